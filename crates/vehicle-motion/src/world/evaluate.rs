//! Forces between all bodies of a world, and the rates that follow.

use crate::V3;
use crate::chassis::Report;
use crate::crush::touch::{Marks, Pose, Push};
use crate::hull::Rub;
use crate::integrate::Stack;
use crate::state::{Outside, State, Work};
use crate::world::Wrench;
use crate::world::pulse::Pulse;
use crate::world::setup::{Memories, Pair, Rails, Setup};

/// Gap of a pair within which steps are short, m.
pub(crate) const NEAR_M: f64 = 0.5;

/// Results of one evaluation.
#[derive(Clone, Debug, Default)]
pub(crate) struct Findings {
    pub reports: Vec<Report>,
    pub pushes: Vec<Push>,
    pub poses: Vec<Pose>,
    /// Forces on the masses of rails, N; by the place of each in the numbers that move.
    pub loads: Vec<f64>,
    /// Ground contact of each hull.
    pub rubs: Vec<Rub>,
    /// Force on the car of each pair, vehicle-space, and the sum of the forces' sizes, N.
    pub forces: Vec<(V3, f64)>,
}

impl Setup<'_> {
    /// Whether a pair's bodies are within reach of each other.
    pub(crate) fn is_near(&self, pair: &Pair, poses: &[Pose]) -> bool {
        if pair.rail.is_some() {
            return true;
        }
        let pass = &self.passes[pair.passes.start];
        let ahead_m = 2.0 * NEAR_M + self.world.tolerance.longest_s * self.closing_m_s(pair, poses);
        !pass.is_apart(&self.shapes, poses, ahead_m)
    }

    /// Upper bound of a pair's closing speed, m/s.
    pub(crate) fn closing_m_s(&self, pair: &Pair, poses: &[Pose]) -> f64 {
        let turns = |body: usize| {
            let reach_m = self.shapes[body].outline.reach_m;
            if reach_m.is_finite() { poses[body].turning_rad_s.norm() * reach_m } else { 0.0 }
        };
        (poses[pair.car].velocity_m_s - poses[pair.body].velocity_m_s).norm() + turns(pair.car) + turns(pair.body)
    }

    /// Number of state variables besides the vehicles: travel and speed of each barrier, then of the rail masses.
    pub(crate) fn more(&self) -> usize {
        self.rails.last().map_or(2 * self.solids.len(), |rail| rail.at.end)
    }

    /// Least gap of a pair, m.
    pub(crate) fn gap_m(&self, pair: &Pair, stack: &Stack, poses: &[Pose]) -> f64 {
        if let Some(number) = pair.rail {
            let Rails { beam, at, .. } = &self.rails[number];
            return beam.gap_m(&stack.more[at.clone()], &self.shapes[pair.car], &poses[pair.car]);
        }
        let passes = &self.passes[pair.passes.clone()];
        passes.iter().map(|pass| pass.gap_m(&self.shapes, poses)).fold(f64::INFINITY, f64::min)
    }

    /// Whether nodes of a pair are inside the other's outline: its gap is below 0.
    pub(crate) fn touches(&self, pair: &Pair, poses: &[Pose]) -> bool {
        pair.rail.is_none() && self.passes[pair.passes.clone()].iter().any(|pass| pass.touches(&self.shapes, poses))
    }

    /// Positions of all bodies.
    pub(crate) fn pose(&self, stack: &Stack, memories: &Memories, poses: &mut Vec<Pose>) {
        poses.clear();
        poses.extend(stack.cars.iter().map(State::pose));
        for (i, solid) in self.solids.iter().enumerate() {
            let mut pose = Pose::standing(solid.at_m);
            if let Some(direction) = memories.slides[i].direction_rad {
                let (sine, cosine) = libm::sincos(direction);
                let along = V3::new(cosine, sine, 0.0);
                pose.at_m += along * stack.more[2 * i];
                pose.velocity_m_s = along * stack.more[2 * i + 1];
            }
            poses.push(pose);
        }
    }

    /// Rates of the whole state.
    pub(crate) fn evaluate(
        &self,
        time_s: f64,
        stack: &Stack,
        memories: &Memories,
        pulses: &[Pulse],
        found: &mut Findings,
        rates: &mut Stack,
    ) {
        let Findings { reports, pushes, poses, forces, rubs, loads } = found;
        pushes.clear();
        pushes.resize(self.vehicles.len() + self.solids.len(), Push::default());
        if !self.pairs.is_empty() {
            self.pose(stack, memories, poses);
            loads.fill(0.0);
            for (i, pair) in self.pairs.iter().enumerate() {
                forces[i] = self.meet(pair, stack, memories, poses, pushes, loads);
            }
            pulses.iter().for_each(|pulse| pulse.push(time_s, poses, pushes));
        }
        for (i, vehicle) in self.vehicles.iter().enumerate() {
            let state = &stack.cars[i];
            let memory = &memories.vehicles[i];
            let controls = vehicle.controls(time_s, state, memory);
            let mut outside = outside(&pushes[i], state);
            if memories.hulls[i].is_near {
                let ground = &self.world.ground;
                rubs[i] = self.hulls[i].rub(state, &vehicle.chassis, controls.steer_rad, &memories.hulls[i], ground);
                outside.rub(&rubs[i], state);
            } else {
                rubs[i] = Rub::default();
            }
            if let Some(wrench) = &self.world.cars[i].push {
                wrench.add(time_s, state, &mut outside);
            }
            let rate = &mut rates.cars[i];
            reports[i] = vehicle.chassis.rates(state, &controls, memory.held, &self.world.ground, &outside, rate);
        }
        for (rail, memory) in self.rails.iter().zip(&memories.rails) {
            let at = rail.at.clone();
            rail.beam.rates(&stack.more[at.clone()], &loads[at.clone()], memory, &mut rates.more[at]);
        }
        for (i, solid) in self.solids.iter().enumerate() {
            let along = |direction: f64| {
                let (sine, cosine) = libm::sincos(direction);
                let push = pushes[self.vehicles.len() + i].force_n;
                push.x * cosine + push.y * sine
            };
            let (Some(slide), Some(direction)) = (&solid.slide, memories.slides[i].direction_rad) else { continue };
            let [way_m, speed] = [stack.more[2 * i], stack.more[2 * i + 1]];
            let held_n = slide.force_n(way_m, memories.slides[i].most_m);
            rates.more[2 * i] = speed;
            rates.more[2 * i + 1] = (along(direction) - held_n) / slide.mass_kg;
        }
    }

    /// Forces of a pair: that on the car, and the sum of sizes.
    fn meet(
        &self,
        pair: &Pair,
        stack: &Stack,
        memories: &Memories,
        poses: &[Pose],
        pushes: &mut [Push],
        loads: &mut [f64],
    ) -> (V3, f64) {
        if !pair.is_felt {
            return Default::default();
        }
        if let Some(number) = pair.rail {
            let Rails { beam, at, series, .. } = &self.rails[number];
            let marks = Marks { faces: &[], most: &memories.most[pair.car] };
            let car = (&marks, &self.shapes[pair.car], &poses[pair.car]);
            let (y, loads) = (&stack.more[at.clone()], &mut loads[at.clone()]);
            return beam.push(y, &series[pair.car], car, &mut pushes[pair.car], loads);
        }
        let (before_n, mut size_n) = (pushes[pair.car].force_n, 0.0);
        for number in pair.passes.clone() {
            let pass = &self.passes[number];
            let marks = Marks { faces: &memories.faces[number], most: &memories.most[pass.memory] };
            size_n += pass.push(&marks, &self.shapes, poses, &memories.poses, pushes);
        }
        (pushes[pair.car].force_n - before_n, size_n)
    }

    pub(crate) fn commit(&self, stack: &Stack, poses: &[Pose], memories: &mut Memories) {
        for pair in self.pairs.iter().filter(|pair| pair.is_felt) {
            for number in pair.passes.clone() {
                let pass = &self.passes[number];
                let (faces, most) = (&mut memories.faces[number], &mut memories.most[pass.memory]);
                pass.commit(faces, most, &self.shapes, poses, &memories.poses);
                if pass.outline_crushes {
                    let (own, others) = memories.most.split_at_mut(pass.memory);
                    let marks = Marks { faces: &memories.faces[number], most: &others[0] };
                    pass.mark(&marks, &mut own[pass.outline_of], &self.shapes, poses);
                }
            }
        }
        for pair in self.pairs.iter().filter(|pair| pair.is_felt) {
            let Some(number) = pair.rail else { continue };
            let (Rails { beam, at, series, .. }, car) = (&self.rails[number], pair.car);
            let y = &stack.more[at.clone()];
            beam.press(y, &series[car], &mut memories.most[car], &self.shapes[car], &poses[car]);
        }
        for (rail, memory) in self.rails.iter().zip(&mut memories.rails) {
            rail.beam.commit(&stack.more[rail.at.clone()], memory);
        }
        memories.poses.clear();
        memories.poses.extend_from_slice(poses);
        for (i, solid) in self.solids.iter().enumerate() {
            let Some(slide) = &solid.slide else { continue };
            let memory = &mut memories.slides[i];
            memory.most_m = memory.most_m.max(stack.more[2 * i]);
            memory.direction_rad = memory.direction_rad.or(slide.direction_rad);
        }
    }

    /// Kinetic energy of the sliders, and their absorbed energy, J.
    pub(crate) fn slides_j(&self, stack: &Stack, memories: &Memories) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for (i, solid) in self.solids.iter().enumerate() {
            let Some(slide) = &solid.slide else { continue };
            let (speed, most_m) = (stack.more[2 * i + 1], memories.slides[i].most_m);
            sums[0] += 0.5 * slide.mass_kg * speed * speed;
            sums[1] += slide.taken_j(stack.more[2 * i], most_m);
        }
        for (rail, memory) in self.rails.iter().zip(&memories.rails) {
            let [kinetic, held] = rail.beam.energy_j(&stack.more[rail.at.clone()], memory);
            sums = [sums[0] + kinetic, sums[1] + held];
        }
        sums
    }
}

impl Outside {
    fn rub(&mut self, rub: &Rub, state: &State) {
        let to_body = state.attitude().inverse();
        self.force_n += to_body * rub.force_n;
        self.moment_n_m += to_body * rub.moment_n_m;
        self.powers.hull_j += rub.power_w;
    }
}

/// A push in the body axes of a vehicle.
fn outside(push: &Push, state: &State) -> Outside {
    if *push == Push::default() {
        return Outside::default();
    }
    let to_body = state.attitude().inverse();
    Outside {
        force_n: to_body * push.force_n,
        moment_n_m: to_body * push.moment_n_m,
        powers: Work { crush_j: push.crushing_w, rubbing_j: push.rubbing_w, ..Work::default() },
    }
}

impl Wrench {
    pub(crate) fn corners_s(&self) -> impl Iterator<Item = f64> + '_ {
        self.components.iter().flat_map(|table| table.corners_s().iter().copied())
    }

    fn add(&self, time_s: f64, state: &State, outside: &mut Outside) {
        let [x, y, z, a, b, c] = [0, 1, 2, 3, 4, 5].map(|i: usize| self.components[i].at(time_s));
        let (force, couple) = (V3::new(x, y, z), V3::new(a, b, c));
        let (velocity, turning) = (state.attitude().inverse() * state.velocity_m_s(), state.rotation_rad_s());
        outside.force_n += force;
        outside.moment_n_m += couple + self.about_m.cross(&force);
        outside.powers.pushed_j += force.dot(&(velocity + turning.cross(&self.about_m))) + couple.dot(&turning);
    }
}
