//! A contact between two bodies from its start to its end, and its effect on each vehicle.

use crate::V3;
use crate::ride::Station;

/// Time without force after which a contact ends, s.
pub(crate) const ENDS_AFTER_S: f64 = 0.025;
/// A force below this share of the contact's largest no longer prolongs it: cars that lean on each other.
pub(crate) const FADES: f64 = 0.01;
/// A smaller force is no contact, N.
pub(crate) const LEAST_N: f64 = 1.0;

/// Partner of a vehicle in a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Partner {
    /// Another vehicle.
    Car(usize),
    /// A barrier.
    Barrier(usize),
}

/// A contact.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// The vehicle.
    pub car: usize,
    /// Its partner.
    pub partner: Partner,
    /// First touch, s.
    pub from_s: f64,
    /// Last force above a hundredth of the largest, s.
    pub until_s: f64,
    /// Impulse on the vehicle, vehicle-space, N·s.
    pub impulse_n_s: V3,
    /// Largest force, N.
    pub peak_n: f64,
    /// Effect on the vehicle, and on its partner if that is a vehicle.
    pub struck: [Option<Struck>; 2],
}

/// Effect of a contact on a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Struck {
    /// Largest velocity change of the centre of gravity during the contact, in the vehicle's axes at first contact,
    /// m/s. It includes tyres and gravity.
    pub delta_v_m_s: V3,
    /// Velocity change by the contact impulse alone, same axes, m/s.
    pub by_contact_m_s: V3,
    /// Principal direction of force, clockwise from the front, rad, 0 to 2π.
    pub pdof_rad: f64,
    /// Clock direction of the force, 1 to 12.
    pub clock: u8,
    /// Energy-equivalent speed √(2E/M), m/s.
    pub ees_m_s: f64,
    /// Velocity before the contact, vehicle-space, m/s.
    pub enters_m_s: V3,
    /// Velocity at the end of the contact, vehicle-space, m/s.
    pub leaves_m_s: V3,
    /// Yaw rate at first contact and at the end, rad/s.
    pub yaw_rates_rad_s: [f64; 2],
    /// Largest acceleration within it, m/s²; infinite if it has no duration.
    pub peak_m_s2: f64,
}

impl Struck {
    /// Of a vehicle's stations, for a contact's time and impulse; `before` is the station before an impact without
    /// duration, as the first of its time is that after it.
    pub(crate) fn of(
        stations: &[Station],
        before: Option<&Station>,
        [from_s, until_s]: [f64; 2],
        impulse_n_s: V3,
        mass_kg: f64,
    ) -> Option<Self> {
        let first = stations.partition_point(|station| station.time_s < from_s - 1e-12);
        let end = stations.partition_point(|station| station.time_s <= until_s + 1e-12).max(first + 1);
        let within = stations.get(first..end.min(stations.len()))?;
        let (start, last) = (before.or(within.first())?, within.last()?);
        let change = |station: &&Station| (station.velocity_m_s - start.velocity_m_s).norm();
        let most = within.iter().max_by(|a, b| change(a).total_cmp(&change(b)))?;
        let to_car = start.attitude.inverse();
        let by_contact = to_car * (impulse_n_s / mass_kg);
        let pdof_rad = libm::atan2(-by_contact.y, -by_contact.x).rem_euclid(core::f64::consts::TAU);
        let work = |station: &Station| station.state.work().crush_j;
        let absorbed_j = (work(last) - work(start)).max(0.0);
        let peak_m_s2 = within.iter().map(|station| station.acceleration_m_s2.norm()).fold(0.0, f64::max);
        let hour = (pdof_rad / (core::f64::consts::PI / 6.0)).round() as u8 % 12;
        Some(Struck {
            delta_v_m_s: to_car * (most.velocity_m_s - start.velocity_m_s),
            by_contact_m_s: by_contact,
            pdof_rad,
            clock: if hour == 0 { 12 } else { hour },
            ees_m_s: (2.0 * absorbed_j / mass_kg).sqrt(),
            enters_m_s: start.velocity_m_s,
            leaves_m_s: last.velocity_m_s,
            yaw_rates_rad_s: [start.rotation_rad_s.z, last.rotation_rad_s.z],
            peak_m_s2: if before.is_some() { f64::INFINITY } else { peak_m_s2 },
        })
    }
}

impl Contact {
    pub(crate) fn begin(car: usize, partner: Partner, from_s: f64) -> Self {
        Contact { car, partner, from_s, until_s: from_s, impulse_n_s: V3::zeros(), peak_n: 0.0, struck: [None; 2] }
    }
}
