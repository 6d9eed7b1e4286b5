//! Files that are read whole.

use std::fs;
use std::io::{self, Read};
use std::path::Path;

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
/// without end, but for a pipe that is open already; more than a text may have.
pub(crate) fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    let found = fs::metadata(path)?;
    let is_pipe = is_open_pipe(path, &found);
    if !found.is_file() && !found.is_dir() && !is_pipe {
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
        return Err(io::Error::other(format!("it has {size:.1} MB, and such a text may have at most {most} MB")));
    }
    if is_pipe {
        return read_pipe(path, most);
    }
    fs::read(path)
}

/// What comes out of a pipe, until all who write it have closed it.
fn read_pipe(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    fs::File::open(path)?.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        let most = most / 1_000_000;
        return Err(io::Error::other(format!("it gives more than {most} MB, the most that such a text may have")));
    }
    Ok(bytes)
}

/// Whether it is a pipe that this process was given, such as `<(command)` of a shell: somebody writes it.
#[cfg(unix)]
fn is_open_pipe(path: &Path, found: &fs::Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt;
    let is_ours = ["/dev/fd", "/proc/self/fd", "/dev/stdin"].iter().any(|given| path.starts_with(given));
    is_ours && found.file_type().is_fifo()
}

#[cfg(not(unix))]
fn is_open_pipe(_: &Path, _: &fs::Metadata) -> bool {
    false
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
