//! What a run watches in evaluations: which sphere has touched which surface.

use crate::forces::Observer;
use crate::forces::contact::Touch;
use crate::model::Model;
use crate::motion::vector::V3;
use crate::results::checkpoint::StepPeaks;
use crate::results::outcome::FirstTouch;
use crate::run::corner::Touching;

/// A sphere against a part of a face, as first touches tell it.
#[derive(Clone, Copy)]
pub(super) struct Meeting {
    pub sphere: usize,
    pub pair: usize,
    /// Which of the pair's parts.
    pub part: usize,
    pub closing_m_s: f64,
    /// Relative to the face.
    pub velocity_m_s: V3<f64>,
    pub normal_force_n: f64,
}

impl From<&Touch<f64>> for Meeting {
    #[inline(always)]
    fn from(touch: &Touch<f64>) -> Self {
        let (sphere, pair, part) = (touch.sphere, touch.pair, touch.part as usize);
        let (closing_m_s, velocity_m_s) = (touch.closing, touch.velocity);
        Meeting { sphere, pair, part, closing_m_s, velocity_m_s, normal_force_n: touch.normal_force }
    }
}

/// Remembers which sphere has touched which surface, and the greatest values.
pub(super) struct Seen {
    surfaces: usize,
    /// By sphere and surface.
    known: Vec<bool>,
    pub touches: Vec<FirstTouch>,
    pub peaks: StepPeaks,
}

impl Seen {
    pub(super) fn new(model: &Model) -> Self {
        let surfaces = model.setup().surface_names().count();
        let spheres = model.body().spheres.len();
        let combinations = spheres * surfaces;
        let (known, touches) = (vec![false; combinations], Vec::with_capacity(combinations));
        Seen { surfaces, known, touches, peaks: StepPeaks::none(spheres) }
    }

    /// Takes over what an earlier part of the run has seen; all of it is of the model.
    pub(super) fn know(&mut self, touches: &[FirstTouch], peaks: &StepPeaks) {
        self.peaks.readings_m_s2 = peaks.readings_m_s2;
        for (greatest, earlier_n) in self.peaks.contacts_n.iter_mut().zip(&peaks.contacts_n) {
            *greatest = *earlier_n;
        }
        for touch in touches {
            self.known[touch.sphere * self.surfaces + touch.surface] = true;
        }
        self.touches.extend_from_slice(touches);
    }

    /// Notes a touch of `model`, the one that this was made for.
    #[inline]
    pub(super) fn note(&mut self, model: &Model, time_s: f64, meeting: Meeting) {
        let surface = model.system().forces.contacts.surface(meeting.pair, meeting.part);
        let sphere = meeting.sphere;
        self.peaks.touch(sphere, meeting.normal_force_n);
        let known = &mut self.known[sphere * self.surfaces + surface];
        if !*known {
            *known = true;
            let speed_m_s = meeting.velocity_m_s.norm_squared().sqrt();
            self.touches.push(FirstTouch { sphere, surface, time_s, speed_m_s, closing_m_s: meeting.closing_m_s });
        }
    }
}

/// Collects what touches: the one observer of steps, as each kind is a whole kernel in the build.
pub(super) struct Met<'a>(pub &'a mut Vec<Touching>);

impl Observer<f64> for Met<'_> {
    #[inline(always)]
    fn contacts(&mut self, touch: &Touch<f64>) {
        self.0.push(touch.into());
    }
}
