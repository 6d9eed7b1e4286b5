//! Runs that Python steps itself, with vehicles that it tells how to move.

use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::{Point3, Vector3};
use occupant_core::model::Model;
use occupant_core::results::channel::{Channel, find, matching};
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Recorder;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::Run as Stepped;
use occupant_core::vehicle::{Attitude, VehicleInput, VehiclePose, VehicleState};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use pythonize::pythonize;

use crate::trouble::plain;

/// A run in progress.
#[pyclass(module = "occupant")]
pub(crate) struct LiveRun {
    model: Arc<Model>,
    run: Stepped<'static>,
    summarizer: Summarizer,
    /// The first exception of a Python force.
    trouble: Trouble,
}

/// Exceptions of Python forces.
pub(crate) type Trouble = Arc<Mutex<Option<PyErr>>>;

/// The exception of a force, or else the simulator's error.
pub(crate) fn raised(trouble: &Trouble, error: impl std::fmt::Display) -> PyErr {
    let left = trouble.lock().unwrap_or_else(PoisonError::into_inner).take();
    left.unwrap_or_else(|| plain(error))
}

/// Position, attitude (roll, pitch, yaw in rad), velocity and rates of the three angles, vehicle-space axes.
pub(crate) fn state(place: [f64; 3], attitude: [f64; 3], velocity: [f64; 3], rates: [f64; 3]) -> VehicleState {
    let [roll_rad, pitch_rad, yaw_rad] = attitude;
    VehicleState {
        pose: VehiclePose { position_m: place.into(), attitude: Attitude { roll_rad, pitch_rad, yaw_rad } },
        velocity_m_s: velocity.into(),
        angle_rates_rad_s: rates.into(),
        ..VehicleState::default()
    }
}

impl LiveRun {
    pub(crate) fn of(model: Model, trouble: Trouble) -> Self {
        let model = Arc::new(model);
        LiveRun { run: Stepped::shared(model.clone()), model, summarizer: Summarizer::new(), trouble }
    }

    fn channel(&self, name: &str) -> PyResult<Channel> {
        find(&self.model, name).map_err(|unknown| PyKeyError::new_err(unknown.to_string()))
    }
}

#[pymethods]
impl LiveRun {
    /// Time reached, s.
    #[getter]
    fn time(&self) -> f64 {
        self.run.time_s()
    }

    /// End of the scenario's time, s.
    #[getter]
    fn end(&self) -> f64 {
        self.run.end_s()
    }

    /// Time up to which the motion of the vehicle is known, s.
    #[getter]
    fn known_until(&self) -> f64 {
        self.run.known_until_s()
    }

    /// Gives the vehicle's motion up to `until`, s: `acceleration` of its c.g., m/s², and `angular` acceleration,
    /// rad/s², along the fixed axes x forward, y right, z down.
    #[pyo3(signature = (until, acceleration, angular=[0.0; 3]))]
    fn push(&mut self, until: f64, acceleration: [f64; 3], angular: [f64; 3]) -> PyResult<()> {
        let input = VehicleInput::Acceleration { linear_m_s2: acceleration.into(), angular_rad_s2: angular.into() };
        self.run.push(until, &input).map_err(plain)
    }

    /// Gives the vehicle's state at `until`, s: its `place`, m, `velocity`, m/s, `attitude` (roll, pitch and yaw), rad,
    /// and the `rates` of these angles, rad/s.
    #[pyo3(signature = (until, place, velocity, attitude=[0.0; 3], rates=[0.0; 3]))]
    fn push_state(
        &mut self,
        until: f64,
        place: [f64; 3],
        velocity: [f64; 3],
        attitude: [f64; 3],
        rates: [f64; 3],
    ) -> PyResult<()> {
        self.run.push(until, &VehicleInput::State(state(place, attitude, velocity, rates))).map_err(plain)
    }

    /// Steps to a time, s; by default to the end of the known vehicle motion, or to the end of the run.
    #[pyo3(signature = (to=None))]
    fn advance(&mut self, py: Python<'_>, to: Option<f64>) -> PyResult<()> {
        let to_s = to.unwrap_or_else(|| self.run.known_until_s().min(self.run.end_s()));
        let run = &mut self.run;
        py.detach(|| run.advance_to(to_s)).map_err(|error| raised(&self.trouble, error))
    }

    /// Applies an `impulse` to a `segment`, N·s, space axes (x forward, y left, z up), at a point `at` from the
    /// segment's lower end, m.
    #[pyo3(signature = (segment, impulse, at=[0.0; 3]))]
    fn kick(&mut self, segment: &str, impulse: [f64; 3], at: [f64; 3]) -> PyResult<()> {
        let tree = self.model.body().tree;
        let missing = || PyKeyError::new_err(format!("no segment is called {segment}"));
        let segment = tree.segment_named(segment).ok_or_else(missing)?;
        self.run.kick(segment, Point3::from(at), Vector3::from(impulse)).map_err(plain)
    }

    /// Present value of a channel, in its SI unit.
    fn __getitem__(&mut self, name: &str) -> PyResult<f64> {
        let channel = self.channel(name)?;
        self.run.look(|sample| channel.value(sample)).map_err(|error| raised(&self.trouble, error))
    }

    /// Present values of all channels that match one of `patterns`, by name.
    #[pyo3(signature = (*patterns))]
    fn values<'py>(&mut self, py: Python<'py>, patterns: Vec<String>) -> PyResult<Bound<'py, PyDict>> {
        let wanted: Vec<Channel> = patterns.iter().flat_map(|pattern| matching(&self.model, pattern)).collect();
        let values = self.run.look(|sample| wanted.iter().map(|one| one.value(sample)).collect::<Vec<f64>>());
        let dict = PyDict::new(py);
        for (channel, value) in wanted.iter().zip(values.map_err(|error| raised(&self.trouble, error))?) {
            dict.set_item(&channel.name, value)?;
        }
        Ok(dict)
    }

    /// Records the present state as an output of the run, from which `summary` is computed.
    fn record(&mut self) -> PyResult<()> {
        let recorded = self.run.record(&mut self.summarizer);
        recorded.map(|_| ()).map_err(|error| raised(&self.trouble, error))
    }

    /// The content of `occupant run --json` for a run that ends here.
    fn summary(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let mut summarizer = self.summarizer.clone();
        let ended = self.run.clone().end(Status::Completed, &mut summarizer as &mut dyn Recorder);
        ended.map_err(plain)?;
        let summary = summarizer.summary(None).ok_or_else(|| plain("nothing was recorded; expected `record()`"))?;
        Ok(pythonize(py, &summary)?.unbind())
    }

    /// The complete state of the run as bytes, for `load`.
    fn save(&mut self) -> PyResult<Vec<u8>> {
        self.run.save().map_err(plain)
    }

    /// Restores a state saved from a run of this scenario.
    fn load(&mut self, bytes: &[u8]) -> PyResult<()> {
        self.run = Stepped::load_shared(self.model.clone(), bytes).map_err(plain)?;
        Ok(())
    }

    /// An independent copy of the run.
    fn copy(&self) -> Self {
        LiveRun {
            model: self.model.clone(),
            run: self.run.clone(),
            summarizer: self.summarizer.clone(),
            trouble: self.trouble.clone(),
        }
    }

    fn __repr__(&self) -> String {
        format!("<occupant.LiveRun {:?} at {} s>", self.model.setup().title, self.run.time_s())
    }
}
