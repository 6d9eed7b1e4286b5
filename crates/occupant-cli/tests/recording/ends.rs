//! How files begin and end: metadata, attachments, the same bytes twice, runs that were cut off.

use std::collections::BTreeMap;
use std::error::Error;
use std::io::{Read, Seek, Write};

use mcap::records::Record;
use mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions};
use occupant_core::model::Model;
use occupant_core::model::setup::Integrator;
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::attempt;

use super::support::{SCENARIO, field, model, read, record, recorder, recorder_into, setup, text};

/// Stops the run, or breaks it, at an output.
struct Halt {
    at: usize,
    breaks: bool,
}

impl Recorder for Halt {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        match (sample.index == self.at, self.breaks) {
            (true, true) => Err("as if the disk were full".into()),
            (true, false) => Ok(Flow::Stop),
            (false, _) => Ok(Flow::Continue),
        }
    }
}

/// A metadata record: its name and entries.
type Entry = (String, BTreeMap<String, String>);

/// Metadata records in the file's order, as far as it can be read, and the number of messages.
fn scan(bytes: &[u8]) -> (Vec<Entry>, usize) {
    let options = LinearReaderOptions::default().with_validate_chunk_crcs(true).with_validate_data_section_crc(true);
    let mut reader = LinearReader::new_with_options(options);
    let (mut metadata, mut messages, mut rest) = (Vec::new(), 0, bytes);
    while let Some(event) = reader.next_event() {
        match event {
            Ok(LinearReadEvent::ReadRequest(wanted)) => {
                let count = wanted.min(rest.len());
                reader.insert(count).copy_from_slice(&rest[..count]);
                reader.notify_read(count);
                rest = &rest[count..];
            }
            Ok(LinearReadEvent::Record { data, opcode }) => match mcap::parse_record(opcode, data).unwrap() {
                Record::Metadata(m) => metadata.push((m.name, m.metadata)),
                Record::Message { .. } => messages += 1,
                _ => {}
            },
            Err(_) => break,
        }
    }
    (metadata, messages)
}

fn result_of(bytes: &[u8]) -> Option<BTreeMap<String, String>> {
    let (metadata, _) = scan(bytes);
    assert_eq!(metadata[0].0, "occupant.run");
    let last = metadata.last().unwrap();
    (last.0 == "occupant.result").then(|| last.1.clone())
}

#[test]
fn a_complete_run_says_so_last() {
    let (bytes, outcome) = record(&model(), ());
    let (metadata, messages) = scan(&bytes);
    let names: Vec<_> = metadata.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["occupant.run", "occupant.result"]);
    let (run, result) = (&metadata[0].1, &metadata[1].1);
    assert_eq!(run["program"], "occupant test");
    assert_eq!(run["start_s"], "-0.01");
    assert_eq!(run["integrator"], "rk4");
    assert_eq!(run["step_s"], "0.00025");
    assert_eq!(run["overrides"], "none");
    assert_eq!(run["body"], "male50-1970");
    assert_eq!(result["status"], "completed");
    assert_eq!(result["outputs"], "41");
    assert_eq!(result["steps"], outcome.effort.steps.to_string());
    let summary = mcap::Summary::read(&bytes).unwrap().unwrap();
    let statistics = summary.stats.unwrap();
    assert_eq!(statistics.message_count, messages as u64);
    assert_eq!(statistics.message_start_time, 0);
    assert_eq!(statistics.message_end_time, 39_500_000);
    assert!(summary.channels.values().all(|c| c.schema.is_some()));
}

#[test]
fn the_scenario_and_a_layout_are_attached() {
    let (bytes, _) = record(&model(), ());
    let summary = mcap::Summary::read(&bytes).unwrap().unwrap();
    let attachments: Vec<_> =
        summary.attachment_indexes.iter().map(|index| mcap::read::attachment(&bytes, index).unwrap()).collect();
    let names: Vec<_> = attachments.iter().map(|a| a.name.as_str()).collect();
    assert_eq!(names, ["short.toml", "layout.json"]);
    assert_eq!(attachments[0].data.as_ref(), SCENARIO.as_bytes());
    let layout: serde_json::Value = serde_json::from_slice(&attachments[1].data).unwrap();
    let topics = read(&bytes);
    let panels = layout["configById"].as_object().unwrap();
    let mut paths = 0;
    for path in panels.values().filter_map(|p| p["paths"].as_array()).flatten() {
        let (topic, name) = path["value"].as_str().unwrap().rsplit_once('.').unwrap();
        field(&topics[topic][0].message, name);
        paths += 1;
    }
    // three accelerometers, two belts, 17 spheres, two energies
    assert_eq!(paths, 24);
    for topic in panels["3D!scene"]["topics"].as_object().unwrap().keys() {
        assert!(topics.contains_key(topic), "{topic}");
    }
}

#[test]
fn the_same_scenario_gives_the_same_bytes() {
    let (first, _) = record(&model(), ());
    let (second, _) = record(&model(), ());
    assert!(first == second);
}

#[test]
fn a_stopped_run_says_so() {
    let halt = Halt { at: 10, breaks: false };
    let (bytes, outcome) = record(&model(), halt);
    assert_eq!(outcome.status, Status::Stopped);
    let result = result_of(&bytes).unwrap();
    assert_eq!((result["status"].as_str(), result["outputs"].as_str()), ("stopped", "11"));
}

#[test]
fn a_failed_run_says_when_and_why() {
    let mut setup = setup();
    setup.integrator = Integrator::Adaptive {
        relative: 1e-12,
        absolute_m: 1e-13,
        absolute_m_s: 1e-13,
        min_step_s: 1e-3,
        max_step_s: 1e-3,
    };
    let (bytes, outcome) = record(&Model::new(setup).unwrap(), ());
    let Status::Failed(error) = &outcome.status else { panic!("{:?}", outcome.status) };
    let result = result_of(&bytes).unwrap();
    assert_eq!(result["status"], "failed");
    assert_eq!(result["reason"], error.to_string());
    let log = &read(&bytes)["/log"];
    let last = &log.last().unwrap().message;
    assert_eq!(field(last, "level").as_enum_number(), Some(4));
    assert!(text(last, "message").contains(&error.to_string()));
}

#[test]
fn first_touches_are_logged_at_their_times() {
    let model = model();
    let (bytes, outcome) = record(&model, ());
    let log = &read(&bytes)["/log"];
    let touches: Vec<_> = log.iter().filter(|l| text(&l.message, "message").contains(" touches ")).collect();
    assert_eq!(touches.len(), outcome.first_touches.len());
    assert!(!touches.is_empty());
    for (line, touch) in touches.iter().zip(&outcome.first_touches) {
        let sphere = &model.body().spheres[touch.sphere].name;
        assert!(text(&line.message, "message").starts_with(&format!("{sphere} touches ")));
        let expected = ((touch.time_s + 0.01) * 1e9).round();
        assert!((line.ns as f64 - expected).abs() <= 1.0);
    }
}

#[test]
fn a_file_dropped_before_the_end_is_readable_and_has_no_result() {
    let model = model();
    let mut file = tempfile::tempfile().unwrap();
    {
        let mut recorder = recorder_into(file.try_clone().unwrap());
        let halt = Halt { at: 30, breaks: true };
        assert!(attempt(&model, (&mut recorder, halt)).is_err());
    }
    let mut bytes = Vec::new();
    file.rewind().unwrap();
    file.read_to_end(&mut bytes).unwrap();
    assert_eq!(result_of(&bytes), None);
    assert_eq!(read(&bytes)["/energy"].len(), 31);
}

#[test]
fn what_a_killed_run_wrote_is_readable_to_the_last_chunk() {
    let model = model();
    let (whole, _) = record(&model, ());
    let mut cut = recorder();
    let halt = Halt { at: 40, breaks: true };
    assert!(attempt(&model, (&mut cut, halt)).is_err());
    // as the process left it: nothing is finished
    let bytes = cut.into_inner().unwrap().into_inner();
    assert!(bytes.len() < whole.len());
    assert_eq!(result_of(&bytes), None);
    let (_, messages) = scan(&bytes);
    let (_, all) = scan(&whole);
    // 20 of 41 outputs, with the frames and shapes between them
    assert!(messages > all / 3, "{messages} of {all}");
}

/// A target with room for so many bytes.
struct Narrow {
    kept: std::io::Cursor<Vec<u8>>,
    room: usize,
}

impl Write for Narrow {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        if self.kept.get_ref().len() + bytes.len() > self.room {
            return Err(std::io::Error::other("the target is full"));
        }
        self.kept.write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

impl Seek for Narrow {
    fn seek(&mut self, to: std::io::SeekFrom) -> std::io::Result<u64> {
        self.kept.seek(to)
    }
}

#[test]
fn a_target_that_is_full_ends_the_run_with_its_reason() {
    let model = model();
    let (whole, _) = record(&model, ());
    // while the run continues, and in what is left for its end
    for room in [whole.len() / 2, whole.len() - 100] {
        let kept = std::io::Cursor::new(Vec::new());
        let mut recorder = recorder_into(Narrow { kept, room });
        let error = attempt(&model, &mut recorder).unwrap_err();
        let mut deepest: &dyn Error = &*error.source;
        while let Some(cause) = deepest.source() {
            deepest = cause;
        }
        let reason = deepest.to_string();
        assert_eq!(reason, "the target is full");
        // what was written before is that of the whole run
        let kept = recorder.into_inner().unwrap().kept.into_inner();
        assert!(kept.len() > 1000, "{}", kept.len());
        assert!(whole.starts_with(&kept[..kept.len().min(1000)]));
        assert!(kept.len() <= room);
    }
}
