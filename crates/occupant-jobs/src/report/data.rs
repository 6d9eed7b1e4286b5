//! Data of the page. The names of the fields are those that `assets/viewer/src` reads.

use crash_measures::injury::Options;
use nalgebra::Point3;
use occupant_core::forces::contact::solid::Solid;
use occupant_core::forces::contact::surface::{Frame, Outline};
use occupant_core::model::Model;
use occupant_core::model::setup::Scenery;
use occupant_core::results::channel::{Channel, Series};
use occupant_core::results::outcome::Outcome;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::{Caveat, Person, Summary};
use occupant_core::vehicle::VehiclePath;
use serde::Serialize;

use super::array::Array;
use super::curves::Plot;
use super::ground::{Ground, GroundData};
use super::measures::Measure;
use super::motion::Motion;
use super::ride_down::RideDown;
use super::{curves, measures, provenance};
use crate::base::{Failure, Units, file_name};
use crate::files::history::choose;
use crate::judged::Impact;
use occupant_files::mcap::scene::compartment::{corners_m, square_m};
use occupant_files::results::Results;
use occupant_pictures::body::{Lump, PATCH_M, Part, Tone, parts, sphere_centre_m};

/// Data of the page.
#[derive(Debug, Serialize)]
pub struct Report {
    /// The program that made it, with its version.
    pub program: String,
    /// The run, and the one it is compared with.
    pub runs: Vec<Run>,
}

impl Report {
    /// Subject of the page, by the names of its files.
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

/// Subject of a page of runs with these names.
pub fn subject(labels: &[&str]) -> String {
    format!("Report of {}", labels.join(" against "))
}

/// A run of the page.
#[derive(Debug, Serialize)]
pub struct Run {
    label: String,
    title: String,
    /// Direction of the impact, and why; of several occupants in one car once.
    impacts: Vec<String>,
    /// Summary line of the run.
    facts: String,
    /// Notes to read before using the results.
    notes: Vec<String>,
    /// Caveats; rows of measures refer to them by index from 0.
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
    /// Display unit of forces and closing speeds: its size in kN and m/s, and its symbol.
    force_unit: (f64, String),
    speed_unit: (f64, String),
    /// Display unit of lengths on the ground, in m.
    length_unit: (f64, String),
    first_contacts: Vec<occupant_core::results::summary::ContactBegin>,
    ground: GroundData,
    /// Names of several occupants, each with the direction of its impact.
    occupants: Vec<Occupant>,
    provenance: Vec<[String; 2]>,
    scenario: String,
}

/// An occupant of the run; the name of a single one is empty.
#[derive(Debug, Serialize)]
pub(super) struct Occupant {
    pub(super) name: String,
    /// The dummy of its limits.
    pub(super) dummy: &'static str,
    /// Whether it gets verdicts; else limits are yardsticks.
    pub(super) judged: bool,
    /// The segment of its head, with whose eye the page looks; none of a body without one.
    pub(super) head: Option<usize>,
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

/// A surface or a face of a solid; corners in axes of the vehicle or, for `space`, in vehicle-space. An unbounded one
/// has corners around the foot of the perpendicular from the origin. Contacts count surfaces, then solids by their
/// first face; other faces come last and have no name.
#[derive(Debug, Serialize)]
struct SurfaceData {
    name: String,
    frame: &'static str,
    bounded: bool,
    material: usize,
    corners: Vec<[f64; 3]>,
    normal: [f64; 3],
    /// Whether it is of a vehicle's exterior.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    outside: bool,
}

/// Records what a page shows of a run, output by output.
#[derive(Debug)]
pub struct PageRecorder {
    motion: Motion,
    series: Series,
    chosen: Vec<Channel>,
    ride: RideDown,
    impact: Impact,
    ground: Ground,
}

/// What a page tells of a run beside its outputs.
#[derive(Clone, Debug, Default)]
pub struct Source {
    /// Name of the run on the page.
    pub label: String,
    /// Notes to read before using the results.
    pub notes: Vec<String>,
    /// Origin of the run: keys and values.
    pub origin: Vec<[String; 2]>,
    /// The scenario as its author wrote it.
    pub scenario: String,
    /// Occupants with verdicts, empty for a single one: dummies. For others limits are yardsticks.
    pub judged: Vec<String>,
}

impl PageRecorder {
    /// A recorder of a run of the model. The page begins with plots of the channels that these names and patterns choose.
    ///
    /// # Errors
    /// A name or pattern that fits no channel.
    pub fn new(model: &Model, channels: &[String]) -> Result<Self, Failure> {
        let chosen = if channels.is_empty() { Vec::new() } else { choose(model, channels)? };
        let series = curves::series(model, &chosen);
        Ok(PageRecorder {
            motion: Motion::default(),
            series,
            chosen,
            ride: RideDown::default(),
            impact: Impact::default(),
            ground: Ground::default(),
        })
    }

    /// The run on the page.
    pub fn run(self, model: &Model, summary: &Summary, told: Source, units: Units) -> Run {
        let PageRecorder { mut motion, series, chosen, ride, mut impact, ground } = self;
        motion.finish();
        let mut summary = summary.clone();
        impact.judge(&mut summary, model);
        let summary = &summary;
        let occupants: Vec<Occupant> =
            summary.people().into_iter().map(|one| Occupant::of(one, &told.judged, model)).collect();
        let mut times = Array::default();
        times.float64(&series.time_s);
        let prefixes: Vec<String> = summary.people().into_iter().map(|(prefix, _)| prefix).collect();
        let mut notes = told.notes;
        notes.extend(model.warnings().iter().map(|w| w.to_string()));
        let (remarks, caveats): (Vec<&Caveat>, Vec<&Caveat>) =
            summary.caveats.iter().partition(|caveat| caveat.is_note());
        notes.extend(remarks.iter().map(|note| note.text.clone()));
        let mut provenance = provenance::ending(summary, series.time_s.len());
        provenance.extend(told.origin);
        let mut plots = curves::own_plots(&series, &chosen, units);
        plots.extend(curves::plots(&series, &prefixes, units));
        Run {
            label: told.label,
            title: model.setup().title.clone(),
            impacts: impact.reasons(units),
            facts: provenance::facts(model, summary, units),
            notes,
            caveats: caveats.iter().map(|caveat| caveat.text.clone()).collect(),
            times,
            segments: model.body().tree.segment_rows().iter().map(|row| row.name.replace('_', " ")).collect(),
            parts: parts(model.body()).iter().map(PartData::of).collect(),
            spheres: spheres(model),
            surfaces: surfaces(model).into_iter().chain(sides(model)).chain(scenery(model)).collect(),
            motion,
            plots,
            measures: measures::measures(summary, &ride, &occupants, units),
            force_unit: units.over("kN"),
            speed_unit: units.over("m/s"),
            length_unit: units.over("m"),
            first_contacts: summary.contacts.clone(),
            ground: ground.data(model, summary),
            occupants,
            provenance,
            scenario: told.scenario,
        }
    }
}

impl PageRecorder {
    fn all(&mut self) -> impl Recorder {
        ((&mut self.impact, &mut self.ground), (&mut self.ride, (&mut self.motion, &mut self.series)))
    }
}

impl Recorder for PageRecorder {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        self.all().begin(model)
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.all().record(sample)
    }

    fn end(&mut self, outcome: &Outcome) -> Result<(), RecorderError> {
        self.all().end(outcome)
    }
}

impl Run {
    /// Name of a run on the page.
    pub(super) fn label_of(results: &Results) -> String {
        file_name(&results.path)
    }

    /// Collects the data of a run, with plots of channels as [`PageRecorder::new`] has them.
    ///
    /// # Errors
    /// A name or pattern that fits no channel.
    pub fn of(results: &Results, channels: &[String], units: Units) -> Result<Self, Failure> {
        Run::judged(results, channels, units, false)
    }

    /// The same, with `verdicts` on people too.
    ///
    /// # Errors
    /// A name or pattern that fits no channel.
    pub fn judged(results: &Results, channels: &[String], units: Units, verdicts: bool) -> Result<Self, Failure> {
        let mut gathered = PageRecorder::new(&results.model, channels)?;
        let summary = results.summary_judged(Options::default(), &mut gathered)?;
        let told = Source {
            label: Run::label_of(results),
            notes: results.notes(),
            origin: provenance::origin(results),
            scenario: results.scenario_text.clone().unwrap_or_default(),
            judged: if verdicts { names(&results.model) } else { results.loaded.dummies() },
        };
        Ok(gathered.run(&results.model, &summary, told, units))
    }
}

/// Names of all bodies.
fn names(model: &Model) -> Vec<String> {
    model.body().tree.bodies().iter().map(|row| row.name.to_owned()).collect()
}

impl Occupant {
    fn of((prefix, person): (String, Person), judged: &[String], model: &Model) -> Self {
        let name = prefix.trim_end_matches('.').to_owned();
        let rows = model.body().tree.bodies();
        let row = rows.iter().find(|row| row.name == name).or(rows.first());
        let head = row.and_then(|row| row.landmarks.head).map(|segment| segment.index());
        Occupant { judged: judged.contains(&name), name, dummy: person.dummy, head }
    }

    /// Whose a row is, by its name: of `driver` and `driver_2` the longer that fits.
    pub(super) fn owner<'a>(all: &'a [Occupant], text: &str) -> Option<&'a Occupant> {
        all.iter().filter(|one| one.is_of(text)).max_by_key(|one| one.name.len())
    }

    fn is_of(&self, text: &str) -> bool {
        let owns = |word: &str| word.strip_prefix(&*self.name).is_some_and(|rest| rest.starts_with(['.', '_']));
        !self.name.is_empty() && text.split_whitespace().any(owns)
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

fn spheres(model: &Model) -> Vec<SphereData> {
    let body = model.body();
    let data = |s: &occupant_core::body::ContactSphere| SphereData {
        name: s.name.clone(),
        segment: s.segment.index(),
        centre: sphere_centre_m(body, s).into(),
        radius: s.radius_m,
    };
    body.spheres.iter().map(data).collect()
}

fn surfaces(model: &Model) -> Vec<SurfaceData> {
    let all = model.setup().surfaces.iter().zip(model.faces());
    all.map(|(surface, face)| {
        if !is_shown(model, face.frame) {
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
            outside: false,
        }
    })
    .collect()
}

/// Road, tyre marks, barriers and the exterior of the vehicle, without contacts.
fn scenery(model: &Model) -> Vec<SurfaceData> {
    let drawn = model.setup().scenery.iter().filter(|own| is_shown(model, own.frame));
    let plates = drawn.flat_map(|own| own.polygons_m.iter().filter(|corners| corners.len() > 2).map(move |p| (own, p)));
    let plate = |(own, corners): (&Scenery, &Vec<Point3<f64>>)| SurfaceData {
        outside: own.name.ends_with("outside"),
        ..SurfaceData::plate(own.frame, SCENERY, "", corners)
    };
    plates.map(plate).collect()
}

/// The first faces of all solids, then the others.
fn sides(model: &Model) -> Vec<SurfaceData> {
    let (mut first, mut others) = (Vec::new(), Vec::new());
    for solid in &model.setup().solids {
        if !is_shown(model, solid.frame) {
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
    /// Placeholder for an object referred to by contacts that is not drawn: it moves within a vehicle or belongs to a
    /// loose body.
    fn hidden(name: &str, material: usize) -> Self {
        let none = [0.0; 3];
        SurfaceData {
            name: name.to_owned(),
            frame: "space",
            bounded: false,
            material,
            corners: vec![none; 3],
            normal: none,
            outside: false,
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
            outside: false,
        }
    }
}

/// Index of the grey material of scenery.
const SCENERY: usize = 5;

/// Whether the page can show a frame: the vehicle, space, or the ground.
fn is_shown(model: &Model, frame: Frame) -> bool {
    match frame {
        Frame::Vehicle | Frame::Space => true,
        Frame::Other(i) => {
            let frame = &model.setup().frames[i];
            frame.parent.is_none() && matches!(frame.path, VehiclePath::Fixed(_))
        }
        Frame::Segment(_) => false,
    }
}

/// The page's name of a frame, and the rotation of its vectors: space is Y left, Z up; vehicle-space Y right, Z down.
fn shown_in(frame: Frame) -> (&'static str, impl Fn([f64; 3]) -> [f64; 3]) {
    let (name, turn) = match frame {
        Frame::Space => ("space", [1.0, -1.0, -1.0]),
        Frame::Other(_) => ("space", [1.0, 1.0, 1.0]),
        _ => ("vehicle", [1.0, 1.0, 1.0]),
    };
    (name, move |v| [0, 1, 2].map(|i| turn[i] * v[i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_belong_to_the_occupant_whose_whole_name_they_begin_with() {
        let occupant = |name: &str| Occupant { name: name.to_owned(), dummy: "", judged: false, head: None };
        let all = ["driver", "driver_2", ""].map(occupant);
        let owner = |text: &str| Occupant::owner(&all, text).map(|one| one.name.as_str());
        assert_eq!(owner("driver.HIC15"), Some("driver"));
        assert_eq!(owner("driver_2.HIC15"), Some("driver_2"));
        assert_eq!(owner("force of driver_lap"), Some("driver"));
        assert_eq!([owner("drivers.HIC15"), owner("HIC15")], [None, None]);
    }
}
