//! Contacts of bodies with the ground, and their ways over it in plan.

use std::collections::HashSet;

use nalgebra::Vector3;
use occupant_core::forces::contact::surface::Frame;
use occupant_core::model::Model;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::Summary;
use occupant_core::vehicle::VehiclePath;
use serde::Serialize;

/// Longest list of contacts; the rest is counted.
const MOST_CONTACTS: usize = 60;
/// Points of a way in plan.
const MOST_POINTS: usize = 400;

/// Begin of a contact with the ground, space axes.
#[derive(Clone, Debug, Serialize)]
pub struct GroundContact {
    time_s: f64,
    part: String,
    #[serde(skip)]
    sphere: String,
    surface: String,
    place_m: [f64; 3],
    /// Speed of the sphere's centre over the output before; none at the first output.
    speed_m_s: Option<f64>,
}

/// Way of the centre of gravity of a thrown body in plan: time, x, y; with the times of its throw.
#[derive(Clone, Debug, Serialize)]
pub struct Way {
    occupant: String,
    points: Vec<[f64; 3]>,
    marks: Vec<(&'static str, f64)>,
}

/// Records contacts and ways.
#[derive(Debug, Default)]
pub struct Ground {
    is_ground: Vec<bool>,
    touching: HashSet<(usize, usize)>,
    contacts: Vec<GroundContact>,
    more: usize,
    before: Option<(f64, Vec<Vector3<f64>>)>,
    ways: Vec<Vec<[f64; 3]>>,
}

/// The ground on the page.
#[derive(Debug, Serialize)]
pub struct GroundData {
    contacts: Vec<GroundContact>,
    /// Contacts beyond the list.
    more: usize,
    ways: Vec<Way>,
}

impl Ground {
    /// Contacts with the ground and ways of thrown bodies. First contacts have the times and speeds of the summary.
    pub fn data(self, model: &Model, summary: &Summary) -> GroundData {
        let thrown = |name: &str| summary.throws.get(name);
        let bodies = model.body().tree.bodies().into_iter().zip(self.ways);
        let ways = bodies.filter_map(|(row, points)| {
            let throw = thrown(row.name)?;
            let launch = throw.launch.as_ref().map(|launch| ("launch", launch.time_s));
            let landing = throw.landing.as_ref().map(|landing| ("landing", landing.time_s));
            let start = ("start of the throw", throw.struck_s);
            let end = (if throw.at_rest { "rest" } else { "end of the run" }, summary.reached_s);
            let marks = [Some(start), launch, landing, Some(end)].into_iter().flatten().collect();
            Some(Way { occupant: row.name.to_owned(), points: thinned(points), marks })
        });
        let mut contacts = self.contacts;
        let mut known = HashSet::new();
        for contact in &mut contacts {
            let is_new = known.insert((contact.sphere.clone(), contact.surface.clone()));
            let is_own = |first: &&occupant_core::results::summary::ContactBegin| {
                first.sphere == contact.sphere && first.surface == contact.surface && !first.at_start
            };
            if let Some(first) = summary.contacts.iter().find(is_own).filter(|_| is_new && contact.speed_m_s.is_some())
            {
                (contact.time_s, contact.speed_m_s) = (first.time_s, Some(first.speed_m_s));
            }
        }
        GroundData { contacts, more: self.more, ways: ways.collect() }
    }

    fn see_contacts(&mut self, s: &Sample<'_>) {
        let spheres = &s.model.body().spheres;
        let centres: Vec<_> = (0..spheres.len()).map(|i| space(s, s.sphere_centre_m(i).coords)).collect();
        let mut now = HashSet::new();
        for touch in s.contacts().filter(|touch| self.is_ground.get(touch.surface) == Some(&true)) {
            let pair = (touch.sphere, touch.surface);
            if !now.insert(pair) || self.touching.contains(&pair) {
                continue;
            }
            if self.contacts.len() == MOST_CONTACTS {
                self.more += 1;
                continue;
            }
            let speed = |(time_s, last): &(f64, Vec<Vector3<f64>>)| {
                (centres[touch.sphere] - last[touch.sphere]).norm() / (s.time_s - time_s)
            };
            self.contacts.push(GroundContact {
                time_s: s.time_s,
                part: spheres[touch.sphere].part.clone(),
                sphere: spheres[touch.sphere].name.clone(),
                surface: s.model.setup().surface_names().nth(touch.surface).unwrap_or_default().to_owned(),
                place_m: space(s, touch.point_m.coords).into(),
                speed_m_s: self.before.as_ref().map(speed),
            });
        }
        self.touching = now;
        self.before = Some((s.time_s, centres));
    }
}

/// A place in axes of the first vehicle in those of space.
fn space(s: &Sample<'_>, place_m: Vector3<f64>) -> Vector3<f64> {
    s.vehicle.point_to_space(place_m)
}

/// At most [`MOST_POINTS`] of the points, with the last.
fn thinned(points: Vec<[f64; 3]>) -> Vec<[f64; 3]> {
    let every = points.len().div_ceil(MOST_POINTS).max(1);
    let last = points.len().saturating_sub(1);
    points.into_iter().enumerate().filter(|(i, _)| i % every == 0 || *i == last).map(|(_, point)| point).collect()
}

impl Recorder for Ground {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        let setup = model.setup();
        let rests = |frame: Frame| match frame {
            Frame::Space => true,
            Frame::Other(i) => {
                setup.frames[i].parent.is_none() && matches!(setup.frames[i].path, VehiclePath::Fixed(_))
            }
            Frame::Vehicle | Frame::Segment(_) => false,
        };
        let frames = setup.surfaces.iter().map(|own| own.frame).chain(setup.solids.iter().map(|own| own.frame));
        self.is_ground = frames.map(rests).collect();
        self.ways = vec![Vec::new(); model.body().tree.bodies().len()];
        Ok(())
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        if self.is_ground.contains(&true) {
            self.see_contacts(&sample.seen_by_vehicle());
        }
        for (body, way) in self.ways.iter_mut().enumerate() {
            let (place_m, _) = sample.centre_of_body(body);
            way.push([sample.time_s, place_m.x, place_m.y]);
        }
        Ok(Flow::Continue)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_keeps_its_ends() {
        for count in [0, 1, 2, 400, 401, 12_345] {
            let points: Vec<_> = (0..count).map(|i| [f64::from(i), 0.0, 0.0]).collect();
            let thin = thinned(points.clone());
            assert!(thin.len() <= MOST_POINTS + 1 && thin.len() >= points.len().min(MOST_POINTS / 2), "{count}");
            assert_eq!((thin.first(), thin.last()), (points.first(), points.last()));
        }
    }
}
