//! Times (series 3).

use super::Check;
use crate::rule::Rule;

pub(super) fn check(check: &mut Check<'_>) {
    let (start, end, step) = (check.value("T1"), check.value("TF"), check.value("DT"));
    let late = format!("the run ends at or before its initial time T1 = {}", check.digits("T1"));
    check
        .wrong_if(end <= start, Rule::Impossible, "TF", late)
        .expected("a time after T1", "look whether T1 and TF have changed places");
    let coarse = step > 0.0 && end > start && step > (end - start) / 2.0;
    check
        .wrong_if(coarse, Rule::Unlikely, "DT", "fewer than two steps fit into the run")
        .expected("a small part of TF − T1", "look for milliseconds");
    let fine = check.value("DTPRNT") < step;
    check
        .wrong_if(fine, Rule::Inconsistent, "DTPRNT", "less than the step DT")
        .expected("DT or a multiple of it", "print less often or step more finely");
    check
        .wrong_if(end - start > 60.0, Rule::LooksLikeOtherUnit, "TF", "more than a minute after T1")
        .expected("a time in seconds", "divide by 1000 if it is in milliseconds");
}
