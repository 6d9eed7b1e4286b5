//! Where a body goes that is thrown: off a vehicle's bonnet, or out of it.
//!
//! It is followed from its first touch with a frame that is not its home: for a pedestrian a vehicle, for an ejected occupant
//! the ground. Places are those of the centre of gravity of the whole body, in space; distances are horizontal.

use nalgebra::Vector3;
use serde::Serialize;

use crate::forces::contact::surface::Frame;
use crate::model::Model;
use crate::motion::frame::SPACE;
use crate::results::sample::Sample;

/// A body that touches nothing for less than this is not airborne, s.
const AIRBORNE_S: f64 = 0.01;

/// How a body was thrown.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Throw {
    /// First touch with a frame that is not its home.
    pub struck_s: f64,
    /// Its speed at the end.
    pub end_speed_m_s: f64,
    /// Horizontal distance from where it was struck to where it is at the end.
    pub distance_m: f64,
    /// Greatest height of its centre of gravity over that where it was struck.
    pub height_m: f64,
    /// Times from which and until which it touched nothing.
    pub airborne_s: Vec<[f64; 2]>,
    /// The first touch with the ground or space after it was airborne.
    pub landing: Option<Landing>,
}

/// How a body comes to the ground.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Landing {
    /// When.
    pub time_s: f64,
    /// The sphere that touches first.
    pub sphere: String,
    /// Speed of the centre of gravity of the whole body.
    pub speed_m_s: f64,
    /// Angle of that velocity below the horizontal.
    pub angle_deg: f64,
    /// Horizontal distance from where it was struck.
    pub distance_m: f64,
}

/// A body that may be thrown.
#[derive(Clone, Debug)]
pub(super) struct Flight {
    of: usize,
    pub name: &'static str,
    /// Frames that belong to its home.
    homes: Vec<usize>,
    /// Frames that stand still: space and the ground.
    still: [usize; 2],
    struck: Option<(f64, Vector3<f64>)>,
    highest_m: f64,
    airborne_s: Vec<[f64; 2]>,
    /// Since when it touches nothing.
    free_s: Option<f64>,
    landing: Option<Landing>,
    now: (Vector3<f64>, Vector3<f64>),
}

impl Flight {
    /// Those of all bodies of a model in which they may be struck.
    pub(super) fn all(model: &Model) -> Vec<Flight> {
        let setup = model.setup();
        if !setup.is_open() {
            return Vec::new();
        }
        let ground = setup.frames.iter().position(|frame| frame.name == "ground").map_or(Frame::Space, Frame::Other);
        let with_home = |home: Frame| {
            let others = (0..setup.frames.len()).map(Frame::Other).filter(|frame| setup.belongs_to(*frame) == home);
            [home].into_iter().chain(others).map(|frame| frame.index(&[])).collect()
        };
        let body = |((of, row), home): ((usize, crate::body::tree::BodyRow), Frame)| Flight {
            of,
            name: row.name,
            homes: with_home(home),
            still: [SPACE, ground.index(&[])],
            struck: None,
            highest_m: 0.0,
            airborne_s: Vec::new(),
            free_s: None,
            landing: None,
            now: (Vector3::zeros(), Vector3::zeros()),
        };
        model.body().tree.bodies().into_iter().enumerate().zip(setup.homes()).map(body).collect()
    }

    pub(super) fn see(&mut self, sample: &Sample<'_>) {
        let (system, time_s) = (sample.model.system(), sample.time_s);
        let touches = || {
            let own = |sphere: usize| system.skeleton.layout.rows()[system.spheres[sphere].segment].body == self.of;
            sample.actions.contacts.iter().filter(move |touch| own(touch.sphere))
        };
        self.now = sample.centre_of_body(self.of);
        let is_struck =
            touches().any(|touch| !self.homes.contains(&touch.frame) && !system.forces.contacts.is_of_bodies(touch));
        if self.struck.is_none() && is_struck {
            self.struck = Some((time_s, self.now.0));
        }
        let from = self.struck.map(|(_, from)| from);
        if let Some(from) = from {
            self.highest_m = self.highest_m.max(self.now.0.z - from.z);
        }
        let is_free = touches().next().is_none();
        let Some(since_s) = self.free_s.filter(|_| !is_free) else {
            self.free_s = if is_free { self.free_s.or(Some(time_s)) } else { None };
            return;
        };
        self.free_s = None;
        if time_s - since_s < AIRBORNE_S {
            return;
        }
        self.airborne_s.push([since_s, time_s]);
        let ground = touches().find(|touch| self.still.contains(&touch.frame));
        if let (None, Some(touch), Some(from)) = (&self.landing, ground, from) {
            let v = self.now.1;
            self.landing = Some(Landing {
                time_s,
                sphere: sample.model.body().spheres[touch.sphere].name.clone(),
                speed_m_s: v.norm(),
                angle_deg: (-v.z).atan2(v.xy().norm()).to_degrees(),
                distance_m: (self.now.0 - from).xy().norm(),
            });
        }
    }

    /// What came of it; none of a body that nothing struck.
    pub(super) fn throw(&self) -> Option<Throw> {
        let (struck_s, from) = self.struck?;
        Some(Throw {
            struck_s,
            end_speed_m_s: self.now.1.norm(),
            distance_m: (self.now.0 - from).xy().norm(),
            height_m: self.highest_m,
            airborne_s: self.airborne_s.clone(),
            landing: self.landing.clone(),
        })
    }
}
