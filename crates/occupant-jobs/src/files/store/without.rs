//! An object store of a build that has none.

use std::convert::Infallible;
use std::io;
use std::ops::Range;
use std::path::Path;

use crate::base::Failure;

/// None can be opened.
#[derive(Clone, Debug)]
pub struct Store(Infallible);

impl Store {
    /// Refuses.
    ///
    /// # Errors
    /// The feature that this build lacks.
    pub fn open(address: &str) -> Result<Store, Failure> {
        let help = "build it with `cargo install occupant-cli --features object-store`, or sweep into a folder";
        Err(Failure::with_help(format!("{address}: this build lacks the feature `object-store`"), help))
    }

    /// The address.
    pub fn address(&self) -> &str {
        match self.0 {}
    }

    /// Names and sizes of the files below a folder.
    ///
    /// # Errors
    /// None.
    pub fn list(&self, _folder: &str) -> io::Result<Vec<(String, u64)>> {
        match self.0 {}
    }

    /// Whether a file is there.
    ///
    /// # Errors
    /// None.
    pub fn has(&self, _name: &str) -> io::Result<bool> {
        match self.0 {}
    }

    /// Some bytes of a file.
    ///
    /// # Errors
    /// None.
    pub fn range(&self, _name: &str, _bytes: Range<u64>) -> io::Result<Vec<u8>> {
        match self.0 {}
    }

    /// Some bytes of each of these files.
    ///
    /// # Errors
    /// None.
    pub fn ranges(&self, _wanted: &[(&str, Range<u64>)]) -> io::Result<Vec<Vec<u8>>> {
        match self.0 {}
    }

    /// All bytes of a file.
    ///
    /// # Errors
    /// None.
    pub fn get(&self, _name: &str) -> io::Result<Vec<u8>> {
        match self.0 {}
    }

    /// Writes a file in place of another.
    ///
    /// # Errors
    /// None.
    pub fn put(&self, _name: &str, _bytes: Vec<u8>) -> io::Result<()> {
        match self.0 {}
    }

    /// Writes a file unless it is there.
    ///
    /// # Errors
    /// None.
    pub fn put_new(&self, _name: &str, _from: &Path) -> io::Result<bool> {
        match self.0 {}
    }
}
