//! Falls of a limp body in a cell from as many attitudes as the argument says: the long form of a proof. What still moves after
//! 2 s is looked at for longer.
#![expect(clippy::print_stdout, reason = "its answer")]

use occupant_tests::dropped::{Fall, fall};

/// Less than this part of the greatest kinetic energy is rest.
const REST: f64 = 1e-3;

fn main() {
    let count = std::env::args().nth(1).and_then(|count| count.parse().ok()).unwrap_or(200);
    let falls: Vec<Fall> = (0..count).map(|seed| fall(seed, 2.0)).collect();
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
    for (seed, _) in (0..count).zip(&falls).filter(|(_, fall)| fall.left > REST) {
        println!("{seed:4}  after 5 s: {:?}", fall(seed, 5.0));
    }
}
