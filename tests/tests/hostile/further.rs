//! More calls of the same kind: of searches, laws, analyses and paths.

use crash_measures::measure::limits::Rule;
use nalgebra::{DMatrix, Matrix3, Point3, Vector3};
use occupant_core::forces::contact::solid::{Shape as Shape3, Solid};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::forces::joint::limit::Curve;
use occupant_core::model::Model;
use occupant_core::model::setup::Integrator;
use occupant_core::vehicle::{AccelerationRecord, Attitude, Baseline, VehiclePath, unwrap_angles};
use occupant_scenario::{Draft, Format};
use occupant_study::analysis::{rank_correlation, ranks, regression, screening, sobol_indices};
use occupant_study::misfit::{likelihood_rise, unrelated_samples};
use occupant_study::risk::{Flight, SensorErrors, VehicleRisk, VehicleSignals, attained, judge, prepare, sampled};
use occupant_study::search::{Descents, Point, Reach, Shape, descend, fold, profile, refine, scan};
use occupant_study::spread::{Band, Rule as Agreement, Spread, quantile};
use occupant_study::{Distribution, Keep, Law, Misfit, Study, Value};

use super::{Came, came, cart, model, report};

fn said(done: Result<impl Sized, impl std::fmt::Debug>) -> Result<(), String> {
    done.map(|_| ()).map_err(|error| format!("{error:?}"))
}

fn point(at: &[f64]) -> Point {
    Point { at: at.to_vec(), value: 1.0 }
}

/// A search that is told whatever `values` makes of its points.
fn told(
    values: fn(&[Vec<f64>]) -> Vec<f64>,
) -> impl FnMut(occupant_study::search::Stage, &[Vec<f64>]) -> Result<Vec<f64>, ()> {
    move |_, points| Ok(values(points))
}

fn bowl(points: &[Vec<f64>]) -> Vec<f64> {
    points.iter().map(|at| 1.0 + at.iter().map(|u| (u - 0.4) * (u - 0.4)).sum::<f64>()).collect()
}

fn nothing(_points: &[Vec<f64>]) -> Vec<f64> {
    Vec::new()
}

fn no_numbers(points: &[Vec<f64>]) -> Vec<f64> {
    vec![f64::NAN; points.len()]
}

fn too_many(points: &[Vec<f64>]) -> Vec<f64> {
    vec![1.0; 2 * points.len() + 1]
}

const REACH: [Reach; 2] = [Reach { length: 0.1, open: false }; 2];

fn shape() -> Shape {
    Shape::look(&point(&[0.4; 2]), &[REACH; 2], 0.01, &mut told(bowl)).unwrap().0
}

fn descents(evaluations: u64, population: usize, start: &[f64]) -> Descents {
    Descents { start: start.to_vec(), next: vec![], seed: 1, evaluations, population, tolerance: 1e-3 }
}

fn signals(count: [usize; 6], value: f64, dt_s: f64) -> VehicleSignals {
    let channels = count.map(|count| Some(vec![value; count]));
    VehicleSignals { start_s: 0.0, dt_s, channels, lead: Default::default(), initial: Attitude::default() }
}

/// Solids each of which has this number in some place.
fn shapes(x: f64) -> Vec<Shape3> {
    let (good, bad, up) = (Point3::origin(), Point3::new(0.0, x, 0.0), Vector3::z());
    let corners_m = vec![bad, Point3::new(1.0, 0.0, 0.0), Point3::new(0.0, 1.0, 0.0)];
    vec![
        Shape3::Prism { corners_m, half_width_m: 0.1, rounding_m: 0.01 },
        Shape3::block(good, Vector3::new(x, 1.0, 1.0), &Matrix3::identity(), 0.01),
        Shape3::Capsule { ends_m: [good, bad], radius_m: 0.1 },
        Shape3::Capsule { ends_m: [good, Point3::new(1.0, 0.0, 0.0)], radius_m: x },
        Shape3::HalfSpace { point_m: bad, normal: up },
        Shape3::HalfSpace { point_m: good, normal: Vector3::new(0.0, x, 0.0) },
    ]
}

fn study() -> Study {
    let draft = Draft::read(include_str!("../../../scenarios/cart-lap-torso.toml"), Format::Toml, "cart").unwrap();
    Study::of_ensemble(draft, "cart", 3, 1, &Default::default())
}

type Row = (&'static str, fn() -> Result<(), String>, bool);

#[rustfmt::skip]
const ROWS: &[Row] = &[
    ("a search without end", || said(descend(&descents(u64::MAX, usize::MAX, &[f64::NAN]), &mut told(bowl))), false),
    ("a search of nothing", || said(descend(&descents(u64::MAX, 4, &[]), &mut told(bowl))), false),
    ("a search that is told nothing", || said(descend(&descents(40, 4, &[0.5; 2]), &mut told(nothing))), false),
    ("a search that is told no numbers", || said(descend(&descents(40, 4, &[0.5; 2]), &mut told(no_numbers))), false),
    ("a search that is told too much", || said(descend(&descents(40, 4, &[0.5; 2]), &mut told(too_many))), false),
    ("a walk without lengths", || said(refine(point(&[0.5; 3]), &[], 0.1, &mut told(bowl)).map(|found| assert!(found.value <= 1.0, "no better than {}", found.value))), false),
    ("a walk of no lengths", || said(refine(point(&[0.5; 3]), &[f64::NAN; 3], f64::NAN, &mut told(bowl))), false),
    ("a walk beyond the walls", || said(refine(point(&[7.0, -3.0, f64::NAN]), &[0.1; 3], 0.1, &mut told(bowl)).map(|found| assert!(found.at.iter().all(|u| (0.0..=1.0).contains(u))))), false),
    ("a walk that is told nothing", || said(refine(point(&[0.5; 2]), &[0.1; 2], 0.1, &mut told(nothing))), false),
    ("a scan from nowhere", || said(scan(&point(&[f64::NAN, 9.0]), 0.0, &mut told(bowl))), false),
    ("a scan that is told nothing", || said(scan(&point(&[0.5]), 0.1, &mut told(nothing))), false),
    ("a shape of more reaches than coordinates", || said(Shape::look(&point(&[0.5]), &[REACH; 4], 0.1, &mut told(bowl))), false),
    ("a shape of no rise", || said(Shape::look(&point(&[0.5]), &[REACH], f64::NAN, &mut told(bowl))), false),
    ("a profile without reaches", || said(profile(&point(&[0.4; 2]), &[], &shape(), 0.01, &mut told(bowl)).map(|all| assert!(all.ends.len() == 2 && all.ends[0][0].open))), false),
    ("a profile of another shape", || { let mut shape = shape(); shape.curvature = DMatrix::zeros(0, 0); said(profile(&point(&[0.4; 2]), &[REACH; 2], &shape, 0.01, &mut told(bowl))) }, false),
    ("a profile of a shape of elsewhere", || { let mut shape = shape(); shape.free[0] = 99; said(profile(&point(&[0.4; 2]), &[REACH; 2], &shape, 0.01, &mut told(bowl))) }, false),
    ("a profile of reaches backwards", || said(profile(&point(&[0.4; 2]), &[[Reach { length: f64::NAN, open: false }, Reach { length: -3.0, open: true }]; 2], &shape(), 0.01, &mut told(bowl))), false),
    ("a profile that is told nothing", || said(profile(&point(&[0.4; 2]), &[REACH; 2], &shape(), 0.01, &mut told(nothing))), false),
    ("a fold of no number", || { assert!(fold(f64::NAN).is_nan()); Ok(()) }, false),
    ("a distribution whose ends are reversed", || { for of in [Distribution::TruncatedNormal { mean: 0.0, sd: 1.0, from: 1.0, to: -1.0 }, Distribution::Triangular { from: 2.0, mode: 1.0, to: 0.0 }, Distribution::LogUniform { from: f64::NAN, to: f64::NAN }, Distribution::TruncatedNormal { mean: f64::NAN, sd: 0.0, from: f64::NAN, to: 1.0 }] { for p in [0.0, 0.5, 1.0, f64::NAN, -1.0] { let _any = Law::Distribution(of.clone()).quantile(p); } } Ok(()) }, false),
    ("levels that there are not", || { assert_eq!(Law::List(Vec::new()).level(7), Value::Base); assert_eq!(Law::List(Vec::new()).quantile(f64::NAN), Value::Base); let _any = Law::Grid { from: 0.0, to: 1.0, steps: 0, log: true }.level(u64::MAX); Ok(()) }, false),
    ("a run of a study that there is not", || { let study = study(); assert!(study.sample(u64::MAX).is_empty()); said(study.draft(u64::MAX)) }, false),
    ("a study of no members", || { let mut study = study(); if let Some(ensemble) = &mut study.ensemble { ensemble.members = 0; } assert_eq!(study.sample_and_member(7), (7, 0)); Ok(()) }, false),
    ("runs to keep that say nothing", || Keep::from_words("worst 0 by hic15").map(|_| ()).ok_or_else(|| "none".into()), true),
    ("a spread of nothing", || { assert!(Spread::of(&[f64::NAN]).is_none() && quantile(&[], 0.5).is_none()); Ok(()) }, false),
    ("a spread that agrees with nothing", || { let _any = Spread::of(&[1.0, 2.0]).unwrap().verdict(&Agreement { relative: f64::NAN, absolute: f64::NAN, least_members: 0 }); Ok(()) }, false),
    ("a band of uneven members", || { let band = Band::of(&[&[1.0, 2.0, 3.0], &[], &[f64::NAN]]); assert_eq!((band.len(), band.time_wider_than(&[], 0.0)), (3, None)); Ok(()) }, false),
    ("a misfit of uneven histories", || said(Misfit::Rms.of(&[1.0, 2.0], &[1.0], 1e-3)), true),
    ("a misfit at no interval", || said(Misfit::PeakAndTime.of(&[1.0, 2.0], &[1.0, 2.0], f64::NAN)), true),
    ("samples that are none", || { assert_eq!(unrelated_samples(&[]), 0.0); assert!(likelihood_rise(1.0, f64::NAN) > 0.0); Ok(()) }, false),
    ("ranks of no numbers", || { assert_eq!(ranks(&[f64::NAN; 3]).len(), 3); Ok(()) }, false),
    ("a correlation of nothing", || said(rank_correlation(&[], &[])), true),
    ("a regression of uneven columns", || said(regression(&[vec![1.0; 3]], &[1.0; 30], 0)), true),
    ("a regression by one parameter twice", || { let x: Vec<f64> = (0..30).map(f64::from).collect(); said(regression(&[x.clone(), x.clone()], &x, 0)) }, true),
    ("indices of uneven columns", || said(sobol_indices(&[1.0; 30], &[2.0; 30], &[vec![1.0; 7]], 0)), true),
    ("indices of what is always the same", || said(sobol_indices(&[1.0; 30], &[1.0; 30], &[vec![1.0; 30]], 0)), true),
    ("a screening of no numbers", || said(screening(&[vec![f64::NAN; 9]], 0)), true),
    ("risk of channels of uneven lengths", || { let risk = VehicleRisk::of(&signals([3, 9, 0, 1, 2, 4], 1.0, 1e-3), &Flight::default()); assert!(risk.flail.is_err() && risk.thiv.is_err()); Ok(()) }, false),
    ("risk of no numbers", || { let risk = VehicleRisk::of(&signals([100; 6], f64::NAN, 1e-3), &Flight::default()); assert!(risk.flail.is_err()); let _any = attained(Rule::Mash2016, &judge(&risk, &[Rule::Mash2016])); Ok(()) }, false),
    ("risk at no interval", || { let risk = VehicleRisk::of(&signals([100; 6], 1.0, 0.0), &Flight::default()); assert!(risk.flail.is_err()); Ok(()) }, false),
    ("sensors of endless errors", || { let _any = SensorErrors { gain: f64::INFINITY, place_m: f64::NAN, angle_rad: 1e300, ..SensorErrors::default() }.member(&signals([5, 5, 5, 2, 0, 5], 1.0, 1e-3), 3); Ok(()) }, false),
    ("signals of an empty record", || said(prepare(&AccelerationRecord::default(), &Default::default())), true),
    ("a path sampled for ever", || sampled(&VehiclePath::parked(), 0.0, f64::INFINITY, 1e-3).map(|_| ()).ok_or_else(|| "none".into()), true),
    ("a jolt looked for without end", || { assert_eq!(VehiclePath::parked().jolt_s([0.0, f64::INFINITY], None, 1.0, 0.0), None); Ok(()) }, false),
    ("a change looked for at no time", || { assert_eq!(VehiclePath::parked().change_s([f64::NAN; 2], 1.0, 0.0), None); Ok(()) }, false),
    ("zeros of other samples", || { let rest = Baseline::of(&[0.0, 0.1, 0.2, 0.3], 0.1, Some(0.1)).unwrap(); rest.take(&[0.0], &mut [1.0], 0.0); rest.take(&[0.0; 4], &mut [1.0], 0.0); Ok(()) }, false),
    ("a curve through nothing", || { let _any = Curve::periodic(&[]).around(1.0); let _any = Curve::periodic(&[[0.0, 1.0]]).around(1.0); Ok(()) }, false),
    ("no stations to unwrap", || { unwrap_angles(&mut []); Ok(()) }, false),
    ("the home of a frame that there is not", || { let setup = cart().at_home(Frame::Other(7)); model(setup) }, true),
    ("spheres of members that there are not", || { let all = cart().together(Vec::new(), &[[(9, 0), (0, usize::MAX)]], &[]); model(all) }, true),
    ("solids of no place", || { for shape in shapes(f64::NAN).into_iter().chain(shapes(f64::INFINITY)) { let words = format!("{shape:?}"); let mut setup = cart(); setup.solids.push(Solid { name: "odd".into(), frame: Frame::Vehicle, shape, material: 0, group: None, spheres: None }); assert!(Model::new(setup).is_err(), "{words}"); } Ok(()) }, false),
    ("another integrator that cannot be", || said(Model::new(cart()).unwrap().with_integrator(Integrator::Rk4 { step_s: -1.0 })), true),
    ("outputs that cannot be", || said(Model::new(cart()).unwrap().with_outputs_every(f64::NAN)), true),
];

#[test]
fn searches_laws_and_paths_refuse_as_well() {
    let mut failures = Vec::new();
    for (name, call, refused) in ROWS {
        match came(name, call) {
            Ok(came) if matches!(came, Came::Refused(_)) == *refused => {}
            Ok(came) => failures.push(format!("{name}: {came:?}")),
            Err(words) => failures.push(words),
        }
    }
    report(&failures);
    assert!(ROWS.len() >= 50, "{}", ROWS.len());
}
