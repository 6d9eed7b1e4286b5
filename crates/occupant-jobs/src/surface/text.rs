//! A fitted surface as a file, a plot and words.

use super::law::{Back, Law};
use super::{Agreement, Contact, Impactor, Surface};
use crate::base::text_table::{Align, Table};
use occupant_pictures::plot::{Axis, Curve, Figure, Sheet, Style, sheet};

/// Relative difference above which it is reported.
const ROUGH: f64 = 0.1;

/// Provenance of a surface, in its file.
#[derive(Clone, Debug, Default)]
pub struct Origin {
    /// Description; the name of the record if absent.
    pub title: Option<String>,
    /// Author and publication.
    pub source: Option<String>,
    /// Specimen.
    pub specimen: Option<String>,
    /// The impactor.
    pub impactor: Option<String>,
    /// Radius of its face, m.
    pub radius_m: Option<f64>,
    /// Date of the measurement.
    pub date: Option<String>,
    /// Licence for reuse.
    pub licence: Option<String>,
    /// Name and SHA-256 of the record.
    pub record: [String; 2],
}

/// Limitations of any such fit, and of this one.
pub(super) fn cautions(law: &Law, contact: &Contact, agreement: &Agreement) -> Vec<String> {
    let mut words = vec![
        format!("deeper than {} mm nothing was measured: the last slope goes on", digits(1e3 * contact.greatest_m())),
        "one impact at one speed: how force depends on speed, and what a second impact meets, were not measured"
            .to_owned(),
    ];
    if agreement.residual > ROUGH {
        let part = digits(100.0 * agreement.residual);
        words.push(format!(
            "computed and measured force differ by {part} % of the peak: another law than lines and a way back"
        ));
    }
    if law.points.windows(2).any(|pair| pair[1][1] < pair[0][1]) {
        words.push(
            "the force falls: the surface breaks or buckles, and a table holds for this impactor alone".to_owned(),
        );
    }
    words
}

impl Surface {
    /// The surface file, TOML.
    pub fn toml(&self, origin: &Origin, impactor: &Impactor) -> String {
        let quantity = |x: f64, unit: &str| format!("\"{} {unit}\"", digits(x));
        let list = |column: usize, scale: f64, unit: &str| {
            let each = self.law.points.iter().map(|point| quantity(scale * point[column], unit));
            format!("[{}]", each.collect::<Vec<_>>().join(", "))
        };
        let mut lines = vec![format!("title = {}", text(origin.title.as_ref().unwrap_or(&origin.record[0])))];
        lines.push("\n[material]".to_owned());
        lines.push(format!("depth = {}", list(0, 1e3, "mm")));
        lines.push(format!("force = {}", list(1, 1.0, "N")));
        match self.law.back {
            Some(Back::Share(share)) => lines.push(format!("returned = {}", digits(share))),
            Some(Back::Slope(slope)) => lines.push(format!("unload_slope = {}", quantity(1e-3 * slope, "kN/m"))),
            None => {}
        }
        lines.extend(self.friction.map(|friction| format!("friction = {}", digits(friction))));
        let basis = |is_there: bool| if is_there { "measured" } else { "not_measured" };
        lines.push("\n[measured]\nloading = \"measured\"".to_owned());
        lines.push(format!("unloading = \"{}\"", basis(self.law.back.is_some())));
        lines.push(format!("friction = \"{}\"", basis(self.friction.is_some())));
        lines.extend(self.origin(origin, impactor));
        lines.extend(self.intervals());
        let of = &self.agreement;
        lines.push("\n[agreement]                 # computed over measured".to_owned());
        lines.push(format!("peak_ratio = {}\ndepth_ratio = {}", digits(of.peak_ratio), digits(of.depth_ratio)));
        lines.extend(of.lost_ratio.map(|ratio| format!("lost_ratio = {}", digits(ratio.max(0.0)))));
        lines.push(format!("residual = {}\n", digits(of.residual)));
        lines.join("\n")
    }

    fn origin(&self, origin: &Origin, impactor: &Impactor) -> Vec<String> {
        let unsaid = || format!("the record {}; who measured it is not said", origin.record[0]);
        let mut lines = vec!["\n[provenance]".to_owned()];
        lines.push(format!("source = {}", text(&origin.source.clone().unwrap_or_else(unsaid))));
        let words = [
            ("specimen", &origin.specimen),
            ("impactor", &origin.impactor),
            ("date", &origin.date),
            ("licence", &origin.licence),
        ];
        lines.extend(words.iter().filter_map(|(key, words)| Some(format!("{key} = {}", text(words.as_ref()?)))));
        let numbers = [
            ("mass", impactor.mass_kg, "kg"),
            ("radius", origin.radius_m.map(|radius| 1e3 * radius), "mm"),
            ("speed", impactor.speed_m_s, "m/s"),
            ("angle", (impactor.angle_rad != 0.0).then_some(impactor.angle_rad.to_degrees()), "deg"),
        ];
        let number = |(key, x, unit): &(&str, Option<f64>, &str)| Some(format!("{key} = \"{} {unit}\"", digits((*x)?)));
        lines.extend(numbers.iter().filter_map(number));
        lines.push(format!("record_sha256 = {}", text(&origin.record[1])));
        let caveats: Vec<String> = self.caveats.iter().map(|caveat| format!("    {},\n", text(caveat))).collect();
        lines.push(format!("caveats = [\n{}]", caveats.concat()));
        lines
    }

    fn intervals(&self) -> Vec<String> {
        let pair = |[from, to]: [f64; 2], unit: &str| match unit {
            "" => format!("[{}, {}]", digits(from), digits(to)),
            unit => format!("[\"{} {unit}\", \"{} {unit}\"]", digits(from), digits(to)),
        };
        let force: Vec<String> = self.certainty.force_n.iter().map(|force| pair(*force, "N")).collect();
        let mut lines = vec!["\n[intervals]                 # 95 %, of noise and of the speed's error".to_owned()];
        lines.push(format!("force = [{}]", force.join(", ")));
        lines.extend(self.law.back.zip(self.certainty.back).map(|(back, range)| match back {
            Back::Share(_) => format!("returned = {}", pair(range, "")),
            Back::Slope(_) => format!("unload_slope = {}", pair(range.map(|slope| 1e-3 * slope), "kN/m")),
        }));
        lines.extend(self.certainty.friction.map(|range| format!("friction = {}", pair(range, ""))));
        lines
    }

    /// Measured and fitted, over time and over depth, SVG.
    pub fn svg(&self, title: &str) -> String {
        let contact = &self.contact;
        let points = |x: &[f64], y: &mut dyn Iterator<Item = f64>| -> Vec<[f64; 2]> {
            x.iter().zip(y).map(|(x, y)| [1e3 * x, 1e-3 * y]).collect()
        };
        let measured = || contact.force_n.iter().copied();
        let computed = || self.computed.iter().map(|row| row[1]);
        let depth: Vec<f64> = self.computed.iter().map(|row| row[0]).collect();
        let figure = |title: &str, axis: [&str; 2], curves: [Vec<[f64; 2]>; 2]| {
            let [own, fitted] = curves;
            let styles = [("measured", Style::measured(0), own), ("fitted", Style::of(1, 0), fitted)];
            Figure {
                title: title.to_owned(),
                x: Axis::of(axis[0], axis[1]),
                y: Axis::of("force", "kN"),
                curves: styles.into_iter().map(|(label, style, points)| Curve::new(label, style, points)).collect(),
                limits: Vec::new(),
                empty: String::new(),
            }
        };
        let times = [points(&contact.time_s, &mut measured()), points(&contact.time_s, &mut computed())];
        let depths = [points(&contact.depth_m, &mut measured()), points(&depth, &mut computed())];
        let figures =
            [figure("Force over time", ["time", "ms"], times), figure("Force over depth", ["depth", "mm"], depths)];
        sheet(&Sheet { title: title.to_owned(), lines: self.caveats.clone(), columns: 2 }, &figures)
    }

    /// Results for the terminal.
    pub fn words(&self) -> String {
        let range = |[from, to]: [f64; 2], scale: f64| format!("{} to {}", digits(scale * from), digits(scale * to));
        let mut table = Table::new(&[(Align::Right, &["depth mm", "force N"]), (Align::Left, &["95 %"])]);
        for (point, ends) in self.law.points.iter().zip(&self.certainty.force_n).skip(1) {
            table.row(vec![digits(1e3 * point[0]), digits(point[1]), range(*ends, 1.0)]);
        }
        let mut lines = vec![table.text().trim_end().to_owned(), String::new()];
        let ends = self.certainty.back.unwrap_or_default();
        lines.push(match self.law.back {
            Some(Back::Share(share)) => format!("returned {} ({})", digits(share), range(ends, 1.0)),
            Some(Back::Slope(slope)) => format!("unload_slope {} kN/m ({})", digits(1e-3 * slope), range(ends, 1e-3)),
            None => "way back: not measured".to_owned(),
        });
        lines.push(match (self.friction, self.certainty.friction) {
            (Some(friction), Some(ends)) => format!("friction {} ({})", digits(friction), range(ends, 1.0)),
            _ => "friction: not measured".to_owned(),
        });
        let Agreement { peak_ratio, depth_ratio, residual, .. } = self.agreement;
        let [peak, depth, off] = [peak_ratio, depth_ratio, 100.0 * residual].map(digits);
        lines.push(format!("computed over measured: peak {peak}, depth {depth}; forces differ by {off} % of the peak"));
        lines.extend(self.caveats.iter().map(|caveat| format!("! {caveat}")));
        lines.join("\n")
    }
}

/// A number with four digits.
fn digits(x: f64) -> String {
    let rounded: f64 = format!("{x:.3e}").parse().unwrap_or(x);
    format!("{rounded}")
}

/// A text of TOML.
fn text(words: &str) -> String {
    toml_edit::Value::from(words).to_string()
}
