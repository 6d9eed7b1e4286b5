//! Functions of the crates below and beside the simulator.

use crash_measures::signal::CumulativeIntegral;
use nalgebra::Vector3;
use occupant_core::body::named::{NamedJoint, NamedLandmarks, tree};
use occupant_core::body::people::{Division, Person};
use occupant_core::body::{Body, JointKind, Segment};
use occupant_core::forces::joint::{BallJoint, Joints};
use occupant_core::model::Model;
use occupant_core::run::batch::Kernel;
use occupant_scenario::{Draft, Format};
use occupant_study::engine::Engine;
use occupant_study::search::Cma;
use occupant_study::sensitivity::measures::{Request, derivatives};
use occupant_study::sensitivity::{Built, Parameter, follow};

use super::{Came, came, cart, report};

fn joint<'a>(name: &'a str, proximal: &'a str, distal: &'a str) -> NamedJoint<'a> {
    NamedJoint { name, kind: JointKind::Ball, proximal, distal, hangs: false }
}

fn other() -> (Body, Segment) {
    let body = Person::named("male50").unwrap().body(Division::of(17).unwrap()).0;
    let last = body.tree.segments().last().unwrap();
    (body, last)
}

fn said(done: Result<impl Sized, impl std::fmt::Debug>) -> Result<(), String> {
    done.map(|_| ()).map_err(|error| format!("{error:?}"))
}

fn grown(joints: &[NamedJoint<'_>]) -> Result<(), String> {
    said(tree(joints, &NamedLandmarks { is_part: true, ..NamedLandmarks::default() }))
}

/// A name, the call, and whether it is refused.
type Row = (&'static str, fn() -> Result<(), String>, bool);

const SPINE: [(&str, &str, &str); 2] = [("back", "pelvis", "chest"), ("neck", "chest", "head")];

fn spine<'a>(more: &[NamedJoint<'a>]) -> Vec<NamedJoint<'a>> {
    SPINE.iter().map(|(name, a, b)| joint(name, a, b)).chain(more.iter().copied()).collect()
}

#[rustfmt::skip]
const ROWS: &[Row] = &[
    ("a tree", || grown(&spine(&[])), false),
    ("a joint on a misspelt segment", || grown(&spine(&[joint("tail", "pelvsi", "tail")])), true),
    ("a segment on two joints", || grown(&spine(&[joint("tail", "pelvis", "head")])), true),
    ("a segment on itself", || grown(&spine(&[joint("tail", "tail", "tail")])), true),
    ("joints in the wrong order", || grown(&[joint("a", "pelvis", "chest"), joint("b", "neck", "head"), joint("c", "chest", "neck")]), true),
    ("a tree without a head", || said(tree(&[joint("back", "pelvis", "chest")], &NamedLandmarks::default())), true),
    ("no tree", || said(tree(&[], &NamedLandmarks::default())), true),
    ("a law of another tree's joint", || { let (body, _) = other(); let _ = Joints::male50().with(body.tree.joints().last().unwrap(), BallJoint::default()); Ok(()) }, false),
    ("another tree's ball", || { let (body, _) = other(); Joints::male50().ball_mut(body.tree.joints().last().unwrap()).map(|_| ()).ok_or_else(|| "none".into()) }, true),
    ("another tree's hinge", || { let (body, _) = other(); Joints::male50().hinge_mut(body.tree.joints().last().unwrap()).map(|_| ()).ok_or_else(|| "none".into()) }, true),
    ("hung on another's segment", || { let (_, last) = other(); assert_eq!(Body::male50().hung_on(last, &[last]).segments.len(), 12); Ok(()) }, false),
    ("a row of another tree", || { let (_, last) = other(); assert_eq!(Body::male50().tree[last].name, ""); Ok(()) }, false),
    ("segment without end", || { let body = Body::male50(); assert!(body.segment(body.tree.segment(usize::MAX)).mass_kg.is_nan()); Ok(()) }, false),
    ("a rigid body of no mass", || { let mut s = cart(); s.belts.clear(); s.body = Body::rigid("", f64::NAN, [0.0; 3], Vector3::repeat(f64::INFINITY)); s.joints = Joints::free(s.body.tree); super::model(s) }, true),
    ("spheres for one radius", || { assert_eq!(Body::male50().standard_spheres(&[0.1]).len(), 1); Ok(()) }, false),
    ("a person of no size", || Body::person(occupant_core::body::Sex::Male, f64::NAN, 80.0).map(|_| ()).ok_or_else(|| "none".into()), true),
    ("a person without mass", || Body::person(occupant_core::body::Sex::Female, 1.6, 0.0).map(|_| ()).ok_or_else(|| "none".into()), true),
    ("integral of nothing", || said(CumulativeIntegral::new(&[], 1e-3)), true),
    ("integral over no time", || said(CumulativeIntegral::new(&[1.0, 2.0], 0.0)), true),
    ("second integral of a list of none", || { let of = CumulativeIntegral::new(&[1.0, 2.0, 3.0], 1e-3).unwrap(); assert!(of.second_at(&[], 1e-3).is_nan()); Ok(()) }, false),
    ("second integral of a short list", || { let of = CumulativeIntegral::new(&[1.0, 2.0, 3.0], 1e-3).unwrap(); assert!(of.second_at(&[0.0], 2e-3).is_nan()); Ok(()) }, false),
    ("integral at no time", || { let of = CumulativeIntegral::new(&[1.0, 2.0], 1e-3).unwrap(); assert!(of.at(f64::NAN).is_nan()); Ok(()) }, false),
    ("threads without end", || said(Engine::new(usize::MAX, Kernel::Scalar).map(|engine| assert!(engine.threads() <= 1024))), false),
    ("no threads", || said(Engine::new(0, Kernel::Lanes8).map(|engine| assert_eq!(engine.threads(), 1))), false),
    ("a descent from nowhere", || said(Cma::new(vec![], 1.0, 8, 0, 0)), true),
    ("a descent from no number", || said(Cma::new(vec![f64::NAN], 1.0, 8, 0, 0)), true),
    ("a descent of no step", || said(Cma::new(vec![0.5], f64::NAN, 8, 0, 0)), true),
    ("a descent backwards", || said(Cma::new(vec![0.5], -1.0, 8, 0, 0)), true),
    ("a descent of too many", || said(Cma::new(vec![0.5; 2], 0.1, usize::MAX, 0, 0).map(|cma| assert_eq!(cma.population(), 1_000_000))), false),
    ("a descent that learns nothing", || said(Cma::new(vec![0.5; 3], 0.1, 8, 0, 0).unwrap().tell(&[], &[])), true),
    ("a descent that learns points alone", || { let mut cma = Cma::new(vec![0.5; 3], 0.1, 8, 0, 0).unwrap(); let points = cma.ask(); said(cma.tell(&points, &[])) }, true),
    ("a descent that learns of other spaces", || { let mut cma = Cma::new(vec![0.5; 3], 0.1, 8, 0, 0).unwrap(); said(cma.tell(&vec![vec![0.0]; 8], &[1.0; 8])) }, true),
    ("a descent that learns no numbers", || { let mut cma = Cma::new(vec![0.5; 3], 0.1, 8, 0, 0).unwrap(); let points = cma.ask(); said(cma.tell(&points, &[f64::NAN; 8])) }, false),
];

#[test]
fn other_crates_refuse_as_well() {
    let mut failures = Vec::new();
    for (name, call, refused) in ROWS {
        match came(name, call) {
            Ok(came) if matches!(came, Came::Refused(_)) == *refused => {}
            Ok(came) => failures.push(format!("{name}: {came:?}")),
            Err(words) => failures.push(words),
        }
    }
    report(&failures);
}

fn model_at(gravity_m_s2: f64) -> Result<Model, String> {
    let mut setup = cart();
    (setup.gravity_m_s2, setup.time.end_s) = (gravity_m_s2, 0.01);
    Model::new(setup).map_err(|problems| problems.to_string())
}

fn gravity(nominal: f64, size: f64) -> Parameter<'static> {
    Parameter { name: "gravity".into(), unit: "m/s^2".into(), nominal, size, model_at: Box::new(model_at) }
}

#[test]
fn derivatives_of_what_there_is_not_are_errors() {
    let (model, by) = (model_at(9.81).unwrap(), gravity(9.81, 9.81));
    assert!(Built::new(&model, &gravity(f64::NAN, 1.0)).is_err());
    assert!(Built::new(&model, &gravity(9.81, 0.0)).is_err());
    let mut built = [Built::new(&model, &by).unwrap()];
    let mut other = cart();
    (other.time.end_s, other.gravity_m_s2) = (0.01, 9.81);
    other.belts.clear();
    assert!(follow(&Model::new(other).unwrap(), &mut built).is_err());
    assert!(follow(&model, &mut []).is_err());
    let trajectory = follow(&model, &mut built).unwrap();
    let ask = |k: usize, name: &str| {
        let request = Request { figures: vec![name.into()], channels: Vec::new() };
        derivatives(&model, &by, &trajectory, k, &request)
    };
    assert!(ask(7, "head.peak").is_err());
    let unknown = ask(0, "hci15").unwrap_err().to_string();
    assert!(unknown.contains("`hci15`") && unknown.contains("`hic15`"), "{unknown}");
    assert!(ask(0, "head.peak").unwrap().figures[0].value.is_finite());
    assert!(trajectory.state_slopes(7, 0).is_empty() && trajectory.state_slopes(0, usize::MAX).is_empty());
}

#[test]
fn text_that_goes_without_end_is_refused() {
    let texts = [
        (Format::Toml, format!("a={}", "[".repeat(100_000))),
        (Format::Json, "[".repeat(100_000)),
        (Format::Json, "{\"a\":".repeat(100_000)),
        (Format::Toml, "\u{0}".into()),
        (Format::Json, "\u{feff}{".into()),
    ];
    for (format, text) in texts {
        assert!(Draft::read(&text, format, "t").is_err(), "{}", &text[..4.min(text.len())]);
    }
}
