//! Several bodies as one, and bodies of one rigid segment.

use nalgebra::{UnitQuaternion, Vector3};

use super::tree::{BodyRow, JointRow, Landmarks, Place, SegmentRow, SphereRow, kept};
use super::{Body, ContactSphere, Joint, Plate, Segment, SegmentProperties, Tree, named};

/// Name of a part of a body with or without a name.
pub(crate) fn called(name: &str, part: &str) -> String {
    if name.is_empty() { part.to_owned() } else { format!("{name}.{part}") }
}

impl Body {
    /// A rigid body of one segment without spheres, its centre of gravity at `cg_m` from its origin, the segment's lower end.
    pub fn rigid(name: &str, mass_kg: f64, inertia_kg_m2: [f64; 3], cg_m: Vector3<f64>) -> Body {
        let segment = SegmentProperties {
            length_m: 2.0 * cg_m.z,
            cg_from_lower_end_m: cg_m.z,
            cg_beside_m: cg_m.xy(),
            mass_kg,
            inertia_kg_m2: inertia_kg_m2.into(),
            principal: UnitQuaternion::identity(),
        };
        Body {
            name: name.to_owned(),
            tree: named::lone(name),
            segments: vec![segment],
            places: Vec::new(),
            shoulder_half_width_m: 0.0,
            hip_half_width_m: 0.0,
            neck_height_m: 0.0,
            condyles_m: None,
            spheres: Vec::new(),
            plates: Vec::new(),
            chests: Vec::new(),
            sides: Vec::new(),
        }
    }

    /// Several named bodies as one, in order; each name prefixes those of its parts.
    pub(crate) fn together(all: &[(&str, &Body)]) -> Body {
        let trees: Vec<_> = all.iter().map(|(name, body)| (*name, body.tree)).collect();
        let mut first = 0;
        let (mut spheres, mut plates) = (Vec::new(), Vec::<Plate>::new());
        let (mut chests, mut sides) = (Vec::new(), Vec::new());
        for (name, body) in all {
            spheres.extend(body.spheres.iter().map(|sphere| ContactSphere {
                name: called(name, &sphere.name),
                part: called(name, &sphere.part),
                segment: Segment(first + sphere.segment.index()),
                ride: sphere.ride.behind(plates.len()),
                ..sphere.clone()
            }));
            chests.extend(body.chests.iter().map(|chest| chest.of_member(name, plates.len())));
            sides.extend(body.sides.iter().map(|sides| sides.of_member(name, plates.len())));
            plates.extend(body.plates.iter().map(|plate| Plate {
                name: called(name, &plate.name),
                segment: Segment(first + plate.segment.index()),
                ..plate.clone()
            }));
            first += body.segments.len();
        }
        let names: Vec<&str> = all.iter().map(|(name, _)| *name).collect();
        Body {
            name: names.join(" + "),
            tree: Tree::together(&trees),
            segments: all.iter().flat_map(|(_, body)| body.segments.iter().copied()).collect(),
            places: all.iter().flat_map(|(_, body)| body.tree.joints().map(|joint| body.place(joint))).collect(),
            shoulder_half_width_m: 0.0,
            hip_half_width_m: 0.0,
            neck_height_m: 0.0,
            condyles_m: all.first().and_then(|(_, body)| body.condyles_m),
            spheres,
            plates,
            chests,
            sides,
        }
    }
}

impl Tree {
    /// Trees of bodies with these names, concatenated; each name prefixes those of its parts.
    pub(crate) fn together(all: &[(&str, &Tree)]) -> &'static Tree {
        let (mut segments, mut joints, mut spheres, mut bodies) = (vec![], vec![], vec![], vec![]);
        for &(name, tree) in all {
            let (first, first_joint) = (segments.len(), joints.len());
            let moved = |segment: Segment| Segment(first + segment.0);
            let called = |part: &str| kept(&called(name, part));
            segments.extend(tree.segments.iter().map(|row| SegmentRow { name: called(row.name), ..*row }));
            let joint = |row: &JointRow| JointRow {
                name: called(row.name),
                proximal: moved(row.proximal),
                distal: moved(row.distal),
                place: Place::Given,
                ..*row
            };
            joints.extend(tree.joints.iter().map(joint));
            let sphere = |row: &SphereRow| SphereRow { name: called(row.name), segment: moved(row.segment), ..*row };
            spheres.extend(tree.spheres.iter().map(sphere));
            let landmarks = tree.landmarks.map(|s| Some(moved(s)), |j| Some(Joint(first_joint + j.0)));
            bodies.push(BodyRow { name: kept(name), first: Segment(first), landmarks });
        }
        let none = Landmarks::NONE;
        let landmarks = bodies.first().map_or(none, |body: &BodyRow| body.landmarks);
        Tree::interned(&segments, &joints, &spheres, landmarks, &bodies)
    }
}
