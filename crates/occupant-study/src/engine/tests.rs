//! Every run has its row, whatever happens to the others and however many threads there are.

use occupant_scenario::{Draft, Format};

use super::*;

/// A body that falls freely, from another height in each run, for a moment.
const FALL: &str = r#"
    title = "Free fall"
    time = { end = 0.02 }
    path = { kind = "fixed" }
    body = { preset = "male50" }
    joints = { preset = "male50" }
    integrator = { kind = "rk4", step = 1e-3 }

    [initial_state]
    q     = [0, 0, 2,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0]
    rates = [0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0]
"#;

/// Outcome by run.
#[derive(Clone, Copy, Default)]
struct Falls {
    refused: Option<u64>,
    panics: Option<u64>,
    /// The source has no more room.
    ends_all: Option<u64>,
    unrecorded: Option<u64>,
}

/// The last output as text, which shows every bit.
struct Last {
    panics: bool,
    fails: bool,
    bits: String,
}

impl Recorder for Last {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        assert!(!(self.panics && sample.time_s > 0.005), "a defect");
        if self.fails {
            return Err("no room".into());
        }
        self.bits = format!("{:?}", sample.checkpoint());
        Ok(Flow::Continue)
    }
}

#[derive(Debug, PartialEq)]
enum Trouble {
    Source,
    Sink,
    Recorder(String),
}

impl From<Unrecorded> for Trouble {
    fn from(error: Unrecorded) -> Self {
        Trouble::Recorder(error.to_string())
    }
}

type Row = (u64, Ending, String);

impl Source for Falls {
    type Recorder = Last;
    type Row = Row;
    type Error = Trouble;

    fn begin(&self, index: u64) -> Result<(Model, Last), NotBegun<Trouble>> {
        if self.ends_all == Some(index) {
            return Err(NotBegun::Error(Trouble::Source));
        }
        let mut draft = Draft::read(FALL, Format::Toml, "fall")?;
        draft.set_value("initial_state.q[2]", &format!("{}", 2.0 + 0.01 * index as f64))?;
        if self.refused == Some(index) {
            draft.set_value("time.end", "-1.0")?;
        }
        let loaded = draft.load(&|name| Err(format!("no file {name}")))?;
        let last =
            Last { panics: self.panics == Some(index), fails: self.unrecorded == Some(index), bits: String::new() };
        Ok((loaded.model()?.0, last))
    }

    fn end(&self, run: Finished<Last>) -> Result<Row, Trouble> {
        Ok((run.index, run.ending, run.ran.map_or(String::new(), |ran| ran.recorder.bits)))
    }
}

const RUNS: u64 = 30;

fn run(
    falls: Falls,
    threads: usize,
    mut sink: impl FnMut(&Row) -> Result<(), Trouble>,
) -> (Vec<Row>, Result<(), Trouble>) {
    let engine = Engine::new(threads, Kernel::best()).unwrap();
    let mut rows = Vec::new();
    let ended = engine.run(&falls, 0..RUNS, &AtomicBool::new(false), |row| {
        sink(&row)?;
        rows.push(row);
        Ok(())
    });
    rows.sort_by_key(|row| row.0);
    (rows, ended)
}

#[test]
fn every_run_has_its_row_with_the_same_bits_for_any_number_of_threads() {
    let (one, ended) = run(Falls::default(), 1, |_| Ok(()));
    assert_eq!(ended, Ok(()));
    assert!(one.iter().map(|row| row.0).eq(0..RUNS));
    assert!(one.iter().all(|row| row.1 == Ending::Completed && row.2.len() > 100));
    assert_ne!(one[0].2, one[1].2);
    for threads in [2, 5] {
        assert!(run(Falls::default(), threads, |_| Ok(())) == (one.clone(), Ok(())));
    }
}

#[test]
fn a_run_that_is_refused_or_breaks_the_program_costs_itself_alone() {
    let (fine, _) = run(Falls::default(), 1, |_| Ok(()));
    for threads in [1, 3] {
        let falls = Falls { refused: Some(4), panics: Some(11), ..Falls::default() };
        let (rows, ended) = run(falls, threads, |_| Ok(()));
        assert_eq!((rows.len() as u64, ended), (RUNS, Ok(())));
        for (row, alone) in rows.iter().zip(&fine) {
            match (row.0, &row.1) {
                (4, Ending::Refused(reason)) => assert!(reason.starts_with("time.end: "), "{reason}"),
                (11, Ending::Broken(reason)) => assert_eq!(reason, "the program stopped: a defect"),
                _ => assert!(row == alone, "{}", row.0),
            }
        }
        assert!(matches!((&rows[4].1, &rows[11].1), (Ending::Refused(_), Ending::Broken(_))));
    }
}

#[test]
fn an_error_of_source_recorder_or_sink_ends_all_runs_and_no_thread_waits_for_ever() {
    for threads in [1, 2, 5] {
        let falls = Falls { ends_all: Some(7), ..Falls::default() };
        assert_eq!(run(falls, threads, |_| Ok(())).1, Err(Trouble::Source));
        let falls = Falls { unrecorded: Some(7), ..Falls::default() };
        let words = "sample 7: recording failed at t = 0.000000 s: no room".to_owned();
        assert_eq!(run(falls, threads, |_| Ok(())).1, Err(Trouble::Recorder(words)));
        let full = |row: &Row| if row.0 == 9 { Err(Trouble::Sink) } else { Ok(()) };
        let (rows, ended) = run(Falls::default(), threads, full);
        assert_eq!(ended, Err(Trouble::Sink));
        assert!(rows.iter().all(|row| row.0 != 9));
    }
}

#[test]
fn once_stopped_nothing_is_begun_and_what_is_under_way_leaves_no_row() {
    let engine = Engine::new(2, Kernel::best()).unwrap();
    let stop = AtomicBool::new(false);
    let mut rows = 0;
    let ended = engine.run(&Falls::default(), 0..1_000_000, &stop, |_| {
        rows += 1;
        stop.store(true, Ordering::Relaxed);
        Ok(())
    });
    assert_eq!(ended, Ok(()));
    assert!((1..1000).contains(&rows), "{rows}");
}
