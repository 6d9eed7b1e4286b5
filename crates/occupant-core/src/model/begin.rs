//! The start of a model: the body or all bodies are placed, then everything that depends on their positions.

use crate::forces::contact::OPEN;
use crate::forces::contact::flat_face::FlatFace;
use crate::forces::contact::solid::Solids;
use crate::forces::sphere::Site;
use crate::forces::{Data, Forces, History, Instant};
use crate::kernel::System;
use crate::kernel::instruments::Instruments;
use crate::model::behind::restraints;
use crate::model::limp::{Rest, sink};
use crate::model::pose::hang;
use crate::model::seat::{Seat, SeatPlane, Seated, seat};
use crate::model::seating::{InitialPosture, InitialVelocity, Placing, Seating, Settling};
use crate::model::settle::{Settled, carry, kept, lack, settle, stand, standing};
use crate::model::setup::Setup;
use crate::model::validate::check_whole;
use crate::model::{Model, Start, frames, together};
use crate::motion::frame::VEHICLE;
use crate::motion::kinematics::Kinematics;
use crate::motion::skeleton::Skeleton;
use crate::motion::state::{MOST_OWN, State};
use crate::motion::vector::V3;
use crate::vehicle::{FrameMotion, PathCursor};
use nalgebra::Vector3;
use placed_text::Problems;

/// Places the bodies, then sets everything that depends on their position: velocities, constants and history of force
/// elements.
pub(super) fn begin(
    setup: &Setup,
    faces: &[FlatFace],
    problems: &mut Problems,
) -> Option<(System<f64>, Start, Vec<Model>)> {
    let start_s = setup.time.start_s;
    let vehicle = setup.path.motion(start_s, start_s, &mut PathCursor::default());
    let alone = together::alone(setup, problems)?;
    if !alone.is_empty() {
        check_whole(setup, problems);
        if problems.has_errors() {
            return None;
        }
    }
    let skeleton = skeleton(setup, &alone);
    let data = setup.forces(faces);
    let forces = Forces::new(&data, &setup.body);
    let mut system = System::new(skeleton, Site::all(&setup.body), forces);
    let is_rear = !restraints(setup).is_empty();
    Instruments::fit(&mut system, &setup.body, &setup.instrument_sites(), is_rear);
    let Placed { mut state, seated, mut settled, unsettled, rest } = if alone.is_empty() {
        place(setup, faces, &data, &mut system, &vehicle, problems)?
    } else {
        Placed::at(State::together(&alone.iter().map(|model| model.start.state).collect::<Vec<_>>()))
    };
    if !state.is_finite() {
        problems.error("posture", "coordinates that are not finite numbers", "numbers");
        return None;
    }
    if seated.is_some() {
        set_velocity(&mut state, &setup.velocity, &vehicle);
    }
    let k = Kinematics::new(&system.skeleton, &state);
    let carried: Vec<_> = system.carriers.iter().map(|n| k.moving(*n)).collect();
    let mut frames_now = frames(start_s, &vehicle);
    setup.place_frames(&mut frames_now, start_s);
    let at = Instant {
        k: &k,
        state: &state,
        frames: &frames_now,
        carried: &carried,
        spheres: &system.spheres,
        accepted: false,
    };
    let forces = &mut system.forces;
    forces.lay(&data, &setup.body, &at);
    // what there is to say of a body alone has been said
    let mut said = Problems::new();
    forces.begin(&data, &setup.body, &at, if alone.is_empty() { problems } else { &mut said });
    rest.iter().for_each(|rest| rest.keep(forces));
    let own = forces.own();
    if own.len() > MOST_OWN {
        let found =
            format!("plates, bags, columns, hinges, reflexes and own forces with {} numbers of a state", own.len());
        let expected = format!(
            "at most {MOST_OWN}: two for each plate, five for each bag, one more for each inflator, three for each column, each hinge and each muscle with a reflex, one for each own force"
        );
        problems.error("bags", found, expected);
        return None;
    }
    let mut history = forces.start(&at);
    rest.iter().for_each(|rest| rest.hold(&mut history));
    if let InitialPosture::Continued { passed, .. } = &setup.posture {
        history.memory.contacts = forces.contacts.continued(&at, passed);
        warn_apart(setup, forces, &history, passed, problems);
    }
    if let Some(settled) = &mut settled {
        let (still, standing) = (state.still(), standing(setup, &vehicle));
        carry(&mut system, &still, &standing, &history);
        settled.lack = lack(&system, &setup.body, &still, &standing, &history);
    }
    let state = state.with_own(&own);
    Some((system, Start { state, history, seated, settled, unsettled }, alone))
}

/// Constants of the body, or of all bodies.
fn skeleton(setup: &Setup, alone: &[Model]) -> Skeleton<f64> {
    if alone.is_empty() {
        let skeleton = Skeleton::new(&setup.body, setup.gravity_m_s2);
        let joint_m = || setup.body.joint_m(setup.body.tree.segment(0));
        return match setup.mounting() {
            Some(mounting) => skeleton.mounted(mounting.mount(joint_m())),
            None => skeleton,
        };
    }
    let mut all = Skeleton::together(&alone.iter().map(|model| &model.system.skeleton).collect::<Vec<_>>());
    for (root, home) in all.roots.iter_mut().zip(setup.homes()) {
        if let Some(mount) = root.mount.as_mut().filter(|mount| mount.frame == VEHICLE) {
            mount.frame = home.index(&[]);
        }
    }
    all
}

/// Initial position of a body.
struct Placed {
    state: State<f64>,
    seated: Option<Seated>,
    settled: Option<Settled>,
    unsettled: Option<Settled>,
    rest: Option<Rest>,
}

impl Placed {
    fn at(state: State<f64>) -> Self {
        Placed { state, seated: None, settled: None, unsettled: None, rest: None }
    }
}

/// Places the body by the posture of the setup.
fn place(
    setup: &Setup,
    faces: &[FlatFace],
    data: &Data<'_>,
    system: &mut System<f64>,
    vehicle: &FrameMotion,
    problems: &mut Problems,
) -> Option<Placed> {
    let seating = match &setup.posture {
        InitialPosture::Seated(seating) => seating,
        InitialPosture::Coordinates(q) | InitialPosture::Continued { coordinates: q, .. } => {
            return Some(Placed::at(q.to_state()));
        }
        InitialPosture::Mounted(mounting) => {
            let carrier = mounting.carrier(vehicle);
            let mut state = hang(&setup.body, mounting, &carrier);
            set_velocity(&mut state, &InitialVelocity::WithVehicle, &carrier);
            return Some(Placed::at(state));
        }
        InitialPosture::Placed(placing) => {
            let carrier = placing.at.carrier(vehicle);
            let mut state = hang(&setup.body, &placing.at, &carrier);
            if placing.stands {
                state = stand(setup, data, system, vehicle, state, problems);
            }
            set_velocity(&mut state, &InitialVelocity::WithVehicle, &carrier);
            if let InitialVelocity::Given(beside) = setup.velocity {
                state.set_velocity(state.velocity() + V3::of(&carrier.vector_to_space(beside)));
            }
            spin(&mut state, placing, vehicle);
            return Some(Placed::at(state));
        }
        InitialPosture::Together => return None,
    };
    let on = seat_of(setup, faces, &system.forces.contacts.solids, seating, vehicle, problems)?;
    let (state, seated) = seat(&setup.body, seating, &on, vehicle, setup.gravity_m_s2, problems)?;
    let mut placed = Placed { seated: Some(seated), ..Placed::at(state) };
    match seating.settle {
        Settling::Not => placed.unsettled = Some(kept(setup, data, system, vehicle, &state)),
        Settling::Locked => {
            let (state, settled) = settle(setup, data, system, vehicle, state);
            (placed.state, placed.settled) = (state, Some(settled));
        }
        Settling::Limp => {
            let (seated, _) = settle(setup, data, system, vehicle, state);
            let (state, settled, rest) = sink(setup, data, system, vehicle, seated);
            (placed.state, placed.settled, placed.rest) = (state, Some(settled), Some(rest));
        }
    }
    placed.settled.inspect(|settled| settled.warn(problems));
    Some(placed)
}

/// Lists pairs given as passed that do not overlap: they are open, as if they were not listed.
fn warn_apart(
    setup: &Setup,
    forces: &Forces<f64>,
    history: &History<f64>,
    passed: &[(usize, usize)],
    problems: &mut Problems,
) {
    let (contacts, pairs) = (&forces.contacts, &history.memory.contacts);
    let is_apart = |&&(sphere, surface): &&(usize, usize)| {
        let groups = contacts.groups.iter().filter(|group| group.sphere == sphere);
        let open = |i: usize| pairs[i].phase == OPEN && contacts.pairs[i].parts.iter().any(|p| p.surface == surface);
        groups.flat_map(|group| group.pairs.clone()).any(open)
    };
    let names = |&(sphere, surface): &(usize, usize)| {
        Some(format!("{} and {}", setup.body.spheres.get(sphere)?.name, setup.surface_name(surface)?))
    };
    let apart: Vec<String> = passed.iter().filter(is_apart).filter_map(names).collect();
    if !apart.is_empty() {
        let found = format!("pairs that do not overlap at the start, and so have no effect: {}", apart.join(", "));
        problems.warning("initial_state.passed", found, "pairs that overlap where the earlier run ended");
    }
}

/// Planes of a seat: of solids, the face of the cushion that faces most upwards, and that of the back that faces most
/// towards the heels and slightly upwards, since a nearly flat back has another face ahead.
fn seat_of<'a>(
    setup: &'a Setup,
    faces: &[FlatFace],
    solids: &Solids<f64>,
    seating: &Seating,
    vehicle: &FrameMotion,
    problems: &mut Problems,
) -> Option<Seat<'a>> {
    let mut plane = |index: usize, key: &str, looks: &dyn Fn(Vector3<f64>) -> Vector3<f64>| {
        let face = faces.get(index).map(|face| SeatPlane { normal: face.normal, offset_m: face.offset_m });
        let solid = || solids.shapes.get(index.checked_sub(faces.len())?)?.plane_towards(looks);
        let found = face.or_else(|| solid().map(|(normal, offset_m)| SeatPlane { normal, offset_m }));
        if found.is_none() {
            problems.error(format!("seat.{key}"), "no such surface", "a surface, or a solid with flat faces");
        }
        found
    };
    let up = vehicle.rotation.tr_mul(&Vector3::z());
    let cushion = plane(seating.cushion, "cushion", &|_| up);
    let back = plane(seating.back, "back", &|middle| Vector3::new((seating.heels_m[0] - middle.x).signum(), 0.0, -0.5));
    let (cushion, back) = (cushion?, back?);
    let material = setup.materials.get(setup.surface_material(seating.cushion))?;
    Some(Seat { cushion, back, force: &material.force })
}

/// Adds the initial angular velocity of a placed body.
fn spin(state: &mut State<f64>, placing: &Placing, vehicle: &FrameMotion) {
    let carrier = placing.at.carrier(vehicle);
    let omega = carrier.vector_to_space(placing.spin_rad_s);
    let arm = state.t1().to_vector() - carrier.point_to_space(placing.at.place_m);
    state.set_velocity(state.velocity() + V3::of(&omega.cross(&arm)));
    state.turns().for_each(|slot| state.set_omega(slot, state.omega(slot) + V3::of(&omega)));
}

/// Sets the initial velocity of every point of the body.
fn set_velocity(state: &mut State<f64>, velocity: &InitialVelocity, vehicle: &FrameMotion) {
    match velocity {
        InitialVelocity::WithVehicle => {
            state.set_velocity(V3::of(&vehicle.velocity_at(state.t1().to_vector())));
            state.turns().for_each(|slot| state.set_omega(slot, V3::of(&vehicle.angular_velocity_rad_s)));
        }
        InitialVelocity::VehicleOrigin => state.set_velocity(V3::of(&vehicle.velocity_m_s)),
        InitialVelocity::Given(v) => {
            state.set_velocity(V3::of(&vehicle.vector_to_space(*v)));
        }
    }
}
