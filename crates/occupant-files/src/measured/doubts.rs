//! What speaks against a record: sensors at the end of their range, units and signs that cannot be, zero errors, drift, rounding. Each is said
//! with the option that mends it; nothing is mended unasked.

use crash_measures::signal::{STANDARD_GRAVITY_MPS2 as G, plateau, resolution, rounding_noise, usual_interval};
use occupant_core::vehicle::{Interpolation, Station, VehiclePath};
use placed_text::number;

use super::motion::{Column, Motion, MotionKind};

/// What else is known of the vehicle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Known {
    /// Time of first contact, s, if it was told.
    pub contact_s: Option<f64>,
    /// Speed at first contact, m/s, if it was told.
    pub speed_m_s: Option<f64>,
    /// Whether zero errors are taken away: at the beginning, at the end.
    pub baseline: [bool; 2],
    /// Frequency from which on places are smoothed, Hz.
    pub smoothed_hz: Option<f64>,
}

/// No crash of a road vehicle changes its velocity by more, m/s.
const MOST_CHANGE_M_S: f64 = 45.0;
/// More turns than a rolling car makes.
const MOST_TURNS: f64 = 6.0;
/// No vehicle turns faster, as the mean of 10 ms, rad/s.
const FASTEST_RAD_S: f64 = 20.0;
/// What tyres alone give, and what a crash goes beyond, m/s²: between them accelerations are doubted that are not in g.
const WEAK_M_S2: [f64; 2] = [G, 2.5 * G];
/// Turns slower than these, rad/s, are doubted beside a velocity change to the side of this, m/s.
const SLOW: (f64, f64) = (0.1, 3.0);
/// Rounding of accelerations that is said, m/s².
const ROUGH_M_S2: f64 = 0.5 * G;
/// A slip that is said, m/s² and, of places, 1/s² of their unit.
const SLIP_M_S2: f64 = 5.0 * G;
/// A gain of speed that is said, m/s.
const GAIN_M_S: f64 = 3.0;
/// Shortest rest whose mean says something, and the longest that is looked at, s.
const REST_S: [f64; 2] = [0.01, 0.1];
/// Zero errors that are said: accelerations, m/s²; rates, rad/s.
const ZERO: [f64; 2] = [0.05 * G, 0.5 * std::f64::consts::PI / 180.0];
/// Noise of rounding that is said, m/s².
const NOISE_M_S2: f64 = 0.1 * G;
/// Frequencies that are proposed, Hz.
const CUTOFFS_HZ: [f64; 12] = [100.0, 60.0, 50.0, 40.0, 30.0, 25.0, 20.0, 15.0, 12.0, 10.0, 8.0, 5.0];

/// All that speaks against a record.
pub fn doubts(motion: &Motion, known: Known) -> Vec<String> {
    let mut said: Vec<String> = motion.columns.iter().filter_map(|column| slip(motion, column)).collect();
    match motion.kind {
        MotionKind::Accelerations => {
            said.extend(motion.columns.iter().filter_map(|column| clipped(column, &motion.time_s)));
            said.extend(motion.columns.iter().filter_map(|column| wrong_unit(column, &motion.time_s)));
            said.extend(weak(motion));
            said.extend(slow(motion));
            said.extend(rough(motion));
            zero_errors(motion, known, &mut said);
            said.extend(motion.si("ax").and_then(|ax| struck_from_behind(&ax, &motion.time_s)));
            said.extend(motion.si("ax").and_then(|ax| backwards(integral(&ax, &motion.time_s), known)));
        }
        MotionKind::Changes => {
            let changes = motion.si("dvx").unwrap_or_default();
            said.extend(gains_speed(&changes));
            said.extend(changes.last().and_then(|change| backwards(*change, known)));
        }
        MotionKind::Places => {
            if !["x", "y"].into_iter().any(|name| motion.has(name)) {
                said.push(format!(
                    "no column is x or y, the vehicle is taken to turn on the spot: --columns names them, such as 't[s],x[m],y[m]'; read were {}",
                    motion.signals.join(", ")
                ));
            }
            said.extend(rounded(motion, known));
            said.extend(turned(motion));
        }
    }
    said
}

fn is_rate(column: &Column) -> bool {
    column.name.starts_with('w')
}

fn clipped(column: &Column, time_s: &[f64]) -> Option<String> {
    let found = plateau(&column.values)?;
    Some(format!(
        "{} stands on its extreme, {} {}, in {} samples, from {} s on {} in a row: a sensor at the end of its range? What is measured may be too low, \
         and only another sensor mends that (--at, --columns)",
        column.name,
        number(found.value),
        column.unit,
        found.samples,
        number(time_s[found.first]),
        found.longest
    ))
}

/// ∫ v dt.
fn integral(values: &[f64], time_s: &[f64]) -> f64 {
    time_s.windows(2).zip(values.windows(2)).map(|(t, v)| 0.5 * (t[1] - t[0]) * (v[0] + v[1])).sum()
}

fn wrong_unit(column: &Column, time_s: &[f64]) -> Option<String> {
    let whole = integral(&column.values, time_s) * column.factor;
    let (name, unit) = (column.name, &column.unit);
    if is_rate(column) {
        let turns = whole / std::f64::consts::TAU;
        let other = if unit.to_lowercase().contains("rad") { "deg/s" } else { "another unit" };
        let fastest = column.factor * strongest(column, time_s);
        let why = match () {
            () if turns.abs() > MOST_TURNS => format!("turns the vehicle {} times", number(turns.round())),
            () if fastest > FASTEST_RAD_S => {
                format!("turns the vehicle {} times a second", number((fastest / std::f64::consts::TAU).round()))
            }
            () => return None,
        };
        return Some(format!("{name} in {unit} {why}: is it in {other}? --columns says so, such as '{name}[deg/s]'"));
    }
    let start = rest(time_s, None).map(|[from, to]| mean(&column.values[from..to]))?;
    let stands_at = |value: f64| (start.abs() / value - 1.0).abs() < 0.03;
    let other = if (column.factor - G).abs() < 1e-9 { "m/s^2" } else { "g" };
    let gravity = name == "az" && column.factor * start.abs() > 0.5 && stands_at(if other == "g" { 1.0 } else { G });
    let too_much = whole.abs() > MOST_CHANGE_M_S;
    (gravity || too_much).then(|| {
        let why = match gravity {
            true => format!("begins at {} {unit}", number((start * 1e3).round() / 1e3)),
            false => format!("changes the velocity by {} km/h", number((whole * 3.6).round())),
        };
        format!("{name} in {unit} {why}: is it in {other}? --columns says so, such as '{name}[{other}]'")
    })
}

/// The greatest magnitude of a mean over 10 ms, in the column's unit.
fn strongest(column: &Column, time_s: &[f64]) -> f64 {
    let whole: Vec<f64> = std::iter::once(0.0)
        .chain(time_s.windows(2).zip(column.values.windows(2)).scan(0.0, |sum, (t, v)| {
            *sum += 0.5 * (t[1] - t[0]) * (v[0] + v[1]);
            Some(*sum)
        }))
        .collect();
    let mean = |i: usize| {
        let j = time_s.partition_point(|t| *t < time_s[i] + REST_S[0] - 1e-9);
        (j < time_s.len()).then(|| ((whole[j] - whole[i]) / (time_s[j] - time_s[i])).abs())
    };
    (0..time_s.len()).filter_map(mean).fold(0.0, f64::max)
}

/// A single value far from both of its neighbours, where no other is: a digit, a bit or a contact that slipped.
fn slip(motion: &Motion, column: &Column) -> Option<String> {
    let is_place = motion.kind == MotionKind::Places;
    let apart = |v: &[f64]| match is_place {
        true => (v[1] - 0.5 * (v[0] + v[2])).abs(),
        // a step is no slip: it leaves one neighbour near
        false if (v[1] - v[0]) * (v[1] - v[2]) > 0.0 => (v[1] - v[0]).abs().min((v[1] - v[2]).abs()),
        false => 0.0,
    };
    let all: Vec<f64> = column.values.windows(3).map(apart).collect();
    let at = (0..all.len()).max_by(|&a, &b| all[a].total_cmp(&all[b]))?;
    let mut sorted = all.clone();
    sorted.sort_unstable_by(|a, b| b.total_cmp(a));
    // of places both neighbours bend the other way by half of it
    let usual = sorted.get(if is_place { 3 } else { 1 })?;
    let least = match motion.kind {
        MotionKind::Places => SLIP_M_S2 * usual_interval(&motion.time_s).powi(2),
        MotionKind::Changes => 1.0,
        MotionKind::Accelerations if is_rate(column) => 1.0,
        MotionKind::Accelerations => SLIP_M_S2,
    };
    (all[at] > 10.0 * usual && all[at] * column.factor > least).then(|| {
        format!(
            "{} jumps in one row, at {} s to {} {}: a slip? If so, take that value out, and --bridge bridges it",
            column.name,
            number(motion.time_s[at + 1]),
            number(column.values[at + 1]),
            column.unit
        )
    })
}

/// Accelerations in m/s² that are those of tyres and hardly more: they may be in g.
fn weak(motion: &Motion) -> Option<String> {
    let all: Vec<&Column> = motion.columns.iter().filter(|c| !is_rate(c) && (c.factor - 1.0).abs() < 1e-9).collect();
    let most = all.iter().map(|column| strongest(column, &motion.time_s)).fold(0.0, f64::max);
    (WEAK_M_S2[0]..WEAK_M_S2[1]).contains(&most).then(|| {
        format!(
            "no acceleration goes beyond {:.1} g (mean of 10 ms): are they in g? --columns says so, such as '{}[g]'",
            most / G,
            all[0].name
        )
    })
}

/// Rates in deg/s that hardly turn a vehicle that is thrown aside: they may be in rad/s.
fn slow(motion: &Motion) -> Option<String> {
    let all: Vec<&Column> = motion.columns.iter().filter(|c| is_rate(c) && (c.factor - 1.0).abs() > 1e-9).collect();
    let most = all.iter().map(|column| column.factor * strongest(column, &motion.time_s)).fold(0.0, f64::max);
    let aside = integral(&motion.si("ay")?, &motion.time_s).abs();
    (0.05 * SLOW.0 < most && most < SLOW.0 && aside > SLOW.1).then(|| {
        format!(
            "the velocity changes by {} km/h to the side, and no rate goes beyond {:.1} deg/s (mean of 10 ms): are they in rad/s? --columns says so, such as '{}[rad/s]'",
            number((aside * 3.6).round()),
            most.to_degrees(),
            all[0].name
        )
    })
}

/// Accelerations that are rounded to whole g or so.
fn rough(motion: &Motion) -> Option<String> {
    let step = |c: &Column| {
        let is_round = |step: &f64| c.values.iter().all(|v| (v / step - (v / step).round()).abs() < 1e-6);
        let steps = [10.0, 5.0, 2.0, 1.0, 0.5].into_iter().filter(|step| step * c.factor >= ROUGH_M_S2);
        let (least, most) =
            c.values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(*v), b.max(*v)));
        // a few levels say nothing
        steps.filter(|step| !is_rate(c) && most - least > 3.0 * step).find(is_round)
    };
    let all: Vec<(&Column, f64)> = motion.columns.iter().filter_map(|c| Some((c, step(c)?))).collect();
    let (column, step) = all.first()?;
    let names: Vec<&str> = all.iter().map(|(column, _)| column.name).collect();
    let half = number(0.5 * step);
    Some(format!(
        "{} are rounded to {} {unit}: what stays below {half} {unit} is lost; `risk --sensor-error offset='{half} {unit}'` gives the measures with intervals",
        names.join(", "),
        number(*step),
        unit = column.unit
    ))
}

/// A vehicle that becomes faster.
fn struck_from_behind(ax: &[f64], time_s: &[f64]) -> Option<String> {
    let gain = integral(ax, time_s);
    (gain > GAIN_M_S).then(|| {
        format!(
            "the vehicle becomes faster by {} km/h, as one that is struck from behind: if x points to the back, turn its sign by --columns, such as \
             't[s],-ax[g]'",
            number((gain * 36.0).round() / 10.0)
        )
    })
}

fn mean(part: &[f64]) -> f64 {
    part.iter().sum::<f64>() / part.len() as f64
}

/// Samples before first contact, those of the last tenth of a second at most; without it, those of the first 10 ms.
fn rest(time_s: &[f64], contact_s: Option<f64>) -> Option<[usize; 2]> {
    let first_s = *time_s.first()?;
    let until_s = contact_s.unwrap_or(first_s + REST_S[0]).min(first_s + REST_S[1]);
    let to = time_s.partition_point(|t| *t < until_s - 1e-9);
    (to >= 2).then_some([0, to])
}

/// Mean and standard deviation.
fn spread(part: &[f64]) -> (f64, f64) {
    let mean = mean(part);
    (mean, (part.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / part.len() as f64).sqrt())
}

fn zero_errors(motion: &Motion, known: Known, said: &mut Vec<String>) {
    let time_s = &motion.time_s;
    let (first_s, last_s) = (time_s[0], time_s[time_s.len() - 1]);
    // time before first contact is a rest
    let contact_s = known.contact_s.or_else(|| (first_s < 0.0 && last_s > 0.0).then_some(0.0));
    let Some(contact_s) = contact_s.filter(|contact_s| contact_s - first_s >= REST_S[0]) else { return };
    let Some([from, to]) = rest(time_s, Some(contact_s)) else { return };
    let length_s = time_s[to - 1] - time_s[from];
    let tail = time_s.partition_point(|t| *t < last_s - REST_S[0].max(length_s));
    let (mut offsets, mut drifts, mut still) = (Vec::new(), Vec::new(), true);
    // a vehicle may go on braking along x and turning about z; any other mean at its end is not its motion
    let mut astray = Vec::new();
    for column in &motion.columns {
        let (begin, noise) = spread(&column.values[from..to]);
        let (end, end_noise) = spread(&column.values[tail..]);
        let [least, gravity] = if is_rate(column) { [ZERO[1], 0.0] } else { [ZERO[0], G] };
        let stands = |error: f64, lift: f64| column.name == "az" && (error * column.factor + lift).abs() < 0.2 * G;
        let lift = [gravity, -gravity].into_iter().find(|lift| gravity > 0.0 && stands(begin, *lift)).unwrap_or(0.0);
        let error = begin * column.factor + lift;
        let sure = 4.0 * noise * column.factor / ((to - from) as f64).sqrt();
        let words = |error: f64| {
            format!("{} {} {}", column.name, number((1e3 * error / column.factor).round() / 1e3), column.unit)
        };
        if error.abs() > least.max(sure) {
            offsets.push(words(error));
        }
        still &= end_noise <= 1.5 * noise + 0.2 * least / column.factor;
        if ((end - begin) * column.factor).abs() > least.max(2.0 * sure) {
            drifts.push(words((end - begin) * column.factor));
            astray.push(column.name);
        }
    }
    let ms = number((length_s * 1e3).round());
    if !offsets.is_empty() && !known.baseline[0] {
        said.push(format!(
            "at rest before first contact the record reads {}: --baseline '{ms} ms' takes that away",
            offsets.join(", ")
        ));
    }
    let has = |name: &str| astray.contains(&name);
    let drifted = ["az", "wx", "wy"].into_iter().any(has) || has("ay") != has("wz");
    if drifted && still && !known.baseline[1] {
        said.push(format!(
            "from its beginning to its end, as quiet, the record goes by {}: if the vehicle stands still there, --baseline '{ms} ms' --baseline-end '{ms} ms' takes the drift away",
            drifts.join(", ")
        ));
    }
}

/// A velocity change whose values are all gains.
fn gains_speed(changes: &[f64]) -> Option<String> {
    let most = changes.iter().fold(0.0_f64, |most, v| if v.abs() > most.abs() { *v } else { most });
    let least = changes.iter().copied().fold(0.0, f64::min);
    (most > 1.5 && least > -0.1 * most).then(|| {
        format!(
            "the vehicle becomes faster by {} km/h, as one that is struck from behind: if the table gives the loss of speed as a positive number, turn \
             its sign by --columns, such as 't[ms],-dvx[km/h]'",
            number((most * 36.0).round() / 10.0)
        )
    })
}

fn backwards(change_m_s: f64, known: Known) -> Option<String> {
    let end_m_s = known.speed_m_s? + change_m_s;
    (end_m_s < -2.0 && known.speed_m_s? > 0.0).then(|| {
        format!(
            "the vehicle goes backwards at {} km/h at the end: is the speed too low, or the sign of the record wrong?",
            number((-end_m_s * 36.0).round() / 10.0)
        )
    })
}

/// Places and angles that are rounded so that their second derivatives are mostly that.
fn rounded(motion: &Motion, known: Known) -> Option<String> {
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
        "{} is rounded to {} {} every {} ms: that alone is {:.2} g of noise in accelerations; --filter '{cutoff} Hz' leaves {left:.2} g of it",
        column.name,
        number(steps[i]? / column.factor),
        column.unit,
        number((dt_s * 1e6).round() / 1e3),
        noise / G
    ))
}

/// The same of the table of a scenario, in the first unit in which its places are round.
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

/// A yaw that turns against the course.
fn turned(motion: &Motion) -> Option<String> {
    let [x, y, yaw] = ["x", "y", "yaw"].map(|name| motion.si(name));
    let (x, y, yaw) = (x?, y?, yaw?);
    let last = x.len() - 1;
    let course = |i: usize, j: usize| (y[j] - y[i]).atan2(x[j] - x[i]);
    let part = (last / 10).max(1);
    let (began, ended) = (course(0, part), course(last - part, last));
    let moved = |i: usize, j: usize| (x[j] - x[i]).hypot(y[j] - y[i]) / (motion.time_s[j] - motion.time_s[i]);
    let (turn, own) = (ended - began, yaw[last] - yaw[0]);
    let least = 3_f64.to_radians();
    let clear = turn.abs() > least
        && own.abs() > least
        && turn.abs() < 2.5
        && moved(0, part).min(moved(last - part, last)) > 3.0;
    (clear && turn * own < 0.0 && (turn + own).abs() < 0.5 * turn.abs()).then(|| {
        "yaw turns against the course of the places: are their axes others? --columns turns a sign, such as '-yaw[deg]'".to_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Name, unit, factor and course of a column.
    type Given<'a> = (&'static str, &'a str, f64, &'a dyn Fn(f64) -> f64);

    fn motion(kind: MotionKind, dt_s: f64, columns: &[Given<'_>]) -> Motion {
        let time_s: Vec<f64> = (-500..5000).map(|i| f64::from(i) * dt_s).collect();
        let column = |(name, unit, factor, of): &Given<'_>| Column {
            name,
            unit: (*unit).to_owned(),
            factor: *factor,
            values: time_s.iter().map(|t| of(*t)).collect(),
        };
        let columns = columns.iter().map(column).collect();
        Motion { kind, words: String::new(), time_s, columns, signals: Vec::new() }
    }

    fn pulse(t: f64) -> f64 {
        if (0.0..0.1).contains(&t) { -10.0 * (std::f64::consts::PI * t / 0.1).sin() } else { 0.0 }
    }

    fn said(columns: &[Given<'_>]) -> String {
        doubts(&motion(MotionKind::Accelerations, 1e-4, columns), Known::default()).join("\n")
    }

    #[test]
    fn a_sound_record_raises_no_doubt_and_each_flaw_is_said_with_its_remedy() {
        let noise = |t: f64| 0.2 * (t * 12_345.0).sin();
        let sound = |t: f64| pulse(t) + noise(t);
        assert_eq!(said(&[("ax", "g", G, &sound), ("wz", "deg/s", 0.01745, &|t| 20.0 * (9.0 * t).sin().max(0.0))]), "");
        let lifted = said(&[("ax", "g", G, &|t| sound(t) + 0.15)]);
        assert!(lifted.contains("reads ax 0.15") && lifted.contains("--baseline '50 ms'"), "{lifted}");
        let cut = said(&[("ax", "g", G, &|t| sound(t).max(-8.0))]);
        assert!(cut.contains("-8 g") && cut.contains("end of its range"), "{cut}");
        let metric = said(&[("ax", "g", G, &|t| 9.81 * pulse(t))]);
        assert!(metric.contains("is it in m/s^2? --columns"), "{metric}");
        let upright = said(&[("az", "m/s^2", 1.0, &|t| -1.0 + 0.01 * noise(t))]);
        assert!(upright.contains("az in m/s^2 begins at -1") && upright.contains("is it in g?"), "{upright}");
        let spun = said(&[("wz", "rad/s", 1.0, &|_| 90.0)]);
        assert!(spun.contains("turns the vehicle") && spun.contains("deg/s"), "{spun}");
        let drifting = said(&[("az", "g", G, &|t| noise(t) + 0.3 * (t + 0.05).max(0.0))]);
        let braking = said(&[("ax", "g", G, &|t| sound(t) - if t > 0.0 { 0.4 } else { 0.0 })]);
        assert_eq!(braking, "");
        assert!(drifting.contains("--baseline-end '50 ms'"), "{drifting}");
    }

    #[test]
    fn signs_of_velocity_changes_and_rounded_places_are_doubted() {
        let gain =
            motion(MotionKind::Changes, 1e-3, &[("dvx", "km/h", 1.0 / 3.6, &|t| 40.0 * (t / 5.0).clamp(0.0, 1.0))]);
        assert!(doubts(&gain, Known::default())[0].contains("'t[ms],-dvx[km/h]'"));
        let loss =
            motion(MotionKind::Changes, 1e-3, &[("dvx", "km/h", 1.0 / 3.6, &|t| -40.0 * (t / 5.0).clamp(0.0, 1.0))]);
        assert!(doubts(&loss, Known { speed_m_s: Some(15.0), ..Known::default() }).is_empty());
        assert!(
            doubts(&loss, Known { speed_m_s: Some(5.0), ..Known::default() })[0].contains("goes backwards at 22 km/h")
        );
        let millimetres = |t: f64| ((22.0 * t - 3.0 * t * t) * 1e3).round() / 1e3;
        let places = motion(MotionKind::Places, 0.01, &[("x", "m", 1.0, &millimetres)]);
        let words = doubts(&places, Known::default()).join("\n");
        assert!(
            words.contains("x is rounded to 0.001 m every 10 ms")
                && words.contains("1.77 g")
                && words.contains("--filter '"),
            "{words}"
        );
        assert!(doubts(&places, Known { smoothed_hz: Some(10.0), ..Known::default() }).is_empty());
        let fine = motion(MotionKind::Places, 0.01, &[("x", "m", 1.0, &|t| 22.0 * t - 3.000_123_4 * t * t)]);
        assert!(doubts(&fine, Known::default()).is_empty());
        let turn: [Given<'_>; 3] = [
            ("x", "m", 1.0, &|t| 20.000_001_3 * (t / 10.0).sin()),
            ("y", "m", 1.0, &|t| 20.000_001_3 * (1.0 - (t / 10.0).cos())),
            ("yaw", "rad", 1.0, &|t| -t / 10.000_001_3),
        ];
        let against = motion(MotionKind::Places, 4e-3, &turn);
        assert!(against.time_s.len() == 5500 && turned(&against).is_none(), "slower than 3 m/s");
    }
}
