//! Files of an object store, by their names below the address.

use std::error::Error as _;
use std::fs;
use std::future::Future;
use std::io::{self, ErrorKind};
use std::ops::Range;
use std::path::Path;
use std::str::FromStr;
use std::sync::Arc;
use std::thread::sleep;
use std::time::Duration;

use futures_util::TryStreamExt;
use futures_util::future::try_join_all;
use object_store::path::Path as Key;
use object_store::{Error, ObjectStore, ObjectStoreExt, PutMode, PutOptions, PutPayload, parse_url_opts};
use tokio::runtime::{Builder, Runtime};
use tokio::time::timeout;

use super::FORMS;
use crate::base::Failure;

/// What the names of settings begin with. Others, such as TOKEN or BUCKET, are meant for other programs.
const SETTINGS: [&str; 3] = ["AWS_", "AZURE_", "GOOGLE_"];
/// The longest that a store may take to answer a question, with all that is tried again meanwhile.
const LONGEST: Duration = Duration::from_secs(90);
/// Pauses before a file is sent again.
const PAUSES: [Duration; 3] = [Duration::from_secs(1), Duration::from_secs(10), Duration::from_secs(30)];

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
        let address = address.trim_end_matches('/');
        let refused = |error: &dyn std::fmt::Display| Failure::with_help(format!("{address}: {error}"), FORMS);
        let url = address.parse().map_err(|error| refused(&error))?;
        let mut settings = Vec::new();
        for (name, value) in std::env::vars_os() {
            let Some(name) = name.to_str().filter(|name| SETTINGS.iter().any(|begin| name.starts_with(begin))) else {
                continue;
            };
            settings.push((name.to_ascii_lowercase(), setting(name, value.to_str(), &url)?));
        }
        let (store, prefix) = parse_url_opts(&url, settings).map_err(|error| match error {
            Error::Generic { store: "Config", .. } | Error::UnknownConfigurationKey { .. } => Failure::with_help(
                format!("{address}: {error}"),
                "mend that variable of the environment: its name begins with AWS_, AZURE_ or GOOGLE_",
            ),
            error => refused(&error),
        })?;
        let runtime = Builder::new_current_thread().enable_all().build().map_err(|error| refused(&error))?;
        Ok(Store(Arc::new(Opened { address: address.to_owned(), prefix, store, runtime })))
    }

    /// The address.
    pub fn address(&self) -> &str {
        &self.0.address
    }

    fn key(&self, name: &str) -> Key {
        name.split('/').fold(self.0.prefix.clone(), |key, part| key.join(part))
    }

    /// The answer of the store to a question.
    fn ask<T>(&self, question: impl Future<Output = Result<T, Error>>) -> io::Result<T> {
        let none = || {
            let words = format!("it gave no answer within {} s", LONGEST.as_secs());
            io::Error::new(ErrorKind::TimedOut, words)
        };
        // the clock belongs to the runtime
        let answer = self.0.runtime.block_on(async { timeout(LONGEST, question).await });
        answer.map_err(|_| none())?.map_err(|error| said(&error))
    }

    /// Names below a folder, and sizes in bytes, sorted.
    ///
    /// # Errors
    /// What the store says.
    pub fn list(&self, folder: &str) -> io::Result<Vec<(String, u64)>> {
        let folder = self.key(folder);
        let mut listed = self.0.store.list(Some(&folder));
        let mut all = Vec::new();
        while let Some(file) = self.ask(listed.try_next())? {
            all.extend(file.location.filename().map(|name| (name.to_owned(), file.size)));
        }
        all.sort();
        Ok(all)
    }

    /// Whether a file is there.
    ///
    /// # Errors
    /// What the store says.
    pub fn has(&self, name: &str) -> io::Result<bool> {
        match self.ask(self.0.store.head(&self.key(name))) {
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
            found => found.map(|_| true),
        }
    }

    /// Some bytes of a file.
    ///
    /// # Errors
    /// What the store says.
    pub fn range(&self, name: &str, bytes: Range<u64>) -> io::Result<Vec<u8>> {
        self.ask(self.0.store.get_range(&self.key(name), bytes)).map(Vec::from)
    }

    /// Some bytes of each of these files, all asked for at the same time.
    ///
    /// # Errors
    /// What the store says.
    pub fn ranges(&self, wanted: &[(&str, Range<u64>)]) -> io::Result<Vec<Vec<u8>>> {
        let of = |(name, bytes): &(&str, Range<u64>)| {
            let (key, bytes) = (self.key(name), bytes.clone());
            async move { self.0.store.get_range(&key, bytes).await.map(Vec::from) }
        };
        self.ask(try_join_all(wanted.iter().map(of)))
    }

    /// All bytes of a file.
    ///
    /// # Errors
    /// What the store says.
    pub fn get(&self, name: &str) -> io::Result<Vec<u8>> {
        let key = self.key(name);
        self.ask(async { self.0.store.get(&key).await?.bytes().await }).map(Vec::from)
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

    /// Sends a file, again where the store is overloaded or the line broke: what was computed is worth a wait. A file that the
    /// store got although the line broke is there the next time.
    fn put_as(&self, name: &str, bytes: Vec<u8>, mode: PutMode) -> io::Result<()> {
        let Opened { store, runtime, .. } = &*self.0;
        let (key, bytes) = (self.key(name), PutPayload::from(bytes));
        let send = || {
            let put = runtime.block_on(store.put_opts(&key, bytes.clone(), PutOptions::from(mode.clone())));
            put.map(|_| ()).map_err(|error| said(&error))
        };
        let mut put = send();
        for pause in PAUSES {
            if !put.as_ref().is_err_and(|error| error.kind() == ErrorKind::Other) {
                break;
            }
            sleep(pause);
            put = send();
        }
        put
    }
}

/// The value of a setting, without white space around it, as files of keys have it; `like` shows what an address is.
fn setting<U: FromStr + AsRef<str>>(name: &str, value: Option<&str>, _like: &U) -> Result<String, Failure> {
    let refused = |found: &str, mend: &str| Failure::with_help(format!("the environment's {name} {found}"), mend);
    let value = value.ok_or_else(|| refused("is no Unicode", "set it anew"))?.trim();
    // certificates and accounts as JSON have several lines
    let is_line = !value.starts_with('{') && !value.starts_with("-----BEGIN");
    if is_line && !value.chars().all(|c| c.is_ascii_graphic() || c == ' ') {
        return Err(refused(
            "has other characters than printable ASCII",
            "set it anew, without quotes and line breaks",
        ));
    }
    if !name.contains("ENDPOINT") || value.is_empty() {
        return Ok(value.to_owned());
    }
    let is_web = |url: &U| url.as_ref().starts_with("http://") || url.as_ref().starts_with("https://");
    let url = value.parse().ok().filter(is_web);
    let form = "give an address such as https://s3.example.org or http://127.0.0.1:9000";
    let url = url.ok_or_else(|| refused(&format!("is `{value}`, which is no address"), form))?;
    Ok(url.as_ref().trim_end_matches('/').to_owned())
}

/// What a store says, with the cause at the bottom of it, and of a page of XML its message.
fn said(error: &Error) -> io::Error {
    let mut words = error.to_string();
    let mut cause = error.source();
    while let Some(deeper) = cause.and_then(|cause| cause.source()) {
        cause = Some(deeper);
    }
    let cause = cause.map(ToString::to_string).filter(|cause| !words.contains(cause.as_str()));
    let tagged = |tag: &str| {
        let (_, after) = words.split_once(&format!("<{tag}>"))?;
        Some(after.split_once(&format!("</{tag}>"))?.0.to_owned())
    };
    let (code, message) = (tagged("Code").unwrap_or_default(), tagged("Message").unwrap_or_default());
    if let Some(page) = words.find("<?xml").filter(|_| !code.is_empty()) {
        words.truncate(page);
        words += &format!("{code}: {message}");
    }
    words.extend(cause.map(|cause| format!(": {cause}")));
    let kind = match error {
        // without a bucket no file of it can be missing
        Error::NotFound { .. } if ["NoSuchBucket", "ContainerNotFound"].contains(&&*code) => ErrorKind::InvalidInput,
        Error::NotFound { .. } => ErrorKind::NotFound,
        Error::AlreadyExists { .. } | Error::Precondition { .. } => ErrorKind::AlreadyExists,
        Error::PermissionDenied { .. } | Error::Unauthenticated { .. } => ErrorKind::PermissionDenied,
        // where machines of a provider get their keys
        _ if words.contains("//169.254.169.254/") || words.contains("//metadata") => ErrorKind::PermissionDenied,
        _ => ErrorKind::Other,
    };
    io::Error::new(kind, words)
}
