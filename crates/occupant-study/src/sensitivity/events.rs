//! Where a motion is not differentiable: what begins, ends or changes its law along a run.
//!
//! The derivative of a run is that of the branches taken. Where a force only changes its slope (a contact begins, a spring
//! unloads, a belt tightens) the derivative of the motion stays right and its own derivative jumps: the straight line
//! holds for small changes only. Where a force jumps (the edge band of a bounded face begins or ends, a sphere rolls
//! from one material onto another, a belt slips off the body) the derivative lacks the jump times the shift of its
//! instant.

use super::trouble::Trouble;
use occupant_core::body::joint::{Joint, JointLaw};
use occupant_core::forces::belt::law::BeltAction;
use occupant_core::forces::contact::Touch;
use occupant_core::forces::{Actions, History};
use occupant_core::model::Model;
use occupant_core::motion::dual::Dual;
use occupant_core::motion::kinematics::Kinematics;
use occupant_core::motion::layout::{BALL_JOINTS, HINGE_JOINTS};
use occupant_core::motion::state::State;
use occupant_core::motion::vector::V3;

/// Events beyond this number are counted and not kept.
const MOST: usize = 4096;
/// Number of the look before the first; a pair that was never seen has 0.
const NONE_YET: u64 = 1;
/// What happens to a sphere on a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touching {
    /// It touches.
    Begins,
    /// It leaves the plane.
    Ends,
    /// Its centre goes beyond the edge: the edge force sets in.
    ReachesEdge,
    /// Its centre comes back from beyond the edge: the edge force ends.
    LeavesEdge,
    /// It has gone round the edge.
    Passes,
    /// It comes onto this surface of the same plane.
    Crosses,
    /// The spring goes onto its second slope.
    Stiffens,
    /// The spring begins to unload.
    Unloads,
    /// The spring is loaded beyond what it has seen.
    Reloads,
    /// It slips the other way.
    SlipsBack,
}

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

/// What happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Happening {
    /// To a sphere on a surface.
    Contact {
        /// Index of the sphere.
        sphere: usize,
        /// Index of the surface.
        surface: usize,
        /// What.
        what: Touching,
    },
    /// To a belt.
    Belt {
        /// Its index.
        belt: usize,
        /// What.
        what: Belted,
    },
    /// A joint enters the range of a stop, or leaves it.
    Stop {
        /// The joint.
        joint: Joint,
        /// Whether it enters.
        enters: bool,
    },
}

/// How a force changes at an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// Its slope changes.
    Kink,
    /// It jumps.
    Jump,
}

/// An event of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Time of the accepted step at which it was seen, s.
    pub time_s: f64,
    /// What.
    pub happening: Happening,
    /// How the force changes.
    pub change: Change,
    /// By how much a force jumps, N; 0 for a kink.
    pub jump_n: f64,
    /// How its instant shifts with each parameter, s per unit; not known for most events.
    pub shift: Vec<f64>,
}

impl Happening {
    /// In words, with the names of `model`, for which it was seen: `head begins to touch wheel`.
    pub fn words(&self, model: &Model) -> String {
        let setup = model.setup();
        match *self {
            Happening::Contact { sphere, surface, what } => {
                let name = |i: usize| setup.body.spheres.get(i).map_or("?", |s| s.name.as_str());
                let face = |i: usize| setup.surfaces.get(i).map_or("?", |s| s.name.as_str());
                let verb = match what {
                    Touching::Begins => "begins to touch",
                    Touching::Ends => "leaves",
                    Touching::ReachesEdge => "reaches the edge of",
                    Touching::LeavesEdge => "comes back from the edge of",
                    Touching::Passes => "has gone round the edge of",
                    Touching::Crosses => "crosses over to",
                    Touching::Stiffens => "reaches the second slope of",
                    Touching::Unloads => "begins to unload",
                    Touching::Reloads => "loads again",
                    Touching::SlipsBack => "slips the other way on",
                };
                format!("{} {verb} {}", name(sphere), face(surface))
            }
            Happening::Belt { belt, what } => {
                let name = setup.belts.get(belt).map_or("?", |b| b.name.as_str());
                let verb = match what {
                    Belted::Tightens => "tightens",
                    Belted::Slackens => "goes slack",
                    Belted::SlipsOff => "slips off the body",
                };
                format!("belt {name} {verb}")
            }
            Happening::Stop { joint, enters } => {
                let verb = if enters { "enters" } else { "leaves" };
                format!("{} {verb} the range of its stop", model.body().tree[joint].name)
            }
        }
    }
}

/// What one evaluation of a run in duals shows.
pub(super) struct Scene<const N: usize> {
    time_s: f64,
    state: State<f64>,
    /// What force elements do.
    pub actions: Actions<Dual<N>>,
}

impl<const N: usize> Scene<N> {
    /// Room for all that `model` can show.
    pub fn new(model: &Model) -> Self {
        let actions = Actions::with_room(&model.system().forces);
        Scene { time_s: f64::NAN, state: model.start().state, actions }
    }

    /// Another one.
    pub fn begin(&mut self, time_s: f64, state: &State<Dual<N>>) {
        self.time_s = time_s;
        self.state = state.zip(state, |x, _| x.value);
        self.actions.clear();
    }
}

/// A pair at the last look.
#[derive(Clone, Copy, Default)]
struct PairNow {
    /// Number of the look at which it touched.
    seen: u64,
    sphere: usize,
    surface: usize,
    on_edge: bool,
    stiff: bool,
    unloading: bool,
    slip: Option<V3<f64>>,
    edge_n: f64,
}

/// A belt at the last look.
#[derive(Clone, Copy, Default)]
struct BeltNow {
    known: bool,
    pulls: bool,
    on_body: bool,
    force_n: f64,
}

/// Looks at a run and notes its events.
pub(super) struct Lookout<const N: usize> {
    looks: u64,
    pairs: Vec<PairNow>,
    touching: Vec<usize>,
    belts: Vec<BeltNow>,
    stops: [Option<bool>; BALL_JOINTS.len() + HINGE_JOINTS.len()],
    list: Vec<(Event0, [f64; N])>,
    /// How many were not kept.
    pub dropped: u64,
}

/// An event without its shifts.
type Event0 = (f64, Happening, Change, f64);

impl<const N: usize> Lookout<N> {
    /// Nothing seen yet of `model`.
    pub fn new(model: &Model) -> Self {
        let system = model.system();
        let pairs = system.forces.contacts.pairs().len();
        Lookout {
            looks: NONE_YET,
            pairs: vec![PairNow::default(); pairs],
            touching: Vec::with_capacity(pairs),
            belts: vec![BeltNow::default(); system.forces.belts.len()],
            stops: [None; BALL_JOINTS.len() + HINGE_JOINTS.len()],
            list: Vec::with_capacity(MOST),
            dropped: 0,
        }
    }

    fn note(&mut self, time_s: f64, happening: Happening, jump_n: Option<f64>, shift: [f64; N]) {
        let (change, jump_n) = match jump_n {
            // an edge beyond which an unloaded spring was, say
            Some(jump_n) if jump_n > 0.0 => (Change::Jump, jump_n),
            _ => (Change::Kink, 0.0),
        };
        match self.list.len() < MOST {
            true => self.list.push(((time_s, happening, change, jump_n), shift)),
            false => self.dropped += 1,
        }
    }

    /// Compares what `scene` shows with what was seen before.
    pub fn look(&mut self, model: &Model, scene: &Scene<N>, history: &History<Dual<N>>) {
        self.looks += 1;
        for touch in &scene.actions.contacts {
            self.look_at_pair(model, scene.time_s, touch, history);
        }
        self.look_for_ends(scene.time_s, history);
        for (i, belt) in scene.actions.belts.iter().enumerate() {
            self.look_at_belt(i, scene.time_s, belt);
        }
        self.look_at_stops(model, scene);
    }

    fn look_at_pair(&mut self, model: &Model, t: f64, touch: &Touch<Dual<N>>, history: &History<Dual<N>>) {
        let setup = model.setup();
        let part = &model.system().forces.contacts.pairs()[touch.pair].parts[touch.part.value as usize];
        let (sphere, surface) = (touch.sphere, part.surface);
        let material = &setup.materials[setup.surfaces[surface].material];
        let before = self.pairs[touch.pair];
        let begins = before.seen + 1 != self.looks;
        let slip = V3 { x: touch.slip.x.value, y: touch.slip.y.value, z: touch.slip.z.value };
        let edge_n = length(&touch.edge);
        let depth = touch.depth.value;
        let now = PairNow {
            seen: self.looks,
            sphere,
            surface,
            on_edge: touch.weight.value < 1.0,
            stiff: depth > material.spring.break_m,
            unloading: depth < history.memory.contacts[touch.pair].greatest.value,
            slip: Some(slip),
            edge_n,
        };
        self.pairs[touch.pair] = now;
        let contact = |what: Touching| Happening::Contact { sphere, surface, what };
        let none = [0.0; N];
        if begins {
            self.touching.push(touch.pair);
            if self.looks > NONE_YET + 1 {
                // the instant of Δ = 0 shifts by −Δ′/Δ̇
                let closing = touch.closing.value;
                let shift = match closing > 0.0 {
                    true => touch.depth.slopes.map(|s| -s / closing),
                    false => [f64::NAN; N],
                };
                self.note(t, contact(Touching::Begins), None, shift);
            }
            return;
        }
        if now.on_edge != before.on_edge {
            let (what, jump_n) = match now.on_edge {
                true => (Touching::ReachesEdge, edge_n),
                false => (Touching::LeavesEdge, before.edge_n),
            };
            self.note(t, contact(what), Some(jump_n), none);
        }
        if now.surface != before.surface {
            let same = setup.surfaces[before.surface].material == setup.surfaces[surface].material;
            let jump_n = (!same).then_some(touch.normal_force.value);
            self.note(t, contact(Touching::Crosses), jump_n, none);
        }
        if now.stiff && !before.stiff && !now.unloading {
            self.note(t, contact(Touching::Stiffens), None, none);
        }
        if now.unloading != before.unloading {
            let what = match now.unloading {
                true => Touching::Unloads,
                false => Touching::Reloads,
            };
            self.note(t, contact(what), None, none);
        }
        if before.slip.is_some_and(|s| s.dot(slip) < 0.0) && touch.normal_force.value > 0.0 {
            self.note(t, contact(Touching::SlipsBack), None, none);
        }
    }

    fn look_for_ends(&mut self, t: f64, history: &History<Dual<N>>) {
        let mut at = 0;
        while at < self.touching.len() {
            let i = self.touching[at];
            let pair = self.pairs[i];
            if pair.seen == self.looks {
                at += 1;
                continue;
            }
            self.touching.swap_remove(at);
            let passed = history.memory.contacts[i].phase.value > occupant_core::forces::contact::TOUCHING;
            let (what, jump_n) = match passed {
                true => (Touching::Passes, Some(pair.edge_n)),
                false => (Touching::Ends, None),
            };
            let happening = Happening::Contact { sphere: pair.sphere, surface: pair.surface, what };
            self.note(t, happening, jump_n, [0.0; N]);
        }
    }

    fn look_at_belt(&mut self, belt: usize, t: f64, action: &BeltAction<Dual<N>>) {
        let before = self.belts[belt];
        let now = BeltNow {
            known: true,
            pulls: action.loop_force.value > 0.0,
            on_body: action.wrap.value > 0.0,
            force_n: action.loop_force.value,
        };
        self.belts[belt] = now;
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
        self.note(t, Happening::Belt { belt, what }, jump_n, [0.0; N]);
    }

    fn look_at_stops(&mut self, model: &Model, scene: &Scene<N>) {
        let system = model.system();
        let k = Kinematics::new(&system.skeleton, &scene.state);
        for (i, joint) in BALL_JOINTS.iter().chain(HINGE_JOINTS).copied().enumerate() {
            let angle_rad = match i.checked_sub(BALL_JOINTS.len()) {
                None => system.forces.joints.beta(i, &k),
                Some(hinge) => scene.state.hinge[hinge],
            };
            let inside = in_stop(&model.setup().joints[joint], angle_rad);
            let before = self.stops[i].replace(inside);
            if before.is_some_and(|b| b != inside) {
                let enters = inside;
                let happening = Happening::Stop { joint, enters };
                self.note(scene.time_s, happening, None, [0.0; N]);
            }
        }
    }

    /// The events, with the shifts of the first `count` directions.
    pub fn events(&self, count: usize) -> Vec<Event> {
        let event = |((time_s, happening, change, jump_n), shift): &(Event0, [f64; N])| Event {
            time_s: *time_s,
            happening: *happening,
            change: *change,
            jump_n: *jump_n,
            shift: shift[..count].to_vec(),
        };
        self.list.iter().map(event).collect()
    }
}

/// Adds the shifts that another pass over the same run has found.
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

fn length<const N: usize>(v: &V3<Dual<N>>) -> f64 {
    (v.x.value * v.x.value + v.y.value * v.y.value + v.z.value * v.z.value).sqrt()
}

/// Whether a joint is in the range of one of its stops.
fn in_stop(law: &JointLaw, angle_rad: f64) -> bool {
    match law {
        JointLaw::Ball(ball) => ball.stop.is_some_and(|s| angle_rad > s.begin_rad),
        JointLaw::Hinge(hinge) => {
            hinge.lower_stop.is_some_and(|s| angle_rad < s.begin_rad)
                || hinge.upper_stop.is_some_and(|s| angle_rad > s.begin_rad)
        }
    }
}
