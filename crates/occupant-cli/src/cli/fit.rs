//! `occupant fit`.

use std::fs;
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use occupant_core::scenario::Draft;

use super::exit::{Done, Failure};
use super::interrupt::Interrupt;
use super::output_file::{Existing, PartialFile};
use super::run::program;
use super::scenario::file_name;
use super::speak::{json, print, say};
use super::sweep::choices::{kernel, threads};
use crate::fit::evaluator::{Evaluator, Means, Record};
use crate::fit::experiment::opened;
use crate::fit::fitting::{Fitting, Given};
use crate::fit::found::{Fittings, Found, found};
use crate::fit::identified::{Answer, run, run_model, search};
use crate::fit::plots::{Pair, sheets};
use crate::fit::progress::Progress;
use crate::fit::scenario_text::{fitted, numbers};
use crate::fit::words::told;
use crate::fit::{history, report};
use crate::measured::MapArgument;
use crate::sweep::folder::Folder;
use crate::sweep::shard::Shard;

/// Find the parameters of a study with which runs follow a test best
///
/// Looks for the values of the study's parameters, each between the ends of its range, with which measured channels of one
/// test or of several are reproduced best; the study's [fit] says what counts. A global search (CMA-ES with growing
/// populations) is followed by a refinement and by intervals: how far each parameter can go while the others make up for it.
/// Writes FOLDER/fit.json, fitted.toml (the scenario with the fitted numbers and where they come from), plots/*.svg
/// (measured against computed, before and after) and history.parquet and .csv (every candidate). A fit that was interrupted
/// or killed goes on with the same command and ends at the same answer.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The study, TOML or JSON
    #[arg(value_name = "STUDY")]
    study: PathBuf,

    /// A test: a text table (CSV) or an ISO-MME test; may be repeated. Not needed where the study names its tests
    #[arg(long, value_name = "TEST")]
    to: Vec<PathBuf>,

    /// The folder of the results; made if absent
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,

    /// Which column of the tests is which channel: 'column=channel', 'column[unit]=channel', 'column=-channel' for opposite
    /// signs; columns named as channels are found without
    #[arg(long, value_name = "MAP")]
    map: Vec<MapArgument>,

    /// Change a value in all scenarios, such as --set time.end='120 ms'; may be repeated
    #[arg(long = "set", value_name = "PATH.TO.KEY=VALUE")]
    overrides: Vec<String>,

    /// Number of threads; one for each core if absent
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,

    /// How runs are computed: scalar, lanes4 or lanes8, the fastest of this processor if absent; all give the same bits
    #[arg(long, value_name = "KERNEL")]
    kernel: Option<String>,

    /// Remove the results that the folder holds and begin anew
    #[arg(long)]
    restart: bool,

    /// Print what fit.json holds instead of tables
    #[arg(long)]
    json: bool,

    /// No progress, no warnings, no tables
    #[arg(short, long)]
    quiet: bool,
}

/// Fits.
pub fn fit(args: &Args) -> Result<Done, Failure> {
    let means = Means { threads: threads(args.threads), kernel: kernel(args.kernel.as_deref())? };
    let given = Given { files: &args.to, maps: &args.map, overrides: &args.overrides };
    let fitting = Fitting::open(&args.study, &given, program()).map_err(Failure::CouldNotRun)?;
    if !args.quiet {
        fitting.warnings.iter().for_each(|w| say(&format!("{w}\n")));
    }
    let folder = Folder::of_fit(&args.output);
    let sha256 = fitting.manifest.sha256();
    let sha256 = sha256.map_err(|e| Failure::plain(format!("the manifest cannot be written: {e}")))?;
    let claimed = folder.claim(&fitting.manifest, &fitting.texts, Shard::WHOLE, args.restart);
    let held = claimed.map_err(told)?;
    if let (Some(reason), false) = (&held.unlocked, args.quiet) {
        say(&format!(
            "warning: this file system has no locks ({reason}): nothing but you keeps two processes from fitting into one folder"
        ));
    }
    let interrupt = Interrupt::listen_for("stopping; once more to stop at once");
    let progress = Progress::new(fitting.fit.budget, args.quiet);
    let evaluator = Evaluator::new(&fitting, &folder, &sha256, means, &interrupt, progress);
    let mut evaluator = evaluator.map_err(told)?;
    if evaluator.known() > 0 && !args.quiet {
        say(&format!("going on: {} runs are there", evaluator.known()));
    }
    let answer = search(&fitting, &mut evaluator)?;
    let records = evaluator.close().map_err(told)?;
    let found = Output { fitting: &fitting, folder: &folder }.write(&answer, &records)?;
    match (args.json, args.quiet) {
        (true, _) => print(&json(&found)?)?,
        (false, true) => {}
        (false, false) => {
            let written = format!("\nwritten to {}\n", folder.path().display());
            print(&(report::text(&fitting, &found) + &written))?;
        }
    }
    Ok(Done::Well)
}

/// Writes the results of a fit.
struct Output<'a> {
    fitting: &'a Fitting,
    folder: &'a Folder,
}

impl Output<'_> {
    /// Fitted scenarios, history, plots, and fit.json last.
    fn write(&self, answer: &Answer, records: &[Record]) -> Result<Found, Failure> {
        let values = self.fitting.values(&answer.best.at);
        let (fittings, runs) = self.run_fitted(&values).map_err(broke_off)?;
        let found = found(self.fitting, answer, records, &fittings, program());
        self.write_scenarios(&found, &fittings)?;
        history::write(self.folder, self.fitting, records).map_err(told)?;
        let lines = [format!("{}: {} score {:.5}", found.study.file, found.objective, found.score.after)];
        for (name, svg) in sheets(self.fitting, &runs, &lines).map_err(broke_off)? {
            let name = format!("plots/{}.svg", file_stem(&name));
            self.put(&name, svg.as_bytes())?;
        }
        self.put("fit.json", json(&found)?.as_bytes())?;
        Ok(found)
    }

    /// Runs the scenarios with the numbers as they will be written, and without.
    fn run_fitted(&self, values: &[f64]) -> Result<(Fittings, Vec<Pair>), String> {
        let experiments = &self.fitting.experiments;
        let mut fittings = Fittings { names: self.names(), numbers: Vec::new(), parts: Vec::new() };
        let mut runs = Vec::new();
        for experiment in experiments {
            let numbers = numbers(experiment, values)?;
            let mut draft: Draft = experiment.study.base().clone();
            for number in &numbers {
                let set = draft.set_value(&number.path, &number.text);
                set.map_err(|e| e.to_string())?;
            }
            let (_, model, _) = opened(draft, &experiment.tables).map_err(|e| e.to_string())?;
            let after = run_model(experiment, &model)?;
            fittings.parts.extend(experiment.misfits(self.fitting.fit.misfit, &after)?);
            fittings.numbers.push(numbers);
            runs.push(Pair { before: run(experiment, None).ok(), after });
        }
        Ok((fittings, runs))
    }

    /// `fitted.toml`, or a file for each experiment, named after its first test.
    fn names(&self) -> Vec<String> {
        let experiments = self.fitting.experiments.len();
        if experiments == 1 {
            return vec!["fitted.toml".to_owned()];
        }
        let name = |e: usize| {
            let test = self.fitting.tests.iter().find(|t| t.experiment == e);
            let name = test.map_or(e.to_string(), |t| file_stem(&t.name));
            format!("fitted/{name}.toml")
        };
        (0..experiments).map(name).collect()
    }

    fn write_scenarios(&self, found: &Found, fittings: &Fittings) -> Result<(), Failure> {
        let each = self.fitting.experiments.iter().zip(&fittings.numbers);
        for ((experiment, numbers), name) in each.zip(&fittings.names) {
            let words = |i: usize| report::provenance(self.fitting, found, &found.parameters[i], i);
            let provenance: Vec<(String, String)> =
                numbers.iter().map(|n| (n.path.clone(), words(n.parameter))).collect();
            let head = format!(
                "# {} with the numbers of the fit {}: see [provenance].\n",
                file_name(&experiment.scenario),
                found.study.file
            );
            let text = fitted(experiment, numbers, &provenance, &head).map_err(broke_off)?;
            if !text.kept {
                say(&format!("note: {name} is written anew: its comments and order could not be kept"));
            }
            self.put(name, text.text.as_bytes())?;
            let folder = Path::new(name).parent().unwrap_or(Path::new(""));
            for (table, bytes) in &experiment.tables {
                // beside the scenario that names it, if that is a place below it
                let below = Path::new(table).components();
                if below.clone().all(|c| matches!(c, std::path::Component::Normal(_))) {
                    let place = folder.join(table);
                    self.put(&place.display().to_string(), bytes)?;
                }
            }
        }
        Ok(())
    }

    /// Writes a file of the folder, whole or not at all.
    fn put(&self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        let path = self.folder.path().join(name);
        let failed =
            |e: &dyn std::fmt::Display| Failure::BrokeOff(format!("error: cannot write {}: {e}", path.display()));
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).map_err(|e| failed(&e))?;
        }
        let mut file = PartialFile::create(&path, Existing::Replace).map_err(|e| failed(&e))?;
        file.write_all(bytes).map_err(|e| failed(&e))?;
        file.publish().map_err(|e| failed(&e))?;
        Ok(())
    }
}

/// A name that can be that of a file.
fn file_stem(name: &str) -> String {
    let plain = |c: char| {
        if c.is_alphanumeric() || "-_ .".contains(c) { c } else { '_' }
    };
    name.chars().map(plain).collect()
}

fn broke_off(reason: String) -> Failure {
    Failure::BrokeOff(format!("error: {reason}"))
}
