//! Calls that no sane program makes: nothing panics, nothing is written or read without a word that is not so.

use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use crash_measures::signal::{CfcFamily, ChannelClass};
use nalgebra::Vector3;
use occupant_core::forces::own::{Force, OwnForce, Place, Pushes, Scene};
use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use occupant_core::results::channel::{Series, find};
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Recorder;
use occupant_core::run::Run;
use occupant_core::run::simulate::simulate;
use occupant_core::vehicle::{VehicleInput, VehiclePath, VehicleState};
use occupant_files::export::{self, About as TableAbout};
use occupant_files::history::{Column, Filter, Histories, Treatment, UnitChoice, filtered, treated};
use occupant_files::mcap::{About, Document, McapOptions, McapRecorder, StoredRun};
use occupant_files::results::Results;
use occupant_files::table::{Cell, Form, Kind, Table};
use occupant_files::{measured, mme, scenario};
use occupant_scenario::{Format, Scenario};

const FALL: &str = r#"
    title = "Free fall"
    time = { end = 0.01 }
    path = { kind = "fixed" }
    body = { preset = "male50" }
    joints = { preset = "male50" }

    [initial_state]
    q     = [0, 0, 2,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0]
    rates = [0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0]
"#;

fn setup() -> Setup {
    Scenario::from_text(FALL, Format::Toml, "fall.toml", &|_| Err("none".into())).unwrap().build().unwrap().0
}

fn fall() -> Model {
    Model::new(setup()).unwrap()
}

fn recorder() -> McapRecorder<Cursor<Vec<u8>>> {
    let media_type = "application/toml".into();
    let scenario = Document { name: "fall.toml".into(), media_type, content: FALL.as_bytes().to_vec() };
    let about = About { program: "mine 1.0".into(), scenario, resolved: None, notes: Default::default() };
    McapRecorder::new(Cursor::new(Vec::new()), about, McapOptions::default()).unwrap()
}

/// The file of a run.
fn file(model: &Model) -> Vec<u8> {
    let mut recorder = recorder();
    simulate(model, &mut recorder).unwrap();
    recorder.into_inner().unwrap().into_inner()
}

/// What is found in a file of these bytes.
fn opened(bytes: &[u8]) -> Result<Results, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.mcap");
    std::fs::write(&path, bytes).unwrap();
    Results::open(&path).map_err(|failure| failure.words())
}

#[derive(Debug)]
struct Push;

impl Force for Push {
    fn apply(&self, _scene: &Scene<'_>, _memory: &[f64], pushes: &mut Pushes<'_, '_>) {
        pushes.force(&Place::Sphere(0), Vector3::x());
    }

    fn start(&self, _scene: &Scene<'_>) -> Vec<f64> {
        vec![1.5]
    }
}

/// What a program's own forces remember is in the file; who opens the file as a run of the scenario alone is told.
#[test]
fn own_forces_are_kept_and_told() {
    let mut own = setup();
    own.own_forces.push(OwnForce::new("push", Push));
    let model = Model::new(own).unwrap();
    let bytes = file(&model);
    let stored = StoredRun::read(&bytes).unwrap();
    assert_eq!(stored.checkpoints[3].memory.own[0][0], 1.5);
    // the program itself continues from there
    let mut again = Run::from_checkpoint(&model, &stored.checkpoints[3]).unwrap();
    let mut first = Run::new(&model);
    for run in [&mut again, &mut first] {
        run.advance_to(0.01).unwrap();
    }
    assert_eq!(again.state().numbers(), first.state().numbers());
    assert!(Run::from_checkpoint(&fall(), &stored.checkpoints[3]).is_err());
    let refused = opened(&bytes).err().unwrap();
    assert!(refused.contains("the program's own force `push`"), "{refused}");
}

#[test]
fn a_vehicle_that_was_told_is_told() {
    let mut live = setup();
    live.path = VehiclePath::live(VehicleState::default());
    let model = Model::new(live).unwrap();
    let (mut run, mut recorder) = (Run::new(&model), recorder());
    for frame in 1..=10 {
        run.record(&mut recorder).unwrap();
        run.push(1e-3 * f64::from(frame), &VehicleInput::acceleration([-5.0, 0.0, 0.0])).unwrap();
        run.advance_to(run.known_until_s()).unwrap();
    }
    run.end(Status::Completed, &mut recorder).unwrap();
    let refused = opened(&recorder.into_inner().unwrap().into_inner()).err().unwrap();
    assert!(refused.contains("a vehicle whose motion is given during the run"), "{refused}");
}

/// A run of its scenario as it was read opens without a resolved one; cut off or damaged it is read as far as it goes.
#[test]
fn a_file_is_read_as_far_as_it_is_one() {
    let bytes = file(&fall());
    let whole = opened(&bytes).unwrap();
    assert!(whole.is_complete() && whole.checkpoints.len() == 11);
    for end in (0..bytes.len()).step_by(bytes.len() / 50) {
        if let Ok(part) = opened(&bytes[..end]) {
            // only what stands behind the run's last record may be cut off from a whole one
            assert!(part.checkpoints.len() <= 11 && part.is_complete() <= (part.checkpoints.len() == 11));
        }
    }
    for at in (0..bytes.len()).step_by(bytes.len() / 100) {
        let mut bytes = bytes.clone();
        bytes[at] ^= 0x55;
        let _as_far_as_it_goes = opened(&bytes);
    }
}

fn told<T, E: std::fmt::Display>(done: Result<T, E>) -> Result<(), String> {
    done.map(|_| ()).map_err(|error| error.to_string())
}

fn table(form: Form, cells: Vec<Cell>) -> Result<(), String> {
    let columns = [("x", Kind::Number), ("word", Kind::Text)];
    let mut table = Table::new(Vec::new(), form, &columns, &[]).unwrap();
    told(table.row(cells))?;
    told(table.finish())
}

fn in_every_form(cells: fn() -> Vec<Cell>) -> Result<(), String> {
    let forms = [Form::Csv, Form::Parquet, Form::Xlsx, Form::Mat];
    let came: Vec<Result<(), String>> = forms.into_iter().map(|form| table(form, cells())).collect();
    assert!(came.iter().all(|one| one.is_ok() == came[0].is_ok()), "{came:?}");
    came.into_iter().next_back().unwrap()
}

fn histories(values: usize) -> Histories {
    let channel = find(&fall(), "head.acceleration.x").unwrap();
    let column = Column { channel, class: None, values: vec![1.0; values] };
    Histories { time_s: vec![0.0, 1e-3], columns: vec![column], notes: Vec::new() }
}

fn exported(values: usize, form: Form) -> Result<(), String> {
    let (results, histories) = (opened(&file(&fall())).unwrap(), histories(values));
    let about = TableAbout::new(&results, &histories, UnitChoice::Si, "none".into(), None);
    told(export::table(&histories, &about, UnitChoice::Si, form))
}

/// The head's acceleration at an interval, s.
fn resampled(interval_s: f64) -> Result<(), String> {
    let model = fall();
    let mut series = Series::new(vec![find(&model, "head.acceleration.x").unwrap()]);
    simulate(&model, &mut series).unwrap();
    let treatment = Treatment { filter: Filter::None, family: CfcFamily::Iso6487, interval_s: Some(interval_s) };
    let channels = series.channels.clone();
    treated(&model, channels, series, treatment).map(|_| ()).map_err(|e| format!("{e:?}"))
}

/// Channels of which nothing was kept.
fn without_values(names: &[&str], filter: Filter) -> Result<(), String> {
    let model = fall();
    let channels = names.iter().map(|name| find(&model, name).unwrap()).collect();
    let treatment = Treatment { filter, family: CfcFamily::Iso6487, interval_s: None };
    treated(&model, channels, Series::new(Vec::new()), treatment).map(|_| ()).map_err(|e| format!("{e:?}"))
}

fn measured_test(histories: &Histories) -> Result<(), String> {
    let text = String::new;
    let labels =
        mme::Labels { name: text(), title: text(), program: text(), seat: '?', dummy: text(), remarks: Vec::new() };
    told(mme::files(&fall(), histories, &labels))
}

/// A name, the call, and whether it is refused.
type Row = (&'static str, fn() -> Result<(), String>, bool);

#[rustfmt::skip]
const ROWS: &[Row] = &[
    ("a row as it should be", || in_every_form(|| vec![Cell::Number(1.0), Cell::text("a")]), false),
    ("a row of no numbers", || in_every_form(|| vec![Cell::Number(f64::NAN), Cell::Absent]), false),
    ("a row with a cell too few", || in_every_form(|| vec![Cell::Number(1.0)]), true),
    ("a row with a cell too many", || in_every_form(|| vec![Cell::Absent; 3]), true),
    ("a row of nothing", || in_every_form(Vec::new), true),
    ("a text among numbers", || in_every_form(|| vec![Cell::text("a"), Cell::text("a")]), true),
    ("two columns of one name", || told(Table::new(Vec::new(), Form::Csv, &[("x", Kind::Number); 2], &[]).map(|_| ())), true),
    ("a table without columns", || { let mut table = Table::new(Vec::new(), Form::Parquet, &[("", Kind::Text); 0], &[]).unwrap(); told(table.row(Vec::new())) }, false),
    ("histories of uneven lengths", || exported(7, Form::Csv), true),
    ("histories without a value", || exported(0, Form::Parquet), true),
    ("histories as they should be", || exported(2, Form::Parquet), false),
    ("channels that were not kept", || without_values(&["head.acceleration.x"], Filter::None), true),
    ("no samples to filter", || without_values(&["head.acceleration.x"], Filter::J211), true),
    ("samples at no interval", || resampled(f64::NAN), true),
    ("samples without end", || resampled(1e-300), true),
    ("samples backwards", || resampled(-1e-3), true),
    ("a filter at no interval", || told(filtered(&[1.0; 9], 0.0, ChannelClass::Cfc60, CfcFamily::SaeJ211).map(|_| ())), true),
    ("a filter of no numbers", || told(filtered(&[f64::NAN; 99], 1e-4, ChannelClass::Cfc60, CfcFamily::SaeJ211).map(|_| ())), true),
    ("a test without samples", || measured_test(&Histories { time_s: Vec::new(), columns: Vec::new(), notes: Vec::new() }), true),
    ("a test of uneven histories", || measured_test(&histories(7)), true),
    ("an output before its run", || { let (model, mut file) = (fall(), recorder()); Run::new(&model).look(|sample| told(file.record(sample))).unwrap() }, true),
    ("an end before its run", || told(Run::new(&fall()).end(Status::Completed, &mut recorder())), true),
    ("two runs in one file", || { let (model, mut file) = (fall(), recorder()); Run::new(&model).record(&mut file).unwrap(); told(Run::new(&model).record(&mut file)) }, true),
    ("a file of no bytes", || opened(&[]).map(|_| ()), true),
    ("a file that only begins like one", || opened(b"\x89MCAP0\r\n").map(|_| ()), true),
    ("a folder as a file", || Results::open(Path::new("/")).map(|_| ()).map_err(|e| e.words()), true),
    ("a file that is not there", || Results::open(Path::new("nowhere/none.mcap")).map(|_| ()).map_err(|e| e.words()), true),
    ("a record of no name", || measured::read(Path::new("")).map(|_| ()).map_err(|e| e.words()), true),
    ("a form of no ending", || Form::of_output(Path::new("x")).map(|_| ()).map_err(|e| e.words()), true),
    ("a scenario of no name", || scenario::open(&scenario::ScenarioArgs { scenario: "".into(), overrides: Vec::new() }).map(|_| ()).map_err(|e| e.words()), true),
];

#[test]
fn nothing_panics_and_what_cannot_be_is_refused() {
    let mut failures = Vec::new();
    for (name, call, refused) in ROWS {
        match catch_unwind(AssertUnwindSafe(call)) {
            Err(_) => failures.push(format!("{name}: panicked")),
            Ok(came) if came.is_err() != *refused || came.as_ref().is_err_and(|words| words.trim().is_empty()) => {
                failures.push(format!("{name}: {came:?}"));
            }
            Ok(_) => {}
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
