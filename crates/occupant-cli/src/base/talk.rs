//! The two voices: results on standard output, talk on standard error.

use std::fs::symlink_metadata;
use std::io::{self, ErrorKind, Write, stderr, stdout};
use std::sync::atomic::{AtomicBool, Ordering};

use placed_text::plain;

use occupant_jobs::base::text_table::fit_terminal;
use occupant_jobs::base::{Failure, talk};

use super::progress::{beside_line, end_line};

/// Whether the process started with its standard output closed. The standard library opens `/dev/null` in its place
/// before `main`, so that writing to it fails silently.
static CLOSED: AtomicBool = AtomicBool::new(false);

ctor::declarative::ctor! {
    #[ctor(unsafe)]
    fn look_before_main() {
        let is_there = |path| symlink_metadata(path).is_ok();
        CLOSED.store(cfg!(unix) && is_there("/dev/fd") && !is_there("/dev/fd/1"), Ordering::Relaxed);
    }
}

/// Prints a result with control characters escaped. A closed pipe is no error. An exceeded limit is red where the terminal
/// has colours, by <https://no-color.org> and `CLICOLOR_FORCE`; an old console of Windows is coloured through its own calls.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let text = plain(text).replace(BEYOND, &format!("\u{1b}[1;31m{BEYOND}\u{1b}[0m"));
    end_line();
    written(anstream::stdout().write_all(text.as_bytes()))
}

/// Verdict of an exceeded limit.
const BEYOND: &str = "EXCEEDED";

/// Prints the bytes of a file unchanged. A closed pipe is no error.
pub(crate) fn print_file(bytes: &[u8]) -> Result<(), Failure> {
    end_line();
    written(stdout().write_all(bytes))
}

/// Outcome of writing a result to standard output.
pub(crate) fn written(result: io::Result<()>) -> Result<(), Failure> {
    let open = if CLOSED.load(Ordering::Relaxed) { Err(io::Error::other("it is closed")) } else { Ok(()) };
    match open.and(result).and_then(|()| stdout().flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::BrokeOff(format!("error: the result could not be written to standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Prints a message to standard error with control characters escaped. Write errors are ignored.
pub(crate) fn say(text: &str) {
    beside_line(|| {
        let _unwritten = writeln!(stderr().lock(), "{}", plain(text));
    });
}

/// Prints messages of jobs to standard error.
struct Voice;

impl log::Log for Voice {
    fn enabled(&self, about: &log::Metadata<'_>) -> bool {
        about.target() == talk::TARGET
    }

    fn log(&self, message: &log::Record<'_>) {
        if self.enabled(message.metadata()) {
            say(&message.args().to_string());
        }
    }

    fn flush(&self) {}
}

/// Sends messages of jobs to standard error from now on, and fits their tables to the terminal.
pub(crate) fn hear_jobs() {
    if let Some((terminal_size::Width(columns), _)) = terminal_size::terminal_size_of(stdout()) {
        fit_terminal(columns);
    }
    // whoever uses the command as a library may listen elsewhere
    if log::set_logger(&Voice).is_ok() {
        log::set_max_level(log::LevelFilter::Info);
    }
}
