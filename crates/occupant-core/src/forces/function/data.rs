//! Force functions as data, and their checks.

use serde::{Deserialize, Serialize};

use super::cubic::Cubic;
use crate::forces::spring::LEAST_FRACTION;
use placed_text::Problems;

/// Loading curve f from (0, 0), and the fraction of its work that is returned.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Deformation and force (N).
    pub points: Vec<[f64; 2]>,
    /// μ of each interval, 0 to 1.
    pub returned: Vec<f64>,
    /// Interpolation between points.
    pub shape: Shape,
    /// Extrapolation beyond the last point.
    pub beyond: Beyond,
}

/// Interpolation of a curve between its points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "schema", schemars(rename = "ShapeChoice"))]
pub enum Shape {
    /// Straight lines.
    #[default]
    Lines,
    /// Smooth and monotone between points.
    Monotone,
    /// c₁x + c₂x² + c₃x³ from the first point to the last.
    #[serde(skip)]
    Polynomial([f64; 3]),
}

/// Extrapolation of a curve beyond its last point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "schema", schemars(rename = "BeyondChoice"))]
pub enum Beyond {
    /// Continues with its last slope.
    #[default]
    Extends,
    /// Keeps its last force.
    Holds,
    /// Ends the run: nothing is known beyond.
    Limits,
}

/// Force over depth of contact, with all effects that it may depend on.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceDeflection {
    /// f; its returned fractions count with [`Unloading::Stretch`].
    pub loading: Function,
    /// Unloading.
    pub unloading: Unloading,
    /// s, a force of the first loading that breaks down: from (0, 0) to force 0; empty if there is none.
    pub spike: Vec<[f64; 2]>,
    /// Factor c over the speed of deformation, m/s; empty: 1.
    pub rate: Vec<[f64; 2]>,
    /// Damping C, N·s/m, and the depth from which it acts fully, m.
    pub viscous: Option<[f64; 2]>,
}

/// Unloading path of the force.
#[derive(Clone, Debug, PartialEq)]
pub enum Unloading {
    /// Each interval by its returned fraction.
    Stretch,
    /// With slope K, N/m, down to a curve g; empty: 0.
    Slope {
        /// K.
        n_per_m: f64,
        /// Points of g.
        least: Vec<[f64; 2]>,
    },
    /// Quadratic of the ATB program.
    Quadratic {
        /// Returned fraction R over the largest deformation; one row: constant.
        returned: Vec<[f64; 2]>,
        /// Permanent set G as a fraction of the largest deformation, over that deformation.
        set: Vec<[f64; 2]>,
    },
}

/// Required shape of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Goes {
    /// Rises in every interval.
    Up,
    /// Falls in no interval, rises in the first.
    NotDown,
    /// Falls in no interval and rises in at least one: the first may be a gap without force.
    NotDownFromGap,
    /// Any shape above 0.
    Anywhere,
}

impl Function {
    /// Straight lines with one returned fraction.
    pub fn lines(points: Vec<[f64; 2]>, returned: f64) -> Self {
        let returned = vec![returned; points.len().saturating_sub(1)];
        Function { points, returned, shape: Shape::Lines, beyond: Beyond::Extends }
    }

    /// Yield point: the first beyond which the slope is at most a quarter of that before.
    pub(crate) fn yields(&self) -> Option<[f64; 2]> {
        let mut steepest = 0.0_f64;
        for (from, to) in self.points.iter().zip(self.points.iter().skip(1)) {
            let slope = (to[1] - from[1]) / (to[0] - from[0]);
            if steepest > 0.0 && slope <= 0.25 * steepest {
                return Some(*from);
            }
            steepest = steepest.max(slope);
        }
        self.points.last().copied().filter(|_| self.beyond == Beyond::Holds)
    }

    /// Cubics of the curve, each with its returned fraction.
    pub(super) fn pieces(&self) -> impl Iterator<Item = (Cubic<f64>, f64)> {
        let mut cubics = match self.shape {
            Shape::Lines => Cubic::lines(&self.points),
            Shape::Monotone => Cubic::monotone(&self.points),
            Shape::Polynomial([c1, c2, c3]) => vec![Cubic { from: 0.0, c: [0.0, c1, c2, c3] }],
        };
        if let (Some(end), Some(last)) = (self.points.last(), cubics.last()) {
            match (self.beyond, self.shape) {
                (Beyond::Holds, _) => cubics.push(Cubic::line(*end, 0.0)),
                (_, Shape::Lines) => {}
                _ => cubics.push(Cubic::line(*end, last.slope(end[0]))),
            }
        }
        let last = self.returned.last().copied().unwrap_or(1.0);
        let shares = self.returned.clone().into_iter().chain(std::iter::repeat(last));
        cubics.into_iter().zip(shares)
    }

    /// c₁x + c₂x² + c₃x³ up to a deformation, with one returned fraction.
    pub fn polynomial(c: [f64; 3], end: f64, returned: f64) -> Self {
        let force = ((c[2] * end + c[1]) * end + c[0]) * end;
        Function { shape: Shape::Polynomial(c), ..Function::lines(vec![[0.0; 2], [end, force]], returned) }
    }

    /// Function with all forces multiplied by `share`.
    pub(crate) fn times(&self, share: f64) -> Self {
        let shape = match self.shape {
            Shape::Polynomial(c) => Shape::Polynomial(c.map(|c| share * c)),
            shape => shape,
        };
        let points = self.points.iter().map(|[x, force]| [*x, share * force]).collect();
        Function { points, shape, ..self.clone() }
    }

    /// x of the last point.
    pub fn end(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point[0])
    }

    /// Largest force within its points, N.
    pub(crate) fn greatest_n(&self) -> f64 {
        self.points.iter().fold(0.0, |most, point| most.max(point[1]))
    }

    /// The largest slope between its points.
    pub(crate) fn steepest_loading(&self) -> f64 {
        self.slopes().fold(0.0, |most: f64, (slope, _)| most.max(slope))
    }

    /// The largest slope of loading and unloading.
    pub(crate) fn steepest(&self) -> f64 {
        self.slopes().fold(0.0, |most: f64, (slope, mu)| most.max(slope / mu.max(LEAST_FRACTION)))
    }

    /// The largest slope of each interval, and its μ.
    fn slopes(&self) -> impl Iterator<Item = (f64, f64)> {
        let ends = self.points.iter().skip(1);
        self.pieces().zip(ends).map(|((cubic, mu), end)| (cubic.slopes(end[0])[1], mu))
    }

    /// Reports problems of it; `falls`: how to mend a force that falls.
    pub(crate) fn check(&self, path: &str, goes: Goes, falls: &str, problems: &mut Problems) {
        check_points(&self.points, path, goes, falls, problems);
        if let (Shape::Polynomial(_), Some((cubic, _))) = (self.shape, self.pieces().next()) {
            let lowest = (0..=PLACES).map(|i| cubic.value(self.end() * f64::from(i) / f64::from(PLACES)));
            if goes != Goes::Anywhere && cubic.slopes(self.end())[0] < 0.0 || lowest.fold(0.0, f64::min) < 0.0 {
                problems.error(path, "a polynomial that falls before its end, or below 0", falls);
            }
        }
        let path = format!("{path}.returned");
        if self.returned.len() + 1 != self.points.len() || self.returned.iter().any(|mu| !(0.0..=1.0).contains(mu)) {
            problems.error(path, "other numbers", "one number, or one for each interval, from 0 to 1");
        } else if let Some(mu) = self.returned.iter().find(|mu| **mu < LEAST_FRACTION) {
            let found = format!("{mu}, which counts as {LEAST_FRACTION}");
            problems.warning(path, found, "at least 0.01: unloading needs some slope");
        }
    }
}

/// Places in which a curve is looked at.
pub(super) const PLACES: u32 = 200;

/// Reports problems of points of a curve.
pub(super) fn check_points(points: &[[f64; 2]], path: &str, goes: Goes, falls: &str, problems: &mut Problems) {
    if points.len() < 2 || points[0] != [0.0, 0.0] {
        problems.error(path, format!("{} points, the first not (0, 0)", points.len()), "(0, 0) and at least one more");
    }
    for (i, pair) in points.windows(2).enumerate() {
        let ([x, force], [next_x, next_force]) = (pair[0], pair[1]);
        if !(next_x > x && next_x.is_finite()) {
            problems.error(path, format!("{next_x} after {x}"), "deformations that rise from point to point");
        }
        let is_right = match goes {
            Goes::Up => next_force > force,
            Goes::NotDown => next_force > force || next_force == force && i > 0,
            Goes::NotDownFromGap => next_force >= force,
            Goes::Anywhere => next_force >= 0.0,
        };
        if !(is_right && next_force.is_finite()) {
            problems.error(path, format!("a force of {next_force} N after {force} N"), falls);
        }
    }
    if goes == Goes::NotDownFromGap && points.iter().all(|[_, force]| *force == 0.0) {
        problems.error(path, "no force at any point", "a force above 0 behind the gap");
    }
}
