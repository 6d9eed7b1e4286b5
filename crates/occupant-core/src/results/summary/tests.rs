use super::*;
use crate::body::Body;
use crate::body::tti12::HEAD;
use crate::model::Model;
use crate::model::setup::Integrator;
use crate::results::peaks::Peaks;
use crate::results::recorder::{Flow, Recorder, RecorderError, Watch};
use crate::results::sample::Sample;
use crate::run::simulate::simulate;
use crate::tests::{crooked, hard, lowest_m};
use crash_measures::injury::Options;
use crash_measures::measure::Dummy;

fn falling(floor: Option<f64>, end_s: f64) -> Model {
    Model::new(crooked(end_s, floor.map(|height_m| (height_m, hard(0.5))))).unwrap()
}

/// Height of a floor in space 5 cm below the lowest sphere, m.
fn floor() -> Option<f64> {
    Some(lowest_m() - 0.05)
}

fn summary_of(model: &Model) -> Summary {
    let mut summarizer = Summarizer::new();
    assert_eq!(summarizer.summary(None), None);
    simulate(model, &mut summarizer).unwrap();
    summarizer.summary(None).unwrap()
}

#[test]
fn a_free_fall_feels_nothing_and_goes_half_g_t_squared() {
    let s = summary_of(&falling(None, 0.1));
    assert_eq!(s.status, RunStatus::Completed);
    assert_eq!((s.reached_s, s.solver.outputs), (0.1, 101));
    let e = s.head_excursion.unwrap();
    // measured: 1.4e-16 m
    assert!((e.down.value - 0.5 * 9.80665 * 0.01).abs() < 1e-12, "{}", e.down.value);
    assert_eq!(e.down.time_s, 0.1);
    assert_eq!(e.up.value, 0.0);
    assert!(e.forward.value < 1e-12 && e.left.value < 1e-12);
    for a in [s.accelerations.head, s.accelerations.chest, s.accelerations.pelvis] {
        // measured: 0 exactly, for the body falls as one
        assert!(a.peak_m_s2 < 1e-9 && a.three_ms_contiguous.unwrap().level_m_s2 < 1e-9);
    }
    assert!(s.contacts.is_empty() && s.sphere_forces.is_empty() && s.elements["belts"].rows.is_empty());
    assert_eq!(s.first_contacts.len(), 17);
    assert!(s.first_contacts.iter().all(|f| f.contact.is_none()));
    // measured: 1.7e-14
    assert!(s.energy.balance_error < 1e-12);
}

/// Keeps every head reading and every sphere force, as a plain list.
#[derive(Default)]
struct Everything {
    head: Vec<(f64, f64)>,
    forces: Vec<(usize, f64, f64)>,
}

impl Recorder for Everything {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        let reading = sample.specific_force_m_s2(HEAD);
        self.head.push((sample.time_s, reading.norm()));
        for sphere in 0..sample.model.body().spheres.len() {
            let force = sample.sphere_force_n(sphere).norm();
            self.forces.push((sphere, sample.time_s, force));
        }
        Ok(Flow::Continue)
    }
}

#[test]
fn peaks_are_those_of_the_whole_record() {
    let model = falling(floor(), 0.25);
    let (mut summarizer, mut all) = (Summarizer::new(), Everything::default());
    let outcome = simulate(&model, (&mut summarizer, &mut all)).unwrap();
    let s = summarizer.summary(Some(1.5)).unwrap();
    assert_eq!(s.solver.wall_time_s, Some(1.5));

    let greatest = all.head.iter().copied().fold((0.0, 0.0), |best, next| if next.1 > best.1 { next } else { best });
    let head = s.accelerations.head;
    // between two outputs the steps see more: measured 37.491 m/s² for 37.478, 0.5 ms later
    assert!(head.peak_m_s2 >= greatest.1 && head.peak_m_s2 < 1.001 * greatest.1, "{head:?} {greatest:?}");
    assert!((head.peak_time_s - greatest.0).abs() < model.setup().time.output_s);
    assert_eq!(head.peak_g, head.peak_m_s2 / 9.80665);
    // held longer than an instant means lower than the peak, and in total at least as high as in one piece
    let (held, total) = (head.three_ms_contiguous.unwrap(), head.three_ms_cumulative.unwrap());
    assert!(held.level_m_s2 <= total.level_m_s2 && total.level_m_s2 < head.peak_m_s2);
    assert!(held.to_s - held.from_s >= 0.003 - 1e-9);

    assert!(!s.sphere_forces.is_empty());
    for peak in &s.sphere_forces {
        let index = model.body().sphere(&peak.sphere).unwrap();
        let own = all.forces.iter().filter(|f| f.0 == index);
        let most = own.map(|f| f.2).fold(0.0, f64::max);
        // an output within a step may show a little more than its ends: measured 5e-5
        assert!(peak.force_n >= most * (1.0 - 2e-4) && peak.force_n < 1.05 * most, "{peak:?} against {most}");
        assert_eq!(peak.surface, "floor");
    }
    assert_eq!(s.contacts.len(), outcome.first_touches.len());
    assert!(s.contacts.iter().all(|c| !c.at_start && c.closing_m_s > 0.0));
    for first in s.first_contacts.iter().filter_map(|f| f.contact.as_ref()) {
        let earliest = s.contacts.iter().filter(|c| c.sphere == first.sphere);
        let earliest = earliest.map(|c| c.time_s).fold(f64::INFINITY, f64::min);
        assert_eq!(first.time_s, earliest);
    }
}

/// With steps of a fixed length, peaks of steps equal those of outputs at each step.
#[test]
fn peaks_of_steps_are_those_of_outputs_at_every_step() {
    let of = |output_s: f64| {
        let mut setup = crooked(0.25, floor().map(|height_m| (height_m, hard(0.5))));
        setup.integrator = Integrator::Rk4 { step_s: 5e-4 };
        setup.time.output_s = output_s;
        let model = Model::new(setup).unwrap();
        let (mut steps, mut outputs) = (Peaks::default(), Peaks::default());
        let watch = Watch(|s: &Sample<'_>| {
            if s.index == 0 {
                outputs = s.now.clone();
            }
            outputs.merge(s.now);
            steps = s.step_peaks.clone();
            // no step begins at the end
            steps.merge(s.now);
        });
        simulate(&model, watch).unwrap();
        (steps, outputs)
    };
    let ((steps, seldom), (_, always)) = (of(0.05), of(5e-4));
    // times of steps count from the output before, to the rounding
    let is_near = |(a, b): (&f64, &f64)| a == b || a.is_nan() && b.is_nan() || (a - b).abs() <= 1e-9 * b.abs();
    let [of_steps, of_outputs] = [&steps, &always].map(Peaks::numbers);
    let far: Vec<_> = of_steps.iter().zip(&of_outputs).filter(|pair| !is_near(*pair)).collect();
    assert!(far.is_empty(), "{far:?}");
    let passed =
        steps.parts.iter().zip(&seldom.parts).filter(|(step, output)| step.force.value > 1.02 * output.force.value);
    assert!(passed.count() > 0, "{steps:?} {seldom:?}");
}

#[test]
fn the_same_run_gives_the_same_summary_and_a_summarizer_can_be_used_again() {
    let model = falling(floor(), 0.2);
    let mut summarizer = Summarizer::new();
    simulate(&falling(None, 0.05), &mut summarizer).unwrap();
    simulate(&model, &mut summarizer).unwrap();
    assert_eq!(summarizer.summary(None).unwrap(), summary_of(&model));
}

/// Stops at an output.
struct StopAt(usize);

impl Recorder for StopAt {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        match sample.index >= self.0 {
            true => Ok(Flow::Stop),
            false => Ok(Flow::Continue),
        }
    }
}

#[test]
fn an_interrupted_run_says_so() {
    let model = falling(None, 0.1);
    let mut summarizer = Summarizer::new();
    simulate(&model, (StopAt(40), &mut summarizer)).unwrap();
    let s = summarizer.summary(None).unwrap();
    assert_eq!(s.status, RunStatus::Interrupted);
    assert!((s.reached_s - 0.04).abs() < 1e-15);
    assert_eq!((s.end_s, s.solver.outputs), (0.1, 41));
    assert!(s.reason.is_some());
}

#[test]
fn a_last_output_between_two_regular_times_does_not_bend_the_levels() {
    // the last interval is half as long as the others
    let model = falling(floor(), 0.2035);
    let s = summary_of(&model);
    assert_eq!(s.solver.outputs, model.output_count());
    assert_eq!(s.reached_s, 0.2035);
    let whole = summary_of(&falling(floor(), 0.203));
    // readings go on beyond the last regular output, so that a later window counts: measured 28.73 m/s² for 28.45
    let [longer, shorter] = [&s, &whole].map(|one| one.accelerations.head.three_ms_contiguous.unwrap());
    assert!(longer.level_m_s2 >= shorter.level_m_s2 && longer.to_s <= 0.2035 + 1e-9, "{longer:?} {shorter:?}");
    assert!(longer.level_m_s2 < 1.02 * shorter.level_m_s2, "{longer:?} {shorter:?}");
}

#[test]
fn nothing_grows_between_the_first_output_and_the_last() {
    let model = falling(floor(), 0.25);
    let mut summarizer = Summarizer::new();
    summarizer.begin(&model).unwrap();
    let before = room(&mut summarizer);
    simulate(&model, &mut summarizer).unwrap();
    assert_eq!(room(&mut summarizer), before);
}

#[test]
fn it_is_json_with_units_in_its_names() {
    let json = serde_json::to_value(summary_of(&falling(floor(), 0.2))).unwrap();
    assert_eq!(json["status"], "completed");
    assert!(json["accelerations"]["head"]["peak_g"].is_f64());
    assert!(json["contacts"][0]["closing_m_s"].is_f64());
    assert!(json["solver"]["wall_time_s"].is_null());
}

#[test]
fn the_list_of_figures_holds_the_summary_under_the_same_names_for_every_run() {
    let (free, floored) = (falling(None, 0.02), falling(floor(), 0.2));
    let (touched_nothing, fell) = (summary_of(&free), summary_of(&floored));
    let figures = fell.figures(&floored);
    let names = |figures: &[Figure]| figures.iter().map(|f| f.name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&touched_nothing.figures(&free)), names(&figures));
    let mut unique = names(&figures);
    unique.sort();
    unique.dedup();
    assert_eq!(unique.len(), figures.len());
    assert!(figures.iter().all(|f| !f.name.contains(char::is_whitespace) && !f.unit.is_empty()));

    let value = |name: &str| figures.iter().find(|f| f.name == name).unwrap().value;
    assert_eq!(value("head.peak"), Some(fell.accelerations.head.peak_m_s2));
    let level = fell.accelerations.chest.three_ms_cumulative.unwrap();
    assert_eq!(value("chest.three_ms_cumulative"), Some(level.level_m_s2));
    let down = fell.head_excursion.unwrap();
    assert_eq!(value("head_excursion.down"), Some(down.down.value));
    assert_eq!(value("solver.evaluations"), Some(fell.solver.evaluations as f64));
    // every force of the summary stands in the list; a sphere that touched nothing has none
    assert!(!fell.sphere_forces.is_empty());
    for sphere in &floored.body().spheres {
        let peak = fell.sphere_forces.iter().find(|p| p.sphere == sphere.name);
        let name = format!("contacts.{}.peak", sphere.name);
        assert_eq!(value(&name), Some(peak.map_or(0.0, |p| p.force_n)), "{name}");
        assert_eq!(value(&format!("{name}_time")), peak.map(|p| p.time_s));
    }
}

/// Room for outputs.
fn room(summarizer: &mut Summarizer) -> Vec<usize> {
    summarizer.people[0].signals.all_mut().map(|values| values.capacity()).collect()
}

#[test]
fn limits_of_another_dummy_are_marked() {
    let model = falling(floor(), 0.02);
    let caveats = |dummy| {
        let mut summarizer = Summarizer::judging(Options::default().with(dummy));
        simulate(&model, &mut summarizer).unwrap();
        summarizer.summary(None).unwrap().caveats
    };
    assert!(caveats(Dummy::HybridIii50M).iter().all(|caveat| caveat.name != "other_dummy"));
    let found = caveats(Dummy::HybridIii5F);
    let other = found.iter().find(|caveat| caveat.name == "other_dummy").unwrap();
    assert!(other.touches("nij") && other.text.contains("Hybrid III 5F of 49 kg"), "{}", other.text);
}

#[test]
fn a_balance_that_short_steps_would_keep_better_marks_every_figure() {
    use crate::results::energy::{Balance, EnergyCheck};
    let check = |balance_error| EnergyCheck {
        balance_error,
        reference: "largest kinetic energy relative to the vehicle",
        reference_j: 4403.0,
        greatest_kinetic_j: 4403.0,
        balance: Balance::Kept,
    };
    assert_eq!(Caveat::of_rough_balance(&check(9e-4)), None);
    let rough = Caveat::of_rough_balance(&check(7e-3)).unwrap();
    assert!(rough.touches("hic15") && rough.text.contains("0.70 %"), "{}", rough.text);
    // what is doubtful or lost says so already
    let lost = EnergyCheck { balance: Balance::Doubtful, ..check(0.05) };
    assert_eq!(Caveat::of_rough_balance(&lost), None);
}

#[test]
fn a_chest_pressed_in_too_far_marks_its_measures_and_no_other_ones() {
    let most = Peak { value: 0.14, time_s: 0.1 };
    let own = Caveat::pressed("driver.sternum", most, strokes::Known::Depth(0.24));
    for (figure, is_touched) in
        [("driver.cti", true), ("driver.chest_deflection", true), ("cti", false), ("driver.chest_peak", false)]
    {
        assert_eq!(own.touches(figure), is_touched, "{figure}");
    }
    assert!(!Caveat::pressed("flesh", most, strokes::Known::Last(0.1)).touches("chest_deflection"));
}

#[test]
fn a_head_on_something_rigid_marks_its_figures() {
    let struck = |sphere: &str, force_n: f64, penetration_m: f64| SpherePeak {
        sphere: sphere.to_owned(),
        force_n,
        time_s: 0.0,
        surface: "post".to_owned(),
        penetration_m,
        penetration_time_s: 0.0,
        thickness_used: 0.0,
    };
    let body = Body::male50();
    let found = Caveat::on_rigid(&body, &struck("head", 9e3, 1e-3)).unwrap();
    assert!(found.name == "head_on_rigid" && found.touches("hic15") && found.touches("nij"), "{found:?}");
    // a dummy's head on a steel plate, a light touch, another part
    for (sphere, force_n, penetration_m) in [("head", 11e3, 3e-3), ("head", 1e3, 1e-5), ("chest", 9e3, 1e-3)] {
        assert_eq!(Caveat::on_rigid(&body, &struck(sphere, force_n, penetration_m)), None);
    }
}
