//! Descriptions of results: name of a quantity, its unit and axes, its field in the result file, and how to compute it.
//!
//! Each module with results lists its quantities once; [`crate::results::catalogue`] combines the lists of a model.
//! Nothing here knows a model or a run.

use std::fmt;

use nalgebra::{UnitQuaternion, Vector3};
use occupant_units::unit::Unit;

/// Axes of a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axes {
    /// No axes: a scalar or a resultant.
    None,
    /// Vehicle axes: X forward, Y right, Z down.
    Vehicle,
    /// Axes of the segment: X forward, Y to the occupant's left, Z up when standing upright.
    Segment,
    /// SAE J211 axes of the segment: X forward, Y to the occupant's right, Z down when standing upright.
    J211,
    /// Vehicle-space: X′_v forward, Y′_v right, Z′_v down, fixed.
    VehicleSpace,
    /// Space: X′ forward, Y′ left, Z′ up.
    Space,
}

impl Axes {
    /// Name in metadata.
    pub const fn name(self) -> &'static str {
        ["none", "vehicle", "segment", "segment (SAE J211)", "vehicle-space", "space"][self as usize]
    }

    /// Word in the names of fields.
    const fn word(self) -> &'static str {
        ["", "vehicle", "segment", "j211", "path", "space"][self as usize]
    }
}

/// Segment axes (left, up) to SAE J211 axes (right, down), or back: rotation by 180° about X.
pub(crate) fn to_j211(v: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(v.x, -v.y, -v.z)
}

/// Owner of quantities: the vehicle, a segment, a belt.
pub trait Owner: Copy + fmt::Debug {
    /// Data of the owner at one output.
    type At<'a>;
}

/// Function that reads a value of its owner at one output.
type Taker<O, T> = for<'a> fn(&<O as Owner>::At<'a>) -> T;

/// A quantity of results: a time history, a field of a message, or both.
#[derive(Clone, Copy, Debug)]
pub struct Quantity<O: Owner> {
    /// SI unit.
    pub unit: Unit,
    /// Axes.
    pub axes: Axes,
    /// Access to the value.
    pub take: Take<O>,
    /// Words as a time history.
    pub channel: Option<ChannelWords>,
    /// Words as a field of its owner's message.
    pub field: Option<FieldWords>,
    /// The field of a vector's magnitude.
    pub resultant: Option<FieldWords>,
}

/// Name and meaning of a time history.
#[derive(Clone, Copy, Debug)]
pub struct ChannelWords {
    /// Suffix of its name, after the owner's.
    pub name: &'static str,
    /// Meaning, with `{}` for the owner.
    pub meaning: &'static str,
}

/// Name and meaning of a field of a message. Field numbers are never reused for something else.
#[derive(Clone, Copy, Debug)]
pub struct FieldWords {
    /// Field number.
    pub number: u32,
    /// Name without axes and unit.
    pub stem: &'static str,
    /// Meaning, for the file's metadata.
    pub meaning: &'static str,
}

/// Access to a quantity of its owner at one output.
#[derive(Clone, Copy, Debug)]
pub enum Take<O: Owner> {
    /// A number.
    Number(Taker<O, f64>),
    /// A whole number.
    Count(Taker<O, u64>),
    /// Text.
    Text(Taker<O, String>),
    /// A vector.
    Vector(Taker<O, Vector3<f64>>),
    /// A vector that may be missing.
    Perhaps(Taker<O, Option<Vector3<f64>>>),
    /// A rotation.
    Rotation(Taker<O, UnitQuaternion<f64>>),
    /// A list of numbers.
    Numbers(Taker<O, Vec<f64>>),
    /// A list of indices.
    Indices(Taker<O, Vec<u32>>),
    /// Messages of the named type within the message.
    Parts(&'static str, Taker<O, Vec<Fields>>),
}

/// Fields of a message by number.
pub(crate) type Fields = Vec<(u32, Value)>;

/// Value of a quantity.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A whole number.
    Count(u64),
    /// Text.
    Text(String),
    /// A vector; none if missing.
    Vector(Option<Vector3<f64>>),
    /// A rotation.
    Rotation(UnitQuaternion<f64>),
    /// A list of numbers.
    Numbers(Vec<f64>),
    /// A list of indices.
    Indices(Vec<u32>),
    /// A long list of numbers in single precision.
    Singles(Vec<f32>),
    /// Messages within the message.
    Parts(Vec<Fields>),
}

/// Type of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A number.
    Number,
    /// A whole number.
    Count,
    /// Text.
    Text,
    /// A vector.
    Vector,
    /// A rotation.
    Rotation,
    /// A list of numbers.
    Numbers,
    /// A list of indices.
    Indices,
    /// A long list of numbers in single precision.
    Singles,
    /// Messages of the named type.
    Parts(&'static str),
}

impl<O: Owner> Quantity<O> {
    /// Quantity read by a function.
    pub(crate) const fn new(unit: Unit, axes: Axes, take: Take<O>) -> Self {
        Quantity { unit, axes, take, channel: None, field: None, resultant: None }
    }

    /// A number.
    pub(crate) const fn number(unit: Unit, of: fn(&O::At<'_>) -> f64) -> Self {
        Quantity::new(unit, Axes::None, Take::Number(of))
    }

    /// A whole number.
    pub(crate) const fn count(of: fn(&O::At<'_>) -> u64) -> Self {
        Quantity::new(Unit::One, Axes::None, Take::Count(of))
    }

    /// A vector.
    pub const fn vector(unit: Unit, axes: Axes, of: fn(&O::At<'_>) -> Vector3<f64>) -> Self {
        Quantity::new(unit, axes, Take::Vector(of))
    }

    /// A vector that may be missing.
    pub(crate) const fn perhaps(unit: Unit, axes: Axes, of: fn(&O::At<'_>) -> Option<Vector3<f64>>) -> Self {
        Quantity::new(unit, axes, Take::Perhaps(of))
    }

    /// Adds a time history; `{}` in `meaning` stands for the owner.
    pub const fn channel(mut self, name: &'static str, meaning: &'static str) -> Self {
        self.channel = Some(ChannelWords { name, meaning });
        self
    }

    /// Adds a field of the owner's message; axes and unit are added to `stem`.
    pub(crate) const fn field(mut self, number: u32, stem: &'static str, meaning: &'static str) -> Self {
        self.field = Some(FieldWords { number, stem, meaning });
        self
    }

    /// Adds a field for the magnitude.
    pub(crate) const fn resultant(mut self, number: u32, stem: &'static str, meaning: &'static str) -> Self {
        self.resultant = Some(FieldWords { number, stem, meaning });
        self
    }

    /// Name of its field: quantity, axes, unit.
    pub(crate) fn field_name(&self, stem: &str) -> String {
        let unit = suffix(self.unit);
        [stem, self.axes.word(), &unit].into_iter().filter(|w| !w.is_empty()).collect::<Vec<_>>().join("_")
    }

    /// Name of the field of its magnitude.
    pub(crate) fn resultant_name(&self, stem: &str) -> String {
        format!("{stem}_resultant_{}", suffix(self.unit))
    }

    /// Its value.
    pub(crate) fn value(&self, at: &O::At<'_>) -> Value {
        match self.take {
            Take::Number(of) => Value::Number(of(at)),
            Take::Count(of) => Value::Count(of(at)),
            Take::Text(of) => Value::Text(of(at)),
            Take::Vector(of) => Value::Vector(Some(of(at))),
            Take::Perhaps(of) => Value::Vector(of(at)),
            Take::Rotation(of) => Value::Rotation(of(at)),
            Take::Numbers(of) => Value::Numbers(of(at)),
            Take::Indices(of) => Value::Indices(of(at)),
            Take::Parts(_, of) => Value::Parts(of(at)),
        }
    }

    /// The type of its field.
    pub(crate) const fn kind(&self) -> Kind {
        match self.take {
            Take::Number(_) => Kind::Number,
            Take::Count(_) => Kind::Count,
            Take::Text(_) => Kind::Text,
            Take::Vector(_) | Take::Perhaps(_) => Kind::Vector,
            Take::Rotation(_) => Kind::Rotation,
            Take::Numbers(_) => Kind::Numbers,
            Take::Indices(_) => Kind::Indices,
            Take::Parts(message, _) => Kind::Parts(message),
        }
    }
}

/// An energy of the ledger.
#[derive(Clone, Copy, Debug)]
pub struct Energy;

impl Owner for Energy {
    type At<'a> = f64;
}

/// An energy: field number, name, and meaning in plots and in the file's metadata.
pub(crate) const fn energy(
    number: u32,
    name: &'static str,
    meaning: &'static str,
    recorded: &'static str,
) -> Quantity<Energy> {
    Quantity::number(Unit::Joule, |energy_j| *energy_j).channel(name, meaning).field(number, name, recorded)
}

/// `m_s2` for m/s²; empty for a dimensionless number.
fn suffix(unit: Unit) -> String {
    match unit {
        Unit::One => String::new(),
        unit => unit.symbol().to_lowercase().replace(['/', '·'], "_").replace('²', "2").replace('³', "3"),
    }
}

/// Values of all fields of a list, by number.
pub(crate) fn values<O: Owner>(list: &[Quantity<O>], at: &O::At<'_>) -> Fields {
    list.iter().filter_map(|q| Some((q.field?.number, q.value(at)))).collect()
}
