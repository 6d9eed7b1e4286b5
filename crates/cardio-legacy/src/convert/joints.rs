//! Joints (series 11).

use super::writer::Writer;
use crate::cards::JOINTS;

pub(super) fn write(w: &mut Writer<'_>) {
    w.table("joints", "Series 11");
    for joint in &JOINTS {
        w.field(&joint.damping());
        let keys: &[&str] = if joint.is_hinge() { &["lower_stop", "upper_stop"] } else { &["stop"] };
        for (key, [begin, full]) in keys.iter().zip(joint.stops()) {
            stop(w, &format!("{}.{key}", joint.key), [&begin, &full, &joint.full_damping()]);
        }
        if let Some([stiffness, rest]) = joint.spring {
            spring(w, stiffness, rest);
        }
    }
}

/// A stop with two blank or zero angles does not exist.
fn stop(w: &mut Writer<'_>, key: &str, [begin, end, full]: [&str; 3]) {
    if w.value(begin) == 0.0 && w.value(end) == 0.0 {
        w.report.assumptions.push(format!("{begin} and {end} are both zero: no stop ({key}), {full} is not used"));
        return;
    }
    let [from, to, damping] = [begin, end, full].map(|name| w.quantity(name));
    let value = format!("{{ begin = {from}, full = {to}, damping = {damping} }}");
    w.set_with(key, &value, &format!("{begin}, {end}, {full}"));
}

fn spring(w: &mut Writer<'_>, stiffness: &str, rest: &str) {
    if w.value(stiffness) == 0.0 {
        return;
    }
    w.field(stiffness);
    if w.value("NPOS") == 1.0 {
        w.field_with(rest, &format!("card 6a, {rest}"));
    }
}
