//! Points where a motion is not differentiable: forces that begin, end or change their law.
//!
//! The derivative of a run is that of the branches taken. Where a force only changes its slope (a contact begins, a spring
//! unloads, a belt tightens) the derivative of the motion stays right and its own derivative jumps: the straight line
//! holds for small changes only. Where a force jumps (the edge band of a bounded face begins or ends, a sphere rolls
//! from one material onto another, a belt slips off the body) the derivative lacks the jump times the shift of its
//! instant.
//!
//! A kind of force element reports its events itself ([`occupant_core::forces::shown::Reported::event`]); those of
//! contacts and joints, which need more than two looks at one element, have files of their own.

mod contact;
mod joint;

pub use contact::Touching;

use crate::sensitivity::trouble::Trouble;
use occupant_core::body::Joint;
use occupant_core::forces::{Actions, History, Listed, Visitor, visit_kinds};
use occupant_core::model::Model;
use occupant_core::motion::dual::Dual;
use occupant_core::motion::state::State;

/// Largest number of events kept; further ones are counted.
const MOST: usize = 4096;

/// Kind of event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Happening {
    /// Of a sphere and a surface.
    Contact {
        /// Index of the sphere.
        sphere: usize,
        /// Index of the surface.
        surface: usize,
        /// The contact event.
        what: Touching,
    },
    /// Of another force element.
    Element {
        /// Name of the element's kind.
        of: &'static str,
        /// Its index.
        element: usize,
        /// The event in words: `goes slack`.
        verb: &'static str,
    },
    /// A joint enters the range of a stop, or leaves it.
    Stop {
        /// The joint.
        joint: Joint,
        /// Whether it enters.
        enters: bool,
    },
}

/// Change of a force at an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// The slope of the force changes.
    Kink,
    /// The force jumps.
    Jump,
}

/// An event of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Time of the accepted step at which it was seen, s.
    pub time_s: f64,
    /// The event.
    pub happening: Happening,
    /// Change of the force.
    pub change: Change,
    /// Jump of the force, N; 0 for a kink.
    pub jump_n: f64,
    /// Shift of the event time by parameter, s per unit; unknown for most events.
    pub shift: Vec<f64>,
}

impl Happening {
    /// Description with the names of `model`: `head begins to touch wheel`.
    pub fn words(&self, model: &Model) -> String {
        match *self {
            Happening::Contact { sphere, surface, what } => what.words(model, sphere, surface),
            Happening::Element { of, element, verb } => {
                let name = model.named(of).get(element).map_or("?", |one| one.name);
                format!("{of} {name} {verb}")
            }
            Happening::Stop { joint, enters } => joint::words(model, joint, enters),
        }
    }
}

/// Result of one evaluation of a run in dual numbers.
pub(super) struct Scene<const N: usize> {
    time_s: f64,
    state: State<f64>,
    /// Actions of the force elements.
    pub actions: Actions<Dual<N>>,
}

impl<const N: usize> Scene<N> {
    /// Buffers for `model`.
    pub fn new(model: &Model) -> Self {
        let actions = Actions::with_room(&model.system().forces);
        Scene { time_s: f64::NAN, state: model.start().state, actions }
    }

    /// Starts another evaluation.
    pub fn begin(&mut self, time_s: f64, state: &State<Dual<N>>) {
        self.time_s = time_s;
        self.state = state.zip(state, |x, _| x.value);
        self.actions.clear();
    }
}

/// Detects the events of a run.
pub(super) struct Lookout<const N: usize> {
    contacts: contact::Lookout,
    /// Actions of the force elements at the last look.
    before: Actions<Dual<N>>,
    joints: joint::Lookout,
    notes: Notes<N>,
}

/// The events of a run.
struct Notes<const N: usize> {
    time_s: f64,
    list: Vec<Event>,
    /// Number of events not kept.
    dropped: u64,
}

impl<const N: usize> Notes<N> {
    /// Notes an event at which a force may jump.
    fn note(&mut self, happening: Happening, jump_n: Option<f64>) {
        self.note_shifting(happening, jump_n, [0.0; N]);
    }

    /// Notes an event with a known shift of its time.
    fn note_shifting(&mut self, happening: Happening, jump_n: Option<f64>, shift: [f64; N]) {
        let (change, jump_n) = match jump_n {
            // an edge beyond which an unloaded spring was, say
            Some(jump_n) if jump_n > 0.0 => (Change::Jump, jump_n),
            _ => (Change::Kink, 0.0),
        };
        if self.list.len() < MOST {
            self.list.push(Event { time_s: self.time_s, happening, change, jump_n, shift: shift.to_vec() });
        } else {
            self.dropped += 1;
        }
    }
}

/// Two consecutive looks.
struct Between<'a, const N: usize> {
    before: &'a Actions<Dual<N>>,
    now: &'a Actions<Dual<N>>,
    notes: &'a mut Notes<N>,
}

impl<const N: usize> Visitor for Between<'_, N> {
    fn visit<E: Listed>(&mut self) {
        let both = E::actions(self.before).iter().zip(E::actions(self.now));
        for (element, (before, now)) in both.enumerate() {
            if let Some((verb, jump_n)) = E::event(before, now) {
                let happening = Happening::Element { of: E::NAMES[0], element, verb };
                self.notes.note(happening, jump_n.map(|jump| jump.value));
            }
        }
    }
}

impl<const N: usize> Lookout<N> {
    /// An empty lookout for `model`.
    pub fn new(model: &Model) -> Self {
        Lookout {
            contacts: contact::Lookout::new(model),
            before: Actions::with_room(&model.system().forces),
            joints: joint::Lookout::default(),
            notes: Notes { time_s: f64::NAN, list: Vec::with_capacity(MOST), dropped: 0 },
        }
    }

    /// Compares `scene` with the last look.
    pub fn look(&mut self, model: &Model, scene: &mut Scene<N>, history: &History<Dual<N>>) {
        let notes = &mut self.notes;
        notes.time_s = scene.time_s;
        self.contacts.look(model, &scene.actions.contacts, &history.memory.contacts, notes);
        visit_kinds(&mut Between { before: &self.before, now: &scene.actions, notes });
        self.joints.look(model, &scene.state, notes);
        std::mem::swap(&mut self.before, &mut scene.actions);
    }

    /// The events with the shifts of the first `count` directions, and the number not kept.
    pub fn events(self, count: usize) -> (Vec<Event>, u64) {
        let Notes { mut list, dropped, .. } = self.notes;
        list.iter_mut().for_each(|event| event.shift.truncate(count));
        (list, dropped)
    }
}

/// Adds the shifts found by another pass over the same run.
pub(super) fn join(events: &mut [Event], more: &[Event]) -> Result<(), Trouble> {
    let same = events.len() == more.len() && events.iter().zip(more).all(|(a, b)| a.happening == b.happening);
    if !same {
        return Err(Trouble::Output("two passes over one run saw other events".to_owned()));
    }
    for (event, more) in events.iter_mut().zip(more) {
        event.shift.extend_from_slice(&more.shift);
    }
    Ok(())
}
