//! Air bags: gas of one pressure in an envelope that unfolds, and the spheres of the body that displace part of it.
//!
//! The state contains the gas of each bag (`law`): its energy, the masses of its components, its sums. Inflators and
//! outlets (`inflator`) change it, and so does the volume that the body displaces (`envelope`). The forces on the body
//! follow from that volume, so that the work of the gas equals theirs. A bag's memory (`past`) changes only at accepted
//! steps.

mod check;
mod data;
mod envelope;
mod gas;
mod inflator;
mod law;
mod outline;
mod past;
mod results;
mod shape;
mod unfold;
mod union;

use crate::body::Body;
use crate::forces::element::{Element, Instant, Load, StoredEnergy, Unlike, WorkSum};
use crate::forces::list::STORES;
use crate::forces::sphere::{Site, Use};
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;
use crate::quantity::Quantity;
pub use data::*;
use envelope::Room;
pub use law::BagLaw;
use law::Now;
use occupant_units::unit::Unit;
pub use past::BagPast;
use placed_text::Problems;
pub use results::BagAction;

/// Largest number of spheres that a bag touches.
pub(crate) const MOST_SPHERES: usize = 20;
/// Largest number of vents of a bag.
pub(crate) const MOST_VENTS: usize = 4;

/// Index of the work absorbed by bags.
const WORK: usize = 5;

const OTHER_BAGS: Unlike = Unlike("the bags have other shapes, spheres, vents or rows of their tables");

/// The kind of force element: air bags.
#[derive(Clone, Copy, Debug)]
pub struct Bags;

impl Element for Bags {
    const OPTIONAL: bool = true;
    const STORED: &'static [StoredEnergy] = &[];
    const SUMS: &'static [WorkSum] = &[WorkSum {
        at: WORK,
        quantity: Quantity::number(Unit::Joule, |taken_j: &f64| *taken_j)
            .channel("bags", "work of the body on air bags")
            .field(18, "bags", "work of the body on air bags since the start; below 0 where they push it"),
    }];
    const NAMES: [&'static str; 2] = ["bag", "bags"];

    type Data<'a> = &'a [Bag];
    type Law<S> = Vec<BagLaw<S>>;
    type Past<S> = BagPast<S>;
    type Hints<S: Scalar> = Option<Box<Room<S>>>;
    type Action<S> = BagAction<S>;

    fn check(data: &[Bag], body: &Body, problems: &mut Problems) {
        data.iter().for_each(|bag| check::data(bag, body, problems));
    }

    fn new(data: &[Bag], _body: &Body) -> Vec<BagLaw<f64>> {
        data.iter().map(BagLaw::new).collect()
    }

    fn begin(law: &mut Vec<BagLaw<f64>>, data: &[Bag], body: &Body, at: &Instant<'_, f64>, problems: &mut Problems) {
        law.iter().zip(data).for_each(|(law, bag)| check::laid(law, bag, body, at, problems));
    }

    fn own(law: &mut Vec<BagLaw<f64>>, numbers: &mut Vec<f64>) {
        law.iter_mut().for_each(|bag| bag.own(numbers));
    }

    fn start(law: &Vec<BagLaw<f64>>, _at: &Instant<'_, f64>) -> Vec<BagPast<f64>> {
        law.iter().map(|_| BagPast::none()).collect()
    }

    fn hints<S: Scalar>(law: &Vec<BagLaw<S>>) -> Option<Box<Room<S>>> {
        (!law.is_empty()).then(|| Box::new(Room::new()))
    }

    fn count<S>(law: &Vec<BagLaw<S>>) -> usize {
        law.len()
    }

    fn zip<S: Copy, A: Copy, T>(
        one: &Vec<BagLaw<S>>,
        other: &Vec<BagLaw<A>>,
        f: &impl Fn(S, A) -> T,
    ) -> Result<Vec<BagLaw<T>>, Unlike> {
        let is_like = one.len() == other.len() && one.iter().zip(other).all(|(a, b)| a.is_like(b));
        let all = is_like.then(|| one.iter().zip(other).map(|(a, b)| a.zip(b, f)).collect());
        all.flatten().ok_or(OTHER_BAGS)
    }

    fn each<S, A>(one: &mut BagPast<S>, other: &mut BagPast<A>, f: &mut impl FnMut(&mut S, &mut A)) {
        one.each(other, f);
    }

    fn map<A: Copy, S>(past: &BagPast<A>, f: &mut impl FnMut(A) -> S) -> BagPast<S> {
        past.map(f)
    }

    fn can_switch(law: &Vec<BagLaw<f64>>) -> bool {
        !law.is_empty()
    }

    #[inline(always)]
    fn switches<S: Scalar>(past: &BagPast<S>) -> S {
        past.switches()
    }

    fn due<S: Scalar<Mask = bool>>(
        law: &Vec<BagLaw<S>>,
        number: usize,
        before: &BagPast<S>,
        now: &BagPast<S>,
        times_s: [S; 2],
    ) -> Option<S> {
        law[number].due(before, now, times_s)
    }

    #[inline(always)]
    fn apply<S: Scalar>(
        law: &Vec<BagLaw<S>>,
        at: &Instant<'_, S>,
        past: &mut [BagPast<S>],
        room: &mut Option<Box<Room<S>>>,
        load: &mut Load<S>,
        show: &mut impl FnMut(&BagAction<S>),
    ) {
        // all bags use the same room; nothing in it outlasts an evaluation
        let Some(room) = room else { return };
        for (bag, past) in law.iter().zip(past) {
            act(bag, at, past, room, load, show);
        }
    }

    /// It has no stored energy in a body's ledger.
    fn segment(_: &Vec<BagLaw<f64>>, _: &[Site<f64>], _: usize, _: &BagAction<f64>) -> usize {
        0
    }

    fn stored_j(_actions: &[BagAction<f64>], _stored_j: &mut [f64; STORES]) {}
}

/// Action of one bag.
#[inline(always)]
fn act<S: Scalar>(
    law: &BagLaw<S>,
    at: &Instant<'_, S>,
    past: &mut BagPast<S>,
    room: &mut Room<S>,
    load: &mut Load<S>,
    show: &mut impl FnMut(&BagAction<S>),
) {
    if !law.acts(at) {
        load.own[law.numbers()].fill(S::zero());
        return show(&BagAction::idle(law));
    }
    let mut now = law.now(at, past, room);
    if at.accepted && S::any(law.commit(&now, past)) {
        now = law.now(at, past, room);
    }
    let pushes = bear(law, at, &now, load);
    let flows = law.flow(at, &now, past, pushes.power, &mut load.own[law.numbers()]);
    if at.accepted {
        law.keep_balance(at, &now, past);
    }
    show(&BagAction::new(law, at, (&now, past), &pushes, &flows));
}

/// Forces of a bag on the body.
struct Pushes<S> {
    /// On its spheres, in their order, space axes, N.
    forces: [V3<S>; MOST_SPHERES],
    /// Work rate of the body on it, W.
    power: S,
}

/// Loads of the bag on the body, and their powers: −κ(p − p_a)∂V/∂x at the centre of a sphere, friction where it touches.
#[inline(always)]
fn bear<S: Scalar>(law: &BagLaw<S>, at: &Instant<'_, S>, now: &Now<'_, S>, load: &mut Load<S>) -> Pushes<S> {
    let (o, envelope) = (S::zero(), &now.envelope);
    let frame = &at.frames[law.envelope.frame];
    let mut pushes = Pushes { forces: [V3::zero(); MOST_SPHERES], power: o };
    let pressure = envelope.crowd * now.gas.gauge;
    for (i, (sphere, _)) in law.envelope.spheres.iter().enumerate() {
        let pressed = &envelope.pressed[i];
        if !S::any(pressed.touches.gt(o)) {
            continue;
        }
        let site = &at.spheres[*sphere];
        let (arm, centre, velocity) = site.place(at.k, Use::Bag);
        let normal = pressed.push * pressure + pressed.gradient * pressed.blow;
        let size = (pressed.gradient.norm_squared() + S::of(1e-24)).sqrt();
        let lever = pressed.gradient * -(site.radius / size);
        let (omega, carried) = (at.k.omega[site.segment], frame.velocity_at(centre));
        let place = frame.velocity_at(centre + lever);
        let relative = velocity + omega.cross(lever) - place;
        let slip = relative - pressed.gradient * (pressed.gradient.dot(relative) / (size * size));
        let speed = (slip.norm_squared() + law.friction_speed_squared).sqrt();
        let friction = slip * -(law.friction * pressure * pressed.area.max(o) * size / speed);
        let wrench = &mut load.wrench[site.segment];
        wrench.force += normal + friction;
        wrench.moment += arm.cross(normal) + (arm + lever).cross(friction);
        let taken = -(normal.dot(velocity - carried) + friction.dot(relative));
        pushes.power += taken;
        let power = load.power_at(site.segment);
        power.sums[WORK] += taken;
        power.vehicle += normal.dot(carried) + friction.dot(place);
        load.push([law.envelope.frame, site.segment], normal + friction, centre, lever.cross(friction), S::truth(true));
        load.press(site, Use::Bag, normal + friction, S::truth(true));
        pushes.forces[i] = normal + friction;
    }
    pushes
}

#[cfg(test)]
mod tests;
