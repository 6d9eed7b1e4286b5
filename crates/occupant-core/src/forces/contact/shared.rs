//! Few things for many pairs: what differs by surface and material, not by sphere, is there once.

use std::ops::Index;

use crate::forces::element::Unlike;

/// A thing for each pair; equal ones are one.
#[derive(Clone, Debug)]
pub struct Shared<T> {
    things: Vec<T>,
    /// By pair.
    of: Vec<u32>,
}

impl<T> Default for Shared<T> {
    fn default() -> Self {
        Shared { things: Vec::new(), of: Vec::new() }
    }
}

impl<T> Shared<T> {
    /// Adds the next pair's, thing number `i`, made first if it is the next.
    pub(super) fn push(&mut self, i: usize, make: impl FnOnce() -> T) {
        if i == self.things.len() {
            self.things.push(make());
        }
        self.of.push(i as u32);
    }

    /// Number of pairs.
    pub fn len(&self) -> usize {
        self.of.len()
    }

    /// Whether there are no pairs.
    pub fn is_empty(&self) -> bool {
        self.of.is_empty()
    }

    /// That of pair `i`, if there is one.
    #[inline(always)]
    pub fn get(&self, i: usize) -> Option<&T> {
        self.of.get(i).map(|thing| &self.things[*thing as usize])
    }

    /// That of pair `i`.
    pub(super) fn get_mut(&mut self, i: usize) -> &mut T {
        &mut self.things[self.of[i] as usize]
    }

    /// That of each pair.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.of.iter().map(|thing| &self.things[*thing as usize])
    }

    /// Pair by pair with those of another model; `unlike` where its pairs share in another way.
    pub(super) fn zip<A, U>(
        &self,
        other: &Shared<A>,
        unlike: Unlike,
        f: impl Fn(&T, &A) -> Result<U, Unlike>,
    ) -> Result<Shared<U>, Unlike> {
        if self.of != other.of {
            return Err(unlike);
        }
        let things = self.things.iter().zip(&other.things).map(|(a, b)| f(a, b));
        Ok(Shared { things: things.collect::<Result<_, _>>()?, of: self.of.clone() })
    }
}

impl<T> Index<usize> for Shared<T> {
    type Output = T;

    #[inline(always)]
    fn index(&self, i: usize) -> &T {
        &self.things[self.of[i] as usize]
    }
}

/// Numbers things by keys in the order in which these are first asked for.
pub(super) struct Numbers<K>(std::collections::BTreeMap<K, usize>);

impl<K: Ord> Numbers<K> {
    /// None yet.
    pub(super) fn new() -> Self {
        Numbers(std::collections::BTreeMap::new())
    }

    /// The number of a key, the next one for a new key.
    pub(super) fn of(&mut self, key: K) -> usize {
        let next = self.0.len();
        *self.0.entry(key).or_insert(next)
    }
}
