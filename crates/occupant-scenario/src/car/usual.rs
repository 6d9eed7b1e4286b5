//! Built-in distributions for studies of the keys of a car and of its occupants.

use super::{Dimension, Size, dimensions};
use placed_text::{Node, Sources};

/// Built-in distribution of a value, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Usual {
    /// Truncated normal distribution.
    Normal {
        /// Mean, and standard deviation before truncation.
        mean_sd: [f64; 2],
        /// Least and greatest value.
        ends: [f64; 2],
    },
    /// Triangular distribution with its mode at the lower end.
    Falling {
        /// Mode, which is the least value.
        mode: f64,
        /// The greatest value.
        to: f64,
    },
}

/// Definition of a built-in distribution.
enum Spread {
    /// Around the scenario's or the class's value: standard deviation, and largest deviation, m or rad.
    About(f64, f64),
    Law(Usual),
}

/// Keys of a seat's occupant with their distributions, and sources.
const OF_SEATS: [(&str, Spread); 6] = [
    // beside stature, which moves the seat by itself: what the lengths of seat tracks in SAE J4004 leave; an estimate
    ("track", Spread::About(0.033, 0.10)),
    // an estimate: torsos of drivers differ by some degrees in one and the same seat (Reed et al., Human Factors 42, 2000)
    ("recline", Spread::About(0.07, 0.175)),
    // estimates: D-rings of 83 second rows were "distributed widely" (Reed, Ebert: SAE 2013-01-1157)
    ("d_ring.behind", Spread::About(0.04, 0.10)),
    ("d_ring.above", Spread::About(0.03, 0.08)),
    // 22.9 mm beside body mass index (Reed, Ebert, Hallman: Stapp Car Crash J. 57, 2013)
    ("lap_above", Spread::About(0.0229, 0.045)),
    // of belted drivers of US cars 35 % had more than 25 mm, most of them less than 50 mm (Maryland, model years 1974 to 1987)
    ("slack", Spread::Law(Usual::Falling { mode: 0.0, to: 0.06 })),
];
/// Keys of the car; estimates for columns with tilt and reach adjustment.
const OF_CAR: [(&str, Spread); 2] =
    [("wheel.ahead", Spread::About(0.025, 0.06)), ("wheel.above", Spread::About(0.02, 0.05))];
/// Adults of the United States, 2011 to 2014 (Fryar et al., Vital and Health Statistics 3, 39): stature of women and men, m, and mass, kg.
/// The standard deviations follow from the percentiles.
const STATURE_M: [[f64; 2]; 2] = [[1.618, 0.071], [1.757, 0.076]];
const MASS_KG: [[f64; 2]; 2] = [[76.4, 19.0], [88.8, 19.0]];

/// Built-in distribution for a path; none if there is none.
pub(crate) fn usual(sources: &Sources, root: &Node, path: &str) -> Option<Usual> {
    if let Some((own, key)) = path.rsplit_once("body.") {
        return of_body(root, own, key);
    }
    let own = path.strip_prefix("car.")?;
    let spread = match own.strip_prefix("seats.") {
        Some(of_seat) => find(&OF_SEATS, of_seat.split_once('.')?.1)?,
        None => find(&OF_CAR, own)?,
    };
    let (sd, most) = match spread {
        Spread::Law(law) => return Some(*law),
        Spread::About(sd, most) => (*sd, *most),
    };
    let all = dimensions(sources, root);
    let found = all.iter().find(|dimension: &&Dimension| dimension.vehicle.is_none() && dimension.name == own)?;
    let (Size::Distance(mean) | Size::Angle(mean)) = found.size else { return None };
    Some(Usual::Normal { mean_sd: [mean, sd], ends: [mean - most, mean + most] })
}

fn find<'t>(table: &'t [(&str, Spread)], key: &str) -> Option<&'t Spread> {
    table.iter().find(|(known, _)| *known == key).map(|(_, spread)| spread)
}

/// Distribution for a person of known sex: "body" or "occupants.NAME.body".
fn of_body(root: &Node, own: &str, key: &str) -> Option<Usual> {
    let mut steps = own.trim_end_matches('.').split('.').filter(|step| !step.is_empty());
    let holder = steps.try_fold(root, |node, step| node.get(step))?;
    let sex = match holder.get("body")?.get("sex").and_then(Node::as_str)? {
        "female" => 0,
        "male" => 1,
        _ => return None,
    };
    let (mean_sd, ends) = match key {
        "stature" => (STATURE_M[sex], [-2.5, 2.5]),
        "mass" => (MASS_KG[sex], [-1.6, 2.5]),
        _ => return None,
    };
    Some(Usual::Normal { mean_sd, ends: ends.map(|sds| mean_sd[0] + sds * mean_sd[1]) })
}
