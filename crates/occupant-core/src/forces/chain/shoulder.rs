//! Webbing over a shoulder: where it comes to lie on its track, and whether it bears there, rubs the neck or is off.

use nalgebra::Vector3;
use serde::Serialize;

use super::data::Track;
use super::law::ChainLaw;
use super::past::ChainPast;
use super::site::{SiteLaw, TrackLaw};
use crate::motion::vector::V3;

/// Largest ratio of lateral force held across a track in a crash, whatever the friction: ours, from runs of cars with
/// belts that start 45° from the track's normal and stay.
const HOLDS: f64 = 1.2;
/// Number of steps along a track.
const STEPS: f64 = 200.0;
/// Distance from the inner end, relative to the track, that counts as beside the neck.
const AT_END: f64 = 1e-6;

/// State of webbing on a shoulder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum OnShoulder {
    /// Carries load on the shoulder.
    Bears,
    /// At the inner end of its track, beside the neck.
    AtNeck,
    /// Beyond the outer end of its track.
    SlidOff,
    /// Lifted off the shoulder.
    LiftedOff,
}

impl Track {
    /// Position of webbing from `ends` under tension, and its distance from the inner end, 0 to 1. Joint of its segment
    /// and ends in that segment's axes; `joint` from the lower end. None for a track that is no arc.
    pub(crate) fn settles(&self, joint: Vector3<f64>, ends: [Vector3<f64>; 2]) -> Option<(f64, OnShoulder)> {
        let law = TrackLaw::new(self, 0, &|_| joint)?;
        let ends = ends.map(|end| V3::of(&end));
        let (mut way, mut sense) = (law.start, 0.0_f64);
        loop {
            let (point, _, out) = law.at(way);
            let unit = |end: V3<f64>| (end - point) * (1.0 / (end - point).norm_squared().max(1e-12).sqrt());
            let force = unit(ends[0]) + unit(ends[1]);
            if out.dot(force) > 0.0 {
                return Some((way / law.length, OnShoulder::LiftedOff));
            }
            let [across, held] = law.parted(way, force);
            let is_held = across.abs() <= self.friction.max(HOLDS) * held || across.signum() == -sense;
            if is_held {
                return Some((way / law.length, OnShoulder::Bears));
            }
            sense = across.signum();
            way += sense * law.length / STEPS;
            if way <= 0.0 {
                return Some((0.0, OnShoulder::AtNeck));
            }
            if way > law.length {
                return Some((1.0, OnShoulder::SlidOff));
            }
        }
    }
}

impl ChainLaw<f64> {
    /// Number of its straps.
    pub(crate) fn strap_count(&self) -> usize {
        self.straps.starts.len()
    }

    /// State of the webbing on the first track that is no iliac wing, and the index of the strap that starts there.
    pub(crate) fn on_shoulder(&self, past: &ChainPast<f64>) -> Option<(usize, OnShoulder)> {
        let is_track = |site: &SiteLaw<f64>| matches!(site, SiteLaw::Track(_, track) if track.wing.is_none());
        let k = self.nodes.iter().position(|node| is_track(&node.site))?;
        let SiteLaw::Track(_, track) = &self.nodes[k].site else { return None };
        let own = &past.nodes[k];
        let strap = self.straps.starts.iter().rposition(|start| *start <= k)?;
        let lies = match () {
            () if own.is_on() && own.way <= AT_END * track.length => OnShoulder::AtNeck,
            () if own.is_on() => OnShoulder::Bears,
            () if own.way > track.length => OnShoulder::SlidOff,
            () => OnShoulder::LiftedOff,
        };
        Some((strap, lies))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;

    /// 10 cm wide and 1 cm high, seen from ahead, its crown up.
    fn arc() -> Track {
        let points_m = [[0.0, -0.05, 0.0], [0.0, 0.0, 0.01], [0.0, 0.05, 0.0]].map(Point3::from);
        Track { points_m, friction: 0.3, drag_n_s_m: 100.0, wing: None, then: None }
    }

    #[test]
    fn webbing_bears_slides_or_lifts_by_where_its_ends_are() {
        let lies = |a: [f64; 3], b: [f64; 3]| arc().settles(Vector3::zeros(), [a, b].map(Vector3::from)).unwrap();
        let (share, how) = lies([-0.3, 0.0, -0.3], [0.3, 0.0, -0.3]);
        assert!((share - 0.5).abs() < 1e-9 && how == OnShoulder::Bears);
        assert_eq!(lies([-0.3, 0.0, 0.4], [0.3, 0.0, 0.3]).1, OnShoulder::LiftedOff);
        // pulled outwards by 60° it slides off, by 84° it lifts off on the way: the track turns away from it
        assert_eq!(lies([-0.3, 1.7, -1.0], [0.3, 1.7, -1.0]), (1.0, OnShoulder::SlidOff));
        assert_eq!(lies([-0.3, -1.7, -1.0], [0.3, -1.7, -1.0]), (0.0, OnShoulder::AtNeck));
        let (share, how) = lies([-0.1, 0.9, -0.1], [0.1, 0.9, -0.1]);
        assert!(how == OnShoulder::LiftedOff && share > 0.6 && share < 0.7, "{share}");
    }
}
