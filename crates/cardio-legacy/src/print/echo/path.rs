//! The path of the vehicle.

use occupant_core::vehicle::{
    AfterEnd, Interpolation, PulsePath, PulseShape, Strength, TablePath, TravelDirection, VehiclePath, VehiclePose,
};
use occupant_units::unit::Unit::{Metre, MetrePerSecond, Radian, Second};

use super::sensors;
use crate::print::unit::{g, ratio};
use crate::print::{Case, Pages, Table, Units};

/// Writes the path of every vehicle.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: Units) {
    let setup = case.model.setup();
    own(pages, &setup.path, units);
    for frame in setup.frames.iter().filter(|frame| frame.path != VehiclePath::parked()) {
        pages.say("");
        let what = if frame.parent.is_some() { "PANEL, AS IT MOVES IN WHAT CARRIES IT:" } else { "VEHICLE" };
        pages.say(&format!("{what} {}", frame.name.to_uppercase()));
        own(pages, &frame.path, units);
    }
}

fn own(pages: &mut Pages, path: &VehiclePath, units: Units) {
    match path {
        VehiclePath::Fixed(path) => {
            pages.say(&format!("THE VEHICLE STANDS {}", pose(&path.pose(), units)));
        }
        VehiclePath::Pulse(path) => pulse(pages, path, units),
        VehiclePath::Table(path) => stations(pages, path, units),
        VehiclePath::Sensors(path) => sensors::write(pages, path, units),
        _ => pages.say("A PATH THAT THIS PRINTOUT DOES NOT KNOW"),
    }
}

pub(crate) fn pose(pose: &VehiclePose, units: Units) -> String {
    let a = &pose.attitude;
    let [roll, pitch, yaw] = units.of(Radian).vector([a.roll_rad, a.pitch_rad, a.yaw_rad]);
    let l = units.of(Metre);
    format!("AT {} {}, ROLL {roll}, PITCH {pitch}, YAW {yaw} DEG", l.point(pose.position_m), l.name())
}

fn pulse(pages: &mut Pages, path: &PulsePath, units: Units) {
    let (d, v) = (path.definition(), units.of(MetrePerSecond));
    let (from_s, to_s) = path.pulse_span_s();
    pages.say("STRAIGHT TRAVEL, SLOWED BY A PULSE");
    pages.fact("START", pose(&d.initial, units));
    pages.fact("INITIAL SPEED", v.say(d.initial_speed_m_s));
    pages.fact("DIRECTION", direction(&d.direction));
    pages.fact("PULSE", format!("{}, FROM {from_s:.6} TO {to_s:.6} SEC", shape(&d.shape, units)));
    pages.fact("PEAK", g().say(path.peak_deceleration_m_s2()));
    pages.fact("DELTA-V", v.say(path.delta_v_m_s()));
    if let Some(rebound_m_s) = d.rebound_m_s {
        pages.fact("REBOUND", v.say(rebound_m_s));
    }
    if let Some(stop) = path.stop() {
        pages.fact("AT REST", format!("AT {:.6} SEC AFTER {}", stop.time_s, units.of(Metre).say(stop.distance_m)));
    }
    if let PulseShape::Tabulated { points } = &d.shape {
        let mut table = Table::new("DECELERATION OVER TIME FROM THE START OF THE PULSE", "SEC|G");
        for point in points {
            table.row([format!("{:.6}", point.time_s), g().show(point.deceleration_m_s2)]);
        }
        table.write(pages);
    }
}

pub(crate) fn direction(direction: &TravelDirection) -> String {
    match *direction {
        TravelDirection::Heading => "NOSE FIRST".to_owned(),
        TravelDirection::Along(v) => {
            format!("ALONG {} (FORWARD, RIGHT, DOWN)", ratio().point(v))
        }
    }
}

pub(crate) fn after(after: AfterEnd) -> &'static str {
    match after {
        AfterEnd::Error => "NO PATH",
        AfterEnd::Coast => "THE LAST VELOCITY",
        AfterEnd::Hold => "REST",
    }
}

fn shape(shape: &PulseShape, units: Units) -> String {
    let strong = |strength: &Strength| match *strength {
        Strength::PeakDeceleration(a) => format!("PEAK {}", g().say(a)),
        Strength::DeltaV(v) => format!("DELTA-V {}", units.of(MetrePerSecond).say(v)),
    };
    match shape {
        PulseShape::HalfSine { strength, .. } => format!("HALF SINE, {}", strong(strength)),
        PulseShape::Haversine { strength, .. } => format!("HAVERSINE, {}", strong(strength)),
        PulseShape::Triangle { strength, peak_fraction, .. } => {
            format!("TRIANGLE, {}, PEAK AT {peak_fraction} OF ITS LENGTH", strong(strength))
        }
        PulseShape::Trapezoid { strength, rise_s, plateau_s, fall_s } => {
            format!("TRAPEZOID, {}, RISE {rise_s}, PLATEAU {plateau_s}, FALL {fall_s} SEC", strong(strength))
        }
        PulseShape::Square { strength, .. } => format!("SQUARE, {}", strong(strength)),
        PulseShape::Tabulated { points } => format!("TABLE OF {} POINTS", points.len()),
    }
}

fn stations(pages: &mut Pages, path: &TablePath, units: Units) {
    let between = match path.interpolation() {
        Interpolation::Linear => "STRAIGHT LINES",
        Interpolation::Spline => "NATURAL SPLINES",
    };
    let (count, after, l) = (path.stations().len(), after(path.after()), units.of(Metre));
    let title = format!("{count} STATIONS, {between} BETWEEN THEM, {after} AFTER THE LAST ({}, DEG)", l.name());
    let mut table = Table::new(title, "SEC|X FORWARD|Y RIGHT|Z DOWN|ROLL|PITCH|YAW");
    for station in path.stations() {
        let a = &station.pose.attitude;
        let angles = units.of(Radian).vector([a.roll_rad, a.pitch_rad, a.yaw_rad]);
        table.row_of(&[&[units.of(Second).show(station.time_s)], &l.vector(station.pose.position_m), &angles]);
    }
    table.write(pages);
}
