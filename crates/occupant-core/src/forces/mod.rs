//! Forces on the body: contact, belts, air bags, columns, joints; each kind of force element has its own module.
//!
//! A kind is an [`Element`]. From the list of kinds in `list.rs` follow the force laws ([`Forces`]), their memory
//! ([`History`]), their actions at one instant ([`Actions`]) and their energies (`STORED`, `SUMS`). The kernel, lanes,
//! dual numbers, the energy ledger and checkpoints know only the list. The results of a kind are its
//! [`shown::Reported`]: result files, summaries, pictures and sensitivities visit the list ([`visit_kinds`]). To add a
//! kind, add a folder with its [`Element`] and [`shown::Reported`], its line in the list, its places in the ledger and
//! its data in a setup.
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
pub(crate) mod marks;
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
