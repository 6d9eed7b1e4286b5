//! The three tests of the report's validation study as `scenarios/cart-*.toml` have them: peaks, durations, what strikes what, and
//! that no joint has failed; at 20 mph, and at 10 mph beside it. What the report says of them stands in `docs/cart-cases.md`.

use crash_measures::signal::cfc::{CfcFamily, ChannelClass, filter_cfc};
use occupant_core::model::Model;
use occupant_core::results::channel::{Series, find};
use occupant_core::results::summary::{RunStatus, Summarizer, Summary};
use occupant_core::run::simulate::simulate;
use occupant_tests::measure::assert_within;
use occupant_tests::room::setup;

const UNBELTED: &str = "cart-unbelted.toml";
const LAP: &str = "cart-lap.toml";
const LAP_AND_TORSO: &str = "cart-lap-torso.toml";
const SLOW: [&str; 3] = ["path.speed=\"10 mph\"", "path.delta_v=\"10 mph\"", "path.duration=\"22.8 ms\""];

/// The pulse of an acceleration, CFC 60: its peak, and how long it lasts without a break above a half, a quarter and a tenth of it.
#[derive(Debug)]
struct Pulse {
    peak_g: f64,
    half_ms: f64,
    quarter_ms: f64,
    tenth_ms: f64,
}

impl Pulse {
    /// Of three components at 1 kHz, m/s².
    fn of(components: &[Vec<f64>]) -> Self {
        let filtered = |values: &Vec<f64>| {
            filter_cfc(values, 1e-3, ChannelClass::Cfc60, CfcFamily::Iso6487).expect("a signal at 1 kHz")
        };
        let axes: Vec<Vec<f64>> = components.iter().map(filtered).collect();
        let norm = |i: usize| axes.iter().map(|axis| axis[i] * axis[i]).sum::<f64>().sqrt();
        let level: Vec<f64> = (0..axes[0].len()).map(norm).collect();
        let peak = level.iter().copied().fold(0.0, f64::max);
        let at = level.iter().position(|a| *a == peak).expect("a peak");
        let ms = |part: f64| {
            let above = |a: &&f64| **a >= part * peak;
            (level[..at].iter().rev().take_while(above).count() + level[at..].iter().take_while(above).count()) as f64
        };
        Pulse { peak_g: peak / 9.80665, half_ms: ms(0.5), quarter_ms: ms(0.25), tenth_ms: ms(0.1) }
    }
}

/// What a case shows.
struct Seen {
    summary: Summary,
    head: Pulse,
    chest: Pulse,
    neck_deg: f64,
}

fn seen(name: &str, set: &[&str]) -> Seen {
    let text = std::fs::read_to_string(format!("{}/../scenarios/{name}", env!("CARGO_MANIFEST_DIR"))).expect(name);
    let model = Model::new(setup(&text, set)).unwrap_or_else(|problems| panic!("{problems}"));
    let parts = ["head", "upper_torso"].into_iter();
    let names = parts.flat_map(|part| ["x", "y", "z"].map(|axis| format!("{part}.acceleration.{axis}")));
    let names: Vec<String> = names.chain(["joint.neck.angle".to_owned()]).collect();
    let mut series = Series::new(names.iter().map(|name| find(&model, name).expect("a channel")).collect());
    let mut summarizer = Summarizer::new();
    simulate(&model, (&mut series, &mut summarizer)).expect("a run");
    let summary = summarizer.summary(None).expect("a summary");
    assert_eq!(summary.status, RunStatus::Completed);
    let neck_deg = series.values[6].iter().copied().fold(0.0, f64::max).to_degrees();
    Seen { summary, head: Pulse::of(&series.values[..3]), chest: Pulse::of(&series.values[3..6]), neck_deg }
}

impl Seen {
    /// When a part of the body first met one of these surfaces, ms; nothing that touched at the start.
    fn strikes_at_ms(&self, part: &str, surfaces: &[&str]) -> Option<f64> {
        let met = |c: &&occupant_core::results::summary::ContactBegin| {
            c.part.ends_with(part) && surfaces.iter().any(|s| c.surface.starts_with(s)) && !c.at_start
        };
        self.summary.contacts.iter().find(met).map(|c| c.time_s * 1e3)
    }

    /// No joint beyond its stop, no part through a surface without a force, none deeper than it can be believed.
    fn assert_sound(&self, name: &str) {
        let unsound = |caveat: &&occupant_core::results::summary::Caveat| {
            ["_beyond_stop", "_passed", "_cut", "_too_deep", "_through", "_lost", "_doubtful"]
                .iter()
                .any(|word| caveat.name.ends_with(word))
        };
        let said: Vec<_> = self.summary.caveats.iter().filter(unsound).map(|caveat| &caveat.text).collect();
        assert!(said.is_empty(), "{name}: {said:?}");
    }
}

/// Peak of head and chest, g; and how long each is above a half, a quarter and a tenth of it, ms.
fn assert_pulses(name: &str, seen: &Seen, head: [f64; 4], chest: [f64; 4]) {
    for (part, pulse, [peak_g, half_ms, quarter_ms, tenth_ms]) in
        [("head", &seen.head, head), ("chest", &seen.chest, chest)]
    {
        let near = |value: f64, off: f64| [value - off, value + off];
        assert_within(&format!("{name}: {part}, g"), pulse.peak_g, near(peak_g, 0.03 * peak_g));
        assert_within(&format!("{name}: {part} above half its peak, ms"), pulse.half_ms, near(half_ms, 2.0));
        assert_within(&format!("{name}: {part} above a quarter, ms"), pulse.quarter_ms, near(quarter_ms, 4.0));
        assert_within(&format!("{name}: {part} above a tenth, ms"), pulse.tenth_ms, near(tenth_ms, 4.0));
    }
}

const FRONT: [&str; 3] = ["steering_wheel", "panel", "windshield"];

/// At 20 mph, what the report says: about 80 g for about 0.03 s; knees, chest and head meet the targets.
#[test]
fn without_a_belt_knees_chest_and_head_meet_panel_and_wheel() {
    let seen = seen(UNBELTED, &[]);
    seen.assert_sound("no belt");
    // Measured: 28, 35, 39 in the three cases, where the stop begins at 33° and is full at 38°.
    assert_within("neck, °", seen.neck_deg, [20.0, 39.5]);
    let [knees, chest, head] = [("knee", "panel"), ("chest", "steering_wheel"), ("head", "panel")]
        .map(|(part, surface)| seen.strikes_at_ms(part, &[surface]).expect(part));
    assert!(knees < chest && chest < head, "{knees} {chest} {head}");
    // the chest stays short of the report's 80 g; its 30 ms lie between those above a quarter and above a tenth
    assert_pulses("no belt", &seen, [80.0, 9.0, 58.0, 93.0], [63.0, 9.0, 15.0, 43.0]);
}

#[test]
fn with_a_lap_belt_the_chest_meets_the_wheel_and_the_head_the_panel() {
    let seen = seen(LAP, &[]);
    seen.assert_sound("lap belt");
    assert_within("neck, °", seen.neck_deg, [25.0, 39.5]);
    let [chest, head] =
        [("chest", "steering_wheel"), ("head", "panel")].map(|(part, s)| seen.strikes_at_ms(part, &[s]).expect(part));
    assert!(chest < head, "{chest} {head}");
    assert_pulses("lap belt", &seen, [81.0, 13.0, 18.0, 84.0], [80.0, 9.0, 13.0, 45.0]);
}

/// About 40 g; nothing is struck, the body turns to the side of the free shoulder, and the arms whip back into the seat.
#[test]
fn with_both_belts_head_and_chest_meet_nothing_and_the_arms_whip_back_into_the_seat() {
    let seen = seen(LAP_AND_TORSO, &[]);
    seen.assert_sound("both belts");
    assert_within("neck, °", seen.neck_deg, [30.0, 40.5]);
    for part in ["head", "chest"] {
        assert_eq!(seen.strikes_at_ms(part, &FRONT), None, "{part}");
    }
    let arms = ["hand", "elbow"].iter().filter_map(|part| seen.strikes_at_ms(part, &["front_seat_back"]));
    let first = arms.fold(f64::INFINITY, f64::min);
    assert_within("arms back in the seat, ms", first, [100.0, 200.0]);
    assert_pulses("both belts", &seen, [49.0, 25.0, 52.0, 69.0], [38.0, 39.0, 58.0, 72.0]);
}

/// From half the speed the cart stops in half the time, and everything is gentler; no neck passes its stop there either.
#[test]
fn at_10_mph_all_is_gentler_and_nothing_fails() {
    for name in [UNBELTED, LAP, LAP_AND_TORSO] {
        let (fast, slow) = (seen(name, &[]), seen(name, &SLOW));
        slow.assert_sound(name);
        // Measured, head and chest, g: 47, 18 without a belt; 71, 32 with the lap belt; 37, 19 with both.
        assert!(slow.head.peak_g < fast.head.peak_g, "{name}: {} {}", slow.head.peak_g, fast.head.peak_g);
        // Measured: 23, 14, 37°.
        assert_within("neck, °", slow.neck_deg, [10.0, 39.5]);
        assert!(slow.chest.peak_g < 0.6 * fast.chest.peak_g, "{name}: {} {}", slow.chest.peak_g, fast.chest.peak_g);
    }
}

/// The decks, fitted by themselves: 17 spheres, thin faces, the figures of the scenarios to a fifth, from 20 mph; from 10 mph all is gentler.
#[test]
fn the_decks_have_the_figures_of_the_scenarios() {
    let cases = [
        ("unbelted", UNBELTED, [81.0, 11.0, 17.0, 64.0], [61.0, 11.0, 18.0, 43.0]),
        ("lap", LAP, [74.0, 6.0, 51.0, 55.0], [74.0, 12.0, 16.0, 21.0]),
        ("lap-torso", LAP_AND_TORSO, [45.0, 8.0, 55.0, 90.0], [41.0, 24.0, 50.0, 72.0]),
    ];
    for (deck, scenario, head, chest) in cases {
        let [own, slow, other] = [
            seen(&format!("decks/report/{deck}.toml"), &[]),
            seen(&format!("decks/report/{deck}-10mph.toml"), &[]),
            seen(scenario, &[]),
        ];
        assert_pulses(deck, &own, head, chest);
        for (part, a, b) in [("head", &own.head, &other.head), ("chest", &own.chest, &other.chest)] {
            // measured: head 81, 74, 45 for 80, 81, 49; chest 61, 74, 41 for 63, 80, 38
            assert_within(&format!("{deck}: {part}, g"), a.peak_g, [0.8 * b.peak_g, 1.2 * b.peak_g]);
        }
        assert!(slow.head.peak_g < own.head.peak_g && slow.chest.peak_g < 0.6 * own.chest.peak_g, "{deck}");
        // between the report's spheres the lower legs go through the panel, and nothing else fails
        for seen in [&own, &slow] {
            let words = ["_beyond_stop", "_passed", "_cut", "_too_deep", "_through"];
            let all = seen.summary.caveats.iter().map(|caveat| caveat.name.as_str());
            let failed: Vec<&str> = all.filter(|name| words.iter().any(|word| name.ends_with(word))).collect();
            assert!(failed.iter().all(|name| name.ends_with("lower_leg_cut")), "{deck}: {failed:?}");
        }
        for (part, surface) in [("knee", "panel"), ("chest", "steering_wheel"), ("head", "panel")] {
            let meets = own.strikes_at_ms(part, &[surface]).is_some();
            assert_eq!(meets, part == "knee" || deck != "lap-torso", "{deck}: {part}");
        }
    }
}
