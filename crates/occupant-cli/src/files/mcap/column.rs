//! A group of results that go into one message: one table gives both the schema and the encoding, so they cannot differ.

use nalgebra::{UnitQuaternion, Vector3};
use occupant_core::motion::report_coordinates::DOF;
use occupant_core::results::sample::Sample;

use super::descriptor::{Field, Kind, many, one};
use super::wire::Wire;

/// Results that belong together: the message type and its fields.
#[derive(Debug)]
pub struct Group {
    /// Name of the message type in the package `occupant`.
    pub message: &'static str,
    /// Its fields.
    pub columns: &'static [Column],
}

/// A field of a group.
#[derive(Debug)]
pub struct Column {
    /// Field number. Numbers are never given again to something else.
    pub number: u32,
    /// Field name: quantity, axes, unit.
    pub name: &'static str,
    /// What it is, for the channel's metadata.
    pub(crate) meaning: &'static str,
    /// Where it comes from.
    pub(crate) value: Value,
}

/// How a column takes its value from a sample; the index says which segment, sphere or belt.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Value {
    Number(fn(&Sample<'_>, usize) -> f64),
    /// A whole number.
    Count(fn(&Sample<'_>, usize) -> u64),
    Vector(fn(&Sample<'_>, usize) -> Vector3<f64>),
    /// A vector that need not exist; the field is absent then.
    Perhaps(fn(&Sample<'_>, usize) -> Option<Vector3<f64>>),
    Rotation(fn(&Sample<'_>, usize) -> UnitQuaternion<f64>),
    /// The report's coordinates or their rates.
    Coordinates(fn(&Sample<'_>) -> [f64; DOF]),
    /// A list of numbers.
    Numbers(fn(&Sample<'_>) -> Vec<f64>),
    /// A list of indices.
    Indices(fn(&Sample<'_>) -> Vec<u32>),
    /// The surfaces that the sphere touches, one by one.
    Touches,
}

/// The touching pair's own message.
pub const TOUCH: &[Field] = &[
    one(1, "surface", Kind::Text),
    one(2, "depth_m", Kind::Number),
    one(3, "normal_force_n", Kind::Number),
    one(4, "force_vehicle_n", Kind::Message("foxglove.Vector3")),
    one(5, "friction_vehicle_n", Kind::Message("foxglove.Vector3")),
    one(6, "point_vehicle_m", Kind::Message("foxglove.Vector3")),
    one(7, "slip_m_s", Kind::Number),
];

impl Column {
    /// Its field in the schema.
    pub(crate) fn field(&self) -> Field {
        let (number, name) = (self.number, self.name);
        match self.value {
            Value::Number(_) => one(number, name, Kind::Number),
            Value::Count(_) => one(number, name, Kind::Count),
            Value::Vector(_) | Value::Perhaps(_) => one(number, name, Kind::Message("foxglove.Vector3")),
            Value::Rotation(_) => one(number, name, Kind::Message("foxglove.Quaternion")),
            Value::Coordinates(_) | Value::Numbers(_) => many(number, name, Kind::Number),
            Value::Indices(_) => many(number, name, Kind::Index),
            Value::Touches => many(number, name, Kind::Message("occupant.Touch")),
        }
    }

    pub(crate) fn write(&self, sample: &Sample<'_>, index: usize, wire: &mut Wire) {
        let number = self.number;
        match self.value {
            Value::Number(of) => wire.number(number, of(sample, index)),
            Value::Count(of) => wire.count(number, of(sample, index)),
            Value::Vector(of) => wire.vector(number, &of(sample, index)),
            Value::Perhaps(of) => {
                if let Some(v) = of(sample, index) {
                    wire.vector(number, &v);
                }
            }
            Value::Rotation(of) => wire.rotation(number, &of(sample, index)),
            Value::Coordinates(of) => wire.numbers(number, &of(sample)),
            Value::Numbers(of) => wire.numbers(number, &of(sample)),
            Value::Indices(of) => wire.indices(number, &of(sample)),
            Value::Touches => write_touches(number, sample, index, wire),
        }
    }
}

fn write_touches(number: u32, sample: &Sample<'_>, sphere: usize, wire: &mut Wire) {
    let surfaces = &sample.model.setup().surfaces;
    for contact in sample.contacts().filter(|c| c.sphere == sphere) {
        wire.message(number, |w| {
            w.text(1, &surfaces[contact.surface].name);
            w.number(2, contact.depth_m);
            w.number(3, contact.normal_force_n);
            w.vector(4, &contact.force_n);
            w.vector(5, &contact.friction_n);
            w.vector(6, &contact.point_m.coords);
            w.number(7, contact.slip_m_s);
        });
    }
}

/// The time in every group's first field.
pub(crate) const TIME: Column =
    Column { number: 1, name: "time_s", meaning: "time of the scenario", value: Value::Number(|s, _| s.time_s) };

/// A column, in one line.
pub(crate) const fn column(number: u32, name: &'static str, value: Value, meaning: &'static str) -> Column {
    Column { number, name, meaning, value }
}
