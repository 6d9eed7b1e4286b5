//! Files of an object store, by their names below the address.

use std::fs;
use std::io::{self, ErrorKind};
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use futures_util::TryStreamExt;
use object_store::path::Path as Key;
use object_store::{Error, ObjectStore, ObjectStoreExt, PutMode, PutOptions, PutPayload, parse_url_opts};
use tokio::runtime::{Builder, Runtime};

use super::FORMS;
use crate::base::Failure;

/// An object store at an address. Keys and tokens are those of the environment, as the tools of its maker name them.
#[derive(Clone, Debug)]
pub struct Store(Arc<Opened>);

#[derive(Debug)]
struct Opened {
    address: String,
    prefix: Key,
    store: Box<dyn ObjectStore>,
    runtime: Runtime,
}

impl Store {
    /// Opens it, without a look at it.
    ///
    /// # Errors
    /// An address that is none; settings of the environment that are none.
    pub fn open(address: &str) -> Result<Store, Failure> {
        let refused = |error: &dyn std::fmt::Display| Failure::with_help(format!("{address}: {error}"), FORMS);
        let url = address.trim_end_matches('/').parse().map_err(|error| refused(&error))?;
        // no setting has other text than Unicode
        let settings = std::env::vars_os()
            .filter_map(|(name, value)| Some((name.to_str()?.to_ascii_lowercase(), value.into_string().ok()?)));
        let (store, prefix) = parse_url_opts(&url, settings).map_err(|error| refused(&error))?;
        let runtime = Builder::new_current_thread().enable_all().build().map_err(|error| refused(&error))?;
        let address = address.trim_end_matches('/').to_owned();
        Ok(Store(Arc::new(Opened { address, prefix, store, runtime })))
    }

    /// The address.
    pub fn address(&self) -> &str {
        &self.0.address
    }

    fn key(&self, name: &str) -> Key {
        name.split('/').fold(self.0.prefix.clone(), |key, part| key.join(part))
    }

    fn said(&self, error: Error) -> io::Error {
        let kind = match &error {
            Error::NotFound { .. } => ErrorKind::NotFound,
            Error::AlreadyExists { .. } | Error::Precondition { .. } => ErrorKind::AlreadyExists,
            Error::PermissionDenied { .. } | Error::Unauthenticated { .. } => ErrorKind::PermissionDenied,
            _ => ErrorKind::Other,
        };
        io::Error::new(kind, format!("{}: {error}", self.0.address))
    }

    /// Names below a folder, and sizes in bytes, sorted.
    ///
    /// # Errors
    /// What the store says.
    pub fn list(&self, folder: &str) -> io::Result<Vec<(String, u64)>> {
        let Opened { store, runtime, .. } = &*self.0;
        let folder = self.key(folder);
        let all =
            runtime.block_on(store.list(Some(&folder)).try_collect::<Vec<_>>()).map_err(|error| self.said(error))?;
        let name = |key: &Key| key.filename().map(str::to_owned);
        let mut all: Vec<_> = all.into_iter().filter_map(|file| Some((name(&file.location)?, file.size))).collect();
        all.sort();
        Ok(all)
    }

    /// Whether a file is there.
    ///
    /// # Errors
    /// What the store says.
    pub fn has(&self, name: &str) -> io::Result<bool> {
        let Opened { store, runtime, .. } = &*self.0;
        match runtime.block_on(store.head(&self.key(name))).map_err(|error| self.said(error)) {
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
            found => found.map(|_| true),
        }
    }

    /// Some bytes of a file.
    ///
    /// # Errors
    /// What the store says.
    pub fn range(&self, name: &str, bytes: Range<u64>) -> io::Result<Vec<u8>> {
        let Opened { store, runtime, .. } = &*self.0;
        let key = self.key(name);
        runtime.block_on(store.get_range(&key, bytes)).map(Vec::from).map_err(|error| self.said(error))
    }

    /// All bytes of a file.
    ///
    /// # Errors
    /// What the store says.
    pub fn get(&self, name: &str) -> io::Result<Vec<u8>> {
        let Opened { store, runtime, .. } = &*self.0;
        let key = self.key(name);
        let got = runtime.block_on(async { store.get(&key).await?.bytes().await });
        got.map(Vec::from).map_err(|error| self.said(error))
    }

    /// Writes a file, whole or not at all, in place of another.
    ///
    /// # Errors
    /// What the store says.
    pub fn put(&self, name: &str, bytes: Vec<u8>) -> io::Result<()> {
        self.put_as(name, bytes, PutMode::Overwrite)
    }

    /// Writes a file, whole or not at all, unless it is there; whether it was not.
    ///
    /// # Errors
    /// What the store says; a file that cannot be read.
    pub fn put_new(&self, name: &str, from: &Path) -> io::Result<bool> {
        match self.put_as(name, fs::read(from)?, PutMode::Create) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => Ok(false),
            put => put.map(|()| true),
        }
    }

    fn put_as(&self, name: &str, bytes: Vec<u8>, mode: PutMode) -> io::Result<()> {
        let Opened { store, runtime, .. } = &*self.0;
        let (key, bytes) = (self.key(name), PutPayload::from(bytes));
        let put = runtime.block_on(store.put_opts(&key, bytes, PutOptions::from(mode)));
        put.map(|_| ()).map_err(|error| self.said(error))
    }
}
