//! Bags against closed forms: vessels that are filled and emptied, gas that is pressed together, a mass that falls onto a bag.

mod pressed;
mod shapes;
mod together;
mod vessel;

use nalgebra::{Point3, Vector3};

use super::*;
use crate::body::tti12::TTI12;
use crate::forces::contact::surface::Frame;
use crate::forces::element::Load;
use crate::forces::sphere::Site;
use crate::motion::frame::Frames;
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::Layout;
use crate::motion::state::{Shape as StateShape, State};

/// Standard gravity, m/s².
const GRAVITY: f64 = 9.80665;

/// γ = 1.4 whatever the temperature, with the R of nitrogen.
const IDEAL: Gas = Gas { r_j_kg_k: 296.8, a_j_kg_k: 296.8 * 3.5, b_j_kg_k2: 0.0 };

/// A bag of 60 l along y with its flat face upwards, unfolded before the run; it holds nothing but [`IDEAL`] gas.
fn closed() -> Bag {
    Bag {
        name: "bag".to_owned(),
        frame: Frame::Vehicle,
        mount_m: Point3::origin(),
        shape: Shape::Capsule { ends_m: [Point3::new(0.0, -0.3, 0.0), Point3::new(0.0, 0.3, 0.0)], radius_m: 0.16 },
        volume_m3: 0.06,
        fires_s: -1.0,
        deploy_s: 0.5,
        ambient: [101_325.0, 300.0],
        inflators: vec![Inflator { gas: IDEAL, due_s: NEVER, rows: vec![[0.0; 3], [1.0, 0.0, 1.0]], tank: None }],
        vents: Vec::new(),
        leakage: Leakage::Fraction(0.0),
        cover_kg: 0.0,
        heat_w_m2_k: 0.0,
        friction: 0.0,
        friction_speed_m_s: 0.1,
        spheres: Vec::new(),
    }
}

const NEVER: f64 = crate::forces::chain::NEVER;

/// Bags and one sphere, which weighs something and moves along z, or stands.
struct Rig {
    law: Vec<BagLaw<f64>>,
    past: Vec<BagPast<f64>>,
    own: Vec<f64>,
    time: f64,
    /// Height and speed of the sphere, m and m/s.
    place: [f64; 2],
    radius: f64,
    /// Further spheres on it: where, seen from the first, and radii, m.
    others: Vec<(Vector3<f64>, f64)>,
    /// kg; none of one that nothing moves.
    mass: Option<f64>,
    gravity: f64,
    actions: Vec<BagAction<f64>>,
}

impl Rig {
    fn new(bags: &[Bag]) -> Self {
        let (mut law, mut own): (Vec<_>, _) = (bags.iter().map(BagLaw::new).collect(), Vec::new());
        Bags::own(&mut law, &mut own);
        let past = law.iter().map(|_| BagPast::none()).collect();
        let (place, radius) = ([10.0, 0.0], 0.12);
        Rig {
            law,
            past,
            own,
            time: 0.0,
            place,
            radius,
            others: Vec::new(),
            mass: None,
            gravity: 0.0,
            actions: Vec::new(),
        }
    }

    /// A bag that holds as much ideal gas as has this pressure and temperature in `volume`, and no air.
    fn filled(bag: &Bag, pressure: f64, temperature: f64, volume: f64) -> Self {
        let mut rig = Rig::new(std::slice::from_ref(bag));
        let mass = pressure * volume / (IDEAL.r_j_kg_k * temperature);
        let unit = bag.ambient[0] * bag.volume_m3;
        let unit_mass = unit / (Gas::AIR.r_j_kg_k * bag.ambient[1]);
        rig.own = vec![0.0; rig.own.len()];
        rig.own[0] = mass * 2.5 * IDEAL.r_j_kg_k * temperature / unit + volume / bag.volume_m3;
        rig.own[5] = mass / unit_mass;
        rig
    }

    /// Rates of everything: of the sphere, then of the gas.
    fn rates(&mut self, accepted: bool, time: f64, place: [f64; 2], own: &[f64]) -> Vec<f64> {
        let mut k = Kinematics::blank();
        k.joint[0] = V3::of(&Vector3::new(0.0, 0.0, place[0]));
        k.joint_velocity[0] = V3::of(&Vector3::new(0.0, 0.0, place[1]));
        k.axes[0] = crate::motion::vector::M3::identity();
        let site = |(place, radius): &(Vector3<f64>, f64)| Site {
            segment: 0,
            offset: V3::of(place),
            radius: *radius,
            knee: None,
            ride: None,
        };
        let first = [(Vector3::zeros(), self.radius)];
        let spheres: Vec<_> = first.iter().chain(&self.others).map(site).collect();
        let state = State::zero(StateShape::new(0, 0)).with_own(own);
        let frames = Frames::still(time);
        let at = Instant { k: &k, state: &state, frames: &frames, carried: &[], spheres: &spheres, accepted };
        let (mut load, actions) = (Load::zero(&Layout::of(&TTI12), []), &mut self.actions);
        actions.clear();
        Bags::apply(&self.law, &at, &mut self.past, &mut Bags::hints(&self.law), &mut load, &mut |action| {
            actions.push(*action);
        });
        let acceleration = self.mass.map_or(0.0, |mass| load.wrench[0].force.z / mass - self.gravity);
        [place[1], acceleration].into_iter().chain(load.own[..own.len()].iter().copied()).collect()
    }

    /// A step of the classical Runge–Kutta method.
    fn step(&mut self, h: f64) {
        let (time, start) = (self.time, [&self.place[..], &self.own].concat());
        let mut sum = vec![0.0; start.len()];
        let mut at = start.clone();
        for (i, (share, weight)) in [(0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)].into_iter().enumerate() {
            let rates = self.rates(i == 0, time + share * h, [at[0], at[1]], &at[2..]);
            sum.iter_mut().zip(&rates).for_each(|(sum, rate)| *sum += weight * rate);
            let next = [0.5, 0.5, 1.0, 0.0][i];
            at = start.iter().zip(&rates).map(|(x, rate)| x + next * h * rate).collect();
        }
        let end: Vec<f64> = start.iter().zip(&sum).map(|(x, sum)| x + h / 6.0 * sum).collect();
        (self.place, self.own, self.time) = ([end[0], end[1]], end[2..].to_vec(), time + h);
    }

    fn run(&mut self, until: f64, h: f64) {
        while self.time < until - 0.5 * h {
            self.step(h);
        }
        self.look();
    }

    /// Looks at an accepted step here.
    fn look(&mut self) -> BagAction<f64> {
        let (time, place, own) = (self.time, self.place, self.own.clone());
        self.rates(true, time, place, &own);
        self.actions[0]
    }

    fn absolute(&self) -> f64 {
        self.actions[0].pressure + 101_325.0
    }
}
