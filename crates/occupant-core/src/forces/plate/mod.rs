//! Plates: deformable parts of the trunk, point masses on slides of a segment.
//!
//! Each has two state variables, s and ṡ, before all others ([`crate::motion::skeleton::Slide`] moves them). Bands
//! (`law`) resist their deflections; what rides on them passes on its forces with its shares (`Load::ride`). The
//! kernel's sweep finds s̈ from the difference.

mod check;
mod data;
mod law;
mod past;
mod results;

use crate::body::Body;
use crate::forces::element::{Element, HeldBy, Instant, Load, StoredEnergy, Unlike, WorkSum};
use crate::forces::list::STORES;
use crate::forces::rate::Rate;
use crate::forces::sphere::Site;
use crate::motion::layout::MOST_SLIDES;
use crate::motion::mobility::Mobility;
use crate::motion::scalar::Scalar;
use crate::quantity::energy;
pub(crate) use check::rides;
pub use data::{Band, Damper, PlateData};
pub(crate) use law::DEEP;
pub use law::PlateLaws;
pub use past::BandPast;
use placed_text::Problems;
pub use results::PlateAction;

/// Index of the work that plates absorb, ∫ΣSṡ.
const WORK: usize = 7;

/// Speed of a plate at which its quadratic damper enters the rates, m/s: that of a hub test.
const TOLD_M_S: f64 = 7.0;

const OTHER_PLATES: Unlike = Unlike("the plates are others, or their bands have other numbers of points");

/// The kind of force element: plates.
#[derive(Clone, Copy, Debug)]
pub struct Plates;

impl Element for Plates {
    const OPTIONAL: bool = true;
    const STORED: &'static [StoredEnergy] = &[StoredEnergy {
        at: 7,
        quantity: energy(21, "plates", "stored in plates of the trunk", "recoverable, in plates of the trunk"),
        held_by: HeldBy::sum(WORK, 69, "start_plates_j", "stored in plates at the start of the run"),
    }];
    const SUMS: &'static [WorkSum] = &[WorkSum {
        at: WORK,
        quantity: energy(
            22,
            "lost_plates",
            "dissipated by plates",
            "dissipated by plates of the trunk since the start",
        ),
    }];
    const NAMES: [&'static str; 2] = ["plate", "plates"];

    type Data<'a> = PlateData<'a>;
    type Law<S> = PlateLaws<S>;
    type Past<S> = BandPast<S>;
    type Hints<S: Scalar> = ();
    type Action<S> = PlateAction<S>;

    fn check(data: PlateData<'_>, body: &Body, problems: &mut Problems) {
        check::check(&data, body, problems);
    }

    fn new(data: PlateData<'_>, body: &Body) -> PlateLaws<f64> {
        PlateLaws::new(&data, body)
    }

    fn own(law: &mut PlateLaws<f64>, numbers: &mut Vec<f64>) {
        law.own(numbers);
    }

    fn start(law: &PlateLaws<f64>, _at: &Instant<'_, f64>) -> Vec<BandPast<f64>> {
        law.bands.iter().map(|_| BandPast::none()).collect()
    }

    fn hints<S: Scalar>(_law: &PlateLaws<S>) {}

    fn count<S>(law: &PlateLaws<S>) -> usize {
        law.bands.len()
    }

    fn most_actions<S>(law: &PlateLaws<S>) -> usize {
        law.segments.len()
    }

    fn zip<S: Copy, A: Copy, T>(
        one: &PlateLaws<S>,
        other: &PlateLaws<A>,
        f: &impl Fn(S, A) -> T,
    ) -> Result<PlateLaws<T>, Unlike> {
        one.zip(other, f).ok_or(OTHER_PLATES)
    }

    fn each<S, A>(one: &mut BandPast<S>, other: &mut BandPast<A>, f: &mut impl FnMut(&mut S, &mut A)) {
        one.greatest.iter_mut().zip(&mut other.greatest).for_each(|(one, other)| f(one, other));
    }

    fn map<A: Copy, S>(past: &BandPast<A>, f: &mut impl FnMut(A) -> S) -> BandPast<S> {
        BandPast { greatest: past.greatest.map(f) }
    }

    fn is_possible(_law: &PlateLaws<f64>, _number: usize, past: &BandPast<f64>) -> bool {
        past.greatest.iter().all(|way| *way >= 0.0)
    }

    fn confine(past: &mut BandPast<f64>) {
        past.greatest = past.greatest.map(|way| way.max(0.0));
    }

    #[inline(always)]
    fn apply<S: Scalar>(
        law: &PlateLaws<S>,
        at: &Instant<'_, S>,
        past: &mut [BandPast<S>],
        _hints: &mut (),
        load: &mut Load<S>,
        show: &mut impl FnMut(&PlateAction<S>),
    ) {
        if law.segments.is_empty() {
            return;
        }
        let mut stored = [S::zero(); MOST_SLIDES];
        if at.k.sliding > 0 {
            resist(law, at, past, load, &mut stored);
        }
        for (i, deep) in law.deep.iter().enumerate().take(MOST_SLIDES) {
            let slid = &at.k.slides[i];
            let deep = S::select(slid.way.gt(*deep), S::one(), S::zero());
            let (deflection, speed, force, stored) = (slid.way, slid.speed, load.resist[i], stored[i]);
            show(&PlateAction { deflection, speed, force, stored, deep });
        }
    }

    /// Springs and dampers of bands against the masses of their plates alone.
    fn rates(
        data: PlateData<'_>,
        _body: &Body,
        _at: &Instant<'_, f64>,
        _actions: &[PlateAction<f64>],
        _mobility: &Mobility<'_>,
    ) -> Vec<Rate> {
        let of = |band: &Band| {
            let give: f64 = band.of.iter().map(|(plate, a)| a * a / data.plates[*plate].mass_kg).sum();
            let steepest = band.spring.steepest() + band.viscous.map_or(0.0, |[stiffness, _]| stiffness);
            let Damper { linear_n_s_m, quadratic_n_s2_m2, outward_n_s_m } = band.damper;
            let damping = outward_n_s_m.max(linear_n_s_m + 2.0 * quadratic_n_s2_m2 * TOLD_M_S);
            let spring = Rate::of_spring(band.name.clone(), Self::NAMES[0].to_owned(), 1.0 / give, steepest);
            [Some(spring), Rate::of_damper(&band.name, 1.0 / give, damping)]
        };
        data.bands.iter().flat_map(of).flatten().collect()
    }

    fn segment(law: &PlateLaws<f64>, _: &[Site<f64>], number: usize, _: &PlateAction<f64>) -> usize {
        law.segments[number]
    }

    fn stored_j(actions: &[PlateAction<f64>], stored_j: &mut [f64; STORES]) {
        stored_j[Self::STORED[0].at] = actions.iter().map(|plate| plate.stored).sum();
    }
}

/// Resistances of all plates with their powers, and the stored energies; that of a link counts with its first plate.
#[inline(always)]
fn resist<S: Scalar>(
    law: &PlateLaws<S>,
    at: &Instant<'_, S>,
    past: &mut [BandPast<S>],
    load: &mut Load<S>,
    stored: &mut [S; MOST_SLIDES],
) {
    for (band, past) in law.bands.iter().zip(past) {
        let moved = band.moved(at.k);
        if at.accepted {
            past.commit(moved[0]);
        }
        let now = band.now(moved, past, at.state.own(), &mut load.own);
        for (plate, factor) in &band.of {
            load.resist[*plate % MOST_SLIDES] += *factor * now.force;
        }
        if let Some((first, _)) = band.of.first() {
            stored[*first % MOST_SLIDES] += now.stored;
            load.power_at(law.segments[*first]).sums[WORK] += now.force * moved[1];
        }
    }
}
