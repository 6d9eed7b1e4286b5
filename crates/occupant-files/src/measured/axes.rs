//! Directions of the axes of records and tables.

/// Direction of the axes; x is forward in both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// y right, z down.
    ZDown,
    /// y left, z up.
    ZUp,
}

/// Names on the command line, names in help.
pub const AXES: [(&str, &str, Axes); 4] = [
    ("z_down", "x forward, y right, z down: SAE J211 and J670, HVOSM", Axes::ZDown),
    ("sae", "The same as z_down", Axes::ZDown),
    ("z_up", "x forward, y left, z up: ISO 8855, CarSim, PC-Crash", Axes::ZUp),
    ("iso", "The same as z_up", Axes::ZUp),
];

impl Axes {
    /// Note when axes were not given.
    pub const TAKEN: &str = "axes are taken as x forward, y right, z down (SAE J670); use --axes z_up for x forward, y left, z up (ISO 8855)";
}
