//! A rail on posts in plan: lateral masses along a line under one tension, with bending, posts that yield and release.

use crate::V3;
use crate::barrier::Rail;
use crate::crush::law::Series;
use crate::crush::touch::{Marks, Pose, Push, SQUARE, Shape};

/// Masses per post spacing.
const PER_POST: usize = 4;
/// Regularisation speed of friction, m/s.
const TURNS_M_S: f64 = 0.127;

/// A rail ready to run.
#[derive(Clone, Debug)]
pub(crate) struct Beam {
    rail: Rail,
    /// Number of masses and distance between them, m.
    pub count: usize,
    step_m: f64,
    along: V3,
    away: V3,
    /// Stiffness of the rail with both anchors, N/m.
    pull_n_per_m: f64,
}

/// Stored state of a rail.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct BeamMemory {
    bent_per_m: Vec<f64>,
    set_m: Vec<f64>,
    let_go: Vec<bool>,
    stretched_m: f64,
    /// Energy dissipated by yielding and released posts, J.
    pub lost_j: f64,
    pub most_m: f64,
    pub most_n: f64,
}

impl BeamMemory {
    /// Number of released posts.
    pub fn released(&self) -> usize {
        self.let_go.iter().filter(|gone| **gone).count()
    }
}

/// Position on the rail beside a point: index of the mass before it, share towards the next, deflection, slope.
type Beside = (usize, f64, f64, f64);
/// Index of a node, the rail position beside it, depth, normal on the vehicle, cosine of the contact angle.
type Press<'a> = dyn FnMut(usize, Beside, f64, V3, f64) + 'a;

/// The rail's inner forces.
struct Inner {
    pull_n: f64,
    length_m: f64,
}

impl Beam {
    pub fn new(rail: &Rail) -> Result<Self, &'static str> {
        let [a, b] = rail.line_m;
        let way = V3::new(b[0] - a[0], b[1] - a[1], 0.0);
        let positive = [rail.spacing_m, rail.kg_per_m, rail.stretch_n, rail.bend_n_m2, rail.anchor_n_per_m];
        let yields = [rail.yield_n, rail.yield_n_m, rail.post_n_per_m, rail.post_n, rail.release_m];
        if positive.iter().chain(&yields).any(|x| !(*x > 0.0 && x.is_finite())) {
            return Err("its numbers must be above 0");
        }
        let posts = (way.norm() / rail.spacing_m).floor() as usize;
        if posts < 2 {
            return Err("it must be at least two post spacings long");
        }
        let count = posts * PER_POST + 1;
        let along = way.normalize();
        let away = V3::z().cross(&along) * if rail.traffic_on_left { 1.0 } else { -1.0 };
        let pull_n_per_m = 1.0 / (way.norm() / rail.stretch_n + 2.0 / rail.anchor_n_per_m);
        let step_m = way.norm() / (count + 1) as f64;
        Ok(Beam { rail: rail.clone(), count, step_m, along, away, pull_n_per_m })
    }

    pub fn memory(&self) -> BeamMemory {
        BeamMemory {
            bent_per_m: vec![0.0; self.count],
            set_m: vec![0.0; self.count],
            let_go: vec![false; self.count],
            ..BeamMemory::default()
        }
    }

    fn start_m(&self) -> V3 {
        let [x, y] = self.rail.line_m[0];
        V3::new(x, y, 0.0)
    }

    /// Its line in plan with both ends, m.
    pub fn line_m(&self, y: &[f64]) -> Vec<[f64; 2]> {
        let place = |j: isize| {
            let at = self.start_m() + self.along * (self.step_m * (j + 1) as f64) + self.away * self.way_m(y, j);
            [at.x, at.y]
        };
        (-1..=self.count as isize).map(place).collect()
    }

    /// Distance of a place in plan from its line, m.
    pub fn off_m(&self, y: &[f64], [x_m, y_m]: [f64; 2]) -> f64 {
        let line = self.line_m(y);
        let off = |pair: &[[f64; 2]]| {
            let [from, way] = [pair[0], [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]]];
            let to = [x_m - from[0], y_m - from[1]];
            let share = (to[0] * way[0] + to[1] * way[1]) / (way[0] * way[0] + way[1] * way[1]);
            let share = share.clamp(0.0, 1.0);
            long(to[0] - share * way[0], to[1] - share * way[1])
        };
        line.windows(2).map(off).fold(f64::INFINITY, f64::min)
    }

    fn has_post(j: usize) -> bool {
        j.is_multiple_of(PER_POST)
    }

    fn mass_kg(&self, j: usize) -> f64 {
        self.rail.kg_per_m * self.step_m + if Self::has_post(j) { self.rail.post_kg } else { 0.0 }
    }

    /// Deflection of a mass away from the traffic, m; the ends are pinned.
    fn way_m(&self, y: &[f64], j: isize) -> f64 {
        if j < 0 || j as usize >= self.count { 0.0 } else { y[2 * j as usize] }
    }

    fn bend_per_m(&self, y: &[f64], j: usize) -> f64 {
        let j = j as isize;
        (self.way_m(y, j - 1) - 2.0 * self.way_m(y, j) + self.way_m(y, j + 1)) / (self.step_m * self.step_m)
    }

    fn inner(&self, y: &[f64], memory: &BeamMemory) -> Inner {
        let piece = |j: isize| long(self.way_m(y, j) - self.way_m(y, j - 1), self.step_m) - self.step_m;
        let length_m: f64 = (0..=self.count as isize).map(piece).sum();
        let pull_n = (self.pull_n_per_m * (length_m - memory.stretched_m)).clamp(0.0, self.rail.yield_n);
        Inner { pull_n, length_m }
    }

    fn moment_n_m(&self, y: &[f64], j: isize, memory: &BeamMemory) -> f64 {
        if j < 0 || j as usize >= self.count {
            return 0.0;
        }
        let bent = self.bend_per_m(y, j as usize) - memory.bent_per_m[j as usize];
        (self.rail.bend_n_m2 * bent).clamp(-self.rail.yield_n_m, self.rail.yield_n_m)
    }

    fn post_n(&self, y: &[f64], j: usize, memory: &BeamMemory) -> f64 {
        if !Self::has_post(j) || memory.let_go[j] {
            return 0.0;
        }
        (self.rail.post_n_per_m * (y[2 * j] - memory.set_m[j])).clamp(-self.rail.post_n, self.rail.post_n)
    }

    /// Rates of the masses: the state has deflection and speed alternating; `loads` are the contact forces on them, N.
    pub fn rates(&self, y: &[f64], loads: &[f64], memory: &BeamMemory, rates: &mut [f64]) {
        let Inner { pull_n, .. } = self.inner(y, memory);
        let slope = |j: isize| {
            let rise = self.way_m(y, j) - self.way_m(y, j - 1);
            rise / long(rise, self.step_m)
        };
        let moment = |j: isize| self.moment_n_m(y, j, memory);
        let (mut before, mut here) = (0.0, moment(0));
        for j in 0..self.count {
            let i = j as isize;
            let next = moment(i + 1);
            let force = pull_n * (slope(i + 1) - slope(i)) - (before - 2.0 * here + next) / self.step_m + loads[j]
                - self.post_n(y, j, memory);
            rates[2 * j] = y[2 * j + 1];
            rates[2 * j + 1] = force / self.mass_kg(j);
            (before, here) = (here, next);
        }
    }

    /// Applies yielding and releases posts.
    pub fn commit(&self, y: &[f64], memory: &mut BeamMemory) {
        let Rail { bend_n_m2, yield_n_m, post_n_per_m, post_n, release_m, yield_n, .. } = self.rail;
        for j in 0..self.count {
            let beyond = self.bend_per_m(y, j) - memory.bent_per_m[j];
            let over = beyond.abs() - yield_n_m / bend_n_m2;
            if over > 0.0 {
                memory.bent_per_m[j] += over.copysign(beyond);
                memory.lost_j += yield_n_m * over * self.step_m;
            }
            let pushed = y[2 * j] - memory.set_m[j];
            let over = pushed.abs() - post_n / post_n_per_m;
            if Self::has_post(j) && !memory.let_go[j] && over > 0.0 {
                memory.set_m[j] += over.copysign(pushed);
                memory.lost_j += post_n * over;
            }
            if Self::has_post(j) && !memory.let_go[j] && y[2 * j] > release_m {
                let held_n = self.post_n(y, j, memory);
                memory.lost_j += 0.5 * held_n * held_n / post_n_per_m;
                memory.let_go[j] = true;
            }
            memory.most_m = memory.most_m.max(y[2 * j]);
        }
        let Inner { pull_n, length_m } = self.inner(y, memory);
        let over = length_m - memory.stretched_m - yield_n / self.pull_n_per_m;
        if over > 0.0 {
            memory.stretched_m += over;
            memory.lost_j += yield_n * over;
        }
        memory.most_n = memory.most_n.max(pull_n);
    }

    /// Kinetic energy, and what is stored and lost, J.
    pub fn energy_j(&self, y: &[f64], memory: &BeamMemory) -> [f64; 2] {
        let (mut kinetic, mut held) = (0.0, memory.lost_j);
        for j in 0..self.count {
            kinetic += 0.5 * self.mass_kg(j) * y[2 * j + 1] * y[2 * j + 1];
            let (moment, post) = (self.moment_n_m(y, j as isize, memory), self.post_n(y, j, memory));
            held += 0.5 * moment * moment / self.rail.bend_n_m2 * self.step_m;
            held += 0.5 * post * post / self.rail.post_n_per_m;
        }
        let Inner { pull_n, .. } = self.inner(y, memory);
        [kinetic, held + 0.5 * pull_n * pull_n / self.pull_n_per_m]
    }

    /// The piece of rail beside a point.
    fn beside(&self, y: &[f64], place_m: &V3) -> Option<Beside> {
        let s = (place_m - self.start_m()).dot(&self.along) / self.step_m - 1.0;
        let j = s.floor();
        if !(0.0..self.count as f64 - 1.0).contains(&j) {
            return None;
        }
        let (j, share) = (j as usize, s - j);
        let (from, to) = (y[2 * j], y[2 * j + 2]);
        Some((j, share, from + share * (to - from), (to - from) / self.step_m))
    }

    fn is_level(&self, shape: &Shape, pose: &Pose) -> bool {
        let [low_m, high_m] = self.rail.band_m;
        // z counts down
        let [top, foot] = shape.outline.band_m.map(|z| -(pose.at_m.z + z));
        foot < high_m && top > low_m
    }

    /// Least way from the vehicle's nodes to the rail, m.
    pub fn gap_m(&self, y: &[f64], shape: &Shape, pose: &Pose) -> f64 {
        self.nearest(y, shape, pose).map_or(f64::INFINITY, |(gap_m, _)| gap_m)
    }

    /// The vehicle's node nearest to the rail: its way to it, m, negative behind it, and its place.
    pub fn nearest(&self, y: &[f64], shape: &Shape, pose: &Pose) -> Option<(f64, V3)> {
        if !self.is_level(shape, pose) {
            return None;
        }
        let near = |node: &crate::crush::outline::Node| {
            let place_m = pose.at_m + pose.axes * node.place_m;
            let at = self.beside(y, &place_m)?;
            let over_m = at.2 - (place_m - self.start_m()).dot(&self.away);
            Some((over_m / long(at.3, 1.0), place_m))
        };
        shape.nodes.iter().filter_map(near).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Adds the force on a vehicle and on the masses. Returns the force on the vehicle and the sum of the forces' sizes.
    pub fn push(
        &self,
        y: &[f64],
        series: &[Series],
        (marks, shape, pose): (&Marks, &Shape, &Pose),
        push: &mut Push,
        loads: &mut [f64],
    ) -> (V3, f64) {
        let (mut sum, mut size) = (V3::zeros(), 0.0);
        self.each(y, shape, pose, &mut |i, at, depth_m, normal, facing| {
            let node = &shape.nodes[i];
            let pressure = series[node.law].pressure(depth_m, marks.most[i]);
            let load_n = pressure.force_n_per_m * node.width_m * facing;
            if load_n == 0.0 {
                return;
            }
            let (j, share, ..) = at;
            let arm_m = pose.axes * node.place_m;
            let arm_m = V3::new(arm_m.x, arm_m.y, -self.rail.height_m - pose.at_m.z);
            let speed = y[2 * j + 1] + share * (y[2 * j + 3] - y[2 * j + 1]);
            let mut velocity = pose.velocity_m_s + pose.turning_rad_s.cross(&arm_m) - self.away * speed;
            // what it does up and down the rail does not feel
            velocity.z = 0.0;
            let closing = -velocity.dot(&normal);
            let along = velocity + normal * closing;
            let turns = (along.norm_squared() + TURNS_M_S * TURNS_M_S).sqrt();
            let force = normal * load_n - along * (self.rail.friction * load_n / turns);
            sum += force;
            size += load_n;
            push.force_n += force;
            push.moment_n_m += arm_m.cross(&force);
            push.crushing_w += load_n * closing;
            push.rubbing_w += self.rail.friction * load_n * along.norm_squared() / turns;
            let lateral = -force.dot(&self.away);
            loads[j] += (1.0 - share) * lateral;
            loads[j + 1] += share * lateral;
        });
        (sum, size)
    }

    /// Stores the largest forces of a vehicle's nodes.
    pub fn press(&self, y: &[f64], series: &[Series], most: &mut [f64], shape: &Shape, pose: &Pose) {
        self.each(y, shape, pose, &mut |i, _, depth_m, _, facing| {
            if facing > SQUARE {
                most[i] = most[i].max(series[shape.nodes[i].law].load(depth_m));
            }
        });
    }

    /// Calls for each node behind the rail.
    fn each(&self, y: &[f64], shape: &Shape, pose: &Pose, with: &mut Press) {
        if !self.is_level(shape, pose) {
            return;
        }
        for (i, node) in shape.nodes.iter().enumerate() {
            let place_m = pose.at_m + pose.axes * node.place_m;
            let Some(at) = self.beside(y, &place_m) else { continue };
            let behind_m = (place_m - self.start_m()).dot(&self.away) - at.2;
            if behind_m <= 0.0 {
                continue;
            }
            let steep = long(at.3, 1.0);
            let normal = (self.along * at.3 - self.away) / steep;
            let facing = -(pose.axes * node.normal).dot(&normal);
            if facing > 0.0 {
                with(i, at, behind_m / steep, normal, facing);
            }
        }
    }
}

/// Length of what goes so far ahead and aside, in numbers of usual size: `hypot` of the system is slow, and its bits are the system's.
fn long(aside: f64, ahead: f64) -> f64 {
    (aside * aside + ahead * ahead).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Under a uniform load, without posts and bending: the parabola of its tension, f = q L²/8T, longer by 8f²/3L.
    #[test]
    fn a_rail_alone_hangs_as_a_rope() {
        let free = Rail { bend_n_m2: 1.0, post_n: 1e-6, ..Rail::w_beam([[0.0, 0.0], [38.1, 0.0]]) };
        let beam = Beam::new(&free).unwrap();
        let memory = beam.memory();
        let load_n_per_m = 2000.0;
        let loads = vec![load_n_per_m * beam.step_m; beam.count];
        let (mut y, mut rates) = (vec![0.0; 2 * beam.count], vec![0.0; 2 * beam.count]);
        let h = 2e-4;
        for _ in 0..60_000 {
            beam.rates(&y, &loads, &memory, &mut rates);
            for j in 0..beam.count {
                y[2 * j + 1] = (y[2 * j + 1] + h * rates[2 * j + 1]) * (1.0 - 5.0 * h);
                y[2 * j] += h * y[2 * j + 1];
            }
        }
        let (pull_n, sag_m, span_m) = (beam.inner(&y, &memory).pull_n, y[beam.count - 1], 38.1);
        let expected_m = load_n_per_m * span_m * span_m / (8.0 * pull_n);
        // measured 0.4 and 0.5 %: the rope is not quite a parabola
        assert!((sag_m / expected_m - 1.0).abs() < 0.01, "{sag_m} {expected_m}");
        let longer_m = 8.0 * sag_m * sag_m / (3.0 * span_m);
        assert!((pull_n / (beam.pull_n_per_m * longer_m) - 1.0).abs() < 0.02, "{pull_n}");
    }
}
