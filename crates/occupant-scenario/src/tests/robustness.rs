//! Any bytes: an answer or a complaint, never a panic.

use super::super::Draft;
use super::{SHORT, no_files};

/// xorshift64*: small, good enough to wander about, the same on every machine.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n.max(1) as u64) as usize
    }
}

/// Reads, checks, builds; says how far it came.
fn feed(bytes: &[u8]) -> usize {
    let Ok(draft) = Draft::read_bytes(bytes, None, "s") else {
        return 0;
    };
    match draft.load(&no_files) {
        Err(problems) => {
            assert!(!problems.to_string().is_empty());
            1
        }
        Ok(loaded) => match loaded.model() {
            Err(problems) => {
                assert!(!problems.to_string().is_empty());
                2
            }
            Ok(_) => 3,
        },
    }
}

#[test]
fn random_bytes() {
    let mut random = Random(0x5eed);
    for _ in 0..3000 {
        let length = random.below(200);
        let bytes: Vec<u8> = (0..length).map(|_| random.next() as u8).collect();
        feed(&bytes);
    }
}

#[test]
fn random_words_of_the_language() {
    let words = [
        "[",
        "]",
        "{",
        "}",
        "=",
        "\n",
        "\"",
        ",",
        ".",
        "-",
        "1e999",
        "nan",
        "0x7fffffffffffffff",
        "true",
        "\\u0000",
        "é",
        "units",
        "title",
        "path",
        "kind",
        "joints",
        "body",
        "preset",
        "male50",
        "surfaces",
        "\"5 in\"",
        "[[",
        "]]",
        "#",
        "'",
    ];
    let mut random = Random(7);
    for _ in 0..3000 {
        let count = random.below(40);
        let text: Vec<&str> = (0..count).map(|_| words[random.below(words.len())]).collect();
        feed(text.concat().as_bytes());
    }
}

/// One random change of a text.
fn mutated(text: &str, random: &mut Random) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..=random.below(3) {
        let at = random.below(bytes.len());
        match random.below(6) {
            0 => bytes[at] = random.next() as u8,
            1 => {
                bytes.remove(at);
            }
            2 => bytes.insert(at, b"0123456789-.e\"[]{}=,# \nxyz"[random.below(26)]),
            3 => {
                let end = (at + random.below(30)).min(bytes.len());
                bytes.drain(at..end);
            }
            4 => {
                let end = (at + random.below(60)).min(bytes.len());
                let piece = bytes[at..end].to_vec();
                let to = random.below(bytes.len());
                bytes.splice(to..to, piece);
            }
            _ => {
                // Numbers of all sizes, in the place of digits.
                let numbers: [&[u8]; 6] = [b"0", b"-1", b"1e300", b"-1e-300", b"inf", b"99999999999999999999"];
                if let Some(digit) = bytes[at..].iter().position(u8::is_ascii_digit) {
                    let number = numbers[random.below(6)].to_vec();
                    bytes.splice(at + digit..at + digit + 1, number);
                }
            }
        }
        if bytes.is_empty() {
            return bytes;
        }
    }
    bytes
}

#[test]
fn mutations_of_a_valid_scenario() {
    let mut random = Random(0xca11);
    let mut reached = [0; 4];
    for _ in 0..3000 {
        reached[feed(&mutated(SHORT, &mut random))] += 1;
    }
    // Mutants die at every stage, and some live; measured: 2421, 387, 51, 141.
    assert!(reached.iter().all(|n| *n > 20), "{reached:?}");
}

#[test]
fn mutations_of_overrides_and_tables() {
    let mut random = Random(99);
    let csv = "t[ms],x[ft],yaw[deg]\n0,0,0\n100,10,90\n200,20,180\n";
    let text = SHORT.replace(
        "kind = \"pulse\"\nshape = \"half_sine\"\nspeed = \"30 km/h\"\ndelta_v = \"30 km/h\"\nduration = \"100 ms\"",
        "kind = \"table\"\nfile = \"p.csv\"",
    );
    for _ in 0..1000 {
        let mut draft = Draft::read_bytes(text.as_bytes(), None, "s").unwrap();
        let assignment = mutated("joints.*.stop.begin[1].\"a b\"=5 in/s^2", &mut random);
        let _ = draft.set(&String::from_utf8_lossy(&assignment));
        let mut file = mutated(csv, &mut random);
        file.extend(mutated(csv, &mut random));
        if let Ok(loaded) = draft.load(&|_| Ok(file.clone())) {
            let _ = loaded.model();
        }
    }
}

#[test]
fn deep_nesting() {
    for text in ["[", "{", "a.", "a=[", "a={b=", "{\"a\":[", "[[a."] {
        feed(text.repeat(20_000).as_bytes());
    }
    let unit = format!("title = 1\ngravity = \"1 {}\"", "(".repeat(50_000));
    feed(unit.as_bytes());
    let mut draft = Draft::read_bytes(SHORT.as_bytes(), None, "s").unwrap();
    let _ = draft.set(&format!("{}=1", "a.".repeat(20_000) + "b"));
}

/// Time and length of messages grow only linearly with repeated mistakes in a text: before, minutes and megabytes.
#[test]
fn a_megabyte_is_read_in_seconds_and_refused_in_a_few_words() {
    let many = |n: usize, one: &dyn Fn(usize) -> String| SHORT.to_owned() + "\n" + &(0..n).map(one).collect::<String>();
    let surface = |material: &'static str| {
        move |i: usize| {
            format!(
                "q{i} = {{ material = \"{material}\", edge = [[-8, {}], [12, {}]], half_width = 10 }}\n",
                40 + i,
                40 + i
            )
        }
    };
    let surfaces = many(9000, &surface("foam"));
    for (text, stage, said) in [
        (many(60_000, &|i| format!("[x{i}]\na = 1\n")), 1, "and 59950 more errors, not shown"),
        (many(9000, &surface("foan")), 2, "and 8950 more errors, not shown"),
        (surfaces.clone(), 3, ""),
        (surfaces + &many(9000, &surface("foam"))[SHORT.len()..], 0, "duplicate key"),
        (many(1, &|_| format!("a{} = 1", "b".repeat(1_000_000))), 1, "…"),
        (many(1, &|_| format!("a = {}", "[1,".repeat(300_000))), 0, ""),
        (
            SHORT.replace("{ material", &format!("{{ spheres = [{}], material", "\"xxx\",".repeat(60_000))),
            2,
            "more errors",
        ),
    ] {
        let from = std::time::Instant::now();
        let found =
            Draft::read_bytes(text.as_bytes(), None, "s").and_then(|d| d.load(&no_files)).and_then(|l| l.model());
        let words = found.map_or_else(|problems| problems.to_string(), |_| String::new());
        assert!(words.len() < 80_000 && words.contains(said), "{}", words.chars().take(2000).collect::<String>());
        assert_eq!(stage == 3, words.is_empty());
        assert!(from.elapsed().as_secs() < 20, "{:?} for stage {stage}: {said}", from.elapsed());
    }
}

#[test]
fn what_speaks_to_a_terminal_is_written_out() {
    let words = Draft::read_bytes(b"title = \"a\"\n\"\\u001b[31m\\u202e\" = 1\ngravity = \"\\u0007\"", None, "s\u{1b}");
    let words = words.unwrap().check().to_string();
    assert!(words.contains("unknown key `\\u001b[31m\\u202e`"), "{words}");
    assert!(words.lines().all(|line| !line.chars().any(char::is_control)), "{words}");
}
