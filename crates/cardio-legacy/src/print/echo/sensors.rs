//! A path from recorded motion.

use occupant_core::vehicle::{SensorGravity, SensorPath, SensorRecord};
use occupant_units::unit::Unit::{Metre, MetrePerSecond};

use super::path::{after, direction, pose};
use crate::print::unit::{degree, g};
use crate::print::{Pages, Table, Units};

/// Writes the options of the record, then the record.
pub(crate) fn write(pages: &mut Pages, path: &SensorPath, units: Units) {
    let (d, v) = (path.definition(), units.of(MetrePerSecond));
    let (from_s, to_s) = path.span_s();
    pages.say("RECORDED MOTION, INTEGRATED");
    pages.fact("START", pose(&d.initial, units));
    pages.fact("SPEED", format!("{}, {}", v.say(d.initial_speed_m_s), direction(&d.direction)));
    pages.fact("USED", format!("FROM {from_s:.6} TO {to_s:.6} SEC, {} AFTER THAT", after(d.after)));
    let (place, unit) = (units.of(Metre).point(d.offset_m), units.of(Metre).name());
    pages.fact("SENSORS", format!("{place} {unit} FROM THE CENTER OF GRAVITY (FORWARD, RIGHT, DOWN)"));
    if let SensorRecord::Accelerations(_) = d.record {
        let gravity = match d.gravity {
            SensorGravity::Included => "IN THE ACCELERATIONS",
            SensorGravity::Zeroed => "ZEROED AT THE START",
            SensorGravity::Removed => "REMOVED FROM THE ACCELERATIONS",
        };
        let filter = match d.filter {
            Some(class) => format!("CFC {:.0}", class.hertz()),
            None => "NONE".to_owned(),
        };
        let baseline = match d.baseline_s {
            Some(length_s) => format!("THE MEAN OF THE FIRST {length_s:.6} SEC TAKEN AWAY"),
            None => "NONE".to_owned(),
        };
        pages.fact("GRAVITY", gravity);
        pages.fact("FILTER", filter);
        pages.fact("BASELINE", baseline);
    }
    record(pages, &d.record, units);
}

/// Samples as read: accelerations in g, rates in deg/s, velocity changes in the printout's unit.
fn record(pages: &mut Pages, record: &SensorRecord, units: Units) {
    let (channels, v) = (record.channels(), units.of(MetrePerSecond));
    let heads: String = channels.iter().map(|(name, _)| format!("|{}", name.to_uppercase())).collect();
    let title = format!("{} SAMPLES AS READ (A IN G, W IN DEG/SEC, DV IN {})", record.time_s().len(), v.name());
    let mut table = Table::new(title, &format!("SEC{heads}"));
    for (i, time_s) in record.time_s().iter().enumerate() {
        let cells = channels.iter().map(|(name, samples)| match name.as_bytes() {
            [b'a', ..] => g().show(samples[i]),
            [b'w', ..] => degree().show(samples[i]),
            _ => v.show(samples[i]),
        });
        table.row(std::iter::once(format!("{time_s:.6}")).chain(cells));
    }
    table.write(pages);
}
