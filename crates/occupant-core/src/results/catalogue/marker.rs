//! Motion of markers: points of segments that a scenario names.
//!
//! With the vehicle's origin O, velocity V, acceleration A and angular velocity Ω, a point at r from O has v′ = v − V −
//! Ω × r and a′ = a − A − Ω̇ × r − Ω × (Ω × r) − 2Ω × v′.

use nalgebra::Vector3;
use occupant_units::unit::Unit::{Metre, MetrePerSecond, MetrePerSecondSquared};

use crate::forces::sphere::{Site, Use};
use crate::model::Model;
use crate::model::setup::MarkerFrame;
use crate::motion::kinematics::Kinematics;
use crate::quantity::{Axes, Owner, Quantity, to_j211};
use crate::results::sample::Sample;
use crate::vehicle::PathCursor;

/// A marker at one output, in its frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfMarker;

/// Position, velocity, acceleration, and displacement since the start of the run.
type Motion = [Vector3<f64>; 4];

impl Owner for OfMarker {
    type At<'a> = Motion;
}

type Of = Quantity<OfMarker>;

/// Message `MarkerMotion`.
pub(super) fn quantities(frame: MarkerFrame) -> [Of; 4] {
    let (place, others, words) = match frame {
        MarkerFrame::Vehicle => (Axes::Vehicle, Axes::Vehicle, VEHICLE),
        MarkerFrame::Space => (Axes::Space, Axes::Space, SPACE),
        MarkerFrame::Segment => (Axes::Vehicle, Axes::J211, SEGMENT),
    };
    [
        Of::vector(Metre, place, |m| m[0]).channel("position", "position of the {}").field(2, "position", "place"),
        Of::vector(MetrePerSecond, others, |m| m[1]).channel("velocity", words[0]).field(3, "velocity", words[1]),
        Of::vector(MetrePerSecondSquared, others, |m| m[2]).channel("acceleration", words[2]).field(
            4,
            "acceleration",
            words[3],
        ),
        Of::vector(Metre, place, |m| m[3]).channel("displacement", "displacement of the {} since the start").field(
            5,
            "displacement",
            "displacement since the start",
        ),
    ]
}

const VEHICLE: [&str; 4] = [
    "velocity of the {} as the vehicle sees it",
    "velocity as the vehicle sees it",
    "acceleration of the {} as the vehicle sees it",
    "acceleration as the vehicle sees it",
];
const SPACE: [&str; 4] =
    ["velocity of the {}", "velocity", "kinematic acceleration of the {}", "kinematic acceleration"];
const SEGMENT: [&str; 4] = [
    "absolute velocity of the {} along its segment",
    "absolute velocity along the segment",
    "accelerometer reading (acceleration minus gravity) of the {}",
    "accelerometer reading: acceleration minus gravity",
];

/// Position of a point at the start of the run, relative to a frame.
pub(super) fn start_m(model: &Model, site: &Site<f64>, frame: MarkerFrame) -> Vector3<f64> {
    let place =
        site.place(&Kinematics::new(&model.system().skeleton, &model.start().state), Use::Contact).1.to_vector();
    if frame == MarkerFrame::Space {
        return place;
    }
    let (t_s, cursor) = (model.setup().time.start_s, &mut PathCursor::default());
    let homes = model.homes(&model.frames(t_s, t_s, cursor), &model.vehicle(t_s, t_s, cursor));
    let tree = model.body().tree;
    homes[tree.body_of(tree.segment(site.segment))].point_to_frame(place)
}

/// Motion of a point that was at `start_m`, relative to a frame.
pub(super) fn motion(s: &Sample<'_>, site: &Site<f64>, frame: MarkerFrame, start_m: &Vector3<f64>) -> Motion {
    let (k, by, n) = (&s.evaluation.kinematics, &s.evaluation.accelerations, site.segment);
    let (arm, place, velocity) = site.place(k, Use::Contact);
    let acceleration = by.joint[n] + by.alpha[n].cross(arm) + k.omega[n].cross(k.omega[n].cross(arm));
    let [place, velocity, acceleration] = [place, velocity, acceleration].map(|v| v.to_vector());
    let home = s.seen_from(n);
    let in_vehicle = home.point_to_frame(place);
    match frame {
        MarkerFrame::Space => [place, velocity, acceleration, place - start_m],
        MarkerFrame::Segment => {
            let along = |v: Vector3<f64>| to_j211(k.axes[n].to_matrix().tr_mul(&v));
            let gravity = Vector3::z() * s.model.setup().gravity_m_s2;
            [in_vehicle, along(velocity), along(acceleration + gravity), in_vehicle - start_m]
        }
        MarkerFrame::Vehicle => {
            let (vehicle, r) = (home, place - home.origin_m);
            let omega = vehicle.angular_velocity_rad_s;
            let seen = velocity - vehicle.velocity_at(place);
            let carried = vehicle.acceleration_m_s2
                + vehicle.angular_acceleration_rad_s2.cross(&r)
                + omega.cross(&(omega.cross(&r) + 2.0 * seen));
            let [seen, acceleration] = [seen, acceleration - carried].map(|v| vehicle.vector_to_frame(v));
            [in_vehicle, seen, acceleration, in_vehicle - start_m]
        }
    }
}
