//! Writing a test: SI values in SAE J211 axes, one file a channel.

use std::collections::HashSet;
use std::fmt::Write as _;
use std::path::PathBuf;

use crash_measures::signal::uniform_interval;
use occupant_core::model::Model;
use occupant_units::unit::Unit;

use super::header::write;
use crate::channel_code::{Code, Place, place_of};
use crate::history::{Column, Histories};

/// Metadata of the test.
#[derive(Clone, Debug)]
pub struct Labels {
    /// Name of the test and of its files.
    pub name: String,
    /// Its title.
    pub title: String,
    /// The program that wrote it.
    pub program: String,
    /// Position code of the occupant.
    pub seat: char,
    /// Fine location 3 of the occupant.
    pub dummy: String,
    /// Remarks of the test file, one line each.
    pub remarks: Vec<String>,
}

/// A file's path in the test's folder, and its text.
type NamedText = (PathBuf, String);

/// The files of a test with their paths in its folder, and the channels without a code.
///
/// # Errors
/// Times that are not equally spaced, channels without a value for each, or no channel with a code.
pub fn files(model: &Model, histories: &Histories, labels: &Labels) -> Result<(Vec<NamedText>, Vec<String>), String> {
    let interval_s = uniform_interval(&histories.time_s)
        .map_err(|e| format!("ISO-MME channels need equally spaced samples ({e}); resample them with --interval"))?;
    histories.check()?;
    let (mut files, mut codes) = (Vec::new(), HashSet::new());
    let mut without = Vec::new();
    let mut list = String::new();
    for column in &histories.columns {
        let coded = place_of(model, &column.channel)
            .and_then(|p| Some((p, Code::new(&p, labels.seat, &labels.dummy, column.class)?)));
        // a code stands for one channel
        let Some((place, code)) = coded.filter(|(_, code)| codes.insert(*code)) else {
            without.push(column.channel.name.clone());
            continue;
        };
        let number = files.len() + 1;
        let text = channel_file(column, &place, &code, interval_s, histories.time_s[0]);
        let heading = format!("Name of channel {number:03}");
        write(&mut list, &heading, &format!("{code} / {}", column.channel.name));
        files.push((PathBuf::from(format!("Channel/{}.{number:03}", labels.name)), text));
    }
    if files.is_empty() {
        return Err("none of these channels has an ISO-MME code".to_owned());
    }
    let count = files.len().to_string();
    let mut chn = String::new();
    write(&mut chn, "Instrumentation standard", "SAE J211");
    write(&mut chn, "Number of channels", &count);
    chn.push_str(&list);
    files.push((PathBuf::from(format!("Channel/{}.chn", labels.name)), chn));
    files.push((PathBuf::from(format!("{}.mme", labels.name)), test_file(labels)));
    Ok((files, without))
}

fn test_file(labels: &Labels) -> String {
    let mut text = String::new();
    let mut put = |name: &str, value: &str| write(&mut text, name, value);
    put("Data format edition number", "1.6");
    put("Laboratory name", &labels.program);
    put("Laboratory test ref. number", &labels.name);
    put("Title", &labels.title);
    put("Type of the test", "simulation");
    put("Number of test objects", "1");
    for remark in &labels.remarks {
        put("Comments", remark);
    }
    text
}

fn channel_file(column: &Column, place: &Place, code: &Code, interval_s: f64, first_s: f64) -> String {
    let channel = &column.channel;
    let mut text = String::with_capacity(20 * column.values.len() + 1000);
    let mut put = |name: &str, value: &str| write(&mut text, name, value);
    put("Test object number", "1");
    put("Name of the channel", &channel.meaning);
    put("Channel code", &code.to_string());
    put("Laboratory channel code", &channel.name);
    put("Customer channel code", &channel.name);
    put("Unit", unit(channel.unit));
    put("Reference channel", "implicit");
    put("Reference channel name", "NOVALUE");
    let class = column.class.map(|c| c.hertz().to_string());
    put("Channel frequency class", class.as_deref().unwrap_or("NOVALUE"));
    put("Sampling interval", &interval_s.to_string());
    put("Time of first sample", &first_s.to_string());
    put("Number of samples", &column.values.len().to_string());
    for value in &column.values {
        // minus zero is zero
        let signed = value * place.sign + 0.0;
        let _ = if value.is_finite() { writeln!(text, "{signed}") } else { writeln!(text, "NOVALUE") };
    }
    text
}

/// Unit names in ISO-MME files.
const fn unit(unit: Unit) -> &'static str {
    match unit {
        Unit::MetrePerSecondSquared => "m/(s*s)",
        Unit::RadianPerSecondSquared => "rad/(s*s)",
        Unit::NewtonMetre => "Nm",
        Unit::One => "-",
        unit => unit.symbol(),
    }
}
