//! Reading a result file back as far as a run can resume it: what it says of itself, its documents, its checkpoints.

use std::collections::BTreeMap;
use std::ops::Range;

use mcap::records::op;
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::summary::RunStatus;

use super::about::{RESULT, RUN};
use super::checkpoint::{self, TOPIC};
use super::drive::DRIVE;
use super::records::{Frame, Index, Record};

/// Content of a result file, or what remains of an interrupted run.
#[derive(Clone, Debug, Default)]
pub struct StoredRun {
    /// The entries of the metadata record `occupant.run`.
    pub run: BTreeMap<String, String>,
    /// The entries of `occupant.result`; none if the run was cut off.
    pub result: Option<BTreeMap<String, String>>,
    /// Whether the file holds a drive without occupants.
    pub is_drive: bool,
    /// Attachments by name.
    pub attachments: BTreeMap<String, Vec<u8>>,
    /// Checkpoints in the file's order.
    pub checkpoints: Vec<Checkpoint>,
    /// First byte that differs from what was written, and the defect.
    damage: Option<(usize, &'static str)>,
    /// Position at which a truncated file ends.
    end: Option<usize>,
    /// Remaining memory for checkpoints, bytes.
    room: usize,
    /// Remaining expansion of compressed chunks, bytes.
    pub(super) unpacked: u64,
}

/// Largest memory for checkpoints of a small file, bytes; a large file may take a multiple of its size.
const MOST_OF_CHECKPOINTS: usize = 256 << 20;
const MOST_TIMES_FILE: usize = 8;
/// Largest expansion of the chunks of a small file, bytes; a large file may take a multiple of its size. Ours expand by
/// 2 to 5.
const MOST_UNPACKED: u64 = 256 << 20;
const MOST_TIMES_PACKED: u64 = 32;

/// Reason to stop reading.
enum Refused {
    /// The record is damaged.
    Damaged(&'static str),
    /// This version cannot use the file.
    Unknown(String),
}

impl From<&'static str> for Refused {
    fn from(what: &'static str) -> Self {
        Refused::Damaged(what)
    }
}

impl StoredRun {
    /// Reads a file to its end or its truncation. A chunk is used whole or not at all; after a damaged record, reading
    /// resumes with the next intact one.
    ///
    /// # Errors
    /// A file that is not MCAP, or a checkpoint that cannot be read, as text.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        if !bytes.starts_with(mcap::MAGIC) {
            return Err("it is not an MCAP file".to_owned());
        }
        let room = MOST_OF_CHECKPOINTS.max(bytes.len().saturating_mul(MOST_TIMES_FILE));
        let unpacked = MOST_UNPACKED.max((bytes.len() as u64).saturating_mul(MOST_TIMES_PACKED));
        let mut stored = StoredRun { room, unpacked, ..StoredRun::default() };
        let index = Index::of(bytes);
        let mut wanted = index.channels.iter().find(|(_, topic)| topic == TOPIC).map(|(id, _)| *id);
        let mut at = mcap::MAGIC.len();
        loop {
            let landmark = index.after(at);
            // no record reaches over the beginning of another one
            let frame = Frame::at(bytes, at).filter(|frame| landmark.is_none_or(|landmark| frame.next <= landmark));
            let Some(frame) = frame else {
                let Some(landmark) = landmark else {
                    stored.end = Some(at);
                    return Ok(stored);
                };
                stored.damaged(at, "a record with an inconsistent length");
                at = landmark;
                continue;
            };
            match stored.take(frame, &mut wanted) {
                Ok(()) => {}
                Err(Refused::Damaged(what)) => stored.damaged(at, what),
                Err(Refused::Unknown(why)) => return Err(why),
            }
            if frame.opcode == op::DATA_END {
                let fits = [0, crc32fast::hash(&bytes[..at])].contains(&frame.checksum());
                if !fits {
                    stored.damaged(at, "a checksum of the preceding data that does not match");
                }
                return Ok(stored);
            }
            at = frame.next;
        }
    }

    fn damaged(&mut self, at: usize, what: &'static str) {
        self.damage.get_or_insert((at, what));
    }

    /// Takes the content of a record; `wanted` is the channel of checkpoints.
    fn take(&mut self, frame: Frame<'_>, wanted: &mut Option<u16>) -> Result<(), Refused> {
        match frame.record(&mut self.unpacked)? {
            Record::Chunk(content) => {
                let before = self.checkpoints.len();
                let taken = self.take_all(&content, wanted);
                if taken.is_err() {
                    self.checkpoints.truncate(before);
                }
                return taken;
            }
            Record::Channel { id, topic } if topic == TOPIC => *wanted = Some(id),
            Record::Message { channel, data } if *wanted == Some(channel) => {
                let takes = size_of::<Checkpoint>() + data.len();
                self.room = self.room.checked_sub(takes).ok_or("more outputs than possible in a file of this size")?;
                let found = checkpoint::read(data).map_err(Refused::Unknown)?;
                if self.checkpoints.last().is_some_and(|last| last.index >= found.index) {
                    return Err("an output that is out of order".into());
                }
                self.checkpoints.push(found);
            }
            Record::Metadata { name, entries } if name == RUN => self.run = entries,
            Record::Metadata { name, entries } if name == RESULT => self.result = Some(entries),
            Record::Metadata { name, .. } if name == DRIVE => self.is_drive = true,
            Record::Attachment { name, data } => _ = self.attachments.insert(name, data.to_owned()),
            _ => {}
        }
        Ok(())
    }

    /// Takes the records of a chunk, except documents, which a small file could expand without bound.
    fn take_all(&mut self, content: &[u8], wanted: &mut Option<u16>) -> Result<(), Refused> {
        let mut at = 0;
        while at < content.len() {
            let frame = Frame::at(content, at).ok_or("a chunk with an incomplete record")?;
            if matches!(frame.opcode, op::CHUNK | op::ATTACHMENT | op::METADATA) {
                return Err("a chunk with a record that belongs outside chunks".into());
            }
            self.take(frame, wanted)?;
            at = frame.next;
        }
        Ok(())
    }

    /// Numbers of the outputs missing from the file.
    fn gaps(&self) -> Vec<Range<usize>> {
        let number = |entries: &BTreeMap<String, String>, key| entries.get(key)?.parse::<usize>().ok();
        // a resumed run has the outputs before; files of older programs have none of them and do not count them
        let has_all = self.checkpoints.first().is_some_and(|first| first.index == 0);
        let first = number(&self.run, "resumed_output").filter(|_| !has_all).unwrap_or(0);
        let count = self.result.as_ref().and_then(|result| number(result, "outputs"));
        let end = count.map(|count| first.saturating_add(count));
        let there = self.checkpoints.iter().map(|checkpoint| checkpoint.index);
        let mut next = first;
        let mut gaps = Vec::new();
        for index in there.chain(end) {
            if index > next {
                gaps.push(next..index);
            }
            next = index.saturating_add(1);
        }
        gaps
    }

    /// Description of the missing outputs; none if all up to the last are there.
    pub fn lost(&self) -> Option<String> {
        let name = |gap: &Range<usize>| match gap.end - gap.start {
            1 => gap.start.to_string(),
            _ => format!("{} to {}", gap.start, gap.end - 1),
        };
        let gaps: Vec<String> = self.gaps().iter().map(name).collect();
        let found = self.damage.map_or_else(|| "damaged".to_owned(), damaged_at);
        (!gaps.is_empty()).then(|| format!("{found}; outputs {} are missing", gaps.join(", ")))
    }

    /// How the run ended, and the reason if it did not complete; a truncated file, or one with missing outputs, counts
    /// as interrupted.
    pub fn ending(&self) -> (RunStatus, Option<String>) {
        let said = |key| self.result.as_ref()?.get(key).cloned();
        let lost = self.lost();
        let status = match said("status").as_deref() {
            Some("completed") if lost.is_none() => return (RunStatus::Completed, None),
            Some("failed") if lost.is_none() => RunStatus::Failed,
            _ => RunStatus::Interrupted,
        };
        (status, lost.or_else(|| said("reason")).or_else(|| Some("it was cut off".to_owned())))
    }

    /// Defects of the file; none for an intact or truncated one.
    pub fn flaw(&self) -> Option<String> {
        let whole = if self.result.is_some() { "; all outputs are there" } else { "" };
        self.lost().or_else(|| self.damage.map(|damage| damaged_at(damage) + whole))
    }

    /// Reason why something may be missing, as an addition to a message.
    pub fn because(&self) -> String {
        match (self.damage, self.end) {
            (Some(damage), _) => format!("; it is {}", damaged_at(damage)),
            (None, Some(end)) => format!("; it ends early, at byte {end}"),
            (None, None) => String::new(),
        }
    }
}

fn damaged_at((byte, what): (usize, &str)) -> String {
    format!("damaged at byte {byte}: {what}")
}
