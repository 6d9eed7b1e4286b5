//! The cart scenarios of the repository read as they should.

use approx::assert_relative_eq;

use super::super::{Draft, Loaded};
use super::no_files;
use occupant_core::body::tti12;
use occupant_core::model::setup::Integrator;

fn cart(name: &str) -> Loaded {
    read(&format!("{}/scenarios/{name}", env!("CARGO_MANIFEST_DIR")), name)
}

fn read(path: &str, name: &str) -> Loaded {
    let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let draft = Draft::read_bytes(&bytes, None, name).unwrap_or_else(|e| panic!("{e}"));
    draft.load(&no_files).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn each_gives_a_model_without_a_warning_but_of_the_lap_belts_steepness() {
    for (name, belts) in
        [("cart-lap-torso.toml", vec!["lap", "torso"]), ("cart-lap.toml", vec!["lap"]), ("cart-unbelted.toml", vec![])]
    {
        let (model, warnings) = cart(name).model().unwrap_or_else(|e| panic!("{e}"));
        // the fitted lap belt goes straight down from the pelvis, steeper than in a car
        let else_said = warnings.iter().any(|warning| warning.problem.path != "belts.lap.anchors");
        assert!(!else_said, "{name}: {warnings}");
        let names: Vec<&str> = model.setup().belts.iter().map(|b| b.name.as_str()).collect();
        assert_eq!(names, belts);
        assert_eq!(model.setup().surfaces.len(), 11);
    }
}

#[test]
fn numbers_arrive_in_si() {
    let place = concat!(env!("CARGO_MANIFEST_DIR"), "/testdata/carts/cart-lap-torso.toml");
    let (setup, _) = read(place, "cart-lap-torso.toml").build().unwrap();
    // 173.55 lb over 386.04 in/s².
    let lbf_s2_per_in = 4.4482216152605 / 0.0254;
    assert_relative_eq!(setup.body.mass_kg(), 173.55 / 386.04 * lbf_s2_per_in, max_relative = 1e-14);
    assert_eq!(setup.body.spheres.len(), 17);
    assert_relative_eq!(setup.gravity_m_s2, 386.04 * 0.0254, max_relative = 1e-15);
    assert_relative_eq!(
        setup.materials[0].force.bilinear().unwrap().k1_n_per_m,
        48.0 * lbf_s2_per_in,
        max_relative = 1e-15
    );
    assert_relative_eq!(
        setup.joints[tti12::NECK].ball().unwrap().damping_n_m_s,
        20.0 * 4.4482216152605 * 0.0254,
        max_relative = 1e-15
    );
    assert_relative_eq!(
        setup.joints[tti12::LEFT_HIP].ball().unwrap().damping_n_m_s,
        6.0 * 4.4482216152605 * 0.0254,
        max_relative = 1e-15
    );
    let knee = setup.joints[tti12::RIGHT_KNEE].hinge().unwrap().lower_stop.unwrap();
    assert_relative_eq!(knee.begin_rad, 5f64.to_radians(), max_relative = 1e-15);
    assert_eq!(knee.full_rad, 0.0);
    assert_eq!(setup.integrator, Integrator::Rk4 { step_s: 1e-4 });
    let torso = &setup.belts[1];
    assert_eq!(setup.body.spheres[torso.sphere].name, "chest");
    assert_relative_eq!(torso.anchors_m[0].z, -20.0 * 0.0254, max_relative = 1e-15);
    // Belts without fractions load and unload along one curve, as in the report.
    assert_eq!((torso.webbing.returned_1, torso.webbing.returned_2), (1.0, 1.0));
}
