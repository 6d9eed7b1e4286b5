//! Contact laws number by number.

use super::law::BreakLaw;
use super::{ContactSystem, ForceLaw, MaterialLaw, Pair, Part, Plane};
use crate::forces::element::Unlike;

/// Other pairs of spheres and surfaces, because of other surfaces, frames, seams or lists of spheres.
pub(crate) const OTHER_PAIRS: Unlike = Unlike("the spheres meet other surfaces");
/// Surfaces of another kind, or with another number of corners.
pub(crate) const OTHER_OUTLINES: Unlike = Unlike("the surfaces have other outlines or numbers of corners");
/// Materials with other parts of their laws, or with another number of points.
const OTHER_LAWS: Unlike = Unlike("the materials have other force laws or numbers of points");

impl<S: Copy> ContactSystem<S> {
    pub(super) fn zip<A: Copy, T>(
        &self,
        other: &ContactSystem<A>,
        f: &impl Fn(S, A) -> T,
    ) -> Result<ContactSystem<T>, Unlike> {
        if self.groups != other.groups || self.panes != other.panes {
            return Err(OTHER_PAIRS);
        }
        let planes = self.planes.iter().zip(&other.planes);
        Ok(ContactSystem {
            groups: self.groups.clone(),
            planes: planes.map(|(a, b)| a.zip(b, f)).collect(),
            pairs: self.pairs.zip(&other.pairs, OTHER_PAIRS, |a, b| a.zip(b, f))?,
            edge_lever: f(self.edge_lever, other.edge_lever),
            solids: self.solids.zip(&other.solids, f)?,
            own: self.own.zip(&other.own, f)?,
            carriers: self.carriers.clone(),
            panes: self.panes.clone(),
            reach_of_a_step: f(self.reach_of_a_step, other.reach_of_a_step),
        })
    }
}

impl<S: Copy> Plane<S> {
    fn zip<A: Copy, T>(&self, other: &Plane<A>, f: &impl Fn(S, A) -> T) -> Plane<T> {
        Plane { normal: self.normal.zip(&other.normal, f), reach: f(self.reach, other.reach) }
    }
}

impl<S: Copy> Pair<S> {
    fn zip<A: Copy, T>(&self, other: &Pair<A>, f: &impl Fn(S, A) -> T) -> Result<Pair<T>, Unlike> {
        if self.parts.len() != other.parts.len() {
            return Err(OTHER_PAIRS);
        }
        let parts = self.parts.iter().zip(&other.parts);
        Ok(Pair {
            u: self.u.zip(&other.u, f),
            v: self.v.zip(&other.v, f),
            normal: self.normal.zip(&other.normal, f),
            parts: parts.map(|(a, b)| a.zip(b, f)).collect::<Result<_, _>>()?,
            retain: f(self.retain, other.retain),
        })
    }
}

impl<S: Copy> Part<S> {
    fn zip<A: Copy, T>(&self, other: &Part<A>, f: &impl Fn(S, A) -> T) -> Result<Part<T>, Unlike> {
        if self.surface != other.surface {
            return Err(OTHER_PAIRS);
        }
        let outline = self.outline.zip(&other.outline, f);
        Ok(Part { surface: self.surface, outline: outline.ok_or(OTHER_OUTLINES)?, law: self.law.zip(&other.law, f)? })
    }
}

impl<S: Copy> MaterialLaw<S> {
    pub(super) fn zip<A: Copy, T>(
        &self,
        other: &MaterialLaw<A>,
        f: &impl Fn(S, A) -> T,
    ) -> Result<MaterialLaw<T>, Unlike> {
        let factors = self.friction_factors.iter().zip(&other.friction_factors);
        if factors.clone().any(|(a, b)| a.len() != b.len()) {
            return Err(OTHER_LAWS);
        }
        let [over_slip, over_force] = &self.friction_factors;
        let breaks = match (&self.breaks, &other.breaks) {
            (Some(a), Some(b)) => Some(Box::new(a.zip(b, f)?)),
            (None, None) => None,
            _ => return Err(OTHER_LAWS),
        };
        Ok(MaterialLaw {
            force: self.force.zip(&other.force, f)?,
            breaks,
            friction: f(self.friction, other.friction),
            friction_speed_squared: f(self.friction_speed_squared, other.friction_speed_squared),
            friction_factors: [
                over_slip.zip(&other.friction_factors[0], f),
                over_force.zip(&other.friction_factors[1], f),
            ],
        })
    }
}

impl<S: Copy> ForceLaw<S> {
    fn zip<A: Copy, T>(&self, other: &ForceLaw<A>, f: &impl Fn(S, A) -> T) -> Result<ForceLaw<T>, Unlike> {
        match (self, other) {
            (ForceLaw::Bilinear(a), ForceLaw::Bilinear(b)) => Ok(ForceLaw::Bilinear(a.zip(b, f))),
            (ForceLaw::Deflection(a), ForceLaw::Deflection(b)) => {
                Ok(ForceLaw::Deflection(Box::new(a.zip(b, f).ok_or(OTHER_LAWS)?)))
            }
            _ => Err(OTHER_LAWS),
        }
    }
}

impl<S: Copy> BreakLaw<S> {
    fn zip<A: Copy, T>(&self, other: &BreakLaw<A>, f: &impl Fn(S, A) -> T) -> Result<BreakLaw<T>, Unlike> {
        let left = match (&self.left, &other.left) {
            (Some(a), Some(b)) => Some(a.zip(b, f)?),
            (None, None) => None,
            _ => return Err(OTHER_LAWS),
        };
        if self.pane != other.pane {
            return Err(OTHER_PAIRS);
        }
        Ok(BreakLaw { pane: self.pane, per: [0, 1].map(|i| f(self.per[i], other.per[i])), left })
    }
}
