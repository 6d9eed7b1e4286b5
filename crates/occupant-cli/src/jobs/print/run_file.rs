//! A run's MCAP file in memory: what it says of itself, its attachments and checkpoints, its messages by topic. A file that
//! was cut off is read as far as it goes; a chunk counts whole or not at all.

use std::collections::BTreeMap;

use mcap::read::{ChunkFlattener, Options};
use mcap::records::Record;
use occupant_core::results::checkpoint::Checkpoint;

use crate::files::mcap::StoredRun;
use crate::files::mcap::about::RUN;

#[derive(Debug, Default)]
pub(crate) struct RunFile {
    /// The record `occupant.run`.
    pub(crate) run: BTreeMap<String, String>,
    /// The record `occupant.result`; none in a file that was cut off.
    pub(crate) result: Option<BTreeMap<String, String>>,
    pub(crate) attachments: BTreeMap<String, Vec<u8>>,
    /// Checkpoints, one an output.
    pub(crate) checkpoints: Vec<Checkpoint>,
    topics: BTreeMap<String, Vec<Vec<u8>>>,
}

impl RunFile {
    /// Reads a file.
    ///
    /// # Errors
    /// It is no MCAP file, or one that `occupant run` has not written.
    pub(crate) fn read(bytes: &[u8]) -> Result<Self, String> {
        let stored = StoredRun::read(bytes)?;
        if stored.run.is_empty() {
            return Err(format!("it is an MCAP file without the record `{RUN}`: no result of `occupant run`"));
        }
        Ok(RunFile {
            run: stored.run,
            result: stored.result,
            attachments: stored.attachments,
            checkpoints: stored.checkpoints,
            topics: messages_by_topic(bytes)?,
        })
    }

    /// Messages of a topic, one an output.
    pub(crate) fn messages(&self, topic: &str) -> &[Vec<u8>] {
        self.topics.get(topic).map_or(&[], Vec::as_slice)
    }
}

fn messages_by_topic(bytes: &[u8]) -> Result<BTreeMap<String, Vec<Vec<u8>>>, String> {
    let mut topics: BTreeMap<String, Vec<Vec<u8>>> = BTreeMap::new();
    let (mut names, mut in_chunk) = (BTreeMap::new(), Vec::new());
    let checked = Options::ValidateChunkCrcs.into();
    let records = ChunkFlattener::new_with_options(bytes, checked).map_err(|e| e.to_string())?;
    for record in records {
        match record {
            Ok(Record::Channel(channel)) if is_group(&channel.topic) => {
                names.insert(channel.id, channel.topic);
            }
            Ok(Record::Message { header, data }) => {
                if let Some(name) = names.get(&header.channel_id) {
                    in_chunk.push((name.clone(), data.into_owned()));
                }
            }
            // indices follow a chunk that is whole
            Ok(Record::MessageIndex(_)) => {
                for (name, message) in in_chunk.drain(..) {
                    topics.entry(name).or_default().push(message);
                }
            }
            Ok(_) => {}
            // a file that was cut off ends with an error
            Err(_) => break,
        }
    }
    Ok(topics)
}

/// Whether a topic holds results, not what viewers draw.
fn is_group(topic: &str) -> bool {
    !topic.starts_with("/scene/") && topic != "/tf" && topic != "/log"
}
