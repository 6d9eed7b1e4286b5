//! Bands over time of every sample of a study with an ensemble: a file for each sample.
//!
//! A sweep keeps no histories, so the members of a sample are run once more, one sample at a time: memory grows with
//! members, channels and outputs, not with samples. A file gets its name only when it is complete, so a killed process
//! is resumed at the first sample without one.

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use occupant_core::results::channel::Channel;
use occupant_study::engine::Engine;
use occupant_study::spread::Rule;
use parquet::file::reader::{FileReader, SerializedFileReader};

use crate::base::{Existing, Failure, Interrupt, Show, say};
use crate::ensemble::bands::{choose, refuse_too_much};
use crate::ensemble::{Bands, Left, Member, Members};
use crate::files::study_folder::Checksums;
use crate::sweep::Plan;
use crate::sweep::words::tell_damaged;
use occupant_files::table::{Cell, Form, Kind, TableFile, columns};

/// Metadata key of a band file.
const ABOUT: &str = "occupant.bands";

/// The bands of a study.
pub struct StudyBands<'a> {
    /// The study.
    pub plan: &'a Plan,
    /// SHA-256 of the manifest of its sweep.
    pub manifest_sha256: &'a str,
    /// Names and patterns of channels; the main ones for none.
    pub channels: &'a [String],
    /// Folder of the files.
    pub folder: PathBuf,
    /// Engine.
    pub engine: &'a Engine,
    /// Request to stop.
    pub interrupt: &'a Interrupt,
    /// Checksums of the intact files.
    pub sums: Checksums,
    /// Progress display.
    pub show: Show,
}

/// Existing results of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum There {
    Bands,
    Nothing,
    /// A file of another study or of other channels.
    Other,
}

impl StudyBands<'_> {
    /// Writes the bands of all samples that have none yet.
    ///
    /// # Errors
    /// Files of something else that may not be replaced; interrupted; an error of the operating system.
    pub fn write_all(&self, existing: Existing) -> Result<(), Failure> {
        let samples = self.plan.study.samples();
        let mut all = 0..samples;
        if existing == Existing::Keep
            && let Some(sample) = all.find(|s| self.there(*s) == There::Other)
        {
            return Err(Failure::with_help(
                format!("{} contains other bands", self.file(sample).display()),
                "--force replaces them; the same --channel resumes",
            ));
        }
        fs::create_dir_all(&self.folder)
            .map_err(|e| Failure::plain(format!("{} cannot be made: {e}", self.folder.display())))?;
        tell_damaged(&self.sums.damaged());
        let study = &self.plan.study;
        let is_run = |sample: &u64| study.excluded(sample * study.members()).is_none();
        for sample in (0..samples).filter(|s| is_run(s) && self.there(*s) != There::Bands) {
            let done = format!(
                "the bands of {sample} of {samples} samples are complete; run the same command again to resume"
            );
            self.write(sample).map_err(|failure| failure.with_done(&done))?;
            if !self.show.quiet {
                say(&format!("sample {sample}: {}", self.file(sample).display()));
            }
        }
        Ok(())
    }

    fn file(&self, sample: u64) -> PathBuf {
        self.folder.join(format!("{sample:06}.parquet"))
    }

    fn there(&self, sample: u64) -> There {
        let path = self.file(sample);
        if !path.exists() || self.sums.damaged().contains(&path) {
            return There::Nothing;
        }
        match said_of_itself(&path) {
            Some(text) if text != self.about() => There::Other,
            Some(_) if self.sums.holds(&path) => There::Bands,
            // one that a killed process has not listed
            Some(_) => There::Nothing,
            None => There::Other,
        }
    }

    /// Identity of the sweep and the channels.
    fn about(&self) -> String {
        let about = serde_json::json!({
            "sweep": self.manifest_sha256,
            "channels": self.channels,
            "within": Rule::default().relative,
        });
        about.to_string()
    }

    /// Runs the members of a sample and writes their bands.
    ///
    /// # Errors
    /// A channel that is none; interrupted; the file cannot be written.
    fn write(&self, sample: u64) -> Result<(), Failure> {
        let study = &self.plan.study;
        let runs = sample * study.members()..(sample + 1) * study.members();
        let channels = self.channels_of(runs.start)?;
        let bar = self.show.bar(study.members(), &format!("runs of sample {sample} of {}", study.samples()));
        let members = Members {
            study,
            runs,
            resolver: &|name: &str| self.plan.tables.get(name),
            channels: &channels,
            interrupt: self.interrupt,
            bar: bar.as_deref(),
        };
        let members = members.run(self.engine)?;
        self.publish(sample, &channels, &members)
    }

    /// Channels of a sample; none if it was refused.
    fn channels_of(&self, run: u64) -> Result<Vec<Channel>, Failure> {
        let Ok(opened) = self.plan.open_sample(run) else {
            return Ok(Vec::new());
        };
        let channels = choose(&opened.model, self.channels)?;
        let members = self.plan.study.members();
        refuse_too_much(members, channels.len(), opened.model.output_count())?;
        Ok(channels)
    }

    fn publish(&self, sample: u64, channels: &[Channel], members: &[Member]) -> Result<(), Failure> {
        let completed: Vec<&Left> = members.iter().flatten().collect();
        let runs: Vec<&[Vec<f64>]> = completed.iter().map(|l| l.values.as_slice()).collect();
        let time_s = completed.first().map_or(Vec::new(), |l| l.time_s.clone());
        let mut bands = Bands::of(channels, time_s, &runs, Rule::default().relative);
        let counts = [completed.len(), members.len() - completed.len()].map(|n| Cell::count(n as u64));
        if !matches!(members.first(), Some(Ok(_))) {
            // the first that completed is not the unchanged one
            bands.channels.iter_mut().for_each(|band| band.nominal.clear());
        }
        let mut columns = columns(&[(Kind::Count, &["sample"])]);
        columns.extend(Bands::columns());
        columns.extend(["tolerance", "lost_at_s"].map(|name| (name, Kind::MaybeNumber)));
        columns.extend(["members", "failed"].map(|name| (name, Kind::Count)));
        let about = [(ABOUT, self.about())];
        let mut table = TableFile::create(self.file(sample), Form::Parquet, Existing::Replace, &columns, &about)?;
        for (band, values) in bands.rows() {
            let mut row = vec![Cell::count(sample)];
            row.extend(values);
            row.extend([Cell::finite(band.tolerance), band.lost_at_s.map_or(Cell::Absent, Cell::Number)]);
            row.extend(counts.clone());
            table.row(row)?;
        }
        Ok(self.sums.add(&table.publish()?)?)
    }
}

/// Metadata of a band file.
fn said_of_itself(path: &Path) -> Option<String> {
    let reader = SerializedFileReader::new(File::open(path).ok()?).ok()?;
    let entries = reader.metadata().file_metadata().key_value_metadata()?;
    entries.iter().find(|e| e.key == ABOUT)?.value.clone()
}
