//! Ctrl-C and the signals that ask a run to end stop it at its next output; a second one ends it at once.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;

use super::failure::Failure;
use super::talk::say;

/// A file that grows beyond the limit of the process (`ulimit -f`) is a write that fails, which is told as any other, not the signal
/// that ends the process without a word.
pub(crate) fn survive_long_files() {
    #[cfg(unix)]
    {
        let heard = Arc::new(AtomicBool::new(false));
        // where that is impossible the signal does what it did
        let _unheard = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, heard);
    }
}

/// A recorder that stops the run once a signal has come.
#[derive(Clone, Debug, Default)]
pub(crate) struct Interrupt {
    pub(crate) asked: Arc<AtomicBool>,
}

impl Interrupt {
    /// Listens from now on, and answers a signal with these words, those of the first to listen. Where that is impossible a
    /// signal ends the process at once; what was written stays readable.
    pub(crate) fn listen(words: &'static str) -> Self {
        static LISTENING: OnceLock<Interrupt> = OnceLock::new();
        LISTENING.get_or_init(|| Interrupt::begin(words)).clone()
    }

    fn begin(words: &'static str) -> Self {
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

    /// Whether a signal has come.
    pub(crate) fn is_asked(&self) -> bool {
        self.asked.load(Ordering::Relaxed)
    }

    /// Ends the work once a signal has come.
    ///
    /// # Errors
    /// Interrupted, and what was done before.
    pub(crate) fn refuse(&self, done: &str) -> Result<(), Failure> {
        if self.is_asked() { Err(Interrupt::failure(done)) } else { Ok(()) }
    }

    /// Interrupted, and what was done before.
    pub(crate) fn failure(done: &str) -> Failure {
        Failure::BrokeOff("error: interrupted".to_owned()).with_done(done)
    }
}

impl Recorder for Interrupt {
    fn record(&mut self, _sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        Ok(if self.asked.load(Ordering::Relaxed) { Flow::Stop } else { Flow::Continue })
    }
}
