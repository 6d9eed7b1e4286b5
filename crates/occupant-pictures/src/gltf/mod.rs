//! A run as a glTF scene with its motion, for Blender and the web: the body's parts, the surfaces and solids, metres, Y up.
//!
//! ```text
//! axes of glTF ─ space ─ vehicle ─┬ segments, frames (animation 1)
//!                (animation 2) ───┘ surfaces and solids
//! ```

mod file;

use std::collections::BTreeMap;

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::model::Model;
use occupant_core::results::sample::Sample;
use occupant_core::vehicle::FrameMotion;
use serde_json::{Value, json};

use super::body::{Snapshot, parts};
use super::mesh::{self, COARSE, hull};
use file::{File, place, turn};
use occupant_files::base::{Failure, program};
use occupant_files::mcap::scene::compartment::{color_of, corners_m, frame_name, scenery_color};
use occupant_files::results::Results;

/// Largest number of times; of a run with more outputs, every second or third is written.
const MOST: usize = 2000;

/// Poses of bodies and frames at the times written.
struct Motion {
    times_s: Vec<f32>,
    /// By time, then by segment, relative to the vehicle.
    segments: Vec<Vec<Isometry3<f64>>>,
    /// The same of frames besides the vehicle.
    frames: BTreeMap<String, Vec<Isometry3<f64>>>,
    /// The vehicle in space.
    vehicle: Vec<Isometry3<f64>>,
}

/// The file's bytes.
///
/// # Errors
/// None for results that were opened.
pub fn glb(results: &Results) -> Result<Vec<u8>, Failure> {
    let model = &results.model;
    let motion = watched(results)?;
    let mut file = File::default();
    let frames = compartment(&mut file, model);
    let segments = bodies(&mut file, model, &motion);
    let start = |poses: &[Isometry3<f64>]| poses.first().copied().unwrap_or_else(Isometry3::identity);
    let mut children: Vec<usize> = segments.clone();
    let mut moving: Vec<(usize, &[Isometry3<f64>])> = Vec::new();
    for (name, meshes) in frames {
        let poses = motion.frames.get(&name).map_or(&[][..], Vec::as_slice);
        let fixed: Vec<usize> =
            meshes.into_iter().map(|(name, mesh)| file.node(&name, &Isometry3::identity(), Some(mesh), &[])).collect();
        let node = file.node(&name, &start(poses), None, &fixed);
        children.push(node);
        moving.push((node, poses));
    }
    let vehicle = file.node("vehicle", &start(&motion.vehicle), None, &children);
    let root = file.node("space", &upright(), None, &[vehicle]);
    let by_segment = |i: usize| motion.segments.iter().map(|poses| poses[i]).collect::<Vec<_>>();
    let of_segments: Vec<Vec<Isometry3<f64>>> = (0..segments.len()).map(by_segment).collect();
    moving.extend(segments.iter().copied().zip(of_segments.iter().map(Vec::as_slice)));
    let animations = [("in the vehicle", moving), ("vehicle in space", vec![(vehicle, motion.vehicle.as_slice())])];
    let times: Vec<[f32; 1]> = motion.times_s.iter().map(|t| [*t]).collect();
    let input = file.floats(&times, "SCALAR", None);
    let animations: Vec<Value> =
        animations.iter().filter_map(|(name, moving)| animation(&mut file, name, input, moving)).collect();
    Ok(file.finish(&program(), root, &animations))
}

fn watched(results: &Results) -> Result<Motion, Failure> {
    let every = results.checkpoints.len().div_ceil(MOST);
    let mut motion = Motion { times_s: Vec::new(), segments: Vec::new(), frames: BTreeMap::new(), vehicle: Vec::new() };
    let first_s = results.model.setup().time.start_s;
    results.watch(|sample| {
        if !sample.index.is_multiple_of(every) {
            return;
        }
        let snapshot = Snapshot::of(sample);
        let vehicle = isometry(&snapshot.vehicle);
        motion.times_s.push((snapshot.time_s - first_s) as f32);
        for (name, of) in frames_of(sample) {
            motion.frames.entry(name).or_default().push(vehicle.inv_mul(&of));
        }
        motion.segments.push(snapshot.poses);
        motion.vehicle.push(vehicle);
    })?;
    Ok(motion)
}

/// Frames besides the vehicle that carry anything, in space.
fn frames_of(sample: &Sample<'_>) -> Vec<(String, Isometry3<f64>)> {
    let setup = sample.model.setup();
    let touched = setup.surfaces.iter().map(|s| s.frame).chain(setup.solids.iter().map(|s| s.frame));
    let used = touched.chain(setup.scenery.iter().map(|own| own.frame));
    let mut all: Vec<(String, Isometry3<f64>)> = Vec::new();
    for frame in used.filter(|frame| *frame != Frame::Vehicle) {
        let name = frame_name(sample.model, frame);
        if all.iter().all(|(known, _)| *known != name) {
            let pose = if frame == Frame::Space { Isometry3::identity() } else { isometry(&sample.frame(frame)) };
            all.push((name, pose));
        }
    }
    all
}

fn isometry(motion: &FrameMotion) -> Isometry3<f64> {
    let turned = Rotation3::from_matrix_unchecked(motion.rotation);
    Isometry3::from_parts(Translation3::from(motion.origin_m), UnitQuaternion::from_rotation_matrix(&turned))
}

/// From space axes (forward, left, up) to glTF axes: Z forward, X left, Y up.
fn upright() -> Isometry3<f64> {
    let [ahead, left, up] = [Vector3::z(), Vector3::x(), Vector3::y()];
    let turned = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[ahead, left, up]));
    Isometry3::from_parts(Translation3::identity(), UnitQuaternion::from_rotation_matrix(&turned))
}

/// A node per segment with its parts.
fn bodies(file: &mut File, model: &Model, motion: &Motion) -> Vec<usize> {
    let body = model.body();
    let parts = parts(body);
    let mut materials: BTreeMap<String, usize> = BTreeMap::new();
    let mut node = |segment| {
        let own = parts.iter().filter(|part| part.segment == segment);
        let shapes: Vec<_> = own
            .map(|part| {
                let name = format!("{:?}", part.tone).to_lowercase();
                let known = materials.get(&name).copied();
                let material = known.unwrap_or_else(|| file.material(&name, part.tone.color().parts()));
                materials.insert(name, material);
                (hull(&part.ends, COARSE), material)
            })
            .collect();
        let name = body.tree[segment].name;
        let mesh = (!shapes.is_empty()).then(|| file.mesh(name, &shapes));
        let pose = motion.segments.first().map_or_else(Isometry3::identity, |poses| poses[segment.index()]);
        file.node(name, &pose, mesh, &[])
    };
    body.tree.segments().map(&mut node).collect()
}

/// Surfaces, solids and scenery by their frame: names and meshes.
fn compartment(file: &mut File, model: &Model) -> BTreeMap<String, Vec<(String, usize)>> {
    let setup = model.setup();
    let surfaces = setup.surfaces.iter().zip(model.faces());
    let surfaces = surfaces.map(|(s, face)| (&s.name, s.frame, s.material, vec![corners_m(face)]));
    let solids = setup.solids.iter().map(|s| (&s.name, s.frame, s.material, s.outline()));
    let materials: Vec<usize> =
        (0..setup.materials.len()).map(|i| file.material(&setup.materials[i].name, color_of(i).parts())).collect();
    let mut frames: BTreeMap<String, Vec<(String, usize)>> = BTreeMap::new();
    let touched =
        surfaces.chain(solids).map(|(name, frame, material, sides)| (name, frame, materials[material], sides));
    let mut drawn = Vec::new();
    for own in setup.scenery.iter().filter(|own| !own.polygons_m.is_empty()) {
        drawn.push((
            &own.name,
            own.frame,
            file.material(&own.name, scenery_color(&own.name).parts()),
            own.polygons_m.clone(),
        ));
    }
    for (name, frame, material, polygons) in touched.chain(drawn) {
        let mesh = file.mesh(name, &[(mesh::polygons(&polygons), material)]);
        let of = if frame == Frame::Vehicle { "compartment".to_owned() } else { frame_name(model, frame) };
        frames.entry(of).or_default().push((name.clone(), mesh));
    }
    frames
}

/// Motion of nodes over time; none if none moves.
fn animation(file: &mut File, name: &str, input: usize, moving: &[(usize, &[Isometry3<f64>])]) -> Option<Value> {
    let (mut samplers, mut channels) = (Vec::new(), Vec::new());
    let moves = |poses: &[Isometry3<f64>]| poses.iter().any(|pose| *pose != poses[0]);
    for (node, poses) in moving.iter().filter(|(_, poses)| moves(poses)) {
        let places: Vec<[f32; 3]> = poses.iter().map(place).collect();
        let outputs = [
            ("translation", file.floats(&places, "VEC3", None)),
            ("rotation", file.floats(&turns(poses), "VEC4", None)),
        ];
        for (path, output) in outputs {
            channels.push(json!({ "sampler": samplers.len(), "target": { "node": node, "path": path } }));
            samplers.push(json!({ "input": input, "output": output, "interpolation": "LINEAR" }));
        }
    }
    (!samplers.is_empty()).then(|| json!({ "name": name, "samplers": samplers, "channels": channels }))
}

/// Quaternions with signs chosen for continuity.
fn turns(poses: &[Isometry3<f64>]) -> Vec<[f32; 4]> {
    let mut before = [0.0; 4];
    let next = |pose| {
        let turned = turn(pose);
        let dot: f32 = turned.iter().zip(&before).map(|(a, b)| a * b).sum();
        before = if dot < 0.0 { turned.map(|x| -x) } else { turned };
        before
    };
    poses.iter().map(next).collect()
}
