//! Damaged and hostile result files: no reader panics, and intact parts are used.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use mcap::records::op;
use occupant_core::results::checkpoint::Checkpoint;

use super::{recording::Recording, run};
use crate::base::{Existing, Interrupt, Units};
use crate::files::history::{Filter, Treatment, choose, load};
use crate::files::scenario::{self, ScenarioArgs};
use crate::print::read;
use crate::report::page;
use cardio_legacy::print::printout;
use occupant_files::mcap::StoredRun;
use occupant_files::mcap::records::{Frame, Record};
use occupant_files::mcap::{checkpoint, wire};
use occupant_files::results::Results;

/// Mutations of each of the two files; more on request.
fn mutations() -> u64 {
    std::env::var("OCCUPANT_MUTATIONS").ok().and_then(|n| n.parse().ok()).unwrap_or(60)
}

/// Bytes of a run with outputs every 0.1 ms, 50 in a chunk.
fn recorded(folder: &Path, end: &str) -> Vec<u8> {
    let scenario = folder.join("case.toml");
    fs::write(&scenario, include_str!("../../../occupant-cli/tests/case.toml")).unwrap();
    let overrides = vec![format!("time.end={end}"), "output.interval='0.1 ms'".to_owned()];
    let args = ScenarioArgs { scenario, overrides };
    let opened = scenario::open(&args).unwrap();
    let file = folder.join("case.mcap");
    let recording = Recording::begin(&file, Existing::Keep, &args, &opened, None).unwrap();
    run(&opened, None, recording, Vec::new(), Interrupt::default()).unwrap();
    fs::read(file).unwrap()
}

/// The same file without chunks, index and checksums: every flipped bit reaches its field.
fn bare(bytes: &[u8]) -> Vec<u8> {
    let mut bare = mcap::MAGIC.to_vec();
    let mut at = bare.len();
    while let Some(frame) = Frame::at(bytes, at) {
        let whole = &bytes[at..frame.next];
        match frame.record(&mut u64::MAX.clone()).unwrap() {
            Record::Chunk(content) => bare.extend_from_slice(&content),
            Record::Attachment { .. } => {
                bare.extend_from_slice(&whole[..whole.len() - 4]);
                bare.extend_from_slice(&[0; 4]);
            }
            _ if frame.opcode == op::DATA_END => break,
            _ => bare.extend_from_slice(whole),
        }
        at = frame.next;
    }
    bare
}

/// Numbers that look random and are always the same (SplitMix64).
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % n.max(1) as u64) as usize
    }
}

fn mutated(bytes: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..=dice.below(3) {
        let at = dice.below(bytes.len());
        let end = (at + dice.below(5000)).min(bytes.len());
        match dice.below(8) {
            0..=2 => bytes[at] ^= 1 << dice.below(8),
            3 => bytes[at] = [0, 1, 5, 6, 7, 0x7f, 0x80, 0xff][dice.below(8)],
            4 => {
                // the length of a record
                let starts = starts(&bytes);
                let at = starts[dice.below(starts.len())] + 1;
                let length =
                    [0, 1, 1 << 20, 1 << 32, u64::MAX, u64::MAX - 8, dice.below(1 << 30) as u64][dice.below(7)];
                let end = (at + 8).min(bytes.len());
                bytes[at.min(end)..end].copy_from_slice(&length.to_le_bytes()[..end - at.min(end)]);
            }
            5 => drop(bytes.drain(at..end)),
            6 => {
                let copy = bytes[at..end].to_vec();
                bytes.splice(at..at, copy);
            }
            _ => {
                // two records change places, or one comes twice
                let starts = starts(&bytes);
                let [a, b] = [dice.below(starts.len()), dice.below(starts.len())];
                let record = |i: usize| Frame::at(&bytes, starts[i]).map_or(starts[i], |frame| frame.next);
                let copy = bytes[starts[a]..record(a)].to_vec();
                bytes.splice(starts[b]..if dice.below(2) == 0 { record(b) } else { starts[b] }, copy);
            }
        }
    }
    bytes
}

fn starts(bytes: &[u8]) -> Vec<usize> {
    let next = |at: &usize| Frame::at(bytes, *at).map(|frame| frame.next);
    std::iter::successors(Some(mcap::MAGIC.len().min(bytes.len())), next).collect()
}

/// Lets every reader of result files see one.
fn read_by_all(file: &Path) -> Option<()> {
    if let Ok((case, _)) = read(file) {
        let _ = printout(&case, case.loaded.scenario.units.unwrap_or_default().into(), None);
    }
    let results = Results::open(file).ok()?;
    let _ = (results.summary(), results.notes(), results.ending());
    let _ = page(std::slice::from_ref(&results), &[], Units::default());
    let all = choose(&results.model, &[]).ok()?;
    let treatment =
        Treatment { filter: Filter::J211, family: crash_measures::signal::CfcFamily::SaeJ211, interval_s: Some(1e-3) };
    let _ = load(&results, all, treatment);
    Some(())
}

#[test]
fn mutated_files_are_read_or_refused_in_short_time() {
    let folder = tempfile::tempdir().unwrap();
    let whole = recorded(folder.path(), "0.0029");
    let bare = bare(&whole);
    assert_eq!(StoredRun::read(&bare).unwrap().checkpoints, StoredRun::read(&whole).unwrap().checkpoints);
    let file: PathBuf = folder.path().join("mutated.mcap");
    let (mut dice, mut used, mut longest) = (Dice(1), 0, Duration::ZERO);
    for base in [&whole, &bare] {
        for _ in 0..mutations() {
            fs::write(&file, mutated(base, &mut dice)).unwrap();
            let began = Instant::now();
            used += u64::from(read_by_all(&file).is_some());
            longest = longest.max(began.elapsed());
        }
    }
    assert!(used > mutations() / 2, "{used} are used");
    // measured: 0.3 s in an unoptimised build
    assert!(longest < Duration::from_secs(20), "{longest:?}");
}

#[test]
fn after_a_damaged_chunk_the_whole_ones_are_used_and_the_gap_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let whole = recorded(folder.path(), "0.0119");
    let chunks: Vec<usize> = starts(&whole).into_iter().filter(|at| whole[*at] == op::CHUNK).collect();
    let mut damaged = whole.clone();
    damaged[chunks[1] + 500] ^= 1;
    let stored = StoredRun::read(&damaged).unwrap();
    let outputs: Vec<usize> = stored.checkpoints.iter().map(|c| c.index).collect();
    assert_eq!(outputs, (0..50).chain(100..120).collect::<Vec<_>>());
    let flaw = stored.flaw().unwrap();
    assert!(flaw.starts_with(&format!("damaged at byte {}: a chunk", chunks[1])), "{flaw}");
    assert!(flaw.ends_with("outputs 50 to 99 are missing"), "{flaw}");

    let file = folder.path().join("damaged.mcap");
    fs::write(&file, &damaged).unwrap();
    let results = Results::open(&file).unwrap();
    assert!(!results.is_complete());
    assert_eq!(results.checkpoints.len(), 50, "measures do not reach over the gap");

    // a length that is wrong hides nothing but its own record
    damaged = whole.clone();
    damaged[chunks[0] + 3] ^= 0xff;
    let stored = StoredRun::read(&damaged).unwrap();
    assert_eq!(stored.checkpoints.first().map(|c| c.index), Some(50));
    assert_eq!(stored.checkpoints.len(), 70);
    assert!(StoredRun::read(&whole).unwrap().flaw().is_none());
}

#[test]
fn a_small_file_takes_little_memory_whatever_it_holds() {
    let record = |opcode: u8, body: &[u8]| [&[opcode], &(body.len() as u64).to_le_bytes()[..], body].concat();
    let text = |words: &str| [&(words.len() as u32).to_le_bytes(), words.as_bytes()].concat();
    let chunk = |content: &[u8]| {
        let size = (content.len() as u64).to_le_bytes();
        record(op::CHUNK, &[&[0; 16][..], &size, &[0; 4], &text(""), &size, content].concat())
    };
    let read = |records: &[u8]| StoredRun::read(&[mcap::MAGIC, records].concat()).unwrap();

    // documents in chunks could be 255 times as long as the file
    let attachment = record(op::ATTACHMENT, &[&[0; 16][..], &text("a"), &text(""), &[0; 8], &[0; 4]].concat());
    assert!(read(&attachment).attachments.contains_key("a"));
    let found = read(&chunk(&attachment));
    assert!(found.attachments.is_empty());
    assert!(found.because().contains("a record that belongs outside chunks"), "{}", found.because());

    // an output of 40 bytes takes as much as another one
    let channel = [&[1, 0, 0, 0][..], &text(checkpoint::TOPIC), &text(""), &text("")].concat();
    let mut records = record(op::CHANNEL, &channel);
    let mut wire = wire::Wire::default();
    for index in 0..700_000 {
        wire.bytes.clear();
        wire.count(2, index);
        records.extend(record(op::MESSAGE, &[&[1, 0][..], &[0; 20], &wire.bytes].concat()));
    }
    let found = read(&records);
    let takes = found.checkpoints.len() * size_of::<Checkpoint>();
    assert!(takes > 200 << 20 && takes <= 256 << 20, "{takes}");
    assert!(found.because().contains("more outputs than possible in a file of this size"), "{}", found.because());
}

#[test]
fn chunks_that_announce_too_much_are_not_unpacked() {
    let chunk = |size: u64, packed: &[u8]| {
        let mut body = [&[0; 16][..], &size.to_le_bytes(), &[0; 4], &3_u32.to_le_bytes(), b"lz4"].concat();
        body.extend_from_slice(&(packed.len() as u64).to_le_bytes());
        body.extend_from_slice(packed);
        [mcap::MAGIC, &[op::CHUNK], &(body.len() as u64).to_le_bytes(), &body].concat()
    };
    let said = |size| StoredRun::read(&chunk(size, &[1; 100])).unwrap().because();
    assert!(said(u64::MAX).contains("at byte 8: a chunk of more than 256 MiB"), "{}", said(u64::MAX));
    assert!(said(1 << 20).contains("announces more bytes than it can contain"), "{}", said(1 << 20));
    assert!(said(1 << 10).contains("cannot be unpacked"), "{}", said(1 << 10));
}

#[test]
fn chunks_of_a_small_file_make_a_quarter_of_a_gigabyte_at_most() {
    use std::io::Write;
    // a record of zeros that nobody knows
    const SIZE: u64 = 100 << 20;
    let mut packer = lz4::EncoderBuilder::new().build(Vec::new()).unwrap();
    packer.write_all(&[&[0x80][..], &(SIZE - 9).to_le_bytes(), &vec![0; SIZE as usize - 9]].concat()).unwrap();
    let packed = packer.finish().0;
    let body = [&[0; 16][..], &SIZE.to_le_bytes(), &[0; 4], &3_u32.to_le_bytes(), b"lz4"].concat();
    let body = [&body[..], &(packed.len() as u64).to_le_bytes(), &packed].concat();
    let chunk = [&[op::CHUNK][..], &(body.len() as u64).to_le_bytes(), &body].concat();
    let said = |chunks: usize| StoredRun::read(&[mcap::MAGIC, &chunk.repeat(chunks)].concat()).unwrap().because();
    assert!(said(2).starts_with("; it ends early, at byte"), "{}", said(2));
    let third = format!("damaged at byte {}: a chunk that unpacks to more bytes", 8 + 2 * chunk.len());
    assert!(said(3).contains(&third), "{}", said(3));
}
