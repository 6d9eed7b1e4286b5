//! From the names of a study and of tests to everything that a fit needs. All that is wrong is told at once.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use occupant_core::results::channel::{Channel, channels, find};
use occupant_core::scenario::Draft;
use occupant_study::{Bounds, Fit, FitChannel, FitTest, Parameter, Study, StudyText};

use super::experiment::Experiment;
use super::target::{Target, filter_of};
use crate::base::names::file_name;
use crate::files::measured::{self, MapArgument, Pair, Wanted, pairs};
use crate::files::scenario::format_of;
use crate::files::signals::Recording;
use crate::files::study_folder::manifest::{Manifest, Text};
use crate::files::study_folder::texts::{NamedBy, Texts};

/// So many evaluations may come on top of the budget.
const ON_TOP: u64 = 1 << 20;

/// A study, its tests, and the scenarios that stand for them. Shared by all threads.
pub(crate) struct Fitting {
    /// Name of the study for messages and results.
    pub(crate) study_name: String,
    /// SHA-256 of the study.
    pub(crate) study_sha256: String,
    /// Title of the study.
    pub(crate) title: String,
    /// What the study says of the fit.
    pub(crate) fit: Fit,
    pub(crate) experiments: Vec<Experiment>,
    pub(crate) tests: Vec<Test>,
    /// Between which ends the parameters are looked for.
    pub(crate) bounds: Vec<Bounds>,
    /// Changes from the command line.
    pub(crate) overrides: Vec<String>,
    /// What the folder of the fit will hold.
    pub(crate) manifest: Manifest,
    /// Bytes of the manifest's texts.
    pub(crate) texts: Vec<Vec<u8>>,
    /// What the user should know.
    pub(crate) warnings: Vec<String>,
}

pub(crate) struct Test {
    /// Its name in results.
    pub(crate) name: String,
    /// Its file, as it was named.
    pub(crate) file: String,
    /// SHA-256 of the file.
    pub(crate) sha256: String,
    /// The scenario that stands for it.
    pub(crate) experiment: usize,
}

/// Tests that the command line gives.
pub(crate) struct Given<'a> {
    pub(crate) files: &'a [PathBuf],
    /// Which column is which channel, in all of them.
    pub(crate) maps: &'a [MapArgument],
    /// Changes in all scenarios.
    pub(crate) overrides: &'a [String],
}

/// A test whose file is known.
struct Named {
    test: FitTest,
    file: PathBuf,
    by: (NamedBy, String),
    /// Where it stands in the study; empty for one of the command line.
    at: String,
}

impl Named {
    fn by_command_line(file: &Path, test: FitTest, at: String) -> Named {
        Named { by: (NamedBy::CommandLineTest, file.display().to_string()), file: file.to_owned(), test, at }
    }
}

impl Fitting {
    /// Reads a study, the scenarios and the tests; `name` is what messages call it.
    ///
    /// # Errors
    /// Everything that is wrong, in words.
    pub(crate) fn open(name: &Path, given: &Given<'_>, program: String) -> Result<Fitting, String> {
        let shown = name.display().to_string();
        let texts = Texts::of_files(name);
        let bytes = texts.get(NamedBy::CommandLine, &file_name(name));
        let bytes = bytes.map_err(|e| format!("error: the study {shown} cannot be read: {e}"))?;
        let text = StudyText::read_bytes(&bytes, format_of(name), &shown);
        let text = text.map_err(|problems| ended(vec![problems.to_string()], &shown))?;
        let fit = text.fit().map_err(|problems| ended(vec![problems.to_string()], &shown))?;
        let mut opening = Opening {
            folder: name.parent().unwrap_or(Path::new("")).to_owned(),
            text: &text,
            texts: &texts,
            given,
            problems: Vec::new(),
            warnings: Vec::new(),
            experiments: Vec::new(),
            failed: Vec::new(),
        };
        let named = opening.named(&fit);
        let tests = opening.tests(&fit, named);
        if !opening.problems.is_empty() || opening.experiments.is_empty() {
            return Err(ended(opening.problems, &shown));
        }
        let Opening { experiments, warnings, .. } = opening;
        let bounds = experiments[0].study.parameters().iter();
        let bounds: Option<Vec<Bounds>> = bounds.map(Parameter::bounds).collect();
        // bind_fit has refused parameters without ends
        let bounds = bounds.ok_or("error: a parameter without ends")?;
        let (manifest, texts) = manifest(&text, &texts, given, experiments.len() as u64, fit.budget, program);
        Ok(Fitting {
            study_name: file_name(name),
            study_sha256: manifest.texts[0].sha256.clone(),
            title: manifest.title.clone(),
            fit,
            experiments,
            tests,
            bounds,
            overrides: given.overrides.to_vec(),
            manifest,
            texts,
            warnings,
        })
    }

    /// What is fitted.
    pub(crate) fn parameters(&self) -> &[Parameter] {
        self.experiments[0].study.parameters()
    }

    /// Values of the parameters, SI, at a point of the unit cube.
    pub(crate) fn values(&self, at: &[f64]) -> Vec<f64> {
        self.bounds.iter().zip(at).map(|(b, u)| b.value(*u)).collect()
    }

    /// The score of all targets, experiment by experiment.
    pub(crate) fn score(&self, parts: &[f64]) -> f64 {
        let weights = self.targets().map(|(_, target)| target.weight);
        self.fit.misfit.combined(weights.zip(parts.iter().copied()))
    }

    /// All targets, experiment by experiment, and of which test each is.
    pub(crate) fn targets(&self) -> impl Iterator<Item = &(usize, Target)> {
        self.experiments.iter().flat_map(|e| &e.targets)
    }

    /// Where the search begins: at the base scenario's values where they lie between the bounds, else in the middle.
    pub(crate) fn start(&self) -> Vec<f64> {
        let start = |(parameter, bounds): (&Parameter, &Bounds)| match parameter.nominal() {
            occupant_study::Value::Number(x) => {
                let u = bounds.part(x);
                if (0.0..=1.0).contains(&u) { u } else { 0.5 }
            }
            _ => 0.5,
        };
        self.parameters().iter().zip(&self.bounds).map(start).collect()
    }
}

/// What the folder of the fit will hold, and the bytes of its texts.
fn manifest(
    text: &StudyText,
    texts: &Texts,
    given: &Given<'_>,
    experiments: u64,
    budget: u64,
    program: String,
) -> (Manifest, Vec<Vec<u8>>) {
    let title = text.section.title.clone().unwrap_or_default();
    let words = given.overrides.iter().cloned();
    let words = words.chain(given.maps.iter().map(|m| format!("--map {m}")));
    let samples = experiments * budget.saturating_add(ON_TOP);
    let mut manifest = Manifest::new(program, title, samples, words.collect());
    let (texts, bytes) = texts.all();
    // where a test lies is no part of the fit
    let named = |text: Text| match text.by {
        NamedBy::CommandLineTest => Text { name: file_name(Path::new(&text.name)), ..text },
        _ => text,
    };
    manifest.texts = texts.into_iter().map(named).collect();
    (manifest, bytes)
}

/// Work on a fit that is being opened, with the problems found so far.
struct Opening<'a> {
    folder: PathBuf,
    text: &'a StudyText,
    texts: &'a Texts,
    given: &'a Given<'a>,
    problems: Vec<String>,
    warnings: Vec<String>,
    experiments: Vec<Experiment>,
    /// Scenarios that were refused.
    failed: Vec<FitTest>,
}

impl Opening<'_> {
    fn complain(&mut self, at: &str, found: String, expected: &str, hint: Option<&str>) {
        let told = self.text.complaint(at, found, expected, hint.map(str::to_owned));
        self.problems.push(told.to_string());
    }

    /// The tests with their files: those of the study, and where it leaves files out those of the command line, in order.
    fn named(&mut self, fit: &Fit) -> Vec<Named> {
        let files = self.given.files;
        if fit.tests.is_empty() {
            if files.is_empty() {
                let hint = "--to test.csv, or [[fit.tests]] with `file`";
                self.complain("", "no test to fit to".to_owned(), "a test", Some(hint));
            }
            let each = files.iter();
            return each.map(|f| Named::by_command_line(f, FitTest::default(), String::new())).collect();
        }
        let open = fit.tests.iter().filter(|t| t.file.is_none()).count();
        if open != files.len() {
            let found = match files.len() {
                0 => format!("{open} of the study's tests have no file"),
                n => format!("{n} files with --to for {open} tests that leave theirs to it"),
            };
            let hint = "--to gives the files of the tests without `file`, in their order";
            self.complain("fit.tests", found, "a file for each test", Some(hint));
            return Vec::new();
        }
        let mut files = files.iter();
        let mut named = Vec::new();
        for (i, test) in fit.tests.iter().enumerate() {
            let at = format!("fit.tests[{i}]");
            match &test.file {
                Some(file) => named.push(Named {
                    file: self.folder.join(file),
                    by: (NamedBy::Study, file.clone()),
                    test: test.clone(),
                    at,
                }),
                None => named.extend(files.next().map(|f| Named::by_command_line(f, test.clone(), at))),
            }
        }
        named
    }

    /// Reads tests and scenarios and brings them together.
    fn tests(&mut self, fit: &Fit, named: Vec<Named>) -> Vec<Test> {
        let mut tests: Vec<Test> = Vec::new();
        let mut met: BTreeSet<String> = BTreeSet::new();
        for named in named {
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
                let found = format!("a second test named \"{name}\"");
                self.complain(&named.at, found, "a `name` of its own", None);
            }
            tests.push(Test {
                name,
                file: match named.by.0 {
                    NamedBy::CommandLineTest => file_name(&named.file),
                    _ => named.by.1.clone(),
                },
                sha256: recording.sha256.clone(),
                experiment,
            });
        }
        if self.problems.is_empty() {
            self.refuse_unmet(fit, &met);
        }
        tests
    }

    /// Complains of channels that no test has a signal for.
    fn refuse_unmet(&mut self, fit: &Fit, met: &BTreeSet<String>) {
        for (i, channel) in fit.channels.iter().enumerate().filter(|(_, c)| !met.contains(&c.name)) {
            let found = format!("no test has a signal for `{}`", channel.name);
            let hint = "say which column it is: map = [\"column[unit]=channel\"] of the test, or --map";
            let at = format!("fit.channels[{i}].channel");
            self.complain(&at, found, "a column of that name", Some(hint));
        }
    }

    /// The scenario that stands for a test: one that is there already, or a new one.
    fn experiment(&mut self, named: &Named) -> Option<usize> {
        let test = &named.test;
        let there = self.experiments.iter().position(|e| e.stands_for(test));
        if there.is_some() {
            return there;
        }
        let told = |t: &FitTest| (&t.base, &t.set) == (&test.base, &test.set);
        if self.failed.iter().any(told) {
            return None;
        }
        match self.new_experiment(named) {
            Ok(experiment) => {
                self.experiments.push(experiment);
                Some(self.experiments.len() - 1)
            }
            Err(problem) => {
                // the same is said of every scenario
                if !self.problems.contains(&problem) {
                    self.problems.push(problem);
                }
                self.failed.push(test.clone());
                None
            }
        }
    }

    fn new_experiment(&mut self, named: &Named) -> Result<Experiment, String> {
        let base = named.test.base.as_deref().unwrap_or(self.text.base());
        let by = match named.test.base {
            Some(_) => NamedBy::Study,
            None => NamedBy::StudyAsBase,
        };
        let path = self.folder.join(base);
        let shown = path.display().to_string();
        let bytes = self.texts.get(by, base).map_err(|e| format!("error: the scenario {shown} cannot be read: {e}"))?;
        let draft = Draft::read_bytes(&bytes, format_of(&path), &shown);
        let draft = draft.map_err(|e| e.to_string())?;
        let at = format!("{}.set", named.at);
        let beside = |file: &str| self.texts.get(NamedBy::Study, file);
        let study = self
            .text
            .bind_fit(draft, (&named.test.set, &at), self.given.overrides, &beside)
            .map_err(|e| e.to_string())?;
        if !study.warnings().is_empty() {
            self.warnings.push(study.warnings().to_string());
        }
        let tables = self.tables(&study, base);
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let new = Experiment::new(path, text, named.test.clone(), study, tables);
        let (experiment, warnings) = new.map_err(|e| e.to_string())?;
        if !warnings.is_empty() {
            self.warnings.push(warnings.to_string());
        }
        Ok(experiment)
    }

    /// The file that a scenario names, if it names one; one that cannot be read is told when the scenario is opened.
    fn tables(&self, study: &Study, base: &str) -> Vec<(String, Vec<u8>)> {
        use occupant_core::scenario::text::Value;
        let beside = Path::new(base).parent().unwrap_or(Path::new(""));
        let named = study.base().clone().get("path.file").unwrap_or_default();
        let read = |(_, value): (String, Value)| {
            let Value::String(name) = value else {
                return None;
            };
            let place = beside.join(&name).display().to_string();
            let bytes = self.texts.get(NamedBy::Study, &place).ok()?;
            Some((name, bytes))
        };
        named.into_iter().filter_map(read).collect()
    }

    fn recording(&mut self, named: &Named) -> Option<Recording> {
        match measured::read(&named.file) {
            Ok(recording) => {
                for note in &recording.notes {
                    self.warnings.push(format!("note: {note}"));
                }
                // a copy for the folder; of an ISO-MME test its checksum only
                let mme = named.file.extension().is_some_and(|e| e.eq_ignore_ascii_case("mme"));
                let single = named.file.is_file() && !mme;
                let copied = single && self.texts.get(named.by.0, &named.by.1).is_ok();
                if !copied {
                    self.texts.add(named.by.0, &named.by.1, recording.sha256.clone());
                }
                Some(recording)
            }
            Err(failure) => {
                self.problems.push(failure.words());
                None
            }
        }
    }

    /// The measured channels of a test.
    fn targets(&mut self, fit: &Fit, named: &Named, recording: &Recording, experiment: usize) -> Vec<Target> {
        let Some(wanted) = self.wanted(fit, experiment) else {
            return Vec::new();
        };
        let run_s = self.experiments[experiment].run_s();
        let window_s = [0, 1].map(|i| named.test.window_s()[i].or(fit.window_s[i]));
        let mut targets = Vec::new();
        for pair in self.pairs(named, recording, &wanted) {
            let (channel, of) = &wanted[pair.channel];
            let weight = of.weight() * named.test.weight();
            let shifted = (pair, named.test.shift_s());
            match Target::new(
                channel.clone(),
                filter_of(of.filter.unwrap_or(fit.filter)),
                weight,
                shifted,
                window_s,
                run_s,
                fit.misfit,
            ) {
                Ok(target) => targets.push(target),
                Err(reason) => {
                    let found = format!("{} of {} cannot be fitted to: {reason}", channel.name, named.file.display());
                    let expected = "a signal with values all through the window";
                    let hint = "choose channels, `from`, `to` and `filter` that the test allows";
                    self.complain(&named.at, found, expected, Some(hint));
                }
            }
        }
        targets
    }

    /// The signals of a test that are channels which count.
    fn pairs(&mut self, named: &Named, recording: &Recording, wanted: &[(Channel, FitChannel)]) -> Vec<Pair> {
        let Some(maps) = self.maps(named) else {
            return Vec::new();
        };
        let names: Vec<Wanted> = wanted.iter().map(|(c, _)| Wanted::from(c)).collect();
        let mut notes = Vec::new();
        let found = pairs(recording, &names, &maps, named.test.seat(), &mut notes);
        self.warnings.extend(notes.into_iter().map(|n| format!("note: {n}")));
        let found = match found {
            Ok(found) => found,
            Err(failure) => {
                self.problems.push(failure.words());
                return Vec::new();
            }
        };
        if found.is_empty() {
            let found = format!("no signal of {} belongs to a channel that counts", named.file.display());
            let hint = "columns are named as channels are, or map = [\"column[unit]=channel\"]";
            self.complain(&named.at, found, "a signal to fit to", Some(hint));
        }
        found
    }

    /// The channels that count, in this scenario; none if the study names one that there is not.
    fn wanted(&mut self, fit: &Fit, experiment: usize) -> Option<Vec<(Channel, FitChannel)>> {
        let model = self.experiments[experiment].model.clone();
        if fit.channels.is_empty() {
            let of = |channel: Channel| {
                let like = FitChannel { name: channel.name.clone(), weight: None, filter: None };
                (channel, like)
            };
            return Some(channels(&model).into_iter().map(of).collect());
        }
        let mut wanted = Vec::new();
        for (i, channel) in fit.channels.iter().enumerate() {
            match find(&model, &channel.name) {
                Ok(found) => wanted.push((found, channel.clone())),
                Err(near) => {
                    let found = format!("there is no channel `{}`", channel.name);
                    let hint = near.map(|n| format!("did you mean `{n}`?"));
                    let at = format!("fit.channels[{i}].channel");
                    let expected = "a channel of the scenario";
                    let told = self.text.complaint(&at, found, expected, hint).to_string();
                    // of several scenarios it is said once
                    if !self.problems.contains(&told) {
                        self.problems.push(told);
                    }
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
                    self.complain(&at, format!("`{text}` is no map"), expected, None);
                    whole = false;
                }
            }
        }
        whole.then_some(maps)
    }
}

/// All problems as the end of the command.
fn ended(problems: Vec<String>, study: &str) -> String {
    let mut blocks: Vec<&str> = Vec::new();
    let all = problems.iter().flat_map(|p| p.split("\n\n"));
    for block in all {
        if !blocks.contains(&block) {
            blocks.push(block);
        }
    }
    let errors = blocks.iter().filter(|b| b.starts_with("error")).count();
    let count = match errors {
        1 => "1 error".to_owned(),
        n => format!("{n} errors"),
    };
    format!("{}\n\n{study}: {count}, nothing was run", blocks.join("\n\n"))
}
