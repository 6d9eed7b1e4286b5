//! Units of measurement, and trigonometry that gives the same bits on every machine. Knows no simulator and no measure.

pub mod trig;
pub mod unit;
