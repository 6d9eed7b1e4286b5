//! `occupant check`.

use occupant_core::diagnosis::{Diagnosis, OnShoulder, RK4_STABILITY_LIMIT, ShoulderBelt, diagnose};

use super::tables::check::check_text;
use crate::base::{Done, Failure, UnitsArg, say, talk};
use occupant_jobs::files::scenario::{self, ScenarioArgs, warn_of};
use occupant_scenario::Dimension;

/// Check a scenario and show what would be simulated
///
/// Exit code 1 if the time step is too long for the fastest part of the model.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scenario: ScenarioArgs,

    #[command(flatten)]
    units: UnitsArg,

    /// Also print masses and lengths of segments, friction, and time scales
    #[arg(long)]
    all: bool,

    /// Print JSON instead of tables, in SI units
    #[arg(long)]
    json: bool,

    /// Print only warnings and errors
    #[arg(short, long)]
    quiet: bool,
}

/// The JSON answer.
#[derive(serde::Serialize)]
struct Told<'a> {
    #[serde(flatten)]
    diagnosis: &'a Diagnosis,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    car: Vec<Dimension>,
}

pub(crate) fn check(args: &Args) -> Result<Done, Failure> {
    let opened = scenario::open(&args.scenario)?;
    if args.quiet {
        scenario::warn(&opened.warnings)
    } else {
        warn_of(&opened)
    }
    let mut diagnosis = diagnose(&opened.model);
    opened.loaded.compare_with_people(&mut diagnosis.body);
    let units = args.units.or(opened.loaded.scenario.units);
    if args.json {
        talk::print(&crate::base::json(&Told { diagnosis: &diagnosis, car: opened.loaded.dimensions() })?)?;
    } else if !args.quiet {
        talk::print(&check_text(&diagnosis, &opened.loaded.dimensions(), units, args.all))?;
    }
    for behind in &diagnosis.behind {
        say(&format!(
            "warning: the centre of {} starts {} behind {}: no contact until the sphere has come out",
            behind.sphere,
            units.say(behind.behind_m * 1e3, "mm", 1),
            behind.surface
        ));
    }
    for open in &diagnosis.open_ahead {
        say(&format!(
            "warning: the body of {} has no belt and nothing in front of it, but the vehicle loses {}: the head will strike nothing\n = help: add an instrument panel and a windscreen, or a belt",
            open.sphere,
            units.say(open.loss_m_s, "m/s", 1)
        ));
    }
    for lap in &diagnosis.lap_belts {
        say(&format!(
            "warning: belt {} pulls on {} at {:.0}° to the normal of the iliac wings; friction holds it only up to {:.0}°, so it slides up towards the abdomen (submarining)\n = help: move the anchors down and forward, or lean the pelvis back less; to model the sliding, use `lap = \"wings\"` of the preset three_point, or nodes with `wing`",
            lap.belt,
            lap.part,
            lap.angle_rad.to_degrees(),
            lap.held_rad.to_degrees()
        ));
    }
    diagnosis.shoulder_belts.iter().filter_map(off_shoulder).for_each(|message| say(&message));
    match too_long(&diagnosis) {
        Some(message) => {
            say(&format!("error: {message}"));
            Ok(Done::Unwell)
        }
        None => Ok(Done::Well),
    }
}

/// Warning about a shoulder belt that leaves the shoulder under load; none if it stays.
fn off_shoulder(own: &ShoulderBelt) -> Option<String> {
    let seen = match own.lies {
        OnShoulder::Bears => return None,
        OnShoulder::LiftedOff => {
            "lifts off the shoulder as it tightens: it will load only the chest\n = help: move the D-ring down or back"
        }
        OnShoulder::SlidOff => "slides off the shoulder towards the arm\n = help: move the D-ring or the buckle inward",
        OnShoulder::AtNeck => {
            "slides against the neck, which it does not load in the model\n = help: move the D-ring outward or down"
        }
    };
    Some(format!("warning: belt {} over {} {seen}", own.belt, own.part))
}

/// Error message of a step too long for the fastest time scale; none if it is stable.
pub(super) fn too_long(diagnosis: &Diagnosis) -> Option<String> {
    let (step_s, fastest) = (diagnosis.run.step_s?, diagnosis.fastest.as_ref()?);
    if diagnosis.step_is_stable() {
        return None;
    }
    Some(format!(
        "the step of {:.4} ms is too long for {} ({}), whose time scale is {:.4} ms\n = expected: a step below {:.4} ms\n = help: set a smaller `integrator.step`, use the adaptive integrator, or make that part softer",
        step_s * 1e3,
        fastest.of,
        fastest.by,
        fastest.time_scale_s * 1e3,
        fastest.time_scale_s * 1e3 * RK4_STABILITY_LIMIT,
    ))
}
