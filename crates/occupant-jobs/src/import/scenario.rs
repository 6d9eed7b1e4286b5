//! The scenario that an import writes.

use occupant_files::measured::{Fired, Imported, Report};

use super::PathTable;
use crate::templates::with_path;

/// The driver's scenario with the path imported from `source`, which is in `file`, and what a recorder says of belt and bag.
pub fn scenario(source: &str, imported: &Imported, path: &PathTable, file: &str) -> String {
    let text = |words: &str| toml_edit::Value::from(words).to_string();
    let title = Some(imported.record.title.trim()).filter(|title| !title.is_empty());
    let title = title.map_or_else(|| source.to_owned(), str::to_owned);
    let keys = path.keys.join("\n");
    let origin = format!("{}: {}, of {}", source, path.words, title);
    let [from_s, to_s] = path.run_s;
    let begin = if from_s == 0.0 { String::new() } else { format!("start = {from_s:?}\n") };
    let time = format!("[time]                      # all of the path\n{begin}end = {to_s:?}                   # s\n");
    let section = format!("{time}\n[path]\n{keys}\nfile = {}\n", text(file));
    with_report(&with_path(&text(&title), &text(&origin), &section), &imported.report)
}

/// Whether a recorder does not say that the driver's belt was open.
pub fn is_belted(report: &Report) -> bool {
    report.belt.is_none_or(|(worn, _)| worn)
}

/// The scenario with what the report of a recorder says about belt and bag.
fn with_report(scenario: &str, report: &Report) -> String {
    let seat = "[car.seats.driver]\n";
    let mut text = scenario.to_owned();
    let put = |text: &str, after: &str, line: String| text.replacen(after, &format!("{after}{line}"), 1);
    if let Some((worn, line)) = report.belt {
        let kind = if worn { "three_point" } else { "none" };
        let said = if worn { "fastened" } else { "not fastened" };
        text = put(&text, seat, format!("belt = \"{kind}\"        # recorder, line {line}: {said}\n"));
    }
    let is_worn = is_belted(report);
    if !is_worn {
        text = text.replacen("# A belted driver", "# An unbelted driver", 1);
    }
    if let Some((Fired::No, line)) = report.pretensioner {
        text = put(&text, "pretensioner = \"100 mm\"", format!(" # recorder, line {line}: not fired, so set to 0\n"));
        text = text.replacen("pretensioner = \"100 mm\" #", "pretensioner = \"0 mm\" #", 1);
    }
    if let Some((Fired::No, line)) = report.bag {
        text += &format!("\n[car.bags]\ndriver = false              # recorder, line {line}: not fired\n");
    }
    let at = |name: &str, time_s: f64, line: usize, device: &str| {
        let ms = placed_text::number((time_s * 1e6).round() / 1e3);
        format!(
            "\n[triggers.{name}]           # recorder, line {line}\nkind = \"time\"\nat = \"{ms} ms\"\n\n[{device}]\ntrigger = \"{name}\"\ndelay = 0\n"
        )
    };
    if let Some((Fired::At(time_s), line)) = report.bag {
        text += &at("recorded_bag", time_s, line, "bags.driver");
    }
    if let Some((Fired::At(time_s), line)) = report.pretensioner.filter(|_| is_worn) {
        text += &at("recorded_pretensioner", time_s, line, "retractors.driver.pretensioner");
    }
    text
}
