//! The iliac wings of a pelvis: where webbing lies on them, and how it slides up.
//!
//! The front edge of a wing, between the upper and the lower anterior iliac spine, is that of the pelvis of S. L. Delp et al., IEEE Trans.
//! Biomed. Eng. 37 (1990) 757: 71 mm ahead of and 66 mm above the hip joints, and 41 and 35 mm, in the axes of a man who stands. Ours: in a
//! car seat the pelvis leans back by 45°, the segment by 19°; 40 mm of flesh lie in front of the spines; the webbing lies over the middle of
//! the edge. Lap belts of drivers were 44 mm ahead of the upper spine, and higher (M. P. Reed et al., Stapp Car Crash J. 57 (2013)).

use occupant_units::trig;

/// Friction of webbing across a wing.
pub const ACROSS: f64 = 0.25;
/// Drag of webbing across a wing, N·s/m.
pub const DRAG_N_S_M: f64 = 100.0;
/// Pull below which webbing does not slide, N: as in driving, below that of a crash. Ours.
pub(crate) const LEAST_N: f64 = 1000.0;
/// Initial position of the webbing, forward of the hip joints and above them, in radii of the sphere of the pelvis.
pub const PLACE: [f64; 2] = [0.68, 0.68];
/// Radius of the arc on which webbing slides, in radii of the sphere of the pelvis.
pub const RADIUS: f64 = 0.8;
/// Angles of the arc's normal, upward from forward, rad: at the lower spine, where the webbing begins, above the upper spine. Ours: the edge
/// alone would be inclined by -0.3 rad, the crest behind the upper spine is level.
pub const ANGLES_RAD: [f64; 3] = [-0.34, -0.09, 0.41];

/// Tangent of the angle of a strap's pull to a wing's normal at an angle upward from forward, positive towards the
/// abdomen. The belt pulls back and `below_rad` down, relative to the pelvis, and across from wing to wing with the
/// same tension.
pub fn across(angle_rad: f64, below_rad: f64) -> f64 {
    let (sine, cosine) = trig::sin_cos(angle_rad - below_rad);
    sine / (cosine * cosine + 1.0).sqrt()
}

/// Webbing that slides on the wings as a belt does on a track, from the belt's total pull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slider {
    /// Angle of its position, upward from forward, rad.
    angle_rad: f64,
    is_off: bool,
}

impl Default for Slider {
    fn default() -> Self {
        Slider { angle_rad: ANGLES_RAD[1], is_off: false }
    }
}

impl Slider {
    /// Advances by `time_s` under the belt's total pull forward and up, in axes of the pelvis, N, on the wings of a pelvis whose sphere has
    /// this radius, m. Whether it has slid off.
    pub fn go(&mut self, [ahead, up]: [f64; 2], pelvis_m: f64, time_s: f64) -> bool {
        let force = trig::hypot(ahead, up);
        if force < LEAST_N {
            return self.is_off;
        }
        let below_rad = trig::atan2(-up, -ahead);
        let tangent = across(self.angle_rad, below_rad);
        let (_, cosine) = trig::sin_cos(self.angle_rad - below_rad);
        let held = 0.5 * force * (cosine * cosine + 1.0).sqrt();
        let slips = (tangent.abs() - ACROSS).max(0.0) * held / DRAG_N_S_M;
        // no farther at once than to where friction holds it
        let most = (time_s * slips / (RADIUS * pelvis_m)).min((tangent.abs() - ACROSS).max(0.0));
        self.angle_rad = (self.angle_rad + most.copysign(tangent)).max(ANGLES_RAD[0]);
        self.is_off |= self.angle_rad > ANGLES_RAD[2] || (cosine < 0.0 && tangent > 0.0);
        self.is_off
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn webbing_slides_off_beyond_the_cone_of_friction_alone() {
        let mut slider = [Slider::default(); 5];
        let pull = |below: f64| [-8e3 * below.cos(), -8e3 * below.sin()];
        for _ in 0..100 {
            assert!(!slider[0].go(pull(-0.41), 0.1, 2e-3));
            assert!(!slider[2].go([0.0, 0.0], 0.1, 2e-3));
            // too light to be a crash, and straight down on the thighs
            assert!(!slider[3].go([-900.0, 0.0], 0.1, 2e-3));
            assert!(!slider[4].go([3e3, -8e3], 0.1, 2e-3));
            slider[1].go(pull(-0.53), 0.1, 2e-3);
        }
        assert_eq!([slider[0], slider[2]], [Slider::default(); 2]);
        assert!(slider[1].is_off);
    }
}
