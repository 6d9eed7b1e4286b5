//! Interior dimensions by class of car (SAE J1100 codes).
//!
//! H30, W3, W20, L50 and H61 are those of S. Macey, G. Wardle: H-Point, The Fundamentals of Car Design & Packaging (Design Studio Press),
//! chapter 6, "approximate reference dimensions" of current production cars, which are rounded to 25 mm. A class here lies in the span of its
//! types there:
//!
//! | class | its types | H30 | W20 | W3 | L50 | H61 |
//! |---|---|---|---|---|---|---|
//! | small | micro, small | 250–275 | 300–350 | 1200–1350 | 750 | 975–1000 |
//! | sedan | medium, large, luxury | 250–275 | 350–400 | 1475–1550 | 850–975 | 975 |
//! | suv | small, medium, large | 300–350 | 375–425 | 1425–1650 | 825–875 | 1010–1025 |
//! | van | minivan, commercial | 350 | 425–525 | 1575–1675 | 850–900 | 1010 |
//! | pickup | small, large 4x4 | 300–350 | 375–475 | 1475–1700 | 625–950 | 1010–1025 |
//!
//! L6 of the sedan is that of the mid-size package of M. P. Reed, S. M. Ebert, J. J. Hallman: Effects of Driver Characteristics on Seat Belt Fit,
//! Stapp Car Crash J. 57 (2013): 550 mm with H30 = 270 mm. The driver's place is that of SAE J4004. L6 of the other classes, H17, A18, W9
//! and what is said of panel and bolster are estimates: no table was found. Knees of drivers were 200 mm from the bolster in the mean, in a
//! sedan, a crossover and a pickup (P. Atkinson et al., SAE 2009-01-0390).

use crate::sections::{CarClass, CarSection, DummyChoice, si_or};
use occupant_units::trig;

/// Stature for which the driver's seat is at its design position, m: the mean of women and men.
pub(super) const MEAN_STATURE_M: f64 = 1.69;
/// Rearward shift of a driver's seat per stature; SAE J4004.
const TRACK_PER_STATURE: f64 = 0.433;
/// Half the travel of a front seat, m; an estimate.
const HALF_TRAVEL_M: f64 = 0.12;

/// Usual distance of a front seat behind its design position, m. Dummies sit as in FMVSS 208: the 5th-percentile female all the way
/// forward (S16), others in the middle (S8.1.2). A person who drives sits as SAE J4004 says. Passengers' seats are not moved: they stood
/// rearward of the middle in 92 % of the frames of a study in traffic (M. P. Reed, S. M. Ebert, M. L. H. Jones: UMTRI-2020-2).
pub(super) fn usual_track_m(rider: &super::Rider) -> f64 {
    match rider.dummy {
        Some(DummyChoice::HybridIii5F) => -HALF_TRAVEL_M,
        None if rider.seat == "driver" => TRACK_PER_STATURE * (rider.stature_m - MEAN_STATURE_M),
        _ => 0.0,
    }
}

/// Lengths in m, angles in degrees.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measures {
    /// H30.
    pub(super) seat_height: f64,
    /// W20.
    pub(super) seat_offset: f64,
    /// L50.
    pub(super) couple: f64,
    /// W3.
    pub(super) shoulder_room: f64,
    /// Roof over the front H-point.
    pub(super) roof: f64,
    /// Distance of the driver's heels forward of the design H-point.
    pub(super) heels: f64,
    /// The same of heels whose soles lie flat on the floor, with their balls where the pedals are.
    pub(super) flat_heels: f64,
    /// Wheel centre forward of and above the design H-point.
    pub(super) wheel: [f64; 2],
    /// A18.
    pub(super) wheel_angle_deg: f64,
    /// W9.
    pub(super) wheel_diameter: f64,
    /// Panel face forward of the H-point, panel top above it.
    pub(super) panel: [f64; 2],
    /// Knee bolster face forward of the H-point.
    pub(super) bolster: f64,
}

/// H30, L6, H17, A18, W9, W20, W3, L50, H61.
fn dimensions(class: CarClass) -> [f64; 9] {
    match class {
        CarClass::Small => [0.255, 0.55, 0.635, 24.0, 0.37, 0.335, 1.35, 0.75, 0.975],
        CarClass::Sedan | CarClass::Sled => [0.25, 0.55, 0.64, 24.0, 0.38, 0.36, 1.48, 0.85, 0.975],
        CarClass::Suv => [0.32, 0.50, 0.70, 28.0, 0.38, 0.40, 1.50, 0.85, 1.015],
        CarClass::Van => [0.35, 0.47, 0.74, 33.0, 0.385, 0.43, 1.60, 0.90, 1.010],
        CarClass::Pickup => [0.33, 0.49, 0.72, 28.0, 0.385, 0.42, 1.65, 0.93, 1.015],
    }
}

/// Added to the distance from H-point to roof, along a line 8° behind the vertical, for effective head room, m; SAE
/// J1100.
pub(super) const H61_ADDS_M: f64 = 0.102;
pub(super) const H61_LEANS_RAD: f64 = 8.0 * std::f64::consts::PI / 180.0;

/// From the heel of a shoe to its ball, along its sole, m; SAE J826.
const HEEL_TO_BALL_M: f64 = 0.203;
/// The heels of a body are in line with its shanks, those of shoes behind them: so much nearer, the ankles are as far from the hips, m;
/// ours.
const HEEL_BEHIND_SHANK_M: f64 = 0.027;
/// From the wheel's centre to the face of the panel, m; ours.
const WHEEL_TO_PANEL_M: f64 = 0.29;
/// From the face of the bolster to that of the panel above it, m; ours.
const BOLSTER_BEFORE_PANEL_M: f64 = 0.06;

impl Measures {
    /// Measures of a class, changed by the scenario's values.
    pub(super) fn of(car: &CarSection) -> Measures {
        let [h30, l6, h17, a18, w9, w20, w3, l50, h61] = dimensions(car.class.unwrap_or_default());
        let (_, upright) = trig::sin_cos(H61_LEANS_RAD);
        let seat_height = si_or(&car.seat_height, h30);
        // ball of the foot ahead of the mean driver's H-point
        let ball = 0.718 - 0.24 * seat_height + 0.41 * l6;
        let ahead = si_or(&car.wheel.ahead, ball - l6);
        let panel = si_or(&car.panel.ahead, ball - l6 + WHEEL_TO_PANEL_M);
        Measures {
            seat_height,
            seat_offset: si_or(&car.seat_offset, w20),
            couple: si_or(&car.couple, l50),
            shoulder_room: si_or(&car.shoulder_room, w3),
            roof: si_or(&car.roof, (h61 - H61_ADDS_M) * upright),
            heels: ball - HEEL_TO_BALL_M * trig::sin_cos(pedal_rad(seat_height)).1 - HEEL_BEHIND_SHANK_M,
            flat_heels: ball - HEEL_TO_BALL_M,
            wheel: [ahead, si_or(&car.wheel.above, h17 - h30)],
            wheel_angle_deg: car.wheel.angle.as_ref().map_or(a18, |angle| angle.si().to_degrees()),
            wheel_diameter: si_or(&car.wheel.diameter, w9),
            panel: [panel, si_or(&car.panel.above, 0.40)],
            bolster: si_or(&car.panel.bolster, panel - BOLSTER_BEFORE_PANEL_M),
        }
    }
}

/// Angle of the sole on an undepressed pedal against the floor, A47, by H30; SAE J1516, rad.
fn pedal_rad(seat_height_m: f64) -> f64 {
    let cm = 100.0 * seat_height_m;
    (78.96 - 0.15 * cm - 0.0173 * cm * cm).max(0.0).to_radians()
}
