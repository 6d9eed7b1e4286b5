//! Default equipment of a car by model years: belts, bags, head restraints, knee bolster. Every number has a key.
//!
//! Sources, all of the United States; Europe followed within some years (UN R16, R17, R94):
//! - front air bags: FMVSS 208, all cars from model year 1998, light trucks from 1999; none was usual before about 1990;
//! - limiters and pretensioners: from the mid-1990s on; 84 % and 63 % of new vehicles in model year 2002 (DOT HS 809 562), all by
//!   2008 (DOT HS 811 835);
//! - head restraints: FMVSS 202 (1969) 700 mm, FMVSS 202a (model year 2009 and 2010) 800 mm and a backset of at most 55 mm; a car of 2005 rated
//!   by IIHS has 85 mm; 100 mm before is an estimate;
//! - columns that give way and laminated windscreens are older than all of this (FMVSS 203, 204, 205; 1966 to 1968);
//! - backs of seats: the greatest moments of 300 tests with a body block (D. C. Viano, S. D. White: Traffic Inj. Prev. 17, 2016): 918 ±
//!   224 N·m (1960s) and 1069 ± 293 N·m (1980s) with one recliner; in the 2000s 1501 ± 335 N·m with one, 2302 ± 699 N·m with two;
//!   4395 ± 1185 N·m where all belts are on the seat. FMVSS 207 asks for 373 N·m. A back yields at 1/1.17 of its greatest moment; 1.3 kN·m
//!   of the 1990s lies between the means and is an estimate. None is given to cars of the present, whose backs are fixed unless they are said;
//! - knee bolsters: came with the rules for occupants without belts of 1987; twice the stiffness before is an estimate.

use crate::sections::{CarBelt, CarSeatSection, CarYears, Force, Length, Moment};

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
    /// Moment at which the back of a front seat yields; none: it does not.
    back_moment: Option<f64>,
}

/// Greatest moment of a back over that at which it begins to yield; ours.
pub(super) const HARDENS: f64 = 1.17;
/// Greatest moment of a back that bears all belts, N·m.
const WITH_BELTS_N_M: f64 = 4395.0;

impl Years {
    pub(super) fn of(years: CarYears) -> Years {
        let present = Years {
            bags: true,
            limiter: Some(3000.0),
            pretensioner: 0.1,
            head_height: 0.80,
            head_gap: 0.05,
            bolster_n_m: None,
            back_moment: None,
        };
        let back = |greatest: f64| Some((greatest / HARDENS / 50.0).round() * 50.0);
        let without_limiter = Years { limiter: None, pretensioner: 0.0, head_height: 0.70, head_gap: 0.1, ..present };
        match years {
            CarYears::Present => present,
            CarYears::TwoThousands => Years { head_gap: 0.085, back_moment: back(2000.0), ..present },
            CarYears::Nineties => Years { back_moment: back(1300.0), ..without_limiter },
            CarYears::Seventies => {
                Years { bags: false, bolster_n_m: Some(80e3), back_moment: back(1000.0), ..without_limiter }
            }
        }
    }

    /// A seat of a row with what it does not say itself; whether its back `yields` where nothing is said.
    pub(super) fn fill(&self, own: CarSeatSection, row: usize, yields: bool) -> CarSeatSection {
        let in_front = |number: f64| if row == 0 { number } else { 0.0 };
        let usual_moment = match own.belt {
            Some(CarBelt::Seat) => Some((WITH_BELTS_N_M / HARDENS / 50.0).round() * 50.0),
            _ => self.back_moment.filter(|_| yields && row == 0),
        };
        CarSeatSection {
            back_moment: own.back_moment.clone().or(usual_moment.map(Moment::of_si)),
            limiter: own.limiter.or(self.limiter.map(Force::of_si)),
            pretensioner: own.pretensioner.or_else(|| Some(Length::of_si(in_front(self.pretensioner)))),
            head_height: own.head_height.or_else(|| Some(Length::of_si(self.head_height))),
            head_gap: own.head_gap.or_else(|| Some(Length::of_si(self.head_gap))),
            ..own
        }
    }
}
