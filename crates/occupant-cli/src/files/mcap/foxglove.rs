//! The public Foxglove types that viewers draw: `foxglove.SceneUpdate`, `foxglove.FrameTransforms`, `foxglove.Log`.
//!
//! Names, field numbers and enum values are those of the published schemas, all fields included, because a viewer may read
//! a list that we never fill. They are stated here rather than taken from Foxglove's own crate, which would add some
//! thirty crates for these tables; `tests/read_back.py` compares them with Foxglove's published Python package.

use prost_types::FileDescriptorProto;

use super::descriptor::{Field, Kind, NestedEnum, file, many, one};

use Kind::{Bytes, Enum, Flag, Index, Message, Number, Signed, SmallSigned, Text};

const TIME: Kind = Message("google.protobuf.Timestamp");
const COLOR: Kind = Message("foxglove.Color");
const POINT: Kind = Message("foxglove.Point3");
const POSE: Kind = Message("foxglove.Pose");
const QUATERNION: Kind = Message("foxglove.Quaternion");
const VECTOR: Kind = Message("foxglove.Vector3");

/// A message of the library: its name, fields and nested enum.
type Entry = (&'static str, &'static [Field<'static>], Option<NestedEnum>);

/// Name of the schema of a scene.
pub(crate) const SCENE_UPDATE: &str = "SceneUpdate";
/// Name of the schema of transforms.
pub(crate) const FRAME_TRANSFORMS: &str = "FrameTransforms";
/// Name of the schema of log lines.
pub(crate) const LOG: &str = "Log";

/// `foxglove.Log.Level`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Level {
    /// What happened.
    Info = 2,
    /// What the user should know.
    Warning = 3,
    /// What ended the run.
    Error = 4,
}

/// Every file that a schema may refer to.
pub(crate) fn library() -> Vec<FileDescriptorProto> {
    let seconds = |name: &str| {
        let fields = [one(1, "seconds", Signed), one(2, "nanos", SmallSigned)];
        FileDescriptorProto {
            name: Some(format!("google/protobuf/{}.proto", name.to_lowercase())),
            ..file("google.protobuf", name, &fields, None)
        }
    };
    let own = MESSAGES.iter().map(|&(name, fields, nested)| file("foxglove", name, fields, nested));
    [seconds("Timestamp"), seconds("Duration")].into_iter().chain(own).collect()
}

const MESSAGES: &[Entry] = &[
    ("Vector3", XYZ, None),
    ("Point3", XYZ, None),
    ("Quaternion", &[one(1, "x", Number), one(2, "y", Number), one(3, "z", Number), one(4, "w", Number)], None),
    ("Color", &[one(1, "r", Number), one(2, "g", Number), one(3, "b", Number), one(4, "a", Number)], None),
    ("Pose", &[one(1, "position", VECTOR), one(2, "orientation", QUATERNION)], None),
    (
        "FrameTransform",
        &[
            one(1, "timestamp", TIME),
            one(2, "parent_frame_id", Text),
            one(3, "child_frame_id", Text),
            one(4, "translation", VECTOR),
            one(5, "rotation", QUATERNION),
        ],
        None,
    ),
    (FRAME_TRANSFORMS, &[many(1, "transforms", Message("foxglove.FrameTransform"))], None),
    (
        LOG,
        &[
            one(1, "timestamp", TIME),
            one(2, "level", Enum("foxglove.Log.Level")),
            one(3, "message", Text),
            one(4, "name", Text),
            one(5, "file", Text),
            one(6, "line", Index),
        ],
        Some(("Level", &["UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"])),
    ),
    (
        SCENE_UPDATE,
        &[
            many(1, "deletions", Message("foxglove.SceneEntityDeletion")),
            many(2, "entities", Message("foxglove.SceneEntity")),
        ],
        None,
    ),
    (
        "SceneEntityDeletion",
        &[one(1, "timestamp", TIME), one(2, "type", Enum("foxglove.SceneEntityDeletion.Type")), one(3, "id", Text)],
        Some(("Type", &["MATCHING_ID", "ALL"])),
    ),
    (
        "SceneEntity",
        &[
            one(1, "timestamp", TIME),
            one(2, "frame_id", Text),
            one(3, "id", Text),
            one(4, "lifetime", Message("google.protobuf.Duration")),
            one(5, "frame_locked", Flag),
            many(6, "metadata", Message("foxglove.KeyValuePair")),
            many(7, "arrows", Message("foxglove.ArrowPrimitive")),
            many(8, "cubes", Message("foxglove.CubePrimitive")),
            many(9, "spheres", Message("foxglove.SpherePrimitive")),
            many(10, "cylinders", Message("foxglove.CylinderPrimitive")),
            many(11, "lines", Message("foxglove.LinePrimitive")),
            many(12, "triangles", Message("foxglove.TriangleListPrimitive")),
            many(13, "texts", Message("foxglove.TextPrimitive")),
            many(14, "models", Message("foxglove.ModelPrimitive")),
        ],
        None,
    ),
    ("KeyValuePair", &[one(1, "key", Text), one(2, "value", Text)], None),
    (
        "ArrowPrimitive",
        &[
            one(1, "pose", POSE),
            one(2, "shaft_length", Number),
            one(3, "shaft_diameter", Number),
            one(4, "head_length", Number),
            one(5, "head_diameter", Number),
            one(6, "color", COLOR),
        ],
        None,
    ),
    ("CubePrimitive", &[one(1, "pose", POSE), one(2, "size", VECTOR), one(3, "color", COLOR)], None),
    ("SpherePrimitive", &[one(1, "pose", POSE), one(2, "size", VECTOR), one(3, "color", COLOR)], None),
    (
        "CylinderPrimitive",
        &[
            one(1, "pose", POSE),
            one(2, "size", VECTOR),
            one(3, "bottom_scale", Number),
            one(4, "top_scale", Number),
            one(5, "color", COLOR),
        ],
        None,
    ),
    (
        "LinePrimitive",
        &[
            one(1, "type", Enum("foxglove.LinePrimitive.Type")),
            one(2, "pose", POSE),
            one(3, "thickness", Number),
            one(4, "scale_invariant", Flag),
            many(5, "points", POINT),
            one(6, "color", COLOR),
            many(7, "colors", COLOR),
            many(8, "indices", Index),
        ],
        Some(("Type", &["LINE_STRIP", "LINE_LOOP", "LINE_LIST"])),
    ),
    (
        "TriangleListPrimitive",
        &[
            one(1, "pose", POSE),
            many(2, "points", POINT),
            one(3, "color", COLOR),
            many(4, "colors", COLOR),
            many(5, "indices", Index),
        ],
        None,
    ),
    (
        "TextPrimitive",
        &[
            one(1, "pose", POSE),
            one(2, "billboard", Flag),
            one(3, "font_size", Number),
            one(4, "scale_invariant", Flag),
            one(5, "color", COLOR),
            one(6, "text", Text),
        ],
        None,
    ),
    (
        "ModelPrimitive",
        &[
            one(1, "pose", POSE),
            one(2, "scale", VECTOR),
            one(3, "color", COLOR),
            one(4, "override_color", Flag),
            one(5, "url", Text),
            one(6, "media_type", Text),
            one(7, "data", Bytes),
        ],
        None,
    ),
];

const XYZ: &[Field<'static>] = &[one(1, "x", Number), one(2, "y", Number), one(3, "z", Number)];
