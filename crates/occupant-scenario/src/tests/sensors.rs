//! Paths of kind "sensors".

use approx::assert_relative_eq;

use super::super::{Format, Scenario};
use super::{complaint, short_with};
use crash_measures::signal::ChannelClass;
use occupant_core::model::setup::STANDARD_GRAVITY_M_S2 as G;
use occupant_core::vehicle::{PathCursor, SensorGravity, SensorPath, SensorRecord, VehiclePath};

const PULSE: &str = "kind = \"pulse\"
shape = \"half_sine\"
speed = \"30 km/h\"
delta_v = \"30 km/h\"
duration = \"100 ms\"";

const SENSORS: &str = "kind = \"sensors\"\nfile = \"record.csv\"\nspeed = 10\nafter = \"coast\"";

fn with_csv(path: &str, csv: &str) -> Result<SensorPath, String> {
    let files = |name: &str| match name {
        "record.csv" => Ok(csv.as_bytes().to_vec()),
        _ => Err("no such file".to_owned()),
    };
    let loaded = Scenario::from_text(&short_with(PULSE, path), Format::Toml, "s.toml", &files);
    let (setup, _) = loaded.and_then(|l| l.build()).map_err(|e| e.to_string())?;
    match setup.path {
        VehiclePath::Sensors(path) => Ok(*path),
        other => panic!("{other:?}"),
    }
}

fn accelerations(path: &SensorPath) -> &occupant_core::vehicle::AccelerationRecord {
    match &path.definition().record {
        SensorRecord::Accelerations(record) => record,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_record_in_its_own_units_gives_the_path() {
    let csv = "# from a test\nt[ms],az[g],ax[g],yaw_rate[deg/s]\n0,-1,-2,90\n100,-1,-4,90\n400,-1,0,0\n";
    let keys = "\ngravity = \"included\"\noffset = [\"-20 cm\", 0, 0.1]\nstart = \"50 ms\"\nyaw = 30";
    let path = with_csv(&format!("{SENSORS}{keys}"), csv).unwrap();
    let record = accelerations(&path);
    assert_eq!(record.time_s, [0.0, 0.1, 0.4]);
    let along_x = record.acceleration_m_s2[0].as_ref().unwrap();
    assert_relative_eq!(along_x[1], -4.0 * G, max_relative = 1e-15);
    assert_eq!(record.acceleration_m_s2[1], None);
    assert_eq!(record.rate_rad_s[0], None);
    let yaw_rate = record.rate_rad_s[2].as_ref().unwrap();
    assert_relative_eq!(yaw_rate[0], std::f64::consts::FRAC_PI_2, max_relative = 1e-15);
    let definition = path.definition();
    assert_eq!(definition.gravity, SensorGravity::Included);
    assert_eq!(definition.offset_m.as_slice(), [-0.2, 0.0, 0.1]);
    assert_relative_eq!(definition.initial.attitude.yaw_rad.to_degrees(), 30.0, max_relative = 1e-15);
    assert_eq!(path.span_s(), (0.05, 0.4));
}

#[test]
fn axes_that_point_up_are_turned() {
    let csv = "t[s],ax[m/s^2],ay[m/s^2],az[m/s^2],wx[rad/s],wy[rad/s],wz[rad/s]\n0,1,2,3,4,5,6\n0.1,1,2,3,4,5,6\n";
    let keys = format!("{SENSORS}\ngravity = \"removed\"\naxes = \"z_up\"");
    let path = with_csv(&keys, csv).unwrap();
    let record = accelerations(&path);
    let first = |channels: &[Option<Vec<f64>>; 3]| [0, 1, 2].map(|i| channels[i].as_ref().unwrap()[0]);
    assert_eq!(first(&record.acceleration_m_s2), [1.0, -2.0, -3.0]);
    assert_eq!(first(&record.rate_rad_s), [4.0, -5.0, -6.0]);
}

#[test]
fn a_filter_and_a_baseline_are_passed_on() {
    let lines: String = (0..100).map(|i| format!("{i},0\n")).collect();
    let keys = format!("{SENSORS}\ngravity = \"zeroed\"\nfilter = \"cfc180\"\nbaseline = \"20 ms\"");
    let path = with_csv(&keys, &format!("t[ms],ax[g]\n{lines}")).unwrap();
    assert_eq!(path.definition().filter, Some(ChannelClass::Cfc180));
    assert_eq!(path.definition().baseline_s, Some(0.02));
}

#[test]
fn velocity_changes_need_no_word_of_gravity() {
    let path = with_csv(SENSORS, "t[ms],dvx[km/h]\n0,0\n10,-3.6\n20,-7.2\n").unwrap();
    let SensorRecord::DeltaV(record) = &path.definition().record else { panic!("{path:?}") };
    assert_relative_eq!(record.longitudinal_m_s.as_ref().unwrap()[2], -2.0);
    assert_eq!(record.lateral_m_s, None);
}

#[test]
fn rows_in_the_scenario_give_the_same_path() {
    let csv = "t[ms],dvx[km/h]\n0,0\n10,-3.6\n";
    let inline = "kind = \"sensors\"\nspeed = 10\nafter = \"coast\"
columns = [\"t[ms]\", \"dvx[km/h]\"]\nrows = [[0, 0], [10, -3.6]]";
    assert_eq!(with_csv(SENSORS, csv).unwrap(), with_csv(inline, "").unwrap());
}

#[test]
fn a_record_of_a_scenario_without_gravity_still_has_that_of_the_earth() {
    let csv = "t[s],az[g]\n0,-1\n1,-1\n";
    let path = with_csv(&format!("{SENSORS}\ngravity = \"included\""), csv).unwrap();
    assert_eq!(path.definition().gravity_m_s2, G);
    let end = VehiclePath::Sensors(Box::new(path)).attitude(1.0, &mut PathCursor::default());
    assert!(end.position_m.z.abs() < 1e-14, "{end:?}");
}

#[test]
fn mistakes_name_the_place_and_the_remedy() {
    for (path, csv, expected) in [
        (
            SENSORS.to_owned(),
            "t[s],ax[g]\n0,0\n1,0\n",
            "error: `path` has no key `gravity`, and the record has accelerations
 --> s.toml:5:1
  |
5 | [path]
  | ^^^^^^
  = in: path
  = expected: gravity = \"included\", \"zeroed\" or \"removed\"",
        ),
        (
            format!("{SENSORS}\ngravity = \"removed\""),
            "t[s],dvx[m/s],ax[g]\n0,0,0\n1,0,0\n",
            "error: `ax` beside velocity changes
 --> record.csv:1:1
  = in: path
  = expected: either `t`, `dvx`, `dvy` and `wz`, or accelerations and rates

error: `gravity` with a record of velocity changes
  --> s.toml:10:11
   |
10 | gravity = \"removed\"
   |           ^^^^^^^^^
   = in: path.gravity
   = expected: accelerations, or leave the key out",
        ),
        (
            format!("{SENSORS}\ngravity = \"removed\""),
            "t[s],q[g]\n0,x\n",
            "error: unknown column `q`
 --> record.csv:1:6
  = expected: `t`, `ax`, `ay`, `az`, `wx`, `wy`, `wz`, `dvx` or `dvy`

error: `x`
 --> record.csv:2:3
  = expected: a number",
        ),
        (
            format!("{SENSORS}\ngravity = \"removed\""),
            "t[s]\n0\n1\n",
            "error: found no channel that moves the vehicle
 --> s.toml:5:1
  |
5 | [path]
  | ^^^^^^
  = in: path
  = expected: accelerations, rates or velocity changes",
        ),
        (
            format!("{SENSORS}\ngravity = \"removed\"\nfilter = \"cfc60\""),
            "t[ms],ax[g]\n0,0\n1,0\n2,0\n5,0\n",
            "error: station 2: found t = 0.001 s
 --> record.csv:3:1
  = in: path
  = expected: 0.0016666666666666668 s, for a filter needs samples evenly spaced in time; resample the record, or leave `filter` out",
        ),
    ] {
        assert_eq!(with_csv(&path, csv).unwrap_err(), expected);
    }
}

#[test]
fn a_record_that_cannot_be_read_is_named() {
    let found = complaint(&short_with(PULSE, SENSORS));
    assert!(found.starts_with("error: `record.csv` cannot be read: there is no file record.csv"), "{found}");
}

#[test]
fn a_scenario_with_sensors_survives_its_own_text() {
    let keys = "\ngravity = \"zeroed\"\naxes = \"z_up\"\nfilter = \"cfc60\"\nstart = 0.1\nroll = 5";
    let text = short_with(PULSE, &format!("{SENSORS}{keys}"));
    let files = |_: &str| Ok(b"t[s],wz[deg/s]\n0,0\n0.1,1\n".to_vec());
    let loaded = Scenario::from_text(&text, Format::Toml, "s.toml", &files).unwrap();
    let again = loaded.scenario.to_toml().unwrap();
    let reread = Scenario::from_text(&again, Format::Toml, "s.toml", &files).unwrap();
    assert_eq!(loaded.scenario, reread.scenario);
    assert_eq!(loaded.tables()[0].0, "record.csv");
}
