//! A run in its place beside others.

use crate::forces::contact::Touch;
use crate::forces::marks::Marks;
use crate::forces::shown::Tracker;
use crate::kernel::instruments::Reading;
use crate::model::Model;
use crate::motion::frame::Frames;
use crate::motion::lanes::Lanes;
use crate::motion::vector::{V3, v3};
use crate::results::outcome::{Outcome, RecordingFailed, Status};
use crate::results::recorder::{Flow, Recorder};
use crate::run::adaptive::Control;
use crate::run::corner::Touching;
use crate::run::observers::{Felt, Meeting};
use crate::run::simulate::go_on;
use crate::run::{Course, Step, Stretch};

/// A run at its index; tag and recorder of its job stay with the [`Jobs`](super::Jobs).
pub(super) struct Place {
    pub model: Model,
    pub run: Course,
    /// Steps to the next output.
    stretch: Stretch,
    step_s: f64,
    /// Planned step.
    whole: Step,
    /// All of it, or the part that near pairs permit.
    pub step: Step,
    /// The step before it, if the run can go back to it, and the planned steps then.
    pub latest: Option<Step>,
    before: (Stretch, [Step; 2]),
    /// Buffer for the frames of one instant.
    pub frames: Frames<f64>,
    /// Data of a run under error control.
    pub control: Option<Control>,
    /// Whether the present evaluation is at the start of its step.
    pub looks: bool,
    /// Whether an element has switched by the end of its latest trial.
    pub jumps: bool,
    /// With steps of fixed length, where the memory in lanes may differ from the run's. Under error control, where the
    /// memory at the start of the latest step may differ from the one last fetched, and that one from the one of the latest
    /// output.
    pub behind: Marks,
    pub unseen: Marks,
    /// Under error control, where the memories at the end of the latest step and of the trial may differ from those last
    /// fetched.
    pub unread: Marks,
}

/// Continuation of a run after a step or an output.
pub(super) enum Next {
    GoesOn,
    Ends(Result<Status, RecordingFailed>),
}

impl Next {
    pub(super) fn ended(status: Status) -> Self {
        Next::Ends(Ok(status))
    }
}

impl Place {
    /// A run of `model` at its start.
    pub(super) fn new(model: Model) -> Self {
        let (run, integrator) = (Course::new(&model), &model.setup().integrator);
        let (step_s, control) = (integrator.longest_step_s(), Control::of(integrator));
        let stretch = Stretch::new(run.time_s, run.time_s, step_s);
        let (whole, step) = (Step::default(), Step::default());
        let (frames, before) = (Frames::still(run.time_s), (stretch, [whole, step]));
        let (latest, looks, jumps) = (None, false, false);
        let [behind, unseen, unread] = [(); 3].map(|()| run.history.changed().blank());
        Place {
            frames,
            model,
            stretch,
            run,
            step_s,
            whole,
            step,
            latest,
            before,
            control,
            looks,
            jumps,
            behind,
            unseen,
            unread,
        }
    }

    /// Notes that the memory in lanes may differ from the run's anywhere.
    pub(super) fn differs_anywhere(&mut self) {
        self.behind.set_all(self.run.history.memory.contacts.len());
    }

    /// First output.
    pub(super) fn begin(&mut self, recorder: &mut dyn Recorder) -> Next {
        match self.run.begin(&self.model, recorder) {
            Ok(()) => self.output(recorder),
            Err(error) => Next::Ends(Err(error)),
        }
    }

    /// Records an output and continues with the next.
    pub(super) fn output(&mut self, recorder: &mut dyn Recorder) -> Next {
        match self.run.record(&self.model, recorder) {
            Err(error) => return Next::Ends(Err(error)),
            Ok(Flow::Stop) => return Next::ended(Status::Stopped),
            Ok(Flow::Continue) => {}
        }
        let Some(target_s) = self.run.next_output_s(&self.model) else {
            return Next::ended(Status::Completed);
        };
        self.stretch = Stretch::new(self.run.time_s, target_s, self.step_s);
        self.latest = None;
        Next::GoesOn
    }

    /// Rest of the present step; none after its end.
    fn left(&self) -> Option<Step> {
        let start_s = self.step.end_s;
        (start_s < self.whole.end_s).then_some(Step { start_s, ..self.whole })
    }

    /// Next step, which may have to end earlier; none at an output.
    pub(super) fn next_step(&mut self) -> Option<Step> {
        self.before = (self.stretch, [self.whole, self.step]);
        if let Some(left) = self.left() {
            return Some(left);
        }
        self.whole = self.stretch.next()?;
        Some(self.whole)
    }

    /// Reverts the present step and restores the one before it.
    pub(super) fn go_back(&mut self, latest: Step) -> Next {
        (self.stretch, [self.whole, self.step]) = self.before;
        match self.run.go_back(&self.model, latest) {
            Ok(()) => Next::GoesOn,
            Err(error) => Next::ended(Status::Failed(error)),
        }
    }

    /// Accepts the present step, except its state; `phase` gives the memory of pairs.
    pub(super) fn take_step(&mut self, phase: impl Fn(usize) -> f64) {
        self.run.effort.evaluations += 4;
        self.run.note(&self.model, self.step.start_s, phase);
    }

    /// Whether an output is reached.
    pub(super) fn is_at_output(&self) -> bool {
        self.left().is_none() && self.stretch.is_over()
    }

    /// Rest of the run, alone.
    pub(super) fn finish(&mut self, recorder: &mut dyn Recorder) -> Result<Status, RecordingFailed> {
        let target_s = self.run.next_output_s(&self.model);
        let advanced = match target_s.filter(|_| self.control.is_some()) {
            Some(target_s) => self.run.advance_to(&self.model, target_s),
            None => self.run.advance_rk4(&self.model, self.left(), self.stretch),
        };
        match advanced {
            Err(error) => Ok(Status::Failed(error)),
            Ok(()) => go_on(&self.model, &mut self.run, recorder),
        }
    }

    /// Model and outcome of its run.
    pub(super) fn end(
        self,
        status: Result<Status, RecordingFailed>,
        recorder: &mut dyn Recorder,
    ) -> (Model, Result<Outcome, RecordingFailed>) {
        (self.model, status.and_then(|status| self.run.end(status, recorder)))
    }
}

/// Instant of an evaluation.
#[derive(Clone, Copy)]
pub(super) enum Sees {
    /// Start of steps of fixed length.
    Start,
    /// Front, of those runs that look.
    Front,
    /// End of a trial.
    Trial,
}

/// Notes contacts and readings of every run.
pub(crate) struct Witness<'a> {
    places: &'a mut [Option<Box<Place>>],
    sees: Sees,
}

impl<'a> Witness<'a> {
    pub(super) fn of(places: &'a mut [Option<Box<Place>>], sees: Sees) -> Self {
        Witness { places, sees }
    }

    /// Buffers for contacts and readings of the observed runs, with their lanes.
    fn notes(&mut self) -> impl Iterator<Item = (usize, &mut Vec<Touching>, &mut Felt)> {
        let sees = self.sees;
        self.places.iter_mut().enumerate().filter_map(move |(i, place)| {
            let Place { run, looks, .. } = &mut **place.as_mut()?;
            let front = run.front.as_mut();
            let (met, felt) = match sees {
                Sees::Start => (&mut run.met, &mut run.felt),
                Sees::Front => front.filter(|_| *looks).map(|front| (&mut front.met, &mut front.felt))?,
                Sees::Trial => front.map(|front| (&mut front.met_in_trial, &mut front.felt_in_trial))?,
            };
            Some((i, met, felt))
        })
    }

    /// Starts a separate instant.
    pub(super) fn anew(&mut self) -> &mut Self {
        for (_, met, felt) in self.notes() {
            met.clear();
            felt.numbers.clear();
        }
        self
    }

    /// Readings of the instruments of a body.
    #[inline(never)]
    pub(super) fn feel<L: Lanes>(&mut self, of: usize, reading: &Reading<L>) {
        for (i, _, felt) in self.notes() {
            for (to, number) in felt.readings[of].iter_mut().zip(reading) {
                *to = number.lane(i);
            }
        }
    }
}

// by themselves: what calls them is inlined then where lanes are computed
impl<L: Lanes> Tracker<L> for &mut Witness<'_> {
    #[inline(never)]
    fn number(&mut self, number: L) {
        self.numbers(&[number]);
    }

    #[inline(never)]
    fn numbers(&mut self, numbers: &[L]) {
        for (i, _, felt) in self.notes() {
            felt.numbers.extend(numbers.iter().map(|number| number.lane(i)));
        }
    }

    #[inline(never)]
    fn touch(&mut self, touch: &Touch<L>) {
        // by reference: a copy of all lanes for each one is what this took most time for
        let vector = |v: &V3<L>, i: usize| v3(v.x.lane(i), v.y.lane(i), v.z.lane(i));
        for (i, met, _) in self.notes() {
            if touch.weight.lane(i) > 0.0 {
                let meeting = Meeting {
                    sphere: touch.sphere,
                    pair: touch.pair,
                    part: touch.part.lane(i) as usize,
                    closing_m_s: touch.closing.lane(i),
                    normal_force_n: touch.normal_force.lane(i),
                    velocity_m_s: vector(&touch.velocity, i),
                    depth_m: touch.depth.lane(i),
                    force_n: vector(&touch.force, i),
                    normal: vector(&touch.normal, i),
                };
                met.push(Touching { meeting });
            }
        }
    }
}
