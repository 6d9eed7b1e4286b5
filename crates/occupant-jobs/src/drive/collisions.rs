//! Collisions of a vehicle and their effects.

use std::f64::consts::PI;

use occupant_scenario::Drives;
use serde::Serialize;
use vehicle_motion::GRAVITY_M_S2;
use vehicle_motion::body::Side;
use vehicle_motion::world::{Contact, Damage, Partner, Struck};

use crate::base::Units;
use crate::base::text_table::{Align, NONE, Table};

/// A collision, from one vehicle's point of view, SI.
#[derive(Clone, Debug, Serialize)]
pub struct Collision {
    /// Name of the partner.
    pub with: String,
    /// Time of the first contact, s.
    pub from_s: f64,
    /// Time of the last force, s.
    pub until_s: f64,
    /// Closing speed of the centres of gravity at first contact, m/s.
    pub closing_m_s: f64,
    /// Largest velocity change, m/s.
    pub delta_v_m_s: f64,
    /// Change of velocity along x, y, z of the vehicle, m/s.
    pub delta_v_axes_m_s: [f64; 3],
    /// Velocity change by the contact impulse alone, without the tyres: the delta-v of impact models, m/s.
    pub delta_v_contact_m_s: f64,
    /// Principal direction of force, clockwise from the front, −π to π, rad.
    pub pdof_rad: f64,
    /// Clock direction of the force, 12 from the front.
    pub clock: u8,
    /// Energy-equivalent speed, m/s.
    pub ees_m_s: f64,
    /// Largest acceleration, m/s²; infinite in an impact without duration.
    pub peak_m_s2: f64,
}

impl Collision {
    /// Whether it is an impact without duration.
    pub fn is_at_once(&self) -> bool {
        self.peak_m_s2.is_infinite()
    }
}

/// Least velocity change of a collision, by itself or with the tyres, m/s; cars that lean on each other stay below.
const LEAST_M_S: f64 = 0.5;

/// Collisions of a vehicle in the order of first contacts.
pub(super) fn of(drives: &Drives, number: usize) -> Vec<Collision> {
    let all = drives.outcome.contacts.iter().filter_map(|contact| one(drives, contact, number));
    all.filter(|own| own.delta_v_m_s.min(own.delta_v_contact_m_s) >= LEAST_M_S).collect()
}

fn one(drives: &Drives, contact: &Contact, number: usize) -> Option<Collision> {
    let (struck, partner) = side_of(contact, number)?;
    let (with, closing) = match partner {
        Partner::Car(other) => {
            let (theirs, _) = side_of(contact, other)?;
            (drives.vehicles[other].name.clone(), struck.enters_m_s - theirs.enters_m_s)
        }
        Partner::Barrier(barrier) => (drives.barriers[barrier].0.clone(), struck.enters_m_s),
    };
    let delta_v = struck.delta_v_m_s;
    let turn = (struck.pdof_rad + PI).rem_euclid(2.0 * PI) - PI;
    Some(Collision {
        with,
        from_s: contact.from_s,
        until_s: contact.until_s,
        closing_m_s: closing.norm(),
        delta_v_m_s: delta_v.norm(),
        delta_v_axes_m_s: delta_v.into(),
        delta_v_contact_m_s: struck.by_contact_m_s.norm(),
        pdof_rad: turn,
        clock: struck.clock,
        ees_m_s: struck.ees_m_s,
        peak_m_s2: struck.peak_m_s2,
    })
}

/// One vehicle's side of a contact, and its partner; none if it is not involved.
fn side_of(contact: &Contact, number: usize) -> Option<(Struck, Partner)> {
    let [first, second] = contact.struck;
    match contact.partner {
        partner if contact.car == number => Some((first?, partner)),
        Partner::Car(other) if other == number => Some((second?, Partner::Car(contact.car))),
        _ => None,
    }
}

/// The collisions as a table.
pub(super) fn text(collisions: &[Collision], units: Units) -> String {
    let mut table = Table::new(&[
        (Align::Left, &["collision with"]),
        (Align::Right, &["from, s", "until, s", "closing speed", "Δv", "ahead", "to the right", "without tyres"]),
        (Align::Right, &["PDOF, deg", "clock", "EES", "peak, g"]),
    ]);
    for own in collisions {
        let speed = |m_s: f64| units.say(m_s, "m/s", 2);
        table.row([
            own.with.clone(),
            format!("{:.3}", own.from_s),
            format!("{:.3}", own.until_s),
            speed(own.closing_m_s),
            speed(own.delta_v_m_s),
            speed(own.delta_v_axes_m_s[0]),
            speed(own.delta_v_axes_m_s[1]),
            speed(own.delta_v_contact_m_s),
            format!("{:.0}", own.pdof_rad.to_degrees()),
            own.clock.to_string(),
            speed(own.ees_m_s),
            if own.is_at_once() { NONE.to_owned() } else { format!("{:.1}", own.peak_m_s2 / GRAVITY_M_S2) },
        ]);
    }
    table.text()
}

/// Damage of a vehicle as a table: largest and residual crush, then residual depths C1 to C6 at equal distances over
/// each damaged side.
pub(super) fn damage_text(damage: &Damage, units: Units) -> String {
    let m = |value: f64| units.say(value, "m", 3);
    let mut table = Table::new(&[
        (Align::Left, &["damage"]),
        (Align::Right, &["from", "to", "C1", "C2", "C3", "C4", "C5", "C6", "mean"]),
    ]);
    for own in &damage.profiles {
        let cells = own.span_m.into_iter().chain(own.depths_m).chain([own.mean_m]).map(m);
        table.row([side_name(own.side).to_owned()].into_iter().chain(cells));
    }
    if damage.profiles.is_empty() {
        table.row(["none that stays".to_owned(), NONE.to_owned()]);
    }
    table.text()
}

/// Crush of a vehicle, as text.
pub(super) fn crush_words(damage: &Damage, units: Units) -> String {
    let m = |value: f64| units.say(value, "m", 3);
    let roof = if damage.roof_m > 0.0 { format!(", the roof by {}", m(damage.roof_m)) } else { String::new() };
    let [most, stays, ees] = [m(damage.dynamic_m), m(damage.residual_m), units.say(damage.ees_m_s, "m/s", 2)];
    format!("{most} dynamic, {stays} residual{roof}; EES {ees}")
}

pub(super) fn side_name(side: Side) -> &'static str {
    match side {
        Side::Front => "front",
        Side::Right => "right",
        Side::Rear => "rear",
        Side::Left => "left",
    }
}
