//! Where results go and come from: a folder, or an object store such as S3, which needs the feature `object-store`.

#[cfg(feature = "object-store")]
mod remote;
#[cfg(not(feature = "object-store"))]
mod without;

use std::path::{Path, PathBuf};

#[cfg(feature = "object-store")]
pub use remote::Store;
#[cfg(not(feature = "object-store"))]
pub use without::Store;

use crate::base::{Failure, sha256};

/// Forms of an address.
const SCHEMES: [&str; 4] = ["s3", "gs", "az", "file"];
const FORMS: &str = "give s3://BUCKET/PREFIX, gs://BUCKET/PREFIX, az://CONTAINER/PREFIX or file:///FOLDER, or a folder";

/// What a user gave for a folder: that folder, or for an address a store, and a folder on this machine for what is not finished.
///
/// # Errors
/// An address that is none, or that this build cannot open; a folder for scratch beside a folder.
pub fn place(given: &Path, scratch: Option<&Path>) -> Result<(PathBuf, Option<Store>), Failure> {
    let Some((address, scheme)) = address(given) else {
        return match scratch {
            None => Ok((given.to_owned(), None)),
            Some(_) => Err(Failure::with_help(
                "--scratch beside a folder",
                "give it with an address such as s3://BUCKET/PREFIX",
            )),
        };
    };
    if !SCHEMES.contains(&scheme) {
        return Err(Failure::with_help(format!("{address} is no address of an object store"), FORMS));
    }
    let store = Store::open(address)?;
    let usual = || std::env::temp_dir().join("occupant").join(&sha256(address.trim_end_matches('/').as_bytes())[..16]);
    Ok((scratch.map_or_else(usual, Path::to_owned), Some(store)))
}

/// An address and its scheme; none of a path.
fn address(given: &Path) -> Option<(&str, &str)> {
    let text = given.to_str()?;
    let (scheme, _) = text.split_once("://")?;
    let is_scheme = !scheme.is_empty() && scheme.chars().all(|c| c.is_ascii_alphanumeric());
    is_scheme.then_some((text, scheme))
}

/// Whether a path is the address of a store.
pub fn is_address(given: &Path) -> bool {
    address(given).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_no_address_and_what_looks_like_one_is_refused_in_words() {
        for folder in ["out", "/tmp/a b", "a:/b", "C:\\x", "://x", "a b://c"] {
            let (path, store) = place(Path::new(folder), None).unwrap();
            assert!(path == Path::new(folder) && store.is_none(), "{folder}");
        }
        let refused = |given: &str, scratch: Option<&str>| {
            let found = place(Path::new(given), scratch.map(Path::new));
            found.map(|_| ()).unwrap_err().words()
        };
        assert!(refused("out", Some("there")).contains("--scratch"));
        assert!(refused("http://host/x", None).contains("is no address of an object store"));
        #[cfg(not(feature = "object-store"))]
        assert!(refused("s3://bucket/x", None).contains("feature `object-store`"));
        #[cfg(feature = "object-store")]
        assert!(refused("s3://", None).contains("s3://"), "{}", refused("s3://", None));
    }
}
