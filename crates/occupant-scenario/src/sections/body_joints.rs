//! `[body.joints]`: the joints between the segments of a body.

use nalgebra::{UnitQuaternion, Vector3};

use super::body::{BodyJointSection, BodySection, turned};
use super::builder::Builder;
use super::quantity::{all_si, point};
use occupant_core::body::named::{NamedJoint, NamedLandmarks, TreeProblem, tree};
use occupant_core::body::{JointKind, JointPlace, JointSite, Tree};
use occupant_core::motion::layout::MOST_OF_TREE;
use placed_text::with_key;

/// A joint with the names of its segments.
struct Hung<'a> {
    name: &'a str,
    proximal: &'a str,
    distal: &'a str,
    section: &'a BodyJointSection,
}

/// The tree of a body's joints, with their positions in its order; none if they do not form a tree.
pub(super) fn own_tree(b: &mut Builder, body: &BodySection, is_part: bool) -> Option<(&'static Tree, Vec<JointPlace>)> {
    let hung: Vec<Hung<'_>> = body.joints.iter().filter_map(|(name, section)| named(b, body, name, section)).collect();
    if hung.len() < body.joints.len() {
        return None;
    }
    let hung = ordered(b, body, hung)?;
    let places: Vec<JointPlace> = hung.iter().map(|joint| place(b, joint)).collect();
    let half_m = |segment: &str| {
        let length = body.segments.get(segment).and_then(|section| section.length.as_ref());
        0.5 * length.map_or(0.0, |length| length.si())
    };
    let joints = hung.iter().zip(&places).map(|(joint, place)| NamedJoint {
        name: joint.name,
        kind: kind(joint.section),
        proximal: joint.proximal,
        distal: joint.distal,
        hangs: place.distal.point_m.z > half_m(joint.distal),
    });
    let own = body.landmarks.clone().unwrap_or_default();
    let marks = NamedLandmarks {
        head: own.head.as_deref(),
        chest: own.chest.as_deref(),
        pelvis: own.pelvis.as_deref(),
        is_part,
    };
    match tree(&joints.collect::<Vec<_>>(), &marks) {
        Ok(tree) => Some((tree, places)),
        Err(problem) => {
            let expected = match problem {
                TreeProblem::MissingLandmark(key) => {
                    format!("landmarks = {{ {key} = \"a segment with a parent joint\" }}")
                }
                _ => "joints that hang each segment on one before it".to_owned(),
            };
            b.error("body.landmarks", problem.to_string(), expected);
            None
        }
    }
}

fn named<'a>(b: &mut Builder, body: &'a BodySection, name: &'a str, section: &'a BodyJointSection) -> Option<Hung<'a>> {
    let path = with_key("body.joints", name);
    let names: Vec<&str> = body.segments.keys().map(String::as_str).collect();
    let mut segment = |key: &str, written: &'a Option<String>| {
        let Some(segment) = written.as_deref() else {
            b.error(&path, format!("`{path}` has no key `{key}`"), format!("{key} = a name in `body.segments`"));
            return None;
        };
        if !body.segments.contains_key(segment) {
            b.unknown(&with_key(&path, key), "segment", segment, &names);
            return None;
        }
        Some(segment)
    };
    let (proximal, distal) = (segment("proximal", &section.proximal), segment("distal", &section.distal));
    Some(Hung { name, proximal: proximal?, distal: distal?, section })
}

/// Whether the kernel supports this number of segments.
fn fits(b: &mut Builder, rest: &[Hung<'_>]) -> bool {
    let axes = |joint: &Hung<'_>| match kind(joint.section) {
        JointKind::Hinge => 1,
        JointKind::Universal => 2,
        JointKind::Ball | JointKind::Fixed => 0,
    };
    let (segments, axes) = (rest.len() + 1, rest.iter().map(axes).sum::<usize>());
    if segments > MOST_OF_TREE || axes > MOST_OF_TREE {
        let found = format!("{segments} segments with {axes} axes of pins and universal joints");
        b.error("body.joints", found, format!("{MOST_OF_TREE} segments and {MOST_OF_TREE} axes at most"));
        return false;
    }
    true
}

/// The joints, each after the one that carries its proximal segment.
fn ordered<'a>(b: &mut Builder, body: &'a BodySection, mut rest: Vec<Hung<'a>>) -> Option<Vec<Hung<'a>>> {
    if !fits(b, &rest) {
        return None;
    }
    let twice = rest.iter().enumerate().find_map(|(i, joint)| {
        let first = rest[..i].iter().find(|first| first.distal == joint.distal)?;
        Some((joint.name, format!("segment `{}` already has a parent joint, `{}`", joint.distal, first.name)))
    });
    if let Some((name, found)) = twice {
        let path = with_key(&with_key("body.joints", name), "distal");
        b.error(&path, found, "one parent joint per segment");
        return None;
    }
    let mut roots = body.segments.keys().filter(|name| rest.iter().all(|joint| joint.distal != name.as_str()));
    let root = roots.next();
    if let (Some(root), Some(other)) = (root, roots.next()) {
        let found = format!("neither `{root}` nor `{other}` has a parent joint");
        b.error(&with_key("body.segments", other), found, "exactly one segment, the root, without a parent joint");
        return None;
    }
    let mut held: Vec<&str> = root.into_iter().map(String::as_str).collect();
    let mut ordered = Vec::new();
    while let Some(next) = rest.iter().position(|joint| held.contains(&joint.proximal)) {
        let joint = rest.remove(next);
        held.push(joint.distal);
        ordered.push(joint);
    }
    if let Some(first) = rest.first() {
        let names: Vec<String> = rest.iter().map(|joint| format!("`{}`", joint.name)).collect();
        let found = format!("joints that form a loop, or hang on one: {}", names.join(", "));
        let expected = "a tree of joints from the root to every segment";
        b.error(&with_key("body.joints", first.name), found, expected);
        return None;
    }
    Some(ordered)
}

fn kind(section: &BodyJointSection) -> JointKind {
    match section.kind.as_deref() {
        Some("pin") => JointKind::Hinge,
        Some("universal") => JointKind::Universal,
        Some("fixed") => JointKind::Fixed,
        _ => JointKind::Ball,
    }
}

fn place(b: &mut Builder, joint: &Hung<'_>) -> JointPlace {
    let (path, section) = (with_key("body.joints", joint.name), joint.section);
    let about = section.axis.as_ref().map_or_else(UnitQuaternion::identity, |axis| {
        let axis = Vector3::from(all_si(axis));
        if kind(section) != JointKind::Hinge || axis.norm() < 1e-6 {
            b.error(&with_key(&path, "axis"), "an axis", "the axis of a pin, not [0, 0, 0]");
        }
        // any turn that brings Y there will do; the one for an axis against Y is about Z
        let half_turn = || UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::PI);
        UnitQuaternion::rotation_between(&Vector3::y(), &axis).unwrap_or_else(half_turn)
    });
    let mut site = |key: &str, at: &Option<[super::Length; 3]>, axes: &Option<[super::Angle; 3]>| {
        if at.is_none() {
            b.error(&path, format!("`{path}` has no key `{key}`"), format!("{key} = [x, y, z] from its lower end"));
        }
        let point_m = at.as_ref().map_or_else(Vector3::zeros, |at| point(at).coords);
        JointSite { point_m, axes: about * turned(axes) }
    };
    let proximal = site("on_proximal", &section.on_proximal, &section.axes_on_proximal);
    JointPlace { proximal, distal: site("on_distal", &section.on_distal, &section.axes_on_distal) }
}
