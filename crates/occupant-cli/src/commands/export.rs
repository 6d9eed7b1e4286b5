//! `occupant export`.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use super::flags::history::{HistoryArgs, code_letter};
use crate::base::failure::{Done, Failure};
use crate::base::names::{file_name, program};
use crate::base::output_file::{Existing, FileProblem, PartialFile, refuse_input};
use crate::base::talk::{json, say};
use crate::files::export::{About, metadata, table};
use crate::files::history::{Filter, Histories, UnitChoice, choose, load};
use crate::files::mme::{Labels, files};
use crate::files::results::Results;
use crate::files::table::Form;

/// Write a run's time histories as CSV, Parquet or ISO-MME
///
/// The ending of the output decides. CSV: one table, units in its headings; what the columns are stands beside it in
/// NAME.csv-metadata.json. Parquet: the same table, its metadata inside. ISO-MME: NAME.mme becomes the folder NAME with
/// NAME.mme and its channels, in SI units and SAE J211 axes, of all channels that the standard's dictionary has a code for.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The results of `occupant run`
    #[arg(value_name = "RUN.mcap")]
    run: PathBuf,

    /// The file to write: NAME.csv, NAME.parquet or NAME.mme
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// Channels by name or pattern, such as 'head.*,belt.*'; all if absent
    #[arg(long, value_name = "NAMES")]
    channels: Vec<String>,

    #[command(flatten)]
    treatment: HistoryArgs,

    /// Interval of the samples, such as '1 ms'; that of the outputs if absent. Values between outputs lie on straight lines
    #[arg(long, value_name = "TIME")]
    interval: Option<String>,

    /// Units of CSV and Parquet
    #[arg(long, value_name = "SYSTEM", default_value = "si")]
    units: UnitChoice,

    /// Position of the occupant in ISO-MME codes: 1 front left, 3 front right, 4 to 9 behind
    #[arg(long, value_name = "CODE", default_value = "1", value_parser = code_letter)]
    seat: char,

    /// Occupant in ISO-MME codes (fine location 3), such as H3; 00 is not defined
    #[arg(long, value_name = "CODE", default_value = "00", value_parser = code_pair)]
    dummy: String,

    /// Replace files that exist
    #[arg(short, long)]
    force: bool,
}

/// Kinds of output.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Table(Form),
    Mme,
}

pub(crate) fn export(args: &Args) -> Result<Done, Failure> {
    let kind = kind(&args.output)?;
    let treatment = args.treatment.treatment(args.interval.as_deref())?;
    let results = Results::open(&args.run)?;
    let channels = choose(&results.model, &args.channels)?;
    let histories = load(&results, channels, treatment)?;
    for note in &histories.notes {
        say(&format!("note: {note}"));
    }
    let Kind::Table(form) = kind else {
        return export_mme(args, &results, &histories);
    };
    let family = args.treatment.family_name();
    let coefficients = (treatment.filter != Filter::None).then_some(family);
    let words = treatment.filter.words();
    let about = About::new(&results, &histories, args.units, words, coefficients);
    let bytes = table(&histories, &about, args.units, form)
        .map_err(|e| Failure::plain(format!("{} cannot be made: {e}", args.output.display())))?;
    if form == Form::Parquet {
        write_file(args, &args.output, &bytes)?;
        return Ok(Done::Well);
    }
    let beside = beside(&args.output);
    let name = file_name(&args.output);
    let about_text = json(&metadata(&about, &name))?;
    // both names must be free before one is taken
    let mut described = begin(args, &beside)?;
    write_file(args, &args.output, &bytes)?;
    let written = described.write_all(about_text.as_bytes());
    written.map_err(|e| Failure::BrokeOff(format!("error: cannot write {}: {e}", beside.display())))?;
    described.publish().map_err(|e| problem(&e))?;
    Ok(Done::Well)
}

fn kind(output: &Path) -> Result<Kind, Failure> {
    let ending = output.extension().and_then(|e| e.to_str()).unwrap_or_default();
    if ending.eq_ignore_ascii_case("mme") {
        return Ok(Kind::Mme);
    }
    Form::of(output).map(Kind::Table).ok_or_else(|| {
        Failure::with_help(
            format!("-o {}: the ending says nothing of a format", output.display()),
            "end it in .csv, .parquet or .mme",
        )
    })
}

/// `out.csv` → `out.csv-metadata.json`.
fn beside(table: &Path) -> PathBuf {
    let mut name = table.file_name().unwrap_or_default().to_owned();
    name.push("-metadata.json");
    table.with_file_name(name)
}

fn begin(args: &Args, path: &Path) -> Result<PartialFile, Failure> {
    refuse_input(path, &args.run).map_err(|e| problem(&e))?;
    PartialFile::create(path, Existing::by(args.force)).map_err(|e| problem(&e))
}

fn write_file(args: &Args, path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let mut file = begin(args, path)?;
    file.write_all(bytes).map_err(|e| Failure::BrokeOff(format!("error: cannot write {}: {e}", path.display())))?;
    file.publish().map_err(|e| problem(&e))?;
    Ok(())
}

fn problem(problem: &FileProblem) -> Failure {
    Failure::plain(problem.to_string())
}

fn export_mme(args: &Args, results: &Results, histories: &Histories) -> Result<Done, Failure> {
    let name = args.output.file_stem().and_then(|n| n.to_str());
    let name = name.ok_or_else(|| Failure::plain("-o: the name of an ISO-MME test must be text"))?;
    let mut remarks = vec![
        format!("result file {}, SHA-256 {}", file_name(&args.run), results.sha256),
        format!("filter: {}", args.treatment.words()),
    ];
    remarks.extend(histories.notes.iter().cloned());
    let labels = Labels {
        name: name.to_owned(),
        title: results.loaded.scenario.title.clone(),
        program: program(),
        seat: args.seat,
        dummy: args.dummy.clone(),
        remarks,
    };
    let (files, without) = files(&results.model, histories, &labels)
        .map_err(|reason| Failure::plain(format!("{} cannot be made: {reason}", args.output.display())))?;
    let folder = args.output.with_extension("");
    publish_folder(args, &folder, &files)?;
    say(&format!("wrote {} channels: {}", files.len() - 2, folder.join(format!("{name}.mme")).display()));
    if !without.is_empty() {
        let shown: Vec<&str> = without.iter().take(4).map(String::as_str).collect();
        let more = if without.len() > 4 { ", …" } else { "" };
        say(&format!("left out {} channels that ISO-MME has no code for: {}{more}", without.len(), shown.join(", ")));
    }
    Ok(Done::Well)
}

/// Writes the files into a provisional folder and gives it its name when all are there.
fn publish_folder(args: &Args, folder: &Path, files: &[(PathBuf, String)]) -> Result<(), Failure> {
    let mut partial = folder.as_os_str().to_owned();
    partial.push(".partial");
    let partial = PathBuf::from(partial);
    if fs::symlink_metadata(folder).is_ok() {
        refuse_other_folder(args, folder)?;
    }
    if fs::symlink_metadata(&partial).is_ok() {
        match args.force {
            true => remove(&partial)?,
            false => {
                return Err(Failure::with_help(
                    format!("{} exists, of an export that was interrupted", partial.display()),
                    "--force replaces it, -o gives another name",
                ));
            }
        }
    }
    let failed =
        |path: &Path, e: std::io::Error| Failure::BrokeOff(format!("error: cannot write {}: {e}", path.display()));
    for (name, text) in files {
        let path = partial.join(name);
        let parent = path.parent().unwrap_or(&partial);
        fs::create_dir_all(parent).map_err(|e| failed(parent, e))?;
        let mut file = fs::File::create_new(&path).map_err(|e| failed(&path, e))?;
        let written = file.write_all(text.as_bytes()).and_then(|()| file.sync_all());
        written.map_err(|e| failed(&path, e))?;
    }
    if fs::symlink_metadata(folder).is_ok() {
        remove(folder)?;
    }
    fs::rename(&partial, folder).map_err(|e| failed(folder, e))
}

/// A folder that stands there is replaced only if asked, and only if it is a test of the same name and nothing else.
fn refuse_other_folder(args: &Args, folder: &Path) -> Result<(), Failure> {
    let name = folder.display();
    if !args.force {
        return Err(Failure::with_help(format!("{name} exists"), "--force replaces it, -o gives another name"));
    }
    let mme = file_name(&args.output);
    let listed = fs::read_dir(folder).map_err(|e| Failure::plain(format!("{name}: {e}")))?;
    for entry in listed {
        let entry = entry.map_err(|e| Failure::plain(format!("{name}: {e}")))?;
        let found = entry.file_name();
        if found != *mme && found != "Channel" {
            return Err(Failure::with_help(
                format!("{name} holds {}, no part of an ISO-MME test, and is not replaced", found.to_string_lossy()),
                "-o gives another name",
            ));
        }
    }
    Ok(())
}

fn remove(folder: &Path) -> Result<(), Failure> {
    fs::remove_dir_all(folder).map_err(|e| Failure::plain(format!("{} cannot be replaced: {e}", folder.display())))
}

fn code_pair(text: &str) -> Result<String, String> {
    let fits = |c: u8| c.is_ascii_digit() || c.is_ascii_uppercase();
    match text.len() == 2 && text.bytes().all(fits) {
        true => Ok(text.to_owned()),
        false => Err("expected two digits or capitals".to_owned()),
    }
}
