//! Steering columns among `[frames]`: the [`Column`]s they come to.

use nalgebra::{Point3, Vector3};

use super::Scenario;
use super::builder::Builder;
use super::frames::{FrameKind, FrameSection};
use super::functions::{function, listed, points};
use super::quantity::{Quantity, all_si, point};
use occupant_core::forces::column::Column;
use occupant_core::forces::function::{Function, Shape};
use occupant_core::model::setup::OtherFrame;
use placed_text::with_key;

/// What a column has and a panel has not.
const OWN: [&str; 7] = ["axis", "mass", "stroke", "force", "shape", "beyond", "unload_slope"];

/// All columns; `frames` are the frames besides space and the first vehicle.
pub(super) fn columns(b: &mut Builder, scenario: &Scenario, frames: &[OtherFrame]) -> Vec<Column> {
    let all = scenario.frames.iter().filter(|(_, section)| section.is_column());
    let known = all.filter_map(|(name, s)| Some((name, s, frames.iter().position(|frame| frame.name == *name)?)));
    known.collect::<Vec<_>>().into_iter().map(|(name, s, frame)| column(b, name, s, frame)).collect()
}

fn column(b: &mut Builder, name: &str, s: &FrameSection, frame: usize) -> Column {
    let path = with_key("frames", name);
    let axis = s.axis.as_ref().map_or_else(Vector3::zeros, |axis| Vector3::from(all_si(axis)));
    let curve = points(b, &path, ["stroke", "force"], listed(&s.stroke), listed(&s.force));
    let shape: Shape = s.shape.unwrap_or_default();
    Column {
        name: name.to_owned(),
        frame,
        axis,
        mass_kg: b.needed(&path, "mass", &s.mass),
        hub_m: s.origin.as_ref().map_or_else(Point3::origin, point),
        force: Function { shape, ..function(curve, &s.beyond, &None, &None, 1.0) },
        unload_n_per_m: s.unload_slope.as_ref().map(Quantity::si),
    }
}

impl FrameSection {
    /// Whether it is a column.
    pub(super) fn is_column(&self) -> bool {
        self.kind == Some(FrameKind::Column)
    }

    /// Reports keys of the other kind, and what the own lacks.
    pub(super) fn check_keys(&self, b: &mut Builder, path: &str) {
        if self.is_column() {
            let (found, expected) =
                ("a path of a column, which goes where it is pushed", "`kind = \"panel\"`, or no path");
            b.refuse_keys(path, &["path"], |_| found.to_owned(), expected);
            for (key, is_there) in [("axis", self.axis.is_some()), ("stroke", self.stroke.is_some())] {
                if !is_there {
                    b.error(
                        path,
                        format!("`{path}` has no key `{key}`"),
                        "`axis`, `mass`, `stroke` and `force` of a column",
                    );
                }
            }
        } else {
            b.refuse_keys(path, &OWN, |key| format!("`{key}` of a panel"), "`kind = \"column\"` beside it");
            if self.path.is_none() {
                b.error(path, format!("`{path}` has no key `path`"), "path = { kind = … }, or `kind = \"column\"`");
            }
        }
    }
}
