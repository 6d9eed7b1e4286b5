//! Histories written to disk: a table with its metadata, or the folder of an ISO-MME test.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::base::{Existing, Failure, PartialFile, begun, file_name, json, refuse_input};
use crate::files::history::{Histories, UnitChoice};
use occupant_files::export::{About, metadata, table};
use occupant_files::table::Form;

/// Files of a table under their temporary names, all created before any is written.
pub struct TableFiles {
    path: PathBuf,
    form: Form,
    table: PartialFile,
    /// Description of a CSV table, `NAME.csv-metadata.json`.
    beside: Option<PartialFile>,
}

impl TableFiles {
    /// Creates the files of a table made from `inputs`.
    ///
    /// # Errors
    /// A name that is taken and may not be replaced, or that of an input.
    pub fn begin(path: &Path, form: Form, inputs: &[PathBuf], existing: Existing) -> Result<Self, Failure> {
        let create = |path: &Path| {
            inputs.iter().try_for_each(|input| refuse_input(path, input))?;
            PartialFile::create(path, existing)
        };
        let table = create(path)?;
        let beside = match form {
            Form::Csv => Some(create(&beside(path))?),
            Form::Parquet | Form::Xlsx | Form::Mat => None,
        };
        Ok(TableFiles { path: path.to_owned(), form, table, beside })
    }

    /// Writes the table and renames the files.
    ///
    /// # Errors
    /// An error of the writer or the file system.
    pub fn write(mut self, histories: &Histories, about: &About, units: UnitChoice) -> Result<(), Failure> {
        let bytes = table(histories, about, units, self.form)
            .map_err(|error| Failure::plain(format!("{} cannot be made: {error}", self.path.display())))?;
        self.table.write_all(&bytes).map_err(|e| unwritten(&self.path, &e))?;
        if let Some(file) = &mut self.beside {
            let description = json(&metadata(about, &file_name(&self.path)))?;
            file.write_all(description.as_bytes()).map_err(|e| unwritten(file.partial_path(), &e))?;
        }
        for file in std::iter::once(self.table).chain(self.beside) {
            file.publish()?;
        }
        Ok(())
    }
}

fn unwritten(path: &Path, error: &std::io::Error) -> Failure {
    Failure::broke_off(format!("cannot write {}: {error}", path.display()))
}

/// `out.csv` → `out.csv-metadata.json`.
fn beside(table: &Path) -> PathBuf {
    let mut name = table.file_name().unwrap_or_default().to_owned();
    name.push("-metadata.json");
    table.with_file_name(name)
}

/// Writes the files of an ISO-MME test into a temporary folder, renamed when complete.
///
/// # Errors
/// A folder that exists and may not be replaced or holds something else; an error of the file system.
pub fn publish_folder(folder: &Path, test: &str, files: &[(PathBuf, String)], force: bool) -> Result<(), Failure> {
    let place = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
    let is_there = || fs::symlink_metadata(&place).is_ok();
    if is_there() {
        refuse_other_folder(&place, test, force)?;
    }
    let (partial, ()) = begun(&place, Existing::by(force), |name| fs::create_dir(name))?;
    let written = write_files(&partial, files).and_then(|()| {
        let replaced = if is_there() { fs::remove_dir_all(&place) } else { Ok(()) };
        replaced.and_then(|()| fs::rename(&partial, &place)).map_err(|e| unwritten(folder, &e))
    });
    written.inspect_err(|_| {
        let _it_may_stay = fs::remove_dir_all(&partial);
    })
}

fn write_files(partial: &Path, files: &[(PathBuf, String)]) -> Result<(), Failure> {
    for (name, text) in files {
        let path = partial.join(name);
        let parent = path.parent().unwrap_or(partial);
        fs::create_dir_all(parent).map_err(|e| unwritten(parent, &e))?;
        let mut file = fs::File::create_new(&path).map_err(|e| unwritten(&path, &e))?;
        let written = file.write_all(text.as_bytes()).and_then(|()| file.sync_all());
        written.map_err(|e| unwritten(&path, &e))?;
    }
    Ok(())
}

/// Refuses to replace a folder unless asked, and unless it is a test of the same name and nothing else.
fn refuse_other_folder(folder: &Path, test: &str, force: bool) -> Result<(), Failure> {
    let name = folder.display();
    if !force {
        return Err(Failure::with_help(format!("{name} exists"), "--force replaces it, -o gives another name"));
    }
    let unreadable = |e: std::io::Error| Failure::plain(format!("{name}: {e}"));
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let found = entry.map_err(unreadable)?.file_name();
        if found != *test && found != "Channel" {
            return Err(Failure::with_help(
                format!(
                    "{name} contains {}, which is not part of an ISO-MME test, and is not replaced",
                    found.to_string_lossy()
                ),
                "-o gives another name",
            ));
        }
    }
    Ok(())
}
