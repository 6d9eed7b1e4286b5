//! The short table at the end of a run.

use occupant_core::summary::{Acceleration, FirstContact, RunStatus, Summary};

use super::recording::Written;
use super::table::Align::{Left, Right};
use super::table::{NONE, Table, facts};

/// The table: title, accelerations, belts, first contacts, and how far to trust the run.
pub fn summary_table(summary: &Summary, written: &Written) -> String {
    let mut parts = vec![title(summary), accelerations(summary)];
    if !summary.belts.is_empty() {
        parts.push(belts(summary));
    }
    if !summary.first_contacts.is_empty() {
        parts.push(first_contacts(summary));
    }
    parts.push(trust(summary, written));
    parts.join("\n")
}

fn title(summary: &Summary) -> String {
    let reached = format!("{} to {} ms", ms(summary.start_s), ms(summary.reached_s));
    let ending = match summary.status {
        RunStatus::Completed => reached,
        RunStatus::Interrupted => format!("INTERRUPTED: {reached} of {} ms", ms(summary.end_s)),
        RunStatus::Failed => format!("FAILED: {reached} of {} ms", ms(summary.end_s)),
    };
    format!("{}\n{ending}\n", summary.title)
}

fn accelerations(summary: &Summary) -> String {
    let mut table = Table::new(&[
        ("acceleration", Left),
        ("peak, g", Right),
        ("at, ms", Right),
        ("3 ms held, g", Right),
        ("from–to, ms", Right),
        ("3 ms in total, g", Right),
    ]);
    let a = &summary.accelerations;
    for (name, part) in [("head", &a.head), ("chest", &a.chest), ("pelvis", &a.pelvis)] {
        table.row(acceleration(name, part));
    }
    table.text()
}

fn acceleration(name: &str, part: &Acceleration) -> [String; 6] {
    let held = part.three_ms_contiguous;
    let total = part.three_ms_cumulative;
    [
        name.to_owned(),
        format!("{:.1}", part.peak_g),
        ms(part.peak_time_s),
        held.map_or(NONE.to_owned(), |l| format!("{:.1}", l.level_g)),
        held.map_or(NONE.to_owned(), |l| format!("{}–{}", ms(l.from_s), ms(l.to_s))),
        total.map_or(NONE.to_owned(), |l| format!("{:.1}", l.level_g)),
    ]
}

fn belts(summary: &Summary) -> String {
    let mut table = Table::new(&[
        ("belt", Left),
        ("loop force, N", Right),
        ("at, ms", Right),
        ("stretch, mm", Right),
        ("force on body, N", Right),
    ]);
    for belt in &summary.belts {
        table.row([
            belt.belt.clone(),
            format!("{:.0}", belt.loop_force_n),
            belt.time_s.map_or(NONE.to_owned(), ms),
            format!("{:.1}", belt.elongation_m * 1e3),
            format!("{:.0}", belt.body_force_n),
        ]);
    }
    table.text()
}

fn first_contacts(summary: &Summary) -> String {
    let mut table = Table::new(&[
        ("first contact", Left),
        ("surface", Left),
        ("at, ms", Right),
        ("speed, m/s", Right),
        ("greatest force, N", Right),
        ("at, ms", Right),
        ("on", Left),
    ]);
    for first in &summary.first_contacts {
        table.row(first_contact(summary, first));
    }
    table.text()
}

fn first_contact(summary: &Summary, first: &FirstContact) -> [String; 7] {
    let contact = first.contact.as_ref();
    let peaks = summary.sphere_forces.iter();
    let peak = peaks.clone().find(|p| p.sphere == first.sphere);
    let or_none = |text: Option<String>| text.unwrap_or(NONE.to_owned());
    [
        first.sphere.clone(),
        or_none(contact.map(|c| c.surface.clone())),
        or_none(contact.map(|c| ms(c.time_s))),
        or_none(contact.map(|c| format!("{:.2}", c.closing_m_s))),
        or_none(peak.map(|p| format!("{:.0}", p.force_n))),
        or_none(peak.map(|p| ms(p.time_s))),
        or_none(peak.map(|p| p.surface.clone())),
    ]
}

fn trust(summary: &Summary, written: &Written) -> String {
    let mut lines = Vec::new();
    if let Some(e) = &summary.head_excursion {
        lines.push((
            "head excursion",
            format!(
                "forward {:.0} mm at {} ms, up {:.0} mm, down {:.0} mm, left {:.0} mm, right {:.0} mm",
                e.forward_m * 1e3,
                ms(e.forward_time_s),
                e.up_m * 1e3,
                e.down_m * 1e3,
                e.left_m * 1e3,
                e.right_m * 1e3
            ),
        ));
    }
    lines.push((
        "energy balance",
        format!(
            "error {:.1e} of the greatest kinetic energy in the vehicle, {:.0} J",
            summary.energy.balance_error, summary.energy.greatest_kinetic_j
        ),
    ));
    lines.push(("integration", integration(summary)));
    match written {
        Written::Nothing => {}
        Written::Complete(path) => lines.push(("written", path.display().to_string())),
        Written::Partial(path) => {
            lines.push(("written", format!("{} (partial)", path.display())));
        }
    }
    facts(&lines)
}

fn integration(summary: &Summary) -> String {
    let s = &summary.solver;
    let rejected = match s.rejected {
        0 => String::new(),
        n => format!(" ({n} rejected)"),
    };
    let time = s.wall_time_s.map_or(String::new(), |t| format!(", {t:.3} s of wall time"));
    format!(
        "{}, {} steps{rejected}, {} evaluations, {} outputs{time}",
        s.integrator, s.steps, s.evaluations, s.outputs
    )
}

/// Seconds as milliseconds.
fn ms(time_s: f64) -> String {
    format!("{:.1}", time_s * 1e3)
}
