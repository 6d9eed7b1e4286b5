//! An air bag as data: its gas, inflators, vents and shape.

use nalgebra::{Point3, Vector3};

use crate::forces::chain::NEVER;
use crate::forces::contact::surface::Frame;

/// R_u, J/(mol·K) (exact, SI of 2019).
pub const GAS_CONSTANT_J_MOL_K: f64 = 8.314_462_618_153_24;
/// Default pressure and temperature of the air around a bag: the standard atmosphere, Pa, and 20 °C, K.
pub const AMBIENT: [f64; 2] = [101_325.0, 293.15];
/// Volume of a folded bag, relative to full.
pub(crate) const FOLDED: f64 = 0.02;

/// An ideal gas, or a mixture of fixed composition, with c_p = a + bT.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gas {
    /// R, J/(kg·K).
    pub r_j_kg_k: f64,
    /// a, J/(kg·K).
    pub a_j_kg_k: f64,
    /// b, J/(kg·K²).
    pub b_j_kg_k2: f64,
}

impl Gas {
    /// Names for [`Gas::named`].
    pub const NAMES: [&'static str; 6] = ["air", "nitrogen", "carbon_dioxide", "water", "helium", "argon"];

    /// Dry air: least squares on its ideal-gas table from 300 to 1000 K, to 1.2 %.
    pub const AIR: Gas = Gas { r_j_kg_k: 287.05, a_j_kg_k: 930.4, b_j_kg_k2: 0.2091 };

    /// A common gas. Nitrogen, carbon dioxide and steam are least squares on the NASA polynomials from 300 to 1000 K,
    /// to 1.7, 5.7 and 1.5 %; noble gases have 2.5 R.
    pub fn named(name: &str) -> Option<Gas> {
        let gas = |r_j_kg_k, a_j_kg_k, b_j_kg_k2| Gas { r_j_kg_k, a_j_kg_k, b_j_kg_k2 };
        let noble = |molar_mass: f64| {
            let r = GAS_CONSTANT_J_MOL_K / molar_mass;
            gas(r, 2.5 * r, 0.0)
        };
        Some(match name {
            "air" => Gas::AIR,
            "nitrogen" => gas(296.80, 962.7, 0.1988),
            "carbon_dioxide" => gas(188.92, 733.0, 0.5360),
            "water" => gas(461.52, 1647.9, 0.6300),
            "helium" => noble(4.0026e-3),
            "argon" => noble(39.948e-3),
            _ => return None,
        })
    }

    /// The mixture of gases by mass fractions.
    pub fn mixed(parts: impl IntoIterator<Item = (Gas, f64)>) -> Gas {
        let none = Gas { r_j_kg_k: 0.0, a_j_kg_k: 0.0, b_j_kg_k2: 0.0 };
        parts.into_iter().fold(none, |sum, (gas, x)| Gas {
            r_j_kg_k: sum.r_j_kg_k + x * gas.r_j_kg_k,
            a_j_kg_k: sum.a_j_kg_k + x * gas.a_j_kg_k,
            b_j_kg_k2: sum.b_j_kg_k2 + x * gas.b_j_kg_k2,
        })
    }

    /// h at a temperature, zero at 0 K, J/kg.
    pub fn enthalpy_j_kg(&self, temperature_k: f64) -> f64 {
        (self.a_j_kg_k + 0.5 * self.b_j_kg_k2 * temperature_k) * temperature_k
    }
}

/// An air bag.
#[derive(Clone, Debug, PartialEq)]
pub struct Bag {
    /// Its name.
    pub name: String,
    /// Its frame.
    pub frame: Frame,
    /// Mounting point, from which it unfolds, axes of its frame, m.
    pub mount_m: Point3<f64>,
    /// Shape when it is full.
    pub shape: Shape,
    /// V_f, m³.
    pub volume_m3: f64,
    /// Firing time, s; [`NEVER`] if none.
    pub fires_s: f64,
    /// t_d, time from firing until it is fully unfolded, s.
    pub deploy_s: f64,
    /// Pressure, Pa, and temperature, K, around it.
    pub ambient: [f64; 2],
    /// Inflators: one, or two stages.
    pub inflators: Vec<Inflator>,
    /// Holes.
    pub vents: Vec<Vent>,
    /// Leakage of the fabric.
    pub leakage: Leakage,
    /// Mass of cover and fabric thrown forward while it unfolds, kg.
    pub cover_kg: f64,
    /// Heat transfer through the fabric, W/(m²·K).
    pub heat_w_m2_k: f64,
    /// Friction coefficient of bodies on it.
    pub friction: f64,
    /// Sliding speed at which friction is 71 % of its full value, m/s.
    pub friction_speed_m_s: f64,
    /// Indices of spheres that it can touch, and factors on their areas.
    pub spheres: Vec<(usize, f64)>,
}

/// A gas source of a bag.
#[derive(Clone, Debug, PartialEq)]
pub struct Inflator {
    /// Its gas.
    pub gas: Gas,
    /// Ignition time, s.
    pub due_s: f64,
    /// Time since ignition, s, mass flow, kg/s, and temperature, K; no flow before the first row and after the last.
    pub rows: Vec<[f64; 3]>,
    /// Volume of a tank, m³, and gauge pressure measured in it, Pa: a check of the table.
    pub tank: Option<[f64; 2]>,
}

/// A hole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vent {
    /// A, m².
    pub area_m2: f64,
    /// C_d.
    pub discharge: f64,
    /// Gauge pressure that opens it for good, Pa.
    pub opens_at_pa: f64,
    /// Opening time, s, unless the pressure has opened it before.
    pub due_s: f64,
}

/// Leakage of the fabric.
#[derive(Clone, Debug, PartialEq)]
pub enum Leakage {
    /// A fraction of the free fabric's area, as a vent.
    Fraction(f64),
    /// Gauge pressure, Pa, and gas speed through the fabric, m/s.
    Speed(Vec<[f64; 2]>),
}

/// Shape of a full bag, in the axes of its frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// From a plane through the mount towards the occupant: a cylinder that ends in a spherical face.
    Dome {
        /// Towards the occupant.
        axis: Vector3<f64>,
        /// H along the axis, m.
        depth_m: f64,
        /// a, m.
        radius_m: f64,
        /// R_f, m.
        face_radius_m: f64,
        /// e, radius of the edge of the face, m.
        edge_m: f64,
    },
    /// A sphere.
    Sphere {
        /// Centre, m.
        centre_m: Point3<f64>,
        /// R, m.
        radius_m: f64,
    },
    /// All points within a radius of a straight line.
    Capsule {
        /// Ends of the line, m.
        ends_m: [Point3<f64>; 2],
        /// Radius, m.
        radius_m: f64,
    },
}

impl Bag {
    /// Times known before the run at which its pressure may have a kink, s.
    pub(crate) fn breaks_s(&self) -> Vec<f64> {
        let mut list = vec![self.fires_s, self.fires_s + self.deploy_s];
        list.extend(self.inflators.iter().flat_map(|one| one.rows.iter().map(|row| one.due_s + row[0])));
        list.extend(self.vents.iter().map(|vent| vent.due_s));
        list.retain(|time_s| *time_s < NEVER);
        list
    }
}
