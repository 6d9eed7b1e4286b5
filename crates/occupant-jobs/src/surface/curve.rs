//! The loading curve: straight lines through as many depths as the record bears.

use super::contact::Contact;
use super::law::{Back, Law};
use super::{Impactor, refuse};
use crate::base::Failure;

/// Lines that a curve has at most.
const MOST: usize = 12;
/// Places at which a line may end.
const PLACES: usize = 48;
/// Samples of each line at least.
const EACH: usize = 3;
/// Differences below this part of the peak are no differences.
const FINEST: f64 = 2e-4;
/// Starts within a sample.
const STARTS: usize = 12;
/// A curve falls if it loses this part of the peak.
const FALLS: f64 = 0.05;

/// Ends of the lines, as parts of the greatest depth; the last is 1.
pub(super) type Shape = Vec<f64>;

/// The shape that the record bears, and the contact with the start that fits it best.
///
/// # Errors
/// Too few samples while the depth grows.
pub(super) fn shape(impactor: &Impactor, contact: &mut Contact) -> Result<Shape, Failure> {
    if contact.turn < EACH {
        return Err(refuse("too few samples while the depth grows", "give a record with a higher rate"));
    }
    let mut shape = vec![0.25, 0.5, 0.75, 1.0];
    for _ in 0..3 {
        restart(contact, impactor, &shape);
        shape = grown(contact);
    }
    restart(contact, impactor, &shape);
    Ok(shape)
}

/// Moves the start to where straight lines of this shape fit best: by whole samples as far back as contact lasts, then by parts
/// of one.
pub(super) fn restart(contact: &mut Contact, impactor: &Impactor, shape: &Shape) {
    let series = contact.series.clone();
    let (times, begin) = (&series.time_s, series.begin);
    let back = begin.saturating_sub(contact.turn + STARTS);
    let better = |best: &mut Option<(f64, Contact)>, start: f64| {
        let one = Contact::from(&series, impactor, start);
        let cost = cost(&one, shape, back);
        if one.turn >= EACH && best.as_ref().is_none_or(|(least, _)| cost < *least) {
            *best = Some((cost, one));
        }
    };
    let mut best = None;
    times[back..begin.max(1)].iter().for_each(|start| better(&mut best, *start));
    let Some(middle) = best.as_ref().map(|(_, one)| one.time_s[0]) else { return };
    let step = (times[begin] - times[back]) / (begin - back).max(1) as f64 / STARTS as f64;
    for i in 1..STARTS {
        for way in [-1.0, 1.0] {
            let start = middle + way * i as f64 * step;
            if start >= times[0] && start < times[begin] {
                better(&mut best, start);
            }
        }
    }
    if let Some((_, one)) = best {
        let caveats = std::mem::take(&mut contact.caveats);
        *contact = Contact { caveats, ..one };
    }
}

/// Sum of squares about the lines of the samples from one on, those before contact included, in which there is no force.
fn cost(contact: &Contact, shape: &Shape, from: usize) -> f64 {
    let series = &contact.series;
    let early = series.time_s[from..].iter().zip(&series.force_n[from..]).take_while(|(t, _)| **t <= contact.time_s[0]);
    early.map(|(_, force)| force * force).sum::<f64>() + squares(contact, shape)
}

/// Samples while the depth grows, without the start.
fn rows(contact: &Contact) -> impl Iterator<Item = [f64; 2]> + '_ {
    (1..=contact.turn).map(|i| [contact.depth_m[i], contact.force_n[i]])
}

/// Forces at the ends of the lines, by least squares: every sample lies between two of them.
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

/// The line in which a part of the depth lies, and how far along it.
fn place(shape: &Shape, part: f64) -> (usize, f64) {
    let at = shape.partition_point(|end| *end < part).min(shape.len() - 1);
    let from = if at == 0 { 0.0 } else { shape[at - 1] };
    (at, (part - from) / (shape[at] - from))
}

/// Sum of squares about the best lines.
fn squares(contact: &Contact, shape: &Shape) -> f64 {
    let force = forces(contact, shape);
    let off = |[depth, measured]: [f64; 2]| {
        let (at, share) = place(shape, depth / contact.greatest_m());
        let from = if at == 0 { 0.0 } else { force[at - 1] };
        (from + share * (force[at] - from) - measured).powi(2)
    };
    rows(contact).map(off).sum()
}

/// Lines are divided as long as that is worth it by the criterion of Schwarz.
fn grown(contact: &Contact) -> Shape {
    let n = contact.turn as f64;
    let finest = n * (FINEST * contact.peak_n()).powi(2);
    let worth = |shape: &Shape| n * (squares(contact, shape).max(finest) / n).ln() + 2.0 * shape.len() as f64 * n.ln();
    let mut best = vec![1.0];
    while best.len() < MOST {
        let tried = (1..PLACES).map(|i| with(&best, i as f64 / PLACES as f64)).filter(|shape| bears(contact, shape));
        let Some(next) = least(tried, |shape| squares(contact, shape)) else { break };
        let next = moved(contact, next);
        if worth(&next) >= worth(&best) {
            break;
        }
        best = next;
    }
    best
}

/// The shape with an end more.
fn with(shape: &Shape, end: f64) -> Shape {
    let mut more = shape.clone();
    more.insert(shape.partition_point(|own| *own < end), end);
    more
}

/// Whether every line has samples.
fn bears(contact: &Contact, shape: &Shape) -> bool {
    let mut counts = vec![0; shape.len()];
    rows(contact).for_each(|[depth, _]| counts[place(shape, depth / contact.greatest_m()).0] += 1);
    counts.iter().all(|count| *count >= EACH)
}

/// The shape with each end moved to where it fits best.
fn moved(contact: &Contact, mut shape: Shape) -> Shape {
    let mut step = 0.5 / PLACES as f64;
    for _ in 0..4 {
        for i in 0..shape.len() - 1 {
            let by = |way: f64| {
                let mut other = shape.clone();
                other[i] += way * step;
                other
            };
            let rises = |shape: &Shape| shape[0] > 0.0 && shape.windows(2).all(|ends| ends[0] < ends[1]);
            let tried = [0.0, -1.0, 1.0].map(by).into_iter().filter(|other| rises(other) && bears(contact, other));
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

/// The law of this shape that fits best.
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

/// Forces that do not fall: those that do are drawn together to their mean.
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

/// The way back that returns the work that came back: by a share or by a slope, whichever is nearer to the samples.
fn back(law: &Law, contact: &Contact, falls: bool) -> Back {
    let [taken, returned] = contact.works();
    let share = Back::Share((returned / taken).clamp(0.01, 1.0));
    let top = law.points.last().map_or(0.0, |point| point[1]);
    let slope = 0.5 * top * top / returned.max(1e-3 * taken);
    let steepest = law.steepest();
    if falls {
        return Back::Slope(slope.max(1.001 * steepest));
    }
    if slope < 1.001 * steepest {
        return share;
    }
    let off = |back: Back| {
        let law = Law { back: Some(back), ..law.clone() };
        let own = law.along(&contact.depth_m);
        let after = own.iter().zip(&contact.force_n).skip(contact.turn);
        after.map(|(a, b)| (a - b).powi(2)).sum::<f64>()
    };
    // of equals the one that needs no second number
    if off(Back::Slope(slope)) < 0.8 * off(share) { Back::Slope(slope) } else { share }
}
