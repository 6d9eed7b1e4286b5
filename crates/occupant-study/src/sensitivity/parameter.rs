//! Numbers that a model depends on, and the models around them.

use std::fmt;

use super::ladder::{Ladder, Side};
use super::trouble::Trouble;
use occupant_core::model::Model;
use occupant_core::model::setup::Integrator;

/// The model at a parameter value, or the reason why there is none.
pub type ModelAt<'a> = dyn Fn(f64) -> Result<Model, String> + 'a;

/// A number that a model depends on.
pub struct Parameter<'a> {
    /// Name.
    pub name: String,
    /// Its SI unit; `1` for a plain number or a factor.
    pub unit: String,
    /// Its value in the nominal model.
    pub nominal: f64,
    /// A large but plausible change: |nominal|, or for 0 one by its unit; see [`size_of`].
    pub size: f64,
    /// The models around it.
    pub model_at: Box<ModelAt<'a>>,
}

impl fmt::Debug for Parameter<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Parameter").field("name", &self.name).field("nominal", &self.nominal).finish_non_exhaustive()
    }
}

impl<'a> Parameter<'a> {
    /// The same parameter with models `made` from these, integrated or recorded differently.
    #[must_use]
    pub fn of_models(&'a self, made: impl Fn(Model) -> Model + 'a) -> Parameter<'a> {
        let model_at = move |value: f64| (self.model_at)(value).map(&made);
        let (name, unit) = (self.name.clone(), self.unit.clone());
        Parameter { name, unit, model_at: Box::new(model_at), ..*self }
    }
}

/// Longest output interval for figures that are differentiated, s.
const FINE_S: f64 = 1e-4;

/// Output interval for the derivatives of figures, s: an integer fraction of the run's own; where steps end at outputs,
/// chosen so that the run is unchanged.
pub fn fine_interval_s(model: &Model) -> f64 {
    let (own_s, setup) = (model.setup().time.output_s, model.setup());
    let Integrator::Rk4 { step_s } = setup.integrator else { return own_s / (own_s / FINE_S - 1e-9).ceil().max(1.0) };
    let steps = (own_s / step_s).round();
    if (steps * step_s - own_s).abs() > 1e-9 * own_s {
        return own_s;
    }
    let fits = |of: &f64| steps % of == 0.0 && of * step_s >= FINE_S * (1.0 - 1e-9);
    let of = (1..=steps as u32).map(f64::from).find(fits).unwrap_or(steps);
    own_s / (steps / of)
}

/// Size of a change of a parameter: its own, or for 0, 0.1 in units of length and angle, 0.01 kg·m², and 1 in any
/// other.
pub fn size_of(nominal: f64, unit: &str) -> f64 {
    match (nominal == 0.0, unit) {
        (false, _) => nominal.abs(),
        (true, "m" | "rad" | "1" | "") => 0.1,
        (true, "kg·m^2") => 0.01,
        (true, _) => 1.0,
    }
}

/// Models at the points of a ladder.
pub(super) struct Family {
    pub ladder: Ladder,
    pub models: Vec<Model>,
    /// Reason for models on one side only, if so.
    pub one_sided: Option<String>,
}

impl Family {
    /// Models at steps of `h`, with the structure and times of `base`.
    ///
    /// # Errors
    /// A value that the scenario refuses to both sides.
    pub fn new(base: &Model, parameter: &Parameter<'_>, h: f64) -> Result<Self, Trouble> {
        let refused = |reason: String| Trouble::Refused { parameter: parameter.name.clone(), reason };
        let make = |side: Side| -> Result<Family, String> {
            let ladder = Ladder::new(parameter.nominal, h, side);
            let models = ladder.points.iter().map(|p| (parameter.model_at)(*p));
            Ok(Family { models: models.collect::<Result<_, _>>()?, ladder, one_sided: None })
        };
        let family = make(Side::Both).or_else(|reason| {
            let side = make(Side::Above).or_else(|_| make(Side::Below));
            side.map(|family| Family { one_sided: Some(reason.clone()), ..family }).map_err(|_| reason)
        });
        let family = family.map_err(refused)?;
        for model in &family.models {
            compare(base, model, &parameter.name)?;
        }
        Ok(family)
    }
}

/// Whether `other` has the same structure, times and integrator as `base`.
fn compare(base: &Model, other: &Model, parameter: &str) -> Result<(), Trouble> {
    let (a, b) = (base.setup(), other.setup());
    if a.time != b.time || a.integrator != b.integrator {
        return Err(Trouble::Times { parameter: parameter.to_owned() });
    }
    let alike = base.system().zip(other.system(), |_, _| ());
    alike.map(|_| ()).map_err(|unlike| Trouble::Structure { parameter: parameter.to_owned(), unlike })
}
