//! Full sets of spheres, parts of the body, and the body against itself.

use super::*;
use crate::Draft;

fn with(changes: &[&str]) -> Result<Setup, String> {
    let mut draft = Draft::read(SHORT, Format::Toml, "test").unwrap();
    changes.iter().try_for_each(|change| draft.set(change)).map_err(|problems| problems.to_string())?;
    let built = draft.load(&no_files).and_then(|loaded| loaded.build());
    built.map(|(setup, _)| setup).map_err(|problems| problems.to_string())
}

const FULL: &str = "body.sphere_set=full";
const OWN: &str = "self_contact={ skin = \"foam\" }";
const POST: &str =
    "solids.post={ kind = \"capsule\", material = \"foam\", ends = [[2, 0, 0], [2, 0, 1]], radius = 0.05 }";

#[test]
fn a_full_set_is_changed_sphere_by_sphere() {
    let setup = with(&[
        FULL,
        "body.spheres.face.radius=\"50 mm\"",
        "body.spheres.left_thigh.share=0.25",
        "body.spheres.chin={ remove = true }",
        "body.spheres.nose={ segment = \"head\", centre = [0.1, 0, 0.1], radius = 0.02, part = \"head\" }",
    ])
    .unwrap();
    let body = &setup.body;
    let of = |name: &str| body.sphere(name).map(|i| &body.spheres[i]);
    assert_eq!((of("face").map(|s| s.radius_m), of("chin")), (Some(0.05), None));
    assert_eq!(body.spheres_called("head").len(), 3, "head, face and nose");
    assert!(body.spheres_called("left_thigh").iter().all(|i| body.spheres[*i].share == 0.25));
    assert_eq!(of("right_thigh_1").map(|s| s.share), Some(1.0));
    assert!(of("left_thigh").is_none());
}

#[test]
fn a_list_of_spheres_takes_whole_parts_and_a_belt_one_sphere() {
    let setup = with(&[FULL, POST, "solids.post.spheres=[\"head\", \"left_shin_2\"]"]).unwrap();
    assert_eq!(setup.solids[0].spheres.as_ref().map(Vec::len), Some(4));
    let report = with(&[POST, "solids.post.spheres=[\"left_shin_2\"]"]).unwrap_err();
    assert!(report.contains("no sphere is named \"left_shin_2\"") && report.contains("left_shin"), "{report}");
    let belt = "belts.leg={ sphere = \"left_thigh\", anchors = [[0, 1, 0], [0, -1, 0]], k1 = 1e5 }";
    let refused = with(&[FULL, belt]).unwrap_err();
    assert!(refused.contains("no sphere is named \"left_thigh\""), "{refused}");
}

#[test]
fn the_body_meets_itself_only_where_a_scenario_says_so() {
    assert_eq!(with(&[FULL]).unwrap().self_contact, None);
    let own = with(&[OWN, "self_contact.pairs=[[\"left_hand\", \"chest\"], [\"chest\", \"left_hand\"]]"]).unwrap();
    assert_eq!(own.self_contact.map(|own| own.pairs.len()), Some(1));
    for (change, expected) in [
        ("self_contact.skin=fur", "no material is named \"fur\""),
        ("self_contact.skins={ haed = \"foam\" }", "no sphere is named \"haed\""),
        ("self_contact.pairs=[[\"left_hand\", \"cheast\"]]", "did you mean \"chest\"?"),
        ("self_contact.pairs=[[\"chest\", \"head\"]]", "share a joint"),
        ("self_contact.pairs=[[\"left_shoulder\", \"chest\"]]", "parts that can be apart and then touch"),
    ] {
        let found = with(&[OWN, change]).unwrap_err();
        assert!(found.contains(expected), "{change}: {found}");
    }
    let soft = with(&[OWN, "materials.foam={ k1 = 8400, delta_b = 0.01, k2 = 0, mu1 = 0.5, friction = 0.3 }"]).unwrap();
    let refused = Model::new(soft).err().unwrap().to_string();
    assert!(refused.contains("the skin foam has no stiffness"), "{refused}");
}

#[test]
fn concave_groups_of_solids_are_told() {
    let step = |name: &str, height: f64| {
        let z = -0.5 * height;
        format!(
            "solids.{name}={{ kind = \"box\", material = \"foam\", group = \"step\", centre = [{}, 0, {z}], lengths = [0.4, 1, {height}] }}",
            3.0 + height
        )
    };
    let warnings = |steps: [&str; 2]| {
        let model = Model::new(with(&steps).unwrap()).unwrap();
        model.warnings().to_string()
    };
    let stairs = warnings([&step("low", 0.2), &step("high", 0.5)]);
    assert!(stairs.contains("concave corner"), "{stairs}");
    let level = warnings([&step("one", 0.2), &step("other", 0.2).replace("3.2", "3.5")]);
    assert!(!level.contains("concave"), "{level}");
}
