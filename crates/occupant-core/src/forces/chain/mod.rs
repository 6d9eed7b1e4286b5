//! Belts over several nodes: anchors, rings, guides, spheres, with retractors, limiters and pretensioners.
//!
//! Massless webbing runs from node to node (`path`). A strap ends where webbing is fixed or has friction; each has one
//! tension, and one number at the first node determines all of them (`march`). The device at that node has phases
//! (`device`). A belt's memory changes only at accepted steps (`past`): within a step the forces are a function of
//! position and time.

mod check;
mod cue;
mod data;
mod device;
mod feed;
mod law;
mod march;
mod mark;
mod past;
mod path;
mod reel;
mod results;
mod shoulder;
mod site;
mod tension;
pub mod wing;

use crate::body::Body;
use crate::forces::belt::STRETCH;
use crate::forces::element::{Element, HeldBy, Instant, Load, StoredEnergy, Unlike, WorkSum};
use crate::forces::list::STORES;
use crate::forces::rate::Rate;
use crate::forces::sphere::{Riding, Site as Sphere, Use};
use crate::motion::frame::Moving;
use crate::motion::mobility::Mobility;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;
use crate::quantity::Quantity;
pub(crate) use check::plain_laps;
pub use data::*;
pub use law::ChainLaw;
use law::{Committed, Now, Room};
use occupant_units::unit::Unit;
pub use past::ChainPast;
use placed_text::Problems;
pub use results::StrapAction;
pub use shoulder::OnShoulder;

/// Largest number of nodes of a belt.
pub(crate) const MOST_NODES: usize = 12;
/// Largest number of spheres of a strap.
const MOST_ARCS: usize = 3;

/// Index of the energy stored in belts, and of the work of pretensioners.
const STORED_AT: usize = 2;
const DRIVEN_AT: usize = 5;

const OTHER_CHAINS: Unlike = Unlike("the belts have other nodes, devices or numbers of points of their curves");

/// The kind of force element: belts over several nodes. An action is that of a strap.
#[derive(Clone, Copy, Debug)]
pub struct Chains;

impl Element for Chains {
    const OPTIONAL: bool = true;
    const STORED: &'static [StoredEnergy] = &[StoredEnergy {
        at: DRIVEN_AT,
        quantity: Quantity::number(Unit::Joule, |driven_j: &f64| -*driven_j)
            .channel("pretensioners", "work of pretensioners")
            .field(17, "pretensioners", "work of pretensioners on belts since the start"),
        held_by: HeldBy::sum(STRETCH, 52, "start_pretensioners_j", "work of pretensioners at the start of the run"),
    }];
    const SUMS: &'static [WorkSum] = &[];
    const NAMES: [&'static str; 2] = ["strap", "straps"];

    type Data<'a> = &'a [Chain];
    type Law<S> = Vec<ChainLaw<S>>;
    type Past<S> = ChainPast<S>;
    type Hints<S: Scalar> = Option<Box<Room<S>>>;
    type Action<S> = StrapAction<S>;

    fn check(data: &[Chain], body: &Body, problems: &mut Problems) {
        check::data(data, body, problems);
    }

    fn new(data: &[Chain], body: &Body) -> Vec<ChainLaw<f64>> {
        let belt = |chain: &Chain| data.iter().position(|other| other.belt == chain.belt).unwrap_or(0);
        data.iter().map(|chain| ChainLaw::new(chain, belt(chain), body)).collect()
    }

    /// All parts of a belt start with the same strain: a given length is that of the whole.
    fn start(law: &Vec<ChainLaw<f64>>, at: &Instant<'_, f64>) -> Vec<ChainPast<f64>> {
        let lies: Vec<_> = law.iter().map(|chain| chain.lie(at)).collect();
        let whole = |chain: &ChainLaw<f64>| -> f64 {
            let parts = law.iter().zip(&lies).filter(|(other, _)| other.belt == chain.belt);
            parts.map(|(_, (length, _))| length).sum()
        };
        let start = |(chain, (_, past)): (&ChainLaw<f64>, &(f64, ChainPast<f64>))| chain.start(at, whole(chain), past);
        law.iter().zip(&lies).map(start).collect()
    }

    fn begin(
        law: &mut Vec<ChainLaw<f64>>,
        data: &[Chain],
        body: &Body,
        at: &Instant<'_, f64>,
        problems: &mut Problems,
    ) {
        let pasts = Self::start(law, at);
        check::laid(law, data, &pasts, body, at, problems);
    }

    fn hints<S: Scalar>(law: &Vec<ChainLaw<S>>) -> Option<Box<Room<S>>> {
        (!law.is_empty()).then(|| Box::new(Room::new()))
    }

    fn count<S>(law: &Vec<ChainLaw<S>>) -> usize {
        law.len()
    }

    fn most_actions<S>(law: &Vec<ChainLaw<S>>) -> usize {
        law.iter().map(|chain| chain.straps.starts.len()).sum()
    }

    fn zip<S: Copy, A: Copy, T>(
        one: &Vec<ChainLaw<S>>,
        other: &Vec<ChainLaw<A>>,
        f: &impl Fn(S, A) -> T,
    ) -> Result<Vec<ChainLaw<T>>, Unlike> {
        let is_like = one.len() == other.len() && one.iter().zip(other).all(|(a, b)| a.is_like(b));
        is_like.then(|| one.iter().zip(other).map(|(a, b)| a.zip(b, f)).collect()).ok_or(OTHER_CHAINS)
    }

    fn each<S, A>(one: &mut ChainPast<S>, other: &mut ChainPast<A>, f: &mut impl FnMut(&mut S, &mut A)) {
        one.each(other, f);
    }

    fn map<A: Copy, S>(past: &ChainPast<A>, f: &mut impl FnMut(A) -> S) -> ChainPast<S> {
        past.map(f)
    }

    fn failure(data: &[Chain], law: &Vec<ChainLaw<f64>>, past: &[ChainPast<f64>]) -> Option<String> {
        let spent = |((chain, law), past): ((&Chain, &ChainLaw<f64>), &ChainPast<f64>)| law.overrun(&chain.belt, past);
        if let Some(why) = data.iter().zip(law).zip(past).find_map(spent) {
            return Some(why);
        }
        let (chain, past) = data.iter().zip(past).find(|(_, past)| past.device.unsolved > 0.0)?;
        let left_m = past.device.unsolved;
        Some(format!("no tensions were found of the belt {}: {left_m:.1e} m of webbing are left over", chain.belt))
    }

    fn can_switch(law: &Vec<ChainLaw<f64>>) -> bool {
        law.iter().any(ChainLaw::can_switch)
    }

    #[inline(always)]
    fn switches<S: Scalar>(past: &ChainPast<S>) -> S {
        past.switches()
    }

    fn due<S: Scalar<Mask = bool>>(
        law: &Vec<ChainLaw<S>>,
        number: usize,
        before: &ChainPast<S>,
        now: &ChainPast<S>,
        _times_s: [S; 2],
    ) -> Option<S> {
        law[number].due(before, now)
    }

    #[inline(always)]
    fn apply<S: Scalar>(
        law: &Vec<ChainLaw<S>>,
        at: &Instant<'_, S>,
        past: &mut [ChainPast<S>],
        room: &mut Option<Box<Room<S>>>,
        load: &mut Load<S>,
        show: &mut impl FnMut(&StrapAction<S>),
    ) {
        // all chains use the same room; nothing in it outlasts an evaluation
        let Some(room) = room else { return };
        for (chain, past) in law.iter().zip(past) {
            act(chain, at, past, room, load, show);
        }
    }

    /// Stiffest loading of a strap, and its effective mass in the present position.
    fn rates(
        data: &[Chain],
        body: &Body,
        at: &Instant<'_, f64>,
        _actions: &[StrapAction<f64>],
        mobility: &Mobility<'_>,
    ) -> Vec<Rate> {
        let law = Self::new(data, body);
        let pasts = Self::start(&law, at);
        let rates = |((chain, law), past): ((&Chain, &ChainLaw<f64>), &ChainPast<f64>)| {
            law.gives(at, past, mobility)
                .into_iter()
                .zip(&chain.straps)
                .map(|([give, length], name)| {
                    let stiffness = chain.webbing.steepest() / length;
                    Rate::of_spring(name.clone(), "webbing".to_owned(), 1.0 / give, stiffness)
                })
                .collect::<Vec<_>>()
        };
        let all = data.iter().zip(&law).zip(&pasts).flat_map(rates);
        all.filter(|rate| rate.effective.is_finite()).collect()
    }

    /// A strap belongs to the body that its belt touches.
    fn segment(law: &Vec<ChainLaw<f64>>, spheres: &[Sphere<f64>], number: usize, _action: &StrapAction<f64>) -> usize {
        let mut straps = law.iter().flat_map(|chain| chain.straps.starts.iter().map(move |_| chain));
        let nodes = straps.nth(number).into_iter().flat_map(|chain| &chain.nodes);
        nodes.filter_map(|node| node.segment(spheres)).next().unwrap_or(0)
    }

    fn stored_j(actions: &[StrapAction<f64>], stored_j: &mut [f64; STORES]) {
        stored_j[STORED_AT] += actions.iter().map(|strap| strap.stored).sum::<f64>();
        stored_j[DRIVEN_AT] = -actions.iter().map(|strap| strap.driven).sum::<f64>();
    }
}

/// Action of one chain. A commit at the time of the last one changes nothing, so that a resumed run has the same bits.
#[inline(always)]
fn act<S: Scalar>(
    chain: &ChainLaw<S>,
    at: &Instant<'_, S>,
    past: &mut ChainPast<S>,
    room: &mut Room<S>,
    load: &mut Load<S>,
    show: &mut impl FnMut(&StrapAction<S>),
) {
    let (mut step, mut is_known): (Option<Committed<S>>, _) = (None, false);
    // a loop, so that there is one copy of what is looked at twice
    let now = loop {
        let now = chain.now(at, past, room, is_known);
        match &mut step {
            None if at.accepted && S::any(at.frames.time.gt(past.device.time)) => {
                let found = chain.commit(at, &now, past);
                is_known = !S::any(found.moved);
                step = Some(found);
            }
            Some(found) if S::any(found.refits) => {
                chain.refit(found, now.lies, past);
                is_known = true;
            }
            _ => break now,
        }
    };
    if let Some(found) = step.filter(|found| S::any(found.lost)) {
        chain.settle(&found, &now, past);
    }
    let unsolved = now.taut.solved.unsolved;
    if S::any(unsolved.gt(S::zero())) {
        past.device.unsolved = unsolved;
    }
    bear(chain, at, &now, past, load);
    for strap in 0..chain.straps.starts.len() {
        show(&StrapAction::new(chain, at, (&now, past), strap));
    }
}

/// Loads of the webbing on the body, and their powers.
#[inline(always)]
fn bear<S: Scalar>(
    chain: &ChainLaw<S>,
    at: &Instant<'_, S>,
    now: &Now<'_, S>,
    past: &ChainPast<S>,
    load: &mut Load<S>,
) {
    let (frame, mut strap) = (&at.frames[chain.frame], 0);
    for (k, force) in chain.forces(now).into_iter().enumerate().take(chain.nodes.len()) {
        let node = &chain.nodes[k];
        strap += usize::from(node.rubs);
        let centre = now.lies.places[k].centre;
        let Some(segment) = node.segment(at.spheres) else {
            if let Some(own) = node.frame {
                hold(chain, at, own, (centre, force), load);
            }
            continue;
        };
        let mut force = force;
        if let Some(next) = node.next() {
            let (is_over, none) = (past.nodes[k].is_handed_over(), V3::zero());
            let handed = V3::select(is_over, force, none);
            pull(at, frame, (next.segment, next.ride.as_ref()), (centre, handed), load);
            if let Some(riding) = &next.ride {
                load.ride(riding, handed, S::truth(true));
            }
            force = V3::select(is_over, none, force);
        }
        pull(at, frame, (segment, node.riding(at.spheres)), (centre, force), load);
        let wrench = &mut load.wrench[segment];
        let couple = node.is_rough().then(|| chain.couple(now, k, strap));
        if let Some(couple) = couple {
            wrench.moment += couple;
        }
        if let Some(site) = node.sphere(at.spheres) {
            load.press(site, Use::Belt, force, S::truth(true));
        } else if let Some(riding) = node.riding(at.spheres) {
            load.ride(riding, force, S::truth(true));
        }
        let power = load.power_at(segment);
        if let Some(couple) = couple {
            power.sums[STRETCH] -= couple.dot(at.k.omega[segment] - frame.omega);
            power.vehicle += couple.dot(frame.omega);
        }
    }
}

/// Applies a force at a point of a frame other than the belt's: motion relative to the belt's frame does work on the webbing,
/// and a yielding frame receives the force.
#[inline(always)]
fn hold<S: Scalar>(
    chain: &ChainLaw<S>,
    at: &Instant<'_, S>,
    own: usize,
    (point, force): (V3<S>, V3<S>),
    load: &mut Load<S>,
) {
    let bearer = chain.nodes.iter().find_map(|node| node.segment(at.spheres)).unwrap_or(0);
    let velocity = at.frames[own].velocity_at(point) - at.frames[chain.frame].velocity_at(point);
    let given = force.dot(velocity);
    let power = load.power_at(bearer);
    power.sums[STRETCH] -= given;
    // the work on a yielding frame is in the ledger of its column or hinge
    power.vehicle -= given;
    load.push([own, bearer], -force, point, V3::zero(), S::truth(true));
}

/// Applies a force at a point of a segment, which may move with plates, with its power; space axes.
#[inline(always)]
fn pull<S: Scalar>(
    at: &Instant<'_, S>,
    frame: &Moving<S>,
    (segment, riding): (usize, Option<&Riding<S>>),
    (point, force): (V3<S>, V3<S>),
    load: &mut Load<S>,
) {
    let arm = point - at.k.joint[segment];
    let mut velocity = at.k.joint_velocity[segment] + at.k.omega[segment].cross(arm);
    if let Some(riding) = riding {
        velocity += riding.carried(at.k)[1];
    }
    let carried = frame.velocity_at(point);
    let wrench = &mut load.wrench[segment];
    wrench.force += force;
    wrench.moment += arm.cross(force);
    let power = load.power_at(segment);
    power.sums[STRETCH] -= force.dot(velocity - carried);
    power.vehicle += force.dot(carried);
}

#[cfg(test)]
mod tests;
