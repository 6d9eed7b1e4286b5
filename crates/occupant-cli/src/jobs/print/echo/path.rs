//! The path of the vehicle.

use occupant_core::vehicle::{
    AfterEnd, Interpolation, PulsePath, PulseShape, Strength, TablePath, TravelDirection, VehiclePath, VehiclePose,
};

use super::sensors;
use crate::jobs::print::case::Case;
use crate::jobs::print::page::Pages;
use crate::jobs::print::table::Table;
use crate::jobs::print::unit::{DEGREE, G, RATIO, Units};

pub(crate) fn write(pages: &mut Pages, case: &Case, units: &Units) {
    match &case.model.setup().path {
        VehiclePath::Fixed(path) => {
            pages.say(&format!("THE VEHICLE STANDS {}", pose(&path.pose(), units)));
        }
        VehiclePath::Pulse(path) => pulse(pages, path, units),
        VehiclePath::Table(path) => stations(pages, path, units),
        VehiclePath::Sensors(path) => sensors::write(pages, path, units),
        _ => pages.say("A PATH THAT THIS PRINTOUT DOES NOT KNOW"),
    }
}

pub(crate) fn pose(pose: &VehiclePose, units: &Units) -> String {
    let a = &pose.attitude;
    let angles = [a.roll_rad, a.pitch_rad, a.yaw_rad].map(|x| DEGREE.show(x));
    format!(
        "AT {} {}, ROLL {}, PITCH {}, YAW {} DEG",
        units.length.point(pose.position_m.into()),
        units.length.name,
        angles[0],
        angles[1],
        angles[2]
    )
}

fn pulse(pages: &mut Pages, path: &PulsePath, units: &Units) {
    let (d, v) = (path.definition(), units.speed);
    let speed = |m_s: f64| format!("{} {}", v.show(m_s), v.name);
    let (from_s, to_s) = path.pulse_span_s();
    pages.say("STRAIGHT TRAVEL, SLOWED BY A PULSE");
    pages.say(&format!("START          {}", pose(&d.initial, units)));
    pages.say(&format!("INITIAL SPEED  {}", speed(d.initial_speed_m_s)));
    pages.say(&format!("DIRECTION      {}", direction(&d.direction)));
    pages.say(&format!("PULSE          {}, FROM {from_s:.6} TO {to_s:.6} SEC", shape(&d.shape, units)));
    pages.say(&format!("PEAK           {} G", G.show(path.peak_deceleration_m_s2())));
    pages.say(&format!("DELTA-V        {}", speed(path.delta_v_m_s())));
    if let Some(rebound_m_s) = d.rebound_m_s {
        pages.say(&format!("REBOUND        {}", speed(rebound_m_s)));
    }
    if let Some(stop) = path.stop() {
        pages.say(&format!(
            "AT REST        AT {:.6} SEC AFTER {} {}",
            stop.time_s,
            units.length.show(stop.distance_m),
            units.length.name
        ));
    }
    if let PulseShape::Tabulated { points } = &d.shape {
        let mut table = Table::new("DECELERATION OVER TIME FROM THE START OF THE PULSE", "SEC | G");
        for point in points {
            table.row([format!("{:.6}", point.time_s), G.show(point.deceleration_m_s2)]);
        }
        table.write(pages);
    }
}

pub(crate) fn direction(direction: &TravelDirection) -> String {
    match *direction {
        TravelDirection::Heading => "NOSE FIRST".to_owned(),
        TravelDirection::Along(v) => {
            format!("ALONG {} (FORWARD, RIGHT, DOWN)", RATIO.point(v.into()))
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

fn shape(shape: &PulseShape, units: &Units) -> String {
    let strong = |strength: &Strength| match *strength {
        Strength::PeakDeceleration(a) => format!("PEAK {} G", G.show(a)),
        Strength::DeltaV(v) => format!("DELTA-V {} {}", units.speed.show(v), units.speed.name),
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

fn stations(pages: &mut Pages, path: &TablePath, units: &Units) {
    let between = match path.interpolation() {
        Interpolation::Linear => "STRAIGHT LINES",
        Interpolation::Spline => "NATURAL SPLINES",
    };
    let after = after(path.after());
    let mut table = Table::new(
        format!(
            "{} STATIONS, {between} BETWEEN THEM, {after} AFTER THE LAST ({}, DEG)",
            path.stations().len(),
            units.length.name
        ),
        "SEC | X FORWARD | Y RIGHT | Z DOWN | ROLL | PITCH | YAW",
    );
    for station in path.stations() {
        let a = &station.pose.attitude;
        let time = [format!("{:.6}", station.time_s)];
        let place = units.length.vector(station.pose.position_m);
        let angles = [a.roll_rad, a.pitch_rad, a.yaw_rad].map(|x| DEGREE.show(x));
        table.row(time.into_iter().chain(place).chain(angles));
    }
    table.write(pages);
}
