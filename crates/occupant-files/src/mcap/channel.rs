//! Channels: a topic with its schema, and the messages written to it.

use std::collections::BTreeMap;
use std::io::{Seek, Write};

use mcap::records::MessageHeader;
use mcap::{McapResult, Writer};
use occupant_core::quantity::Kind;
use occupant_core::results::catalogue::{Message, touch};
use prost_types::{FieldDescriptorProto, FileDescriptorProto};

use super::{descriptor, foxglove};

const PROTOBUF: &str = "protobuf";
/// Package of our own messages.
const PACKAGE: &str = "occupant";

/// A topic.
#[derive(Debug)]
pub struct Channel {
    id: u16,
    sequence: u32,
}

impl Channel {
    /// Header of the next message, at a time in ns.
    pub fn next(&mut self, ns: u64) -> MessageHeader {
        let header = MessageHeader { channel_id: self.id, sequence: self.sequence, log_time: ns, publish_time: ns };
        self.sequence = self.sequence.wrapping_add(1);
        header
    }
}

/// The schemas of a file.
#[derive(Debug)]
pub struct Schemas {
    library: Vec<FileDescriptorProto>,
}

impl Default for Schemas {
    /// Foxglove's types and our own within messages.
    fn default() -> Self {
        let mut library = foxglove::library();
        let fields = touch().into_iter().map(|(number, name, kind)| described(number, &name, kind));
        library.push(descriptor::file(PACKAGE, "Touch", fields.collect(), None));
        Schemas { library }
    }
}

impl Schemas {
    /// The schema record's bytes of a Foxglove type.
    pub fn foxglove(&self, name: &str) -> Vec<u8> {
        let path = format!("foxglove/{name}.proto");
        let found = self.library.iter().find(|f| f.name() == path);
        found.map_or_else(Vec::new, |file| descriptor::set(file, &self.library))
    }

    /// A channel of a Foxglove type.
    ///
    /// # Errors
    /// An error of the writer.
    pub fn add_foxglove(&self, writer: &mut Writer<impl Write + Seek>, topic: &str, name: &str) -> McapResult<Channel> {
        add(writer, topic, &format!("foxglove.{name}"), &self.foxglove(name), &BTreeMap::new())
    }

    /// A channel of a catalogue message; its metadata describe each field.
    ///
    /// # Errors
    /// An error of the writer.
    pub fn add(&self, writer: &mut Writer<impl Write + Seek>, message: &Message) -> McapResult<Channel> {
        let fields = message.fields.iter().map(|f| described(f.number, &f.name, f.kind));
        let schema = descriptor::set(&descriptor::file(PACKAGE, message.name, fields.collect(), None), &self.library);
        let meanings = message.fields.iter().map(|f| (f.name.clone(), f.meaning.clone().into_owned())).collect();
        add(writer, &message.topic, &format!("{PACKAGE}.{}", message.name), &schema, &meanings)
    }
}

fn add(
    writer: &mut Writer<impl Write + Seek>,
    topic: &str,
    message: &str,
    schema: &[u8],
    metadata: &BTreeMap<String, String>,
) -> McapResult<Channel> {
    let schema = writer.add_schema(message, PROTOBUF, schema)?;
    Ok(Channel { id: writer.add_channel(schema, topic, PROTOBUF, metadata)?, sequence: 0 })
}

fn described(number: u32, name: &str, kind: Kind) -> FieldDescriptorProto {
    let parts;
    let words = match kind {
        Kind::Number => "double",
        Kind::Count => "uint64",
        Kind::Text => "string",
        Kind::Vector => "foxglove.Vector3",
        Kind::Rotation => "foxglove.Quaternion",
        Kind::Numbers => "repeated double",
        Kind::Indices => "repeated fixed32",
        Kind::Singles => "repeated float",
        Kind::Parts(message) => {
            parts = format!("repeated {message}");
            &parts
        }
    };
    descriptor::field(number, name, words)
}
