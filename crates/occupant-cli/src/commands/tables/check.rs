//! The tables of `occupant check`.

use occupant_core::diagnosis::{Clearance, Diagnosis, OnShoulder, Rate, SeatStart, SegmentFigures, ShoulderBelt, Way};
use occupant_core::model::settle::Settled;
use occupant_core::model::setup::STANDARD_GRAVITY_M_S2;
use occupant_scenario::{Dimension, Size};
use placed_text::shown;

use super::elements;
use super::summary::Marks;
use crate::base::Units;
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{NONE, facts, table, trimmed};

/// Missing joint moment below which a posture counts as held, N·m.
const LEAST_LACK_N_M: f64 = 1.0;

/// Overview before a run; with `all` also segments, friction, corners, self-contact and time scales.
pub(crate) fn check_text(d: &Diagnosis, car: &[Dimension], units: Units, all: bool) -> String {
    let mut parts = vec![format!("{}\n", shown(&d.title)), overview(d, units)];
    if all {
        parts.push(segments(d, units));
    }
    parts.extend(d.body.weak.map(|words| format!("note: {words}\n")));
    if let Some(seat) = &d.seat {
        parts.push(seating(seat, units));
    }
    if !car.is_empty() {
        parts.push(dimensions(car, units));
    }
    if !d.clearances.is_empty() {
        parts.push(clearances(d, units));
    }
    if !d.shoulder_belts.is_empty() {
        parts.push(shoulders(d));
    }
    parts.push(contacts(d, units));
    if all {
        parts.extend(surroundings(d, units));
    }
    parts.extend(elements::texts(&d.elements, &Marks::default(), units));
    if all {
        parts.push(sphere_rates(d, units));
        parts.extend((!d.other_rates.is_empty()).then(|| other_rates(d)));
    }
    parts.push(verdict(d));
    if !all {
        parts.push("segments, friction and time scales: add --all\n".to_owned());
    }
    parts.join("\n")
}

/// Friction of materials, open corners, and contacts within the body.
fn surroundings(d: &Diagnosis, units: Units) -> Vec<String> {
    let mut parts = Vec::new();
    parts.extend((!d.friction.is_empty()).then(|| friction(d, units)));
    parts.extend((!d.corners.is_empty()).then(|| corners(d)));
    if !d.self_contact.is_empty() {
        let rows = d.self_contact.iter().map(|(part, others)| [part.clone(), others.join(", ")]);
        parts.push(table(&[(Left, &["part of the body", "can touch"])], rows));
    }
    parts
}

fn overview(d: &Diagnosis, units: Units) -> String {
    let (run, vehicle) = (&d.run, &d.vehicle);
    let step = match run.step_s {
        Some(step_s) => format!("{}, step {} ms", run.integrator, trimmed(step_s * 1e3, 4)),
        None => format!("{}, step under error control", run.integrator),
    };
    let speed = |m_s| units.say(m_s, "m/s", 3);
    let pulse = vehicle.pulse.map_or_else(String::new, |[peak_m_s2, duration_s]| {
        format!(", peak {} g over {} ms", trimmed(peak_m_s2 / STANDARD_GRAVITY_M_S2, 1), trimmed(1e3 * duration_s, 1))
    });
    facts(&[
        (
            "occupant",
            format!(
                "{}: {} in {} segments, {} degrees of freedom, {} contact spheres",
                d.body.name,
                units.say(d.body.mass_kg, "kg", 2),
                d.body.segments.len(),
                d.body.degrees_of_freedom,
                d.body.spheres
            ),
        ),
        (
            "vehicle",
            format!(
                "{} path: {} at the start, {} at the end, velocity change {}{pulse}; {} surfaces",
                vehicle.path,
                speed(vehicle.start_speed_m_s),
                speed(vehicle.end_speed_m_s),
                speed(vehicle.velocity_change_m_s),
                d.surfaces
            ),
        ),
        (
            "run",
            format!(
                "{} to {} ms, {} outputs every {} ms, {step}",
                trimmed(run.start_s * 1e3, 4),
                trimmed(run.end_s * 1e3, 4),
                run.outputs,
                trimmed(run.output_s * 1e3, 4)
            ),
        ),
        ("gravity", units.say(run.gravity_m_s2, "m/s²", 5)),
    ])
}

fn segments(d: &Diagnosis, units: Units) -> String {
    let all = &d.body.segments;
    let heads = ["mass, kg", "length, m", "5–95 % range, m"].map(|head| units.heading(head));
    let length = |m| units.number(m, "m", 4);
    let has_bands = all.iter().any(|s| s.length_band_m.is_some());
    let columns: Vec<&str> = heads.iter().take(if has_bands { 3 } else { 2 }).map(String::as_str).collect();
    let row = |s: &SegmentFigures| {
        let band =
            s.length_band_m.map_or(NONE.to_owned(), |[least, most]| format!("{} to {}", length(least), length(most)));
        let cells = [s.segment.to_owned(), units.number(s.mass_kg, "kg", 3), length(s.length_m), band];
        cells.into_iter().take(1 + columns.len()).collect::<Vec<_>>()
    };
    table(&[(Left, &["segment"]), (Right, &columns)], all.iter().map(row))
}

fn seating(seat: &SeatStart, units: Units) -> String {
    let place = |p: [f64; 3]| {
        let [x, y, z] = p.map(|m| units.number(m, "m", 4));
        format!("({x}, {y}, {z}) {} in the vehicle", units.symbol("m"))
    };
    let mm = |m: f64| units.say(m * 1e3, "mm", 1);
    let mut lines = vec![
        ("seated on", format!("{}, {}", seat.cushion, seat.back)),
        ("pelvis", format!("centre at {}, sinks {} into the cushion", place(seat.pelvis_m), mm(seat.sink_m))),
        ("left knee", format!("at {}", place(seat.left_knee_m))),
        ("legs", format!("thighs lean {:.1}°, lower legs {:.1}°", seat.thighs_deg, seat.lower_legs_deg)),
    ];
    if let Some(s) = &seat.settled {
        lines.push((
            "settled",
            format!(
                "moved {} and turned {:.2}°; residual {} and {}, weight {}",
                mm(s.moved_m),
                s.turned_rad.to_degrees(),
                units.say(s.residual_force_n, "N", 2),
                units.say(s.residual_moment_n_m, "N·m", 2),
                units.say(s.weight_n, "N", 1)
            ),
        ));
    }
    if let Some(lack) = seat.settled.and_then(|s| s.lack).filter(|lack| lack.moment_n_m > LEAST_LACK_N_M) {
        let joint = lack.joint.replace('_', " ");
        let words = format!(
            "note: without muscles the posture is not in balance, {joint} lacks {}: the body sags slowly as the run begins; ",
            units.say(lack.moment_n_m, "N·m", 1)
        );
        lines.push(("joints", words + "to avoid it, add muscles with tone, or set posture.limp = true"));
    }
    if let Some(s) = seat.unsettled.filter(Settled::is_unbalanced) {
        let left = [s.residual_force_n, s.weight_n].map(|n| units.say(n, "N", 0));
        let left = format!("a force of {} (weight {})", left[0], left[1]);
        lines.push((
            "unsettled",
            format!("{left} is unbalanced and disturbs the first 50 ms; set posture.settle = true"),
        ));
    }
    facts(&lines)
}

/// All distances of a car written with `[car]`.
fn dimensions(car: &[Dimension], units: Units) -> String {
    let row = |own: &Dimension| {
        let vehicle = own.vehicle.as_ref().map_or(String::new(), |vehicle| format!("vehicles.{vehicle}."));
        let size = match own.size {
            Size::Distance(m) => units.say(m * 1e3, "mm", 0),
            Size::Angle(rad) => format!("{:.1}°", rad.to_degrees()),
            Size::Force(n) => units.say(n, "N", 0),
            Size::Moment(n_m) => units.say(n_m, "N·m", 0),
            Size::Word(ref word) => word.clone(),
        };
        let code = if own.code.is_empty() { NONE } else { own.code };
        // a name of several words is no key
        let of = if own.name.contains(' ') { "" } else { "car." };
        [format!("{vehicle}{of}{}", own.name), size, code.to_owned()]
    };
    table(&[(Left, &["of the car"]), (Right, &["size"]), (Left, &["SAE J1100"])], car.iter().map(row))
}

/// Clearances in front of the body and above it.
fn clearances(d: &Diagnosis, units: Units) -> String {
    let row = |own: &Clearance| {
        let way = if own.way == Way::Up { "up" } else { "forward" };
        [own.sphere.clone(), way.to_owned(), own.surface.clone(), units.number(own.distance_m * 1e3, "mm", 0)]
    };
    let free = units.heading("clearance, mm");
    let columns = [(Left, &["from", "direction", "first obstacle"][..]), (Right, &[free.as_str()][..])];
    table(&columns, d.clearances.iter().map(row))
}

/// Position of belts on the shoulders.
fn shoulders(d: &Diagnosis) -> String {
    let row = |own: &ShoulderBelt| {
        let lies = match own.lies {
            OnShoulder::Bears => "on the shoulder",
            OnShoulder::AtNeck => "against the neck",
            OnShoulder::SlidOff => "slides off",
            OnShoulder::LiftedOff => "lifts off the shoulder",
        };
        [own.belt.clone(), own.part.clone(), format!("{:.0} %", 100.0 * own.share), lies.to_owned()]
    };
    let columns =
        [(Left, &["shoulder belt", "over"][..]), (Right, &["from neck to arm"][..]), (Left, &["under load"][..])];
    table(&columns, d.shoulder_belts.iter().map(row))
}

fn contacts(d: &Diagnosis, units: Units) -> String {
    if d.contacts.is_empty() {
        return "nothing touches at the start\n".to_owned();
    }
    let rows = d.contacts.iter().map(|c| {
        let [depth, force] = [units.number(c.depth_m * 1e3, "mm", 2), units.number(c.normal_force_n, "N", 1)];
        let [rubs, fully] = [c.friction_n, c.full_friction_n].map(|n| units.number(n, "N", 1));
        [c.sphere.clone(), c.surface.clone(), depth, force, rubs, fully]
    });
    let heads = ["depth, mm", "force, N", "friction, N", "when sliding, N"].map(|head| units.heading(head));
    let heads = heads.each_ref().map(String::as_str);
    table(&[(Left, &["touches at the start", "surface"]), (Right, &heads)], rows)
}

/// Regularised friction: speeds at which it is nearly full, and creep on a slope.
fn friction(d: &Diagnosis, units: Units) -> String {
    let heads =
        ["friction", "speed of 71 % friction, m/s", "creep on a 10° slope, m/s"].map(|head| units.heading(head));
    let heads = heads.each_ref().map(String::as_str);
    let rows = d.friction.iter().map(|f| {
        let speed = |m_s: f64| units.number(m_s, "m/s", 3);
        let creeps = f.creeps_m_s.map_or("slides".to_owned(), speed);
        [f.material.clone(), trimmed(f.coefficient, 3), speed(f.speed_m_s), creeps]
    });
    let note = "friction grows with sliding speed and never sticks; a smaller `friction_speed` is closer to sticking, but needs shorter steps\n";
    table(&[(Left, &["material"]), (Right, &heads)], rows) + note
}

/// Open convex corners of surfaces, around which a sphere may move.
fn corners(d: &Diagnosis) -> String {
    let rows = d.corners.iter().cloned();
    let note = "a sphere that moves around such a corner passes through without force; a solid stops it\n";
    table(&[(Left, &["convex corner of", "and"])], rows) + note
}

fn sphere_rates(d: &Diagnosis, units: Units) -> String {
    let heads = ["effective mass, kg", "slope, kN/m", "time scale, ms", "step/time scale", "friction stable to, N"];
    let heads = heads.map(|head| units.heading(head));
    let heads = heads.each_ref().map(String::as_str);
    let rows = d.sphere_rates.iter().map(|s| {
        let r = &s.rate;
        // a held part has infinite effective mass
        let mass = if r.effective.is_finite() { units.number(r.effective, "kg", 3) } else { NONE.to_owned() };
        let slope = units.number(r.coefficient / 1e3, "kN/m", 1);
        let limit = s.friction_limit_n.map_or(NONE.to_owned(), |n| units.number(n, "N", 0));
        [r.of.clone(), r.by.clone(), mass, slope, time_scale(r), by_step(d, r), limit]
    });
    table(&[(Left, &["sphere", "stiffest material"]), (Right, &heads)], rows)
}

fn other_rates(d: &Diagnosis) -> String {
    let rows = d.other_rates.iter();
    let rows = rows.map(|r| [r.of.clone(), r.by.clone(), time_scale(r), by_step(d, r)]);
    table(&[(Left, &["belt or joint", ""]), (Right, &["time scale, ms", "step/time scale"])], rows)
}

/// Time scale in ms; none if both parts are held and cannot move.
fn time_scale(rate: &Rate) -> String {
    if rate.time_scale_s.is_finite() { format!("{:.3}", rate.time_scale_s * 1e3) } else { NONE.to_owned() }
}

fn by_step(d: &Diagnosis, rate: &Rate) -> String {
    let step_s = d.run.step_s.filter(|_| rate.time_scale_s.is_finite());
    step_s.map_or(NONE.to_owned(), |h| format!("{:.3}", h / rate.time_scale_s))
}

fn verdict(d: &Diagnosis) -> String {
    let Some(fastest) = d.fastest.as_ref().filter(|fastest| fastest.time_scale_s.is_finite()) else {
        return "no contact, belt or joint sets a time scale\n".to_owned();
    };
    let scale = format!("fastest time scale: {:.4} ms ({}, {})", fastest.time_scale_s * 1e3, fastest.of, fastest.by);
    match d.step_by_time_scale {
        Some(number) => {
            format!("{scale}; step/time scale {number:.3}, must be below 2.8\n")
        }
        None => format!("{scale}; the error control chooses the step\n"),
    }
}
