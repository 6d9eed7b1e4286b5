//! Spheres whose centres go through the axis of a bar or a rim, detected at accepted steps: the normal reverses while
//! the centre is inside.

use super::corner::Touching;
use crate::model::Model;
use crate::motion::vector::V3;

/// Contacts of spheres with bars and rims.
#[derive(Clone)]
pub(super) struct Bars {
    /// By index in the memory of pairs; empty without bars.
    last: Vec<Option<Touched>>,
    /// Number of steps so far.
    steps: u64,
}

/// The last contact of a sphere with a bar or a rim.
#[derive(Clone, Copy)]
struct Touched {
    /// Normal; for a centre inside, that at its entry.
    normal: V3<f64>,
    /// Whether the sphere's centre was inside.
    inside: bool,
    step: u64,
}

impl Bars {
    /// Empty record for a run of `model`.
    pub(super) fn new(model: &Model) -> Self {
        let shapes = &model.system().forces.contacts.solids.shapes;
        let count =
            if shapes.iter().any(|shape| shape.is_bar()) { model.start().history.memory.contacts.len() } else { 0 };
        Bars { last: vec![None; count], steps: 0 }
    }

    /// Takes the contacts of an accepted step; `tell` receives sphere, penetration (m) and surface of each passage.
    pub(super) fn see(&mut self, model: &Model, met: &[Touching], mut tell: impl FnMut(usize, f64, usize)) {
        self.steps += 1;
        if self.last.is_empty() {
            return;
        }
        let contacts = &model.system().forces.contacts;
        for meeting in met.iter().map(|one| one.meeting) {
            let member = contacts.member_of(meeting.pair, meeting.part);
            let Some(member) = member.filter(|member| contacts.solids.shapes[member.solid].is_bar()) else { continue };
            let inside = meeting.depth_m > model.body().spheres[meeting.sphere].radius_m;
            let last = self.last[member.past].filter(|last| last.step + 1 == self.steps);
            let is_through = |last: Touched| last.normal.dot(meeting.normal) < 0.0 && (last.inside || inside);
            let stays = last.filter(|last| last.inside && inside && !is_through(*last));
            let normal = stays.map_or(meeting.normal, |last| last.normal);
            self.last[member.past] = Some(Touched { normal, inside, step: self.steps });
            if last.is_some_and(is_through) {
                tell(meeting.sphere, meeting.depth_m, member.surface);
            }
        }
    }
}
