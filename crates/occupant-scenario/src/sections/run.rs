//! `[time]`, `[integrator]` and `[output]`: their keys, converted to [`TimeSpan`], [`Integrator`] and
//! [`OutputOptions`].

use schemars::{JsonSchema, Schema};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::builder::Builder;
use super::markers::markers;
use super::quantity::{NOT_NEGATIVE, POSITIVE, si_or};
use super::{Length, Ratio, Scenario, Speed, Time};
use occupant_core::body::Body;
use occupant_core::model::accuracy::Accuracy;
use occupant_core::model::setup::{Allowance, DEFAULT_OUTPUT_S, Integrator, OutputOptions, TimeSpan};
use placed_text::number;

/// Start and end of the run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TimeSection {
    /// Start; 0 if absent.
    pub(crate) start: Option<Time>,
    /// End.
    pub(crate) end: Time,
    /// True: the run ends early, once every body has had less than 1e-4 of its peak kinetic energy (in space) for 0.2
    /// s. False if absent.
    pub(crate) stop_at_rest: Option<bool>,
    /// Largest number of evaluations of the equations of motion; a run that needs more ends as failed. No limit if absent. In a
    /// study it keeps single samples from holding up the others.
    #[schemars(extend("minimum" = 1))]
    pub(crate) max_evaluations: Option<u64>,
    /// Longest wall time of the run, after which it ends as failed. Which runs it ends depends on the machine; `max_evaluations`
    /// does not. No limit if absent.
    pub(crate) max_wall_time: Option<Time<POSITIVE>>,
}

/// Recorded outputs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct OutputSection {
    /// Output interval; 1 ms if absent.
    pub(crate) interval: Option<Time<POSITIVE>>,
    /// True: also record the coordinates q₁…q₃₁ of the 1970 report and their rates. False if absent.
    pub(crate) report_coordinates: Option<bool>,
}

/// Time integration of the equations of motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
#[schemars(transform = kind_goes_without_saying)]
pub(crate) enum IntegratorSection {
    /// The classical fourth-order Runge–Kutta method with a fixed step, as in the 1970 report.
    Rk4 {
        /// Time step.
        step: Time<POSITIVE>,
    },
    /// An embedded 3(2) Runge–Kutta pair with adaptive step.
    Adaptive(Box<AdaptiveSection>),
}

/// A table with an accuracy needs no `kind`.
fn kind_goes_without_saying(schema: &mut Schema) {
    let cases = schema.get_mut("oneOf").and_then(Value::as_array_mut).into_iter().flatten();
    for case in cases.filter_map(Value::as_object_mut) {
        if case.get("properties").is_some_and(|keys| keys.get("accuracy").is_some()) {
            case.remove("required");
            case.insert("anyOf".to_owned(), json!([{ "required": ["kind"] }, { "required": ["accuracy"] }]));
        }
    }
}

/// Settings of "adaptive".
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "x-at-most-one" = [["accuracy", "relative"], ["accuracy", "absolute_length"], ["accuracy", "absolute_speed"]],
))]
pub(crate) struct AdaptiveSection {
    /// Allowed integration error of the head's path and of peaks: "survey" (1 mm, 0.5 %), "engineering" (0.1 mm, 0.1 %)
    /// or "reference" (a thousandth of that). Sets the tolerances for the length of the run. "engineering" if neither
    /// this nor a tolerance is given.
    pub(crate) accuracy: Option<Accuracy>,
    /// Relative tolerance of velocities; 3e-8 if absent and another tolerance is given.
    pub(crate) relative: Option<Ratio<NOT_NEGATIVE>>,
    /// Absolute tolerance of positions; 3e-9 m if absent and another tolerance is given.
    pub(crate) absolute_length: Option<Length<POSITIVE>>,
    /// Absolute tolerance of velocities; 3e-7 m/s if absent and another tolerance is given.
    pub(crate) absolute_speed: Option<Speed<POSITIVE>>,
    /// Smallest step, also the first one; 1e-10 s if absent, 1e-12 s with accuracy "reference".
    pub(crate) min_step: Option<Time<POSITIVE>>,
    /// Largest step. If absent, 0.5 ms in a run of up to 0.35 s without tolerances, else 2 ms.
    pub(crate) max_step: Option<Time<POSITIVE>>,
}

/// Start, end and output interval.
pub(super) fn time(b: &mut Builder, s: &Scenario) -> TimeSpan {
    let span = TimeSpan {
        start_s: si_or(&s.time.start, 0.0),
        end_s: s.time.end.si(),
        output_s: s.output.as_ref().map_or(DEFAULT_OUTPUT_S, |o| si_or(&o.interval, DEFAULT_OUTPUT_S)),
        stops_at_rest: s.time.stop_at_rest.unwrap_or(false),
        allowance: Allowance {
            evaluations: s.time.max_evaluations.unwrap_or(u64::MAX),
            wall_time_s: si_or(&s.time.max_wall_time, f64::INFINITY),
        },
    };
    if span.end_s <= span.start_s {
        let found = format!("a run from {} s to {} s", number(span.start_s), number(span.end_s));
        b.error("time.end", found, "an end after the start");
    }
    span
}

/// The integrator, with given tolerances, or those of an accuracy over the length of the run.
pub(super) fn integrator(b: &mut Builder, s: &Scenario, time: &TimeSpan) -> Integrator {
    let asked = |accuracy: Option<Accuracy>| accuracy.unwrap_or_default().integrator(time.end_s - time.start_s);
    let a = match &s.integrator {
        None => return asked(None),
        Some(IntegratorSection::Rk4 { step }) => return Integrator::Rk4 { step_s: step.si() },
        Some(IntegratorSection::Adaptive(a)) => a,
    };
    let is_written = a.relative.is_some() || a.absolute_length.is_some() || a.absolute_speed.is_some();
    let mut integrator = if is_written { Integrator::default() } else { asked(a.accuracy) };
    if let Integrator::Adaptive { relative, absolute_m, absolute_m_s, min_step_s, max_step_s } = &mut integrator {
        *relative = si_or(&a.relative, *relative);
        *absolute_m = si_or(&a.absolute_length, *absolute_m);
        *absolute_m_s = si_or(&a.absolute_speed, *absolute_m_s);
        *min_step_s = si_or(&a.min_step, *min_step_s);
        *max_step_s = si_or(&a.max_step, *max_step_s);
        if max_step_s < min_step_s {
            let found = format!("a largest step of {max_step_s} s below the smallest, {min_step_s} s");
            b.error("integrator.max_step", found, "min_step ≤ max_step");
        }
    }
    integrator
}

/// Extra outputs.
pub(super) fn output(b: &mut Builder, s: &Scenario, body: &Body) -> OutputOptions {
    OutputOptions {
        report_coordinates: s.output.as_ref().and_then(|o| o.report_coordinates) == Some(true),
        markers: markers(b, &s.markers, body),
        readings_s: None,
    }
}
