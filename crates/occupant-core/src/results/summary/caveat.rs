//! Caveats: which figures of a run should not be quoted, and why. All their texts are here.

use crash_measures::injury::Measure;
use crash_measures::measure::Dummy;
use serde::Serialize;

use super::strokes::{Beyond, Known};
use super::{Ejection, Exit, Peak, RunStatus, SpherePeak, Summary, Throw, word};
use crate::body::{Body, Chest, ContactSphere, Joint, Limb, Segment, Sides};
use crate::forces::chain::{Chain, Site};
use crate::forces::rate::Rate;
use crate::model::settle::Settled;
use crate::results::energy::{Balance, EnergyCheck};

/// Energy error above which steps are too long: with short enough steps, runs of every kind stay below it, as a rule at
/// 1e-4 or less.
const ROUGH: f64 = 1e-3;
/// Longest output interval, plus rounding, s, for which peaks of forces, depths and positions at outputs are exact
/// enough.
const APART_S: f64 = 2e-3 + 1e-9;
/// Force of a head impact, N, and a stiffness above that of any head, N/m: a dummy's head on a steel plate has 3.7 MN/m
/// in 49 CFR 572.32.
const HEAD_STRUCK_N: f64 = 2000.0;
const RIGID_N_M: f64 = 5e6;
/// Results that are peaks of this kind.
const PEAKS: [&str; 6] = ["belts.*", "straps.*", "joints.*", "muscles.*", "contacts.*", "head_excursion.*"];

/// Reason why some results of a run should not be quoted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Caveat {
    /// Identifier for tables of many runs, such as `neck_beyond_stop`.
    pub name: String,
    /// Finding, and the results that it affects.
    pub text: String,
    /// Names of the results and measures; a final `*` matches any ending.
    pub figures: Vec<String>,
}

impl Caveat {
    /// Name of the caveat for invalid results.
    pub const BALANCE_LOST: &str = "energy_balance_lost";
    /// Name of the caveat for results of a part of a run.
    pub const PART: &str = "part_of_a_run";
    /// Name of the caveat on ejections, which applies to a single run.
    pub const CHANCE: &str = "ejection_by_chance";

    fn new(name: impl Into<String>, text: String, figures: Vec<String>) -> Self {
        Caveat { name: name.into(), text, figures }
    }

    /// Whether it affects the result or measure with this name.
    pub fn touches(&self, figure: &str) -> bool {
        self.figures.iter().any(|of| of.strip_suffix('*').map_or(of == figure, |stem| figure.starts_with(stem)))
    }

    /// Whether it affects no particular result: a note on the uncertainty of the model.
    pub fn is_note(&self) -> bool {
        self.figures.is_empty()
    }

    /// The same for one of several occupants, whose name precedes those of its results.
    pub(super) fn of_occupant(self, name: &str) -> Self {
        let figures =
            self.figures.iter().map(|figure| if name.is_empty() { figure.clone() } else { format!("{name}.{figure}") });
        Caveat { figures: figures.collect(), ..self }.with_subject(name)
    }

    /// The same with the subject in its text; its results have the subject's names.
    pub(super) fn with_subject(self, name: &str) -> Self {
        if name.is_empty() { self } else { Caveat { text: format!("{name}: {}", self.text), ..self } }
    }

    /// Run that did not complete; none for one that did.
    pub(super) fn of_ending(status: RunStatus, reached_s: f64) -> Option<Self> {
        let (name, ended) = match status {
            RunStatus::Completed => return None,
            RunStatus::Interrupted => ("run_interrupted", "was interrupted"),
            RunStatus::Failed => ("run_failed", "failed"),
        };
        let text = format!("the run {ended}: all results are up to {:.1} ms", 1e3 * reached_s);
        Some(Caveat::new(name, text, owned(&["*"])))
    }

    /// Body still in motion at the end of the run.
    pub(super) fn not_at_rest(body: &str, throw: &Throw) -> Option<Self> {
        let figures = ["distance", "slide_distance", "from_launch", "height"].map(|name| format!("throw.{name}"));
        let text = format!(
            "thrown, and still moving at {:.1} m/s when the run ends: throw distances are those so far",
            throw.end_speed_m_s
        );
        (!throw.at_rest).then(|| Caveat::new("not_at_rest", text, figures.to_vec()).of_occupant(body))
    }

    /// Results of a part of a run only.
    pub(super) fn of_part(text: String) -> Self {
        Caveat::new(Self::PART, text, owned(&["*"]))
    }

    /// Quantities that a resumed run counts from its own start, `from_s`.
    pub(super) fn of_rest(from_s: f64, summary: &Summary) -> Self {
        let text = format!(
            "the file resumes a run at {:.1} ms: peaks and measures cover the whole run, but events, throws, ejections and other caveats only the time from there on",
            1e3 * from_s
        );
        let prefix = |name: &&str| if name.is_empty() { String::new() } else { format!("{name}.") };
        let figures = summary.throws.keys().map(|name| format!("{}throw.*", prefix(name)));
        Caveat::new(Self::PART, text, figures.collect())
    }

    /// Energy error above 1 %; none below.
    pub(super) fn of_balance(energy: &EnergyCheck) -> Option<Self> {
        let (name, means) = match energy.balance {
            Balance::Kept => return None,
            Balance::Doubtful => ("energy_balance_doubtful", "the results are doubtful"),
            Balance::Lost => (Caveat::BALANCE_LOST, "the results mean nothing"),
        };
        Some(Caveat::new(name, format!("the energy balance is {}: {means}", energy.found()), owned(&["*"])))
    }

    /// Energy error below 1 % but above that of short enough steps; none below both.
    pub(super) fn of_rough_balance(energy: &EnergyCheck) -> Option<Self> {
        let is_rough = energy.balance == Balance::Kept && energy.balance_error > ROUGH;
        let text = format!(
            "the energy balance is off by {:.2} % of the {}; short enough steps keep it within {:.1} %. Results may depend on the step: use a shorter step or error control, or check them with --estimate-error",
            1e2 * energy.balance_error,
            energy.reference,
            1e2 * ROUGH
        );
        is_rough.then(|| Caveat::new("energy_balance_rough", text, owned(&["*"])))
    }

    /// Fixed step longer than `most` time scales: `rates` are those that are too fast for it, of spheres in contact and
    /// of all other elements; none without any.
    pub fn step_too_long(step_s: f64, most: f64, rates: &[&Rate], summary: &Summary) -> Option<Self> {
        let is_sphere = |rate: &Rate| summary.first_contacts.iter().any(|first| first.sphere == rate.of);
        let touched =
            |rate: &Rate| summary.contacts.iter().any(|contact| contact.sphere == rate.of || contact.part == rate.of);
        let acted = rates.iter().filter(|rate| !is_sphere(rate) || touched(rate));
        let worst = acted.min_by(|a, b| a.time_scale_s.total_cmp(&b.time_scale_s))?;
        let text = format!(
            "the step of {:.4} ms is {:.1} times the time scale of {} ({}); the limit is {most} times. Results depend on the step",
            1e3 * step_s,
            step_s / worst.time_scale_s,
            worst.of,
            worst.by
        );
        Some(Caveat::new("step_too_long", text, owned(&["*"])))
    }

    /// Chatter of a sphere by friction on a surface, with a fixed step that is too long.
    pub fn chatters(sphere: &str, surface: &str, step_s: f64, time_s: f64) -> Self {
        let text = format!(
            "friction of {sphere} on {surface} is too stiff for the step of {:.4} ms at {:.1} ms: the sphere may chatter, and later results depend on the step. Use a shorter step or error control, or check them with --estimate-error",
            1e3 * step_s,
            1e3 * time_s
        );
        Caveat::new("friction_chatters", text, owned(&["*"]))
    }

    /// Results that change with finer integration, by name with the relative change; none without any.
    pub fn undetermined(against: &str, changed: &[(String, f64)], figures: Vec<String>) -> Option<Self> {
        let (name, part) = changed.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let text = format!(
            "{} results are not determined: with {against}, {name} differs by {:.0} %; quote only results that are stable in an ensemble (--ensemble)",
            changed.len(),
            1e2 * part
        );
        Some(Caveat::new("undetermined", text, figures))
    }

    /// Body not at rest at the start, and its results of the first 50 ms.
    pub(super) fn unbalanced(left: &Settled, early: Vec<String>) -> Self {
        let text = format!(
            "the body is not in balance at the start: a force of {:.0} N is left over (weight {:.0} N), so results of the first {:.0} ms show how it settles. Set posture.settle = true, or move the surfaces so that they just carry it",
            left.residual_force_n,
            left.weight_n,
            1e3 * Settled::FADES_S
        );
        Caveat::new("start_unbalanced", text, early)
    }

    /// Joint turned to `turned`, beyond the end of a stop.
    pub(super) fn beyond_stop(body: &Body, joint: Joint, turned: &Turned) -> Self {
        let row = &body.tree[joint];
        let is_neck = body.tree.landmarks_at(row.distal).neck == Some(joint);
        let neck = ["nij", "neck_*"].map(|figure| format!("{}{figure}", prefix(body, row.distal)));
        let figures = if is_neck { neck.to_vec() } else { figures_of(body, row.distal) };
        let [angle, stop] = [turned.angle_rad, turned.stop_rad].map(f64::to_degrees);
        let (at, name) = (at(turned.beyond), row.name.replace('_', " "));
        let seen = if turned.is_elastic {
            format!("{angle:.0}° beyond its elastic limit {at}; {stop:.0}° is the most that is meaningful")
        } else {
            format!("{angle:.0}° {at}, the stop ends at {stop:.0}°")
        };
        let text = format!("{name} beyond its stop: {seen}; {}", not_to_be_quoted(&name));
        Caveat::new(format!("{}_beyond_stop", row.name), text, figures)
    }

    /// Neck of one joint with the limit of one of two neck joints.
    pub(super) fn half_a_neck() -> Self {
        let text = "a one-joint neck with the limits of a two-joint one (preset gebod or person): 218 and 178 N·m at 52° and 44°, instead of 88 to 108 N·m at 64° to 78° in the pendulum test of 49 CFR 572.33. Do not quote neck results";
        Caveat::new("neck_of_gebod", text.to_owned(), owned(&["nij", "neck_*"]))
    }

    /// Sphere that overlapped a surface by `overlap` without force.
    pub(super) fn passed(body: &Body, sphere: usize, surface: &str, overlap: Peak) -> Self {
        let seen = format!("passed {} deep through {surface} {} without force", mm(overlap.value), at(overlap));
        Caveat::of_sphere(body, sphere, "passed", seen)
    }

    /// Penetration of a surface beyond any real deformation.
    pub(super) fn too_deep(body: &Body, sphere: usize, surface: &str, depth: Peak, most_m: f64) -> Self {
        let seen = format!(
            "{} deep in {surface} {}; {} is the most that is meaningful",
            mm(depth.value),
            at(depth),
            mm(most_m)
        );
        Caveat::of_sphere(body, sphere, "too_deep", seen)
    }

    /// Sphere that bottomed out a solid, or passed through it.
    pub(super) fn bottomed(body: &Body, sphere: usize, solid: &str, depth: Peak, thickness_m: f64) -> Self {
        let (deep, share) = (mm(depth.value), 100.0 * depth.value / thickness_m);
        let seen = format!("{deep} deep in {solid} {}, {share:.0} % of its {}", at(depth), mm(thickness_m));
        Caveat::of_sphere(body, sphere, "bottomed", seen)
    }

    /// Penetration beyond the last point of a force function.
    pub(super) fn beyond_curve(body: &Body, sphere: usize, surface: &str, beyond: Peak, last_m: f64) -> Self {
        let (deep, last) = (mm(last_m + beyond.value), mm(last_m));
        let seen =
            format!("{deep} deep in {surface} {}, beyond the last point of its force function at {last}", at(beyond));
        Caveat::of_sphere(body, sphere, "beyond_curve", seen)
    }

    /// Webbing stretched beyond the last point of its curve.
    pub(super) fn stretched(strap: &str, beyond: Peak, last: f64) -> Self {
        let [strain, last] = [last + beyond.value, last].map(|strain| 1e2 * strain);
        let seen = format!(
            "webbing {strap} stretched by {strain:.1} % {}, beyond the end of its curve at {last:.1} %",
            at(beyond)
        );
        let text = format!("{seen}; {}", not_to_be_quoted("its"));
        Caveat::new(format!("{strap}_stretched"), text, vec![format!("straps.{}.*", word(strap))])
    }

    /// Limiter that paid out more webbing than its curve has.
    pub(super) fn run_out(belt: &str, beyond: Peak, last_m: f64) -> Self {
        let (way, last) = (mm(last_m + beyond.value), mm(last_m));
        let seen = format!("limiter of {belt} bottomed out at {way} {}; its curve ends at {last}", at(beyond));
        let text = format!("{seen}; {}", not_to_be_quoted("the belt's"));
        Caveat::new(format!("{belt}_limiter_bottomed"), text, vec![format!("straps.{}_*", word(belt))])
    }

    /// Lap belt that left a wing of the pelvis (1: left, 2: right) at a time, s.
    pub(super) fn submarined(body: &Body, chain: &Chain, (time_s, wing): (f64, f64)) -> Option<Self> {
        let pelvis = chain.nodes.iter().find_map(|node| match &node.site {
            Site::Track(segment, track) => track.wing.map(|_| body.tree.segment(*segment)),
            _ => None,
        })?;
        let belt = &chain.belt;
        let side = if wing > 1.5 { "right" } else { "left" };
        let text = format!(
            "the belt {belt} left the {side} iliac wing at {:.1} ms and lies on the abdomen: submarining. Lower loads here do not mean better restraint. The position of the wing is an estimate; {}",
            1e3 * time_s,
            not_to_be_quoted("the belt's, pelvis and chest")
        );
        let chest = body.tree.landmarks_at(pelvis).chest;
        let spoiled = [Some(pelvis), chest].into_iter().flatten().flat_map(|segment| figures_of(body, segment));
        let figures = [format!("straps.{}_*", word(belt))].into_iter().chain(spoiled).collect();
        Some(Caveat::new(format!("submarining_{side}"), text, figures))
    }

    /// Lap belt over plain points of a pelvis. It appears in every such run, so it marks no result.
    pub(super) fn submarining_unseen(chain: &Chain) -> Self {
        let belt = &chain.belt;
        let text = format!(
            "the belt {belt} lies on plain points of the pelvis, which it cannot leave: submarining cannot be seen. Nodes with `wing` show it"
        );
        Caveat::new(format!("{belt}_submarining_unseen"), text, Vec::new())
    }

    /// Shoulder belt off the shoulder under load since a time, s.
    pub(super) fn off_shoulder(chain: &Chain, time_s: f64) -> Self {
        let seen = format!("was off the shoulder at {:.1} ms, under load", 1e3 * time_s);
        Caveat::of_shoulder(chain, "off_shoulder", &format!("{seen}: it bears on the chest alone"))
    }

    /// Shoulder belt beside the neck under load since a time, s.
    pub(super) fn at_neck(chain: &Chain, time_s: f64) -> Self {
        let seen = format!("slid to the neck at {:.1} ms, under load", 1e3 * time_s);
        Caveat::of_shoulder(chain, "on_neck", &format!("{seen}: what it does to the neck is not modelled"))
    }

    /// Belt that passes behind a sphere under load since a time, s: neither it nor what it wraps moves as in front.
    pub(super) fn behind(body: &Body, chain: &Chain, time_s: f64) -> Self {
        let belt = &chain.belt;
        let text = format!(
            "the belt {belt} passed behind a sphere of the body at {:.1} ms, under load: there it pushes the body ahead. Points of the body instead of a sphere keep a belt in front; {}",
            1e3 * time_s,
            not_to_be_quoted("the belt's and the body's")
        );
        let spheres = chain.nodes.iter().filter_map(|node| match node.site {
            Site::Sphere(sphere) => body.spheres.get(sphere),
            _ => None,
        });
        let spoiled = spheres.flat_map(|sphere| figures_of(body, sphere.segment));
        let figures = [format!("straps.{}_*", word(belt))].into_iter().chain(spoiled).collect();
        Caveat::new(format!("{belt}_behind"), text, figures)
    }

    fn of_shoulder(chain: &Chain, sign: &str, seen: &str) -> Self {
        let belt = &chain.belt;
        let text = format!("the belt {belt} {seen}; {}", not_to_be_quoted("the belt's"));
        let figures = vec![format!("straps.{}_*", word(belt))];
        Caveat::new(format!("{belt}_{sign}"), text, figures)
    }

    /// Belts round the sphere of a pelvis whose force would have pulled them off its wings at a time, s.
    pub(super) fn would_submarine(body: &Body, sphere: usize, belts: &str, own: Vec<String>, time_s: f64) -> Self {
        let part = &body.spheres[sphere];
        let text = format!(
            "the pull of {belts} on {} would have drawn it over the iliac crests by {:.1} ms: submarining, which a belt round a sphere cannot show. The position of the wings is an estimate; {}",
            part.name,
            1e3 * time_s,
            not_to_be_quoted("the belt's, pelvis and chest")
        );
        let chest = body.tree.landmarks_at(part.segment).chest;
        let spoiled = [Some(part.segment), chest].into_iter().flatten().flat_map(|segment| figures_of(body, segment));
        Caveat::new(format!("submarining_{}", word(&part.name)), text, own.into_iter().chain(spoiled).collect())
    }

    /// Plate deflected beyond the range of all tests.
    pub(super) fn pressed(plate: &str, most: Peak, known: Known) -> Self {
        let seen = match known {
            Known::Depth(depth_m) => format!("{:.0} % of the chest's depth", 100.0 * most.value / depth_m),
            Known::Last(last_m) => format!("beyond {}, where its force ends", mm(last_m)),
        };
        let text = format!(
            "{plate} is pressed in by {}, {seen}, {}: beyond all test data; {}",
            mm(most.value),
            at(most),
            not_to_be_quoted("its")
        );
        let own = plate.rsplit_once('.').map_or_else(String::new, |(body, _)| format!("{body}."));
        let is_of_chest = matches!(known, Known::Depth(_));
        let measures = OF_DEFLECTION.iter().filter(|_| is_of_chest).map(|name| format!("{own}{name}"));
        let figures = [format!("plates.{plate}.*")].into_iter().chain(measures).collect();
        Caveat::new(format!("{plate}_too_deep"), text, figures)
    }

    /// Uncertainty of a deformable chest. It appears in every such run, so it marks no result.
    pub(super) fn of_chest(chest: &Chest) -> Self {
        let of = match chest.preset.as_str() {
            "own" => return Caveat::own_chest(chest),
            "person" => "of a person, fitted to hub tests of cadavers at 4.3 and 6.7 m/s",
            _ => "of a dummy, fitted to one hub test",
        };
        let text = format!(
            "chest {of}. Under belts and bags, a constant share of their force (0.2 to 0.5 is plausible) bears on the sternum, and the deflection depends on it. Not valid for loads from the side or from behind, or for broken ribs"
        );
        Caveat::new("chest_of_one_share", text, Vec::new()).with_subject(&chest.of)
    }

    /// Uncertainty of sides that yield. It appears in every such run, so it marks no result.
    pub(super) fn of_sides(sides: &Sides) -> Self {
        let of = match sides.preset.as_str() {
            "person" => {
                "of a person yield as they do from the front, fitted to no test from the side: hubs meet the forces of tests, and press in the chest as far as there, the abdomen 1 to 25 % less than there. Under a broad plate the ribs go in 1.4 to 2.4 times as far as in tests. The pelvis is fitted to hubs at one speed. Limits of dummies do not apply to them"
            }
            _ => {
                "of a dummy, with three ribs as one, are fitted to drops of a rib and one test of its abdomen; its pelvis is fitted to one test"
            }
        };
        let text = format!("ribs and abdomen to the side {of}. Shoulders are rigid");
        Caveat::new("sides_as_one_rib", text, Vec::new()).with_subject(&sides.of)
    }

    fn own_chest(chest: &Chest) -> Self {
        let text = "chest with the scenario's own values; under belts and bags, a constant share of their force bears on the sternum";
        Caveat::new("chest_of_one_share", text.to_owned(), Vec::new()).with_subject(&chest.of)
    }

    /// Column stroke beyond the last point of its force.
    pub(super) fn stroked(Beyond { name: column, turns }: &Beyond, beyond: Peak, last: f64) -> Self {
        let shown = |x: f64| if *turns { format!("{:.1}°", x.to_degrees()) } else { mm(x) };
        let (way, last) = (shown(last + beyond.value), shown(last));
        if *turns {
            let text = format!(
                "{column} turned {way} {}, beyond the end of its moment curve at {last}; {}",
                at(beyond),
                not_to_be_quoted("its")
            );
            return Caveat::new(format!("{column}_beyond_turn"), text, vec![format!("hinges.{column}.*")]);
        }
        let text = format!(
            "{column} stroked {way} {}, beyond the end of its force curve at {last}; {}",
            at(beyond),
            not_to_be_quoted("its")
        );
        Caveat::new(format!("{column}_beyond_stroke"), text, vec![format!("columns.{column}.*")])
    }

    /// Sphere in the way of a bag at firing, or that compressed it down to its mount or its middle.
    pub(super) fn of_bag(body: &Body, sphere: usize, sign: &str, bag: &str, time_s: f64) -> Self {
        let at = format!("at {:.1} ms", 1e3 * time_s);
        let seen = if sign == "caught" {
            format!(
                "was inside the space of the bag {bag} when it fired, {at}; of the forces of unfolding only a guess is known"
            )
        } else {
            format!("pressed the bag {bag} in as far as its mount or its centre {at}")
        };
        Caveat::of_sphere(body, sphere, sign, seen)
    }

    /// Sphere in contact with a part behind a bag through the bag.
    pub(super) fn touched_through(body: &Body, sphere: usize, bag: &str, what: &str, time_s: f64) -> Self {
        let seen = format!("touched {what} through the bag {bag} at {:.1} ms", 1e3 * time_s);
        let caveat = Caveat::of_sphere(body, sphere, "through_bag", seen.clone());
        let own = &body.spheres[sphere];
        if Some(own.segment) == body.tree.landmarks_at(own.segment).head {
            return caveat;
        }
        // what is behind yields by its own law, and the bag goes on: nothing is missing but for a head on a rim
        let text = format!("{} {seen}: both press it from then on", own.name.replace('_', " "));
        Caveat { text, figures: Vec::new(), ..caveat }
    }

    /// Sphere that left the compartment where no geometry is modelled that would have stopped it.
    pub(super) fn left_compartment(body: &Body, sphere: usize, exit: &Exit) -> Self {
        let past = exit.past.as_ref().map_or(String::new(), |past| format!(", past {past}"));
        let seen = format!(
            "left the modelled compartment {} at {:.1} ms{past}: the scenario has nothing there that it would have hit",
            exit.side.words(),
            1e3 * exit.time_s
        );
        Caveat::of_sphere(body, sphere, "left_compartment", seen)
    }

    /// Measures whose maximum is in a window cut off by the end of the run; none without any.
    pub(super) fn cut_off(reached_s: f64, cut: &[&Measure]) -> Option<Self> {
        let worst = cut.first()?;
        let (label, of) = (worst.label, cut.len());
        let others = if of == 1 { String::new() } else { format!(" and {} more", of - 1) };
        let text = format!(
            "{label}{others}: the peak is at the end of the run, {:.1} ms; a longer run may have a higher one",
            1e3 * reached_s
        );
        Some(Caveat::new("window_at_end", text, names_of(cut.iter().copied())))
    }

    /// Sphere whose centre crossed the axis of a bar or a rim and was pushed onwards.
    pub(super) fn through(body: &Body, sphere: usize, solid: &str, depth: Peak) -> Self {
        let seen = format!("went through {solid} {} and was pushed out beyond", at(depth));
        Caveat::of_sphere(body, sphere, "through", seen)
    }

    /// Head that struck something stiffer than a head: at the greatest force, its penetration of `struck` was so small
    /// that only a rigid skull on a rigid block fits it. None for other parts.
    pub(super) fn on_rigid(body: &Body, struck: &SpherePeak) -> Option<Self> {
        let is_head = |sphere: &ContactSphere| Some(sphere.segment) == body.tree.landmarks_at(sphere.segment).head;
        let sphere = body.spheres.iter().position(|sphere| sphere.part == struck.sphere && is_head(sphere))?;
        let is_rigid = struck.force_n > HEAD_STRUCK_N && struck.force_n > RIGID_N_M * struck.penetration_m;
        let seen = format!(
            "struck {} with {:.1} kN and pressed it in by only {:.1} mm, less than a dummy's head on a steel plate: it is as good as rigid",
            struck.surface,
            1e-3 * struck.force_n,
            1e3 * struck.penetration_m
        );
        is_rigid.then(|| Caveat::of_sphere(body, sphere, "on_rigid", seen))
    }

    /// Ejected occupant, with results from ejection on: they amplify small changes of the start, and no energy balance
    /// shows it.
    pub(super) fn by_chance(ejection: &Ejection, later: Vec<String>) -> Option<Self> {
        let first = ejection.parts.first()?;
        let text = format!(
            "an occupant who leaves the seat tumbles: ejection ({} first, at {:.1} ms) and what follows may be chance in a single run; --estimate-error shows what is not determined, --ensemble what is stable",
            first.part.rsplit('.').next().unwrap_or_default().replace('_', " "),
            1e3 * first.time_s
        );
        Some(Caveat::new(Self::CHANCE, text, [owned(&["ejection*", "throw.*"]), later].concat()))
    }

    fn of_sphere(body: &Body, sphere: usize, sign: &str, seen: String) -> Self {
        let own = &body.spheres[sphere];
        let [name, part] = [&own.name, &own.part].map(|name| name.replace('_', " "));
        let text = format!("{name} {seen}; {}", not_to_be_quoted(&part));
        Caveat::new(format!("{}_{sign}", word(&own.part)), text, figures_of(body, own.segment))
    }

    /// Limb that passed through a surface between its spheres, the nearest of which was `clear` away.
    pub(super) fn cut(body: &Body, limb: Segment, surface: &str, clear: Peak) -> Self {
        let row = &body.tree[limb];
        let name = row.name.replace('_', " ");
        let quoted = not_to_be_quoted(&name);
        let text = format!("{name} went through {surface} between its spheres {} without force; {quoted}", at(clear));
        Caveat::new(format!("{}_cut", row.name), text, figures_of(body, limb))
    }

    /// Interval of readings too long: measures that change by a part of their value if every second reading is left
    /// out; none if all are exact enough. `are_of_steps` is false for runs without peaks of steps, which have peaks at
    /// their outputs only.
    pub(super) fn too_coarse(interval_s: f64, off: &[(&Measure, f64)], are_of_steps: bool) -> Option<Self> {
        let worst = off.iter().max_by(|a, b| a.1.total_cmp(&b.1));
        let readings = if are_of_steps { "reading" } else { "output" };
        let of_measures = worst.map(|(worst, most)| {
            let (count, label, percent) = (off.len(), worst.label, 100.0 * most);
            let measures = if count == 1 { "measure" } else { "measures" };
            format!("{count} {measures}: with every other {readings} left out, {label} changes by {percent:.0} %")
        });
        let is_apart = interval_s > APART_S && !are_of_steps;
        let of_peaks = is_apart.then(|| "peaks of forces, depths and positions, which need 2 ms or less".to_owned());
        let spoiled: Vec<String> = of_peaks.into_iter().chain(of_measures).collect();
        let mends = if are_of_steps { "a shorter step" } else { "a shorter output.interval" };
        let text = format!(
            "{readings}s every {} ms are too coarse for {}; use {mends}, or `measures --interval`",
            (1e9 * interval_s).round() / 1e6,
            spoiled.join(", and for ")
        );
        let mut figures = names_of(off.iter().map(|(m, _)| *m));
        figures.extend(PEAKS.iter().filter(|_| is_apart).map(|name| (*name).to_owned()));
        (!spoiled.is_empty()).then(|| Caveat::new(format!("{readings}s_too_coarse"), text, figures))
    }

    /// Body other than the dummy of the limits and risks.
    pub(super) fn other_dummy(dummy: Dummy, mass_kg: f64, measures: &[Measure]) -> Option<Self> {
        let differs = (mass_kg / dummy.mass_kg() - 1.0).abs() > 0.2;
        let text = format!(
            "limits and risks are for a {} of {:.0} kg; the body has {mass_kg:.0} kg, so neither applies",
            dummy.name(),
            dummy.mass_kg()
        );
        let judged = measures.iter().filter(|m| !(m.limits.is_empty() && m.risks.is_empty()));
        differs.then(|| Caveat::new("other_dummy", text, names_of(judged)))
    }
}

/// Angle of a joint beyond a stop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turned {
    /// Angle beyond the stop's end, rad.
    pub beyond: Peak,
    /// The joint's angle, or the excess beyond an elastic limit, rad.
    pub angle_rad: f64,
    /// End of the stop, or the largest excess beyond an elastic limit, rad.
    pub stop_rad: f64,
    pub is_elastic: bool,
}

fn not_to_be_quoted(of: &str) -> String {
    format!("do not quote {of} results")
}

fn at(peak: Peak) -> String {
    format!("at {:.1} ms", 1e3 * peak.time_s)
}

fn mm(length_m: f64) -> String {
    format!("{:.0} mm", 1e3 * length_m)
}

/// Measures of chest deflection and its rate.
const OF_DEFLECTION: [&str; 6] =
    ["chest_deflection", "chest_compression", "deflection_rate", "viscous_criterion", "cti", "pc_score"];

/// Names of measures among measures and results.
fn names_of<'a>(measures: impl Iterator<Item = &'a Measure>) -> Vec<String> {
    measures.flat_map(|m| [Some(m.name), m.figure]).flatten().map(str::to_owned).collect()
}

fn owned(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

/// Prefix of the measures of the body of a segment.
fn prefix(body: &Body, segment: Segment) -> String {
    let name = body.tree.bodies()[body.tree.body_of(segment)].name;
    if name.is_empty() { String::new() } else { format!("{name}.") }
}

/// Results of a segment, and of the spheres on it.
fn figures_of(body: &Body, segment: Segment) -> Vec<String> {
    let marks = body.tree.landmarks_at(segment);
    let is_of = |leg: Option<Limb>| leg.is_some_and(|leg| body.tree.is_of(segment, &leg));
    let measured: &[&str] = if Some(segment) == marks.head {
        &["hic15", "hic36", "gsi", "bric", "damage", "head*", "nij", "neck_*"]
    } else if Some(segment) == marks.chest {
        &["chest*", "csi", "deflection_rate", "viscous_criterion", "cti", "pc_score"]
    } else if Some(segment) == marks.pelvis {
        &["pelvis*"]
    } else if is_of(marks.legs.right) {
        &["right_femur*", "right_tibia*"]
    } else if is_of(marks.legs.left) {
        &["left_femur*", "left_tibia*"]
    } else {
        &[]
    };
    let spheres = body.spheres.iter().filter(|sphere| sphere.segment == segment);
    let touched = spheres.map(|sphere| format!("contacts.{}.*", word(&sphere.part)));
    let measured = measured.iter().map(|figure| format!("{}{figure}", prefix(body, segment)));
    let mut figures: Vec<String> = measured.chain(touched).collect();
    figures.dedup();
    figures
}
