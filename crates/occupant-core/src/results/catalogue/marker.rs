//! Motion of markers: points of segments that a scenario names.
//!
//! With the vehicle's origin O, velocity V, acceleration A and angular velocity Ω, a point at r from O has there
//! v′ = v − V − Ω × r and a′ = a − A − Ω̇ × r − Ω × (Ω × r) − 2Ω × v′.

use crash_measures::unit::Unit::{Metre, MetrePerSecond, MetrePerSecondSquared};
use nalgebra::Vector3;

use crate::forces::sphere::Site;
use crate::model::setup::MarkerFrame;
use crate::quantity::{Axes, Owner, Quantity, to_j211};
use crate::results::sample::Sample;

/// A marker at one output, in its frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfMarker;

/// Place, velocity and acceleration.
type Motion = [Vector3<f64>; 3];

impl Owner for OfMarker {
    type At<'a> = Motion;
}

type Of = Quantity<OfMarker>;

/// Message `MarkerMotion`.
pub(super) fn quantities(frame: MarkerFrame) -> [Of; 3] {
    let (place, others, words) = match frame {
        MarkerFrame::Vehicle => (Axes::Vehicle, Axes::Vehicle, VEHICLE),
        MarkerFrame::Space => (Axes::Space, Axes::Space, SPACE),
        MarkerFrame::Segment => (Axes::Vehicle, Axes::J211, SEGMENT),
    };
    [
        Of::vector(Metre, place, |m| m[0]).channel("position", "place of the {}").field(2, "position", "place"),
        Of::vector(MetrePerSecond, others, |m| m[1]).channel("velocity", words[0]).field(3, "velocity", words[1]),
        Of::vector(MetrePerSecondSquared, others, |m| m[2]).channel("acceleration", words[2]).field(
            4,
            "acceleration",
            words[3],
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
    "what an accelerometer there reads: acceleration less gravity",
];

/// The motion of a point as a frame has it.
pub(super) fn motion(s: &Sample<'_>, site: &Site<f64>, frame: MarkerFrame) -> Motion {
    let (k, by, n) = (&s.evaluation.kinematics, &s.evaluation.accelerations, site.segment);
    let (arm, place, velocity) = site.place(k);
    let acceleration = by.joint[n] + by.alpha[n].cross(arm) + k.omega[n].cross(k.omega[n].cross(arm));
    let [place, velocity, acceleration] = [place, velocity, acceleration].map(|v| v.to_vector());
    let in_vehicle = s.vehicle.point_to_frame(place);
    match frame {
        MarkerFrame::Space => [place, velocity, acceleration],
        MarkerFrame::Segment => {
            let along = |v: Vector3<f64>| to_j211(k.axes[n].to_matrix().tr_mul(&v));
            let gravity = Vector3::z() * s.model.setup().gravity_m_s2;
            [in_vehicle, along(velocity), along(acceleration + gravity)]
        }
        MarkerFrame::Vehicle => {
            let (vehicle, r) = (s.vehicle, place - s.vehicle.origin_m);
            let omega = vehicle.angular_velocity_rad_s;
            let seen = velocity - vehicle.velocity_at(place);
            let carried = vehicle.acceleration_m_s2
                + vehicle.angular_acceleration_rad_s2.cross(&r)
                + omega.cross(&(omega.cross(&r) + 2.0 * seen));
            [in_vehicle, vehicle.vector_to_frame(seen), vehicle.vector_to_frame(acceleration - carried)]
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnosis::tests::model_of;
    use crate::results::channel::{Series, matching};
    use crate::run::simulate::simulate;

    /// Outputs of all markers of a body afloat whose head has a rate of its own.
    fn outputs(rate: (usize, f64), path: &str, markers: &str) -> Series {
        let (q, mut rates) = (["0.0"; 31].join(", "), vec!["0.0".to_owned(); 31]);
        rates[rate.0] = format!("{:?}", rate.1);
        let rates = rates.join(", ");
        let model = model_of(&format!(
            "title = \"markers\"\ngravity = 0\ntime = {{ end = 0.1 }}\noutput = {{ interval = 0.0005 }}\n\
             path = {path}\nbody = {{ preset = \"male50\" }}\njoints = {{ all = {{ damping = 0 }} }}\n\
             initial_state = {{ q = [{q}], rates = [{rates}] }}\n{markers}"
        ));
        let mut series = Series::new(matching(&model, "marker.*"));
        simulate(&model, &mut series).unwrap();
        series
    }

    /// A head that spins about its long axis goes on so: a point beside the axis goes round in a circle.
    #[test]
    fn a_marker_on_a_spinning_segment_goes_round() {
        let markers = "markers.ear = { segment = \"head\", place = [0, 0.1, 0.2], frame = \"segment\" }\n\
                       markers.seen = { segment = \"head\", place = [0, 0.1, 0.2], frame = \"space\" }\n";
        let series = outputs((9, 12.0), "{ kind = \"fixed\" }", markers);
        let of = |name: &str| series.of(name).unwrap();
        for (i, t_s) in series.time_s.iter().enumerate() {
            let (sine, cosine) = (12.0 * t_s).sin_cos();
            for (name, expected) in [
                // J211: Y to the right, X ahead; the ear is on the left
                ("marker.ear.acceleration.x", 0.0),
                ("marker.ear.acceleration.y", 14.4),
                ("marker.ear.velocity.x", -1.2),
                ("marker.seen.position.x", -0.1 * sine),
                ("marker.seen.position.y", 0.1 * cosine),
                ("marker.seen.velocity.y", -1.2 * sine),
                ("marker.seen.acceleration.x", 14.4 * sine),
                ("marker.seen.acceleration.y", -14.4 * cosine),
            ] {
                let found = of(name)[i];
                assert!((found - expected).abs() < 1e-5, "{name} at {t_s}: {found} for {expected}");
            }
        }
    }

    /// From a vehicle that turns and slows down, each is the rate of the one before.
    #[test]
    fn what_a_vehicle_sees_is_the_rate_of_the_place() {
        let path = "{ kind = \"table\", columns = [\"t[s]\", \"x[m]\", \"y[m]\", \"yaw[deg]\"], \
                    rows = [[0, 0, 0, 0], [0.05, 0.6, 0, 8], [0.1, 0.9, 0.1, 30], [0.15, 1, 0.2, 50]] }";
        let markers = "markers.t1 = { segment = \"upper_torso\", place = [-0.05, 0.02, 0.3] }\n";
        let series = outputs((10, 15.0), path, markers);
        for [one, rate] in [["position", "velocity"], ["velocity", "acceleration"]] {
            for axis in ["x", "y", "z"] {
                let [one, rate] = [one, rate].map(|name| series.of(&format!("marker.t1.{name}.{axis}")).unwrap());
                // at 50 ms, a time of the table, the rate of the acceleration jumps
                for i in (1..series.time_s.len() - 1).filter(|i| *i != 100) {
                    let found = (one[i + 1] - one[i - 1]) / (series.time_s[i + 1] - series.time_s[i - 1]);
                    assert!((found - rate[i]).abs() < 1e-3 * (1.0 + rate[i].abs()), "{axis} {i}: {found} {}", rate[i]);
                }
            }
        }
    }
}
