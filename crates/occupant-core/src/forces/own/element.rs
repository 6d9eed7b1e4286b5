//! The kind of force element that a program defines itself.

use std::any::Any;
use std::fmt;
use std::marker::PhantomData;

use nalgebra::Vector3;
use occupant_units::unit::Unit::{Joule, Newton};

use super::{MOST_CHANNELS, MOST_MEMORY, OwnForce, Pushes, Scene, check};
use crate::body::Body;
use crate::forces::element::{Element, Instant, Load, StoredEnergy, Unlike, WorkSum};
use crate::forces::list::STORES;
use crate::forces::shown::{Named, OneOf, Reported};
use crate::forces::sphere::Site;
use crate::forces::stored::Archive;
use crate::motion::frame::Frames;
use crate::motion::kinematics::Kinematics;
use crate::motion::scalar::Scalar;
use crate::motion::state::State;
use crate::quantity::{FieldWords, Quantity, energy};
use placed_text::Problems;

/// Reason why a model with an own force cannot be computed side by side and has no derivatives.
pub(crate) const PLAIN: Unlike = Unlike("a program's own forces support neither lanes nor derivatives");

/// Absorbed energy for which the state variable of a force is 1, J.
const SCALE_J: f64 = 100.0;

/// Setup data.
#[derive(Clone, Copy, Debug)]
pub struct OwnData<'a> {
    /// All own forces.
    pub forces: &'a [OwnForce],
    /// Number of frames besides space and the vehicle.
    pub others: usize,
}

/// All own forces; none with scalars other than plain numbers.
#[derive(Clone, Debug, Default)]
pub struct OwnLaw<S> {
    plain: OwnPlain,
    numbers: PhantomData<S>,
}

impl<S> OwnLaw<S> {
    fn of(plain: OwnPlain) -> Self {
        OwnLaw { plain, numbers: PhantomData }
    }
}

/// The forces, with the data that their points need.
#[derive(Clone, Default)]
pub struct OwnPlain {
    pub(super) forces: Vec<OwnForce>,
    pub(super) others: usize,
    pub(super) spheres: Vec<Site<f64>>,
    /// By segment: its joint from its lower end, m.
    pub(super) joints: Vec<Vector3<f64>>,
    /// By force: its index among the state variables that elements own.
    own: Vec<usize>,
}

impl fmt::Debug for OwnPlain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.forces.iter().map(|own| &own.name)).finish()
    }
}

/// State of one force at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OwnAction {
    segment: usize,
    /// Largest of its forces, N.
    force: f64,
    /// Energy absorbed from the bodies since the start, stored or dissipated, J; negative: supplied.
    taken: f64,
    stored: f64,
    pub(crate) shown: [f64; MOST_CHANNELS],
}

/// The kind of force element: a program's own forces.
#[derive(Clone, Copy, Debug)]
pub struct OwnForces;

impl OwnPlain {
    fn scene<'a>(&'a self, k: &'a Kinematics<f64>, frames: &'a Frames<f64>) -> Scene<'a> {
        Scene { law: self, k, frames }
    }

    /// Adds all forces.
    #[inline(never)]
    fn apply(
        &self,
        (k, state, frames): (&Kinematics<f64>, &State<f64>, &Frames<f64>),
        accepted: bool,
        (i, memory): (usize, &mut [f64; MOST_MEMORY]),
        load: &mut Load<f64>,
    ) -> OwnAction {
        let (scene, own) = (self.scene(k, frames), &self.forces[i]);
        if accepted {
            own.force.accept(&scene, memory);
        }
        let shown = [f64::NAN; MOST_CHANNELS];
        let mut pushes = Pushes { scene, load, home: None, taken_w: 0.0, force_n: 0.0, stored_j: 0.0, shown };
        own.force.apply(&scene, memory, &mut pushes);
        let Pushes { home, taken_w, force_n: force, stored_j: stored, shown, .. } = pushes;
        let place = self.own.get(i).copied().unwrap_or(usize::MAX);
        if let Some(rate) = load.own.get_mut(place) {
            *rate = taken_w / SCALE_J;
        }
        let taken = state.own().get(place).map_or(0.0, |taken| SCALE_J * taken);
        OwnAction { segment: home.unwrap_or_default(), force, taken, stored, shown }
    }
}

/// A value of a scalar type as one of plain numbers, if it is.
fn plain<T: Any, P: Any>(thing: &T) -> Option<&P> {
    (thing as &dyn Any).downcast_ref()
}

fn plain_mut<T: Any, P: Any>(thing: &mut T) -> Option<&mut P> {
    (thing as &mut dyn Any).downcast_mut()
}

impl Element for OwnForces {
    const OPTIONAL: bool = true;
    const STORED: &'static [StoredEnergy] = &[StoredEnergy {
        at: 6,
        quantity: energy(
            20,
            "own_forces",
            "taken by the program's own forces",
            "taken from the bodies by a program's own forces since the start, stored or lost; negative if they gave energy",
        ),
        held_by: None,
    }];
    const SUMS: &'static [WorkSum] = &[];
    const NAMES: [&'static str; 2] = ["own_force", "own forces"];

    type Data<'a> = OwnData<'a>;
    type Law<S> = OwnLaw<S>;
    type Past<S> = [S; MOST_MEMORY];
    type Hints<S: Scalar> = ();
    type Action<S> = OwnAction;

    fn check(data: OwnData<'_>, _body: &Body, problems: &mut Problems) {
        check(data.forces, problems);
    }

    fn new(data: OwnData<'_>, body: &Body) -> OwnLaw<f64> {
        if data.forces.is_empty() {
            return OwnLaw::default();
        }
        OwnLaw::of(OwnPlain {
            forces: data.forces.to_vec(),
            others: data.others,
            spheres: Site::all(body),
            joints: body.tree.segments().map(|segment| body.joint_m(segment)).collect(),
            own: Vec::new(),
        })
    }

    fn own(law: &mut OwnLaw<f64>, numbers: &mut Vec<f64>) {
        let law = &mut law.plain;
        law.own = (numbers.len()..numbers.len() + law.forces.len()).collect();
        numbers.extend(law.forces.iter().map(|_| 0.0));
    }

    fn start(law: &OwnLaw<f64>, at: &Instant<'_, f64>) -> Vec<[f64; MOST_MEMORY]> {
        let law = &law.plain;
        let scene = law.scene(at.k, at.frames);
        let one = |own: &OwnForce| {
            let mut given = own.force.start(&scene).into_iter();
            std::array::from_fn(|_| given.next().unwrap_or_default())
        };
        law.forces.iter().map(one).collect()
    }

    fn begin(_law: &mut OwnLaw<f64>, data: OwnData<'_>, body: &Body, at: &Instant<'_, f64>, problems: &mut Problems) {
        let law = OwnForces::new(data, body);
        for own in data.forces {
            let numbers = own.force.start(&law.plain.scene(at.k, at.frames));
            let path = format!("own_forces.{}", own.name);
            if numbers.len() > MOST_MEMORY {
                let expected = format!("at most {MOST_MEMORY}");
                problems.error(path, format!("{} numbers to remember", numbers.len()), expected);
            } else if !numbers.iter().all(|number| number.is_finite()) {
                problems.error(path, "numbers to remember that are not finite", "finite numbers");
            }
        }
    }

    fn hints<S: Scalar>(_law: &OwnLaw<S>) {}

    fn count<S>(law: &OwnLaw<S>) -> usize {
        law.plain.forces.len()
    }

    fn zip<S: Copy, A: Copy, T>(
        one: &OwnLaw<S>,
        other: &OwnLaw<A>,
        _f: &impl Fn(S, A) -> T,
    ) -> Result<OwnLaw<T>, Unlike> {
        let are_none = one.plain.forces.is_empty() && other.plain.forces.is_empty();
        if are_none { Ok(OwnLaw::of(OwnPlain::default())) } else { Err(PLAIN) }
    }

    fn each<S, A>(one: &mut [S; MOST_MEMORY], other: &mut [A; MOST_MEMORY], f: &mut impl FnMut(&mut S, &mut A)) {
        one.iter_mut().zip(other).for_each(|(one, other)| f(one, other));
    }

    fn map<A: Copy, S>(past: &[A; MOST_MEMORY], f: &mut impl FnMut(A) -> S) -> [S; MOST_MEMORY] {
        past.map(f)
    }

    #[inline(always)]
    fn apply<S: Scalar>(
        law: &OwnLaw<S>,
        at: &Instant<'_, S>,
        past: &mut [[S; MOST_MEMORY]],
        _hints: &mut (),
        load: &mut Load<S>,
        show: &mut impl FnMut(&OwnAction),
    ) {
        let law = &law.plain;
        if law.forces.is_empty() {
            return;
        }
        // laws of other numbers than plain ones are empty: `zip`
        let (Some(k), Some(state), Some(frames), Some(load)) =
            (plain(at.k), plain(at.state), plain(at.frames), plain_mut(load))
        else {
            return;
        };
        for (i, memory) in past.iter_mut().enumerate() {
            if let Some(memory) = plain_mut(memory) {
                show(&law.apply((k, state, frames), at.accepted, (i, memory), load));
            }
        }
    }

    fn segment(_law: &OwnLaw<f64>, _spheres: &[Site<f64>], _number: usize, action: &OwnAction) -> usize {
        action.segment
    }

    fn stored_j(actions: &[OwnAction], stored_j: &mut [f64; STORES]) {
        stored_j[Self::STORED[0].at] = actions.iter().map(|own| own.taken).sum();
    }
}

type Of = Quantity<OneOf<OwnForces>>;

impl Reported for OwnForces {
    const MESSAGE: &'static str = "OwnForceState";

    const QUANTITIES: &'static [Of] = &[
        Of::number(Newton, |own| own.force).channel("force", "largest of the forces of the {}").field(
            2,
            "force",
            "greatest of its forces",
        ),
        Of::number(Joule, |own| own.taken)
            .channel("taken", "energy that the {} has taken from the bodies, stored or lost")
            .field(
                3,
                "taken",
                "energy taken from the bodies since the start, stored or lost; negative if it gave energy",
            ),
        Of::number(Joule, |own| own.stored).channel("stored", "recoverable energy of the {}, as it reports").field(
            4,
            "stored",
            "recoverable energy, as it reports",
        ),
    ];

    fn keep(past: &mut Vec<[f64; MOST_MEMORY]>, like: Option<&[[f64; MOST_MEMORY]]>, file: &mut dyn Archive) {
        let number = if like.is_some() { 68 } else { 67 };
        let meaning = "what each of the program's own forces remembers, 16 numbers each";
        let list = file.numbers(FieldWords { number, stem: "own_forces", meaning }, past.concat());
        let (forces, rest) = list.as_chunks();
        if !rest.is_empty() {
            return file.refuse("a list of own forces with parts missing");
        }
        *past = forces.to_vec();
    }

    fn named<'a>(data: Self::Data<'a>) -> Vec<Named<'a>> {
        data.forces.iter().map(|own| Named { name: &own.name, sphere: None }).collect()
    }
}
