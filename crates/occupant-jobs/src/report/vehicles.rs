//! Occupant risk from the motion of the vehicles alone, folded on the page of a run: the sections of `occupant risk`.

use super::data::Run;
use crate::base::Units;
use crate::risk::{self, OWN_STYLE};
use occupant_files::results::Results;
use occupant_pictures::html::Html;

/// HTML below the drawings of the script; empty if no vehicle accelerates or rotates. A motion common to several runs
/// is shown once.
pub(super) fn vehicles(runs: &[Results], units: Units) -> String {
    let mut reports: Vec<risk::Report> = Vec::new();
    for run in runs {
        let setup = run.model.setup();
        for vehicle in risk::vehicles(setup) {
            let report = risk::Report::of_run(&Run::label_of(run), setup, Some(vehicle)).filter(moves);
            reports.extend(report.filter(|new| reports.iter().all(|old| old.signals != new.signals)));
        }
    }
    let mut html = Html::default();
    if reports.is_empty() {
        return html.finish();
    }
    html.raw(&format!("<style>\n{OWN_STYLE}</style>\n"));
    html.raw("<div class=\"study\" style=\"max-width:1500px;margin:0 auto;padding:0 16px 12px\">\n");
    for report in &reports {
        html.fold(&format!("Motion of {}: {}", report.subject.name, verdict(report)));
        html.raw(&risk::sections(report, Some(units.system)));
        html.unfold();
    }
    html.raw("</div>\n");
    html.finish()
}

fn moves(report: &risk::Report) -> bool {
    report.signals.channels.iter().flatten().flatten().any(|value| *value != 0.0)
}

fn verdict(report: &risk::Report) -> String {
    match &report.broken()[..] {
        [] => "OIV, ORA, THIV, PHD, ASI, roll and pitch within the limits of all rules".to_owned(),
        broken => format!("OIV, ORA, THIV, PHD, ASI, roll and pitch; beyond {}", broken.join(", ")),
    }
}
