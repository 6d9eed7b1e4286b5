//! `body.chest`, `body.plates`, `ride`: what they come to, and what is refused.

use super::belts::changed;

const DRIVER: &str = include_str!("../../testdata/hand/three-point.toml");

#[test]
fn a_chest_of_a_person_comes_to_three_plates_that_scale_with_the_body() {
    let (model, _) = changed(DRIVER, &["body.chest=person", "body.pelvis=flesh"]).unwrap();
    let body = model.body();
    let names: Vec<&str> = body.plates.iter().map(|plate| plate.name.as_str()).collect();
    assert_eq!(names, ["sternum", "left_ribs", "right_ribs", "flesh"]);
    let sternum = &body.plates[0];
    assert!((sternum.mass_kg - 0.2).abs() < 1e-12 && (sternum.depth_m.unwrap() - 0.2402).abs() < 1e-3);
    assert_eq!(model.setup().bands[0].spring.points[1], [0.022, 220.0]);
    let chest = &body.spheres[body.sphere("chest").unwrap()];
    assert_eq!((&chest.ride.contact[..], &chest.ride.belt[..]), (&[(0, 1.0)][..], &[(0, 0.35)][..]));
    let pelvis = &body.spheres[body.sphere("pelvis").unwrap()];
    assert_eq!((pelvis.ride.contact.len(), &pelvis.ride.belt[..]), (0, &[(3, 1.0)][..]));
    let links: Vec<&str> = model.setup().bands.iter().map(|band| band.name.as_str()).collect();
    assert_eq!(links, ["sternum", "flesh", "rib_cage", "rocking"]);
    // the seat's back, a solid behind all surfaces
    let back = model.setup().surface_names().position(|name| name == "seat_back");
    assert_eq!(model.setup().behind, back.into_iter().collect::<Vec<_>>());
    let (small, _) = changed(DRIVER, &["body.preset=female05", "body.chest=person"]).unwrap();
    let [depth_m, force_n] = small.setup().bands[0].spring.points[1];
    assert!((0.016..0.020).contains(&depth_m) && (140.0..190.0).contains(&force_n), "{depth_m} {force_n}");
    assert!((0.1..0.15).contains(&small.body().plates[0].mass_kg));
}

const EVEN: &str = "body.sphere_set=even";

#[test]
fn sides_of_a_person_yield_as_the_front() {
    let set = [EVEN, "body.chest=person", "body.abdomen=person", "body.sides=person"];
    let (model, _) = changed(DRIVER, &set).unwrap();
    let body = model.body();
    let names: Vec<&str> = body.plates.iter().map(|plate| plate.name.as_str()).collect();
    assert_eq!(names[4..], ["left_side", "right_side", "left_pelvis", "right_pelvis", "abdomen_side"]);
    let (front, left) = (&model.setup().bands[0], &model.setup().bands[2]);
    assert_eq!((&left.name[..], &left.spring, left.damper), ("left_side", &front.spring, front.damper));
    // inwards is to the right on the left side; the plates stand where the spheres at the sides end
    let ends = ["left_chest", "right_chest"].map(|name| {
        let sphere = &body.spheres[body.sphere(name).unwrap()];
        sphere.centre_from_lower_end_m.y.abs() + sphere.radius_m
    });
    for (plate, (sign, end_m)) in body.plates[4..6].iter().zip([1.0, -1.0].into_iter().zip(ends)) {
        assert!((plate.place_from_lower_end_m.y - sign * end_m).abs() < 1e-12 && plate.inward.y == -sign);
    }
    let sides = &body.sides[0];
    assert_eq!((&sides.preset[..], sides.ribs, sides.abdomen), ("person", [4, 5], Some(8)));
    assert_eq!((sides.pelvis, sides.pubic_share), (Some([6, 7]), None));
    assert!((sides.half_breadth_m - ends[0]).abs() < 1e-12 && (0.14..0.17).contains(&ends[0]));
    let ride = |name: &str| body.spheres[body.sphere(name).unwrap()].ride.clone();
    assert_eq!(ride("left_chest").contact, [(0, 1.0), (4, 1.0)]);
    assert_eq!(ride("chest").contact, [(0, 1.0), (4, 0.5), (5, 0.5)]);
    for name in ["abdomen", "left_abdomen", "right_abdomen"] {
        assert_eq!(ride(name).contact, [(3, 1.0), (8, 1.0)], "{name}");
    }
    assert_eq!((ride("left_pelvis").contact, ride("pelvis").bag), (vec![(6, 1.0)], vec![(6, 0.5), (7, 0.5)]));
    assert_eq!((ride("left_chest").belt, ride("left_chest").bag), (vec![(0, 0.35)], vec![(0, 0.35), (4, 1.0)]));
    let [own, abdomen] = ["left_abdomen", "abdomen"].map(|name| &body.spheres[body.sphere(name).unwrap()]);
    let half_m = own.centre_from_lower_end_m.y + own.radius_m;
    assert!(own.part == "abdomen" && (half_m / abdomen.radius_m - 1.47).abs() < 1e-12 && half_m > 0.15);
    let (less, _) = changed(DRIVER, &[&set[..], &["body.spheres.left_abdomen.remove=true"]].concat()).unwrap();
    assert!(less.body().sphere("left_abdomen").is_none() && less.body().sphere("right_abdomen").is_some());
    // without them all is as it was
    let (plain, _) = changed(DRIVER, &set[..3]).unwrap();
    assert!(plain.body().sides.is_empty() && plain.body().plates.len() == 4);
}

#[test]
fn sides_need_the_spheres_that_carry_what_strikes_them() {
    for (changes, expected) in [
        (&["body.sides=person"][..], "body.sphere_set = \"even\""),
        (&[EVEN, "body.sides=person", "body.preset=child10"], "they stay rigid"),
        (&[EVEN, "body.sides=es-2"], "es2"),
        (&[EVEN, "body.sides=person", "body.plates.left_side.mass=9"], "at most a fifth of their segment's mass"),
        (&[EVEN, "body.sides=es2", "body.spheres.left_chest.remove=true"], "no sphere `left_chest`"),
    ] {
        let said = match changed(DRIVER, changes) {
            Ok((_, said)) => said,
            Err(said) => said,
        };
        assert!(said.contains(expected), "{changes:?}: {said}");
    }
}

#[test]
fn a_rigid_chest_is_none() {
    let (model, _) = changed(DRIVER, &["body.chest=rigid"]).unwrap();
    assert!(model.body().plates.is_empty() && model.body().chests.is_empty() && model.setup().bands.is_empty());
}

#[test]
fn what_is_wrong_with_plates_is_said_at_its_place() {
    let chest = "body.chest=person";
    for (changes, expected) in [
        (&[chest, "body.plates.sternum.segment=\"upper_torsos\""][..], "did you mean \"upper_torso\"?"),
        (&[chest, "body.plates.sternum.segment=\"head\""], "which is a part of another segment"),
        (&[chest, "body.plates.sternum.inward=[0, 0, 0]"], "the direction in which it yields"),
        (&[chest, "body.plates.sternum.mass=0"], "body.plates.sternum.mass"),
        (&[chest, "body.plates.sternum.mass=8"], "at most a fifth of their segment's mass"),
        (&[chest, "body.plates.sternum.damper.linear=-1"], "body.plates.sternum.damper.linear"),
        (&[chest, "body.plates.sternum.spring.returned=1.2"], "body.plates.sternum.spring.returned"),
        (&[chest, "body.plates.sternum.spring.force=[0, 900, 200]"], "forces that do not fall"),
        (&[chest, "body.spheres.chest.ride.belt.sternum=1.5"], "a share from 0 to 1"),
        (&[chest, "body.spheres.chest.ride.belt.sternun=0.5"], "did you mean \"sternum\"?"),
        (&[chest, "body.plate_links.rocking.of={ left_rib = 1 }"], "did you mean \"left_ribs\"?"),
        (&["body.chest=persons"], "did you mean \"person\"?"),
        (&[chest, "body.preset=child10"], "an adult preset or person"),
    ] {
        let said = match changed(DRIVER, changes) {
            Ok((_, said)) => said,
            Err(said) => said,
        };
        assert!(said.contains(expected), "{changes:?}: {said}");
    }
}
