//! Place and turn of the twelve segments: Eqs 1–26.

use super::{DOF, dual::Number, vector::Vector};
use occupant_core::body::tti12::TTI12;
use occupant_core::body::{Body, SegmentProperties};

/// Columns of the matrix that takes segment axes to space axes: the segment's X, Y and Z in space.
#[derive(Clone, Copy, Debug)]
pub struct Axes<T> {
    /// T₁₁, T₂₁, T₃₁.
    pub x: Vector<T>,
    /// T₁₂, T₂₂, T₃₂.
    pub y: Vector<T>,
    /// T₁₃, T₂₃, T₃₃.
    pub z: Vector<T>,
}

/// Where every segment is, in space axes; index = segment number − 1.
#[derive(Clone, Copy, Debug)]
pub struct Pose<T> {
    /// Tⁿ and Tⁿᵐ.
    pub axes: [Axes<T>; 12],
    /// Centres of gravity.
    pub cg: [Vector<T>; 12],
    /// Lower ends (the distal ends of limbs), from which points on a segment are measured.
    pub lower_end: [Vector<T>; 12],
}

/// Place and turn of all segments for given q₁…q₃₁.
pub fn pose<T: Number>(body: &Body, q: &[T; DOF]) -> Pose<T> {
    let axes = all_axes(q);
    // Segment n of the report is index n here; 0 is unused.
    let length: [f64; 13] = numbered(body, |s| s.length_m);
    let rho: [f64; 13] = numbered(body, |s| s.cg_from_lower_end_m);
    let z = |n: usize| axes[n - 1].z;
    let y = |n: usize| axes[n - 1].y;
    let below = |n: usize| (length[n] - rho[n]) * z(n); // ρ̄ Z
    let l = |n: usize| length[n] * z(n); // L Z
    let (l_s, l_h, neck) = (body.shoulder_half_width_m, body.hip_half_width_m, body.neck_height_m);

    let t1 = Vector([q[0], q[1], q[2]]);
    let cg = [
        t1 - below(1),                                     // (15), ρ̄₁ as in (13)
        t1 + rho[2] * z(2),                                // (16)
        t1 + l(2) + neck * z(2) + rho[3] * z(3),           // (17), the neck above the shoulders
        t1 - l(1) - below(4),                              // (18)
        t1 + l(2) + l_s * y(2) - below(5),                 // (19)
        t1 + l(2) - l_s * y(2) - below(6),                 // (20)
        t1 + l(2) + l_s * y(2) - l(5) - below(7),          // (21)
        t1 + l(2) - l_s * y(2) - l(6) - below(8),          // (22)
        t1 - l(1) - l(4) + l_h * y(4) - below(9),          // (23)
        t1 - l(1) - l(4) - l_h * y(4) - below(10),         // (24)
        t1 - l(1) - l(4) + l_h * y(4) - l(9) - below(11),  // (25)
        t1 - l(1) - l(4) - l_h * y(4) - l(10) - below(12), // (26)
    ];
    // ρ is the distance of the centre of gravity from the lower end.
    let lower_end = std::array::from_fn(|i| cg[i] - rho[i + 1] * axes[i].z);
    Pose { axes, cg, lower_end }
}

/// [Tⁿ] of the eight free segments and [Tⁿᵐ] of forearms and lower legs.
pub(super) fn all_axes<T: Number>(q: &[T; DOF]) -> [Axes<T>; 12] {
    let (t5, t6, t9, t10) = (euler(q, 16), euler(q, 19), euler(q, 24), euler(q, 27));
    [
        euler(q, 4),
        euler(q, 7),
        euler(q, 10),
        euler(q, 13),
        t5,
        t6,
        hinge(t5, q[21]),
        hinge(t6, q[22]),
        t9,
        t10,
        hinge(t9, q[29]),
        hinge(t10, q[30]),
    ]
}

/// Eq. 6, `first` the number of the coordinate φ.
fn euler<T: Number>(q: &[T; DOF], first: usize) -> Axes<T> {
    let (phi, theta, psi) = (q[first - 1], q[first], q[first + 1]);
    let (sf, cf) = (phi.sin(), phi.cos());
    let (st, ct) = (theta.sin(), theta.cos());
    let (sp, cp) = (psi.sin(), psi.cos());
    Axes {
        x: Vector([cf * ct * cp - sf * sp, sf * ct * cp + cf * sp, -st * cp]), // (6a, d, g)
        y: Vector([-cf * ct * sp - sf * cp, -sf * ct * sp + cf * cp, st * sp]), // (6b, e, h)
        z: Vector([cf * st, sf * st, ct]),                                     // (6c, f, i)
    }
}

/// Eqs 8–11: [Tⁿᵐ] = [Tⁿ] R_y(α).
fn hinge<T: Number>(t: Axes<T>, alpha: T) -> Axes<T> {
    let (sa, ca) = (alpha.sin(), alpha.cos());
    Axes { x: t.x * ca - t.z * sa, y: t.y, z: t.x * sa + t.z * ca }
}

/// Values by the report's segment number, 1 to 12.
fn numbered(body: &Body, of: impl Fn(&SegmentProperties) -> f64) -> [f64; 13] {
    let mut values = [f64::NAN; 13];
    for segment in TTI12.segments() {
        values[segment.number()] = of(body.segment(segment));
    }
    values
}
