//! Belts: one loop round one sphere, two anchors in the vehicle.
//!
//! Report: "Lap and Torso Restraint Belts", Figs 17 and 18.

mod check;
mod course;
pub mod law;
mod results;

use nalgebra::Point3;

use crate::body::Body;
use crate::forces::contact::surface::Frame;
use crate::forces::element::{Element, HeldBy, Instant, Load, StoredEnergy, Unlike, WorkSum};
use crate::forces::list::STORES;
use crate::forces::rate::Rate;
use crate::forces::sphere::{Site, Use};
use crate::forces::spring::BilinearSpring;
use crate::motion::mobility::Mobility;
use crate::motion::scalar::Scalar;
use crate::motion::vector::v3;
use crate::quantity::energy;
use law::{BeltAction, BeltHistory, BeltLaw};
use placed_text::Problems;

/// Index of the work done on belts, stored and dissipated.
pub const STRETCH: usize = 3;

/// Different belts, or belts around different spheres.
pub(crate) const OTHER_BELTS: Unlike = Unlike("the belts differ or go round other spheres");

/// Definition of the unstretched length L₀.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RestLength {
    /// L₀ = length at the start + slack; negative slack is preload.
    Slack {
        /// Slack.
        slack_m: f64,
    },
    /// L₀ itself.
    Given {
        /// L₀.
        length_m: f64,
    },
}

impl Default for RestLength {
    /// Neither slack nor preload.
    fn default() -> Self {
        RestLength::Slack { slack_m: 0.0 }
    }
}

/// A belt.
#[derive(Clone, Debug, PartialEq)]
pub struct Belt {
    /// Unique name, e.g. `lap`, `torso`.
    pub name: String,
    /// Index of its sphere: pelvis for a lap belt, chest for a torso belt.
    pub sphere: usize,
    /// Frame of the anchors.
    pub frame: Frame,
    /// Anchor points, axes of the frame.
    pub anchors_m: [Point3<f64>; 2],
    /// Loop force over elongation. Fractions of 1 load and unload along one curve as in Fig. 18.
    pub webbing: BilinearSpring,
    /// Unstretched length.
    pub rest: RestLength,
}

impl Belt {
    /// A belt without slack around sphere `sphere` (index), from anchor to anchor (vehicle axes).
    pub fn new(name: impl Into<String>, sphere: usize, anchors_m: [Point3<f64>; 2], webbing: BilinearSpring) -> Self {
        Belt { name: name.into(), sphere, frame: Frame::Vehicle, anchors_m, webbing, rest: RestLength::default() }
    }
}

/// The kind of force element: belts.
#[derive(Clone, Copy, Debug)]
pub struct Belts;

impl Element for Belts {
    const STORED: &'static [StoredEnergy] = &[StoredEnergy {
        at: 2,
        quantity: energy(7, "belts", "stored in belts", "recoverable, in belts"),
        held_by: HeldBy::sum(STRETCH, 22, "start_belts_j", "stored in belts at the start of the run"),
    }];
    const SUMS: &'static [WorkSum] = &[WorkSum {
        at: STRETCH,
        quantity: energy(11, "lost_belts", "dissipated by belts", "dissipated by belts since the start"),
    }];
    const NAMES: [&'static str; 2] = ["belt", "belts"];

    type Data<'a> = &'a [Belt];
    type Law<S> = Vec<BeltLaw<S>>;
    type Past<S> = BeltHistory<S>;
    type Hints<S: Scalar> = ();
    type Action<S> = BeltAction<S>;

    fn check(data: &[Belt], body: &Body, problems: &mut Problems) {
        check::data(data, body, problems);
    }

    fn new(data: &[Belt], body: &Body) -> Vec<BeltLaw<f64>> {
        data.iter().map(|belt| BeltLaw::new(belt, body.spheres[belt.sphere].radius_m, 0.0)).collect()
    }

    fn lay(law: &mut Vec<BeltLaw<f64>>, data: &[Belt], body: &Body, at: &Instant<'_, f64>) {
        for (law, belt) in law.iter_mut().zip(data) {
            *law = BeltLaw::laid(
                belt,
                body.spheres[belt.sphere].radius_m,
                at.centre_in(belt.sphere, Use::Belt, law.frame),
            );
        }
    }

    fn begin(law: &mut Vec<BeltLaw<f64>>, data: &[Belt], body: &Body, at: &Instant<'_, f64>, problems: &mut Problems) {
        for (law, belt) in law.iter().zip(data) {
            let spheres: Vec<_> =
                (0..body.spheres.len()).map(|sphere| at.centre_in(sphere, Use::Belt, law.frame)).collect();
            check::laid(law, belt, body, &spheres, problems);
        }
    }

    fn start(law: &Vec<BeltLaw<f64>>, at: &Instant<'_, f64>) -> Vec<BeltHistory<f64>> {
        law.iter().map(|belt| belt.initial_history(at.centre_in(belt.sphere, Use::Belt, belt.frame))).collect()
    }

    fn hints<S: Scalar>(_law: &Vec<BeltLaw<S>>) {}

    fn count<S>(law: &Vec<BeltLaw<S>>) -> usize {
        law.len()
    }

    fn zip<S: Copy, A: Copy, T>(
        one: &Vec<BeltLaw<S>>,
        other: &Vec<BeltLaw<A>>,
        f: &impl Fn(S, A) -> T,
    ) -> Result<Vec<BeltLaw<T>>, Unlike> {
        if one.len() != other.len() || one.iter().zip(other).any(|(a, b)| a.sphere != b.sphere) {
            return Err(OTHER_BELTS);
        }
        Ok(one.iter().zip(other).map(|(a, b)| a.zip(b, f)).collect())
    }

    fn each<S, A>(one: &mut BeltHistory<S>, other: &mut BeltHistory<A>, f: &mut impl FnMut(&mut S, &mut A)) {
        f(&mut one.normal.x, &mut other.normal.x);
        f(&mut one.normal.y, &mut other.normal.y);
        f(&mut one.normal.z, &mut other.normal.z);
        f(&mut one.greatest, &mut other.greatest);
    }

    fn map<A: Copy, S>(past: &BeltHistory<A>, f: &mut impl FnMut(A) -> S) -> BeltHistory<S> {
        let n = past.normal;
        BeltHistory { normal: v3(f(n.x), f(n.y), f(n.z)), greatest: f(past.greatest) }
    }

    /// Applies the forces at the spheres' centres.
    #[inline(always)]
    fn apply<S: Scalar>(
        law: &Vec<BeltLaw<S>>,
        at: &Instant<'_, S>,
        past: &mut [BeltHistory<S>],
        _hints: &mut (),
        load: &mut Load<S>,
        show: &mut impl FnMut(&BeltAction<S>),
    ) {
        for (belt, past) in law.iter().zip(past) {
            let frame = &at.frames[belt.frame];
            let site = &at.spheres[belt.sphere];
            let (arm, centre, velocity) = site.place(at.k, Use::Belt);
            let centre_v = frame.axes.into_frame(centre - frame.origin);
            let action = belt.act(centre_v, past);
            if at.accepted {
                belt.commit(&action, past);
            }
            let force = frame.axes.out(action.force);
            let carried = frame.velocity_at(centre);
            let wrench = &mut load.wrench[site.segment];
            wrench.force += force;
            wrench.moment += arm.cross(force);
            load.press(site, Use::Belt, force, S::truth(true));
            let power = load.power_at(site.segment);
            power.sums[STRETCH] -= force.dot(velocity - carried);
            power.vehicle += force.dot(carried);
            show(&action);
        }
    }

    /// Loop stiffness and the effective mass along the sum of the two free lengths' directions.
    fn rates(
        data: &[Belt],
        body: &Body,
        at: &Instant<'_, f64>,
        actions: &[BeltAction<f64>],
        mobility: &Mobility<'_>,
    ) -> Vec<Rate> {
        let one = |(belt, action): (&Belt, &BeltAction<f64>)| {
            // −gradient of the length with respect to the centre
            let gradient = at.frames[belt.frame.index(&[])].axes.out(action.free[0] + action.free[1]).to_vector();
            let site = &at.spheres[belt.sphere];
            let (_, centre, _) = site.place(&mobility.kinematics, Use::Belt);
            let give = gradient.dot(&(mobility.of_point(site.segment, centre) * gradient));
            let by = format!("on {}", body.spheres[belt.sphere].name);
            Rate::of_spring(belt.name.clone(), by, 1.0 / give, belt.webbing.steepest_n_per_m())
        };
        data.iter().zip(actions).map(one).collect()
    }

    fn segment(law: &Vec<BeltLaw<f64>>, spheres: &[Site<f64>], number: usize, _action: &BeltAction<f64>) -> usize {
        spheres[law[number].sphere].segment
    }

    fn stored_j(actions: &[BeltAction<f64>], stored_j: &mut [f64; STORES]) {
        stored_j[Self::STORED[0].at] = actions.iter().map(|belt| belt.stored).sum();
    }
}
