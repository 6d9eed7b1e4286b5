//! Results of a kind of force element: quantities, peaks, tables, events, and drawing data.

use std::marker::PhantomData;

use nalgebra::{Point3, Vector3};

use super::contact::Touch;
use super::contact::surface::Frame;
use super::element::Element;
use super::sphere::Use;
use super::stored::Archive;
use super::table::{Column, Table};
use crate::body::Body;
use crate::motion::scalar::Scalar;
use crate::quantity::{Owner, Quantity};

/// A kind of force element in results. Result files, summaries, tables, studies, pictures and sensitivities access a
/// kind by this trait only.
///
///
/// A kind with named elements has an action for each at every output, in the order of the names.
pub trait Reported: Element + 'static {
    /// Message type of an element in the result file; its topic is the singular name of the kind and the element's
    /// name.
    const MESSAGE: &'static str = "";
    /// Fields of that message, and time histories of an element.
    const QUANTITIES: &'static [Quantity<OneOf<Self>>] = &[];
    /// Quantities of an element whose peaks the summary of a run lists.
    const PEAKS: &'static [Tracked] = &[];

    /// Whether the summary of a run has a table of their peaks.
    const SHOWS_PEAKS: bool = true;
    /// Whether the summary of a run lists their events: [`Reported::event`].
    const TELLS: bool = false;

    /// Passes the values of [`Reported::PEAKS`], in their order, to a tracker.
    #[inline(always)]
    fn track<S: Scalar>(_action: &Self::Action<S>, _tracker: &mut impl Tracker<S>) {}

    /// Reads or writes their memory in a result file; at the start of a step, `like` is their memory at the output.
    fn keep(_past: &mut Vec<Self::Past<f64>>, _like: Option<&[Self::Past<f64>]>, _file: &mut dyn Archive) {}

    /// Names of the elements and the spheres on which they act.
    fn named<'a>(_data: Self::Data<'a>) -> Vec<Named<'a>> {
        Vec::new()
    }

    /// Table of the elements at the start of a run.
    fn start_table(_shown: &Shown<'_, Self>) -> Option<Table> {
        None
    }

    /// Lines in pictures.
    fn lines(_shown: &Shown<'_, Self>) -> Vec<Line> {
        Vec::new()
    }

    /// Plane figures in pictures.
    fn sections(_shown: &Shown<'_, Self>) -> Vec<Section> {
        Vec::new()
    }

    /// Shows every force on a sphere except those of contacts, which have points and depths of their own.
    fn pulls(_shown: &Shown<'_, Self>, _show: &mut dyn FnMut(&Pull<'_>)) {}

    /// Shows switches between two commits: the index of each action, and the event as text of [`Reported::event`].
    fn switched(
        _law: &Self::Law<f64>,
        _before: &[Self::Past<f64>],
        _now: &[Self::Past<f64>],
        _show: &mut dyn FnMut(usize, &'static str),
    ) {
    }

    /// How many there are of what has events at accepted steps.
    fn most_told(law: &Self::Law<f64>) -> usize {
        if Self::BY_STEPS.is_empty() { 0 } else { Self::most_actions(law) }
    }

    /// What events are told of, in the order of their numbers: a name, and what follows the words of the event.
    fn tellers(data: Self::Data<'_>, _law: &Self::Law<f64>, _body: &Body) -> Vec<[String; 2]> {
        let named = Self::named(data).into_iter().filter(|_| Self::TELLS);
        named.map(|one| [one.name.to_owned(), String::new()]).collect()
    }

    /// Events at accepted steps, as text of [`Reported::event`]: all that [`Reported::switched`] and [`Reported::told`]
    /// report.
    const BY_STEPS: &'static [&'static str] = &[];

    /// Shows the events of an element between two accepted steps, by its tracked values there.
    fn told(_before: &[f64], _now: &[f64], _show: &mut dyn FnMut(&'static str)) {}

    /// Event of an element between two evaluations, as text that follows its name, and the jump of its force, N; none
    /// for a mere change of slope.
    fn event<S: Scalar>(_before: &Self::Action<S>, _now: &Self::Action<S>) -> Option<(&'static str, Option<S>)> {
        None
    }
}

/// One element of a kind, as owner of quantities.
#[derive(Clone, Copy, Debug)]
pub struct OneOf<E>(PhantomData<E>);

impl<E: Reported> Owner for OneOf<E> {
    type At<'a> = &'a E::Action<f64>;
}

/// The elements of one kind at one output.
pub struct Shown<'a, E: Element> {
    /// Setup data.
    pub data: E::Data<'a>,
    /// Law.
    pub law: &'a E::Law<f64>,
    /// Actions.
    pub actions: &'a [E::Action<f64>],
    /// The body.
    pub body: &'a Body,
    /// Centre of a sphere for a use, vehicle axes, m.
    pub centre_m: &'a dyn Fn(usize, Use) -> Point3<f64>,
    /// A point of a frame, axes of the first vehicle, m.
    pub place_m: &'a dyn Fn(Frame, Point3<f64>) -> Point3<f64>,
}

/// A single element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Named<'a> {
    /// Its name.
    pub name: &'a str,
    /// Index of the sphere on which it acts; none for a joint.
    pub sphere: Option<usize>,
}

/// Line of an element in pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Name of the element.
    pub name: String,
    /// Points, vehicle axes, m.
    pub points_m: Vec<Point3<f64>>,
    /// Force along it, N.
    pub force_n: f64,
}

/// Plane figure of an element in pictures, such as a section of a bag.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Name of the element.
    pub name: String,
    /// Corners of a convex polygon, vehicle axes, m.
    pub corners_m: Vec<Point3<f64>>,
}

/// The force of an element on a sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pull<'a> {
    /// Kind of element: [`Element::NAMES`].
    pub of: &'static str,
    /// Name of the element.
    pub name: &'a str,
    /// Index of the sphere.
    pub sphere: usize,
    /// Point of application, vehicle axes, m.
    pub point_m: Point3<f64>,
    /// Force, vehicle axes, N.
    pub force_n: Vector3<f64>,
}

/// Follows the actions of force elements from step to step.
pub trait Tracker<S> {
    /// Value whose maximum is kept.
    fn number(&mut self, number: S);
    /// Several values.
    #[inline(always)]
    fn numbers(&mut self, numbers: &[S])
    where
        S: Copy,
    {
        for number in numbers {
            self.number(*number);
        }
    }
    /// Contact of a sphere.
    fn touch(&mut self, touch: &Touch<S>);
}

/// Quantity whose maximum over a run is kept: [`Reported::track`] shows it.
#[derive(Clone, Copy, Debug)]
pub struct Tracked {
    /// Column of the peak.
    pub column: Column,
    /// Column of its time, empty where the peak is not above 0.
    pub time: Option<Column>,
    /// Whether a peak below 0 counts as 0.
    pub at_least_zero: bool,
}
