//! The report as a page for an authority: one HTML file that needs no network and no script, and that prints on white.

use occupant_scenario::kind::UnitSystem;

use super::figures::Figures;
use super::table::{about, basis_name, documents, head, shown, told, unit_of, verdict_name};
use super::{Report, plots};
use crate::base::program;
use occupant_pictures::html::{Cell, Html, about as about_page};
use occupant_pictures::plot::inline;

const STYLE: &str = include_str!("../../assets/viewer/dist/viewer.css");
/// Style of [`sections`] in addition to that of a run's page.
pub const OWN_STYLE: &str = include_str!("../../assets/study/study.css");
/// Print style: everything unfolded, black on white, no clipped figures.
const PRINT: &str = "@media print {\n  body { background: #ffffff; color: #000000; }\n  figure, tr { break-inside: avoid; }\n  .scroll { overflow: visible; }\n}\n";
/// Width and height of a plot.
const PLOT: [f64; 2] = [430.0, 240.0];

/// The complete file; `origin` lists the sources of the numbers.
pub fn page(report: &Report, units: Option<UnitSystem>, origin: &[(&str, String)]) -> String {
    let mut html = begun(&format!("Occupant risk of {}", report.subject.name));
    html.text("p", "Occupant risk from the vehicle’s motion alone");
    html.raw("</header>\n");
    html.raw(&sections(report, units));
    ended(html, origin)
}

/// A page that prints, up to its title; its header is open.
pub fn begun(title: &str) -> Html {
    let mut html = Html::default();
    html.raw("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    html.raw("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    html.raw(&format!("{}\n", about_page(title)));
    html.raw(
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n",
    );
    html.text("title", title);
    html.raw(&format!("<style>\n{}\n{OWN_STYLE}\n{PRINT}</style>\n", STYLE.trim_end()));
    html.raw("</head>\n<body>\n<div id=\"report\" class=\"study\">\n<header>\n");
    html.text("h1", title);
    html
}

/// The whole page, with its sources.
pub fn ended(mut html: Html, origin: &[(&str, String)]) -> String {
    html.text("h2", "Source");
    let made = [("report made by", program())];
    html.facts(&[origin, &made].concat());
    html.raw("</div>\n</body>\n</html>\n");
    html.finish()
}

/// Measures, limits and histories: the page without head and origin.
pub fn sections(report: &Report, units: Option<UnitSystem>) -> String {
    let mut html = Html::default();
    report.notes.iter().for_each(|note| html.text("p class=\"note\"", note));
    html.text("h2", "Record");
    html.facts(&head(report));
    let figures = Figures::of(report);
    html.text("h2", "Measures");
    measures(&mut html, report, &figures, units);
    if !figures.left_out.is_empty() {
        html.text("h3", "Left out");
        let rows: Vec<(&str, String)> =
            figures.left_out.iter().map(|l| (l.measure.as_str(), l.reason.clone())).collect();
        html.facts(&rows);
    }
    html.text("h2", "Limits");
    limits(&mut html, report, units);
    let classes = report.classes(units);
    if !classes.is_empty() {
        html.text("h3", "Classes and levels");
        let row = |(rule, class, by): (&str, Option<&str>, String)| {
            [rule, class.unwrap_or("none"), &by].map(|words| Cell::Words(words.to_owned())).to_vec()
        };
        html.table(&["rule", "class or level", "by"], &classes.into_iter().map(row).collect::<Vec<_>>());
    }
    html.text("h2", "Histories");
    html.raw("<div class=\"grid\">\n");
    plots::plots(report).iter().for_each(|figure| html.raw(&format!("<figure>{}</figure>\n", inline(figure, PLOT))));
    html.raw("</div>\n");
    html.finish()
}

fn measures(html: &mut Html, report: &Report, figures: &Figures, units: Option<UnitSystem>) {
    let mut heads = vec!["measure", "value", "unit"];
    if report.intervals.is_some() {
        heads.extend(["95 % from", "to"]);
    }
    if units.is_none() {
        heads.extend(["or", "unit"]);
    }
    heads.extend(["time, s", "remark"]);
    let row = |figure: &super::figures::Figure| {
        let told = told(figure, units);
        let mut cells = vec![
            Cell::Words(figure.name.clone()),
            Cell::Number(shown(figure.value, told[0])),
            Cell::Words(told[0].0.symbol()),
        ];
        if let Some(intervals) = &report.intervals {
            let ends = intervals.of_key(&figure.key).map(|ends| ends.map(|si| Cell::Number(shown(si, told[0]))));
            cells.extend(ends.unwrap_or_else(|| [(); 2].map(|()| Cell::Number("–".to_owned()))));
        }
        if units.is_none() {
            let other = told.get(1);
            cells.push(Cell::Number(other.map_or_else(String::new, |unit| shown(figure.value, *unit))));
            cells.push(Cell::Words(other.map_or_else(String::new, |unit| unit.0.symbol())));
        }
        cells.extend(about(figure).map(Cell::Words));
        cells
    };
    html.table(&heads, &figures.figures.iter().map(row).collect::<Vec<_>>());
}

fn limits(html: &mut Html, report: &Report, units: Option<UnitSystem>) {
    let row = |judgement: &occupant_study::risk::Judgement| {
        let unit = unit_of(judgement.limit.quantity, units);
        let perhaps = |si: Option<f64>| Cell::Number(si.map_or_else(|| "–".to_owned(), |si| shown(si, unit)));
        vec![
            Cell::Words(judgement.limit.rule.name().to_owned()),
            Cell::Words(judgement.measure.to_owned()),
            Cell::Words(judgement.limit.grade.name().to_owned()),
            Cell::Number(shown(judgement.limit.most, unit)),
            perhaps(judgement.value),
            perhaps(judgement.verdict.map(|v| v.margin)),
            Cell::Words(unit.0.symbol()),
            Cell::Words(verdict_name(judgement).to_owned()),
            Cell::Words(basis_name(judgement.limit.basis).to_owned()),
        ]
    };
    let heads = ["rule", "measure", "limit", "at most", "value", "margin", "unit", "verdict", "limit read in"];
    html.table(&heads, &report.judgements.iter().map(row).collect::<Vec<_>>());
    let sources: Vec<String> =
        documents(&report.judgements).into_iter().map(|(rules, document)| format!("{rules}: {document}.")).collect();
    html.text("p class=\"remark\"", &format!("Sources of the limits. {}", sources.join(" ")));
    html.text(
        "p class=\"remark\"",
        "Limits come from secondary sources: check the rule itself before a legal statement. Exceeding an intermediate class or level does not break a rule.",
    );
}
