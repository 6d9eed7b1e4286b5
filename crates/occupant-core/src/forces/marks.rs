//! Marks on elements: which of them a commit may have changed.
//!
//! A memory has thousands of pairs of spheres and faces, and a commit looks at a few dozen. A copy of the rest costs more
//! than a rate.

/// A set of elements of one kind, by number.
#[derive(Clone, Debug, Default)]
pub(crate) struct Marks {
    /// 64 elements each.
    words: Vec<u64>,
}

impl Marks {
    /// No marks on `count` elements.
    pub(crate) fn none(count: usize) -> Self {
        Marks { words: vec![0; count.div_ceil(64)] }
    }

    /// No marks on as many elements.
    pub(crate) fn blank(&self) -> Self {
        Marks { words: vec![0; self.words.len()] }
    }

    /// Replaces the marks by those of `other`, on as many elements.
    #[inline(always)]
    pub(crate) fn take_over(&mut self, other: &Marks) {
        self.words.copy_from_slice(&other.words);
    }

    /// Marks element `i`, which must exist.
    #[inline(always)]
    pub(crate) fn set(&mut self, i: usize) {
        self.words[i / 64] |= 1 << (i % 64);
    }

    /// Marks all elements, and none beyond the first `count`.
    #[cfg(any(target_arch = "x86_64", test))]
    pub(crate) fn set_all(&mut self, count: usize) {
        self.clear();
        (0..count).for_each(|i| self.set(i));
    }

    /// Removes all marks.
    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.words.fill(0);
    }

    /// Adds the marks of `other`, on as many elements.
    #[inline(always)]
    pub(crate) fn add(&mut self, other: &Marks) {
        for (own, other) in self.words.iter_mut().zip(&other.words) {
            *own |= other;
        }
    }

    /// The marked elements in ascending order.
    #[inline(always)]
    pub(crate) fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.words.iter().enumerate().flat_map(|(word, bits)| {
            let next = |bits: &u64| Some(bits & (bits - 1)).filter(|rest| *rest != 0);
            let left = std::iter::successors(Some(*bits).filter(|bits| *bits != 0), next);
            left.map(move |bits| 64 * word + bits.trailing_zeros() as usize)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_counted_once_and_in_order() {
        let mut marks = Marks::none(130);
        [129, 3, 64, 3, 0, 63].into_iter().for_each(|i| marks.set(i));
        assert_eq!(marks.iter().collect::<Vec<_>>(), [0, 3, 63, 64, 129]);
        let mut other = Marks::none(130);
        other.set(5);
        other.add(&marks);
        assert_eq!(other.iter().collect::<Vec<_>>(), [0, 3, 5, 63, 64, 129]);
        other.set_all(70);
        assert_eq!(other.iter().count(), 70);
        other.clear();
        assert_eq!(other.iter().count(), 0);
    }
}
