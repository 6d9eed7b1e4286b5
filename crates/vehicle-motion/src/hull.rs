//! The hull on the ground: spheres of the body, and the edges of the wheels at faces that their treads do not touch.

use crate::V3;
use crate::body::Body;
use crate::chassis::Chassis;
use crate::crush::outline::Outline;
use crate::crush::touch::Pose;
use crate::ground::Ground;
use crate::state::State;

/// Regularisation speed of friction, m/s.
const TURNS_M_S: f64 = 0.127;
/// Height of the hull over the ground below which it is evaluated, m.
const NEAR_M: f64 = 0.05;
/// Height of the hull over the ground up to which it is measured to the edges of a mesh, m; above `NEAR_M`.
const SEEN_M: f64 = 0.06;
/// Edge of a wheel: radius of its sphere, distance from the axle, distance from the middle plane, m.
const EDGE_M: [f64; 3] = [0.05, 0.08, 0.05];
/// Stiffness of a wheel's edge against a curb, N/m, a guess: rim, bearing and links.
const EDGE_N_PER_M: f64 = 2e6;
/// Depth above which an edge is twenty times as stiff, so that no wheel passes through a curb's face, m.
const EDGE_BOTTOMS_M: f64 = 0.05;
/// Number of consecutive faces stored per edge.
const FACES: usize = 4;
/// Depth above which an edge in first contact is ignored until it is out again, as it entered through the tread, m.
const FRESH_M: f64 = 0.03;
/// A vehicle that leans more (sine) may stand on the edges of its wheels, and meet barriers with its roof; that grows over so much.
const LEANS: f64 = 0.6;
const FADES: f64 = 0.2;

#[derive(Clone, Copy, Debug)]
struct Sphere {
    place_m: V3,
    radius_m: f64,
    stiffness: f64,
    is_roof: bool,
    /// Whether it stands higher than the outline that meets barriers.
    is_high: bool,
}

/// A rigid barrier that the part of a hull above the outline may meet.
#[derive(Clone, Debug)]
pub(crate) struct Obstacle {
    pub outline: Outline,
    pub at_m: V3,
    pub friction: f64,
}

impl Obstacle {
    /// Way of a point to its surface in plan, m, negative inside, and the outward normal there.
    fn distance(&self, place_m: &V3) -> (f64, V3) {
        let from_it = place_m - self.at_m;
        let (gap_m, [x, y]) = self.outline.nearest(&from_it);
        (gap_m, V3::new(x, y, 0.0))
    }
}

/// The hull of a vehicle.
#[derive(Clone, Debug)]
pub(crate) struct Hull {
    spheres: Vec<Sphere>,
    obstacles: Vec<Obstacle>,
    friction: f64,
    returned: f64,
    /// Free radius of the wheels, m.
    wheel_m: f64,
    /// Radius that holds all spheres, m.
    reach_m: f64,
}

/// Its stored state.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct HullMemory {
    /// Largest depth of each sphere, then of the two edges of each wheel by face, m; and that before the last step.
    most_m: Vec<f64>,
    before_m: Vec<f64>,
    /// Whether it may touch within the next step.
    pub is_near: bool,
    /// Least height over the ground at the last evaluation, m.
    pub clear_m: f64,
}

/// Ground contact of the hull: force and moment about the centre of gravity, vehicle-space, and the dissipated power.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Rub {
    pub force_n: V3,
    pub moment_n_m: V3,
    pub power_w: f64,
}

/// A sphere in the ground.
struct Dip {
    number: usize,
    centre_m: V3,
    radius_m: f64,
    depth_m: f64,
    normal: V3,
    stiffness: f64,
    /// Friction of a barrier; none: that of the hull and the ground.
    friction: Option<f64>,
    is_edge: bool,
    /// Weight.
    counts: f64,
}

impl Dip {
    fn is_felt(&self, most_m: f64) -> bool {
        self.depth_m > 0.0 && (!self.is_edge || most_m > 0.0 || self.depth_m < FRESH_M)
    }

    /// Force, N, and energy, J, at a depth on loading.
    fn load(&self, depth_m: f64) -> [f64; 2] {
        let beyond_m = if self.is_edge { (depth_m - EDGE_BOTTOMS_M).max(0.0) } else { 0.0 };
        let k = self.stiffness;
        [k * (depth_m + 19.0 * beyond_m), 0.5 * k * (depth_m * depth_m + 19.0 * beyond_m * beyond_m)]
    }
}

impl Hull {
    pub fn of(body: &Body, height_m: f64, wheel_m: f64, obstacles: Vec<Obstacle>) -> Self {
        let spheres = body.hull.iter().map(|ball| Sphere {
            place_m: V3::new(ball.place_m[0], ball.place_m[1], height_m - ball.place_m[2]),
            radius_m: ball.radius_m,
            stiffness: ball.stiffness_n_per_m,
            is_roof: ball.is_roof,
            is_high: ball.place_m[2] > body.band_m[1],
        });
        let spheres: Vec<Sphere> = spheres.collect();
        let reach_m = spheres.iter().map(|sphere| sphere.place_m.norm() + sphere.radius_m).fold(0.0, f64::max);
        Hull { reach_m, spheres, obstacles, friction: body.hull_friction, returned: body.hull_returned, wheel_m }
    }

    pub fn memory(&self) -> HullMemory {
        HullMemory {
            most_m: vec![0.0; self.memories()],
            before_m: vec![0.0; self.memories()],
            is_near: false,
            clear_m: 0.0,
        }
    }

    /// Depths to remember: of spheres in the ground, of edges of wheels by face, of spheres in each barrier.
    fn memories(&self) -> usize {
        self.spheres.len() * (1 + self.obstacles.len()) + 8 * FACES
    }

    /// Least way of a sphere to the ground or a barrier, m.
    pub fn clear_m(&self, state: &State, ground: &Ground) -> f64 {
        let mut least_m = self.over_m(state, ground);
        let pose = state.pose();
        self.meets(&pose, &mut |dip| least_m = least_m.min(-dip.depth_m));
        least_m
    }

    /// Spheres above the outline in barriers, of a vehicle that leans: of one that stands the outline tells all.
    fn meets(&self, pose: &Pose, meet: &mut dyn FnMut(Dip)) {
        let counts = ((pose.axes[(2, 1)].abs() - LEANS) / FADES).clamp(0.0, 1.0);
        if counts == 0.0 {
            return;
        }
        for (i, obstacle) in self.obstacles.iter().enumerate() {
            let first = self.spheres.len() * (1 + i) + 8 * FACES;
            for (j, sphere) in self.spheres.iter().enumerate().filter(|(_, sphere)| sphere.is_high) {
                let centre_m = pose.at_m + pose.axes * sphere.place_m;
                let (distance, normal) = obstacle.distance(&centre_m);
                let (radius_m, stiffness) = (sphere.radius_m, sphere.stiffness);
                meet(Dip {
                    number: first + j,
                    centre_m,
                    radius_m,
                    depth_m: radius_m - distance,
                    normal,
                    stiffness,
                    friction: Some(obstacle.friction),
                    is_edge: false,
                    counts,
                });
            }
        }
    }

    /// Least height of a sphere over the ground, m.
    fn over_m(&self, state: &State, ground: &Ground) -> f64 {
        let (at, axes) = (state.position_m(), *state.attitude().to_rotation_matrix().matrix());
        if let Some((normal, point)) = ground.lone(at.x, at.y, self.reach_m) {
            let (height, down) = (normal.dot(&(at - point)), axes.tr_mul(&normal));
            let over = |sphere: &Sphere| height + down.dot(&sphere.place_m) - sphere.radius_m;
            return self.spheres.iter().map(over).fold(f64::INFINITY, f64::min);
        }
        let over = |sphere: &Sphere| {
            let within_m = sphere.radius_m + SEEN_M;
            ground.distance_within(&(at + axes * sphere.place_m), within_m).0 - sphere.radius_m
        };
        self.spheres.iter().map(over).fold(f64::INFINITY, f64::min)
    }

    fn dips(
        &self,
        pose: &Pose,
        chassis: &Chassis,
        state: &State,
        steer: [f64; 4],
        ground: &Ground,
        meet: &mut dyn FnMut(Dip),
    ) {
        self.meets(pose, meet);
        for (number, sphere) in self.spheres.iter().enumerate() {
            let centre_m = pose.at_m + pose.axes * sphere.place_m;
            let (distance, normal) = ground.distance_within(&centre_m, sphere.radius_m);
            let (radius_m, stiffness) = (sphere.radius_m, sphere.stiffness);
            let depth_m = radius_m - distance;
            let (friction, is_edge, counts) = (None, false, 1.0);
            meet(Dip { number, centre_m, radius_m, depth_m, normal, stiffness, friction, is_edge, counts });
        }
        // a face that only an edge meets, or wheels that lie nearly flat
        if !(ground.has_steep() || pose.axes[(2, 1)].abs() > LEANS) {
            return;
        }
        let [radius_m, inward_m, aside_m] = EDGE_M;
        for (wheel, steer_rad) in steer.into_iter().enumerate() {
            let (place, axle) = chassis.wheel_at(state, wheel, steer_rad);
            let (centre, axle) = (pose.at_m + pose.axes * place, pose.axes * axle);
            // the lowest part of the wheel, in its plane
            let down = V3::z() - axle * axle.z;
            let down = if down.norm() > 0.2 { down.normalize() } else { pose.axes.column(2).into_owned() };
            for (side, sign) in [-1.0, 1.0].into_iter().enumerate() {
                let centre_m = centre + axle * (sign * aside_m) + down * (self.wheel_m - inward_m);
                let first = self.spheres.len() + FACES * (2 * wheel + side);
                ground.beside(&centre_m, radius_m, &axle, |face, depth_m, normal, counts| {
                    let (number, stiffness) = (first + face % FACES, EDGE_N_PER_M);
                    let (friction, is_edge) = (None, true);
                    meet(Dip { number, centre_m, radius_m, depth_m, normal, stiffness, friction, is_edge, counts });
                });
            }
        }
    }

    /// Action of the ground.
    pub fn rub(&self, state: &State, chassis: &Chassis, steer: [f64; 4], memory: &HullMemory, ground: &Ground) -> Rub {
        let pose = state.pose();
        let mut sum = Rub::default();
        self.dips(&pose, chassis, state, steer, ground, &mut |dip| {
            let most_m = memory.most_m[dip.number];
            if !dip.is_felt(most_m) {
                return;
            }
            let load_n = if dip.depth_m >= most_m {
                dip.load(dip.depth_m)[0]
            } else {
                // straight back, so that the returned share of the energy comes back
                let [top_n, energy_j] = dip.load(most_m);
                let way_m = 2.0 * self.returned * energy_j / top_n;
                top_n * (1.0 - (most_m - dip.depth_m) / way_m).max(0.0)
            };
            let load_n = dip.counts * load_n;
            let arm_m = dip.centre_m - dip.normal * (dip.radius_m - 0.5 * dip.depth_m) - pose.at_m;
            let velocity = pose.velocity_m_s + pose.turning_rad_s.cross(&arm_m);
            let along = velocity - dip.normal * velocity.dot(&dip.normal);
            let place_m = pose.at_m + arm_m;
            let zone = ground.zone(place_m.x, place_m.y).map_or(1.0, |zone| zone.friction);
            let speed = (along.norm_squared() + TURNS_M_S * TURNS_M_S).sqrt();
            let friction = dip.friction.unwrap_or(self.friction * zone);
            let force = dip.normal * load_n - along * (friction * load_n / speed);
            sum.force_n += force;
            sum.moment_n_m += arm_m.cross(&force);
            sum.power_w -= force.dot(&velocity);
        });
        sum
    }

    /// Stores depths; a separated sphere resets, except the roof.
    pub fn commit(
        &self,
        state: &State,
        chassis: &Chassis,
        steer: impl FnOnce() -> [f64; 4],
        memory: &mut HullMemory,
        ground: &Ground,
    ) {
        if memory.is_near {
            let HullMemory { most_m, before_m, .. } = memory;
            core::mem::swap(most_m, before_m);
            most_m.fill(0.0);
            self.dips(&state.pose(), chassis, state, steer(), ground, &mut |dip| {
                let is_roof = self.sphere_of(dip.number).is_some_and(|sphere| sphere.is_roof);
                let before_m = before_m[dip.number];
                let is_kept = is_roof || dip.is_felt(before_m);
                most_m[dip.number] = if is_kept { before_m.max(dip.depth_m) } else { 0.0 };
            });
        }
        let leans = state.attitude() * V3::y();
        memory.is_near = memory.clear_m < NEAR_M || ground.has_steep() || leans.z.abs() > LEANS;
    }

    /// Deepest crush of the roof by ground and barriers, m.
    pub fn roof_m(&self, memory: &HullMemory) -> f64 {
        let roof = |number: usize| self.sphere_of(number).is_some_and(|sphere| sphere.is_roof);
        let of = memory.most_m.iter().enumerate().filter(|(number, _)| roof(*number));
        of.map(|(_, most)| *most).fold(0.0, f64::max)
    }

    /// The sphere of a depth; none of an edge of a wheel.
    fn sphere_of(&self, number: usize) -> Option<&Sphere> {
        let n = self.spheres.len();
        let in_barrier = || number.checked_sub(n + 8 * FACES)?.checked_rem(n);
        if number < n { self.spheres.get(number) } else { self.spheres.get(in_barrier()?) }
    }
}
