//! The templates of `occupant new`: a driver's scenario, and the changes of the others, section by section.

/// The default template.
pub const STARTER: &str = include_str!("driver.toml");

/// A scenario or study to start from.
#[derive(Clone, Copy, Debug)]
pub struct Template {
    /// Its name.
    pub name: &'static str,
    /// What it describes.
    pub meaning: &'static str,
    content: Content,
}

#[derive(Clone, Copy, Debug)]
enum Content {
    Whole(&'static str),
    /// Sections that replace those of the driver's scenario, or are added to it.
    Changes(&'static str),
}

const fn whole(name: &'static str, meaning: &'static str, text: &'static str) -> Template {
    Template { name, meaning, content: Content::Whole(text) }
}

const fn changes(name: &'static str, meaning: &'static str, text: &'static str) -> Template {
    Template { name, meaning, content: Content::Changes(text) }
}

/// A section and the comments before it.
struct Section<'a> {
    /// Section name; empty for the head of the scenario with its title.
    name: &'a str,
    comments: &'a str,
    text: &'a str,
}

impl Template {
    /// All templates, the default first.
    #[rustfmt::skip]
    pub const ALL: [Template; 14] = [
        whole("driver", "A belted driver, 50 km/h into a stop", STARTER),
        changes("right-hand-drive", "The same in a right-hand-drive car", include_str!("right-hand-drive.toml")),
        changes("rear-seat", "A belted passenger behind the driver, 50 km/h into a stop", include_str!("rear-seat.toml")),
        changes("side", "A belted driver struck on the near side", include_str!("side.toml")),
        changes("far-side", "A belted driver struck on the far side", include_str!("far-side.toml")),
        changes("rear", "A driver struck from behind", include_str!("rear.toml")),
        changes("rollover", "A belted driver in a quarter-turn rollover", include_str!("rollover.toml")),
        changes("edr", "A belted driver in a crash recorded by an event data recorder", include_str!("edr.toml")),
        whole("sled", "A belted occupant on a sled, with a tabulated pulse", include_str!("sled.toml")),
        whole("neck", "Head and neck of a living volunteer driven at T1, as in sled tests", include_str!("neck.toml")),
        whole("pedestrian", "A pedestrian struck by a braking car", include_str!("pedestrian.toml")),
        changes("sensors", "A belted driver in a crash recorded by sensors in the car", include_str!("sensors.toml")),
        changes("drive", "A sedan with a belted driver that runs off the road into a ditch", include_str!("drive.toml")),
        whole("study", "A study of my-case.toml: its parameters and their ranges", include_str!("study.toml")),
    ];

    /// The template with this name.
    pub fn named(name: &str) -> Option<Template> {
        Template::ALL.into_iter().find(|template| template.name == name)
    }

    /// Whether it is a study, not a scenario.
    pub fn is_study(self) -> bool {
        self.name == "study"
    }

    /// Its text.
    pub fn text(self) -> String {
        match self.content {
            Content::Whole(text) => text.to_owned(),
            Content::Changes(text) => changed(STARTER, text),
        }
    }

    /// Next commands for a file of this name.
    pub fn next(self, name: &str) -> String {
        match self.name {
            "drive" => format!("occupant drive {name}\n      occupant run {name}"),
            "study" => format!("occupant sweep {name} --dry-run\n      occupant sweep {name}"),
            _ => format!("occupant check {name}\n      occupant run {name}"),
        }
    }
}

/// The driver's scenario with another title and path; all three as TOML.
pub fn with_path(title: &str, origin: &str, section: &str) -> String {
    let head = "# A belted driver in a generic car, on the vehicle path of a test: change body, posture, belts and interior to those of the test.\n\n";
    let changed = changed(STARTER, &format!("{head}title = {title}\n\n{section}"));
    let line = |line: &str| match line.starts_with("path = ") {
        true => format!("path = {origin}\n"),
        false => line.to_owned(),
    };
    changed.split_inclusive('\n').map(line).collect()
}

/// The sections of `base`, replaced by those of `changes`, then the new sections of `changes`. A changed section keeps
/// its comments unless the change brings its own.
fn changed(base: &str, changes: &str) -> String {
    let (base, changes) = (sections(base), sections(changes));
    let as_changed = |old: &Section<'_>| match changes.iter().find(|new| new.name == old.name) {
        Some(new) if new.comments.trim().is_empty() => old.comments.to_owned() + new.text,
        Some(new) => new.comments.to_owned() + new.text,
        None => old.comments.to_owned() + old.text,
    };
    let is_new = |new: &&Section<'_>| base.iter().all(|old| old.name != new.name);
    let added = changes.iter().filter(is_new).map(|new| new.comments.to_owned() + new.text);
    base.iter().map(as_changed).chain(added).collect()
}

fn sections(text: &str) -> Vec<Section<'_>> {
    let mut sections = Vec::new();
    // where the section under way and its first line begin, where its last key ends, where the line begins
    let (mut name, mut start, mut head, mut end, mut at) = ("", 0, 0, 0, 0);
    for line in text.split_inclusive('\n') {
        if let Some((next, _)) = line.strip_prefix('[').and_then(|header| header.split_once(']')) {
            sections.push(Section { name, comments: &text[start..head], text: &text[head..end] });
            (name, start, head) = (next, end, at);
        }
        at += line.len();
        if !line.starts_with('#') && !line.trim().is_empty() {
            end = at;
        }
    }
    sections.push(Section { name, comments: &text[start..head], text: &text[head..end] });
    sections
}
