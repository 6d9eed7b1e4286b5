//! Pictures in three dimensions: shaded bodies with thickness in the car, on the ground with its grid, with soft shadows.
//!
//! A software renderer of our own paints them (`canvas`): it needs no graphics card, and gives the same bits everywhere.

mod camera;
mod canvas;
mod lens;
mod light;
mod overlay;
mod shapes;
mod sight;
mod stage;
#[cfg(test)]
mod tests;

use nalgebra::{Point3, Vector3};
use occupant_core::model::Model;
use resvg::tiny_skia::{IntSize, Pixmap};

use crate::body::{Snapshot, sphere_centre_m};
use crate::film::Frame;
use crate::format;
pub use camera::{Camera, Carrier};
use camera::{Fitted, middle};
pub use lens::Lens;
use lens::{Frustum, V3};
use light::{Lamp, Shadows};
use stage::{Cast, frame_pose, in_space};

/// Largest side of a picture, pixels.
pub const MOST_PIXELS: usize = 8192;
/// Largest number of pixels of a sheet.
const MOST_IN_ALL: usize = 200_000_000;
/// Radius within which things throw shadows, at least, and share of the lamp that a seen-through car takes.
const SHADED_M: f32 = 1.2;
const FAINT: f32 = 0.40;
/// Moments at which what hides people is looked for.
const SIGHTS: usize = 8;
/// Height of a name above a head, m.
const NAME_M: f64 = 0.2;

/// A run to be pictured.
pub struct Scene<'a> {
    cast: Cast<'a>,
    moments: &'a [Snapshot],
    camera: Fitted,
    size: [usize; 2],
    about: String,
    caption: Vec<String>,
}

impl<'a> Scene<'a> {
    /// Pictures of `size` pixels, width and height, from a camera; `about` says how they are shown, and the caption where
    /// they come from.
    ///
    /// # Errors
    /// A side without pixels, or with more than [`MOST_PIXELS`]; a user's camera that looks nowhere.
    pub fn new(
        model: &'a Model,
        moments: &'a [Snapshot],
        camera: Camera,
        size: [usize; 2],
        about: &str,
        caption: Vec<String>,
    ) -> Result<Self, String> {
        if size.iter().any(|side| !(1..=MOST_PIXELS).contains(side)) {
            let [width, height] = size;
            return Err(format!("a picture of {width} × {height} pixels; each side can have 1 to {MOST_PIXELS}"));
        }
        if let Camera::Own(lens, _) = camera
            && !lens.looks()
        {
            return Err(
                "the camera looks nowhere: eye and target must be finite and apart, and the field of view 1 to \
                        170 degrees"
                    .to_owned(),
            );
        }
        let mut cast = Cast::of(model, moments.first());
        let camera_name = camera.name();
        let camera = camera.fitted(model, moments);
        let some = moments.iter().step_by(moments.len().div_ceil(SIGHTS).max(1));
        cast.look_from(&some.map(|moment| (camera.lens(model, moment).eye_m, moment)).collect::<Vec<_>>());
        let grid = if cast.has_ground() { "grid 1 m" } else { "grid 1 m, drawn below the car: the run has no ground" };
        let about =
            [camera_name, grid, about].iter().filter(|t| !t.is_empty()).copied().collect::<Vec<_>>().join(" · ");
        Ok(Scene { cast, moments, camera, size, about, caption })
    }

    /// The picture of a moment.
    ///
    /// # Errors
    /// A moment that does not exist; words that cannot be drawn.
    pub fn frame(&self, moment: usize) -> Result<Frame, String> {
        let count = self.moments.len();
        let moment = self.moments.get(moment).ok_or_else(|| format!("no moment {moment}: there are {count}"))?;
        let lens = self.camera.lens(self.cast.model, moment);
        let origin = in_space(moment, &middle(moment)).coords;
        let origin = if origin.sum().is_finite() { origin } else { Vector3::zeros() };
        let frustum = lens.before(&origin, self.size);
        let mut pixmap = pixmap(self.size, &self.bare(moment, &lens, &frustum, &origin))?;
        format::overlay(&self.words(moment, &lens, &frustum, &origin), &mut pixmap)?;
        Ok(Frame::Pixels(pixmap))
    }

    fn bare(&self, moment: &Snapshot, lens: &Lens, frustum: &Frustum, origin: &Vector3<f64>) -> Vec<[u8; 3]> {
        let stage = self.cast.stage(moment, origin, &lens.eye_m, self.camera.hidden());
        let towards = V3::new(0.28, -0.34, 0.90).normalize();
        let thrown = || stage.shades.iter().map(|i| &stage.pieces[*i]);
        let solid = ball(thrown());
        let faint = ball(stage.faint.iter());
        let shadows = [
            (Shadows::of(&towards, solid.0, solid.1, thrown()), 1.0),
            (Shadows::of(&towards, faint.0, faint.1, stage.faint.iter()), FAINT),
        ];
        let grid = [0, 1].map(|i| (origin[i].rem_euclid(10.0)) as f32);
        let lamp =
            Lamp { towards, eye: frustum.eye, away_m: (lens.target_m - lens.eye_m).norm() as f32, grid, shadows };
        canvas::paint(frustum, &stage.pieces, &stage.veils, &lamp)
    }

    fn words(&self, moment: &Snapshot, lens: &Lens, frustum: &Frustum, origin: &Vector3<f64>) -> String {
        let target: V3 = (lens.target_m.coords - origin).cast();
        let away = frustum.seen(&target).z;
        let per_m = (away > lens::NEAR_M).then(|| f64::from(frustum.focal / away));
        let speed = moment.vehicle.velocity_m_s.norm() * 3.6;
        let speeds = if speed.is_finite() { vec![format!("vehicle {speed:.1} km/h")] } else { Vec::new() };
        overlay::draw(&overlay::Words {
            size: self.size,
            title: &self.cast.model.setup().title,
            about: &self.about,
            time_s: moment.time_s,
            speeds: &speeds,
            names: &self.names(moment, frustum, origin),
            per_m,
            caption: &self.caption,
        })
    }

    /// Names of several people, above their heads.
    fn names(&self, moment: &Snapshot, frustum: &Frustum, origin: &Vector3<f64>) -> Vec<(String, [f64; 2])> {
        let (setup, body) = (self.cast.model.setup(), self.cast.model.body());
        let mut names = Vec::new();
        for (member, name) in setup.members.iter().map(|member| &member.name).enumerate() {
            let first = body.tree.segments().find(|s| body.tree.body_of(*s) == member);
            let Some(first) = first else { continue };
            let top = body.tree.landmarks_at(first).head.unwrap_or(first);
            let skull = body.spheres.iter().find(|sphere| sphere.segment == top);
            let middle = skull.map_or_else(Vector3::zeros, |sphere| sphere_centre_m(body, sphere));
            let at = frame_pose(moment) * moment.poses[top.index()] * Point3::from(middle) + Vector3::z() * NAME_M;
            let seen = frustum.seen(&(at.coords - origin).cast());
            if seen.z > lens::NEAR_M {
                let name = if name.is_empty() { "occupant".to_owned() } else { name.replace('_', " ") };
                names.push((name, frustum.pixel(&seen).map(f64::from)));
            }
        }
        names
    }
}

/// Middle and radius of what throws shadows.
fn ball<'p>(pieces: impl Iterator<Item = &'p canvas::Piece>) -> (V3, f32) {
    let mut ends = [V3::repeat(f32::MAX), V3::repeat(f32::MIN)];
    for corner in pieces.flat_map(|piece| &piece.corners).filter(|corner| corner.place.sum().is_finite()) {
        ends = [ends[0].inf(&corner.place), ends[1].sup(&corner.place)];
    }
    let size = ends[1] - ends[0];
    if size.x < 0.0 { (V3::zeros(), SHADED_M) } else { ((ends[0] + ends[1]) * 0.5, (0.5 * size.norm()).max(SHADED_M)) }
}

fn pixmap([width, height]: [usize; 2], pixels: &[[u8; 3]]) -> Result<Pixmap, String> {
    let bytes = pixels.iter().flat_map(|[r, g, b]| [*r, *g, *b, 255]).collect();
    let size = IntSize::from_wh(width as u32, height as u32);
    let pixmap = size.and_then(|size| Pixmap::from_vec(bytes, size));
    pixmap.ok_or_else(|| format!("a picture of {width} × {height} pixels cannot be made"))
}

/// Columns of a sheet.
const COLUMNS: usize = 3;

/// Several pictures of one size as the PNG of a sheet, row by row.
///
/// # Errors
/// No picture; a sheet that is too large.
pub fn sheet(frames: Vec<Frame>) -> Result<Vec<u8>, String> {
    let pictures: Result<Vec<Pixmap>, String> = frames.into_iter().map(|frame| frame.rendered(1.0)).collect();
    let pictures = pictures?;
    let first = pictures.first().ok_or("there are no times to draw")?;
    let columns = COLUMNS.min(pictures.len());
    let rows = pictures.len().div_ceil(columns);
    let (width, height) = (first.width() as usize, first.height() as usize);
    if width * columns * height * rows > MOST_IN_ALL {
        return Err(format!("the sheet would have {} × {} pixels", width * columns, height * rows));
    }
    let mut bytes = vec![255; 4 * width * columns * height * rows];
    for (i, picture) in pictures.iter().enumerate() {
        let (left, top) = (i % columns * width, i / columns * height);
        for (y, row) in picture.data().chunks(4 * width).take(height).enumerate() {
            let at = 4 * ((top + y) * width * columns + left);
            bytes[at..at + 4 * width.min(row.len() / 4)].copy_from_slice(&row[..4 * width.min(row.len() / 4)]);
        }
    }
    let size = IntSize::from_wh((width * columns) as u32, (height * rows) as u32);
    let sheet = size.and_then(|size| Pixmap::from_vec(bytes, size)).ok_or("the sheet cannot be made")?;
    Frame::Pixels(sheet).png(1.0)
}
