//! Work that goes on without Python's lock, shows its progress in Python and stops at Ctrl-C.

use std::cell::RefCell;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{Builder, scope};
use std::time::{Duration, Instant};

use log::{LevelFilter, Log, Metadata, Record};
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_jobs::base::progress::Bar;
use occupant_jobs::base::talk::TARGET;
use occupant_jobs::base::{Failure, Interrupt, Show};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict};

use crate::trouble::{failed, plain};

/// How long work goes on before it looks for Ctrl-C.
const LOOK: Duration = Duration::from_millis(50);
/// As the engine's: models of many bodies are large to build.
const STACK: usize = 16 << 20;

/// Progress as Python wants it.
pub(crate) struct Progress {
    how: How,
    done: AtomicU64,
    /// What the function raised.
    raised: Mutex<Option<PyErr>>,
}

enum How {
    /// A function of the number of steps done, and of all.
    Function(Py<PyAny>),
    /// A bar of tqdm.
    Tqdm(Py<PyAny>),
}

impl Progress {
    /// None of None and False; a bar of tqdm for True; else a function.
    pub(crate) fn of(py: Python<'_>, asked: Option<&Bound<'_, PyAny>>, what: &str) -> PyResult<Option<Arc<Self>>> {
        let Some(asked) = asked else { return Ok(None) };
        let how = match asked.cast::<PyBool>() {
            Ok(is) if !is.is_true() => return Ok(None),
            Ok(_) => How::Tqdm(tqdm(py, what)?),
            Err(_) if asked.is_callable() => How::Function(asked.clone().unbind()),
            Err(_) => return Err(plain("progress is neither true, false nor a function; expected f(done, all)")),
        };
        Ok(Some(Arc::new(Progress { how, done: AtomicU64::new(0), raised: Mutex::new(None) })))
    }

    /// Shows that `done` of `all` steps are done.
    pub(crate) fn see(&self, done: u64, all: u64) {
        let before = self.done.swap(done, Ordering::Relaxed);
        let shown = Python::attach(|py| match &self.how {
            How::Function(function) => function.call1(py, (done, all)).map(drop),
            How::Tqdm(bar) => {
                bar.setattr(py, "total", all)?;
                bar.call_method1(py, "update", (done.saturating_sub(before),)).map(drop)
            }
        });
        if let Err(error) = shown {
            self.raised.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
        }
    }

    fn end(&self) {
        if let How::Tqdm(bar) = &self.how {
            // a bar that cannot be closed has been seen
            let _closed = Python::attach(|py| bar.call_method0(py, "close"));
        }
    }

    fn has_raised(&self) -> bool {
        self.raised.lock().unwrap_or_else(PoisonError::into_inner).is_some()
    }

    fn take(&self) -> Option<PyErr> {
        self.raised.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

fn tqdm(py: Python<'_>, what: &str) -> PyResult<Py<PyAny>> {
    let missing =
        |_| plain("progress=True needs tqdm, which is not installed; expected `pip install tqdm`, or a function");
    let module = py.import("tqdm.auto").map_err(missing)?;
    let options = PyDict::new(py);
    options.set_item("unit", what)?;
    Ok(module.getattr("tqdm")?.call((), Some(&options))?.unbind())
}

/// A bar of a job as a function of Python sees it.
struct PythonBar {
    progress: Arc<Progress>,
    all: AtomicU64,
}

impl Bar for PythonBar {
    fn set_length(&self, all: u64) {
        self.all.store(all, Ordering::Relaxed);
    }

    fn set_position(&self, done: u64) {
        self.progress.see(done, self.all.load(Ordering::Relaxed));
    }

    fn set_message(&self, _words: String) {}

    fn forget_rate(&self) {}

    fn clear(&self) {}
}

thread_local! {
    /// Progress of the job on this thread.
    static SHOWN: RefCell<Option<Arc<Progress>>> = const { RefCell::new(None) };
}

/// Display of the job on this thread.
pub(crate) const SHOW: Show = Show {
    quiet: false,
    bar: |all, _what| {
        let shown = SHOWN.with_borrow(Clone::clone);
        shown.map(|progress| Box::new(PythonBar { progress, all: AtomicU64::new(all) }) as Box<dyn Bar>)
    },
};

/// Does the work on a thread of its own, without Python's lock. Ctrl-C and an exception of the progress ask it to stop.
pub(crate) fn work<T: Send>(
    py: Python<'_>,
    progress: Option<Arc<Progress>>,
    job: impl FnOnce(&Interrupt) -> Result<T, Failure> + Send,
) -> PyResult<T> {
    let interrupt = Interrupt::default();
    let (done, mut raised) = py.detach(|| {
        scope(|scope| {
            let (at_work, ended) = channel::<()>();
            let (interrupt, shown) = (&interrupt, progress.clone());
            let worker = Builder::new().stack_size(STACK).spawn_scoped(scope, move || {
                let _until_the_end = at_work;
                SHOWN.set(shown);
                job(interrupt)
            });
            let Ok(worker) = worker else { return (Err(plain("no thread can be started")), None) };
            let mut raised = None;
            while ended.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
                if raised.is_none() {
                    raised = Python::attach(|py| py.check_signals()).err();
                }
                if raised.is_some() || progress.as_ref().is_some_and(|own| own.has_raised()) {
                    interrupt.asked.store(true, Ordering::Relaxed);
                }
            }
            let done = worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            (done.map_err(failed), raised)
        })
    });
    if let Some(progress) = progress {
        progress.end();
        raised = raised.or(progress.take());
    }
    raised.map_or(done, Err)
}

/// Passes messages of jobs to Python's logger `occupant`.
struct Logger;

impl Log for Logger {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        metadata.target() == TARGET
    }

    fn log(&self, record: &Record<'_>) {
        if !self.enabled(record.metadata()) {
            return;
        }
        let text = record.args().to_string();
        let level = if text.starts_with("warning") { "warning" } else { "info" };
        Python::attach(|py| {
            let logger = py.import("logging").and_then(|logging| logging.call_method1("getLogger", (TARGET,)));
            // a message that nobody can hear is lost
            let _heard = logger.and_then(|logger| logger.call_method1(level, (text,)));
        });
    }

    fn flush(&self) {}
}

/// Passes messages of jobs to Python from now on.
pub(crate) fn hear() {
    // where the process has another logger, that one hears them
    if log::set_logger(&Logger).is_ok() {
        log::set_max_level(LevelFilter::Info);
    }
}

/// Watches a run on the thread that called: Ctrl-C and an exception of the progress stop it.
pub(crate) struct Watcher {
    progress: Option<Arc<Progress>>,
    all: u64,
    looked: Instant,
    raised: Option<PyErr>,
}

impl Watcher {
    pub(crate) fn new(progress: Option<Arc<Progress>>, all: usize) -> Self {
        Watcher { progress, all: all as u64, looked: Instant::now(), raised: None }
    }

    /// What stopped the run, if anything did.
    pub(crate) fn raised(self) -> Option<PyErr> {
        let of_progress = self.progress.and_then(|progress| {
            progress.end();
            progress.take()
        });
        self.raised.or(of_progress)
    }
}

impl Recorder for Watcher {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        let done = sample.index as u64 + 1;
        let is_due = self.looked.elapsed() > LOOK;
        if is_due || done == self.all {
            self.looked = Instant::now();
            self.progress.iter().for_each(|progress| progress.see(done, self.all));
        }
        if is_due {
            self.raised = Python::attach(|py| py.check_signals()).err();
        }
        let is_over = self.raised.is_some() || self.progress.as_ref().is_some_and(|own| own.has_raised());
        Ok(if is_over { Flow::Stop } else { Flow::Continue })
    }
}
