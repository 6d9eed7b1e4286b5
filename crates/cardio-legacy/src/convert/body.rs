//! Segments and spheres (series 5 and 7).

use occupant_core::body::both_sides;
use occupant_core::body::tti12::TTI12;

use super::writer::Writer;

const SEGMENT_FIELDS: [&str; 6] = ["XLE", "RHO", "XM", "XIN", "YIN", "ZIN"];

pub(super) fn write(w: &mut Writer<'_>) {
    w.table("body", "Series 5, card a");
    w.field("XLS");
    w.field("XLH");
    w.table("body.segments", "Series 5, cards b: XLE, RHO, XM, XIN YIN ZIN of each NSEG");
    let names: Vec<&str> = TTI12.segment_rows().iter().map(|row| row.name).collect();
    for (name, numbers) in entries(w, &names, &SEGMENT_FIELDS) {
        let numbers: Vec<String> = numbers.iter().map(u32::to_string).collect();
        segment(w, &numbers[0], &name, &format!("NSEG {}", numbers.join(", ")));
    }
    w.table("body.spheres", "Series 7, cards b–d: RS");
    for (name, numbers) in entries(w, &TTI12.sphere_names(), &["RS"]) {
        let fields: Vec<String> = numbers.iter().map(|n| format!("RS({n})")).collect();
        let radius = w.quantity(&fields[0]);
        w.set_with(&format!("{name}.radius"), &radius, &fields.join(", "));
    }
}

/// Names in the scenario of `fields` of numbered things, and their indices: left and right, which are adjacent, are one
/// entry if they are equal.
fn entries(w: &mut Writer<'_>, names: &[&str], fields: &[&str]) -> Vec<(String, Vec<u32>)> {
    let mut entries: Vec<(String, Vec<u32>)> = Vec::new();
    for (number, name) in (1..).zip(names) {
        match (both_sides(name), entries.last_mut()) {
            (Some(both), Some((before, numbers)))
                if both_sides(before).as_ref() == Some(&both) && alike(w, fields, [number - 1, number]) =>
            {
                *before = both;
                numbers.push(number);
            }
            _ => entries.push(((*name).to_owned(), vec![number])),
        }
    }
    entries
}

/// Whether the fields of two indices are equal.
fn alike(w: &mut Writer<'_>, fields: &[&str], numbers: [u32; 2]) -> bool {
    fields.iter().all(|field| {
        let [one, two] = numbers.map(|n| w.value(&format!("{field}({n})")));
        one == two
    })
}

fn segment(w: &mut Writer<'_>, number: &str, name: &str, card: &str) {
    let [length, rho, mass, x, y, z] = SEGMENT_FIELDS.map(|field| w.quantity(&format!("{field}({number})")));
    w.comment(&format!("Card 5b, {card}"));
    w.set(&format!("{name}.length"), &length);
    w.set(&format!("{name}.cg_from_lower_end"), &rho);
    w.set(&format!("{name}.mass"), &mass);
    w.set(&format!("{name}.inertia"), &format!("[{x}, {y}, {z}]"));
}
