//! Force elements in results, kind by kind: drawing data, forces and quantities at an output.

use crate::forces::contact::surface::Frame;
use crate::forces::shown::{Line, Named, Pull, Section, Shown};
use crate::forces::table::Tables;
use crate::forces::{Listed, Visitor, visit_kinds};
use crate::model::Model;
use crate::model::setup::Member;
use crate::results::sample::Sample;
use crate::vehicle::FrameMotion;
use nalgebra::{Point3, Vector3};

impl Sample<'_> {
    /// Elements of one kind.
    fn show<E: Listed, T>(&self, of: impl FnOnce(&Shown<'_, E>) -> T) -> T {
        let (model, at_home) = (self.model, Sample { watcher: None, ..*self });
        of(&Shown {
            data: E::data(&model.setup().forces(model.faces())),
            law: E::law(&model.system().forces),
            actions: E::actions(self.actions),
            body: model.body(),
            centre_m: &|sphere, by| at_home.sphere_under_m(sphere, by),
            place_m: &|frame, point_m| self.placed_m(frame, point_m),
        })
    }

    /// A point of a frame, axes of the first vehicle, m.
    fn placed_m(&self, frame: Frame, point_m: Point3<f64>) -> Point3<f64> {
        match frame {
            Frame::Vehicle => point_m,
            frame => self.vehicle.point_to_frame(self.frame(frame).point_to_space(point_m.coords)).into(),
        }
    }

    /// Lines of force elements in pictures.
    pub fn lines(&self) -> Vec<Line> {
        let mut list = Lines(self, Vec::new());
        visit_kinds(&mut list);
        for line in &mut list.1 {
            // what belongs to one of several bodies bears its name
            let is_own = |member: &Member| line.name.split_once('.').is_some_and(|(of, _)| of == member.name);
            let own = self.model.setup().members.iter().position(is_own);
            for point in &mut line.points_m {
                *point = self
                    .watched(own.unwrap_or(0), point.coords, FrameMotion::point_to_space, FrameMotion::point_to_frame)
                    .into();
            }
        }
        list.1
    }

    /// Plane figures of force elements in pictures.
    pub fn sections(&self) -> Vec<Section> {
        let mut list = Sections(self, Vec::new());
        visit_kinds(&mut list);
        list.1
    }

    /// Shows every force on a sphere except those of contacts.
    pub fn pulls(&self, show: &mut dyn FnMut(&Pull<'_>)) {
        let tree = self.model.body().tree;
        visit_kinds(&mut Pulls(self, &mut |pull: &Pull<'_>| {
            let of = tree.body_of(self.model.body().spheres[pull.sphere].segment);
            let point = self.watched(of, pull.point_m.coords, FrameMotion::point_to_space, FrameMotion::point_to_frame);
            let force_n = self.watched(of, pull.force_n, FrameMotion::vector_to_space, FrameMotion::vector_to_frame);
            show(&Pull { point_m: point.into(), force_n, ..*pull });
        }));
    }

    /// A vector in axes of a body's home, transformed to those of the observer, if there is one.
    fn watched(
        &self,
        of: usize,
        told: Vector3<f64>,
        out: fn(&FrameMotion, Vector3<f64>) -> Vector3<f64>,
        into: fn(&FrameMotion, Vector3<f64>) -> Vector3<f64>,
    ) -> Vector3<f64> {
        let is_there = |watcher: &&FrameMotion| **watcher != self.homes[of];
        self.watcher.filter(is_there).map_or(told, |watcher| into(watcher, out(&self.homes[of], told)))
    }

    /// Tables of force elements at the start of a run.
    pub(crate) fn start_tables(&self) -> Tables {
        let mut list = StartTables(self, Tables::new());
        visit_kinds(&mut list);
        list.1
    }
}

impl Model {
    /// Names of all kinds of force elements that the model can have, and of its own elements.
    pub(crate) fn element_names(&self) -> Vec<&str> {
        let mut list = AllNames { model: self, list: Vec::new() };
        visit_kinds(&mut list);
        list.list
    }

    /// Elements of the kind with the singular name `of`, in the scenario's order.
    pub fn named(&self, of: &str) -> Vec<Named<'_>> {
        let mut list = Names { model: self, of, list: Vec::new() };
        visit_kinds(&mut list);
        list.list
    }
}

struct Lines<'s, 'a>(&'s Sample<'a>, Vec<Line>);

impl Visitor for Lines<'_, '_> {
    fn visit<E: Listed>(&mut self) {
        self.1.extend(self.0.show(E::lines));
    }
}

struct Sections<'s, 'a>(&'s Sample<'a>, Vec<Section>);

impl Visitor for Sections<'_, '_> {
    fn visit<E: Listed>(&mut self) {
        self.1.extend(self.0.show(E::sections));
    }
}

struct Pulls<'s, 'a, 'f>(&'s Sample<'a>, &'f mut dyn FnMut(&Pull<'_>));

impl Visitor for Pulls<'_, '_, '_> {
    fn visit<E: Listed>(&mut self) {
        self.0.show(|shown| E::pulls(shown, self.1));
    }
}

struct StartTables<'s, 'a>(&'s Sample<'a>, Tables);

impl Visitor for StartTables<'_, '_> {
    fn visit<E: Listed>(&mut self) {
        self.1.extend(self.0.show(E::start_table).map(|table| (E::NAMES[1], table)));
    }
}

struct AllNames<'m> {
    model: &'m Model,
    list: Vec<&'m str>,
}

impl Visitor for AllNames<'_> {
    fn visit<E: Listed>(&mut self) {
        self.list.push(E::NAMES[0]);
        self.list.extend(E::named(E::data(&self.model.setup().forces(self.model.faces()))).iter().map(|one| one.name));
    }
}

struct Names<'m, 'o> {
    model: &'m Model,
    of: &'o str,
    list: Vec<Named<'m>>,
}

impl Visitor for Names<'_, '_> {
    fn visit<E: Listed>(&mut self) {
        if E::NAMES[0] == self.of {
            self.list = E::named(E::data(&self.model.setup().forces(self.model.faces())));
        }
    }
}
