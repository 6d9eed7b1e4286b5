//! Whether all references exist: frames, segments, spheres, names.

use crate::forces::chain::Site;
use crate::forces::contact::surface::Frame;
use crate::model::seating::InitialPosture;
use crate::model::setup::{Member, Setup};
use crate::motion::frame::{MOST_FRAMES, VEHICLE};
use placed_text::{Problems, with_key};

/// Largest number of frames besides space and the first vehicle.
const MOST_OTHERS: usize = MOST_FRAMES - VEHICLE - 1;

/// Reports invalid indices. All other checks rely on it: none may read a setup with such errors.
pub(super) fn check(setup: &Setup, problems: &mut Problems) {
    check_frames(setup, problems);
    check_carried(setup, problems);
    check_body(setup, problems);
    check_nodes(setup, problems);
    check_markers(setup, problems);
    check_members(setup, problems);
    problems.check_unique("materials", "material", setup.materials.iter().map(|m| m.name.as_str()));
}

/// Reason why a frame is invalid, if it is; `segments`: whether it may be a segment.
fn lost(setup: &Setup, frame: Frame, segments: bool) -> Option<String> {
    let (frames, count) = (setup.frames.len(), setup.body.segments.len());
    match frame {
        Frame::Space | Frame::Vehicle => None,
        Frame::Other(i) => (i >= frames).then(|| format!("frame {i} of {frames}")),
        Frame::Segment(n) if segments => (n >= count).then(|| format!("segment {n} of {count}")),
        Frame::Segment(n) => Some(format!("segment {n}")),
    }
}

fn check_frames(setup: &Setup, problems: &mut Problems) {
    let frames = &setup.frames;
    if frames.len() > MOST_OTHERS {
        let found = format!("{} frames besides space and the vehicle", frames.len());
        problems.error("frames", found, format!("at most {MOST_OTHERS}"));
    }
    problems.check_unique("frames", "frame", frames.iter().map(|frame| frame.name.as_str()));
    for frame in frames.iter().filter(|frame| frame.path.is_live()) {
        problems.error(
            with_key("frames", &frame.name),
            "a path that is given during the run",
            "one that is known in advance: only that of the vehicle can be given during the run",
        );
    }
    for (i, frame) in frames.iter().enumerate() {
        let Some((parent, origin_m)) = frame.parent else { continue };
        let path = format!("{}.parent", with_key("frames", &frame.name));
        let is_before = match parent {
            Frame::Space | Frame::Vehicle => true,
            Frame::Other(j) => j < i,
            Frame::Segment(_) => false,
        };
        if !is_before {
            let found = if parent == Frame::Other(i) { "the frame itself".to_owned() } else { format!("{parent:?}") };
            problems.error(&path, found, "space, the vehicle, or a frame that precedes it in the list");
        }
        if !origin_m.coords.sum().is_finite() {
            problems.error(path, "a point that is not finite", "finite coordinates");
        }
    }
}

/// Checks what moves with a frame.
fn check_carried(setup: &Setup, problems: &mut Problems) {
    let mut each = |path: String, frame: Frame, segments: bool| {
        if let Some(found) = lost(setup, frame, segments) {
            let more = if segments { ", or a segment of the body" } else { "" };
            problems.error(format!("{path}.frame"), found, format!("space, the vehicle, one of `frames`{more}"));
        }
    };
    setup.surfaces.iter().for_each(|one| each(with_key("surfaces", &one.name), one.frame, true));
    setup.solids.iter().for_each(|one| each(with_key("solids", &one.name), one.frame, true));
    setup.scenery.iter().for_each(|one| each(with_key("scenery", &one.name), one.frame, true));
    setup.belts.iter().for_each(|one| each(with_key("belts", &one.name), one.frame, false));
    setup.chains.iter().for_each(|one| each(with_key("belts", &one.belt), one.frame, false));
    let nodes = setup.chains.iter().flat_map(|chain| chain.nodes.iter().map(move |node| (chain, node)));
    for (chain, node) in nodes {
        let path = format!("{}.{}", with_key("belts", &chain.belt), node.name);
        node.frame.iter().for_each(|frame| each(path.clone(), *frame, false));
    }
    let at = match &setup.posture {
        InitialPosture::Mounted(mounting) => Some(mounting.frame),
        InitialPosture::Placed(placing) => Some(placing.at.frame),
        _ => None,
    };
    if let Some(frame @ (Frame::Other(_) | Frame::Segment(_))) = at {
        problems.error("mount.frame", format!("{frame:?}"), "space, or the vehicle of the body");
    }
}

fn check_body(setup: &Setup, problems: &mut Problems) {
    let (body, joints) = (&setup.body, &setup.joints);
    let (segments, count) = (body.segments.len(), body.tree.joints().len());
    for sphere in body.spheres.iter().filter(|sphere| sphere.segment.index() >= segments) {
        let found = format!("segment {} of {segments}", sphere.segment.index());
        problems.error(format!("body.spheres.{}.segment", sphere.name), found, "a segment of this body");
    }
    if joints.tree() != body.tree {
        let of = |tree: &crate::body::Tree| format!("{} segments and {} joints", tree.segments().len(), count);
        let found = format!("joints of another body, of {}", of(joints.tree()));
        problems.error_with_hint("joints", found, "joints of this body's own tree", "`Joints::free(body.tree)`");
    }
    let places = joints.limits.iter().map(|limits| limits.joint).chain(joints.muscles.iter().map(|m| m.joint));
    if let Some(joint) = places.into_iter().find(|joint| joint.index() >= count) {
        problems.error("joints", format!("joint {} of {count}", joint.index()), "a joint of this body");
    }
}

fn check_nodes(setup: &Setup, problems: &mut Problems) {
    let segments = setup.body.segments.len();
    for chain in &setup.chains {
        for (i, node) in chain.nodes.iter().enumerate() {
            if let Site::Segment(n, ..) | Site::Track(n, _) = node.site
                && n >= segments
            {
                let path = format!("{}.nodes[{i}]", with_key("belts", &chain.belt));
                problems.error(path, format!("segment {n} of {segments}"), "a segment of the body");
            }
        }
    }
}

fn check_markers(setup: &Setup, problems: &mut Problems) {
    let (markers, segments) = (&setup.output.markers, setup.body.segments.len());
    problems.check_unique("output.markers", "marker", markers.iter().map(|marker| marker.name.as_str()));
    for marker in markers {
        let path = with_key("output.markers", &marker.name);
        if marker.name.is_empty() {
            problems.error(&path, "a marker without a name", "a name, which results use");
        }
        if marker.segment.index() >= segments {
            let found = format!("segment {} of {segments}", marker.segment.index());
            problems.error(format!("{path}.segment"), found, "a segment of the body");
        }
        if !marker.place_from_lower_end_m.coords.sum().is_finite() {
            problems.error(path, "a position that is not finite", "finite coordinates");
        }
    }
}

/// Checks that members are those of the body, as when one was added to a setup for one body.
fn check_members(setup: &Setup, problems: &mut Problems) {
    let (members, is_together) = (&setup.members, setup.posture == InitialPosture::Together);
    if members.is_empty() {
        if is_together {
            problems.error("posture", "that of several bodies, of which there are none", "a posture of this body");
        }
        return;
    }
    let segments: usize = members.iter().map(|member| member.alone.body.segments.len()).sum();
    if !is_together || setup.body.tree.bodies().len() != members.len() || segments != setup.body.segments.len() {
        let found = format!("{} members that are not the bodies of this setup", members.len());
        problems.error("occupants", found, "a setup that `Setup::together` makes of its members");
    }
    for Member { name, home, meets, alone } in members {
        if let Some(found) = lost(setup, *home, false) {
            problems.error(with_key("occupants", name), found, "space, the vehicle, or one of `frames` for a home");
        }
        if meets.iter().flatten().flatten().any(|sphere| *sphere >= alone.body.spheres.len()) {
            problems.error(
                with_key("occupants", name),
                "no such sphere",
                "spheres of the body that it meets things with",
            );
        }
    }
}
