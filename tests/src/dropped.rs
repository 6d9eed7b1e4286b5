//! A limp body that falls in a closed room of solids, in any attitude.

use nalgebra::UnitQuaternion;
use occupant_core::model::Model;
use occupant_core::model::seating::InitialPosture;
use occupant_core::motion::report_coordinates::{DOF, EULER_START, ReportCoordinates};
use occupant_core::motion::state::Quat;
use occupant_core::motion::vector::V3;
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;

use crate::random::Random;
use crate::room::setup;

const CELL: &str = include_str!("../data/cell.toml");
/// Half the inner width of the cell, and how thick its walls are, m.
const HALF_M: f64 = 1.3;
const WALL_M: f64 = 0.3;

/// How a fall went.
#[derive(Clone, Copy, Debug)]
pub struct Fall {
    /// How far a sphere's centre was beyond the far side of a wall at most, m; negative: none ever was.
    pub beyond_m: f64,
    /// Energy balance over the greatest kinetic energy.
    pub balance_error: f64,
    /// Kinetic energy in the end over the greatest.
    pub left: f64,
}

/// Lets a body of full spheres that can touch itself fall from an attitude of `seed`, and looks at it for `end_s`.
pub fn fall(seed: u64, end_s: f64) -> Fall {
    let mut random = Random::new(seed);
    let whole = random.turn();
    let mut state = ReportCoordinates { q: [0.0; DOF], rates: [0.0; DOF] }.to_state();
    state.set_t1(V3::of(&random.vector(0.05)));
    state.set_velocity(V3::of(&random.vector(2.0)));
    let spin = V3::of(&random.vector(1.0));
    for slot in 0..EULER_START.len() {
        let bent = whole * UnitQuaternion::from_scaled_axis(random.vector(0.25));
        state.set_orientation(slot, Quat { w: bent.w, v: V3::of(&bent.imag()) });
        state.set_omega(slot, spin);
    }
    for (limb, angle) in state.hinge_mut().iter_mut().enumerate() {
        let bend = random.between(0.2, 1.2);
        *angle = if limb < 2 { -bend } else { bend };
    }
    let mut setup = setup(CELL, &[&format!("time.end={end_s}")]);
    setup.posture = InitialPosture::Coordinates(Box::new(ReportCoordinates::from_state(&state).unwrap()));
    let model = Model::new(setup).unwrap();
    let (mut beyond_m, mut kinetic_j, mut most_j) = (f64::NEG_INFINITY, 0.0, 0.0_f64);
    let look = |s: &Sample<'_>| {
        let centres = (0..s.model.body().spheres.len()).map(|i| s.sphere_centre_m(i).coords.amax());
        beyond_m = centres.fold(beyond_m, f64::max);
        kinetic_j = s.energy.kinetic_j;
        most_j = most_j.max(kinetic_j);
    };
    let outcome = simulate(&model, Watch(look)).unwrap();
    assert_eq!(outcome.status, Status::Completed);
    Fall { beyond_m: beyond_m - HALF_M - WALL_M, balance_error: outcome.energy.balance_error, left: kinetic_j / most_j }
}
