//! Hashes of the complete files of a folder: `SHA256SUMS`, as `sha256sum -c` reads it; those of a block's runs stand in its
//! journal, then in its part.
//!
//! A line is appended as soon as a file has its name; of two lines for one file the later counts. A file without a line
//! was incomplete when its process was killed, and is made again; a file that differs from its line is damaged.

use std::collections::BTreeMap;
use std::fs::{self, OpenOptions};
use std::io::{ErrorKind, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard};

use super::folder::{JOURNAL, PARTS};
use super::problem::Problem;
use crate::base::names::stays_within;
use crate::base::{Existing, remove_if_there, sha256_of_file, write_whole};

/// Number of characters of a checksum.
const SUM: usize = 64;

/// Name of the checksum file.
pub const SUMS: &str = "SHA256SUMS";

/// The sample of a whole run, by its name.
pub fn sample_of(name: &str) -> Option<u64> {
    name.strip_prefix("runs/")?.split('.').next()?.parse().ok()
}

/// Checksums of a folder, and which of its files are intact.
#[derive(Debug)]
pub struct Checksums {
    folder: PathBuf,
    /// The file with the checksums.
    list: PathBuf,
    /// By name, relative to the folder.
    listed: Mutex<BTreeMap<String, Listed>>,
}

#[derive(Debug)]
struct Listed {
    sum: String,
    /// Whether the file is intact; none if it is missing or was not checked.
    sound: Option<bool>,
}

impl Checksums {
    /// Reads the checksums of a folder and verifies the files whose names `wanted` selects.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn open(folder: &Path, wanted: impl Fn(&str) -> bool) -> Result<Checksums, Problem> {
        Checksums::read(folder, folder.join(SUMS), wanted)
    }

    /// Reads the checksums that stand in `list` and verifies the files whose names `wanted` selects.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn read(folder: &Path, list: PathBuf, wanted: impl Fn(&str) -> bool) -> Result<Checksums, Problem> {
        let text = match fs::read(&list) {
            Err(error) if error.kind() == ErrorKind::NotFound => Vec::new(),
            read => read.map_err(Problem::io("read", &list))?,
        };
        let text = String::from_utf8_lossy(&text);
        // what a killed process has left of its last line has no end; the next one is appended to it and is lost as well
        let lines = text.split_inclusive('\n').filter_map(|line| line.strip_suffix('\n')?.split_once("  "));
        let sums = Checksums { folder: folder.to_owned(), list, listed: Mutex::default() };
        for (sum, name) in lines {
            sums.learn(name, sum, false);
        }
        let names: Vec<String> = sums.listed().keys().filter(|name| wanted(name)).cloned().collect();
        for name in names {
            let sum = sums.listed()[&name].sum.clone();
            sums.learn(&name, &sum, true);
        }
        Ok(sums)
    }

    /// Takes a checksum from elsewhere; whether the file is intact is looked at with `verify`.
    pub fn learn(&self, name: &str, sum: &str, verify: bool) {
        if sum.len() != SUM || !stays_within(name) {
            return;
        }
        let sound = || match sha256_of_file(&self.folder.join(name)) {
            Err(error) if error.kind() == ErrorKind::NotFound => None,
            found => Some(found.is_ok_and(|found| found == sum)),
        };
        let sound = if verify { sound() } else { None };
        self.listed().insert(name.to_owned(), Listed { sum: sum.to_owned(), sound });
    }

    /// Names and checksums of the whole runs of these samples.
    pub fn runs_of(&self, samples: &Range<u64>) -> BTreeMap<String, String> {
        let listed = self.listed();
        let ours = listed.iter().filter(|(name, _)| sample_of(name).is_some_and(|index| samples.contains(&index)));
        ours.map(|(name, file)| (name.clone(), file.sum.clone())).collect()
    }

    fn listed(&self) -> MutexGuard<'_, BTreeMap<String, Listed>> {
        self.listed.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }

    fn name(&self, path: &Path) -> String {
        let parts = path.strip_prefix(&self.folder).unwrap_or(path).components();
        parts.map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
    }

    /// Damaged files that were not recomputed.
    pub fn damaged(&self) -> Vec<PathBuf> {
        let listed = self.listed();
        let damaged = listed.iter().filter(|(_, file)| file.sound == Some(false));
        damaged.map(|(name, _)| self.folder.join(name)).collect()
    }

    /// Whether a file exists and is intact.
    pub fn holds(&self, path: &Path) -> bool {
        path.exists() && self.listed().get(&self.name(path)).is_some_and(|file| file.sound == Some(true))
    }

    /// Adds the checksum of a complete file.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn add(&self, path: &Path) -> Result<(), Problem> {
        let sum = sha256_of_file(path).map_err(Problem::io("read", path))?;
        let (name, list) = (self.name(path), &self.list);
        let mut listed = self.listed();
        if listed.get(&name).is_none_or(|file| file.sum != sum) {
            let appended = OpenOptions::new().create(true).append(true).open(list);
            let line = format!("{sum}  {name}\n");
            appended.and_then(|mut file| file.write_all(line.as_bytes())).map_err(Problem::io("write", list))?;
        }
        listed.insert(name, Listed { sum, sound: Some(true) });
        Ok(())
    }

    /// Renames a damaged file so that it is ignored; its content will be recomputed.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn put_aside(&self, path: &Path) -> Result<(), Problem> {
        // whoever reads all files of the folder of parts does not meet it
        let is_part = path.parent().is_some_and(|folder| folder.ends_with(PARTS));
        let place =
            if is_part { self.folder.join(JOURNAL).join(path.file_name().unwrap_or_default()) } else { path.into() };
        match fs::rename(path, place.with_extension("damaged")) {
            // another process was quicker
            Err(error) if error.kind() == ErrorKind::NotFound => {}
            renamed => renamed.map_err(Problem::io("rename", path))?,
        }
        self.listed().remove(&self.name(path));
        Ok(())
    }

    /// Removes a file that is listed.
    ///
    /// # Errors
    /// An error of the operating system.
    pub fn remove(&self, path: &Path) -> Result<(), Problem> {
        let listed = self.listed().remove(&self.name(path));
        Ok(listed.map_or(Ok(()), |_| remove_if_there(path))?)
    }

    /// Rewrites the checksum file, one line per existing file.
    ///
    /// # Errors
    /// Files that are damaged still; an error of the operating system.
    pub fn close(self) -> Result<(), Problem> {
        if let Some(path) = self.damaged().into_iter().next() {
            return Err(Problem::Unmended { path });
        }
        let listed = self.listed();
        let there = listed.iter().filter(|(name, _)| self.folder.join(name).exists());
        let lines: String = there.map(|(name, file)| format!("{}  {name}\n", file.sum)).collect();
        write_whole(&self.list, Existing::Replace, lines.as_bytes())?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Otherwise `/dev/zero` would be read, and a file of another owner renamed.
    #[test]
    fn only_files_of_the_folder_are_listed() {
        let there = tempfile::tempdir().unwrap();
        let outside = there.path().join("outside");
        fs::write(&outside, "x").unwrap();
        let folder = there.path().join("folder");
        fs::create_dir_all(folder.join("runs")).unwrap();
        let sum = "0".repeat(SUM);
        let names = ["../outside", "runs/1.mcap/../../../outside", &outside.display().to_string(), "./x", ""];
        let lines: String = names.map(|name| format!("{sum}  {name}\n")).concat();
        fs::write(folder.join(SUMS), lines + &format!("short  runs/1.mcap\n{sum}  runs/2.mcap\n")).unwrap();
        let sums = Checksums::open(&folder, |_| true).unwrap();
        assert!(sums.damaged().is_empty());
        assert_eq!(sums.listed().keys().collect::<Vec<_>>(), ["runs/2.mcap"]);
    }

    #[test]
    fn a_changed_file_is_damaged_until_it_is_made_again_and_a_torn_line_lists_nothing() {
        let there = tempfile::tempdir().unwrap();
        let [a, b] = ["a", "b"].map(|name| there.path().join(name));
        let open = || Checksums::open(there.path(), |_| true).unwrap();
        for path in [&a, &b] {
            fs::write(path, "whole").unwrap();
            open().add(path).unwrap();
        }
        assert!(open().holds(&a) && open().damaged().is_empty());
        fs::write(&a, "whola").unwrap();
        let sums = open();
        assert!(!sums.holds(&a) && sums.holds(&b));
        assert_eq!(sums.damaged(), std::slice::from_ref(&a));
        assert!(matches!(open().close(), Err(Problem::Unmended { .. })));
        sums.add(&a).unwrap();
        assert!(sums.holds(&a) && sums.damaged().is_empty());
        sums.close().unwrap();
        let list = fs::read_to_string(there.path().join(SUMS)).unwrap();
        assert_eq!(list.lines().count(), 2);
        fs::write(there.path().join(SUMS), &list[..list.len() - 1]).unwrap();
        assert!(open().holds(&a) && !open().holds(&b));
    }
}
