//! Seating: from posture angles and a seat to the state at the start.
//!
//! Report: "Seating the Passenger", Figs 19 and 20. In vehicle axes a segment that leans back by γ has Z = (−sin γ, 0,
//! −cos γ). Our decisions: the pelvis sphere is tangent to the seat back and sinks into the cushion until the loading
//! curve there, resolved along gravity, carries g·(M₁+…+M₈ + ½(M₉+M₁₀)); each leg is a two-link chain from hip to heel
//! with the knee above the line. If the legs of a smaller person do not reach the heels' position, the thighs lie along
//! the cushion and the feet are at the given height, but nearer. If they do not reach down to that height either, the
//! legs lie stretched along the cushion.

use nalgebra::{Matrix3, Vector3};
use occupant_units::trig;

use crate::body::tree::Limb;
use crate::body::{Body, Segment};
use crate::forces::contact::material::Force;
use crate::forces::function::DeflectionLaw;
use crate::forces::spring::Spring;
use crate::model::pose::{Pose, along, leaned};
use crate::model::seating::{Seating, angle_of};
use crate::motion::state::State;
use crate::vehicle::FrameMotion;
use placed_text::Problems;

/// Largest distance between hips and heels, m; more is a mistake.
const NOBODYS_LEG_M: f64 = 1.1;

/// Results of seating, for the user to check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seated {
    /// Penetration of the pelvis sphere into the cushion, m.
    pub sink_m: f64,
    /// Centre of the pelvis sphere, vehicle axes, m.
    pub pelvis_m: Vector3<f64>,
    /// Left knee, vehicle axes, m.
    pub knee_m: Vector3<f64>,
    /// Angles γ of thighs and lower legs, rad.
    pub legs_rad: [f64; 2],
}

/// Plane of the cushion or the back, vehicle axes.
pub(crate) struct SeatPlane {
    /// N̂, towards the body.
    pub normal: Vector3<f64>,
    /// N̂·x of its points, m.
    pub offset_m: f64,
}

/// The seat where the pelvis is.
pub(crate) struct Seat<'a> {
    /// Plane of the cushion.
    pub cushion: SeatPlane,
    /// Plane of the back.
    pub back: SeatPlane,
    /// Loading curve of the cushion.
    pub force: &'a Force,
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
    if Some(pelvis.segment) != marks.pelvis {
        problems.error("body.spheres.pelvis", "not on the lower torso", "the lower torso");
        return None;
    }
    if marks.legs().next().is_none() {
        let expected = "segments `left_thigh` and `left_lower_leg` or the right ones, whose heels stand on the floor";
        let hint = "a part of a body is held by `[mount]` instead of sitting";
        problems.error_with_hint("posture.seat", "a body without legs", expected, hint);
        return None;
    }
    let sink_m = sink(body, seat, vehicle, gravity_m_s2, problems)?;
    let pelvis_m = place_pelvis(seat, pelvis.radius_m, sink_m, seating.lateral_m, problems)?;

    let lean = leaned(angle_of(&seating.angles_rad, body.tree[pelvis.segment].name).unwrap_or_default());
    let lower_end = pelvis_m - lean * pelvis.centre_from_lower_end_m.coords;
    let hip = |limb: &Limb| lower_end + lean * body.socket_m(limb.upper);
    let legs: Vec<_> = marks
        .legs()
        .map(|limb| (limb, leg(body, &limb, hip(&limb), &seat.cushion.normal, seating, problems)))
        .collect();
    let legs: Vec<(Limb, Leg)> = legs.into_iter().map(|(limb, leg)| Some((limb, leg?))).collect::<Option<_>>()?;
    let pose = {
        let of_leg = |segment| legs.iter().find_map(|(limb, leg)| leg.angle_rad(limb, segment));
        let posed = |angles: &[(String, f64)]| Pose::new(body, angles, of_leg, None, leaned(0.0));
        let pose = posed(&seating.angles_rad);
        match seating.hands_m {
            Some(hands) => {
                let t1_m = pose.t1_m(body, pelvis.segment, lower_end);
                posed(&reach(body, &seating.angles_rad, &posed, t1_m, hands, problems))
            }
            None => pose,
        }
    };
    let (first, Leg { thigh, shank }) = &legs[0];
    let knee_m = hip(first) + pose.axes[first.upper.index()] * link_m(body, first.upper, first.lower);
    let heel_m = knee_m + pose.axes[first.lower.index()] * to_heel_m(body, first);
    warn_short(seating, heel_m, problems);
    let state = pose.state(body, pose.t1_m(body, pelvis.segment, lower_end), vehicle);
    Some((state, Seated { sink_m, pelvis_m, knee_m, legs_rad: [*thigh, *shank] }))
}

/// Vector from the joint that carries a segment to the joint by which it carries `next`, m.
fn link_m(body: &Body, segment: Segment, next: Segment) -> Vector3<f64> {
    body.socket_m(next) - body.joint_m(segment)
}

/// Penetration at which the cushion carries the weight on it.
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
    let marks = body.tree.landmarks();
    let in_legs = |s: &Segment| marks.legs().any(|leg| body.tree.is_of(*s, &leg));
    let carried = body.tree.segments().filter(|s| !in_legs(s)).map(mass).sum::<f64>()
        + 0.5 * marks.legs().map(|leg| mass(leg.upper)).sum::<f64>();
    let up = vehicle.rotation.tr_mul(&Vector3::z());
    let support = seat.cushion.normal.dot(&up);
    if support < 0.1 {
        problems.error_with_hint(
            "seat.cushion",
            format!("a cushion whose normal makes {:.0}° with the vertical", trig::acos(support).to_degrees()),
            "a cushion that faces up at the start",
            "check the cushion's `inside` point, or give the initial state in report coordinates",
        );
        return None;
    }
    let load = carried * gravity_m_s2 / support;
    let depth = depth_under(seat.force, load);
    if depth.is_none() {
        problems.error("materials", "a cushion without stiffness", "a positive k1 and k2");
    }
    depth
}

/// Deformation at which the loading curve reaches `load` (N), m.
fn depth_under(force: &Force, load: f64) -> Option<f64> {
    let spring = match force {
        Force::Bilinear(spring) => spring,
        Force::Deflection(law) => return DeflectionLaw::new(law, 1.0).depth_under(load),
    };
    let first = spring.k1_n_per_m * spring.break_m;
    let depth = if load <= first && first > 0.0 {
        load / spring.k1_n_per_m
    } else {
        spring.break_m + (load - first) / spring.k2_n_per_m
    };
    let force = Spring::<f64>::new(spring).respond(depth, 0.0).0;
    (depth.is_finite() && (force - load).abs() < 1e-6 * load.max(1.0)).then_some(depth)
}

/// Centre of the pelvis sphere: tangent to the back, penetrating the cushion, at the given lateral position.
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

/// Angle γ of thigh and lower leg, rad.
struct Leg {
    thigh: f64,
    shank: f64,
}

impl Leg {
    /// Angle γ of the thigh, angle of the knee.
    fn angle_rad(&self, limb: &Limb, segment: Segment) -> Option<f64> {
        let knee = (segment == limb.lower).then_some(self.thigh - self.shank);
        if segment == limb.upper { Some(self.thigh) } else { knee }
    }
}

/// Length of a link in the X–Z plane of its segment, m, and its angle ahead of the segment's Z axis, rad.
fn planar(link_m: &Vector3<f64>) -> (f64, f64) {
    let ahead = trig::atan2(link_m.x, -link_m.z);
    ((link_m.x * link_m.x + link_m.z * link_m.z).sqrt(), ahead)
}

/// Vector from the knee to the heel, the distal end of the leg, lower-leg axes, m.
fn to_heel_m(body: &Body, limb: &Limb) -> Vector3<f64> {
    match limb.end {
        Some(foot) => link_m(body, limb.lower, foot) - body.joint_m(foot),
        None => -body.joint_m(limb.lower),
    }
}

/// Largest bend between the links of a reaching arm, and steps of the search.
const BENT_MOST_RAD: f64 = 2.6;
const HALVINGS: usize = 40;

/// Angles of a seated body with those of its arms that put its hands at `hands_m`, [x, z], elbows below the line from
/// the shoulders. Arms that are too short point there; forearms without an own pin keep their given angles.
fn reach(
    body: &Body,
    angles_rad: &[(String, f64)],
    posed: &impl Fn(&[(String, f64)]) -> Pose,
    t1_m: Vector3<f64>,
    hands_m: [f64; 2],
    problems: &mut Problems,
) -> Vec<(String, f64)> {
    let (mut angles, mut short_m) = (angles_rad.to_vec(), 0.0_f64);
    for arm in body.tree.landmarks().arms() {
        let Some(elbow) = body.tree.bearer(arm.lower).filter(|joint| body.tree[*joint].is_hinge()) else { continue };
        let (upper, elbow) = (body.tree[arm.upper].name, body.tree[elbow].name);
        let with = |lean: f64, bend: f64| {
            let own = [(upper.to_owned(), lean), (elbow.to_owned(), bend)];
            own.into_iter().chain(angles_rad.iter().cloned()).collect::<Vec<_>>()
        };
        // seen from the side: the hand from the shoulder
        let from_shoulder = |lean: f64, bend: f64| {
            let pose = posed(&with(lean, bend));
            let shoulder = end_m(body, &pose, t1_m, arm.upper, body.joint_m(arm.upper));
            let (segment, point) = palm(body, &arm);
            let hand = end_m(body, &pose, t1_m, segment, point) - shoulder;
            let target = Vector3::new(hands_m[0], 0.0, hands_m[1]) - shoulder;
            (hand, target)
        };
        let (mut most, mut least) = (-BENT_MOST_RAD, 0.0);
        for _ in 0..HALVINGS {
            let middle = (most + least) / 2.0;
            let (hand, target) = from_shoulder(0.0, middle);
            let is_short = hand.xz().norm() < target.xz().norm();
            (most, least) = if is_short { (middle, least) } else { (most, middle) };
        }
        let (hand, target) = from_shoulder(0.0, least);
        // a segment that leans back by γ has its lower end ahead by as much
        let angle = |v: Vector3<f64>| trig::atan2(v.x, v.z);
        let lean = angle(target) - angle(hand);
        short_m = short_m.max(target.xz().norm() - hand.xz().norm());
        angles = with(lean, least).into_iter().take(2).chain(angles).collect();
    }
    if short_m > 1e-3 {
        let [x, z] = hands_m;
        let found =
            format!("the arms are too short by {short_m:.3} m for hands at [{x:.3}, {z:.3}] m: they point there");
        problems.warning("posture.hands", found, "hands that the arms of this body reach");
    }
    angles
}

/// A point of a segment given from its lower end, vehicle axes, m.
fn end_m(body: &Body, pose: &Pose, t1_m: Vector3<f64>, segment: Segment, point: Vector3<f64>) -> Vector3<f64> {
    t1_m - pose.t1_m(body, segment, Vector3::zeros()) + pose.axes[segment.index()] * point
}

/// Centre of a hand: of its sphere, or the distal end of the arm.
fn palm(body: &Body, arm: &Limb) -> (Segment, Vector3<f64>) {
    let last = arm.end.unwrap_or(arm.lower);
    let is_hand = |sphere: &&crate::body::ContactSphere| sphere.segment == last && sphere.name.ends_with("_hand");
    let sphere = body.spheres.iter().find(is_hand);
    (last, sphere.map_or_else(Vector3::zeros, |sphere| sphere.centre_from_lower_end_m.coords))
}

/// Warns where the feet are if they do not reach the heel point.
fn warn_short(seating: &Seating, heel_m: Vector3<f64>, problems: &mut Problems) {
    let [x, z] = seating.heels_m;
    if trig::hypot(heel_m.x - x, heel_m.z - z) < 1e-6 {
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

/// Leg that is too short for the heel point: along the cushion, and from the knees down to the height of the heels if
/// possible.
fn short_leg(a: f64, b: f64, hip: Vector3<f64>, cushion: &Vector3<f64>, heel_z: f64) -> [f64; 2] {
    let thigh = trig::atan2(-cushion.z, cushion.x);
    let down = (heel_z - (hip - along(thigh) * a).z) / b;
    let shank = if down.abs() < 1.0 { trig::acos(down) } else { thigh };
    [thigh, shank]
}

/// Two links from `hip` to the heel in the X_v–Z_v plane, the knee above their line.
fn leg(
    body: &Body,
    limb: &Limb,
    hip: Vector3<f64>,
    cushion: &Vector3<f64>,
    seating: &Seating,
    problems: &mut Problems,
) -> Option<Leg> {
    let (a, thigh_ahead) = planar(&link_m(body, limb.upper, limb.lower));
    let (b, shank_ahead) = planar(&to_heel_m(body, limb));
    let of = |thigh: f64, shank: f64| Some(Leg { thigh: thigh - thigh_ahead, shank: shank - shank_ahead });
    let [x, z] = seating.heels_m;
    let hip = Vector3::new(hip.x, 0.0, hip.z);
    let to_heel = Vector3::new(x, 0.0, z) - hip;
    let distance = to_heel.norm();
    let (shortest, longest) = ((a - b).abs(), a + b);
    if distance > longest && distance < NOBODYS_LEG_M {
        let [thigh, shank] = short_leg(a, b, hip, cushion, z);
        return of(thigh, shank);
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
    let opening = trig::acos(cosine.clamp(-1.0, 1.0));
    // γ of a link that points down along d is atan2(d_x, d_z); raising the knee increases it
    let line = trig::atan2(to_heel.x, to_heel.z);
    let thigh_lean = line + opening;
    let knee = hip - along(thigh_lean) * a;
    let down = Vector3::new(x, 0.0, z) - knee;
    let shank_lean = trig::atan2(down.x, down.z);
    of(thigh_lean, shank_lean)
}
