//! Accuracy of an extension by cards: it is run and compared with an uninterrupted run.

use cardio_legacy::{ConvertOptions, Deck};
use crash_measures::signal::STANDARD_GRAVITY_MPS2;
use occupant_core::model::Model;
use occupant_core::results::channel::{Series, channels, star};
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::run::simulate::{attempt, resume};
use occupant_scenario::{Draft, Format};

/// Reads files referred to by a scenario.
type Resolver<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

/// Position of the head in the vehicle.
const HEAD: [&str; 3] = ["sphere.head.position.x", "sphere.head.position.y", "sphere.head.position.z"];
/// Belt forces.
const BELTS: &str = "belt.*.force";
/// Accelerometer readings.
const READ: [(&str, &str); 3] = [
    ("head.acceleration.resultant", "head"),
    ("upper_torso.acceleration.resultant", "chest"),
    ("lower_torso.acceleration.resultant", "pelvis"),
];
/// Largest difference of output times on cards and in results, s.
const SAME_S: f64 = 1e-6;

/// The model of a scenario with another end time.
pub(super) fn until(mut draft: Draft, end_s: f64, resolver: Resolver<'_>) -> Result<Model, String> {
    draft.set_value("time.end", &format!("{end_s}")).map_err(|problems| problems.to_string())?;
    let loaded = draft.load(&|name| resolver(name)).map_err(|problems| problems.to_string())?;
    loaded.model().map(|(model, _)| model).map_err(|problems| problems.to_string())
}

/// The run of a deck.
pub(super) fn of_deck(deck: &Deck, options: &ConvertOptions, resolver: Resolver<'_>) -> Result<Series, String> {
    let toml = deck.to_scenario(options).map_err(|error| error.to_string())?.toml;
    let draft = Draft::read(&toml, Format::Toml, "extension").map_err(|problems| problems.to_string())?;
    let loaded = draft.load(&|name| resolver(name)).map_err(|problems| problems.to_string())?;
    let (model, _) = loaded.model().map_err(|problems| problems.to_string())?;
    histories(&model, None)
}

/// Histories to compare, from the start of a run or from the end of another.
pub(super) fn histories(model: &Model, from: Option<&Checkpoint>) -> Result<Series, String> {
    let is_asked = |name: &str| HEAD.contains(&name) || star(BELTS, name).is_some() || READ.iter().any(|r| r.0 == name);
    let mut series = Series::new(channels(model).into_iter().filter(|c| is_asked(&c.name)).collect());
    let ended = match from {
        Some(from) => resume(model, from, &mut series).map_err(|error| error.to_string()),
        None => attempt(model, &mut series).map_err(|error| error.to_string()),
    };
    ended.map(|_| series)
}

/// Difference between an extension and the uninterrupted run, as text.
pub(super) fn words(goes_on: Result<Series, String>, extension: Result<Series, String>) -> String {
    const WHY: &str = "cards do not carry the largest deformations, so the extension is approximate";
    let (goes_on, extension) = match (goes_on, extension) {
        (Ok(goes_on), Ok(extension)) => (goes_on, extension),
        (Err(error), _) | (_, Err(error)) => return format!("{WHY}; the error is unknown: {error}"),
    };
    let common: Vec<[usize; 2]> = common(&goes_on.time_s, &extension.time_s);
    let (Some(first), Some(last)) = (common.first(), common.last()) else {
        return format!("{WHY}; the error is unknown: the two have no common output time");
    };
    let [from_s, to_s] = [first, last].map(|at| goes_on.time_s[at[0]]);
    let mut parts = vec![format!("the head is up to {:.1} mm off", 1e3 * apart_m(&goes_on, &extension, &common))];
    let peaks = goes_on.channels.iter().filter_map(|channel| {
        let name = &channel.name;
        let belt = star(BELTS, name).map(|belt| (format!("belt {belt}"), 1.0, "N"));
        let read = READ.iter().find(|r| r.0 == name).map(|r| (r.1.to_owned(), STANDARD_GRAVITY_MPS2, "g"));
        let (what, si, unit) = belt.or(read)?;
        let [own, other] = [(&goes_on, 0), (&extension, 1)].map(|(series, side)| {
            let values = series.of(name).unwrap_or_default();
            common.iter().filter_map(|at| values.get(at[side])).fold(0.0, |most: f64, x| most.max(*x)) / si
        });
        Some(format!("{what} {other:.0} {unit} instead of {own:.0} {unit}"))
    });
    parts.extend(peaks);
    format!(
        "{WHY}. From {from_s:.3} s to {to_s:.3} s, compared with the continued run: {}; peaks, extension and run: {}",
        parts[0],
        parts[1..].join(", ")
    )
}

/// Indices of outputs at the same times.
fn common(one_s: &[f64], other_s: &[f64]) -> Vec<[usize; 2]> {
    let at = |t_s: f64| other_s.iter().position(|other| (other - t_s).abs() < SAME_S);
    one_s.iter().enumerate().filter_map(|(i, t_s)| Some([i, at(*t_s)?])).collect()
}

fn apart_m(one: &Series, other: &Series, common: &[[usize; 2]]) -> f64 {
    let square = |at: &[usize; 2], name: &str| {
        let [a, b] = [(one, at[0]), (other, at[1])].map(|(series, i)| series.of(name).and_then(|v| v.get(i)).copied());
        a.zip(b).map_or(f64::NAN, |(a, b)| (a - b) * (a - b))
    };
    common.iter().map(|at| HEAD.iter().map(|name| square(at, name)).sum::<f64>().sqrt()).fold(0.0, f64::max)
}
