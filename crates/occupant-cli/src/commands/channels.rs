//! `occupant channels`.

use std::path::{Path, PathBuf};

use crash_measures::injury::{Measure, Options, Signals, assess};
use occupant_core::model::Model;
use occupant_core::results::channel::{Channel, channels as all_of};
use occupant_scenario::{Draft, Format};
use placed_text::did_you_mean;

use crate::base::text_table::{Align, Table};
use crate::base::{Failure, by_ending, ending, talk};
use occupant_files::results::Results;
use occupant_jobs::files::scenario::{self, ScenarioArgs};

/// List the channels of a run: name, unit, meaning
///
/// Other commands take these names in --channel; `*` matches any part of a name. {x,y,z} stands for three channels.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// List only channels with this word in their name or meaning, such as head, belt or "chest deflection"; or the
    /// run, scenario or deck whose channels to list
    #[arg(value_name = "WORD|FILE")]
    word: Option<String>,

    /// The run, scenario or deck; the scenario of `occupant new` if absent
    #[arg(long, value_name = "RUN.mcap|SCENARIO")]
    of: Option<PathBuf>,
}

pub(crate) fn channels(args: &Args) -> Result<(), Failure> {
    let file = args.word.as_ref().filter(|word| args.of.is_none() && is_file(word));
    let model = match args.of.as_deref().or_else(|| file.map(Path::new)) {
        Some(file) => model_of(file)?,
        None => starter()?,
    };
    let word = if file.is_some() { String::new() } else { args.word.as_deref().unwrap_or_default().to_lowercase() };
    let all = all_of(&model);
    // whole words first: `hic` is no vehicle
    let is_word = |text: &str| text.split(|c: char| !c.is_alphanumeric()).any(|own| own.to_lowercase() == word);
    let has_words = |c: &Channel| {
        let text = format!("{} {}", c.name, c.meaning).to_lowercase();
        word.split_whitespace().all(|own| text.contains(own))
    };
    let that = |is: &dyn Fn(&Channel) -> bool| rows(all.iter().filter(|c| is(c)));
    let mut found = if word.is_empty() { Vec::new() } else { that(&|c| is_word(&c.name) || is_word(&c.meaning)) };
    if found.is_empty() && measure(&word).is_none() {
        found = that(&has_words);
    }
    if found.is_empty() {
        if let Some(label) = measure(&word) {
            let help = "`occupant measures RUN.mcap` prints the measures of a run";
            return Err(Failure::with_help(format!("{label} is a measure, one number per run, not a channel"), help));
        }
        let words: Vec<&str> = all.iter().flat_map(|channel| channel.name.split(['.', '_'])).collect();
        let help = did_you_mean(&word, &words, '`').unwrap_or_else(|| "`occupant channels` lists them all".to_owned());
        return Err(Failure::with_help(format!("no channel has `{word}` in its name or meaning"), &help));
    }
    let mut table = Table::new(&[(Align::Left, &["channel", "unit", "meaning"])]);
    found.into_iter().for_each(|row| table.row(row));
    talk::print(&table.text())
}

/// Whether a word names a file whose channels can be listed.
fn is_file(word: &str) -> bool {
    let path = Path::new(word);
    path.is_file() || by_ending(path, &[("mcap", ()), ("toml", ()), ("json", ())]).is_some()
}

/// Label of the measure that a word means, with or without a number after it.
fn measure(word: &str) -> Option<&'static str> {
    let all = assess(&Signals::new(), &Options::default());
    let is_it = |measure: &Measure| {
        measure
            .name
            .split('_')
            .next()
            .is_some_and(|own| own == word || own.trim_end_matches(|c: char| c.is_ascii_digit()) == word)
    };
    all.iter().find(|measure| is_it(measure)).map(|measure| measure.label)
}

/// Name, unit and meaning; components of one vector in one row.
fn rows<'a>(channels: impl Iterator<Item = &'a Channel>) -> Vec<[String; 3]> {
    let mut rows: Vec<(&str, Vec<&str>, &Channel)> = Vec::new();
    for channel in channels {
        let (stem, component) = channel.name.rsplit_once('.').unwrap_or(("", &channel.name));
        match rows.last_mut() {
            Some((own, components, first)) if *own == stem && first.meaning == channel.meaning => {
                components.push(component);
            }
            _ => rows.push((stem, vec![component], channel)),
        }
    }
    let row = |(stem, components, first): (&str, Vec<&str>, &Channel)| {
        let name = match &components[..] {
            [_] => first.name.clone(),
            several => format!("{stem}.{{{}}}", several.join(",")),
        };
        [name, first.unit.symbol().to_owned(), first.meaning.clone()]
    };
    rows.into_iter().map(row).collect()
}

fn model_of(file: &Path) -> Result<Model, Failure> {
    if ending(file) == "mcap" {
        return Ok(Results::open(file)?.model);
    }
    let opened = scenario::open(&ScenarioArgs { scenario: file.to_owned(), overrides: Vec::new() })?;
    Ok(opened.model)
}

fn starter() -> Result<Model, Failure> {
    let wrong = |problems| Failure::plain(format!("the starter scenario cannot be read: {problems}"));
    let draft = Draft::read_bytes(occupant_jobs::templates::STARTER.as_bytes(), Some(Format::Toml), "starter")
        .map_err(wrong)?;
    let loaded = draft.load(&|name| Err(format!("{name}: it must not name files"))).map_err(wrong)?;
    Ok(loaded.model().map_err(wrong)?.0)
}
