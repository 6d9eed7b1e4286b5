//! Deformable parts of the trunk: point masses on slides, and what rides on them.

use nalgebra::{Point3, Vector3};

use super::Segment;

/// A part of a segment that yields along a line: its mass is a point that slides.
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    /// Unique name, such as `sternum`.
    pub name: String,
    /// The segment, of whose mass it is a part.
    pub segment: Segment,
    /// Where its mass is before it yields, from the segment's lower end, segment axes, m.
    pub place_from_lower_end_m: Point3<f64>,
    /// The way inwards along which it slides, segment axes; any length.
    pub inward: Vector3<f64>,
    /// m.
    pub mass_kg: f64,
    /// Depth of the trunk behind it, m: deflections of more than 0.45 of it are told of. None if none is known.
    pub depth_m: Option<f64>,
}

/// Plates (indices) with the shares of their deflections that something goes along with, each from 0 to 1.
pub type Shares = Vec<(usize, f64)>;

/// How a sphere rides on plates of its segment, by what touches it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ride {
    /// Under surfaces, solids and other spheres.
    pub contact: Shares,
    /// Under belts.
    pub belt: Shares,
    /// Under air bags.
    pub bag: Shares,
}

impl Ride {
    /// The plates that it rides on in any way, each once.
    pub(crate) fn plates(&self) -> Vec<usize> {
        let all = [&self.contact, &self.belt, &self.bag];
        let mut plates: Vec<usize> = all.into_iter().flatten().map(|(plate, _)| *plate).collect();
        plates.sort_unstable();
        plates.dedup();
        plates
    }

    /// The same where the plates stand behind `first` others.
    #[must_use]
    pub(crate) fn behind(&self, first: usize) -> Self {
        let moved = |shares: &Shares| shares.iter().map(|(plate, share)| (first + plate, *share)).collect();
        Ride { contact: moved(&self.contact), belt: moved(&self.belt), bag: moved(&self.bag) }
    }
}

impl Chest {
    /// The same among several bodies, of one with this name whose plates begin at `first`.
    pub(crate) fn of_member(&self, name: &str, first: usize) -> Self {
        let moved = |shares: &Shares| shares.iter().map(|(plate, share)| (first + plate, *share)).collect();
        let points = self.points.iter().map(|(point, shares)| (point.clone(), moved(shares))).collect();
        Chest { of: name.to_owned(), breastbone: first + self.breastbone, points, ..self.clone() }
    }
}

/// A chest that is measured: whose, how deep, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Chest {
    /// Name of the body among several; empty of one alone.
    pub of: String,
    /// The set of plates that it was made from: `person`, `dummy50`, `dummy05f`, or `own`.
    pub preset: String,
    /// The plate of the sternum (index).
    pub breastbone: usize,
    /// Depth that deflections are compared with, m.
    pub depth_m: f64,
    /// Scale factor of the viscous criterion: 1.3 of dummies by SAE J1727, 1 of people.
    pub viscous_scale: f64,
    /// Places whose deflections are told besides, as sums over plates: `upper_left`, `lower_right`.
    pub points: Vec<(String, Shares)>,
}
