//! Joints (series 11).

use super::writer::Writer;

/// A joint with one stop by its card names: scenario name, damping, full damping, begin and end of the stop.
const BALLS: [(&str, [&str; 4]); 5] = [
    ("neck", ["XJNN", "XJSN", "AGNN", "AGSN"]),
    ("shoulders", ["XJNS", "XJSS", "AGNS", "AGSS"]),
    ("upper_back", ["XJNUB", "XJSUB", "AGNUB", "AGSUB"]),
    ("lower_back", ["XJNLB", "XJSLB", "AGNLB", "AGSLB"]),
    ("hips", ["XJNH", "XJSH", "AGNH", "AGSH"]),
];
/// Stiffness and rest angle of the back joints.
const SPRINGS: [(&str, &str, &str); 2] = [("upper_back", "SPJNT4", "BETA4"), ("lower_back", "SPJNT7", "BETA7")];
const HINGES: [(&str, [&str; 4]); 2] =
    [("elbows", ["XJNE", "XJSE", "AGNE", "AGSE"]), ("knees", ["XJNK", "XJSK", "AGNK", "AGSK"])];

pub(super) fn write(w: &mut Writer<'_>) {
    w.table("joints", "Series 11");
    for (name, [normal, full, begin, end]) in BALLS {
        damping(w, name, normal);
        stop(w, &format!("{name}.stop"), [begin, end, full]);
        if let Some((_, stiffness, angle)) = SPRINGS.iter().find(|s| s.0 == name) {
            spring(w, name, stiffness, angle);
        }
    }
    for (name, [normal, full, begin, end]) in HINGES {
        damping(w, name, normal);
        for (key, side) in [("lower_stop", 1), ("upper_stop", 2)] {
            let (begin, end) = (format!("{begin}({side})"), format!("{end}({side})"));
            stop(w, &format!("{name}.{key}"), [&begin, &end, full]);
        }
    }
}

fn damping(w: &mut Writer<'_>, name: &str, field: &str) {
    let value = w.quantity(field);
    w.set_with(&format!("{name}.damping"), &value, field);
}

/// A stop whose two angles are blank or zero is none.
fn stop(w: &mut Writer<'_>, key: &str, [begin, end, full]: [&str; 3]) {
    if w.value(begin) == 0.0 && w.value(end) == 0.0 {
        w.report.assumptions.push(format!("{begin} and {end} are both zero: no stop ({key}), {full} is not used"));
        return;
    }
    let [from, to, damping] = [begin, end, full].map(|name| w.quantity(name));
    w.set_with(
        key,
        &format!("{{ begin = {from}, full = {to}, damping = {damping} }}"),
        &format!("{begin}, {end}, {full}"),
    );
}

fn spring(w: &mut Writer<'_>, name: &str, stiffness: &str, angle: &str) {
    if w.value(stiffness) == 0.0 {
        return;
    }
    let value = w.quantity(stiffness);
    w.set_with(&format!("{name}.stiffness"), &value, stiffness);
    if w.value("NPOS") == 1.0 {
        let rest = w.quantity(angle);
        w.set_with(&format!("{name}.rest_angle"), &rest, &format!("card 6a, {angle}"));
    }
}
