//! The 16 characters of a channel code, and the corresponding channels.
//!
//! ```text
//! 1 1 HEAD CG 00 H3 AC X A
//! │ │ │    │  │  │  │  │ └ filter class: A 1000, B 600, C 180, D 60, 0 none
//! │ │ │    │  │  │  │  └ direction X Y Z, R resultant, 0 none; 1 2 3 with other signs than SAE J211
//! │ │ │    │  │  │  └ physical dimension
//! │ │ │    │  │  └ fine location 3: dummy, or point of a belt
//! │ │ │    └──┴ fine locations 1 and 2
//! │ │ └ main location
//! │ └ position: seat, 0 for the vehicle
//! └ test object
//! ```
//!
//! Segment axes are X ahead, Y left, Z up; SAE J211 turns them about X: Y and Z change their signs.

use std::fmt;
use std::str::FromStr;

use crash_measures::signal::ChannelClass;
use occupant_core::body::Segment;
use occupant_core::forces::chain::{Chain, Node, Site};
use occupant_core::model::Model;
use occupant_core::results::channel::Channel;

/// A channel code of 16 characters, ISO 13499.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Code([u8; 16]);

/// Position of one of our channels in the dictionary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Main and fine locations 1 and 2, eight characters.
    pub location: &'static str,
    /// Fine location 3, such as a point of a belt; that of the dummy if absent.
    pub third: Option<&'static str>,
    /// Physical dimension.
    pub dimension: &'static str,
    /// Direction: X, Y, Z, R of a resultant, or 0.
    pub direction: char,
    /// Whether it belongs to the vehicle instead of the occupant.
    of_vehicle: bool,
    /// Ratio of the coded value to ours: 1 or −1.
    pub sign: f64,
}

impl FromStr for Code {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let bytes: [u8; 16] = text.trim().as_bytes().try_into().map_err(|_| ())?;
        let word = |b: &u8| b.is_ascii_uppercase() || b.is_ascii_digit() || *b == b'?';
        bytes.iter().all(word).then_some(Code(bytes)).ok_or(())
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|b| write!(f, "{}", char::from(*b)))
    }
}

impl Code {
    /// Code of a dictionary position.
    pub fn new(place: &Place, seat: char, dummy: &str, class: Option<ChannelClass>) -> Option<Self> {
        let position = if place.of_vehicle { '0' } else { seat };
        let third = if place.of_vehicle { "00" } else { place.third.unwrap_or(dummy) };
        let filter = class.map_or('0', ChannelClass::mme_letter);
        format!("1{position}{}{third}{}{}{filter}", place.location, place.dimension, place.direction).parse().ok()
    }

    fn part(&self, from: usize, to: usize) -> &str {
        std::str::from_utf8(&self.0[from..to]).unwrap_or_default()
    }

    /// Ratio of our value to the coded one, if this is the channel of that name for the occupant on `seat`.
    pub fn sign_for(&self, channel: &str, seat: char) -> Option<f64> {
        if let Some(rest) = channel.strip_prefix("belt.") {
            let name = rest.strip_suffix(".force")?;
            let points = webbing_points(name)?;
            let is_webbing = (self.part(2, 6), self.part(12, 14)) == ("SEBE", "FO") && self.is_at(seat);
            return (is_webbing && points.contains(&self.part(10, 12))).then_some(1.0);
        }
        let place = place_of_name(channel)?;
        let fine = self.part(6, 10);
        let position = if place.of_vehicle { self.is_at('0') } else { self.is_at(seat) };
        let fits = self.part(2, 6) == &place.location[..4]
            && (fine == &place.location[4..] || fine == "0000")
            && self.part(12, 14) == place.dimension
            && char::from(self.0[14]) == place.direction
            && position;
        fits.then_some(place.sign)
    }

    /// Ratio of our value to the coded one, if this is the channel at a position of webbing, bag or column.
    pub fn sign_at(&self, place: &Place, seat: char) -> Option<f64> {
        let third = place.third?;
        let fits = self.part(2, 6) == &place.location[..4]
            && (third == "00" || third == self.part(10, 12))
            && self.part(12, 14) == place.dimension
            && (place.direction == '0' || char::from(self.0[14]) == place.direction)
            && self.is_at(seat);
        fits.then_some(place.sign)
    }

    /// Location on the vehicle and axis (from 0) of a vehicle acceleration.
    pub fn vehicle_acceleration(&self) -> Option<(String, usize)> {
        let axis = "XYZ".find(char::from(self.0[14]))?;
        let is_own = self.part(12, 14) == "AC" && self.is_at('0');
        is_own.then(|| (self.part(2, 10).trim_end_matches('0').to_owned(), axis))
    }

    fn is_at(&self, position: char) -> bool {
        let own = char::from(self.0[1]);
        own == position || own == '?' || (position == '0' && self.0[0] == b'S')
    }
}

/// Dictionary position of a model's channel; none if the dictionary has none.
pub fn place_of(model: &Model, channel: &Channel) -> Option<Place> {
    let (kind, rest) = channel.name.split_once('.')?;
    let setup = model.setup();
    // of several occupants, nothing says which of these is whose
    if ["belt", "strap", "bag", "column"].contains(&kind) && model.body().tree.bodies().len() > 1 {
        return None;
    }
    let is_first =
        |names: &mut dyn Iterator<Item = &String>, name: &str| names.next().is_some_and(|first| first == name);
    let beside = |location, third, dimension, direction| {
        Some(Place { location, third: Some(third), dimension, direction, of_vehicle: false, sign: 1.0 })
    };
    match (kind, rest.rsplit_once('.')) {
        ("belt", Some((name, "force"))) => beside("SEBE0000", loop_point(model, name)?, "FO", '0'),
        ("strap", Some((name, "force"))) => beside("SEBE0000", strap_point(model, name)?, "FO", '0'),
        // the dictionary tells bags and columns of a seat not apart
        ("bag", Some((name, "pressure"))) if is_first(&mut setup.bags.iter().map(|bag| &bag.name), name) => {
            beside("AIRB0000", "00", "PR", '0')
        }
        ("column", Some((name, what))) if is_first(&mut setup.columns.iter().map(|column| &column.name), name) => {
            let dimension = [("stroke", "DS"), ("force", "FO")].into_iter().find(|(of, _)| *of == what)?.1;
            beside("STCO0000", "00", dimension, 'X')
        }
        _ => place_of_name(&channel.name),
    }
}

/// Webbing point (fine location 3) of a loop, by the part of the body that it goes round.
fn loop_point(model: &Model, name: &str) -> Option<&'static str> {
    let round = model.named("belt").into_iter().find(|one| one.name == name)?.sphere?;
    let (segment, tree) = (model.body().spheres.get(round)?.segment, &model.body().tree);
    match segment {
        _ if Some(segment) == tree.landmarks().pelvis => Some("B6"),
        _ if tree.is_trunk(segment) => Some("B3"),
        _ => None,
    }
}

/// What a node of webbing rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    /// The vehicle.
    Anchor,
    Pelvis,
    /// The body above the pelvis: chest or shoulder.
    Chest,
}

/// Webbing point (fine location 3) of a strap: B1 at the retractor, B3 and B4 above and below the chest, B5 and B6 at the inner and
/// outer side of the pelvis. The inner side is that of the buckle, which both sections share.
fn strap_point(model: &Model, name: &str) -> Option<&'static str> {
    let chain = model.setup().chains.iter().find(|chain| chain.straps.iter().any(|strap| strap == name))?;
    let number = chain.straps.iter().position(|strap| strap == name)?;
    let last = chain.nodes.len().checked_sub(1)?;
    let parts = |i: &usize| *i == 0 || *i == last || chain.nodes[*i].parts();
    let ends: Vec<usize> = (0..=last).filter(parts).collect();
    let [first, end] = [*ends.get(number)?, *ends.get(number + 1)?];
    let (from, to) = (&chain.nodes[first], &chain.nodes[end]);
    let over = |wanted: Part| chain.nodes[first + 1..end].iter().any(|node| part_of(model, node) == wanted);
    match [from, to].map(|node| part_of(model, node)) {
        // webbing that runs freely over the body is one strap
        [Part::Anchor, Part::Anchor] if over(Part::Pelvis) => Some("B6"),
        [Part::Anchor, Part::Anchor] if over(Part::Chest) => Some("B3"),
        [Part::Anchor, Part::Anchor] => (number == 0 && chain.device.reel.is_some()).then_some("B1"),
        [Part::Anchor, Part::Chest] => Some(if is_beside(model, chain, from, Part::Pelvis) { "B4" } else { "B3" }),
        [Part::Chest, Part::Anchor] => Some(if is_beside(model, chain, to, Part::Pelvis) { "B4" } else { "B3" }),
        [Part::Anchor, Part::Pelvis] => Some(if is_beside(model, chain, from, Part::Chest) { "B5" } else { "B6" }),
        [Part::Pelvis, Part::Anchor] => Some(if is_beside(model, chain, to, Part::Chest) { "B5" } else { "B6" }),
        _ => None,
    }
}

fn part_of(model: &Model, node: &Node) -> Part {
    let segment = match &node.site {
        Site::Vehicle(..) => return Part::Anchor,
        Site::Segment(segment, ..) | Site::Track(segment, _) => Some(*segment),
        Site::Sphere(sphere) => model.body().spheres.get(*sphere).map(|sphere| sphere.segment.index()),
    };
    let pelvis = model.body().tree.landmarks().pelvis.map(Segment::index);
    if segment == pelvis { Part::Pelvis } else { Part::Chest }
}

/// Whether webbing of the same belt leads from a node to a part of the body.
fn is_beside(model: &Model, chain: &Chain, node: &Node, wanted: Part) -> bool {
    let parts = model.setup().chains.iter().filter(|other| other.belt == chain.belt);
    let pairs = parts.flat_map(|chain| chain.nodes.windows(2));
    let is = |one: &Node, other: &Node| one.name == node.name && part_of(model, other) == wanted;
    pairs.into_iter().any(|pair| is(&pair[0], &pair[1]) || is(&pair[1], &pair[0]))
}

/// Webbing points (fine location 3) of a belt with this name.
fn webbing_points(name: &str) -> Option<[&'static str; 2]> {
    let has = |words: &[&str]| words.iter().any(|w| name.contains(w));
    match () {
        () if has(&["lap", "pelvis"]) => Some(["B5", "B6"]),
        () if has(&["torso", "shoulder", "diagonal", "chest"]) => Some(["B3", "B4"]),
        () => None,
    }
}

fn place_of_name(name: &str) -> Option<Place> {
    let (of, component) = name.rsplit_once('.')?;
    // segment axes become those of SAE J211; loads of neck and femurs and the vehicle are in such axes already
    let (location, dimension, turned, of_vehicle) = match of {
        "head.acceleration" => ("HEADCG00", "AC", true, false),
        "head.angular_velocity" => ("HEADCG00", "AV", true, false),
        "head.angular_acceleration" => ("HEADCG00", "AA", true, false),
        "upper_torso.acceleration" => ("CHST0000", "AC", true, false),
        "upper_torso.angular_velocity" => ("CHST0000", "AV", true, false),
        "lower_torso.acceleration" => ("PELV0000", "AC", true, false),
        "lower_torso.angular_velocity" => ("PELV0000", "AV", true, false),
        "neck.force" => ("NECKUP00", "FO", false, false),
        "neck.moment" => ("NECKUP00", "MO", false, false),
        "right_femur" => ("FEMRRI00", "FO", false, false),
        "left_femur" => ("FEMRLE00", "FO", false, false),
        "chest" if component == "deflection" => ("CHST0000", "DS", false, false),
        "lower_spine.acceleration" => ("THSP1200", "AC", false, false),
        "t1.acceleration" => ("THSP0100", "AC", false, false),
        "lower_neck.force" => ("NECKLO00", "FO", false, false),
        "lower_neck.moment" => ("NECKLO00", "MO", false, false),
        "pubic" if component == "force" => ("PUBC0000", "FO", false, false),
        "right_tibia.upper.moment" => ("TIBIRIUP", "MO", false, false),
        "right_tibia.upper.force" => ("TIBIRIUP", "FO", false, false),
        "right_tibia.lower.moment" => ("TIBIRILO", "MO", false, false),
        "right_tibia.lower.force" => ("TIBIRILO", "FO", false, false),
        "left_tibia.upper.moment" => ("TIBILEUP", "MO", false, false),
        "left_tibia.upper.force" => ("TIBILEUP", "FO", false, false),
        "left_tibia.lower.moment" => ("TIBILELO", "MO", false, false),
        "left_tibia.lower.force" => ("TIBILELO", "FO", false, false),
        "vehicle.acceleration" => ("VEHCCG00", "AC", false, true),
        "vehicle.velocity" => ("VEHCCG00", "VE", false, true),
        "vehicle.angular_velocity" => ("VEHCCG00", "AV", false, true),
        "vehicle" => ("VEHCCG00", "AN", false, true),
        _ => return None,
    };
    let direction = match component {
        "x" | "roll" | "deflection" => 'X',
        "y" | "pitch" | "force" => 'Y',
        "z" | "yaw" | "axial" => 'Z',
        "resultant" => 'R',
        _ => return None,
    };
    // a deflection is inward, the sternum's way along X is not
    let is_against = (turned && matches!(direction, 'Y' | 'Z')) || dimension == "DS";
    let sign = if is_against { -1.0 } else { 1.0 };
    Some(Place { location, third: None, dimension, direction, of_vehicle, sign })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn code(text: &str) -> Code {
        text.parse().unwrap()
    }

    #[test]
    fn codes_are_sixteen_capitals_or_digits() {
        assert_eq!(code("11HEADCG00H3ACXA").to_string(), "11HEADCG00H3ACXA");
        assert!("11HEADCG00H3ACX".parse::<Code>().is_err());
        assert!("11headCG00H3ACXA".parse::<Code>().is_err());
        assert!("11HEADCG00H3ACXé".parse::<Code>().is_err());
    }

    #[test]
    fn segment_axes_turn_into_those_of_j211() {
        let sign = |text: &str, name| code(text).sign_for(name, '1');
        assert_eq!(sign("11HEADCG00H3ACXA", "head.acceleration.x"), Some(1.0));
        assert_eq!(sign("11HEAD0000H3ACYA", "head.acceleration.y"), Some(-1.0));
        assert_eq!(sign("11HEADCG00H3ACZA", "head.acceleration.z"), Some(-1.0));
        assert_eq!(sign("11HEADCG00H3ACRA", "head.acceleration.resultant"), Some(1.0));
        assert_eq!(sign("11NECKUP00H3FOZB", "neck.force.z"), Some(1.0));
        assert_eq!(sign("10VEHCCG0000ACXD", "vehicle.acceleration.x"), Some(1.0));
        // direction 3 has unknown signs, seat 3 is another occupant, the lower neck is another place
        assert_eq!(sign("11HEADCG00H3AC3A", "head.acceleration.z"), None);
        assert_eq!(sign("13HEADCG00H3ACXA", "head.acceleration.x"), None);
        assert_eq!(sign("11NECKLO00H3FOZB", "neck.force.z"), None);
    }

    #[test]
    fn chests_and_legs_are_known_too() {
        let sign = |text: &str, name| code(text).sign_for(name, '1');
        assert_eq!(sign("11CHST0000H3DSXC", "chest.deflection"), Some(-1.0));
        assert_eq!(sign("11CHST0000H3DSXC", "chest.deflection.x"), None);
        assert_eq!(sign("11TIBILEUPH3MOYB", "left_tibia.upper.moment.y"), Some(1.0));
        assert_eq!(sign("11TIBILEUPH3MOYB", "left_tibia.lower.moment.y"), None);
        assert_eq!(sign("11PUBC0000ERFOYB", "pubic.force"), Some(1.0));
        assert_eq!(sign("11THSP0100BRACXD", "t1.acceleration.x"), Some(1.0));
        assert_eq!(sign("11NECKLO00BRMOYB", "lower_neck.moment.y"), Some(1.0));
    }

    #[test]
    fn belts_are_known_by_their_points() {
        let sign = |text: &str, name| code(text).sign_for(name, '1');
        assert_eq!(sign("11SEBE0000B6FO0D", "belt.lap.force"), Some(1.0));
        assert_eq!(sign("11SEBE0000B3FO0D", "belt.torso.force"), Some(1.0));
        assert_eq!(sign("11SEBE0000B3FO0D", "belt.lap.force"), None);
        assert_eq!(sign("11SEBE0000B1FO0D", "belt.torso.force"), None);
    }
}
