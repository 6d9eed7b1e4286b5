//! What an ensemble came to, as data: the tables on the terminal and the JSON are made of it.

use occupant_study::Tolerances;
use serde::Serialize;

use super::bands::{Bands, ChannelBand};
use super::judge::{Judged, Tolerance, judge, rule, word};
use super::members::{Left, Member};

/// An ensemble that has been run.
pub(crate) struct Report {
    /// Runs, the unchanged one included.
    pub(crate) members: u64,
    /// What named the random numbers.
    pub(crate) seed: u64,
    /// How far the changes went.
    pub(crate) changes: Tolerances,
    /// How far the members may differ.
    pub(crate) tolerance: Tolerance,
    /// Members that did not complete, and why.
    pub(crate) failed: Vec<(u64, String)>,
    /// All figures that some member has.
    pub(crate) figures: Vec<Judged>,
    /// Bands of the channels looked at.
    pub(crate) bands: Bands,
}

impl Report {
    /// Judges what the members left.
    pub(crate) fn of(
        nominal: &Left,
        others: &[Member],
        tolerance: Tolerance,
        bands: Bands,
        (seed, changes): (u64, Tolerances),
    ) -> Report {
        let failed = (1..).zip(others);
        let failed = failed.filter_map(|(number, member)| Some((number, member.as_ref().err()?.clone())));
        let value = |i: usize, member: &Member| member.as_ref().map_or(f64::NAN, |left| left.value(i));
        let figures = nominal.figures.iter().enumerate().map(|(i, (name, unit, _))| {
            let first = std::iter::once(nominal.value(i));
            let values = first.chain(others.iter().map(|m| value(i, m)));
            (name.as_str(), *unit, values.collect())
        });
        let figures = judge(figures, tolerance);
        Report { members: others.len() as u64 + 1, seed, changes, tolerance, failed: failed.collect(), figures, bands }
    }

    /// As `--json` prints it.
    pub(crate) fn describe(&self, files: Vec<String>) -> Description<'_> {
        Description {
            members: self.members,
            completed: self.members - self.failed.len() as u64,
            seed: self.seed,
            changes: Changes {
                posture_rad: self.changes.posture_rad,
                place_m: self.changes.place_m,
                path: self.changes.path,
                stiffness: self.changes.stiffness,
            },
            within: self.tolerance.relative,
            failed: self.failed.iter().map(|(member, reason)| Broken { member: *member, reason }).collect(),
            figures: self.figures.iter().map(|f| Figure::of(f, self.tolerance)).collect(),
            channels: self.bands.channels.iter().map(Channel::of).collect(),
            files,
        }
    }

    /// Names of the figures that are not stable.
    pub(crate) fn unstable(&self) -> Vec<&str> {
        let unstable = self.figures.iter().filter(|f| f.is_unstable());
        unstable.map(|f| f.name.as_str()).collect()
    }
}

/// An ensemble in JSON; SI units.
#[derive(Serialize)]
pub(crate) struct Description<'a> {
    members: u64,
    completed: u64,
    seed: u64,
    changes: Changes,
    /// Width of the middle 90 % that a stable figure may have, as a part of the median.
    within: f64,
    failed: Vec<Broken<'a>>,
    figures: Vec<Figure<'a>>,
    channels: Vec<Channel<'a>>,
    /// Files of bands and plots.
    files: Vec<String>,
}

#[derive(Serialize)]
struct Changes {
    posture_rad: f64,
    place_m: f64,
    path: f64,
    stiffness: f64,
}

#[derive(Serialize)]
struct Broken<'a> {
    member: u64,
    reason: &'a str,
}

#[derive(Serialize)]
struct Figure<'a> {
    name: &'a str,
    unit: &'a str,
    nominal: Option<f64>,
    members: usize,
    missing: usize,
    least: f64,
    q05: f64,
    q25: f64,
    median: f64,
    q75: f64,
    q95: f64,
    greatest: f64,
    tolerance: f64,
    verdict: &'static str,
}

impl<'a> Figure<'a> {
    fn of(judged: &'a Judged, tolerance: Tolerance) -> Self {
        let s = &judged.spread;
        let rule = rule(&judged.name, &judged.unit, tolerance);
        Figure {
            name: &judged.name,
            unit: &judged.unit,
            nominal: judged.nominal,
            members: s.members,
            missing: s.missing,
            least: s.least,
            q05: s.q05,
            q25: s.q25,
            median: s.median,
            q75: s.q75,
            q95: s.q95,
            greatest: s.greatest,
            tolerance: (rule.relative * s.median.abs()).max(rule.absolute),
            verdict: word(judged.verdict),
        }
    }
}

#[derive(Serialize)]
struct Channel<'a> {
    name: &'a str,
    unit: &'a str,
    tolerance: f64,
    lost_at_s: Option<f64>,
    widest: Option<f64>,
    widest_at_s: Option<f64>,
}

impl<'a> Channel<'a> {
    fn of(band: &'a ChannelBand) -> Self {
        Channel {
            name: &band.name,
            unit: band.unit,
            tolerance: band.tolerance,
            lost_at_s: band.lost_at_s,
            widest: band.widest.map(|(width, _)| width),
            widest_at_s: band.widest.map(|(_, time_s)| time_s),
        }
    }
}
