//! Frames of columns and mounts of bags.

use crate::forces::MOST_GIVING;
use crate::forces::column::Column;
use crate::forces::contact::surface::Frame;
use crate::model::setup::{OtherFrame, Setup};
use crate::vehicle::{Interpolation, VehiclePath};
use placed_text::{Problems, with_key};

pub(super) fn check(setup: &Setup, problems: &mut Problems) {
    let Setup { columns, frames, bags, .. } = setup;
    if columns.len() > MOST_GIVING {
        problems.error("frames", format!("{} columns", columns.len()), format!("at most {MOST_GIVING} that yield"));
    }
    for (i, column) in columns.iter().enumerate() {
        let path = with_key("frames", &column.name);
        let own = |frame: Frame| columns.iter().any(|other| frame == Frame::Other(other.frame));
        let parent = frames.get(column.frame).and_then(|frame| frame.parent.map(|(parent, _)| parent));
        let stands = |frame: &OtherFrame| matches!(frame.path, VehiclePath::Fixed(_));
        if columns[..i].iter().any(|other| other.frame == column.frame) {
            problems.error(&path, "a second column of one frame", "a frame of its own");
        } else if !frames.get(column.frame).is_some_and(stands) {
            problems.error(&path, "a column of a frame that moves by itself", "one that stands in its parent");
        } else if !parent.is_some_and(|parent| is_carrier(parent) && !own(parent)) {
            problems.error(format!("{path}.parent"), "no vehicle and no panel", "a vehicle, or a panel");
        } else if is_without_acceleration(setup, column) {
            let found = "a parent that moves along straight lines between positions, without acceleration";
            let expected = "`interpolation = \"spline\"` of its table: the weight of the hub counts nothing";
            problems.warning(&path, found, expected);
        }
    }
    for frame in frames.iter().filter(|frame| columns.iter().any(|one| hangs_on(frame, one))) {
        let path = format!("{}.parent", with_key("frames", &frame.name));
        problems.error(path, "a frame carried by a column", "a vehicle, or a panel");
    }
    for bag in
        bags.iter().filter(|bag| matches!(bag.frame, Frame::Other(i) if i >= frames.len()) || !is_carrier(bag.frame))
    {
        problems.error(
            format!("{}.frame", with_key("bags", &bag.name)),
            "no frame of a vehicle",
            "a vehicle, or a frame on it",
        );
    }
}

/// Whether a frame may carry a column or a bag.
fn is_carrier(frame: Frame) -> bool {
    !matches!(frame, Frame::Space | Frame::Segment(_))
}

fn hangs_on(frame: &OtherFrame, column: &Column) -> bool {
    frame.parent.is_some_and(|(parent, _)| parent == Frame::Other(column.frame))
}

/// Whether the carrier of a column moves along straight lines of a table.
fn is_without_acceleration(setup: &Setup, column: &Column) -> bool {
    let is_linear =
        |path: &VehiclePath| matches!(path, VehiclePath::Table(t) if t.interpolation() == Interpolation::Linear);
    let mut frame = Frame::Other(column.frame);
    for _ in 0..=setup.frames.len() {
        let Frame::Other(i) = frame else { return frame == Frame::Vehicle && is_linear(&setup.path) };
        let Some(other) = setup.frames.get(i) else { return false };
        if is_linear(&other.path) {
            return true;
        }
        let Some((parent, _)) = other.parent else { return false };
        frame = parent;
    }
    false
}
