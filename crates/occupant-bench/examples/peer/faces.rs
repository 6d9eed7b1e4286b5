//! Surfaces as bodies that MuJoCo knows: a polygon is the rectangle round it, a disc a flat cylinder.

use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use occupant_core::forces::contact::flat_face::FlatFace;
use occupant_core::forces::contact::surface::{Frame, Outline};
use occupant_core::motion::frame::Frames;
use occupant_core::motion::frame::{SPACE, VEHICLE};
use occupant_core::motion::vector::V3;

use crate::mjcf::list;

/// Half of a box's or cylinder's thickness, behind the face, m.
const HALF_THICKNESS_M: f64 = 0.05;

/// The `<geom>` of a face whose frame stands as in `frames`.
pub fn geom(face: &FlatFace, friction: f64, frames: &Frames<f64>) -> String {
    let (u, v) = face.plane_axes();
    let normal = face.normal;
    let (shape, size, centre) = match &face.outline {
        Outline::Polygon(corners) => {
            let along = |axis: &Vector3<f64>| {
                let along = corners.iter().map(|c| axis.dot(&c.coords));
                let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), a| (l.min(a), h.max(a)));
                (0.5 * (low + high), 0.5 * (high - low))
            };
            let ((at_u, half_u), (at_v, half_v)) = (along(&u), along(&v));
            let centre = u * at_u + v * at_v + normal * (face.offset_m - HALF_THICKNESS_M);
            ("box", vec![half_u, half_v, HALF_THICKNESS_M], centre)
        }
        Outline::Disc { centre_m, radius_m, .. } => {
            let centre = centre_m.coords - normal * HALF_THICKNESS_M;
            ("cylinder", vec![*radius_m, HALF_THICKNESS_M], centre)
        }
        Outline::Unbounded { .. } => ("plane", vec![0.0, 0.0, 1.0], normal * face.offset_m),
    };
    let frame = &frames[match face.frame {
        Frame::Space => SPACE,
        // the cases have no others
        _ => VEHICLE,
    }];
    let place = frame.origin + frame.axes.out(V3::of(&centre));
    let axes = frame.axes.to_matrix() * Matrix3::from_columns(&[u, v, normal]);
    let turn = UnitQuaternion::from_matrix(&axes);
    format!(
        r#"<geom type="{shape}" size="{}" pos="{}" quat="{}" friction="{friction} 0 0" contype="0" conaffinity="1"/>"#,
        list(&size),
        list(&[place.x, place.y, place.z]),
        list(&[turn.w, turn.i, turn.j, turn.k]),
    )
}
