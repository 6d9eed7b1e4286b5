//! What a run watches in evaluations: which sphere has touched which surface.

use crate::forces::Observer;
use crate::forces::contact::Touch;
use crate::model::Model;
use crate::motion::vector::V3;
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
}

impl From<&Touch<f64>> for Meeting {
    #[inline(always)]
    fn from(touch: &Touch<f64>) -> Self {
        let (sphere, pair, part) = (touch.sphere, touch.pair, touch.part as usize);
        Meeting { sphere, pair, part, closing_m_s: touch.closing, velocity_m_s: touch.velocity }
    }
}

/// Remembers which sphere has touched which surface.
pub(super) struct Seen {
    surfaces: usize,
    /// By sphere and surface.
    known: Vec<bool>,
    pub touches: Vec<FirstTouch>,
}

impl Seen {
    pub(super) fn new(model: &Model) -> Self {
        let surfaces = model.setup().surface_names().count();
        let combinations = model.body().spheres.len() * surfaces;
        Seen { surfaces, known: vec![false; combinations], touches: Vec::with_capacity(combinations) }
    }

    /// Takes over what an earlier part of the run has seen; all of it is of the model.
    pub(super) fn know(&mut self, touches: &[FirstTouch]) {
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
