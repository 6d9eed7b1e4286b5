//! What a run watches in evaluations: the details of an output, and which sphere has touched which surface.

use crate::kernel::Observer;
use crate::kernel::belts::BeltAction;
use crate::kernel::contact::Touch;
use crate::model::Model;
use crate::outcome::FirstTouch;

/// Collects the details of one evaluation.
pub(crate) struct Touches {
    pub pairs: Vec<Touch<f64>>,
    pub belts: Vec<BeltAction<f64>>,
}

impl Touches {
    pub fn clear(&mut self) {
        self.pairs.clear();
        self.belts.clear();
    }
}

impl Observer<f64> for Touches {
    fn touch(&mut self, touch: &Touch<f64>) {
        self.pairs.push(*touch);
    }
    fn belt(&mut self, _index: usize, action: &BeltAction<f64>) {
        self.belts.push(*action);
    }
}

/// Remembers which sphere has touched which surface.
pub(crate) struct Seen<'a> {
    model: &'a Model,
    /// By sphere and surface.
    known: Vec<bool>,
    pub touches: Vec<FirstTouch>,
}

impl<'a> Seen<'a> {
    pub fn new(model: &'a Model) -> Self {
        let combinations = model.body().spheres.len() * model.faces().len();
        Seen {
            model,
            known: vec![false; combinations],
            touches: Vec::with_capacity(combinations),
        }
    }

    /// Takes over what an earlier part of the run has seen; all of it is of the model.
    pub fn know(&mut self, touches: &[FirstTouch]) {
        for touch in touches {
            self.known[touch.sphere * self.model.faces().len() + touch.surface] = true;
        }
        self.touches.extend_from_slice(touches);
    }

    pub fn note(&mut self, time_s: f64, touch: &Touch<f64>) {
        let pair = &self.model.system().contacts.pairs()[touch.pair];
        let surface = pair.parts[touch.part as usize].surface;
        let known = &mut self.known[touch.sphere * self.model.faces().len() + surface];
        if !*known {
            *known = true;
            let closing_m_s = touch.closing;
            self.touches.push(FirstTouch {
                sphere: touch.sphere,
                surface,
                time_s,
                closing_m_s,
            });
        }
    }
}

/// Watches the first evaluation of a step.
pub(crate) struct SeenAt<'s, 'a> {
    pub seen: &'s mut Seen<'a>,
    pub time_s: f64,
}

impl Observer<f64> for SeenAt<'_, '_> {
    #[inline(always)]
    fn touch(&mut self, touch: &Touch<f64>) {
        self.seen.note(self.time_s, touch);
    }
}
