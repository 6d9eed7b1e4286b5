//! Nearest of several words to a misspelt one.

/// The candidate most like `word`, if any is near enough to be meant: at most a third of the letters differ, or only
/// upper and lower case. The first of several equally near ones; else the only one that contains the word; else the
/// first whose dotted parts begin with those of the word: `head.acc.x` means `head.acceleration.x`.
pub fn nearest<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let candidates: Vec<&str> = candidates.collect();
    alike(word, candidates.iter().copied()).or_else(|| {
        let mut longer = candidates.iter().filter(|c| word.len() > 3 && c.contains(word));
        let only = longer.next().filter(|_| longer.next().is_none()).copied();
        only.or_else(|| candidates.into_iter().find(|c| abbreviates(word, c)))
    })
}

/// Whether each dotted part of `word`, of two or more, begins the same part of `whole`.
fn abbreviates(word: &str, whole: &str) -> bool {
    let (short, long): (Vec<_>, Vec<_>) = (word.split('.').collect(), whole.split('.').collect());
    let begins = |(s, l): (&&str, &&str)| s.len() > 1 && l.starts_with(s) || s == l;
    short.len() > 1 && short.len() == long.len() && short.iter().zip(&long).all(begins)
}

fn alike<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let plain = plain(word);
    let limit = plain.chars().count().clamp(2, 60) / 3;
    candidates
        .map(|candidate| (distance(&plain, &self::plain(candidate)), candidate))
        .filter(|(d, _)| *d <= limit.max(1))
        .min_by_key(|(d, _)| *d)
        .filter(|(d, candidate)| *d == 0 || plain.chars().count() > 2 || candidate.len() > 2)
        .map(|(_, candidate)| candidate)
}

/// Distance of optimal string alignment: insertions, deletions, substitutions and swaps of neighbours, each position at
/// most once.
fn distance(one: &str, other: &str) -> usize {
    let other: Vec<char> = other.chars().collect();
    let (mut before, mut row): (Vec<usize>, Vec<usize>) = (Vec::new(), (0..=other.len()).collect());
    let mut last = None;
    for (i, a) in one.chars().enumerate() {
        let mut next = vec![i + 1];
        for (j, b) in other.iter().enumerate() {
            let mut least = (row[j] + usize::from(a != *b)).min(row[j + 1] + 1).min(next[j] + 1);
            if j > 0 && last == Some(*b) && other[j - 1] == a {
                least = least.min(before[j - 1] + 1);
            }
            next.push(least);
        }
        (before, row, last) = (row, next, Some(a));
    }
    row[other.len()]
}

/// Letters in lower case, `-` and blanks as `_`.
fn plain(word: &str) -> String {
    word.chars().take(80).flat_map(char::to_lowercase).map(|c| if c == '-' || c == ' ' { '_' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn abbreviated_parts_are_completed() {
        let names = ["head.rotation.resultant", "head.acceleration.resultant", "head.acceleration.x"];
        let nearest = |word| nearest(word, names.into_iter());
        assert_eq!(nearest("head.acc.resultant"), Some("head.acceleration.resultant"));
        assert_eq!(nearest("head.acc"), None);
        assert_eq!(nearest("head..resultant"), None);
    }

    #[test]
    fn letters_are_counted() {
        let all = [
            ("", "", 0),
            ("ab", "", 2),
            ("abc", "abc", 0),
            ("firction", "friction", 1),
            ("ca", "abc", 3),
            ("äb", "bä", 1),
        ];
        for (one, other, count) in all {
            assert_eq!([distance(one, other), distance(other, one)], [count; 2], "{one} {other}");
        }
    }

    #[test]
    fn finds_what_was_meant_and_nothing_else() {
        let names = ["damping", "stop", "twist_damping", "k1", "k2", "friction"];
        let find = |word| nearest(word, names.into_iter());
        assert_eq!(find("dampng"), Some("damping"));
        assert_eq!(find("Damping"), Some("damping"));
        assert_eq!(find("twist-damping"), Some("twist_damping"));
        assert_eq!(find("firction"), Some("friction"));
        assert_eq!(find("K1"), Some("k1"));
        assert_eq!(find("twist"), Some("twist_damping"));
        assert_eq!(find("colour"), None);
        assert_eq!(find(""), None);
    }
}
