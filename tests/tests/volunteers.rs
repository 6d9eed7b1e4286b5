//! A living person: what the muscles do, that their delays are the same to the bit wherever they are computed, and tests with
//! volunteers: four men at 15 g, 7 g to the side, braking, a weak push from behind.

use crash_measures::correlation::iso18571;
use crash_measures::signal::{Continuation, LowPass, STANDARD_GRAVITY_MPS2};
use occupant_core::forces::joint::muscle::Muscle;
use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use occupant_core::results::channel::{Series, matching};
use occupant_core::run::simulate::simulate;
use occupant_core::vehicle::PathCursor as Cursor;
use occupant_scenario::{Draft, Format};
use occupant_tests::measure::assert_below;
use occupant_tests::room::{ends_alike_side_by_side, setup};

use crate::laboratory::{Curves, sampled_to};
use crate::resume::goes_on;

const SLED: &str = include_str!("../../scenarios/neck-sled.toml");
const BRAKING: &str = include_str!("../data/volunteers/braking.toml");
const LATERAL: &str = include_str!("../data/volunteers/lateral.toml");
const REAR: &str = include_str!("../data/volunteers/rear.toml");
const ALIVE: &str = "joints.preset=volunteer";

fn living(set: &[&str]) -> Setup {
    setup(SLED, &[&[ALIVE], set].concat())
}

fn series(setup: Setup) -> (Series, f64) {
    let model = Model::new(setup).unwrap();
    let mut series = Series::new(matching(&model, "*"));
    let outcome = simulate(&model, &mut series).unwrap();
    (series, outcome.energy.balance_error)
}

/// Forward turn of a segment since the start, deg.
fn forward(series: &Series, segment: &str) -> Vec<f64> {
    let turned = series.of(&format!("{segment}.rotation.y")).unwrap();
    turned.iter().map(|angle| (turned[0] - angle).to_degrees()).collect()
}

fn most(of: &[f64]) -> f64 {
    of.iter().fold(0.0, |most: f64, x| most.max(*x))
}

/// What is said of a scenario that is wrong or doubtful.
fn said(set: &[&str]) -> String {
    let mut draft = Draft::read(SLED, Format::Toml, "test").unwrap();
    set.iter().for_each(|assignment| draft.set(assignment).unwrap());
    let no_files = |name: &str| Err(format!("no file {name}"));
    match draft.load(&no_files).and_then(|loaded| loaded.build()) {
        Ok((_, warnings)) => warnings.to_string(),
        Err(errors) => errors.to_string(),
    }
}

#[test]
fn the_muscles_of_a_volunteer_hold_the_head_and_keep_the_books() {
    // under error control the kinks of limits leave some 1e-5
    const FINE: &str = "integrator={ kind = \"rk4\", step = 2e-5 }";
    let (dead, _) = series(setup(SLED, &[FINE]));
    let turned = |set: &[&str]| {
        let (own, error) = series(living(&[set, &[FINE]].concat()));
        // 1.5e-8; 2.5e-8 without muscles: the kinks of limits
        assert_below("energy balance", error, 1e-7);
        let work = own.of("energy.muscles").unwrap();
        // they brake, and not by a little
        assert!(work[work.len() - 1] < -5.0, "{:?}", work.last());
        most(&forward(&own, "head"))
    };
    let [unaware, aware, braced] =
        ["unaware", "aware", "braced"].map(|ready| turned(&[&format!("muscles.readiness={ready}")]));
    let passive = most(&forward(&dead, "head"));
    assert!(passive > unaware && unaware > aware && aware > braced, "{passive} {unaware} {aware} {braced}");
}

/// τṡ = K_f ρ + D_f ω − s, taken exactly over straight lines between outputs, is what acts.
#[test]
fn a_reflex_follows_late() {
    let (k, d, delay_s) = (40.0, 2.0, 0.03);
    let muscle =
        format!("muscles.neck={{ tone = 1, reflex = {{ stiffness = {k}, damping = {d}, delay = {delay_s} }} }}");
    let (own, _) = series(setup(SLED, &[&muscle, "output.interval=\"0.2 ms\""]));
    let (head, neck) = (forward(&own, "head"), forward(&own, "neck"));
    let rate = |segment: &str, i: usize| own.of(&format!("{segment}.angular_velocity.y")).unwrap()[i];
    let asked = |i: usize| k * (head[i] - neck[i]).to_radians() + d * (rate("head", i) - rate("neck", i));
    let acts = own.of("muscle.neck.moment").unwrap();
    let mut felt = 0.0_f64;
    for (i, acts) in acts.iter().enumerate().skip(1) {
        let x = (own.time_s[i] - own.time_s[i - 1]) / delay_s;
        let share = (1.0 - (-x).exp()) / x;
        felt = felt * (-x).exp() + asked(i - 1) * (share - (-x).exp()) + asked(i) * (1.0 - share);
        assert!((acts - felt.abs()).abs() < 0.01, "{}: {acts} {felt}", own.time_s[i]);
    }
    assert!(most(acts) > 10.0, "{}", most(acts));
}

#[test]
fn a_delay_that_is_none_is_refused() {
    for delay_s in [1e-5, 0.0, -1.0, f64::NAN] {
        let mut setup = living(&[]);
        setup.joints.muscles[1].reflex.as_mut().unwrap().delay_s = delay_s;
        let said = Model::new(setup).unwrap_err().to_string();
        assert!(said.contains("muscles.neck.reflex.delay"), "{said}");
    }
}

#[test]
fn a_volunteer_answers_what_he_feels_and_is_no_stronger_than_he_is() {
    let muscles = |set: &[&str]| -> Vec<Muscle> { living(set).joints.muscles };
    let [base, top] = muscles(&[])[..] else { panic!("two joints") };
    // the sled's ramp of 25 g in 40 ms, which reaches 0.5 g after 0.8 ms
    let felt_s = 0.04 * 0.5 / 25.0;
    assert!((base.times_s[0] - felt_s - 0.05).abs() < 1e-6 && base.times_s == top.times_s, "{:?}", base.times_s);
    assert!(base.reflex.is_some_and(|reflex| reflex.delay_s > 0.0) && base.tone == 0.0);
    let woman = muscles(&["body.preset=female50"]);
    assert!((woman[0].most_n_m / base.most_n_m - 0.44).abs() < 1e-9);
    let at = muscles(&["triggers.go={ kind = \"time\", at = 0.1 }", "muscles.trigger=go"]);
    assert!((at[0].times_s[0] - 0.15).abs() < 1e-9);
    // a joint's own words replace the preset's, those of all do not
    let own = muscles(&["muscles.neck={ tone = 1, stiffness = 7 }", "muscles.all={ tone = 1, stiffness = 3 }"]);
    assert_eq!(own.iter().map(|muscle| muscle.stiffness_n_m).collect::<Vec<_>>(), [base.stiffness_n_m, 7.0]);
    let (run, _) = series(living(&[]));
    for (joint, muscle) in [("neck_base", base), ("neck", top)] {
        let moment = most(run.of(&format!("muscle.{joint}.moment")).unwrap());
        assert!(moment > 10.0 && moment <= muscle.most_n_m * (1.0 + 1e-9), "{joint}: {moment}");
    }
}

/// Who sits and waits keeps still: his muscles carry him, below their trigger by tone.
#[test]
fn a_volunteer_who_waits_sits_still() {
    let parked = [
        "path={ kind = \"fixed\" }",
        "triggers.go={ kind = \"time\", at = 0.3 }",
        "muscles.trigger=go",
        "time.end=0.5",
    ];
    let off = |set: &[&str]| {
        let (run, _) = series(setup(BRAKING, &[&parked, set].concat()));
        let moved = |name: &str| {
            most(&run.of(name).unwrap().iter().map(|x| (x - run.of(name).unwrap()[0]).abs()).collect::<Vec<_>>())
        };
        let read = run.of("head.acceleration.resultant").unwrap();
        (
            moved("head.position.x"),
            most(&read.iter().map(|a| (a / STANDARD_GRAVITY_MPS2 - 1.0).abs()).collect::<Vec<_>>()),
        )
    };
    let (moved_m, off_g) = off(&[]);
    assert_below("head moves, m", moved_m, 1e-3);
    assert_below("head off 1 g", off_g, 0.02);
    // without muscles he sags
    let dead = series(setup(BRAKING, &["joints.preset=person", "muscles={}", parked[0], parked[3]])).0;
    let head = dead.of("head.position.x").unwrap();
    assert!((head[head.len() - 1] - head[0]).abs() > 0.02, "{}", head[head.len() - 1] - head[0]);
}

/// A braked passenger: whose muscles, how strong, what they do to the books.
#[test]
fn trunk_and_limbs_of_a_volunteer_hold_him_and_keep_the_books() {
    let muscles = |set: &[&str]| {
        let setup = setup(BRAKING, set);
        let named = |muscle: &Muscle| (setup.body.tree[muscle.joint].name, *muscle);
        setup.joints.muscles.iter().map(named).collect::<Vec<_>>()
    };
    let men = muscles(&[]);
    let women = muscles(&["body.preset=female50"]);
    assert_eq!(men.len(), 18, "all joints: {men:?}");
    let of = |all: &[(&str, Muscle)], joint: &str| all.iter().find(|(name, _)| *name == joint).unwrap().1;
    for (joint, man, part) in [("lower_back", 179.0, 0.66), ("left_hip", 188.0, 0.60), ("right_knee", 134.0, 0.63)] {
        let [his, hers] = [&men, &women].map(|all| of(all, joint));
        assert!(
            (his.most_n_m - man).abs() < 1e-9 && (hers.most_n_m / man - part).abs() < 1e-9,
            "{joint}: {his:?} {hers:?}"
        );
        assert!(his.tone > 0.0 && his.carries);
    }
    let tones = ["unaware", "aware", "braced"].map(|ready| {
        let muscle = of(&muscles(&[&format!("muscles.readiness={ready}")]), "lower_back");
        (muscle.tone, muscle.times_s[0])
    });
    assert!(tones[0].1 > tones[1].1 && tones[1].0 < tones[2].0, "{tones:?}");
    // a pair said replaces the preset's, one side the pair
    let own = muscles(&["muscles.knees={ tone = 1, stiffness = 7 }", "muscles.left_knee={ tone = 1, stiffness = 5 }"]);
    assert_eq!([of(&own, "left_knee"), of(&own, "right_knee")].map(|muscle| muscle.stiffness_n_m), [5.0, 7.0]);
    let (run, error) = series(setup(BRAKING, &["time.end=0.6"]));
    assert_below("energy balance", error, 1e-4);
    let work = run.of("energy.muscles").unwrap();
    assert!(work[work.len() - 1] < -5.0, "{:?}", work.last());
    for (joint, muscle) in &men {
        let moment = most(run.of(&format!("muscle.{joint}.moment")).unwrap());
        assert!(moment <= 2.0 * muscle.most_n_m, "{joint}: {moment}");
    }
}

#[test]
fn a_seated_volunteer_has_the_same_bits_side_by_side_and_resumed() {
    let short = ["time.end=0.3", "output.interval=\"2 ms\"", "path.start=0"];
    ends_alike_side_by_side(|i| {
        let peak = format!("path.peak=\"{} g\"", 1.0 + 0.2 * f64::from(i));
        Model::new(setup(BRAKING, &[&short[..], &[&peak]].concat())).unwrap()
    });
    goes_on(&setup(BRAKING, &short));
}

#[test]
fn what_is_wrong_with_a_volunteer_is_said() {
    let linear = "path={ kind = \"table\", interpolation = \"linear\", after = \"coast\", columns = [\"t[s]\", \"x[m]\"], rows = [[0, 0], [1, 1]] }";
    for (set, expected) in [
        (&["muscles.readiness=aware"][..], "`readiness` without a volunteer"),
        (&["muscles.trigger=go", "triggers.go={ kind = \"time\", at = 0.1 }"], "`trigger` without a volunteer"),
        (&[ALIVE, "muscles.readiness=asleep"], "\"unaware\""),
        (&[ALIVE, "muscles.trigger=go"], "no trigger is named \"go\""),
        (&[ALIVE, linear], "on a path without accelerations"),
        (&["muscles.neck={ tone = 1, reflex = { stiffness = 5 } }"], "delay"),
        (&[ALIVE, "body={ preset = \"child10\" }"], "the muscles of a grown man in the body \"child10\""),
        (&["muscles.neck={ tone = 1, stiffness = 5, hold = [0, 5, 0], carries = true }"], "either `carries`"),
        (&["muscles.neck={ tone = 1, reflex = { stiffness = 5, delay = 0 } }"], "delay"),
    ] {
        let said = said(set);
        assert!(said.contains(expected), "{set:?}: {said}");
    }
}

/// A person of whose segments nothing is said has a neck of two joints; whoever asks for one joint is told.
#[test]
fn a_neck_of_one_joint_is_no_persons() {
    let body = |preset: &str| format!("body={{ preset = \"{preset}\" }}");
    let has_two = |joints: &str| {
        let held = setup(SLED, &[&body("male50"), "mount.posture={ head = 5 }", joints]);
        held.body.tree.joint_named("neck_base").is_some()
    };
    assert!(has_two("joints.preset=person") && has_two(ALIVE) && !has_two("joints.preset=gebod"));
    let told = |joints: &str, body: &str| said(&[joints, "mount.posture={ head = 5 }", body]);
    for body in ["body.segment_count=12", &body("male50-1970")] {
        for (joints, kind) in [("joints.preset=person", "warning: "), (ALIVE, "error: ")] {
            let said = told(joints, body);
            let name = joints.split('=').next_back().unwrap();
            let found = format!("{kind}the neck of \"{name}\" in a body with a one-joint neck");
            assert!(said.contains(&found), "{joints} {body}: {said}");
        }
        assert!(!told("joints.preset=gebod", body).contains("one joint"));
    }
}

#[test]
fn a_delay_has_the_same_bits_side_by_side_and_resumed() {
    let short = ["time.end=0.12", "muscles.readiness=braced"];
    ends_alike_side_by_side(|i| {
        let delay = format!("path.speed={}", 10.0 + f64::from(i));
        let start = format!("mount.posture.head={i}");
        Model::new(living(&[&short[..], &[&delay, &start]].concat())).unwrap()
    });
    goes_on(&living(&short));
}

/// Turn, places along x and z against T1, two accelerations and the angular acceleration of the head of a volunteer, rated by ISO/TS 18571
/// over 200 ms, and how far his head lags behind his neck after 100 ms, deg.
fn rated(number: u32, set: &[&str], [lean, neck, head]: [f64; 3]) -> ([f64; 6], f64) {
    let curves = Curves::open(&format!("nbdl-15g/volunteer-{number}.csv"));
    let time_s: Vec<f64> = curves.column("t_ms").iter().map(|t| 1e-3 * t).collect();
    let dt_s = time_s[1] - time_s[0];
    let smooth = |name: &str, corner_hz: f64| {
        let pass = LowPass::with_corner(corner_hz, dt_s).unwrap();
        pass.filter_phaseless(&curves.column(name), Continuation::PointReflection { samples: 40 }).unwrap()
    };
    let [ahead, up, turned] = [smooth("T1_ax_g", 60.0), smooth("T1_az_g", 30.0), smooth("T1_rot_deg", 60.0)];
    let row = |i: usize| {
        // from the sled's axes into those of T1, which dives by p; z down
        let (sine, cosine) = (turned[i] - turned[0]).to_radians().sin_cos();
        let [x, z] = [ahead[i], -up[i]];
        let [before, after] = [i.saturating_sub(1), (i + 1).min(time_s.len() - 1)];
        let rate = (turned[after] - turned[before]) / (time_s[after] - time_s[before]);
        format!("[{}, {}, {}, {}]", time_s[i], cosine * x + sine * z, cosine * z - sine * x, -rate)
    };
    let rows: Vec<String> = (0..time_s.len()).step_by(2).map(row).collect();
    let test = [
        "path.columns=[\"t[s]\", \"ax[g]\", \"az[g]\", \"wy[deg/s]\"]".to_owned(),
        format!("path.rows=[{}]", rows.join(", ")),
        "path.speed=\"30 m/s\"".to_owned(),
        "time.end=0.2".to_owned(),
        "output.interval=\"1 ms\"".to_owned(),
        format!("mount.pitch={lean}"),
        format!("mount.posture={{ neck = {neck}, head = {head} }}"),
    ];
    let all: Vec<&str> = set.iter().copied().chain(test.iter().map(String::as_str)).collect();
    let (run, _) = series(setup(SLED, &all));
    let (turn, neck) = (forward(&run, "head"), forward(&run, "neck"));
    let of = |name: &str| run.of(name).unwrap();
    let way = |name: &str, unit: f64| of(name).iter().map(|x| unit * (x - of(name)[0])).collect::<Vec<f64>>();
    let felt = |i: usize| {
        let (sine, cosine) = (turn[i] - head).to_radians().sin_cos();
        let [x, z] =
            ["x", "z"].map(|axis| of(&format!("head.kinematic_acceleration.{axis}"))[i] / STANDARD_GRAVITY_MPS2);
        [cosine * x + sine * z, cosine * z - sine * x]
    };
    let [x_g, z_g] = [0, 1].map(|axis| (0..turn.len()).map(|i| felt(i)[axis]).collect::<Vec<f64>>());
    let ours = [
        turn.clone(),
        way("head.level_position.x", 1e3),
        way("head.level_position.z", -1e3),
        x_g,
        z_g,
        of("head.angular_acceleration.y").to_vec(),
    ];
    let names = ["Head_rot_deg", "Head_x_mm", "Head_z_mm", "Head_ax_g", "Head_az_g", "Head_rotacc_rad_s2"];
    let ratings = std::array::from_fn(|i| {
        let measured = sampled_to(199, &time_s, &curves.column(names[i]), false);
        iso18571(&measured, &sampled_to(199, &run.time_s, &ours[i], false), 1e-4).unwrap().overall
    });
    let at = run.time_s.partition_point(|t| *t < 0.1 - 1e-9);
    (ratings, neck[at] - turn[at])
}

/// Means of all six over the four men.
fn mean(set: &[&str], posture_deg: [f64; 3]) -> ([f64; 6], f64, f64) {
    let all = [1635, 1637, 1639, 1644].map(|number| rated(number, set, posture_deg));
    let each: [f64; 6] = std::array::from_fn(|i| all.iter().map(|(ratings, _)| ratings[i]).sum::<f64>() / 4.0);
    (each, each.iter().sum::<f64>() / 6.0, all.iter().map(|(_, lag)| lag).sum::<f64>() / 4.0)
}

/// Four men at 15 g from ahead (Ewing and Thomas 1972), driven at T1: all was fitted with these curves in view.
#[test]
#[cfg_attr(not(crash_tests), ignore = "OCCUPANT_CRASH_TESTS names no folder of crash tests")]
fn a_volunteer_moves_as_four_men_did() {
    let fitted = mean(&[ALIVE], [22.0, 18.0, 0.0]);
    let passive = mean(&[], [22.0, 18.0, 0.0]);
    assert!(fitted.1 > 0.79 && fitted.2 > 20.0, "{fitted:.3?}");
    assert!(passive.1 < fitted.1 - 0.1, "{passive:.3?}");
}

/// Least and greatest change of a channel since the start, until a time.
fn change(run: &Series, name: &str, until_s: f64) -> [f64; 2] {
    let all = run.of(name).unwrap();
    let within = run.time_s.iter().zip(all).filter(|(t, _)| **t < until_s + 1e-9).map(|(_, x)| x - all[0]);
    within.fold([0.0, 0.0], |[least, most], x| [f64::min(least, x), f64::max(most, x)])
}

/// Front passengers braked at 1.1 g; those braked "medium harsh" went 97 ± 47 mm ahead with the head, 55 ± 26 mm with the chest
/// (Carlsson and Davidsson 2011, braking not said). Here 151 and 58 mm: the head is just beyond one standard deviation. The first half
/// second of braking.
#[test]
fn a_braked_volunteer_goes_ahead_about_as_far_as_passengers() {
    let ahead = |set: &[&str]| {
        let (run, _) = series(setup(BRAKING, &[&["time.end=0.6"], set].concat()));
        let turned = change(&run, "head.rotation.y", 0.6)[0].to_degrees();
        [change(&run, "head.position.x", 0.6)[1], change(&run, "upper_torso.position.x", 0.6)[1], -turned]
    };
    let [unaware, braced] = ["unaware", "braced"].map(|ready| ahead(&[&format!("muscles.readiness={ready}")]));
    let dead = ahead(&["joints.preset=person", "muscles={}"]);
    assert!((0.05..0.155).contains(&unaware[0]) && (0.029..0.081).contains(&unaware[1]), "{unaware:?}");
    assert!(braced[0] < unaware[0] && dead[0] > 1.25 * unaware[0], "{braced:?} {unaware:?} {dead:?}");
}

/// ISO/TR 9790, neck test 1, from seven volunteers of NBDL: flexion 44 to 59 deg, head 130 to 162 mm to the side and 64 to 94 mm down
/// against T1, twist 32 to 45 deg, 8 to 11 g to the side, 8 to 10 g down. Nothing sideways is fitted to these tests; the roll of T1 is
/// inferred (`lateral.toml`).
#[test]
fn a_volunteer_driven_to_the_side_bends_nearly_as_men_did() {
    /// Roll of T1 at the head's peak.
    const ROLL_DEG: f64 = 10.0;
    let seen = |set: &[&str]| {
        let (run, _) = series(setup(LATERAL, set));
        let range = |name: &str| change(&run, name, 1.0).map(f64::abs).into_iter().fold(0.0, f64::max);
        let g = |axis: &str| range(&format!("head.kinematic_acceleration.{axis}")) / STANDARD_GRAVITY_MPS2;
        let [flexion, twist] = ["x", "z"].map(|axis| range(&format!("head.rotation.{axis}")).to_degrees());
        [
            flexion - ROLL_DEG,
            1e3 * range("head.level_position.y"),
            1e3 * range("head.level_position.z"),
            twist,
            g("y"),
            g("z"),
        ]
    };
    let aware = seen(&[]);
    let dead = seen(&["joints.preset=person"]);
    let middles = [51.5, 146.0, 79.0, 38.5, 9.5, 9.0];
    let off: Vec<f64> = aware.iter().zip(middles).map(|(ours, theirs)| ours / theirs - 1.0).collect();
    // measured: -2, -11, -20, -16, +34, +6 %
    assert!([0, 1, 2, 3, 5].iter().all(|i| off[*i].abs() < 0.21), "{off:.2?}");
    assert!(off.iter().all(|off| off.abs() < 0.36), "{off:.2?}");
    assert!(dead[0] > 1.15 * aware[0], "{dead:?}");
    // an upright T1 throws the head harder and less far
    let rows =
        [[0.0, 0.0], [0.02, 0.5], [0.04, 4.0], [0.065, 15.0], [0.085, 8.0], [0.105, 4.5], [0.13, 2.0], [0.15, 0.0]];
    let rows = rows.map(|[time_s, g]| format!("[{time_s}, {g}, 0]")).join(", ");
    let upright = seen(&[&format!("path.rows=[{rows}]")]);
    assert!(upright[1] < 0.93 * aware[1] && upright[4] > 1.1 * aware[4], "{upright:?}");
}

/// Eight women at 6.8 km/h, 10 cm before the head restraint: NIC 3.9 m²/s² on average (Carlsson et al. 2021), in another seat.
#[test]
fn a_volunteer_struck_from_behind_turns_less_than_the_dead() {
    let turned = |set: &[&str]| {
        let (run, _) = series(setup(REAR, set));
        [
            change(&run, "head.rotation.y", 1.0)[1].to_degrees(),
            change(&run, "upper_torso.rotation.y", 1.0)[1].to_degrees(),
        ]
    };
    let (alive, dead) = (turned(&[]), turned(&["joints.preset=person", "muscles={}"]));
    assert!((10.0..64.0).contains(&alive[0]) && dead[0] > 1.5 * alive[0], "{alive:?} {dead:?}");
}

/// The template's table of accelerations along the sled, and the same motion as sensors on T1 feel it: another integration, the same
/// head.
#[test]
fn t1_by_the_axes_of_a_sled_moves_the_head_as_t1_by_its_own() {
    const TEMPLATE: &str = include_str!("../../scenarios/templates/neck.toml");
    let sled = setup(TEMPLATE, &[]);
    let mut at = Cursor::default();
    let rows: Vec<String> = (0..=800)
        .map(|i| {
            let t = 2.5e-4 * f64::from(i);
            let motion = sled.path.motion(t, t, &mut at);
            // vehicle axes: forward, right, down
            let felt = motion.rotation.transpose() * motion.acceleration_m_s2;
            let rate = motion.rotation.transpose() * motion.angular_velocity_rad_s;
            format!("[{t}, {}, {}, {}]", felt.x, felt.z, rate.y)
        })
        .collect();
    let sensors = format!(
        "path={{ kind = \"sensors\", gravity = \"removed\", speed = 0, after = \"coast\", columns = [\"t[s]\", \"ax[m/s^2]\", \"az[m/s^2]\", \"wy[rad/s]\"], rows = [{}] }}",
        rows.join(", ")
    );
    let [one, other] = [series(sled).0, series(setup(TEMPLATE, &[&sensors])).0].map(|run| forward(&run, "head"));
    let apart = one.iter().zip(&other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(most(&one) > 60.0);
    assert_below("heads apart, deg", apart, 0.05);
}
