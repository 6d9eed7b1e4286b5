//! Columns among the frames of a scenario, and what is mounted on them.

use super::belts::changed;
use occupant_core::forces::contact::surface::Frame;

const DRIVER: &str = include_str!("../../testdata/hand/column-driver.toml");

#[test]
fn numbers_of_columns_come_to_their_data() {
    let (model, said) = changed(DRIVER, &["frames.column.unload_slope=\"5 kN/mm\""]).unwrap();
    assert!(said.is_empty(), "{said}");
    let column = &model.setup().columns[0];
    assert_eq!((column.frame, column.mass_kg, column.unload_n_per_m), (1, 3.0, Some(5e6)));
    assert_eq!(column.force.points, [[0.0, 0.0], [1e-3, 3e3], [3e-3, 2.5e3], [0.1, 2.5e3], [0.11, 12e3]]);
    assert_eq!(model.setup().bags[0].frame, Frame::Other(1));
    let listed = ["frames.column.stroke=null", "frames.column.force=null", "frames.column.library=\"column_1969\""];
    let (model, _) = changed(DRIVER, &listed).unwrap();
    let points = &model.setup().columns[0].force.points;
    assert_eq!((points[1], points[2]), ([5e-3, 1800.0 * 4.448_221_615_260_5], [0.15, 1800.0 * 4.448_221_615_260_5]));
}

#[test]
fn what_is_wrong_with_columns_is_said_at_its_place() {
    let more = |name: &str| {
        format!(
            "frames.{name}={{ kind = \"column\", axis = [1, 0, 0], mass = 3, stroke = [0, 0.1], force = [0, 900] }}"
        )
    };
    let [two, three, four, five] = ["two", "three", "four", "five"].map(more);
    let hangs = "frames.hangs={ parent = \"column\", path = { kind = \"fixed\" } }";
    let line = "path={ kind = \"table\", interpolation = \"linear\", columns = [\"t[s]\", \"x[m]\"], rows = [[0, 0], [0.05, 0.6], [0.2, 0.9]] }";
    for (changes, expected) in [
        (&["frames.column.axis=[0, 0, 0]"][..], "the way that it gives"),
        (&["frames.column.axis=null"], "`frames.column` has no key `axis`"),
        (&["frames.column.mass=null"], "`frames.column` has no key `mass`"),
        (&["frames.column.mass=0"], "frames.column.mass"),
        (&["frames.column.stroke=[0, 0.1]"], "the same number in both"),
        (&["frames.column.stroke[2]=0.0005"], "deformations that rise"),
        (&["frames.column.force=[0, 0, 0, 0, 0]"], "a force that never rises"),
        (&["frames.column.unload_slope=\"1 kN/mm\""], "no less than the largest slope of the force"),
        (&["frames.column.path={ kind = \"fixed\" }"], "a column, which moves where it is pushed"),
        (&["frames.column.kind=\"panel\""], "`axis` in a panel"),
        (&["frames.column.kind=\"colum\""], "did you mean \"column\"?"),
        (&["frames.column.parent=\"space\"", "bags.driver=null"], "no vehicle and no panel"),
        (&[hangs], "a frame carried by a column"),
        (&[&two, &three, &four, &five], "5 columns"),
        (&["bags.driver.frame=\"ground\""], "does not move with the first vehicle"),
        (&["bags.driver.frame=\"colunm\""], "did you mean \"column\"?"),
        (&[line, "bags.driver=null", "belts=null", "retractors=null", "triggers=null"], "without acceleration"),
    ] {
        let said = match changed(DRIVER, changes) {
            Ok((_, said)) => said,
            Err(said) => said,
        };
        assert!(said.contains(expected), "{changes:?}: {said}");
    }
}

#[test]
fn a_column_may_hang_on_a_panel() {
    let panel = "frames={ panel = { path = { kind = \"table\", interpolation = \"spline\", columns = [\"t[ms]\", \"x[mm]\"], rows = [[0, 0], [50, -40], [200, -60]] } }, \
                 column = { kind = \"column\", parent = \"panel\", axis = [1, 0, 0], mass = 3, stroke = [0, 0.1], force = [0, 900] } }";
    let (model, said) = changed(DRIVER, &[panel]).unwrap();
    assert!(said.is_empty() && model.setup().columns[0].frame == 2, "{said}");
}
