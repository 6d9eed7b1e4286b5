//! The report's generalized coordinates q₁…q₃₁: an input and output format.
//!
//! Order (Appendix III): q₁–q₃ place of T1 in space; φ, θ, ψ (z–y–z Euler angles, absolute) of segments 1, 2, 3, 4 as
//! q₄–q₁₅, of 5 as q₁₆–q₁₈, of 6 as q₁₉–q₂₁; α₇, α₈ as q₂₂, q₂₃; φ, θ, ψ of 9 as q₂₄–q₂₆, of 10 as q₂₇–q₂₉; α₁₁, α₁₂ as
//! q₃₀, q₃₁. They are singular where sin θ = 0 (an upright torso, a hanging arm); nothing is integrated in them.

/// Number of degrees of freedom.
pub const DOF: usize = 31;

/// q and q̇: metres and radians, metres and radians per second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReportCoordinates {
    /// q₁…q₃₁.
    pub q: [f64; DOF],
    /// q̇₁…q̇₃₁.
    pub rates: [f64; DOF],
}
