//! Pictures in three dimensions: shaded bodies with thickness in the car, on the ground with its grid, with soft shadows.
//!
//! A software renderer of our own paints them (`canvas`): it needs no graphics card, and gives the same bits everywhere.

mod beside;
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

use std::borrow::Cow;

use nalgebra::{Point3, Vector3};
use occupant_core::model::Model;
use resvg::tiny_skia::{IntSize, Pixmap};

use crate::body::{Snapshot, sphere_centre_m};
use crate::film::Frame;
use crate::format;
pub use beside::{Photograph, abreast, photograph};
use camera::middle;
pub use camera::{Camera, Carrier, Fitted};
use canvas::{Colour, Piece};
pub use lens::Lens;
use lens::{Frustum, V3};
use light::{Lamp, Shadows};
use overlay::clock;
use stage::{Cast, Edge, SHIRTS, Stage, TINTS, frame_pose, in_space};

/// Largest side of a picture, pixels.
pub const MOST_PIXELS: usize = 8192;
/// Largest number of other runs in a picture.
pub const MOST_GHOSTS: usize = canvas::MOST_GHOSTS;
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
#[derive(Clone, Debug)]
pub struct Shown<'a> {
    /// Its model.
    pub model: &'a Model,
    /// What it shows on each picture.
    pub moments: &'a [Snapshot],
    /// The time that each picture tells, s: that of another run if it sets the clock. Its own if empty.
    pub clock_s: &'a [f64],
    /// Where it comes from; the first line names it.
    pub caption: Vec<String>,
}

/// Another run within the pictures of a run, translucent.
struct Ghost<'a> {
    cast: Cast<'a>,
    moments: Cow<'a, [Snapshot]>,
    caption: Vec<String>,
}

/// Pictures of a run, with others as ghosts.
pub struct Scene<'a> {
    cast: Cast<'a>,
    moments: &'a [Snapshot],
    clock_s: &'a [f64],
    ghosts: Vec<Ghost<'a>>,
    camera: Fitted,
    size: [usize; 2],
    about: String,
    caption: Vec<String>,
}

impl<'a> Scene<'a> {
    /// Pictures of `size` pixels, width and height, from a camera; `about` says how they are shown. Ghosts have as many
    /// moments as the run. A camera that rides with the vehicle shows them in axes of their own vehicles, put where that of
    /// the run is; any other where they are in space.
    ///
    /// # Errors
    /// A side without pixels, or with more than [`MOST_PIXELS`]; more than [`MOST_GHOSTS`] ghosts.
    pub fn new(
        run: &Shown<'a>,
        ghosts: &[Shown<'a>],
        camera: Fitted,
        size: [usize; 2],
        about: &str,
    ) -> Result<Self, String> {
        if size.iter().any(|side| !(1..=MOST_PIXELS).contains(side)) {
            let [width, height] = size;
            return Err(format!("a picture of {width} × {height} pixels; each side can have 1 to {MOST_PIXELS}"));
        }
        if ghosts.len() > MOST_GHOSTS {
            return Err(format!(
                "{} runs in the picture of another; at most {MOST_GHOSTS} can be told apart",
                ghosts.len()
            ));
        }
        let mut cast = Cast::of(run.model, run.moments.first());
        let some = run.moments.iter().step_by(run.moments.len().div_ceil(SIGHTS).max(1));
        cast.look_from(&some.map(|moment| (camera.lens(run.model, moment).eye_m, moment)).collect::<Vec<_>>());
        let grid = if cast.has_ground() { "grid 1 m" } else { "grid 1 m, drawn below the car: the run has no ground" };
        let ghosts: Vec<_> = ghosts.iter().map(|own| Ghost::of(own, run.moments, &camera)).collect();
        let placed = match (ghosts.is_empty(), camera.camera.rides()) {
            (true, _) => "",
            (false, true) => "ghosts in axes of their own vehicles",
            (false, false) => "ghosts where they are in space",
        };
        let about = [camera.camera.name(), placed, grid, about];
        let about = about.into_iter().filter(|t| !t.is_empty()).collect::<Vec<_>>().join(" · ");
        let (moments, clock_s, caption) = (run.moments, run.clock_s, run.caption.clone());
        Ok(Scene { cast, moments, clock_s, ghosts, camera, size, about, caption })
    }

    /// The picture of a moment.
    ///
    /// # Errors
    /// A moment that does not exist; words that cannot be drawn.
    pub fn frame(&self, moment: usize) -> Result<Frame, String> {
        let count = self.moments.len();
        let at = moment;
        let moment = self.moments.get(at).ok_or_else(|| format!("no moment {at}: there are {count}"))?;
        let lens = self.camera.lens(self.cast.model, moment);
        let origin = in_space(moment, &middle(moment)).coords;
        let origin = if origin.sum().is_finite() { origin } else { Vector3::zeros() };
        let frustum = lens.before(&origin, self.size);
        let mut pixmap = pixmap(self.size, &self.bare(at, &lens, &frustum, &origin))?;
        format::overlay(&self.words(at, &lens, &frustum, &origin), &mut pixmap)?;
        Ok(Frame::Pixels(pixmap))
    }

    fn bare(&self, at: usize, lens: &Lens, frustum: &Frustum, origin: &Vector3<f64>) -> Vec<[u8; 3]> {
        let moment = &self.moments[at];
        let mut stage = self.cast.stage(moment, origin, &lens.eye_m, self.camera.hidden(self.cast.model));
        let ghosts = self.apparitions(at, origin, &mut stage);
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
        canvas::paint(frustum, &stage.pieces, &ghosts, &stage.veils, &lamp)
    }

    /// The things of each ghost; what is seen through already joins that of the run.
    fn apparitions(&self, at: usize, origin: &Vector3<f64>, stage: &mut Stage) -> Vec<Vec<Piece>> {
        if self.ghosts.is_empty() {
            return Vec::new();
        }
        let moment = &self.moments[at];
        let mut known = self.cast.edges(moment);
        known.extend(moment.sections.iter().map(|section| Edge::of_section(moment, section)));
        let of = |(ghost, tint): (&Ghost<'_>, Colour)| {
            let Some(moment) = ghost.moments.get(at) else { return Vec::new() };
            let own = ghost.cast.apparition(moment, origin, self.camera.hidden(ghost.cast.model), tint, &known);
            stage.veils.extend(own.veils);
            own.pieces
        };
        self.ghosts.iter().zip(TINTS).map(of).collect()
    }

    fn words(&self, at: usize, lens: &Lens, frustum: &Frustum, origin: &Vector3<f64>) -> String {
        let moment = &self.moments[at];
        let target: V3 = (lens.target_m.coords - origin).cast();
        let away = frustum.seen(&target).z;
        let per_m = (away > lens::NEAR_M).then(|| f64::from(frustum.focal / away));
        let speed = moment.vehicle.velocity_m_s.norm() * 3.6;
        let speeds = if speed.is_finite() { vec![format!("vehicle {speed:.1} km/h")] } else { Vec::new() };
        overlay::draw(&overlay::Words {
            size: self.size,
            title: &self.cast.model.setup().title,
            about: &self.about,
            time_s: self.time_s(at),
            speeds: &speeds,
            names: &self.names(moment, frustum, origin),
            per_m,
            caption: &self.captions(at),
        })
        .svg
    }

    /// Where everything comes from, each run with its colour if there are several; of a ghost also whether it has ended.
    fn captions(&self, at: usize) -> Vec<(Option<Colour>, String)> {
        let coloured = |lines: &[String], colour: Option<Colour>| -> Vec<(Option<Colour>, String)> {
            lines.iter().enumerate().map(|(i, line)| (colour.filter(|_| i == 0), line.clone())).collect()
        };
        let of = |caption: &[String], colour, moments: &[Snapshot], model| {
            let mut own = coloured(caption, colour);
            let beyond = moments.get(at).and_then(|own| beyond(self.time_s(at), own, model));
            own.iter_mut().take(1).for_each(|(_, line)| *line += beyond.as_deref().unwrap_or_default());
            own
        };
        let first = (!self.ghosts.is_empty()).then_some(SHIRTS[0]);
        let mut all = of(&self.caption, first, self.moments, self.cast.model);
        for (ghost, tint) in self.ghosts.iter().zip(TINTS) {
            all.extend(of(&ghost.caption, Some(tint), &ghost.moments, ghost.cast.model));
        }
        all
    }

    /// The time that a picture tells, s.
    fn time_s(&self, at: usize) -> f64 {
        self.clock_s.get(at).copied().unwrap_or(self.moments[at].time_s)
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

impl<'a> Ghost<'a> {
    fn of(run: &Shown<'a>, pictured: &[Snapshot], camera: &Fitted) -> Self {
        let carried = || run.moments.iter().zip(pictured).map(|(own, at)| own.carried_by(&at.vehicle)).collect();
        let moments = if camera.camera.rides() { Cow::Owned(carried()) } else { Cow::Borrowed(run.moments) };
        Ghost { cast: Cast::of(run.model, None), moments, caption: run.caption.clone() }
    }
}

/// Says that a run has no output near the time of a picture.
fn beyond(clock_s: f64, own: &Snapshot, model: &Model) -> Option<String> {
    let (time_s, near_s) = (own.time_s, model.setup().time.output_s);
    if clock_s > time_s + near_s {
        return Some(format!(", ended at {} and stays as it was then", clock(time_s)));
    }
    (clock_s < time_s - near_s).then(|| format!(", begins at {}", clock(time_s)))
}

/// Middle and radius of what throws shadows.
fn ball<'p>(pieces: impl Iterator<Item = &'p Piece>) -> (V3, f32) {
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
