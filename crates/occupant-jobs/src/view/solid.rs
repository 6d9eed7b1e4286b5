//! The flags of a picture in three dimensions, and its camera.

use std::path::Path;
use std::str::FromStr;

use nalgebra::{Point3, Vector3};
use occupant_files::base::input_file;
use occupant_pictures::film::{Film, Frame};
use occupant_pictures::scene::{Camera, Carrier, Lens, Scene, Shown, abreast};
use placed_text::{Document, Problem, nearest};

use super::Kind;
use super::others::{Beside, Opened, Others, Run};
use crate::base::Failure;

/// Sizes of a picture alone and of a film for players, and of pictures on a sheet and of a GIF, pixels.
const LARGE: [usize; 2] = [1920, 1080];
const SMALL: [usize; 2] = [960, 540];
/// Field of view of a camera that gives none, degrees of the picture's height.
const USUAL_DEG: f64 = 40.0;

/// Flags of a picture in three dimensions.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
pub struct Solid {
    /// Draw in three dimensions: shaded bodies in the car, on the ground with a grid of metres. PNG, GIF and MP4 only
    #[cfg_attr(feature = "clap", arg(long = "3d", conflicts_with_all = ["views", "dimensions"]))]
    pub solid: bool,

    /// Where it is seen from: `vehicle` (rides with the car), `ground` (sees the whole path), `chase` (behind the
    /// occupant), `driver` (the eye of the first occupant), or a TOML file with `eye` and `target` (x, y, z in m),
    /// `field_of_view` (degrees of the picture's height, 40 if absent) and `frame` ("vehicle" or "space")
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "CAMERA|FILE.toml", default_value = "vehicle", requires = "solid")
    )]
    pub camera: String,

    /// Width and height in pixels; 1920x1080 if absent, 960x540 for each of several pictures and for a GIF
    #[cfg_attr(feature = "clap", arg(long, value_name = "WIDTHxHEIGHT", value_parser = size, requires = "solid"))]
    pub size: Option<PixelSize>,

    /// Other runs, and pictures of a test.
    #[cfg_attr(feature = "clap", command(flatten))]
    pub others: Others,
}

/// Width and height, pixels.
#[derive(Clone, Copy, Debug)]
pub struct PixelSize([usize; 2]);

/// Width and height as text, such as `1920x1080`.
///
/// # Errors
/// No two numbers, or one out of range.
pub fn size(text: &str) -> Result<PixelSize, String> {
    let side = |text: &str| usize::from_str(text.trim()).ok().filter(|side| (16..=8192).contains(side));
    let sides = text.split_once(['x', '×']).and_then(|(width, height)| Some(PixelSize([side(width)?, side(height)?])));
    sides.ok_or_else(|| "expected two numbers from 16 to 8192, such as 1920x1080".to_owned())
}

impl Solid {
    /// Whether the picture has three dimensions.
    pub const fn is_asked(&self) -> bool {
        self.solid
    }

    /// What makes the frames.
    pub(super) fn scene<'a>(
        &self,
        run: &'a Run,
        others: &'a Opened,
        pace: &str,
        kind: Kind,
    ) -> Result<impl Fn(usize) -> Result<Frame, String> + Sync + use<'a>, Failure> {
        let usual = match kind {
            Kind::Picture(_) if run.moments.len() > 1 => SMALL,
            Kind::Film(Film::Gif) => SMALL,
            _ => LARGE,
        };
        let [width, height] = self.size.map_or(usual, |size| size.0);
        let about = pace.trim_start_matches([',', ' ']);
        let shown = run.shown("", (!others.ghosts.is_empty()).then_some(run));
        let ghosts: Vec<Shown<'a>> = others.ghosts.iter().map(|own| own.shown("ghost: ", Some(run))).collect();
        let beside = match &others.beside {
            Some(Beside::Run(own)) => Some(own.shown("", None)),
            _ => None,
        };
        let left = if others.beside.is_some() { width / 2 } else { width };
        let all: Vec<&Shown<'_>> = std::iter::once(&shown).chain(&ghosts).chain(&beside).collect();
        let camera = self.camera()?.fitted(&all, left as f64 / height as f64).map_err(Failure::plain)?;
        let scene = |run: &Shown<'a>, ghosts: &[Shown<'a>], width: usize| {
            Scene::new(run, ghosts, camera, [width, height], about).map_err(Failure::plain)
        };
        let own = scene(&shown, &ghosts, left)?;
        let right = width - left;
        let beside_scene = beside.as_ref().map(|run| scene(run, &[], right)).transpose()?;
        Ok(move |frame: usize| {
            let first = own.frame(frame)?;
            let second = match (&others.beside, &beside_scene) {
                (Some(Beside::Test(test)), _) => test.frame(run.clock_s[frame], [right, height])?,
                (_, Some(scene)) => scene.frame(frame)?,
                _ => return Ok(first),
            };
            abreast(first, second)
        })
    }

    fn camera(&self) -> Result<Camera, Failure> {
        let names = ["ground", "vehicle", "chase", "driver"];
        match self.camera.as_str() {
            "ground" => Ok(Camera::Ground),
            "vehicle" => Ok(Camera::Vehicle),
            "chase" => Ok(Camera::Chase),
            "driver" => Ok(Camera::Driver),
            file if Path::new(file).extension().is_some_and(|ending| ending == "toml") => read(Path::new(file)),
            other => {
                let near =
                    nearest(other, names.into_iter()).map_or(String::new(), |name| format!("; is `{name}` meant?"));
                let found = format!("`{other}` is no camera{near}");
                Err(Failure::with_help(found, "give ground, vehicle, chase, driver, or a file NAME.toml"))
            }
        }
    }
}

/// A camera from a file.
fn read(path: &Path) -> Result<Camera, Failure> {
    let document = Document::read_named(&input_file::read(path)?, &path.display().to_string());
    let document = document.map_err(|problems| Failure::CouldNotRun(problems.to_string()))?;
    parsed(&document).map_err(|problem| Failure::CouldNotRun(document.place(problem).to_string()))
}

fn parsed(document: &Document) -> Result<Camera, Problem> {
    let keys = ["eye", "target", "field_of_view", "frame"];
    let entries = document.root.as_table().into_iter().flat_map(|table| table.keys());
    if let Some(wrong) = entries.map(String::as_str).find(|key| !keys.contains(key)) {
        return Err(Problem::error(
            wrong,
            format!("`{wrong}` is no key of a camera"),
            "eye, target, field_of_view or frame",
        ));
    }
    let carrier = match document.root.get("frame").map(|node| node.as_str()) {
        None | Some(Some("vehicle")) => Carrier::Vehicle,
        Some(Some("space")) => Carrier::Space,
        Some(_) => return Err(Problem::error("frame", "no frame of a camera", "\"vehicle\" or \"space\"")),
    };
    let angle = match document.root.get("field_of_view") {
        None => USUAL_DEG,
        Some(node) => node.value.number().filter(|angle| (1.0..=170.0).contains(angle)).ok_or_else(|| {
            Problem::error("field_of_view", "no angle of a camera", "degrees of the picture's height, from 1 to 170")
        })?,
    };
    let (eye_m, target_m) = (point(document, "eye")?, point(document, "target")?);
    if (eye_m - target_m).norm() < 1e-6 {
        return Err(Problem::error("target", "the camera looks at its own eye", "a target apart from the eye"));
    }
    let up = if carrier == Carrier::Vehicle { -Vector3::z() } else { Vector3::z() };
    Ok(Camera::Own(Lens { eye_m, target_m, up, height_rad: angle.to_radians() }, carrier))
}

fn point(document: &Document, key: &str) -> Result<Point3<f64>, Problem> {
    let numbers: Option<Vec<f64>> =
        document.root.get(key).and_then(|node| node.items().iter().map(|node| node.value.number()).collect());
    match numbers.as_deref() {
        Some([x, y, z]) if (x + y + z).is_finite() => Ok(Point3::new(*x, *y, *z)),
        _ => Err(Problem::error(key, format!("`{key}` is no place"), "three numbers in m, such as [2.5, 1.5, -0.8]")),
    }
}
