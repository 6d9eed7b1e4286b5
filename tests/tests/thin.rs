//! Small and fast spheres against thin things: none passes, under any integrator, and each rebounds as closed forms say.

use nalgebra::{Matrix3, Point3, Vector3};
use occupant_core::body::{Body, ContactSphere};
use occupant_core::forces::contact::material::DEFAULT_FRICTION_SPEED_M_S;
use occupant_core::forces::contact::solid::{Shape, Solid};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::forces::joint::Joints;
use occupant_core::forces::spring::BilinearSpring;
use occupant_core::model::Model;
use occupant_core::model::seating::{InitialPosture, InitialVelocity, Mounting, Placing};
use occupant_core::model::setup::{Allowance, Integrator, LOOSE, Setup, TimeSpan};
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_core::vehicle::VehiclePose;
use occupant_tests::cases::{afloat, smooth};
use occupant_tests::measure::assert_below;
use occupant_tests::random::Random;
use occupant_tests::room::ends_alike_side_by_side;
use occupant_tests::steps::step;

/// A ball that is thrown at a plate across the x axis, whose front is at x = 0.
#[derive(Clone, Copy, Debug)]
struct Throw {
    radius_m: f64,
    mass_kg: f64,
    stiffness_n_per_m: f64,
    thickness_m: f64,
    speed_m_s: f64,
    /// How far before the plate it begins, m.
    before_m: f64,
    /// Sideways, as a part of its speed.
    aside: f64,
}

impl Throw {
    fn random(random: &mut Random) -> Self {
        let radius_m = random.between(3e-3, 20e-3);
        // of plastic to steel
        let mass_kg = random.between(1000.0, 7800.0) * 4.0 / 3.0 * std::f64::consts::PI * radius_m.powi(3);
        Throw {
            radius_m,
            mass_kg,
            stiffness_n_per_m: 10f64.powf(random.between(4.5, 6.5)),
            thickness_m: random.between(1e-3, 5e-3),
            speed_m_s: random.between(5.0, 90.0),
            before_m: radius_m + random.between(0.01, 0.2),
            aside: random.between(-0.5, 0.5),
        }
    }

    /// How long the plate holds it, s.
    fn contact_s(&self) -> f64 {
        std::f64::consts::PI * (self.mass_kg / self.stiffness_n_per_m).sqrt()
    }

    fn setup(&self, shape: Shape, integrator: Integrator) -> Setup {
        let along = self.speed_m_s;
        let start = Vector3::new(-self.before_m, 0.0, 0.0);
        let mut setup = ball(self, start, Vector3::new(along, self.aside * along, 0.0));
        setup.materials = vec![smooth(BilinearSpring::linear(self.stiffness_n_per_m, 1.0))];
        setup.solids = vec![solid(shape)];
        setup.integrator = integrator;
        // until it is as far away again
        let end_s = self.contact_s() + 2.0 * self.before_m / along;
        setup.time =
            TimeSpan { start_s: 0.0, end_s, output_s: end_s, stops_at_rest: false, allowance: Allowance::default() };
        setup
    }

    fn plate(&self) -> Shape {
        let lengths_m = Vector3::new(self.thickness_m, 2.0, 2.0);
        Shape::block(Point3::new(0.5 * self.thickness_m, 0.0, 0.0), lengths_m, &Matrix3::identity(), 0.0)
    }
}

/// A body of one segment with one sphere, in space.
fn ball(throw: &Throw, at_m: Vector3<f64>, velocity_m_s: Vector3<f64>) -> Setup {
    let inertia = 0.4 * throw.mass_kg * throw.radius_m.powi(2);
    let mut body = Body::rigid(LOOSE, throw.mass_kg, [inertia; 3], Vector3::zeros());
    let segment = body.tree.segment(0);
    body.spheres.push(ContactSphere::new("ball", segment, Point3::origin(), throw.radius_m));
    body.segments[0].length_m = 0.1;
    let attitude = VehiclePose::default().attitude;
    let (point_m, place_m) = (Vector3::zeros(), at_m);
    let at = Mounting { frame: Frame::Vehicle, point_m, place_m, attitude, angles_rad: Vec::new() };
    Setup {
        joints: Joints::free(body.tree),
        posture: InitialPosture::Placed(Box::new(Placing { at, stands: false, spin_rad_s: Vector3::zeros() })),
        velocity: InitialVelocity::Given(velocity_m_s),
        body,
        ..afloat(occupant_tests::cases::bead(0.04), 1.0, 1e-3)
    }
}

fn solid(shape: Shape) -> Solid {
    Solid { name: "plate".into(), frame: Frame::Vehicle, shape, material: 0, group: None, spheres: None }
}

/// Velocity at the end along x, m/s, with the greatest error of the energy balance.
fn rebound(setup: Setup) -> (f64, f64) {
    let model = Model::new(setup).unwrap_or_else(|problems| panic!("{problems}"));
    let mut last = 0.0;
    let outcome = simulate(&model, Watch(|s: &Sample<'_>| last = s.state.velocity().x)).unwrap();
    assert_eq!(outcome.status, Status::Completed);
    (last, outcome.energy.balance_error.abs())
}

const STEPS_S: [f64; 3] = [1e-4, 5e-5, 3e-4];

#[test]
fn none_of_a_thousand_balls_passes_a_plate() {
    let mut random = Random::new(1);
    let (mut worst, mut steady) = (0.0_f64, 0);
    for i in 0..1000 {
        let throw = Throw::random(&mut random);
        let (speed, _) = rebound(throw.setup(throw.plate(), Integrator::default()));
        let error = (speed / throw.speed_m_s + 1.0).abs();
        worst = worst.max(error);
        assert!(error < 1e-4, "{throw:?}: {speed} m/s");
        let step_s = STEPS_S[i % STEPS_S.len()];
        let (speed, _) = rebound(throw.setup(throw.plate(), Integrator::Rk4 { step_s }));
        assert!(speed < 0.0, "{throw:?}, {step_s} s: {speed} m/s");
        // where the step bears the spring
        if step_s < 0.5 * (throw.mass_kg / throw.stiffness_n_per_m).sqrt() {
            steady += 1;
            let error = (speed / throw.speed_m_s + 1.0).abs();
            assert!(error < 0.05, "{throw:?}, {step_s} s: {speed} m/s");
        }
    }
    assert!(steady > 100, "{steady}");
    assert_below("rebound under error control", worst, 1e-4);
}

#[test]
fn fast_balls_pass_neither_bars_nor_edges() {
    let mut random = Random::new(2);
    for i in 0..200 {
        let mut throw = Throw { aside: 0.0, ..Throw::random(&mut random) };
        // an axis is passed with an energy of the spring that is as deep as both radii
        let bar_m = random.between(1e-3, 5e-3);
        let depth_m = 0.8 * (throw.radius_m + bar_m);
        throw.stiffness_n_per_m = throw.mass_kg * (throw.speed_m_s / depth_m).powi(2);
        let ends_m = [-1.0, 1.0].map(|z| Point3::new(bar_m, 0.0, z));
        let bar = Shape::Capsule { ends_m, radius_m: bar_m };
        for integrator in [Integrator::default(), Integrator::Rk4 { step_s: STEPS_S[i % STEPS_S.len()] }] {
            let (speed, balance) = rebound(throw.setup(bar.clone(), integrator));
            assert!(speed < 0.0, "{throw:?}, {integrator:?}: {speed} m/s, balance {balance}");
        }
    }
}

/// Beside the middle of posts, rims and edges of plates, at most: where it goes on as one does that hard things throw off.
#[test]
fn balls_that_meet_posts_rims_and_edges_are_thrown_off_and_pass_none() {
    let mut random = Random::new(3);
    let mut worst = 0.0_f64;
    for i in 0..300 {
        let mut throw = Throw { aside: 0.0, ..Throw::random(&mut random) };
        let tube_m = if i % 3 == 2 { 0.0 } else { random.between(1e-3, 5e-3) };
        let round_m = throw.radius_m + tube_m;
        // a hundredth of that deep
        throw.stiffness_n_per_m = throw.mass_kg * (throw.speed_m_s / (0.01 * round_m)).powi(2);
        let beside = random.between(0.0, 0.8);
        let shape = match i % 3 {
            0 => Shape::Capsule { ends_m: [-1.0, 1.0].map(|z| Point3::new(0.0, 0.0, z)), radius_m: tube_m },
            1 => Shape::Rim {
                centre_m: Point3::new(0.0, -0.19, 0.0),
                axis: Vector3::x(),
                ring_radius_m: 0.19,
                tube_radius_m: tube_m,
            },
            _ => {
                let (middle, lengths_m) = (0.5 * throw.thickness_m, Vector3::new(throw.thickness_m, 1.0, 2.0));
                Shape::block(Point3::new(middle, -0.5, 0.0), lengths_m, &Matrix3::identity(), 0.0)
            }
        };
        // it touches where the normal is (−cos φ, sin φ)
        let (sine, cosine) = (beside, (1.0 - beside * beside).sqrt());
        let expected = Vector3::new(1.0 - 2.0 * cosine * cosine, 2.0 * cosine * sine, 0.0) * throw.speed_m_s;
        let came = Vector3::new(throw.speed_m_s, 0.0, 0.0);
        for integrator in [Integrator::default(), Integrator::Rk4 { step_s: STEPS_S[i % STEPS_S.len()] }] {
            let mut setup = throw.setup(shape.clone(), integrator);
            let start = Vector3::new(-throw.before_m - tube_m, beside * round_m, 0.0);
            let moved = ball(&throw, start, came);
            (setup.posture, setup.velocity) = (moved.posture, moved.velocity);
            if let InitialPosture::Placed(placing) = &mut setup.posture {
                placing.spin_rad_s = Vector3::from_fn(|_, _| random.between(-100.0, 100.0));
            }
            let model = Model::new(setup).unwrap_or_else(|problems| panic!("{problems}"));
            let mut went = came;
            // velocities are in axes of space, where y points to the left
            let watch = Watch(|s: &Sample<'_>| {
                let v = s.cg_velocity_m_s(s.model.body().tree.segment(0));
                went = Vector3::new(v.x, -v.y, -v.z);
            });
            assert_eq!(simulate(&model, watch).unwrap().status, Status::Completed);
            let off = (went - expected).norm() / throw.speed_m_s;
            if integrator == Integrator::default() {
                worst = worst.max(off);
                assert!(off < 0.05, "{throw:?} beside {beside} of {shape:?}: {went:?}, expected {expected:?}");
            }
            let turned = (went - came).norm() / (expected - came).norm();
            assert!(turned > 0.3, "{throw:?} beside {beside} of {shape:?}, {integrator:?}: {went:?}");
        }
    }
    assert_below("against hard ones", worst, 0.05);
}

/// Speed along the plate and spin that friction of `coefficient` leaves, m/s and rad/s, by itself: the push is half a sine, and the
/// friction acts half-way into the overlap.
fn rubbed(throw: &Throw, coefficient: f64, spin_rad_s: f64) -> [f64; 2] {
    let Throw { mass_kg, stiffness_n_per_m, radius_m, speed_m_s, aside, .. } = *throw;
    let pace = (stiffness_n_per_m / mass_kg).sqrt();
    let about = 0.4 * mass_kg * radius_m.powi(2);
    let rate = |t: f64, [along, spin]: [f64; 2]| {
        let depth_m = speed_m_s / pace * (pace * t).sin();
        let lever_m = (radius_m - 0.5 * depth_m).max(0.0);
        let slip = along + spin * lever_m;
        let push = -coefficient * stiffness_n_per_m * depth_m * slip / slip.hypot(DEFAULT_FRICTION_SPEED_M_S);
        [push / mass_kg, push * lever_m / about]
    };
    let h = throw.contact_s() / 20_000.0;
    (0..20_000).fold([aside * speed_m_s, spin_rad_s], |y, i| step(h * f64::from(i), h, y, &rate))
}

#[test]
fn balls_that_spin_and_rub_pass_no_plate_and_get_no_more_along_it_than_friction_gives() {
    let mut random = Random::new(4);
    let (mut worst, mut gripped) = ([0.0_f64; 2], 0);
    for i in 0..300 {
        let mut throw = Throw::random(&mut random);
        // no deeper than a half of the ball
        let least = throw.mass_kg * (2.0 * throw.speed_m_s / throw.radius_m).powi(2);
        throw.stiffness_n_per_m = throw.stiffness_n_per_m.max(least);
        let coefficient = random.between(0.02, 0.6);
        let spin = random.between(-2.0, 2.0) * throw.speed_m_s / throw.radius_m;
        let [along, turning] = rubbed(&throw, coefficient, spin);
        gripped += u32::from((along - throw.aside * throw.speed_m_s).abs() < 1.9 * coefficient * throw.speed_m_s);
        for integrator in [Integrator::default(), Integrator::Rk4 { step_s: STEPS_S[i % STEPS_S.len()] }] {
            let mut setup = throw.setup(throw.plate(), integrator);
            setup.materials[0].friction = coefficient;
            if let InitialPosture::Placed(placing) = &mut setup.posture {
                placing.spin_rad_s = Vector3::z() * spin;
            }
            let model = Model::new(setup).unwrap_or_else(|problems| panic!("{problems}"));
            let [mut went, mut spun] = [Vector3::zeros(); 2];
            // in axes of space y points to the left and z up
            let watch = Watch(|s: &Sample<'_>| {
                let ball = s.model.body().tree.segment(0);
                (went, spun) = (s.cg_velocity_m_s(ball), s.angular_velocity_rad_s(ball));
            });
            let outcome = simulate(&model, watch).unwrap();
            assert_eq!(outcome.status, Status::Completed);
            let (across, pushed) = (went.x - throw.speed_m_s, -went.y - throw.aside * throw.speed_m_s);
            assert!(went.x < 0.0, "{throw:?}, {integrator:?}: {went:?}");
            // of the integrals of a push and of what it lets friction be at most
            assert!(pushed.abs() <= 1.001 * coefficient * across.abs(), "{throw:?}, {integrator:?}: {pushed} {across}");
            if integrator == Integrator::default() {
                let size = throw.speed_m_s.hypot(spin * throw.radius_m);
                let off = [-went.y - along, (-spun.z - turning) * throw.radius_m].map(|off| off.abs() / size);
                worst = [worst[0].max(off[0]), worst[1].max(off[1])];
            }
        }
    }
    assert!((50..250).contains(&gripped), "{gripped}");
    assert_below("along the plate", worst[0], 1e-4);
    assert_below("spin", worst[1], 1e-4);
}

#[test]
fn a_ball_leaves_an_elastic_plate_as_fast_as_it_came_after_half_a_period() {
    for (speed_m_s, mass_kg) in [(18.0, 0.02), (30.0, 0.02), (90.0, 0.001)] {
        let throw = Throw {
            radius_m: 5e-3,
            mass_kg,
            stiffness_n_per_m: 1e6,
            thickness_m: 2e-3,
            speed_m_s,
            before_m: 0.1,
            aside: 0.0,
        };
        let touch_s = (throw.before_m - throw.radius_m) / speed_m_s;
        let mut setup = throw.setup(throw.plate(), Integrator::default());
        setup.time.output_s = 1e-6;
        setup.time.end_s = touch_s + 1.5 * throw.contact_s();
        let (mut first, mut last, mut impulse, mut deepest) = (None, 0.0, 0.0, 0.0_f64);
        let look = Watch(|s: &Sample<'_>| {
            for contact in s.contacts() {
                first = first.or(Some(s.time_s));
                (last, deepest) = (s.time_s, deepest.max(contact.depth_m));
                impulse += 1e-6 * contact.normal_force_n;
            }
        });
        simulate(&Model::new(setup).unwrap(), look).unwrap();
        // measured to the outputs of 1 µs
        assert_below("begin, s", (first.unwrap_or(0.0) - touch_s).abs(), 1.1e-6);
        assert_below("length, s", (last - touch_s - throw.contact_s()).abs(), 1.1e-6);
        assert_below("impulse", (impulse / (2.0 * mass_kg * speed_m_s) - 1.0).abs(), 1e-3);
        let deep_m = speed_m_s * (mass_kg / throw.stiffness_n_per_m).sqrt();
        assert_below("depth", (deepest / deep_m - 1.0).abs(), 1e-3);
    }
}

#[test]
fn lanes_give_throws_the_bits_of_single_runs() {
    ends_alike_side_by_side(|i| {
        let throw = Throw::random(&mut Random::new(u64::from(i) + 7));
        let mut setup = throw.setup(throw.plate(), Integrator::Rk4 { step_s: 1e-4 });
        setup.time.output_s = 1.3e-3;
        Model::new(setup).unwrap()
    });
}
