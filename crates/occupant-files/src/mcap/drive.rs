//! A drive without people as an MCAP file: road, barriers, tyre marks, vehicles, what the vehicles do, and the report.
//!
//! Topics: `/tf` with a frame for each vehicle, `/scene/drive` written once, `/scene/rails` while rails move,
//! `/drive/VEHICLE` with a field for each column, `/log` with events. Axes and types are those of runs.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::{Seek, Write};

use mcap::records::Metadata;
use mcap::{Attachment, McapResult, WriteOptions, Writer};
use nalgebra::{Point3, UnitQuaternion, Vector3};
use occupant_core::quantity::Kind;
use occupant_core::results::catalogue::{Field, Message};

use super::COMPRESSION;
use super::about::Document;
use super::channel::{Channel, Schemas};
use super::clock::nanoseconds;
use super::foxglove::{FRAME_TRANSFORMS, LOG, Level, SCENE_UPDATE};
use super::log;
use super::scene::compartment::scenery_color;
use super::scene::primitive::{Closing, line, polygon};
use super::scene::{entity, replace};
use super::topics::{self, SPACE_FRAME, other_frame};
use super::wire::Wire;

/// Name of the first metadata record.
pub const DRIVE: &str = "occupant.drive";
const DRIVE_SCENE: &str = "/scene/drive";
const RAILS_SCENE: &str = "/scene/rails";
const EDGE_M: f64 = 0.006;

/// Polygons with a name, m.
#[derive(Clone, Debug, PartialEq)]
pub struct Painted {
    /// Its name, which gives its colour.
    pub name: String,
    /// Number of the vehicle that carries it; none: it stands in space.
    pub vehicle: Option<usize>,
    /// Convex polygons in those axes.
    pub polygons_m: Vec<Vec<Point3<f64>>>,
}

/// A vehicle over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Its name.
    pub name: String,
    /// Headings with units, `speed[m/s]`; the first is the time, s.
    pub columns: Vec<String>,
    /// Numbers by column.
    pub rows: Vec<Vec<f64>>,
    /// Place in space, m, and rotation from the vehicle's axes to those of space, for each row.
    pub poses: Vec<(Vector3<f64>, UnitQuaternion<f64>)>,
}

/// A drive to write.
#[derive(Clone, Debug, PartialEq)]
pub struct DriveFile {
    /// Program and version.
    pub program: String,
    /// Title.
    pub title: String,
    /// Scenario and report.
    pub documents: Vec<Document>,
    /// What does not change its shape.
    pub scenery: Vec<Painted>,
    /// What changes it: from each time, s, until the next.
    pub moving: Vec<(f64, Vec<Painted>)>,
    /// The vehicles, with rows at the same times.
    pub vehicles: Vec<Track>,
    /// Events, s.
    pub events: Vec<(f64, String)>,
}

impl DriveFile {
    /// Writes it.
    ///
    /// # Errors
    /// What `target` reports.
    pub fn write<W: Write + Seek>(&self, target: W) -> McapResult<W> {
        let mut file =
            WriteOptions::new().profile("").library(self.program.clone()).compression(COMPRESSION).create(target)?;
        self.write_documents(&mut file)?;
        let schemas = Schemas::default();
        let mut still = schemas.add_foxglove(&mut file, DRIVE_SCENE, SCENE_UPDATE)?;
        put(&mut file, &mut still, 0.0, |wire| self.scenery.iter().for_each(|own| self.paint(wire, 0, own)))?;
        self.write_moving(&mut file, &schemas)?;
        self.write_vehicles(&mut file, &schemas)?;
        self.write_events(&mut file, &schemas)?;
        file.finish()?;
        Ok(file.into_inner())
    }

    fn write_documents<W: Write + Seek>(&self, file: &mut Writer<W>) -> McapResult<()> {
        let entries = [("program", &self.program), ("title", &self.title)];
        let metadata =
            entries.map(|(key, value)| (key.to_owned(), value.clone())).into_iter().collect::<BTreeMap<_, _>>();
        file.write_metadata(&Metadata { name: DRIVE.to_owned(), metadata })?;
        for document in &self.documents {
            file.attach(&Attachment {
                log_time: 0,
                create_time: 0,
                name: document.name.clone(),
                media_type: document.media_type.clone(),
                data: Cow::Borrowed(&document.content),
            })?;
        }
        Ok(())
    }

    fn paint(&self, wire: &mut Wire, ns: u64, own: &Painted) {
        let color = scenery_color(&own.name);
        let frame = own.vehicle.map_or(SPACE_FRAME.to_owned(), |i| other_frame(&self.vehicles[i].name));
        entity(wire, ns, &frame, &own.name, |w| {
            for corners in &own.polygons_m {
                polygon(w, corners, color);
                line(w, Closing::Closed, corners, EDGE_M, color.with_opacity(0.9));
            }
        });
    }

    fn write_moving<W: Write + Seek>(&self, file: &mut Writer<W>, schemas: &Schemas) -> McapResult<()> {
        if self.moving.is_empty() {
            return Ok(());
        }
        let mut channel = schemas.add_foxglove(file, RAILS_SCENE, SCENE_UPDATE)?;
        for (time_s, all) in &self.moving {
            let ns = nanoseconds(*time_s, 0.0);
            put(file, &mut channel, *time_s, |wire| {
                replace(wire, ns, |wire| all.iter().for_each(|own| self.paint(wire, ns, own)));
            })?;
        }
        Ok(())
    }

    fn write_vehicles<W: Write + Seek>(&self, file: &mut Writer<W>, schemas: &Schemas) -> McapResult<()> {
        let mut transforms = schemas.add_foxglove(file, topics::TRANSFORMS, FRAME_TRANSFORMS)?;
        let mut channels = Vec::new();
        for own in &self.vehicles {
            channels.push(schemas.add(file, &own.message())?);
        }
        let rows = self.vehicles.first().map_or(0, |own| own.rows.len());
        for i in 0..rows {
            let time_s = self.vehicles[0].rows[i][0];
            put(file, &mut transforms, time_s, |wire| {
                self.vehicles.iter().for_each(|own| own.transform(wire, nanoseconds(time_s, 0.0), i));
            })?;
            for (own, channel) in self.vehicles.iter().zip(&mut channels) {
                put(file, channel, time_s, |wire| {
                    (1..).zip(&own.rows[i]).for_each(|(field, value)| wire.number(field, *value));
                })?;
            }
        }
        Ok(())
    }

    fn write_events<W: Write + Seek>(&self, file: &mut Writer<W>, schemas: &Schemas) -> McapResult<()> {
        let mut channel = schemas.add_foxglove(file, topics::LOG, LOG)?;
        for (time_s, words) in &self.events {
            let ns = nanoseconds(*time_s, 0.0);
            put(file, &mut channel, *time_s, |wire| log::write(wire, ns, Level::Info, words))?;
        }
        Ok(())
    }
}

fn put<W: Write + Seek>(
    file: &mut Writer<W>,
    channel: &mut Channel,
    time_s: f64,
    write: impl FnOnce(&mut Wire),
) -> McapResult<()> {
    let mut wire = Wire::default();
    write(&mut wire);
    file.write_to_known_channel(&channel.next(nanoseconds(time_s, 0.0)), &wire.bytes)
}

impl Track {
    fn message(&self) -> Message {
        let field = |(number, heading): (u32, &String)| Field {
            number,
            name: field_name(heading),
            meaning: Cow::Owned(heading.clone()),
            kind: Kind::Number,
            source: None,
        };
        let fields = (1..).zip(&self.columns).map(field).collect();
        Message { name: "DriveMotion", topic: format!("/drive/{}", self.name), fields }
    }

    fn transform(&self, wire: &mut Wire, ns: u64, row: usize) {
        let (place_m, turn) = &self.poses[row];
        wire.message(1, |w| {
            w.time(1, ns);
            w.text(2, SPACE_FRAME);
            w.text(3, &other_frame(&self.name));
            w.vector(4, place_m);
            w.rotation(5, turn);
        });
    }
}

/// `wheel.left_front.load[N]` → `wheel_left_front_load_n`, `speed[m/s]` → `speed_m_s`.
fn field_name(heading: &str) -> String {
    let lower = heading.to_ascii_lowercase().replace("^", "").replace("[-]", "");
    let words = lower.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| !word.is_empty());
    words.collect::<Vec<_>>().join("_")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_become_names_of_fields() {
        let names =
            ["t[s]", "ax[m/s^2]", "wheel.left_front.load[N]", "wheel.left_front.saturation[-]", "wheel.a.brake[N*m]"];
        let expected =
            ["t_s", "ax_m_s2", "wheel_left_front_load_n", "wheel_left_front_saturation", "wheel_a_brake_n_m"];
        assert_eq!(names.map(field_name), expected);
    }
}
