//! The templates of `occupant new`: a driver's scenario, and the changes of the others, section by section.

/// The default template.
pub const STARTER: &str = include_str!("driver.toml");

/// A scenario or study to start from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Template {
    /// A belted driver, 50 km/h into a stop.
    #[default]
    Driver,
    /// The same in a right-hand-drive car.
    RightHandDrive,
    /// A belted passenger behind the driver.
    RearSeat,
    /// A belted driver struck on the near side.
    Side,
    /// A belted driver struck on the far side.
    FarSide,
    /// A driver struck from behind.
    Rear,
    /// A belted driver in a quarter-turn rollover.
    Rollover,
    /// A crash recorded by an event data recorder.
    Edr,
    /// A belted occupant on a sled.
    Sled,
    /// Head and neck of a volunteer.
    Neck,
    /// A pedestrian struck by a braking car.
    Pedestrian,
    /// A crash recorded by sensors in the car.
    Sensors,
    /// A sedan that runs off the road.
    Drive,
    /// A study of my-case.toml.
    Study,
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
    pub const ALL: [Template; 14] = {
        use Template::*;
        [
            Driver,
            RightHandDrive,
            RearSeat,
            Side,
            FarSide,
            Rear,
            Rollover,
            Edr,
            Sled,
            Neck,
            Pedestrian,
            Sensors,
            Drive,
            Study,
        ]
    };

    /// Its name, and what it describes.
    pub fn words(self) -> (&'static str, &'static str) {
        match self {
            Template::Driver => ("driver", "A belted driver, 50 km/h into a stop"),
            Template::RightHandDrive => ("right-hand-drive", "The same in a right-hand-drive car"),
            Template::RearSeat => ("rear-seat", "A belted passenger behind the driver, 50 km/h into a stop"),
            Template::Side => ("side", "A belted driver struck on the near side"),
            Template::FarSide => ("far-side", "A belted driver struck on the far side"),
            Template::Rear => ("rear", "A driver struck from behind"),
            Template::Rollover => ("rollover", "A belted driver in a quarter-turn rollover"),
            Template::Edr => ("edr", "A belted driver in a crash recorded by an event data recorder"),
            Template::Sled => ("sled", "A belted occupant on a sled, with a tabulated pulse"),
            Template::Neck => ("neck", "Head and neck of a living volunteer driven at T1, as in sled tests"),
            Template::Pedestrian => ("pedestrian", "A pedestrian struck by a braking car"),
            Template::Sensors => ("sensors", "A belted driver in a crash recorded by sensors in the car"),
            Template::Drive => ("drive", "A sedan with a belted driver that runs off the road into a ditch"),
            Template::Study => ("study", "A study of my-case.toml: its parameters and their ranges"),
        }
    }

    /// The scenario.
    pub fn text(self) -> String {
        let driver = STARTER;
        match self {
            Template::Driver => driver.to_owned(),
            Template::RightHandDrive => changed(driver, include_str!("right-hand-drive.toml")),
            Template::RearSeat => changed(driver, include_str!("rear-seat.toml")),
            Template::Side => changed(driver, include_str!("side.toml")),
            Template::FarSide => changed(driver, include_str!("far-side.toml")),
            Template::Rear => changed(driver, include_str!("rear.toml")),
            Template::Rollover => changed(driver, include_str!("rollover.toml")),
            Template::Edr => changed(driver, include_str!("edr.toml")),
            Template::Sled => include_str!("sled.toml").to_owned(),
            Template::Neck => include_str!("neck.toml").to_owned(),
            Template::Pedestrian => include_str!("pedestrian.toml").to_owned(),
            Template::Sensors => changed(driver, include_str!("sensors.toml")),
            Template::Drive => changed(driver, include_str!("drive.toml")),
            Template::Study => include_str!("study.toml").to_owned(),
        }
    }

    /// Next commands for a file of this name.
    pub fn next(self, name: &str) -> String {
        match self {
            Template::Drive => format!("occupant drive {name}\n      occupant run {name}"),
            Template::Study => format!("occupant sweep {name} --dry-run\n      occupant sweep {name}"),
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
