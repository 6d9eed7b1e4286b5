//! Times (series 3).

use super::Check;
use crate::deck::Plot;
use crate::rule::Rule;

pub(super) fn check(c: &mut Check<'_>) {
    let (start, end, step) = (c.value("T1"), c.value("TF"), c.value("DT"));
    let late = format!("the run ends at or before its initial time T1 = {}", c.digits("T1"));
    c.wrong_if(end <= start, Rule::Impossible, "TF", late)
        .expected("a time after T1", "check whether T1 and TF are exchanged");
    let coarse = step > 0.0 && end > start && step > (end - start) / 2.0;
    c.wrong_if(coarse, Rule::Unlikely, "DT", "fewer than two steps fit into the run")
        .expected("a small part of TF − T1", "look for milliseconds");
    let fine = c.value("DTPRNT") < step;
    c.wrong_if(fine, Rule::Inconsistent, "DTPRNT", "less than the step DT")
        .expected("DT or a multiple of it", "print less often or step more finely");
    let plots_without_data = c.deck.plot() == Plot::Standard && c.value("NDISK") == 1.0;
    c.wrong_if(
        plots_without_data,
        Rule::Inconsistent,
        "NDISK",
        "no plot data on disk, and STAN asks for plots of them",
    )
    .expected("0. with STAN, 1. with NONE", "punch NDISK = 0. for plots, or NONE on the plot card for none");
    c.wrong_if(end - start > 60.0, Rule::LooksLikeOtherUnit, "TF", "more than a minute after T1")
        .expected("a time in seconds", "divide by 1000 if it is in milliseconds");
}
