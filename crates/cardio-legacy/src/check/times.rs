//! Times and switches (series 3).

use super::Check;
use crate::rule::Rule;

const SWITCH: &str = "0. or 1., with the decimal point";

pub(super) fn check(check: &mut Check<'_>) {
    check.positive("DT", "the integration needs a step");
    check.positive("DTPRNT", "printing needs an interval");
    let (start, end, step) = (check.value("T1"), check.value("TF"), check.value("DT"));
    let late = format!("the run ends at or before its initial time T1 = {}", check.digits("T1"));
    check.complain_if(
        end <= start,
        Rule::Impossible,
        "TF",
        &late,
        "a time after T1",
        "look whether T1 and TF have changed places",
    );
    let coarse = step > 0.0 && end > start && step > (end - start) / 2.0;
    check.complain_if(
        coarse,
        Rule::Unlikely,
        "DT",
        "fewer than two steps fit into the run",
        "a small part of TF − T1",
        "look for milliseconds",
    );
    let fine = check.value("DTPRNT") < step;
    check.complain_if(
        fine,
        Rule::Inconsistent,
        "DTPRNT",
        "less than the step DT",
        "DT or a multiple of it",
        "print less often or step more finely",
    );
    let long = end - start > 60.0;
    check.complain_if(
        long,
        Rule::LooksLikeOtherUnit,
        "TF",
        "more than a minute after T1",
        "a time in seconds",
        "divide by 1000 if it is in milliseconds",
    );
    for name in ["NPOS", "NDISK"] {
        let value = check.value(name);
        let violated = value != 0.0 && value != 1.0 && !value.is_nan();
        check.complain_if(violated, Rule::Impossible, name, "the switch has two positions", SWITCH, "punch 0. or 1.");
    }
    let stations = check.value("MREAD");
    let violated = stations < 0.0 || stations.fract() > 0.0;
    let remedy = "punch 0. if the path stands on series 12";
    check.complain_if(
        violated,
        Rule::NotAWholeNumber,
        "MREAD",
        "this counts no stations",
        "0. or a number of stations",
        remedy,
    );
}
