//! The flags of `occupant risk` in SI.

use crash_measures::signal::ChannelClass;
use occupant_scenario::kind::{ACCELERATION, ANGLE, ANGULAR_VELOCITY, KINDS, LENGTH, RATIO, TIME};
use occupant_study::risk::{Flight, Preparation, SensorErrors, VerticalGravity};

use super::Args;
use crate::base::Failure;
use occupant_jobs::import::PathFilter;

/// Preparation of the record.
pub(crate) fn preparation(args: &Args) -> Result<Preparation, Failure> {
    let interval_s = quantity("--interval", TIME, &args.interval)?;
    Ok(Preparation {
        filter: class(args).map(|class| (class, args.coefficients)),
        baseline_s: [
            quantity("--baseline", TIME, &args.baseline)?,
            quantity("--baseline-end", TIME, &args.baseline_end)?,
        ],
        interval_s: interval_s.map(|interval_s| positive("--interval", interval_s)).transpose()?,
        offset_m: offset(args.offset.as_deref())?,
        gravity: if args.gravity_included { VerticalGravity::Included } else { VerticalGravity::Removed },
        start_s: quantity("--start", TIME, &args.start)?,
        end_s: quantity("--to", TIME, &args.end)?,
    })
}

/// Filter class requested by --filter; a frequency smooths positions and does not change the class.
fn class(args: &Args) -> Option<ChannelClass> {
    match args.filter {
        None | Some(PathFilter::Frequency(_)) => ChannelClass::from_number(180),
        Some(PathFilter::None) => None,
        Some(PathFilter::Class(number)) => ChannelClass::from_number(number),
    }
}

/// Bounds of sensor errors.
pub(crate) fn errors(args: &Args) -> Result<SensorErrors, Failure> {
    let mut errors = SensorErrors::default();
    for text in &args.sensor_error {
        let refused = |found: &str| {
            let help = "give gain='1 %', offset='0.05 g', rate='0.2 deg/s', angle='1 deg' or place='20 mm'";
            Failure::with_help(format!("--sensor-error {text}: {found}"), help)
        };
        let (what, amount) = text.split_once('=').ok_or_else(|| refused("it has no `=`"))?;
        let (bound, kind) = match what.trim() {
            "gain" => (&mut errors.gain, RATIO),
            "offset" => (&mut errors.offset_m_s2, ACCELERATION),
            "rate" => (&mut errors.rate_rad_s, ANGULAR_VELOCITY),
            "angle" => (&mut errors.angle_rad, ANGLE),
            "place" => (&mut errors.place_m, LENGTH),
            other => return Err(refused(&format!("unknown name `{other}`"))),
        };
        let value =
            KINDS[kind].read(amount.trim()).map_err(|e| refused(&format!("{}; expected {}", e.found, e.expected)))?;
        if !(value >= 0.0 && value.is_finite()) {
            return Err(refused("the bound is below 0"));
        }
        *bound = value;
    }
    Ok(errors)
}

/// Flail distances and initial head position.
pub(crate) fn flight(args: &Args) -> Result<Flight, Failure> {
    let mut flight = Flight::default();
    if let Some(x_m) = quantity("--flail-x", LENGTH, &args.flail_x)? {
        flight.distances.longitudinal_m = positive("--flail-x", x_m)?;
        flight.head.forward_m = x_m;
    }
    if let Some(y_m) = quantity("--flail-y", LENGTH, &args.flail_y)? {
        flight.distances.lateral_m = positive("--flail-y", y_m)?;
        flight.head.sideways_m = y_m;
    }
    if let Some(x_m) = quantity("--head-start", LENGTH, &args.head_start)? {
        flight.head.start_x_m = x_m;
    }
    Ok(flight)
}

/// Quantity of a flag in SI; a bare number is in SI.
fn quantity(flag: &str, kind: usize, words: &Option<String>) -> Result<Option<f64>, Failure> {
    words.as_deref().map(|text| si(flag, kind, text)).transpose()
}

fn si(flag: &str, kind: usize, text: &str) -> Result<f64, Failure> {
    let text = text.trim();
    match KINDS[kind].read(text) {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(value) => Err(Failure::plain(format!("{flag} {text}: found {value}, expected a finite number"))),
        Err(error) => Err(Failure::plain(format!("{flag} {text}: {}, expected {}", error.found, error.expected))),
    }
}

fn positive(flag: &str, value: f64) -> Result<f64, Failure> {
    if value > 0.0 { Ok(value) } else { Err(Failure::plain(format!("{flag}: found {value}, expected more than 0"))) }
}

fn offset(words: Option<&str>) -> Result<[f64; 3], Failure> {
    let Some(words) = words else {
        return Ok([0.0; 3]);
    };
    let parts: Vec<&str> = words.split(',').collect();
    let [x, y, z] = parts[..] else {
        return Err(Failure::with_help(
            format!("--offset {words}: found {} lengths, expected 3", parts.len()),
            "give forward, right and down, such as --offset '-0.3 m,0,10 cm'",
        ));
    };
    let length = |text| si("--offset", LENGTH, text);
    Ok([length(x)?, length(y)?, length(z)?])
}
