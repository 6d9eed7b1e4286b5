//! `occupant export`.

use std::path::{Path, PathBuf};

use super::flags::history::{code_letter, interval};
use crate::base::input_file::is_input;
use crate::base::{Existing, Failure, deliver, ending, file_name, note, print_file, program, refuse_input, say};
use occupant_files::export::{About, table};
use occupant_files::mme::{Labels, files};
use occupant_files::results::Results;
use occupant_files::table::Form;
use occupant_jobs::export::{TableFiles, publish_folder};
use occupant_jobs::files::history::{AxisChoice, Filter, Histories, Treatment, UnitChoice, choose, family_name, load};
use occupant_jobs::files::scenario::inputs;
use occupant_jobs::files::study_folder::StudyTable;
use occupant_jobs::sweep::results::refuse_gaps;
use occupant_jobs::sweep::stored::{MadeBy, Stored, open};
use occupant_pictures::gltf::glb;

/// Export a run as CSV, Parquet, XLSX, MAT or ISO-MME, or its motion as glTF
///
/// The file extension sets the format:
///
/// .csv: one table with units in its headings; NAME.csv-metadata.json describes the columns.
///
/// .parquet: the same table with the descriptions inside.
///
/// .xlsx: the same table, with sheets for the measures and for the descriptions.
///
/// .mat: one variable per channel, such as head_acceleration_x, and the structures measures, columns and about.
///
/// .mme: an ISO-MME folder NAME, in SI units and SAE J211 axes, with all channels that have an ISO-MME code.
///
/// .glb: a glTF scene of the moving body, surfaces and solids, without belts, for Blender and the web.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The results of `occupant run`, or the folder of a sweep, to export its table of samples
    #[arg(value_name = "RUN.mcap")]
    run: PathBuf,

    /// The file to write; `-` writes CSV to standard output; RUN.csv beside the run if absent
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Channels by name or pattern, such as 'head.*,belt.*'; all if absent
    #[arg(long = "channel", alias = "channels", value_name = "NAMES")]
    channels: Vec<String>,

    #[command(flatten)]
    treatment: Treatment,

    /// Sample interval, such as '1 ms', interpolated linearly; that of the outputs if absent
    #[arg(long, value_name = "TIME", value_parser = interval)]
    interval: Option<f64>,

    /// Units of tables; measures are always in SI
    #[arg(long, value_name = "SYSTEM", default_value = "si")]
    units: UnitChoice,

    /// Axes of quantities that belong to a segment
    #[arg(long, value_enum, default_value_t)]
    axes: AxisChoice,

    /// Position code of the occupant in ISO-MME channel names: 1 front left, 3 front right, 4 to 9 rear
    #[arg(long, value_name = "CODE", default_value = "1", value_parser = code_letter)]
    seat: char,

    /// Dummy code in ISO-MME channel names (fine location 3), such as H3; 00 is undefined
    #[arg(long, value_name = "CODE", default_value = "00", value_parser = code_pair)]
    dummy: String,

    /// Replace existing files
    #[arg(short, long)]
    force: bool,
}

pub(crate) fn export(args: &Args) -> Result<(), Failure> {
    let output = args.output.clone().unwrap_or_else(|| args.run.with_extension("csv"));
    let to_standard = is_input(&output);
    if ending(&output) == "glb" {
        return export_scene(args, &output);
    }
    let is_mme = ending(&output) == "mme";
    let form = if to_standard { Some(Form::Csv) } else { Form::of(&output) };
    if !is_mme && form.is_none() {
        return Err(Failure::ending(&output, ".csv, .parquet, .xlsx, .mat, .mme or .glb"));
    }
    if let (true, Some(form)) = (args.run.is_dir(), form) {
        return export_sweep(args, &output, form);
    }
    let treatment = Treatment { interval_s: args.interval, ..args.treatment };
    let results = Results::open(&args.run)?;
    let channels = choose(&results.model, &args.channels)?;
    let histories = load(&results, channels, treatment)?;
    histories.notes.iter().for_each(note);
    let Some(form) = form else {
        return export_mme(args, &output, &results, &histories);
    };
    if args.axes != AxisChoice::Segment {
        note(&"y and z of segments have the signs of SAE J211; `compare`, `measures` and `fit` read tables in segment axes".to_owned());
    }
    let histories = args.axes.turned(histories);
    let coefficients = (treatment.filter != Filter::None).then(|| family_name(treatment.family));
    let mut about = About::new(&results, &histories, args.units, treatment.filter.words(), coefficients);
    if matches!(form, Form::Xlsx | Form::Mat) {
        about.figures = results.summary()?.figures(&results.model);
    }
    if to_standard {
        let bytes = table(&histories, &about, args.units, form).map_err(|error| Failure::plain(error.to_string()))?;
        return print_file(&bytes);
    }
    let files = TableFiles::begin(&output, form, &inputs(&args.run, &results.loaded), Existing::by(args.force))?;
    files.write(&histories, &about, args.units)?;
    say(&format!("wrote {} channels: {}", histories.columns.len(), output.display()));
    Ok(())
}

/// Exports the motion as a scene, which has neither channels nor filters.
fn export_scene(args: &Args, output: &Path) -> Result<(), Failure> {
    if !args.channels.is_empty() || args.interval.is_some() {
        let found = "--channel and --interval apply to tables; a glTF scene has all outputs";
        return Err(Failure::with_help(found, "leave them out, or write a table such as NAME.csv"));
    }
    refuse_input(output, &args.run)?;
    let results = Results::open(&args.run)?;
    results.notes().iter().chain(&results.doubt()).for_each(note);
    deliver(output, args.force, &glb(&results)?)
}

/// Exports the table of a sweep, with all columns.
fn export_sweep(args: &Args, output: &Path, form: Form) -> Result<(), Failure> {
    let is_of_runs = !args.channels.is_empty()
        || args.interval.is_some()
        || (args.treatment.filter, args.units, args.axes) != (Filter::None, UnitChoice::Si, AxisChoice::Segment);
    if is_input(output) || is_of_runs {
        let found = format!("{} is the folder of a sweep, with one row per sample", args.run.display());
        let help = "give -o FILE, without --channel, --interval, --filter, --units and --axes";
        return Err(Failure::with_help(found, help));
    }
    let Stored { manifest, journal, .. } = open(std::slice::from_ref(&args.run), MadeBy::AnyProgram)?;
    refuse_gaps(&journal, &manifest)?;
    let mut table = StudyTable::create([(output.to_owned(), form)], Existing::by(args.force), &manifest)?;
    journal.each_row(|row| table.row(&row))?;
    table.publish()?;
    say(&format!("wrote {} samples: {}", manifest.samples, output.display()));
    Ok(())
}

fn export_mme(args: &Args, output: &Path, results: &Results, histories: &Histories) -> Result<(), Failure> {
    let name = output.file_stem().and_then(|n| n.to_str());
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
        .map_err(|reason| Failure::plain(format!("{} cannot be made: {reason}", output.display())))?;
    let folder = output.with_extension("");
    publish_folder(&folder, &file_name(output), &files, args.force)?;
    say(&format!("wrote {} channels: {}", files.len() - 2, folder.join(format!("{name}.mme")).display()));
    if !without.is_empty() {
        let shown: Vec<&str> = without.iter().take(4).map(String::as_str).collect();
        let more = if without.len() > 4 { ", …" } else { "" };
        say(&format!("skipped {} channels without an ISO-MME code: {}{more}", without.len(), shown.join(", ")));
    }
    Ok(())
}

fn code_pair(text: &str) -> Result<String, String> {
    let fits = |c: u8| c.is_ascii_digit() || c.is_ascii_uppercase();
    if text.len() == 2 && text.bytes().all(fits) {
        Ok(text.to_owned())
    } else {
        Err("expected two digits or capitals".to_owned())
    }
}
