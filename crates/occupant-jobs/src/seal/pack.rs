//! The bytes of a sealed case: sections end to end, and the seal.

use std::io::{Read as _, Write as _};
use std::path::{Component, Path};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use serde::{Deserialize, Serialize};

use crate::base::Failure;
use occupant_files::base::{ending, sha256};

/// Largest size of a case, bytes.
pub const MOST_BYTES: usize = 5_000_000;
/// Longest section of a page, bytes: an altered byte is named as closely.
const PIECE: usize = 16_384;
/// Largest part when it is unpacked, bytes.
const MOST_UNPACKED: u64 = 64 << 20;
/// Place of a picture or film on the page.
const PLACE: &str = "<p style=\"max-width:1500px;margin:0 auto;padding:0 16px 16px\">";
const WIDTH: &str = "style=\"max-width:100%\"";
const BEGIN: &str = "<!-- occupant seal 1\n";

/// A file in a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Its name, relative to the folder of the scenario, with `/`.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

impl Part {
    /// A part of this name.
    pub fn new(name: &str, bytes: Vec<u8>) -> Self {
        Part { name: name.to_owned(), bytes }
    }

    /// Whether it is small enough to be unpacked again.
    pub(super) fn can_be_unpacked(&self) -> bool {
        self.bytes.len() as u64 <= MOST_UNPACKED
    }

    /// Whether its name is a place below a folder, on every system.
    pub fn stays_inside(&self) -> bool {
        let is_below = |part| matches!(part, Component::Normal(_) | Component::CurDir);
        !self.name.is_empty()
            && !self.name.contains(['\\', ':', '\0'])
            && Path::new(&self.name).components().all(is_below)
    }
}

#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Section {
    name: String,
    start: usize,
    length: usize,
    sha256: String,
    /// SHA-256 and bytes of the part when it is unpacked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    part: Option<(String, u64)>,
}

/// A section that is not what was sealed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Its name.
    pub name: String,
    /// Its first byte, from 0.
    pub start: usize,
    /// One past its last byte.
    pub end: usize,
}

/// A sealed case, read.
#[derive(Debug)]
pub struct Case<'a> {
    bytes: &'a [u8],
    sections: Vec<Section>,
    /// What was altered.
    pub faults: Vec<Fault>,
}

/// A case of any size.
pub(super) struct Packed {
    pub bytes: Vec<u8>,
    sections: Vec<Section>,
}

/// Page with the section put in, parts and seal.
pub(super) fn pack(page: &str, section: &str, parts: &[Part]) -> Result<Packed, Failure> {
    let (before, after) = page.rsplit_once("</body>").unwrap_or((page, ""));
    let (mut bytes, mut sections) = (Vec::new(), Vec::new());
    let mut put = |name: &str, own: &[u8], part: Option<&Part>| {
        let part = part.map(|part| (sha256(&part.bytes), part.bytes.len() as u64));
        sections.push(Section {
            name: name.to_owned(),
            start: bytes.len(),
            length: own.len(),
            sha256: sha256(own),
            part,
        });
        bytes.extend_from_slice(own);
    };
    before.as_bytes().chunks(PIECE).for_each(|piece| put("the page", piece, None));
    section.as_bytes().chunks(PIECE).for_each(|piece| put("the list of inputs on the page", piece, None));
    for part in parts {
        put(&format!("part {}", part.name), packed(part)?.as_bytes(), Some(part));
    }
    put("the end of the page", format!("</body>{after}").as_bytes(), None);
    let seal = tail(&sections)?;
    bytes.extend_from_slice(seal.as_bytes());
    Ok(Packed { bytes, sections })
}

impl Packed {
    /// Its bytes.
    ///
    /// # Errors
    /// A case that is too large.
    pub(super) fn checked(self) -> Result<Vec<u8>, Failure> {
        let size = self.bytes.len();
        if size > MOST_BYTES { Err(too_large(size, &self.sections)) } else { Ok(self.bytes) }
    }
}

fn too_large(size: usize, sections: &[Section]) -> Failure {
    let parts = sections.iter().filter(|section| section.part.is_some());
    let sizes: Vec<String> = parts.clone().map(|s| format!("{} {:.2} MB", s.name, s.length as f64 / 1e6)).collect();
    let rest = (size - parts.map(|s| s.length).sum::<usize>()) as f64 / 1e6;
    let found = format!(
        "the case has {:.2} MB, the limit is {} MB: the page {rest:.2} MB, {}",
        size as f64 / 1e6,
        MOST_BYTES / 1_000_000,
        sizes.join(", ")
    );
    Failure::with_help(
        found,
        "leave out or shorten a film or an added file; a longer output.interval or an earlier time.end makes the page smaller",
    )
}

/// A part in its envelope.
fn packed(part: &Part) -> Result<String, Failure> {
    let Envelope { before, after, is_shown } = Envelope::of(&part.name);
    let content = if is_shown { STANDARD.encode(&part.bytes) } else { STANDARD.encode(gzip(&part.bytes)?) };
    Ok(format!("{before}{content}{after}"))
}

fn gzip(bytes: &[u8]) -> Result<Vec<u8>, Failure> {
    let mut gzip = GzEncoder::new(Vec::new(), Compression::best());
    let done = gzip.write_all(bytes).and_then(|()| gzip.finish());
    done.map_err(|e| Failure::plain(format!("a part cannot be compressed: {e}")))
}

/// What stands before and after the base64 of a part. No name stands here.
struct Envelope {
    before: String,
    after: &'static str,
    /// Whether the page shows that very copy: it is not compressed then.
    is_shown: bool,
}

impl Envelope {
    fn of(name: &str) -> Self {
        let kind = ending(Path::new(name));
        let tag = match &*kind {
            "png" | "gif" => format!("<img alt=\"an added picture\" {WIDTH} src=\"data:image/{kind};base64,"),
            "mp4" => format!("<video controls {WIDTH} src=\"data:video/mp4;base64,"),
            _ => {
                let before = "<script type=\"text/plain\">".to_owned();
                return Envelope { before, after: "</script>\n", is_shown: false };
            }
        };
        let after = if kind == "mp4" { "\"></video></p>\n" } else { "\"></p>\n" };
        Envelope { before: PLACE.to_owned() + &tag, after, is_shown: true }
    }
}

/// The seal: the list in one line, and its hash. No name can end the comment.
fn tail(sections: &[Section]) -> Result<String, Failure> {
    let json =
        serde_json::to_string(sections).map_err(|e| Failure::plain(format!("the seal cannot be written: {e}")))?;
    let json = json.replace('<', "\\u003c").replace('>', "\\u003e");
    let hash = sha256(json.as_bytes());
    Ok(format!("{BEGIN}{json}\n{hash} -->\n"))
}

impl<'a> Case<'a> {
    /// Reads a case and compares every section with the seal.
    ///
    /// # Errors
    /// A file whose seal is missing or altered: then nothing else in it can be judged.
    pub fn read(bytes: &'a [u8]) -> Result<Self, Failure> {
        let at = bytes.windows(BEGIN.len()).rposition(|window| window == BEGIN.as_bytes());
        let at = at.ok_or_else(|| broken("the first line of the seal is missing or altered", 0, bytes.len()))?;
        let wrong = |what: &str| broken(what, at, bytes.len());
        let sealed = std::str::from_utf8(&bytes[at..]).map_err(|_| wrong("the seal is altered"))?;
        let lines = sealed.strip_prefix(BEGIN).and_then(|rest| rest.strip_suffix(" -->\n")?.rsplit_once('\n'));
        let (json, hash) = lines.ok_or_else(|| wrong("the end of the seal is altered or cut off"))?;
        if sha256(json.as_bytes()) != hash {
            return Err(wrong("the seal's own list is altered: its SHA-256 is not that of its last line"));
        }
        let sections: Vec<Section> = serde_json::from_str(json).map_err(|e| wrong(&format!("the seal: {e}")))?;
        let mut next = 0;
        for section in &sections {
            let end = section.start.checked_add(section.length).filter(|end| section.start == next && *end <= at);
            next = end.ok_or_else(|| wrong("the sections of the seal do not lie end to end"))?;
        }
        if next != at {
            return Err(wrong("bytes stand before the seal that it does not list"));
        }
        let mut case = Case { bytes, sections, faults: Vec::new() };
        case.faults = case.sections.iter().filter(|s| sha256(case.text(s)) != s.sha256).map(Fault::of).collect();
        Ok(case)
    }

    fn text(&self, section: &Section) -> &'a [u8] {
        &self.bytes[section.start..section.start + section.length]
    }

    /// The parts, unpacked.
    ///
    /// # Errors
    /// A part that is altered or not what its seal says.
    pub fn parts(&self) -> Result<Vec<Part>, Failure> {
        let parts = self.sections.iter().filter_map(|section| Some((section, section.part.as_ref()?)));
        parts.map(|(section, (hash, length))| self.part(section, hash, *length)).collect()
    }

    fn part(&self, section: &Section, hash: &str, length: u64) -> Result<Part, Failure> {
        let wrong = || Failure::plain(format!("{} cannot be unpacked, or is not what its seal says", section.name));
        let text = std::str::from_utf8(self.text(section)).map_err(|_| wrong())?;
        let name = section.name.strip_prefix("part ").ok_or_else(wrong)?;
        let Envelope { before, after, is_shown } = Envelope::of(name);
        let text = text.strip_prefix(&*before).and_then(|text| text.strip_suffix(&after)).ok_or_else(wrong)?;
        let content = STANDARD.decode(text).map_err(|_| wrong())?;
        let mut bytes = Vec::new();
        let most = length.min(MOST_UNPACKED);
        let read = match is_shown {
            true => content.as_slice().take(most).read_to_end(&mut bytes),
            false => GzDecoder::new(&content[..]).take(most).read_to_end(&mut bytes),
        };
        let part = Part::new(name, bytes);
        let is_whole = read.is_ok() && sha256(&part.bytes) == hash && part.stays_inside();
        is_whole.then_some(part).ok_or_else(wrong)
    }
}

impl Fault {
    fn of(section: &Section) -> Self {
        Fault { name: section.name.clone(), start: section.start, end: section.start + section.length }
    }
}

fn broken(what: &str, start: usize, end: usize) -> Failure {
    Failure::BrokeOff(format!(
        "error: altered: {what} (bytes {start} to {end})\n = expected: a case written by `occupant seal`"
    ))
}
