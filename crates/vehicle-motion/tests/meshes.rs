//! Ground of triangles: grids of heights, and roads with bends.

use core::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Rotation3, Vector3};
use vehicle_motion::car::{Car, Class};
use vehicle_motion::driver::{Driver, Steering, Table};
use vehicle_motion::ground::{Ground, GroundError, Mesh, Road, Station};
use vehicle_motion::run::{Drive, Start};

type V3 = Vector3<f64>;

const DITCH: [[f64; 2]; 5] = [[-20.0, 0.4], [3.0, 0.0], [11.0, -2.0], [14.0, -2.0], [26.0, 1.0]];

fn ditch() -> Ground {
    Ground::section(DITCH.to_vec(), 0.03).unwrap()
}

fn road(line_m: Vec<[f64; 2]>, radius_m: f64) -> Result<Ground, GroundError> {
    let stations = vec![Station { at_m: 0.0, corners_m: DITCH.to_vec() }];
    Road { line_m, radius_m, stations, grade: 0.03 }.mesh().map(Ground::mesh)
}

/// Heights of a ground at every metre.
fn surveyed(ground: &Ground, from_m: [f64; 2], counts: [usize; 2]) -> Ground {
    let at = |i: usize, j: usize| ground.height_m(from_m[0] + i as f64, from_m[1] + j as f64);
    let heights_m: Vec<f64> = (0..counts[0]).flat_map(|i| (0..counts[1]).map(move |j| at(i, j))).collect();
    Ground::mesh(Mesh::grid(from_m, [1.0, 1.0], counts, &heights_m).unwrap())
}

/// The same faces as a cross-section, as a road and as a grid give a wheel the same contact.
#[test]
fn a_wheel_meets_the_same_ground_however_it_is_given() {
    let section = ditch();
    let others = [road(vec![[0.0, 0.0], [30.0, 0.0]], 50.0).unwrap(), surveyed(&section, [-20.0, -20.0], [50, 50])];
    let mut met = 0;
    for (i, other) in others.iter().enumerate() {
        for n in 0..4000 {
            let share = |k: f64| (f64::from(n) * k).fract();
            let (x, y) = (-5.0 + 20.0 * share(0.618_034), -8.0 + 32.0 * share(0.414_214));
            let axle = Rotation3::from_euler_angles(0.4 * share(0.732_051) - 0.2, 0.0, PI * share(0.236_068)) * V3::y();
            let centre_m = V3::new(x, y, -section.height_m(x, y) - 0.34 + 0.1 * share(0.645_751));
            assert!((other.height_m(x, y) - section.height_m(x, y)).abs() < 1e-9, "{i}: {x} {y}");
            let [one, two] = [&section, other].map(|ground| ground.footprint(centre_m, axle, 0.32, 0.1));
            let (Some(one), Some(two)) = (one, two) else {
                assert_eq!(one.is_some(), two.is_some(), "{i}: {x} {y}");
                continue;
            };
            met += 1;
            // over corners the gradient is a difference over 1e-7 m
            let off = (one.depth_m - two.depth_m).abs() + (one.point_m - two.point_m).norm();
            let forces = (one.normal * one.share - two.normal * two.share).norm();
            assert!(off < 1e-6 && forces < 1e-5, "{i}: {x} {y}\n{one:?}\n{two:?}");
            let (near, far) = (section.distance(&centre_m), other.distance(&centre_m));
            assert!((near.0 - far.0).abs() < 1e-9, "{i}: {x} {y} {near:?} {far:?}");
        }
    }
    // measured 6568 contacts
    assert!(met > 6000, "{met}");
}

/// A car that leaves the road and crosses the ditch moves alike on all three; and on a road that runs another way, as
/// seen from there.
#[test]
fn a_ditch_is_crossed_alike_on_a_section_a_road_and_a_grid() {
    let car = Car::of_class(Class::Sedan);
    let drive = |ground: Ground, yaw_rad: f64| {
        let drive = Drive::new(&car, ground, Driver::coasting()).unwrap();
        let start = Start { speed_m_s: 20.0, yaw_rad: yaw_rad + 0.2, ..Start::default() };
        let ride = drive.run(&start, 2.5).unwrap();
        Rotation3::from_axis_angle(&V3::z_axis(), -yaw_rad) * ride.last().position_m
    };
    let section = drive(ditch(), 0.0);
    let turned = vec![[0.0, 0.0], [10.0 * libm::cos(0.7), 10.0 * libm::sin(0.7)]];
    let cases = [
        ("road", drive(road(vec![[0.0, 0.0], [30.0, 0.0]], 50.0).unwrap(), 0.0)),
        ("grid", drive(surveyed(&ditch(), [-10.0, -20.0], [90, 60]), 0.0)),
        ("turned road", drive(road(turned, 50.0).unwrap(), 0.7)),
    ];
    assert!(section.x > 40.0 && section.y > 6.0, "{section:?}");
    for (name, place) in cases {
        let off_m = (place - section).norm();
        // measured 0.13, 0.01, 0.002 mm; the tolerance is 0.1 mm
        assert!(off_m < 2e-4, "{name}: {off_m} m off {section:?}");
    }
}

/// A bend lies where its arc does; offsets count from the line, and the ground rises along it.
#[test]
fn a_bend_is_an_arc() {
    let radius_m = 60.0;
    // straight on to 40, a quarter turn to the right, straight to the right
    let ground = road(vec![[0.0, 0.0], [100.0, 0.0], [100.0, 80.0]], radius_m).unwrap();
    let centre = [40.0, 60.0];
    for i in 0..=90 {
        let angle = FRAC_PI_2 * f64::from(i) / 90.0;
        for right_m in [-15.0, -1.0, 0.0, 2.0, 8.0, 12.0, 20.0] {
            let out_m = radius_m - right_m;
            let (x, y) = (centre[0] + out_m * angle.sin(), centre[1] - out_m * angle.cos());
            let along_m = 40.0 + radius_m * angle;
            let expected = ditch().height_m(along_m, right_m);
            // chords of 1 m: 2 mm beside the arc, on slopes of at most 1:4
            assert!((ground.height_m(x, y) - expected).abs() < 2e-3, "{angle} {right_m}");
            assert!((ground.offset_m(x, y) - right_m).abs() < 3e-3, "{angle} {right_m}: {}", ground.offset_m(x, y));
        }
    }
    for (x, y, along_m, right_m) in [(-30.0, 5.0, -30.0, 5.0), (95.0, 90.0, 40.0 + 60.0 * FRAC_PI_2 + 30.0, 5.0)] {
        assert!((ground.height_m(x, y) - ditch().height_m(along_m, right_m)).abs() < 1e-9, "{x} {y}");
    }
    // beyond the centre of the bend there is still some ground
    assert!(ground.height_m(-300.0, 400.0).is_finite() && ground.height_m(41.0, 61.0).is_finite());
}

/// Round a bend whose bank is right for the speed a car rolls with next to no side force.
#[test]
fn a_banked_bend_carries_a_car_round() {
    let (radius_m, speed_m_s) = (80.0f64, 20.0f64);
    let bank = speed_m_s * speed_m_s / (9.806_65 * radius_m);
    let section = |bank: f64| vec![[-12.0, 12.0 * bank], [12.0, -12.0 * bank]];
    // a right bend is low on its right
    let line_m = vec![[0.0, 0.0], [300.0, 0.0], [300.0, 300.0]];
    let start_m = 300.0 - radius_m;
    let stations =
        [(start_m - 60.0, 0.0), (start_m - 10.0, bank)].map(|(at_m, bank)| Station { at_m, corners_m: section(bank) });
    let road = Road { line_m: line_m.clone(), radius_m, stations: stations.to_vec(), grade: 0.0 };
    let ground = Ground::mesh(road.mesh().unwrap());
    let car = Car::of_class(Class::Sedan);
    // the angle of a circle that is rolled slowly
    let steer = Table::constant((car.front.ahead_m - car.rear.ahead_m) / radius_m);
    let driver = Driver { steering: Steering::Table(steer), ..Driver::coasting() };
    let drive = Drive::new(&car, ground.clone(), driver).unwrap();
    // begun on the bank, in the bend's direction and turning with it
    let angle = 0.3f64;
    let start = Start {
        x_m: start_m + radius_m * angle.sin(),
        y_m: radius_m * (1.0 - angle.cos()),
        yaw_rad: angle,
        speed_m_s,
        yaw_rate_rad_s: speed_m_s / radius_m,
        ..Start::default()
    };
    let ride = drive.run(&start, 2.0).unwrap();
    let (mut aside_m_s2, mut most_m) = (0.0f64, 0.0f64);
    for station in ride.stations().iter().filter(|station| station.time_s > 0.5) {
        most_m = most_m.max(ground.offset_m(station.position_m.x, station.position_m.y).abs());
        let side_n: f64 = station.wheels.iter().map(|wheel| wheel.shear_n[1]).sum();
        aside_m_s2 = aside_m_s2.max(side_n.abs() / car.mass_kg);
    }
    // measured 1.2 m and 0.48 m/s²; on the level it would need 5 m/s²
    assert!(most_m < 1.5 && aside_m_s2 < 1.0, "{most_m} m {aside_m_s2} m/s2");
}

/// Over a grid, at headings that are not along its edges, where a tread has no breadth, the elastic force does no work on a closed path.
#[test]
fn a_way_over_a_grid_gains_no_energy() {
    let heights_m = [0.0, 0.0, 0.05, 0.0, 0.1, 0.0, 0.0, 0.2, 0.0, 0.0, 0.1, 0.05, 0.0, 0.0, 0.0, 0.0];
    let ground = Ground::mesh(Mesh::grid([-0.5, -0.5], [0.4, 0.4], [4, 4], &heights_m).unwrap());
    for (roll, yaw) in [(0.0, 0.3), (0.1, 0.6), (-0.2, 1.3)] {
        let axle = Rotation3::from_euler_angles(roll, 0.0, yaw) * V3::y();
        let force = |at: V3| {
            let found = ground.footprint(at, axle, 0.32, 0.1);
            found.map_or(V3::zeros(), |at| at.normal * (at.depth_m * at.share))
        };
        let corners = [[-0.3, -0.3, -0.36], [0.3, -0.1, -0.40], [0.2, 0.4, -0.36], [-0.3, -0.3, -0.36]].map(V3::from);
        let (mut work, mut most) = (0.0f64, 0.0f64);
        for pair in corners.windows(2) {
            let (way, n) = (pair[1] - pair[0], 4000);
            for i in 0..n {
                work += force(pair[0] + way * ((f64::from(i) + 0.5) / f64::from(n))).dot(&way) / f64::from(n);
                most = most.max(work.abs());
            }
        }
        // measured 1.8e-5, 2.4e-5, 7e-8
        assert!(most > 1e-5 && work.abs() < 1e-4 * most, "{roll} {yaw}: {work} of {most}");
    }
}

#[test]
fn mistakes_are_told() {
    let grid = |counts, heights: &[f64]| Mesh::grid([0.0; 2], [1.0; 2], counts, heights);
    assert_eq!(grid([1, 4], &[0.0; 4]), Err(GroundError::Grid { rows: 1, columns: 4, heights: 4 }));
    assert_eq!(grid([2, 2], &[0.0; 5]), Err(GroundError::Grid { rows: 2, columns: 2, heights: 5 }));
    assert_eq!(grid([usize::MAX, 3], &[0.0; 5]), Err(GroundError::Grid { rows: usize::MAX, columns: 3, heights: 5 }));
    assert_eq!(grid([2, 2], &[0.0, 0.0, f64::NAN, 0.0]), Err(GroundError::NotFinite));
    assert_eq!(Mesh::grid([0.0; 2], [1.0, 0.0], [2, 2], &[0.0; 4]), Err(GroundError::Spacing(0.0)));
    let tells = |line_m: Vec<[f64; 2]>, radius_m: f64| road(line_m, radius_m).unwrap_err().to_string();
    assert!(tells(vec![[0.0; 2]], 1.0).contains("at least two"));
    assert!(tells(vec![[0.0; 2], [0.0; 2]], 1.0).contains("the same"));
    assert!(tells(vec![[0.0; 2], [10.0, 0.0], [10.0, 90.0]], 50.0).contains("smaller radius"));
    assert!(tells(vec![[0.0; 2], [99.0, 0.0], [99.0, 99.0]], 24.0).contains("inside of a bend"));
    assert!(tells(vec![[0.0; 2], [99.0, 0.0], [0.0, 0.0]], 24.0).contains("smaller radius"));
    assert!(tells(vec![[0.0; 2], [99.0, 0.0], [99.0, 99.0]], f64::NAN).contains("must be numbers"));
    assert!(!tells(vec![[0.0; 2], [99.0, 0.0], [99.0, 99.0]], -50.0).is_empty());
    assert!(tells(vec![[0.0; 2], [1e300, 0.0]], 1.0).contains("at most 1000000 m"));
    let stations =
        vec![Station { at_m: 0.0, corners_m: DITCH.to_vec() }, Station { at_m: 0.0, corners_m: DITCH.to_vec() }];
    let line_m = vec![[0.0; 2], [99.0, 0.0]];
    let twice = Road { line_m: line_m.clone(), radius_m: 9.0, stations, grade: 0.0 };
    assert!(twice.mesh().unwrap_err().to_string().contains("not ahead"));
    let none = Road { line_m, radius_m: 9.0, stations: Vec::new(), grade: 0.0 };
    assert!(none.mesh().unwrap_err().to_string().contains("without a cross-section"));
    let curb = vehicle_motion::ground::Curb { right_m: 0.0, height_m: 0.1, face_rad: 1.4 };
    let straight = road(vec![[0.0; 2], [9.0, 0.0]], 5.0).unwrap();
    assert_eq!(straight.with_curbs(&[curb]), Err(GroundError::CurbsOnMesh));
}
