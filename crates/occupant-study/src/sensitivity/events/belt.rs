//! Events of belts.

use super::{Happening, Notes};
use occupant_core::forces::belt::law::BeltAction;
use occupant_core::model::Model;
use occupant_core::motion::dual::Dual;

/// What happens to a belt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Belted {
    /// It begins to pull.
    Tightens,
    /// It goes slack.
    Slackens,
    /// It slips off the body.
    SlipsOff,
}

impl Belted {
    /// In words: `belt lap goes slack`.
    pub(super) fn words(self, model: &Model, belt: usize) -> String {
        let name = model.setup().belts.get(belt).map_or("?", |b| b.name.as_str());
        let verb = match self {
            Belted::Tightens => "tightens",
            Belted::Slackens => "goes slack",
            Belted::SlipsOff => "slips off the body",
        };
        format!("belt {name} {verb}")
    }
}

/// A belt at the last look.
#[derive(Clone, Copy, Default)]
struct BeltNow {
    known: bool,
    pulls: bool,
    on_body: bool,
    force_n: f64,
}

/// What was seen of belts.
pub(super) struct Lookout(Vec<BeltNow>);

impl Lookout {
    pub fn new(model: &Model) -> Self {
        Lookout(vec![BeltNow::default(); model.system().forces.belts.len()])
    }

    pub fn look<const N: usize>(&mut self, actions: &[BeltAction<Dual<N>>], notes: &mut Notes<N>) {
        for (i, action) in actions.iter().enumerate() {
            self.look_at(i, action, notes);
        }
    }

    fn look_at<const N: usize>(&mut self, belt: usize, action: &BeltAction<Dual<N>>, notes: &mut Notes<N>) {
        let before = self.0[belt];
        let now = BeltNow {
            known: true,
            pulls: action.loop_force.value > 0.0,
            on_body: action.wrap.value > 0.0,
            force_n: action.loop_force.value,
        };
        self.0[belt] = now;
        let what = match (before.pulls, now.pulls) {
            (false, true) => Belted::Tightens,
            (true, false) if now.on_body => Belted::Slackens,
            (true, false) => Belted::SlipsOff,
            _ => return,
        };
        if !before.known {
            return;
        }
        let jump_n = (what == Belted::SlipsOff).then_some(before.force_n);
        notes.note(Happening::Belt { belt, what }, jump_n);
    }
}
