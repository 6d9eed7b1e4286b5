//! Setups that point at what there is not, or that contradict themselves.

use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector3};
use occupant_core::body::people::{Division, Person};
use occupant_core::body::{Body, Segment};
use occupant_core::forces::chain::Site;
use occupant_core::forces::contact::surface::Frame;
use occupant_core::forces::joint::Joints;
use occupant_core::model::seating::{InitialPosture, Mounting};
use occupant_core::model::setup::{Integrator, Marker, MarkerFrame, Member, OtherFrame, Scenery, Setup};
use occupant_core::motion::report_coordinates::{DOF, ReportCoordinates};
use occupant_core::vehicle::{Attitude, VehicleMotion, VehiclePath, VehicleState};

use super::{Came, came, cart, model, report, setup};

/// A name, a change, and a part of what is said of it.
type Row = (&'static str, fn(&mut Setup), &'static str);

fn frame(name: &str, parent: Option<Frame>) -> OtherFrame {
    let parent = parent.map(|parent| (parent, Point3::origin()));
    OtherFrame { name: name.into(), path: VehiclePath::parked(), parent }
}

/// A body of 17 segments, and its last segment, which one of 12 has not.
fn other() -> (Body, Segment) {
    let body = Person::named("male50").unwrap().body(Division::of(17).unwrap()).0;
    let last = body.tree.segments().last().unwrap();
    (body, last)
}

fn marker(name: &str) -> Marker {
    let body = Body::male50();
    let segment = body.tree.segment_named("head").unwrap();
    Marker { name: name.into(), segment, place_from_lower_end_m: Point3::origin(), frame: MarkerFrame::Vehicle }
}

fn mounted(at: Frame) -> InitialPosture {
    InitialPosture::Mounted(Box::new(Mounting {
        frame: at,
        point_m: Vector3::zeros(),
        place_m: Vector3::zeros(),
        attitude: Attitude::default(),
        angles_rad: Vec::new(),
    }))
}

fn seated(setup: &mut Setup) -> &mut occupant_core::model::seating::Seating {
    match &mut setup.posture {
        InitialPosture::Seated(seating) => seating,
        other => panic!("{other:?}"),
    }
}

fn adaptive(relative: f64, absolute: f64, min_step_s: f64) -> Integrator {
    Integrator::Adaptive { relative, absolute_m: absolute, absolute_m_s: absolute, min_step_s, max_step_s: 1e-3 }
}

/// Paths that a program may bring.
#[derive(Debug)]
struct Own(fn(f64) -> VehicleState, Vec<f64>, (f64, f64));

impl VehicleMotion for Own {
    fn at(&self, t_s: f64) -> VehicleState {
        (self.0)(t_s)
    }
    fn breaks_s(&self) -> Vec<f64> {
        self.1.clone()
    }
    fn span_s(&self) -> (f64, f64) {
        self.2
    }
}

const ALWAYS: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

fn still(_t_s: f64) -> VehicleState {
    VehicleState::default()
}

fn leaping(t_s: f64) -> VehicleState {
    let mut state = VehicleState::default();
    state.pose.position_m.x = if t_s > 0.1 { 1e6 } else { 0.0 };
    state
}

fn breaking_off(t_s: f64) -> VehicleState {
    let mut state = VehicleState::default();
    state.velocity_m_s.x = if t_s > 0.05 { f64::NAN } else { 0.0 };
    state
}

fn absent(t_s: f64) -> VehicleState {
    let mut state = VehicleState::default();
    state.pose.position_m.y = if t_s > 0.05 && t_s < 0.06 { f64::NAN } else { 0.0 };
    state
}

#[rustfmt::skip]
const ROWS: &[Row] = &[
    ("surface on a frame that there is not", |s| s.surfaces[0].frame = Frame::Other(9), "frame 9 of 0"),
    ("surface on a frame without end", |s| s.surfaces[0].frame = Frame::Other(usize::MAX), "of `frames`"),
    ("surface on a segment that there is not", |s| s.surfaces[0].frame = Frame::Segment(99), "segment 99 of 12"),
    ("surface of no material", |s| s.surfaces[0].material = 9999, "no such material"),
    ("surface of no sphere", |s| s.surfaces[0].spheres = Some(vec![9999]), "no such sphere"),
    ("two surfaces of one name", |s| s.surfaces[1].name = s.surfaces[0].name.clone(), "a second surface"),
    ("two materials of one name", |s| { let one = s.materials[0].clone(); s.materials.push(one); }, "a second material"),
    ("belt on a segment", |s| s.belts[0].frame = Frame::Segment(3), "segment 3"),
    ("belt on no frame", |s| s.belts[0].frame = Frame::Other(0), "frame 0 of 0"),
    ("belt round no sphere", |s| s.belts[0].sphere = 9999, "no such sphere"),
    ("two belts of one name", |s| s.belts[1].name = s.belts[0].name.clone(), "a second belt"),
    ("anchors in one place", |s| s.belts[0].anchors_m[1] = s.belts[0].anchors_m[0], "two anchors in one place"),
    ("scenery on no frame", |s| s.scenery.push(Scenery { name: "road".into(), frame: Frame::Other(3), polygons_m: vec![] }), "frame 3 of 0"),
    ("nine frames", |s| s.frames = (0..9).map(|i| frame(&format!("f{i}"), None)).collect(), "at most 8"),
    ("a hundred frames", |s| s.frames = (0..100).map(|i| frame(&format!("f{i}"), None)).collect(), "at most 8"),
    ("two frames of one name", |s| s.frames = vec![frame("f", None), frame("f", None)], "a second frame"),
    ("frame that carries itself", |s| s.frames = vec![frame("f", Some(Frame::Other(0)))], "the frame itself"),
    ("frame on a later one", |s| s.frames = vec![frame("f", Some(Frame::Other(1))), frame("g", None)], "precedes it"),
    ("frame on none", |s| s.frames = vec![frame("f", Some(Frame::Other(77)))], "precedes it"),
    ("frame on a segment", |s| s.frames = vec![frame("f", Some(Frame::Segment(3)))], "precedes it"),
    ("frame about no point", |s| { s.frames = vec![frame("f", Some(Frame::Vehicle))]; s.frames[0].parent.as_mut().unwrap().1.x = f64::NAN; }, "not finite"),
    ("frame of a path told on the way", |s| { s.frames = vec![frame("f", None)]; s.frames[0].path = VehiclePath::live(VehicleState::default()); }, "given during the run"),
    ("frame whose path breaks off", |s| { s.frames = vec![frame("f", None)]; s.frames[0].path = VehiclePath::own(Own(breaking_off, vec![], ALWAYS)); }, "not finite"),
    ("frame whose path is too short", |s| { s.frames = vec![frame("f", None)]; s.frames[0].path = VehiclePath::own(Own(still, vec![], (0.0, 0.01))); }, "whole run"),
    ("cushion that there is not", |s| seated(s).cushion = 9999, "no such surface"),
    ("back that there is not", |s| seated(s).back = usize::MAX, "no such surface"),
    ("back that is the cushion", |s| seated(s).back = seated(s).cushion, "parallel"),
    ("seat without surfaces", |s| s.surfaces.clear(), "no such surface"),
    ("heels out of reach", |s| seated(s).heels_m = [1e9, 0.0], "out of reach"),
    ("mount on another frame", |s| s.posture = mounted(Frame::Other(4)), "space, or the vehicle"),
    ("mount on a segment", |s| s.posture = mounted(Frame::Segment(40)), "space, or the vehicle"),
    ("posture of several", |s| s.posture = InitialPosture::Together, "several bodies"),
    ("coordinates that are none", |s| s.posture = InitialPosture::Coordinates(Box::new(ReportCoordinates { q: [f64::NAN; DOF], rates: [0.0; DOF] })), "not finite"),
    ("joints of another body", |s| { let (body, _) = other(); s.joints = Joints::free(body.tree); }, "joints of another body"),
    ("body of other joints", |s| s.body = other().0, "joints of another body"),
    ("too few segments", |s| s.body.segments.truncate(3), "3 segments"),
    ("too many places", |s| { let (body, _) = other(); s.body.places = body.tree.joints().map(|j| body.place(j)).collect(); }, "places of joints"),
    ("sphere on another body's segment", |s| s.body.spheres[0].segment = other().1, "of 12"),
    ("two spheres of one name", |s| { let one = s.body.spheres[0].clone(); s.body.spheres.push(one); }, "a second sphere"),
    ("sphere far from its segment", |s| s.body.spheres[0].centre_from_lower_end_m.z = 50.0, "a sphere on its segment"),
    ("sphere of no size", |s| s.body.spheres[0].radius_m = 0.0, "positive"),
    ("sphere of less than none", |s| s.body.spheres[0].radius_m = -1.0, "positive"),
    ("mass of a mountain", |s| s.body.segments.iter_mut().for_each(|one| one.mass_kg = 1e300), "expected"),
    ("no inertia", |s| s.body.segments[0].inertia_kg_m2 = Vector3::zeros(), "inertia"),
    ("inertia of no body", |s| s.body.segments[0].inertia_kg_m2 = Vector3::new(1.0, 1.0, 3.0), "triangle"),
    ("axes that are none", |s| s.body.segments[0].principal = UnitQuaternion::new_unchecked(Quaternion::new(f64::NAN, 0.0, 0.0, 0.0)), "principal axes"),
    ("condyles that are nowhere", |s| s.body.condyles_m = Some(Vector3::repeat(f64::NAN)), "not finite"),
    ("marker on another body's segment", |s| { let mut m = marker("m"); m.segment = other().1; s.output.markers.push(m); }, "of 12"),
    ("marker without a name", |s| s.output.markers.push(marker("")), "without a name"),
    ("two markers of one name", |s| s.output.markers = vec![marker("m"), marker("m")], "a second marker"),
    ("marker nowhere", |s| { let mut m = marker("m"); m.place_from_lower_end_m.y = f64::NAN; s.output.markers.push(m); }, "not finite"),
    ("member that was added", |s| { let alone = s.clone(); s.members.push(Member { name: "x".into(), home: Frame::Vehicle, meets: vec![], alone }); }, "`Setup::together`"),
    ("member in no frame", |s| { let alone = s.clone(); s.members.push(Member { name: "x".into(), home: Frame::Other(5), meets: vec![Some(vec![9999])], alone }); }, "frame 5 of 0"),
    ("end before the start", |s| s.time.end_s = -1.0, "an end after the start"),
    ("end at the start", |s| s.time.end_s = s.time.start_s, "an end after the start"),
    ("outputs without end", |s| s.time.output_s = 1e-300, "at most"),
    ("outputs too dense", |s| s.time.output_s = 1e-9, "at most"),
    ("outputs backwards", |s| s.time.output_s = -1.0, "positive"),
    ("one output in years", |s| s.time.output_s = 1e9, "no longer than the run"),
    ("readings too dense", |s| s.output.readings_s = Some(1e-12), "at most"),
    ("readings backwards", |s| s.output.readings_s = Some(-1.0), "positive"),
    ("steps too short", |s| s.integrator = Integrator::Rk4 { step_s: 1e-12 }, "at most"),
    ("steps backwards", |s| s.integrator = Integrator::Rk4 { step_s: -1e-4 }, "positive"),
    ("no tolerance", |s| s.integrator = adaptive(0.0, 0.0, 0.0), "positive"),
    ("tolerance below all digits", |s| s.integrator = adaptive(1e-300, 1e-300, 1e-300), "at least"),
    ("tolerance below the last digit", |s| s.integrator = adaptive(1e-30, 1e-30, 1e-10), "at least"),
    ("tolerance without bound", |s| s.integrator = adaptive(f64::INFINITY, f64::INFINITY, 1e-10), "positive"),
    ("steps that no clock tells", |s| s.integrator = adaptive(1e-8, 1e-8, 1e-300), "at least"),
    ("smallest step above the largest", |s| s.integrator = adaptive(1e-6, 1e-6, 1.0), "above the smallest"),
    ("gravity upwards", |s| s.gravity_m_s2 = -9.81, "it acts downwards"),
    ("path that breaks off", |s| s.path = VehiclePath::own(Own(breaking_off, vec![], ALWAYS)), "not finite"),
    ("path that is not there for a while", |s| s.path = VehiclePath::own(Own(absent, vec![], ALWAYS)), "NaN"),
    ("path that leaps", |s| s.path = VehiclePath::own(Own(leaping, vec![], ALWAYS)), "as its velocity requires"),
    ("path of a million corners", |s| s.path = VehiclePath::own(Own(still, (0..1_000_000).map(|i| 1e-7 * f64::from(i)).collect(), ALWAYS)), "at most 100000"),
    ("path with a corner at no time", |s| s.path = VehiclePath::own(Own(still, vec![0.1, f64::NAN], ALWAYS)), "all finite"),
    ("path that ends before it begins", |s| s.path = VehiclePath::own(Own(still, vec![], (1.0, -1.0))), "whole run"),
    ("too many spheres", |s| { let one = s.body.spheres[0].clone(); for i in 0..70_000 { let mut next = one.clone(); next.name = format!("s{i}"); s.body.spheres.push(next); } }, "at most 200000 pairs"),
];

#[test]
fn a_setup_that_points_nowhere_is_refused_with_words() {
    let mut failures = Vec::new();
    for (name, change, words) in ROWS {
        let mut broken = cart();
        let refused = came(name, || {
            change(&mut broken);
            model(broken)
        });
        match refused {
            Ok(Came::Refused(said)) if said.contains(words) => {}
            Ok(came) => failures.push(format!("{name}: {words:?} is not in {came:?}")),
            Err(words) => failures.push(words),
        }
    }
    report(&failures);
    assert!(ROWS.len() >= 70, "{}", ROWS.len());
}

/// The same of belts over several nodes, bags, columns, solids and several bodies.
#[test]
fn so_is_one_of_other_elements() {
    let chain: &[Row] = &[
        ("node on no sphere", |s| s.chains[0].nodes[1].site = Site::Sphere(999), "no such sphere"),
        (
            "node on no segment",
            |s| s.chains[0].nodes[0].site = Site::Segment(999, Point3::origin(), None),
            "segment 999",
        ),
        ("no nodes", |s| s.chains[0].nodes.clear(), "0 nodes"),
        ("no names of straps", |s| s.chains[0].straps.clear(), "names of straps"),
        ("on a segment", |s| s.chains[0].frame = Frame::Segment(99), "segment 99"),
        ("no webbing", |s| s.chains[0].webbing.points.clear(), "0 points"),
        ("no fractions", |s| s.chains[0].webbing.returned.clear(), "returned"),
    ];
    let bag: &[Row] = &[
        ("bag on no frame", |s| s.bags[0].frame = Frame::Other(8), "frame"),
        ("bag on a segment", |s| s.bags[0].frame = Frame::Segment(1), "frame"),
        ("bag of no sphere", |s| s.bags[0].spheres = vec![(999, 1.0)], "sphere"),
        ("bag of an inflator without a table", |s| s.bags[0].inflators[0].rows.clear(), "table"),
    ];
    let column: &[Row] = &[
        ("column of no frame", |s| s.frames.clear(), "frame"),
        ("column of another frame", |s| s.columns[0].frame = 77, "column"),
        (
            "two columns of one frame",
            |s| {
                let one = s.columns[0].clone();
                s.columns.push(one);
            },
            "second",
        ),
    ];
    let solids: &[Row] = &[
        ("solid of no material", |s| s.solids[0].material = 99, "no such material"),
        ("solid on no frame", |s| s.solids[0].frame = Frame::Other(9), "frame 9"),
        ("solid of no sphere", |s| s.solids[0].spheres = Some(vec![9999]), "no such sphere"),
        ("two solids of one name", |s| s.solids[1].name = s.solids[0].name.clone(), "second"),
    ];
    let several: &[Row] = &[
        ("one of several without a unique name", |s| s.members[1].name = s.members[0].name.clone(), "second"),
        ("one of several in no frame", |s| s.members[0].home = Frame::Other(77), "frame 77"),
        (
            "one of several left out",
            |s| {
                s.members.pop();
            },
            "`Setup::together`",
        ),
        ("surfaces of no material among several", |s| s.surfaces[0].material = 99, "no such material"),
        ("spheres of nobody among several", |s| s.surfaces[0].spheres = Some(vec![9999]), "no such sphere"),
        ("gravity that is none among several", |s| s.gravity_m_s2 = f64::NAN, "gravity"),
    ];
    let cases = [
        (include_str!("../../../tests/data/hand/three-point.toml"), chain),
        (include_str!("../../../tests/data/hand/airbag-driver.toml"), bag),
        (include_str!("../../../tests/data/hand/column-driver.toml"), column),
        (include_str!("../../../tests/data/hand/rear-seat-solids.toml"), solids),
        (include_str!("../../../tests/data/hand/side-by-side.toml"), several),
    ];
    let mut failures = Vec::new();
    for (text, rows) in cases {
        let whole = setup(text);
        for (name, change, words) in rows {
            let mut broken = whole.clone();
            match came(name, || {
                change(&mut broken);
                model(broken)
            }) {
                Ok(Came::Refused(said)) if said.contains(words) => {}
                Ok(came) => failures.push(format!("{name}: {words:?} is not in {came:?}")),
                Err(words) => failures.push(words),
            }
        }
    }
    report(&failures);
}
