//! The protobuf wire format, written straight into the buffer that goes to the file, and read back as far
//! as a run needs it to resume.
//!
//! Fields are always written, also where they are zero: a file then holds every bit that was recorded (the usual writers
//! leave zeros out, and −0 with them).

use nalgebra::{UnitQuaternion, Vector3};
use occupant_core::quantity::Value;
use prost::encoding::{WireType, decode_key, decode_varint, double, encode_key, encode_varint, fixed32, uint64};

/// Messages under construction, one after the other.
#[derive(Debug, Default)]
pub struct Wire {
    /// Bytes written so far.
    pub bytes: Vec<u8>,
}

impl Wire {
    /// A value of the catalogue; nothing for a missing vector.
    pub fn value(&mut self, field: u32, value: &Value) {
        match value {
            Value::Number(number) => self.number(field, *number),
            Value::Count(count) => self.count(field, *count),
            Value::Text(text) => self.text(field, text),
            Value::Vector(vector) => vector.iter().for_each(|v| self.vector(field, v)),
            Value::Rotation(rotation) => self.rotation(field, rotation),
            Value::Numbers(numbers) => self.numbers(field, numbers),
            Value::Indices(indices) => self.indices(field, indices),
            Value::Singles(numbers) => self.packed(field, numbers.iter().map(|value| value.to_le_bytes())),
            Value::Parts(parts) => {
                for part in parts {
                    self.message(field, |wire| part.iter().for_each(|(field, value)| wire.value(*field, value)));
                }
            }
        }
    }

    /// A `double`.
    pub fn number(&mut self, field: u32, value: f64) {
        double::encode(field, &value, &mut self.bytes);
    }

    /// A packed `repeated double`.
    pub fn numbers(&mut self, field: u32, values: &[f64]) {
        self.packed(field, values.iter().map(|value| value.to_le_bytes()));
    }

    /// A `fixed32`.
    pub fn index(&mut self, field: u32, value: u32) {
        fixed32::encode(field, &value, &mut self.bytes);
    }

    /// A packed `repeated fixed32`.
    pub fn indices(&mut self, field: u32, values: &[u32]) {
        self.packed(field, values.iter().map(|value| value.to_le_bytes()));
    }

    fn packed<const N: usize>(&mut self, field: u32, values: impl ExactSizeIterator<Item = [u8; N]>) {
        self.length(field, N * values.len());
        values.for_each(|value| self.bytes.extend_from_slice(&value));
    }

    /// A `uint64`, or an enum's number.
    pub fn count(&mut self, field: u32, value: u64) {
        uint64::encode(field, &value, &mut self.bytes);
    }

    /// A `bool`.
    pub fn flag(&mut self, field: u32, value: bool) {
        self.count(field, value.into());
    }

    /// A `string`.
    pub fn text(&mut self, field: u32, value: &str) {
        self.length(field, value.len());
        self.bytes.extend_from_slice(value.as_bytes());
    }

    /// A message within the message.
    pub fn message(&mut self, field: u32, content: impl FnOnce(&mut Wire)) {
        encode_key(field, WireType::LengthDelimited, &mut self.bytes);
        let start = self.bytes.len();
        content(self);
        let end = self.bytes.len();
        // the length stands before the content, but is known only after it
        encode_varint((end - start) as u64, &mut self.bytes);
        let size = self.bytes.len() - end;
        self.bytes[start..].rotate_right(size);
    }

    /// A `foxglove.Vector3` or `foxglove.Point3`.
    pub fn vector(&mut self, field: u32, v: &Vector3<f64>) {
        self.components(field, &[v.x, v.y, v.z]);
    }

    /// A `foxglove.Quaternion`.
    pub fn rotation(&mut self, field: u32, q: &UnitQuaternion<f64>) {
        self.components(field, &[q.i, q.j, q.k, q.w]);
    }

    /// A message of doubles.
    fn components(&mut self, field: u32, values: &[f64]) {
        // a byte of key and eight of number each
        self.length(field, 9 * values.len());
        (1..).zip(values).for_each(|(field, value)| self.number(field, *value));
    }

    /// A `google.protobuf.Timestamp` or `google.protobuf.Duration` of `ns` nanoseconds.
    pub fn time(&mut self, field: u32, ns: u64) {
        self.message(field, |wire| {
            wire.count(1, ns / 1_000_000_000);
            wire.count(2, ns % 1_000_000_000);
        });
    }

    /// Start of a field with this many bytes.
    fn length(&mut self, field: u32, bytes: usize) {
        encode_key(field, WireType::LengthDelimited, &mut self.bytes);
        encode_varint(bytes as u64, &mut self.bytes);
    }
}

/// The unread rest of a message whose fields are in a fixed order.
#[derive(Clone, Copy)]
pub struct Rest<'a>(pub &'a [u8]);

impl<'a> Rest<'a> {
    /// Reads the next field into `value` if it is `field` and has its type.
    pub fn value(&mut self, field: u32, value: &mut Value) -> Option<()> {
        let mut ahead = *self;
        let wire_type = match value {
            Value::Count(_) => WireType::Varint,
            Value::Number(_) => WireType::SixtyFourBit,
            _ => WireType::LengthDelimited,
        };
        if decode_key(&mut ahead.0).ok()? != (field, wire_type) {
            return None;
        }
        match value {
            Value::Count(count) => *count = decode_varint(&mut ahead.0).ok()?,
            Value::Number(number) => *number = f64::from_le_bytes(*ahead.0.split_off(..8)?.first_chunk()?),
            Value::Numbers(list) => *list = ahead.list()?.iter().copied().map(f64::from_le_bytes).collect(),
            Value::Indices(list) => *list = ahead.list()?.iter().copied().map(u32::from_le_bytes).collect(),
            Value::Singles(list) => *list = ahead.list()?.iter().copied().map(f32::from_le_bytes).collect(),
            _ => return None,
        }
        *self = ahead;
        Some(())
    }

    fn list<const N: usize>(&mut self) -> Option<&'a [[u8; N]]> {
        let size = usize::try_from(decode_varint(&mut self.0).ok()?).ok()?;
        let (list, odd) = self.0.split_off(..size)?.as_chunks();
        odd.is_empty().then_some(list)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The examples of the protobuf documentation: `150` in field 1, `"testing"` in field 2, a message in field 3.
    #[test]
    fn the_documented_examples_come_out() {
        let mut wire = Wire::default();
        wire.count(1, 150);
        wire.text(2, "testing");
        wire.message(3, |w| w.count(1, 150));
        let expected = [&[0x08, 0x96, 0x01][..], b"\x12\x07testing", &[0x1a, 0x03, 0x08, 0x96, 0x01]];
        assert_eq!(wire.bytes, expected.concat());
    }

    #[test]
    fn a_long_message_has_its_length_in_front() {
        let mut wire = Wire::default();
        wire.message(1, |w| w.text(2, &"x".repeat(300)));
        // 300 + key and two bytes of length = 303 = 0b10_0101111
        assert_eq!(&wire.bytes[..6], [0x0a, 0xaf, 0x02, 0x12, 0xac, 0x02]);
        assert_eq!(wire.bytes.len(), 306);
    }

    #[test]
    fn minus_zero_is_written() {
        let mut wire = Wire::default();
        wire.number(1, -0.0);
        assert_eq!(wire.bytes, [9, 0, 0, 0, 0, 0, 0, 0, 0x80]);
    }
}
