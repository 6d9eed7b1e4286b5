//! The loading curve: straight lines through as many depths as the record bears.

use super::contact::Contact;
use super::law::{Law, back};
use super::{Impactor, refuse};
use crate::base::Failure;
use occupant_units::trig;

/// Largest number of lines of a curve.
const MOST: usize = 12;
/// Number of candidate positions for the end of a line.
const PLACES: usize = 32;
/// Shortest line, relative to the greatest depth.
const NARROWEST: f64 = 0.02;
/// Least number of samples per line.
const EACH: usize = 3;
/// Negligible difference, relative to the peak.
const FINEST: f64 = 2e-4;
/// Samples before the threshold in which contact may have begun.
const NEAR: usize = 4;
/// Accuracy of the start, in samples.
const FINE: f64 = 0.05;
/// Difference of the criterion below which shapes are nearly as good.
const RIVAL: f64 = 14.0;
/// Number of starts tried at once.
const TRIED: usize = 12;
/// First slope, relative to the mean slope, below which the first line is a gap.
const GAP: f64 = 0.05;
/// Relative drop from which a curve counts as falling.
const FALLS: f64 = 0.05;

/// Ends of the lines, relative to the greatest depth; the last is 1.
pub(super) type Shape = Vec<f64>;

/// A shape and the contact whose start fits it best.
#[derive(Clone)]
pub(super) struct Choice {
    worth: f64,
    pub(super) shape: Shape,
    pub(super) contact: Contact,
}

/// The shape best supported by the record, and others nearly as good, each with its start.
///
/// # Errors
/// Too few samples while the depth grows.
pub(super) fn choices(impactor: &Impactor, contact: &Contact) -> Result<Vec<Choice>, Failure> {
    let (series, from) = (&contact.series, earliest(contact));
    // far back, and close to where the force is sure
    let mut best: Vec<Option<Choice>> = vec![None; MOST + 1];
    for from in [from, series.begin.saturating_sub(NEAR)] {
        let found = searched(impactor, contact, from);
        found.into_iter().flatten().for_each(|choice| keep(&mut best, choice));
    }
    let Some(first) = first_of(&best).cloned() else {
        return Err(refuse("no line fits the record while the depth grows", "give a record with a higher rate"));
    };
    let caveats = contact.caveats.clone();
    let mut all: Vec<Choice> = best.into_iter().flatten().filter(|other| other.worth < first.worth + RIVAL).collect();
    all.sort_by(|a, b| a.worth.total_cmp(&b.worth));
    all.iter_mut().for_each(|choice| choice.contact.caveats.clone_from(&caveats));
    Ok(all)
}

/// The best shapes for each number of lines, with starts after a sample, by decreasing steps.
fn searched(impactor: &Impactor, contact: &Contact, from: usize) -> Vec<Option<Choice>> {
    let series = &contact.series;
    let times = &series.time_s;
    let mut best: Vec<Option<Choice>> = vec![None; MOST + 1];
    let [mut low, mut high] = [times[from], times[series.begin]];
    while high > low && high - low > FINE * (times[series.begin] - times[from]) / (series.begin - from) as f64 {
        let step = (high - low) / TRIED as f64;
        for i in 0..TRIED {
            let one = Contact::from(series, impactor, low + i as f64 * step);
            if one.turn >= EACH {
                grown(&one, earliest(contact)).into_iter().for_each(|choice| keep(&mut best, choice));
            }
        }
        let middle = first_of(&best).map_or(high, |choice| choice.contact.time_s[0]);
        (low, high) = ((middle - step).max(times[from]), (middle + step).min(times[series.begin]));
    }
    best
}

fn first_of(best: &[Option<Choice>]) -> Option<&Choice> {
    best.iter().flatten().min_by(|a, b| a.worth.total_cmp(&b.worth))
}

/// Keeps the best for each number of lines; a first line without force is rejected as a gap, as contact begins with
/// force.
fn keep(best: &mut [Option<Choice>], choice: Choice) {
    let Choice { contact, shape, .. } = &choice;
    let samples = rows(contact).take_while(|[depth, _]| *depth < shape[0] * contact.greatest_m()).count().max(1);
    let sure = 2.0 * contact.series.floor_n / (samples as f64).sqrt();
    let rises = forces(contact, shape)[0] > sure.max(GAP * shape[0] * contact.peak_n());
    let own = &mut best[choice.shape.len()];
    if rises && own.as_ref().is_none_or(|least| choice.worth < least.worth) {
        *own = Some(choice);
    }
}

/// Moves the start to the best fit of this shape: by whole samples as far back as contact extends, then by fractions of
/// one.
pub(super) fn restart(contact: &mut Contact, impactor: &Impactor, shape: &Shape) {
    let series = contact.series.clone();
    let (times, from) = (&series.time_s, earliest(contact));
    let mut best: Option<(f64, Contact)> = None;
    let [mut low, mut high] = [times[from], times[series.begin]];
    while high > low && high - low > FINE * (times[series.begin] - times[from]) / (series.begin - from) as f64 {
        let step = (high - low) / TRIED as f64;
        for i in 0..TRIED {
            let one = Contact::from(&series, impactor, low + i as f64 * step);
            let cost = cost(&one, shape, from);
            if one.turn >= EACH && best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, one));
            }
        }
        let middle = best.as_ref().map_or(high, |(_, one)| one.time_s[0]);
        (low, high) = ((middle - step).max(times[from]), (middle + step).min(times[series.begin]));
    }
    if let Some((_, one)) = best {
        let caveats = std::mem::take(&mut contact.caveats);
        *contact = Contact { caveats, ..one };
    }
}

/// The earliest sample of contact.
fn earliest(contact: &Contact) -> usize {
    contact.series.begin.saturating_sub(contact.turn + 2)
}

/// Residual sum of squares from a sample on, including samples before contact, which have no force.
fn cost(contact: &Contact, shape: &Shape, from: usize) -> f64 {
    let series = &contact.series;
    let early = series.time_s[from..].iter().zip(&series.force_n[from..]).take_while(|(t, _)| **t <= contact.time_s[0]);
    early.map(|(_, force)| force * force).sum::<f64>() + squares(contact, shape)
}

/// Samples while the depth grows, without the start.
fn rows(contact: &Contact) -> impl Iterator<Item = [f64; 2]> + '_ {
    (1..=contact.turn).map(|i| [contact.depth_m[i], contact.force_n[i]])
}

/// Least-squares forces at the ends of the lines.
pub(super) fn forces(contact: &Contact, shape: &Shape) -> Vec<f64> {
    let n = shape.len();
    let (mut diagonal, mut beside, mut right) = (vec![1e-12; n], vec![0.0; n], vec![0.0; n]);
    for [depth, force] in rows(contact) {
        let (at, share) = place(shape, depth / contact.greatest_m());
        diagonal[at] += share * share;
        right[at] += share * force;
        if at > 0 {
            diagonal[at - 1] += (1.0 - share).powi(2);
            beside[at] += share * (1.0 - share);
            right[at - 1] += (1.0 - share) * force;
        }
    }
    for i in 1..n {
        let factor = beside[i] / diagonal[i - 1];
        diagonal[i] -= factor * beside[i];
        right[i] -= factor * right[i - 1];
    }
    for i in (0..n).rev() {
        let above = if i + 1 < n { beside[i + 1] * right[i + 1] } else { 0.0 };
        right[i] = (right[i] - above) / diagonal[i];
    }
    right
}

/// Index of the line at a relative depth, and the position along it.
fn place(shape: &Shape, part: f64) -> (usize, f64) {
    let at = shape.partition_point(|end| *end < part).min(shape.len() - 1);
    let from = if at == 0 { 0.0 } else { shape[at - 1] };
    (at, (part - from) / (shape[at] - from))
}

/// Residual sum of squares of the best lines.
fn squares(contact: &Contact, shape: &Shape) -> f64 {
    let force = forces(contact, shape);
    let off = |[depth, measured]: [f64; 2]| {
        let (at, share) = place(shape, depth / contact.greatest_m());
        let from = if at == 0 { 0.0 } else { force[at - 1] };
        (from + share * (force[at] - from) - measured).powi(2)
    };
    rows(contact).map(off).sum()
}

/// Schwarz criterion of a shape, lower is better, from a sample on.
fn worth(contact: &Contact, shape: &Shape, from: usize) -> f64 {
    let before = contact.series.time_s[from..].iter().take_while(|t| **t <= contact.time_s[0]).count();
    let n = (before + contact.turn) as f64;
    let finest = n * (FINEST * contact.peak_n()).powi(2);
    n * trig::ln(cost(contact, shape, from).max(finest) / n) + 2.0 * shape.len() as f64 * trig::ln(n)
}

/// Divides lines while the criterion improves, and once more.
fn grown(contact: &Contact, from: usize) -> Vec<Choice> {
    let choice = |shape: Shape| Choice { worth: worth(contact, &shape, from), shape, contact: contact.clone() };
    let mut all = vec![choice(vec![1.0])];
    while all.len() < MOST {
        let last = &all[all.len() - 1];
        let tried = (1..PLACES).map(|i| with(&last.shape, i as f64 / PLACES as f64));
        let next = least(tried.filter(|shape| bears(contact, shape)), |shape| squares(contact, shape));
        let Some(next) = next.map(|shape| choice(moved(contact, shape))) else { break };
        let ends = next.worth > last.worth;
        all.push(next);
        if ends {
            break;
        }
    }
    all
}

/// The shape with an additional end.
fn with(shape: &Shape, end: f64) -> Shape {
    let mut more = shape.clone();
    more.insert(shape.partition_point(|own| *own < end), end);
    more
}

/// Whether every line has a length and samples.
fn bears(contact: &Contact, shape: &Shape) -> bool {
    if shape[0] < NARROWEST || shape.windows(2).any(|ends| ends[1] - ends[0] < NARROWEST) {
        return false;
    }
    let mut counts = vec![0; shape.len()];
    rows(contact).for_each(|[depth, _]| counts[place(shape, depth / contact.greatest_m()).0] += 1);
    counts.iter().all(|count| *count >= EACH)
}

/// The shape with each end moved to its best fit.
fn moved(contact: &Contact, mut shape: Shape) -> Shape {
    let mut step = 0.5 / PLACES as f64;
    for _ in 0..4 {
        for i in 0..shape.len() - 1 {
            let by = |way: f64| {
                let mut other = shape.clone();
                other[i] += way * step;
                other
            };
            let tried = [0.0, -1.0, 1.0].map(by).into_iter().filter(|other| bears(contact, other));
            shape = least(tried, |other| squares(contact, other)).unwrap_or_else(|| shape.clone());
        }
        step *= 0.5;
    }
    shape
}

fn least(shapes: impl Iterator<Item = Shape>, cost: impl Fn(&Shape) -> f64) -> Option<Shape> {
    let all = shapes.map(|shape| (cost(&shape), shape));
    all.fold(None, |best: Option<(f64, Shape)>, (cost, shape)| match best {
        Some((least, _)) if least <= cost => best,
        _ => Some((cost, shape)),
    })
    .map(|(_, shape)| shape)
}

/// The best law of this shape.
pub(super) fn law(shape: &Shape, contact: &Contact) -> Law {
    let force = forces(contact, shape);
    let peak = contact.peak_n();
    let falls = force.windows(2).any(|pair| pair[0] - pair[1] > FALLS * peak);
    let force = if falls { force.iter().map(|f| f.max(0.0)).collect() } else { level(force) };
    let points = shape.iter().zip(force).map(|(part, force)| [part * contact.greatest_m(), force]);
    let mut law = Law { points: std::iter::once([0.0, 0.0]).chain(points).collect(), back: None };
    law.back = contact.rebounds.then(|| back(&law, contact, falls));
    law
}

/// Monotone forces: falling ones are pooled to their mean.
fn level(force: Vec<f64>) -> Vec<f64> {
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for f in force {
        pools.push((f.max(0.0), 1));
        while let [.., (a, m), (b, n)] = pools[..] {
            if a <= b {
                break;
            }
            pools.truncate(pools.len() - 2);
            pools.push(((a * m as f64 + b * n as f64) / (m + n) as f64, m + n));
        }
    }
    pools.into_iter().flat_map(|(f, n)| std::iter::repeat_n(f, n)).collect()
}
