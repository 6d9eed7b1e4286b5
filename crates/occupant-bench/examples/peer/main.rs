//! A scenario's occupant for other engines (`peers`): as MJCF, and our own motion and accelerations of it as JSON.
//!
//! ```text
//! peer mjcf SCENARIO SECONDS free|hinges|held|contact    the model for MuJoCo
//! peer motion SCENARIO SECONDS                             what other engines are checked against
//! ```
//!
//! SECONDS is an instant of the scenario. Everything is seen from the vehicle of that instant and put where the vehicle
//! stands at the scenario's start, so that surfaces are at rest. SI, space axes, quaternions as w, x, y, z; positions q,
//! speeds v and accelerations in the coordinates of [`coordinates`], which are MuJoCo's.

mod belts;
mod coordinates;
mod faces;
mod mjcf;
mod motion;

use std::path::Path;

use coordinates::Placed;
use mjcf::Parts;
use occupant_core::model::Model;
use occupant_scenario::{Format, Scenario};

const USAGE: &str = "peer mjcf SCENARIO SECONDS free|hinges|held|contact, or peer motion SCENARIO SECONDS";

#[allow(clippy::print_stdout, reason = "an example prints its result")]
fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (what, path, seconds, parts) = match words[..] {
        ["mjcf", path, seconds, parts] => ("mjcf", path, seconds, parts),
        ["motion", path, seconds] => ("motion", path, seconds, "hinges"),
        _ => panic!("{USAGE}"),
    };
    let model = read(Path::new(path));
    let instant_s = seconds.parse().expect("an instant, s");
    let parts = Parts::named(parts).expect(USAGE);
    let instants = Placed::all(&model, instant_s);
    match what {
        "mjcf" => println!("{}", mjcf::write(&model, parts, &instants)),
        _ => println!("{}", motion::describe(&model, &instants.spun)),
    }
}

/// The model of a scenario file, which may name files beside it.
fn read(path: &Path) -> Model {
    let text = std::fs::read_to_string(path).expect("a scenario file");
    let beside = |name: &str| {
        let file = path.with_file_name(name);
        std::fs::read(&file).map_err(|e| format!("{}: {e}", file.display()))
    };
    let format = match path.extension().and_then(|e| e.to_str()) {
        Some("json") => Format::Json,
        _ => Format::Toml,
    };
    let loaded = Scenario::from_text(&text, format, &path.to_string_lossy(), &beside);
    let loaded = loaded.unwrap_or_else(|problems| panic!("{problems}"));
    loaded.model().unwrap_or_else(|problems| panic!("{problems}")).0
}
