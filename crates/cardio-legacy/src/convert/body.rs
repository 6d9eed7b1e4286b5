//! Segments and spheres (series 5 and 7).

use occupant_core::body::tti12::TTI12;

use super::writer::Writer;

const TRUNK: [(u32, &str); 4] = [(1, "middle_torso"), (2, "upper_torso"), (3, "head"), (4, "lower_torso")];
/// Left, right, and the names of both, of the left and of the right one.
const LIMBS: [(u32, u32, [&str; 3]); 4] = [
    (5, 6, ["upper_arms", "left_upper_arm", "right_upper_arm"]),
    (7, 8, ["forearms", "left_forearm", "right_forearm"]),
    (9, 10, ["thighs", "left_thigh", "right_thigh"]),
    (11, 12, ["lower_legs", "left_lower_leg", "right_lower_leg"]),
];
/// Spheres that come in pairs: the even one is the right one.
const SPHERE_PAIRS: [(usize, &str); 7] =
    [(4, "shoulders"), (6, "elbows"), (8, "hands"), (10, "thighs"), (12, "knees"), (14, "shins"), (16, "feet")];
const SEGMENT_FIELDS: [&str; 6] = ["XLE", "RHO", "XM", "XIN", "YIN", "ZIN"];

pub(super) fn write(w: &mut Writer<'_>) {
    w.table("body", "Series 5, card a");
    w.field("XLS");
    w.field("XLH");
    w.table("body.segments", "Series 5, cards b: XLE, RHO, XM, XIN YIN ZIN of each NSEG");
    for (number, name) in TRUNK {
        segment(w, number, name, &format!("NSEG {number}"));
    }
    for (left, right, [both, left_name, right_name]) in LIMBS {
        if alike(w, left, right) {
            segment(w, left, both, &format!("NSEG {left}, {right}"));
        } else {
            segment(w, left, left_name, &format!("NSEG {left}"));
            segment(w, right, right_name, &format!("NSEG {right}"));
        }
    }
    w.table("body.spheres", "Series 7, cards b–d: RS");
    for number in 1..=3 {
        sphere(w, number, TTI12.spheres()[number - 1].name, &format!("RS({number})"));
    }
    for (right, both) in SPHERE_PAIRS {
        let (one, two) = (format!("RS({right})"), format!("RS({})", right + 1));
        if w.value(&one) == w.value(&two) {
            sphere(w, right, both, &format!("{one}, {two}"));
        } else {
            sphere(w, right, TTI12.spheres()[right - 1].name, &one);
            sphere(w, right + 1, TTI12.spheres()[right].name, &two);
        }
    }
}

fn alike(w: &mut Writer<'_>, left: u32, right: u32) -> bool {
    SEGMENT_FIELDS.iter().all(|name| w.value(&format!("{name}({left})")) == w.value(&format!("{name}({right})")))
}

fn segment(w: &mut Writer<'_>, number: u32, name: &str, card: &str) {
    let [length, rho, mass, x, y, z] = SEGMENT_FIELDS.map(|field| w.quantity(&format!("{field}({number})")));
    w.comment(&format!("Card 5b, {card}"));
    w.set(&format!("{name}.length"), &length);
    w.set(&format!("{name}.cg_from_lower_end"), &rho);
    w.set(&format!("{name}.mass"), &mass);
    w.set(&format!("{name}.inertia"), &format!("[{x}, {y}, {z}]"));
}

fn sphere(w: &mut Writer<'_>, number: usize, name: &str, card: &str) {
    let radius = w.quantity(&format!("RS({number})"));
    w.set_with(&format!("{name}.radius"), &radius, card);
}
