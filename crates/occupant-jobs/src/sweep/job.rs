//! A sweep in its folder: computes what is missing, writes whole runs that are kept, then the tables, or its part of the table.

use occupant_study::Keep;
use occupant_study::engine::Engine;

use super::progress::Progress;
use super::rating::rate;
use super::simulation::is_kept;
use super::words::{indices, judged, tell, tell_damaged, warn_unlocked};
use super::{Plan, Simulation, kept, parts, results};
use crate::base::{Done, Failure, Interrupt, Show, Units, note, quoted, say};
use crate::files::study_folder::checksums::sample_of;
use crate::files::study_folder::{Block, Checksums, Finished, Folder, Held, Journal, JournalWriter, Problem, Waiting};

/// A sweep, or one part of it.
pub struct Sweep {
    /// The study.
    pub plan: Plan,
    /// The folder.
    pub folder: Folder,
    /// Its samples: all, or a part of the study.
    pub block: Block,
    /// Whether it waits for another process at the same work.
    pub wait: bool,
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
    /// Computes missing samples, and writes the tables of a whole sweep or the part of a range. Outcome and report.
    ///
    /// # Errors
    /// A folder of something else, or in which another process is at work; interrupted; an error of the operating system.
    pub fn run(&self) -> Result<(Done, String), Failure> {
        let Sweep { plan, folder, .. } = self;
        let held = self.claim()?;
        warn_unlocked(&held, "computing the same samples", self.show.quiet);
        if self.is_in_store()? {
            return Ok((Done::Well, String::new()));
        }
        kept::prepare(&self.keep, folder)?;
        let samples = self.block.samples.clone();
        let sums = self.look_over()?;
        let (journal, aside) = Journal::mend(folder, &sums, || self.read())?;
        journal.runs_in(folder).for_each(|(name, sum)| sums.learn(name, sum, true));
        tell_damaged(&[held.mended, aside, sums.damaged()].concat());
        let runs = kept::among(&sums.damaged(), folder, samples.clone());
        if let Some(note) =
            indices(&plan.study).filter(|_| !self.show.quiet && journal.finished.count(samples.clone()) == 0)
        {
            say(&format!("note: {note}"));
        }
        let progress = self.compute(&journal.finished, &sums)?;
        let note = self.kernel.as_ref().and_then(|kernel| progress.disobeyed(kernel));
        note.iter().filter(|_| !self.show.quiet).for_each(|note| say(note));
        let journal = self.read()?;
        let wanted = samples.clone().filter(|index| is_kept(&self.keep, *index));
        self.write_kept(&journal, &sums, wanted.chain(runs))?;
        if self.is_whole() {
            return self.finish(&journal, &progress, sums);
        }
        self.hand_in(&journal, progress.computed, &sums)
    }

    /// Whether the store has the part already, which is said.
    fn is_in_store(&self) -> Result<bool, Failure> {
        let Sweep { folder, block, .. } = self;
        let is_there = folder.has_stored(block)?;
        if is_there {
            if !self.show.quiet {
                say(&format!("{block}: finished, in {}", folder.shown()));
            }
            folder.clear_block(block)?;
        }
        Ok(is_there)
    }

    /// Writes the part of a finished range, of which so many samples were computed now.
    fn hand_in(&self, journal: &Journal, computed: u64, sums: &Checksums) -> Result<(Done, String), Failure> {
        let Sweep { folder, block, plan, .. } = self;
        let runs = sums.runs_of(&block.samples);
        parts::write(folder, journal, &plan.manifest, block, &runs)?;
        folder.put_part(block, &plan.manifest, &runs)?;
        if !self.show.quiet {
            let count = block.samples.end - block.samples.start;
            say(&format!(
                "{block}: all {count} are finished, {computed} of them now; when all parts of the study are, make the table with `occupant sweep merge {}`",
                quoted(folder.shown())
            ));
        }
        Ok((Done::Well, String::new()))
    }

    fn is_whole(&self) -> bool {
        self.folder.store.is_none() && self.block.is_all_of(self.plan.manifest.samples)
    }

    /// Claims the folder, when others have left it if they may be waited for.
    fn claim(&self) -> Result<Held, Failure> {
        let Sweep { plan, folder, .. } = self;
        self.waiting().claim(|| folder.claim(&plan.manifest, &plan.texts, &self.block, self.restart))
    }

    fn waiting(&self) -> Waiting<'_> {
        Waiting { wait: self.wait, quiet: self.show.quiet, interrupt: &self.interrupt }
    }

    /// What there is: of a part of the study its own files alone.
    fn read(&self) -> Result<Journal, Problem> {
        let Sweep { plan, folder, block, .. } = self;
        match self.is_whole() {
            true => Journal::read(std::slice::from_ref(folder), &plan.manifest),
            false => Journal::of_block(folder, &plan.manifest, block),
        }
    }

    /// Verifies the files written by this sweep, or for these samples.
    fn look_over(&self) -> Result<Checksums, Problem> {
        let Sweep { folder, block, .. } = self;
        if !self.is_whole() {
            return Checksums::read(&folder.path, folder.beside_journal(block, "sums"), |_| true);
        }
        // bands are looked after by those who make them
        Checksums::open(&folder.path, |name| sample_of(name).is_some() || !name.contains('/'))
    }

    /// Computes unfinished samples.
    fn compute(&self, finished: &Finished, sums: &Checksums) -> Result<Progress, Failure> {
        let (manifest, samples) = (&self.plan.manifest, self.block.samples.clone());
        let before = finished.count(samples.clone());
        let count = samples.end - samples.start;
        if before > 0 && before < count && !self.show.quiet {
            say(&format!("resuming: {before} of {count} samples are finished"));
        }
        let mut progress = Progress::new(count, before, self.show);
        let mut journal = JournalWriter::new(&self.folder, &manifest.identity(), &self.block);
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
        match ended {
            // without locks another process has computed the same samples, and was quicker
            Err(_) if self.has_all() => {}
            ended => ended.map_err(|failure| failure.with_done(&kept))?,
        }
        self.interrupt.refuse(&kept)?;
        Ok(progress)
    }

    fn has_all(&self) -> bool {
        let count = self.block.samples.end - self.block.samples.start;
        self.read().is_ok_and(|journal| journal.finished.count(self.block.samples.clone()) == count)
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

    /// Writes the tables, the worst runs and the rating.
    fn finish(&self, journal: &Journal, progress: &Progress, sums: Checksums) -> Result<(Done, String), Failure> {
        let place = (&self.folder, &sums);
        let mut results = results::write(place, journal, &self.plan.manifest, (&self.keep, self.csv), &self.waiting())?;
        self.write_kept(journal, &sums, results.worst.iter().copied())?;
        let run_of = |index| Some(self.folder.run(index)).filter(|path| sums.holds(path));
        let elapsed_s = progress.elapsed_s();
        let rated = rate(&self.plan, place, journal, &run_of, (&self.engine, &self.waiting()))?;
        results.files.extend(rated.files);
        sums.close()?;
        self.folder.clear_journals()?;
        if self.show.quiet {
            return Ok((judged(&results.census), String::new()));
        }
        rated.notes.iter().for_each(note);
        let work = format!("{} samples in {:.1} s, {} threads", progress.computed, elapsed_s, self.engine.threads());
        let next = format!("occupant study report {}", quoted(self.folder.path.display()));
        Ok((judged(&results.census), tell(&results, Some(work), &next, self.units) + &rated.text))
    }
}
