//! The crash pulse of a report: cumulative or per interval, its sign, and whether it agrees with all else that the report says.

use std::path::Path;

use occupant_units::unit::Unit;
use placed_text::number;

use super::facts::{Facts, Fired, STRUCK, Said, Signs, contradiction};
use super::{DeltaV, Hints};
use crate::measured::motion::is_named;
use crate::signals::{Recording, Signal};
use crate::trouble::Trouble;
use crash_measures::signal::usual_interval;

/// Largest velocity change of a road vehicle, m/s.
const MOST_M_S: f64 = 55.0;
/// Largest speed of a road vehicle, m/s.
const FASTEST_M_S: f64 = 85.0;
/// Longest crash pulse, s, and largest acceleration between two rows, m/s².
const LONGEST_S: f64 = 5.0;
const STEEPEST_M_S2: f64 = 3000.0;
/// A slower vehicle stands, m/s.
const STANDS_M_S: f64 = 5.0 / 3.6;
/// Velocity changes below are no direction, m/s.
const LITTLE_M_S: f64 = 1.0;
/// Values that mark a missing velocity change.
const MARKS: [f64; 12] = [126.0, 127.0, 128.0, 254.0, 255.0, 888.0, 997.0, 999.0, 9999.0, 99_996.0, 99_997.0, 32_767.0];
/// Accelerations sampled more coarsely give a worse path than velocity changes, s.
const FINE_S: f64 = 0.0025;

/// What the headings of a signal said.
#[derive(Clone, Debug, Default)]
pub(super) struct Heading {
    pub(super) name: String,
    pub(super) line: usize,
    pub(super) is_loss: bool,
    pub(super) told: Option<DeltaV>,
}

pub(super) struct Pulse<'a> {
    pub(super) path: &'a Path,
    pub(super) facts: &'a Facts,
    pub(super) hints: Hints<'a>,
    pub(super) headings: &'a [Heading],
    /// Speed before the crash, m/s, and its words.
    pub(super) speed: Option<(f64, String)>,
}

/// Index of the signal that is a column.
fn at(recording: &Recording, name: &str) -> Option<usize> {
    recording.signals.iter().position(|signal| signal.scale.is_some() && is_named(signal, name))
}

fn si(signal: &Signal) -> Vec<f64> {
    let factor = signal.scale.map_or(1.0, |scale| scale.factor);
    signal.values.iter().map(|value| value * factor).collect()
}

fn finite(values: &[f64]) -> impl DoubleEndedIterator<Item = f64> {
    values.iter().copied().filter(|value| value.is_finite())
}

/// The value that is farthest from 0.
fn extreme(values: &[f64]) -> f64 {
    finite(values).fold(0.0, |most: f64, v| if v.abs() > most.abs() { v } else { most })
}

/// The velocity change of a signal over its times, m/s, accelerations integrated.
fn change(signal: &Signal) -> Vec<f64> {
    let values = si(signal);
    if signal.scale.is_some_and(|scale| scale.dimension == Unit::MetrePerSecond.dimension()) {
        return values;
    }
    let mut sum = 0.0;
    let steps = signal.time_s.windows(2).zip(values.windows(2)).map(|(t, v)| {
        let step = 0.5 * (t[1] - t[0]) * (v[0] + v[1]);
        sum += if step.is_finite() { step } else { 0.0 };
        sum
    });
    std::iter::once(0.0).chain(steps).collect()
}

fn km_h(speed_m_s: f64) -> String {
    number((speed_m_s * 36.0).round() / 10.0)
}

impl Pulse<'_> {
    fn heading(&self, signal: &Signal) -> Heading {
        let own = self.headings.iter().find(|heading| heading.name == signal.name);
        own.cloned().unwrap_or_else(|| Heading { line: 1, ..Heading::default() })
    }

    /// Settles shape and sign of the pulse.
    ///
    /// # Errors
    /// Contradictions, and questions that only the user can answer.
    pub(super) fn settle(&self, recording: &mut Recording) -> Result<(), Trouble> {
        let of_changes = ["dvx", "dvy"].map(|name| at(recording, name));
        for i in of_changes.into_iter().flatten() {
            let note = without_marks(&mut recording.signals[i]);
            recording.notes.extend(note);
        }
        self.cumulate(recording, of_changes)?;
        of_changes.into_iter().flatten().try_for_each(|i| self.check_times(&recording.signals[i]))?;
        self.check_doubles(recording)?;
        self.check_sizes(recording)?;
        self.check_most(recording, of_changes)?;
        self.sign(recording, 0, ["dvx", "ax"].map(|name| at(recording, name)))?;
        self.sign(recording, 1, ["dvy", "ay"].map(|name| at(recording, name)))?;
        self.check_accelerations(recording)?;
        self.check_end(recording)
    }

    /// Sums of changes per interval.
    fn cumulate(&self, recording: &mut Recording, of_changes: [Option<usize>; 2]) -> Result<(), Trouble> {
        let mut decided = None;
        for (axis, i) in of_changes.into_iter().enumerate() {
            let Some(i) = i else { continue };
            let own = match decided.filter(|_| axis == 1) {
                Some(own) => own,
                None => self.kind(&recording.signals[i], self.facts.most_m_s[axis], &mut recording.notes)?,
            };
            decided = Some(own);
            if own == DeltaV::Interval {
                sum_up(&mut recording.signals[i]);
            }
        }
        Ok(())
    }

    fn kind(&self, signal: &Signal, most: Said<f64>, notes: &mut Vec<String>) -> Result<DeltaV, Trouble> {
        if let Some(told) = self.hints.delta_v {
            return Ok(told);
        }
        let heading = self.heading(signal);
        let values = si(signal);
        let all: Vec<f64> = finite(&values).collect();
        let (peak, sum) = (extreme(&values).abs(), all.iter().sum::<f64>());
        let total: f64 = all.iter().map(|v| v.abs()).sum();
        let last = all.last().map_or(0.0, |v| v.abs());
        let is_one_way = sum.abs() >= 0.8 * total;
        let returns = all.len() > 4 && peak > 0.3 && is_one_way && last <= 0.15 * peak && sum.abs() > 2.0 * peak;
        let agrees = |size: f64| most.is_some_and(|(most, _)| (most.abs() - size).abs() <= 0.1 * most.abs() + 0.56);
        let (as_sum, as_is) = (agrees(sum.abs()) && !agrees(peak), agrees(peak) && !agrees(sum.abs()));
        let ask = |found: String| {
            contradiction(self.path, heading.line, &found)
                .hint("say how to read the numbers with --delta-v cumulative or --delta-v interval")
        };
        match heading.told {
            Some(DeltaV::Cumulative) if as_sum || returns => Err(ask(format!(
                "`{}` is called cumulative but returns to {} km/h from {}, as changes per interval do",
                signal.name,
                km_h(last),
                km_h(peak)
            ))),
            Some(DeltaV::Interval) if as_is || sum.abs() > MOST_M_S => Err(ask(format!(
                "`{}` is called a change per interval, but its sum is {} km/h and its largest value {}",
                signal.name,
                km_h(sum),
                km_h(peak)
            ))),
            Some(told) => {
                if told == DeltaV::Interval {
                    notes.push(format!("`{}` gives changes per interval: summed to {} km/h", signal.name, km_h(sum)));
                }
                Ok(told)
            }
            None if as_sum && all.len() > 4 || returns && !as_is => {
                notes.push(format!(
                    "`{}` returns to {} km/h from {}, so it is read as changes per interval and summed to {} km/h; --delta-v cumulative takes it as it stands",
                    signal.name, km_h(last), km_h(peak), km_h(sum)
                ));
                Ok(DeltaV::Interval)
            }
            None => Ok(DeltaV::Cumulative),
        }
    }

    /// A velocity change begins at 0, and takes the time of a crash.
    fn check_times(&self, signal: &Signal) -> Result<(), Trouble> {
        let heading = self.heading(signal);
        let values = si(signal);
        let wrong = |found: String, expected: &str| {
            Err(Trouble::at(self.path, heading.line, found, expected)
                .hint("correct the unit of time in the heading, or name all columns with their units with --columns"))
        };
        let known = || signal.time_s.iter().zip(&values).filter(|(_, v)| v.is_finite());
        let length_s = last_time(signal) - known().next().map_or(0.0, |(t, _)| *t);
        if length_s > LONGEST_S {
            let found = format!("a crash pulse `{}` of {} s", signal.name, number((length_s * 10.0).round() / 10.0));
            return wrong(found, "at most 5 s");
        }
        let pairs = signal.time_s.windows(2).zip(values.windows(2)).filter(|(t, _)| t[1] > t[0]);
        let steepest = pairs.map(|(t, v)| ((v[1] - v[0]) / (t[1] - t[0])).abs()).filter(|a| a.is_finite());
        let steepest = steepest.fold(0.0, f64::max);
        if steepest > STEEPEST_M_S2 {
            let found =
                format!("`{}` changes with {} g between two rows", signal.name, number((steepest / 9.806_65).round()));
            return wrong(found, "at most 300 g");
        }
        let peak = extreme(&values).abs();
        let first = known().next().filter(|(t, v)| **t <= 0.0 && v.abs() > (5.0_f64 / 3.6).max(0.2 * peak));
        match first {
            None => Ok(()),
            Some((t, v)) => {
                let found = format!("`{}` is already {} km/h at {} s", signal.name, km_h(*v), number(*t));
                Err(contradiction(self.path, heading.line, &found)
                    .hint("a cumulative change is 0 at time zero; --delta-v interval sums the rows"))
            }
        }
    }

    /// Velocity changes that are given twice, per interval and cumulative, agree.
    fn check_doubles(&self, recording: &Recording) -> Result<(), Trouble> {
        for name in ["dvx", "dvy"] {
            let all: Vec<&Signal> =
                recording.signals.iter().filter(|s| s.scale.is_some() && is_named(s, name)).collect();
            let [first, others @ ..] = &all[..] else { continue };
            for other in others {
                let (a, b) = (extreme(&si(first)), extreme(&si(other)));
                if (a - b).abs() > 0.3 + 0.05 * a.abs() {
                    let found =
                        format!("`{}` reaches {} km/h, and `{}` {} km/h", first.name, km_h(a), other.name, km_h(b));
                    return Err(contradiction(self.path, self.heading(first).line, &found)
                        .hint("choose one of the two with --columns, such as 't[ms],dvx[km/h],-'"));
                }
            }
        }
        Ok(())
    }

    fn check_sizes(&self, recording: &Recording) -> Result<(), Trouble> {
        for name in ["dvx", "dvy", "ax", "ay"] {
            let Some(signal) = at(recording, name).map(|i| &recording.signals[i]) else { continue };
            let most = extreme(&change(signal));
            if most.abs() > MOST_M_S {
                let found = format!(
                    "`{}` in {} gives a velocity change of {} km/h",
                    signal.name,
                    signal.unit.as_deref().unwrap_or("?"),
                    km_h(most)
                );
                return Err(Trouble::at(
                    self.path,
                    self.heading(signal).line,
                    found,
                    "at most 200 km/h: no road vehicle changes its velocity by more",
                )
                .hint("correct the unit in the heading, or name all columns with their units with --columns"));
            }
        }
        if let Some((speed, words)) = self.speed.as_ref().filter(|(speed, _)| *speed > FASTEST_M_S || *speed < -20.0) {
            let found = format!("{words} is {} km/h", km_h(*speed));
            return Err(
                Trouble::of(self.path, found, "a speed of a road vehicle").hint("correct its unit, or give --speed")
            );
        }
        Ok(())
    }

    /// The largest velocity change that the report names, against its table.
    fn check_most(&self, recording: &mut Recording, of_changes: [Option<usize>; 2]) -> Result<(), Trouble> {
        for (i, most) in of_changes.into_iter().zip(self.facts.most_m_s) {
            let (Some(i), Some((most, line))) = (i, most) else { continue };
            let signal = &recording.signals[i];
            let values = si(signal);
            let peak = extreme(&values);
            let is_cut = ends_changing(&signal.time_s, &values);
            let [told, read] = [most, peak].map(km_h);
            let found = format!("the largest velocity change is {told} km/h here and {read} km/h in `{}`", signal.name);
            if (most.abs() - peak.abs()).abs() > 0.1 * most.abs().max(peak.abs()) + 0.56 {
                if !is_cut || most.abs() < peak.abs() {
                    return Err(contradiction(self.path, line, &found)
                        .hint("correct one of the two, their units, or give --delta-v interval"));
                }
                recording.notes.push(format!(
                    "the table ends at {} km/h, before the largest velocity change of {} km/h (line {line}): the pulse is cut off, and results are too low",
                    km_h(peak), km_h(most)
                ));
            } else if most < -LITTLE_M_S
                && peak > LITTLE_M_S
                && self.hints.struck.is_none()
                && !matches!(self.facts.signs, Some((Signs::None | Signs::Loss, _)))
            {
                return Err(contradiction(self.path, line, &found).hint(STRUCK));
            }
        }
        Ok(())
    }

    /// The sign of an axis: velocity change and acceleration.
    fn sign(&self, recording: &mut Recording, axis: usize, found: [Option<usize>; 2]) -> Result<(), Trouble> {
        let is_signed = ["dvx", "dvy", "ax", "ay"].iter().filter_map(|name| at(recording, name)).any(|i| {
            let values = change(&recording.signals[i]);
            finite(&values).fold(0.0, f64::min) < -LITTLE_M_S
        });
        for i in found.into_iter().flatten() {
            let heading = self.heading(&recording.signals[i]);
            let most = extreme(&change(&recording.signals[i]));
            let turned = if axis == 0 {
                self.turns_x(most, is_signed, &heading)?
            } else {
                self.turns_y(most, is_signed, &heading)?
            };
            if let Some(why) = turned {
                recording.signals[i].values.iter_mut().for_each(|value| *value = 0.0 - *value);
                recording.notes.push(format!("the sign of `{}` is reversed: {why}", recording.signals[i].name));
            }
        }
        Ok(())
    }

    /// Why a longitudinal signal is turned, if it is.
    fn turns_x(&self, most: f64, is_signed: bool, heading: &Heading) -> Result<Option<String>, Trouble> {
        let turns = |should_lose: bool| (most > 0.0) == should_lose;
        if let Some([x, _]) = self.hints.struck.filter(|[x, _]| *x != 0) {
            return Ok(turns(x < 0).then(|| format!("--struck {}", if x < 0 { "front" } else { "rear" })));
        }
        if most.abs() < LITTLE_M_S {
            return Ok(None);
        }
        let refuse = |found: &str| Err(contradiction(self.path, heading.line, found).hint(STRUCK));
        let struck = &self.facts.struck;
        let what = format!("a {} of {} km/h", if most > 0.0 { "gain" } else { "loss" }, km_h(most.abs()));
        let (front, rear) = (struck.front.as_ref(), struck.rear.as_ref());
        if let (Some(front), Some(rear)) = (front, rear) {
            return refuse(&format!("{front}, but {rear}"));
        }
        let signs = self.facts.signs.map(|(signs, _)| signs);
        let is_printed_loss = heading.is_loss || signs == Some(Signs::Loss);
        if is_printed_loss {
            return match (rear, most > 0.0) {
                (Some(rear), true) => refuse(&format!("positive numbers are a loss of speed, but {rear}")),
                (_, true) => Ok(Some("the report gives a loss of speed as a positive number".to_owned())),
                (None, false) if heading.is_loss && signs != Some(Signs::Loss) => Ok(None),
                (_, false) => Ok(Some("the report gives a gain of speed as a negative number".to_owned())),
            };
        }
        if most < 0.0 {
            return match rear {
                Some(rear) => refuse(&format!("{what}, as in a frontal impact, but {rear}")),
                None => Ok(None),
            };
        }
        let bag = self
            .facts
            .bag
            .filter(|(fired, _)| *fired != Fired::No)
            .map(|(_, line)| format!("the front air bag fired (line {line})"));
        let moves = self.speed.as_ref().filter(|(speed, _)| *speed > STANDS_M_S);
        let turn = |why: &str| {
            Ok(Some(format!(
                "{why}, so positive numbers are taken as a loss of speed; --struck rear takes them as a gain"
            )))
        };
        match (rear, front.or(bag.as_ref())) {
            (Some(rear), Some(_)) if bag.is_some() => refuse(&format!("{rear}, but {}", bag.unwrap_or_default())),
            (Some(_), _) => Ok(None),
            (None, Some(front)) if is_signed || signs == Some(Signs::Sae) => refuse(&format!("{what}, as in a rear impact, but {front}")),
            (None, Some(front)) => turn(front),
            (None, None) if signs == Some(Signs::None) => turn("the report gives magnitudes"),
            (None, None) if signs == Some(Signs::Sae) => Ok(None),
            (None, None) => match moves {
                Some((speed, words)) => Err(Trouble::at(self.path, heading.line, format!(
                    "{what}, as in a rear impact, of a vehicle that drives {} km/h before ({words}); or magnitudes of a frontal impact", km_h(*speed)
                ), "a sign that something in the report confirms").hint(STRUCK)),
                None => Ok(None),
            },
        }
    }

    /// Why a lateral signal is turned, if it is.
    fn turns_y(&self, most: f64, is_signed: bool, heading: &Heading) -> Result<Option<String>, Trouble> {
        if let Some([_, y]) = self.hints.struck.filter(|[_, y]| *y != 0) {
            return Ok(((most > 0.0) != (y > 0)).then(|| format!("--struck {}", if y > 0 { "left" } else { "right" })));
        }
        if self.facts.is_left_positive {
            return Ok(Some("the report counts to the left".to_owned()));
        }
        let struck = &self.facts.struck;
        if most.abs() < LITTLE_M_S || struck.front.is_some() || struck.rear.is_some() {
            return Ok(None);
        }
        let words = |side: &str, to: &str| {
            contradiction(
                self.path,
                heading.line,
                &format!("{side}, but the vehicle is pushed to the {to} (y to the right)"),
            )
            .hint(STRUCK)
        };
        match (&struck.left, &struck.right) {
            (Some(left), None) if most < 0.0 => Err(words(left, "left")),
            (None, Some(right)) if most > 0.0 && is_signed => Err(words(right, "right")),
            (None, Some(right)) if most > 0.0 => {
                Ok(Some(format!("{right}, so the vehicle is pushed to the left; --struck left takes it as it stands")))
            }
            _ => Ok(None),
        }
    }

    /// Velocity change and acceleration of one axis agree, and one of them makes the path.
    fn check_accelerations(&self, recording: &mut Recording) -> Result<(), Trouble> {
        for (of_change, of_acceleration) in [("dvx", "ax"), ("dvy", "ay")] {
            let (Some(i), Some(j)) = (at(recording, of_change), at(recording, of_acceleration)) else { continue };
            let (told, acceleration) = (&recording.signals[i], &recording.signals[j]);
            let end_s = finite(&acceleration.time_s).next_back().unwrap_or(0.0).min(last_time(told));
            let of = |signal: &Signal| {
                let values = change(signal);
                let mut known = signal.time_s.iter().zip(&values).filter(|(t, v)| **t <= end_s + 1e-9 && v.is_finite());
                known.next_back().map_or(0.0, |(_, v)| *v)
            };
            let (a, b) = (of(told), of(acceleration));
            let is_opposite = a * b < 0.0 && a.abs().min(b.abs()) > LITTLE_M_S;
            if is_opposite || (a - b).abs() > (0.4 * a.abs().max(b.abs())).max(2.0) {
                return Err(contradiction(
                    self.path,
                    self.heading(acceleration).line,
                    &format!(
                        "`{}` sums to {} km/h at {} ms, `{}` is {} km/h",
                        acceleration.name,
                        km_h(b),
                        number((end_s * 1e3).round()),
                        told.name,
                        km_h(a)
                    ),
                )
                .hint("choose one of the two with --columns, such as 't[ms],dvx[km/h],-'"));
            }
        }
        let (Some(i), Some(j)) = (at(recording, "dvx"), at(recording, "ax")) else { return Ok(()) };
        let is_fine = usual_interval(&recording.signals[j].time_s) <= FINE_S
            && last_time(&recording.signals[j]) >= 0.8 * last_time(&recording.signals[i]);
        let [kept, left] = if is_fine { [j, i] } else { [i, j] };
        let names: [&[&str]; 2] = if is_fine { [&["ax"], &["dvx", "dvy"]] } else { [&["dvx"], &["ax", "ay", "az"]] };
        recording.notes.push(format!(
            "the path is made of `{}`, with which `{}` agrees: it is left out",
            recording.signals[kept].name, recording.signals[left].name
        ));
        recording.signals.retain(|signal| !names[1].iter().any(|name| is_named(signal, name)));
        Ok(())
    }

    /// A vehicle that ends much faster backwards than walls throw it.
    fn check_end(&self, recording: &Recording) -> Result<(), Trouble> {
        let Some((speed, words)) =
            self.speed.as_ref().filter(|_| self.hints.struck.is_none() && self.hints.speed_m_s.is_none())
        else {
            return Ok(());
        };
        let Some(signal) = ["dvx", "ax"].iter().find_map(|name| at(recording, name)).map(|i| &recording.signals[i])
        else {
            return Ok(());
        };
        let values = change(signal);
        let end = speed + finite(&values).next_back().unwrap_or(0.0);
        if end >= -(2.0 + 0.15 * speed) {
            return Ok(());
        }
        Err(contradiction(self.path, self.heading(signal).line, &format!(
            "{words} is {} km/h, and a loss of {} km/h leaves the vehicle at {} km/h backwards", km_h(*speed), km_h(speed - end), km_h(-end)
        )).hint("if another vehicle pushed it back, say --struck front; give the speed at impact with --speed if it is another"))
    }
}

fn last_time(signal: &Signal) -> f64 {
    let mut known = signal.time_s.iter().zip(&signal.values).filter(|(_, value)| value.is_finite());
    known.next_back().map_or(0.0, |(t, _)| *t)
}

/// Whether the last 20 ms still change by more than 0.8 km/h.
fn ends_changing(time_s: &[f64], values: &[f64]) -> bool {
    let known: Vec<(f64, f64)> =
        time_s.iter().copied().zip(values.iter().copied()).filter(|(_, v)| v.is_finite()).collect();
    let Some((end_s, end)) = known.last() else { return false };
    known.iter().rev().find(|(t, _)| *t <= end_s - 0.0199).is_some_and(|(_, v)| (end - v).abs() > 0.8 / 3.6)
}

/// Marks of missing values, and zeros behind the end of the event, become missing.
fn without_marks(signal: &mut Signal) -> Option<String> {
    let is_mark = |value: f64| MARKS.iter().any(|mark| (value.abs() - mark).abs() < 1e-9);
    let most = finite(&signal.values).filter(|value| !is_mark(*value)).fold(0.0, |most: f64, v| most.max(v.abs()));
    let mut count = 0;
    for value in signal.values.iter_mut().filter(|value| is_mark(**value) && value.abs() > 1.5 * most) {
        *value = f64::NAN;
        count += 1;
    }
    let zeros = signal
        .values
        .iter()
        .rev()
        .take_while(|value| **value == 0.0 || value.is_nan())
        .filter(|value| **value == 0.0)
        .count();
    let known = signal.values.iter().rev().find(|value| **value != 0.0 && !value.is_nan()).copied().unwrap_or(0.0);
    let is_padding = zeros > 0 && known.abs() > 0.5 * most && signal.values.len() > zeros + 2;
    if is_padding {
        let from = signal.values.iter().rposition(|value| *value != 0.0 && !value.is_nan()).map_or(0, |i| i + 1);
        signal.values[from..].iter_mut().for_each(|value| *value = f64::NAN);
    }
    let what = match (count, is_padding) {
        (0, false) => return None,
        (0, true) => format!("{zeros} zeros behind its end"),
        (_, false) => format!("{count} marks of missing values"),
        (_, true) => format!("{count} marks of missing values and {zeros} zeros behind its end"),
    };
    Some(format!("`{}` has {what}: left out", signal.name))
}

/// Changes per interval become cumulative; a first row at time 0 that is not 0 is the change behind it.
fn sum_up(signal: &mut Signal) {
    if signal.time_s.first() == Some(&0.0) && signal.values.first().is_some_and(|value| *value != 0.0) {
        let step_s = usual_interval(&signal.time_s);
        signal.time_s.iter_mut().for_each(|t| *t += step_s);
        signal.time_s.insert(0, 0.0);
        signal.values.insert(0, 0.0);
    }
    let mut sum = 0.0;
    for value in signal.values.iter_mut().filter(|value| value.is_finite()) {
        sum += *value;
        *value = sum;
    }
}
