//! Loads of head restraints on heads in a rear impact.

use nalgebra::Vector3;

use crate::body::Segment;
use crate::model::Model;
use crate::model::behind::restraints;
use crate::results::sample::Sample;

/// Forces of head restraints on heads at an output, N, by body, for a run whose steps were not recorded.
pub(crate) fn held(sample: &Sample<'_>) -> Vec<f64> {
    let (restraints, heads) = (restraints(sample.model.setup()), heads(sample.model));
    let mut sums = vec![Vector3::zeros(); sample.model.system().instruments.len()];
    for contact in sample.contacts().filter(|contact| restraints.contains(&contact.surface)) {
        if let Some(of) = heads[contact.sphere] {
            sums[of] += contact.force_n;
        }
    }
    sums.iter().map(|sum| sum.norm()).collect()
}

/// By sphere: the body whose head it belongs to, if any.
pub(crate) fn heads(model: &Model) -> Vec<Option<usize>> {
    let (body, rows) = (model.body(), model.body().tree.bodies());
    let head = |segment: Segment| {
        let of = body.tree.body_of(segment);
        (rows[of].landmarks.instruments()[0] == Some(segment)).then_some(of)
    };
    body.spheres.iter().map(|sphere| head(sphere.segment)).collect()
}
