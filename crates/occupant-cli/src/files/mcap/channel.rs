//! Channels: a topic with its schema, and the messages written to it.

use std::collections::BTreeMap;
use std::io::{Seek, Write};

use mcap::records::MessageHeader;
use mcap::{McapResult, Writer};
use occupant_core::quantity::Kind;
use occupant_core::results::catalogue::{Field, Message, touch};
use prost_types::FileDescriptorProto;

use super::descriptor::{self, many, one};
use super::foxglove;

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
    /// Foxglove's types and our own within messages.
    fn default() -> Self {
        let mut library = foxglove::library();
        let fields = touch();
        library.push(file("Touch", fields.iter().map(|(number, name, kind)| described(*number, name, *kind))));
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

    /// A channel of a message of the catalogue; its metadata say what each field means.
    pub(crate) fn add(&self, writer: &mut Writer<impl Write + Seek>, message: &Message) -> McapResult<Channel> {
        let full = format!("{PACKAGE}.{}", message.name);
        let fields = message.fields.iter().map(|f| described(f.number, &f.name, f.kind));
        let described = descriptor::set(&file(message.name, fields), &self.library);
        let schema = writer.add_schema(&full, PROTOBUF, &described)?;
        let meaning = |field: &Field| (field.name.clone(), field.meaning.clone().into_owned());
        let metadata: BTreeMap<String, String> = message.fields.iter().map(meaning).collect();
        let id = writer.add_channel(schema, &message.topic, PROTOBUF, &metadata)?;
        Ok(Channel { id, sequence: 0 })
    }
}

/// The file that declares one of our messages.
fn file<'a>(name: &str, fields: impl Iterator<Item = descriptor::Field<'a>>) -> FileDescriptorProto {
    descriptor::file(PACKAGE, name, &fields.collect::<Vec<_>>(), None)
}

fn described(number: u32, name: &str, kind: Kind) -> descriptor::Field<'_> {
    use descriptor::Kind::{Count, Index, Message, Number, Text};
    match kind {
        Kind::Number => one(number, name, Number),
        Kind::Count => one(number, name, Count),
        Kind::Text => one(number, name, Text),
        Kind::Vector => one(number, name, Message("foxglove.Vector3")),
        Kind::Rotation => one(number, name, Message("foxglove.Quaternion")),
        Kind::Numbers => many(number, name, Number),
        Kind::Indices => many(number, name, Index),
        Kind::Parts(message) => many(number, name, Message(message)),
    }
}
