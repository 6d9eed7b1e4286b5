//! The generator's 15 segments merged to the report's 12 by the parallel-axis theorem, products of inertia neglected.

use nalgebra::Vector3;

use super::{CT, F, H, LA, LL, LT, N, REFERENCE, Stretch, UA, UL, UT};
use crate::body::tti12::TTI12;
use crate::body::{Body, SegmentProperties};

/// Rigidly joined parts: moments of inertia about the centre of gravity, which is `z_m` above a datum.
#[derive(Clone, Copy)]
struct Lump {
    mass_kg: f64,
    z_m: f64,
    inertia_kg_m2: [f64; 3],
}

impl Lump {
    /// Joined with another, whose centre of gravity is `ahead_m` forward of this one's.
    fn with(self, other: Lump, ahead_m: f64) -> Lump {
        let mass_kg = self.mass_kg + other.mass_kg;
        let reduced_kg = self.mass_kg * other.mass_kg / mass_kg;
        let up_m = other.z_m - self.z_m;
        let steiner =
            [up_m * up_m, up_m * up_m + ahead_m * ahead_m, ahead_m * ahead_m].map(|square| reduced_kg * square);
        Lump {
            mass_kg,
            z_m: (self.mass_kg * self.z_m + other.mass_kg * other.z_m) / mass_kg,
            inertia_kg_m2: std::array::from_fn(|i| self.inertia_kg_m2[i] + other.inertia_kg_m2[i] + steiner[i]),
        }
    }

    fn segment(&self, length_m: f64) -> SegmentProperties {
        SegmentProperties::new(length_m, self.mass_kg, self.z_m, Vector3::from(self.inertia_kg_m2))
    }
}

impl Stretch {
    /// A part with inertias about the axes of the body's 12 segments; its centre of gravity is `z_m` above the datum.
    fn lump(&self, part: usize, z_m: f64) -> Lump {
        let [ix, iy, iz] = self.principal(part);
        let sin2 = libm::sin(REFERENCE[part].2.to_radians()).powi(2);
        let inertia_kg_m2 = [ix + (iz - ix) * sin2, iy, iz + (ix - iz) * sin2];
        Lump { mass_kg: self.mass_kg[part], z_m, inertia_kg_m2 }
    }

    /// The parts merged to the 12 segments; distances of joints from centres of gravity are the reference's.
    pub(super) fn merged(&self) -> Body {
        let z = |part, inches| self.along(part, 2, inches);
        let x = |part, inches| self.along(part, 0, inches);
        let plain = |part, above, below| self.lump(part, z(part, below)).segment(z(part, above) + z(part, below));

        // the neck's centre of gravity is 1.46 in above its lower joint, which is 7.26 in above the upper torso's
        let neck = self.lump(N, z(UT, 6.99 + 7.26) + z(N, 1.46));
        let torso = self.lump(UT, z(UT, 6.99)).with(neck, x(N, 0.93) - x(UT, 0.27));
        // of the 3.97 in between the neck's joints, 2.99 hang from the head's
        let head = self.lump(H, z(H, 1.93) + z(N, 2.99));
        let ankle_m = x(F, 1.37 + 1.39);
        let shank = self.lump(LL, z(LL, 9.78) + ankle_m);
        let leg = shank.with(self.foot(), x(LL, 0.39) + z(F, 2.76));

        let segments = [
            plain(CT, 0.83, 2.25),
            torso.segment(z(UT, 6.99 + 4.35)),
            head.segment(head.z_m + z(H, 4.90)),
            plain(LT, 2.24, 1.52),
            plain(UA, 5.22, 5.04),
            plain(LA, 7.08, 9.20),
            plain(UL, 7.55, 9.80),
            leg.segment(z(LL, 6.91 + 9.78) + ankle_m),
        ];
        Body {
            name: "person".to_owned(),
            tree: &TTI12,
            segments: TTI12
                .segments()
                .map(|n| n.index())
                .map(|n| segments[if n < 4 { n } else { 4 + (n - 4) / 2 }])
                .collect(),
            places: Vec::new(),
            shoulder_half_width_m: self.half_width_m(UA),
            hip_half_width_m: self.half_width_m(UL),
            neck_height_m: z(UT, 2.91) + z(N, 0.98),
            // the head's pivot lies 0.83 in behind and 1.93 in below the centre of gravity of the head
            condyles_m: Some(Vector3::new(-x(H, 0.83), 0.0, z(N, 2.99))),
            spheres: Vec::new(),
            plates: Vec::new(),
            chests: Vec::new(),
            sides: Vec::new(),
        }
    }

    /// The foot: its X axis points up and its Z axis forward.
    fn foot(&self) -> Lump {
        let foot = self.lump(F, self.along(F, 0, 1.39));
        let [ix, iy, iz] = foot.inertia_kg_m2;
        Lump { inertia_kg_m2: [iz, iy, ix], ..foot }
    }
}
