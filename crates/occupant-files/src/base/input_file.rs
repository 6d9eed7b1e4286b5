//! Files that are read whole.

use std::fs;
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::names::ending;

/// Largest table, MB: reading takes up to thirty times as much memory.
const MOST_OF_TABLE: u64 = 32;
/// Largest scenario or study, MB: `{a.b=1},` takes up to five hundred times as much.
const MOST_OF_SCENARIO: u64 = 2;
/// Largest deck, MB: an empty line takes a hundred times as much.
const MOST_OF_DECK: u64 = 4;

/// The bytes of a file.
///
/// # Errors
/// A file that cannot be read, as [`bytes`] says.
pub fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    bytes(path).map_err(|error| Failure::plain(format!("{} cannot be read: {error}", path.display())))
}

/// Bytes of a file named by a user or a text; `-` is standard input. Results may have any size.
///
/// # Errors
/// An error of the operating system; what is no ordinary file, such as a pipe that nobody may ever write into or a device
/// without end, but for a pipe that is open already; more than a text may have ([`ErrorKind::InvalidData`]).
pub fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    if is_input(path) {
        return read_all(io::stdin(), MOST_OF_TABLE);
    }
    let found = fs::metadata(path)?;
    let is_pipe = is_open_pipe(path, &found);
    if !found.is_file() && !found.is_dir() && !is_pipe {
        return Err(io::Error::other(
            "it is a pipe or a device, not an ordinary file; save its content to a file first",
        ));
    }
    let most = match ending(path).as_str() {
        "mcap" | "parquet" => None,
        "toml" | "json" => Some(MOST_OF_SCENARIO),
        _ => Some(MOST_OF_TABLE),
    };
    most.map_or(Ok(()), |most| within(found.len(), most))?;
    if is_pipe {
        return read_pipe(path, most.unwrap_or(MOST_OF_TABLE));
    }
    fs::read(path)
}

/// Entries of a folder, sorted.
///
/// # Errors
/// An error of the operating system.
pub fn entries(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut paths = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<PathBuf>>>()?;
    paths.sort();
    Ok(paths)
}

/// Bytes of a deck, or of another input by its extension.
///
/// # Errors
/// A file that cannot be read, as [`bytes`] says; a text that is too long for a deck.
pub fn deck(path: &Path) -> Result<Vec<u8>, Failure> {
    let bytes = read(path)?;
    let is_deck = !matches!(ending(path).as_str(), "mcap" | "toml" | "json");
    let fits = if is_deck { within(bytes.len() as u64, MOST_OF_DECK) } else { Ok(()) };
    fits.map(|()| bytes).map_err(|error| Failure::plain(format!("{} is not a deck: {error}", path.display())))
}

/// Refuses a scenario text that is too long.
///
/// # Errors
/// Its length, and the permitted length.
pub fn scenario_fits(bytes: &[u8]) -> io::Result<()> {
    within(bytes.len() as u64, MOST_OF_SCENARIO)
}

fn within(size: u64, most: u64) -> io::Result<()> {
    if size <= most * 1_000_000 {
        return Ok(());
    }
    let size = size as f64 / 1e6;
    Err(io::Error::new(ErrorKind::InvalidData, format!("it has {size:.1} MB; the limit for such a file is {most} MB")))
}

/// Bytes from a pipe until all writers have closed it; `most` in MB.
fn read_pipe(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    read_all(fs::File::open(path)?, most)
}

/// Whether a name means standard input.
pub fn is_input(path: &Path) -> bool {
    path == Path::new("-")
}

fn read_all(from: impl Read, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    from.take(most * 1_000_000 + 1).read_to_end(&mut bytes)?;
    if within(bytes.len() as u64, most).is_err() {
        let found = format!("it is longer than {most} MB, the limit for such a file");
        return Err(io::Error::new(ErrorKind::InvalidData, found));
    }
    Ok(bytes)
}

/// Whether it is a pipe given to this process, such as `<(command)` of a shell.
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
        fs::File::create(&long).unwrap().set_len(2_000_001).unwrap();
        assert!(scenario_fits(&vec![0; 2_000_001]).is_err() && scenario_fits(&vec![0; 2_000_000]).is_ok());
        let long_deck = folder.path().join("long.dat");
        fs::File::create(&long_deck).unwrap().set_len(4_000_001).unwrap();
        assert!(bytes(&long_deck).is_ok(), "a table may be as long");
        assert!(deck(&long_deck).unwrap_err().words().contains("4.0 MB"));
        assert!(refused(&long).contains("2.0 MB; the limit for such a file is 2 MB"), "{}", refused(&long));
    }
}
