//! Initial memory of contacts for a body at rest in its position.
//!
//! Settling evaluates a body in hundreds of postures, each slightly different from the last. A sphere checks all pairs
//! of a group once and stores those that are near. Until it has moved as far as its distance from touching any other,
//! the others are skipped.

use super::hints::{ContactHints, LEAST_WAY_M, Looking};
use super::pane::WHOLE;
use super::{ContactSystem, Contacts, OPEN, PASSED, PairHistory, TOUCHING, weight};
use crate::forces::element::{Element, Instant};
use crate::motion::vector::V3;

/// Apart, with nothing to remember.
const APART: PairHistory<f64> = PairHistory { phase: OPEN, greatest: 0.0 };

impl ContactSystem<f64> {
    /// What [`Element::start`] gives, of all pairs that touch or are near; what others remember moves nothing. Hints are those
    /// of the last restart, or leave nothing out. Returns how many pairs and groups an evaluation looks at.
    pub(super) fn restart(
        &self,
        at: &Instant<'_, f64>,
        past: &mut Vec<PairHistory<f64>>,
        hints: &mut ContactHints<f64>,
    ) -> usize {
        past.resize(Contacts::count(self), APART);
        let mut looks = 0;
        for (g, group) in self.groups.iter().chain(&self.solids.groups).enumerate() {
            let (centre, radius) = (at.centre_in(group.sphere, group.by, group.frame), at.spheres[group.sphere].radius);
            if hints.must_look(g, centre, 0.0) {
                let mut look = Looking::new(group);
                for i in group.pairs.clone() {
                    let off = self.begin_pair(i, radius, centre, past);
                    look.watch(i, off < LEAST_WAY_M, off, hints);
                }
                look.end(g, centre, hints);
            } else {
                for place in hints.watched_of(g, group) {
                    self.begin_pair(hints.watched[place] as usize, radius, centre, past);
                }
            }
            looks += 1 + hints.look_at_watched(g, group);
        }
        past.truncate(self.own.first);
        past.extend(self.own.start(at));
        past.extend(self.panes.iter().map(|_| PairHistory { phase: WHOLE, greatest: 0.0 }));
        looks + self.own.pairs.len()
    }

    /// Begins pair `i`, of faces or of solids, with a centre in the frame; returns how far the sphere must move at least to
    /// exert a force, m: 0 or less where it does.
    fn begin_pair(&self, i: usize, radius: f64, centre: V3<f64>, past: &mut [PairHistory<f64>]) -> f64 {
        let Some(j) = i.checked_sub(self.pairs.len()) else {
            return self.begin_face(i, radius, centre, &mut past[i]);
        };
        self.solids.pairs[j].members.iter().for_each(|member| past[member.past] = APART);
        let nearest = self.solids.nearest(j, centre, radius, past, true);
        past[i] = APART;
        self.solids.laws[j].commit(nearest.depth, &mut past[i]);
        -nearest.depth
    }

    /// Passed where the centre is beyond the plane or beside the face.
    fn begin_face(&self, i: usize, radius: f64, centre: V3<f64>, past: &mut PairHistory<f64>) -> f64 {
        let depth = self.planes[i].depth(centre);
        let (offset, _) = self.pairs[i].nearest(centre);
        let beside = weight(offset.distance, radius) <= 0.0;
        *past = match depth > 0.0 {
            true if depth > radius || beside => PairHistory { phase: PASSED, greatest: 0.0 },
            true => PairHistory { phase: TOUCHING, greatest: depth },
            false => APART,
        };
        (-depth).max(depth - radius).max(offset.distance - radius)
    }

    /// Pair states where an earlier run ended, which tells of faces whether they have passed but not how deep they were: the
    /// listed pairs of sphere and surface have passed, all others that overlap touch.
    pub(crate) fn continued(&self, at: &Instant<'_, f64>, passed: &[(usize, usize)]) -> Vec<PairHistory<f64>> {
        let mut past = Contacts::start(self, at);
        for group in &self.groups {
            let centre = at.centre_in(group.sphere, group.by, group.frame);
            for i in group.pairs.clone() {
                let depth = self.planes[i].depth(centre);
                let is_passed = self.pairs[i].parts.iter().any(|part| passed.contains(&(group.sphere, part.surface)));
                past[i] = match depth > 0.0 {
                    true if is_passed => PairHistory { phase: PASSED, greatest: 0.0 },
                    true => PairHistory { phase: TOUCHING, greatest: depth },
                    false => APART,
                };
            }
        }
        past
    }
}
