//! Reading a test.

use std::path::{Path, PathBuf};

use super::header::{Header, entry, text_of};
use crate::base::{Failure, ending, file_name, input_file, sha256};
use crate::channel_code::Code;
use crate::signals::{Recording, Signal, finite, scale_of, seconds_in};
use crate::trouble::Trouble;

/// Reads a test by its folder or its .mme file.
///
/// # Errors
/// Missing and unreadable files, and problems in them.
pub fn read(path: &Path) -> Result<Recording, Failure> {
    let mme = if path.is_dir() { the_mme_in(path)? } else { path.to_owned() };
    // the test's file itself holds nothing that signals need
    input_file::read(&mme)?;
    let files = channel_files(&mme)?;
    let mut all_bytes = Vec::new();
    let mut channels = Vec::with_capacity(files.len());
    for file in files {
        let bytes = input_file::read(&file)?;
        all_bytes.extend_from_slice(&bytes);
        channels.push(RawChannel::read(file, &text_of(bytes))?);
    }
    let mut notes = Vec::new();
    let mut signals = Vec::with_capacity(channels.len());
    for channel in &channels {
        let time_s = channel.times(&channels)?;
        signals.push(channel.signal(time_s, &mut notes));
    }
    Ok(Recording { path: path.to_owned(), sha256: sha256(&all_bytes), signals, notes })
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    input_file::entries(folder).map_err(|e| Failure::plain(format!("{} cannot be read: {e}", folder.display())))
}

fn the_mme_in(folder: &Path) -> Result<PathBuf, Failure> {
    let is_mme = |p: &PathBuf| ending(p) == "mme";
    let mut found: Vec<PathBuf> = entries(folder)?.into_iter().filter(is_mme).collect();
    match (found.len(), found.pop()) {
        (1, Some(one)) => Ok(one),
        (0, _) => Err(Trouble::of(folder, "a folder without a .mme file", "an ISO-MME test").into()),
        (n, _) => {
            Err(Trouble::of(folder, format!("{n} .mme files"), "one test").hint("give the .mme file itself").into())
        }
    }
}

/// Files `NAME.001` and following, next to the .mme file in the folder `Channel`.
fn channel_files(mme: &Path) -> Result<Vec<PathBuf>, Failure> {
    let folder = mme.parent().filter(|p| !p.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    let is_channel = |p: &PathBuf| p.is_dir() && p.file_name().is_some_and(|n| n.eq_ignore_ascii_case("channel"));
    let Some(inside) = entries(folder)?.into_iter().find(is_channel) else {
        let found = "there is no folder Channel beside the .mme file";
        return Err(Trouble::of(mme, found, "the test's channels in Channel/").into());
    };
    let stem = mme.file_stem().unwrap_or_default();
    let own = |p: &PathBuf| {
        let number = p.extension().and_then(|e| e.to_str()).unwrap_or_default();
        let numbered = number.len() >= 3 && number.bytes().all(|b| b.is_ascii_digit());
        numbered && p.file_stem().is_some_and(|s| s.eq_ignore_ascii_case(stem))
    };
    let files: Vec<PathBuf> = entries(&inside)?.into_iter().filter(own).collect();
    if files.is_empty() {
        let found = format!("no channel files {}.001 …", stem.to_string_lossy());
        return Err(Trouble::of(&inside, found, "one file for each channel").into());
    }
    Ok(files)
}

struct RawChannel {
    path: PathBuf,
    header: Header,
    values: Vec<f64>,
    /// Line of the first value.
    first_line: usize,
}

impl RawChannel {
    fn read(path: PathBuf, text: &str) -> Result<Self, Trouble> {
        let mut channel = RawChannel { path, header: Header::default(), values: Vec::new(), first_line: 0 };
        for (i, line) in text.lines().enumerate() {
            let (number, line) = (i + 1, line.trim());
            if line.is_empty() {
                continue;
            }
            if channel.values.is_empty() {
                if let Some((name, value)) = entry(line) {
                    channel.header.push(name, value, number);
                    continue;
                }
                channel.first_line = number;
            }
            channel.values.push(channel.value(line, number)?);
        }
        channel.check_count()?;
        Ok(channel)
    }

    fn value(&self, text: &str, line: usize) -> Result<f64, Trouble> {
        let number = if text.eq_ignore_ascii_case("NOVALUE") { Some(f64::NAN) } else { finite(text) };
        number.ok_or_else(|| Trouble::at(&self.path, line, format!("`{text}`"), "a number or NOVALUE"))
    }

    fn check_count(&self) -> Result<(), Trouble> {
        let found = self.values.len();
        if found == 0 {
            return Err(Trouble::of(&self.path, "a channel without values", "one value per line"));
        }
        let Some((count, line)) = self.header.get("Number of samples") else {
            return Ok(());
        };
        let (wrong, expected) = match count.parse::<usize>() {
            Ok(n) if n == found => return Ok(()),
            Ok(n) => (format!("{found} values after a header that says {n}"), "the number of values in the header"),
            Err(_) => (format!("`{count}`"), "a number of samples"),
        };
        Err(Trouble::at(&self.path, line, wrong, expected))
    }

    /// A number of the header.
    fn number(&self, name: &str) -> Result<Option<f64>, Trouble> {
        let read = |(text, line)| {
            finite(text).ok_or_else(|| Trouble::at(&self.path, line, format!("`{text}` as {name}"), "a number"))
        };
        self.header.get(name).map(read).transpose()
    }

    fn name(&self) -> String {
        let named = self.header.get("Channel code").or_else(|| self.header.get("Name of the channel"));
        named.map_or_else(|| file_name(&self.path), |(name, _)| name.to_owned())
    }

    /// Times, s: from the header, or those of the reference channel.
    fn times(&self, all: &[RawChannel]) -> Result<Vec<f64>, Trouble> {
        let reference = self.header.get("Reference channel").map(|(r, _)| r.to_lowercase());
        if reference.as_deref() != Some("explicit") {
            return self.counted_times();
        }
        let Some((name, line)) = self.header.get("Reference channel name") else {
            let found = "an explicit reference channel without its name";
            return Err(Trouble::of(&self.path, found, "`Reference channel name`"));
        };
        let Some(times) = all.iter().find(|c| c.name() == name) else {
            let found = format!("the reference channel `{name}`, which is not in the test");
            return Err(Trouble::at(&self.path, line, found, "the code of a channel of times"));
        };
        let factor = times.header.get("Unit").and_then(|(unit, _)| seconds_in(unit)).ok_or_else(|| {
            let found = format!("`{name}` as time channel, but not in a unit of time");
            Trouble::at(&self.path, line, found, "a channel in s or ms")
        })?;
        if times.values.len() != self.values.len() {
            let found = format!("{} values at {} times", self.values.len(), times.values.len());
            return Err(Trouble::at(&self.path, line, found, "the same number of times and values"));
        }
        let time_s: Vec<f64> = times.values.iter().map(|t| t * factor).collect();
        // a missing time is no greater than another
        let greater = |i: usize| time_s[i] > time_s[i - 1];
        match (1..time_s.len()).find(|&i| !greater(i)) {
            Some(i) => Err(Trouble::at(
                &times.path,
                times.first_line + i,
                format!("time {} s after {} s", time_s[i], time_s[i - 1]),
                "times that increase",
            )),
            None => Ok(time_s),
        }
    }

    fn counted_times(&self) -> Result<Vec<f64>, Trouble> {
        let interval_s = self.number("Sampling interval")?;
        let Some(interval_s) = interval_s.filter(|dt| *dt > 0.0) else {
            let found = "no sampling interval above zero";
            return Err(Trouble::of(&self.path, found, "`Sampling interval` in seconds"));
        };
        let first_s = self.number("Time of first sample")?.unwrap_or(0.0);
        let count = self.values.len();
        Ok((0..count).map(|i| first_s + i as f64 * interval_s).collect())
    }

    fn signal(&self, time_s: Vec<f64>, notes: &mut Vec<String>) -> Signal {
        let name = self.name();
        let (unit, line) = self.header.get("Unit").map_or((None, 1), |(unit, line)| (Some(unit), line));
        let explicit = self.header.get("Reference channel").is_some();
        if !explicit && self.header.get("Time of first sample").is_none() {
            notes.push(format!("{name}: the time of the first sample is missing: 0 s is assumed"));
        }
        Signal {
            code: name.parse::<Code>().ok(),
            scale: unit.and_then(scale_of),
            unit: unit.map(str::to_owned),
            name,
            time_s,
            values: self.values.clone(),
            place: format!("{}:{line}", self.path.display()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn channel(text: &str) -> Result<RawChannel, String> {
        RawChannel::read(PathBuf::from("T.001"), text).map_err(|t| t.to_string())
    }

    const HEAD: &str = "Channel code :10VEHCCG0000ACXD\nUnit :m/(s*s)\nReference channel :implicit\n\
                        Sampling interval :0.001\nTime of first sample :-0.01\n";

    #[test]
    fn values_follow_the_header() {
        let found = channel(&format!("{HEAD}Number of samples :3\n-0\nNOVALUE\n1.5e1\n")).unwrap();
        let times = found.times(&[]).unwrap();
        let close = |(a, b): (&f64, f64)| (a - b).abs() < 1e-15;
        assert!(times.iter().zip([-0.01, -0.009, -0.008]).all(close), "{times:?}");
        let signal = found.signal(Vec::new(), &mut Vec::new());
        assert_eq!(signal.code.map(|c| c.to_string()).as_deref(), Some("10VEHCCG0000ACXD"));
        assert_eq!(signal.scale.map(|s| s.factor), Some(1.0));
        assert!(signal.values[1].is_nan() && signal.values[2] == 15.0);
    }

    #[test]
    fn times_may_be_a_channel_of_their_own() {
        let times = channel("Channel code :11TIRS0000__TI00\nUnit :ms\n1\n2\n4\n").unwrap();
        let text = "Channel code :X\nReference channel :explicit\nReference channel name :11TIRS0000__TI00\n5\n6\n7\n";
        let found = channel(text).unwrap();
        assert_eq!(found.times(&[times]).unwrap(), [0.001, 0.002, 0.004]);
        assert!(found.times(&[]).unwrap_err().to_string().contains("which is not in the test"));
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        for (text, words) in [
            (format!("{HEAD}Number of samples :3\n1\n"), "T.001:6"),
            (format!("{HEAD}1\nabc\n"), "T.001:7"),
            (HEAD.to_owned(), "without values"),
        ] {
            let message = channel(&text).err().unwrap();
            assert!(message.contains(words), "{message}");
        }
        let found = channel("Channel code :X\n1\n").unwrap();
        assert!(found.times(&[]).unwrap_err().to_string().contains("sampling interval"));
    }
}
