//! Limits of figures: those of rules for the body, and those that the user gives.

use occupant_core::model::Model;
use occupant_core::results::channel::matches;
use occupant_core::results::summary::FigureLimit;
use occupant_scenario::kind::{KINDS, UnitSystem};
use occupant_units::unit::Unit;
use placed_text::{Value, nearest};

use crate::base::Failure;

/// Limits of figures.
#[derive(Clone, Debug, Default)]
pub struct Limits {
    /// Those of rules, for the bodies of the scenario.
    pub known: Vec<FigureLimit>,
    /// Those that the user gave; they come first.
    pub asked: Vec<FigureLimit>,
}

impl Limits {
    /// Limits of rules for the bodies of a model, and of the user.
    pub fn new(model: Option<&Model>, asked: Vec<FigureLimit>) -> Limits {
        Limits { known: model.map(FigureLimit::of_model).unwrap_or_default(), asked }
    }

    /// Those of a figure.
    pub fn of(&self, figure: &str) -> Vec<&FigureLimit> {
        self.asked.iter().chain(&self.known).filter(|limit| limit.figure == figure).collect()
    }
}

/// A limit such as `hic15=700` or `head_excursion.forward=650 mm` for the figures (name and unit) that its name fits.
///
/// # Errors
/// No `=`, a name that fits no figure, a number without or with a wrong unit.
pub fn parse_limit(text: &str, figures: &[(String, String)]) -> Result<Vec<FigureLimit>, Failure> {
    let refused = |found: String, help: &str| Failure::with_help(format!("--limit {text}: {found}"), help);
    let example = "give FIGURE=VALUE, such as hic15=700 or 'head_excursion.forward=650 mm'";
    let (name, value) = text.split_once('=').ok_or_else(|| refused("it has no `=`".to_owned(), example))?;
    let fitting = fitting("--limit", name.trim(), figures)?;
    let limit = |(figure, unit): &(String, String)| {
        let most = in_unit(value.trim(), unit).map_err(|(found, help)| refused(found, &help))?;
        Ok(FigureLimit { figure: figure.clone(), rule: None, dummy: None, most, quoted: true })
    };
    fitting.into_iter().map(limit).collect()
}

/// The figures (name and unit) that a name, or a pattern with stars, of this flag fits; at least one.
///
/// # Errors
/// It fits none.
pub fn fitting<'f>(
    flag: &str,
    name: &str,
    figures: &'f [(String, String)],
) -> Result<Vec<&'f (String, String)>, Failure> {
    let pieces: Vec<&str> = name.split('*').collect();
    let found: Vec<_> = figures.iter().filter(|(figure, _)| matches(figure, &pieces)).collect();
    if !found.is_empty() {
        return Ok(found);
    }
    let near = nearest(name, figures.iter().map(|(figure, _)| figure.as_str()));
    let example = "give the name of a result, such as hic15, or a pattern, such as 'head.*'".to_owned();
    let help = near.map_or(example, |near| format!("did you mean `{near}`?"));
    Err(Failure::with_help(format!("{flag} {name}: there is no such result"), &help))
}

/// A value with its unit as a number of a figure's unit; a figure with a unit needs one here.
///
/// # Errors
/// What was found, and how to mend it.
fn in_unit(text: &str, unit: &str) -> Result<f64, (String, String)> {
    let finite = |x: f64| {
        let found = "it is not a finite number".to_owned();
        if x.is_finite() { Ok(x) } else { Err((found, "give a finite number".to_owned())) }
    };
    let bare = text.parse::<f64>().ok();
    let Some((measured, si)) = Unit::measuring(unit).filter(|(measured, _)| *measured != Unit::One) else {
        let found = || (format!("`{text}` is not a number"), "this figure is a plain number".to_owned());
        return finite(bare.ok_or_else(found)?);
    };
    if bare.is_some() {
        let found = format!("`{text}` has no unit");
        return Err((found, format!("the figure is in {unit}: write the unit after the number")));
    }
    let kind = KINDS.iter().find(|kind| kind.unit == measured);
    let kind = kind.ok_or_else(|| (format!("a figure in {unit}"), "give a limit for another figure".to_owned()))?;
    let value = kind.si(&Value::String(text.to_owned()), UnitSystem::Si);
    finite(value.map_err(|e| (e.found, format!("expected {}", e.expected)))? / si)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_needs_a_known_figure_and_a_unit_that_fits() {
        let figures = [("hic15", "1"), ("head.peak", "m/s²"), ("rear.hic15", "1"), ("belts.lap.peak", "N")]
            .map(|(name, unit)| (name.to_owned(), unit.to_owned()));
        let of = |text: &str| {
            parse_limit(text, &figures).map(|l| l.into_iter().map(|l| (l.figure, l.most)).collect::<Vec<_>>())
        };
        assert_eq!(of("hic15 = 700").unwrap(), [("hic15".to_owned(), 700.0)]);
        assert_eq!(of("*hic15=700").unwrap().len(), 2);
        let g = of("head.peak=80 g").unwrap()[0].1;
        assert!((g - 80.0 * 9.80665).abs() < 1e-9, "{g}");
        assert_eq!(of("belts.lap.peak=6 kN").unwrap()[0].1, 6000.0);
        for wrong in ["hic15", "hic=700", "hic15=high", "hic15=NaN", "head.peak=80", "head.peak=80 mm", "hic15=700 N"] {
            assert!(of(wrong).is_err(), "{wrong}");
        }
    }
}
