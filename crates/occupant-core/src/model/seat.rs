//! Seating: from posture angles and a seat to the state at the start.
//!
//! Report: "Seating the Passenger", Figs 19 and 20. In vehicle axes a segment that leans back by γ has
//! Z = (−sin γ, 0, −cos γ). Our decisions: the pelvis sphere is tangent to the seat back and sinks into the cushion until
//! the loading curve there, resolved along gravity, carries g·(M₁+…+M₈ + ½(M₉+M₁₀)); each leg is a two-link chain from hip
//! to heel with the knee above the line. Where the legs of a smaller person do not reach the heels' place, the thighs lie along
//! the cushion and the feet stand as high as they were to, nearer; where they do not reach down to there either, the legs lie
//! stretched along the cushion.

use nalgebra::{Matrix3, Vector3};

use crate::body::tree::Limb;
use crate::body::{Body, Segment};
use crate::forces::spring::{BilinearSpring, Spring};
use crate::model::seating::Seating;
use crate::motion::layout::Layout;
use crate::motion::report_coordinates::quaternion;
use crate::motion::state::{Shape, State};
use crate::motion::vector::V3;
use crate::vehicle::FrameMotion;
use placed_text::Problems;

/// Heels farther from the hips than this, m, are a mistake: nobody's legs are so long.
const NOBODYS_LEG_M: f64 = 1.1;

/// Figures of a seating, for the user to check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seated {
    /// Depth to which the pelvis sphere sinks into the cushion, m.
    pub sink_m: f64,
    /// Centre of the pelvis sphere, vehicle axes, m.
    pub pelvis_m: Vector3<f64>,
    /// Left knee, vehicle axes, m.
    pub knee_m: Vector3<f64>,
    /// Lean of the thighs and of the lower legs, rad, as γ.
    pub legs_rad: [f64; 2],
}

/// A plane that the pelvis sits on or leans against, vehicle axes.
pub(crate) struct SeatPlane {
    /// N̂, towards the body.
    pub normal: Vector3<f64>,
    /// N̂·x of its points, m.
    pub offset_m: f64,
}

/// What the seat is made of where the pelvis sits.
pub(crate) struct Seat<'a> {
    /// Plane of the cushion.
    pub cushion: SeatPlane,
    /// Plane of the back.
    pub back: SeatPlane,
    /// Loading curve of the cushion.
    pub spring: &'a BilinearSpring,
}

/// Seats `body`; velocities are zero. Problems are reported under `posture` and `seat`.
pub(crate) fn seat(
    body: &Body,
    seating: &Seating,
    seat: &Seat<'_>,
    vehicle: &FrameMotion,
    gravity_m_s2: f64,
    problems: &mut Problems,
) -> Option<(State<f64>, Seated)> {
    let Some(pelvis) = body.sphere("pelvis").map(|i| &body.spheres[i]) else {
        problems.error_with_hint(
            "body.spheres",
            "no sphere named `pelvis`",
            "a pelvis sphere, which sits on the cushion",
            "keep it, or give the initial state in report coordinates",
        );
        return None;
    };
    let marks = body.tree.landmarks();
    if pelvis.segment != marks.pelvis {
        problems.error("body.spheres.pelvis", "not on the lower torso", "the lower torso");
        return None;
    }
    let sink_m = sink(body, seat, vehicle, gravity_m_s2, problems)?;
    let pelvis_m = place_pelvis(seat, pelvis.radius_m, sink_m, seating.lateral_m, problems)?;

    let length = |s: Segment| body.segment(s).length_m;
    let lean = leaned(seating.lean_rad[3]);
    let lower_end = pelvis_m - lean * pelvis.centre_from_lower_end_m.coords;
    let hip = Vector3::new(lower_end.x, 0.0, lower_end.z);
    let [left, right] = legs(body, hip, &seat.cushion.normal, seating, problems)?;

    let t1 = lower_end
        - along(seating.lean_rad[3]) * -length(marks.pelvis)
        - along(seating.lean_rad[0]) * -length(marks.middle);
    let layout = Layout::of(body.tree);
    let mut state = State::zero(Shape::of(&layout));
    state.set_t1(V3::of(&vehicle.point_to_space(t1)));
    let mut lean = |segment: Segment, gamma: f64| {
        if let Some(slot) = layout.free_slot(segment.index()) {
            // Bⁿ (111), which is Tⁿ at the start: X′ = Bⁿ X_n (110)
            state.set_orientation(slot, quaternion(&(vehicle.rotation * leaned(gamma))));
        }
    };
    let trunk = [marks.middle, marks.chest, marks.head, marks.pelvis];
    for (segment, gamma) in trunk.into_iter().zip(seating.lean_rad) {
        lean(segment, gamma);
    }
    let limbs = [
        (&marks.arms.left, seating.upper_arms_rad, seating.elbows_rad),
        (&marks.arms.right, seating.upper_arms_rad, seating.elbows_rad),
        (&marks.legs.left, left.thigh, left.thigh - left.shank),
        (&marks.legs.right, right.thigh, right.thigh - right.shank),
    ];
    for (limb, gamma, _) in limbs {
        lean(limb.upper, gamma);
    }
    for (limb, _, alpha) in limbs {
        if let Some(slot) = layout.hinge_slot(limb.lower.index()) {
            state.hinge_mut()[slot] = alpha;
        }
    }
    let knee_m = lower_end - Vector3::y() * body.hip_half_width_m - along(left.thigh) * length(marks.legs.left.upper);
    let seated = Seated { sink_m, pelvis_m, knee_m, legs_rad: [left.thigh, left.shank] };
    Some((state, seated))
}

/// Z of a segment that leans back by γ, vehicle axes (Eq. 109).
fn along(gamma: f64) -> Vector3<f64> {
    let (s, c) = crash_measures::trig::sin_cos(gamma);
    Vector3::new(-s, 0.0, -c)
}

/// Axes of a segment that leans back by γ, vehicle axes: X ahead, Y to the left.
fn leaned(gamma: f64) -> Matrix3<f64> {
    let z = along(gamma);
    let y = -Vector3::y();
    Matrix3::from_columns(&[y.cross(&z), y, z])
}

/// Depth at which the cushion carries the weight that rests on it.
fn sink(
    body: &Body,
    seat: &Seat<'_>,
    vehicle: &FrameMotion,
    gravity_m_s2: f64,
    problems: &mut Problems,
) -> Option<f64> {
    if gravity_m_s2 == 0.0 {
        return Some(0.0);
    }
    let mass = |s: Segment| body.segment(s).mass_kg;
    let legs = &body.tree.landmarks().legs;
    let in_legs = |s: &Segment| [legs.left, legs.right].iter().any(|leg| *s == leg.upper || *s == leg.lower);
    let carried = body.tree.segments().filter(|s| !in_legs(s)).map(mass).sum::<f64>()
        + 0.5 * (mass(legs.left.upper) + mass(legs.right.upper));
    let up = vehicle.rotation.tr_mul(&Vector3::z());
    let support = seat.cushion.normal.dot(&up);
    if support < 0.1 {
        problems.error_with_hint(
            "seat.cushion",
            format!(
                "a cushion whose normal makes {:.0}° with the vertical",
                crash_measures::trig::acos(support).to_degrees()
            ),
            "a cushion that faces up at the start",
            "check the cushion's `inside` point, or give the initial state in report coordinates",
        );
        return None;
    }
    let load = carried * gravity_m_s2 / support;
    let depth = depth_under(seat.spring, load);
    if depth.is_none() {
        problems.error("materials", "a cushion without stiffness", "a positive k1 and k2");
    }
    depth
}

/// Deformation at which the loading curve reaches `load` (N), m.
fn depth_under(spring: &BilinearSpring, load: f64) -> Option<f64> {
    let first = spring.k1_n_per_m * spring.break_m;
    let depth =
        if load <= first { load / spring.k1_n_per_m } else { spring.break_m + (load - first) / spring.k2_n_per_m };
    let force = Spring::<f64>::new(spring).respond(depth, 0.0).0;
    (depth.is_finite() && (force - load).abs() < 1e-6 * load.max(1.0)).then_some(depth)
}

/// Centre of the pelvis sphere: tangent to the back, sunk into the cushion, at the given lateral place.
fn place_pelvis(
    seat: &Seat<'_>,
    radius_m: f64,
    sink_m: f64,
    lateral_m: f64,
    problems: &mut Problems,
) -> Option<Vector3<f64>> {
    let rows =
        Matrix3::from_rows(&[seat.cushion.normal.transpose(), seat.back.normal.transpose(), Vector3::y().transpose()]);
    let places = Vector3::new(seat.cushion.offset_m + radius_m - sink_m, seat.back.offset_m + radius_m, lateral_m);
    let centre = (rows.determinant().abs() > 1e-3).then(|| rows.lu().solve(&places)).flatten();
    if centre.is_none() {
        problems.error("seat", "a cushion and a back that are parallel", "planes that meet");
    }
    centre
}

/// Lean of thigh and lower leg, rad.
struct Leg {
    thigh: f64,
    shank: f64,
}

/// Both legs.
fn legs(
    body: &Body,
    hip: Vector3<f64>,
    cushion: &Vector3<f64>,
    seating: &Seating,
    problems: &mut Problems,
) -> Option<[Leg; 2]> {
    let limbs = &body.tree.landmarks().legs;
    let [left, right] = [&limbs.left, &limbs.right].map(|limb| leg(body, limb, hip, cushion, seating, problems));
    let (left, right) = (left?, right?);
    let length = |s: Segment| body.segment(s).length_m;
    let heel = hip - along(left.thigh) * length(limbs.left.upper) - along(left.shank) * length(limbs.left.lower);
    warn_short(seating, heel, problems);
    Some([left, right])
}

/// Says where the feet are that do not reach the heels' place.
fn warn_short(seating: &Seating, heel_m: Vector3<f64>, problems: &mut Problems) {
    let [x, z] = seating.heels_m;
    if (heel_m.x - x).hypot(heel_m.z - z) < 1e-6 {
        return;
    }
    let how =
        if (heel_m.z - z).abs() < 1e-6 { "stand nearer" } else { "do not reach down, and the legs lie on the cushion" };
    problems.warning(
        "posture.heels",
        format!(
            "the legs are too short for heels at [{x:.3}, {z:.3}] m: the feet {how}, at [{:.3}, {:.3}] m",
            heel_m.x, heel_m.z
        ),
        "heels that the feet of this body reach",
    );
}

/// Legs too short for the heels' place: along the cushion, and from the knees down to the height of the heels if they reach.
fn short_leg(a: f64, b: f64, hip: Vector3<f64>, cushion: &Vector3<f64>, heel_z: f64) -> Leg {
    let thigh = crash_measures::trig::atan2(-cushion.z, cushion.x);
    let down = (heel_z - (hip - along(thigh) * a).z) / b;
    let shank = if down.abs() < 1.0 { crash_measures::trig::acos(down) } else { thigh };
    Leg { thigh, shank }
}

/// Two links from `hip` to the heel in the X_v–Z_v plane, the knee above the line.
fn leg(
    body: &Body,
    limb: &Limb,
    hip: Vector3<f64>,
    cushion: &Vector3<f64>,
    seating: &Seating,
    problems: &mut Problems,
) -> Option<Leg> {
    let (a, b) = (body.segment(limb.upper).length_m, body.segment(limb.lower).length_m);
    let [x, z] = seating.heels_m;
    let to_heel = Vector3::new(x, 0.0, z) - hip;
    let distance = to_heel.norm();
    let (shortest, longest) = ((a - b).abs(), a + b);
    if distance > longest && distance < NOBODYS_LEG_M {
        return Some(short_leg(a, b, hip, cushion, z));
    }
    if !(distance >= shortest && distance <= longest) {
        let (by, remedy) = if distance > longest {
            (distance - longest, "bring the heels nearer to the seat")
        } else {
            (shortest - distance, "move the heels away from the seat")
        };
        problems.error_with_hint(
            "posture.heels",
            format!(
                "heels {:.4} m from the hips, {:.4} m out of reach of a leg of {:.4} m + {:.4} m",
                distance, by, a, b
            ),
            format!("a distance from {shortest:.4} m to {longest:.4} m"),
            remedy,
        );
        return None;
    }
    // angle at the hip between thigh and the line to the heel
    let cosine = (a * a + distance * distance - b * b) / (2.0 * a * distance);
    let opening = crash_measures::trig::acos(cosine.clamp(-1.0, 1.0));
    // γ of a link that points down along d is atan2(d_x, d_z); raising the knee increases it
    let line = crash_measures::trig::atan2(to_heel.x, to_heel.z);
    let thigh_lean = line + opening;
    let knee = hip - along(thigh_lean) * a;
    let down = Vector3::new(x, 0.0, z) - knee;
    Some(Leg { thigh: thigh_lean, shank: crash_measures::trig::atan2(down.x, down.z) })
}
