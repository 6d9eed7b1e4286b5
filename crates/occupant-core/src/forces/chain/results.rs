//! Results of a chain, by strap.

use std::array::from_fn;

use nalgebra::{Point3, Vector3};
use occupant_units::unit::Unit::{self, Joule, Metre, Newton, One, Radian};

use super::data::Wing;
use super::law::Now;
use super::past::{ChainPast, NodePast};
use super::site::{NodeLaw, SiteLaw};
use super::{ChainLaw, Chains, MOST_ARCS, MOST_NODES};
use crate::forces::element::{Element, Instant};
use crate::forces::shown::{Line, Named, OneOf, Pull, Reported, Shown, Tracked, Tracker};
use crate::forces::sphere::Use;
use crate::forces::stored::Archive;
use crate::forces::table::{Cell, Column, Table};
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;
use crate::quantity::{Axes, FieldWords, Quantity};

/// Largest angle between two points of a drawn arc, rad.
const ARC_STEP_RAD: f64 = 0.15;

/// Action of one strap at one instant.
#[derive(Clone, Copy, Debug)]
pub struct StrapAction<S> {
    /// T, N.
    pub force: S,
    /// ε.
    pub strain: S,
    /// Geometric length, m.
    pub length: S,
    /// N, unstretched length, m.
    pub unstretched: S,
    /// Webbing fed in at its start since the beginning, unstretched, m: payout for a spool.
    pub fed: S,
    /// Its speed, of the first strap, m/s.
    pub fed_speed: S,
    /// Phase of the device at its start; 0 for a ring.
    pub phase: S,
    /// θ at its start, rad.
    pub turn: S,
    /// 1 while the webbing passes the node at its start.
    pub passes: S,
    /// Recoverable energy, including the limiter, J.
    pub stored: S,
    /// Dissipated in it and at its start, J.
    pub lost: S,
    /// Work of actuators, J.
    pub driven: S,
    /// Residual webbing of the solution, m.
    pub residual: S,
    /// Ends, vehicle axes, m.
    pub ends: [V3<S>; 2],
    /// Force of the webbing on the node at its start, vehicle axes, N.
    pub node_force: V3<S>,
    /// 1 if it starts at the left iliac wing, 2 at the right one, 0 elsewhere.
    pub wing: S,
    /// 1 once the webbing has left the node at its start.
    pub is_off: S,
    /// Angle of the webbing's force on a track at its start to the bone's normal, rad; 0 elsewhere and off.
    pub bone_angle: S,
    /// That force, N.
    pub bone_force: S,
    /// Spheres that it wraps, and frictionless points between them.
    arcs: [Arc<S>; MOST_ARCS],
}

/// Webbing on a sphere, or on a point.
#[derive(Clone, Copy, Debug)]
struct Arc<S> {
    sphere: Option<usize>,
    /// W, rad; ≤ 0 without contact.
    wrap: S,
    /// Centre, and vector from there to the tangent point, vehicle axes, m.
    centre: V3<S>,
    touch: V3<S>,
    /// Axis of the arc.
    axis: V3<S>,
    force: V3<S>,
}

impl<S: Scalar> StrapAction<S> {
    #[inline(always)]
    pub(super) fn new(
        chain: &ChainLaw<S>,
        at: &Instant<'_, S>,
        (now, past): (&Now<'_, S>, &ChainPast<S>),
        strap: usize,
    ) -> Self {
        let o = S::zero();
        let (straps, lies) = (&chain.straps, &now.lies);
        let (tense, node) = (&now.taut.straps[strap], straps.starts[strap]);
        let end = straps.starts.get(strap + 1).copied().unwrap_or(chain.nodes.len() - 1);
        let frame = &at.frames[chain.frame];
        let (own, device) = (&past.nodes[node], &past.device);
        let forces = chain.forces(now);
        let of_first = |number: S| if strap == 0 { number } else { o };
        let [bone_angle, bone_force] = on_bone(&chain.nodes[node], at, lies.ways[node], own, forces[node]);
        StrapAction {
            force: tense.tension,
            strain: tense.strain,
            length: lies.course.lengths[strap],
            unstretched: tense.unstretched,
            fed: own.fed + tense.fed,
            fed_speed: of_first(device.speed),
            phase: of_first(device.phase),
            turn: lies.course.turns[strap],
            passes: own.on,
            stored: straps.stored(&now.taut, strap),
            lost: own.lost,
            driven: of_first(device.driven),
            residual: of_first(now.taut.solved.residual),
            ends: [node, end].map(|k| {
                let on_surface = lies.bends[k].touch * lies.places[k].radius;
                frame.axes.into_frame(lies.places[k].centre + on_surface - frame.origin)
            }),
            node_force: frame.axes.into_frame(forces[node]),
            wing: S::of(chain.nodes[node].wing().map_or(0.0, |wing| 1.0 + f64::from(wing == Wing::Right))),
            is_off: S::select(own.is_on() & !own.is_handed_over(), o, S::one()),
            bone_angle,
            bone_force,
            arcs: arcs(chain, at, (now, past), &forces, node..end),
        }
    }
}

/// Angle and magnitude of the force on the bone of a track.
#[inline(always)]
fn on_bone<S: Scalar>(node: &NodeLaw<S>, at: &Instant<'_, S>, way: S, past: &NodePast<S>, force: V3<S>) -> [S; 2] {
    let SiteLaw::Track(segment, track) = &node.site else { return [S::zero(); 2] };
    let force = at.k.axes[*segment].into_frame(force);
    let is_there = past.is_on() & !past.is_handed_over();
    let size = force.norm_squared().max(S::of(1e-60)).sqrt();
    [track.angle(way, force), size].map(|number| S::select(is_there & size.gt(S::of(1e-6)), number, S::zero()))
}

/// Spheres of a strap between these nodes, and as many points between as fit.
#[inline(always)]
fn arcs<S: Scalar>(
    chain: &ChainLaw<S>,
    at: &Instant<'_, S>,
    (now, past): (&Now<'_, S>, &ChainPast<S>),
    forces: &[V3<S>; MOST_NODES],
    nodes: std::ops::Range<usize>,
) -> [Arc<S>; MOST_ARCS] {
    let frame = &at.frames[chain.frame];
    let (first, count) = (nodes.start, nodes.clone().filter(|k| chain.nodes[*k].is_sphere()).count());
    let mut room = MOST_ARCS.saturating_sub(count);
    let mut bearings = nodes.filter(move |k| {
        let is_point = *k != first && !chain.nodes[*k].is_sphere();
        let has_room = is_point && room > 0;
        room -= usize::from(has_room);
        has_room || chain.nodes[*k].is_sphere()
    });
    from_fn(|_| {
        let none = V3::zero();
        let Some(k) = bearings.next() else {
            return Arc { sphere: None, wrap: S::zero(), centre: none, touch: none, axis: none, force: none };
        };
        let (bend, place) = (&now.lies.bends[k], &now.lies.places[k]);
        let sphere = if let SiteLaw::Sphere(sphere) = &chain.nodes[k].site { Some(*sphere) } else { None };
        Arc {
            sphere,
            // a point is drawn like a sphere without size
            wrap: S::select(past.nodes[k].is_on(), if sphere.is_some() { bend.wrap } else { S::of(1e-3) }, S::zero()),
            centre: frame.axes.into_frame(place.centre - frame.origin),
            touch: frame.axes.into_frame(bend.touch) * place.radius,
            axis: -frame.axes.into_frame(bend.normal),
            force: frame.axes.into_frame(forces[k]),
        }
    })
}

impl StrapAction<f64> {
    /// Spheres that it wraps, and its forces on them, axes of the belt's frame, N.
    pub(crate) fn on_spheres(&self) -> impl Iterator<Item = (usize, Vector3<f64>)> {
        let on = self.arcs.iter().filter(|arc| arc.wrap > 0.0);
        on.filter_map(|arc| Some((arc.sphere?, arc.force.to_vector())))
    }
}

impl Arc<f64> {
    /// Points along it, vehicle axes, m.
    fn points_m(&self) -> impl Iterator<Item = Point3<f64>> {
        let [centre, touch, axis] = [self.centre, self.touch, self.axis].map(V3::to_vector);
        let steps = (self.wrap.max(0.0) / ARC_STEP_RAD).ceil();
        let angle = move |i: f64| self.wrap * if steps > 0.0 { i / steps } else { 0.0 };
        let point = move |angle: f64| {
            let (sine, cosine) = occupant_units::trig::sin_cos(angle);
            Point3::from(centre + touch * cosine + axis.cross(&touch) * sine)
        };
        let count = if self.wrap > 0.0 { steps as u64 + 1 } else { 0 };
        (0..count).map(move |i| point(angle(i as f64)))
    }
}

type Of = Quantity<OneOf<Chains>>;

impl Reported for Chains {
    const MESSAGE: &'static str = "Strap";
    const TELLS: bool = true;

    const QUANTITIES: &'static [Of] = &[
        Of::number(Newton, |s| s.force).channel("force", "tension of the {}").field(2, "force", "tension"),
        Of::number(One, |s| s.strain).channel("strain", "strain of the {}").field(
            3,
            "strain",
            "length over unstretched length, less 1; in slack where tension begins",
        ),
        Of::number(Metre, |s| s.length).channel("length", "length of the {}").field(
            4,
            "length",
            "length that it lies at",
        ),
        Of::number(Metre, |s| s.unstretched).field(5, "unstretched", "unstretched length"),
        Of::number(Metre, |s| s.fed).channel("payout", "webbing that has come into the {} where it begins").field(
            6,
            "payout",
            "unstretched webbing that has entered at its first node since the start: off the spool, through the ring",
        ),
        Of::number(Unit::MetrePerSecond, |s| s.fed_speed).field(
            7,
            "payout_speed",
            "speed at which webbing has left the spool in the last step; 0 of other straps",
        ),
        Of::number(One, |s| s.phase).channel("phase", "phase of the device of the {}").field(
            8,
            "phase",
            "of the device at its first node: 1 open spool, 2 locking, 3 pulled in, 4 locked or fixed; 0 of a ring",
        ),
        Of::number(Radian, |s| s.turn).field(
            9,
            "turn",
            "angle by which the webbing turns in the ring at its first node",
        ),
        Of::vector(Newton, Axes::Vehicle, |s| s.node_force.to_vector())
            .channel("node_force", "force of the webbing on the node where the {} begins")
            .field(10, "node_force", "force of the webbing on its first node")
            .resultant(11, "node_force", "its magnitude"),
        Of::vector(Metre, Axes::Vehicle, |s| s.ends[0].to_vector()).field(12, "start", "where it begins"),
        Of::number(Radian, |s| s.bone_angle)
            .channel(
                "pelvis_angle",
                "angle of the belt's force against the bone where the {} begins, positive towards the abdomen",
            )
            .field(
                16,
                "bone_angle",
                "of its force on a track where it begins against the bone's normal, positive outwards",
            ),
        Of::number(Newton, |s| s.bone_force)
            .channel("bone_force", "force of the webbing on the bone where the {} begins")
            .field(17, "bone_force", "its force on a track at its first node; 0 once it has come off"),
        Of::number(Joule, |s| s.stored).field(
            13,
            "stored",
            "recoverable energy, with that of the limiter at its first node",
        ),
        Of::number(Joule, |s| s.lost).field(
            14,
            "lost",
            "lost in it and at its first node since the start: webbing, friction, limiter and spool",
        ),
        Of::number(Metre, |s| s.residual).field(
            15,
            "residual",
            "of the first strap: webbing that the solution for the tensions leaves over",
        ),
    ];

    const PEAKS: &'static [Tracked] = &[
        Tracked {
            column: Column::number("force_n", "force, N", 0).measure("peak", Newton),
            time: Some(Column::time("time_s").measure("peak_time", Unit::Second)),
            at_least_zero: true,
        },
        Tracked {
            column: Column { scale: 1e3, ..Column::number("payout_m", "payout, mm", 1) }.measure("payout", Metre),
            time: None,
            at_least_zero: false,
        },
        Tracked {
            column: Column { scale: 1e3, ..Column::number("pull_in_m", "pull-in, mm", 1) }.measure("pull_in", Metre),
            time: None,
            at_least_zero: true,
        },
        Tracked {
            column: Column::number("lost_j", "dissipated, J", 1).measure("lost", Joule),
            time: None,
            at_least_zero: true,
        },
    ];

    #[inline(always)]
    fn track<S: Scalar>(s: &StrapAction<S>, tracker: &mut impl Tracker<S>) {
        tracker.numbers(&[s.force, s.fed, -s.fed, s.lost]);
    }

    fn keep(past: &mut Vec<ChainPast<f64>>, like: Option<&[ChainPast<f64>]>, file: &mut dyn Archive) {
        let number = if like.is_some() { 51 } else { 50 };
        let meaning = "what each belt over several nodes remembers: of its device, then of 12 nodes";
        let mut list = Vec::new();
        for chain in &*past {
            chain.map(&mut |x| list.push(x));
        }
        let list = file.numbers(FieldWords { number, stem: "chains", meaning }, list);
        let mut size = 0;
        let blank = ChainPast::<f64>::none();
        blank.map(&mut |_| size += 1);
        if list.len() % size != 0 {
            return file.refuse("a list of belts with parts missing");
        }
        let chain = |numbers: &[f64]| {
            let mut numbers = numbers.iter().copied();
            blank.map(&mut |none| numbers.next().unwrap_or(none))
        };
        *past = list.chunks(size).map(chain).collect();
    }

    fn named<'a>(data: Self::Data<'a>) -> Vec<Named<'a>> {
        data.iter().flat_map(|chain| &chain.straps).map(|name| Named { name, sphere: None }).collect()
    }

    fn start_table(shown: &Shown<'_, Self>) -> Option<Table> {
        if shown.data.is_empty() {
            return None;
        }
        let columns = [
            Column::number("length_m", "length, m", 4),
            Column::number("unstretched_m", "unstretched, m", 4),
            Column::number("force_n", "force, N", 1),
            Column { scale: 180.0 / std::f64::consts::PI, ..Column::number("turn_rad", "turn, °", 1) },
            Column { scale: 180.0 / std::f64::consts::PI, ..Column::number("wrap_rad", "wrap, °", 1) },
        ];
        let row = |(named, s): (Named<'_>, &StrapAction<f64>)| {
            let wrap = s.arcs.iter().filter(|arc| arc.sphere.is_some()).map(|arc| arc.wrap.max(0.0)).sum();
            let numbers = [s.length, s.unstretched, s.force, s.turn, wrap];
            (named.name.to_owned(), numbers.map(|number| Cell::Number(Some(number))).to_vec())
        };
        Some(Table::new(Self::NAMES[0], &columns, Self::named(shown.data).into_iter().zip(shown.actions).map(row)))
    }

    fn lines(shown: &Shown<'_, Self>) -> Vec<Line> {
        let line = |(named, s): (Named<'_>, &StrapAction<f64>)| {
            let [from, to] = s.ends.map(|end| Point3::from(end.to_vector()));
            let points_m = [from].into_iter().chain(s.arcs.iter().flat_map(Arc::points_m)).chain([to]).collect();
            Line { name: named.name.to_owned(), points_m, force_n: s.force }
        };
        Self::named(shown.data).into_iter().zip(shown.actions).map(line).collect()
    }

    fn pulls(shown: &Shown<'_, Self>, show: &mut dyn FnMut(&Pull<'_>)) {
        let [of, _] = Self::NAMES;
        for (named, strap) in Self::named(shown.data).into_iter().zip(shown.actions) {
            for arc in strap.arcs.iter().filter(|arc| arc.wrap > 0.0) {
                let Some(sphere) = arc.sphere else { continue };
                let (name, point_m) = (named.name, (shown.centre_m)(sphere, Use::Belt));
                show(&Pull { of, name, sphere, point_m, force_n: arc.force.to_vector() });
            }
        }
    }

    const BY_STEPS: &'static [&'static str] = &[
        LEAVES_LEFT,
        LEAVES_RIGHT,
        LOSES,
        COMES_ONTO,
        LEAVES,
        TIGHTENS,
        SLACKENS,
        PHASES[1],
        PHASES[2],
        PHASES[3],
        PHASES[4],
    ];

    fn told(before: &[f64], now: &[f64], show: &mut dyn FnMut(&'static str)) {
        match [before[0] > 0.0, now[0] > 0.0] {
            [false, true] => show(TIGHTENS),
            [true, false] => show(SLACKENS),
            _ => {}
        }
    }

    fn switched(
        law: &Vec<ChainLaw<f64>>,
        before: &[ChainPast<f64>],
        now: &[ChainPast<f64>],
        show: &mut dyn FnMut(usize, &'static str),
    ) {
        let mut first = 0;
        for (chain, (before, now)) in law.iter().zip(before.iter().zip(now)) {
            if before.device.phase != now.device.phase {
                show(first, phase_words(now.device.phase));
            }
            let starts = &chain.straps.starts;
            for (k, node) in chain.nodes.iter().enumerate() {
                let [was, is] = [before, now].map(|past| past.nodes[k].is_on());
                let strap = first + starts.iter().filter(|start| **start <= k).count().saturating_sub(1);
                let [was_over, is_over] = [before, now].map(|past| past.nodes[k].is_handed_over());
                if node.wing().is_some() && ((was && !is) || (!was_over && is_over)) {
                    show(strap, if node.wing() == Some(Wing::Left) { LEAVES_LEFT } else { LEAVES_RIGHT });
                } else if was_over != is_over {
                    show(strap, LOSES);
                } else if was != is && node.is_sphere() {
                    show(strap, if is { COMES_ONTO } else { LEAVES });
                } else if was != is && starts.contains(&k) {
                    show(strap, LOSES);
                }
            }
            first += starts.len();
        }
    }

    fn event<S: Scalar>(before: &StrapAction<S>, now: &StrapAction<S>) -> Option<(&'static str, Option<S>)> {
        let (o, half) = (S::zero(), S::of(0.5));
        let is = |x: S| S::any(x.gt(half));
        let rises = |from: S, to: S| S::any(to.gt(from + half));
        if !is(before.is_off) && is(now.is_off) && is(now.wing) {
            let words = if S::any(now.wing.gt(S::of(1.5))) { LEAVES_RIGHT } else { LEAVES_LEFT };
            return Some((words, None));
        }
        if is(before.passes) && !is(now.passes) {
            return Some((LOSES, Some(before.force)));
        }
        if rises(before.phase, now.phase) || rises(now.phase, before.phase) {
            return Some((phase_words(now.phase), None));
        }
        let wraps = |strap: &StrapAction<S>| {
            let on = strap.arcs.iter().filter(|arc| arc.sphere.is_some() && S::any(arc.wrap.gt(o)));
            on.count()
        };
        match wraps(now).cmp(&wraps(before)) {
            std::cmp::Ordering::Less => return Some((LEAVES, None)),
            std::cmp::Ordering::Greater => return Some((COMES_ONTO, None)),
            std::cmp::Ordering::Equal => {}
        }
        match (S::any(before.force.gt(o)), S::any(now.force.gt(o))) {
            (false, true) => Some((TIGHTENS, None)),
            (true, false) => Some((SLACKENS, None)),
            _ => None,
        }
    }
}

const LEAVES_LEFT: &str = "leaves the left iliac wing";
const LEAVES_RIGHT: &str = "leaves the right iliac wing";
const LOSES: &str = "comes off its first node";
const COMES_ONTO: &str = "comes onto a sphere of the body";
const LEAVES: &str = "leaves a sphere of the body";
const TIGHTENS: &str = "tightens";
const SLACKENS: &str = "goes slack";
/// Descriptions of phase changes of a device.
const PHASES: [&str; 5] = ["", "opens", "begins to lock", "is pulled in by its pretensioner", "locks"];

fn phase_words<S: Scalar>(phase: S) -> &'static str {
    let place = (0..PHASES.len()).find(|i| !S::any(phase.gt(S::of(*i as f64 + 0.5))));
    PHASES[place.unwrap_or(0)]
}

const _: () = assert!(MOST_ARCS < MOST_NODES);
