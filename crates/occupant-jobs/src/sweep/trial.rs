//! A few samples, run as the sweep will run them, to know what all will take.

use std::fs;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use occupant_core::model::Model;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::Summarizer;
use occupant_study::engine::{Engine, Finished, NotBegun, Source};
use occupant_study::{Study, of_stretch};
use rayon::prelude::*;

use super::{Plan, Staying};
use crate::base::text_table::trimmed;
use crate::base::{Failure, Interrupt};
use crate::files::study_folder::{Row, Status};
use occupant_files::table::Cell;

/// Rounds of all lanes of all threads; least and largest number of samples.
const ROUNDS: usize = 3;
const SAMPLES: [u64; 2] = [24, 200];
/// Time after which no sample is begun, and after which none is waited for.
const BEGUN_WITHIN: Duration = Duration::from_secs(10);
const ENDED_WITHIN: Duration = Duration::from_secs(60);
/// Excluded samples passed over in search of one that is run.
const PASSED: u64 = 1000;
/// Size of a number in a table, bytes.
const NUMBER: f64 = 8.0;
/// Unit of processor time in `/proc`, and the least that it measures well enough.
const TICKS_PER_S: f64 = 100.0;
const LEAST_S: f64 = 0.1;

/// Samples that were tried.
pub struct Trial {
    /// Their rows.
    rows: Vec<Row>,
    /// Number of those that were not waited for.
    unended: u64,
    threads: usize,
    /// Processor time of all of them, s; none where the system does not tell.
    processor_s: Option<f64>,
}

impl Trial {
    /// Tries samples spread over a range of the study; one for each thread goes before, to warm up.
    ///
    /// # Errors
    /// None of them could be run; interrupted.
    pub fn of(plan: &Plan, samples: &Range<u64>, engine: &Engine, interrupt: &Interrupt) -> Result<Trial, Failure> {
        let threads = engine.threads();
        let count = ((ROUNDS * threads * engine.kernel().lanes()) as u64).clamp(SAMPLES[0], SAMPLES[1]);
        let mut chosen = spread(&plan.study, samples, count);
        if chosen.is_empty() {
            let is_run = |index: &u64| plan.study.excluded(*index).is_none();
            chosen.extend(engine.share(|| samples.clone().into_par_iter().find_first(is_run)));
        }
        if chosen.is_empty() {
            return Err(Failure::plain("each sample of this range breaks a constraint: nothing is run"));
        }
        let run = |indices: &[u64]| {
            let began = Instant::now();
            let timed = Timed { plan, until: began + ENDED_WITHIN, unended: AtomicU64::new(0), interrupt };
            let in_time = indices.iter().copied().take_while(move |_| began.elapsed() < BEGUN_WITHIN);
            let mut rows = Vec::new();
            engine.run(&timed, in_time, &interrupt.asked, |row| {
                rows.push(row);
                Ok(())
            })?;
            interrupt.refuse("nothing was written")?;
            Ok::<_, Failure>((rows, timed.unended.into_inner()))
        };
        let (warm, _) = run(&chosen[..threads.min(chosen.len())])?;
        let before = processor_s();
        let (mut rows, unended) = run(&chosen)?;
        let processor_s = processor_s().zip(before).map(|(after, before)| after - before).filter(|s| *s > LEAST_S);
        // samples so long that the others were not begun
        if rows.is_empty() {
            rows = warm;
        }
        rows.sort_by_key(|row| row.index);
        let trial = Trial { rows, unended, threads, processor_s };
        trial.refuse_none()?;
        Ok(trial)
    }

    fn refuse_none(&self) -> Result<(), Failure> {
        if self.rows.iter().any(|row| row.status == Status::Completed) {
            return Ok(());
        }
        match self.rows.first() {
            Some(Row { status: Status::Refused, index, reason, .. }) => {
                Err(Failure::plain(format!("sample {index} is invalid: {reason}")))
            }
            Some(Row { index, reason, .. }) => {
                Err(Failure::broke_off(format!("sample {index} does not run: {reason}")))
            }
            None => {
                let found = format!("no sample ended within {:.0} s", ENDED_WITHIN.as_secs_f64());
                Err(Failure::broke_off(found))
            }
        }
    }

    /// What these samples of the study will take, as lines of a preview.
    pub fn lines(&self, left: &Staying) -> Vec<(&'static str, String)> {
        let times: Vec<f64> = self.rows.iter().map(Row::thread_time_s).collect();
        let n = times.len() as f64;
        let mean_s = times.iter().sum::<f64>() / n;
        let variance = times.iter().map(|s| (s - mean_s) * (s - mean_s)).sum::<f64>() / (n - 1.0).max(1.0);
        let off = 200.0 * (variance / n).sqrt() / mean_s.max(1e-9);
        let [least_s, most_s] =
            [times.iter().fold(f64::MAX, |a, b| a.min(*b)), times.iter().fold(0.0, |a, b| b.max(a))];
        let all_s = mean_s * left.kept();
        let longest_s = self.rows.iter().map(|row| row.wall_time_s).fold(0.0, f64::max);
        let wall_s = longest_s.max(all_s / self.threads as f64);
        let threads = if self.threads == 1 { "1 thread".to_owned() } else { format!("{} threads", self.threads) };
        let off = if times.len() > 1 { format!(" (± {off:.0} %)") } else { String::new() };
        let millis = |s: f64| trimmed(1e3 * s, 2);
        let each = format!("{} ms of a thread for each sample", millis(mean_s));
        let tried =
            format!("{} to {} ms of {} tried, spread over the study", millis(least_s), millis(most_s), times.len());
        // a thread may have to share its processor
        let processor_s = self.processor_s.map_or(all_s, |s| s / n * left.kept());
        let mut lines = vec![
            ("time", format!("about {} on {threads}{off}", duration(wall_s))),
            ("processor", format!("about {} in all; {each}: {tried}", duration(processor_s))),
        ];
        let share = 100.0 * n / left.kept();
        if share < 50.0 {
            let later = format!(
                "after more than {n:.0} samples ({} %) `occupant sweep status` knows better",
                trimmed(share, 4)
            );
            lines.push(("", later));
        }
        lines.extend(self.doubts().map(|line| ("", line)));
        lines
    }

    /// What makes the estimate doubtful.
    fn doubts(&self) -> impl Iterator<Item = String> {
        let failed = self.rows.iter().filter(|row| row.status != Status::Completed).count();
        let failed = (failed > 0).then(|| format!("{failed} of those tried did not complete"));
        let within = ENDED_WITHIN.as_secs_f64();
        let more = format!("{} more did not end within {within:.0} s: it may take much longer", self.unended);
        failed.into_iter().chain((self.unended > 0).then_some(more))
    }

    /// Approximate size of the rows of so many samples, bytes: numbers that vary, and the inputs alone of those left out.
    pub fn bytes(&self, left: &Staying, inputs: usize) -> f64 {
        let varies = |at: usize| {
            let mut seen = self.rows.iter().map(|row| row.cells.get(at).and_then(Cell::number).map(f64::to_bits));
            let first = seen.next();
            seen.any(|bits| Some(bits) != first)
        };
        let columns = self.rows.first().map_or(0, |row| row.cells.len());
        let varying = (0..columns).filter(|at| varies(*at)).count();
        // index and wall time vary too
        let excluded = left.samples as f64 - left.kept();
        NUMBER * (left.kept() * (varying + 2) as f64 + excluded * (inputs + 2) as f64)
    }
}

/// At most `count` samples of a range that are run, one of each stretch at random, so that no pattern of the design is met.
fn spread(study: &Study, samples: &Range<u64>, count: u64) -> Vec<u64> {
    let all = samples.end.saturating_sub(samples.start);
    let stretches = count.min(all).max(1);
    let border = |k: u64| samples.start + (u128::from(all) * u128::from(k) / u128::from(stretches)) as u64;
    let chosen = (0..stretches).filter_map(|k| {
        let (begin, end) = (border(k), border(k + 1));
        let first = begin + of_stretch(study.seed, k, end - begin);
        let mut tried = (first..end).chain(begin..first).take(PASSED as usize);
        tried.find(|index| study.excluded(*index).is_none())
    });
    chosen.collect()
}

/// Runs samples and keeps nothing of them.
struct Timed<'a> {
    plan: &'a Plan,
    until: Instant,
    unended: AtomicU64,
    interrupt: &'a Interrupt,
}

/// Ends a run at a time.
struct Deadline(Instant);

impl Recorder for Deadline {
    fn record(&mut self, _sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        Ok(if Instant::now() > self.0 { Flow::Stop } else { Flow::Continue })
    }
}

impl Source for Timed<'_> {
    type Recorder = (Summarizer, Deadline);
    type Row = Row;
    type Error = Failure;

    fn begin(&self, index: u64) -> Result<(Model, Self::Recorder), NotBegun<Failure>> {
        Ok((self.plan.open_sample(index)?.model, (Summarizer::new(), Deadline(self.until))))
    }

    fn end(&self, run: Finished<Self::Recorder>) -> Result<Row, Failure> {
        let mut row = self.plan.row(&run);
        if let Some(ran) = run.ran {
            self.plan.fill(&mut row, &ran.recorder.0, &ran.model);
        }
        Ok(row)
    }

    fn stopped(&self, _recorder: Self::Recorder) -> Result<(), Failure> {
        if !self.interrupt.is_asked() {
            self.unended.fetch_add(1, Ordering::Relaxed);
        }
        Ok(())
    }
}

/// Processor time of this process, s; none where the system does not tell.
fn processor_s() -> Option<f64> {
    let text = fs::read_to_string("/proc/self/stat").ok()?;
    // behind the name in brackets, which may have any characters, the state comes first
    let mut fields = text.rsplit_once(") ")?.1.split(' ').skip(11).map_while(|field| field.parse::<f64>().ok());
    Some((fields.next()? + fields.next()?) / TICKS_PER_S)
}

/// A duration as text.
fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => format!("{} s", trimmed(s, 2)),
        s if s < 100.0 => format!("{s:.1} s"),
        s if s < 6000.0 => format!("{:.0} min", s / 60.0),
        s if s < 172_800.0 => format!("{:.1} h", s / 3600.0),
        s => format!("{:.1} days", s / 86400.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::study_folder::row::tests::row;

    fn trial(times_s: &[f64], threads: usize) -> Trial {
        let row = |(i, wall_time_s): (usize, &f64)| Row { wall_time_s: *wall_time_s, ..row(4 * i as u64) };
        Trial { rows: times_s.iter().enumerate().map(row).collect(), unended: 0, threads, processor_s: None }
    }

    fn text(lines: &[(&str, String)]) -> String {
        lines.iter().map(|(head, line)| format!("{head} {line}\n")).collect()
    }

    #[test]
    fn time_is_that_of_the_samples_tried_with_their_scatter() {
        let left = Staying::all(36_000);
        let told = text(&trial(&[0.1, 0.3, 0.1, 0.3], 2).lines(&left));
        // 0.2 s · 36 000 = 2 h; standard error of 0.1155/√4 of 0.2: twice 29 %
        assert!(told.contains("time about 60 min on 2 threads (± 58 %)"), "{told}");
        assert!(
            told.contains("processor about 2.0 h in all; 200 ms of a thread for each sample: 100 to 300 ms of 4 tried"),
            "{told}"
        );
        assert!(told.contains("after more than 4 samples (0.0111 %) `occupant sweep status` knows better"), "{told}");
        // no fewer than the longest, however many threads
        let told = text(&trial(&[0.2, 0.2], 8).lines(&Staying::all(2)));
        assert!(told.contains("time about 0.2 s on 8 threads (± 0 %)") && !told.contains("status"), "{told}");
        let shared = Trial { processor_s: Some(0.4), ..trial(&[0.2; 4], 2) };
        assert!(text(&shared.lines(&left)).contains("processor about 60 min in all; 200 ms of a thread"));
        let mut slow = trial(&[0.2], 1);
        slow.unended = 3;
        let told = text(&slow.lines(&left));
        assert!(told.contains("on 1 thread\n") && told.contains("3 more did not end within 60 s"), "{told}");
    }

    #[test]
    fn a_sample_side_by_side_with_others_takes_its_part_of_the_thread() {
        let beside = Row { kernel: "lanes8".to_owned(), ..row(0) };
        assert_eq!((row(0).thread_time_s(), beside.thread_time_s()), (0.25, 0.25 / 8.0));
    }

    #[test]
    fn the_size_is_that_of_numbers_that_vary() {
        // of the cells the first varies, one is a text, one is the same in all
        let bytes = |left: &Staying| trial(&[0.1; 5], 1).bytes(left, 1);
        assert_eq!(bytes(&Staying::all(1000)), 1000.0 * 8.0 * 3.0);
    }
}
