//! Contact time and penetration of the impactor.

use occupant_units::trig;
use std::sync::Arc;

use super::depth::{greatest, integrated, measured};
use super::law::work;
use super::record::Record;
use super::{Impactor, refuse};
use crate::base::Failure;
use occupant_core::forces::contact::material::DEFAULT_FRICTION_SPEED_M_S;
use occupant_study::spread::median;

/// Least ratio of a peak to the noise.
const ABOVE_NOISE: f64 = 8.0;
/// Contact threshold: multiple of the noise, fraction of the peak.
pub(super) const FLOOR: [f64; 2] = [4.0, 1e-3];
/// Fraction of the peak above which later force is reported, and below which force has ended.
const PART: f64 = 0.1;
/// Least number of samples before contact for the zero offset.
const QUIET: usize = 5;
/// Number of equal samples at the peak that suggest a clipped sensor.
const FLAT: usize = 4;
/// Largest apparent ratio of returned to absorbed work.
const MOST_RETURNED: f64 = 1.02;

/// One contact: from its first moment to the last sample with force.
#[derive(Clone, Debug)]
pub struct Contact {
    /// Times, s; the first is that of first contact.
    pub time_s: Vec<f64>,
    /// Force on the impactor along the normal, N.
    pub force_n: Vec<f64>,
    /// Depth, m.
    pub depth_m: Vec<f64>,
    /// Index of the greatest depth.
    pub turn: usize,
    /// Whether unloading was recorded to its end.
    pub rebounds: bool,
    /// Normal speed at first contact, m/s, if known.
    pub speed_m_s: Option<f64>,
    /// Doubts about the record.
    pub caveats: Vec<String>,
    pub(super) series: Arc<Series>,
}

/// Forces with corrected sign and offset, and the index where contact begins.
#[derive(Clone, Debug)]
pub(super) struct Series {
    pub(super) time_s: Vec<f64>,
    pub(super) force_n: Vec<f64>,
    pub(super) depth_m: Option<Vec<f64>>,
    pub(super) begin: usize,
    /// Force threshold of contact, N.
    pub(super) floor_n: f64,
}

impl Contact {
    /// The first contact of a record.
    ///
    /// # Errors
    /// No contact, peaks of both signs, an impactor that is not stopped or that comes back too fast, no speed.
    pub(super) fn of(record: &Record, impactor: &Impactor) -> Result<Contact, Failure> {
        if record.depth_m.is_none() && (impactor.speed_m_s.is_none() || impactor.mass_kg.is_none()) {
            let found = "the depth was not measured, and to compute it mass and speed of the impactor are needed";
            return Err(refuse(found, "add --mass and --height or --speed, or a column `depth`"));
        }
        let mut caveats = Vec::new();
        let series = Arc::new(Series::of(record, impactor, &mut caveats)?);
        let start = series.start();
        let mut contact = Contact::from(&series, impactor, start);
        contact.caveats = caveats;
        contact.check(impactor)?;
        contact.look_behind();
        Ok(contact)
    }

    /// The contact that begins at a time, s.
    pub(super) fn from(series: &Arc<Series>, impactor: &Impactor, start_s: f64) -> Contact {
        let from = series.time_s.partition_point(|t| *t <= start_s);
        let time_s: Vec<f64> = std::iter::once(start_s).chain(series.time_s[from..].iter().copied()).collect();
        let force_n: Vec<f64> = std::iter::once(0.0).chain(series.force_n[from..].iter().copied()).collect();
        let speed_m_s = impactor.speed_m_s.map(|speed| speed * trig::cos(impactor.angle_rad));
        let depth_m = match &series.depth_m {
            Some(depth) => measured(&series.time_s, depth, from, start_s),
            None => integrated(&time_s, &force_n, impactor, speed_m_s.unwrap_or_default()),
        };
        let turns = depth_m.windows(2).position(|x| x[1] < x[0] && x[0] > 0.0);
        let turns = if series.depth_m.is_some() { Some(greatest(&depth_m)) } else { turns };
        let turn = turns.unwrap_or(depth_m.len() - 1);
        let end = (turn..force_n.len()).find(|i| force_n[*i] < series.floor_n);
        let last = end.unwrap_or(force_n.len() - 1);
        let cut = |values: &[f64]| values[..=last].to_vec();
        let (time_s, force_n, depth_m) = (cut(&time_s), cut(&force_n), cut(&depth_m));
        let rebounds = end.is_some_and(|end| end > turn);
        Contact { time_s, force_n, depth_m, turn, rebounds, speed_m_s, caveats: Vec::new(), series: series.clone() }
    }

    /// The greatest force, N.
    pub fn peak_n(&self) -> f64 {
        self.force_n.iter().copied().fold(0.0, f64::max)
    }

    /// The greatest depth, m.
    pub fn greatest_m(&self) -> f64 {
        self.depth_m[self.turn]
    }

    /// Work absorbed and work returned, J.
    pub fn works(&self) -> [f64; 2] {
        let part = |from: usize, to: usize| work(&self.depth_m[from..=to], &self.force_n[from..=to]);
        [part(0, self.turn), -part(self.turn, self.depth_m.len() - 1)]
    }

    fn check(&mut self, impactor: &Impactor) -> Result<(), Failure> {
        const HELP: &str = "check mass, speed, units and --from; a saturated sensor reads too little; a surface that is broken through is not for this fit";
        let last = self.force_n.len() - 1;
        if self.turn == last {
            if self.force_n[last] < PART * self.peak_n() {
                return Err(refuse(
                    "the impactor still goes in where the force has ended: the record does not stop it",
                    HELP,
                ));
            }
            self.caveats
                .push("the record ends before the impactor has stopped: the curve ends there as well".to_owned());
        } else if !self.rebounds {
            self.caveats.push("the record ends before contact does: the way back was not measured".to_owned());
        }
        let [taken, returned] = self.works();
        if self.rebounds && returned > MOST_RETURNED * taken {
            let found = format!("the surface gives back {returned:.3} J of {taken:.3} J that it took");
            return Err(refuse(found, HELP));
        }
        if self.greatest_m() <= 0.0 || !taken.is_finite() || taken <= 0.0 || self.turn < 3 {
            let found = format!("{} samples before the greatest depth of {:.2} mm", self.turn, 1e3 * self.greatest_m());
            return Err(refuse(found, "give a record with more samples, or check mass, speed and units"));
        }
        if self.series.depth_m.is_some() && impactor.speed_m_s.is_none() {
            self.caveats.push("the speed is not known: a slow press is softer than an impact".to_owned());
        }
        Ok(())
    }

    /// Reports force after the contact.
    fn look_behind(&mut self) {
        let (Some(end), series) = (self.time_s.last(), &self.series) else { return };
        let level = (PART * self.peak_n()).max(2.0 * series.floor_n);
        let after = series.time_s.partition_point(|t| t <= end);
        let later = series.force_n[after..].iter().position(|force| *force > level).map(|i| after + i);
        if let (Some(at), true) = (later, self.rebounds) {
            let words = format!("a second impact from {:.2} ms on was left out", 1e3 * series.time_s[at]);
            self.caveats.push(words);
        }
    }

    /// Friction coefficient of an oblique impact; none without tangential data, a message if it slid too little.
    pub(super) fn friction(&self, record: &Record, impactor: &Impactor) -> Option<Result<f64, String>> {
        let own = record.tangential_n.as_ref()?;
        let (Some(mass), Some(speed)) = (impactor.mass_kg, impactor.speed_m_s) else {
            return Some(Err("friction was not fitted: mass and speed are needed".to_owned()));
        };
        let from = self.series.time_s.partition_point(|t| *t <= self.time_s[0]);
        let zero = median(&own[..from.saturating_sub(1)]).unwrap_or(0.0);
        let rows = own[from..].iter().zip(&self.force_n[1..]).map(|(t, n)| [t - zero, *n]);
        let sign = rows.clone().map(|row| row[0]).sum::<f64>().signum();
        let mut slip = speed * trig::sin(impactor.angle_rad);
        let (mut products, mut squares, mut peak, mut before, mut time) = (0.0, 0.0, 0.0_f64, 0.0, self.time_s[0]);
        for ([tangential, normal], t) in rows.zip(&self.time_s[1..]) {
            let tangential = sign * tangential;
            slip -= 0.5 * (before + tangential) / mass * (t - time);
            (before, time) = (tangential, *t);
            if slip < DEFAULT_FRICTION_SPEED_M_S {
                break;
            }
            let full = normal * slip / trig::hypot(slip, DEFAULT_FRICTION_SPEED_M_S);
            (products, squares, peak) = (products + tangential * full, squares + full * full, peak.max(normal));
        }
        if peak < 0.5 * self.peak_n() || squares <= 0.0 {
            return Some(Err("friction was not fitted: the impactor slides too little (is --angle right?)".to_owned()));
        }
        Some(Ok((products / squares).max(0.0)))
    }
}

impl Series {
    fn of(record: &Record, impactor: &Impactor, caveats: &mut Vec<String>) -> Result<Series, Failure> {
        let [low, high] = [f64::min, f64::max].map(|f| record.force_n.iter().copied().fold(0.0, f));
        let quiet = noise(&record.force_n);
        let offset = record.force_n.iter().copied().take(QUIET).sum::<f64>() / QUIET as f64;
        let (down, up) = (offset - low, high - offset);
        if down.max(up) <= ABOVE_NOISE * quiet || down.max(up) <= 0.0 {
            let found = format!("no contact: the greatest force is {:.1} N, the noise {quiet:.1} N", down.max(up));
            return Err(refuse(found, "give the record of an impact, or widen --from and --to"));
        }
        if down.min(up) > 0.5 * down.max(up) {
            let found = format!("forces of both signs: {low:.0} N and {high:.0} N");
            return Err(refuse(found, "keep one impact with --from and --to; a surface only pushes"));
        }
        if down > up {
            caveats.push("the record counts force into the surface as positive: its sign was turned".to_owned());
        }
        let sign = if down > up { -1.0 } else { 1.0 };
        let force_n: Vec<f64> = record.force_n.iter().map(|force| sign * force).collect();
        let depth_m = record.depth_m.as_ref().map(|depth| upright(depth, caveats));
        let peak = down.max(up);
        let mut series = Series { time_s: record.time_s.clone(), force_n, depth_m, begin: 0, floor_n: 0.0 };
        series.floor_n = (FLOOR[0] * quiet).max(FLOOR[1] * peak);
        series.zero(sign * offset, peak, impactor, caveats);
        flat_top(&series, caveats);
        Ok(series)
    }

    /// Finds the start of contact and removes the offset before it.
    fn zero(&mut self, first: f64, peak: f64, impactor: &Impactor, caveats: &mut Vec<String>) {
        let rises = |series: &Series, zero: f64| {
            let above = |i: usize| series.force_n.get(i).is_none_or(|force| force - zero > series.floor_n);
            let sure = |i: &usize| (0..3).all(|more| above(i + more));
            (0..series.force_n.len()).find(sure).unwrap_or(0)
        };
        let begin = rises(self, first);
        let quiet = &self.force_n[..begin / 2];
        let mean = quiet.iter().sum::<f64>() / quiet.len().max(1) as f64;
        // of the noise alone it would be smaller than that
        let least = 3.0 * self.floor_n / FLOOR[0] / (quiet.len().max(1) as f64).sqrt();
        let zero = if begin >= QUIET && mean.abs() > least { mean } else { 0.0 };
        if begin < QUIET {
            caveats.push("the record has no quiet part before contact: its zero was not checked".to_owned());
        }
        if zero.abs() > 0.01 * peak {
            let g = impactor.mass_kg.map_or(String::new(), |mass| format!(" ({:.2} g)", zero / mass / 9.80665));
            caveats.push(format!("{zero:.1} N{g} before contact, gravity or offset, were taken as zero"));
        }
        self.force_n.iter_mut().for_each(|force| *force -= zero);
        self.begin = rises(self, 0.0);
    }

    /// Time of first contact: zero of the line through the first two samples with force.
    fn start(&self) -> f64 {
        let (t, f) = (&self.time_s, &self.force_n);
        let before = (0..self.begin).rev().find(|i| f[*i] <= 0.0);
        let Some(i) = before else { return t[0] };
        let rise = f.get(i + 2).map_or(0.0, |next| next - f[i + 1]);
        let dt = t[i + 1] - t[i];
        let back = if rise > 0.0 { (f[i + 1] / rise).min(1.0) } else { 1.0 };
        t[i + 1] - back * dt
    }
}

/// Depths, positive into the surface.
fn upright(depth: &[f64], caveats: &mut Vec<String>) -> Vec<f64> {
    let first = depth[0];
    let sign =
        if first - depth.iter().copied().fold(first, f64::min) > depth.iter().copied().fold(first, f64::max) - first {
            caveats.push("the record counts depth as negative: its sign was turned".to_owned());
            -1.0
        } else {
            1.0
        };
    depth.iter().map(|x| sign * x).collect()
}

/// Reports a flat peak after a steep rise.
fn flat_top(series: &Series, caveats: &mut Vec<String>) {
    let f = &series.force_n;
    let peak = f.iter().copied().fold(0.0, f64::max);
    let is_top = |force: &f64| peak - force <= 1e-6 * peak;
    let Some(first) = f.iter().position(&is_top) else { return };
    let count = f[first..].iter().take_while(|force| is_top(force)).count();
    if count >= FLAT && first > 0 {
        let [from, to] = [first, first + count - 1].map(|i| 1e3 * series.time_s[i]);
        caveats.push(format!(
            "{count} equal samples at the peak from {from:.2} to {to:.2} ms: a surface that yields, or a saturated sensor, of which nothing here may be used"
        ));
    }
}

/// Size of the noise, from second differences.
fn noise(values: &[f64]) -> f64 {
    let bends: Vec<f64> = values.windows(3).map(|w| (w[0] - 2.0 * w[1] + w[2]).abs()).collect();
    median(&bends).unwrap_or(0.0) / (0.6745 * 6.0_f64.sqrt())
}
