//! Statements of an ensemble beside a run. The unchanged run is no random sample, so it is not counted.

use occupant_core::results::summary::Caveat;
use occupant_study::Tolerances;
use occupant_study::sketch::Sketch;

use super::text::changes;
use super::{Left, Member};
use crate::base::Units;
use crate::quoted::{About, LeftOut, Limits, Sampling, Statement, Values};

/// What the members of an ensemble have in common.
pub struct Subject<'a> {
    /// The program and the scenario, as the beginning of a sentence.
    pub simulated: String,
    /// Seed of the changes.
    pub seed: u64,
    /// The changes.
    pub changes: &'a Tolerances,
    /// Inputs drawn from ready distributions, described.
    pub inputs: &'a [String],
    /// Limits of figures.
    pub limits: &'a Limits,
    /// Units of the paragraphs.
    pub units: Units,
}

/// What the changed runs say of each figure.
pub fn quotes(of: &Subject<'_>, nominal: &Left, others: &[Member]) -> Vec<Statement> {
    let lost = |left: &&Left| left.caveats.iter().any(|caveat| caveat.name == Caveat::BALANCE_LOST);
    let failed = others.iter().filter(|member| member.is_err()).count() as u64;
    let doubtful = others.iter().flatten().filter(lost).count() as u64;
    let first = others.iter().find_map(|member| member.as_ref().err());
    let why = first.map(|reason| format!("failed (the first: {reason})")).unwrap_or_default();
    let left_out = [(failed, why), (doubtful, "lost their energy balance by more than 10 %".to_owned())];
    let left_out = left_out.into_iter().filter(|(runs, _)| *runs > 0);
    let about = About {
        simulated: format!("{}: {} runs with random changes (seed {})", of.simulated, others.len(), of.seed),
        each: ["changed run".to_owned(), "changed runs".to_owned()],
        varied: varied(of),
        left_out: left_out.map(|(runs, reason)| LeftOut { runs, reason }).collect(),
        sampling: Sampling::Random,
    };
    let statement = |(i, figure): (usize, &occupant_core::results::summary::Figure)| {
        let counts = |member: &Member| member.as_ref().ok().filter(|left| !lost(left)).map(|left| left.value(i));
        let values: Vec<f64> = others.iter().map(|member| counts(member).unwrap_or(f64::NAN)).collect();
        let values = Sketch::exact(&values);
        let touched = |left: &&Left| left.value(i).is_finite() && left.caveats.iter().any(|c| c.touches(&figure.name));
        let kept = others.iter().flatten().filter(|left| !lost(left)).filter(touched);
        let names = kept.clone().flat_map(|left| left.caveats.iter().filter(|c| c.touches(&figure.name)));
        let mut names: Vec<String> = names.map(|caveat| caveat.name.clone()).collect();
        names.sort_unstable();
        names.dedup();
        let of_figure = Values {
            figure: &figure.name,
            unit: figure.unit,
            case: None,
            values: &values,
            unchanged: Some(nominal.value(i)),
            caveats: (kept.count(), values.len(), &names),
        };
        Statement::of(&about, &of_figure, of.limits, of.units)
    };
    nominal.figures.iter().enumerate().filter_map(statement).collect()
}

fn varied(of: &Subject<'_>) -> Vec<String> {
    let tolerances = format!("uniform, at most {}", changes(of.changes, None, of.units));
    std::iter::once(tolerances).chain(of.inputs.iter().cloned()).collect()
}
