//! The energy ledger: every joule of the occupant accounted for at each output.
//!
//! Kinetic, gravity, spring, contact and belt energies are functions of the state; work sums are integrated with the
//! integrator's own weights. With W_v the work of the moving vehicle on the occupant,
//! kinetic + gravity + springs + ∫contact + ∫friction + ∫joints + ∫belts − W_v stays what it was at the start.

use crate::motion::frame::Moving;
use crate::motion::kinematics::Kinematics;
use crate::motion::skeleton::Skeleton;
use crate::motion::state::Work;
use crate::motion::vector::V3;

/// Energies of one instant, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyLedger {
    /// Kinetic energy in space.
    pub kinetic_j: f64,
    /// Kinetic energy of the motion relative to the vehicle (velocities minus the vehicle's rigid-body field).
    pub kinetic_relative_j: f64,
    /// M g Z′, zero at Z′ = 0.
    pub gravity_j: f64,
    /// Stored in the joints' springs.
    pub spine_j: f64,
    /// Stored (recoverable) in contacts.
    pub contacts_j: f64,
    /// Stored (recoverable) in belts.
    pub belts_j: f64,
    /// Dissipated by contacts since the start: work put in less what is stored.
    pub lost_contacts_j: f64,
    /// Dissipated by friction since the start.
    pub lost_friction_j: f64,
    /// Dissipated by joint dampers and stops since the start.
    pub lost_joints_j: f64,
    /// Dissipated by belts since the start.
    pub lost_belts_j: f64,
    /// Work done on the occupant by the moving vehicle since the start.
    pub vehicle_work_j: f64,
    /// Present sum less the sum at the start; 0 for an exact integration.
    pub balance_j: f64,
}

/// Stored energies at the start, from which the balance counts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyStart {
    /// Stored in contacts, J.
    pub contacts_j: f64,
    /// Stored in belts, J.
    pub belts_j: f64,
    /// Sum of kinetic, gravity and spring energy, J.
    pub mechanical_j: f64,
}

/// Stored energies of one instant, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stored {
    /// In the joints' springs.
    pub spine_j: f64,
    /// In contacts.
    pub contacts_j: f64,
    /// In belts.
    pub belts_j: f64,
}

impl EnergyLedger {
    /// The ledger of one instant; `vehicle` is the vehicle's motion.
    pub fn new(
        body: &Skeleton<f64>,
        k: &Kinematics<f64>,
        vehicle: &Moving<f64>,
        stored: Stored,
        work: &Work<f64>,
        start: &EnergyStart,
    ) -> Self {
        let kinetic_j = kinetic(body, k, &Moving::space());
        let gravity_j = gravity(body, k);
        let mechanical = kinetic_j + gravity_j + stored.spine_j;
        let spent = work.contact + work.friction + work.joints + work.belts;
        EnergyLedger {
            kinetic_j,
            kinetic_relative_j: kinetic(body, k, vehicle),
            gravity_j,
            spine_j: stored.spine_j,
            contacts_j: stored.contacts_j,
            belts_j: stored.belts_j,
            lost_contacts_j: work.contact + start.contacts_j - stored.contacts_j,
            lost_friction_j: work.friction,
            lost_joints_j: work.joints,
            lost_belts_j: work.belts + start.belts_j - stored.belts_j,
            vehicle_work_j: work.vehicle,
            balance_j: mechanical + spent - work.vehicle - start.mechanical_j,
        }
    }

    /// What this instant contributes to the start of a balance.
    pub fn as_start(&self) -> EnergyStart {
        EnergyStart {
            contacts_j: self.contacts_j,
            belts_j: self.belts_j,
            mechanical_j: self.kinetic_j + self.gravity_j + self.spine_j,
        }
    }
}

/// ½ Σ (M v·v + ω·Iω) of the motion relative to a frame (Eq. 54), J.
pub fn kinetic(body: &Skeleton<f64>, k: &Kinematics<f64>, frame: &Moving<f64>) -> f64 {
    let segment = |n: usize| {
        let link = &body.links[n];
        let v = k.cg_velocity(body, n) - frame.velocity_at(k.cg(body, n));
        let w = k.axes[n].into_frame(k.omega[n] - frame.omega);
        let [ix, iy, iz] = link.central;
        link.mass * v.norm_squared() + ix * w.x * w.x + iy * w.y * w.y + iz * w.z * w.z
    };
    0.5 * (0..body.links.len()).map(segment).sum::<f64>()
}

/// Σ M g Z′ (Eq. 55 with Z′₀ = 0), J.
pub fn gravity(body: &Skeleton<f64>, k: &Kinematics<f64>) -> f64 {
    let height = |n: usize| body.links[n].mass * k.cg(body, n).z;
    body.gravity * (0..body.links.len()).map(height).sum::<f64>()
}

/// Σ M v and Σ (M (x − about) × v + I ω), space axes: kg·m/s and kg·m²/s.
pub fn momentum(body: &Skeleton<f64>, k: &Kinematics<f64>, about: V3<f64>) -> (V3<f64>, V3<f64>) {
    let (mut linear, mut angular) = (V3::zero(), V3::zero());
    for (n, link) in body.links.iter().enumerate() {
        let p = k.cg_velocity(body, n) * link.mass;
        let w = k.axes[n].into_frame(k.omega[n]);
        let [ix, iy, iz] = link.central;
        linear += p;
        angular += (k.cg(body, n) - about).cross(p);
        angular += k.axes[n].out(V3 { x: ix * w.x, y: iy * w.y, z: iz * w.z });
    }
    (linear, angular)
}
