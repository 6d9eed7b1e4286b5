//! Reading a result file back as far as a run can resume it: what it says of itself, its documents, its checkpoints.

use std::collections::BTreeMap;

use mcap::read::ChunkFlattener;
use mcap::records::{MessageHeader, Record};
use occupant_core::results::checkpoint::Checkpoint;

use super::about::{RESULT, RUN};
use super::checkpoint::{self, TOPIC};

/// What a result file holds, or what a run that was cut off has left of it.
#[derive(Clone, Debug, Default)]
pub struct StoredRun {
    /// The entries of the metadata record `occupant.run`.
    pub run: BTreeMap<String, String>,
    /// The entries of `occupant.result`; none if the run was cut off.
    pub result: Option<BTreeMap<String, String>>,
    pub(crate) attachments: BTreeMap<String, Vec<u8>>,
    /// Checkpoints in the file's order.
    pub checkpoints: Vec<Checkpoint>,
}

impl StoredRun {
    /// Reads a file up to its end, or up to where it is cut off. A chunk counts whole or not at all.
    ///
    /// # Errors
    /// A file that is not MCAP, or a checkpoint that cannot be read, in words.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        if !bytes.starts_with(mcap::MAGIC) {
            return Err("it is not an MCAP file".to_owned());
        }
        let mut stored = StoredRun::default();
        let (mut channel, mut in_chunk) = (None, Vec::new());
        let checked = mcap::read::Options::ValidateChunkCrcs.into();
        for record in ChunkFlattener::new_with_options(bytes, checked).map_err(|e| e.to_string())? {
            match record {
                // indices follow a chunk that is whole
                Ok(Record::MessageIndex(_)) => stored.checkpoints.append(&mut in_chunk),
                Ok(record) => stored.take(record, &mut channel, &mut in_chunk)?,
                // a file that was cut off ends with an error
                Err(_) => break,
            }
        }
        Ok(stored)
    }

    /// Takes what counts from a record; `wanted` is the channel of checkpoints, which go to `found`.
    fn take(
        &mut self,
        record: Record<'_>,
        wanted: &mut Option<u16>,
        found: &mut Vec<Checkpoint>,
    ) -> Result<(), String> {
        match record {
            Record::Channel(channel) if channel.topic == TOPIC => {
                *wanted = Some(channel.id);
            }
            Record::Message { header: MessageHeader { channel_id, .. }, data } if *wanted == Some(channel_id) => {
                found.push(checkpoint::read(data.as_ref())?);
            }
            Record::Metadata(metadata) if metadata.name == RUN => self.run = metadata.metadata,
            Record::Metadata(metadata) if metadata.name == RESULT => {
                self.result = Some(metadata.metadata);
            }
            Record::Attachment { header, data, .. } => {
                self.attachments.insert(header.name, data.into_owned());
            }
            _ => {}
        }
        Ok(())
    }
}
