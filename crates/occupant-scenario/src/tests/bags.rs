//! Bags and gases of a scenario.

use super::belts::changed;
use occupant_core::forces::bag::{Gas, Leakage, Shape};
use occupant_core::forces::chain::NEVER;

const DRIVER: &str = include_str!("../../testdata/hand/airbag-driver.toml");

#[test]
fn numbers_of_bags_come_to_their_data() {
    let changes = [
        "bags.driver.vents[0].trigger=\"crash\"",
        "bags.driver.vents[0].delay=\"30 ms\"",
        "bags.driver.inflators[0].gas={ generator = 0.99, helium = 0.01 }",
        "bags.driver.inflators[0].delay=\"20 ms\"",
        "bags.driver.ambient={ pressure = \"95 kPa\" }",
    ];
    let (model, said) = changed(DRIVER, &changes).unwrap();
    assert!(said.is_empty(), "{said}");
    let bag = &model.setup().bags[0];
    let Shape::Dome { depth_m, edge_m, .. } = bag.shape else { panic!("{:?}", bag.shape) };
    assert_eq!((depth_m, edge_m, bag.volume_m3, bag.deploy_s), (0.3, 0.08, 0.08, 0.025));
    // the trigger's time, then delays of their own
    let fired = bag.fires_s - 9e-3;
    assert!(
        (bag.vents[0].due_s - fired - 30e-3).abs() < 1e-12 && (bag.inflators[0].due_s - fired - 20e-3).abs() < 1e-12
    );
    assert_eq!((bag.vents[0].area_m2, bag.vents[0].opens_at_pa), (3e-3, 20e3));
    assert_eq!((bag.ambient, bag.leakage.clone()), ([95e3, 293.15], Leakage::Fraction(0.001)));
    let helium = Gas::named("helium").unwrap();
    let r = 0.99 * 8.314_462_618_153_24 / 0.033 + 0.01 * helium.r_j_kg_k;
    assert!((bag.inflators[0].gas.r_j_kg_k - r).abs() < 1e-9);
    let body = model.body();
    let chest = body.sphere("chest").unwrap();
    assert!(bag.spheres.contains(&(chest, 1.6)) && bag.spheres.contains(&(body.sphere("head").unwrap(), 1.0)));
    // a vent that nothing opens is open, one with a trigger alone is not
    let open = changed(DRIVER, &["bags.driver.vents=[{ area = 1e-3, discharge = 0.7 }]"]).unwrap().0;
    assert_eq!((open.setup().bags[0].vents[0].opens_at_pa, open.setup().bags[0].vents[0].due_s), (0.0, NEVER));
}

#[test]
fn what_is_wrong_with_bags_is_said_at_its_place() {
    let ball = "bags.driver.sphere={ centre = [0.2, -0.35, -0.45], radius = 0.26 }";
    for (changes, expected) in [
        (&["bags.driver.trigger=\"crush\""][..], "did you mean \"crash\"?"),
        (
            &["bags.driver.trigger=\"b\"", "triggers.b={ kind = \"belt_tension\", threshold = 100 }"],
            "a trigger on a belt",
        ),
        (&[ball], "`dome`"),
        (&["bags.driver.dome=null"], "capsule"),
        (&["bags.driver.dome=null", ball, "bags.driver.volume=\"30 l\""], "within 30 %"),
        (&["bags.driver.dome.face_radius=0.3"], "a flatter face"),
        (&["bags.driver.dome.edge=0.31"], "an edge of at most its depth and radius"),
        (&["bags.driver.inflators[0].gas={ generatr = 1 }"], "did you mean \"generator\"?"),
        (&["bags.driver.inflators[0].gas={ helium = 0.9 }"], "fractions with the sum 1"),
        (&["bags.driver.inflators[0].flow=[0, 1, 0]"], "the same number of each"),
        (&["bags.driver.inflators[0].times=[0, 0.02, 0.004, 0.045]"], "times that rise"),
        (&["bags.driver.inflators[0].temperature[1]=1900"], "hotter than 1500 K"),
        (&["bags.driver.inflators[0].flow=[0, 0.2, 0.1, 0]"], "gas for 0.8 to 3 times the volume"),
        (&["bags.driver.inflators[0].tank={ volume = \"60 l\", pressure = \"10 kPa\" }"], "in the tank, not 10.0"),
        (&["bags.driver.vents[0].discharge=1.4"], "no hole passes more than its area"),
        (
            &["bags.driver.leakage=null", "bags.driver.permeability={ pressure = [0, 1e4], speed = [0.1, 1] }"],
            "from pressure 0",
        ),
        (&["bags.driver.spheres=[]", "bags.driver.reach=null"], "1 to 20 spheres"),
        (&["bags.driver.reach={ pelvis = 2 }"], "which is not one of its spheres"),
        (&["bags.driver.reach={ chest = 9 }"], "less wide than the bag"),
        (&["bags.driver.ambient={ temperature = \"20 deg\" }"], "a temperature above absolute zero"),
        (&["bags.driver.mount=[0, -0.35, -0.5]"], "within the full bag at the start"),
    ] {
        let said = match changed(DRIVER, changes) {
            Ok((_, warnings)) => warnings,
            Err(said) => said,
        };
        assert!(said.contains(expected) && said.contains("bags.driver"), "{changes:?}: {said}");
    }
    let one = DRIVER.split("[bags.driver]").nth(1).unwrap().split("[seats.driver]").next().unwrap();
    let more: String =
        (0..16).map(|i| format!("[bags.b{i}]{}", one.replace("bags.driver", &format!("bags.b{i}")))).collect();
    let crowd = DRIVER.replace("[seats.driver]", &format!("{more}\n[seats.driver]"));
    assert!(changed(&crowd, &[]).unwrap_err().contains("at most 80"));
}
