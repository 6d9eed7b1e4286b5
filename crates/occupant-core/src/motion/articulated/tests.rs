//! Point masses that slide, against golden numbers and against all equations at once.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use crate::motion::dynamics::{Sweep, Wrench};
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::{Freedom, Layout, MOST_SEGMENTS, MOST_SLIDES};
use crate::motion::skeleton::{Part, Skeleton, Slide};
use crate::motion::state::{SLIDE_UNITS, Shape, State};
use crate::motion::vector::V3;

/// m, û, r₀, s, ṡ and Q − S.
struct Point(f64, Vector3<f64>, Vector3<f64>, f64, f64, f64);

impl Point {
    fn r(&self) -> Vector3<f64> {
        self.2 + self.1 * self.3
    }
}

/// A segment without its point masses: mass, centre of gravity, inertia about it, angular velocity, force and moment at
/// the joint.
struct Alone {
    mass: f64,
    cg: Vector3<f64>,
    inertia: Matrix3<f64>,
    omega: Vector3<f64>,
    force: Vector3<f64>,
    moment: Vector3<f64>,
}

/// Articulated inertia of a point mass, about the origin.
fn about(mass: f64, at: Vector3<f64>) -> Matrix3<f64> {
    (Matrix3::identity() * at.norm_squared() - at * at.transpose()) * mass
}

/// Accelerations of joint and point masses, and angular acceleration, by the sweep; the point masses are part of the
/// segment.
fn swept(alone: &Alone, points: &[Point]) -> Vec<f64> {
    let mass_kg = alone.mass + points.iter().map(|p| p.0).sum::<f64>();
    let sigma = points.iter().fold(alone.cg * alone.mass, |sum, p| sum + p.2 * p.0);
    let joint = points.iter().fold(alone.inertia + about(alone.mass, alone.cg), |sum, p| sum + about(p.0, p.2));
    let cg_m = sigma / mass_kg;
    let inertia_kg_m2 = joint - about(mass_kg, cg_m);
    let part = Part { mass_kg, cg_m, inertia_kg_m2, joint_m: Vector3::zeros(), triads: [Matrix3::identity(); 2] };
    let layout = Layout::new(&[(None, Freedom::Ball)]).unwrap();
    let shape = Shape::of(&layout);
    let mut skeleton = Skeleton::of(layout, &[part], 0.0).without_closed_forms();
    let slide = |p: &Point| Slide { segment: 0, mass: p.0, place: V3::of(&p.2), axis: V3::of(&p.1) };
    skeleton.slides = points.iter().map(slide).collect();
    let own: Vec<f64> = points.iter().flat_map(|p| [p.3 / SLIDE_UNITS[0], p.4 / SLIDE_UNITS[1]]).collect();
    let mut state = State::zero(shape).with_own(&own);
    let upright = crate::motion::state::Quat { w: 1.0, v: V3::zero() };
    state.set_orientation(0, upright);
    state.set_omega(0, V3::of(&alone.omega));
    let k = Kinematics::new(&skeleton, &state);
    let (mut wrench, mut drive) = ([Wrench::zero(); MOST_SEGMENTS], [0.0; MOST_SLIDES]);
    wrench[0] = Wrench { force: V3::of(&alone.force), moment: V3::of(&alone.moment) };
    drive.iter_mut().zip(points).for_each(|(drive, p)| *drive = p.5);
    let mut sweep = Sweep::blank(&skeleton);
    sweep.solve(&skeleton, &k, &[], (&wrench, &drive), None);
    let found = &sweep.accelerations;
    let both = [found.joint[0], found.alpha[0]].map(|v| [v.x, v.y, v.z]);
    both.into_iter().flatten().chain(found.slides[..points.len()].iter().copied()).collect()
}

/// The same from one matrix of all unknowns.
fn dense(alone: &Alone, points: &[Point]) -> Vec<f64> {
    let (n, w, sigma) = (6 + points.len(), alone.omega, alone.cg * alone.mass);
    let joint = alone.inertia + about(alone.mass, alone.cg);
    let (mut matrix, mut right) = (DMatrix::<f64>::zeros(n, n), DVector::<f64>::zeros(n));
    matrix.view_mut((0, 0), (3, 3)).copy_from(&(Matrix3::identity() * alone.mass));
    matrix.view_mut((0, 3), (3, 3)).copy_from(&-sigma.cross_matrix());
    matrix.view_mut((3, 0), (3, 3)).copy_from(&sigma.cross_matrix());
    matrix.view_mut((3, 3), (3, 3)).copy_from(&joint);
    right.rows_mut(0, 3).copy_from(&(alone.force - w.cross(&w.cross(&sigma))));
    right.rows_mut(3, 3).copy_from(&(alone.moment - w.cross(&(joint * w))));
    for (i, p) in points.iter().enumerate() {
        let mut velocity = DMatrix::<f64>::zeros(3, n);
        velocity.view_mut((0, 0), (3, 3)).copy_from(&Matrix3::identity());
        velocity.view_mut((0, 3), (3, 3)).copy_from(&-p.r().cross_matrix());
        velocity.view_mut((0, 6 + i), (3, 1)).copy_from(&p.1);
        let bias = w.cross(&w.cross(&p.r())) + w.cross(&p.1) * (2.0 * p.4);
        matrix += velocity.transpose() * &velocity * p.0;
        right -= velocity.transpose() * bias * p.0;
        right[6 + i] += p.5;
    }
    matrix.lu().solve(&right).unwrap().iter().copied().collect()
}

fn worst(found: &[f64], expected: &[f64]) -> f64 {
    let size = expected.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    found.iter().zip(expected).map(|(a, b)| (a - b).abs() / size).fold(0.0, f64::max)
}

/// A trunk with two plates; expected accelerations are from an independent program.
#[test]
fn two_plates_of_a_trunk_accelerate_as_golden_numbers_say() {
    let v = Vector3::new;
    let alone = Alone {
        mass: 20.0,
        cg: v(0.02, 0.0, 0.15),
        inertia: Matrix3::from_diagonal(&v(0.44, 0.33, 0.29)),
        omega: v(2.0, -4.0, 1.0),
        force: v(-800.0, 50.0, 20.0),
        moment: v(3.0, -40.0, 5.0),
    };
    let golden = [
        -69.80299521310822,
        8.006628972711836,
        7.5556835793929595,
        23.553745250227454,
        165.6199680873881,
        -57.892829330307165,
        -1541.3314009573783,
        612.0563521527064,
    ];
    let inward = -Vector3::x();
    for slid in [0.0, 0.05, -0.02] {
        let at = |r: Vector3<f64>| r - inward * slid;
        let points = [
            Point(0.2, inward, at(v(0.1, 0.0, 0.18)), slid, 1.5, -300.0),
            Point(0.3, inward, at(v(0.09, 0.1, 0.07)), slid, -0.5, 200.0),
        ];
        let found = worst(&swept(&alone, &points), &golden);
        assert!(found < 1e-13, "slid by {slid}: {found:e}");
    }
}

#[test]
fn plates_in_any_direction_accelerate_as_all_equations_at_once_say() {
    let mut seed = 7_u64;
    let mut random = move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let mut most = 0.0_f64;
    for _ in 0..200 {
        let mut v = |size: f64| Vector3::new(random(), random(), random()) * size;
        let shape = Matrix3::from_columns(&[v(2.0), v(2.0), v(2.0)]);
        let alone = Alone {
            mass: 20.0 + v(5.0).x,
            cg: v(0.4),
            inertia: shape * shape.transpose() * 0.1 + Matrix3::identity() * 0.2,
            omega: v(10.0),
            force: v(2e3),
            moment: v(2e2),
        };
        let mut point = || Point(0.7 + v(1.0).x, v(1.0).normalize(), v(0.4), v(0.2).x, v(6.0).x, v(1e3).x);
        let points = [point(), point(), point()];
        most = most.max(worst(&swept(&alone, &points), &dense(&alone, &points)));
    }
    // Measured: see the bound's factor of ten.
    assert!(most < 1e-12, "{most:e}");
}
