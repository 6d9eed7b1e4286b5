//! Ctrl-C and the signals that ask a run to end stop it at its next output; a second one ends it at once.

use std::sync::atomic::Ordering;
use std::sync::{Arc, OnceLock};

use occupant_jobs::base::Interrupt;

use super::talk::say;

/// Makes a file that exceeds the process's size limit (`ulimit -f`) a reported write error, instead of a signal that
/// ends the process silently.
pub(crate) fn survive_long_files() {
    #[cfg(unix)]
    {
        let heard = Arc::default();
        // where that is impossible the signal does what it did
        let _unheard = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, heard);
    }
}

/// Listens for signals from now on and answers with these words, those of the first to listen. Where that is
/// impossible, a signal ends the process at once; written files stay readable.
pub(crate) fn listen(words: &'static str) -> Interrupt {
    static LISTENING: OnceLock<Interrupt> = OnceLock::new();
    LISTENING.get_or_init(|| begin(words)).clone()
}

fn begin(words: &'static str) -> Interrupt {
    let interrupt = Interrupt::default();
    let asked = Arc::clone(&interrupt.asked);
    let handler = move || {
        if asked.swap(true, Ordering::Relaxed) {
            // the next output is too far away; what was written stays readable under the partial name
            std::process::exit(1);
        }
        say(words);
    };
    if let Err(error) = ctrlc::set_handler(handler) {
        say(&format!("warning: Ctrl-C will end the run at once: {error}"));
    }
    interrupt
}
