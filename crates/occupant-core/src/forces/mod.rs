//! What acts on the body: contact, belts, air bags, columns, joints, each kind of force element in a room of its own.
//!
//! A kind is an [`Element`]. The list of kinds in `list.rs` gives the force laws of everything ([`Forces`]), what they
//! remember ([`History`]), what they do at one instant ([`Actions`]), their energies (`STORED`, `SUMS`). The kernel, runs
//! side by side, dual numbers, the energy ledger and checkpoints know the list alone. What results show of a kind is its
//! [`shown::Reported`]: result files, summaries, pictures and sensitivities visit the list ([`visit_kinds`]). To add a kind
//! takes a folder with its [`Element`] and [`shown::Reported`], its line in the list, its places in the ledger and its data
//! in a setup.
//!
//! Nothing here knows a model, a run or a result.

pub mod bag;
pub mod belt;
pub mod chain;
pub mod column;
pub mod contact;
pub(crate) mod decay;
mod element;
pub mod function;
pub mod joint;
mod list;
pub mod own;
mod pace;
pub mod plate;
pub(crate) mod rate;
pub mod shown;
pub mod sphere;
pub mod spring;
pub mod stored;
pub mod table;

pub use element::*;
pub use list::*;
pub use pace::Pace;
