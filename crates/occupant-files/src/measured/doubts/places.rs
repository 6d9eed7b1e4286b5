//! Doubts about positions and angles: rounding, times out of step, axes.

use crash_measures::signal::{STANDARD_GRAVITY_MPS2 as G, resolution, rounding_noise, smooth, usual_interval};
use occupant_core::vehicle::{Interpolation, Station, VehiclePath};
use occupant_units::trig;
use placed_text::number;

use super::super::motion::{Column, Motion, MotionKind};
use super::Known;

/// Least rounding noise that is reported, m/s².
const NOISE_M_S2: f64 = 0.1 * G;
/// Speed, m/s, and angle to the heading, deg, above which a vehicle is reported as moving sideways.
const ACROSS: (f64, f64) = (3.0, 30.0);
/// Frequencies that are suggested, Hz.
const CUTOFFS_HZ: [f64; 12] = [100.0, 60.0, 50.0, 40.0, 30.0, 25.0, 20.0, 15.0, 12.0, 10.0, 8.0, 5.0];

/// Reports a single irregular time among regular ones.
pub(super) fn late(motion: &Motion) -> Option<String> {
    let usual_s = usual_interval(&motion.time_s);
    let odd = |pair: &[f64]| (pair[1] - pair[0] - usual_s).abs() > 0.02 * usual_s;
    let all: Vec<usize> = motion.time_s.windows(2).enumerate().filter(|(_, pair)| odd(pair)).map(|(i, _)| i).collect();
    let [before, after] = all[..] else { return None };
    (after == before + 1 && motion.time_s.len() > 10).then(|| {
        format!("the time {} s does not fit the others: correct it, or remove its row", number(motion.time_s[after]))
    })
}

/// Reports positions and angles rounded so coarsely that their second derivatives are mostly rounding noise.
pub(super) fn rounded(motion: &Motion, known: Known) -> Option<String> {
    let dt_s = usual_interval(&motion.time_s);
    let steps: Vec<Option<f64>> = motion.columns.iter().map(|c| Some(resolution(&c.values)? * c.factor)).collect();
    let worst = |filter_hz: Option<f64>| {
        // half a metre from the centre of gravity an angle moves so far
        let arm = |i: usize| if ["x", "y", "z"].contains(&motion.columns[i].name) { 1.0 } else { 0.5 };
        let noise = (0..steps.len()).filter_map(|i| Some((arm(i) * rounding_noise(steps[i]?, dt_s, filter_hz), i)));
        noise.max_by(|a, b| a.0.total_cmp(&b.0))
    };
    let (noise, i) = worst(known.smoothed_hz).filter(|(noise, _)| *noise > NOISE_M_S2)?;
    let column = &motion.columns[i];
    let fits = |hz: &&f64| **hz * dt_s < 0.25 && worst(Some(**hz)).is_some_and(|(noise, _)| noise < 0.6 * NOISE_M_S2);
    let cutoff = CUTOFFS_HZ.iter().find(fits).copied().unwrap_or(CUTOFFS_HZ[CUTOFFS_HZ.len() - 1]);
    let left = worst(Some(cutoff)).map_or(0.0, |(noise, _)| noise / G);
    Some(format!(
        "{} is rounded to {} {} every {} ms, which alone makes {:.2} g of noise in accelerations; --filter '{cutoff} Hz' reduces it to {left:.2} g",
        column.name,
        number(steps[i]? / column.factor),
        column.unit,
        number((dt_s * 1e6).round() / 1e3),
        noise / G
    ))
}

/// Effect of the cutoff frequency on accelerations: smoothing lowers peaks, rounding adds noise.
pub(super) fn smoothed(motion: &Motion, known: Known) -> Option<String> {
    let hertz = known.smoothed_hz?;
    let accelerations = |column: &Column, hertz: f64| -> Option<Vec<f64>> {
        let z = smooth(&motion.time_s, &column.values, hertz).ok()?;
        let second = |(t, z): (&[f64], &[f64])| {
            let (h, g) = (t[1] - t[0], t[2] - t[1]);
            2.0 * ((z[2] - z[1]) / g - (z[1] - z[0]) / h) / (h + g)
        };
        Some(motion.time_s.windows(3).zip(z.windows(3)).map(second).collect())
    };
    let apart = |column: &Column| -> Option<f64> {
        let (own, other) = (accelerations(column, hertz)?, accelerations(column, 1.5 * hertz)?);
        Some(own.iter().zip(&other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) * column.factor)
    };
    let places = motion.columns.iter().filter(|column| ["x", "y", "z"].contains(&column.name));
    let all = places.filter_map(|column| Some((apart(column)?, column.name)));
    let (most, name) = all.max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(format!(
        "positions are smoothed above {} Hz; with {} Hz, accelerations along {name} would differ by up to {:.2} g",
        number(hertz),
        number(1.5 * hertz),
        most / G
    ))
}

/// Reports coarse rounding of the positions of a scenario's table, in the first unit in which they are round.
pub fn rounded_table(path: &VehiclePath) -> Option<String> {
    let VehiclePath::Table(table) = path else { return None };
    let stations = table.stations();
    if table.interpolation() != Interpolation::Spline || stations.len() < 3 {
        return None;
    }
    let column = |axis: usize, (name, unit, factor): (&'static str, &str, f64)| {
        let value = |station: &Station| {
            let attitude = station.pose.attitude;
            [attitude.roll_rad, attitude.pitch_rad, attitude.yaw_rad]
                .get(axis.wrapping_sub(3))
                .copied()
                .unwrap_or_else(|| station.pose.position_m[axis])
                / factor
        };
        Column { name, unit: unit.to_owned(), factor, values: stations.iter().map(value).collect() }
    };
    let motion = |unit: &str, metres: f64| {
        let deg = std::f64::consts::PI / 180.0;
        let lengths = ["x", "y", "z"].map(|name| (name, unit, metres));
        let angles = ["roll", "pitch", "yaw"].map(|name| (name, "deg", deg));
        let columns = [lengths, angles].concat().into_iter().enumerate().map(|(axis, of)| column(axis, of)).collect();
        let time_s = stations.iter().map(|station| station.time_s).collect();
        Motion { kind: MotionKind::Places, words: String::new(), time_s, columns, signals: Vec::new() }
    };
    let units = [("m", 1.0), ("ft", 0.3048), ("in", 0.0254)];
    let found = units.iter().find_map(|(unit, metres)| rounded(&motion(unit, *metres), Known::default()));
    found.map(|words| words.replace("--filter '", "--set path.filter='"))
}

/// Reports a yaw angle that turns against the course.
pub(super) fn turned(motion: &Motion) -> Option<String> {
    let [x, y, yaw] = ["x", "y", "yaw"].map(|name| motion.si(name));
    let (x, y, yaw) = (x?, y?, yaw?);
    let last = x.len() - 1;
    let course = |i: usize, j: usize| trig::atan2(y[j] - y[i], x[j] - x[i]);
    let part = (last / 10).max(1);
    let (began, ended) = (course(0, part), course(last - part, last));
    let moved = |i: usize, j: usize| trig::hypot(x[j] - x[i], y[j] - y[i]) / (motion.time_s[j] - motion.time_s[i]);
    let (turn, own) = (ended - began, yaw[last] - yaw[0]);
    let least = 3_f64.to_radians();
    let clear = turn.abs() > least
        && own.abs() > least
        && turn.abs() < 2.5
        && moved(0, part).min(moved(last - part, last)) > 3.0;
    (clear && turn * own < 0.0 && (turn + own).abs() < 0.5 * turn.abs()).then(|| {
        "yaw turns opposite to the course of the positions: check the axes; reverse a sign with --columns, such as '-yaw[deg]'".to_owned()
    })
}

/// Reports a vehicle that moves across its heading, or backward.
pub(super) fn across(motion: &Motion) -> Option<String> {
    let (x, y) = (motion.si("x")?, motion.si("y")?);
    let yaw = motion.si("yaw");
    let part = (x.len() / 10).max(1);
    let moved_m = trig::hypot(x[part] - x[0], y[part] - y[0]);
    let speed_m_s = moved_m / (motion.time_s[part] - motion.time_s[0]);
    let heading = yaw.as_ref().map_or(0.0, |yaw| 0.5 * (yaw[0] + yaw[part]));
    let turn = trig::atan2(y[part] - y[0], x[part] - x[0]) - heading;
    let beside = trig::atan2(trig::sin(turn), trig::cos(turn)).to_degrees();
    (speed_m_s > ACROSS.0 && beside.abs() > ACROSS.1).then(|| {
        let goes = format!(
            "at the start the vehicle moves at {} km/h, {} deg off its heading",
            number((3.6 * speed_m_s).round()),
            number(beside.abs().round())
        );
        let mend = match yaw {
            None => "there is no yaw column; name it with --columns, such as '…,yaw[deg]'",
            Some(_) => "if it does not slide, yaw counts from another axis: with --columns exchange x and y, or reverse a sign, such as '-yaw[deg]'",
        };
        format!("{goes}; {mend}")
    })
}
