//! Deformable parts of the trunk: point masses on slides, and what rides on them.

use nalgebra::{Point3, Vector3};

use super::Segment;

/// A part of a segment that deforms along a line: its mass is a sliding point.
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    /// Unique name, such as `sternum`.
    pub name: String,
    /// Its segment; its mass is part of the segment's.
    pub segment: Segment,
    /// Initial position of its mass, from the segment's lower end, segment axes, m.
    pub place_from_lower_end_m: Point3<f64>,
    /// Inward sliding direction, segment axes; any length.
    pub inward: Vector3<f64>,
    /// m.
    pub mass_kg: f64,
    /// Depth of the trunk behind it, m: deflections of more than 0.45 of it are reported. None if unknown.
    pub depth_m: Option<f64>,
}

/// Indices of plates, each with the share of its deflection that is followed, 0 to 1.
pub type Shares = Vec<(usize, f64)>;

/// Plates that a sphere rides on, by contact type.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ride {
    /// In contact with surfaces, solids and other spheres.
    pub contact: Shares,
    /// In contact with belts.
    pub belt: Shares,
    /// In contact with air bags.
    pub bag: Shares,
}

impl Ride {
    /// All plates that it rides on, each once.
    pub(crate) fn plates(&self) -> Vec<usize> {
        let all = [&self.contact, &self.belt, &self.bag];
        let mut plates: Vec<usize> = all.into_iter().flatten().map(|(plate, _)| *plate).collect();
        plates.sort_unstable();
        plates.dedup();
        plates
    }

    /// The ride with plate indices shifted by `first`.
    #[must_use]
    pub(crate) fn behind(&self, first: usize) -> Self {
        let moved = |shares: &Shares| shares.iter().map(|(plate, share)| (first + plate, *share)).collect();
        Ride { contact: moved(&self.contact), belt: moved(&self.belt), bag: moved(&self.bag) }
    }
}

impl Sides {
    /// The sides in a model of several bodies, for the body with this name whose plates begin at `first`.
    pub(crate) fn of_member(&self, name: &str, first: usize) -> Self {
        let moved = |plate: usize| first + plate;
        let (ribs, abdomen) = (self.ribs.map(moved), self.abdomen.map(moved));
        let pelvis = self.pelvis.map(|plates| plates.map(moved));
        Sides { of: name.to_owned(), ribs, abdomen, pelvis, ..self.clone() }
    }
}

impl Chest {
    /// The ride in a model of several bodies, for the body with this name whose plates begin at `first`.
    pub(crate) fn of_member(&self, name: &str, first: usize) -> Self {
        let moved = |shares: &Shares| shares.iter().map(|(plate, share)| (first + plate, *share)).collect();
        let points = self.points.iter().map(|(point, shares)| (point.clone(), moved(shares))).collect();
        Chest { of: name.to_owned(), breastbone: first + self.breastbone, points, ..self.clone() }
    }
}

/// The sides of a trunk in the results: ribs on the left and on the right, and the abdomen between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Sides {
    /// Name of the body among several; empty for a single one.
    pub of: String,
    /// Origin of its plates: `person` or `es2`.
    pub preset: String,
    /// Indices of the plates of the ribs, left and right.
    pub ribs: [usize; 2],
    /// Index of the abdomen's plate, if there is an abdomen.
    pub abdomen: Option<usize>,
    /// Indices of the plates of the pelvis, left and right, if it yields.
    pub pelvis: Option<[usize; 2]>,
    /// Share of the force on a side of the pelvis that the pubic symphysis of a dummy feels; none for a person.
    pub pubic_share: Option<f64>,
    /// Half of the breadth of the chest, m: the reference of the viscous criterion.
    pub half_breadth_m: f64,
}

/// A chest in the results: body, depth, and measuring points.
#[derive(Clone, Debug, PartialEq)]
pub struct Chest {
    /// Name of the body among several; empty for a single one.
    pub of: String,
    /// Origin of its plates: `person`, `dummy50`, `dummy05f`, or `own`.
    pub preset: String,
    /// Index of the sternum's plate.
    pub breastbone: usize,
    /// Reference depth of deflections, m.
    pub depth_m: f64,
    /// Scale factor of the viscous criterion: 1.3 for dummies by SAE J1727, 1 for people.
    pub viscous_scale: f64,
    /// Further measuring points, as sums over plates: `upper_left`, `lower_right`.
    pub points: Vec<(String, Shares)>,
}
