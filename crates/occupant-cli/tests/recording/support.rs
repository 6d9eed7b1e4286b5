//! A short run and a reader of its file that knows nothing of the writer's tables: it decodes by the schemas in the file.

use std::collections::BTreeMap;
use std::io::{Cursor, Seek, Write};
use std::num::NonZeroU32;

use mcap::MessageStream;
use occupant_cli::mcap::{About, Document, McapOptions, McapRecorder};
use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use occupant_core::results::outcome::Outcome;
use occupant_core::results::recorder::Recorder;
use occupant_core::run::simulate::attempt;
use occupant_scenario::{Format, Scenario};
use prost_reflect::{DescriptorPool, DynamicMessage, ReflectMessage, Value};

/// The scenario of these tests.
pub const SCENARIO: &str = include_str!("short.toml");

/// Its plain data.
pub fn setup() -> Setup {
    let no_files = |name: &str| Err(format!("{name}: there are no files here"));
    let loaded =
        Scenario::from_text(SCENARIO, Format::Toml, "short.toml", &no_files).unwrap_or_else(|d| panic!("{d:?}"));
    loaded.build().unwrap_or_else(|d| panic!("{d:?}")).0
}

/// Its model.
pub fn model() -> Model {
    Model::new(setup()).unwrap_or_else(|p| panic!("{p:?}"))
}

/// A recorder into memory, which closes a chunk every 20 outputs.
pub fn recorder() -> McapRecorder<Cursor<Vec<u8>>> {
    recorder_into(Cursor::new(Vec::new()))
}

/// The same into a given target.
pub fn recorder_into<W: Write + Seek + Send + 'static>(target: W) -> McapRecorder<W> {
    let about = About {
        program: "occupant test".to_owned(),
        scenario: Document {
            name: "short.toml".to_owned(),
            media_type: "application/toml".to_owned(),
            content: SCENARIO.as_bytes().to_vec(),
        },
        resolved: None,
        notes: BTreeMap::from([("overrides".to_owned(), "none".to_owned())]),
    };
    let options = McapOptions { outputs_per_chunk: NonZeroU32::new(20).unwrap(), ..McapOptions::default() };
    McapRecorder::new(target, about, options).unwrap()
}

/// Runs `model` as far as it goes, with another recorder beside the file.
pub fn record(model: &Model, other: impl Recorder) -> (Vec<u8>, Outcome) {
    let mut file = recorder();
    let outcome = attempt(model, (&mut file, other)).unwrap();
    (file.into_inner().unwrap().into_inner(), outcome)
}

/// A decoded message.
pub struct Read {
    /// Time in the file, ns.
    pub ns: u64,
    /// Number in its channel.
    pub sequence: u32,
    /// Its fields.
    pub message: DynamicMessage,
}

/// All messages by topic, decoded by the schemas that the file carries.
pub fn read(bytes: &[u8]) -> BTreeMap<String, Vec<Read>> {
    let mut topics: BTreeMap<String, Vec<Read>> = BTreeMap::new();
    let mut pools: BTreeMap<u16, DescriptorPool> = BTreeMap::new();
    for message in MessageStream::new(bytes).unwrap() {
        let message = message.unwrap();
        let channel = &message.channel;
        let schema = channel.schema.as_ref().expect("a schema");
        assert_eq!(channel.message_encoding, "protobuf", "{}", channel.topic);
        assert_eq!(schema.encoding, "protobuf", "{}", channel.topic);
        assert_eq!(message.log_time, message.publish_time);
        let pool = pools.entry(schema.id).or_insert_with(|| DescriptorPool::decode(schema.data.as_ref()).unwrap());
        let kind = pool.get_message_by_name(&schema.name).expect("its message");
        let content = DynamicMessage::decode(kind, message.data.as_ref()).unwrap();
        assert_eq!(content.unknown_fields().count(), 0, "{}", channel.topic);
        topics.entry(channel.topic.clone()).or_default().push(Read {
            ns: message.log_time,
            sequence: message.sequence,
            message: content,
        });
    }
    topics
}

/// A field by its name.
pub fn field(message: &DynamicMessage, name: &str) -> Value {
    let known = message.descriptor().get_field_by_name(name);
    assert!(known.is_some(), "no field {name}");
    message.get_field_by_name(name).unwrap().into_owned()
}

/// A message within a message.
pub fn part(message: &DynamicMessage, name: &str) -> DynamicMessage {
    field(message, name).as_message().expect("a message").clone()
}

/// A list of messages.
pub fn parts(message: &DynamicMessage, name: &str) -> Vec<DynamicMessage> {
    let value = field(message, name);
    let list = value.as_list().expect("a list").iter();
    list.map(|v| v.as_message().expect("a message").clone()).collect()
}

/// A text.
pub fn text(message: &DynamicMessage, name: &str) -> String {
    field(message, name).as_str().expect("a text").to_owned()
}

/// The numbers of a field in order: one, the components of a vector or a rotation, or a list.
pub fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::F64(x) => vec![*x],
        Value::U64(n) => vec![*n as f64],
        Value::List(list) => list.iter().flat_map(numbers).collect(),
        Value::Message(m) => components(m),
        other => panic!("not numbers: {other:?}"),
    }
}

/// The numbers of a message's fields in order.
pub fn components(message: &DynamicMessage) -> Vec<f64> {
    let fields: Vec<_> = message.descriptor().fields().collect();
    let value = |f| numbers(&message.get_field(f));
    fields.iter().flat_map(value).collect()
}
