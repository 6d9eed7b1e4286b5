//! The list of commands in `occupant --help`, grouped by job.

use std::fmt::Write;

/// Groups of commands, by job.
const GROUPS: [(&str, &[&str]); 7] = [
    ("Set up a case", &["new", "check", "explain", "schema", "surface"]),
    ("Simulate", &["run", "drive"]),
    ("Look at a run", &["view", "report", "seal", "plot", "print", "channels"]),
    ("Judge a run or a test", &["measures", "compare", "risk", "sensitivity"]),
    ("Many runs", &["sweep", "study", "fit", "optimise"]),
    ("Exchange data with other programs and tests", &["import", "export", "convert"]),
    ("This program", &["completions", "man", "help"]),
];

/// The command line with its help grouped by job.
pub(super) fn grouped(command: clap::Command) -> clap::Command {
    let mut list = String::new();
    for (title, names) in GROUPS {
        _ = writeln!(list, "{title}:");
        for name in names {
            let about = command.find_subcommand(name).and_then(clap::Command::get_about).map(ToString::to_string);
            let about = about.unwrap_or_else(|| "Show this help, or the help of a command".to_owned());
            _ = writeln!(list, "  {name:<12} {about}");
        }
        list.push('\n');
    }
    command.help_template(format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{list}Options:\n{{options}}{{after-help}}"
    ))
}
