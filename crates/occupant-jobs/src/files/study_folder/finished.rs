//! Finished samples of a study.

use std::ops::Range;

/// The set of finished samples.
#[derive(Clone, Debug)]
pub struct Finished(Vec<bool>);

impl Finished {
    /// An empty set for `samples` samples.
    pub fn none(samples: u64) -> Self {
        Finished(vec![false; samples as usize])
    }

    /// Adds the samples that belong to the study.
    pub fn add(&mut self, samples: Range<u64>) {
        let most = self.0.len() as u64;
        let [start, end] = [samples.start, samples.end].map(|border| border.min(most) as usize);
        if let Some(finished) = self.0.get_mut(start..end) {
            finished.fill(true);
        }
    }

    /// Whether all samples are finished.
    pub fn is_full(&self) -> bool {
        self.0.iter().all(|finished| *finished)
    }

    /// Whether a sample is finished.
    pub fn has(&self, index: u64) -> bool {
        self.0.get(index as usize).is_some_and(|finished| *finished)
    }

    /// Number of finished samples in a range.
    pub fn count(&self, range: Range<u64>) -> u64 {
        range.filter(|i| self.has(*i)).count() as u64
    }

    /// Unfinished samples of a range, as ranges.
    pub fn gaps(&self, range: Range<u64>) -> Vec<Range<u64>> {
        let mut gaps: Vec<Range<u64>> = Vec::new();
        for index in range.filter(|i| !self.has(*i)) {
            match gaps.last_mut() {
                Some(gap) if gap.end == index => gap.end += 1,
                _ => gaps.push(index..index + 1),
            }
        }
        gaps
    }
}

/// Ranges as text, `3, 7–12`, at most `most` of them.
pub fn ranges_text(ranges: &[Range<u64>], most: usize) -> String {
    let one = |r: &Range<u64>| match r.end - r.start {
        1 => r.start.to_string(),
        _ => format!("{}–{}", r.start, r.end - 1),
    };
    let mut text = ranges.iter().take(most).map(one).collect::<Vec<_>>().join(", ");
    if ranges.len() > most {
        text.push_str(&format!(" and {} more ranges", ranges.len() - most));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_are_what_was_not_added() {
        let mut finished = Finished::none(200);
        for index in (0..200).filter(|i| !(60..70).contains(i) && *i != 199) {
            finished.add(index..index + 1);
        }
        finished.add(1 << 40..1 << 41);
        assert!(!finished.is_full());
        assert!(!finished.has(1 << 40));
        assert_eq!(finished.gaps(0..200), [60..70, 199..200]);
        assert_eq!(finished.gaps(0..65), vec![60..65]);
        assert_eq!(finished.count(0..200), 189);
        assert_eq!(ranges_text(&finished.gaps(0..200), 9), "60–69, 199");
        assert_eq!(ranges_text(&finished.gaps(0..200), 1), "60–69 and 1 more ranges");
    }
}
