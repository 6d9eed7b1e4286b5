//! Default equipment of a car by model years: belts, bags, head restraints, knee bolster. Every number has a key.
//!
//! Sources, all of the United States; Europe followed within some years (UN R16, R17, R94):
//! - front air bags: FMVSS 208, all cars from model year 1998, light trucks from 1999; none was usual before about 1990;
//! - limiters and pretensioners: from the mid-1990s on; 84 % and 63 % of new vehicles in model year 2002 (DOT HS 809 562), all by
//!   2008 (DOT HS 811 835);
//! - head restraints: FMVSS 202 (1969) 700 mm, FMVSS 202a (model year 2009 and 2010) 800 mm and a backset of at most 55 mm; a car of 2005 rated
//!   by IIHS has 85 mm; 100 mm before is an estimate;
//! - columns that give way and laminated windscreens are older than all of this (FMVSS 203, 204, 205; 1966 to 1968);
//! - knee bolsters: came with the rules for occupants without belts of 1987; twice the stiffness before is an estimate.

use crate::sections::{CarSeatSection, CarYears, Force, Length};

/// Lengths in m, forces in N, moments in N·m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Years {
    /// Front air bags.
    pub(super) bags: bool,
    limiter: Option<f64>,
    /// Of the front seats.
    pretensioner: f64,
    head_height: f64,
    head_gap: f64,
    /// Stiffness of the knee bolster; none: that of the material.
    pub(super) bolster_n_m: Option<f64>,
}

impl Years {
    pub(super) fn of(years: CarYears) -> Years {
        let present = Years {
            bags: true,
            limiter: Some(3000.0),
            pretensioner: 0.1,
            head_height: 0.80,
            head_gap: 0.05,
            bolster_n_m: None,
        };
        let without_limiter = Years { limiter: None, pretensioner: 0.0, head_height: 0.70, head_gap: 0.1, ..present };
        match years {
            CarYears::Present => present,
            CarYears::TwoThousands => Years { head_gap: 0.085, ..present },
            CarYears::Nineties => without_limiter,
            CarYears::Seventies => Years { bags: false, bolster_n_m: Some(80e3), ..without_limiter },
        }
    }

    /// A seat of a row with defaults for missing keys.
    pub(super) fn fill(&self, own: CarSeatSection, row: usize) -> CarSeatSection {
        let in_front = |number: f64| if row == 0 { number } else { 0.0 };
        CarSeatSection {
            limiter: own.limiter.or(self.limiter.map(Force::of_si)),
            pretensioner: own.pretensioner.or_else(|| Some(Length::of_si(in_front(self.pretensioner)))),
            head_height: own.head_height.or_else(|| Some(Length::of_si(self.head_height))),
            head_gap: own.head_gap.or_else(|| Some(Length::of_si(self.head_gap))),
            ..own
        }
    }
}
