//! Headings of recorders: "Delta-V, longitudinal" means `dvx`.

use occupant_units::unit::{Dimension, Unit};

/// Quantities in headings, and the words for them.
type Sense = (&'static str, &'static [&'static str]);

/// The quantity, the direction, words for both, and words that carry no information: English, German, French, Spanish,
/// romanised Japanese, without accents ([`folded`]).
#[rustfmt::skip]
const SENSES: [Sense; 26] = [
    ("t", &["time", "t", "zeit", "zeitpunkt", "temps", "tiempo", "tempo", "times", "jikan", "jikoku"]),
    ("d", &["delta", "deltav", "dv", "δv", "δ", "change", "cumulative", "cumulated", "cum", "anderung", "aenderung", "kumuliert",
        "kumulierte", "kumulativ", "variation", "cumulee", "cumule", "cambio", "variacion", "acumulado", "acumulada", "henka", "henkaryo", "ruiseki",
        "deruta"]),
    ("v", &["v", "velocity", "speed", "vitesse", "velocidad", "geschwindigkeit", "geschw", "vel", "fahrzeuggeschwindigkeit", "fahrgeschwindigkeit",
        "sokudo", "sharyosokudo", "shasoku"]),
    ("dv", &["geschwindigkeitsanderung", "geschwindigkeitsaenderung", "sokudohenka"]),
    ("a", &["acceleration", "accel", "acc", "a", "beschleunigung", "beschl", "aceleracion", "accelerometer", "kasokudo"]),
    ("w", &["rate", "angular", "omega", "gyro", "winkelgeschwindigkeit", "drehrate"]),
    ("x", &["longitudinal", "long", "x", "xpos", "xo", "xcg", "langs", "laengs", "langsrichtung", "laengsrichtung", "longitudinale",
        "zengo"]),
    ("y", &["lateral", "lat", "y", "ypos", "yo", "ycg", "quer", "querrichtung", "laterale", "transversal", "transversale", "sayu",
        "sayuu"]),
    ("z", &["vertical", "vert", "z", "zpos", "zo", "zcg", "vertikal", "verticale", "joge", "jouge"]),
    ("p", &["roll", "phi", "wanken", "wankwinkel", "rollwinkel", "roulis"]),
    ("q", &["pitch", "theta", "nicken", "nickwinkel", "tangage"]),
    ("r", &["yaw", "psi", "heading", "gier", "gieren", "gierwinkel", "lacet"]),
    ("vx", &["vx"]),
    ("vy", &["vy"]),
    ("ax", &["ax", "accx", "xacc", "longacc", "langsbeschl", "langsbeschleunigung", "laengsbeschleunigung"]),
    ("ay", &["ay", "accy", "yacc", "latacc", "querbeschl", "querbeschleunigung"]),
    ("az", &["az", "accz", "zacc", "vertacc", "vertikalbeschleunigung", "hochbeschleunigung"]),
    ("wx", &["wx", "avx", "gyrox", "omegax"]),
    ("wy", &["wy", "avy", "gyroy", "omegay"]),
    ("wz", &["wz", "avz", "gyroz", "omegaz"]),
    ("pw", &["rollrate", "wankrate"]),
    ("qw", &["pitchrate", "nickrate"]),
    ("rw", &["yawrate", "gierrate"]),
    ("dvx", &["dvx", "δvx", "deltavx"]),
    ("dvy", &["dvy", "δvy", "deltavy"]),
    ("", &["in", "of", "the", "vehicle", "cg", "event", "crash", "position", "angle", "axis", "direction", "sensor", "center",
        "centre", "tm", "pulse", "sdm", "recorded", "indicated", "pre", "precrash", "gravity", "cog", "c", "g", "vehicle's", "car",
        "body", "chassis", "raw", "filtered", "channel", "der", "des", "schwerpunkt", "richtung", "fzg", "kfz", "veh", "ryo", "ryou", "fahrzeug", "angezeigt", "angezeigte",
        "de", "du", "la", "le", "l", "vehicule", "indiquee", "direccion", "del", "el", "vehiculo", "indicada", "houkou", "hoko",
        "sharyo", "sharyou", "no"]),
];

/// Meaning that the unit of a column adds to its words: `X (g)` is an acceleration, `Roll (deg/s)` a rate.
const BY_UNIT: [(Unit, [&str; 3], &str); 3] = [
    (Unit::MetrePerSecondSquared, ["x", "y", "z"], "a"),
    (Unit::RadianPerSecond, ["x", "y", "z"], "w"),
    (Unit::RadianPerSecond, ["p", "q", "r"], "w"),
];

/// The meanings of a heading, sorted, and the column that they denote.
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

/// The column of a path's table that a heading denotes, if every word of it is known.
pub fn heading(text: &str) -> Option<&'static str> {
    column_of(&senses(text)?)
}

/// Whether a heading means the speed of the vehicle.
pub fn speed_named(text: &str) -> bool {
    senses(text).is_some_and(|senses| senses == "v")
}

/// The same for a column whose unit has this dimension, which resolves ambiguous words; none if unit and words
/// contradict.
pub fn heading_in(text: &str, measured: Dimension) -> Option<&'static str> {
    let rates = [("p", "wx"), ("q", "wy"), ("r", "wz")];
    if let Some((_, rate)) = rates.iter().find(|(name, _)| text.trim().eq_ignore_ascii_case(name)) {
        return (measured == Unit::RadianPerSecond.dimension()).then_some(rate);
    }
    let mut senses = senses(text)?;
    let open =
        |(unit, axes, _): &&(Unit, [&str; 3], &str)| unit.dimension() == measured && axes.contains(&senses.as_str());
    if let Some((.., what)) = BY_UNIT.iter().find(open) {
        senses = sorted(&(senses + what));
    }
    column_of(&senses).filter(|column| dimension(column) == measured)
}

/// The quantity of a column.
fn dimension(column: &str) -> Dimension {
    match column {
        "t" => Unit::Second,
        "x" | "y" | "z" => Unit::Metre,
        "roll" | "pitch" | "yaw" => Unit::Radian,
        "wx" | "wy" | "wz" => Unit::RadianPerSecond,
        "dvx" | "dvy" => Unit::MetrePerSecond,
        _ => Unit::MetrePerSecondSquared,
    }
    .dimension()
}

/// Text in small letters without accents, for comparison of words: `Längs` and `La\u{308}ngs` are `langs`.
pub fn folded(text: &str) -> String {
    const PLAIN: [(&str, &str); 14] = [
        ("äàâáãå", "a"),
        ("éèêë", "e"),
        ("íìîïī", "i"),
        ("öóòôõō", "o"),
        ("üúùûū", "u"),
        ("ā", "a"),
        ("ē", "e"),
        ("ñ", "n"),
        ("ç", "c"),
        ("ß", "ss"),
        ("œ", "oe"),
        ("æ", "ae"),
        ("ÿ", "y"),
        ("∆", "δ"),
    ];
    let mut plain = String::with_capacity(text.len());
    // accents that stand alone are left out
    for c in text.chars().flat_map(char::to_lowercase).filter(|c| !('\u{300}'..='\u{36f}').contains(c)) {
        match PLAIN.iter().find(|(of, _)| of.contains(c)) {
            Some((_, letters)) => plain.push_str(letters),
            None => plain.push(c),
        }
    }
    plain
}

/// The meanings of a heading, sorted; none if a word is unknown. Numbers of channels and filter classes are ignored.
fn senses(text: &str) -> Option<String> {
    let text = folded(text);
    let words = text.split(|c: char| !(c.is_alphanumeric() || c == '\'')).filter(|word| !word.is_empty());
    let says_nothing = |word: &str| word.strip_prefix("cfc").unwrap_or(word).bytes().all(|b| b.is_ascii_digit());
    let sense = |word: &str| match says_nothing(word) {
        true => Some(""),
        false => SENSES.iter().find(|(_, names)| names.contains(&word)).map(|(sense, _)| *sense),
    };
    words.map(sense).collect::<Option<String>>().map(|senses| sorted(&senses))
}

fn sorted(senses: &str) -> String {
    let mut senses: Vec<char> = senses.chars().collect();
    senses.sort_unstable();
    senses.dedup();
    senses.into_iter().collect()
}

fn column_of(senses: &str) -> Option<&'static str> {
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
            ("Longitudinal Crash Pulse Delta-V", Some("dvx")),
            ("SDM Recorded Vehicle Velocity Change", Some("dvx")),
            ("Change in velocity", Some("dvx")),
            ("Lateral Acceleration", Some("ay")),
            ("Accel X", Some("ax")),
            ("Yaw rate", Some("wz")),
            ("angular velocity roll", Some("wx")),
            ("CG Ax", Some("ax")),
            ("Längsbeschl.", Some("ax")),
            ("Delta-V quer", Some("dvy")),
            ("PHI", Some("roll")),
            ("THETA", Some("pitch")),
            ("PSI", Some("yaw")),
            ("AVz", Some("wz")),
            ("Xcg_TM", Some("x")),
            ("ΔVx", Some("dvx")),
            ("∆v längs", Some("dvx")),
            ("Geschwindigkeitsänderung in Querrichtung", Some("dvy")),
            ("Variation de vitesse latérale", Some("dvy")),
            ("Variación de velocidad longitudinal", Some("dvx")),
            ("Sokudo henka (zengo)", Some("dvx")),
            ("Zengo kasokudo", Some("ax")),
            ("Jikan", Some("t")),
            ("La\u{308}ngsbeschl.", Some("ax")),
            ("vx", None),
            ("Vehicle speed", None),
            ("Engine rpm", None),
            ("", None),
        ] {
            assert_eq!(heading(text), column, "{text}");
        }
        for text in ["Fahrzeuggeschwindigkeit", "Vitesse du véhicule", "Velocidad del vehículo", "Sharyō sokudo"] {
            assert!(speed_named(text), "{text}");
        }
        assert!(speed_named("Vehicle speed") && speed_named("Speed, Vehicle Indicated") && !speed_named("Delta-V"));
        assert!(COLUMNS.iter().all(|(senses, _)| senses.chars().is_sorted()));
    }

    #[test]
    fn the_unit_settles_what_words_leave_open() {
        let of = |text: &str, unit: Unit| heading_in(text, unit.dimension());
        assert_eq!(of("CG X", Unit::MetrePerSecondSquared), Some("ax"));
        assert_eq!(of("X", Unit::MetrePerSecondSquared), Some("ax"));
        assert_eq!(of("X", Unit::Metre), Some("x"));
        assert_eq!(of("Yaw", Unit::RadianPerSecond), Some("wz"));
        assert_eq!(of("Gyro Z", Unit::RadianPerSecond), Some("wz"));
        assert_eq!(of("Yaw", Unit::Radian), Some("yaw"));
        assert_eq!(of("R", Unit::RadianPerSecond), Some("wz"));
        assert_eq!(of("ax", Unit::Metre), None);
        assert_eq!(of("Accel X CFC60", Unit::MetrePerSecondSquared), Some("ax"));
        assert_eq!(of("Vehicle speed", Unit::MetrePerSecond), None);
        assert_eq!(of("Head X", Unit::MetrePerSecondSquared), None);
    }
}
