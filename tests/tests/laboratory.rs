//! Measures against those that laboratories computed from their own tests: records of NHTSA's vehicle database.
//!
//! The curves are not part of this repository. They are looked for in the folder that `OCCUPANT_CRASH_TESTS` names, else in
//! `../shared/reference/tests`; where there is none, the tests say so and are left out.

use std::path::PathBuf;

use crash_measures::measure::{HicWindow, hic, largest_magnitude, minimum, three_ms_cumulative};
use crash_measures::signal::STANDARD_GRAVITY_MPS2;

/// Columns of a table of a test, by name, at the interval of its first column.
struct Curves {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Curves {
    /// The table of this name; none, with a word, where no curves are.
    #[expect(clippy::print_stderr, reason = "a test that is left out says so")]
    fn open(name: &str) -> Option<Curves> {
        let beside = || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../shared/reference/tests");
        let folder = std::env::var_os("OCCUPANT_CRASH_TESTS").map_or_else(beside, PathBuf::from);
        let Ok(text) = std::fs::read_to_string(folder.join(name)) else {
            eprintln!("left out: {name} is not there (OCCUPANT_CRASH_TESTS names the folder of crash tests)");
            return None;
        };
        let mut lines = text.lines();
        let names = lines.next()?.split(',').map(str::to_owned).collect();
        let rows = lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect()).collect();
        Some(Curves { names, rows })
    }

    fn column(&self, name: &str) -> Vec<f64> {
        let at = self.names.iter().position(|n| n.starts_with(name)).unwrap_or_else(|| panic!("no column {name}"));
        self.rows.iter().map(|row| row[at]).collect()
    }

    /// Magnitude of three columns in g, m/s².
    fn resultant(&self, names: [&str; 3]) -> Vec<f64> {
        let [x, y, z] = names.map(|name| self.column(name));
        let of = |((x, y), z): ((&f64, &f64), &f64)| STANDARD_GRAVITY_MPS2 * (x * x + y * y + z * z).sqrt();
        x.iter().zip(&y).zip(&z).map(of).collect()
    }

    fn interval_s(&self) -> f64 {
        let times = self.column("t_ms");
        1e-3 * (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64
    }
}

/// Value, t₁ and t₂ (ms) that a record prints, against ours: to all printed digits, the times to a sample.
fn same_hic(table: &str, occupant: &str, window: HicWindow, [value, from_ms, to_ms]: [f64; 3]) {
    let Some(curves) = Curves::open(table) else { return };
    let names = ["x", "y", "z"].map(|axis| format!("{occupant}_{axis}_g"));
    let resultant = curves.resultant(names.each_ref().map(String::as_str));
    let dt_s = curves.interval_s();
    let ours = hic(&resultant, dt_s, window).unwrap();
    assert_eq!(ours.value.round(), value, "{table} {occupant}");
    for (found, printed) in [(ours.start_s, from_ms), (ours.end_s, to_ms)] {
        assert!((1e3 * found - printed).abs() <= 1e3 * dt_s + 1e-9, "{table} {occupant}: {found} {printed}");
    }
}

#[test]
fn the_head_injury_criterion_is_the_laboratorys_own() {
    same_hic("nhtsa-7292/head-raw-driver.csv", "driver", HicWindow::Ms36, [1114.0, 84.72, 106.72]);
    same_hic("nhtsa-10146/head-raw.csv", "driver", HicWindow::Ms15, [140.0, 77.7, 92.7]);
    same_hic("nhtsa-10146/head-raw.csv", "front-passenger", HicWindow::Ms15, [335.0, 67.8, 82.8]);
}

/// Within half a per cent of what a record prints.
fn near(what: &str, ours: f64, printed: f64) {
    assert!((ours / printed - 1.0).abs() < 5e-3, "{what}: {ours} {printed}");
}

#[test]
fn peaks_of_femurs_and_belts_are_the_laboratorys_own() {
    for (table, left_n, right_n) in [
        ("nhtsa-7292/driver.csv", -1789.0, -5790.0),
        ("nhtsa-10146/driver.csv", -1923.0, -2345.0),
        ("nhtsa-10146/front-passenger.csv", -1182.0, -1378.0),
    ] {
        let Some(curves) = Curves::open(table) else { return };
        for (column, printed_n) in [("FMRL_ZL_LC_N", left_n), ("FMRR_ZL_LC_N", right_n)] {
            let ours = minimum(&curves.column(column), curves.interval_s()).unwrap();
            near(&format!("{table} {column}"), ours.value, printed_n);
        }
    }
    let Some(curves) = Curves::open("nhtsa-7292/driver.csv") else { return };
    for (column, printed_n) in [("LPBO", 6937.0), ("SHBT", 4845.0)] {
        let ours = largest_magnitude(&curves.column(column), curves.interval_s()).unwrap();
        near(column, ours.value.abs(), printed_n);
    }
}

#[test]
fn three_milliseconds_of_the_chest_are_the_laboratorys_own() {
    let chest = ["CHST_XL_AC_g", "CHST_YL_AC_g", "CHST_ZL_AC_g"];
    let ours_g = |table| {
        let curves = Curves::open(table)?;
        let held = three_ms_cumulative(&curves.resultant(chest), curves.interval_s()).unwrap();
        Some(held.level_mps2 / STANDARD_GRAVITY_MPS2)
    };
    let Some(driver_g) = ours_g("nhtsa-7292/driver.csv") else { return };
    near("nhtsa-7292 chest, g", driver_g, 59.3);
    // this record holds whole numbers of g
    for table in ["nhtsa-10146/driver.csv", "nhtsa-10146/front-passenger.csv"] {
        let Some(chest_g) = ours_g(table) else { return };
        assert_eq!(chest_g.round(), 41.0, "{table}: {chest_g}");
    }
}
