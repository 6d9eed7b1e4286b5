//! Opens a study and its tests, with everything that a fit needs. All problems are reported at once.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use occupant_core::results::channel::{Channel, channels, find};
use occupant_scenario::Draft;
use occupant_study::{Fit, FitChannel, FitTest, Study, StudyText};

use super::target::filter_of;
use super::{Experiment, Target, Test};
use crate::base::{ending, file_name};
use crate::files::scenario::{Tables, format_of};
use crate::files::study_folder::{NamedBy, Texts};
use crate::sweep::plan::unread;
use occupant_files::measured::{self, MapArgument, Pair, Wanted, pairs};
use occupant_files::signals::Recording;

/// Tests that the command line gives.
pub struct Given<'a> {
    /// The files.
    pub files: &'a [PathBuf],
    /// Assignment of columns to channels, for all of them.
    pub maps: &'a [MapArgument],
    /// Changes in all scenarios.
    pub overrides: &'a [String],
}

/// A test with a known file.
struct Named {
    test: FitTest,
    file: PathBuf,
    by: (NamedBy, String),
    /// Its path in the study; empty for one from the command line.
    at: String,
}

/// A fit being opened, with the problems found so far.
pub(super) struct Opening<'a> {
    folder: &'a Path,
    text: &'a StudyText,
    texts: &'a Texts,
    given: &'a Given<'a>,
    pub(super) problems: Vec<String>,
    pub(super) warnings: Vec<String>,
    pub(super) experiments: Vec<Experiment>,
    /// Tests whose scenarios were opened, with the result.
    known: Vec<(FitTest, Option<usize>)>,
}

impl<'a> Opening<'a> {
    pub(super) fn new(folder: &'a Path, text: &'a StudyText, texts: &'a Texts, given: &'a Given<'a>) -> Self {
        let (problems, warnings, experiments, known) = Default::default();
        Opening { folder, text, texts, given, problems, warnings, experiments, known }
    }

    fn complain(&mut self, at: &str, found: String, expected: &str, hint: Option<&str>) {
        let problem = self.text.complaint(at, found, expected, hint.map(str::to_owned));
        self.problems.push(problem.to_string());
    }

    /// Tests with their files: those of the study, and for missing files those of the command line, in order.
    fn named(&mut self, fit: &Fit) -> Vec<Named> {
        let files = self.given.files;
        let of_study = !fit.tests.is_empty();
        let tests = if of_study { fit.tests.clone() } else { vec![FitTest::default(); files.len()] };
        if tests.is_empty() {
            let hint = "--test test.csv, or [[fit.tests]] with `file`";
            self.complain("", "there is no test to fit to".to_owned(), "a test", Some(hint));
        }
        let open = tests.iter().filter(|t| t.file.is_none()).count();
        if open != files.len() {
            let found = match files.len() {
                0 => format!("{open} of the study's tests have no file"),
                n => format!("--test gives {n} files, but {open} tests of the study need one"),
            };
            let hint = "give one --test for each test without `file`, in their order";
            self.complain("fit.tests", found, "a file for each test", Some(hint));
            return Vec::new();
        }
        let mut files = files.iter();
        let named = tests.into_iter().enumerate().filter_map(|(i, test)| {
            let at = if of_study { format!("fit.tests[{i}]") } else { String::new() };
            let (file, by) = match &test.file {
                Some(file) => (self.folder.join(file), (NamedBy::Study, file.clone())),
                None => files.next().map(|f| (f.clone(), (NamedBy::CommandLineTest, f.display().to_string())))?,
            };
            Some(Named { file, by, test, at })
        });
        named.collect()
    }

    /// Reads tests and scenarios and combines them.
    pub(super) fn tests(&mut self, fit: &Fit) -> Vec<Test> {
        let mut tests: Vec<Test> = Vec::new();
        let mut met: BTreeSet<String> = BTreeSet::new();
        for named in self.named(fit) {
            let experiment = self.experiment(&named);
            let recording = self.recording(&named);
            let (Some(experiment), Some(recording)) = (experiment, recording) else {
                continue;
            };
            let number = tests.len();
            for target in self.targets(fit, &named, &recording, experiment) {
                met.insert(target.channel.name.clone());
                self.experiments[experiment].add(number, target);
            }
            let stem = named.file.file_stem().unwrap_or_default().to_string_lossy();
            let name = named.test.name.clone().unwrap_or_else(|| stem.into_owned());
            if tests.iter().any(|t| t.name == name) {
                let found = format!("two tests named \"{name}\"");
                self.complain(&named.at, found, "a unique `name`", None);
            }
            tests.push(Test {
                name,
                file: match named.by.0 {
                    NamedBy::CommandLineTest => file_name(&named.file),
                    _ => named.by.1.clone(),
                },
                sha256: recording.sha256.clone(),
                scenario: file_name(&self.experiments[experiment].scenario),
                fitted: String::new(),
                experiment,
                nuisances: named.test.nuisances(),
            });
        }
        if self.problems.is_empty() {
            self.refuse_unmet(fit, &met);
        }
        tests
    }

    /// Reports channels for which no test has a signal.
    fn refuse_unmet(&mut self, fit: &Fit, met: &BTreeSet<String>) {
        for (i, channel) in fit.channels.iter().enumerate().filter(|(_, c)| !met.contains(&c.name)) {
            let found = format!("no test has a signal for `{}`", channel.name);
            let hint = "assign a column: map = [\"column[unit]=channel\"] in the test, or --map";
            let at = format!("fit.channels[{i}].channel");
            self.complain(&at, found, "a column with that name", Some(hint));
        }
    }

    /// The scenario of a test: an existing one or a new one; none if it was refused.
    fn experiment(&mut self, named: &Named) -> Option<usize> {
        let test = &named.test;
        let same = |(known, _): &&(FitTest, Option<usize>)| (&known.base, &known.set) == (&test.base, &test.set);
        if let Some((_, there)) = self.known.iter().find(same) {
            return *there;
        }
        let new = self.new_experiment(named).map_err(|problem| self.problems.push(problem)).ok();
        let there = new.map(|experiment| {
            self.experiments.push(experiment);
            self.experiments.len() - 1
        });
        self.known.push((test.clone(), there));
        there
    }

    fn new_experiment(&mut self, named: &Named) -> Result<Experiment, String> {
        let base = named.test.base.as_deref().unwrap_or(self.text.base());
        let (by, at) = match named.test.base {
            Some(_) => (NamedBy::Study, format!("{}.base", named.at)),
            None => (NamedBy::StudyAsBase, "base".to_owned()),
        };
        let path = self.folder.join(base);
        let shown = path.display().to_string();
        let bytes = self.texts.get(by, base);
        let bytes = bytes.map_err(|e| unread(self.text, &at, &format!("the scenario {shown}"), &e).to_string())?;
        let draft = Draft::read_bytes(&bytes, format_of(&path), &shown);
        let draft = draft.map_err(|e| e.to_string())?;
        let at = format!("{}.set", named.at);
        let beside = |file: &str| self.texts.get(NamedBy::Study, file);
        let study = self
            .text
            .bind_fit(draft, (&named.test.set, &at), self.given.overrides, &beside)
            .map_err(|e| e.to_string())?;
        if !study.warnings.is_empty() {
            self.warnings.push(study.warnings.to_string());
        }
        let tables = self.tables(&study, base);
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let new = Experiment::new(path, text, study, tables);
        let (experiment, warnings) = new.map_err(|e| e.to_string())?;
        if !warnings.is_empty() {
            self.warnings.push(warnings.to_string());
        }
        Ok(experiment)
    }

    /// Files referred to by a scenario; an unreadable one is reported when the scenario is opened.
    fn tables(&self, study: &Study, base: &str) -> Tables {
        let beside = Path::new(base).parent().unwrap_or(Path::new(""));
        let read = |(_, name): (String, String)| {
            let bytes = self.texts.get(NamedBy::Study, &beside.join(&name).display().to_string()).ok()?;
            Some((name, bytes))
        };
        Tables(study.base.clone().files().into_iter().filter_map(read).collect())
    }

    fn recording(&mut self, named: &Named) -> Option<Recording> {
        let read = measured::read(&named.file).map_err(|failure| match (&named.test.file, fs::metadata(&named.file)) {
            (Some(_), Err(error)) => {
                let (at, file) = (format!("{}.file", named.at), named.file.display().to_string());
                unread(self.text, &at, &file, &error).to_string()
            }
            _ => failure.words(),
        });
        let recording = read.map_err(|problem| self.problems.push(problem)).ok()?;
        self.warnings.extend(recording.notes.iter().map(|note| format!("note: {note}")));
        // a copy for the folder; of an ISO-MME test its checksum only
        let single = named.file.is_file() && ending(&named.file) != "mme";
        let copied = single && self.texts.get(named.by.0, &named.by.1).is_ok();
        if !copied {
            self.texts.add(named.by.0, &named.by.1, recording.sha256.clone().into_bytes());
        }
        Some(recording)
    }

    /// The measured channels of a test.
    fn targets(&mut self, fit: &Fit, named: &Named, recording: &Recording, experiment: usize) -> Vec<Target> {
        let Some(wanted) = self.wanted(fit, experiment) else {
            return Vec::new();
        };
        // the run must have values wherever the offset may put the window
        let [from_s, to_s] = self.experiments[experiment].run_s();
        let [offset, _] = named.test.nuisances();
        let [early_s, late_s] = offset.unwrap_or_default();
        let run_s = [from_s - early_s.min(0.0), to_s - late_s.max(0.0)];
        let window_s = [0, 1].map(|i| named.test.window_s()[i].or(fit.window_s[i]));
        let mut targets = Vec::new();
        for pair in self.pairs(named, recording, &wanted) {
            let (channel, of) = &wanted[pair.channel];
            let filter = filter_of(of.filter.unwrap_or(fit.filter));
            let weight = of.weight() * named.test.weight();
            let shifted = (pair, named.test.shift_s());
            match Target::new(channel.clone(), filter, weight, shifted, window_s, run_s, fit.misfit) {
                Ok(target) => targets.push(target),
                Err(reason) => {
                    let found = format!("{} of {} cannot be fitted to: {reason}", channel.name, named.file.display());
                    let expected = "a signal with values in the whole window";
                    let hint = "choose channels, `from`, `to` and `filter` that the test allows";
                    self.complain(&named.at, found, expected, Some(hint));
                }
            }
        }
        targets
    }

    /// Signals of a test for the compared channels.
    fn pairs(&mut self, named: &Named, recording: &Recording, wanted: &[(Channel, FitChannel)]) -> Vec<Pair> {
        let Some(maps) = self.maps(named) else {
            return Vec::new();
        };
        let names: Vec<Wanted> = wanted.iter().map(|(c, _)| Wanted::from(c)).collect();
        let mut notes = Vec::new();
        let found = pairs(recording, &names, &maps, named.test.seat(), &mut notes);
        self.warnings.extend(notes.into_iter().map(|n| format!("note: {n}")));
        let Ok(pairs) = found.map_err(|failure| self.problems.push(failure.words())) else {
            return Vec::new();
        };
        if pairs.is_empty() {
            let found = format!("no signal of {} matches a channel of the fit", named.file.display());
            let hint = "name columns like channels, or map = [\"column[unit]=channel\"]";
            self.complain(&named.at, found, "a signal to fit to", Some(hint));
        }
        pairs
    }

    /// Compared channels in this scenario; none if the study names a missing one.
    fn wanted(&mut self, fit: &Fit, experiment: usize) -> Option<Vec<(Channel, FitChannel)>> {
        let model = self.experiments[experiment].model.clone();
        if fit.channels.is_empty() {
            let plain = |c: &Channel| FitChannel { name: c.name.clone(), weight: None, filter: None };
            return Some(channels(&model).into_iter().map(|c| (c.clone(), plain(&c))).collect());
        }
        let mut wanted = Vec::new();
        for (i, channel) in fit.channels.iter().enumerate() {
            match find(&model, &channel.name) {
                Ok(found) => wanted.push((found, channel.clone())),
                Err(near) => {
                    let found = format!("there is no channel `{}`", channel.name);
                    let hint = near.nearest.map(|n| format!("did you mean `{n}`?"));
                    let at = format!("fit.channels[{i}].channel");
                    let expected = "a channel of the scenario";
                    self.complain(&at, found, expected, hint.as_deref());
                }
            }
        }
        (wanted.len() == fit.channels.len()).then_some(wanted)
    }

    fn maps(&mut self, named: &Named) -> Option<Vec<MapArgument>> {
        let mut maps = self.given.maps.to_vec();
        let mut whole = true;
        for (i, text) in named.test.map.iter().enumerate() {
            match text.parse() {
                Ok(map) => maps.push(map),
                Err(expected) => {
                    let expected: String = expected;
                    let expected = expected.trim_start_matches("expected ");
                    let at = format!("{}.map[{i}]", named.at);
                    self.complain(&at, format!("`{text}` is not a map"), expected, None);
                    whole = false;
                }
            }
        }
        whole.then_some(maps)
    }
}
