//! The vehicle's path (series 12): order, cover of the run, unwrapped angles, speed of the occupant.

use super::{Check, Complaint};
use crate::deck::DeckCard;
use crate::rule::Rule;

/// Speeds of vehicle and occupant may differ by this much before it is called a contradiction.
const SPEED_TOLERANCE: f64 = 0.1;
const FASTEST_IN_PER_S: f64 = 3000.0;

pub(super) fn check(check: &mut Check<'_>) {
    if check.value("MREAD") != 0.0 {
        return;
    }
    let numbers = |card: &DeckCard| card.numbers.iter().map(|n| n.value).collect::<Vec<_>>();
    let stations: Vec<Vec<f64>> = check.deck.cards_of(12, 'b').map(numbers).filter(|n| n.len() >= 7).collect();
    for (index, pair) in stations.windows(2).enumerate() {
        check_step(check, index + 2, &pair[0], &pair[1]);
    }
    check_cover(check, &stations);
    if let (Some(first), Some(second)) = (stations.first(), stations.get(1)) {
        check_speed(check, first, second);
    }
}

fn check_step(check: &mut Check<'_>, station: usize, before: &[f64], after: &[f64]) {
    let time = format!("CALT({station})");
    let message = format!("not after the station before it, {}", before[0]);
    check.complain_if(
        after[0] <= before[0],
        Rule::Impossible,
        &time,
        &message,
        "times that grow from card to card",
        "sort the stations, or remove the doubled one",
    );
    for (place, name) in [(4, "CALPH"), (5, "CALTH"), (6, "CALPS")] {
        let jump = (after[place] - before[place]).abs();
        let message = format!("it jumps by {jump} degrees from the station before");
        let remedy = "let the angle run on beyond 180 degrees instead of starting again at −180";
        check.complain_if(
            jump > 180.0,
            Rule::Impossible,
            &format!("{name}({station})"),
            &message,
            "unwrapped angles",
            remedy,
        );
    }
    let way = (1..=3).map(|axis| (after[axis] - before[axis]).powi(2)).sum::<f64>().sqrt();
    let fast = after[0] > before[0] && way / (after[0] - before[0]) > FASTEST_IN_PER_S;
    let message = format!("the vehicle moves {way:.3} in from the station before, faster than 170 mph");
    check.complain_if(
        fast,
        Rule::Unlikely,
        &format!("CALX({station})"),
        &message,
        "positions in inches, times in seconds",
        "look for the decimal point",
    );
}

fn check_cover(check: &mut Check<'_>, stations: &[Vec<f64>]) {
    let (Some(first), Some(last)) = (stations.first(), stations.last()) else {
        return;
    };
    let (start, end) = (check.value("T1"), check.value("TF"));
    let complaint = |message| Complaint {
        rule: Rule::PathTooShort,
        message,
        expected: "stations from T1 or earlier to TF or later",
        remedy: "add stations, or change T1 and TF on card 3",
    };
    if first[0] > start {
        check
            .complain("CALT(1)", complaint(format!("the path begins at {} s and the run at T1 = {start} s", first[0])));
    }
    if last[0] < end {
        let name = format!("CALT({})", stations.len());
        check.complain(&name, complaint(format!("the path ends at {} s and the run at TF = {end} s", last[0])));
    }
    if stations.len() == 1 {
        check.complain("NVPOS", complaint("one station makes no path".to_owned()));
    }
}

/// The occupant usually begins with the vehicle's speed; a factor of 12 or 17.6 between them is a unit.
fn check_speed(check: &mut Check<'_>, first: &[f64], second: &[f64]) {
    let duration = second[0] - first[0];
    if check.value("NPOS") != 0.0 || duration <= 0.0 {
        return;
    }
    let vehicle = (1..=3).map(|axis| ((second[axis] - first[axis]) / duration).powi(2)).sum::<f64>().sqrt();
    let occupant = ["VXVC", "VYVC", "VZVC"].map(|name| check.value(name).powi(2)).iter().sum::<f64>().sqrt();
    let near = |factor: f64| (vehicle / occupant / factor - 1.0).abs() < 0.05;
    let (rule, message) = match () {
        () if near(12.0) => (Rule::LooksLikeOtherUnit, "this looks like ft/s"),
        () if near(17.6) => (Rule::LooksLikeOtherUnit, "this looks like miles per hour"),
        () if (vehicle - occupant).abs() > SPEED_TOLERANCE * vehicle.max(occupant) => {
            (Rule::Inconsistent, "occupant and vehicle begin at different speeds")
        }
        () => return,
    };
    let message = format!("{message}: the vehicle's first interval has {vehicle:.2} in/s, the occupant {occupant:.2}");
    check.complain_if(
        true,
        rule,
        "VXVC",
        &message,
        "the initial velocity in vehicle axes, in in/s",
        "give the occupant the vehicle's velocity unless the difference is meant",
    );
}
