//! The sections of the page.

use occupant_core::study::analysis::Estimate;

use super::Report;
use super::analysis::{Analysis, ByDesign};
use super::caution;
use super::command::command;
use super::describe;
use super::html::{Cell, Html};
use super::plots;
use super::samples::{Input, Response};
use super::shown::{part, shown, shown_unit, with_unit};

/// At most so many scatter plots for each response.
const SCATTERS: usize = 9;
/// Pairs of this many parameters are mapped.
const MAPPED: usize = 4;
/// Maps need so many rows for five colours to say anything.
const MAPPED_ROWS: usize = 10;

/// What the study is.
pub fn study(html: &mut Html, report: &Report) {
    let opened = &report.opened;
    let (study, manifest) = (opened.plan.study(), &opened.manifest);
    let ends = &report.gathered.ends;
    let mut facts = vec![
        ("base scenario", study.base_name().to_owned()),
        ("design", describe::design(study)),
        ("seed", study.seed().to_string()),
        (
            "runs",
            format!("{} of {} finished", ends.finished, ends.planned),
        ),
    ];
    if let Some(ensemble) = study.ensemble() {
        let each = format!(
            "{} members for each sample, {} small changes; the response of a sample is the median of its members",
            ensemble.members,
            ensemble.perturbations.len()
        );
        facts.push(("ensemble", each));
    }
    if !manifest.overrides.is_empty() {
        facts.push(("changes of the command line", manifest.overrides.join(", ")));
    }
    html.text("h2", "The study");
    html.facts(&facts);
    if study.parameters().is_empty() {
        return;
    }
    html.text("h2", "What is varied");
    let rows = study.parameters().iter().map(|p| {
        vec![
            Cell::Words(p.name.clone()),
            Cell::Words(describe::law(p)),
            Cell::Words(describe::nominal(p)),
            Cell::Words(describe::places(p)),
        ]
    });
    let head = ["parameter", "values", "in the base", "where"];
    html.table(&head, &rows.collect::<Vec<_>>());
}

/// How the runs ended.
pub fn ends(html: &mut Html, report: &Report) {
    let ends = &report.gathered.ends;
    html.text("h2", "How the runs ended");
    let mut facts = vec![("completed", ends.completed.to_string())];
    for (name, count) in [
        (
            "completed, energy balance off by more than 10 %: left out",
            ends.doubtful,
        ),
        ("failed", ends.failed),
        ("refused", ends.refused),
        ("the program broke off", ends.broken),
        ("not finished yet", ends.planned - ends.finished),
    ] {
        if count > 0 {
            facts.push((name, count.to_string()));
        }
    }
    html.facts(&facts);
    if ends.reasons.is_empty() {
        return;
    }
    let row = |(reason, count, run): &(String, u64, u64)| {
        vec![
            Cell::Number(count.to_string()),
            Cell::Number(run.to_string()),
            Cell::Words(reason.clone()),
        ]
    };
    let mut rows: Vec<Vec<Cell>> = ends.reasons.iter().map(row).collect();
    if ends.other_reasons > 0 {
        rows.push(vec![
            Cell::Number(ends.other_reasons.to_string()),
            Cell::Number("–".to_owned()),
            Cell::Words("other reasons".to_owned()),
        ]);
    }
    html.table(&["runs", "first", "reason"], &rows);
}

/// One response.
pub fn response(html: &mut Html, report: &Report, analysis: &Analysis) {
    let samples = &report.gathered.samples;
    let response = &samples.responses[analysis.response];
    html.raw(&format!("<section id=\"r{}\">\n", analysis.response));
    html.text("h2", &heading(response));
    spread(html, response, analysis);
    if analysis.spread.is_some() && !analysis.constant {
        by_design(html, report, analysis);
        linear(html, report, analysis);
        pictures(html, report, analysis);
    }
    extremes(html, report, analysis);
    html.raw("</section>\n");
}

fn heading(response: &Response) -> String {
    match shown_unit(&response.unit).1 {
        "" => response.name.clone(),
        unit => format!("{}, {unit}", response.name),
    }
}

fn spread(html: &mut Html, response: &Response, analysis: &Analysis) {
    let Some(s) = analysis.spread else {
        html.text(
            "p class=\"note\"",
            "No sample that is there has this figure.",
        );
        return;
    };
    if let Some(why) = caution::missing(s.missing, s.members + s.missing) {
        html.text("p class=\"note\"", &format!("† {why}."));
    }
    let [stable, unstable] = response.stable;
    if unstable > 0 {
        html.text(
            "p class=\"note\"",
            &format!(
                "In {unstable} of {} samples the members of the ensemble do not agree on this figure.",
                stable + unstable
            ),
        );
    }
    if analysis.constant {
        let value = with_unit(s.median, &response.unit);
        html.text(
            "p",
            &format!("The same in all {} samples: {value}.", s.members),
        );
        return;
    }
    let head = ["samples", "least", "5 %", "median", "95 %", "greatest"];
    let mut row = vec![Cell::Number(s.members.to_string())];
    let values = [s.least, s.q05, s.median, s.q95, s.greatest];
    row.extend(values.map(|x| Cell::Number(shown(x, &response.unit))));
    html.table(&head, &[row]);
}

fn by_design(html: &mut Html, report: &Report, analysis: &Analysis) {
    let samples = &report.gathered.samples;
    let response = &samples.responses[analysis.response];
    let ordered = |row: &dyn Fn(usize) -> Option<Vec<Cell>>| -> Vec<Vec<Cell>> {
        analysis.order.iter().filter_map(|i| row(*i)).collect()
    };
    let name = |i: usize| Cell::Words(samples.inputs[i].name.clone());
    let (title, head, rows, picture): (_, &[&str], _, _) = match &analysis.by_design {
        ByDesign::Plain => return,
        ByDesign::Sobol(Ok(found)) => {
            let row = |i: usize| {
                let mut row = vec![name(i)];
                for e in [found.first.get(i)?, found.total.get(i)?] {
                    row.extend(cells(e, &part, caution::index(e, found)));
                }
                Some(row)
            };
            let head = &["parameter", "first order", "95 %", "total", "95 %"];
            let picture = plots::sobol(samples, analysis, found);
            let points = format!(
                "Sobol indices: parts of the variance, of {} points{}",
                found.points,
                match found.dropped {
                    0 => String::new(),
                    n => format!("; {n} more have runs without a figure"),
                }
            );
            (points, head, ordered(&row), picture)
        }
        ByDesign::Morris(Ok(found)) => {
            let row = |i: usize| {
                let effect = found.get(i)?;
                let mark = caution::effect(effect);
                let text = |x: f64| shown(x, &response.unit);
                let mut row = vec![name(i)];
                row.extend(cells(&effect.mean_magnitude, &text, mark.clone()));
                row.push(Cell::of(text(effect.mean.value), mark.clone()));
                row.push(Cell::of(text(effect.deviation), mark));
                row.push(Cell::Number(effect.effects.to_string()));
                Some(row)
            };
            let head = &["parameter", "μ*", "95 %", "μ", "σ", "effects"];
            let title =
                "Morris’s elementary effects: the change over a parameter’s whole range".to_owned();
            (
                title,
                head,
                ordered(&row),
                plots::morris(samples, analysis, found),
            )
        }
        ByDesign::OneAtATime(Ok(found)) => {
            let row = |i: usize| {
                let reach = found.get(i)?;
                let [low, high] = reach.range();
                let [first, last] = reach.ends().unwrap_or([f64::NAN; 2]);
                let values = [first, last, low, high, high - low];
                let mut row = vec![name(i)];
                row.extend(values.map(|x| Cell::Number(shown(x, &response.unit))));
                Some(row)
            };
            let head = &[
                "parameter",
                "at its least",
                "at its greatest",
                "least",
                "greatest",
                "reach",
            ];
            let title = "One parameter at a time".to_owned();
            (
                title,
                head,
                ordered(&row),
                plots::tornado(samples, analysis, found),
            )
        }
        ByDesign::Sobol(Err(why)) => return without(html, "Sobol indices", why),
        ByDesign::Morris(Err(why)) => return without(html, "Elementary effects", why),
        ByDesign::OneAtATime(Err(why)) => return without(html, "One parameter at a time", why),
    };
    html.text("h3", &title);
    html.raw("<div class=\"pair\">\n");
    html.raw(&format!("<figure>{picture}</figure>\n"));
    html.table(head, &rows);
    html.raw("</div>\n");
}

fn without(html: &mut Html, what: &str, why: &str) {
    html.text(
        "p class=\"note\"",
        &format!("{what}: none, because there are too few numbers to say anything ({why})."),
    );
}

/// A number and its interval.
fn cells(estimate: &Estimate, text: &dyn Fn(f64) -> String, mark: Option<String>) -> [Cell; 2] {
    let interval = format!("{} … {}", text(estimate.low), text(estimate.high));
    [Cell::of(text(estimate.value), mark), Cell::Number(interval)]
}

fn linear(html: &mut Html, report: &Report, analysis: &Analysis) {
    let samples = &report.gathered.samples;
    let linear = &analysis.linear;
    if samples.inputs.is_empty() {
        return;
    }
    html.text("h3", "Rank correlation and standardised regression");
    if let Some(why) = &linear.without {
        html.text("p", &format!("None: {why}."));
        return;
    }
    let blank = |n: usize| vec![Cell::Number("–".to_owned()); n];
    let mut rows = Vec::new();
    for i in &analysis.order {
        let mut row = vec![Cell::Words(samples.inputs[*i].name.clone())];
        let mut reading = "";
        match &linear.ranks[*i] {
            Ok(found) => {
                let mark = caution::rank(found);
                reading = match (found.rho.is_clear(), found.rho.value > 0.0) {
                    (false, _) => "sign not known",
                    (true, true) => "rises",
                    (true, false) => "falls",
                };
                row.extend(cells(&found.rho, &part, mark));
            }
            Err(_) => row.extend(blank(2)),
        }
        match &linear.regression {
            Ok((which, found)) => match which.iter().position(|w| w == i) {
                Some(at) => {
                    let mark = caution::regression(found);
                    row.extend(cells(&found.coefficients[at], &part, mark));
                }
                None => row.extend(blank(2)),
            },
            Err(_) => row.extend(blank(2)),
        }
        row.push(Cell::Words(match &linear.ranks[*i] {
            Err(why) => why.clone(),
            Ok(_) => reading.to_owned(),
        }));
        rows.push(row);
    }
    html.raw("<div class=\"pair\">\n");
    html.raw(&format!(
        "<figure>{}</figure>\n<div>",
        plots::linear(samples, analysis)
    ));
    let head = [
        "parameter",
        "rank correlation",
        "95 %",
        "coefficient",
        "95 %",
        "with it the figure",
    ];
    html.table(&head, &rows);
    html.text("p class=\"remark\"", &regression_words(linear));
    html.raw("</div></div>\n");
}

fn regression_words(linear: &super::analysis::Linear) -> String {
    match &linear.regression {
        Ok((_, found)) => {
            let mark = caution::regression(found);
            let why = mark.map(|why| format!(" †: {why}")).unwrap_or_default();
            format!(
                "The linear model of {} rows explains R² = {} of the variance{why}.",
                found.rows,
                part(found.explained)
            )
        }
        Err(why) => format!("No regression: {why}."),
    }
}

fn pictures(html: &mut Html, report: &Report, analysis: &Analysis) {
    let samples = &report.gathered.samples;
    let response = &samples.responses[analysis.response];
    let drawn: Vec<&Input> = analysis
        .order
        .iter()
        .map(|i| &samples.inputs[*i])
        .filter(|input| input.varies())
        .collect();
    if drawn.is_empty() {
        return;
    }
    html.text("h3", "Over each parameter");
    if drawn.len() > SCATTERS {
        let words = format!("The {SCATTERS} that matter most of {}.", drawn.len());
        html.text("p class=\"remark\"", &words);
    }
    if samples.len() > plots::MOST_DOTS {
        let every = samples.len().div_ceil(plots::MOST_DOTS);
        let words = format!("One of {every} samples is drawn; all of them count in the numbers.");
        html.text("p class=\"remark\"", &words);
    }
    html.raw("<div class=\"grid\">\n");
    for input in drawn.iter().take(SCATTERS) {
        let picture = plots::scatter(input, response);
        html.raw(&format!("<figure>{picture}</figure>\n"));
    }
    html.raw("</div>\n");
    maps(html, &drawn, response);
}

fn maps(html: &mut Html, drawn: &[&Input], response: &Response) {
    let Some(fifths) = fifths(&response.values) else {
        return;
    };
    let few = &drawn[..drawn.len().min(MAPPED)];
    if few.len() < 2 {
        return;
    }
    html.text("h3", "Over two parameters");
    if drawn.len() > MAPPED {
        let words = format!("Pairs of the {MAPPED} that matter most.");
        html.text("p class=\"remark\"", &words);
    }
    html.raw("<div class=\"grid\">\n");
    for (i, up) in few.iter().enumerate() {
        for across in &few[..i] {
            let picture = plots::map(across, up, response, &fifths);
            html.raw(&format!("<figure>{picture}</figure>\n"));
        }
    }
    html.raw("</div>\n");
}

/// The bounds between the fifths of the values.
fn fifths(values: &[f64]) -> Option<[f64; 4]> {
    use occupant_core::study::spread::quantile;
    let there = values.iter().filter(|x| x.is_finite()).count();
    if there < MAPPED_ROWS {
        return None;
    }
    let bounds: Vec<f64> = [0.2, 0.4, 0.6, 0.8]
        .iter()
        .filter_map(|p| quantile(values, *p))
        .collect();
    bounds.try_into().ok()
}

fn extremes(html: &mut Html, report: &Report, analysis: &Analysis) {
    let samples = &report.gathered.samples;
    let response = &samples.responses[analysis.response];
    let found = &report.gathered.extremes[analysis.response];
    if found.worst.is_empty() {
        return;
    }
    html.text("h3", "Worst and best runs");
    for (word, runs) in [("greatest", &found.worst), ("least", &found.best)] {
        for (value, run) in runs {
            let value = with_unit(*value, &response.unit);
            html.text("p class=\"run\"", &format!("Run {run}, {word}: {value}"));
            match command(&report.opened.plan, &report.opened.manifest, *run) {
                Some(command) => html.text("pre class=\"command\"", &command),
                None => html.text("p class=\"remark\"", "No shell command can say its values."),
            }
        }
    }
}
