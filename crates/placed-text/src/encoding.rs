//! The bytes of a table as text, whatever wrote them: UTF-8, UTF-16, or the one-byte code of Western Europe.

/// Characters of the bytes 0x80 to 0x9f in Windows-1252; the others are those of Latin-1.
const UPPER: &str = "€\u{81}‚ƒ„…†‡ˆ‰Š‹Œ\u{8d}Ž\u{8f}\u{90}‘’“”•–—˜™š›œ\u{9d}žŸ";

/// Text of a table, and the name of its encoding if it is not UTF-8. The byte-order mark is removed, and lines end with
/// a line feed.
///
/// # Errors
/// Bytes that are no text.
pub fn decoded(bytes: &[u8]) -> Result<(String, Option<&'static str>), String> {
    let (text, name) = of_code(bytes)?;
    // lines of old Macs end with a carriage return alone
    let is_old = text.contains('\r') && !text.contains('\n');
    Ok((if is_old { text.replace('\r', "\n") } else { text }, name))
}

fn of_code(bytes: &[u8]) -> Result<(String, Option<&'static str>), String> {
    match bytes {
        [0xff, 0xfe, 0, 0, ..] | [0, 0, 0xfe, 0xff, ..] => {
            return Err("UTF-32 text: neither UTF-8, UTF-16 nor Windows-1252".to_owned());
        }
        [0xef, 0xbb, 0xbf, rest @ ..] => return of_code(rest),
        [0xff, 0xfe, rest @ ..] => return wide(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => return wide(rest, u16::from_be_bytes),
        _ => {}
    }
    let head = &bytes[..bytes.len().min(512) & !1];
    let zeros = |odd: usize| head.iter().skip(odd).step_by(2).filter(|b| **b == 0).count();
    match (4 * zeros(0) > head.len(), 4 * zeros(1) > head.len()) {
        (true, false) => return wide(bytes, u16::from_be_bytes),
        (false, true) => return wide(bytes, u16::from_le_bytes),
        _ => {}
    }
    if let Ok(text) = std::str::from_utf8(bytes) {
        return Ok((text.to_owned(), None));
    }
    let is_text = |b: &u8| *b >= 0x20 || matches!(b, b'\t' | b'\n' | b'\r' | 0x0c | 0x1a);
    match bytes.iter().position(|b| !is_text(b)) {
        Some(at) => Err(format!("byte 0x{:02x} at {at}: neither UTF-8, UTF-16 nor Windows-1252 text", bytes[at])),
        None => Ok((bytes.iter().map(|b| letter(*b)).collect(), Some("Windows-1252"))),
    }
}

fn wide(bytes: &[u8], number: fn([u8; 2]) -> u16) -> Result<(String, Option<&'static str>), String> {
    if bytes.len() % 2 == 1 {
        return Err(format!("{} bytes of UTF-16, an odd number: neither UTF-8 nor UTF-16 text", bytes.len()));
    }
    let units = bytes.chunks_exact(2).map(|pair| number([pair[0], pair[1]]));
    let text: Result<String, _> = char::decode_utf16(units).collect();
    text.map(|text| (text, Some("UTF-16"))).map_err(|error| format!("not UTF-8, and as UTF-16 {error}"))
}

fn letter(byte: u8) -> char {
    match byte {
        0x80..=0x9f => UPPER.chars().nth(usize::from(byte - 0x80)).unwrap_or('\u{fffd}'),
        _ => char::from(byte),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_table_is_read_from_every_encoding() {
        let text = "Zeit [ms];Längsbeschl. [g];Drehrate [°/s]\r\n0;1;2\r\n";
        let utf16 = |mark: bool, bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
            let mark = mark.then_some(0xfeff);
            mark.into_iter().chain(text.encode_utf16()).flat_map(bytes).collect()
        };
        let latin: Vec<u8> = text.chars().map(|c| c as u32 as u8).collect();
        let marked = [&b"\xef\xbb\xbf"[..], text.as_bytes()].concat();
        for (bytes, name) in [
            (text.as_bytes().to_vec(), None),
            (marked, None),
            (latin, Some("Windows-1252")),
            (utf16(true, u16::to_le_bytes), Some("UTF-16")),
            (utf16(true, u16::to_be_bytes), Some("UTF-16")),
            (utf16(false, u16::to_le_bytes), Some("UTF-16")),
            (utf16(false, u16::to_be_bytes), Some("UTF-16")),
        ] {
            assert_eq!(decoded(&bytes), Ok((text.to_owned(), name)));
        }
        assert_eq!(UPPER.chars().count(), 32);
        assert_eq!(decoded(b"\x80 5").unwrap().0, "€ 5");
        assert_eq!(decoded(b"").unwrap().0, "");
        assert_eq!(decoded(b"t;x\r0;1\r").unwrap().0, "t;x\n0;1\n");
    }

    #[test]
    fn what_is_no_text_is_refused() {
        assert!(decoded(&[0xff, 0xfe, 0x00]).unwrap_err().contains("not UTF-8") || decoded(&[0xff, 0xfe, 0]).is_err());
        assert!(decoded(&[0x89, b'P', b'N', b'G', 0x0d, 0x01, 0x00, 0x1b]).is_err());
        assert!(decoded(&[0xff, 0xfe, 0x00, 0xd8]).is_err());
        assert!(decoded(&[0xff, 0xfe, 0, 0, b't', 0, 0, 0]).unwrap_err().contains("UTF-32"));
    }
}
