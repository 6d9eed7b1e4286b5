//! Statements of a study: what its runs say of each response, for the page, the terminal, JSON and a table.

use occupant_study::certainty::Histogram;
use occupant_study::sketch::Sketch;
use occupant_study::{Design, Study};
use serde::Serialize;

use super::gather::Spoiled;
use super::spread_plots::{distribution, histogram};
use super::{Analysis, Gathered, Report};
use crate::base::shown::{shown, shown_unit};
use crate::base::{Told, Units, describe};
use crate::quoted::{About, LeftOut, Limits, Sampling, Statement, Values, percent};
use crate::sweep::{Census, Stored};
use occupant_pictures::html::{Cell, Html};

/// Reasons named of runs that failed.
const REASONS: usize = 2;
/// Characters of a reason.
const REASON: usize = 120;

/// The answer of `--json`, SI units.
#[derive(Serialize)]
pub struct Answer<'a> {
    /// The program.
    pub program: String,
    /// The program that made the runs.
    pub runs_by: &'a str,
    /// Title of the study.
    pub title: &'a str,
    /// Runs of the study, and those that are finished.
    pub runs: [u64; 2],
    /// Notes to read first.
    pub notes: &'a [String],
    /// What the runs say of each figure.
    pub figures: Vec<&'a Statement>,
}

/// What is common to all responses of a study.
pub fn about(opened: &Stored, gathered: &Gathered, units: Units) -> About {
    let (study, manifest, ends) = (&opened.plan.study, &opened.manifest, &gathered.ends);
    let members = study.members();
    let is_single = study.samples() == 1 && members > 1;
    let (each, count) = match (is_single, members) {
        (true, _) => (["changed run".to_owned(), "changed runs".to_owned()], ends.begun().saturating_sub(1)),
        (false, 1) => (["run".to_owned(), "runs".to_owned()], ends.begun()),
        (false, n) => {
            let of = |noun: &str| format!("{noun} (each the median of {n} runs with small changes)");
            ([of("sample"), of("samples")], gathered.len())
        }
    };
    let title =
        if manifest.title.is_empty() { String::new() } else { format!(" for the study “{}”", manifest.title) };
    let unfinished = ends.planned - ends.finished();
    let open = if unfinished > 0 { format!(", {unfinished} runs are not finished") } else { String::new() };
    let excluded = match ends.excluded {
        0 => String::new(),
        n => format!(", {n} left out by constraints"),
    };
    let simulated = format!(
        "{} simulated {}{title}: {count} {} ({}, seed {}{excluded}{open})",
        manifest.program,
        study.base_name,
        each[usize::from(count != 1)],
        describe::design(study),
        study.seed
    );
    About {
        simulated,
        each,
        varied: varied(study, gathered, units),
        left_out: left_out(ends, members),
        sampling: sampling(study),
    }
}

/// Each parameter with its law, its source and its places; values that the study sets in all runs.
fn varied(study: &Study, gathered: &Gathered, units: Units) -> Vec<String> {
    let inputs = study.parameters.iter().zip(&gathered.samples.inputs);
    let mut all: Vec<String> = inputs.map(|(parameter, input)| describe::input(parameter, &input.unit)).collect();
    if let Some(ensemble) = &study.ensemble {
        all.extend(describe::ensemble(ensemble, units).into_iter().map(|words| format!("in each changed run {words}")));
    }
    if !study.changes.is_empty() {
        let set = study.changes.iter().map(|(path, text)| format!("{path} = {}", text.trim_matches('"')));
        all.push(format!("the same in all runs: {}", set.collect::<Vec<_>>().join(", ")));
    }
    all
}

/// Runs without any figure. Members of an ensemble are counted with the sample that they belong to.
fn left_out(ends: &Census, members: u64) -> Vec<LeftOut> {
    if members > 1 {
        return Vec::new();
    }
    let of = |count: u64, what: &str| (count > 0).then(|| LeftOut { runs: count, reason: what.to_owned() });
    let reasons = ends.reasons.iter().take(REASONS);
    let reasons: Vec<String> =
        reasons.map(|(reason, ..)| placed_text::shortened(&reason.replace('\n', " "), REASON)).collect();
    let why =
        |what: &str| if reasons.is_empty() { what.to_owned() } else { format!("{what} ({})", reasons.join("; ")) };
    let broken = ends.failed + ends.refused + ends.broken;
    [of(broken, &why("failed or were refused")), of(ends.doubtful, "lost their energy balance by more than 10 %")]
        .into_iter()
        .flatten()
        .collect()
}

fn sampling(study: &Study) -> Sampling {
    let none = |why: &str| Sampling::None(why.to_owned());
    match &study.design {
        Design::MonteCarlo { .. } => Sampling::Random,
        Design::Single if study.members() > 1 => Sampling::Random,
        Design::LatinHypercube { .. } | Design::Sobol { .. } | Design::Saltelli { .. } => Sampling::Even,
        Design::FullFactorial => none("a full factorial design is no sample of a distribution"),
        Design::Table { .. } => none("the samples come from a table, whose distribution is not known"),
        Design::OneAtATime { .. } => none("one parameter at a time is no sample of a distribution"),
        Design::Morris { .. } => none("Morris’s trajectories are no sample of a distribution"),
        Design::Single => none("it is a single run"),
    }
}

/// Statements of a response: one, or one for each combination of crossed values.
pub fn statements(
    about: &About,
    opened: &Stored,
    gathered: &Gathered,
    analysis: &Analysis,
    limits: &Limits,
    units: Units,
) -> Vec<Statement> {
    let response = &gathered.samples.responses[analysis.response];
    let Spoiled { runs, of, names } = &gathered.spoiled[analysis.response];
    let names: Vec<String> = names.keys().cloned().collect();
    let values = gathered.values(analysis.response);
    let plain = Values {
        figure: &response.name,
        unit: &response.unit.si,
        case: None,
        values: &values,
        unchanged: None,
        caveats: (*runs, *of, &names),
    };
    let say = |values: &Values<'_>, about: &About| Statement::of(about, values, limits, units);
    if let Some((unchanged, values)) = gathered.members.get(analysis.response) {
        return say(&Values { values, unchanged: Some(*unchanged), ..plain }, about).into_iter().collect();
    }
    let samples = &gathered.samples;
    if opened.plan.study.crossing() > 1 {
        let groups = gathered.groups(analysis.response);
        let Some(cases) = groups.named(&samples.inputs) else {
            let why = "crossed values share their samples, and there are too many combinations to list".to_owned();
            let about = About { sampling: Sampling::None(why), ..about.clone() };
            return say(&plain, &about).into_iter().collect();
        };
        let of_case = |(case, values): &(String, &Sketch)| say(&Values { case: Some(case), values, ..plain }, about);
        return cases.iter().filter_map(of_case).collect();
    }
    if matches!(opened.plan.study.design, Design::Saltelli { .. }) {
        let values = gathered.independent(analysis.response);
        let rows = values.len() + values.missing();
        let simulated = format!("{}; of these the {rows} of blocks A and B", about.simulated);
        let about = About { simulated, left_out: Vec::new(), ..about.clone() };
        return say(&Values { values: &values, ..plain }, &about).into_iter().collect();
    }
    say(&plain, about).into_iter().collect()
}

/// The paragraphs of all responses, for the terminal.
pub fn text(report: &Report) -> String {
    let paragraphs = report.statements().map(|statement| statement.paragraph.as_str());
    paragraphs.collect::<Vec<_>>().join("\n\n") + "\n"
}

/// The answer in JSON.
pub fn answer(report: &Report) -> Answer<'_> {
    let ends = &report.gathered.ends;
    Answer {
        program: crate::base::program(),
        runs_by: &report.opened.manifest.program,
        title: &report.opened.manifest.title,
        runs: [ends.planned, ends.finished()],
        notes: &report.notes,
        figures: report.statements().collect(),
    }
}

/// Paragraph, quantiles, limits and plots of a statement on the page.
pub fn section(html: &mut Html, of: &Statement, unit: &Told) {
    words(html, of, unit);
    let Some(bars) = &of.histogram else { return };
    html.raw("<div class=\"grid\">\n");
    for picture in [histogram(of, bars, unit), distribution(of, unit)] {
        html.raw(&format!("<figure>{picture}</figure>\n"));
    }
    html.raw("</div>\n");
}

/// Paragraph, quantiles and limits of a statement.
fn words(html: &mut Html, of: &Statement, unit: &Told) {
    html.text("h3", &of.case.as_ref().map_or("To quote".to_owned(), |case| format!("To quote, with {case}")));
    html.text("blockquote", &of.paragraph);
    quantiles(html, of, unit);
    limits(html, of, unit);
}

/// What can be quoted of a study, as text: its notes, then each response under its name.
pub fn all_words(html: &mut Html, report: &Report) {
    for note in &report.notes {
        html.text("p class=\"note\"", note);
    }
    for finding in report.findings() {
        html.fold(&finding.response.name);
        finding.statements.iter().for_each(|statement| words(html, statement, &finding.response.unit));
        html.unfold();
    }
}

fn quantiles(html: &mut Html, of: &Statement, unit: &Told) {
    if of.histogram.is_none() {
        return;
    }
    let heads: Vec<String> =
        of.quantiles.iter().map(|q| format!("{} %", 100.0 * q.part).replace("50 %", "median")).collect();
    let heads: Vec<&str> = std::iter::once("quantile").chain(heads.iter().map(String::as_str)).collect();
    let row = |name: &str, cell: &dyn Fn(usize) -> String| {
        let cells = (0..of.quantiles.len()).map(|i| Cell::Number(cell(i)));
        std::iter::once(Cell::Words(name.to_owned())).chain(cells).collect::<Vec<_>>()
    };
    let q = &of.quantiles;
    let mut rows = vec![row("value", &|i| shown(q[i].value, unit))];
    if of.without_intervals.is_none() {
        let end = |end: Option<f64>, i: usize| end.map_or(format!("needs {}", q[i].needed), |x| shown(x, unit));
        rows.push(row("95 %, from", &|i| end(q[i].low, i)));
        rows.push(row("to", &|i| end(q[i].high, i)));
    }
    html.table(&heads, &rows);
}

fn limits(html: &mut Html, of: &Statement, unit: &Told) {
    if of.limits.is_empty() {
        return;
    }
    let row = |limit: &crate::quoted::Exceeded| {
        let found = &limit.found;
        let rules = if limit.rules.is_empty() { "asked for".to_owned() } else { limit.rules.join(", ") };
        let all = of.without_intervals.is_none();
        let part = |p: f64| Cell::Number(if all { percent(p) } else { "–".to_owned() });
        vec![
            Cell::Number(shown(limit.most, unit)),
            Cell::Words(rules),
            Cell::Number(format!("{} of {}", found.above, found.of)),
            part(found.probability),
            part(found.low),
            part(found.high),
        ]
    };
    let heading = match shown_unit(unit).1 {
        "" => "limit".to_owned(),
        symbol => format!("limit, {symbol}"),
    };
    let heads = [heading.as_str(), "rule", "over it", "probability, %", "95 %, from", "to"];
    html.table(&heads, &of.limits.iter().map(row).collect::<Vec<_>>());
}

/// Ends of the bars of a histogram with their counts.
pub fn bars(of: &Histogram) -> impl Iterator<Item = (f64, f64, usize)> {
    let end = |i: usize| of.from + i as f64 * of.width;
    of.counts.iter().enumerate().map(move |(i, count)| (end(i), end(i + 1), *count))
}
