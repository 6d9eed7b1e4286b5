//! Channels: a topic with its schema, and the messages written to it.

use std::collections::BTreeMap;
use std::io::{Seek, Write};

use mcap::records::MessageHeader;
use mcap::{McapResult, Writer};
use prost_types::FileDescriptorProto;

use super::column::{Group, TOUCH};
use super::{descriptor, foxglove};

const PROTOBUF: &str = "protobuf";
/// Package of our own messages.
const PACKAGE: &str = "occupant";

/// A topic that messages go to.
#[derive(Debug)]
pub(crate) struct Channel {
    id: u16,
    sequence: u32,
}

impl Channel {
    pub(crate) fn next(&mut self, ns: u64) -> MessageHeader {
        let header = MessageHeader { channel_id: self.id, sequence: self.sequence, log_time: ns, publish_time: ns };
        self.sequence = self.sequence.wrapping_add(1);
        header
    }
}

#[derive(Debug)]
pub(crate) struct Schemas {
    library: Vec<FileDescriptorProto>,
}

impl Default for Schemas {
    /// Foxglove's types and our own below the groups.
    fn default() -> Self {
        let mut library = foxglove::library();
        library.push(descriptor::file(PACKAGE, "Touch", TOUCH, None));
        Schemas { library }
    }
}

impl Schemas {
    /// The schema record's bytes of a Foxglove type.
    pub(crate) fn foxglove(&self, name: &str) -> Vec<u8> {
        let path = format!("foxglove/{name}.proto");
        let found = self.library.iter().find(|f| f.name() == path);
        found.map_or_else(Vec::new, |file| descriptor::set(file, &self.library))
    }

    /// The schema record's bytes of a group.
    pub(crate) fn group(&self, group: &Group) -> Vec<u8> {
        let fields: Vec<_> = group.columns.iter().map(|c| c.field()).collect();
        let file = descriptor::file(PACKAGE, group.message, &fields, None);
        descriptor::set(&file, &self.library)
    }

    /// A channel of a Foxglove type.
    pub(crate) fn add_foxglove(
        &self,
        writer: &mut Writer<impl Write + Seek>,
        topic: &str,
        name: &str,
    ) -> McapResult<Channel> {
        let full = format!("foxglove.{name}");
        let schema = writer.add_schema(&full, PROTOBUF, &self.foxglove(name))?;
        let id = writer.add_channel(schema, topic, PROTOBUF, &BTreeMap::new())?;
        Ok(Channel { id, sequence: 0 })
    }

    /// A channel of a group; its metadata say what each field means.
    pub(crate) fn add_group(
        &self,
        writer: &mut Writer<impl Write + Seek>,
        topic: &str,
        group: &Group,
    ) -> McapResult<Channel> {
        let full = format!("{PACKAGE}.{}", group.message);
        let schema = writer.add_schema(&full, PROTOBUF, &self.group(group))?;
        let meaning = |c: &super::column::Column| (c.name.to_owned(), c.meaning.to_owned());
        let metadata: BTreeMap<String, String> = group.columns.iter().map(meaning).collect();
        let id = writer.add_channel(schema, topic, PROTOBUF, &metadata)?;
        Ok(Channel { id, sequence: 0 })
    }
}
