//! The public Foxglove types that viewers draw: `foxglove.SceneUpdate`, `foxglove.FrameTransforms`, `foxglove.Log`.
//!
//! Names, field numbers and enum values are those of the published schemas, all fields included, because a viewer may read
//! a list that we never fill. They are stated here rather than taken from Foxglove's own crate, which would add some
//! thirty crates for this table; `tests/read_back.py` compares them with Foxglove's published Python package.

use prost_types::FileDescriptorProto;

use super::descriptor::{enumeration, field, file};

/// Name of the schema of a scene.
pub const SCENE_UPDATE: &str = "SceneUpdate";
/// Name of the schema of transforms.
pub const FRAME_TRANSFORMS: &str = "FrameTransforms";
/// Name of the schema of log lines.
pub const LOG: &str = "Log";

/// `foxglove.Log.Level`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// An event.
    Info = 2,
    /// A warning for the user.
    Warning = 3,
    /// The reason why the run ended.
    Error = 4,
}

/// Every file that a schema may refer to.
pub fn library() -> Vec<FileDescriptorProto> {
    let seconds = |name: &str| FileDescriptorProto {
        name: Some(format!("google/protobuf/{}.proto", name.to_lowercase())),
        ..declared("google.protobuf", name, "int64 seconds, int32 nanos")
    };
    let own = MESSAGES.iter().map(|(name, fields)| declared("foxglove", name, fields));
    [seconds("Timestamp"), seconds("Duration")].into_iter().chain(own).collect()
}

/// A file from an entry of [`MESSAGES`].
fn declared(package: &str, name: &str, fields: &str) -> FileDescriptorProto {
    let (fields, nested) = match fields.split_once("; ") {
        Some((fields, nested)) => (fields, nested.split_once(": ")),
        None => (fields, None),
    };
    let described = |(number, words): (u32, &str)| words.rsplit_once(' ').map(|(kind, name)| field(number, name, kind));
    let fields = (1..).zip(fields.split(", ")).filter_map(described);
    let nested = nested.map(|(name, values)| enumeration(name, values.split(' ')));
    file(package, name, fields.collect(), nested)
}

/// The messages: fields, numbered from 1, and the values of an enum declared inside, numbered from 0.
#[rustfmt::skip]
const MESSAGES: [(&str, &str); 20] = [
    ("Vector3", "double x, double y, double z"),
    ("Point3", "double x, double y, double z"),
    ("Quaternion", "double x, double y, double z, double w"),
    ("Color", "double r, double g, double b, double a"),
    ("Pose", "foxglove.Vector3 position, foxglove.Quaternion orientation"),
    ("FrameTransform", "google.protobuf.Timestamp timestamp, string parent_frame_id, string child_frame_id, \
        foxglove.Vector3 translation, foxglove.Quaternion rotation"),
    (FRAME_TRANSFORMS, "repeated foxglove.FrameTransform transforms"),
    (LOG, "google.protobuf.Timestamp timestamp, enum foxglove.Log.Level level, string message, string name, string file, \
        fixed32 line; Level: UNKNOWN DEBUG INFO WARNING ERROR FATAL"),
    (SCENE_UPDATE, "repeated foxglove.SceneEntityDeletion deletions, repeated foxglove.SceneEntity entities"),
    ("SceneEntityDeletion", "google.protobuf.Timestamp timestamp, enum foxglove.SceneEntityDeletion.Type type, string id; \
        Type: MATCHING_ID ALL"),
    ("SceneEntity", "google.protobuf.Timestamp timestamp, string frame_id, string id, google.protobuf.Duration lifetime, \
        bool frame_locked, repeated foxglove.KeyValuePair metadata, repeated foxglove.ArrowPrimitive arrows, \
        repeated foxglove.CubePrimitive cubes, repeated foxglove.SpherePrimitive spheres, \
        repeated foxglove.CylinderPrimitive cylinders, repeated foxglove.LinePrimitive lines, \
        repeated foxglove.TriangleListPrimitive triangles, repeated foxglove.TextPrimitive texts, \
        repeated foxglove.ModelPrimitive models"),
    ("KeyValuePair", "string key, string value"),
    ("ArrowPrimitive", "foxglove.Pose pose, double shaft_length, double shaft_diameter, double head_length, \
        double head_diameter, foxglove.Color color"),
    ("CubePrimitive", "foxglove.Pose pose, foxglove.Vector3 size, foxglove.Color color"),
    ("SpherePrimitive", "foxglove.Pose pose, foxglove.Vector3 size, foxglove.Color color"),
    ("CylinderPrimitive", "foxglove.Pose pose, foxglove.Vector3 size, double bottom_scale, double top_scale, \
        foxglove.Color color"),
    ("LinePrimitive", "enum foxglove.LinePrimitive.Type type, foxglove.Pose pose, double thickness, \
        bool scale_invariant, repeated foxglove.Point3 points, foxglove.Color color, repeated foxglove.Color colors, \
        repeated fixed32 indices; Type: LINE_STRIP LINE_LOOP LINE_LIST"),
    ("TriangleListPrimitive", "foxglove.Pose pose, repeated foxglove.Point3 points, foxglove.Color color, \
        repeated foxglove.Color colors, repeated fixed32 indices"),
    ("TextPrimitive", "foxglove.Pose pose, bool billboard, double font_size, bool scale_invariant, foxglove.Color color, \
        string text"),
    ("ModelPrimitive", "foxglove.Pose pose, foxglove.Vector3 scale, foxglove.Color color, bool override_color, \
        string url, string media_type, bytes data"),
];
