//! Every number of a setup in turn is no number, and infinite: a model of it is refused.

use occupant_core::forces::bag::{Leakage, Shape};
use occupant_core::forces::belt::RestLength;
use occupant_core::forces::chain::{Cue, Rest, Site};
use occupant_core::forces::contact::material::Force;
use occupant_core::forces::contact::surface::{Facing, Outline};
use occupant_core::forces::spring::BilinearSpring;
use occupant_core::model::seating::{InitialPosture, InitialVelocity};
use occupant_core::model::setup::{Integrator, Setup};

use super::{Came, came, model, report, setup};

type Numbers<'s> = Vec<(String, &'s mut f64)>;

fn spring<'s>(list: &mut Numbers<'s>, of: &str, spring: &'s mut BilinearSpring) {
    let BilinearSpring { k1_n_per_m, k2_n_per_m, break_m, returned_1, returned_2 } = spring;
    for (key, number) in
        [("k1", k1_n_per_m), ("k2", k2_n_per_m), ("break", break_m), ("mu1", returned_1), ("mu2", returned_2)]
    {
        list.push((format!("{of}.{key}"), number));
    }
}

/// The numbers of a setup that a model must refuse when they are none.
fn numbers(setup: &mut Setup) -> Numbers<'_> {
    let mut list: Numbers<'_> = Vec::new();
    let Setup { body, joints, materials, surfaces, belts, chains, bags, columns, posture, velocity, time, .. } = setup;
    list.push(("gravity".into(), &mut setup.gravity_m_s2));
    list.extend([("start", &mut time.start_s), ("end", &mut time.end_s), ("output", &mut time.output_s)].map(named));
    match &mut setup.integrator {
        Integrator::Rk4 { step_s } => list.push(("step".into(), step_s)),
        Integrator::Adaptive { relative, absolute_m, absolute_m_s, min_step_s, max_step_s } => {
            let all = [relative, absolute_m, absolute_m_s, min_step_s, max_step_s];
            list.extend(all.into_iter().enumerate().map(|(i, number)| (format!("integrator {i}"), number)));
        }
    }
    for (i, one) in body.segments.iter_mut().enumerate() {
        list.push((format!("length {i}"), &mut one.length_m));
        list.push((format!("mass {i}"), &mut one.mass_kg));
        list.push((format!("cg {i}"), &mut one.cg_from_lower_end_m));
        list.extend(one.cg_beside_m.iter_mut().map(|x| (format!("cg beside {i}"), x)));
        list.extend(one.inertia_kg_m2.iter_mut().map(|x| (format!("inertia {i}"), x)));
    }
    let widths = [&mut body.shoulder_half_width_m, &mut body.hip_half_width_m, &mut body.neck_height_m];
    list.extend(widths.into_iter().enumerate().map(|(i, x)| (format!("width {i}"), x)));
    for one in &mut body.spheres {
        list.push((format!("radius {}", one.name), &mut one.radius_m));
        list.push((format!("share {}", one.name), &mut one.share));
        list.extend(one.centre_from_lower_end_m.iter_mut().map(|x| (format!("centre {}", one.name), x)));
    }
    list.push(("epsilon".into(), &mut joints.epsilon));
    for one in materials {
        list.push((format!("friction {}", one.name), &mut one.friction));
        list.push((format!("friction speed {}", one.name), &mut one.friction_speed_m_s));
        if let Force::Bilinear(own) = &mut one.force {
            spring(&mut list, &one.name, own);
        }
    }
    for one in surfaces {
        let name = one.name.clone();
        match &mut one.outline {
            Outline::Polygon(corners) => {
                list.extend(corners.iter_mut().flat_map(|p| p.iter_mut()).map(|x| (format!("corner {name}"), x)));
            }
            Outline::Disc { centre_m, radius_m, axis } => {
                list.push((format!("radius {name}"), radius_m));
                list.extend(centre_m.iter_mut().chain(axis.iter_mut()).map(|x| (format!("disc {name}"), x)));
            }
            Outline::Unbounded { point_m, axis } => {
                list.extend(point_m.iter_mut().chain(axis.iter_mut()).map(|x| (format!("plane {name}"), x)));
            }
        }
        if let Facing::Towards(point) = &mut one.facing {
            list.extend(point.iter_mut().map(|x| (format!("facing {name}"), x)));
        }
    }
    for one in belts {
        spring(&mut list, &one.name, &mut one.webbing);
        list.extend(one.anchors_m.iter_mut().flat_map(|p| p.iter_mut()).map(|x| ("anchor".into(), x)));
        list.push(match &mut one.rest {
            RestLength::Slack { slack_m } => ("slack".into(), slack_m),
            RestLength::Given { length_m } => ("length".into(), length_m),
        });
    }
    for one in chains {
        list.extend(one.webbing.points.iter_mut().flatten().map(|x| ("webbing".into(), x)));
        list.extend(one.webbing.returned.iter_mut().map(|x| ("returned".into(), x)));
        list.extend(one.viscous.iter_mut().flatten().map(|x| ("viscous".into(), x)));
        list.push(match &mut one.rest {
            Rest::Slack(x) => ("chain slack".into(), x),
            Rest::Pretension(x) => ("pretension".into(), x),
            Rest::Length(x) => ("chain length".into(), x),
        });
        for node in &mut one.nodes {
            list.push((format!("friction {}", node.name), &mut node.friction));
            match &mut node.site {
                Site::Vehicle(point, _) | Site::Segment(_, point, _) => {
                    list.extend(point.iter_mut().map(|x| (format!("node {}", node.name), x)));
                }
                Site::Track(_, track) => {
                    list.extend(track.points_m.iter_mut().flat_map(|p| p.iter_mut()).map(|x| ("track".into(), x)));
                    list.push(("track friction".into(), &mut track.friction));
                    list.push(("track drag".into(), &mut track.drag_n_s_m));
                }
                Site::Sphere(_) => {}
            }
        }
        if let Some(reel) = &mut one.device.reel {
            list.push(("on spool".into(), &mut reel.on_spool_m));
            list.push(("reel tension".into(), &mut reel.tension_n));
            list.extend(reel.lock_after.iter_mut().map(|x| ("lock after".into(), x)));
            cue(&mut list, "lock", &mut reel.lock);
        }
        cue(&mut list, "release", &mut one.release);
    }
    for one in bags {
        list.extend(one.mount_m.iter_mut().map(|x| ("mount".into(), x)));
        list.extend(one.ambient.iter_mut().map(|x| ("ambient".into(), x)));
        list.push(("volume".into(), &mut one.volume_m3));
        list.push(("fires".into(), &mut one.fires_s));
        list.push(("deploy".into(), &mut one.deploy_s));
        list.push(("heat".into(), &mut one.heat_w_m2_k));
        list.push(("bag friction".into(), &mut one.friction));
        list.push(("bag friction speed".into(), &mut one.friction_speed_m_s));
        for inflator in &mut one.inflators {
            list.push(("ignites".into(), &mut inflator.due_s));
            list.extend(inflator.rows.iter_mut().flatten().map(|x| ("inflator".into(), x)));
        }
        for vent in &mut one.vents {
            list.push(("vent".into(), &mut vent.area_m2));
            list.push(("discharge".into(), &mut vent.discharge));
        }
        if let Leakage::Fraction(x) = &mut one.leakage {
            list.push(("leakage".into(), x));
        }
        if let Shape::Dome { axis, depth_m, radius_m, face_radius_m, edge_m } = &mut one.shape {
            list.extend(axis.iter_mut().map(|x| ("bag axis".into(), x)));
            list.extend([depth_m, radius_m, face_radius_m, edge_m].map(|x| ("dome".into(), x)));
        }
    }
    for one in columns {
        list.extend(one.axis.iter_mut().chain(one.hub_m.iter_mut()).map(|x| ("column".into(), x)));
        list.push(("column mass".into(), &mut one.mass_kg));
        list.extend(one.force.points.iter_mut().flatten().map(|x| ("column force".into(), x)));
    }
    if let InitialPosture::Seated(seating) = posture {
        list.push(("lateral".into(), &mut seating.lateral_m));
        list.extend(seating.heels_m.iter_mut().map(|x| ("heels".into(), x)));
        list.extend(seating.angles_rad.iter_mut().map(|(name, x)| (format!("angle {name}"), x)));
    }
    if let InitialVelocity::Given(v) = velocity {
        list.extend(v.iter_mut().map(|x| ("velocity".into(), x)));
    }
    list
}

fn cue<'s>(list: &mut Numbers<'s>, of: &str, cue: &'s mut Cue) {
    list.push((format!("{of} due"), &mut cue.due_s));
    if let Some(watch) = &mut cue.watch {
        let all = [&mut watch.threshold, &mut watch.lasting_s, &mut watch.delay_s];
        list.extend(all.into_iter().map(|x| (format!("{of} watch"), x)));
    }
}

fn named<'s>((name, number): (&str, &'s mut f64)) -> (String, &'s mut f64) {
    (name.to_owned(), number)
}

const CASES: [(&str, &str); 4] = [
    ("cart", include_str!("../../../scenarios/cart-lap-torso.toml")),
    ("three-point", include_str!("../../../tests/data/hand/three-point.toml")),
    ("air bag", include_str!("../../../tests/data/hand/airbag-driver.toml")),
    ("column", include_str!("../../../tests/data/hand/column-driver.toml")),
];

/// 1312 calls: 656 numbers, each not a number and infinite.
#[test]
fn no_number_of_a_setup_may_be_none() {
    let (mut failures, mut calls) = (Vec::new(), 0);
    for (case, text) in CASES {
        let whole = setup(text);
        let count = numbers(&mut whole.clone()).len();
        for (i, hostile) in (0..count).flat_map(|i| [(i, f64::NAN), (i, f64::INFINITY)]) {
            let mut broken = whole.clone();
            let mut all = numbers(&mut broken);
            let name = format!("{case}: {} = {hostile}", all[i].0);
            *all[i].1 = hostile;
            drop(all);
            calls += 1;
            match came(&name, || model(broken)) {
                Ok(Came::Refused(_)) => {}
                Ok(Came::Answered) => failures.push(format!("{name}: a model was made of it")),
                Err(words) => failures.push(words),
            }
        }
    }
    report(&failures);
    assert!(calls >= 300, "{calls}");
}
