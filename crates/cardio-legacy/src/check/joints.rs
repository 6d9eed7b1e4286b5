//! Joints and gravity (series 11).

use super::Check;
use crate::rule::Rule;

/// Damping and stop of a joint by the names of its fields.
struct Stop {
    normal: &'static str,
    full: &'static str,
    begins_at: &'static str,
    full_at: &'static str,
    /// The stop is met by a falling angle.
    falling: bool,
}

const fn stop(
    normal: &'static str,
    full: &'static str,
    begins_at: &'static str,
    full_at: &'static str,
    falling: bool,
) -> Stop {
    Stop { normal, full, begins_at, full_at, falling }
}

const STOPS: [Stop; 9] = [
    stop("XJNN", "XJSN", "AGNN", "AGSN", false),
    stop("XJNS", "XJSS", "AGNS", "AGSS", false),
    stop("XJNUB", "XJSUB", "AGNUB", "AGSUB", false),
    stop("XJNLB", "XJSLB", "AGNLB", "AGSLB", false),
    stop("XJNH", "XJSH", "AGNH", "AGSH", false),
    stop("XJNE", "XJSE", "AGNE(1)", "AGSE(1)", true),
    stop("XJNE", "XJSE", "AGNE(2)", "AGSE(2)", false),
    stop("XJNK", "XJSK", "AGNK(1)", "AGSK(1)", true),
    stop("XJNK", "XJSK", "AGNK(2)", "AGSK(2)", false),
];

pub(super) fn check(check: &mut Check<'_>) {
    for stop in &STOPS {
        check_stop(check, stop);
    }
    for name in ["XJNE", "XJNK"] {
        check.not_negative(name, "a damping takes energy away");
    }
    for name in ["SPJNT4", "SPJNT7"] {
        check.not_negative(name, "stiffness of a spring");
    }
    for (name, what) in
        [("AGSE(1)", "elbows bend towards negative angles"), ("AGNE(1)", "elbows bend towards negative angles")]
    {
        let violated = check.value(name) > 0.0;
        check.complain_if(
            violated,
            Rule::Unlikely,
            name,
            what,
            "about −130° in radians, −2.27",
            "look for a missing minus sign",
        );
    }
    check_gravity(check);
}

fn check_stop(check: &mut Check<'_>, stop: &Stop) {
    check.radians(&[stop.begins_at, stop.full_at]);
    let pair_of_first = stop.begins_at.ends_with("(2)");
    if !pair_of_first && !stop.begins_at.ends_with(')') {
        check.not_negative(stop.normal, "a damping takes energy away");
    }
    if !pair_of_first {
        check.not_negative(stop.full, "a damping takes energy away");
        let less = check.value(stop.full) < check.value(stop.normal) && check.value(stop.full) != 0.0;
        let message = format!("less than the damping before the stop, {} = {}", stop.normal, check.digits(stop.normal));
        check.complain_if(
            less,
            Rule::Unlikely,
            stop.full,
            &message,
            "more than the damping before the stop",
            "look whether the two have changed places",
        );
    }
    let (begins, full) = (check.value(stop.begins_at), check.value(stop.full_at));
    let wrong = if stop.falling { begins < full } else { begins > full };
    let message = format!("the stop begins beyond its end, {} = {}", stop.full_at, check.digits(stop.full_at));
    let side = if stop.falling { "above the angle of the full stop" } else { "below the angle of the full stop" };
    check.complain_if(
        wrong,
        Rule::Impossible,
        stop.begins_at,
        &message,
        side,
        "look whether the two angles have changed places",
    );
}

fn check_gravity(check: &mut Check<'_>) {
    let gravity = check.value("GR");
    check.not_negative("GR", "gravity is given by its magnitude");
    let (rule, message, remedy) = match gravity {
        g if (31.0..33.5).contains(&g) => (Rule::LooksLikeOtherUnit, "this looks like ft/s²", "multiply by 12"),
        g if (9.7..9.9).contains(&g) => (Rule::LooksLikeOtherUnit, "this looks like m/s²", "punch 386.04"),
        1.0 => (Rule::LooksLikeOtherUnit, "this looks like a number of g", "punch 386.04"),
        g if g > 0.0 && !(380.0..392.0).contains(&g) => (Rule::Unlikely, "not the earth's gravity", "punch 386.04"),
        _ => return,
    };
    check.complain_if(true, rule, "GR", message, "386.04 in/s², or 0 for none", remedy);
}
