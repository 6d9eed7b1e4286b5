//! Linear constraints between parameters: the points of a study that they leave out, and the nearest point that they do not.
//!
//! A point is judged by its own values alone, so it has its number and its place whatever becomes of the others: a design with
//! constraints is cut into parts, and extended, as one without.

use super::law::Bounds;

/// A constraint: least ≤ Σ factor · value ≤ most, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Relation {
    /// Its name.
    pub name: String,
    /// Indices of parameters with their factors, none of them 0.
    pub terms: Vec<(usize, f64)>,
    /// Least sum; −∞ without one.
    pub least: f64,
    /// Largest sum; ∞ without one.
    pub most: f64,
    /// SI unit of the sum; empty for plain numbers.
    pub unit: &'static str,
}

/// What counts as rounding, as a part of the sum of all magnitudes.
const ROUNDING: f64 = 1e-9;
/// Rounds in search of the nearest point, and of a first one.
const ROUNDS: usize = 500;
const FIRST_ROUNDS: usize = 20_000;

impl Relation {
    fn sum(&self, values: &[f64]) -> f64 {
        self.terms.iter().map(|(i, factor)| factor * values[*i]).sum()
    }

    /// In words, if it is broken by these values of all parameters, more than by rounding.
    pub fn broken(&self, values: &[f64]) -> Option<String> {
        let sum = self.sum(values);
        let rounding = ROUNDING * self.terms.iter().map(|(i, factor)| (factor * values[*i]).abs()).sum::<f64>();
        let (side, limit) = match sum {
            _ if sum < self.least - rounding => ("below", self.least),
            _ if sum > self.most + rounding => ("above", self.most),
            _ => return None,
        };
        Some(format!("the sum of constraint `{}` is {side} {limit} {}", self.name, self.unit).trim_end().to_owned())
    }
}

/// The points between the bounds of parameters that keep all constraints.
#[derive(Clone, Debug)]
pub struct Within {
    relations: Vec<Relation>,
    bounds: Vec<Bounds>,
    /// One of them, in parts of the ranges.
    first: Vec<f64>,
}

impl Within {
    /// The points of these bounds, which may be of further parameters; none if there is no point.
    pub fn new(relations: &[Relation], bounds: &[Bounds]) -> Option<Within> {
        let middle = vec![0.5; bounds.len()];
        let all = Within { relations: relations.to_vec(), bounds: bounds.to_vec(), first: middle };
        let first = all.approach(all.first.clone(), FIRST_ROUNDS);
        all.keeps(&first).then_some(Within { first, ..all })
    }

    /// The nearest of the points to these values, as seen in parts of the ranges; the values themselves if they are one.
    pub fn nearest(&self, values: &[f64]) -> Vec<f64> {
        if self.relations.iter().all(|relation| relation.broken(values).is_none()) {
            return values.to_vec();
        }
        let near = self.approach(self.parts(values), ROUNDS);
        // on the line from a point that keeps all, halved until its end does too
        let mut part = 1.0;
        let along = |part: f64| self.first.iter().zip(&near).map(|(a, b)| a + part * (b - a)).collect::<Vec<_>>();
        while !self.keeps(&along(part)) && part > ROUNDING {
            part *= 0.5;
        }
        self.values(&if part > ROUNDING { along(part) } else { self.first.clone() })
    }

    /// Distance of values from the nearest of the points, in parts of the ranges.
    pub fn apart(&self, values: &[f64]) -> f64 {
        let (here, there) = (self.parts(values), self.parts(&self.nearest(values)));
        here.iter().zip(there).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    }

    /// The constraints that values break, or meet but for this distance in parts of the ranges.
    pub fn met(&self, values: &[f64], near: f64) -> impl Iterator<Item = &Relation> {
        let is_met = move |relation: &&Relation| {
            let square: f64 = self.slopes(relation).map(|(_, slope)| slope * slope).sum();
            let (sum, reach) = (relation.sum(values), near * square.sqrt());
            sum > relation.most - reach || sum < relation.least + reach
        };
        self.relations.iter().filter(is_met)
    }

    /// Indices of the parameters of a constraint, with the change of its sum across all of their ranges.
    fn slopes(&self, relation: &Relation) -> impl Iterator<Item = (usize, f64)> {
        relation.terms.iter().map(|(i, factor)| (*i, factor * (self.bounds[*i].to - self.bounds[*i].from)))
    }

    fn values(&self, parts: &[f64]) -> Vec<f64> {
        let value = |(bounds, part): (&Bounds, &f64)| Bounds { log: false, ..*bounds }.value(*part);
        self.bounds.iter().zip(parts).map(value).collect()
    }

    fn parts(&self, values: &[f64]) -> Vec<f64> {
        // of a range without length there is one part
        let part = |(bounds, value): (&Bounds, &f64)| match bounds.to > bounds.from {
            true => Bounds { log: false, ..*bounds }.part(*value),
            false => 0.5,
        };
        self.bounds.iter().zip(values).map(part).collect()
    }

    fn keeps(&self, parts: &[f64]) -> bool {
        let values = self.values(parts);
        self.relations.iter().all(|relation| relation.broken(&values).is_none())
    }

    /// Projects on each constraint and on the bounds in turn (R. L. Dykstra, Journal of the American Statistical Association 78,
    /// 1983), until all are kept and nothing moves.
    fn approach(&self, start: Vec<f64>, rounds: usize) -> Vec<f64> {
        let mut x = start;
        let mut moved = vec![vec![0.0; x.len()]; self.relations.len() + 1];
        for _ in 0..rounds {
            let before = x.clone();
            for (k, moved) in moved.iter_mut().enumerate() {
                let from: Vec<f64> = x.iter().zip(&*moved).map(|(x, moved)| x + moved).collect();
                x = match self.relations.get(k) {
                    Some(relation) => self.onto(relation, &from),
                    None => from.iter().map(|u| u.clamp(0.0, 1.0)).collect(),
                };
                moved.iter_mut().zip(from.iter().zip(&x)).for_each(|(moved, (from, x))| *moved = from - x);
            }
            let step = x.iter().zip(before).map(|(now, before)| (now - before).abs()).fold(0.0, f64::max);
            if step < 1e-12 && self.keeps(&x) {
                break;
            }
        }
        x
    }

    /// The nearest point that keeps a constraint, whatever the bounds.
    fn onto(&self, relation: &Relation, parts: &[f64]) -> Vec<f64> {
        let slopes: Vec<(usize, f64)> = self.slopes(relation).collect();
        let square: f64 = slopes.iter().map(|(_, slope)| slope * slope).sum();
        let sum = relation.sum(&self.values(parts));
        let beyond = (sum - relation.most).max(0.0) + (sum - relation.least).min(0.0);
        let mut parts = parts.to_vec();
        if beyond != 0.0 && square > 0.0 {
            slopes.iter().for_each(|(i, slope)| parts[*i] -= beyond * slope / square);
        }
        parts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn relation(terms: &[(usize, f64)], least: f64, most: f64) -> Relation {
        Relation { name: "r".to_owned(), terms: terms.to_vec(), least, most, unit: "N" }
    }

    fn bounds(ends: &[[f64; 2]]) -> Vec<Bounds> {
        ends.iter().map(|[from, to]| Bounds { from: *from, to: *to, log: false }).collect()
    }

    #[test]
    fn what_breaks_a_constraint_is_told_and_rounding_does_not() {
        let r = relation(&[(0, 1.0), (1, -1.0)], 0.0, 5.0);
        assert_eq!(r.broken(&[1.0, 2.0]).as_deref(), Some("the sum of constraint `r` is below 0 N"));
        assert_eq!(r.broken(&[9.0, 2.0]).as_deref(), Some("the sum of constraint `r` is above 5 N"));
        for kept in [[2.0, 2.0], [0.1 + 0.2, 0.3], [0.3, 0.1 + 0.2], [7.0, 2.0]] {
            assert_eq!(r.broken(&kept), None, "{kept:?}");
        }
    }

    /// In a square: half of it, a corner, a strip, and a point with ranges of different lengths.
    #[test]
    fn the_nearest_point_is_that_of_plane_geometry() {
        let unit = bounds(&[[0.0, 1.0], [0.0, 1.0]]);
        let half = Within::new(&[relation(&[(0, 1.0), (1, 1.0)], f64::NEG_INFINITY, 1.0)], &unit).unwrap();
        let near = |within: &Within, from: [f64; 2], to: [f64; 2]| {
            let found = within.nearest(&from);
            let off = found.iter().zip(to).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-9, "{from:?}: {found:?}, not {to:?}");
        };
        near(&half, [0.3, 0.4], [0.3, 0.4]);
        near(&half, [0.8, 0.6], [0.6, 0.4]);
        near(&half, [1.0, 1.0], [0.5, 0.5]);
        assert!((half.apart(&[1.0, 1.0]) - 0.5_f64.sqrt()).abs() < 1e-9 && half.apart(&[0.1, 0.1]) == 0.0);
        // the line is 0.0707 away
        let met = |near| half.met(&[0.5, 0.4], near).count();
        assert_eq!((met(0.07), met(0.071), half.met(&[0.9, 0.9], 0.0).count()), (0, 1, 1));
        let corner = [relation(&[(0, 1.0)], 0.7, f64::INFINITY), relation(&[(0, 1.0), (1, 1.0)], -1.0, 0.8)];
        near(&Within::new(&corner, &unit).unwrap(), [0.0, 1.0], [0.7, 0.1]);
        let strip = [relation(&[(0, 1.0), (1, -1.0)], 0.0, 0.0)];
        near(&Within::new(&strip, &unit).unwrap(), [0.2, 0.6], [0.4, 0.4]);
        // as far in parts of the ranges: u + v ≤ 1 for x = 10 u
        let long = Within::new(&[relation(&[(0, 0.1), (1, 1.0)], -1.0, 1.0)], &bounds(&[[0.0, 10.0], [0.0, 1.0]]));
        near(&long.unwrap(), [8.0, 0.6], [6.0, 0.4]);
    }

    #[test]
    fn ranges_without_a_point_have_none_and_thin_ones_have() {
        let unit = bounds(&[[0.0, 1.0], [0.0, 1.0]]);
        let at_least = |least| [relation(&[(0, 1.0), (1, 1.0)], least, f64::INFINITY)];
        assert!(Within::new(&at_least(2.1), &unit).is_none());
        assert!(Within::new(&at_least(2.0), &unit).is_some(), "a corner is a point");
        // a needle: between two lines at a small angle
        let needle = [relation(&[(0, 1.0), (1, -1.0)], 0.0, 9.0), relation(&[(0, 0.99), (1, -1.0)], -9.0, 0.0)];
        let needle = Within::new(&needle, &unit).unwrap();
        for from in [[0.0, 1.0], [1.0, 0.0], [0.3, 0.2]] {
            let found = needle.nearest(&from);
            assert!(needle.keeps(&found), "{from:?}: {found:?}");
        }
    }
}
