//! Identity of this build: what tells two programs of one version apart.
//!
//! On Linux it is the build id that the linker has written into the program or library (a hash of its content); elsewhere,
//! and where there is none, the SHA-256 of the program's file.

use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use super::sha256::sha256_of_file;

/// Bytes at the beginning of a program that hold its notes.
const HEAD: u64 = 1 << 16;
/// Type of a program header that points to notes, and of the note with the build id.
const PT_NOTE: u64 = 4;
const NT_GNU_BUILD_ID: u64 = 3;

/// Identity of this build in hexadecimal, found once; empty if its file cannot be read.
pub fn build() -> &'static str {
    static BUILD: OnceLock<String> = OnceLock::new();
    BUILD.get_or_init(|| {
        let files = own_object().into_iter().chain(std::env::current_exe());
        files.into_iter().find_map(|file| identity(&file)).unwrap_or_default()
    })
}

/// The file with this code: a program, or the library that a program has loaded.
fn own_object() -> Option<PathBuf> {
    let here = build as *const () as usize;
    let maps = fs::read_to_string("/proc/self/maps").ok()?;
    let holds = |line: &&str| {
        let (from, to) = line.split(' ').next().and_then(|range| range.split_once('-')).unwrap_or(("", ""));
        let [from, to] = [from, to].map(|text| usize::from_str_radix(text, 16).unwrap_or(0));
        (from..to).contains(&here)
    };
    let line = maps.lines().find(holds)?;
    line.find('/').map(|at| PathBuf::from(&line[at..]))
}

fn identity(file: &Path) -> Option<String> {
    let mut head = Vec::new();
    File::open(file).ok()?.take(HEAD).read_to_end(&mut head).ok()?;
    build_id(&head).or_else(|| sha256_of_file(file).ok())
}

/// The build id of a program in ELF, 64 bits, least byte first.
fn build_id(elf: &[u8]) -> Option<String> {
    if !elf.starts_with(b"\x7fELF\x02\x01") {
        return None;
    }
    let headers = number(elf, 0x20, 8)?;
    let [size, count] = [number(elf, 0x36, 2)?, number(elf, 0x38, 2)?];
    let header = |i: u64| elf.get(usize::try_from(headers.checked_add(i * size)?).ok()?..);
    let notes = (0..count).filter_map(header).filter(|header| number(header, 0, 4) == Some(PT_NOTE));
    let content = |header: &[u8]| {
        let from = usize::try_from(number(header, 8, 8)?).ok()?;
        let to = from.checked_add(usize::try_from(number(header, 0x20, 8)?).ok()?)?;
        noted(elf.get(from..to)?)
    };
    notes.into_iter().find_map(content)
}

/// The build id among notes.
fn noted(mut notes: &[u8]) -> Option<String> {
    loop {
        let [name, length] = [number(notes, 0, 4)? as usize, number(notes, 4, 4)? as usize];
        let begin = 12 + name.checked_next_multiple_of(4)?;
        let content = notes.get(begin..begin.checked_add(length)?)?;
        if number(notes, 8, 4)? == NT_GNU_BUILD_ID && notes.get(12..16)? == b"GNU\0" {
            return Some(content.iter().map(|byte| format!("{byte:02x}")).collect());
        }
        notes = notes.get(begin + length.checked_next_multiple_of(4)?..)?;
    }
}

/// A whole number of `length` bytes.
fn number(bytes: &[u8], at: usize, length: usize) -> Option<u64> {
    let bytes = bytes.get(at..at + length)?;
    Some(bytes.iter().rev().fold(0, |number, byte| number << 8 | u64::from(*byte)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A program of one header and two notes.
    fn program() -> Vec<u8> {
        let mut elf = vec![0; 0x40];
        elf[..6].copy_from_slice(b"\x7fELF\x02\x01");
        (elf[0x20], elf[0x36], elf[0x38]) = (0x40, 0x38, 1);
        let mut header = vec![0; 0x38];
        (header[0], header[8], header[0x20]) = (4, 0x78, 36);
        elf.extend(header);
        elf.extend(b"\x04\0\0\0\x02\0\0\0\x05\0\0\0GNU\0\x01\x02\0\0");
        elf.extend(b"\x04\0\0\0\x04\0\0\0\x03\0\0\0GNU\0\xde\xad\xbe\xef");
        elf[0x40 + 0x20] = 40;
        elf
    }

    #[test]
    fn the_note_of_the_linker_is_found_and_cut_off_or_hostile_bytes_have_none() {
        let whole = program();
        assert_eq!(build_id(&whole).as_deref(), Some("deadbeef"));
        for end in 0..whole.len() {
            assert_eq!(build_id(&whole[..end]), None, "{end}");
            let mut other = whole.clone();
            other[end] = 0xff;
            build_id(&other);
        }
    }

    #[test]
    fn this_build_is_known_and_quickly_so() {
        assert!(build().len() >= 16 && build().bytes().all(|byte| byte.is_ascii_hexdigit()), "{}", build());
        let file = if cfg!(target_os = "linux") { own_object().unwrap() } else { std::env::current_exe().unwrap() };
        assert_eq!(file.canonicalize().unwrap(), std::env::current_exe().unwrap().canonicalize().unwrap());
    }
}
