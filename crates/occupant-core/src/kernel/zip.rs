//! Systems number by number: how several of the same structure become one of another scalar.
//!
//! With `f` = (lanes, number) ↦ lanes with that number in lane i, a system takes its place among others; with
//! (value, derivative) ↦ dual number, a system and its derivative become one. What is no number must agree: see [`Unlike`].

use std::fmt;

use crate::forces::contact::{ContactSystem, Pair, Part, Plane, Site};
use crate::kernel::System;

/// What keeps two systems from being computed side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unlike {
    /// Other spheres, or spheres on other segments.
    Spheres,
    /// Other pairs of spheres and surfaces, because of other surfaces, frames, seams or lists of spheres.
    Pairs,
    /// Surfaces of another kind, or with another number of corners.
    Outlines,
    /// Other belts, or belts round other spheres.
    Belts,
    /// Springs in other joints.
    Springs,
}

impl fmt::Display for Unlike {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Unlike::Spheres => "the contact spheres are others or on other segments",
            Unlike::Pairs => "the spheres meet other surfaces",
            Unlike::Outlines => "the surfaces have other outlines or numbers of corners",
            Unlike::Belts => "the belts are others or go round other spheres",
            Unlike::Springs => "other joints have springs",
        })
    }
}

impl std::error::Error for Unlike {}

impl<S: Copy> System<S> {
    /// f applied to every number and the one in the same place of `other`.
    ///
    /// # Errors
    /// Systems of unlike structure.
    pub fn zip<A: Copy, T>(&self, other: &System<A>, f: impl Fn(S, A) -> T) -> Result<System<T>, Unlike> {
        if self.joints.springs() != other.joints.springs() {
            return Err(Unlike::Springs);
        }
        let spheres = |belts: &mut dyn Iterator<Item = usize>| belts.collect::<Vec<_>>();
        if spheres(&mut self.belts.iter().map(|b| b.sphere)) != spheres(&mut other.belts.iter().map(|b| b.sphere)) {
            return Err(Unlike::Belts);
        }
        let belts = self.belts.iter().zip(&other.belts);
        Ok(System {
            skeleton: self.skeleton.zip(&other.skeleton, &f),
            joints: self.joints.zip(&other.joints, &f),
            contacts: self.contacts.zip(&other.contacts, &f)?,
            belts: belts.map(|(a, b)| a.zip(b, &f)).collect(),
        })
    }
}

impl<S: Copy> ContactSystem<S> {
    fn zip<A: Copy, T>(&self, other: &ContactSystem<A>, f: &impl Fn(S, A) -> T) -> Result<ContactSystem<T>, Unlike> {
        let on = |a: &Site<S>, b: &Site<A>| a.segment == b.segment;
        let same = self.sites.iter().zip(&other.sites).all(|(a, b)| on(a, b));
        if self.sites.len() != other.sites.len() || !same {
            return Err(Unlike::Spheres);
        }
        if self.groups != other.groups {
            return Err(Unlike::Pairs);
        }
        let sites = self.sites.iter().zip(&other.sites);
        let planes = self.planes.iter().zip(&other.planes);
        let pairs = self.pairs.iter().zip(&other.pairs);
        Ok(ContactSystem {
            sites: sites.map(|(a, b)| a.zip(b, f)).collect(),
            groups: self.groups.clone(),
            planes: planes.map(|(a, b)| a.zip(b, f)).collect(),
            pairs: pairs.map(|(a, b)| a.zip(b, f)).collect::<Result<_, _>>()?,
            edge_lever: f(self.edge_lever, other.edge_lever),
            reach_of_a_step: f(self.reach_of_a_step, other.reach_of_a_step),
        })
    }
}

impl<S: Copy> Site<S> {
    fn zip<A: Copy, T>(&self, other: &Site<A>, f: &impl Fn(S, A) -> T) -> Site<T> {
        Site { segment: self.segment, offset: self.offset.zip(&other.offset, f), radius: f(self.radius, other.radius) }
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
            return Err(Unlike::Pairs);
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
            return Err(Unlike::Pairs);
        }
        let outline = self.outline.zip(&other.outline, f);
        Ok(Part {
            surface: self.surface,
            outline: outline.ok_or(Unlike::Outlines)?,
            spring: self.spring.zip(&other.spring, f),
            friction: f(self.friction, other.friction),
            friction_speed_squared: f(self.friction_speed_squared, other.friction_speed_squared),
        })
    }
}
