//! Points of series 8 that bound the surfaces of series 9: read from `compartment.toml`, not from code.

use std::collections::BTreeSet;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::deck::Deck;

/// Built-in reconstruction of the compartment.
const RECONSTRUCTION: &str = include_str!("compartment.toml");
const POINTS: u32 = 22;
const SURFACES: u32 = 25;

/// The surfaces of the card deck's compartment.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CompartmentLayout {
    roof_points: Vec<u32>,
    #[serde(rename = "surface")]
    surfaces: Vec<SurfaceLayout>,
    pub(crate) wheel: WheelLayout,
}

/// A planar surface; either `edge` or `corners`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct SurfaceLayout {
    number: u32,
    name: String,
    edge: Option<[u32; 2]>,
    #[serde(default)]
    corners: Vec<Corner>,
    faces: [f64; 3],
}

/// A side of the compartment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wall {
    /// The card's variable of its half width, VCW or VRW.
    pub half_width: &'static str,
    /// Whether it is on the left, at negative Y.
    pub is_left: bool,
}

/// The half widths of the body and of the roof.
const HALF_WIDTHS: [&str; 2] = ["VCW", "VRW"];

impl<'de> Deserialize<'de> for Wall {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        let width = name.strip_prefix('-').unwrap_or(&name);
        let known = HALF_WIDTHS.into_iter().find(|half_width| *half_width == width);
        let unknown = || D::Error::unknown_variant(&name, &["-VCW", "VCW", "-VRW", "VRW"]);
        Ok(Self { half_width: known.ok_or_else(unknown)?, is_left: name.starts_with('-') })
    }
}

/// The steering wheel.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WheelLayout {
    /// Number of the surface.
    pub number: u32,
    /// Name of the surface.
    pub name: String,
    /// Point that gives its centre.
    pub point: u32,
    /// Distance of its centre behind that point, in.
    pub behind_in: f64,
    /// Distance of its centre below that point, in; 0 if absent.
    #[serde(default)]
    pub below_in: f64,
    /// Tilt of its plane from vertical, degrees; it faces rearward and up.
    pub tilt_deg: f64,
}

/// A corner of a surface, by the cards' variables.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Corner {
    /// Point whose XV is the corner's X.
    #[serde(rename = "x")]
    pub x_of: u32,
    /// Point whose ZV is the corner's Z.
    #[serde(rename = "z")]
    pub z_of: u32,
    /// Its Y.
    pub wall: Wall,
}

/// A surface with its corners counter-clockwise seen from its open side.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// Number in series 9.
    pub number: u32,
    /// Name in scenarios.
    pub name: String,
    /// Its corners; none if the deck's points give it no area.
    pub corners: Vec<Corner>,
}

/// A surface of a deck that a conversion omits.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LeftOut {
    /// Number in series 9.
    pub number: u32,
    /// Name in scenarios.
    pub name: String,
    /// Reason, as the predicate of a sentence about it.
    pub why: &'static str,
}

impl WheelLayout {
    /// Its position, as text.
    pub(crate) fn words(&self) -> String {
        let height = match self.below_in {
            0.0 => "level with it".to_owned(),
            below if below < 0.0 => format!("{} in above it", -below),
            below => format!("{below} in below it"),
        };
        format!("{} in behind point {} and {height}", self.behind_in, self.point)
    }
}

impl CompartmentLayout {
    /// Built-in reconstruction.
    ///
    /// # Errors
    /// As [`CompartmentLayout::from_toml`]; a test of the crate shows that there are none.
    pub fn reconstruction() -> Result<Self, String> {
        Self::from_toml(RECONSTRUCTION)
    }

    /// A layout from a file, for owners of the report's figures.
    ///
    /// # Errors
    /// The TOML reader's message, or which surface or point is wrong.
    pub fn from_toml(text: &str) -> Result<Self, String> {
        let mut layout: Self = toml::from_str(text).map_err(|error| error.to_string())?;
        for surface in &mut layout.surfaces {
            if surface.edge.is_some() != surface.corners.is_empty() || matches!(surface.corners.len(), 1 | 2) {
                return Err(format!("surface {} needs either an edge or at least three corners", surface.number));
            }
            if let Some(edge) = surface.edge {
                surface.corners = corners_of_edge(edge, &layout.roof_points);
            }
        }
        layout.check()?;
        Ok(layout)
    }

    /// This layout, or the built-in reconstruction without one.
    pub(crate) fn or_reconstruction(layout: Option<&Self>) -> Result<Self, String> {
        layout.cloned().map_or_else(Self::reconstruction, Ok)
    }

    /// The name of a surface by its number.
    pub(crate) fn name_of(&self, number: u32) -> Option<&str> {
        self.numbered().find(|(n, _)| *n == number).map(|(_, name)| name)
    }

    /// The number of a surface by its name.
    pub fn number_of(&self, name: &str) -> Option<u32> {
        self.numbered().find(|(_, n)| *n == name).map(|(number, _)| number)
    }

    /// Number and name of all surfaces.
    pub(crate) fn numbered(&self) -> impl Iterator<Item = (u32, &str)> {
        let planar = self.surfaces.iter().map(|s| (s.number, s.name.as_str()));
        planar.chain([(self.wheel.number, self.wheel.name.as_str())])
    }

    /// Corners of a surface in the order of the data file, whatever its open side; none for the wheel.
    pub(crate) fn corners_of(&self, number: u32) -> &[Corner] {
        self.surfaces.iter().find(|s| s.number == number).map_or(&[], |s| &s.corners)
    }

    /// Points that bound a surface, or that give the wheel's position.
    pub(crate) fn points_of(&self, number: u32) -> BTreeSet<u32> {
        if number == self.wheel.number {
            return BTreeSet::from([self.wheel.point]);
        }
        self.corners_of(number).iter().flat_map(|corner| [corner.x_of, corner.z_of]).collect()
    }

    /// Coordinates of series 8 that bound no surface, by their variables.
    pub(crate) fn unused_coordinates(&self) -> Vec<String> {
        let corners = || self.surfaces.iter().flat_map(|surface| &surface.corners);
        let bounds = |n: u32| [corners().any(|corner| corner.x_of == n), corners().any(|corner| corner.z_of == n)];
        let unused = |n: u32| {
            let is_used = bounds(n).map(|bounds| bounds || n == self.wheel.point);
            ["XV", "ZV"].into_iter().zip(is_used).filter(|(_, used)| !used).map(move |(axis, _)| format!("{axis}({n})"))
        };
        (1..=POINTS).flat_map(unused).collect()
    }

    fn check(&self) -> Result<(), String> {
        let mut numbers: Vec<u32> = self.numbered().map(|(number, _)| number).collect();
        numbers.sort_unstable();
        if !numbers.iter().copied().eq(1..=SURFACES) {
            return Err(format!("the surfaces must be numbered 1 to {SURFACES}, each once; found {numbers:?}"));
        }
        for surface in &self.surfaces {
            if let Some(point) = self.points_of(surface.number).iter().find(|p| !(1..=POINTS).contains(*p)) {
                return Err(format!("surface {} names point {point}; there are {POINTS}", surface.number));
            }
        }
        if !(1..=POINTS).contains(&self.wheel.point) {
            return Err(format!("the wheel names point {}; there are {POINTS}", self.wheel.point));
        }
        Ok(())
    }

    /// Planar surfaces of a deck, by number, without the wheel.
    pub fn faces(&self, deck: &Deck) -> Vec<Face> {
        let mut faces: Vec<_> = self.surfaces.iter().map(|surface| face(surface, deck)).collect();
        faces.sort_by_key(|face| face.number);
        faces
    }

    /// Surfaces of a deck that no scenario gets, by number: those without area and those without resistance. An
    /// unreadable number omits none.
    pub(crate) fn left_out(&self, deck: &Deck) -> Vec<LeftOut> {
        let faces = self.faces(deck).into_iter();
        let no_extent = |face: Face| (face.corners.is_empty().then_some("has no area"), face.number, face.name);
        let wheel = deck.value("DSW").is_some_and(|diameter| diameter <= 0.0).then_some("has no diameter");
        let all = faces.map(no_extent).chain([(wheel, self.wheel.number, self.wheel.name.clone())]);
        // STIF1 = 0 alone is a gap before the spring bears
        let is_zero = |stiffness: &str, number| deck.value(&format!("{stiffness}({number})")) == Some(0.0);
        let resists_nothing = |number| is_zero("STIF1", number) && is_zero("STIF2", number);
        all.filter_map(|(why, number, name)| {
            let why = why.or(resists_nothing(number).then_some("resists nothing (STIF1 = STIF2 = 0)"))?;
            Some(LeftOut { number, name, why })
        })
        .collect()
    }
}

/// Corners of a surface that spans the width at two points.
fn corners_of_edge([one, two]: [u32; 2], roof_points: &[u32]) -> Vec<Corner> {
    let corner = |point: u32, is_left: bool| {
        let half_width = HALF_WIDTHS[usize::from(roof_points.contains(&point))];
        Corner { x_of: point, z_of: point, wall: Wall { half_width, is_left } }
    };
    vec![corner(one, true), corner(two, true), corner(two, false), corner(one, false)]
}

fn face(surface: &SurfaceLayout, deck: &Deck) -> Face {
    let mut corners = surface.corners.clone();
    let normal = area_vector(&corners.iter().map(|c| position(c, deck)).collect::<Vec<_>>());
    let towards: f64 = normal.iter().zip(surface.faces).map(|(n, f)| n * f).sum();
    if towards < 0.0 {
        corners.reverse();
    }
    if normal.iter().map(|n| n * n).sum::<f64>() < SMALLEST_AREA_IN2 * SMALLEST_AREA_IN2 {
        corners.clear();
    }
    Face { number: surface.number, name: surface.name.clone(), corners }
}

/// Area below which a surface does not exist, in².
const SMALLEST_AREA_IN2: f64 = 1e-6;

/// Position of a corner in vehicle axes, in.
fn position(corner: &Corner, deck: &Deck) -> [f64; 3] {
    let value = |name: &str| deck.value(name).unwrap_or(f64::NAN);
    let width = value(corner.wall.half_width);
    let y = if corner.wall.is_left { -width } else { width };
    [value(&format!("XV({})", corner.x_of)), y, value(&format!("ZV({})", corner.z_of))]
}

/// Half the sum of the cross products of neighbouring corners: normal times area, in².
fn area_vector(corners: &[[f64; 3]]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        for (axis, part) in sum.iter_mut().enumerate() {
            let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
            *part += 0.5 * (a[j] * b[k] - a[k] * b[j]);
        }
    }
    sum
}
