//! TDMS, the files of LabVIEW and DIAdem: segments of objects with properties and of their raw data. Channels of numbers become signals; their
//! times are those of their waveform properties, or of a channel of times in their group.
//!
//! Written after National Instruments' public description. Raw data of DAQmx and scales that are applied on reading are refused, not guessed.

use std::path::Path;

use crate::base::{Failure, input_file, sha256};
use crate::signals::{Recording, Signal, scale_of, seconds_in};
use crate::trouble::Trouble;

const INTERLEAVED: u32 = 1 << 5;
const BIG_ENDIAN: u32 = 1 << 6;
const DAQMX: u32 = 1 << 7;
const NEW_LIST: u32 = 1 << 2;
const METADATA: u32 = 1 << 1;
const RAW: u32 = 1 << 3;
/// Length of the header of a segment.
const HEAD: usize = 28;
/// Largest number of values of all channels.
const MOST_VALUES: usize = 20_000_000;

/// A channel, a group or the file.
#[derive(Clone, Debug, Default)]
struct Object {
    path: String,
    properties: Vec<(String, Property)>,
    /// Type and number of its values per chunk.
    index: Option<(u32, usize)>,
    values: Vec<f64>,
}

#[derive(Clone, Debug, PartialEq)]
enum Property {
    Number(f64),
    Text(String),
    Other,
}

/// Reads a file.
///
/// # Errors
/// Unreadable parts, with their problems.
pub(super) fn read(path: &Path) -> Result<Recording, Failure> {
    let bytes = input_file::read(path)?;
    let objects = objects(&bytes).map_err(|found| Trouble::of(path, found, "a TDMS file of numbers"))?;
    let (mut signals, mut notes) = (Vec::new(), Vec::new());
    for object in objects.iter().filter(|object| !object.values.is_empty()) {
        match object.signal(&objects, path) {
            Ok(Some(signal)) => signals.push(signal),
            Ok(None) => {}
            Err(why) => notes.push(format!("{}: {why}: skipped", object.path)),
        }
    }
    if signals.is_empty() {
        let found = notes.first().cloned().unwrap_or_else(|| "no numeric channel".to_owned());
        return Err(Trouble::of(path, found, "numeric channels with times").into());
    }
    Ok(Recording { path: path.to_owned(), sha256: sha256(&bytes), signals, notes })
}

impl Object {
    /// Names of its group and of itself, without quotes.
    fn names(&self) -> Vec<String> {
        let inner = self.path.trim_start_matches('/').trim_matches('\'');
        inner.split("'/'").map(|name| name.replace("''", "'")).collect()
    }

    fn number(&self, name: &str) -> Option<f64> {
        self.properties.iter().find_map(|(own, value)| match value {
            Property::Number(x) if own == name => Some(*x),
            _ => None,
        })
    }

    fn unit(&self) -> Option<String> {
        let names = ["unit_string", "NI_UnitDescription", "unit", "Unit"];
        let text = |(own, value): &(String, Property)| match value {
            Property::Text(text) if names.contains(&own.as_str()) && !text.trim().is_empty() => {
                Some(text.trim().to_owned())
            }
            _ => None,
        };
        self.properties.iter().find_map(text)
    }

    /// Seconds per unit of its values, if it is a time channel.
    fn seconds(&self) -> Option<f64> {
        let name = self.names().pop()?.to_lowercase();
        let is_time = ["time", "t", "zeit", "x"].iter().any(|own| name == *own || name.starts_with(&format!("{own} ")));
        is_time.then(|| self.unit().and_then(|unit| seconds_in(&unit)).unwrap_or(1.0))
    }

    /// As a signal; none for a time channel.
    fn signal(&self, all: &[Object], path: &Path) -> Result<Option<Signal>, String> {
        let mut names = self.names();
        let name = names.pop().unwrap_or_default();
        if self.number("NI_Number_Of_Scales").is_some_and(|count| count > 0.0) {
            return Err("its values are scaled on reading; export the scaled values from DIAdem or LabVIEW".to_owned());
        }
        let step = self.number("wf_increment").filter(|step| *step > 0.0);
        let time_s: Vec<f64> = match step {
            Some(step) => {
                let from = self.number("wf_start_offset").unwrap_or(0.0);
                (0..self.values.len()).map(|i| from + i as f64 * step).collect()
            }
            None if self.seconds().is_some() => return Ok(None),
            None => {
                let beside = |other: &&Object| {
                    other.values.len() == self.values.len()
                        && other.names().first() == names.first()
                        && other.seconds().is_some()
                };
                let times = all
                    .iter()
                    .find(beside)
                    .ok_or("it has no times, neither wf_increment nor a channel of times beside it")?;
                let second = times.seconds().unwrap_or(1.0);
                times.values.iter().map(|t| t * second).collect()
            }
        };
        if time_s.windows(2).any(|pair| pair[1] <= pair[0]) || time_s.iter().any(|t| !t.is_finite()) {
            return Err("its times do not increase".to_owned());
        }
        // one name in several groups
        let is_twice = all.iter().filter(|other| other.names().last() == Some(&name)).count() > 1;
        let full = if is_twice && !names.is_empty() { format!("{}/{name}", names.join("/")) } else { name.clone() };
        let (bare, own) = placed_text::name_and_unit(&full);
        let unit = self.unit().or_else(|| own.map(str::to_owned));
        Ok(Some(Signal {
            code: name.parse().ok(),
            scale: unit.as_deref().and_then(scale_of),
            unit,
            name: bare.to_owned(),
            time_s,
            values: self.values.clone(),
            place: format!("{}:{}", path.display(), self.path),
        }))
    }
}

/// All objects of a file with their values.
fn objects(bytes: &[u8]) -> Result<Vec<Object>, String> {
    let (mut all, mut active, mut at): (Vec<Object>, Vec<usize>, usize) = (Vec::new(), Vec::new(), 0);
    while at + HEAD <= bytes.len() {
        if &bytes[at..at + 4] != b"TDSm" {
            return Err(format!("no segment at byte {at}"));
        }
        let mut toc = Words { bytes, at: at + 4, is_big: false };
        let mask = toc.u32()?;
        let mut words = Words { bytes, at: at + 8, is_big: mask & BIG_ENDIAN != 0 };
        let _version = words.u32()?;
        let [next, raw] = [words.u64()?, words.u64()?];
        let start = at + HEAD;
        let place = |offset: u64| usize::try_from(offset).ok().and_then(|offset| start.checked_add(offset));
        // a file that was not closed: up to its end
        let end = place(next).filter(|end| *end <= bytes.len()).unwrap_or(bytes.len());
        let raw = place(raw).filter(|raw| (start..=end).contains(raw)).ok_or("raw data beyond the end of the file")?;
        if mask & METADATA != 0 {
            words.metadata(&mut all, &mut active, mask & NEW_LIST != 0)?;
        }
        if mask & RAW != 0 {
            if mask & DAQMX != 0 {
                return Err(
                    "raw data of DAQmx, which are scaled on reading; export them from DIAdem or LabVIEW as numbers"
                        .to_owned(),
                );
            }
            let mut data = Words { bytes: &bytes[..end], at: raw, is_big: words.is_big };
            data.raw(&mut all, &active, mask & INTERLEAVED != 0)?;
        }
        at = end;
    }
    if all.is_empty() { Err("no segment".to_owned()) } else { Ok(all) }
}

/// Reader of consecutive numbers.
struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
    is_big: bool,
}

impl Words<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let part =
            self.at.checked_add(N).and_then(|to| self.bytes.get(self.at..to)).ok_or("the file ends too early")?;
        self.at += N;
        let mut bytes: [u8; N] = part.try_into().map_err(|_| "the file ends too early")?;
        if self.is_big {
            bytes.reverse();
        }
        Ok(bytes)
    }

    fn u32(&mut self) -> Result<u32, String> {
        self.take().map(u32::from_le_bytes)
    }

    fn u64(&mut self) -> Result<u64, String> {
        self.take().map(u64::from_le_bytes)
    }

    fn text(&mut self) -> Result<String, String> {
        let length = self.u32()? as usize;
        let part =
            self.at.checked_add(length).and_then(|to| self.bytes.get(self.at..to)).ok_or("the file ends too early")?;
        self.at += length;
        Ok(String::from_utf8_lossy(part).into_owned())
    }

    /// A number of a type; none for a non-numeric type.
    fn number(&mut self, kind: u32) -> Result<Option<f64>, String> {
        Ok(Some(match kind {
            1 => f64::from(i8::from_le_bytes(self.take()?)),
            2 => f64::from(i16::from_le_bytes(self.take()?)),
            3 => f64::from(i32::from_le_bytes(self.take()?)),
            4 => i64::from_le_bytes(self.take()?) as f64,
            5 | 0x21 => f64::from(u8::from_le_bytes(self.take()?)),
            6 => f64::from(u16::from_le_bytes(self.take()?)),
            7 => f64::from(self.u32()?),
            8 => self.u64()? as f64,
            9 | 0x19 => f64::from(f32::from_le_bytes(self.take()?)),
            10 | 0x1a => f64::from_le_bytes(self.take()?),
            0x44 => {
                self.take::<16>()?;
                return Ok(None);
            }
            other => return Err(format!("values of the type {other:#x}")),
        }))
    }

    /// The objects of a segment; `active` are those in its raw data, in order.
    fn metadata(&mut self, all: &mut Vec<Object>, active: &mut Vec<usize>, is_new: bool) -> Result<(), String> {
        if is_new {
            active.clear();
        }
        for _ in 0..self.u32()? {
            let path = self.text()?;
            let at = all.iter().position(|object| object.path == path).unwrap_or_else(|| {
                all.push(Object { path, ..Object::default() });
                all.len() - 1
            });
            match self.u32()? {
                u32::MAX => active.retain(|own| *own != at),
                0 => active.extend((!active.contains(&at)).then_some(at)),
                0x1269 | 0x1369 => return Err("raw data of DAQmx, which are scaled on reading".to_owned()),
                _ => {
                    let (kind, _dimension, count) = (self.u32()?, self.u32()?, self.u64()?);
                    if kind == 0x20 {
                        self.u64()?;
                    }
                    all[at].index = Some((kind, usize::try_from(count).map_err(|_| "too many values")?));
                    active.extend((!active.contains(&at)).then_some(at));
                }
            }
            for _ in 0..self.u32()? {
                let (name, kind) = (self.text()?, self.u32()?);
                let value = match kind {
                    0x20 => Property::Text(self.text()?),
                    _ => self.number(kind)?.map_or(Property::Other, Property::Number),
                };
                all[at].properties.retain(|(own, _)| *own != name);
                all[at].properties.push((name, value));
            }
        }
        Ok(())
    }

    /// Raw data to the end: chunks of all active objects.
    fn raw(&mut self, all: &mut [Object], active: &[usize], is_interleaved: bool) -> Result<(), String> {
        let indices: Vec<(usize, u32, usize)> =
            active.iter().filter_map(|&at| all[at].index.map(|(kind, count)| (at, kind, count))).collect();
        if let Some((at, ..)) = indices.iter().find(|(_, kind, _)| *kind == 0x20) {
            return Err(format!("texts as values of {}", all[*at].path));
        }
        if indices.iter().all(|(.., count)| *count == 0) {
            return Ok(());
        }
        while self.at < self.bytes.len() {
            let rounds = if is_interleaved { indices.iter().map(|(.., count)| *count).max().unwrap_or(0) } else { 1 };
            for round in 0..rounds {
                for &(at, kind, count) in &indices {
                    let values = if is_interleaved { usize::from(round < count) } else { count };
                    for _ in 0..values {
                        // a file that was not closed may end within a chunk
                        if self.at >= self.bytes.len() {
                            return Ok(());
                        }
                        let value = self.number(kind)?.unwrap_or(f64::NAN);
                        all[at].values.push(value);
                    }
                }
            }
            if all.iter().map(|object| object.values.len()).sum::<usize>() > MOST_VALUES {
                return Err(format!("more than {MOST_VALUES} values"));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of one segment: two channels of doubles and floats with waveform properties and units, an integer without times.
    pub fn file(is_interleaved: bool) -> Vec<u8> {
        let text = |text: &str| [&(text.len() as u32).to_le_bytes()[..], text.as_bytes()].concat();
        let unit = |unit: &str| [text("unit_string"), 0x20_u32.to_le_bytes().to_vec(), text(unit)].concat();
        let number =
            |name: &str, x: f64| [text(name), 10_u32.to_le_bytes().to_vec(), x.to_le_bytes().to_vec()].concat();
        let channel = |path: &str, kind: u32, properties: &[Vec<u8>]| {
            let index = [20_u32.to_le_bytes(), kind.to_le_bytes(), 1_u32.to_le_bytes()].concat();
            let count = (properties.len() as u32).to_le_bytes();
            [text(path), index, 3_u64.to_le_bytes().to_vec(), count.to_vec(), properties.concat()].concat()
        };
        let wave = [number("wf_start_offset", -0.001), number("wf_increment", 0.001)];
        let metadata = [
            3_u32.to_le_bytes().to_vec(),
            [text("/"), u32::MAX.to_le_bytes().to_vec(), 0_u32.to_le_bytes().to_vec()].concat(),
            channel("/'Vehicle'/'CG X'", 10, &[vec![unit("g")], wave.to_vec()].concat()),
            channel("/'Vehicle'/'Yaw rate'", 9, &[vec![unit("deg/s")], wave.to_vec()].concat()),
        ]
        .concat();
        let (x, yaw) = ([-1.0_f64, -2.5, -3.0], [10.0_f32, 20.0, 30.0]);
        let raw: Vec<u8> = match is_interleaved {
            false => x.iter().flat_map(|v| v.to_le_bytes()).chain(yaw.iter().flat_map(|v| v.to_le_bytes())).collect(),
            true => x.iter().zip(yaw).flat_map(|(x, w)| [&x.to_le_bytes()[..], &w.to_le_bytes()].concat()).collect(),
        };
        let mask = METADATA | NEW_LIST | RAW | if is_interleaved { INTERLEAVED } else { 0 };
        let offsets = [(metadata.len() + raw.len()) as u64, metadata.len() as u64].map(u64::to_le_bytes).concat();
        [b"TDSm".to_vec(), mask.to_le_bytes().to_vec(), 4713_u32.to_le_bytes().to_vec(), offsets, metadata, raw]
            .concat()
    }

    #[test]
    fn channels_become_signals_with_times_and_units() {
        for bytes in [file(false), file(true)] {
            // a second segment of the same channels continues
            let whole = objects(&[bytes.clone(), bytes].concat()).unwrap();
            let signals: Vec<Signal> =
                whole.iter().filter_map(|o| o.signal(&whole, Path::new("a.tdms")).ok()?).collect();
            let signal = signals.iter().find(|s| s.name == "CG X").unwrap();
            assert_eq!(signal.values, [-1.0, -2.5, -3.0, -1.0, -2.5, -3.0]);
            assert!(signal.unit.as_deref() == Some("g") && (signal.time_s[2] - 0.001).abs() < 1e-15, "{signal:?}");
            assert_eq!(signals.iter().find(|s| s.name == "Yaw rate").unwrap().values[1], 20.0);
        }
    }

    #[test]
    fn no_bytes_bring_the_reader_down() {
        let whole = file(false);
        for cut in 0..whole.len() {
            let _ = objects(&whole[..cut]);
            let mut wrong = whole.clone();
            wrong[cut] ^= 0xff;
            let _ = objects(&wrong);
        }
        assert!(objects(b"no TDMS, but long enough to be a head").unwrap_err().contains("no segment"));
    }
}
