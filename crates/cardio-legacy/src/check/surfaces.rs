//! The materials of the surfaces (series 9).

use super::Check;
use crate::rule::Rule;

pub(super) fn check(check: &mut Check<'_>) {
    for surface in 1..=25 {
        check_surface(check, surface);
    }
}

fn check_surface(check: &mut Check<'_>, n: u32) {
    let [first, second, elbow, keep_1, keep_2, friction] =
        ["STIF1", "STIF2", "DELB", "AMU1", "AMU2", "COFR"].map(|name| format!("{name}({n})"));
    for (name, what) in
        [(&first, "stiffness"), (&second, "stiffness"), (&elbow, "deformation"), (&friction, "coefficient of friction")]
    {
        check.not_negative(name, what);
    }
    let (soft, stiff) = (check.value(&first), check.value(&second));
    check.complain_if(
        soft == 0.0,
        Rule::Unlikely,
        &first,
        "the surface resists nothing up to DELB",
        "a stiffness in lbf/in",
        "punch the stiffness",
    );
    check.complain_if(
        stiff == 0.0,
        Rule::Unlikely,
        &second,
        "the surface resists no more beyond DELB",
        "a stiffness in lbf/in",
        "punch STIF1 again for a linear spring",
    );
    let message = format!("softer than STIF1({n}) = {}", check.digits(&first));
    let softens = soft > stiff && stiff > 0.0;
    check.complain_if(
        softens,
        Rule::Unlikely,
        &second,
        &message,
        "the larger of the two",
        "look whether the two have changed places",
    );
    for name in [&keep_1, &keep_2] {
        let value = check.value(name);
        let violated = !(0.0..=1.0).contains(&value) && !value.is_nan();
        check.complain_if(
            violated,
            Rule::Impossible,
            name,
            "a fraction of the energy",
            "0 to 1",
            "divide percents by 100",
        );
    }
    let rough = check.value(&friction) > 2.0;
    check.complain_if(
        rough,
        Rule::Unlikely,
        &friction,
        "more than any pair of materials has",
        "0 to about 1",
        "divide percents by 100",
    );
}
