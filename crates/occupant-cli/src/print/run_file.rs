//! A run's MCAP file in memory: what it says of itself, its attachments, its messages by topic. A file that was cut off is
//! read as far as it goes.

use std::borrow::Cow;
use std::collections::BTreeMap;

use mcap::read::{ChunkFlattener, Options};
use mcap::records::Record;

use crate::mcap::Document;
use crate::mcap::about::{RESULT, RUN};

/// The file.
#[derive(Debug, Default)]
pub struct RunFile {
    /// The record `occupant.run`.
    pub run: BTreeMap<String, String>,
    /// The record `occupant.result`; none in a file that was cut off.
    pub result: Option<BTreeMap<String, String>>,
    /// Attachments.
    pub attachments: Vec<Document>,
    /// What ended the reading before the end of the file.
    pub broken: Option<String>,
    topics: BTreeMap<String, Vec<Vec<u8>>>,
}

impl RunFile {
    /// Reads a file.
    ///
    /// # Errors
    /// It is no MCAP file, or one that `occupant run` has not written.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        let options = Options::IgnoreEndMagic | Options::ValidateChunkCrcs;
        let records = ChunkFlattener::new_with_options(bytes, options)
            .map_err(|error| format!("it is not an MCAP file: {error}"))?;
        let (mut file, mut names) = (RunFile::default(), BTreeMap::new());
        let mut count = 0;
        for record in records {
            match record {
                Ok(Record::DataEnd(_)) => break,
                Ok(record) => file.take(record, &mut names),
                Err(error) if count == 0 => {
                    return Err(format!("it is not an MCAP file: {error}"));
                }
                Err(error) => {
                    file.broken = Some(error.to_string());
                    break;
                }
            }
            count += 1;
        }
        match file.run.is_empty() {
            true => Err(format!(
                "it is an MCAP file without the record `{RUN}`: no result of `occupant run`"
            )),
            false => Ok(file),
        }
    }

    fn take(&mut self, record: Record<'_>, names: &mut BTreeMap<u16, String>) {
        match record {
            Record::Metadata(metadata) if metadata.name == RUN => self.run = metadata.metadata,
            Record::Metadata(metadata) if metadata.name == RESULT => {
                self.result = Some(metadata.metadata);
            }
            Record::Attachment { header, data, .. } => self.attachments.push(Document {
                name: header.name,
                media_type: header.media_type,
                content: data.into_owned(),
            }),
            Record::Channel(channel) if channel.message_encoding == "protobuf" => {
                names.insert(channel.id, channel.topic);
            }
            Record::Message { header, data } => {
                let wanted = names.get(&header.channel_id).filter(|name| is_group(name));
                if let Some(name) = wanted {
                    let messages = self.topics.entry(name.clone()).or_default();
                    messages.push(Cow::into_owned(data));
                }
            }
            _ => {}
        }
    }

    /// Messages of a topic, one an output.
    pub fn messages(&self, topic: &str) -> &[Vec<u8>] {
        self.topics.get(topic).map_or(&[], Vec::as_slice)
    }

    /// An attachment by its name.
    pub fn attachment(&self, name: &str) -> Option<&Document> {
        self.attachments.iter().find(|d| d.name == name)
    }
}

/// Whether a topic holds results, not what viewers draw.
fn is_group(topic: &str) -> bool {
    !topic.starts_with("/scene/") && topic != "/tf" && topic != "/log"
}
