//! From a body and flat faces to contact pairs: each sphere against each face it can touch, seams joined.

use nalgebra::{Point3, Vector3};

use super::{ContactData, EdgeForce};
use crate::body::{Body, ContactSphere};
use crate::forces::contact::face::{Outline, V2};
use crate::forces::contact::flat_face::FlatFace;
use crate::forces::contact::material::{Material, Memory};
use crate::forces::contact::self_contact::SelfPairs;
use crate::forces::contact::shared::Numbers;
use crate::forces::contact::solid::Solids;
use crate::forces::contact::surface::{Frame, Outline as FaceOutline, Surface};
use crate::forces::contact::{ContactSystem, Group, MaterialLaw, Pair, Part, Plane};
use crate::forces::sphere::Use;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// No sphere approaches a face faster than this, m/s: several times any crash.
pub(crate) const FASTEST_M_S: f64 = 100.0;

impl ContactSystem<f64> {
    /// All pairs of `body` with surfaces whose planes are known.
    pub fn new(body: &Body, data: &ContactData<'_>) -> Self {
        let &ContactData { surfaces, faces, solids, behind, self_contact, materials, edge_force, longest_step_s } =
            data;
        let mut system = ContactSystem {
            edge_lever: match edge_force {
                EdgeForce::AtContactPoint => 1.0,
                EdgeForce::AtCentre => 0.0,
            },
            reach_of_a_step: FASTEST_M_S * longest_step_s,
            ..ContactSystem::default()
        };
        system.carriers = carriers(data);
        let frames = frames(surfaces.iter().map(|s| s.frame), &system.carriers);
        let seams = seams(faces);
        let flats: Vec<Flat> = faces.iter().map(Flat::new).collect();
        let mut numbers = Numbers::new();
        for (sphere, data) in body.spheres.iter().enumerate() {
            for &(frame, index) in &frames {
                if is_own(body, data, frame) {
                    continue;
                }
                for by in uses(data) {
                    let first = system.pairs.len();
                    let reaches = |i: usize| {
                        let own = &surfaces[i].spheres;
                        let is_met = surfaces[i].frame == frame && own.as_ref().is_none_or(|s| s.contains(&sphere));
                        is_met && meets(by, data, behind, i)
                    };
                    for parts in joined(reaches, surfaces.len(), &seams) {
                        system.planes.push(plane(&faces[parts[0]], data.radius_m));
                        let make = || pair(&parts, surfaces, &flats, materials, data.share);
                        system.pairs.push(numbers.of((data.share.to_bits(), parts.clone())), make);
                    }
                    let pairs = first..system.pairs.len();
                    if !pairs.is_empty() {
                        system.groups.push(Group { sphere, frame: index, by: *by, pairs });
                    }
                }
            }
        }
        system.solids = Solids::new(body, data, &system.carriers, system.pairs.len());
        let (first, names) = (system.pairs.len() + system.solids.count(), surfaces.len() + solids.len());
        system.own = SelfPairs::new(body, self_contact, materials, first, names);
        system.find_panes(body, data);
        system
    }
}

/// Segments that carry surfaces or solids, each once.
pub(crate) fn carriers(data: &ContactData<'_>) -> Vec<usize> {
    let frames = data.surfaces.iter().map(|s| s.frame).chain(data.solids.iter().map(|s| s.frame));
    let mut carriers: Vec<usize> = frames.filter_map(Frame::segment).collect();
    carriers.sort_unstable();
    carriers.dedup();
    carriers
}

/// The frames that are there with their places among those of an instant, that of the first vehicle first, then space.
pub(super) fn frames(all: impl Iterator<Item = Frame>, carriers: &[usize]) -> Vec<(Frame, usize)> {
    let mut frames =
        vec![(Frame::Vehicle, Frame::Vehicle.index(carriers)), (Frame::Space, Frame::Space.index(carriers))];
    let mut others: Vec<_> = all.map(|frame| (frame, frame.index(carriers))).collect();
    others.sort_by_key(|(_, index)| *index);
    others.dedup();
    frames.extend(others.into_iter().filter(|(frame, _)| !matches!(frame, Frame::Vehicle | Frame::Space)));
    frames
}

/// Whether a frame is a segment of the body that a sphere belongs to.
pub(super) fn is_own(bodies: &Body, sphere: &ContactSphere, frame: Frame) -> bool {
    let tree = bodies.tree;
    frame.segment().is_some_and(|n| tree.body_of(tree.segment(n)) == tree.body_of(sphere.segment))
}

/// For each face those before it that it joins.
fn seams(faces: &[FlatFace]) -> Vec<Vec<usize>> {
    let mut seams = vec![Vec::new(); faces.len()];
    FlatFace::seams(faces).for_each(|[first, second]| seams[second].push(first));
    seams
}

/// As what surfaces use a sphere: one that rides has those apart that the spine leans on.
pub(super) fn uses(sphere: &ContactSphere) -> &'static [Use] {
    if sphere.ride.contact.is_empty() { &[Use::Contact] } else { &[Use::Contact, Use::Back] }
}

/// Whether a sphere meets a surface or solid (number) under a use; `behind` lists those that the spine leans on.
pub(super) fn meets(by: &Use, sphere: &ContactSphere, behind: &[usize], number: usize) -> bool {
    sphere.ride.contact.is_empty() || behind.contains(&number) == (*by == Use::Back)
}

/// Of `count` faces those that a sphere `reaches`, in groups that act as one; in order of their first surface.
fn joined(reaches: impl Fn(usize) -> bool, count: usize, seams: &[Vec<usize>]) -> Vec<Vec<usize>> {
    // an earlier face of the same group, at last its first; the face itself where there is none
    let mut earlier: Vec<usize> = (0..count).collect();
    let first_of = |earlier: &mut Vec<usize>, mut i: usize| {
        while earlier[i] != i {
            earlier[i] = earlier[earlier[i]];
            i = earlier[i];
        }
        i
    };
    let mut groups: Vec<Vec<usize>> = vec![Vec::new(); count];
    for i in (0..count).filter(|i| reaches(*i)) {
        for &j in seams[i].iter().filter(|&&j| reaches(j)) {
            let (a, b) = (first_of(&mut earlier, i), first_of(&mut earlier, j));
            earlier[a.max(b)] = a.min(b);
        }
    }
    for i in (0..count).filter(|i| reaches(*i)) {
        groups[first_of(&mut earlier, i)].push(i);
    }
    groups.retain(|group| !group.is_empty());
    groups
}

fn plane<S: Scalar>(face: &FlatFace, radius_m: f64) -> Plane<S> {
    Plane { normal: V3::of(&face.normal), reach: S::of(radius_m + face.offset_m) }
}

/// A face and the axes of its plane.
struct Flat<'f> {
    face: &'f FlatFace,
    axes: [Vector3<f64>; 2],
    /// Its outline in them.
    outline: Outline<f64>,
}

impl<'f> Flat<'f> {
    fn new(face: &'f FlatFace) -> Self {
        let (u, v) = face.plane_axes();
        Flat { face, axes: [u, v], outline: outline(face, &[u, v]) }
    }
}

/// Outline of a face in the axes of a plane.
fn outline(face: &FlatFace, [u, v]: &[Vector3<f64>; 2]) -> Outline<f64> {
    let flat = |p: &Point3<f64>| [u.dot(&p.coords), v.dot(&p.coords)];
    match &face.outline {
        FaceOutline::Polygon(corners) => Outline::polygon(&corners.iter().map(flat).collect::<Vec<_>>()),
        FaceOutline::Disc { centre_m, radius_m, .. } => {
            let [u, v] = flat(centre_m);
            Outline::Disc { centre: V2 { u, v }, radius: *radius_m }
        }
        FaceOutline::Unbounded { .. } => Outline::Unbounded,
    }
}

fn pair(parts: &[usize], surfaces: &[Surface], flats: &[Flat], materials: &[Material], share: f64) -> Pair<f64> {
    let Flat { face: first, axes: [u, v], .. } = &flats[parts[0]];
    let part = |&i: &usize| {
        let material = &materials[surfaces[i].material];
        // several faces that act as one are measured in the axes of the first
        let outline = if i == parts[0] { flats[i].outline.clone() } else { outline(flats[i].face, &[*u, *v]) };
        Part { surface: i, outline, law: MaterialLaw::new(material, share) }
    };
    let retains = parts.iter().any(|&i| materials[surfaces[i].material].memory == Memory::Retain);
    Pair {
        u: V3::of(u),
        v: V3::of(v),
        normal: V3::of(&first.normal),
        parts: parts.iter().map(part).collect(),
        retain: if retains { 1.0 } else { 0.0 },
    }
}
