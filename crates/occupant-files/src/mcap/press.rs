//! A thread that compresses and writes messages during the run.
//!
//! The thread does the same as the run would do, in the same order, so the file has the same bytes. Its errors are
//! returned with the next chunk, at the latest when the writer is finished. Without a thread everything is written
//! immediately.

use std::io::{Seek, Write};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::sync::{Arc, Mutex};
use std::thread::{Builder, JoinHandle};

use mcap::records::MessageHeader;
use mcap::{McapResult, Writer};

use super::channel::Channel;
use super::wire::Wire;

/// Largest number of chunks waiting to be written; then the run waits.
const WAITING: usize = 2;

/// The writer of a file, and data in transit to it.
pub struct Press<W: Write + Seek + Send + 'static> {
    writer: Shared<W>,
    /// The writing thread, which holds the writer's lock while it exists.
    thread: Option<Thread>,
    /// Data not yet handed over.
    batch: Batch,
}

/// The writer of a file; none after the target was taken back.
type Shared<W> = Arc<Mutex<Option<Writer<W>>>>;

/// A thread that writes batches until the channel closes or a write fails.
struct Thread {
    batches: SyncSender<Batch>,
    handle: JoinHandle<McapResult<()>>,
}

/// Consecutive messages.
#[derive(Default)]
struct Batch {
    /// Header of each, and its end in `wire`.
    messages: Vec<(MessageHeader, usize)>,
    wire: Wire,
    /// Whether a chunk ends after them.
    ends_chunk: bool,
}

impl<W: Write + Seek + Send + 'static> Press<W> {
    /// A press that has no thread yet.
    pub fn new(writer: Writer<W>) -> Self {
        Press { writer: Arc::new(Mutex::new(Some(writer))), thread: None, batch: Batch::default() }
    }

    /// Appends a channel's message, encoded by `write`.
    pub fn put(&mut self, channel: &mut Channel, ns: u64, write: impl FnOnce(&mut Wire)) {
        write(&mut self.batch.wire);
        self.batch.messages.push((channel.next(ns), self.batch.wire.bytes.len()));
    }

    /// Ends the chunk and hands it over.
    ///
    /// # Errors
    /// An error of the target since the last chunk.
    pub fn end_chunk(&mut self) -> McapResult<()> {
        self.batch.ends_chunk = true;
        if self.thread.is_none() {
            self.thread = Thread::begin(&self.writer);
        }
        self.hand_over()
    }

    /// The writer, after all data handed over have been written.
    ///
    /// # Errors
    /// An error of the target.
    pub fn home(&mut self) -> McapResult<&mut Writer<W>> {
        let handed_over = self.hand_over();
        let written = self.wait();
        handed_over.and(written)?;
        self.own()?.as_mut().ok_or_else(lost)
    }

    /// The target; data not yet written are dropped.
    ///
    /// # Errors
    /// None is left, because the thread broke off.
    pub fn into_inner(mut self) -> McapResult<W> {
        // an error was reported with the chunk that it was about, or the run's end would have called the writer home
        let _ = self.wait();
        self.own()?.take().map(Writer::into_inner).ok_or_else(lost)
    }

    /// Hands the batch to the thread, or writes it.
    fn hand_over(&mut self) -> McapResult<()> {
        let batch = std::mem::take(&mut self.batch);
        match &self.thread {
            // a thread that has ended says why
            Some(thread) => thread.batches.send(batch).or_else(|_| self.wait()),
            None => batch.write(self.own()?),
        }
    }

    /// Waits for the thread to write everything and end.
    fn wait(&mut self) -> McapResult<()> {
        let Some(Thread { batches, handle }) = self.thread.take() else {
            return Ok(());
        };
        drop(batches);
        handle.join().unwrap_or_else(|_broke_off| Err(lost()))
    }

    /// The writer, while no thread holds it.
    fn own(&mut self) -> McapResult<&mut Option<Writer<W>>> {
        let alone = Arc::get_mut(&mut self.writer).and_then(|writer| writer.get_mut().ok());
        alone.ok_or_else(lost)
    }
}

impl<W: Write + Seek + Send + 'static> Drop for Press<W> {
    /// Writes the remaining data, as a dropped writer does; errors are ignored.
    fn drop(&mut self) {
        let _ = self.home();
    }
}

impl Thread {
    /// Starts the thread; none if that fails.
    fn begin<W: Write + Seek + Send + 'static>(writer: &Shared<W>) -> Option<Thread> {
        let writer = Arc::clone(writer);
        let (batches, coming) = sync_channel::<Batch>(WAITING);
        let work = move || {
            let mut writer = writer.lock().map_err(|_| lost())?;
            coming.into_iter().try_for_each(|batch| batch.write(&mut writer))
        };
        let handle = Builder::new().name("mcap".to_owned()).spawn(work).ok()?;
        Some(Thread { batches, handle })
    }
}

impl Batch {
    fn write<W: Write + Seek>(self, writer: &mut Option<Writer<W>>) -> McapResult<()> {
        let writer = writer.as_mut().ok_or_else(lost)?;
        let mut start = 0;
        for (header, end) in self.messages {
            writer.write_to_known_channel(&header, &self.wire.bytes[start..end])?;
            start = end;
        }
        if self.ends_chunk { writer.flush() } else { Ok(()) }
    }
}

/// Error of a writer after an earlier error.
fn lost() -> mcap::McapError {
    std::io::Error::other("the file's writer is gone").into()
}
