//! Contact of spheres with bounded plane surfaces, with solids, and with each other.

mod ahead;
mod assembly;
mod check;
mod encounter;
pub(crate) mod face;
pub mod flat_face;
mod hints;
mod law;
pub mod material;
pub(crate) mod near;
mod pane;
mod results;
pub mod self_contact;
mod shared;
pub mod solid;
mod start;
pub mod surface;
mod system;
mod zip;

pub(crate) use assembly::FASTEST_M_S;
pub(crate) use hints::ContactHints;
pub(crate) use law::{ForceLaw, MaterialLaw};
pub use system::*;

use crate::body::Body;
use crate::forces::contact::flat_face::FlatFace;
use crate::forces::contact::material::Material;
use crate::forces::contact::solid::Solid;
use crate::forces::contact::surface::Surface;
use crate::forces::element::{Element, HeldBy, Instant, Load, StoredEnergy, Unlike, WorkSum, passes};
use crate::forces::list::STORES;
use crate::forces::marks::Marks;
use crate::forces::pace::Pace;
use crate::forces::sphere::Site;
use crate::motion::frame::MOST_FRAMES;
use crate::motion::scalar::Scalar;
use crate::quantity::energy;
use encounter::{Aside, Sphere};
use hints::{LEAST_WAY_M, Looking, Nearing};
use placed_text::Problems;
use self_contact::SelfContact;
use solid::{Member, lever};

/// Index of the work done on contacts along their normals and edge bands, stored and dissipated.
pub const PRESS: usize = 0;
/// Index of the work dissipated by friction.
pub const FRICTION: usize = 1;

/// Contact data of a setup.
#[derive(Clone, Copy, Debug)]
pub struct ContactData<'a> {
    /// Surfaces of vehicle and space.
    pub surfaces: &'a [Surface],
    /// Their planes, known once the surfaces are found sound.
    pub faces: &'a [FlatFace],
    /// Solids of vehicle and space.
    pub solids: &'a [Solid],
    /// Surfaces, and solids after all surfaces, that support the spine: spheres that move with plates do not move
    /// there.
    pub behind: &'a [usize],
    /// Contact of the body with itself, if any.
    pub self_contact: Option<&'a SelfContact>,
    /// Materials.
    pub materials: &'a [Material],
    /// Where the edge force acts.
    pub edge_force: EdgeForce,
    /// Longest step of the integrator, s.
    pub longest_step_s: f64,
}

/// The kind of force element: spheres that press and rub on faces.
#[derive(Clone, Copy, Debug)]
pub struct Contacts;

impl Element for Contacts {
    const STORED: &'static [StoredEnergy] = &[StoredEnergy {
        at: 1,
        quantity: energy(6, "contacts", "stored in contacts", "recoverable, in contacts"),
        held_by: HeldBy::sum(PRESS, 21, "start_contacts_j", "stored in contacts at the start of the run"),
    }];
    const SUMS: &'static [WorkSum] = &[
        WorkSum {
            at: PRESS,
            quantity: energy(8, "lost_contacts", "dissipated by contacts", "dissipated by contacts since the start"),
        },
        WorkSum {
            at: FRICTION,
            quantity: energy(9, "lost_friction", "dissipated by friction", "dissipated by friction since the start"),
        },
    ];
    const NAMES: [&'static str; 2] = ["pair", "pairs of spheres and surfaces"];

    type Data<'a> = ContactData<'a>;
    type Law<S> = ContactSystem<S>;
    type Past<S> = PairHistory<S>;
    type Hints<S: Scalar> = ContactHints<S>;
    type Action<S> = Touch<S>;

    fn check(data: ContactData<'_>, body: &Body, problems: &mut Problems) {
        check::check(&data, body, problems);
    }

    fn new(data: ContactData<'_>, body: &Body) -> ContactSystem<f64> {
        ContactSystem::new(body, &data)
    }

    fn begin(
        law: &mut ContactSystem<f64>,
        data: ContactData<'_>,
        body: &Body,
        at: &Instant<'_, f64>,
        problems: &mut Problems,
    ) {
        check::crowds(data.faces, problems);
        check::beneath(law, &data, body, at, problems);
        check::centres(law, &data, body, at, problems);
        check::overlaps(law, body, at, problems);
        check::touching(&Self::start(law, at), problems);
    }

    fn start(law: &ContactSystem<f64>, at: &Instant<'_, f64>) -> Vec<PairHistory<f64>> {
        let mut past = Vec::new();
        law.restart(at, &mut past, &mut ContactHints::new(law));
        past
    }

    fn restart(
        law: &ContactSystem<f64>,
        at: &Instant<'_, f64>,
        past: &mut Vec<PairHistory<f64>>,
        hints: &mut ContactHints<f64>,
    ) -> usize {
        law.restart(at, past, hints)
    }

    fn hints<S: Scalar>(law: &ContactSystem<S>) -> ContactHints<S> {
        ContactHints::new(law)
    }

    fn pace<S: Scalar>(hints: &ContactHints<S>) -> Pace<S> {
        hints.pace
    }

    fn count<S>(law: &ContactSystem<S>) -> usize {
        law.first_pane() + law.panes.len()
    }

    fn most_actions<S>(law: &ContactSystem<S>) -> usize {
        law.pairs.len() + law.solids.pairs.len() + law.own.pairs.len()
    }

    fn zip<S: Copy, A: Copy, T>(
        one: &ContactSystem<S>,
        other: &ContactSystem<A>,
        f: &impl Fn(S, A) -> T,
    ) -> Result<ContactSystem<T>, Unlike> {
        one.zip(other, f)
    }

    const MARKS: bool = true;

    fn each<S, A>(one: &mut PairHistory<S>, other: &mut PairHistory<A>, f: &mut impl FnMut(&mut S, &mut A)) {
        f(&mut one.phase, &mut other.phase);
        f(&mut one.greatest, &mut other.greatest);
    }

    fn map<A: Copy, S>(past: &PairHistory<A>, f: &mut impl FnMut(A) -> S) -> PairHistory<S> {
        PairHistory { phase: f(past.phase), greatest: f(past.greatest) }
    }

    fn failure(data: ContactData<'_>, law: &ContactSystem<f64>, past: &[PairHistory<f64>]) -> Option<String> {
        let names = data.surfaces.iter().map(|s| &s.name).chain(data.solids.iter().map(|s| &s.name));
        let names: Vec<&String> = names.collect();
        let faces = law.pairs.iter().map(|pair| pair.parts.iter().map(|part| (&part.law, part.surface)).collect());
        let unions = law.solids.pairs.iter().zip(law.solids.laws.iter());
        let solids = unions.map(|(union, own)| vec![(&own.law, union.members[0].surface)]);
        let overrun = |(past, laws): (&PairHistory<f64>, Vec<(&MaterialLaw<f64>, usize)>)| {
            laws.into_iter().find_map(|(law, surface)| {
                let ForceLaw::Deflection(law) = &law.force else { return None };
                law.overrun(&format!("a sphere in {}", names[surface]), past.greatest)
            })
        };
        past.iter().zip(faces.chain(solids)).find_map(overrun)
    }

    fn is_possible(law: &ContactSystem<f64>, number: usize, past: &PairHistory<f64>) -> bool {
        let is_face = past.phase.fract() == 0.0 && (FACE..FACE + MOST_FACES).contains(&past.phase);
        let may_be_face = (law.pairs.len() + law.solids.pairs.len()..law.own.first).contains(&number);
        ([OPEN, TOUCHING, PASSED].contains(&past.phase) || may_be_face && is_face)
            && past.greatest.is_finite()
            && past.greatest >= 0.0
            || law.is_pane(number, past)
    }

    fn can_switch(law: &ContactSystem<f64>) -> bool {
        !law.panes.is_empty()
    }

    #[inline(always)]
    fn switches<S: Scalar>(past: &PairHistory<S>) -> S {
        S::select(past.is_broken(), S::one(), S::zero())
    }

    #[inline(always)]
    fn any_switched<S: Scalar>(before: &[PairHistory<S>], now: &[PairHistory<S>]) -> S::Mask {
        pane::any_broke(before, now)
    }

    fn due<S: Scalar<Mask = bool>>(
        _law: &ContactSystem<S>,
        _number: usize,
        before: &PairHistory<S>,
        now: &PairHistory<S>,
        _times_s: [S; 2],
    ) -> Option<S> {
        Some(passes(S::one(), before.greatest, now.greatest))
    }

    fn confine(past: &mut PairHistory<f64>) {
        past.greatest = past.greatest.max(0.0);
    }

    #[inline(always)]
    fn apply<S: Scalar>(
        law: &ContactSystem<S>,
        at: &Instant<'_, S>,
        past: &mut [PairHistory<S>],
        hints: &mut ContactHints<S>,
        load: &mut Load<S>,
        show: &mut impl FnMut(&Touch<S>),
    ) {
        let mut reach = law.reach_of_a_step;
        if at.accepted {
            hints.pace = Pace::any();
            hints.changed.clear();
            reach = law.reach(at);
            hints.reach = reach;
            if !law.panes.is_empty() {
                law.strain_panes(at, past, hints);
            }
        }
        for (g, group) in law.groups.iter().enumerate() {
            let aside = law.aside(group, at, load);
            meet_all::<S, false>(law, (g, group), reach, at, past, hints, load, show);
            if let Some(aside) = aside {
                aside.react(at.k, load);
            }
        }
        for (g, group) in (law.groups.len()..).zip(&law.solids.groups) {
            let aside = law.aside(group, at, load);
            meet_all::<S, true>(law, (g, group), reach, at, past, hints, load, show);
            if let Some(aside) = aside {
                aside.react(at.k, load);
            }
        }
        if at.accepted {
            law.mark_always(&mut hints.changed);
        }
        law.own.apply(at, past, hints, [reach, law.longest_step()], load, show);
    }

    fn segment(_law: &ContactSystem<f64>, spheres: &[Site<f64>], _number: usize, touch: &Touch<f64>) -> usize {
        spheres[touch.sphere].segment
    }

    fn stored_j(actions: &[Touch<f64>], stored_j: &mut [f64; STORES]) {
        stored_j[Self::STORED[0].at] = actions.iter().map(|touch| touch.stored).sum();
    }
}

/// A sphere and all pairs of a group, number `g`: of faces, or of solids. Within a step it comes no farther than `reach`.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "two calls, both inlined")]
fn meet_all<S: Scalar, const SOLID: bool>(
    law: &ContactSystem<S>,
    (g, group): (usize, &Group),
    reach: S,
    at: &Instant<'_, S>,
    past: &mut [PairHistory<S>],
    hints: &mut ContactHints<S>,
    load: &mut Load<S>,
    show: &mut impl FnMut(&Touch<S>),
) {
    let near = hints.near_of(g, group);
    if !at.accepted && near.is_empty() {
        return;
    }
    let mut sphere = Sphere::new(law, group, at);
    // of most spheres nothing is watched; and no sphere comes farther than `reach`
    if at.accepted && hints.watched_of(g, group).is_empty() && !hints.must_look(g, sphere.centre_f, reach) {
        return hints.has_none_near(g);
    }
    let power = load.power_at(at.spheres[group.sphere].segment);
    let way = if at.accepted { Some(sphere.way(law.longest_step())) } else { None };
    let reach = if let Some(way) = &way { law.reach_of(way, reach) } else { reach };
    let looks = at.accepted && hints.must_look(g, sphere.centre_f, reach);
    // what is not watched stays apart until the next look, what is not near until the next commit
    let mut enough = S::zero();
    if at.accepted {
        enough = if looks { reach + S::of(LEAST_WAY_M) } else { reach };
    }
    let places = if looks {
        group.pairs.clone()
    } else if at.accepted {
        hints.watched_of(g, group)
    } else {
        near
    };
    let (mut near, mut look, all) = (Nearing::new(group), Looking::new(group), S::truth(true));
    // one loop, so that there is one copy of what a pair does
    for place in places {
        let (i, lanes) = if looks {
            (place, all)
        } else if at.accepted {
            (hints.watched[place] as usize, all)
        } else {
            (hints.near[place].pair as usize, hints.near[place].lanes)
        };
        if SOLID && let Some(off) = sphere.keeps_off(i, enough, past) {
            look.pass(off);
            continue;
        }
        let depth = sphere.look_at::<SOLID>(i, lanes, past, power, show);
        if at.accepted {
            law.mark::<SOLID>(i, &mut hints.changed);
        }
        if looks {
            look.at(i, depth, reach, &past[i], hints);
        }
        if at.accepted {
            near.at(i, depth, reach, &past[i], hints);
        }
    }
    if looks {
        look.end(g, sphere.centre_f, hints);
    }
    if let Some(way) = way {
        near.end(g, reach, hints);
        law.look_ahead::<SOLID>((g, group), &way, past, hints);
    }
    sphere.load(load);
}

impl<S: Scalar> ContactSystem<S> {
    /// Marks what is remembered of pair `i`: of solids with the faces of each.
    #[inline(always)]
    fn mark<const SOLID: bool>(&self, i: usize, changed: &mut Marks) {
        changed.set(i);
        if SOLID {
            for member in &self.solids.pairs[i - self.pairs.len()].members {
                changed.set(member.past);
            }
        }
    }

    /// Marks what every commit looks at: pairs of spheres of the body, and panes.
    #[inline(always)]
    fn mark_always(&self, changed: &mut Marks) {
        for i in self.own.first..self.first_pane() + self.panes.len() {
            changed.set(i);
        }
    }

    /// Puts aside what the sphere of a group has where a segment carries the faces, and so gets the opposite.
    #[inline(always)]
    fn aside(&self, group: &Group, at: &Instant<'_, S>, load: &mut Load<S>) -> Option<Aside<S>> {
        let carrier = group.frame.checked_sub(MOST_FRAMES)?;
        Some(Aside::new([at.spheres[group.sphere].segment, self.carriers[carrier]], load))
    }

    /// How far the point A of a touch is from the sphere's centre against N̂, m.
    #[inline(always)]
    pub(crate) fn lever(&self, touch: &Touch<S>, radius: S) -> S {
        match touch.pair {
            pair if pair < self.pairs.len() => radius,
            pair if pair < self.own.first => lever(touch.depth, radius),
            _ => self_contact::lever(touch.depth, radius),
        }
    }
}

impl<S: Scalar> ContactSystem<S> {
    /// What the part of a pair is: the index of a surface, of a solid behind all surfaces, or of a sphere behind all solids.
    pub fn surface(&self, pair: usize, part: usize) -> usize {
        match (self.own.get(pair), self.pairs.get(pair)) {
            (Some(own), _) => self.own.surface + own.spheres[1 - part],
            (None, Some(pair)) => pair.parts[part].surface,
            (None, None) => self.solids.pairs[pair - self.pairs.len()].members[part].surface,
        }
    }
}

impl ContactSystem<f64> {
    /// What each sphere feels of a touch: one, or two of the body that touch each other.
    pub(crate) fn sides(&self, touch: &Touch<f64>) -> impl Iterator<Item = Touch<f64>> + use<> {
        [*touch].into_iter().chain(self.other_side(touch))
    }

    /// What the other of two spheres of the body feels of their touch.
    pub(crate) fn other_side(&self, touch: &Touch<f64>) -> Option<Touch<f64>> {
        self.own.get(touch.pair).map(|pair| touch.mirrored(pair.spheres))
    }

    /// Whether a touch is one of two spheres.
    pub(crate) fn is_of_bodies(&self, touch: &Touch<f64>) -> bool {
        self.own.get(touch.pair).is_some()
    }

    /// The solid of a part of a pair and its position in what is remembered.
    pub(crate) fn member_of(&self, pair: usize, part: usize) -> Option<&Member> {
        let union = self.solids.pairs.get(pair.checked_sub(self.pairs.len())?)?;
        union.members.get(part)
    }

    /// How thick the solid of a touch is behind the face that `past` remembers, m; infinite for what is no solid.
    pub(crate) fn thickness_m(&self, touch: &Touch<f64>, past: &[PairHistory<f64>]) -> f64 {
        self.thickness_of(touch.pair, touch.part as usize, &|pair| past[pair].phase)
    }

    /// The same of the part of a pair, where `phase` tells what pairs remember.
    pub(crate) fn thickness_of(&self, pair: usize, part: usize, phase: &impl Fn(usize) -> f64) -> f64 {
        let of = |member: &Member| self.solids.shapes[member.solid].thickness_m(phase(member.past));
        self.member_of(pair, part).map_or(f64::INFINITY, of)
    }

    /// The sphere that meets the one that this part of a pair is of; none of a pair that is not of two spheres.
    pub(crate) fn other_sphere(&self, pair: usize, part: usize) -> Option<usize> {
        self.own.get(pair).map(|own| own.spheres[1 - part])
    }

    /// Coefficient of friction of a touch of what is no body.
    pub(crate) fn friction(&self, touch: &Touch<f64>) -> f64 {
        let faces = self.pairs.get(touch.pair).map(|pair| &pair.parts[touch.part as usize].law);
        faces.unwrap_or_else(|| &self.solids.laws[touch.pair - self.pairs.len()].law).friction
    }

    /// Law of a part of a pair.
    fn law(&self, pair: usize, part: usize) -> &MaterialLaw<f64> {
        match (self.own.get(pair), self.pairs.get(pair)) {
            (Some(own), _) => &own.law,
            (None, Some(faces)) => &faces.parts[part].law,
            (None, None) => &self.solids.laws[pair - self.pairs.len()].law,
        }
    }

    /// Depth of the last point of the force function that a touch follows, m; infinite of a spring, and of two skins as one. Of
    /// what breaks it is that of what is left.
    pub(crate) fn last_point_m(&self, touch: &Touch<f64>) -> f64 {
        let law = self.law(touch.pair, touch.part as usize);
        match &law.breaks {
            _ if self.own.get(touch.pair).is_some() => f64::INFINITY,
            Some(breaks) => breaks.left.as_ref().map_or(f64::INFINITY, ForceLaw::last_point_m),
            None => law.force.last_point_m(),
        }
    }

    /// Deformation at which the slope of a pair's spring changes, m; of a force function, which may bend often, none is.
    pub fn knee_m(&self, pair: usize, part: usize) -> f64 {
        match &self.law(pair, part).force {
            ForceLaw::Bilinear(spring) => spring.knee(),
            ForceLaw::Deflection(_) => f64::INFINITY,
        }
    }
}
