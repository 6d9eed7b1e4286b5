//! The sections of the page.

use super::{Finding, Report, groups, matters, pictures, quoting, worst};
use crate::base::describe;
use crate::base::shown::{shown, shown_unit, with_unit};
use occupant_pictures::html::{Cell, Html};

/// Description of the study.
pub fn study(html: &mut Html, report: &Report) {
    let opened = &report.opened;
    let (study, manifest) = (&opened.plan.study, &opened.manifest);
    let ends = &report.gathered.ends;
    let mut facts = vec![
        ("base scenario", study.base_name.to_owned()),
        ("design", describe::design(study)),
        ("seed", study.seed.to_string()),
        ("runs", format!("{} of {} finished", ends.finished(), ends.planned)),
    ];
    if let Some(ensemble) = &study.ensemble {
        let each = format!(
            "{} runs per sample with {} small changes; the response of a sample is the median of its runs",
            ensemble.members,
            ensemble.perturbations.len()
        );
        facts.push(("ensemble", each));
    }
    if !manifest.overrides.is_empty() {
        facts.push(("changes on the command line", manifest.overrides.join(", ")));
    }
    let one_in = report.gathered.samples.one_in;
    if one_in > 1 {
        facts.push((
            "large study",
            format!("rank correlations and dots are of one in {one_in} samples; all else is of all samples"),
        ));
    }
    html.text("h2", "The study");
    html.facts(&facts);
}

/// Its parameters.
pub fn varied(html: &mut Html, report: &Report) {
    let study = &report.opened.plan.study;
    if study.parameters.is_empty() {
        return;
    }
    html.fold("What is varied");
    let inputs = &report.gathered.samples.inputs;
    let rows = study.parameters.iter().zip(inputs).map(|(p, input)| {
        vec![
            Cell::Words(p.name.clone()),
            Cell::Words(describe::law(p, &input.unit)),
            Cell::Words(describe::nominal(p, &input.unit)),
            Cell::Words(describe::places(p)),
        ]
    });
    let head = ["parameter", "values", "in the base", "where"];
    html.table(&head, &rows.collect::<Vec<_>>());
    html.unfold();
}

/// Outcomes of the runs.
pub fn ends(html: &mut Html, report: &Report) {
    let ends = &report.gathered.ends;
    html.text("h2", "How the runs ended");
    let mut facts = vec![("completed", ends.completed.to_string())];
    for (name, count) in [
        ("completed, but energy balance off by more than 10 %: excluded", ends.doubtful),
        ("failed", ends.failed),
        ("refused", ends.refused),
        ("the program stopped", ends.broken),
        ("excluded by constraints: not run", ends.excluded),
        ("not finished yet", ends.planned - ends.finished()),
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
        vec![Cell::Number(count.to_string()), Cell::Number(run.to_string()), Cell::Words(reason.clone())]
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

/// Section of a response, folded under a line with its median and range. A link to the section unfolds it.
pub fn response(html: &mut Html, of: &Finding<'_>) {
    let heading = match shown_unit(&of.response.unit).1 {
        "" => of.response.name.clone(),
        unit => format!("{}, {unit}", of.response.name),
    };
    let value = |x: f64| shown(x, &of.response.unit);
    let range = of.analysis.spread.map_or_else(
        || "no sample has it".to_owned(),
        |s| format!("median {}, 5 to 95 %: {} … {}", value(s.median), value(s.q05), value(s.q95)),
    );
    html.fold(&format!("{heading}: {range}"));
    html.raw(&format!("<section id=\"r{}\">\n", of.analysis.response));
    spread(html, of);
    of.statements.iter().for_each(|statement| quoting::section(html, statement, &of.response.unit));
    if of.analysis.spread.is_some() && !of.analysis.constant {
        groups::table(html, of);
        matters::by_design(html, of);
        matters::linear(html, of);
        html.fold("Pictures over the parameters");
        pictures::pictures(html, of);
        html.unfold();
    }
    extremes(html, of);
    html.raw("</section>\n");
    html.unfold();
}

fn spread(html: &mut Html, of: &Finding<'_>) {
    let Some(s) = of.analysis.spread else {
        html.text("p class=\"note\"", "No finished sample has this result.");
        return;
    };
    // that of all numbers of the response, its count of samples among them
    let mark = of.numbers.iter().find(|n| n.quantity == "samples").and_then(|n| n.mark.clone());
    if let Some(why) = &mark {
        html.text("p class=\"note\"", &format!("† {why}."));
    }
    let [stable, unstable] = of.response.stable;
    if unstable > 0 {
        html.text(
            "p class=\"note\"",
            &format!("In {unstable} of {} samples this result is not stable in the ensemble.", stable + unstable),
        );
    }
    if of.analysis.constant {
        let value = with_unit(s.median, &of.response.unit);
        html.text("p", &format!("The same in all {} samples: {value}.", s.members));
        return;
    }
    let head = ["samples", "least", "5 %", "median", "95 %", "greatest"];
    let mut row = vec![Cell::Number(s.members.to_string())];
    let values = [s.least, s.q05, s.median, s.q95, s.greatest];
    row.extend(values.map(|x| Cell::of(shown(x, &of.response.unit), mark.clone())));
    html.table(&head, &[row]);
}

fn extremes(html: &mut Html, of: &Finding<'_>) {
    let mut runs = of.numbers.iter().filter_map(|n| Some((n, n.run.as_ref()?))).peekable();
    if runs.peek().is_some() {
        html.text("h3", "Worst and best runs");
    }
    for (number, run) in runs {
        let word = if number.quantity == "worst" { "greatest" } else { "least" };
        let value = with_unit(number.estimate.value, &of.response.unit);
        let mark = number.mark.as_ref().map(|why| format!(" †: {why}")).unwrap_or_default();
        html.fold(&format!("Run {}, {word}: {value}{mark}", run.number));
        if let Some(folder) = of.runs {
            let file = format!("occupant run {folder}/{}", worst::name(run.number));
            html.text("pre class=\"scenario\"", &file);
        }
        match &run.command {
            Some(command) => html.text("pre class=\"command\"", command),
            None => html.text("p class=\"remark\"", "Its values cannot be written as a shell command."),
        }
        html.unfold();
    }
}
