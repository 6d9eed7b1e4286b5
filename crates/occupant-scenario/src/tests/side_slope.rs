//! The side slope as sensors in the car would have recorded it: scenarios/side-slope-sensors.toml and its record.
//!
//! The record is made from the path of scenarios/side-slope.toml, here, so that it can be made again.

use nalgebra::{Point3, Vector3};

use super::super::{Draft, Loaded};
use occupant_core::model::setup::STANDARD_GRAVITY_M_S2 as G;
use occupant_core::vehicle::{PathCursor, VehiclePath};

/// Position of the sensors: behind, to the right of and below the c.g., m.
const OFFSET_M: Vector3<f64> = Vector3::new(-0.35, 0.10, 0.05);
/// Samples a second.
const RATE: f64 = 200.0;

fn folder() -> String {
    format!("{}/scenarios", env!("CARGO_MANIFEST_DIR"))
}

fn scenario(name: &str) -> Loaded {
    let read = |file: &str| std::fs::read(format!("{}/{file}", folder())).map_err(|error| error.to_string());
    let draft = Draft::read_bytes(&read(name).unwrap(), None, name);
    draft.unwrap().load(&read).unwrap_or_else(|e| panic!("{e}"))
}

fn path(name: &str) -> (VehiclePath, f64) {
    let (setup, _) = scenario(name).build().unwrap_or_else(|e| panic!("{e}"));
    (setup.path, setup.gravity_m_s2)
}

/// Readings of sensors in the vehicle: specific force in g and rates in deg/s, along the vehicle's axes.
fn recorded(path: &VehiclePath, gravity_m_s2: f64, end_s: f64) -> String {
    let mut cursor = PathCursor::default();
    let mut csv = String::from(
        "# scenarios/side-slope.toml as sensors 0.35 m behind, 0.10 m right of and 0.05 m below the c.g. would record it,\n\
         # gravity included; x forward, y right, z down\n\
         t[s],ax[g],ay[g],az[g],wx[deg/s],wy[deg/s],wz[deg/s]\n",
    );
    for i in 0..=(end_s * RATE).round() as usize {
        let t_s = i as f64 / RATE;
        let motion = path.motion(t_s, t_s, &mut cursor);
        let sensors = motion.point_to_space(OFFSET_M);
        let up = Vector3::new(0.0, 0.0, gravity_m_s2);
        // a + α × r + ω × (ω × r)
        let (r, omega) = (sensors - motion.origin_m, motion.angular_velocity_rad_s);
        let turning = motion.angular_acceleration_rad_s2.cross(&r) + omega.cross(&omega.cross(&r));
        let felt = motion.vector_to_frame(motion.acceleration_m_s2 + turning + up) / G;
        let rate = motion.vector_to_frame(motion.angular_velocity_rad_s);
        let rate = rate.map(f64::to_degrees);
        let digits = |x: f64, decimals: usize| {
            let text = format!("{x:.decimals$}");
            // minus zero is zero
            match text.trim_start_matches(['-', '0', '.']) {
                "" => text.trim_start_matches('-').to_owned(),
                _ => text,
            }
        };
        csv.push_str(&format!("{t_s:.3}"));
        felt.iter().for_each(|a| csv.push_str(&format!(",{}", digits(*a, 6))));
        rate.iter().for_each(|w| csv.push_str(&format!(",{}", digits(*w, 5))));
        csv.push('\n');
    }
    csv
}

#[test]
fn the_record_is_that_of_the_path() {
    let (original, gravity_m_s2) = path("side-slope.toml");
    let expected = recorded(&original, gravity_m_s2, 2.4);
    let found = std::fs::read_to_string(format!("{}/side-slope-sensors.csv", folder())).unwrap();
    let numbers = |text: &str| -> Vec<f64> {
        let lines = text.lines().skip(3).flat_map(|line| line.split(','));
        lines.map(|cell| cell.parse().unwrap()).collect()
    };
    assert_eq!(found.lines().count(), expected.lines().count());
    for (found, expected) in numbers(&found).into_iter().zip(numbers(&expected)) {
        // the last digit
        assert!((found - expected).abs() < 1.5e-5, "{found} {expected}");
    }
}

#[test]
fn the_sensors_give_the_path_back() {
    let (original, _) = path("side-slope.toml");
    let (again, _) = path("side-slope-sensors.toml");
    let (mut place_m, mut turn_rad, mut speed_m_s) = (0.0f64, 0.0f64, 0.0f64);
    let mut cursors = [PathCursor::default(), PathCursor::default()];
    for i in 0..=2400 {
        let t_s = f64::from(i) * 1e-3;
        let [first, second] = &mut cursors;
        let (wanted, found) = (original.motion(t_s, t_s, first), again.motion(t_s, t_s, second));
        place_m = place_m.max((wanted.origin_m - found.origin_m).norm());
        turn_rad = turn_rad.max((wanted.rotation - found.rotation).norm());
        speed_m_s = speed_m_s.max((wanted.velocity_m_s - found.velocity_m_s).norm());
    }
    // measured 8.3e-5 m, 2.5e-5, 7.8e-5 m/s: straight lines between 200 samples a second, six digits
    assert!(place_m < 2e-4 && turn_rad < 1e-4 && speed_m_s < 2e-4, "{place_m:e} {turn_rad:e} {speed_m_s:e}");
    let (model, warnings) = scenario("side-slope-sensors.toml").model().unwrap();
    assert!(warnings.is_empty(), "{warnings}");
    let seat = model.setup().path.motion(1.0, 1.0, &mut PathCursor::default());
    assert!(seat.point_to_space(Point3::origin().coords).x > 25.0);
}
