//! Messages of a run's groups, read by the table that writes them.

use crate::files::mcap::column::{Group, TOUCH};

/// A message: its group's table and its fields.
#[derive(Debug)]
pub(crate) struct Message<'a> {
    group: &'static Group,
    fields: Vec<(u32, Field<'a>)>,
}

/// A field's value in the protobuf wire format.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Field<'a> {
    Count(u64),
    Number(f64),
    Bytes(&'a [u8]),
}

/// A surface that a sphere touches.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Touch {
    pub(crate) surface: String,
    /// Δ, m.
    pub(crate) depth_m: f64,
    /// wF, N.
    pub(crate) normal_force_n: f64,
    /// Friction, vehicle axes, N.
    pub(crate) friction_n: [f64; 3],
    /// Slip, m/s.
    pub(crate) slip_m_s: f64,
}

impl<'a> Message<'a> {
    /// Reads a message of `group`; `None` if the bytes are not in the wire format.
    pub(crate) fn read(group: &'static Group, bytes: &'a [u8]) -> Option<Self> {
        let fields = fields(bytes)?;
        Some(Message { group, fields })
    }

    /// A number or a count; not a number where the message has none.
    pub(crate) fn number(&self, name: &str) -> f64 {
        match self.field(name) {
            Some(Field::Number(number)) => number,
            Some(Field::Count(count)) => count as f64,
            _ => f64::NAN,
        }
    }

    /// A vector, if the message has it.
    pub(crate) fn vector(&self, name: &str) -> Option<[f64; 3]> {
        match self.field(name)? {
            Field::Bytes(bytes) => components(bytes),
            _ => None,
        }
    }

    /// A vector; not a number where the message has none.
    pub(crate) fn components(&self, name: &str) -> [f64; 3] {
        self.vector(name).unwrap_or([f64::NAN; 3])
    }

    /// The surfaces touched; `None` where one of them cannot be read.
    pub(crate) fn touches(&self) -> Option<Vec<Touch>> {
        let number = self.number_of("touches")?;
        let own = self.fields.iter().filter(|(n, _)| *n == number);
        own.map(|(_, field)| match field {
            Field::Bytes(bytes) => touch(bytes),
            _ => None,
        })
        .collect()
    }

    fn number_of(&self, name: &str) -> Option<u32> {
        let column = self.group.columns.iter().find(|c| c.name == name);
        column.map(|c| c.number)
    }

    fn field(&self, name: &str) -> Option<Field<'a>> {
        find(&self.fields, self.number_of(name)?)
    }
}

fn find<'a>(fields: &[(u32, Field<'a>)], number: u32) -> Option<Field<'a>> {
    // of a field that comes twice the last holds
    let found = fields.iter().rev().find(|(n, _)| *n == number);
    found.map(|&(_, field)| field)
}

fn touch(bytes: &[u8]) -> Option<Touch> {
    let fields = fields(bytes)?;
    let field = |name: &str| {
        let known = TOUCH.iter().find(|f| f.name == name)?;
        find(&fields, known.number)
    };
    let number = |name| match field(name) {
        Some(Field::Number(number)) => number,
        _ => f64::NAN,
    };
    let vector = |name| match field(name) {
        Some(Field::Bytes(bytes)) => components(bytes),
        _ => None,
    };
    let surface = match field("surface") {
        Some(Field::Bytes(name)) => String::from_utf8_lossy(name).into_owned(),
        _ => return None,
    };
    Some(Touch {
        surface,
        depth_m: number("depth_m"),
        normal_force_n: number("normal_force_n"),
        friction_n: vector("friction_vehicle_n").unwrap_or([f64::NAN; 3]),
        slip_m_s: number("slip_m_s"),
    })
}

/// x, y, z of a `foxglove.Vector3`; one that is left out is zero, as protobuf has it.
fn components(bytes: &[u8]) -> Option<[f64; 3]> {
    let fields = fields(bytes)?;
    Some([1, 2, 3].map(|n| match find(&fields, n) {
        Some(Field::Number(number)) => number,
        _ => 0.0,
    }))
}

fn fields(mut bytes: &[u8]) -> Option<Vec<(u32, Field<'_>)>> {
    let mut fields = Vec::new();
    while !bytes.is_empty() {
        let key = varint(&mut bytes)?;
        let number = u32::try_from(key >> 3).ok()?;
        let field = match key & 7 {
            0 => Field::Count(varint(&mut bytes)?),
            1 => Field::Number(f64::from_le_bytes(taken(&mut bytes, 8)?.try_into().ok()?)),
            2 => {
                let length = usize::try_from(varint(&mut bytes)?).ok()?;
                Field::Bytes(taken(&mut bytes, length)?)
            }
            5 => Field::Bytes(taken(&mut bytes, 4)?),
            _ => return None,
        };
        fields.push((number, field));
    }
    Some(fields)
}

fn taken<'a>(bytes: &mut &'a [u8], count: usize) -> Option<&'a [u8]> {
    let (head, rest) = bytes.split_at_checked(count)?;
    *bytes = rest;
    Some(head)
}

fn varint(bytes: &mut &[u8]) -> Option<u64> {
    let mut value = 0;
    for shift in (0..64).step_by(7) {
        let byte = taken(bytes, 1)?[0];
        value |= u64::from(byte & 0x7f) << shift;
        if byte < 0x80 {
            return Some(value);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::mcap::groups::{BELT, SOLVER, SPHERE};
    use crate::files::mcap::wire::Wire;
    use nalgebra::Vector3;

    #[test]
    fn what_the_writer_wrote_comes_back() {
        let mut wire = Wire::default();
        wire.number(1, -0.25);
        wire.number(2, 123.456);
        wire.vector(3, &Vector3::new(1.0, -2.0, 3.5));
        let message = Message::read(&BELT, wire.bytes()).unwrap();
        assert_eq!(message.number("time_s"), -0.25);
        assert_eq!(message.number("loop_force_n"), 123.456);
        assert_eq!(message.vector("restraining_force_vehicle_n"), Some([1.0, -2.0, 3.5]));
        assert!(message.number("length_m").is_nan());
    }

    #[test]
    fn counts_and_touches_come_back() {
        let mut wire = Wire::default();
        wire.count(2, 70_000);
        let message = Message::read(&SOLVER, wire.bytes()).unwrap();
        assert_eq!(message.number("steps"), 70_000.0);
        wire.clear();
        wire.message(7, |w| {
            w.text(1, "floor");
            w.number(2, 0.01);
        });
        wire.message(7, |w| w.text(1, "wall"));
        let message = Message::read(&SPHERE, wire.bytes()).unwrap();
        let touches = message.touches().unwrap();
        assert_eq!(touches.len(), 2);
        assert_eq!((touches[0].surface.as_str(), touches[0].depth_m), ("floor", 0.01));
        assert_eq!(touches[1].surface, "wall");
    }

    #[test]
    fn bytes_that_are_no_message_are_refused() {
        for bytes in [&[0x09, 1, 2][..], &[0x12, 200, 1], &[0xff; 12], &[0x0b]] {
            assert!(Message::read(&BELT, bytes).is_none(), "{bytes:?}");
        }
    }
}
