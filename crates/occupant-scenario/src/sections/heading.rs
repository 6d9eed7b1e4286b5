//! Headings of recorders, in words: "Delta-V, longitudinal" is what `dvx` is.

/// A thing that headings speak of, and the words that they have for it.
type Sense = (char, &'static [&'static str]);

/// What is measured, which way, and words that say neither.
const SENSES: [Sense; 12] = [
    ('t', &["time", "t", "zeit", "temps"]),
    ('d', &["delta", "deltav", "dv", "change", "cumulative"]),
    ('v', &["v", "velocity", "speed"]),
    ('a', &["acceleration", "accel", "acc", "a"]),
    ('w', &["rate", "angular", "omega", "gyro"]),
    ('x', &["longitudinal", "long", "x", "xpos"]),
    ('y', &["lateral", "lat", "y", "ypos"]),
    ('z', &["vertical", "vert", "z", "zpos"]),
    ('p', &["roll"]),
    ('q', &["pitch"]),
    ('r', &["yaw", "heading"]),
    (' ', &["in", "of", "the", "vehicle", "cg", "event", "crash", "position", "angle", "axis", "direction"]),
];

/// The senses of a heading, sorted, and the column that they mean.
const COLUMNS: [(&str, &str); 26] = [
    ("t", "t"),
    ("x", "x"),
    ("y", "y"),
    ("z", "z"),
    ("p", "roll"),
    ("q", "pitch"),
    ("r", "yaw"),
    ("a", "a"),
    ("ax", "ax"),
    ("ay", "ay"),
    ("az", "az"),
    ("wx", "wx"),
    ("wy", "wy"),
    ("wz", "wz"),
    ("pw", "wx"),
    ("qw", "wy"),
    ("rw", "wz"),
    ("pvw", "wx"),
    ("qvw", "wy"),
    ("rvw", "wz"),
    ("d", "dvx"),
    ("dv", "dvx"),
    ("dx", "dvx"),
    ("dvx", "dvx"),
    ("dy", "dvy"),
    ("dvy", "dvy"),
];

/// The column of a path's table that a heading means, if every word of it is known.
pub fn heading(text: &str) -> Option<&'static str> {
    let text = text.to_lowercase();
    let words = text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let sense = |word: &str| SENSES.iter().find(|(_, names)| names.contains(&word)).map(|(sense, _)| *sense);
    let mut senses: Vec<char> = words.map(sense).collect::<Option<_>>()?;
    senses.retain(|sense| *sense != ' ');
    senses.sort_unstable();
    senses.dedup();
    let senses: String = senses.into_iter().collect();
    COLUMNS.iter().find(|(of, _)| *of == senses).map(|(_, column)| *column)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_of_recorders_mean_columns() {
        for (text, column) in [
            ("Time", Some("t")),
            ("Delta-V longitudinal", Some("dvx")),
            ("Cumulative Delta V, Lateral", Some("dvy")),
            ("longitudinal delta-v", Some("dvx")),
            ("DeltaV", Some("dvx")),
            ("Change in velocity", Some("dvx")),
            ("Lateral Acceleration", Some("ay")),
            ("Accel X", Some("ax")),
            ("Yaw rate", Some("wz")),
            ("angular velocity roll", Some("wx")),
            ("Vehicle speed", None),
            ("Engine rpm", None),
            ("", None),
        ] {
            assert_eq!(heading(text), column, "{text}");
        }
        assert!(COLUMNS.iter().all(|(senses, _)| senses.chars().is_sorted()));
    }
}
