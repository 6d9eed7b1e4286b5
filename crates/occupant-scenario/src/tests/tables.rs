//! Tables of numbers, inline and in CSV files.

use approx::assert_relative_eq;

use super::super::{Format, Scenario};
use super::{build, complaint, short_with};
use occupant_core::model::setup::Setup;
use occupant_core::vehicle::{Interpolation, PathCursor, VehiclePath};

pub(super) const PULSE: &str = "kind = \"pulse\"
shape = \"half_sine\"
speed = \"30 km/h\"
delta_v = \"30 km/h\"
duration = \"100 ms\"";

const TABLE: &str = "kind = \"table\"\nfile = \"path.csv\"\nafter = \"hold\"";

fn with_csv(path: &str, csv: &str) -> Result<Setup, String> {
    let files = |name: &str| match name {
        "path.csv" => Ok(csv.as_bytes().to_vec()),
        _ => Err("no such file".to_owned()),
    };
    let text = short_with(PULSE, path);
    let loaded = Scenario::from_text(&text, Format::Toml, "s.toml", &files);
    loaded.and_then(|l| l.build()).map(|(setup, _)| setup).map_err(|e| e.to_string())
}

#[test]
fn a_csv_file_gives_the_path_in_its_own_units() {
    let csv = "\u{feff}# a comment\n t[ms], x[ft], yaw[deg]\r\n0,0,0\r\n\r\n100, 10, 90\n200,20,180\n";
    let setup = with_csv(TABLE, csv).unwrap();
    let VehiclePath::Table(table) = &setup.path else { panic!("{:?}", setup.path) };
    assert_eq!(table.interpolation(), Interpolation::Spline);
    let station = table.stations()[1];
    assert_relative_eq!(station.time_s, 0.1);
    assert_relative_eq!(station.pose.position_m.x, 3.048, max_relative = 1e-15);
    assert_relative_eq!(station.pose.attitude.yaw_rad, std::f64::consts::FRAC_PI_2);
    assert_eq!(station.pose.position_m.z, 0.0);
}

const ALONG_THE_SLED: &str = "kind = \"table\"\naxes = \"z_up\"\nafter = \"coast\"\ncolumns = [\"t[ms]\", \"ax[g]\", \"az[g]\", \"pitch[deg]\"]\n\
                              rows = [[0, -4, 1, 0], [20, -6, 2, 1], [50, -9, -1, 7], [60, -3, 0, 9], [100, 2, 3, 12]]";

/// Accelerations along axes that do not turn are the path's, straight lines between the times, whatever the angle; speed and place are
/// their integrals from rest, over triangles and by Simpson's rule, exact for straight lines.
#[test]
fn accelerations_along_the_axes_of_a_sled_give_the_path() {
    let path = with_csv(ALONG_THE_SLED, "").unwrap().path;
    let g = occupant_core::model::setup::STANDARD_GRAVITY_M_S2;
    let (t, x, z) = ([0.0, 0.02, 0.05, 0.06, 0.1], [-4.0, -6.0, -9.0, -3.0, 2.0], [1.0, 2.0, -1.0, 0.0, 3.0]);
    let (mut speed, mut place) = ([0.0; 2], [0.0; 2]);
    for i in 0..4 {
        let h = t[i + 1] - t[i];
        for part in [0.0, 0.25, 0.5, 1.0] {
            let motion = path.motion(t[i] + part * h, t[i] + part * h, &mut PathCursor::default());
            let line = |of: [f64; 5]| g * (of[i] + part * (of[i + 1] - of[i]));
            assert!((motion.acceleration_m_s2.x - line(x)).abs() < 1e-10, "{i} {part}: {motion:?}");
            assert!((motion.acceleration_m_s2.z - line(z)).abs() < 1e-10, "{i} {part}: {motion:?}");
        }
        for (axis, of) in [x, z].into_iter().enumerate() {
            let (a, next) = (g * of[i], g * of[i + 1]);
            let half = speed[axis] + 0.25 * h * (a + 0.5 * (a + next));
            let last = speed[axis] + 0.5 * h * (a + next);
            place[axis] += h / 6.0 * (speed[axis] + 4.0 * half + last);
            speed[axis] = last;
        }
        let motion = path.motion(t[i + 1], t[i + 1], &mut PathCursor::default());
        assert!(
            (motion.velocity_m_s.x - speed[0]).abs() < 1e-12 && (motion.origin_m.x - place[0]).abs() < 1e-13,
            "{i}"
        );
        assert!(
            (motion.velocity_m_s.z - speed[1]).abs() < 1e-12 && (motion.origin_m.z - place[1]).abs() < 1e-13,
            "{i}"
        );
    }
}

/// `strength` and `turn` act on the accelerations at the ends too.
#[test]
fn accelerations_along_the_axes_of_a_sled_are_scaled_and_turned() {
    let text = format!("{ALONG_THE_SLED}\nstrength = 0.5\nturn = 90");
    let path = with_csv(&text, "").unwrap().path;
    let g = occupant_core::model::setup::STANDARD_GRAVITY_M_S2;
    for (time_s, x, z) in [(0.0, -4.0, 1.0), (0.01, -5.0, 1.5), (0.055, -6.0, -0.5), (0.1, 2.0, 3.0)] {
        let found = path.motion(time_s, time_s, &mut PathCursor::default()).acceleration_m_s2;
        // to the right is -Y in axes with Z up
        assert_relative_eq!(found, nalgebra::Vector3::new(0.0, -x, z) * (0.5 * g), epsilon = 1e-10);
    }
}

#[test]
fn a_table_of_accelerations_without_a_row_is_refused() {
    let (text, _) = ALONG_THE_SLED.split_once("[[").unwrap();
    let said = with_csv(&format!("{text}[]"), "").err().unwrap_or_default();
    assert!(said.contains("found 0 stations"), "{said}");
}

/// A filter acts on the accelerations, so the vehicle still starts from rest; what is held after accelerations that end at rest has them.
#[test]
fn accelerations_are_filtered_before_they_are_integrated_and_may_end_at_rest() {
    let at =
        |text: &str, time_s: f64| with_csv(text, "").unwrap().path.motion(time_s, time_s, &mut PathCursor::default());
    let filtered = at(&format!("{ALONG_THE_SLED}\nfilter = \"8 Hz\""), 0.0);
    assert!(filtered.velocity_m_s.norm() < 1e-12, "{filtered:?}");
    let held = "kind = \"table\"\nafter = \"hold\"\ncolumns = [\"t[ms]\", \"ax[m/s^2]\"]\n\
                rows = [[0, 100], [20, 50], [60, -90], [100, 55]]";
    for (time_s, expected) in [(0.0, 100.0), (0.01, 75.0), (0.05, -55.0), (0.08, -17.5)] {
        assert_relative_eq!(at(held, time_s).acceleration_m_s2.x, expected, epsilon = 1e-9);
    }
}

#[test]
fn accelerations_that_do_not_go_with_a_table_are_refused() {
    for (from, to, expected) in [
        ("coast", "hold", "leave the vehicle at 4.09 m/s"),
        ("\"ax[g]\", \"az[g]\"", "\"ax[g]\", \"x[m]\"", "`ax` beside `x`"),
        ("kind", "interpolation = \"linear\"\nkind", "straight lines between positions"),
        ("\"ax[g]\"", "\"ax[m]\"", "ax"),
        ("[50, -9", "[10, -9", "time"),
    ] {
        let said = with_csv(&ALONG_THE_SLED.replacen(from, to, 1), "").err().unwrap_or_default();
        assert!(said.contains(expected), "{from}: {said}");
    }
}

/// A pulse that continues after the vehicle has stopped, and a table with the signs of an accelerometer.
#[test]
fn a_pulse_that_the_speed_does_not_cover_is_warned_of() {
    let warnings = |pulse: &str| {
        let text = short_with(PULSE, &format!("kind = \"pulse\"\n{pulse}"));
        let loaded = Scenario::from_text(&text, Format::Toml, "s.toml", &|_: &str| Err(String::new())).unwrap();
        loaded.build().unwrap().1.to_string()
    };
    let table = |sign: &str| {
        format!("shape = \"tabulated\"\ncolumns = [\"t[ms]\", \"a[g]\"]\nrows = [[0, 0], [50, {sign}20], [100, 0]]\n")
    };
    let square = "shape = \"square\"\nduration = \"0.1 s\"\n";
    for (pulse, wanted) in [
        (format!("{square}speed = \"50 km/h\"\ndelta_v = \"80 km/h\""), "it stops at 62.5 ms"),
        (format!("{square}speed = \"50 km/h\"\ndelta_v = \"80 km/h\"\nrebound = \"30 km/h\""), ""),
        (format!("{square}speed = \"50 km/h\"\ndelta_v = \"50 km/h\""), ""),
        (format!("{}speed = \"30 km/h\"", table("")), "the pulse removes 35.3 km/h, but the vehicle has 30.0 km/h"),
        (format!("{}speed = \"36 km/h\"", table("")), ""),
        (format!("{}speed = \"30 km/h\"", table("-")), "the pulse speeds the vehicle up by 35.3 km/h"),
        // pushed from rest: no speed is lost
        (format!("{square}speed = 0\ndelta_v = \"-50 km/h\""), ""),
    ] {
        let found = warnings(&pulse);
        assert!(if wanted.is_empty() { !found.contains("pulse") } else { found.contains(wanted) }, "{pulse}: {found}");
    }
}

#[test]
fn an_inline_table_gives_the_same_path() {
    let csv = "t[ms],x[ft],yaw[deg]\n0,0,0\n100,10,90\n200,20,180\n";
    let inline = "kind = \"table\"\nafter = \"hold\"\ncolumns = [\"t[ms]\", \"x[ft]\", \"yaw[deg]\"]
rows = [[0, 0, 0], [100, 10, 90], [200, 20, 180.0]]";
    assert_eq!(with_csv(TABLE, csv).unwrap().path, build(&short_with(PULSE, inline)).path);
}

#[test]
fn tables_of_recorders_are_read_as_they_are() {
    const RECORDER: &str = "kind = \"sensors\"\nfile = \"path.csv\"\nspeed = \"30 km/h\"\nafter = \"hold\"";
    let path = |section: &str, csv: &str| with_csv(section, csv).map(|setup| setup.path).unwrap();
    let plain = path(RECORDER, "t[ms],dvx[km/h]\n0,0\n50,-12.5\n100,-25\n");
    for csv in [
        "Time (ms),Delta-V longitudinal (km/h)\n0,0\n50,-12.5\n100,-25\n",
        "\"Time (ms)\",\"Delta-V, longitudinal (km/h)\"\n0,0\n50,-12.5\n100,-25\n",
        "Time [ms];Cumulative Delta V [km/h]\n0;0\n50;-12,5\n100;-25\n",
        "Time\tDelta-V\nms\tkm/h\n0\t0\n50\t-12,5\n100\t-25\n",
        "time (ms)   dvx [km/h]\n0 0\n50   -12.5\n100  -25\n",
    ] {
        assert_eq!(path(RECORDER, csv), plain, "{csv}");
    }
    let named = format!("{RECORDER}\ncolumns = [\"t[ms]\", \"-\", \"dvx[km/h]\"]");
    for csv in ["clock,brake,change\n0,off,0\n50,on,-12.5\n100,on,-25\n", "0,1,0\n50,1,-12.5\n100,1,-25\n"] {
        assert_eq!(path(&named, csv), plain, "{csv}");
    }
    let refused = with_csv(RECORDER, "Time (ms),Engine speed (rpm)\n0,0\n").unwrap_err();
    assert!(refused.contains("unknown column `Engine speed`"), "{refused}");
}

#[test]
fn a_table_says_its_axes_its_point_and_the_order_of_its_angles() {
    let path = |keys: &str, csv: &str| match with_csv(&format!("{TABLE}\n{keys}"), csv).unwrap().path {
        VehiclePath::Table(table) => table.stations().to_vec(),
        other => panic!("{other:?}"),
    };
    let csv = "t[s],x[m],y[m],z[m],roll[deg],pitch[deg],yaw[deg]\n0,0,0,0,0,0,0\n1,5,3,1,10,20,30\n";
    let up = "Time,XPos,YPos,ZPos,Pitch,Roll,Yaw\n0,0,0,0,0,0,0\n1,5,-3,-1,-20,10,-30\n";
    let named = "axes = \"z_up\"\ncolumns = [\"t[s]\", \"x[m]\", \"y[m]\", \"z[m]\", \"pitch[deg]\", \"roll[deg]\", \"yaw[deg]\"]";
    assert_eq!(path(named, up), path("", csv));
    // a point 1 m behind the centre of gravity, the car turned to the right by 90°
    let turned = path("offset = [-1, 0, 0]", "t[s],x[m],y[m],yaw[deg]\n0,-1,0,0\n1,5,-1,90\n");
    assert_relative_eq!(turned[0].pose.position_m.x, 0.0);
    assert_relative_eq!(turned[1].pose.position_m, nalgebra::Vector3::new(5.0, 0.0, 0.0), epsilon = 1e-15);
    // rolled by 90° first, its nose goes up to where its roof is: to the right
    let csv = "t[s],roll[deg],pitch[deg],yaw[deg]\n0,0,0,0\n1,90,30,0\n";
    let rolled = path("angles = \"roll_pitch_yaw\"", csv)[1].pose.attitude;
    assert_relative_eq!(rolled.yaw_rad.to_degrees(), 30.0, epsilon = 1e-12);
    assert_relative_eq!(rolled.roll_rad.to_degrees(), 90.0, epsilon = 1e-12);
    assert_relative_eq!(rolled.pitch_rad, 0.0, epsilon = 1e-12);
}

#[test]
fn every_vehicle_and_frame_may_have_a_file() {
    let text = short_with(PULSE, TABLE)
        + "\n[vehicles.other.path]\nkind = \"table\"\nfile = \"other.csv\"\nafter = \"hold\"\n"
        + "\n[frames.door]\nparent = \"other\"\npath = { kind = \"table\", file = \"path.csv\", after = \"hold\" }\n";
    let files = |name: &str| match name {
        "path.csv" => Ok(b"t[s],x[m]\n0,0\n9,1\n".to_vec()),
        "other.csv" => Ok(b"t[s],x[m]\n0,0\n9,2\n".to_vec()),
        _ => Err("no such file".to_owned()),
    };
    let loaded = Scenario::from_text(&text, Format::Toml, "s.toml", &files).unwrap();
    let setup = loaded.build().unwrap().0;
    let last = |path: &VehiclePath| match path {
        VehiclePath::Table(table) => table.stations()[1].pose.position_m.x,
        other => panic!("{other:?}"),
    };
    let found: Vec<f64> = [&setup.path, &setup.frames[0].path, &setup.frames[2].path].map(last).to_vec();
    assert_eq!(found, [1.0, 2.0, 1.0]);
    let names: Vec<&str> = loaded.tables().iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["path.csv", "other.csv"]);
    let nowhere = Scenario::from_text(&text, Format::Toml, "s.toml", &|_: &str| Err("none".to_owned()));
    let found = nowhere.unwrap_err().to_string();
    assert!(found.contains("in: vehicles.other.path.file") && found.contains("in: path.file"), "{found}");
    let wrong = |name: &str| if name == "other.csv" { Ok(b"t[s],x[m]\n0,?\n".to_vec()) } else { files(name) };
    let wrong = Scenario::from_text(&text, Format::Toml, "s.toml", &wrong).unwrap().build().unwrap_err();
    assert!(wrong.to_string().starts_with("error: `?`\n --> other.csv:2:3"), "{wrong}");
    let mut draft = super::super::Draft::read(&text, Format::Toml, "s.toml").unwrap();
    let files = draft.files().into_iter().map(|(path, name)| format!("{path}={name}"));
    let expected = ["path.file=path.csv", "vehicles.other.path.file=other.csv", "frames.door.path.file=path.csv"];
    assert_eq!(files.collect::<Vec<_>>(), expected);
    assert!(super::super::names_file("vehicles.other.path.file") && !super::super::names_file("path.kind"));
}

#[test]
fn a_tabulated_pulse_is_in_g() {
    let pulse = "kind = \"pulse\"\nshape = \"tabulated\"\nspeed = 10\ncolumns = [\"t[ms]\", \"a[g]\"]
rows = [[0, 0], [40, 20], [80, 0]]";
    let VehiclePath::Pulse(path) = build(&short_with(PULSE, pulse)).path else { panic!("no pulse") };
    assert_relative_eq!(path.peak_deceleration_m_s2(), 20.0 * 9.80665, max_relative = 1e-15);
}

#[test]
fn mistakes_name_the_file_line_and_column() {
    for (csv, expected) in [
        (
            "t[s],x[m],q[m]\n0,0,0\n",
            "error: unknown column `q`
 --> path.csv:1:11
  = expected: `t`, `x`, `y`, `z`, `roll`, `pitch`, `yaw`, `ax`, `ay` or `az`",
        ),
        (
            "t[s],x\n0,0\n",
            "error: column `x` without a unit
 --> path.csv:1:6
  = expected: the unit of a length in brackets, such as `x[m]`",
        ),
        (
            "t[m],x[m]\n0,0\n",
            "error: `m` is not the unit of a time
 --> path.csv:1:1
  = expected: the unit of a time in brackets, such as `t[s]`",
        ),
        (
            "user:secret,q\nroot:hidden,0\n",
            "error: a first line without any known column
 --> path.csv:1:1
  = expected: `t`, `x`, `y`, `z`, `roll`, `pitch`, `yaw`, `ax`, `ay` or `az`",
        ),
        (
            "x[m]\n0\n",
            "error: no column `t`
 --> path.csv:1:1
  = expected: a column `t[s]`",
        ),
        (
            "t[s],x[m]\n0,0\n\n0.1,abc\n0.2,,1\n",
            "error: `abc`
 --> path.csv:4:5
  = expected: a number

error: an empty cell
 --> path.csv:5:5
  = expected: a number

error: 3 numbers
 --> path.csv:5:1
  = expected: 2, one for each column",
        ),
        (
            "t[s],x[m]\n0,0\n0,1\n",
            "error: station 2: found t = 0 s
 --> path.csv:3:1
  = in: path
  = expected: a time after that of the station before (0 s)",
        ),
        (
            "",
            "error: an empty table
 --> path.csv:1:1
  = expected: a line that names the columns",
        ),
    ] {
        assert_eq!(with_csv(TABLE, csv).unwrap_err(), expected);
    }
}

#[test]
fn a_file_that_cannot_be_read_is_named() {
    assert_eq!(
        complaint(&short_with(PULSE, TABLE)),
        "error: `path.csv` cannot be read: there is no file path.csv
 --> s.toml:7:8
  |
7 | file = \"path.csv\"
  |        ^^^^^^^^^^
  = in: path.file
  = expected: a CSV file, its name relative to the scenario"
    );
}
