//! Which of several words was meant by a misspelt one.

/// The candidate most like `word`, if any is near enough to be meant: at most a third of the letters differ, or only
/// upper and lower case. The first of several equally near ones; else the only one that contains the word.
pub fn nearest<'a>(word: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let candidates: Vec<&str> = candidates.collect();
    alike(word, candidates.iter().copied()).or_else(|| {
        let mut longer = candidates.iter().filter(|c| word.len() > 3 && c.contains(word));
        longer.next().filter(|_| longer.next().is_none()).copied()
    })
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

/// How many letters must be put in, left out, changed or exchanged with their neighbour to make one word of another, each place at
/// most once: the distance of optimal string alignment.
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
