//! The message with the complete memory of a run at an output, from which it can resume bit for bit.
//!
//! Pairs are numbered as the model numbers them; those in no list are open and have no largest deformation.

use occupant_core::forces::stored::Archive;
use occupant_core::quantity::{FieldWords, Kind, Value};
use occupant_core::results::catalogue::{Field, Message};
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::sample::Sample;

use super::wire::{Rest, Wire};

/// The topic of checkpoints.
pub const TOPIC: &str = "/checkpoint";

/// Message `occupant.Checkpoint`.
pub fn checkpoint() -> Message {
    let mut words = Words::default();
    Checkpoint::stored(&mut words);
    Message { name: "Checkpoint", topic: TOPIC.to_owned(), fields: words.fields }
}

/// Writes the fields of the message.
pub fn write(wire: &mut Wire, sample: &Sample<'_>) {
    sample.checkpoint().keep(wire);
}

/// The fields of the message of an output.
pub fn encoded(checkpoint: &Checkpoint) -> Vec<u8> {
    let mut wire = Wire::default();
    checkpoint.clone().keep(&mut wire);
    wire.bytes
}

/// Parses the message. Fields missing from the file stay empty.
///
/// # Errors
/// Fields that cannot be, as text.
pub fn read(bytes: &[u8]) -> Result<Checkpoint, String> {
    let mut reader = Reader { rest: Rest(bytes), trouble: None };
    let checkpoint = Checkpoint::stored(&mut reader);
    if !reader.rest.0.is_empty() {
        reader.refuse("fields that this version does not know");
    }
    reader.trouble.map_or(Ok(checkpoint), Err)
}

/// Names of the fields.
#[derive(Default)]
struct Words {
    fields: Vec<Field>,
    is_step: bool,
}

impl Archive for Words {
    fn exchange(&mut self, FieldWords { number, stem, meaning }: FieldWords, value: &mut Value) {
        let (name, meaning) = if self.is_step {
            (format!("step_{stem}"), format!("as `{stem}`").into())
        } else {
            (stem.to_owned(), meaning.into())
        };
        let kind = match value {
            Value::Count(_) => Kind::Count,
            Value::Numbers(_) => Kind::Numbers,
            Value::Indices(_) => Kind::Indices,
            Value::Singles(_) => Kind::Singles,
            _ => Kind::Number,
        };
        self.fields.push(Field { number, name, meaning, kind, source: None });
    }

    fn begin_step(&mut self) {
        self.is_step = true;
    }
}

impl Archive for Wire {
    fn exchange(&mut self, words: FieldWords, value: &mut Value) {
        self.value(words.number, value);
    }
}

struct Reader<'a> {
    rest: Rest<'a>,
    trouble: Option<String>,
}

impl Archive for Reader<'_> {
    fn exchange(&mut self, words: FieldWords, value: &mut Value) {
        self.rest.value(words.number, value);
    }

    fn refuse(&mut self, why: &str) {
        self.trouble.get_or_insert(format!("a checkpoint cannot be read: {why}"));
    }
}
