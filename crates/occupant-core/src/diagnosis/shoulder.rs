//! Position of belts on shoulders: where loaded webbing settles, from the initial posture.

use serde::Serialize;

use super::rates::frame_at_start;
use crate::forces::chain::{Chain, OnShoulder, Site};
use crate::forces::shown::Line;
use crate::results::sample::Sample;

/// A belt over a shoulder.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ShoulderBelt {
    /// Name of the belt.
    pub belt: String,
    /// The segment that supports it.
    pub part: String,
    /// Position from the neck towards the arm under load, 0 to 1.
    pub share: f64,
    /// Its state there.
    pub lies: OnShoulder,
}

/// All shoulder belts.
pub(super) fn all(sample: &Sample<'_>) -> Vec<ShoulderBelt> {
    let chains = &sample.model.setup().chains;
    if chains.is_empty() {
        return Vec::new();
    }
    let lines = sample.lines();
    chains.iter().filter_map(|chain| one(sample, chain, &lines)).collect()
}

fn one(sample: &Sample<'_>, chain: &Chain, lines: &[Line]) -> Option<ShoulderBelt> {
    let (model, body) = (sample.model, sample.model.body());
    let k = chain.nodes.iter().position(|node| matches!(&node.site, Site::Track(_, track) if track.wing.is_none()))?;
    let Site::Track(segment, track) = &chain.nodes[k].site else { return None };
    // a strap begins where the webbing rubs
    let strap = chain.nodes[1..=k].iter().filter(|node| node.parts()).count();
    let line = |strap: usize| lines.iter().find(|line| chain.straps.get(strap) == Some(&line.name));
    let before = line(strap.checked_sub(1)?)?.points_m.iter().rev().nth(1)?;
    let behind = line(strap).filter(|_| chain.nodes[k].parts())?.points_m.get(1)?;
    let (frame, kinematics) = (frame_at_start(model, chain.frame), &sample.evaluation.kinematics);
    let (joint, axes) = (kinematics.joint[*segment].to_vector(), kinematics.axes[*segment].to_matrix());
    let ends = [before, behind].map(|end| axes.tr_mul(&(frame.point_to_space(end.coords) - joint)));
    let segment = body.tree.segment(*segment);
    let (share, lies) = track.settles(body.joint_m(segment), ends)?;
    Some(ShoulderBelt { belt: chain.belt.clone(), part: body.tree[segment].name.to_owned(), share, lies })
}
