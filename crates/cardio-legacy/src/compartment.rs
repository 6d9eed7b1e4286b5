//! Which points of series 8 bound which surface of series 9: read from `compartment.toml`, not from code.

use serde::Deserialize;

use crate::deck::Deck;

/// The reconstruction that travels with the crate.
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
    /// Where the steering wheel stands.
    pub wheel: WheelLayout,
}

/// One planar surface; either `edge` or `corners`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct SurfaceLayout {
    number: u32,
    name: String,
    edge: Option<[u32; 2]>,
    corners: Option<Vec<CornerLayout>>,
    faces: [f64; 3],
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct CornerLayout {
    x: u32,
    z: u32,
    wall: Wall,
}

/// A side of the compartment: half width and sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub enum Wall {
    /// Left, at the half width of the compartment.
    #[serde(rename = "-VCW")]
    LeftBody,
    /// Right, at the half width of the compartment.
    #[serde(rename = "VCW")]
    RightBody,
    /// Left, at the half width of the roof.
    #[serde(rename = "-VRW")]
    LeftRoof,
    /// Right, at the half width of the roof.
    #[serde(rename = "VRW")]
    RightRoof,
}

impl Wall {
    /// The card's variable, and whether it counts negative (to the left).
    pub fn half_width(self) -> (&'static str, bool) {
        match self {
            Self::LeftBody => ("VCW", true),
            Self::RightBody => ("VCW", false),
            Self::LeftRoof => ("VRW", true),
            Self::RightRoof => ("VRW", false),
        }
    }
}

/// The steering wheel.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WheelLayout {
    /// Number of the surface.
    pub number: u32,
    /// Name of the surface.
    pub name: String,
    /// The point with which its centre is level.
    pub point: u32,
    /// How far its centre lies behind that point, in.
    pub behind_in: f64,
    /// Tilt of its plane from vertical, degrees; it faces rearward and up.
    pub tilt_deg: f64,
}

/// A corner of a surface, by the cards' variables.
#[derive(Debug, Clone, PartialEq)]
pub struct Corner {
    /// Point whose XV is the corner's X.
    pub x_of: u32,
    /// Point whose ZV is the corner's Z.
    pub z_of: u32,
    /// Its Y.
    pub wall: Wall,
}

/// A surface with its corners counter-clockwise as seen from its open side.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// Number in series 9.
    pub number: u32,
    /// Name in scenarios.
    pub name: String,
    /// Its corners; none where the deck's points leave it without area.
    pub corners: Vec<Corner>,
}

/// A surface of a deck that a conversion leaves out.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LeftOut {
    /// Number in series 9.
    pub number: u32,
    /// Name in scenarios.
    pub name: String,
    /// Why, as the predicate of a sentence about it.
    pub why: &'static str,
}

impl CompartmentLayout {
    /// The reconstruction that travels with the crate.
    ///
    /// # Errors
    /// As [`CompartmentLayout::from_toml`]; a test of the crate shows that there is none.
    pub fn reconstruction() -> Result<Self, String> {
        Self::from_toml(RECONSTRUCTION)
    }

    /// A layout of somebody who holds the figures.
    ///
    /// # Errors
    /// The TOML reader's message, or which surface or point is wrong.
    pub fn from_toml(text: &str) -> Result<Self, String> {
        let layout: Self = toml::from_str(text).map_err(|error| error.to_string())?;
        layout.check()?;
        Ok(layout)
    }

    /// The name of a surface by its number.
    pub fn name_of(&self, number: u32) -> Option<&str> {
        let surface = self.surfaces.iter().find(|s| s.number == number);
        let wheel = (self.wheel.number == number).then_some(&self.wheel.name);
        surface.map(|s| &s.name).or(wheel).map(String::as_str)
    }

    /// The number of a surface by its name.
    pub fn number_of(&self, name: &str) -> Option<u32> {
        let surface = self.surfaces.iter().find(|s| s.name == name).map(|s| s.number);
        surface.or_else(|| (self.wheel.name == name).then_some(self.wheel.number))
    }

    /// The names of all surfaces, by number.
    pub fn names(&self) -> Vec<&str> {
        (1..=SURFACES).filter_map(|number| self.name_of(number)).collect()
    }

    /// The corners of a surface in the order of the data file, whatever its open side; none for the wheel.
    pub(crate) fn corners_of(&self, number: u32) -> Vec<Corner> {
        let surface = self.surfaces.iter().find(|s| s.number == number);
        surface.map(|s| self.corners(s)).unwrap_or_default()
    }

    /// The points by which a surface is bounded; that of the wheel's place for the wheel.
    pub fn points_of(&self, number: u32) -> Vec<u32> {
        let Some(surface) = self.surfaces.iter().find(|s| s.number == number) else {
            return vec![self.wheel.point];
        };
        let corners = surface.corners.iter().flatten().flat_map(|c| [c.x, c.z]);
        let mut points: Vec<u32> = surface.edge.iter().flatten().copied().chain(corners).collect();
        points.sort_unstable();
        points.dedup();
        points
    }

    fn check(&self) -> Result<(), String> {
        let mut numbers: Vec<u32> = self.surfaces.iter().map(|s| s.number).chain([self.wheel.number]).collect();
        numbers.sort_unstable();
        if !numbers.iter().copied().eq(1..=SURFACES) {
            return Err(format!("the surfaces must be numbered 1 to {SURFACES}, each once; found {numbers:?}"));
        }
        for surface in &self.surfaces {
            let points = match (&surface.edge, &surface.corners) {
                (Some(edge), None) => edge.to_vec(),
                (None, Some(corners)) if corners.len() >= 3 => corners.iter().flat_map(|c| [c.x, c.z]).collect(),
                _ => {
                    return Err(format!("surface {} needs either an edge or at least three corners", surface.number));
                }
            };
            if let Some(point) = points.iter().find(|p| !(1..=POINTS).contains(*p)) {
                return Err(format!("surface {} names point {point}; there are {POINTS}", surface.number));
            }
        }
        if !(1..=POINTS).contains(&self.wheel.point) {
            return Err(format!("the wheel names point {}; there are {POINTS}", self.wheel.point));
        }
        Ok(())
    }

    /// The planar surfaces of a deck, by number; the wheel is not among them.
    pub fn faces(&self, deck: &Deck) -> Vec<Face> {
        let mut faces: Vec<_> = self.surfaces.iter().map(|surface| self.face(surface, deck)).collect();
        faces.sort_by_key(|face| face.number);
        faces
    }

    /// All surfaces of a deck that no scenario gets, by number: those without area and those that resist nothing. A number that
    /// could not be read leaves none out.
    pub(crate) fn left_out(&self, deck: &Deck) -> Vec<LeftOut> {
        let faces = self.faces(deck).into_iter();
        let no_extent = |face: Face| (face.corners.is_empty().then_some("has no area"), face.number, face.name);
        let wheel = deck.value("DSW").is_some_and(|diameter| diameter <= 0.0).then_some("has no diameter");
        let all = faces.map(no_extent).chain([(wheel, self.wheel.number, self.wheel.name.clone())]);
        let resists_nothing = |number| deck.value(&format!("STIF1({number})")) == Some(0.0);
        all.filter_map(|(why, number, name)| {
            let why = why.or(resists_nothing(number).then_some("resists nothing (STIF1 = 0)"))?;
            Some(LeftOut { number, name, why })
        })
        .collect()
    }

    fn face(&self, surface: &SurfaceLayout, deck: &Deck) -> Face {
        let mut corners = self.corners(surface);
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

    fn corners(&self, surface: &SurfaceLayout) -> Vec<Corner> {
        if let Some([one, two]) = surface.edge {
            return [(one, false), (two, false), (two, true), (one, true)]
                .map(|(point, right)| Corner { x_of: point, z_of: point, wall: self.wall_at(point, right) })
                .to_vec();
        }
        let corners = surface.corners.iter().flatten();
        corners.map(|c| Corner { x_of: c.x, z_of: c.z, wall: c.wall }).collect()
    }

    fn wall_at(&self, point: u32, right: bool) -> Wall {
        match (self.roof_points.contains(&point), right) {
            (true, false) => Wall::LeftRoof,
            (true, true) => Wall::RightRoof,
            (false, false) => Wall::LeftBody,
            (false, true) => Wall::RightBody,
        }
    }
}

/// A surface smaller than this is none.
const SMALLEST_AREA_IN2: f64 = 1e-6;

/// Place of a corner in vehicle axes, in.
fn position(corner: &Corner, deck: &Deck) -> [f64; 3] {
    let value = |name: &str| deck.value(name).unwrap_or(f64::NAN);
    let (width, left) = corner.wall.half_width();
    let y = if left { -value(width) } else { value(width) };
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
