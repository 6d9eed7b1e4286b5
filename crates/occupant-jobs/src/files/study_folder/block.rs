//! A range of samples that one process computes, and the names of its files.

use std::fmt;
use std::ops::Range;

/// Consecutive samples of a study, at least one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// The samples.
    pub samples: Range<u64>,
}

impl Block {
    /// These samples; none without any.
    pub fn new(samples: Range<u64>) -> Option<Block> {
        (!samples.is_empty()).then_some(Block { samples })
    }

    /// Parses `1000..2000`, which ends before 2000, or `1000-1999`, the form of `sweep status --missing`, for a study of `of`
    /// samples.
    ///
    /// # Errors
    /// Problems of it.
    pub fn parse(text: &str, of: u64) -> Result<Block, String> {
        let form = "a range of samples, such as 1000..2000 (up to 1999) or 1000-1999, counted from 0";
        let unread = || format!("`{text}` is not a range; expected {form}");
        let (first, end, more) = match text.split_once("..") {
            Some((first, end)) => (first, end, 0),
            None => text.split_once('-').map(|(first, last)| (first, last, 1)).ok_or_else(unread)?,
        };
        let number = |word: &str| word.trim().parse::<u64>().map_err(|_| unread());
        let (first, end) = (number(first)?, number(end)?.saturating_add(more));
        if end > of {
            return Err(format!("`{text}` ends beyond the study, which has {of} samples; expected {form}"));
        }
        Block::new(first..end).ok_or_else(|| format!("`{text}` has no sample; expected {form}"))
    }

    /// Whether it is all of a study.
    pub fn is_all_of(&self, samples: u64) -> bool {
        self.samples == (0..samples)
    }

    /// Beginning of the names of its files.
    pub fn stem(&self) -> String {
        format!("{:09}-{:09}", self.samples.start, self.samples.end.saturating_sub(1))
    }

    /// The block of a file, by its name.
    pub fn of_file(name: &str) -> Option<Block> {
        let (first, last) = name.split_once('.')?.0.split_once('-')?;
        Block::new(first.parse().ok()?..last.parse::<u64>().ok()?.checked_add(1)?)
    }
}

impl fmt::Display for Block {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "samples {} to {}", self.samples.start, self.samples.end.saturating_sub(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_of_a_range_are_read_and_name_its_files() {
        let block = Block::parse("8..16", 24).unwrap();
        assert_eq!(Block::parse(" 8-15 ", 24), Ok(block.clone()));
        assert_eq!(block.stem(), "000000008-000000015");
        assert_eq!(Block::of_file(&format!("{}.000001.rows", block.stem())), Some(block));
        assert!(Block::parse("0..24", 24).unwrap().is_all_of(24));
        for other in ["notes.txt", "5-3.parquet", "1.rows", "shard-0001-of-0002.rows", "1-18446744073709551615.rows"] {
            assert_eq!(Block::of_file(other), None, "{other}");
        }
    }

    #[test]
    fn what_is_no_range_is_refused_in_words() {
        for (text, said) in [
            ("", "is not a range"),
            ("5", "is not a range"),
            ("a..b", "is not a range"),
            ("..5", "is not a range"),
            ("-1-5", "is not a range"),
            ("5..5", "has no sample"),
            ("7..3", "has no sample"),
            ("7-3", "has no sample"),
            ("0..25", "ends beyond the study, which has 24 samples"),
            ("0-18446744073709551615", "ends beyond the study"),
        ] {
            let refused = Block::parse(text, 24).unwrap_err();
            assert!(refused.contains(said), "{text}: {refused}");
        }
    }
}
