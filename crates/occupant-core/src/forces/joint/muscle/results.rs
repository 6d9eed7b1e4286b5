//! Muscles in results.

use occupant_units::unit::Unit::{NewtonMetre, One, Second};

use super::{MuscleAction, Muscles};
use crate::forces::shown::{Named, OneOf, Reported, Tracked, Tracker};
use crate::forces::table::Column;
use crate::motion::scalar::Scalar;
use crate::quantity::Quantity;

type Of = Quantity<OneOf<Muscles>>;

impl MuscleAction<f64> {
    /// Magnitude of the moment, N·m.
    fn moment_n_m(&self) -> f64 {
        self.moment.norm_squared().sqrt()
    }
}

impl Reported for Muscles {
    const MESSAGE: &'static str = "Muscle";

    const QUANTITIES: &'static [Of] = &[
        Of::number(NewtonMetre, |a| a.moment_n_m()).channel("moment", "moment of the {}").field(
            2,
            "moment",
            "magnitude of its moment",
        ),
        Of::number(One, |a| a.activation).channel("activation", "activation of the {}").field(
            3,
            "activation",
            "from 0 to 1",
        ),
    ];

    const PEAKS: &'static [Tracked] = &[Tracked {
        column: Column::number("peak_n_m", "moment, N·m", 1).measure("peak", NewtonMetre),
        time: Some(Column::time("peak_time_s").measure("peak_time", Second)),
        at_least_zero: true,
    }];

    #[inline(always)]
    fn track<S: Scalar>(a: &MuscleAction<S>, tracker: &mut impl Tracker<S>) {
        tracker.number(a.moment.norm_squared().sqrt());
    }

    fn named<'a>(data: Self::Data<'a>) -> Vec<Named<'a>> {
        data.muscles.iter().map(|muscle| Named { name: data.tree()[muscle.joint].name, sphere: None }).collect()
    }
}
