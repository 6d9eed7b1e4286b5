//! The way of webbing, straps of given lengths, and devices: closed forms, identities, and figures of another program.

mod devices;
mod drum;
mod path;
mod straps;

use nalgebra::Point3;

use super::MOST_NODES;
use super::data::*;
use super::past::ChainPast;
use super::tension::{Course, Straps, Taut, Web};
use crate::forces::contact::surface::Frame;
use crate::forces::function::Function;

fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1u64 << 53) as f64
}

/// f = 110 kN ε(1 + 2ε) as this number of straight lines up to 20 %.
fn lines(count: usize, returned: f64) -> Function {
    let point = |i: usize| {
        let strain = 0.2 * i as f64 / count as f64;
        [strain, 110e3 * strain * (1.0 + 2.0 * strain)]
    };
    Function::lines((0..=count).map(point).collect(), returned)
}

fn webbing(returned: f64) -> Function {
    lines(20, returned)
}

fn chain(frictions: &[f64], webbing: Function, device: Device, rest: Rest) -> Chain {
    let node = |friction| Node {
        name: String::new(),
        site: Site::Vehicle(Point3::origin(), None),
        friction,
        strength_n: NEVER,
        ride: Vec::new(),
        frame: None,
    };
    let mut nodes = vec![node(0.0)];
    nodes.extend(frictions.iter().copied().map(node));
    nodes.push(node(0.0));
    let straps = (0..=frictions.len()).map(|i| i.to_string()).collect();
    Chain {
        frame: Frame::Vehicle,
        belt: "belt".to_owned(),
        nodes,
        straps,
        webbing,
        viscous: None,
        rest,
        device,
        release: Cue::NEVER,
        strength_n: NEVER,
    }
}

fn fixed() -> Device {
    Device { limiter: None, second: None, reel: None }
}

fn limiter(points: &[[f64; 2]]) -> Device {
    Device { limiter: Some(Function::lines(points.to_vec(), 0.01)), second: None, reel: None }
}

/// Straps, their memory, and their geometry.
struct Rig {
    straps: Straps<f64>,
    past: ChainPast<f64>,
    course: Course<f64>,
    /// Work put in by what moves the ends, J.
    work: f64,
    pulls: [f64; MOST_NODES],
}

/// Tension of each strap; 0 beyond the last.
fn tensions(taut: &Taut<'_, f64>) -> [f64; MOST_NODES] {
    std::array::from_fn(|i| taut.straps.get(i).map_or(0.0, |strap| strap.tension))
}

impl Rig {
    fn new(chain: &Chain, lengths: &[f64], turns: &[f64]) -> Rig {
        let straps = Straps::new(chain, (0..lengths.len()).collect());
        let mut course = Course::none();
        course.lengths[..lengths.len()].copy_from_slice(lengths);
        course.turns[1..=turns.len()].copy_from_slice(turns);
        let mut past = ChainPast::none();
        straps.start(0.0, straps.start_strain(lengths.iter().sum()), &course.lengths, &mut past);
        let mut rig = Rig { straps, past, course, work: 0.0, pulls: [0.0; MOST_NODES] };
        rig.pulls = rig.tensions();
        rig
    }

    fn tensions(&self) -> [f64; MOST_NODES] {
        let mut web = Web::new();
        tensions(&self.straps.taut(self.past.device.time, &self.course, &self.past, &mut web))
    }

    /// A step of h to these lengths, and the memory of it.
    fn step(&mut self, h: f64, lengths: &[f64]) {
        let before = self.course.lengths;
        self.course.lengths[..lengths.len()].copy_from_slice(lengths);
        let time = self.past.device.time + h;
        let mut web = Web::new();
        let taut = self.straps.taut(time, &self.course, &self.past, &mut web);
        let mut next = self.past;
        self.straps.commit(time, &taut, &self.past, &mut next);
        next.device.time = time;
        self.past = next;
        let now = tensions(&taut);
        for i in 0..lengths.len() {
            self.work += 0.5 * (now[i] + self.pulls[i]) * (lengths[i] - before[i]);
        }
        self.pulls = now;
    }

    fn unstretched(&self) -> f64 {
        self.past.nodes.iter().map(|node| node.unstretched).sum()
    }

    fn stored(&self) -> f64 {
        let mut web = Web::new();
        let taut = self.straps.taut(self.past.device.time, &self.course, &self.past, &mut web);
        (0..self.straps.starts.len()).map(|strap| self.straps.stored(&taut, strap)).sum()
    }

    fn lost(&self) -> f64 {
        self.past.nodes.iter().map(|node| node.lost).sum()
    }

    fn payout(&self) -> f64 {
        self.past.nodes[0].fed
    }
}

fn reel(lock: Cue, pull: Option<Pull>, q: Option<&[[f64; 2]]>) -> Device {
    let limiter = q.and_then(|points| limiter(points).limiter);
    let reel = Reel { on_spool_m: 0.8, tension_n: 6.0, lock, lock_after: [0.0, 0.0], pull };
    Device { limiter, second: None, reel: Some(reel) }
}

fn at(due_s: f64) -> Cue {
    Cue { due_s, watch: None }
}
