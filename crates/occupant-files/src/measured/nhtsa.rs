//! Tests of NHTSA's databases in the ASCII form of version 5: `vNNNNN.EV5` with the test record, and beside it a file for each
//! curve, `vNNNNN.001` and on (or `.tsv`), with a line `time<tab>value` for each sample.
//!
//! The record has sections of lines with fields between bars; what a curve is stands in INSTRUMENTATION. Curves that the dictionary
//! of ISO-MME has a place for are named by its codes, the others as NHTSA names them, `01_TBLU_XL_LC`. Signs are those of SAE J211.

use std::path::{Path, PathBuf};

use super::super::mme::{Code, text_of};
use super::super::signals::{Recording, Signal, finite, scale_of};
use super::super::trouble::Trouble;
use crate::base::{Failure, ending, input_file, sha256};

/// Metadata of the test.
#[derive(Clone, Debug, Default)]
pub struct TestRecord {
    /// Its title.
    pub title: String,
    /// Speed of the vehicle before the crash, km/h.
    pub speed_km_h: Option<f64>,
}

/// A line of INSTRUMENTATION: its fields and position.
struct Curve<'a> {
    line: usize,
    fields: Vec<&'a str>,
}

/// Fields of a curve.
const VEHICLE: usize = 0;
const NUMBER: usize = 1;
const SENSOR: usize = 2;
const SEAT: usize = 3;
const PLACE: usize = 4;
const AXIS: usize = 5;
const UNIT: usize = 7;
const QUALITY: usize = 17;
const REDUNDANT: usize = 18;
/// Field of VEHICLE with its speed.
const SPEED: usize = 41;

/// NHTSA's unit names, and ours.
const UNITS: [(&str, &str); 11] = [
    ("G'S", "g"),
    ("NWT", "N"),
    ("NWM", "N*m"),
    ("MM", "mm"),
    ("DEG", "deg"),
    ("DPS", "deg/s"),
    ("DP2", "deg/s^2"),
    ("KPH", "km/h"),
    ("MPS", "m/s"),
    ("RAD", "rad"),
    ("SEC", "s"),
];

/// NHTSA's sensor locations, and main and fine locations 1 to 3 of ISO-MME.
const PLACES: [(&str, &str); 10] = [
    ("HDCG", "HEADCG0000"),
    ("NEKU", "NECKUP0000"),
    ("NEKL", "NECKLO0000"),
    ("CHST", "CHST000000"),
    ("PVCN", "PELV000000"),
    ("FMRL", "FEMRLE0000"),
    ("FMRR", "FEMRRI0000"),
    ("SHBT", "SEBE0000B3"),
    ("LPBO", "SEBE0000B6"),
    ("VECG", "VEHCCG0000"),
];

/// Whether a file or folder is such a test.
pub(super) fn header(path: &Path) -> Option<PathBuf> {
    let is_header = |path: &PathBuf| ending(path) == "ev5" && path.is_file();
    match path.is_dir() {
        true => input_file::entries(path).ok()?.into_iter().find(is_header),
        false => Some(path.to_owned()).filter(is_header),
    }
}

/// Reads a test by its header file; `vehicle` is the selected one.
///
/// # Errors
/// Unreadable files, and problems in them.
pub(super) fn read(header: &Path, vehicle: u32) -> Result<(TestRecord, Recording), Failure> {
    let bytes = input_file::read(header)?;
    let text = text_of(bytes.clone());
    let (record, curves) = parsed(header, &text, vehicle)?;
    let (mut notes, mut signals, mut all_bytes) = (Vec::new(), Vec::new(), bytes.clone());
    for curve in &curves {
        let number = format!("{:0>3}", curve.fields[NUMBER]);
        let Some(file) =
            [number.clone(), format!("{number}.tsv")].iter().map(|e| header.with_extension(e)).find(|f| f.is_file())
        else {
            notes.push(format!("curve {number}, {}, has no file: skipped", curve.words()));
            continue;
        };
        let bytes = input_file::read(&file)?;
        all_bytes.extend_from_slice(&bytes);
        let (time_s, values) = samples(&file, &text_of(bytes))?;
        if !["AM", ""].contains(&curve.fields[QUALITY]) {
            notes.push(format!("curve {number}, {}, has the status {}", curve.words(), curve.fields[QUALITY]));
        }
        let mut signal = curve.signal(header, time_s, values);
        // a second sensor at one place, or moments beside forces
        if signals.iter().any(|other: &Signal| other.name == signal.name) {
            signal = Signal { name: format!("{}_{number}", signal.name), code: None, ..signal };
        }
        signals.push(signal);
    }
    if signals.is_empty() {
        let found = format!("no curve of vehicle {vehicle} beside the test record");
        let expected = format!("files {}, .002 and so on", header.with_extension("001").display());
        return Err(Trouble::of(header, found, expected).into());
    }
    Ok((record, Recording { path: header.to_owned(), sha256: sha256(&all_bytes), signals, notes }))
}

fn parsed<'a>(header: &Path, text: &'a str, vehicle: u32) -> Result<(TestRecord, Vec<Curve<'a>>), Trouble> {
    let (mut section, mut record, mut curves) = ("", TestRecord::default(), Vec::new());
    let is_own = |field: &str| field.trim().parse() == Ok(vehicle);
    for (line, words) in (1..).zip(text.lines()) {
        let words = words.trim();
        if let Some(name) = words.strip_prefix("-----") {
            section = name.trim_matches(|c| c == '-' || c == ' ');
            continue;
        }
        let fields: Vec<&str> = words.split('|').map(str::trim).collect();
        match section {
            "TEST" if fields.len() > 1 => record.title = fields[1].to_owned(),
            "VEHICLE" if fields.len() > SPEED && is_own(fields[0]) => record.speed_km_h = finite(fields[SPEED]),
            "INSTRUMENTATION" if !words.is_empty() => {
                if fields.len() <= REDUNDANT {
                    let expected = "20 fields of a curve with bars between them";
                    return Err(Trouble::at(header, line, format!("{} fields", fields.len()), expected));
                }
                // it becomes the ending of a file's name
                if fields[NUMBER].is_empty() || !fields[NUMBER].bytes().all(|digit| digit.is_ascii_digit()) {
                    let found = format!("a curve numbered `{}`", placed_text::shortened(fields[NUMBER], 40));
                    return Err(Trouble::at(header, line, found, "digits, as in the names of the curves' files"));
                }
                if is_own(fields[VEHICLE]) {
                    curves.push(Curve { line, fields });
                }
            }
            _ => {}
        }
    }
    if curves.is_empty() {
        let found = format!("no curve of vehicle {vehicle} in the section INSTRUMENTATION");
        return Err(Trouble::of(header, found, "the record of a test with its curves").hint("--vehicle names another"));
    }
    Ok((record, curves))
}

impl Curve<'_> {
    /// Title of the test, or its name.
    fn words(&self) -> String {
        self.fields.get(19).filter(|words| !words.is_empty()).map_or_else(|| self.own_name(), |w| (*w).to_owned())
    }

    fn own_name(&self) -> String {
        let mut name = [SEAT, PLACE, AXIS, SENSOR].map(|i| self.fields[i]).join("_");
        if self.fields[REDUNDANT] == "R" {
            name.push_str("_redundant");
        }
        name
    }

    /// Its code; none for redundant sensors and unknown locations or seats.
    fn code(&self) -> Option<Code> {
        let place = PLACES.iter().find(|(name, _)| *name == self.fields[PLACE])?.1;
        let seat = match self.fields[SEAT] {
            _ if place.starts_with("VEHC") => '0',
            "01" | "1" => '1',
            "02" | "2" => '3',
            "04" | "4" => '4',
            _ => return None,
        };
        let dimension = match (self.fields[SENSOR], self.fields[UNIT]) {
            ("AC", _) => "AC",
            ("AV", _) => "AV",
            ("DS", _) => "DS",
            ("LC", "NWT") => "FO",
            ("LC", "NWM") => "MO",
            _ => return None,
        };
        let direction = self.fields[AXIS].chars().next().filter(|axis| "XYZR".contains(*axis)).unwrap_or('0');
        let code = format!("1{seat}{place}{dimension}{direction}0");
        (self.fields[REDUNDANT] != "R").then(|| code.parse().ok())?
    }

    fn signal(&self, header: &Path, time_s: Vec<f64>, values: Vec<f64>) -> Signal {
        let written = self.fields[UNIT];
        let unit = UNITS.iter().find(|(name, _)| *name == written).map_or(written, |(_, unit)| unit);
        let code = self.code();
        Signal {
            name: code.map_or_else(|| self.own_name(), |code| code.to_string()),
            code,
            unit: Some(unit.to_owned()).filter(|unit| !unit.is_empty()),
            scale: scale_of(unit),
            time_s,
            values,
            place: format!("{}:{}", header.display(), self.line),
        }
    }
}

/// Times and values of a curve.
fn samples(file: &Path, text: &str) -> Result<(Vec<f64>, Vec<f64>), Trouble> {
    let (mut time_s, mut values): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    for (line, words) in (1..).zip(text.lines()).filter(|(_, words)| !words.trim().is_empty()) {
        let numbers: Vec<Option<f64>> = words.split([' ', '\t', ',']).filter(|w| !w.is_empty()).map(finite).collect();
        let [Some(t), Some(value)] = numbers[..] else {
            return Err(Trouble::at(
                file,
                line,
                format!("`{}`", placed_text::shortened(words, 40)),
                "a time and a value",
            ));
        };
        if time_s.last().is_some_and(|before| t <= *before) {
            return Err(Trouble::at(
                file,
                line,
                format!("time {t} s after {} s", time_s[time_s.len() - 1]),
                "times that increase",
            ));
        }
        time_s.push(t);
        values.push(value);
    }
    match time_s.len() {
        0 | 1 => Err(Trouble::of(file, "a curve without samples", "a line for each time")),
        _ => Ok((time_s, values)),
    }
}
