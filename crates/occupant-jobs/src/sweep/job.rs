//! A sweep in its folder: computes what is missing, writes whole runs that are kept, then the tables.

use std::ops::Range;

use occupant_study::Keep;
use occupant_study::engine::Engine;

use super::progress::Progress;
use super::simulation::is_kept;
use super::stored::sha256_of;
use super::words::{indices, judged, tell, tell_damaged, warn_unlocked};
use super::{Plan, Simulation, kept, results};
use crate::base::{Done, Failure, Interrupt, Show, Units, quoted, say};
use crate::files::study_folder::{Checksums, Finished, Folder, Journal, JournalWriter, Problem, Shard};

/// A sweep, or one part of it.
pub struct Sweep {
    /// The study.
    pub plan: Plan,
    /// The folder.
    pub folder: Folder,
    /// Part of the study.
    pub shard: Shard,
    /// Samples whose result file is kept.
    pub keep: Keep,
    /// Whether tables are also written as CSV.
    pub csv: bool,
    /// Whether existing results are removed.
    pub restart: bool,
    /// Progress display.
    pub show: Show,
    /// Units of printed numbers.
    pub units: Units,
    /// Engine.
    pub engine: Engine,
    /// The kernel asked for, if any.
    pub kernel: Option<String>,
    /// Request to stop.
    pub interrupt: Interrupt,
}

impl Sweep {
    /// Computes missing samples, and writes the tables of a whole sweep. Outcome and report.
    ///
    /// # Errors
    /// A folder of something else, or in which another process is at work; interrupted; an error of the operating system.
    pub fn run(&self) -> Result<(Done, String), Failure> {
        let Sweep { plan, folder, .. } = self;
        let manifest = &plan.manifest;
        let held = folder.claim(manifest, &plan.texts, self.shard, self.restart)?;
        warn_unlocked(&held, "computing the same shard", self.show.quiet);
        kept::prepare(&self.keep, folder)?;
        let samples = self.shard.range(manifest.samples);
        let sha256 = sha256_of(manifest)?;
        let sums = self.look_over(&samples)?;
        let (journal, aside) = Journal::mend(folder, (&sha256, manifest.samples), &sums)?;
        tell_damaged(&[held.mended, aside, sums.damaged()].concat());
        let runs = kept::among(&sums.damaged(), folder, samples.clone());
        if let Some(note) =
            indices(&plan.study).filter(|_| !self.show.quiet && journal.finished.count(samples.clone()) == 0)
        {
            say(&format!("note: {note}"));
        }
        let progress = self.compute(&journal.finished, &samples, (&sha256, &sums))?;
        let note = self.kernel.as_ref().and_then(|kernel| progress.disobeyed(kernel));
        note.iter().filter(|_| !self.show.quiet).for_each(|note| say(note));
        let journal = Journal::read(std::slice::from_ref(folder), &sha256, manifest.samples)?;
        let wanted = samples.clone().filter(|index| is_kept(&self.keep, *index));
        self.write_kept(&journal, &sums, wanted.chain(runs))?;
        Journal::list(folder, self.shard, &sums)?;
        if self.shard.is_whole() {
            return self.finish(&journal, &progress, sums);
        }
        if !self.show.quiet {
            say(&format!(
                "shard {}: all {} samples are finished, {} of them now; when all shards are, make the table with `occupant sweep merge {}`",
                self.shard,
                samples.end - samples.start,
                progress.computed,
                folder.path.display()
            ));
        }
        Ok((Done::Well, String::new()))
    }

    /// Verifies the files written by this shard.
    fn look_over(&self, samples: &Range<u64>) -> Result<Checksums, Problem> {
        let run = |name: &str| name.strip_prefix("runs/")?.split('.').next()?.parse::<u64>().ok();
        Checksums::open(&self.folder.path, |name| match (run(name), name.rsplit_once('/')) {
            (Some(index), _) => samples.contains(&index),
            (None, Some(("journal", piece))) => Shard::of_file(piece) == Some(self.shard),
            // bands are looked after by those who make them
            (None, folder) => folder.is_none() && self.shard.is_whole(),
        })
    }

    /// Computes unfinished samples.
    fn compute(
        &self,
        finished: &Finished,
        samples: &Range<u64>,
        (sha256, sums): (&str, &Checksums),
    ) -> Result<Progress, Failure> {
        let before = finished.count(samples.clone());
        let count = samples.end - samples.start;
        if before > 0 && before < count && !self.show.quiet {
            say(&format!("resuming: {before} of {count} samples are finished"));
        }
        let mut progress = Progress::new(count, before, self.show);
        let mut journal = JournalWriter::new(&self.folder, sha256, self.shard)?;
        let simulation = Simulation { plan: &self.plan, keep: &self.keep, folder: &self.folder, sums };
        let missing = samples.clone().filter(|index| !finished.has(*index));
        let ended = self.engine.run(&simulation, missing, &self.interrupt.asked, |row| {
            journal.append(&row)?;
            progress.see(&row);
            Ok(())
        });
        progress.end();
        let ended = ended.and_then(|()| Ok(journal.close()?));
        let done = before + progress.computed;
        let kept = format!("{done} of {count} samples are finished and kept; run the same command again to resume");
        let kept = self.folder.still(kept);
        ended.map_err(|failure| failure.with_done(&kept))?;
        self.interrupt.refuse(&kept)?;
        Ok(progress)
    }

    /// Writes missing result files of finished samples.
    fn write_kept(
        &self,
        journal: &Journal,
        sums: &Checksums,
        samples: impl Iterator<Item = u64>,
    ) -> Result<(), Failure> {
        let (place, stop) = ((&self.folder, sums), &self.interrupt.asked);
        kept::write_missing(&self.plan, place, journal, samples, &self.engine, stop)?;
        self.interrupt.refuse("all samples are finished; run the same command again to write the table")
    }

    /// Writes the tables and the worst runs.
    fn finish(&self, journal: &Journal, progress: &Progress, sums: Checksums) -> Result<(Done, String), Failure> {
        let results = results::write((&self.folder, &sums), journal, &self.plan.manifest, &self.keep, self.csv)?;
        self.write_kept(journal, &sums, results.worst.iter().copied())?;
        sums.close()?;
        if self.show.quiet {
            return Ok((judged(&results.census), String::new()));
        }
        let work = format!(
            "{} samples in {:.1} s, {} threads",
            progress.computed,
            progress.elapsed_s(),
            self.engine.threads()
        );
        let next = format!("occupant study report {}", quoted(self.folder.path.display()));
        Ok((judged(&results.census), tell(&results, Some(work), &next, self.units)))
    }
}
