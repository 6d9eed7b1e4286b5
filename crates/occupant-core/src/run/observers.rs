//! Observers of evaluations: contacts, force elements, instruments.

use crate::forces::Actions;
use crate::forces::contact::{PairHistory, Touch};
use crate::forces::shown::Tracker;
use crate::kernel::instruments::{PLACE, READINGS, Reading};
use crate::model::Model;
use crate::model::behind::restraints;
use crate::motion::kinematics::Kinematics;
use crate::motion::vector::V3;
use crate::results::checkpoint::Checkpoint;
use crate::results::fine::Fine;
use crate::results::outcome::FirstTouch;
use crate::results::peaks::{EXCURSIONS, FELT, Peaks};
use crate::results::rear;
use crate::results::sample::Switched;
use crate::results::summary::Peak;
use crate::run::bars::Bars;
use crate::run::changes::Changes;
use crate::run::corner::Touching;
use crate::vehicle::PathCursor;

/// Contact of a sphere with a part of a face, for first contacts and peaks.
#[derive(Clone, Copy)]
pub(super) struct Meeting {
    pub sphere: usize,
    pub pair: usize,
    /// Index of the pair's part.
    pub part: usize,
    pub closing_m_s: f64,
    /// Relative to the face.
    pub velocity_m_s: V3<f64>,
    pub normal_force_n: f64,
    pub depth_m: f64,
    /// On the sphere, space axes.
    pub force_n: V3<f64>,
    pub normal: V3<f64>,
}

impl From<&Touch<f64>> for Meeting {
    #[inline(always)]
    fn from(touch: &Touch<f64>) -> Self {
        let (sphere, pair, part) = (touch.sphere, touch.pair, touch.part as usize);
        let (closing_m_s, velocity_m_s) = (touch.closing, touch.velocity);
        let (normal_force_n, depth_m, force_n, normal) = (touch.normal_force, touch.depth, touch.force, touch.normal);
        Meeting { sphere, pair, part, closing_m_s, velocity_m_s, normal_force_n, depth_m, force_n, normal }
    }
}

/// Values at one instant besides contacts: tracked values of force elements, and readings by body.
#[derive(Clone, Debug, Default)]
pub(super) struct Felt {
    pub numbers: Vec<f64>,
    pub readings: Vec<Reading<f64>>,
}

impl Felt {
    /// Space for all readings of `model`; that of the numbers grows when they are first written.
    pub(super) fn new(model: &Model) -> Self {
        let nothing = [f64::NAN; READINGS];
        Felt { numbers: Vec::new(), readings: vec![nothing; model.system().instruments.len()] }
    }
}

/// Number of tracked values of a model.
fn tracked(model: &Model) -> usize {
    let start = model.start();
    let mut cursor = PathCursor::default();
    let start_s = model.setup().time.start_s;
    let frames = model.frames(start_s, start_s, &mut cursor);
    let mut actions = Actions::with_room(&model.system().forces);
    let situation = crate::kernel::Situation::within(&start.state, &frames);
    model.system().evaluate(situation, &mut start.history.clone(), &mut actions);
    let mut count = 0;
    actions.follow(&mut Count(&mut count));
    count
}

struct Count<'a>(&'a mut usize);

impl Tracker<f64> for Count<'_> {
    fn number(&mut self, _number: f64) {
        *self.0 += 1;
    }
    fn touch(&mut self, _touch: &Touch<f64>) {}
}

/// Records first contacts of spheres with surfaces, the largest values and the readings.
#[derive(Clone)]
pub(super) struct Seen {
    surfaces: usize,
    /// By sphere and surface.
    known: Vec<bool>,
    /// By pair: the part noted last, counted from 1.
    noted: Vec<u32>,
    pub touches: Vec<FirstTouch>,
    pub peaks: Peaks,
    pub fine: Fine,
    changes: Changes,
    bars: Bars,
    look: Look,
}

/// Data for the search for largest values.
#[derive(Clone)]
struct Look {
    /// By sphere.
    part_of: Vec<usize>,
    /// By body: initial position of the head, axes of its home, m.
    starts_m: Vec<[f64; 3]>,
    /// By part.
    sums: Vec<Sum>,
    /// Surfaces that are head restraints in a rear impact; by sphere, the body of its head; by body, the force of a
    /// restraint on its head, N.
    restraints: Vec<usize>,
    heads: Vec<Option<usize>>,
    held: Vec<f64>,
    holding: Vec<V3<f64>>,
}

/// Sum of the contacts of a part of the body at one instant.
#[derive(Clone, Copy)]
struct Sum {
    force_n: V3<f64>,
    hardest: Peak,
    /// Pair and part of the hardest contact.
    of: [usize; 2],
}

impl Seen {
    pub(super) fn new(model: &Model) -> Self {
        let surfaces = model.setup().surface_names().count();
        let combinations = model.body().spheres.len() * surfaces;
        let (known, touches) = (vec![false; combinations], Vec::with_capacity(combinations));
        let (look, peaks) = (Look::new(model), none_of(model));
        let (changes, bars) = (Changes::new(model), Bars::new(model));
        let noted = vec![0; model.start().history.memory.contacts.len()];
        Seen { surfaces, known, noted, touches, peaks, fine: Fine::new(model), changes, bars, look }
    }

    /// Takes the record of an earlier part of the run of the same model.
    pub(super) fn know(&mut self, from: &Checkpoint) -> bool {
        for touch in &from.first_touches {
            self.known[touch.sphere * self.surfaces + touch.surface] = true;
        }
        self.touches.extend_from_slice(&from.first_touches);
        if from.peaks.is_empty() {
            // nobody has looked
            self.peaks = Peaks::default();
            return true;
        }
        self.peaks.read(&from.peaks) && self.fine.read(&from.readings_before, &from.readings)
    }

    /// Notes the values at an accepted step; `phases` gives the memory of pairs.
    pub(super) fn see(
        &mut self,
        model: &Model,
        time_s: f64,
        met: &[Touching],
        felt: &Felt,
        phase: impl Fn(usize) -> f64,
    ) {
        for touching in met {
            self.note(model, time_s, touching.meeting);
        }
        if !self.peaks.are_unknown() {
            self.look.at(model, time_s, (met, felt), phase, &mut self.peaks);
            self.look.hold(model, met);
            self.fine.see(time_s, &felt.readings, &self.look.held);
            self.compare(model, time_s, met, felt);
        }
    }

    /// Compares an accepted step with the one before; repeating the same step has no effect.
    pub(super) fn compare(&mut self, model: &Model, time_s: f64, met: &[Touching], felt: &Felt) {
        self.changes.see(time_s, &felt.numbers);
        let (parts, part_of) = (&mut self.peaks.parts, &self.look.part_of);
        self.bars.see(model, met, |sphere, depth_m, bar| {
            if let Some(part) = parts.get_mut(part_of[sphere]) {
                part.go_through(depth_m, bar, time_s);
            }
        });
    }

    /// Events of force elements since the last call.
    pub(super) fn told(&mut self) -> &mut Vec<Switched> {
        &mut self.changes.told
    }

    /// Values at one instant only.
    pub(super) fn look_at(
        &mut self,
        model: &Model,
        time_s: f64,
        seen: (&[Touching], &Felt),
        past: &[PairHistory<f64>],
        peaks: &mut Peaks,
    ) {
        peaks.clear();
        self.look.at(model, time_s, seen, |pair| past[pair].phase, peaks);
    }

    /// Notes a contact of `model`, for which this was made.
    #[inline]
    pub(super) fn note(&mut self, model: &Model, time_s: f64, meeting: Meeting) {
        let (noted, part) = (&mut self.noted[meeting.pair], meeting.part as u32 + 1);
        if *noted == part {
            return;
        }
        *noted = part;
        let surface = model.system().forces.contacts.surface(meeting.pair, meeting.part);
        let sphere = meeting.sphere;
        let known = &mut self.known[sphere * self.surfaces + surface];
        if !*known {
            *known = true;
            let speed_m_s = meeting.velocity_m_s.norm_squared().sqrt();
            self.touches.push(FirstTouch { sphere, surface, time_s, speed_m_s, closing_m_s: meeting.closing_m_s });
        }
    }
}

/// Empty peaks of a run of `model`.
pub(super) fn none_of(model: &Model) -> Peaks {
    Peaks::none(tracked(model), model.system().instruments.len(), model.body().parts().count())
}

impl Look {
    fn new(model: &Model) -> Self {
        let body = model.body();
        let parts: Vec<&str> = body.parts().collect();
        let part_of = |part: &str| parts.iter().position(|of| *of == part).unwrap_or(0);
        let bodies = model.system().instruments.len();
        let none = Sum { force_n: V3::zero(), hardest: Peak::NONE, of: [0; 2] };
        Look {
            part_of: body.spheres.iter().map(|sphere| part_of(&sphere.part)).collect(),
            starts_m: starts_m(model),
            sums: vec![none; parts.len()],
            restraints: restraints(model.setup()),
            heads: rear::heads(model),
            held: vec![0.0; bodies],
            holding: vec![V3::zero(); bodies],
        }
    }

    /// Sums the forces of head restraints on heads.
    fn hold(&mut self, model: &Model, met: &[Touching]) {
        if self.restraints.is_empty() {
            return;
        }
        self.holding.fill(V3::zero());
        let contacts = &model.system().forces.contacts;
        for Meeting { sphere, pair, part, force_n, .. } in met.iter().map(|one| one.meeting) {
            let Some(of) = self.heads[sphere] else { continue };
            if self.restraints.contains(&contacts.surface(pair, part)) {
                self.holding[of] += force_n;
            }
        }
        for (held, sum) in self.held.iter_mut().zip(&self.holding) {
            *held = sum.norm_squared().sqrt();
        }
    }

    fn at(
        &mut self,
        model: &Model,
        time_s: f64,
        (met, felt): (&[Touching], &Felt),
        phase: impl Fn(usize) -> f64,
        peaks: &mut Peaks,
    ) {
        for (peak, number) in peaks.elements.iter_mut().zip(&felt.numbers) {
            peak.see(*number, time_s);
        }
        for ((own, reading), start_m) in peaks.felt.iter_mut().zip(&felt.readings).zip(&self.starts_m) {
            for (peak, number) in own.iter_mut().zip(felt_of(reading, start_m)) {
                peak.see(number, time_s);
            }
        }
        if !met.is_empty() {
            self.at_parts(model, time_s, met, phase, peaks);
        }
    }

    /// Contacts come by sphere or by frame: they are summed first, then compared.
    fn at_parts(
        &mut self,
        model: &Model,
        time_s: f64,
        met: &[Touching],
        phase: impl Fn(usize) -> f64,
        peaks: &mut Peaks,
    ) {
        let contacts = &model.system().forces.contacts;
        for sum in &mut self.sums {
            (sum.force_n, sum.hardest) = (V3::zero(), Peak::NONE);
        }
        for Meeting { sphere, pair, part, normal_force_n, depth_m, force_n, .. } in met.iter().map(|one| one.meeting) {
            let thickness_m = contacts.thickness_of(pair, part, &phase);
            let other = contacts.other_sphere(pair, part).map(|other| (other, 1 - part, -force_n));
            for (sphere, side, force_n) in [Some((sphere, part, force_n)), other].into_iter().flatten() {
                let of = self.part_of[sphere];
                let (sum, peak) = (&mut self.sums[of], &mut peaks.parts[of]);
                sum.force_n += force_n;
                peak.penetration.see(depth_m, time_s);
                peak.used = peak.used.max(depth_m / thickness_m);
                if sum.hardest.see(normal_force_n, time_s) {
                    sum.of = [pair, side];
                }
            }
        }
        for (sum, peak) in self.sums.iter().zip(&mut peaks.parts) {
            if sum.hardest.value > Peak::NONE.value && peak.force.see(sum.force_n.norm_squared().sqrt(), time_s) {
                let [pair, side] = sum.of;
                peak.surface = contacts.surface(pair, side);
            }
        }
    }
}

/// Initial positions of the heads of a model, by body.
fn starts_m(model: &Model) -> Vec<[f64; 3]> {
    let (system, start_s) = (model.system(), model.setup().time.start_s);
    let k = Kinematics::new(&system.skeleton, &model.start().state);
    let frames = model.frames(start_s, start_s, &mut PathCursor::default());
    system
        .instruments
        .iter()
        .map(|own| own.head_in(system, &k, &frames).map_or([0.0; 3], |v| [v.x, v.y, v.z]))
        .collect()
}

/// Compared values of a reading; see [`Peaks`].
fn felt_of(reading: &Reading<f64>, start_m: &[f64; 3]) -> [f64; FELT] {
    let length = |from: usize| {
        let [x, y, z] = [reading[from], reading[from + 1], reading[from + 2]];
        (x * x + y * y + z * z).sqrt()
    };
    let [shear_x, shear_y, tension, flexion] = [reading[15], reading[16], reading[17], reading[19]];
    let mut all = [f64::NAN; FELT];
    [all[0], all[1], all[2]] = [length(0), length(3), length(6)];
    [all[3], all[4], all[5]] = [tension, -tension, (shear_x * shear_x + shear_y * shear_y).sqrt()];
    [all[6], all[7], all[8], all[9]] = [flexion, -flexion, -reading[21], -reading[22]];
    for (i, start_m) in start_m.iter().enumerate() {
        let moved = reading[PLACE + i] - start_m;
        [all[EXCURSIONS + 2 * i], all[EXCURSIONS + 2 * i + 1]] = [moved, -moved];
    }
    all
}

/// Collects contacts and tracked values: the only observer of steps, as each kind adds a whole kernel to the build.
pub(super) struct Met<'a> {
    pub met: &'a mut Vec<Touching>,
    pub numbers: &'a mut Vec<f64>,
}

impl<'a> Met<'a> {
    /// Of a separate instant.
    pub(super) fn anew(met: &'a mut Vec<Touching>, felt: &'a mut Felt) -> Self {
        met.clear();
        felt.numbers.clear();
        Met { met, numbers: &mut felt.numbers }
    }
}

impl Tracker<f64> for Met<'_> {
    #[inline(always)]
    fn number(&mut self, number: f64) {
        self.numbers.push(number);
    }

    #[inline(always)]
    fn numbers(&mut self, numbers: &[f64]) {
        self.numbers.extend_from_slice(numbers);
    }

    #[inline(always)]
    fn touch(&mut self, touch: &Touch<f64>) {
        self.met.push(touch.into());
    }
}
