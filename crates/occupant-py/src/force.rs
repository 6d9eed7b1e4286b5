//! Forces that Python brings.

use std::fmt;
use std::sync::PoisonError;

use nalgebra::Vector3;
use occupant_core::forces::contact::surface::Frame;
use occupant_core::forces::own::{Force, OwnForce, Place, Pushes, Scene};
use occupant_core::model::setup::Setup;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};

use crate::live::Trouble;
use crate::trouble::plain;

/// A force defined in Python: its points by name, and its function.
pub(crate) struct Brought {
    pub(crate) name: String,
    pub(crate) places: Vec<Where>,
    pub(crate) function: Py<PyAny>,
}

/// A point by name.
#[derive(Clone, Debug)]
pub(crate) enum Where {
    Sphere(String),
    Segment(String, [f64; 3]),
    Vehicle([f64; 3]),
    Space([f64; 3]),
}

impl Where {
    /// `"right_hand"`, a sphere, or `("head", [x, y, z])`, a point of a segment, of `"vehicle"` or of `"space"`.
    pub(crate) fn of(given: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(sphere) = given.extract::<String>() {
            return Ok(Where::Sphere(sphere));
        }
        let (name, point): (String, [f64; 3]) = given.extract()?;
        Ok(match name.as_str() {
            "vehicle" => Where::Vehicle(point),
            "space" => Where::Space(point),
            _ => Where::Segment(name, point),
        })
    }

    /// As [`Where::of`] reads it.
    fn given<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match self {
            Where::Sphere(name) => name.into_bound_py_any(py),
            Where::Segment(name, point) => (name, *point).into_bound_py_any(py),
            Where::Vehicle(point) => ("vehicle", *point).into_bound_py_any(py),
            Where::Space(point) => ("space", *point).into_bound_py_any(py),
        }
    }

    fn place(&self, setup: &Setup) -> PyResult<Place> {
        match self {
            Where::Sphere(name) => {
                let sphere = setup.body.sphere(name).map(Place::Sphere);
                sphere.ok_or_else(|| plain(format!("no sphere is called {name}")))
            }
            Where::Segment(name, point) => {
                let segment = setup.body.tree.segment_named(name).map(|one| Place::Segment(one, (*point).into()));
                segment
                    .ok_or_else(|| plain(format!("no segment is called {name}; there are vehicle and space as well")))
            }
            Where::Vehicle(point) => Ok(Place::Frame(Frame::Vehicle, (*point).into())),
            Where::Space(point) => Ok(Place::Frame(Frame::Space, (*point).into())),
        }
    }
}

impl Brought {
    /// What `Scenario.add_force` takes.
    pub(crate) fn parts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let places = self.places.iter().map(|one| one.given(py)).collect::<PyResult<Vec<_>>>()?;
        (&self.name, places, &self.function).into_pyobject(py)
    }

    /// The force in the form of a setup.
    pub(crate) fn own(&self, py: Python<'_>, setup: &Setup, trouble: Trouble) -> PyResult<OwnForce> {
        let places = self.places.iter().map(|one| one.place(setup)).collect::<PyResult<Vec<_>>>()?;
        Ok(OwnForce::new(&self.name, Called { places, function: self.function.clone_ref(py), trouble }))
    }
}

/// A force computed by Python.
struct Called {
    places: Vec<Place>,
    function: Py<PyAny>,
    trouble: Trouble,
}

impl fmt::Debug for Called {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a force of Python's")
    }
}

impl Called {
    /// Calls the function: a force for each point, space axes, N.
    fn ask(&self, scene: &Scene<'_>) -> PyResult<Vec<[f64; 3]>> {
        Python::attach(|py| {
            let motions: Vec<_> = self.places.iter().map(|place| scene.motion(place)).collect();
            let places: Vec<[f64; 3]> = motions.iter().map(|motion| motion.place_m.into()).collect();
            let velocities: Vec<[f64; 3]> = motions.iter().map(|motion| motion.velocity_m_s.into()).collect();
            let args = (scene.time_s(), PyList::new(py, places)?, PyList::new(py, velocities)?);
            let forces: Vec<[f64; 3]> = self.function.call1(py, args)?.extract(py)?;
            if forces.len() == self.places.len() {
                return Ok(forces);
            }
            Err(plain(format!("{} forces for {} places; expected one for each", forces.len(), self.places.len())))
        })
    }
}

impl Force for Called {
    fn apply(&self, scene: &Scene<'_>, _memory: &[f64], pushes: &mut Pushes<'_, '_>) {
        match self.ask(scene) {
            Ok(forces) => {
                for (place, force) in self.places.iter().zip(forces) {
                    pushes.force(place, force.into());
                }
            }
            Err(error) => {
                self.trouble.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
                // ends the run
                if let Some(place) = self.places.first() {
                    pushes.force(place, Vector3::repeat(f64::NAN));
                }
            }
        }
    }
}
