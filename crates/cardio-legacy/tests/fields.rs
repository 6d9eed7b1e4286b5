//! The field rules of FORTRAN IV, one sentence a test.

use cardio_legacy::Rule;
use cardio_legacy::fortran::{FieldError, read_integer, read_real};

fn real(text: &str) -> (f64, String, Vec<Rule>) {
    let reading = read_real(format!("{text:10}").as_bytes()).unwrap_or_else(|error| panic!("`{text}`: {error:?}"));
    (reading.value, reading.digits, reading.surprises)
}

#[test]
fn a_point_overrules_the_format() {
    for (text, value, digits) in [
        ("    386.04", 386.04, "386.04"),
        ("386.04", 386.04, "386.04"),
        ("   -.5", -0.5, "-0.5"),
        ("  +12.50", 12.5, "12.50"),
        ("       12.", 12.0, "12"),
        ("0012.5", 12.5, "12.5"),
        (".123456789", 0.123456789, "0.123456789"),
        ("        0.", 0.0, "0"),
        ("       -0.", -0.0, "-0"),
    ] {
        assert_eq!(real(text), (value, digits.to_owned(), vec![]), "`{text}`");
    }
}

#[test]
fn without_a_point_a_number_counts_from_the_right_end() {
    assert_eq!(real("        12"), (12.0, "12".into(), vec![]));
    assert_eq!(real("12"), (1_200_000_000.0, "1200000000".into(), vec![Rule::LeftJustified]));
    assert_eq!(real("       -5 "), (-50.0, "-50".into(), vec![Rule::LeftJustified]));
}

#[test]
fn blanks_inside_a_number_are_zeros() {
    assert_eq!(real("   1 2.5"), (102.5, "102.5".into(), vec![Rule::EmbeddedBlanks]));
    assert_eq!(real("   1. 5"), (1.05, "1.05".into(), vec![Rule::EmbeddedBlanks]));
    assert_eq!(real("   1 .5"), (10.5, "10.5".into(), vec![Rule::EmbeddedBlanks]));
    assert_eq!(real(" 1.5  "), (1.5, "1.5".into(), vec![]), "behind a fraction they change nothing");
    assert_eq!(real("  -  1.5"), (-1.5, "-1.5".into(), vec![]), "behind a sign they change nothing");
}

#[test]
fn exponents_come_with_e_with_d_and_without_letter() {
    for (text, value) in [
        ("     1.5E3", 1500.0),
        ("    1.5E+3", 1500.0),
        ("    1.5E-3", 0.0015),
        ("    1.5D-3", 0.0015),
        ("    1.5E 3", 1500.0),
        ("   1.5E+03", 1500.0),
        ("      15E3", 15000.0),
    ] {
        assert_eq!(real(text), (value, real(text).1, vec![]), "`{text}`");
    }
    assert_eq!(real("     1.5-3"), (0.0015, "1.5e-3".into(), vec![Rule::BareExponent]));
    assert_eq!(real("     1.5+3"), (1500.0, "1.5e3".into(), vec![Rule::BareExponent]));
    assert_eq!(real("     1.5e3"), (1500.0, "1.5e3".into(), vec![Rule::SmallLetter]));
    assert_eq!(real("    1.5E3 "), (1.5e30, "1.5e30".into(), vec![Rule::LeftJustified]));
}

#[test]
fn an_exponent_at_the_left_of_its_field_is_too_large() {
    assert_eq!(read_real(b"1.5E1     "), Err(FieldError::TooLarge { digits: "1.5e100000".into() }));
    assert_eq!(read_real(b"   1.E+76 "), Err(FieldError::TooLarge { digits: "1e760".into() }));
    assert_eq!(read_real(b"    1.E+76"), Err(FieldError::TooLarge { digits: "1e76".into() }));
    assert_eq!(read_real(b"   7.2E+75").map(|r| r.value), Ok(7.2e75));
}

#[test]
fn numbers_too_small_for_the_machine_are_named() {
    let tiny = real("    1.E-80");
    assert_eq!((tiny.0, tiny.1.as_str()), (0.0, "0"), "as the 360 had it");
    assert_eq!(tiny.2, [Rule::Underflow]);
    assert_eq!(real("   1.E-999").2, [Rule::Underflow], "zero in our arithmetic too");
    assert_eq!(real("    0.E-80").2, []);
    assert_eq!(real("    6.E-79").2, []);
}

#[test]
fn a_blank_field_is_a_zero_that_says_so() {
    let reading = read_real(b"          ").expect("blank");
    assert!(reading.blank);
    assert_eq!((reading.value, reading.digits.as_str()), (0.0, "0"));
    assert!(read_integer(b"  ").expect("blank").blank);
}

#[test]
fn what_is_no_number_says_where() {
    for (text, error) in [
        ("     1.2.3", FieldError::Character { offset: 8, found: b'.' }),
        ("      12,5", FieldError::Character { offset: 8, found: b',' }),
        ("      O.25", FieldError::Character { offset: 6, found: b'O' }),
        ("      1-2-", FieldError::Character { offset: 9, found: b'-' }),
        ("      +-12", FieldError::Character { offset: 7, found: b'-' }),
        ("       1.5E", FieldError::EmptyExponent),
        ("      1.5E+", FieldError::EmptyExponent),
        ("      1.5E ", FieldError::EmptyExponent),
        ("         -", FieldError::NoDigits),
        ("    -     ", FieldError::NoDigits),
        ("       E12", FieldError::Character { offset: 7, found: b'E' }),
        ("  1.5E  -3", FieldError::Character { offset: 8, found: b'-' }),
    ] {
        assert_eq!(read_real(text.as_bytes()), Err(error), "`{text}`");
    }
}

#[test]
fn a_point_alone_is_zero_and_said() {
    for text in [".         ", "    .     ", "         .", "-.        ", "        +."] {
        let reading = read_real(text.as_bytes()).expect("zero");
        assert_eq!((reading.value, reading.blank), (0.0, false), "`{text}`");
        assert_eq!(reading.surprises, [Rule::LonePoint]);
    }
}

#[test]
fn integers_count_from_the_right_end_and_take_no_point() {
    let read = |text: &str| read_integer(text.as_bytes()).map(|r| (r.value, r.surprises));
    assert_eq!(read(" 7"), Ok((7.0, vec![])));
    assert_eq!(read("12"), Ok((12.0, vec![])));
    assert_eq!(read("1 "), Ok((10.0, vec![Rule::LeftJustified])));
    assert_eq!(read("      1000"), Ok((1000.0, vec![])));
    assert_eq!(read("1."), Err(FieldError::Character { offset: 1, found: b'.' }));
    assert_eq!(read("1E"), Err(FieldError::Character { offset: 1, found: b'E' }));
}

#[test]
fn any_field_of_any_bytes_is_read_or_refused() {
    let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = || {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        seed
    };
    let alphabet = b" 0123456789.+-EDed,x\t\x00\xff";
    for _ in 0..200_000 {
        let width = (next() % 12) as usize;
        let field: Vec<u8> = (0..width).map(|_| alphabet[(next() % alphabet.len() as u64) as usize]).collect();
        if let Ok(reading) = read_real(&field) {
            assert!(reading.value.is_finite());
            let again: f64 = reading.digits.parse().expect("digits are a number");
            assert_eq!(again.to_bits(), reading.value.to_bits(), "{field:?}");
        }
        let _ = read_integer(&field);
    }
}
