//! The constants and the start of a model, and how they change with a parameter.
//!
//! Masses, planes, force laws, the seated body, unstretched belts, the vehicle's motion at an instant: all are smooth
//! closed functions of the numbers of a scenario, so their slopes are taken by extrapolated differences of models
//! ([`super::ladder`]). The motion is never differenced.

use std::array::from_fn;
use std::cell::{Cell, RefCell};

use super::ladder::{Ladder, POINTS, Slope};
use super::parameter::{Family, Parameter};
use super::trouble::Trouble;
use occupant_core::forces::{History, Memory};
use occupant_core::kernel::System;
use occupant_core::model::{Model, ROUNDING_S};
use occupant_core::motion::dual::Dual;
use occupant_core::motion::frame::{Frames, Moving, VEHICLE};
use occupant_core::motion::state::State;
use occupant_core::vehicle::PathCursor;

/// Step of the differences, relative to the parameter's size.
const STEP: f64 = 1e-3;
/// Relative difference of two extrapolations above which there is no slope.
const ROUGH: f64 = 1e-2;
/// Scale for relative differences of smaller numbers, which may be rounding errors.
const SMALL: f64 = 1e-6;
/// Number of components of a frame's motion.
const MOTION: usize = 24;
/// Components that all forces depend on; the rest are accelerations, which may jump.
const PLACE_AND_SPEED: usize = 18;

/// Derivatives of a model's numbers with respect to parameters.
#[derive(Clone, Debug)]
pub struct Built {
    system: Vec<f64>,
    state: Vec<f64>,
    history: Vec<f64>,
    /// Times at which steps end and how they shift, s and s per unit, in increasing order.
    shifts: Vec<[f64; 2]>,
    path: Option<Path>,
    /// Largest difference of two extrapolations, relative to the number or its change.
    pub doubt: f64,
    /// Notes for the user.
    pub notes: Vec<String>,
}

/// Vehicle frames of models at the points of a ladder.
#[derive(Clone, Debug)]
struct Path {
    ladder: Ladder,
    models: Vec<Model>,
    cursors: Vec<PathCursor>,
    size: f64,
    /// Largest difference of two extrapolations, and its time, s.
    doubt: (f64, f64),
}

impl Built {
    /// Derivatives of everything that `base` is built from.
    ///
    /// # Errors
    /// Models beside the parameter's value that are refused or of another structure; a start that is not smooth.
    pub fn new(base: &Model, parameter: &Parameter<'_>) -> Result<Self, Trouble> {
        if !(parameter.nominal.is_finite() && parameter.size > 0.0 && parameter.size.is_finite()) {
            let (value, size) = (parameter.nominal, parameter.size);
            let found = format!("`{}` has the value {value} and the size {size}", parameter.name);
            return Err(Trouble::Parameter(found + "; expected a finite value and a size above 0"));
        }
        let family = Family::new(base, parameter, STEP * parameter.size)?;
        let mut doubt = 0.0_f64;
        let mut slopes = |of: &dyn Fn(&Model) -> Vec<f64>| {
            let at_base = of(base);
            let values: Vec<Vec<f64>> = family.models.iter().map(of).collect();
            let slopes = family.ladder.slopes(&at_base, &values);
            for (slope, value) in slopes.iter().zip(&at_base) {
                doubt = doubt.max(relative(slope, *value, parameter.size));
            }
            slopes.iter().map(|s| s.value).collect::<Vec<f64>>()
        };
        let system = slopes(&|m| system_numbers(m.system()));
        let state = slopes(&|m| m.start().state.numbers().to_vec());
        let history = slopes(&|m| remembered(&m.start().history.memory));
        let mut notes = Vec::new();
        let times_s = base.each_break_s();
        let beside: Vec<Vec<f64>> = family.models.iter().map(Model::each_break_s).collect();
        let shifts = if beside.iter().all(|others_s| others_s.len() == times_s.len()) {
            let mut shifts = Vec::with_capacity(times_s.len());
            for (slope, time_s) in family.ladder.slopes(&times_s, &beside).iter().zip(&times_s) {
                let off = relative(slope, *time_s, parameter.size);
                let is_rough = off.is_nan() || off > ROUGH;
                // where a pulse just stops the vehicle, less speed stops it earlier by the root of the change, more not at all
                shifts.push(if is_rough { 0.0 } else { slope.value });
                match (is_within(base, *time_s), is_rough) {
                    (true, true) => notes.push(format!(
                        "{}: the event at {:.3} ms shifts with it, but not in proportion; the shift is ignored",
                        parameter.name,
                        time_s * 1e3
                    )),
                    (true, false) => doubt = doubt.max(off),
                    (false, _) => {}
                }
            }
            in_order(times_s, shifts)
        } else {
            notes.push(format!(
                "{}: close to its value other devices fire, or other corners of a path apply",
                parameter.name
            ));
            Vec::new()
        };
        if let Some(time_s) = coincidence(base, &shifts) {
            notes.push(format!(
                "{}: two events coincide at {:.3} ms and it separates them, so the two sides differ",
                parameter.name,
                time_s * 1e3
            ));
        }
        if let Some(reason) = &family.one_sided {
            let reason = reason.lines().next().unwrap_or_default();
            notes.push(format!(
                "{}: a derivative to one side only, because the other is invalid: {reason}",
                parameter.name
            ));
        }
        let phases = |m: &Model| m.start().history.memory.contacts.iter().map(|p| p.phase.to_bits()).collect();
        let at_base: Vec<u64> = phases(base);
        if family.models.iter().any(|m| phases(m) != at_base) {
            notes.push(format!(
                "{}: within {:.1} % of its value, other spheres touch at the start",
                parameter.name,
                STEP * 100.0
            ));
        }
        if doubt.is_nan() || doubt > ROUGH {
            return Err(Trouble::Rough { parameter: parameter.name.clone(), doubt });
        }
        Ok(Built { system, state, history, shifts, path: Path::new(base, family, parameter.size), doubt, notes })
    }

    /// Whether it belongs to a model of this structure.
    pub(super) fn is_of(&self, model: &Model) -> bool {
        let start = model.start();
        let counts = [system_numbers(model.system()).len(), start.state.numbers().len()];
        counts == [self.system.len(), self.state.len()] && remembered(&start.history.memory).len() == self.history.len()
    }

    /// Shift of a step's end at a time, s per unit; of coincident events the last in the order of the setup.
    pub(super) fn shift(&self, time_s: f64) -> f64 {
        let from = self.shifts.partition_point(|[at_s, _]| *at_s < time_s - ROUNDING_S);
        let here = self.shifts[from..].iter().take_while(|[at_s, _]| *at_s <= time_s + ROUNDING_S);
        here.last().map_or(0.0, |[_, shift]| *shift)
    }

    /// Largest difference of two extrapolations of the vehicle's motion and its time, s; none if the parameter does not
    /// affect the path.
    pub fn path_doubt(&self) -> Option<(f64, f64)> {
        self.path.as_ref().map(|p| p.doubt)
    }
}

/// Times with their shifts in increasing order; a stable sort.
fn in_order(times_s: Vec<f64>, shifts: Vec<f64>) -> Vec<[f64; 2]> {
    let mut list: Vec<[f64; 2]> = times_s.into_iter().zip(shifts).map(|(time_s, shift)| [time_s, shift]).collect();
    list.sort_by(|a, b| a[0].total_cmp(&b[0]));
    list
}

/// Whether a time is inside the run of a model, before its end.
fn is_within(base: &Model, time_s: f64) -> bool {
    let time = &base.setup().time;
    time.start_s < time_s && time_s < time.end_s
}

/// The first time within the run at which two coincident events shift differently, s.
fn coincidence(base: &Model, shifts: &[[f64; 2]]) -> Option<f64> {
    let within = |[a, b]: [[f64; 2]; 2]| b[0] - a[0] <= ROUNDING_S && is_within(base, a[0]);
    let apart = |[a, b]: [[f64; 2]; 2]| (a[1] - b[1]).abs() > ROUGH * a[1].abs().max(b[1].abs());
    let mut pairs = shifts.windows(2).map(|pair| [pair[0], pair[1]]);
    pairs.find(|pair| within(*pair) && apart(*pair)).map(|[a, _]| a[0])
}

/// Difference of two extrapolations of a slope, relative to the change for a change of `size`, or to the number.
fn relative(slope: &Slope, value: f64, size: f64) -> f64 {
    let scale = (slope.value * size).abs().max(value.abs()).max(SMALL);
    if scale.is_finite() { slope.doubt * size / scale } else { 0.0 }
}

impl Path {
    fn new(base: &Model, family: Family, size: f64) -> Option<Self> {
        let base = base.setup();
        let is_same = |m: &Model| (&m.setup().path, &m.setup().frames) == (&base.path, &base.frames);
        if family.models.iter().all(is_same) {
            return None;
        }
        Some(Path {
            ladder: family.ladder,
            cursors: vec![PathCursor::default(); family.models.len()],
            models: family.models,
            size,
            doubt: (0.0, 0.0),
        })
    }

    /// Frames of all models at a time.
    fn frames(&mut self, t_s: f64, middle_s: f64) -> Vec<Frames<f64>> {
        let models = self.models.iter().zip(&mut self.cursors);
        models.map(|(model, cursor)| model.frames(t_s, middle_s, cursor)).collect()
    }

    /// Derivatives of a frame's motion, whose numbers are `at_base`.
    fn slopes(&mut self, at_base: &[f64; MOTION], all: &[Frames<f64>], frame: usize, t_s: f64) -> [f64; MOTION] {
        let mut values = [[0.0; MOTION]; POINTS];
        for (values, frames) in values.iter_mut().zip(all) {
            *values = motion_numbers(&frames[frame]);
        }
        let count = all.len();
        from_fn(|i| {
            let column: [f64; POINTS] = from_fn(|point| values[point][i]);
            let slope = self.ladder.slope(at_base[i], &column[..count]);
            let doubt = slope.doubt * self.size / (slope.value * self.size).abs().max(1.0);
            if i < PLACE_AND_SPEED && doubt > self.doubt.0 {
                self.doubt = (doubt, t_s);
            }
            slope.value
        })
    }
}

/// The numbers of a system in the order of [`System::zip`].
fn system_numbers(system: &System<f64>) -> Vec<f64> {
    let list = RefCell::new(Vec::new());
    // a system is like itself
    let _itself = system.zip(system, |x, _| list.borrow_mut().push(x));
    list.into_inner()
}

/// Numbers of the stored state of force elements, in the order of [`Memory::each`], the phases of pairs as 0.
fn remembered(memory: &Memory<f64>) -> Vec<f64> {
    let mut memory = memory.clone();
    for pair in &mut memory.contacts {
        pair.phase = 0.0;
    }
    let mut list = Vec::new();
    memory.map(&mut |x| list.push(x));
    list
}

fn motion_numbers(motion: &Moving<f64>) -> [f64; MOTION] {
    let mut numbers = [0.0; MOTION];
    let mut places = numbers.iter_mut();
    motion.clone().each(motion, &mut |_, x| {
        if let Some(place) = places.next() {
            *place = x;
        }
    });
    numbers
}

/// The dual number at position `at`, which is advanced by one.
fn next<const N: usize>(value: f64, at: &Cell<usize>, slope: impl Fn(usize, usize) -> f64) -> Dual<N> {
    let place = at.get();
    at.set(place + 1);
    Dual::new(value, from_fn(|k| slope(k, place)))
}

/// The system of `model` in dual numbers; direction k is that of `built[k]`, further directions are zero.
pub(super) fn dual_system<const N: usize>(model: &Model, built: &[Built]) -> Result<System<Dual<N>>, Trouble> {
    let at = Cell::new(0);
    let slope = |k: usize, i: usize| built.get(k).map_or(0.0, |b| b.system[i]);
    let system = model.system();
    let dual = system.zip(system, |x, _| next(x, &at, slope));
    // a system is like itself
    dual.map_err(|unlike| Trouble::Output(unlike.to_string()))
}

/// Initial state in dual numbers.
pub(super) fn dual_state<const N: usize>(model: &Model, built: &[Built]) -> State<Dual<N>> {
    let start = &model.start().state;
    let mut dual = start.zip(start, |x, _| Dual::new(x, [0.0; N]));
    for (k, built) in built.iter().enumerate().take(N) {
        for (x, slope) in dual.numbers_mut().iter_mut().zip(&built.state) {
            x.slopes[k] = *slope;
        }
    }
    dual
}

/// Initial history in dual numbers.
pub(super) fn dual_history<const N: usize>(
    model: &Model,
    system: &System<Dual<N>>,
    built: &[Built],
) -> History<Dual<N>> {
    let at = Cell::new(0);
    let slope = |k: usize, i: usize| built.get(k).map_or(0.0, |b| b.history[i]);
    History::new(&system.forces, model.start().history.memory.map(&mut |value| next(value, &at, slope)))
}

/// Frames at `t_s` in dual numbers.
pub(super) fn dual_frames<const N: usize>(
    plain: &Frames<f64>,
    built: &mut [Built],
    t_s: f64,
    middle_s: f64,
) -> Frames<Dual<N>> {
    let still = |x: f64, _: f64| Dual::new(x, [0.0; N]);
    let mut dual = plain.zip(plain, &still);
    for (k, built) in built.iter_mut().enumerate().take(N) {
        let Some(path) = &mut built.path else { continue };
        let all = path.frames(t_s, middle_s);
        let others = path.models.first().map_or(0, |model| model.setup().frames.len());
        for frame in VEHICLE..=VEHICLE + others {
            let slopes = path.slopes(&motion_numbers(&plain[frame]), &all, frame, t_s);
            let mut places = slopes.iter();
            dual[frame].each(&plain[frame], &mut |x: &mut Dual<N>, _| {
                x.slopes[k] = places.next().copied().unwrap_or(0.0);
            });
        }
    }
    dual
}
