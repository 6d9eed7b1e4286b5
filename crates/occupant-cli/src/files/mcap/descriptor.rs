//! Protobuf types described at run time: what a reader needs to understand a channel without a `.proto` file.

use prost::Message as _;
use prost_types::field_descriptor_proto::{Label, Type};
use prost_types::{
    DescriptorProto, EnumDescriptorProto, EnumValueDescriptorProto, FieldDescriptorProto, FileDescriptorProto,
    FileDescriptorSet,
};

/// Type of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// `double`.
    Number,
    /// `uint64`.
    Count,
    /// `fixed32`.
    Index,
    /// `int64`.
    Signed,
    /// `int32`.
    SmallSigned,
    /// `bool`.
    Flag,
    /// `string`.
    Text,
    /// `bytes`.
    Bytes,
    /// A message by its full name, e.g. `foxglove.Vector3`.
    Message(&'static str),
    /// An enum by its full name.
    Enum(&'static str),
}

/// A field of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Field<'a> {
    /// Its number, which never changes.
    pub(crate) number: u32,
    /// Its name, with the unit of what it holds.
    pub(crate) name: &'a str,
    /// Its type.
    pub(crate) kind: Kind,
    /// A list of values.
    pub(crate) repeated: bool,
}

/// A single value.
pub(crate) const fn one(number: u32, name: &str, kind: Kind) -> Field<'_> {
    Field { number, name, kind, repeated: false }
}

/// A list of values.
pub(crate) const fn many(number: u32, name: &str, kind: Kind) -> Field<'_> {
    Field { number, name, kind, repeated: true }
}

/// An enum declared inside a message: its name and its values, numbered from 0.
pub(crate) type NestedEnum = (&'static str, &'static [&'static str]);

/// A `.proto` file with one message of its own name; `package/Name.proto` declares `package.Name`.
pub(crate) fn file(package: &str, name: &str, fields: &[Field<'_>], nested: Option<NestedEnum>) -> FileDescriptorProto {
    let mut dependency: Vec<String> = fields.iter().filter_map(|f| home(f.kind)).collect();
    dependency.sort();
    dependency.dedup();
    let own = format!("{package}/{name}.proto");
    dependency.retain(|d| *d != own);
    FileDescriptorProto {
        name: Some(own),
        package: Some(package.to_owned()),
        dependency,
        message_type: vec![DescriptorProto {
            name: Some(name.to_owned()),
            field: fields.iter().map(describe).collect(),
            enum_type: nested.map(describe_enum).into_iter().collect(),
            ..Default::default()
        }],
        syntax: Some("proto3".to_owned()),
        ..Default::default()
    }
}

/// The bytes of a schema record: the wanted files and all that they refer to, dependencies first.
pub(crate) fn set(wanted: &FileDescriptorProto, library: &[FileDescriptorProto]) -> Vec<u8> {
    let mut files = Vec::new();
    collect(wanted, library, &mut files);
    FileDescriptorSet { file: files }.encode_to_vec()
}

fn collect(file: &FileDescriptorProto, library: &[FileDescriptorProto], files: &mut Vec<FileDescriptorProto>) {
    if files.iter().any(|f| f.name == file.name) {
        return;
    }
    for dependency in &file.dependency {
        let found = library.iter().find(|f| f.name.as_deref() == Some(dependency));
        if let Some(found) = found {
            collect(found, library, files);
        }
    }
    files.push(file.clone());
}

/// The file that declares a type: `a.B` and `a.B.C` stand in `a/B.proto`, Google's in files of small letters.
fn home(kind: Kind) -> Option<String> {
    let (Kind::Message(name) | Kind::Enum(name)) = kind else {
        return None;
    };
    if let Some(google) = name.strip_prefix("google.protobuf.") {
        return Some(format!("google/protobuf/{}.proto", google.to_lowercase()));
    }
    let mut words = name.split('.');
    Some(format!("{}/{}.proto", words.next()?, words.next()?))
}

fn describe(field: &Field<'_>) -> FieldDescriptorProto {
    let label = if field.repeated { Label::Repeated } else { Label::Optional };
    let (kind, type_name) = match field.kind {
        Kind::Number => (Type::Double, None),
        Kind::Count => (Type::Uint64, None),
        Kind::Index => (Type::Fixed32, None),
        Kind::Signed => (Type::Int64, None),
        Kind::SmallSigned => (Type::Int32, None),
        Kind::Flag => (Type::Bool, None),
        Kind::Text => (Type::String, None),
        Kind::Bytes => (Type::Bytes, None),
        Kind::Message(name) => (Type::Message, Some(format!(".{name}"))),
        Kind::Enum(name) => (Type::Enum, Some(format!(".{name}"))),
    };
    FieldDescriptorProto {
        name: Some(field.name.to_owned()),
        number: Some(field.number as i32),
        label: Some(label.into()),
        r#type: Some(kind.into()),
        type_name,
        ..Default::default()
    }
}

fn describe_enum((name, values): NestedEnum) -> EnumDescriptorProto {
    let value = |(number, name): (i32, &&str)| EnumValueDescriptorProto {
        name: Some((*name).to_owned()),
        number: Some(number),
        ..Default::default()
    };
    EnumDescriptorProto {
        name: Some(name.to_owned()),
        value: (0..).zip(values).map(value).collect(),
        ..Default::default()
    }
}
