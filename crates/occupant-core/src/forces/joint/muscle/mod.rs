//! Muscles: active torques that hold the posture of a joint from a trigger on, after a reaction time.

mod check;
mod law;
mod results;

use crate::body::{Body, Segment};
use crate::forces::element::{Element, Instant, Load, StoredEnergy, Unlike, WorkSum};
use crate::forces::joint::Joints;
use crate::forces::joint::posture::Posture;
use crate::forces::list::STORES;
use crate::forces::rate::Rate;
use crate::forces::sphere::Site as Sphere;
use crate::motion::mobility::{Mobility, greatest};
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;
use crate::quantity::Quantity;
pub use law::{Muscle, NEVER_S, Reflex};
use law::{MuscleAction, MuscleLaw};
use occupant_units::unit::Unit;
use placed_text::Problems;

/// Index of the work that muscles absorb; the work that they do is its negative.
const WORK: usize = 4;

const OTHER_MUSCLES: Unlike = Unlike("other joints have muscles or reflexes");

/// The kind of force element: muscles of joints.
#[derive(Clone, Copy, Debug)]
pub struct Muscles;

impl Element for Muscles {
    const OPTIONAL: bool = true;
    const STORED: &'static [StoredEnergy] = &[];
    const SUMS: &'static [WorkSum] =
        &[WorkSum {
            at: WORK,
            quantity: Quantity::number(Unit::Joule, |taken_j: &f64| -*taken_j)
                .channel("muscles", "work of muscles")
                .field(16, "muscles", "work of muscles on the body since the start; below 0 where they brake"),
        }];
    const NAMES: [&'static str; 2] = ["muscle", "muscles"];

    type Data<'a> = &'a Joints;
    type Law<S> = Vec<MuscleLaw<S>>;
    type Past<S> = ();
    type Hints<S: Scalar> = ();
    type Action<S> = MuscleAction<S>;

    fn check(data: &Joints, _body: &Body, problems: &mut Problems) {
        data.muscles.iter().for_each(|muscle| check::check(data, muscle, problems));
    }

    fn new(data: &Joints, body: &Body) -> Vec<MuscleLaw<f64>> {
        data.muscles.iter().map(|muscle| MuscleLaw::new(body, muscle)).collect()
    }

    /// Muscles hold the initial posture unless another is given.
    fn begin(law: &mut Vec<MuscleLaw<f64>>, data: &Joints, _: &Body, at: &Instant<'_, f64>, _: &mut Problems) {
        for (muscle, _) in law.iter_mut().zip(&data.muscles).filter(|(_, said)| said.hold.is_none()) {
            let (inner, outer) = muscle.segments;
            muscle.held = Posture::new(&at.k.axes[inner], &at.k.axes[outer], V3::zero());
        }
    }

    fn own(law: &mut Vec<MuscleLaw<f64>>, numbers: &mut Vec<f64>) {
        law.iter_mut().for_each(|muscle| muscle.own(numbers));
    }

    fn start(_law: &Vec<MuscleLaw<f64>>, _at: &Instant<'_, f64>) -> Vec<()> {
        Vec::new()
    }

    fn hints<S: Scalar>(_law: &Vec<MuscleLaw<S>>) {}

    fn count<S>(_law: &Vec<MuscleLaw<S>>) -> usize {
        0
    }

    fn most_actions<S>(law: &Vec<MuscleLaw<S>>) -> usize {
        law.len()
    }

    fn zip<S: Copy, A: Copy, T>(
        one: &Vec<MuscleLaw<S>>,
        other: &Vec<MuscleLaw<A>>,
        f: &impl Fn(S, A) -> T,
    ) -> Result<Vec<MuscleLaw<T>>, Unlike> {
        let is_like = one.len() == other.len() && one.iter().zip(other).all(|(a, b)| a.is_like(b));
        is_like.then(|| one.iter().zip(other).map(|(a, b)| a.zip(b, f)).collect()).ok_or(OTHER_MUSCLES)
    }

    fn each<S, A>(_one: &mut (), _other: &mut (), _f: &mut impl FnMut(&mut S, &mut A)) {}

    fn map<A: Copy, S>(_past: &(), _f: &mut impl FnMut(A) -> S) {}

    #[inline(always)]
    fn apply<S: Scalar>(
        law: &Vec<MuscleLaw<S>>,
        at: &Instant<'_, S>,
        _past: &mut [()],
        _hints: &mut (),
        load: &mut Load<S>,
        show: &mut impl FnMut(&MuscleAction<S>),
    ) {
        for muscle in law {
            let action = muscle.act(at);
            let (inner, outer) = muscle.segments;
            load.wrench[outer].moment += action.moment;
            load.wrench[inner].moment -= action.moment;
            load.power_at(outer).sums[WORK] -= action.power;
            muscle.flow(&action, &mut load.own);
            show(&action);
        }
    }

    /// Spring and damper of fully active muscles.
    fn rates(
        data: &Joints,
        _body: &Body,
        _at: &Instant<'_, f64>,
        _actions: &[MuscleAction<f64>],
        mobility: &Mobility<'_>,
    ) -> Vec<Rate> {
        data.muscles.iter().flat_map(|muscle| rates(data, muscle, mobility)).collect()
    }

    fn segment(
        law: &Vec<MuscleLaw<f64>>,
        _spheres: &[Sphere<f64>],
        number: usize,
        _action: &MuscleAction<f64>,
    ) -> usize {
        law[number].segments.1
    }

    fn stored_j(_actions: &[MuscleAction<f64>], _stored_j: &mut [f64; STORES]) {}
}

fn rates(data: &Joints, muscle: &Muscle, mobility: &Mobility<'_>) -> Vec<Rate> {
    let row = &data.tree()[muscle.joint];
    let [inner, outer] = row.between().map(Segment::index);
    let hinge = mobility.skeleton.layout.hinge_slot(row.carrying()[1].index()).map(|hinge| mobility.of_hinge(hinge));
    let give = hinge.unwrap_or_else(|| greatest(mobility.of_joint(inner, outer)));
    let spring = Rate::of_spring(row.name.to_owned(), "muscle".to_owned(), 1.0 / give, muscle.stiffness_n_m);
    let damper = Rate::of_damper(&format!("{}, muscle", row.name), 1.0 / give, muscle.damping_n_m_s);
    [Some(spring).filter(|spring| spring.coefficient > 0.0), damper].into_iter().flatten().collect()
}

#[cfg(test)]
mod tests;
