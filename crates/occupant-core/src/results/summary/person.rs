//! Readings of the instruments of one body in a run.

use super::{Acceleration, Accelerations, Excursion, Level, Peak, Person};
use crate::body::tree::BodyRow;
use crate::kernel::instruments::{SIDE_SIGNALS, TIBIA_SIGNALS};
use crate::model::Model;
use crate::model::setup::STANDARD_GRAVITY_M_S2;
use crate::results::fine::{Fine, REAR_SIGNALS};
use crate::results::peaks::{EXCURSIONS, FELT, Peaks};
use crash_measures::injury::{self, ChestPoint, Options, Readings, Signals, Special, TibiaLoad, TibiaSite};
use crash_measures::measure::{Peak as Extreme, ThreeMs};

/// Readings of the instruments of one body in a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Watched {
    /// Index of the body.
    of: usize,
    pub(super) name: &'static str,
    pub(super) mass_kg: f64,
    has_head: bool,
    /// Whether it has a head, a chest and a pelvis that are not mounted: else their readings are an input.
    has: [bool; 3],
    pub(super) signals: Signals,
}

impl Watched {
    /// Bodies of a model with results, those that [`Fine`] reads; at least the first.
    pub(super) fn all(model: &Model, fine: &Fine) -> Vec<Watched> {
        let (body, rows) = (model.body(), model.body().tree.bodies());
        let watched = |&of: &usize| {
            let row = &rows[of];
            let head = if row.name.is_empty() { "head".to_owned() } else { format!("{}.head", row.name) };
            let own = || body.tree.segments().filter(|segment| body.tree.body_of(*segment) == of);
            let told = own().next().filter(|_| model.system().skeleton.layout.is_guided(of));
            Watched {
                of,
                name: row.name,
                mass_kg: own().map(|segment| body.segment(segment).mass_kg).sum(),
                has_head: body.sphere(&head).is_some(),
                has: row.landmarks.instruments().map(|segment| segment.is_some() && segment != told),
                signals: begun(model, fine, row),
            }
        };
        fine.bodies.iter().map(watched).collect()
    }

    /// Takes the readings of the body with the index `place` among those that are read.
    pub(super) fn take(&mut self, place: usize, fine: &Fine) {
        if self.signals.is_empty() {
            (self.signals.start_s, self.signals.interval_s) = (fine.first_s(), fine.interval_s);
        }
        let count = fine.count();
        for (n, values) in self.signals.all_mut().enumerate() {
            match self.has.get(n / 3) {
                Some(false) => values.extend(std::iter::repeat_n(f64::NAN, count)),
                _ => fine.push_column(place, n, values),
            }
        }
        let parts: [(&[Special], _); 4] = [
            (&CHEST, fine.chest_part()),
            (&SIDE, fine.side_part()),
            (&LEGS, fine.legs_part()),
            (&REAR, fine.rear_part()),
        ];
        for (which, at) in parts.into_iter().flat_map(|(all, part)| all.iter().zip(part)) {
            if let Some(values) = self.signals.special.get_mut(which) {
                fine.push_column(place, at, values);
            }
        }
    }

    /// Ends the signals, after all readings were taken; `are_of_steps`: whether peaks are those of steps.
    pub(super) fn complete(&mut self, peaks: &Peaks, are_of_steps: bool) {
        if !self.signals.is_empty() {
            // the file of an older program lacks some
            self.signals.special.retain(|_, values| !values.is_empty());
        }
        let own = self.own(peaks);
        self.signals.peaks =
            are_of_steps.then(|| std::array::from_fn(|i| Extreme { value: own[i].value, time_s: own[i].time_s }));
    }

    /// Largest values of its readings.
    fn own(&self, peaks: &Peaks) -> [Peak; FELT] {
        let mut own = peaks.felt.get(self.of).copied().unwrap_or([Peak::NONE; FELT]);
        (0..3).filter(|i| !self.has[*i]).for_each(|i| own[i] = Peak::NONE);
        own
    }

    /// Results of a run that has ended.
    pub(super) fn person(&self, options: &Options, peaks: &Peaks) -> Person {
        let own = self.own(peaks);
        let options = self.options(options);
        let readings = Readings::new(&self.signals, &options);
        let parts = [&readings.head, &readings.chest, &readings.pelvis];
        let [head, chest, pelvis] = std::array::from_fn(|i| self.acceleration(i, own[i], parts[i]));
        let accelerations = Accelerations { head, chest, pelvis };
        let (dummy, measures) = (options.dummy.name(), readings.measures());
        Person { accelerations, head_excursion: self.excursion(&own), dummy, measures }
    }

    /// Settings for this body: those of a dummy for the side if its ribs yield to the side.
    pub(super) fn options(&self, options: &Options) -> Options {
        match self.signals.sides {
            Some(_) => options.for_side(self.mass_kg),
            None => options.for_body(self.mass_kg),
        }
    }

    /// Signals of this body at rest; those of missing parts are NaN.
    pub(super) fn at_rest(&self, samples: usize) -> Signals {
        let mut signals = self.signals.clone();
        for (n, values) in signals.all_mut().enumerate() {
            let is_read = self.has.get(n / 3).is_none_or(|has| *has);
            values.resize(samples, if is_read { 0.0 } else { f64::NAN });
        }
        signals.special.values_mut().for_each(|values| values.resize(samples, 0.0));
        signals
    }

    fn excursion(&self, own: &[Peak; FELT]) -> Option<Excursion> {
        let [forward, rearward, right, left, down, up] = std::array::from_fn(|i| own[EXCURSIONS + i]);
        (self.has_head && forward.value.is_finite()).then_some(Excursion { forward, rearward, left, right, up, down })
    }

    fn acceleration(&self, i: usize, peak: Peak, levels: &injury::Acceleration) -> Acceleration {
        // no numbers of what a part of a body lacks
        let peak = if self.has[i] { peak } else { Peak { value: f64::NAN, time_s: f64::NAN } };
        let level = |held: &ThreeMs| Level {
            level_m_s2: held.level_mps2,
            level_g: in_g(held.level_mps2),
            from_s: self.signals.start_s + held.start_s,
            to_s: self.signals.start_s + held.end_s,
        };
        Acceleration {
            peak_m_s2: peak.value,
            peak_g: in_g(peak.value),
            peak_time_s: peak.time_s,
            three_ms_contiguous: levels.three_ms_contiguous.as_ref().ok().map(level),
            three_ms_cumulative: levels.three_ms_cumulative.as_ref().ok().map(level),
        }
    }
}

/// Samples with space reserved at the start, 100 s at 10 kHz.
const MOST_ROOM: usize = 1_000_000;

/// Deflections of a chest in the order of a sample, and the signals for side impact, of the lower legs, and for rear impact.
const CHEST: [Special; 5] = [
    Special::ChestDeflection,
    Special::ChestPoint(ChestPoint::ALL[0]),
    Special::ChestPoint(ChestPoint::ALL[1]),
    Special::ChestPoint(ChestPoint::ALL[2]),
    Special::ChestPoint(ChestPoint::ALL[3]),
];
const SIDE: [Special; SIDE_SIGNALS] = [
    Special::Rib(0),
    Special::Abdomen(0),
    Special::LowerSpine(0),
    Special::LowerSpine(1),
    Special::LowerSpine(2),
    Special::Pelvis(0),
    Special::Pubic,
];
const LEGS: [Special; TIBIA_SIGNALS] = {
    let mut all = [Special::T1; TIBIA_SIGNALS];
    let loads = [TibiaLoad::MomentX, TibiaLoad::MomentY, TibiaLoad::ForceZ];
    let mut i = 0;
    while i < TIBIA_SIGNALS {
        all[i] = Special::Tibia(TibiaSite::ALL[i / loads.len()], loads[i % loads.len()]);
        i += 1;
    }
    all
};
const REAR: [Special; REAR_SIGNALS] = [Special::T1, Special::HeadRestraint, Special::HeadSpeed, Special::PelvisPlace];

/// Signals with room for a whole run.
fn begun(model: &Model, fine: &Fine, row: &BodyRow) -> Signals {
    let (name, marks) = (row.name, &row.landmarks);
    let is_whole = marks.instruments().iter().all(Option::is_some);
    let mut signals = Signals { interval_s: fine.interval_s, ..Signals::new() };
    let room = Fine::most(model).max(model.output_count()).min(MOST_ROOM);
    signals.all_mut().for_each(|values| values.reserve(room));
    if let Some(chest) = model.body().chests.iter().find(|chest| chest.of == name) {
        let points = if chest.points.is_empty() { &[][..] } else { &ChestPoint::ALL[..] };
        let all = [Special::ChestDeflection].into_iter().chain(points.iter().map(|point| Special::ChestPoint(*point)));
        signals.special.extend(all.map(|which| (which, Vec::with_capacity(room))));
        let is_dummy = chest.preset.starts_with("dummy");
        signals.person = (!is_dummy).then_some(injury::Person { chest_depth_m: chest.depth_m, age_years: None });
    }
    if let Some(sides) = model.body().sides.iter().find(|sides| sides.of == name) {
        let has = |which: &Special| match which {
            Special::Abdomen(_) => sides.abdomen.is_some(),
            Special::Pelvis(_) => sides.pelvis.is_some() && sides.pubic_share.is_none(),
            Special::Pubic => sides.pelvis.is_some() && sides.pubic_share.is_some(),
            _ => true,
        };
        let own = SIDE.into_iter().filter(has);
        signals.special.extend(own.map(|which| (which, Vec::with_capacity(room))));
        let half_breadth_m = sides.half_breadth_m;
        let is_dummy = sides.preset != "person";
        signals.sides = Some(if is_dummy { injury::Ribs::Dummy } else { injury::Ribs::Person { half_breadth_m } });
    }
    for (leg, own) in [marks.legs.right, marks.legs.left].into_iter().zip(LEGS.chunks_exact(TIBIA_SIGNALS / 2)) {
        let has_foot = leg.is_some_and(|leg| leg.end.is_some());
        signals.special.extend(own.iter().filter(|_| has_foot).map(|which| (*which, Vec::with_capacity(room))));
    }
    if fine.rear > 0 && is_whole {
        signals.special.extend(REAR.map(|which| (which, Vec::with_capacity(room))));
    }
    signals
}

fn in_g(acceleration_m_s2: f64) -> f64 {
    acceleration_m_s2 / STANDARD_GRAVITY_M_S2
}
