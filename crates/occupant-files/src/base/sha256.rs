//! Hash of the content of a file.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use sha2::{Digest, Sha256};

/// Number of bytes read at a time.
const AT_ONCE: usize = 1 << 16;

/// SHA-256 in hexadecimal.
pub fn sha256(bytes: &[u8]) -> String {
    in_hexadecimal(&Sha256::digest(bytes))
}

/// SHA-256 of a file of any size, in hexadecimal.
///
/// # Errors
/// An error of the operating system.
pub fn sha256_of_file(path: &Path) -> io::Result<String> {
    let mut hash = Sha256::new();
    each_portion(&mut File::open(path)?, |bytes| hash.update(bytes))?;
    Ok(in_hexadecimal(&hash.finalize()))
}

/// Passes a file on in portions.
///
/// # Errors
/// An error of the operating system.
pub fn each_portion(file: &mut impl Read, mut see: impl FnMut(&[u8])) -> io::Result<()> {
    let mut portion = vec![0; AT_ONCE];
    loop {
        match file.read(&mut portion)? {
            0 => return Ok(()),
            count => see(&portion[..count]),
        }
    }
}

fn in_hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// FIPS 180-4, the example "abc".
    #[test]
    fn the_published_digest_comes_out() {
        assert_eq!(sha256(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }

    #[test]
    fn a_file_has_the_digest_of_its_bytes() {
        let there = tempfile::tempdir().unwrap();
        let path = there.path().join("file");
        for length in [0, 1, AT_ONCE, AT_ONCE + 1, 3 * AT_ONCE + 7] {
            let bytes: Vec<u8> = (0..length).map(|i| (i * i) as u8).collect();
            std::fs::write(&path, &bytes).unwrap();
            assert_eq!(sha256_of_file(&path).unwrap(), sha256(&bytes));
        }
    }
}
