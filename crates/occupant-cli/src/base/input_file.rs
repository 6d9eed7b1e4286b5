//! Files that are read whole.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::names::ending;

/// Megabytes that a text may have: what it is read into takes up to fifty times as much.
const MOST_OF_TEXT: u64 = 32;
/// The same of a scenario or study, whose every word becomes a place.
const MOST_OF_SCENARIO: u64 = 8;

/// The bytes of a file.
///
/// # Errors
/// A file that cannot be read, as [`bytes`] says.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    bytes(path).map_err(|error| Failure::plain(format!("{} cannot be read: {error}", path.display())))
}

/// The bytes of a file that a user or a text names. Results may be of any size.
///
/// # Errors
/// What the operating system refuses; what is no ordinary file, such as a pipe that nobody may ever write into or a device
/// without end; more than a text may have ([`ErrorKind::InvalidData`]).
pub(crate) fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    let found = fs::metadata(path)?;
    if !found.is_file() && !found.is_dir() {
        return Err(io::Error::other(
            "it is a pipe or a device, not an ordinary file; save what it gives in one first",
        ));
    }
    let most = match ending(path).as_str() {
        "mcap" => u64::MAX,
        "toml" | "json" => MOST_OF_SCENARIO * 1_000_000,
        _ => MOST_OF_TEXT * 1_000_000,
    };
    if found.len() > most {
        let (size, most) = (found.len() as f64 / 1e6, most / 1_000_000);
        let found = format!("it has {size:.1} MB, and such a text may have at most {most} MB");
        return Err(io::Error::new(ErrorKind::InvalidData, found));
    }
    fs::read(path)
}

/// What stands in a folder, sorted.
///
/// # Errors
/// What the operating system refuses.
pub(crate) fn entries(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut paths = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<PathBuf>>>()?;
    paths.sort();
    Ok(paths)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neither_devices_nor_texts_without_measure_are_read() {
        let refused = |path: &Path| bytes(path).unwrap_err().to_string();
        if cfg!(unix) {
            assert!(refused(Path::new("/dev/zero")).contains("not an ordinary file"));
        }
        let folder = tempfile::tempdir().unwrap();
        let long = folder.path().join("long.toml");
        fs::File::create(&long).unwrap().set_len(8_000_001).unwrap();
        assert!(refused(&long).contains("8.0 MB, and such a text may have at most 8 MB"), "{}", refused(&long));
    }
}
