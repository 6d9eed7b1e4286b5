//! The examples run, those of the core too, and a case built in code is that of its text to the bit.

#[path = "../../occupant-core/examples/case_in_code.rs"]
#[allow(dead_code, reason = "an example's own parts")]
mod case_in_code;
#[path = "../examples/own_recorder.rs"]
mod own_recorder;
#[path = "../examples/own_vehicle_path.rs"]
mod own_vehicle_path;
#[path = "../examples/scenario_from_text.rs"]
#[allow(dead_code, reason = "its main takes an argument")]
mod scenario_from_text;
#[path = "../examples/sweep_with_rayon.rs"]
mod sweep_with_rayon;

use std::path::Path;

use occupant_core::body::Body;
use occupant_core::forces::joint::Joints;
use occupant_core::model::Model;
use occupant_core::model::seating::InitialPosture;
use occupant_core::model::setup::{Setup, SetupBuilder};
use occupant_core::motion::report_coordinates::{DOF, ReportCoordinates};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_core::vehicle::VehiclePath;
use occupant_scenario::{Draft, Format, preset_body};

const CART: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/testdata/carts/cart-lap-torso.toml");

fn from_text(text: &str) -> Setup {
    let no_files = |name: &str| Err(format!("{name}: no files here"));
    Draft::read(text, Format::Toml, "test.toml").unwrap().load(&no_files).unwrap().build().unwrap().0
}

/// Every number of the state at every output, as bits.
fn states(setup: Setup) -> Vec<u64> {
    let mut bits = Vec::new();
    let model = Model::new(setup).unwrap();
    simulate(&model, Watch(|s: &Sample<'_>| bits.extend(s.state.numbers().iter().map(|x| x.to_bits())))).unwrap();
    bits
}

#[test]
fn every_example_runs() {
    scenario_from_text::run(Path::new(CART)).unwrap();
    case_in_code::main().unwrap();
    own_vehicle_path::main().unwrap();
    own_recorder::main().unwrap();
    sweep_with_rayon::main().unwrap();
}

#[test]
fn a_case_in_code_is_that_of_its_text_to_the_bit() {
    let text = from_text(&std::fs::read_to_string(CART).unwrap());
    // the text has the body of the first version, and a seat whose back is behind the trunk
    let (body, behind) = (preset_body("male50-1970").unwrap(), text.behind.clone());
    let code = Setup { body, behind, ..case_in_code::cart().unwrap() };
    assert_eq!(code, text);
    assert_eq!(states(code), states(text));
}

#[test]
fn what_code_does_not_say_is_as_in_a_scenario_that_does_not_say_it() {
    let zeros = [0.0; DOF];
    let list = format!("{zeros:?}");
    let text = from_text(&format!(
        "title = \"plain\"\ntime = {{ end = 0.1 }}\npath = {{ kind = \"fixed\" }}\nbody = {{ preset = \"male50\" }}\n\
         joints = {{ preset = \"male50\" }}\ninitial_state = {{ q = {list}, rates = {list} }}\n"
    ));
    let posture = InitialPosture::Coordinates(Box::new(ReportCoordinates { q: zeros, rates: zeros }));
    let case = SetupBuilder::new("plain", Body::male50(), Joints::male50());
    assert_eq!(case.build(VehiclePath::parked(), posture, 0.1), text);
}
