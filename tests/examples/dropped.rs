//! Falls of a limp body in a cell from as many attitudes as the argument says: the long form of a proof.
#![expect(clippy::print_stdout, reason = "its answer")]

use occupant_tests::dropped::{Fall, fall};

fn main() {
    let count = std::env::args().nth(1).and_then(|count| count.parse().ok()).unwrap_or(200);
    let falls: Vec<Fall> = (0..count).map(fall).collect();
    for (seed, fall) in falls.iter().enumerate() {
        println!("{seed:4}  {fall:?}");
    }
    let most = |of: fn(&Fall) -> f64| falls.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    println!(
        "{count} falls: at most {:.4} m beyond a wall, energy balance {:.1e}, {:.1e} of the kinetic energy left",
        most(|f| f.beyond_m),
        most(|f| f.balance_error.abs()),
        most(|f| f.left)
    );
}
