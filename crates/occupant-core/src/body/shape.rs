//! Spheres without gaps between them: what a body may have in place of the report's 17.
//!
//! Ours, not measured. Each is placed by one of the report's spheres and has its size from it, or stands in a row along a
//! limb; so every tree that has those spheres and segments of these names has them. Left and right are mirrored.

use nalgebra::Vector3;

use super::{Body, ContactSphere, Segment, Tree};

/// A sphere near another, to whose part it belongs.
struct Beside {
    name: &'static str,
    of: &'static str,
    /// Radius, and centre forward, left and up from that sphere's, in its radii.
    radius: f64,
    place: [f64; 3],
}

/// Radius of the spheres at the sides of the chest and distance of their centres from its middle, in radii of the chest's
/// sphere.
const SIDE_OF_CHEST: [f64; 2] = [0.8, 0.54];
/// Half of the breadth of a chest with these, in radii of its sphere.
pub const CHEST_OUT: f64 = SIDE_OF_CHEST[0] + SIDE_OF_CHEST[1];

/// The same of the spheres at the sides of the pelvis and of the abdomen.
const SIDE_OF_PELVIS: [f64; 2] = [0.8, 0.67];
/// Half of the breadth of a pelvis with these, in radii of its sphere.
pub const PELVIS_OUT: f64 = SIDE_OF_PELVIS[0] + SIDE_OF_PELVIS[1];

const BESIDE: [Beside; 10] = [
    beside("face", "head", 0.6, [0.45, 0.0, -0.65]),
    beside("chin", "head", 0.35, [0.6, 0.0, -1.0]),
    beside("right_chest", "chest", SIDE_OF_CHEST[0], [0.0, -SIDE_OF_CHEST[1], 0.0]),
    beside("left_chest", "chest", SIDE_OF_CHEST[0], [0.0, SIDE_OF_CHEST[1], 0.0]),
    beside("right_pelvis", "pelvis", SIDE_OF_PELVIS[0], [0.0, -SIDE_OF_PELVIS[1], 0.0]),
    beside("left_pelvis", "pelvis", SIDE_OF_PELVIS[0], [0.0, SIDE_OF_PELVIS[1], 0.0]),
    beside("right_abdomen", "abdomen", SIDE_OF_PELVIS[0], [0.0, -SIDE_OF_PELVIS[1], 0.0]),
    beside("left_abdomen", "abdomen", SIDE_OF_PELVIS[0], [0.0, SIDE_OF_PELVIS[1], 0.0]),
    beside("right_forefoot", "right_foot", 0.7, [3.2, 0.0, -0.3]),
    beside("left_forefoot", "left_foot", 0.7, [3.2, 0.0, -0.3]),
];

/// Spheres of the trunk that are parts of their own.
const TRUNK: [&str; 2] = ["neck", "abdomen"];

/// A row of spheres along a segment from its joint to `end`, instead of the report's sphere of that name, if there is
/// one; names without sides. Radii are interpolated linearly between those of two spheres.
struct Row {
    part: &'static str,
    segment: &'static str,
    end: &'static str,
    radii: [&'static str; 2],
}

const ROWS: [Row; 4] = [
    row("upper_arm", "upper_arm", "elbow", ["shoulder", "elbow"]),
    row("forearm", "forearm", "hand", ["elbow", "hand"]),
    row("thigh", "thigh", "knee", ["thigh", "thigh"]),
    row("shin", "lower_leg", "foot", ["shin", "shin"]),
];

const SIDES: [&str; 2] = ["right", "left"];

/// Largest distance between spheres of a row, in mean radii: their envelope sags by 0.4 of one.
pub const APART: f64 = 1.6;
/// Length of a limb that a bar across it presses, in its radii: the forces at Δ − x²/2(r + ρ) of all places x along a limb of
/// radius r are that at Δ on a length of (4/3)√(2(r + ρ)Δ); 44 mm of a forearm, r = 40 mm, 10 mm deep in a rim, ρ = 15 mm.
const BAR_APART: f64 = 1.2;
/// The same for spheres that share their force: HIC and chest loads of belted drivers change by less than 5 % from here
/// to half of it.
pub const APART_EVENLY: f64 = 1.2;
/// Largest number of spheres of a row.
const MOST_IN_ROW: usize = 24;

/// Height of the neck's middle between the shoulder line and the crown, as a fraction.
const NECK: f64 = 0.32;

const fn beside(name: &'static str, of: &'static str, radius: f64, place: [f64; 3]) -> Beside {
    Beside { name, of, radius, place }
}

const fn row(part: &'static str, segment: &'static str, end: &'static str, radii: [&'static str; 2]) -> Row {
    Row { part, segment, end, radii }
}

/// All names that spheres or parts of a body with this tree may have without being named by a scenario.
pub fn names(tree: &Tree) -> Vec<String> {
    let standard = tree.sphere_names().into_iter().chain(BESIDE.iter().map(|b| b.name)).chain(TRUNK);
    let rows = SIDES.iter().flat_map(|side| ROWS.iter().map(move |row| format!("{side}_{}", row.part)));
    let in_row = |part: String| [part.clone()].into_iter().chain((1..=MOST_IN_ROW).map(move |i| format!("{part}_{i}")));
    standard.map(str::to_owned).chain(rows.flat_map(in_row)).collect()
}

/// Gapless spheres of a body with the report's spheres `report`; those of a row are at most `apart` mean radii apart.
pub fn full(body: &Body, report: Vec<ContactSphere>, apart: f64) -> Vec<ContactSphere> {
    let of = |name: &str| report.iter().find(|sphere| sphere.name == name);
    let beside = BESIDE.iter().filter_map(|b| Some(b.sphere(of(b.of)?)));
    let trunk = [of("head").map(|head| neck(body, head)), of("pelvis").and_then(|pelvis| abdomen(body, pelvis))];
    let rows = SIDES.iter().flat_map(|side| ROWS.iter().flat_map(move |r| in_row(body, side, r, apart, &of)));
    let is_replaced =
        |name: &str| ROWS.iter().any(|row| SIDES.iter().any(|side| name == format!("{side}_{}", row.part)));
    let kept = report.iter().filter(|sphere| !is_replaced(&sphere.name)).cloned();
    kept.chain(beside).chain(trunk.into_iter().flatten()).chain(rows).collect()
}

/// Spheres to the left and right of an abdomen, which make it as wide as a person; they move with the same plates as it.
pub fn sides_of_abdomen(abdomen: &ContactSphere) -> impl Iterator<Item = ContactSphere> {
    BESIDE.iter().filter(|b| b.of == "abdomen").map(|b| b.sphere(abdomen))
}

impl Beside {
    fn sphere(&self, of: &ContactSphere) -> ContactSphere {
        let centre_from_lower_end_m = of.centre_from_lower_end_m + Vector3::from(self.place) * of.radius_m;
        let radius_m = self.radius * of.radius_m;
        ContactSphere { name: self.name.to_owned(), centre_from_lower_end_m, radius_m, ..of.clone() }
    }
}

/// Sphere of the neck, on the neck segment if there is one, else on the head.
fn neck(body: &Body, head: &ContactSphere) -> ContactSphere {
    let height_m = |segment| body.segment(segment).length_m;
    let (segment, z_m) = match body.tree.segment_named("neck") {
        Some(neck) => (neck, 0.5 * height_m(neck)),
        None => {
            let above_m = body.tree.landmarks().chest.and_then(|chest| body.neck_above_m(chest)).unwrap_or(0.0);
            (head.segment, NECK * (above_m + height_m(head.segment)) - above_m)
        }
    };
    ContactSphere::new("neck", segment, [0.0, 0.0, z_m].into(), 0.62 * head.radius_m)
}

/// Sphere between chest and pelvis, if the body has a segment there.
fn abdomen(body: &Body, pelvis: &ContactSphere) -> Option<ContactSphere> {
    let marks = body.tree.landmarks();
    let is_between = |s: &Segment| body.tree.is_trunk(*s) && ![marks.chest, marks.pelvis].contains(&Some(*s));
    let middle = body.tree.segments().find(is_between)?;
    let centre_m = [0.0, 0.0, 0.5 * body.segment(middle).length_m].into();
    Some(ContactSphere::new("abdomen", middle, centre_m, 0.93 * pelvis.radius_m))
}

/// Spheres of a row, numbered from the trunk; none if the body lacks what positions them.
fn in_row<'s>(
    body: &Body,
    side: &str,
    row: &Row,
    apart: f64,
    of: &impl Fn(&str) -> Option<&'s ContactSphere>,
) -> Vec<ContactSphere> {
    let sided = |word: &str| format!("{side}_{word}");
    let [from, to] = row.radii.map(|word| of(&sided(word)));
    let (Some(segment), Some(from), Some(to)) = (body.tree.segment_named(&sided(row.segment)), from, to) else {
        return Vec::new();
    };
    let top = Vector3::new(0.0, 0.0, body.segment(segment).length_m);
    let end = of(&sided(row.end)).filter(|end| end.segment == segment);
    let down = end.map_or(Vector3::zeros(), |end| end.centre_from_lower_end_m.coords) - top;
    let long = down.norm() / (0.5 * (from.radius_m + to.radius_m));
    let gaps = (long / apart).ceil().clamp(1.0, MOST_IN_ROW as f64 + 1.0);
    // one that is farther from its neighbours than usual exerts what is missing between them
    let [alone, alone_on_bars] = [APART, BAR_APART].map(|usual| (long / gaps / usual).max(1.0));
    let sphere = |i: usize| {
        let along = i as f64 / gaps;
        let part = sided(row.part);
        let radius_m = from.radius_m + along * (to.radius_m - from.radius_m);
        let own = of(&part).map_or(1.0, |replaced| replaced.share);
        let (share, bar_share) = (alone * own, alone_on_bars * own);
        let name = format!("{part}_{i}");
        let plain = ContactSphere::new(name, segment, (top + down * along).into(), radius_m);
        ContactSphere { part, share, bar_share, ..plain }
    };
    (1..gaps as usize).map(sphere).collect()
}

/// Gives spheres of one segment that overlap a share each of what one of them alone would exert, so that forces depend on the area
/// of the body and not on the number of its spheres.
///
/// Two of radii r_k and r_l whose centres are d apart count for each other as o_kl = 1 − (d + |r_k − r_l|)/(1.6 min(r_k, r_l)), if that is
/// positive; the share of k is 1/Σ o_kl. A row has the same force however dense it is: n spheres in one place have 1/n each,
/// spheres 1.6 radii apart have all of theirs. On bars across limbs 1.2 radii take the place of 1.6, as a bar meets one or two of a row at a
/// time; other spheres have the same share there.
pub fn share_evenly(spheres: &mut [ContactSphere]) {
    let common = |one: &ContactSphere, other: &ContactSphere, apart: f64| {
        if one.segment != other.segment {
            return 0.0;
        }
        let apart_m = (one.centre_from_lower_end_m - other.centre_from_lower_end_m).norm();
        let other_size_m = (one.radius_m - other.radius_m).abs();
        (1.0 - (apart_m + other_size_m) / (apart * one.radius_m.min(other.radius_m))).max(0.0)
    };
    let crowd = |one: &ContactSphere, apart: f64| spheres.iter().map(|other| common(one, other, apart)).sum::<f64>();
    let crowds: Vec<[f64; 2]> =
        spheres.iter().map(|one| [APART, BAR_APART].map(|apart| crowd(one, apart).max(1.0))).collect();
    for (sphere, [crowd, on_bars]) in spheres.iter_mut().zip(crowds) {
        let crosses = is_of_limb(&sphere.part);
        sphere.bar_share = if crosses { sphere.bar_share / on_bars } else { sphere.share / crowd };
        sphere.share /= crowd;
    }
}

/// Whether a part of this name is a row along a limb.
fn is_of_limb(part: &str) -> bool {
    ROWS.iter().any(|row| {
        SIDES.iter().any(|side| part.strip_prefix(side).is_some_and(|rest| rest.strip_prefix('_') == Some(row.part)))
    })
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::body::people::{Division, Person, child};

    fn body() -> Body {
        let body = Body::male50();
        Body { spheres: full(&body, body.spheres.clone(), APART), ..body }
    }

    fn of_part<'b>(body: &'b Body, part: &str) -> Vec<&'b ContactSphere> {
        body.spheres.iter().filter(|sphere| sphere.part == part).collect()
    }

    #[test]
    fn a_man_has_as_many_spheres_along_his_limbs_as_specified() {
        let body = body();
        for (part, count) in [("upper_arm", 2), ("forearm", 4), ("thigh", 3), ("shin", 4), ("foot", 2)] {
            for side in SIDES {
                assert_eq!(of_part(&body, &format!("{side}_{part}")).len(), count, "{side} {part}");
            }
        }
        let threes = ["head", "chest", "pelvis"].map(|part| of_part(&body, part).len());
        assert_eq!((threes, body.spheres.len()), ([3; 3], 49));
        let known = names(body.tree);
        assert!(body.spheres.iter().all(|s| known.contains(&s.name) && known.contains(&s.part)));
    }

    /// From sphere to sphere along each limb no gap is wider than 1.6 mean radii, joints and ends included.
    #[test]
    fn limbs_have_no_holes() {
        for name in ["male50", "female05", "male95", "child06"] {
            let grown = Person::named(name).map(|person| person.body(Division::Twelve).0);
            let report = grown.or_else(|| child(name, Division::Twelve)).expect("a preset");
            let body = Body { spheres: full(&report, report.spheres.clone(), APART), ..report };
            let places = body.standing_m();
            for (part, ends) in
                [("upper_arm", ["shoulder", "elbow"]), ("forearm", ["elbow", "hand"]), ("shin", ["knee", "foot"])]
            {
                let row = of_part(&body, &format!("left_{part}"));
                let names = row.iter().map(|s| s.name.clone());
                let ends = ends.map(|end| format!("left_{end}"));
                let chain: Vec<usize> = [ends[0].clone()]
                    .into_iter()
                    .chain(names)
                    .chain([ends[1].clone()])
                    .flat_map(|n| body.sphere(&n))
                    .collect();
                for pair in chain.windows(2) {
                    let radii_m = 0.5 * (row[0].radius_m + row[row.len() - 1].radius_m);
                    let apart_m = (places[pair[0]] - places[pair[1]]).norm();
                    assert!(apart_m <= 1.6 * radii_m + 1e-12, "{name} {part}: {apart_m} of {radii_m}");
                }
            }
        }
    }

    fn shared(places: &[(f64, f64)]) -> Vec<f64> {
        let chest = body().tree.landmarks().chest.expect("a chest");
        let sphere = |(z_m, r_m): &(f64, f64)| ContactSphere::new("s", chest, [0.0, 0.0, *z_m].into(), *r_m);
        let mut spheres: Vec<_> = places.iter().map(sphere).collect();
        share_evenly(&mut spheres);
        spheres.iter().map(|sphere| sphere.share).collect()
    }

    /// Per length a row exerts the same, however dense it is: exactly at whole fractions of 1.6 radii, and almost between.
    #[test]
    fn a_row_exerts_the_same_however_dense_it_is() {
        for (apart, within) in [(1.6, 1e-12), (0.8, 1e-12), (0.4, 1e-12), (1.2, 0.12), (1.0, 0.09), (0.6, 0.04)] {
            let row: Vec<_> = (0..41).map(|i| (0.05 * apart * f64::from(i), 0.05)).collect();
            let per_length = shared(&row)[20] / apart;
            assert_relative_eq!(per_length * 1.6, 1.0, max_relative = within);
        }
        assert_eq!(shared(&[(0.0, 0.1); 5]), [0.2; 5]);
        assert_eq!(shared(&[(0.0, 0.1), (0.161, 0.1), (0.0, 0.02)]), [1.0; 3]);
    }

    /// Bars across a limb, at places evenly along it: the mean force is 0.92 of that of one sphere, whatever the spacing. The spacing of
    /// a row is up to 7 % off what was asked for, because a whole number of spheres fills a limb.
    #[test]
    fn a_bar_across_a_limb_meets_one_sphere_however_many_there_are() {
        let (r, rho, depth) = (0.04, 0.015, 0.01);
        for spacing in [0.6, 1.2, 2.4] {
            let body = Body::male50();
            let mut spheres = full(&body, body.spheres.clone(), spacing);
            share_evenly(&mut spheres);
            let row: Vec<_> = spheres.iter().filter(|sphere| sphere.part == "left_shin").collect();
            let place = |i: usize| row[i].centre_from_lower_end_m;
            let gap = (place(1) - place(0)).norm() / row[1].radius_m * r;
            let share = row[row.len() / 2].bar_share;
            let press = |x: f64| (depth - x * x / (2.0 * (r + rho))).max(0.0);
            let at = |along: f64| (-9..=9).map(|i| share * press(along - f64::from(i) * gap)).sum::<f64>();
            let mean = (0..1000).map(|i| at(gap * f64::from(i) / 1000.0)).sum::<f64>() / 1000.0;
            assert!((mean / depth - 0.92).abs() < 0.08, "{spacing}: {}", mean / depth);
        }
    }

    #[test]
    fn the_reports_spheres_exert_all_of_theirs() {
        let mut body = Body::male50();
        share_evenly(&mut body.spheres);
        assert!(body.spheres.iter().all(|sphere| sphere.share == 1.0));
    }

    #[test]
    fn left_and_right_are_mirrored() {
        let body = body();
        let places = body.standing_m();
        for (left, place) in body.spheres.iter().zip(&places) {
            let Some(name) = left.name.strip_prefix("left_") else { continue };
            let i = body.sphere(&format!("right_{name}")).expect("its mirror image");
            let right = &body.spheres[i];
            assert_relative_eq!(places[i], nalgebra::Point3::new(place.x, -place.y, place.z), epsilon = 1e-15);
            assert_eq!(left.radius_m, right.radius_m);
            assert_eq!(left.part.replace("left_", "right_"), right.part);
        }
    }
}
