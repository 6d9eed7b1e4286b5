//! `occupant seal`.

use std::path::{Path, PathBuf};

use crate::base::{
    Done, Failure, deliver, file_name, input_file, is_page, print, program, publish, refuse_input, say, sha256,
};
use occupant_jobs::seal::{Beside, Case, Part, Same, Sealed, again, seal as sealed};
use occupant_jobs::sweep::stored::{MadeBy, open as open_study};

/// Seal a run with its inputs in one HTML file, or verify such a file
///
/// The page opens offline. It lists every value that was set, all files with their SHA-256 and the motion every 1/20 s, and
/// carries them. The run is made again first: it is sealed only if the same bits come out. Limit 5 MB; results beyond that
/// are left out, with the SHA-256 of every output in their place.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The results of `occupant run`; with --verify or --extract the sealed case
    #[arg(value_name = "RUN.mcap|CASE.html")]
    file: PathBuf,

    /// The sealed case; RUN.sealed.html beside the run if absent
    #[arg(short, long, value_name = "FILE.html", conflicts_with_all = ["verify", "extract"])]
    output: Option<PathBuf>,

    /// Add a file: a picture or film (PNG, GIF or MP4, shown on the page), tables and texts (shown as text). May be repeated
    #[arg(long, value_name = "FILE", conflicts_with_all = ["verify", "extract"])]
    add: Vec<PathBuf>,

    /// Quote a study of the scenario: quantiles with their intervals and paragraphs of its results stand on the page. The folder
    /// of `occupant sweep`; repeat it for shards
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["verify", "extract"])]
    study: Vec<PathBuf>,

    /// Compare every byte of the case with its seal, and name what was altered; exit code 1 then
    #[arg(long)]
    verify: bool,

    /// With --verify: run the case again with this program and compare to the bit
    #[arg(long, requires = "verify", conflicts_with_all = ["output", "add", "study"])]
    again: bool,

    /// Write the parts of the case into a new folder
    #[arg(long, value_name = "FOLDER")]
    extract: Option<PathBuf>,

    /// Replace an existing file
    #[arg(short, long)]
    force: bool,
}

pub(crate) fn seal(args: &Args) -> Result<Done, Failure> {
    if args.verify || args.extract.is_some() { open(args) } else { write(args) }
}

fn write(args: &Args) -> Result<Done, Failure> {
    let output = args.output.clone().unwrap_or_else(|| args.file.with_extension("sealed.html"));
    if !is_page(&output) {
        return Err(Failure::ending(&output, ".html"));
    }
    std::iter::once(&args.file).chain(&args.add).try_for_each(|input| refuse_input(&output, input))?;
    let bytes = input_file::read(&args.file)?;
    let added =
        args.add.iter().map(|file| Ok(Part::new(&format!("added/{}", file_name(file)), input_file::read(file)?)));
    let added = added.collect::<Result<Vec<_>, Failure>>()?;
    let study = if args.study.is_empty() { None } else { Some(open_study(&args.study, MadeBy::AnyProgram)?) };
    let Sealed { bytes: case, holds_run } = sealed((&args.file, &bytes), &build()?, Beside { added, study }, None)?;
    deliver(&output, args.force, &case)?;
    if !holds_run {
        say(
            "note: the results are not in the case, which would be larger than 5 MB with them; it has the SHA-256 of every output, and --verify --again compares them",
        );
    }
    print(&format!("SHA-256   {}\nsize      {:.2} MB\n", sha256(&case), case.len() as f64 / 1e6))?;
    Ok(Done::Well)
}

/// Program, platform and the hash of the executable.
fn build() -> Result<String, Failure> {
    let own = std::env::current_exe().and_then(std::fs::read);
    let own = own.map_err(|e| Failure::plain(format!("this program's own file cannot be read: {e}")))?;
    let (system, machine) = (std::env::consts::OS, std::env::consts::ARCH);
    Ok(format!("{}, {system} {machine}, executable SHA-256 {}", program(), sha256(&own)))
}

fn open(args: &Args) -> Result<Done, Failure> {
    let bytes = input_file::read(&args.file)?;
    let case = Case::read(&bytes)?;
    for fault in &case.faults {
        say(&format!("error: altered: {} (bytes {} to {})", fault.name, fault.start, fault.end));
    }
    if !case.faults.is_empty() {
        return Ok(Done::Unwell);
    }
    let parts = case.parts()?;
    if let Some(folder) = &args.extract {
        extract(folder, &parts, args.force)?;
    }
    print(&format!("every byte of {} is as sealed\nSHA-256   {}\n", args.file.display(), sha256(&bytes)))?;
    if args.again { run_again(&bytes, &parts) } else { Ok(Done::Well) }
}

fn extract(folder: &Path, parts: &[Part], force: bool) -> Result<(), Failure> {
    for part in parts {
        let path = folder.join(&part.name);
        let made = path.parent().map_or(Ok(()), std::fs::create_dir_all);
        made.map_err(|e| Failure::broke_off(format!("cannot write {}: {e}", path.display())))?;
        publish(&path, force, &part.bytes)?;
    }
    say(&format!("wrote {} files into {}; run `resolved.toml` there", parts.len(), folder.display()));
    Ok(())
}

fn run_again(bytes: &[u8], parts: &[Part]) -> Result<Done, Failure> {
    let build = build()?;
    if !String::from_utf8_lossy(bytes).contains(&build) {
        say(&format!("note: the case was sealed by another build; this is {build}"));
    }
    match again(parts)? {
        Same::Yes(outputs) => {
            print(&format!("run again: all {outputs} outputs are the same to the bit\n")).map(|()| Done::Well)
        }
        Same::No(why) => {
            say(&format!("error: run again, it is another run: {why}"));
            Ok(Done::Unwell)
        }
    }
}
