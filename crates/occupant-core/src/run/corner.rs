//! Corners within a step: where a contact begins or ends, and where it changes from loading to unloading.
//!
//! Error control notices that a step contains a corner, but not where: it shortens steps until one is short enough to
//! pass over it. A trial gives more information: the contacts at its start and at its end, with their depth and speed.
//! Therefore the kink is located, the step ends just behind it, and the next one begins on the other side.

use super::Step;
use crate::forces::History;
use crate::forces::contact::Touch;
use crate::model::Model;
use crate::motion::integrate::bogacki_shampine::Tolerance;
use crate::run::observers::Meeting;

/// Fraction of the tolerance below which the change of velocity by a kink is ignored (measured in `docs/accuracy.md`).
const LEAST_SHARE: f64 = 0.03;
/// Fraction of a step within which kinks count as at its ends.
const MARGIN: f64 = 0.02;
/// Distance of the step's end behind a kink, as a fraction of the trial's length.
const BEHIND: f64 = 0.01;
/// Error in velocity of a step across the beginning of a force, as a fraction of the force's impulse.
const BEGINNING: f64 = 0.1;

/// A contact pair.
#[derive(Clone, Copy)]
pub(super) struct Touching {
    pub meeting: Meeting,
}

impl From<&Touch<f64>> for Touching {
    #[inline(always)]
    fn from(touch: &Touch<f64>) -> Self {
        Touching { meeting: touch.into() }
    }
}

/// A trial step with the contacts at its ends.
pub(super) struct Crossing<'a> {
    pub model: &'a Model,
    pub step: Step,
    pub at_start: &'a [Touching],
    pub at_end: &'a [Touching],
    /// History at the start.
    pub history: &'a History<f64>,
    pub tolerance: &'a Tolerance,
}

impl Crossing<'_> {
    /// End of the step just behind its first relevant kink, s. All evaluations see pairs in the same order.
    pub(super) fn end_behind_corner(&self) -> Option<f64> {
        debug_assert!(self.at_end.is_sorted_by_key(|touching| touching.meeting.pair));
        let (mut first, mut started, mut ended) = (f64::INFINITY, self.at_start, self.at_end);
        loop {
            let [before, after] = [started, ended].map(|list| list.first().map_or(usize::MAX, |of| of.meeting.pair));
            let kink = match (started, ended) {
                ([start, ..], [end, ..]) if before == after => self.turn(start, end),
                ([start, ..], _) if before < after => self.ending(start),
                (_, [end, ..]) => self.beginning(end),
                (_, []) => break,
            };
            first = kink.map_or(first, |share| first.min(share));
            started = &started[usize::from(before <= after)..];
            ended = &ended[usize::from(after <= before)..];
        }
        let end_s = self.step.start_s + (first + BEHIND) * self.step.length_s();
        first.is_finite().then_some(end_s)
    }

    /// A contact that begins, as seen from the end.
    fn beginning(&self, end: &Touching) -> Option<f64> {
        let h = self.step.length_s();
        let since_s = (end.meeting.depth_m / end.meeting.closing_m_s.max(1e-3)).min(h);
        self.if_it_matters(1.0 - since_s / h, BEGINNING * end.meeting.normal_force_n * since_s, end)
    }

    /// A contact that ends, as seen from the start.
    fn ending(&self, start: &Touching) -> Option<f64> {
        let h = self.step.length_s();
        let left_s = (start.meeting.depth_m / (-start.meeting.closing_m_s).max(1e-3)).min(h);
        self.if_it_matters(left_s / h, BEGINNING * start.meeting.normal_force_n * left_s, start)
    }

    /// A contact with its largest penetration within the step: beyond it, the step still follows the loading curve,
    /// since Δ_m is updated at the ends of steps.
    fn turn(&self, start: &Touching, end: &Touching) -> Option<f64> {
        let h = self.step.length_s();
        let (v0, v1) = (start.meeting.closing_m_s, end.meeting.closing_m_s);
        if !(v0 > 0.0 && v1 < 0.0) {
            return None;
        }
        // Δ(s) of the cubic through depths and closing speeds, s = 0…1
        let (d0, way) = (start.meeting.depth_m, end.meeting.depth_m - start.meeting.depth_m);
        let (square, cube) = (3.0 * way - h * (2.0 * v0 + v1), h * (v0 + v1) - 2.0 * way);
        let speed = |s: f64| h * v0 + s * (2.0 * square + 3.0 * cube * s);
        let (mut rising, mut falling) = (0.0, 1.0);
        for _ in 0..30 {
            let middle = 0.5 * (rising + falling);
            if speed(middle) > 0.0 { rising = middle } else { falling = middle }
        }
        let s = falling;
        let deepest_m = d0 + s * (h * v0 + s * (square + cube * s));
        let greatest_m = self.history.memory.contacts[end.meeting.pair].greatest;
        let missed_m = deepest_m - end.meeting.depth_m.max(greatest_m);
        let stiffness = end.meeting.normal_force_n / end.meeting.depth_m.max(1e-6);
        let impulse = stiffness * missed_m * (1.0 - s) * h / 3.0;
        self.if_it_matters(s, impulse, end)
    }

    /// The kink at `share` of the step, if an error of `impulse` (N·s) there is relevant.
    fn if_it_matters(&self, share: f64, impulse: f64, touching: &Touching) -> Option<f64> {
        let system = self.model.system();
        let segment = system.spheres[touching.meeting.sphere].segment;
        let error_m_s = impulse / system.skeleton.links[segment].mass;
        let speed_m_s = touching.meeting.closing_m_s.abs();
        let tolerance = self.tolerance.absolute_m_s + self.tolerance.relative * speed_m_s;
        let inside = share > MARGIN && share < 1.0 - MARGIN;
        (inside && error_m_s > LEAST_SHARE * tolerance).then_some(share)
    }
}
