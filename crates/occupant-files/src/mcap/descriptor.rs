//! Protobuf types described at run time: what a reader needs to understand a channel without a `.proto` file.

use prost::Message as _;
use prost_types::field_descriptor_proto::{Label, Type};
use prost_types::{
    DescriptorProto, EnumDescriptorProto, EnumValueDescriptorProto, FieldDescriptorProto, FileDescriptorProto,
    FileDescriptorSet,
};

/// A field: its number, which never changes, its name with the unit, and its type in `.proto` notation: `double`,
/// `repeated fixed32`, `enum foxglove.Log.Level`; any other is a message.
pub fn field(number: u32, name: &str, words: &str) -> FieldDescriptorProto {
    let (label, words) = match words.strip_prefix("repeated ") {
        Some(words) => (Label::Repeated, words),
        None => (Label::Optional, words),
    };
    let (kind, declared) = match words.strip_prefix("enum ") {
        Some(name) => (Type::Enum, Some(name)),
        None => match Type::from_str_name(&format!("TYPE_{}", words.to_uppercase())) {
            Some(kind) => (kind, None),
            None => (Type::Message, Some(words)),
        },
    };
    FieldDescriptorProto {
        name: Some(name.to_owned()),
        number: Some(number as i32),
        label: Some(label.into()),
        r#type: Some(kind.into()),
        type_name: declared.map(|name| format!(".{name}")),
        ..Default::default()
    }
}

/// An enum declared inside a message; its values are numbered from 0.
pub fn enumeration<'a>(name: &str, values: impl Iterator<Item = &'a str>) -> EnumDescriptorProto {
    let value = |(number, name): (i32, &str)| EnumValueDescriptorProto {
        name: Some(name.to_owned()),
        number: Some(number),
        ..Default::default()
    };
    EnumDescriptorProto {
        name: Some(name.to_owned()),
        value: (0..).zip(values).map(value).collect(),
        ..Default::default()
    }
}

/// A `.proto` file with one message of the same name; `package/Name.proto` declares `package.Name`.
pub fn file(
    package: &str,
    name: &str,
    fields: Vec<FieldDescriptorProto>,
    nested: Option<EnumDescriptorProto>,
) -> FileDescriptorProto {
    let own = format!("{package}/{name}.proto");
    let mut dependency: Vec<String> = fields.iter().filter_map(|f| home(f.type_name())).collect();
    dependency.sort();
    dependency.dedup();
    dependency.retain(|d| *d != own);
    FileDescriptorProto {
        name: Some(own),
        package: Some(package.to_owned()),
        dependency,
        message_type: vec![DescriptorProto {
            name: Some(name.to_owned()),
            field: fields,
            enum_type: nested.into_iter().collect(),
            ..Default::default()
        }],
        syntax: Some("proto3".to_owned()),
        ..Default::default()
    }
}

/// The file that declares a type: `.a.B` and `.a.B.C` are in `a/B.proto`, Google's in files with lower-case names.
fn home(type_name: &str) -> Option<String> {
    if let Some(google) = type_name.strip_prefix(".google.protobuf.") {
        return Some(format!("google/protobuf/{}.proto", google.to_lowercase()));
    }
    let mut words = type_name.split('.').skip(1);
    Some(format!("{}/{}.proto", words.next()?, words.next()?))
}

/// Bytes of a schema record: the file and all that it refers to, dependencies first.
pub fn set(wanted: &FileDescriptorProto, library: &[FileDescriptorProto]) -> Vec<u8> {
    let mut file = Vec::new();
    collect(wanted, library, &mut file);
    FileDescriptorSet { file }.encode_to_vec()
}

fn collect(file: &FileDescriptorProto, library: &[FileDescriptorProto], files: &mut Vec<FileDescriptorProto>) {
    if files.iter().any(|f| f.name == file.name) {
        return;
    }
    for dependency in &file.dependency {
        if let Some(found) = library.iter().find(|f| f.name() == dependency) {
            collect(found, library, files);
        }
    }
    files.push(file.clone());
}
