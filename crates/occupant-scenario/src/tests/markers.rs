//! Motion of markers.

use super::model_of;
use occupant_core::results::channel::{Series, matching};
use occupant_core::run::simulate::simulate;

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

/// A head that spins about its long axis keeps spinning: a point off the axis moves on a circle.
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
