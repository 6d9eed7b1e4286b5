//! The page: one HTML file that needs no network and no script.

use super::{Report, caution, matrix, matters, panels, sections};
use crate::base::program;
use occupant_pictures::html::{Html, about as about_page};

/// Style of a run's report, with additions.
const STYLE: &str = include_str!("../../assets/viewer/dist/viewer.css");
const OWN_STYLE: &str = include_str!("../../assets/study/study.css");

/// Subject of the page.
pub fn subject(report: &Report) -> String {
    format!("Report of the study {}", report.opened.manifest.title)
}

/// The complete file.
pub fn page(report: &Report) -> String {
    let title = match report.opened.manifest.title.as_str() {
        "" => "Study",
        title => title,
    };
    let mut html = Html::default();
    html.raw("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    html.raw("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    html.raw(&format!("{}\n", about_page(&subject(report))));
    html.raw(
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n",
    );
    html.text("title", title);
    html.raw(&format!("<style>\n{}\n{}</style>\n", STYLE.trim_end(), OWN_STYLE));
    html.raw("</head>\n<body>\n<div id=\"report\" class=\"study\">\n<header>\n");
    html.text("h1", title);
    let ends = &report.gathered.ends;
    html.text("p", &format!("Study report, {} of {} runs finished", ends.finished(), ends.planned));
    html.raw("</header>\n");
    for note in &report.notes {
        html.text("p class=\"note\"", note);
    }
    matrix::section(&mut html, report);
    html.raw("<div class=\"pair\"><div>\n");
    sections::study(&mut html, report);
    html.raw("</div><div>\n");
    sections::ends(&mut html, report);
    html.raw("</div></div>\n");
    if ends.begun() > 0 {
        panels::section(&mut html, report);
    }
    sections::varied(&mut html, report);
    if ends.begun() == 0 {
        html.text("p class=\"note\"", "No run has finished yet.");
    } else {
        html.text("h2", "Measure by measure");
        report.findings().for_each(|finding| sections::response(&mut html, &finding));
    }
    about(&mut html, report);
    html.raw("</div>\n</body>\n</html>\n");
    html.finish()
}

/// Explanations and origin.
fn about(html: &mut Html, report: &Report) {
    let opened = &report.opened;
    html.fold("How to read it");
    html.text(
        "p",
        "A number with † is unreliable. Hover over it for the reason, or see the table beside the page (.parquet). Marked are:",
    );
    html.raw("<ul>\n");
    for rule in caution::rules() {
        html.text("li", &rule);
    }
    html.raw("</ul>\n");
    html.text("p", matters::SIGN_RULE);
    html.text(
        "p",
        "Run the commands in a POSIX shell in the folder of the study, the one with sweep.json. They reproduce the results of the row to the last bit. Intervals are 95 %, by bootstrap; those of rank correlations by Fisher’s z. Correlation and regression use the runs of Saltelli’s blocks A and B. With an ensemble, a sample counts once, with the median of its runs.",
    );
    html.unfold();
    html.fold("Source");
    let mut facts = vec![
        ("runs made by", opened.manifest.program.clone()),
        ("report made by", program()),
        ("sweep.json, SHA-256", opened.manifest_sha256.clone()),
    ];
    for text in &opened.manifest.texts {
        facts.push(("text", format!("{}, SHA-256 {}", text.name, text.sha256)));
    }
    html.facts(&facts);
    html.unfold();
}
