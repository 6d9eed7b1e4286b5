//! A small study: its samples as changes of the case, and the figures of one of them. The page runs them one by one.

use occupant_core::diagnosis::FrictionWatch;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::simulate;
use occupant_files::steps;
use occupant_jobs::base::Failure;
use occupant_scenario::Format;
use occupant_study::{Study, StudyText, Value};
use serde::Serialize;

use crate::case::{Case, Opened, Refused};

/// Most runs of a study in a page.
const MOST: u64 = 500;

/// A study as the page runs it.
#[derive(Serialize)]
pub struct Planned {
    parameters: Vec<Parameter>,
    samples: Vec<Sample>,
}

#[derive(Serialize)]
struct Parameter {
    name: String,
    unit: &'static str,
}

/// One run of a study.
#[derive(Serialize)]
struct Sample {
    /// Values of the parameters, SI; none that is no number.
    values: Vec<Option<f64>>,
    /// The changes that make it.
    set: Vec<String>,
}

/// Figures of a run, as a row of the table of `occupant sweep` has them.
#[derive(Serialize)]
pub struct Measured {
    figures: Vec<Figure>,
}

#[derive(Serialize)]
struct Figure {
    name: String,
    unit: &'static str,
    value: Option<f64>,
    /// Whether a caveat applies to it.
    is_spoilt: bool,
}

/// The samples of a study of this case; its `base` is not read.
///
/// # Errors
/// All that is wrong with either; a study of more runs than a page should do.
pub fn planned(case: &Case, text: &str) -> Result<Planned, Refused> {
    let read = StudyText::read(text, Format::Toml, "study")?;
    let study = read.bind(case.draft()?, &[], &|file| case.table(file))?;
    if study.len() > MOST {
        let found = format!("a study of {} runs", study.len());
        let help = format!("a page runs at most {MOST}; use `occupant sweep` for more");
        return Err(Failure::with_help(found, &help).into());
    }
    let parameters = study.parameters.iter().map(|one| Parameter { name: one.name.clone(), unit: one.unit });
    Ok(Planned { parameters: parameters.collect(), samples: (0..study.len()).map(|i| sample(&study, i)).collect() })
}

fn sample(study: &Study, index: u64) -> Sample {
    let value = |value: &Value| match value {
        Value::Number(value) => Some(*value),
        _ => None,
    };
    Sample {
        values: study.sample(index).iter().map(|setting| value(&setting.value)).collect(),
        set: study.assignments(index).iter().map(|one| format!("{}={}", one.path, one.text())).collect(),
    }
}

/// Runs a case for its figures alone.
///
/// # Errors
/// All that is wrong with it; a run that fails.
pub fn measured(case: &Case) -> Result<Measured, Refused> {
    let Opened { model, .. } = case.open()?;
    let (mut summarizer, mut friction) = (Summarizer::new(), FrictionWatch::new());
    simulate(&model, (&mut summarizer, &mut friction)).map_err(Failure::broke_off)?;
    let mut summary = summarizer.summary(None).ok_or_else(|| Failure::plain("the run has no summary"))?;
    let more = steps::caveats(&model, &friction, &summary);
    summary.caveats.extend(more);
    let spoilt = |name: &str| summary.caveats.iter().any(|caveat| !caveat.is_note() && caveat.touches(name));
    let figure = |one: occupant_core::results::summary::Figure| Figure {
        is_spoilt: spoilt(&one.name),
        name: one.name,
        unit: one.unit,
        value: one.value,
    };
    Ok(Measured { figures: summary.figures(&model).into_iter().map(figure).collect() })
}
