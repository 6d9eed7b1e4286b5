//! `[webbings]`, `[limiters]`, and the form of force functions everywhere: two lists, and what unloading returns.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, si_or};
use super::{Force, Length, Quantity, Ratio, Time};
use occupant_core::forces::function::{Beyond, Function};

/// Returned fraction of a limiter's work: a torsion bar does not wind back.
const LIMITER_RETURNS: f64 = 0.01;

/// Webbing: tension over strain, linear between points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["returned", "returned_each"]]))]
pub(crate) struct WebbingSection {
    /// Strains, from 0.
    pub(crate) strain: Option<Vec<Ratio<NOT_NEGATIVE>>>,
    /// Tension at each.
    pub(crate) force: Option<Vec<Force<NOT_NEGATIVE>>>,
    /// Force or moment beyond the last point; "extends" if absent.
    pub(crate) beyond: Option<Beyond>,
    /// Name of a webbing of the library. Other keys override its values.
    #[schemars(extend("enum" = ["webbing_atb", "webbing_ng"]))]
    pub(crate) library: Option<String>,
    /// Fraction of its work that unloading returns; 1 if absent.
    pub(crate) returned: Option<Ratio<FRACTION>>,
    /// The same for each interval.
    pub(crate) returned_each: Option<Vec<Ratio<FRACTION>>>,
    /// Damping: a relaxing spring (Maxwell element) in parallel.
    pub(crate) viscous: Option<ViscousSection>,
}

/// A relaxing spring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ViscousSection {
    /// Tension per unit of strain.
    pub(crate) stiffness: Force<POSITIVE>,
    /// Time constant.
    pub(crate) time: Time<POSITIVE>,
}

/// A load limiter: belt force over webbing paid out. The initial rise is webbing that tightens on the spool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["returned", "returned_each"]]))]
pub(crate) struct LimiterSection {
    /// Webbing paid out, from 0.
    pub(crate) payout: Option<Vec<Length<NOT_NEGATIVE>>>,
    /// Force at each; must not fall.
    pub(crate) force: Option<Vec<Force<NOT_NEGATIVE>>>,
    /// Force or moment beyond the last point; "extends" if absent.
    pub(crate) beyond: Option<Beyond>,
    /// Name of a limiter of the library. Other keys override its values.
    #[schemars(extend("enum" = ["torsion_bar"]))]
    pub(crate) library: Option<String>,
    /// Fraction of its work that unloading returns; 0.01 if absent, as of a torsion bar.
    pub(crate) returned: Option<Ratio<FRACTION>>,
    /// The same for each interval.
    pub(crate) returned_each: Option<Vec<Ratio<FRACTION>>>,
}

impl WebbingSection {
    /// Its curve, and stiffness (N) and time (s) of its damping.
    pub(super) fn function(&self, b: &mut Builder, path: &str) -> (Function, Option<[f64; 2]>) {
        let points = points(b, path, ["strain", "force"], listed(&self.strain), listed(&self.force));
        let viscous = self.viscous.as_ref().map(|viscous| [viscous.stiffness.si(), viscous.time.si()]);
        (function(points, &self.beyond, &self.returned, &self.returned_each, 1.0), viscous)
    }
}

impl LimiterSection {
    /// Its curve.
    pub(super) fn function(&self, b: &mut Builder, path: &str) -> Function {
        let points = points(b, path, ["payout", "force"], listed(&self.payout), listed(&self.force));
        function(points, &self.beyond, &self.returned, &self.returned_each, LIMITER_RETURNS)
    }
}

/// A piecewise linear function, with one returned fraction, or one per interval.
pub(super) fn function(
    points: Vec<[f64; 2]>,
    beyond: &Option<Beyond>,
    one: &Option<Ratio<FRACTION>>,
    each: &Option<Vec<Ratio<FRACTION>>>,
    usual: f64,
) -> Function {
    let plain = Function { beyond: beyond.unwrap_or_default(), ..Function::lines(points, si_or(one, usual)) };
    match each {
        Some(each) => Function { returned: each.iter().map(Ratio::si).collect(), ..plain },
        None => plain,
    }
}

/// A list; empty if absent.
pub(super) fn listed<const KIND: usize, const RANGE: usize>(
    list: &Option<Vec<Quantity<KIND, RANGE>>>,
) -> &[Quantity<KIND, RANGE>] {
    list.as_deref().unwrap_or_default()
}

/// Points from two lists of equal length.
pub(super) fn points<const A: usize, const B: usize, const C: usize, const D: usize>(
    b: &mut Builder,
    path: &str,
    [x, y]: [&str; 2],
    xs: &[Quantity<A, B>],
    ys: &[Quantity<C, D>],
) -> Vec<[f64; 2]> {
    if xs.len() != ys.len() {
        let found = format!("{} numbers in `{x}`, {} in `{y}`", xs.len(), ys.len());
        b.error(path, found, "the same number in both");
    }
    xs.iter().zip(ys).map(|(x, y)| [x.si(), y.si()]).collect()
}
