//! What acts on the body: contact, belts, joints, each in a room of its own.

pub mod belt;
pub mod contact;
pub mod joint;
pub mod material;
pub mod spring;

pub use contact::history::History;

use belt::law::BeltAction;
use contact::Touch;

/// Receives what happens in an evaluation.
pub trait Observer<S> {
    /// A pair exerts a force.
    #[inline(always)]
    fn touch(&mut self, _touch: &Touch<S>) {}
    /// Shape and force of belt `_index`.
    #[inline(always)]
    fn belt(&mut self, _index: usize, _action: &BeltAction<S>) {}
}

impl<S> Observer<S> for () {}
