//! Where messages go: to a thread that compresses and writes them while the run goes on.
//!
//! The thread does with the writer, in the same order, what would have been done without it, so the file has the same
//! bytes. Its errors come back with the next chunk, at the latest when the writer is called home. If no thread can be had,
//! everything is done at once.

use std::io::{Seek, Write};
use std::panic::resume_unwind;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{Builder, JoinHandle};

use mcap::records::MessageHeader;
use mcap::{McapResult, Writer};

/// Chunks that may wait to be written; then the run waits.
const WAITING: usize = 2;

/// The writer of a file, here or on a thread of its own.
pub(crate) struct Press<W: Write + Seek + Send + 'static> {
    place: Place<W>,
    /// What has not been handed over.
    batch: Batch,
}

enum Place<W: Write + Seek> {
    Here(Box<Writer<W>>),
    Away(Away<W>),
    /// While it changes its place.
    Nowhere,
}

/// A writer on its thread.
struct Away<W: Write + Seek> {
    batches: SyncSender<Batch>,
    /// Batches that were written, to be used again.
    written: Receiver<Batch>,
    thread: JoinHandle<Returned<W>>,
}

/// What the thread gives back: the writer, if it was handed one, and how the writing went.
type Returned<W> = (Option<Box<Writer<W>>>, McapResult<()>);

/// Messages in a row.
#[derive(Default)]
struct Batch {
    /// Header of each, and where it ends in `bytes`.
    messages: Vec<(MessageHeader, usize)>,
    bytes: Vec<u8>,
    /// A chunk ends behind them.
    ends_chunk: bool,
}

impl<W: Write + Seek + Send + 'static> Press<W> {
    /// With the writer here.
    pub(crate) fn new(writer: Writer<W>) -> Self {
        Press { place: Place::Here(Box::new(writer)), batch: Batch::default() }
    }

    /// Takes the next message.
    pub(crate) fn write(&mut self, header: MessageHeader, bytes: &[u8]) {
        self.batch.bytes.extend_from_slice(bytes);
        let end = self.batch.bytes.len();
        self.batch.messages.push((header, end));
    }

    /// Ends the chunk and hands it over.
    ///
    /// # Errors
    /// What the target reported since the last chunk.
    pub(crate) fn end_chunk(&mut self) -> McapResult<()> {
        self.batch.ends_chunk = true;
        self.go_away();
        self.hand_over()
    }

    /// The writer, with everything written that was handed over.
    ///
    /// # Errors
    /// What the target reported.
    pub(crate) fn home(&mut self) -> McapResult<&mut Writer<W>> {
        let handed_over = self.hand_over();
        let came_home = self.come_home();
        handed_over.and(came_home)?;
        match &mut self.place {
            Place::Here(writer) => Ok(writer),
            Place::Away(_) | Place::Nowhere => Err(lost()),
        }
    }

    /// The target; what was not yet handed to it is cut off.
    ///
    /// # Errors
    /// None is left, because the thread of the writer could not take it over.
    pub(crate) fn into_inner(mut self) -> McapResult<W> {
        // an error was reported with the chunk that it was about, or the run's end would have called the writer home
        let _ = self.come_home();
        match std::mem::replace(&mut self.place, Place::Nowhere) {
            Place::Here(writer) => Ok(writer.into_inner()),
            Place::Away(_) | Place::Nowhere => Err(lost()),
        }
    }

    /// Writes the batch, or gives it to the thread.
    fn hand_over(&mut self) -> McapResult<()> {
        match &mut self.place {
            Place::Here(writer) => self.batch.write(writer),
            Place::Away(away) => {
                let next = away.written.try_recv().unwrap_or_default();
                let batch = std::mem::replace(&mut self.batch, next);
                match away.batches.send(batch) {
                    Ok(()) => Ok(()),
                    // the thread has ended: it says why
                    Err(_) => self.come_home(),
                }
            }
            Place::Nowhere => Err(lost()),
        }
    }

    /// Puts the writer on a thread, if there is one to be had.
    fn go_away(&mut self) {
        let Place::Here(_) = self.place else { return };
        let (give, take) = sync_channel::<Box<Writer<W>>>(1);
        let (batches, coming) = sync_channel::<Batch>(WAITING);
        let (done, written) = sync_channel::<Batch>(WAITING + 1);
        let work = move || {
            let Ok(mut writer) = take.recv() else {
                return (None, Ok(()));
            };
            for mut batch in coming {
                if let Err(error) = batch.write(&mut writer) {
                    return (Some(writer), Err(error));
                }
                // a full list or nobody there: then the batch is not used again
                let _ = done.try_send(batch);
            }
            (Some(writer), Ok(()))
        };
        let Ok(thread) = Builder::new().name("mcap".to_owned()).spawn(work) else {
            return;
        };
        let place = std::mem::replace(&mut self.place, Place::Nowhere);
        if let Place::Here(writer) = place {
            self.place = match give.send(writer) {
                Ok(()) => Place::Away(Away { batches, written, thread }),
                Err(back) => Place::Here(back.0),
            };
        }
    }

    /// Waits until the thread has written everything and brings the writer back.
    fn come_home(&mut self) -> McapResult<()> {
        let away = match std::mem::replace(&mut self.place, Place::Nowhere) {
            Place::Away(away) => away,
            place => {
                self.place = place;
                return Ok(());
            }
        };
        drop(away.batches);
        // as if it had happened here
        let (writer, result) = away.thread.join().unwrap_or_else(|panic| resume_unwind(panic));
        self.place = writer.map_or(Place::Nowhere, Place::Here);
        result
    }
}

impl<W: Write + Seek + Send + 'static> Drop for Press<W> {
    /// What was taken is written, as a writer does that is dropped; nobody is left to hear of an error.
    fn drop(&mut self) {
        let mut rest = std::mem::take(&mut self.batch);
        match std::mem::replace(&mut self.place, Place::Nowhere) {
            Place::Here(mut writer) => _ = rest.write(&mut writer),
            Place::Away(away) => {
                _ = away.batches.send(rest);
                drop(away.batches);
                _ = away.thread.join();
            }
            Place::Nowhere => {}
        }
    }
}

impl Batch {
    /// Writes the messages and forgets them.
    fn write<W: Write + Seek>(&mut self, writer: &mut Writer<W>) -> McapResult<()> {
        let mut start = 0;
        for (header, end) in self.messages.drain(..) {
            writer.write_to_known_channel(&header, &self.bytes[start..end])?;
            start = end;
        }
        self.bytes.clear();
        match std::mem::take(&mut self.ends_chunk) {
            true => writer.flush(),
            false => Ok(()),
        }
    }
}

/// After an error the writer is not used again.
fn lost() -> mcap::McapError {
    std::io::Error::other("the file's writer is gone").into()
}
