//! Motion of the body: numbers and vectors, state, kinematics, dynamics, integrators.

pub(crate) mod articulated;
pub(crate) mod closed;
pub mod dual;
pub mod dynamics;
pub mod frame;
pub mod integrate;
pub mod kinematics;
#[cfg(any(target_arch = "x86_64", test))]
pub(crate) mod lanes;
pub mod layout;
pub(crate) mod mobility;
pub mod report_coordinates;
pub(crate) mod scalar;
pub mod skeleton;
pub mod state;
pub mod vector;
