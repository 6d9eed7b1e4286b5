//! Doubts about a record: clipped sensors, impossible units and signs, zero offsets, drift, rounding. Each names the
//! option that corrects it; nothing is corrected without being asked.

mod lost;
mod places;
mod slips;
mod units;
mod zero;

use crash_measures::signal::plateau;
use placed_text::number;

use super::motion::{Column, Motion, MotionKind};
use lost::{absurd, held};
pub use places::rounded_table;
use places::{across, late, rounded, smoothed, turned};
use slips::slip;
use units::{rough, slow, weak, wrong_unit};
use zero::zero_errors;

/// Known data of the vehicle besides the record.
#[derive(Clone, Copy, Debug, Default)]
pub struct Known {
    /// Time of first contact, s, if given.
    pub contact_s: Option<f64>,
    /// Speed at first contact, m/s, if given.
    pub speed_m_s: Option<f64>,
    /// Whether zero offsets are removed: at the start, at the end.
    pub baseline: [bool; 2],
    /// Cutoff frequency of the smoothing of positions, Hz.
    pub smoothed_hz: Option<f64>,
}

/// Least gain of speed that is reported, m/s.
const GAIN_M_S: f64 = 3.0;
/// Shortest and longest rest used for a mean, s.
const REST_S: [f64; 2] = [0.01, 0.1];

/// All doubts about a record.
pub fn doubts(motion: &Motion, known: Known) -> Vec<String> {
    // what marks a missing value says nothing of units and signs
    let (mad, sound): (Vec<&Column>, Vec<&Column>) =
        motion.columns.iter().partition(|column| absurd(motion, column).is_some());
    let mut said: Vec<String> = mad.iter().filter_map(|column| absurd(motion, column)).collect();
    said.extend(sound.iter().filter_map(|column| slip(motion, column)));
    let si = |name: &str| sound.iter().any(|column| column.name == name).then(|| motion.si(name)).flatten();
    match motion.kind {
        MotionKind::Accelerations => {
            said.extend(sound.iter().filter_map(|column| clipped(column, &motion.time_s)));
            said.extend(held(motion));
            said.extend(sound.iter().filter_map(|column| wrong_unit(column, &motion.time_s)));
            said.extend(weak(motion));
            said.extend(slow(motion));
            said.extend(rough(motion));
            zero_errors(motion, known, &mut said);
            said.extend(si("ax").and_then(|ax| struck_from_behind(&ax, &motion.time_s)));
            said.extend(si("ax").and_then(|ax| backwards(integral(&ax, &motion.time_s), known)));
        }
        MotionKind::Changes => {
            let changes = si("dvx").unwrap_or_default();
            said.extend(gains_speed(&changes));
            said.extend(changes.last().and_then(|change| backwards(*change, known)));
        }
        MotionKind::Places => {
            if !["x", "y"].into_iter().any(|name| motion.has(name)) {
                said.push(format!(
                    "there is no column x or y, so the vehicle turns on the spot. Name them with --columns, such as 't[s],x[m],y[m]'; columns read: {}",
                    motion.signals.join(", ")
                ));
            }
            said.extend(late(motion));
            said.extend(rounded(motion, known));
            said.extend(smoothed(motion, known));
            said.extend(turned(motion));
            said.extend(across(motion));
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
        "{} reads its extreme, {} {}, in {} samples, from {} s on {} in a row. If the sensor was clipped, results may be too low; use another sensor (--at, --columns)",
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

/// Reports a vehicle that gains speed.
fn struck_from_behind(ax: &[f64], time_s: &[f64]) -> Option<String> {
    let gain = integral(ax, time_s);
    (gain > GAIN_M_S).then(|| {
        format!(
            "the vehicle gains {} km/h, as in a rear impact. If x points backwards, reverse its sign with --columns, such as 't[s],-ax[g]'",
            number((gain * 36.0).round() / 10.0)
        )
    })
}

fn mean(part: &[f64]) -> f64 {
    part.iter().sum::<f64>() / part.len() as f64
}

/// Reports a velocity change that only increases.
fn gains_speed(changes: &[f64]) -> Option<String> {
    let most = changes.iter().fold(0.0_f64, |most, v| if v.abs() > most.abs() { *v } else { most });
    let least = changes.iter().copied().fold(0.0, f64::min);
    (most > 1.5 && least > -0.1 * most).then(|| {
        format!(
            "the vehicle gains {} km/h, as in a rear impact. If the table gives a loss of speed as a positive number, use --struck front, or reverse its sign with --columns, such as 't[ms],-dvx[km/h]'",
            number((most * 36.0).round() / 10.0)
        )
    })
}

fn backwards(change_m_s: f64, known: Known) -> Option<String> {
    let end_m_s = known.speed_m_s? + change_m_s;
    (end_m_s < -2.0 && known.speed_m_s? > 0.0).then(|| {
        format!(
            "the vehicle moves backwards at {} km/h at the end: check the initial speed and the sign of the record",
            number((-end_m_s * 36.0).round() / 10.0)
        )
    })
}

#[cfg(test)]
mod tests {
    use crash_measures::signal::STANDARD_GRAVITY_MPS2 as G;

    use super::*;

    /// Name, unit, factor and values of a column.
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
        assert!(cut.contains("-8 g") && cut.contains("If the sensor was clipped"), "{cut}");
        let metric = said(&[("ax", "g", G, &|t| 9.81 * pulse(t))]);
        assert!(metric.contains("if it is in m/s^2, use --columns"), "{metric}");
        let upright = said(&[("az", "m/s^2", 1.0, &|t| -1.0 + 0.01 * noise(t))]);
        assert!(upright.contains("az in m/s^2 begins at -1") && upright.contains("if it is in g"), "{upright}");
        let spun = said(&[("wz", "rad/s", 1.0, &|_| 90.0)]);
        assert!(spun.contains("turns the vehicle") && spun.contains("deg/s"), "{spun}");
        let drifting = said(&[("az", "g", G, &|t| noise(t) + 0.3 * (t + 0.05).max(0.0))]);
        let braking = said(&[("ax", "g", G, &|t| sound(t) - if t > 0.0 { 0.4 } else { 0.0 })]);
        assert_eq!(braking, "");
        assert!(drifting.contains("--baseline-end '50 ms'"), "{drifting}");
    }

    #[test]
    fn what_a_recorder_put_in_the_place_of_lost_samples_is_said() {
        let noise = |t: f64| 0.2 * (t * 12_345.0).sin();
        let lost = |t: f64, put: f64| if (0.02..0.03).contains(&t) { put } else { pulse(t) + noise(t) };
        let zeros = said(&[("ax", "g", G, &|t| lost(t, 0.0)), ("ay", "g", G, &|t| lost(t, 0.0))]);
        assert!(zeros.contains("ax, ay are 0 from 0.02 s to 0.0299 s, 100 samples"), "{zeros}");
        let last = said(&[("ax", "g", G, &|t| lost(t, -6.0)), ("wz", "deg/s", 0.01745, &|t| 9.0 * noise(t))]);
        assert!(last.contains("ax is constant from 0.02 s"), "{last}");
        let marked = said(&[("ax", "g", G, &|t| lost(t, 99_999.0))]);
        assert!(marked.contains("ax is 99999 g at 0.02 s and 100 times beyond 2000 g"), "{marked}");
        assert!(!marked.contains("becomes faster") && !marked.contains("m/s^2"), "{marked}");
        // zeros before and behind, a drawn pulse with its top cut, and rounded samples are no loss
        let drawn =
            said(&[("ax", "g", G, &|t| pulse(t).max(-9.0)), ("ay", "g", G, &|t| if t > 0.3 { 0.0 } else { noise(t) })]);
        assert!(!drawn.contains("were samples lost"), "{drawn}");
        assert!(
            !said(&[("ax", "g", G, &|t| (2.0 * (pulse(t) + noise(t))).round() / 2.0)]).contains("were samples lost")
        );
    }

    #[test]
    fn a_vehicle_that_goes_across_its_heading_is_asked_about() {
        let goes = |yaw: &dyn Fn(f64) -> f64| {
            let places: [Given<'_>; 3] = [
                ("x", "m", 1.0, &|t| 0.000_013_7 * t),
                ("y", "m", 1.0, &|t| 20.000_001_3 * t),
                ("yaw", "deg", 0.017_453_292_519_943, yaw),
            ];
            doubts(&motion(MotionKind::Places, 4e-3, &places), Known::default()).join("\n")
        };
        assert!(goes(&|_| 0.0).contains("72 km/h, 90 deg off its heading"), "{}", goes(&|_| 0.0));
        assert_eq!(goes(&|t| 89.0 + 0.1 * t), "");
        assert_eq!(goes(&|t| 450.0 + 0.1 * t), "");
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
            doubts(&loss, Known { speed_m_s: Some(5.0), ..Known::default() })[0].contains("moves backwards at 22 km/h")
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
        let known = Known { smoothed_hz: Some(10.0), ..Known::default() };
        let [words] = &doubts(&places, known)[..] else { panic!("one note") };
        assert!(
            words.contains("smoothed above 10 Hz; with 15 Hz, accelerations along x would differ by up to 0."),
            "{words}"
        );
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
