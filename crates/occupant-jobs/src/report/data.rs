//! Data of the page. The names of the fields are those that `assets/viewer/src` reads.

use nalgebra::Point3;
use occupant_core::forces::contact::solid::Solid;
use occupant_core::forces::contact::surface::{Frame, Outline};
use occupant_core::results::summary::Caveat;
use occupant_core::vehicle::VehiclePath;
use serde::Serialize;

use super::array::Array;
use super::curves::Plot;
use super::measures::Measure;
use super::motion::Motion;
use super::ride_down::RideDown;
use super::{curves, measures, provenance};
use crate::base::{Failure, Units, file_name};
use occupant_files::mcap::scene::compartment::{corners_m, square_m};
use occupant_files::results::Results;
use occupant_pictures::body::{Lump, PATCH_M, Part, Tone, parts, sphere_centre_m};

/// All that the page shows.
#[derive(Debug, Serialize)]
pub struct Report {
    /// The program that made it, with its version.
    pub program: String,
    /// The run, and the one it is compared with.
    pub runs: Vec<Run>,
}

impl Report {
    /// What the page is of, by the names of its files.
    pub fn subject(&self) -> String {
        let labels: Vec<&str> = self.runs.iter().map(|run| run.label.as_str()).collect();
        subject(&labels)
    }

    /// The title of the page.
    pub fn title(&self) -> String {
        let titles = self.runs.iter().map(|run| match run.title.as_str() {
            "" => run.label.as_str(),
            title => title,
        });
        titles.collect::<Vec<_>>().join(" – ")
    }
}

/// What a page of runs of these names is of.
pub fn subject(labels: &[&str]) -> String {
    format!("Report of {}", labels.join(" against "))
}

/// A run of the page.
#[derive(Debug, Serialize)]
pub struct Run {
    label: String,
    title: String,
    /// The run in a line.
    facts: String,
    /// What a reader should know before trusting the results.
    notes: Vec<String>,
    /// What was seen that spoils figures; rows of measures count them from 0.
    caveats: Vec<String>,
    times: Array,
    segments: Vec<String>,
    parts: Vec<PartData>,
    spheres: Vec<SphereData>,
    surfaces: Vec<SurfaceData>,
    #[serde(flatten)]
    motion: Motion,
    plots: Vec<Plot>,
    measures: Vec<Measure>,
    /// Units of forces and closing speeds: kN and m/s in one that is shown, and its symbol.
    force_unit: (f64, String),
    speed_unit: (f64, String),
    first_contacts: Vec<occupant_core::results::summary::ContactBegin>,
    provenance: Vec<[String; 2]>,
    scenario: String,
}

/// The convex hull of two ellipsoids, each centre x, y, z and half axes x, y, z, segment axes, m.
#[derive(Debug, Serialize)]
struct PartData {
    segment: usize,
    tone: &'static str,
    ends: [[f64; 6]; 2],
}

/// A contact sphere; centre from the segment's centre of gravity, segment axes, m.
#[derive(Debug, Serialize)]
struct SphereData {
    name: String,
    segment: usize,
    centre: [f64; 3],
    radius: f64,
}

/// A surface or a side of a solid; corners in axes of the vehicle or, for `space`, in vehicle-space. One without bounds has them about its foot
/// below the origin. Contacts count surfaces, then solids by their first side; other sides come last and have no name.
#[derive(Debug, Serialize)]
struct SurfaceData {
    name: String,
    frame: &'static str,
    bounded: bool,
    material: usize,
    corners: Vec<[f64; 3]>,
    normal: [f64; 3],
}

impl Run {
    /// What the page calls a run.
    pub(super) fn label_of(results: &Results) -> String {
        file_name(&results.path)
    }

    /// Gathers a run.
    ///
    /// # Errors
    /// None for a file that was opened.
    pub fn of(results: &Results, units: Units) -> Result<Self, Failure> {
        let model = &results.model;
        let (mut motion, mut series, mut times) = (Motion::default(), curves::series(model), Array::default());
        let mut ride = RideDown::default();
        results.replay((&mut ride, (&mut motion, &mut series)))?;
        times.float64(&series.time_s);
        let summary = results.summary()?;
        let prefixes: Vec<String> = summary.people().into_iter().map(|(prefix, _)| prefix).collect();
        let mut notes = results.notes();
        notes.extend(model.warnings().iter().map(|w| w.to_string()));
        let (told, caveats): (Vec<&Caveat>, Vec<&Caveat>) = summary.caveats.iter().partition(|caveat| caveat.is_note());
        notes.extend(told.iter().map(|note| note.text.clone()));
        Ok(Run {
            label: Run::label_of(results),
            title: model.setup().title.clone(),
            facts: provenance::facts(results, &summary, units),
            notes,
            caveats: caveats.iter().map(|caveat| caveat.text.clone()).collect(),
            times,
            segments: model.body().tree.segment_rows().iter().map(|row| row.name.replace('_', " ")).collect(),
            parts: parts(model.body()).iter().map(PartData::of).collect(),
            spheres: spheres(results),
            surfaces: surfaces(results).into_iter().chain(sides(results)).chain(scenery(results)).collect(),
            motion,
            plots: curves::plots(&series, &prefixes, units),
            measures: measures::measures(&summary, &ride, units),
            force_unit: units.over("kN"),
            speed_unit: units.over("m/s"),
            first_contacts: summary.contacts.clone(),
            provenance: provenance::lines(results, &summary),
            scenario: results.scenario_text.clone().unwrap_or_default(),
        })
    }
}

impl PartData {
    fn of(part: &Part) -> Self {
        let end = |Lump { centre_m: c, half_m: h, .. }: &Lump| [c.x, c.y, c.z, h.x, h.y, h.z];
        PartData {
            segment: part.segment.index(),
            tone: match part.tone {
                Tone::Skin => "skin",
                Tone::Shirt => "shirt",
                Tone::Trousers => "trousers",
            },
            ends: part.ends.each_ref().map(end),
        }
    }
}

fn spheres(results: &Results) -> Vec<SphereData> {
    let body = results.model.body();
    let data = |s: &occupant_core::body::ContactSphere| SphereData {
        name: s.name.clone(),
        segment: s.segment.index(),
        centre: sphere_centre_m(body, s).into(),
        radius: s.radius_m,
    };
    body.spheres.iter().map(data).collect()
}

fn surfaces(results: &Results) -> Vec<SurfaceData> {
    let model = &results.model;
    let all = model.setup().surfaces.iter().zip(model.faces());
    all.map(|(surface, face)| {
        if !is_shown(results, face.frame) {
            return SurfaceData::hidden(&surface.name, surface.material);
        }
        let bounded = !matches!(face.outline, Outline::Unbounded { .. });
        let (frame, turned) = shown_in(face.frame);
        let follows = !bounded && face.frame != Frame::Vehicle;
        let foot = face.normal * face.offset_m;
        // a patch that follows the vehicle moves along the plane from its foot below the origin
        let corners = if follows { square_m(face, foot.into(), PATCH_M) } else { corners_m(face) };
        SurfaceData {
            name: surface.name.clone(),
            frame,
            bounded,
            material: surface.material,
            corners: corners.into_iter().map(|p| turned(p.into())).collect(),
            normal: turned(face.normal.into()),
        }
    })
    .collect()
}

/// Road, tyre marks, barriers and the outside of the vehicle, which nothing touches.
fn scenery(results: &Results) -> Vec<SurfaceData> {
    let drawn = results.model.setup().scenery.iter().filter(|own| is_shown(results, own.frame));
    let plates =
        drawn.flat_map(|own| own.polygons_m.iter().filter(|corners| corners.len() > 2).map(|p| (own.frame, p)));
    plates.map(|(frame, corners)| SurfaceData::plate(frame, SCENERY, "", corners)).collect()
}

/// The first sides of all solids, then the others.
fn sides(results: &Results) -> Vec<SurfaceData> {
    let (mut first, mut others) = (Vec::new(), Vec::new());
    for solid in &results.model.setup().solids {
        if !is_shown(results, solid.frame) {
            first.push(SurfaceData::hidden(&solid.name, solid.material));
            continue;
        }
        let mut sides = solid.outline().into_iter();
        first.extend(sides.next().map(|side| SurfaceData::side(solid, &solid.name, &side)));
        others.extend(sides.map(|side| SurfaceData::side(solid, "", &side)));
    }
    first.append(&mut others);
    first
}

impl SurfaceData {
    /// A name that contacts speak of, of what moves within a vehicle or is a loose body's: nothing to see, like a patch of no size.
    fn hidden(name: &str, material: usize) -> Self {
        let none = [0.0; 3];
        SurfaceData {
            name: name.to_owned(),
            frame: "space",
            bounded: false,
            material,
            corners: vec![none; 3],
            normal: none,
        }
    }

    fn side(solid: &Solid, name: &str, corners: &[Point3<f64>]) -> Self {
        SurfaceData::plate(solid.frame, solid.material, name, corners)
    }

    fn plate(frame: Frame, material: usize, name: &str, corners: &[Point3<f64>]) -> Self {
        let (frame, turned) = shown_in(frame);
        let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).normalize();
        SurfaceData {
            name: name.to_owned(),
            frame,
            bounded: true,
            material,
            corners: corners.iter().map(|p| turned((*p).into())).collect(),
            normal: turned(normal.into()),
        }
    }
}

/// What is drawn and touches nothing has the colour of this material: grey.
const SCENERY: usize = 5;

/// Whether the page can show what is fixed to a frame: it knows the vehicle, space, and the ground.
fn is_shown(results: &Results, frame: Frame) -> bool {
    match frame {
        Frame::Vehicle | Frame::Space => true,
        Frame::Other(i) => {
            let frame = &results.model.setup().frames[i];
            frame.parent.is_none() && matches!(frame.path, VehiclePath::Fixed(_))
        }
        Frame::Segment(_) => false,
    }
}

/// The page's name of a frame, and what turns its vectors: space is Y left, Z up; vehicle-space Y right, Z down.
fn shown_in(frame: Frame) -> (&'static str, impl Fn([f64; 3]) -> [f64; 3]) {
    let (name, turn) = match frame {
        Frame::Space => ("space", [1.0, -1.0, -1.0]),
        Frame::Other(_) => ("space", [1.0, 1.0, 1.0]),
        _ => ("vehicle", [1.0, 1.0, 1.0]),
    };
    (name, move |v| [0, 1, 2].map(|i| turn[i] * v[i]))
}
