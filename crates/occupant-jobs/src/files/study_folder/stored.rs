//! A sweep in an object store: what the folder on this machine fetches from there, and puts there.
//!
//! The store has manifest, copies, parts and the whole runs of finished ranges under the names of a folder. Journals and what
//! else is not finished stay on this machine.

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, ErrorKind};
use std::path::Path;

use super::block::Block;
use super::folder::{Folder, PARTS, RUNS};
use super::manifest::Manifest;
use super::part::Part;
use super::problem::Problem;
use crate::base::{Existing, Failure, file_name, remove_if_there, write_whole};
use crate::files::store::{Store, place};

impl Folder {
    /// The folder of a sweep that a user gave, or the one on this machine for an address, with what the store says of the sweep.
    ///
    /// # Errors
    /// An address that cannot be opened or read.
    pub fn given(given: &Path, scratch: Option<&Path>) -> Result<Folder, Failure> {
        let (path, store) = place(given, scratch)?;
        let mut folder = Folder::at(&path);
        folder.store = store;
        folder.fetch_manifest()?;
        Ok(folder)
    }

    /// As the user gave it.
    pub fn shown(&self) -> String {
        self.store.as_ref().map_or_else(|| self.path.display().to_string(), |store| store.address().to_owned())
    }

    fn said(&self) -> impl Fn(io::Error) -> Problem {
        |found| Problem::Store { address: self.shown(), found }
    }

    /// The manifest of the store, if it has one.
    fn stored_manifest(&self, store: &Store) -> Result<Option<(Vec<u8>, Manifest)>, Failure> {
        let bytes = match store.get(&file_name(&self.manifest_path())) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            got => got.map_err(self.said())?,
        };
        let no_manifest = |error: serde_json::Error| {
            let name = file_name(&self.manifest_path());
            io::Error::new(ErrorKind::InvalidData, format!("its {name} is none of a sweep: {error}"))
        };
        let manifest = serde_json::from_slice(&bytes).map_err(|error| self.said()(no_manifest(error)))?;
        Ok(Some((bytes, manifest)))
    }

    /// Fetches manifest and copies, unless those here are the same.
    fn fetch_manifest(&self) -> Result<(), Failure> {
        let Some(store) = &self.store else { return Ok(()) };
        let Some((bytes, manifest)) = self.stored_manifest(store)? else { return Ok(()) };
        if fs::read(self.manifest_path()).is_ok_and(|here| here == bytes) {
            return Ok(());
        }
        for text in manifest.texts.iter().filter(|text| crate::base::names::stays_within(&text.copy)) {
            let copy = store.get(&text.copy).map_err(self.said())?;
            self.write(&text.copy, &copy)?;
        }
        self.write(&file_name(&self.manifest_path()), &bytes)
    }

    fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        let path = self.path.join(name);
        let parent = path.parent().unwrap_or(&self.path);
        fs::create_dir_all(parent).map_err(Problem::io("create", parent))?;
        write_whole(&path, Existing::Replace, bytes)?;
        Ok(())
    }

    /// The parts that the store has.
    ///
    /// # Errors
    /// What the store says; a file that is no part of this study.
    pub(super) fn stored_parts(&self, study: &str) -> Result<Vec<Part>, Problem> {
        let Some(store) = &self.store else { return Ok(Vec::new()) };
        let listed = store.list(PARTS).map_err(self.said())?;
        let is_part = |name: &str| Block::of_file(name).is_some() && name.ends_with(".parquet");
        let parts = listed.into_iter().filter(|(name, _)| is_part(name));
        let parts: Vec<_> = parts.map(|(name, size)| (format!("{PARTS}/{name}"), size)).collect();
        Part::in_store(self, store, &parts, study)
    }

    /// Whether the store has the part of a range; it looks at no other.
    ///
    /// # Errors
    /// What the store says.
    pub fn has_stored(&self, block: &Block) -> Result<bool, Failure> {
        let Some(store) = &self.store else { return Ok(false) };
        Ok(store.has(&format!("{PARTS}/{}", file_name(&self.part(block)))).map_err(self.said())?)
    }

    /// Puts the part of a finished range into the store, after the whole runs that belong to it, and removes them here.
    ///
    /// # Errors
    /// What the store says; a file that cannot be read.
    pub fn put_part(&self, block: &Block, manifest: &Manifest, runs: &BTreeMap<String, String>) -> Result<(), Failure> {
        let Some(store) = &self.store else { return Ok(()) };
        self.put_manifest(store, manifest)?;
        let part = self.part(block);
        let names: Vec<String> = runs.keys().cloned().chain([format!("{PARTS}/{}", file_name(&part))]).collect();
        for name in &names {
            // one that is there has the same bits
            store.put_new(name, &self.path.join(name)).map_err(self.said())?;
        }
        names.iter().try_for_each(|name| remove_if_there(&self.path.join(name)))?;
        // runs that belong to no row, such as those of a keep that has changed, stay
        let _stays = fs::remove_dir(self.path.join(RUNS));
        Ok(())
    }

    /// Puts copies and manifest into the store, the manifest last, unless those of as many samples are there.
    fn put_manifest(&self, store: &Store, manifest: &Manifest) -> Result<(), Failure> {
        if self.stored_manifest(store)?.is_some_and(|(_, there)| there.samples >= manifest.samples) {
            return Ok(());
        }
        for text in &manifest.texts {
            store.put(&text.copy, self.copy_of(text)?).map_err(self.said())?;
        }
        let bytes = fs::read(self.manifest_path()).map_err(Problem::io("read", &self.manifest_path()))?;
        Ok(store.put(&file_name(&self.manifest_path()), bytes).map_err(self.said())?)
    }
}
