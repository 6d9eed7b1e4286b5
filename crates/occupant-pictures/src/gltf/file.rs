//! A glTF 2.0 file in its binary form: a JSON text and a block of numbers, put together piece by piece.

use nalgebra::Isometry3;
use serde_json::{Value, json};

use crate::mesh::Mesh;

/// Component types of glTF.
const FLOAT: u32 = 5126;
const INDEX: u32 = 5125;
/// Targets of buffer views; none for times and rotations.
const VERTICES: u32 = 34962;
const TRIANGLES: u32 = 34963;

/// A file under construction.
#[derive(Debug, Default)]
pub(super) struct File {
    numbers: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    nodes: Vec<Value>,
}

impl File {
    /// Adds a two-sided material; its index.
    pub(super) fn material(&mut self, name: &str, [r, g, b, a]: [f64; 4]) -> usize {
        let mode = if a < 1.0 { "BLEND" } else { "OPAQUE" };
        let paint = json!({ "baseColorFactor": [r, g, b, a], "metallicFactor": 0.0, "roughnessFactor": 0.8 });
        let material = json!({ "name": name, "pbrMetallicRoughness": paint, "alphaMode": mode, "doubleSided": true });
        pushed(&mut self.materials, material)
    }

    /// Adds shapes with their materials as one mesh; its index.
    pub(super) fn mesh(&mut self, name: &str, shapes: &[(Mesh, usize)]) -> usize {
        let primitives: Vec<Value> = shapes.iter().map(|(shape, material)| self.primitive(shape, *material)).collect();
        pushed(&mut self.meshes, json!({ "name": name, "primitives": primitives }))
    }

    fn primitive(&mut self, shape: &Mesh, material: usize) -> Value {
        let position = self.floats(&shape.corners, "VEC3", Some(VERTICES));
        let normal = self.floats(&shape.normals, "VEC3", Some(VERTICES));
        let bytes: Vec<u8> = shape.triangles.iter().flatten().flat_map(|i| i.to_le_bytes()).collect();
        let view = self.view(&bytes, Some(TRIANGLES));
        let count = 3 * shape.triangles.len();
        let accessor = json!({ "bufferView": view, "componentType": INDEX, "count": count, "type": "SCALAR" });
        let indices = pushed(&mut self.accessors, accessor);
        json!({ "attributes": { "POSITION": position, "NORMAL": normal }, "indices": indices, "material": material })
    }

    /// Adds rows of numbers, with the range of each column; their index.
    pub(super) fn floats<const N: usize>(&mut self, rows: &[[f32; N]], kind: &str, target: Option<u32>) -> usize {
        let bytes: Vec<u8> = rows.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let view = self.view(&bytes, target);
        let least = |i: usize| rows.iter().map(|row| row[i]).fold(f32::INFINITY, f32::min);
        let greatest = |i: usize| rows.iter().map(|row| row[i]).fold(f32::NEG_INFINITY, f32::max);
        let [min, max] = [(0..N).map(least).collect::<Vec<_>>(), (0..N).map(greatest).collect()];
        let accessor = json!({
            "bufferView": view, "componentType": FLOAT, "count": rows.len(), "type": kind, "min": min, "max": max,
        });
        pushed(&mut self.accessors, accessor)
    }

    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": self.numbers.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        // all numbers have four bytes: what follows stands at a multiple of four
        self.numbers.extend_from_slice(bytes);
        pushed(&mut self.views, view)
    }

    /// Adds a node; its index.
    pub(super) fn node(&mut self, name: &str, pose: &Isometry3<f64>, mesh: Option<usize>, children: &[usize]) -> usize {
        let mut node = json!({ "name": name, "translation": place(pose), "rotation": turn(pose) });
        if let Some(mesh) = mesh {
            node["mesh"] = mesh.into();
        }
        if !children.is_empty() {
            node["children"] = children.into();
        }
        pushed(&mut self.nodes, node)
    }

    /// Bytes of the file, with `root` as its scene.
    pub(super) fn finish(self, generator: &str, root: usize, animations: &[Value]) -> Vec<u8> {
        let mut text = json!({
            "asset": { "version": "2.0", "generator": generator },
            "scene": 0,
            "scenes": [{ "nodes": [root] }],
            "nodes": self.nodes,
            "meshes": self.meshes,
            "materials": self.materials,
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{ "byteLength": self.numbers.len() }],
        });
        if !animations.is_empty() {
            text["animations"] = animations.into();
        }
        let mut json = text.to_string().into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let length = 12 + 8 + json.len() + 8 + self.numbers.len();
        let mut bytes = b"glTF".to_vec();
        let mut put = |number: usize| bytes.extend_from_slice(&(number as u32).to_le_bytes());
        [2, length, json.len()].into_iter().for_each(&mut put);
        bytes.extend_from_slice(b"JSON");
        bytes.extend_from_slice(&json);
        bytes.extend_from_slice(&(self.numbers.len() as u32).to_le_bytes());
        bytes.extend_from_slice(b"BIN\0");
        bytes.extend_from_slice(&self.numbers);
        bytes
    }
}

fn pushed(list: &mut Vec<Value>, value: Value) -> usize {
    list.push(value);
    list.len() - 1
}

pub(super) fn place(pose: &Isometry3<f64>) -> [f32; 3] {
    pose.translation.vector.data.0[0].map(|x| x as f32)
}

pub(super) fn turn(pose: &Isometry3<f64>) -> [f32; 4] {
    pose.rotation.coords.data.0[0].map(|x| x as f32)
}
