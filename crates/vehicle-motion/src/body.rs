//! The body of a vehicle in contacts: outline, stiffness of its faces, spheres of its hull.

/// Impact speed without residual crush, m/s: 8 km/h.
pub const NO_CRUSH_M_S: f64 = 2.222;

/// Crush stiffness: force per width A + B C over the residual crush C.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffness {
    /// A, N/m.
    pub a_n_per_m: f64,
    /// B, N/m².
    pub b_n_per_m2: f64,
}

impl Stiffness {
    /// Stiffness of a vehicle whose residual crush at a full-width wall is C = (v − b₀)/b₁, b₀ 2.222 m/s: A = M b₀b₁/W,
    /// B = M b₁²/W.
    pub fn by_speed(mass_kg: f64, width_m: f64, crush_per_s: f64) -> Self {
        let per_width = mass_kg / width_m;
        Stiffness {
            a_n_per_m: per_width * NO_CRUSH_M_S * crush_per_s,
            b_n_per_m2: per_width * crush_per_s * crush_per_s,
        }
    }

    /// Stiffness from one full-width wall test: speed and six depths C₁ to C₆, m, at equal distances over its width.
    /// Exact for the profile: the energy ½M v² is that of the depths.
    pub fn by_test(mass_kg: f64, width_m: f64, speed_m_s: f64, depths_m: [f64; 6]) -> Self {
        let c = depths_m;
        let mean = (0.5 * (c[0] + c[5]) + c[1..5].iter().sum::<f64>()) / 5.0;
        let square = c.windows(2).map(|p| p[0] * p[0] + p[0] * p[1] + p[1] * p[1]).sum::<f64>() / 15.0;
        // Q b₁² + 2 b₀ C̄ b₁ + b₀² − v² = 0
        let half = NO_CRUSH_M_S * mean;
        let rest = NO_CRUSH_M_S * NO_CRUSH_M_S - speed_m_s * speed_m_s;
        Stiffness::by_speed(mass_kg, width_m, (-half + (half * half - square * rest).sqrt()) / square)
    }

    /// The stiffness with A and B scaled.
    pub fn scaled(self, of_a: f64, of_b: f64) -> Self {
        Stiffness { a_n_per_m: of_a * self.a_n_per_m, b_n_per_m2: of_b * self.b_n_per_m2 }
    }

    /// Crush energy of residual depths at equal distances over a width, J, with the force inclined to the face's
    /// normal: (1 + tan²α) ∫ (A C + ½B C² + A²/2B), linear between the depths (CRASH3).
    pub fn damage_j(self, width_m: f64, depths_m: &[f64], lean_rad: f64) -> f64 {
        let Stiffness { a_n_per_m: a, b_n_per_m2: b } = self;
        let pieces = depths_m.len().saturating_sub(1).max(1) as f64;
        let piece = |p: &[f64]| 0.5 * a * (p[0] + p[1]) + b * (p[0] * p[0] + p[0] * p[1] + p[1] * p[1]) / 6.0;
        let sum: f64 = depths_m.windows(2).map(piece).sum::<f64>() / pieces;
        let tangent = libm::tan(lean_rad);
        (1.0 + tangent * tangent) * width_m * (sum + 0.5 * a * a / b)
    }

    /// Crush that leaves no damage, A/B, m.
    pub fn elastic_m(self) -> f64 {
        self.a_n_per_m / self.b_n_per_m2
    }
}

/// A row of contact nodes on a face: height, and share of the stiffness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Over the road at rest, m.
    pub height_m: f64,
    /// Share of the face's stiffness.
    pub share: f64,
}

/// Interpretation of the stiffness coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// Maximum crush = residual crush + A/B: for damage, EES, reconstruction. Pulses are too short.
    Residual,
    /// Maximum crush is longer by a share, with the same energy and residual crush: for pulses on occupants.
    Dynamic {
        /// The share, 0.2 by the one test with channels compared so far.
        longer: f64,
    },
}

impl Reading {
    /// Ratio of the maximum crush to that of the residual interpretation.
    pub fn stretch(self) -> f64 {
        match self {
            Reading::Residual => 1.0,
            Reading::Dynamic { longer } => 1.0 + longer,
        }
    }
}

/// Sides of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Front, with its cut corners.
    Front,
    /// To the right.
    Right,
    /// Rear, with its cut corners.
    Rear,
    /// To the left.
    Left,
}

/// A part of a side that is stiffer: a wheel, a pillar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hard {
    /// Of which side.
    pub side: Side,
    /// Range along the side, m: forward of the centre of gravity on the left and right, to the right in front and rear.
    pub span_m: [f64; 2],
    /// Factor on A and B.
    pub factor: f64,
}

/// Crush properties of a vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct Crush {
    /// Front.
    pub front: Stiffness,
    /// Both sides.
    pub side: Stiffness,
    /// Rear.
    pub rear: Stiffness,
    /// Rows of nodes of front and rear.
    pub end_rows: Vec<Row>,
    /// Rows of nodes of the sides.
    pub side_rows: Vec<Row>,
    /// Shares of energy returned, below A/B and above.
    pub returned: [f64; 2],
    /// Interpretation of the stiffness.
    pub reading: Reading,
    /// Stiffer parts.
    pub hard: Vec<Hard>,
    /// Largest distance between nodes, m.
    pub spacing_m: f64,
}

impl Crush {
    /// Crush of given faces, with guessed rows, returned shares 0.2 and 0.015, residual interpretation.
    pub fn of_faces(front: Stiffness, side: Stiffness, rear: Stiffness) -> Self {
        let row = |height_m, share| Row { height_m, share };
        Crush {
            front,
            side,
            rear,
            end_rows: vec![row(0.45, 0.7), row(0.75, 0.3)],
            side_rows: vec![row(0.35, 0.5), row(0.6, 0.5)],
            returned: [0.2, 0.015],
            reading: Reading::Residual,
            hard: Vec::new(),
            spacing_m: 0.1,
        }
    }

    /// Of a side.
    pub fn of(&self, side: Side) -> Stiffness {
        match side {
            Side::Front => self.front,
            Side::Rear => self.rear,
            Side::Left | Side::Right => self.side,
        }
    }
}

/// A sphere of the hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Position forward and right of the centre of gravity, and height over the road at rest, m.
    pub place_m: [f64; 3],
    /// Radius, m.
    pub radius_m: f64,
    /// Stiffness, N/m.
    pub stiffness_n_per_m: f64,
    /// Whether its crush is permanent: roof.
    pub is_roof: bool,
}

/// Outline, crush and hull.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Distance of the front face forward of the centre of gravity, m.
    pub front_m: f64,
    /// Length, m.
    pub length_m: f64,
    /// Width, m.
    pub width_m: f64,
    /// Height of the roof over the road, m.
    pub height_m: f64,
    /// Size of the cut corners in plan, m.
    pub corner_m: f64,
    /// Lower and upper edge of the outline over the road at rest, m.
    pub band_m: [f64; 2],
    /// Stiffness.
    pub crush: Crush,
    /// Spheres that meet the ground.
    pub hull: Vec<Ball>,
    /// Friction of the hull on ground of factor 1.
    pub hull_friction: f64,
    /// Share of energy returned by a sphere of the hull.
    pub hull_returned: f64,
}

/// Spheres of a sedan on the right: ahead, right, height, radius, m. Each has its mirror.
const SEDAN_HULL: [[f64; 4]; 12] = [
    [0.45, 0.52, 1.43, 0.06],
    [-0.45, 0.53, 1.45, 0.06],
    [-1.1, 0.50, 1.40, 0.06],
    [1.0, 0.70, 1.0, 0.06],
    [2.0, 0.70, 0.78, 0.08],
    [-2.0, 0.70, 0.95, 0.08],
    [1.9, 0.78, 0.5, 0.1],
    [-2.0, 0.78, 0.5, 0.1],
    [0.0, 0.80, 0.95, 0.06],
    [-0.9, 0.80, 0.95, 0.06],
    [0.8, 0.76, 0.25, 0.06],
    [-0.8, 0.76, 0.25, 0.06],
];
const SEDAN_M: [f64; 3] = [4.70, 1.82, 1.45];
const SEDAN_FRONT_M: f64 = 2.05;

impl Body {
    /// A body of a length, width and height, with the front a distance forward of the centre of gravity; its hull is
    /// that of a sedan, scaled.
    pub fn sized(size_m: [f64; 3], front_m: f64, crush: Crush) -> Self {
        let [along, across, up] = [0, 1, 2].map(|i| size_m[i] / SEDAN_M[i]);
        let ball = |[x, y, z, radius_m]: [f64; 4], side: f64| Ball {
            place_m: [front_m + (x - SEDAN_FRONT_M) * along, side * y * across, z * up],
            radius_m,
            stiffness_n_per_m: if z <= 0.5 { 500e3 } else { 250e3 },
            is_roof: z > 1.2,
        };
        Body {
            front_m,
            length_m: size_m[0],
            width_m: size_m[1],
            height_m: size_m[2],
            corner_m: 0.15,
            band_m: [0.25, 1.0],
            crush,
            hull: SEDAN_HULL.iter().flat_map(|&row| [ball(row, -1.0), ball(row, 1.0)]).collect(),
            hull_friction: 0.5,
            hull_returned: 0.15,
        }
    }

    /// The body relative to another centre of gravity: forward and right, m. Heights are from the road and unchanged.
    pub(crate) fn shift(&mut self, ahead_m: f64, right_m: f64) {
        self.front_m -= ahead_m;
        for ball in &mut self.hull {
            ball.place_m[0] -= ahead_m;
            ball.place_m[1] -= right_m;
        }
        for hard in &mut self.crush.hard {
            let along = if matches!(hard.side, Side::Left | Side::Right) { ahead_m } else { right_m };
            hard.span_m = hard.span_m.map(|x| x - along);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// CRASH3's sample run with G = A²/2B: published with G of 1874 and 203 lb, 19 255.1 and 31 099.9 ft·lb.
    #[test]
    fn damage_energies_are_those_of_the_sample_run() {
        let (inch, pound) = (0.0254, 0.453_592_37 * 9.80665);
        let stiffness =
            |a: f64, b: f64| Stiffness { a_n_per_m: a * pound / inch, b_n_per_m2: b * pound / (inch * inch) };
        let side = [6.2, 8.3, 9.2, 5.9, 4.4, 0.8];
        let quarter = core::f64::consts::FRAC_PI_4;
        let cases = [
            (stiffness(356.0, 34.0), 73.0, &[2.7, 3.6][..], 0.0, 19_192.9, 19_255.1),
            (stiffness(143.0, 50.0), 84.5, &side[..], quarter, 31_120.9, 31_099.9),
        ];
        for (stiffness, width, depths, lean, expected, published) in cases {
            let depths: Vec<f64> = depths.iter().map(|c| c * inch).collect();
            let found = stiffness.damage_j(width * inch, &depths, lean) / (pound * 12.0 * inch);
            assert!((found - expected).abs() < 0.06, "{found} {expected}");
            assert!((found / published - 1.0).abs() < 4e-3);
        }
    }

    /// 1500 kg on 1.5 m, 0.5 m at 56 km/h: a worked example of the literature.
    #[test]
    fn stiffness_of_one_test_is_exact_for_its_profile() {
        let found = Stiffness::by_test(1500.0, 1.5, 56.0 / 3.6, [0.5; 6]);
        assert!((found.a_n_per_m - 59_259.0).abs() < 60.0 && (found.b_n_per_m2 - 711_111.0).abs() < 800.0, "{found:?}");
        let depths = [0.38, 0.466, 0.511, 0.518, 0.489, 0.37];
        let found = Stiffness::by_test(1719.0, 1.837, 57.09 / 3.6, depths);
        let energy = found.damage_j(1.837, &depths, 0.0);
        let expected = 0.5 * 1719.0 * (57.09f64 / 3.6).powi(2);
        assert!((energy / expected - 1.0).abs() < 1e-12, "{energy} {expected}");
    }
}
