//! Yielding frames with a mass, which bodies and bags push along an axis (a steering column) or about one (a hinge).
//!
//! The state contains position and speed of each (`law`), and its absorbed work. A column moves its frame before any
//! force is computed; forces on that frame are gathered by body (`Load::push`) and act on the column after all others.
//! Its memory (`past`) is its largest stroke, which stays.

mod check;
mod data;
mod law;
mod past;
mod results;

use crate::body::Body;
use crate::forces::element::{Element, Instant, Load, MOST_GIVING, StoredEnergy, Unlike, WorkSum};
use crate::forces::list::{Forces, STORES};
use crate::forces::rate::Rate;
use crate::forces::sphere::Site;
use crate::motion::frame::Frames;
use crate::motion::mobility::Mobility;
use crate::motion::scalar::Scalar;
use crate::motion::state::State;
use crate::quantity::Quantity;
pub use data::{Column, ColumnData, Hinge};
pub use law::ColumnLaw;
use occupant_units::unit::Unit;
pub use past::ColumnPast;
use placed_text::Problems;
pub use results::ColumnAction;

/// Index of the work absorbed by columns.
const WORK: usize = 6;

const OTHER_COLUMNS: Unlike = Unlike("the columns carry other frames or have other numbers of points of their force");

/// A kind of force element: frames that yield along an axis, or about one.
#[derive(Clone, Copy, Debug)]
pub struct Giving<const TURNS: bool>;
/// Steering columns.
pub type Columns = Giving<false>;
/// Hinges, such as seat recliners.
pub type Hinges = Giving<true>;

impl<const TURNS: bool> Giving<TURNS> {
    /// Columns and hinges share one work sum.
    const WORK: &'static [WorkSum] = &[WorkSum {
        at: WORK,
        quantity: Quantity::number(Unit::Joule, |taken_j: &f64| *taken_j)
            .channel("columns", "work taken up by columns and hinges")
            .field(
                19,
                "columns",
                "work that columns and hinges took up since the start, of bodies and of their own weight",
            ),
    }];
}

impl<const TURNS: bool> Element for Giving<TURNS> {
    const OPTIONAL: bool = true;
    const SHARES: &'static [usize] = if TURNS { &[WORK] } else { &[] };
    const STORED: &'static [StoredEnergy] = &[];
    const SUMS: &'static [WorkSum] = if TURNS { &[] } else { Self::WORK };
    const NAMES: [&'static str; 2] = if TURNS { ["hinge", "hinges"] } else { ["column", "columns"] };

    type Data<'a> = ColumnData<'a>;
    type Law<S> = Vec<ColumnLaw<S>>;
    type Past<S> = ColumnPast<S>;
    type Hints<S: Scalar> = ();
    type Action<S> = ColumnAction<S>;

    fn check(data: ColumnData<'_>, _body: &Body, problems: &mut Problems) {
        data.those(TURNS).for_each(|(_, column)| check::data(column, problems));
    }

    fn new(data: ColumnData<'_>, _body: &Body) -> Vec<ColumnLaw<f64>> {
        data.those(TURNS).map(|column| ColumnLaw::new(column, &data)).collect()
    }

    fn own(law: &mut Vec<ColumnLaw<f64>>, numbers: &mut Vec<f64>) {
        law.iter_mut().for_each(|column| column.own(numbers));
    }

    fn start(law: &Vec<ColumnLaw<f64>>, _at: &Instant<'_, f64>) -> Vec<ColumnPast<f64>> {
        law.iter().map(|_| ColumnPast::none()).collect()
    }

    fn hints<S: Scalar>(_law: &Vec<ColumnLaw<S>>) {}

    fn count<S>(law: &Vec<ColumnLaw<S>>) -> usize {
        law.len()
    }

    fn zip<S: Copy, A: Copy, T>(
        one: &Vec<ColumnLaw<S>>,
        other: &Vec<ColumnLaw<A>>,
        f: &impl Fn(S, A) -> T,
    ) -> Result<Vec<ColumnLaw<T>>, Unlike> {
        let all = (one.len() == other.len()).then(|| one.iter().zip(other).map(|(a, b)| a.zip(b, f)).collect());
        all.flatten().ok_or(OTHER_COLUMNS)
    }

    fn each<S, A>(one: &mut ColumnPast<S>, other: &mut ColumnPast<A>, f: &mut impl FnMut(&mut S, &mut A)) {
        one.each(other, f);
    }

    fn map<A: Copy, S>(past: &ColumnPast<A>, f: &mut impl FnMut(A) -> S) -> ColumnPast<S> {
        past.map(f)
    }

    fn is_possible(_law: &Vec<ColumnLaw<f64>>, _number: usize, past: &ColumnPast<f64>) -> bool {
        past.greatest >= 0.0
    }

    fn failure(data: ColumnData<'_>, law: &Vec<ColumnLaw<f64>>, past: &[ColumnPast<f64>]) -> Option<String> {
        let all = data.those(TURNS).zip(law).zip(past);
        all.into_iter().find_map(|(((_, column), law), past)| law.overrun(&column.name, past))
    }

    fn confine(past: &mut ColumnPast<f64>) {
        past.greatest = past.greatest.max(0.0);
    }

    #[inline(always)]
    fn apply<S: Scalar>(
        law: &Vec<ColumnLaw<S>>,
        at: &Instant<'_, S>,
        past: &mut [ColumnPast<S>],
        _hints: &mut (),
        load: &mut Load<S>,
        show: &mut impl FnMut(&ColumnAction<S>),
    ) {
        for (column, past) in law.iter().zip(past) {
            act(column, at, past, load, show);
        }
    }

    fn rates(
        data: ColumnData<'_>,
        body: &Body,
        _at: &Instant<'_, f64>,
        _actions: &[ColumnAction<f64>],
        _mobility: &Mobility<'_>,
    ) -> Vec<Rate> {
        let rate = |((_, column), law): ((usize, &Column), ColumnLaw<f64>)| {
            Rate::of_spring(column.name.clone(), Self::NAMES[0].to_owned(), column.inertia(), law.stiffness)
        };
        data.those(TURNS).zip(Self::new(data, body)).map(rate).collect()
    }

    /// It has no stored energy in a body's ledger.
    fn segment(_: &Vec<ColumnLaw<f64>>, _: &[Site<f64>], _: usize, _: &ColumnAction<f64>) -> usize {
        0
    }

    fn stored_j(_actions: &[ColumnAction<f64>], _stored_j: &mut [f64; STORES]) {}
}

impl<S> Forces<S> {
    /// Whether any frame yields.
    pub(crate) fn gives(&self) -> bool {
        !(self.columns.is_empty() && self.hinges.is_empty())
    }

    /// Yielding frames, in order.
    pub(crate) fn giving(&self) -> impl Iterator<Item = usize> {
        let all = || self.columns.iter().chain(&self.hinges);
        (0..MOST_GIVING).filter_map(move |place| all().find(|one| one.place == place).map(|one| one.frame))
    }
}

/// Moves the frames of columns, which `frames` contains as carried by their parents, by their strokes.
#[inline(always)]
pub(crate) fn carry<S: Scalar>(law: &[ColumnLaw<S>], state: &State<S>, frames: &mut Frames<S>) {
    for column in law {
        column.carry(state, frames);
    }
}

/// Action of a column. The work of a body along the stroke, booked as done on the frame, is the column's; the work of
/// the parent's motion on the hub is booked on both sides of the first body.
#[inline(always)]
fn act<S: Scalar>(
    law: &ColumnLaw<S>,
    at: &Instant<'_, S>,
    past: &mut ColumnPast<S>,
    load: &mut Load<S>,
    show: &mut impl FnMut(&ColumnAction<S>),
) {
    let Some(own) = law.moved(at.state) else {
        return show(&ColumnAction::idle());
    };
    if at.accepted {
        past.greatest = past.greatest.max(own[0]);
    }
    let (now, drag) = (law.now(own, past), law.drag(at, own[1]));
    let (speed, mut push) = (own[1], S::zero());
    let bodies = load.bodies();
    for (onto, power) in load.onto.iter().zip(&mut load.power).take(bodies) {
        let along = law.along(at, &onto[law.place % MOST_GIVING]);
        push += along;
        power.sums[WORK] += along * speed;
        power.vehicle += along * speed;
    }
    let [power, ..] = &mut load.power;
    power.sums[WORK] -= drag * speed;
    power.vehicle -= drag * speed;
    law.flow(&now, push, drag, &mut load.own);
    if at.accepted {
        past.residual = past.residual.max((own[2] - now.stored - now.lost).abs());
        past.taken = past.taken.max(own[2]);
    }
    show(&ColumnAction::new(&now, push, past));
}
