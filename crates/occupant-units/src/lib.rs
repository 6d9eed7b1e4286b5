//! Units of measurement, and trigonometry that gives the same bits on every machine. Knows no simulator and no measure.
//!
//! ```
//! use occupant_units::unit;
//!
//! let stiffness = unit::parse("lbf/in", 0)?;
//! assert!((48.0 * stiffness.factor - 8406.1).abs() < 0.1); // N/m
//! assert_eq!(stiffness.dimension, unit::parse("N/m", 0)?.dimension);
//!
//! // an error says where, what was found, and what could be there
//! let error = unit::parse("lbf/inn", 0).unwrap_err();
//! assert_eq!((error.start, error.end), (4, 7));
//! # Ok::<(), occupant_units::unit::UnitError>(())
//! ```

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod trig;
pub mod unit;
