//! `occupant sensitivity`.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::base::failure::{Done, Failure};
use crate::base::names::file_name;
use crate::base::output_file::{Existing, PartialFile, refuse_input};
use crate::base::sha256::sha256;
use crate::base::talk::{self, print, say};
use crate::files::export::{metadata, table};
use crate::files::history::UnitChoice;
use crate::files::scenario::{ScenarioArgs, draft, open_draft};
use crate::files::table::Form;
use crate::jobs::sensitivity::{Analysis, Answer, Asked, Words, about, analyse, ask, histories, text};

/// How measures and channels change with numbers of the scenario
///
/// The derivative of the run is computed exactly, in dual numbers, not by differences of runs; it is then held against
/// runs in which the number is changed by up to 1 %, and what limits it (contacts that begin, friction that reverses,
/// belts that go slack) is listed. All numbers are SI, angles in radians. A path to several numbers, such as
/// joints.*.damping, is a factor on all of them.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example: occupant sensitivity cart.toml --to hic15,belts.lap.peak --of joints.neck.damping,materials.seat.k1"
)]
pub(crate) struct Args {
    #[command(flatten)]
    scenario: ScenarioArgs,

    /// Measures of the run, such as hic15,belts.lap.peak; `*` stands for anything
    #[arg(long, value_name = "MEASURES", required_unless_present = "channels")]
    to: Vec<String>,

    /// Numbers of the scenario, by path, such as joints.neck.damping,materials.seat.k1
    #[arg(long, value_name = "PATHS", required = true)]
    of: Vec<String>,

    /// Channels whose derivatives over time are written to -o, such as 'head.acceleration.*'
    #[arg(long, value_name = "NAMES", requires = "output")]
    channels: Vec<String>,

    /// The table of channels and their derivatives: NAME.csv or NAME.parquet
    #[arg(short, long, value_name = "FILE", requires = "channels")]
    output: Option<PathBuf>,

    /// Print all that was found as JSON
    #[arg(long)]
    json: bool,

    /// Replace files that exist
    #[arg(short, long)]
    force: bool,
}

/// Computes and tells the derivatives.
pub(crate) fn sensitivity(args: &Args) -> Result<Done, Failure> {
    let form = args.output.as_deref().map(form).transpose()?;
    let (bytes, base) = draft(&args.scenario)?;
    let opened = open_draft(&args.scenario, bytes, base.clone())?;
    if !opened.warnings.is_empty() {
        say(&format!("{}\n", opened.warnings));
    }
    let folder = args.scenario.scenario.parent().unwrap_or(Path::new(""));
    let resolver = |file: &str| std::fs::read(folder.join(file)).map_err(|error| error.to_string());
    let words = Words { to: &args.to, of: &args.of, channels: &args.channels };
    // names that are taken are told before the work
    let files = begin(args, form)?;
    let asked = ask(&base, &opened.model, &resolver, &words).inspect_err(|_| discard(&files))?;
    let found = analyse(&opened.model, &asked).inspect_err(|_| discard(&files))?;
    let name = file_name(&args.scenario.scenario);
    if let Some(files) = files {
        let sum = sha256(&opened.bytes);
        let source = [name.as_str(), sum.as_str()];
        write(files, args, &opened.model, &asked, &found, source)?;
    }
    let answer = match args.json {
        true => talk::json(&Answer::new(&name, &opened.model, &asked, &found))?,
        false => text(&opened.model, &asked, &found),
    };
    print(&answer)?;
    Ok(Done::Well)
}

fn form(output: &Path) -> Result<Form, Failure> {
    Form::of(output).ok_or_else(|| {
        Failure::with_help(
            format!("-o {}: the ending says nothing of a format", output.display()),
            "end it in .csv or .parquet",
        )
    })
}

/// Files under their provisional names: the table, and what is beside it.
struct Files {
    table: PartialFile,
    /// Of a CSV table.
    beside: Option<PartialFile>,
}

fn begin(args: &Args, form: Option<Form>) -> Result<Option<Files>, Failure> {
    let (Some(output), Some(form)) = (&args.output, form) else {
        return Ok(None);
    };
    let existing = Existing::by(args.force);
    let create = |path: &Path| {
        refuse_input(path, &args.scenario.scenario)
            .and_then(|()| PartialFile::create(path, existing))
            .map_err(|e| Failure::plain(e.to_string()))
    };
    let table = create(output)?;
    let beside = match form {
        Form::Parquet => None,
        Form::Csv => match create(&beside(output)) {
            Ok(file) => Some(file),
            Err(failure) => {
                let _it_may_stay = std::fs::remove_file(table.partial_path());
                return Err(failure);
            }
        },
    };
    Ok(Some(Files { table, beside }))
}

/// Takes away the provisional files of work that came to nothing.
fn discard(files: &Option<Files>) {
    let Some(files) = files else { return };
    for file in [Some(&files.table), files.beside.as_ref()].into_iter().flatten() {
        let _it_may_stay = std::fs::remove_file(file.partial_path());
    }
}

/// `out.csv` → `out.csv-metadata.json`.
fn beside(table: &Path) -> PathBuf {
    let mut name = table.file_name().unwrap_or_default().to_owned();
    name.push("-metadata.json");
    table.with_file_name(name)
}

fn write(
    files: Files,
    args: &Args,
    model: &occupant_core::model::Model,
    asked: &Asked<'_>,
    found: &Analysis,
    source: [&str; 2],
) -> Result<(), Failure> {
    let histories = histories(asked, found);
    let about = about(model, asked, found, source);
    let broke_off = |e: &dyn std::fmt::Display| Failure::BrokeOff(format!("error: {e}"));
    let Files { table: mut file, beside } = files;
    let form = if beside.is_some() { Form::Csv } else { Form::Parquet };
    if let Some(mut beside) = beside {
        let output = args.output.as_deref().unwrap_or(Path::new(""));
        let described = talk::json(&metadata(&about, &file_name(output)))?;
        beside.write_all(described.as_bytes()).map_err(|e| broke_off(&e))?;
        beside.publish().map_err(|e| broke_off(&e))?;
    }
    let bytes = table(&histories, &about, UnitChoice::Si, form).map_err(|e| broke_off(&e))?;
    file.write_all(&bytes).map_err(|e| broke_off(&e))?;
    file.publish().map_err(|e| broke_off(&e))?;
    Ok(())
}
