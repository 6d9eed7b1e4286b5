//! Several frames and bodies: what one hands to another, what a frame does to a body, and that neither knows of what is far away.

use nalgebra::{Point3, Vector3};
use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use occupant_core::results::energy::Balance;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::{Summarizer, Summary};
use occupant_core::run::simulate::{resume, simulate};
use occupant_tests::measure::assert_below;
use occupant_tests::room::{Last, ends_alike_side_by_side, run, setup};

const ABREAST: &str = include_str!("../data/hand/side-by-side.toml");
const PEDESTRIAN: &str = include_str!("../../scenarios/pedestrian.toml");

/// An occupant that is far away, and what is thrown past him.
const SPACE: &str = r#"
title = "loose bodies in space"
gravity = 0
time = { end = "40 ms" }
output = { interval = "0.5 ms" }
integrator = { kind = "rk4", step = "20 us" }
path = { kind = "fixed" }
contact = { skin = "rubber" }
body = { preset = "male50" }
joints = { preset = "male50" }
initial_state = { q = [900, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0], rates = [0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0] }

[materials]
rubber = { k1 = "100 kN/m", mu1 = 0.49, friction = 0.4 }
steel  = { k1 = "400 kN/m", mu1 = 0.81, friction = 0.2 }
"#;

fn space(more: &str, set: &[&str]) -> Setup {
    setup(&format!("{SPACE}{more}"), set)
}

fn summary(setup: Setup) -> Summary {
    let mut summarizer = Summarizer::new();
    run(setup, &mut summarizer);
    summarizer.summary(None).unwrap()
}

/// Linear momentum, and angular momentum about the origin, of the bodies from `first` on, space axes.
fn momenta(s: &Sample<'_>, first: usize) -> [Vector3<f64>; 2] {
    let (k, skeleton) = (&s.evaluation.kinematics, &s.model.system().skeleton);
    let tree = s.model.body().tree;
    let own = tree.segments().filter(|segment| tree.body_of(*segment) >= first).map(|segment| segment.index());
    own.fold([Vector3::zeros(); 2], |[p, l], n| {
        let axes = k.axes[n].to_matrix();
        let spin = axes * skeleton.links[n].by_inertia(k.axes[n].into_frame(k.omega[n])).to_vector();
        let momentum = skeleton.links[n].mass * k.cg_velocity(skeleton, n).to_vector();
        [p + momentum, l + k.cg(skeleton, n).to_vector().cross(&momentum) + spin]
    })
}

/// A ball of 2 kg that moves with 3 m/s along x, and one of 3 kg beside its way.
fn balls(beside_m: f64) -> String {
    format!(
        r#"
[loose.one]
mass = 2
inertia = [0.008, 0.008, 0.008]
at = [-0.2, 0, 0]
velocity = [3, 0, 0]
spheres = {{ all = {{ centre = [0, 0, 0], radius = 0.1 }} }}

[loose.two]
mass = 3
inertia = [0.012, 0.012, 0.012]
at = [0.1, {beside_m}, 0]
spheres = {{ all = {{ centre = [0, 0, 0], radius = 0.1 }} }}
"#
    )
}

#[test]
fn two_balls_head_on_meet_as_their_closed_form_says() {
    let (k, mu, m) = (50e3, 0.49, 2.0 * 3.0 / 5.0);
    let mut deepest = 0.0_f64;
    let (mut first, mut last) = (None, [0.0; 2]);
    let (_, outcome) = run(
        space(&balls(0.0), &["time.end=70 ms"]),
        Watch(|s: &Sample<'_>| {
            first.get_or_insert(momenta(s, 1)[0]);
            last = [1, 2].map(|body| s.centre_of_body(body).1.x);
            deepest = s.actions.contacts.iter().map(|t| t.depth).fold(deepest, f64::max);
            // what one gets the other gives, at every output
            assert!((s.ledgers[1].others_work_j + s.ledgers[2].others_work_j).abs() < 1e-12);
            assert!(s.ledgers.iter().all(|own| own.balance_j.abs() < 1e-5), "{:?}", s.ledgers);
        }),
    );
    // equal skins in series: half the stiffness of one, its returned fraction; x_max = v √(m/k), e = √μ
    assert_below("depth", (deepest / (3.0 * f64::sqrt(m / k)) - 1.0).abs(), 1e-3);
    assert_below("restitution", ((last[1] - last[0]) / 3.0 - f64::sqrt(mu)).abs(), 2e-4);
    assert_below("momentum, N s", (2.0 * last[0] + 3.0 * last[1] - first.unwrap().x).abs(), 1e-12);
    assert_below("energy balance", outcome.energy.balance_error, 1e-6);
}

#[test]
fn balls_that_meet_off_centre_and_rub_keep_their_momenta() {
    let drift = |step: &str| {
        let mut all = Vec::new();
        run(
            space(&balls(0.12), &[&format!("integrator.step={step}")]),
            Watch(|s: &Sample<'_>| all.push(momenta(s, 1))),
        );
        let off = |k: usize| all.iter().map(|now| (now[k] - all[0][k]).norm()).fold(0.0, f64::max);
        let spun = all.last().unwrap()[1] - all[0][1];
        assert!(spun.norm() < 1e-3);
        [off(0), off(1)]
    };
    let ([linear, coarse], [_, fine]) = (drift("100 us"), drift("25 us"));
    assert_below("linear momentum, N s", linear, 1e-12);
    assert_below("angular momentum, N m s", fine, 1e-7);
    assert!(coarse > 30.0 * fine || coarse < 1e-11, "{coarse} {fine}");
}

/// The second ball has a steel plate before it, which the first strikes: what carries faces gets the opposite.
#[test]
fn what_strikes_the_face_of_a_loose_body_gives_it_its_momentum() {
    let plate = r#"
[surfaces.front]
frame = "two"
material = "steel"
points = [[-0.12, -0.2, -0.2], [-0.12, 0.2, -0.2], [-0.12, 0.2, 0.2], [-0.12, -0.2, 0.2]]
inside = [-1, 0, 0]
"#;
    let mut all = Vec::new();
    let mut hits = 0;
    let (_, outcome) = run(
        space(&(balls(0.06) + plate), &["contact.bodies=[]"]),
        Watch(|s: &Sample<'_>| {
            all.push(momenta(s, 1));
            hits += s.actions.contacts.len();
        }),
    );
    assert!(hits > 2);
    let off = |k: usize| all.iter().map(|now| (now[k] - all[0][k]).norm()).fold(0.0, f64::max);
    assert_below("linear momentum, N s", off(0), 1e-12);
    assert_below("angular momentum, N m s", off(1), 1e-6);
    assert_below("energy balance", outcome.energy.balance_error, 1e-5);
    // limbs of the occupant far away are looked for in the plate, too
    let seen = summary(space(&(balls(0.06) + plate), &["contact.bodies=[]"]));
    assert!(seen.caveats.iter().all(|caveat| !caveat.name.ends_with("_cut")), "{:?}", seen.caveats);
}

/// A wall that heads alone can touch is none for a ball, which has none.
#[test]
fn a_surface_for_named_parts_lets_loose_bodies_through() {
    let at_end = |spheres: &str| {
        let wall = format!(
            "[surfaces.wall]\nmaterial = 'steel'\npoints = [[0.3, -1, -1], [0.3, 1, -1], [0.3, 1, 1], [0.3, -1, 1]]\ninside = [0, 0, 0]\n{spheres}\n"
        );
        let ball = "[loose.ball]\nvehicle = 'vehicle'\nmass = 2\ninertia = [0.008, 0.008, 0.008]\nat = [0.15, 0, 0]\nvelocity = [3, 0, 0]\nspheres = { all = { centre = [0, 0, 0], radius = 0.1 } }\n";
        let mut last = 0.0;
        let see = Watch(|s: &Sample<'_>| last = s.centre_of_body(1).1.x);
        run(space(&format!("{wall}{ball}"), &["contact.bodies=[]"]), see);
        last
    };
    assert!((at_end("spheres = ['head']") - 3.0).abs() < 1e-12);
    assert!(at_end("") < 0.0);
}

/// Everything that moves the driver, as text.
fn driver(setup: Setup) -> Vec<String> {
    let mut seen = Vec::new();
    run(
        setup,
        Watch(|s: &Sample<'_>| {
            let trunk = s.model.body().tree.segments().filter(|n| s.model.body().tree.body_of(*n) == 0);
            let k = &s.evaluation.kinematics;
            seen.push(format!(
                "{:?}",
                trunk.map(|n| (k.axes[n.index()], k.joint[n.index()], s.cg_m(n))).collect::<Vec<_>>()
            ));
        }),
    );
    seen
}

const STEPS: [&str; 3] = ["integrator.kind=rk4", "integrator.step=50 us", "time.end=120 ms"];

#[test]
fn an_occupant_beside_one_that_is_far_away_moves_as_alone_to_the_bit() {
    let cut = ABREAST.split("[occupants.passenger]").next().unwrap();
    let alone = driver(setup(cut, &STEPS));
    let apart = ABREAST.replace("[occupants.passenger]\nvehicle = \"vehicle\"", "[vehicles.other]\npath = { kind = \"fixed\", position = [0, 100, 0] }\n\n[occupants.passenger]\nvehicle = \"other\"");
    let stance = apart.rsplit_once("posture = ").unwrap().0.to_owned() + "initial_velocity_is_none = 0\n";
    // far away nobody sits: he hangs on a mount there
    let stance =
        stance.replace("initial_velocity_is_none = 0", "mount = { segment = \"lower_torso\", place = [0, 0, 0] }");
    let beside = driver(setup(&stance, &STEPS));
    assert!(alone.len() > 100);
    assert_eq!(alone, beside);
}

#[test]
fn two_occupants_in_mirror_images_move_in_mirror_images() {
    // both alike, both pushed ahead, nothing beside but each other
    let alike = ABREAST.replace("preset = \"female50\"", "preset = \"male50\"").replace(
        "upper_arms = 10, elbows = -40, heels = [0.7, 0.36]",
        "upper_arms = 30, elbows = -60, heels = [0.75, 0.36]",
    );
    let mut worst = 0.0_f64;
    let mut touched = false;
    // both slide inwards
    let alike = alike
        .replace("seat = \"left\",", "seat = \"left\", velocity = [0, 4, 0],")
        .replace("seat = \"right\",", "seat = \"right\", velocity = [0, -4, 0],");
    let set = ["path.direction=[1, 0, 0]", "path.speed=1 km/h", "path.delta_v=1 km/h", "time.end=120 ms"];
    run(
        setup(&alike, &[&STEPS[..2], &set].concat()),
        Watch(|s: &Sample<'_>| {
            let tree = s.model.body().tree;
            touched |= s.contacts().any(|c| c.surface >= s.model.setup().surfaces.len());
            for n in tree.segments().filter(|n| tree.body_of(*n) == 0) {
                let other = tree[n].name.replace("driver", "passenger");
                let other = if other.contains("left") {
                    other.replace("left", "right")
                } else {
                    other.replace("right", "left")
                };
                let twin = tree.segments().find(|m| tree[*m].name == other).unwrap();
                let mirrored = |p: Point3<f64>| Point3::new(p.x, -p.y, p.z);
                worst = worst.max((s.cg_m(n) - mirrored(s.cg_m(twin))).norm());
            }
        }),
    );
    assert!(touched);
    assert_below("m", worst, 1e-8);
}

#[test]
fn several_bodies_end_alike_in_lanes_and_when_they_go_on_from_an_output() {
    ends_alike_side_by_side(|i| {
        let friction = format!("materials.flesh.friction={}", 0.2 + 0.1 * f64::from(i));
        let end = if i == 4 { "time.end=105 ms" } else { "time.end=110 ms" };
        Model::new(setup(ABREAST, &[STEPS[0], STEPS[1], end, &friction])).unwrap()
    });
    let model = Model::new(setup(ABREAST, &["time.end=130 ms"])).unwrap();
    let (mut middle, mut whole) = (None, None);
    let look = |s: &Sample<'_>| {
        if s.index == 115 {
            middle = Some(s.checkpoint());
        }
        whole = Some(s.checkpoint());
    };
    let outcome = simulate(&model, Watch(look)).unwrap();
    let mut rest = Last::default();
    let again = resume(&model, &middle.unwrap(), &mut rest).unwrap();
    assert_eq!((whole, outcome.energy), (rest.0, again.energy));
}

/// The same car as two vehicles on one path: the doors belong to the second.
#[test]
fn faces_of_one_vehicle_split_over_two_with_one_path_press_alike() {
    let path = ABREAST.split("[path]").nth(1).unwrap().split("\n\n").next().unwrap();
    let path: String = path.lines().skip(1).map(|line| format!("{line}\n")).collect();
    let split = ABREAST
        .replace("left_door   = {", "left_door   = { frame = \"twin\", meets = \"all\", inside = [0, 0, 0],")
        .to_owned()
        + &format!("\n[vehicles.twin.path]\n{path}");
    let (one, two) = (driver_places(setup(ABREAST, &STEPS)), driver_places(setup(&split, &STEPS)));
    let off = one.iter().zip(&two).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    assert_below("m", off, 1e-9);
}

fn driver_places(setup: Setup) -> Vec<Vector3<f64>> {
    let mut seen: Vec<Vector3<f64>> = Vec::new();
    run(setup, Watch(|s: &Sample<'_>| seen.extend(s.model.body().tree.segments().map(|n| s.cg_m(n).coords))));
    seen
}

#[test]
fn who_flies_with_everything_else_sees_nothing_of_it() {
    let still = driver_places(setup(PEDESTRIAN, &["time.end=150 ms", STEPS[0], STEPS[1]]));
    let mut seen: Vec<Vector3<f64>> = Vec::new();
    // all of it moves to the right with 5 m/s, the ground as a vehicle
    let start = PEDESTRIAN.find("rows = [").unwrap();
    let end = PEDESTRIAN.find("after = \"hold\"").unwrap();
    let row = |pair: &str| {
        let (t_ms, x) = pair.trim().split_once(", ").unwrap();
        format!("[{t_ms}, {x}, {}], ", 5e-3 * t_ms.parse::<f64>().unwrap())
    };
    let pairs = PEDESTRIAN[start + 8..end].split(['[', ']']).filter(|part| part.contains(|c: char| c.is_ascii_digit()));
    let rows: String = pairs.map(row).collect();
    let moving = format!("{}rows = [{rows}]\n{}", &PEDESTRIAN[..start], &PEDESTRIAN[end..])
        .replace("columns = [\"t[ms]\", \"x[m]\"]", "columns = [\"t[ms]\", \"x[m]\", \"y[m]\"]")
        .replace(
            "[ground]\nmaterial = \"asphalt\"\nbelow = \"0.55 m\"",
            "[vehicles.road.path]\nkind = \"table\"\ncolumns = [\"t[ms]\", \"y[m]\", \"z[m]\"]\n\
             rows = [[0, 0, 0.55], [100, 0.5, 0.55], [200, 1, 0.55], [300, 1.5, 0.55]]\n\n[surfaces.road]\nframe = \"road\"\nmaterial = \"asphalt\"\n\
             plane = { point = [0, 0, 0], normal = [0, 0, -1] }\n#",
        )
        .replace("[occupants.walker]", "[occupants.walker]\nvehicle = \"road\"");
    run(
        setup(&moving, &["time.end=150 ms", STEPS[0], STEPS[1]]),
        Watch(|s: &Sample<'_>| {
            // the road lies below the origin
            seen.extend(s.model.body().tree.segments().map(|n| s.cg_m(n).coords + 0.55 * Vector3::z()));
        }),
    );
    let off = still.iter().zip(&seen).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    assert_eq!(still.len(), seen.len());
    assert_below("m", off, 1e-7);
}

/// A ball and a block on the ground.
const GROUND: &str = r#"
[ground]
material = "steel"

[loose.ball]
mass = 2
inertia = [0.008, 0.008, 0.008]
at = [0, 5, -1.1]
spheres = { all = { centre = [0, 0, 0], radius = 0.1 } }
"#;

#[test]
fn a_ball_falls_and_rebounds_as_its_closed_form_says() {
    let (mut speeds, mut touch_s) = (Vec::new(), None);
    let set =
        ["gravity=9.81", "time.end=480 ms", "contact.bodies=[]", "integrator.step=5 us", "initial_state.q[2]=5000"];
    run(
        space(GROUND, &set),
        Watch(|s: &Sample<'_>| {
            speeds.push(s.centre_of_body(1).1.z);
            if touch_s.is_none() && !s.actions.contacts.is_empty() {
                touch_s = Some(s.time_s);
            }
        }),
    );
    // √(2h/g) until it touches, √μ of the speed after, less what gravity does in the meantime
    let fall_s = f64::sqrt(2.0 * 1.0 / 9.81);
    let found_s = touch_s.unwrap();
    assert!(found_s >= fall_s && found_s - fall_s < 5.1e-4, "{found_s} {fall_s}");
    let (down, up) = (speeds.iter().copied().fold(0.0, f64::min), speeds.iter().copied().fold(0.0, f64::max));
    assert_below("restitution", (up / -down - 0.9).abs(), 5e-3);
}

#[test]
fn a_block_that_slides_stops_where_its_closed_form_says() {
    let block = r#"
[ground]
material = "steel"

[loose.block]
mass = 40
inertia = [50, 50, 50]
cg = [0, 0, 0.001]
at = [0, 0, -0.1]
velocity = [3, 0, 0]
spheres = { a = { centre = [1, 1, 0], radius = 0.1 }, b = { centre = [1, -1, 0], radius = 0.1 }, c = { centre = [-1, 1, 0], radius = 0.1 }, d = { centre = [-1, -1, 0], radius = 0.1 } }
"#;
    let (mut far, mut speed) = (0.0, 0.0);
    let set = ["gravity=9.81", "time.end=3 s", "contact.bodies=[]", "initial_state.q[2]=5000", "output.interval=10 ms"];
    let adaptive = SPACE.replace("integrator = { kind = \"rk4\", step = \"20 us\" }", "");
    run(
        setup(&format!("{adaptive}{block}"), &set),
        Watch(|s: &Sample<'_>| {
            (far, speed) = (s.centre_of_body(1).0.x, s.centre_of_body(1).1.xy().norm());
        }),
    );
    // friction of one speed v_s below which it fades: [v √(v² + v_s²) + v_s² asinh(v/v_s)]/(2 f g)
    let (v, f, g, slow) = (3.0_f64, 0.2, 9.81, 0.127_f64);
    let expected = (v * (v * v + slow * slow).sqrt() + slow * slow * (v / slow).asinh()) / (2.0 * f * g);
    assert_below("way", (far / expected - 1.0).abs(), 5e-3);
    assert_below("creep, m/s", speed, 1e-3);
}

#[test]
fn a_panel_that_does_not_move_is_its_vehicle_and_one_that_does_presses_as_its_path_says() {
    let still = "\n[frames.panel]\npath = { kind = \"fixed\" }\n";
    let on_panel =
        |text: &str| text.replace("left_door   = {", "left_door   = { frame = \"panel\", inside = [0, 0, 0],");
    // everything on the panel: the same order of forces, the same bits
    let whole = ABREAST.replace("inside = [0.5, 0, 0] }", "}");
    let whole = whole.replace(" = { material = ", " = { frame = \"panel\", inside = [0.1, 0, -0.4], material = ");
    let (one, two) = (driver_places(setup(ABREAST, &STEPS)), driver_places(setup(&(whole + still), &STEPS)));
    assert!(one == two);
    // the door comes in by 0.1 m within 60 ms: it works on the driver, and the balance closes
    let moving = "\n[frames.panel.path]\nkind = \"table\"\ncolumns = [\"t[ms]\", \"y[m]\"]\nrows = [[0, 0], [15, 0.02], [30, 0.06], [45, 0.09], [60, 0.1]]\nafter = \"hold\"\n";
    let mut work = 0.0;
    let (_, outcome) =
        run(setup(&(on_panel(ABREAST) + moving), &STEPS), Watch(|s: &Sample<'_>| work = s.ledgers[0].vehicle_work_j));
    let mut before = 0.0;
    run(setup(ABREAST, &STEPS), Watch(|s: &Sample<'_>| before = s.ledgers[0].vehicle_work_j));
    assert!((work - before).abs() > 10.0, "{work} {before}");
    assert_below("energy balance", outcome.energy.balance_error, 1e-5);
}

#[test]
fn a_pedestrian_is_thrown_as_far_as_the_speed_allows_and_comes_to_rest() {
    let done = summary(setup(PEDESTRIAN, &[]));
    let throw = &done.throws["walker"];
    assert!(done.reached_s < done.end_s, "{}", done.reached_s);
    assert!(throw.end_speed_m_s < 0.3, "{throw:?}");
    // a projectile that slides on: 2 f g s/(1 + f²) ≤ v² ≤ 2 f g s
    let (v, f, g) = (40.0 / 3.6, 0.7_f64, 9.80665);
    let (least, most) = (v * v / (2.0 * f * g), v * v * (1.0 + f * f) / (2.0 * f * g));
    // he goes 1 % farther than one who slides: he rolls, and the ground slows him by 0.44 g, not by 0.7 g
    assert!(throw.distance_m > least && throw.distance_m < 1.02 * most, "{throw:?} {least} {most}");
    assert!(throw.landing.is_some() && !throw.airborne_s.is_empty());
    assert_below("energy balance", done.energy.balance_error, 1e-4);
}

/// A rider without a vehicle who slides head first at a post.
const RIDER: &str = r#"
title = "a rider slides at a post"
[time]
end = "0.1 s"
[output]
interval = "0.5 ms"
[path]
kind = "fixed"
[ground]
material = "road"
[materials]
road = { k1 = "200 kN/m", mu1 = 0.2, friction = 0.4 }
[solids.post]
kind = "capsule"
material = "road"
ends = [[2.0, 0.0, 0.1], [2.0, 0.0, -0.7]]
radius = 0.06
[occupants.rider]
body = { preset = "male50", segment_count = 15 }
joints = { preset = "gebod" }
mount = { segment = "upper_torso", place = [0.70, 0, -0.15], pitch = 90, yaw = 180, let_go = ["16 m/s", 0, 0] }
"#;

/// With a wheel that is far too stiff for the step the occupant loses his balance, whatever flies a kilometre away.
#[test]
fn a_heavy_body_far_away_does_not_hide_what_the_occupant_has_lost() {
    let cart = include_str!("../data/carts/cart-lap.toml");
    let truck = "\n[loose.truck]\nmass = \"20000 kg\"\ninertia = [1e6, 1e6, 1e6]\nat = [1000, 5000, -5000]\n\
                 velocity = [\"40 m/s\", 0, 0]\n";
    let set = [
        "integrator.step=2 ms",
        "output.interval=2 ms",
        "materials.steering_wheel.k1=20000",
        "materials.steering_wheel.k2=20000",
    ];
    let of = |text: &str| run(setup(text, &set), ()).1.energy;
    let (alone, beside) = (of(cart), of(&format!("{cart}{truck}")));
    assert_eq!((alone.balance, beside.balance), (Balance::Lost, Balance::Lost), "{alone:?} {beside:?}");
    assert!(alone.balance_error > 0.1 && beside.balance_error > 0.1, "{alone:?} {beside:?}");
    assert_eq!(beside.reference, "largest energy of one of the bodies");
}

#[test]
fn a_rider_without_a_vehicle_meets_a_post_in_his_way() {
    let deepest_in_post_m = |set: &[&str]| {
        let mut deepest_m = 0.0_f64;
        let look = Watch(|s: &Sample<'_>| {
            let contacts = s.contacts().filter(|own| s.model.setup().surface_name(own.surface) == Some("post"));
            deepest_m = contacts.fold(deepest_m, |most, own| most.max(own.depth_m));
        });
        run(setup(RIDER, set), look);
        deepest_m
    };
    assert!(deepest_in_post_m(&[]) > 0.01);
    assert_eq!(deepest_in_post_m(&["solids.post.meets=\"own\""]), 0.0);
}

#[test]
fn a_rider_who_begins_below_the_ground_is_refused() {
    let found = Model::new(setup(RIDER, &["occupants.rider.mount.place[2]=0.3"])).map(|_| ()).unwrap_err().to_string();
    assert!(found.contains("ground") && found.contains("behind it at the start"), "{found}");
    assert!(Model::new(setup(RIDER, &[])).is_ok());
}

#[test]
fn one_who_passes_through_the_surfaces_of_a_vehicle_is_named_and_so_is_which_way_is_up() {
    let wall = "surfaces.wall={ material = \"road\", edge = [[3, 0], [3, -1]], half_width = 1, inside = [0, 0, -0.5] }";
    let told = |set: &[&str]| {
        let mut draft = occupant_scenario::Draft::read(RIDER, occupant_scenario::Format::Toml, "test").unwrap();
        set.iter().for_each(|assignment| draft.set(assignment).unwrap());
        let no_files = |name: &str| Err(format!("no file {name}"));
        draft.load(&no_files).and_then(|loaded| loaded.build()).unwrap().1.to_string()
    };
    assert!(told(&[wall]).contains("rider passes through wall"), "{}", told(&[wall]));
    assert!(!told(&[wall, "surfaces.wall.meets=\"all\""]).contains("passes through"));
    let up = told(&["occupants.rider.mount.frame=\"space\"", "occupants.rider.mount.place[2]=0.15"]);
    assert!(up.contains("is up in"), "{up}");
    assert!(!told(&[]).contains("is up in"));
}
