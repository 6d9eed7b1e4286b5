//! Steering columns and hinges among `[frames]`, converted to [`Column`]s.

use nalgebra::{Point3, Vector3};

use super::Scenario;
use super::builder::Builder;
use super::frames::{FrameKind, FrameSection};
use super::functions::{function, listed, points};
use super::quantity::{Quantity, all_si, point};
use occupant_core::forces::column::{Column, Hinge};
use occupant_core::forces::function::{Function, Shape};
use occupant_core::model::setup::OtherFrame;
use placed_text::with_key;

/// Keys of columns and hinges that a panel lacks; of columns that hinges lack; and the reverse.
const OWN: [&str; 4] = ["axis", "mass", "shape", "beyond"];
const SLIDES: [&str; 3] = ["stroke", "force", "unload_slope"];
const TURNS: [&str; 5] = ["centre", "inertia", "angle", "moment", "unload_stiffness"];

/// All columns and hinges; `frames` are the frames besides space and the first vehicle.
pub(super) fn columns(b: &mut Builder, scenario: &Scenario, frames: &[OtherFrame]) -> Vec<Column> {
    let all = scenario.frames.iter().filter(|(_, section)| section.gives());
    let known = all.filter_map(|(name, s)| Some((name, s, frames.iter().position(|frame| frame.name == *name)?)));
    known.collect::<Vec<_>>().into_iter().map(|(name, s, frame)| column(b, name, s, frame)).collect()
}

fn column(b: &mut Builder, name: &str, s: &FrameSection, frame: usize) -> Column {
    let path = with_key("frames", name);
    let axis = s.axis.as_ref().map_or_else(Vector3::zeros, |axis| Vector3::from(all_si(axis)));
    let turns = s.kind == Some(FrameKind::Hinge);
    let curve = if turns {
        points(b, &path, ["angle", "moment"], listed(&s.angle), listed(&s.moment))
    } else {
        points(b, &path, ["stroke", "force"], listed(&s.stroke), listed(&s.force))
    };
    let shape: Shape = s.shape.unwrap_or_default();
    let place = |place: &Option<_>| place.as_ref().map_or_else(Point3::origin, point);
    let slope = s.unload_slope.as_ref().map(Quantity::si);
    Column {
        name: name.to_owned(),
        frame,
        axis,
        mass_kg: b.needed(&path, "mass", &s.mass),
        hub_m: place(if turns { &s.centre } else { &s.origin }),
        force: Function { shape, ..function(curve, &s.beyond, &None, &None, 1.0) },
        unload_n_per_m: if turns { s.unload_stiffness.as_ref().map(Quantity::si) } else { slope },
        hinge: turns.then(|| Hinge { at_m: place(&s.origin), inertia_kg_m2: b.needed(&path, "inertia", &s.inertia) }),
    }
}

impl FrameSection {
    /// Whether it moves under load.
    pub(super) fn gives(&self) -> bool {
        matches!(self.kind, Some(FrameKind::Column | FrameKind::Hinge))
    }

    /// Reports keys of other kinds, and missing keys of its own.
    pub(super) fn check_keys(&self, b: &mut Builder, path: &str) {
        let (keys, others, expected): (&[(&str, bool)], _, _) = match self.kind {
            Some(FrameKind::Column) => (
                &[("axis", self.axis.is_some()), ("stroke", self.stroke.is_some())],
                &TURNS[..],
                "`axis`, `mass`, `stroke` and `force` of a column",
            ),
            Some(FrameKind::Hinge) => (
                &[("axis", self.axis.is_some()), ("centre", self.centre.is_some()), ("angle", self.angle.is_some())],
                &SLIDES[..],
                "`origin`, `axis`, `mass`, `centre`, `inertia`, `angle` and `moment` of a hinge",
            ),
            _ => return self.check_panel(b, path),
        };
        let kind = if self.kind == Some(FrameKind::Hinge) { "hinge" } else { "column" };
        let found = format!("a path in a {kind}, which moves where it is pushed");
        b.refuse_keys(path, &["path"], |_| found.clone(), "`kind = \"panel\"`, or no path");
        let other = if kind == "hinge" { "column" } else { "hinge" };
        b.refuse_keys(path, others, |key| format!("`{key}` in a {kind}"), &format!("`kind = \"{other}\"`"));
        for (key, _) in keys.iter().filter(|(_, is_there)| !is_there) {
            b.error(path, format!("`{path}` has no key `{key}`"), expected);
        }
    }

    fn check_panel(&self, b: &mut Builder, path: &str) {
        b.refuse_keys(path, &OWN, |key| format!("`{key}` in a panel"), "`kind = \"column\"` or \"hinge\"");
        for (keys, kind) in [(&SLIDES[..], "column"), (&TURNS[..], "hinge")] {
            b.refuse_keys(path, keys, |key| format!("`{key}` in a panel"), &format!("`kind = \"{kind}\"`"));
        }
        if self.path.is_none() {
            let expected = "path = { kind = … }, or `kind = \"column\"` or \"hinge\"";
            b.error(path, format!("`{path}` has no key `path`"), expected);
        }
    }
}
