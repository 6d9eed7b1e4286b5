//! Whiplash: measures of a blow from behind, for a BioRID-II and whatever stands for it.
//!
//! Times count from the start of the record, which is to be that of the pulse. Accelerations are those of SAE J211 (X ahead,
//! class 60 for head and T1 as seats are rated), neck forces and moments those of SAE J1733 (shear positive where the neck
//! pushes the head ahead, that is where the chest goes ahead of it; tension and flexion positive).

mod contact;
mod lower_neck;
mod nic;
mod nkm;
mod travel;

pub use contact::{HeadContact, RestraintContact, head_restraint_contact};
pub use lower_neck::{LowerNeckIntercepts, LowerNeckLoads, lower_neck_load};
pub use nic::{Nic, nic, nic_history};
pub use nkm::{Nkm, NkmIntercepts, NkmMode, nkm};
pub use travel::{Travel, greatest_until, rebound_speed, relative_travel};
