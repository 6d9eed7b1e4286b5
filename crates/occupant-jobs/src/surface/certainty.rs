//! Intervals: the record is made again many times, with its noise in another order and another speed within its error, and
//! the fit is repeated. The order is kept within blocks as long as the noise remembers.

use occupant_units::trig;
use std::sync::Arc;

use super::Impactor;
use super::contact::{self, Contact};
use super::curve::{self, Choice, Shape};
use super::law::{Back, Law};
use super::record::Record;
use occupant_study::misfit::unrelated_samples;
use occupant_study::{normal_quantile, of_resample};

/// Number of synthetic records.
const RECORDS: u64 = 100;
/// Half width of a 95 % interval over the standard deviation.
const WIDE: f64 = 1.96;

/// 95 % intervals, SI.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Certainty {
    /// Of the force at each point of the curve, the first at depth 0.
    pub force_n: Vec<[f64; 2]>,
    /// Of the returned share or the unloading slope.
    pub back: Option<[f64; 2]>,
    /// Of the friction.
    pub friction: Option<[f64; 2]>,
}

/// Intervals of the best law, widened to include its rivals, and of the friction.
pub(super) fn of(record: &Record, impactor: &Impactor, choices: &[Choice], law: &Law) -> Certainty {
    let Choice { shape, contact, .. } = &choices[0];
    let made: Vec<Made> = (0..RECORDS).filter_map(|i| again(record, impactor, contact, (shape, law), i)).collect();
    let rivals: Vec<Law> = choices[1..].iter().map(|rival| curve::law(&rival.shape, &rival.contact)).collect();
    let around = |value: f64, of: &dyn Fn(&Made) -> Option<f64>, others: &dyn Fn(&Law) -> Option<f64>| {
        let all: Vec<f64> = made.iter().filter_map(of).collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        let variance = all.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (all.len().max(2) - 1) as f64;
        let other = rivals.iter().filter_map(others).map(|x| (x - value).abs()).fold(0.0, f64::max);
        let half = trig::hypot(WIDE * variance.sqrt(), other);
        [value - half, value + half]
    };
    let hidden = hidden(law, contact);
    let force = |(i, point): (usize, &[f64; 2])| {
        let [from, to] = around(point[1], &|made| made.force_n.get(i).copied(), &|rival| Some(rival.loading(point[0])));
        let shifted = [hidden, -hidden].map(|by| (law.loading((point[0] + by).max(0.0)) - point[1]).abs());
        let hidden = if i == 0 { 0.0 } else { shifted[0].max(shifted[1]) };
        let half = trig::hypot(0.5 * (to - from), hidden);
        [(point[1] - half).max(0.0), point[1] + half]
    };
    let value = |back: Back| match back {
        Back::Share(x) | Back::Slope(x) => x,
    };
    let friction = contact.friction(record, impactor).and_then(Result::ok);
    Certainty {
        force_n: law.points.iter().enumerate().map(force).collect(),
        back: law.back.map(|back| around(value(back), &|made| made.back, &|_| None).map(|x| x.max(0.0))),
        friction: friction.map(|f| around(f, &|made| made.friction, &|_| None).map(|x| x.max(0.0))),
    }
}

/// Depth at which the force is no larger than the noise: contact may have begun earlier or later by that much, m.
fn hidden(law: &Law, contact: &Contact) -> f64 {
    let level = contact.series.floor_n / contact::FLOOR[0];
    let steps = 1000;
    let depths = (0..=steps).map(|i| contact.greatest_m() * f64::from(i) / f64::from(steps));
    depths.into_iter().find(|depth| law.loading(*depth) >= level).unwrap_or(0.0)
}

/// Fit of a synthetic record.
struct Made {
    force_n: Vec<f64>,
    back: Option<f64>,
    friction: Option<f64>,
}

fn again(
    record: &Record,
    impactor: &Impactor,
    contact: &Contact,
    (shape, law): (&Shape, &Law),
    number: u64,
) -> Option<Made> {
    let from = contact.series.time_s.partition_point(|t| *t <= contact.time_s[0]);
    let own = law.along(&contact.depth_m[1..]);
    let count = if law.back.is_some() { own.len() } else { contact.turn };
    let points = shape.len() + usize::from(law.back.is_some());
    let larger = (count as f64 / (count.saturating_sub(points).max(1)) as f64).sqrt();
    let off: Vec<f64> = own.iter().zip(&contact.force_n[1..]).take(count).map(|(a, b)| larger * (b - a)).collect();
    let noise = shuffled(&off, contact.series.force_n.len(), number, 0);
    let mut series = (*contact.series).clone();
    for (i, force) in series.force_n.iter_mut().enumerate() {
        let quiet = if i < from || i >= from + count { 0.0 } else { own[i - from] };
        *force = quiet + noise[i];
    }
    let speed = |speed: f64| speed + impactor.speed_error_m_s / WIDE * normal_quantile(of_resample(number, 0));
    let other = Impactor { speed_m_s: impactor.speed_m_s.map(speed), ..*impactor };
    let mut made = Contact::from(&Arc::new(series), &other, contact.time_s[0]);
    curve::restart(&mut made, &other, shape);
    let again = curve::law(shape, &made);
    let works = made.works();
    let back = law.back.map(|back| match back {
        Back::Share(_) => works[1] / works[0],
        Back::Slope(_) => 0.5 * again.points.last().map_or(0.0, |p| p[1]).powi(2) / works[1],
    });
    let friction = rubbed(record, &other, &made, number);
    let force_n: Vec<f64> = law.points.iter().map(|point| again.loading(point[0])).collect();
    force_n.iter().all(|f| f.is_finite()).then_some(Made { force_n, back, friction })
}

/// Friction from a record with permuted tangential noise.
fn rubbed(record: &Record, impactor: &Impactor, contact: &Contact, number: u64) -> Option<f64> {
    let own = record.tangential_n.as_ref()?;
    let friction = contact.friction(record, impactor)?.ok()?;
    let sign = own.iter().sum::<f64>().signum();
    let smooth: Vec<f64> = contact.series.force_n.iter().map(|normal| sign * friction * normal).collect();
    let from = contact.series.begin;
    let until = (from + contact.time_s.len()).min(own.len());
    let off: Vec<f64> = own[from..until].iter().zip(&smooth[from..until]).map(|(a, b)| a - b).collect();
    let noise = shuffled(&off, own.len(), number, 1);
    let tangential_n = smooth.iter().zip(noise).map(|(a, b)| a + b).collect();
    contact.friction(&Record { tangential_n: Some(tangential_n), ..record.clone() }, impactor)?.ok()
}

/// Residual blocks in another order, `count` values in total.
fn shuffled(off: &[f64], count: usize, number: u64, of: u32) -> Vec<f64> {
    if off.is_empty() {
        return vec![0.0; count];
    }
    let remembers = off.len() as f64 / unrelated_samples(off).max(1.0);
    let block = (2.0 * remembers).ceil().clamp(1.0, off.len() as f64) as usize;
    let start = |i: usize| (of_resample(number, 2 * (i / block) as u32 + 2 + of) * off.len() as f64) as usize;
    (0..count).map(|i| off[(start(i) + i % block) % off.len()]).collect()
}
