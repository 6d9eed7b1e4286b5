//! Waiting for another process that is at work in a folder.

use std::thread::sleep;
use std::time::Duration;

use super::problem::Problem;
use crate::base::{Failure, Interrupt, say};

/// Interval of looks at a folder in which another process is at work.
const LOOK_AGAIN: Duration = Duration::from_millis(500);

/// What a command does where another process is at work.
#[derive(Clone, Copy, Debug)]
pub struct Waiting<'a> {
    /// Whether it waits, or gives up.
    pub wait: bool,
    /// Whether it says nothing of it.
    pub quiet: bool,
    /// Request to stop.
    pub interrupt: &'a Interrupt,
}

impl Waiting<'_> {
    /// What `claim` gives, once no other process is in its way.
    ///
    /// # Errors
    /// Another process that may not be waited for; interrupted; what else `claim` says.
    pub fn claim<T>(&self, mut claim: impl FnMut() -> Result<T, Problem>) -> Result<T, Failure> {
        let mut is_told = self.quiet;
        loop {
            match claim() {
                Err(problem @ Problem::Busy { .. }) if self.wait => {
                    if !std::mem::replace(&mut is_told, true) {
                        say(&format!("waiting: {}", problem.to_string().lines().next().unwrap_or_default()));
                    }
                    self.interrupt.refuse("nothing; another process is at work")?;
                    sleep(LOOK_AGAIN);
                }
                claimed => return Ok(claimed?),
            }
        }
    }
}
