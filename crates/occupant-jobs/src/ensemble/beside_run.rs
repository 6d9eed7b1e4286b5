//! The ensemble beside a run: its members after the run itself, their tables and files.

use std::path::PathBuf;

use occupant_core::model::Model;
use occupant_core::results::channel::{Channel, Series};
use occupant_core::results::summary::Summary;
use occupant_study::engine::Engine;
use occupant_study::{Study, Tolerances};
use placed_text::shown;

use super::quotes::{Subject, quotes};
use super::{Bands, Left, Members, Report, plot};
use crate::base::{Existing, Failure, Interrupt, Show, Units, program, write_whole};
use crate::files::scenario::Opened;
use crate::quoted::{Limits, fitting, parse_limit};
use occupant_files::table::{Form, TableFile};
use occupant_pictures::Format;

/// Pixels of a PNG per drawing unit (1/96 inch).
const PIXELS: f64 = 2.0;

/// A requested ensemble.
pub struct Wanted {
    /// The study.
    pub study: Study,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Tolerances of the perturbations.
    pub changes: Tolerances,
    /// Largest width of the middle 90 % of a stable figure, relative to the median.
    pub within: f64,
    /// The engine that runs them.
    pub engine: Engine,
    /// Channels whose histories are kept.
    pub channels: Vec<Channel>,
    /// The files.
    pub files: Vec<(PathBuf, BandFile)>,
    /// Whether files are replaced.
    pub existing: Existing,
    /// Units of pictures and paragraphs.
    pub units: Units,
    /// Inputs drawn from ready distributions, described.
    pub inputs: Vec<String>,
    /// Limits besides those of rules, such as `hic15=700`.
    pub limits: Vec<String>,
    /// Names and patterns of figures whose paragraphs are printed.
    pub quote: Vec<String>,
}

/// Content of a band file.
#[derive(Clone, Copy)]
pub enum BandFile {
    /// A table.
    Table(Form),
    /// A picture.
    Picture(Format),
}

impl Wanted {
    /// Runs and assesses the members; `histories` and `summary` are those of the unchanged run.
    ///
    /// # Errors
    /// Interrupted; a file that cannot be written.
    pub fn run(
        self,
        opened: &Opened,
        summary: &Summary,
        histories: Series,
        interrupt: &Interrupt,
        show: Show,
    ) -> Result<Report, Failure> {
        let time_s = histories.time_s.clone();
        let nominal = Left::of(summary, &opened.model, histories);
        let (limits, quote) = self.asked(&nominal, &opened.model)?;
        let bar = show.bar(self.study.len() - 1, "members");
        // what the scenario names was read with it and is not read again
        let tables = opened.loaded.tables();
        let resolver = |name: &str| match tables.iter().find(|(table, _)| *table == name) {
            Some((_, text)) => Ok(text.as_bytes().to_vec()),
            None => Err("it was not read with the scenario".to_owned()),
        };
        let members = Members {
            study: &self.study,
            // the unchanged run is done
            runs: 1..self.study.len(),
            resolver: &resolver,
            channels: &self.channels,
            interrupt,
            bar: bar.as_deref(),
        };
        let others = members.run(&self.engine)?;
        let completed = others.iter().flatten().map(|left| left.values.as_slice());
        let runs: Vec<&[Vec<f64>]> = std::iter::once(nominal.values.as_slice()).chain(completed).collect();
        let bands = Bands::of(&self.channels, time_s, &runs, self.within);
        let mut report = Report::of(&nominal, &others, self.within, bands, (self.seed, self.changes));
        let title = shown(&summary.title);
        let subject = Subject {
            simulated: format!("{} simulated {} (“{title}”)", program(), self.study.base_name),
            seed: self.seed,
            changes: &self.changes,
            inputs: &self.inputs,
            limits: &limits,
            units: self.units,
        };
        report.quotes = quotes(&subject, &nominal, &others);
        (report.inputs, report.quote) = (self.inputs.clone(), quote);
        let files = self.files.iter().map(|file| self.write(&report, file, &title));
        report.files = files.collect::<Result<_, _>>()?;
        Ok(report)
    }

    /// Limits, and the names of the figures whose paragraphs are printed: known before the members are run.
    fn asked(&self, nominal: &Left, model: &Model) -> Result<(Limits, Vec<String>), Failure> {
        let figures: Vec<_> = nominal.figures.iter().map(|f| (f.name.clone(), f.unit.to_owned())).collect();
        let limits: Vec<_> = self.limits.iter().map(|text| parse_limit(text, &figures)).collect::<Result<_, _>>()?;
        let quoted: Vec<_> =
            self.quote.iter().map(|name| fitting("--quote", name.trim(), &figures)).collect::<Result<_, _>>()?;
        let names = quoted.into_iter().flatten().map(|(name, _)| name.clone()).collect();
        Ok((Limits::new(Some(model), limits.concat()), names))
    }

    fn write(&self, report: &Report, (path, kind): &(PathBuf, BandFile), title: &str) -> Result<String, Failure> {
        let words = format!("{} runs with small changes, seed {}", report.members, report.seed);
        let written = match kind {
            BandFile::Table(form) => {
                let about = [("occupant.ensemble", format!("{}: {title}: {words}", program()))];
                let mut table = TableFile::create(path.clone(), *form, self.existing, &Bands::columns(), &about)?;
                report.bands.rows().try_for_each(|(_, row)| table.row(row))?;
                table.publish()?
            }
            BandFile::Picture(format) => {
                let drawing = plot::svg(&report.bands, title, &words, self.units);
                let unmade = |e| Failure::broke_off(format!("{} cannot be made: {e}", path.display()));
                let bytes = format.encode(&drawing, PIXELS).map_err(unmade)?;
                write_whole(path, self.existing, &bytes).map_err(Failure::broke_off)?
            }
        };
        Ok(written.display().to_string())
    }
}
