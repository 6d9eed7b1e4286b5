//! Checks of belts over several nodes: their data and their initial course.

use super::data::{Chain, Cue, NEVER, Node, Rest, Site, Stroke, Track};
use super::law::{Lies, Room};
use super::site::TrackLaw;
use super::{ChainLaw, ChainPast, MOST_ARCS, MOST_NODES};
use crate::body::{Body, Shares};
use crate::forces::element::Instant;
use crate::forces::function::Goes;
use crate::forces::plate;
use nalgebra::Vector3;
use placed_text::{Problem, Problems, with_key};

/// Cosines of the angles between planes of neighbouring spheres above which a belt is refused or warned of: 45° and
/// 15°.
const TURNED: [f64; 2] = [std::f64::consts::FRAC_1_SQRT_2, 0.965_925_826_289_068_3];
/// Shortest strap without a warning, m.
const SHORT_M: f64 = 0.05;
/// Largest friction and initial tension without a warning.
const MOST_FRICTION: f64 = 0.6;
/// Friction from which webbing is meant to be clamped, as in a locking tongue.
const CLAMPED: f64 = 3.0;
const MOST_START_N: f64 = 100.0;

pub(super) fn data(chains: &[Chain], body: &Body, problems: &mut Problems) {
    plain_laps(chains, body).for_each(|(chain, k)| submarining(chain, k, problems));
    for chain in chains {
        let path = with_key("belts", &chain.belt);
        nodes(chain, body, &path, problems);
        let falls = "forces that rise from point to point";
        chain.webbing.check(&format!("{path}.webbing"), Goes::Up, falls, problems);
        device(chain, &path, problems);
        if let Some([stiffness, time]) = chain.viscous {
            problems.check_positive(&format!("{path}.webbing.viscous.stiffness"), stiffness, "N");
            problems.check_positive(&format!("{path}.webbing.viscous.time"), time, "s");
        }
        match chain.rest {
            Rest::Length(length) => drop(problems.check_positive(&format!("{path}.length"), length, "m")),
            Rest::Pretension(tension) => problems.check_at_least_zero(&format!("{path}.pretension"), tension, "N"),
            Rest::Slack(slack_m) if slack_m.is_finite() => {}
            Rest::Slack(slack_m) => problems.error(format!("{path}.slack"), format!("{slack_m} m"), "a finite length"),
        }
    }
}

/// First plain point of a pelvis on the way of a lap belt, one that comes from or goes to the vehicle there; none if the
/// belt lies on wings or other tracks of it.
fn plain_lap(chain: &Chain, body: &Body) -> Option<usize> {
    let pelvis_of = |node: &Node| {
        let (Site::Segment(segment, ..) | Site::Track(segment, _)) = node.site else { return None };
        let segment = (segment < body.segments.len()).then(|| body.tree.segment(segment))?;
        body.tree.landmarks_at(segment).pelvis.filter(|pelvis| *pelvis == segment)
    };
    if chain.nodes.iter().any(|node| matches!(node.site, Site::Track(..)) && pelvis_of(node).is_some()) {
        return None;
    }
    let is_vehicle = |node: Option<&Node>| node.is_some_and(|node| matches!(node.site, Site::Vehicle(..)));
    let is_lap = |k: &usize| {
        let beside = [k.checked_sub(1), Some(k + 1)].map(|k| chain.nodes.get(k?));
        pelvis_of(&chain.nodes[*k]).is_some() && beside.into_iter().any(is_vehicle)
    };
    (0..chain.nodes.len()).find(is_lap)
}

/// Lap belts over plain points of a pelvis, which webbing cannot leave, and the first such node of each: once for the parts of a
/// belt between ties.
pub(crate) fn plain_laps<'c>(chains: &'c [Chain], body: &'c Body) -> impl Iterator<Item = (&'c Chain, usize)> {
    let lap = |chain: &'c Chain| Some((chain, plain_lap(chain, body)?));
    let is_first = move |i: usize, belt: &str| chains[..i].iter().filter_map(lap).all(|(part, _)| part.belt != belt);
    let laps = chains.iter().enumerate().filter_map(move |(i, chain)| Some((i, lap(chain)?)));
    laps.filter(move |(i, (chain, _))| is_first(*i, &chain.belt)).map(|(_, lap)| lap)
}

/// Warns of such a belt.
fn submarining(chain: &Chain, k: usize, problems: &mut Problems) {
    let path = with_key("belts", &chain.belt);
    let found = format!("a lap belt over `{}`, a plain point of the pelvis", chain.nodes[k].name);
    let expected = "nodes with `wing = \"left\"` and `wing = \"right\"`: webbing cannot slide up from a plain point, so submarining cannot be seen";
    let hint = "or use `preset = \"three_point\"` with `lap = \"wings\"`";
    problems.push(Problem::warning(format!("{path}.nodes[{k}]"), found, expected).with_hint(Some(hint)));
}

fn nodes(chain: &Chain, body: &Body, path: &str, problems: &mut Problems) {
    let path = format!("{path}.nodes");
    let count = chain.nodes.len();
    if !(2..=MOST_NODES).contains(&count) {
        problems.error(
            &path,
            format!("{count} nodes"),
            format!("2 to {MOST_NODES} nodes of a belt, or of a part between ties"),
        );
    }
    problems.check_unique(&path, "node", chain.nodes.iter().map(|node| node.name.as_str()));
    let mut spheres = 0;
    for (i, node) in chain.nodes.iter().enumerate() {
        let at = format!("{path}[{i}]");
        let (is_end, is_sphere) = (i == 0 || i + 1 == count, matches!(node.site, Site::Sphere(_)));
        if is_end && (is_sphere || matches!(node.site, Site::Track(..) | Site::Segment(_, _, Some(_)))) {
            problems.error(&at, "an end that webbing can leave", "an anchor: a point of the vehicle or of a segment");
        }
        let is_sphere_at = |k: usize| chain.nodes.get(k).is_some_and(|node| matches!(node.site, Site::Sphere(_)));
        if is_sphere && node.friction > 0.0 && (is_sphere_at(i.wrapping_sub(1)) || is_sphere_at(i + 1)) {
            let expected = "a point, such as a ring or a guide, on either side of a sphere with friction";
            problems.error(format!("{at}.friction"), "friction on a sphere beside a sphere", expected);
        }
        spheres = usize::from(is_sphere) + if node.friction > 0.0 { 0 } else { spheres };
        if spheres > MOST_ARCS {
            problems.error(
                &at,
                format!("{spheres} spheres of one strap"),
                format!("at most {MOST_ARCS} between points with friction"),
            );
        }
        one(node, body, &at, problems);
    }
}

fn one(node: &Node, body: &Body, at: &str, problems: &mut Problems) {
    problems.check_at_least_zero(&format!("{at}.friction"), node.friction, "1");
    problems.check_positive(&format!("{at}.strength"), node.strength_n, "N");
    if node.friction > MOST_FRICTION && node.friction < CLAMPED {
        problems.warning(
            format!("{at}.friction"),
            format!("{}", node.friction),
            "0.1 to 0.6: webbing over steel or cloth; 3 or more clamps it",
        );
    }
    if let (Site::Segment(segment, ..) | Site::Track(segment, _), false) = (&node.site, node.ride.is_empty()) {
        rides(*segment, &node.ride, &format!("{at}.ride"), body, problems);
    }
    match &node.site {
        Site::Vehicle(point, stroke) => {
            is_finite(&point.coords, at, problems);
            stroke.iter().for_each(|stroke| check_stroke(stroke, at, problems));
        }
        Site::Segment(_, point, away) => {
            is_finite(&point.coords, at, problems);
            if away.is_some_and(|away| !(away.norm() > 0.5 && away.norm() < 2.0)) {
                problems.error(format!("{at}.normal"), "no direction", "a direction away from the body");
            }
        }
        Site::Track(_, track) => check_track(track, body, at, problems),
        Site::Sphere(sphere) if *sphere >= body.spheres.len() => {
            problems.error(format!("{at}.sphere"), "no such sphere", "a sphere of the body");
        }
        Site::Sphere(_) => {}
    }
}

/// Checks that a point of a segment (index) can ride on these plates.
fn rides(segment: usize, shares: &Shares, path: &str, body: &Body, problems: &mut Problems) {
    if segment >= body.segments.len() {
        problems.error(path, "a point of no segment", "a segment of the body");
    } else {
        plate::rides(shares, path, body.tree.segment(segment), &body.plates, problems);
    }
}

fn is_finite(point: &Vector3<f64>, at: &str, problems: &mut Problems) {
    if point.iter().any(|c| !c.is_finite()) {
        problems.error(format!("{at}.at"), "not finite numbers", "a point");
    }
}

fn check_track(track: &Track, body: &Body, at: &str, problems: &mut Problems) {
    if let Some(next) = &track.then {
        let path = format!("{at}.then");
        is_finite(&next.point_m.coords, &path, problems);
        rides(next.segment, &next.ride, &format!("{path}.ride"), body, problems);
    }
    problems.check_at_least_zero(&format!("{at}.across"), track.friction, "1");
    problems.check_positive(&format!("{at}.drag"), track.drag_n_s_m, "N*s/m");
    if TrackLaw::new(track, 0, &|_| Vector3::zeros()).is_none() {
        problems.error(format!("{at}.track"), "three points in line", "inner end, crown and outer end of an arc");
    }
}

fn check_stroke(stroke: &Stroke, at: &str, problems: &mut Problems) {
    let path = format!("{at}.pretensioner");
    table(&stroke.way, &path, problems);
    problems.check_positive(&format!("{path}.stall_force"), stroke.stall_n, "N");
}

/// A table that begins at (0, 0) with nondecreasing values.
fn table(rows: &[[f64; 2]], path: &str, problems: &mut Problems) {
    if rows.len() < 2 || rows[0] != [0.0, 0.0] {
        problems.error(path, "a table that does not begin with 0, 0", "two rows or more from time 0 and 0 on");
    }
    if rows.windows(2).any(|pair| !(pair[1][0] > pair[0][0] && pair[1][1] >= pair[0][1])) {
        problems.error(path, "times that do not rise or values that fall", "times that rise, values that do not fall");
    }
}

fn device(chain: &Chain, path: &str, problems: &mut Problems) {
    let falls = "a force that does not fall over payout; a force that falls needs a second limiter and a trigger";
    let limiters = chain.device.limiter.iter().map(|law| (law, "limiter"));
    let second = chain.device.second.iter().map(|(law, ..)| (law, "second_limiter"));
    for (law, key) in limiters.chain(second) {
        law.check(&format!("{path}.{key}"), Goes::NotDown, falls, problems);
    }
    cue(&chain.release, &format!("{path}.release"), problems);
    if let Some((_, by, over_s)) = &chain.device.second {
        cue(by, &format!("{path}.second_limiter"), problems);
        problems.check_at_least_zero(&format!("{path}.second_limiter.over"), *over_s, "s");
    }
    let Some(reel) = &chain.device.reel else { return };
    cue(&reel.lock, &format!("{path}.retractor.lock"), problems);
    for (key, value, unit) in [("lock_after", reel.lock_after[0], "m"), ("lock_within", reel.lock_after[1], "s")] {
        problems.check_at_least_zero(&format!("{path}.retractor.{key}"), value, unit);
    }
    problems.check_positive(&format!("{path}.retractor.on_spool"), reel.on_spool_m, "m");
    if reel.tension_n.is_nan() || reel.tension_n < 0.1 {
        let found = format!("{} N", reel.tension_n);
        problems.error(
            format!("{path}.retractor.spool_tension"),
            found,
            "at least 0.1 N: an open spool keeps its webbing taut",
        );
    }
    let most_n = chain.device.limiter.as_ref().map_or(f64::INFINITY, |limiter| limiter.greatest_n());
    if reel.tension_n > most_n {
        problems.error(
            format!("{path}.retractor"),
            "a spool tension above the limiter",
            "a tension that the limiter can hold",
        );
    }
    if let Some(pull) = &reel.pull {
        let path = format!("{path}.retractor.pretensioner");
        cue(&pull.cue, &path, problems);
        if pull.by_force.is_none() {
            table(&pull.table, &path, problems);
        }
        problems.check_positive(&format!("{path}.stall_force"), pull.stall_n, "N");
        if pull.stall_n > most_n && pull.stall_n < NEVER {
            let expected = "a stall force that the limiter can hold";
            problems.error(format!("{path}.stall_force"), format!("{} N above the limiter", pull.stall_n), expected);
        }
    }
    if reel.lock.due_s >= NEVER && reel.lock.watch.is_none() && reel.pull.is_none() {
        problems.warning(
            format!("{path}.retractor"),
            "a spool that nothing locks in this run",
            "a lock whose trigger fires",
        );
    }
}

/// Checks a cue: a time, [`NEVER`] if unknown, or a watched quantity.
fn cue(cue: &Cue, path: &str, problems: &mut Problems) {
    let watched = cue.watch.iter().flat_map(|watch| [watch.threshold, watch.lasting_s, watch.delay_s]);
    if let Some(number) = [cue.due_s].into_iter().chain(watched).find(|number| !number.is_finite()) {
        problems.error(path, format!("{number}"), "finite numbers; `chain::NEVER` for what does not happen");
    }
}

/// Belts in their initial position.
pub(super) fn laid(
    law: &[ChainLaw<f64>],
    data: &[Chain],
    pasts: &[ChainPast<f64>],
    body: &Body,
    at: &Instant<'_, f64>,
    problems: &mut Problems,
) {
    for ((law, chain), past) in law.iter().zip(data).zip(pasts) {
        let path = with_key("belts", &chain.belt);
        let count = law.straps.starts.len();
        if chain.straps.len() != count {
            let found = format!("{} names of straps", chain.straps.len());
            problems.error(format!("{path}.straps"), found, format!("{count}, one for each"));
        }
        let mut room = Room::new();
        let now = law.now(at, past, &mut room, false);
        for (k, node) in chain.nodes.iter().enumerate() {
            let node_path = format!("{path}.nodes[{k}]");
            if let (Site::Sphere(sphere), true) = (&node.site, past.nodes[k].on == 0.0) {
                let found = format!("the belt does not touch the sphere {} at the start", body.spheres[*sphere].name);
                let problem = Problem::warning(&node_path, found, "a belt that lies on it");
                problems.push(
                    problem.with_hint(Some("it takes part once the belt comes onto it; check the nodes beside it")),
                );
            }
            inside(law, chain, body, (k, &node_path), &now.lies.places, problems);
            slope(chain, body, (k, &node_path), at, &now.lies.places, problems);
            planes(chain, past, k, now.lies, problems, &node_path);
        }
        for (name, run) in chain.straps.iter().zip(now.taut.runs) {
            if run.length.is_nan() || run.length <= 0.0 {
                problems.error(&path, format!("the strap {name} has no length"), "nodes in different places");
            } else if run.length < SHORT_M {
                let found = format!("the strap {name} is {:.0} mm long", 1e3 * run.length);
                problems.warning(&path, found, "50 mm or more: shorter ones are very stiff");
            }
        }
        let tension = now.taut.straps[0].tension;
        if tension > MOST_START_N {
            problems.warning(&path, format!("a tension of {tension:.0} N at the start"), "less than 100 N");
        }
    }
}

/// Neighbouring spheres with different planes: the length is then ambiguous, and neither may be on the webbing's side.
fn planes(chain: &Chain, past: &ChainPast<f64>, k: usize, lies: &Lies<f64>, problems: &mut Problems, path: &str) {
    let is_sphere = |k: usize| chain.nodes.get(k).is_some_and(|node| matches!(node.site, Site::Sphere(_)));
    let is_on = |k: usize| is_sphere(k) && past.nodes[k].on > 0.0;
    if !(is_on(k) && is_on(k + 1)) {
        return;
    }
    let cosine = lies.bends[k].normal.dot(lies.bends[k + 1].normal);
    let found = format!("{:.0}° between the planes of webbing on this sphere and on the next", degrees(cosine));
    if cosine < TURNED[0] {
        problems.error(path, found, "at most 45°, both on one side of the webbing: a point between them");
    } else if cosine < TURNED[1] {
        problems.warning(path, found, "less than 15°: the length is 0.5 mm in 1.4 m off at 5°");
    }
}

fn degrees(cosine: f64) -> f64 {
    occupant_units::trig::acos(cosine.clamp(-1.0, 1.0)).to_degrees()
}

/// Least slope of a lap part from the pelvis back and down to its anchors, °: a flatter one slides up to the abdomen.
const LEAST_SLOPE_DEG: f64 = 30.0;

/// Warns of a lap part that would not stay on the pelvis: webbing around a sphere cannot slide up from it.
fn slope(
    chain: &Chain,
    body: &Body,
    (k, path): (usize, &str),
    at: &Instant<'_, f64>,
    places: &[super::path::Place<f64>; MOST_NODES],
    problems: &mut Problems,
) {
    let Site::Sphere(sphere) = chain.nodes[k].site else { return };
    let segment = body.spheres[sphere].segment;
    if body.tree.landmarks_at(segment).pelvis != Some(segment) {
        return;
    }
    let axes = &at.frames[chain.frame.index(&[])].axes;
    for other in [k.wrapping_sub(1), k + 1] {
        if !chain.nodes.get(other).is_some_and(|node| matches!(node.site, Site::Vehicle(..))) {
            continue;
        }
        let to = axes.into_frame(places[other].centre - places[k].centre);
        let slope_deg = occupant_units::trig::atan2(to.z, -to.x).to_degrees();
        if (-90.0..LEAST_SLOPE_DEG).contains(&slope_deg) {
            let found = format!(
                "the lap belt goes from the pelvis to an anchor at {slope_deg:.0}° below the level, counted from straight back"
            );
            let expected = format!(
                "{LEAST_SLOPE_DEG}° or more: a flatter belt slides up to the belly, and this one cannot: submarining does not show"
            );
            let hint = "move the anchor, or check the seat's position";
            problems.push(Problem::warning(path, found, expected).with_hint(Some(hint)));
            return;
        }
    }
}

/// A node inside the neighbouring sphere.
fn inside(
    law: &ChainLaw<f64>,
    chain: &Chain,
    body: &Body,
    (k, path): (usize, &str),
    places: &[super::path::Place<f64>; MOST_NODES],
    problems: &mut Problems,
) {
    for other in [k.wrapping_sub(1), k + 1] {
        let (Some(Site::Sphere(sphere)), Some(_)) = (chain.nodes.get(other).map(|n| &n.site), law.nodes.get(other))
        else {
            continue;
        };
        let (own, beside) = (&places[k], &places[other]);
        let distance = (own.centre - beside.centre).norm_squared().sqrt();
        if distance <= (beside.radius - own.radius).abs() {
            let (name, radius) = (&body.spheres[*sphere].name, beside.radius);
            let found = format!("{distance:.4} m from the centre of the sphere {name} of radius {radius:.4} m");
            problems.error(path, found, "a node outside the sphere beside it");
        }
    }
}
