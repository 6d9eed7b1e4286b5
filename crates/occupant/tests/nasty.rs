//! Calls that no sane program makes: nothing panics, nothing gives nonsense without a word.

use std::panic::{AssertUnwindSafe, catch_unwind};

use occupant::core::body::Body;
use occupant::core::forces::joint::Joints;
use occupant::prelude::*;

const DRIVER: &str = include_str!("../examples/driver.toml");

fn case() -> Case {
    let mut case = Case::from_toml(DRIVER).unwrap();
    case.ends_at(0.01);
    case
}

fn bare() -> Case {
    let mut case = Case::new("bare", Occupant::male50());
    case.standing_at([0.0, 0.0, 1.4]);
    case.ends_at(0.01);
    case
}

fn live() -> Model {
    let mut case = case();
    case.live(VehicleState::default()).unwrap();
    case.model().unwrap()
}

/// Of a case with something added, whether it runs.
fn with(change: impl FnOnce(&mut Case)) -> Result<(), Error> {
    let mut case = case();
    change(&mut case);
    case.model()?.simulate().map(|_| ())
}

fn wood() -> Material {
    Material::new("wood", BilinearSpring::linear(1e5, 0.3), 0.6)
}

fn wall() -> Outline {
    Outline::strip([[2.0, -1.0], [2.0, 1.0]], 0.0, 1.0, 1.0)
}

/// A force with everything of a kind.
#[derive(Debug)]
struct Odd(f64, usize);

impl Force for Odd {
    fn apply(&self, scene: &Scene<'_>, memory: &[f64], pushes: &mut Pushes<'_, '_>) {
        let place = Place::Sphere(self.1);
        assert!(memory.len() <= 16);
        let away = scene.motion(&place).place_m;
        pushes.force(&place, Vector3::new(self.0, 0.0, 0.0));
        pushes.between(&place, &place, away * self.0);
        pushes.show(usize::MAX, self.0);
        pushes.stored_j(self.0);
    }
}

type Row = (&'static str, fn() -> Result<(), Error>, Option<ErrorKind>);

use ErrorKind::{Case as OfCase, Input, Integration, Name, Recording, Text};

#[rustfmt::skip]
const ROWS: &[Row] = &[
    ("a material of another case", || { let mut other = bare(); let of = other.material(wood()); with(|case| { case.surface("wall", of, wall(), [0.0; 3]); }) }, Some(OfCase)),
    ("a ground of another case's material", || { let of = bare().material(wood()); with(|case| { case.ground("ground", of, 9.0); }) }, Some(OfCase)),
    ("a surface of another case on a frame", || { let mut other = bare(); let of = other.material(wood()); let wall = other.surface("wall", of, wall(), [0.0; 3]); with(|case| { let car = case.vehicle("car", VehiclePath::parked()); case.carry(wall, car); }) }, Some(OfCase)),
    ("a sphere of another case", || { let sphere = bare().sphere("head")?; with(|case| { case.belt("rope", sphere, [[0.0; 3]; 2], BilinearSpring::linear(1e3, 1.0)); }) }, Some(OfCase)),
    ("a seat of another case", || { let other = Case::from_toml(DRIVER)?; let cushion = other.surface_named("front_cushion")?; with(|case| case.seat(Seat::new(cushion, cushion, [0.0; 2]))) }, Some(OfCase)),
    ("things of the case of a clone", || { let mut first = bare(); let of = first.material(wood()); let mut clone = first.clone(); clone.ground("ground", of, 0.0); clone.model().map(|_| ()) }, None),
    ("a wall of no place", || with(|case| { let of = case.material(wood()); case.surface("wall", of, Outline::strip([[f64::NAN; 2]; 2], 0.0, 1.0, 1.0), [0.0; 3]); }), Some(OfCase)),
    ("a wall of no size", || with(|case| { let of = case.material(wood()); case.surface("wall", of, Outline::strip([[1.0; 2]; 2], 0.0, 0.0, 0.0), [0.0; 3]); }), Some(OfCase)),
    ("two walls of one name", || with(|case| { let of = case.material(wood()); for _ in 0..2 { case.surface("wall", of, wall(), [0.0; 3]); } }), Some(OfCase)),
    ("a nameless material", || with(|case| { case.material(Material::new("", BilinearSpring::linear(1e5, 0.3), 0.6)); }), None),
    ("a material that pulls", || with(|case| { case.material(Material::new("glue", BilinearSpring::linear(-1e5, 0.3), 0.6)); }), Some(OfCase)),
    ("a material of endless friction", || with(|case| { case.material(Material::new("glue", BilinearSpring::linear(1e5, 0.3), f64::INFINITY)); }), Some(OfCase)),
    ("a belt at no place", || with(|case| { let pelvis = case.sphere("pelvis").unwrap(); case.belt("rope", pelvis, [[f64::INFINITY; 3]; 2], BilinearSpring::linear(1e3, 1.0)); }), Some(OfCase)),
    ("a marker at no place", || with(|case| { let head = case.segment("head").unwrap(); case.marker("m", head, [f64::NAN; 3]); }), Some(OfCase)),
    ("two markers of one name", || with(|case| { let head = case.segment("head").unwrap(); for _ in 0..2 { case.marker("m", head, [0.0; 3]); } }), Some(OfCase)),
    ("a ground at no height", || with(|case| { let of = case.material(wood()); case.ground("ground", of, f64::NAN); }), Some(OfCase)),
    ("a stand at no place", || with(|case| case.standing_at([f64::NAN; 3])), Some(OfCase)),
    ("a stand of a body of 17 parts", || { let (body, _) = occupant::core::body::people::Person::named("male50").unwrap().body(occupant::core::body::people::Division::of(17).unwrap()); let tree = body.tree; let mut case = Case::new("", Occupant::custom(body, Joints::free(tree))); case.standing_at([0.0, 0.0, 1.4]); case.model().map(|_| ()) }, Some(OfCase)),
    ("joints of another body", || { let (body, _) = occupant::core::body::people::Person::named("male50").unwrap().body(occupant::core::body::people::Division::of(17).unwrap()); Case::new("", Occupant::custom(body, Joints::male50())).model().map(|_| ()) }, Some(OfCase)),
    ("a rigid body as an occupant", || { let body = Body::rigid("", 1.0, [1.0; 3], Vector3::zeros()); let tree = body.tree; Case::new("", Occupant::custom(body, Joints::free(tree))).model()?.simulate().map(|_| ()) }, Some(OfCase)),
    ("an end before the start", || with(|case| case.ends_at(-1.0)), Some(OfCase)),
    ("an end without end", || with(|case| case.ends_at(f64::INFINITY)), Some(OfCase)),
    ("outputs at no time", || with(|case| case.outputs_every(0.0)), Some(OfCase)),
    ("outputs backwards", || with(|case| case.outputs_every(-1e-3)), Some(OfCase)),
    ("no steps", || with(|case| case.integrator(Integrator::Rk4 { step_s: 0.0 })), Some(OfCase)),
    ("a model stepped otherwise, by nothing", || case().model()?.with_integrator(Integrator::Rk4 { step_s: f64::NAN }).map(|_| ()).map_err(Error::from), Some(OfCase)),
    ("a model recorded at no time", || case().model()?.with_outputs_every(0.0).map(|_| ()).map_err(Error::from), Some(OfCase)),
    ("a pulse of no duration", || bare().pulse(10.0, PulseShape::HalfSine { strength: Strength::DeltaV(10.0), duration_s: 0.0 }), Some(Input)),
    ("a pulse at no speed", || bare().pulse(f64::NAN, PulseShape::HalfSine { strength: Strength::DeltaV(10.0), duration_s: 0.1 }), Some(Input)),
    ("a start at no speed", || with(|case| { case.live(VehicleState { velocity_m_s: Vector3::repeat(f64::NAN), ..VehicleState::default() }).unwrap(); }), Some(OfCase)),
    ("a run to the end that nobody tells", || live().simulate().map(|_| ()), Some(Integration)),
    ("a force on no sphere", || with(|case| case.force("odd", Odd(1.0, usize::MAX))), Some(Integration)),
    ("a force without end", || with(|case| case.force("odd", Odd(f64::INFINITY, 0))), Some(Integration)),
    ("a force of no number", || with(|case| case.force("odd", Odd(f64::NAN, 0))), Some(Integration)),
    ("a force on itself", || with(|case| case.force("odd", Odd(1.0, 0))), None),
    ("two forces of one name", || with(|case| { case.force("odd", Odd(1.0, 0)); case.force("odd", Odd(2.0, 0)); }), Some(OfCase)),
    ("a person of a metre and a ton", || Occupant::person(Sex::Female, 1.0, 1000.0).map(|_| ()), Some(Input)),
    ("no scenario", || Case::from_toml("").map(|_| ()), Some(Text)),
    ("a scenario of zeros", || Case::from_toml("\0\0").map(|_| ()), Some(Text)),
    ("a scenario that names a file", || { let mut text = Scenario::from_toml(DRIVER)?; text.set("path", r#"{ kind = "table", file = "none.csv" }"#)?; Case::from_scenario(&text).map(|_| ()) }, Some(Text)),
    ("a value at no path", || Scenario::from_toml(DRIVER)?.set("", "1"), Some(Text)),
    ("no value at a path", || Scenario::from_toml(DRIVER)?.set("path.speed", ""), Some(Text)),
    ("a value that goes on", || Scenario::from_toml(DRIVER)?.set("path.speed", "1\n[belts.x]\ny = 1"), Some(Text)),
    ("a figure of a misspelt name", || case().model()?.simulate()?.figure("hic 15").map(|_| ()), Some(Name)),
    ("a figure of no name", || case().model()?.simulate()?.figure("").map(|_| ()), Some(Name)),
    ("a channel that was not kept", || { let model = case().model()?; let (mut run, mut log) = (Run::new(&model), Log::of(&model, &["head.acceleration.x"])?); run.record(&mut log)?; log.end(run)?.channel("head.acceleration.y").map(|_| ()) }, Some(Name)),
    ("the log of another model", || { let (model, other) = (case().model()?, bare().model()?); let mut log = Log::new(&model); Run::new(&model).record(&mut log)?; log.end(Run::new(&other)).map(|_| ()) }, Some(Recording)),
    ("a log that ends with an earlier run", || { let model = case().model()?; let mut log = Log::new(&model); let mut run = Run::new(&model); run.advance_to(0.005)?; run.record(&mut log)?; log.end(Run::new(&model)).map(|_| ()) }, Some(Recording)),
    ("a log of two runs in turn", || { let model = case().model()?; let mut log = Log::new(&model); let mut run = Run::new(&model); run.record(&mut log)?; let mut ahead = run.clone(); ahead.advance_to(0.005)?; ahead.record(&mut log)?; run.record(&mut log).map(|_| ()).map_err(Error::from) }, Some(Recording)),
    ("channels of another model", || { let log = Log::of(&bare().model()?, &["head.acceleration.x"])?; let model = case().model()?; let mut log = log; Run::new(&model).record(&mut log).map(|_| ()).map_err(Error::from) }, Some(Recording)),
    ("a log without an output", || { let model = case().model()?; Log::new(&model).end(Run::new(&model)).map(|_| ()) }, Some(Recording)),
    ("an end that comes at once", || { let model = case().model()?; let (mut run, mut log) = (Run::new(&model), Log::new(&model)); run.record(&mut log)?; let results = log.end(run)?; assert!(results.time_s() == [0.0]); Ok(()) }, None),
    ("a run of hours has no room for all at once", || { let mut case = case(); case.ends_at(36_000.0); case.outputs_every(0.01); let model = case.model()?; let (mut run, mut log) = (Run::new(&model), Log::new(&model)); run.record(&mut log).map(|_| ()).map_err(Error::from) }, None),
    ("a saved run of another case", || { let (model, other) = (case().model()?, bare().model()?); let bytes = Run::new(&model).save()?; Run::load(&other, &bytes).map(|_| ()).map_err(Error::from) }, Some(Input)),
    ("a saved run that breaks off", || { let model = case().model()?; let bytes = Run::new(&model).save()?; for end in (0..bytes.len()).step_by(7) { assert!(Run::load(&model, &bytes[..end]).is_err(), "{end}"); } Ok(()) }, None),
    ("a saved run with other numbers", || { let model = case().model()?; let bytes = Run::new(&model).save()?; for at in (0..bytes.len()).step_by(5) { let mut bytes = bytes.clone(); bytes[at] ^= 0xff; let _may_be_one = Run::load(&model, &bytes).map(|mut run| run.advance_to(1e-3)); } Ok(()) }, None),
    ("a frame that goes back", || { let model = live(); let mut run = Run::new(&model); run.push(2e-3, &VehicleInput::acceleration([0.0; 3]))?; run.advance_to(2e-3)?; run.push(1e-3, &VehicleInput::acceleration([0.0; 3])).map_err(Error::from) }, Some(Input)),
    ("a frame that leaps", || { let model = live(); let mut state = VehicleState::default(); state.pose.position_m.x = 1e9; Run::new(&model).push(1e-3, &VehicleInput::State(state)).map_err(Error::from) }, Some(Input)),
    ("a frame of a year", || { let model = live(); let mut run = Run::new(&model); run.push(3e7, &VehicleInput::acceleration([0.0; 3]))?; run.advance_to(run.end_s()).map_err(Error::from) }, None),
    ("a frame of nothing", || { let model = live(); Run::new(&model).push(1e-300, &VehicleInput::State(VehicleState::default())).map_err(Error::from) }, Some(Input)),
];

#[test]
fn nothing_panics_and_what_cannot_be_is_refused() {
    let mut failures = Vec::new();
    for (name, call, expected) in ROWS {
        match catch_unwind(AssertUnwindSafe(call)) {
            Err(_) => failures.push(format!("{name}: panicked")),
            Ok(came) => {
                let found = came.as_ref().err().map(Error::kind);
                if found != *expected || came.as_ref().is_err_and(|error| error.to_string().trim().is_empty()) {
                    failures.push(format!("{name}: {came:?}, expected {expected:?}"));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(ROWS.len() >= 60, "{}", ROWS.len());
}
