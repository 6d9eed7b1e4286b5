//! Storage of the memory of sphere–face pairs in result files: only pairs that are not open and undeformed, by number.

use super::pane::Pane;
use super::{ContactData, ContactSystem, Contacts, FACE, OPEN, PASSED, PairHistory, TOUCHING, Touch};
use crate::body::Body;
use crate::forces::shown::{Reported, Tracker};
use crate::forces::stored::Archive;
use crate::motion::scalar::Scalar;
use crate::quantity::FieldWords;

/// A file that has more pairs than this is none of ours.
const MOST_PAIRS: u64 = 1 << 20;

/// The event of a pane, followed by the name of a segment.
const BREAKS: &str = "breaks under the";

impl Reported for Contacts {
    #[inline(always)]
    fn track<S: Scalar>(touch: &Touch<S>, tracker: &mut impl Tracker<S>) {
        tracker.touch(touch);
    }

    const BY_STEPS: &'static [&'static str] = &[BREAKS];

    /// Each pane with each segment that may break it.
    fn most_told(law: &ContactSystem<f64>) -> usize {
        law.panes.iter().map(|pane| pane.segments).sum()
    }

    fn tellers(data: ContactData<'_>, law: &ContactSystem<f64>, body: &Body) -> Vec<[String; 2]> {
        let surfaces = data.surfaces.iter().map(|s| &s.name).chain(data.solids.iter().map(|s| &s.name));
        let names: Vec<&String> = surfaces.collect();
        let segments = || body.tree.segments().map(|segment| body.tree[segment].name.to_string());
        let of = |pane: &Pane| segments().map(|segment| [names[pane.surface].clone(), segment]).collect::<Vec<_>>();
        law.panes.iter().flat_map(of).collect()
    }

    fn switched(
        law: &ContactSystem<f64>,
        before: &[PairHistory<f64>],
        now: &[PairHistory<f64>],
        show: &mut dyn FnMut(usize, &'static str),
    ) {
        let both = before.iter().zip(now).skip(law.first_pane());
        for (i, ((before, now), pane)) in both.zip(&law.panes).enumerate() {
            if let (None, Some(segment)) = (before.broken_by(), now.broken_by()) {
                show(i * pane.segments + segment, BREAKS);
            }
        }
    }

    fn keep(past: &mut Vec<PairHistory<f64>>, like: Option<&[PairHistory<f64>]>, file: &mut dyn Archive) {
        let words = |at_output, at_step, stem, meaning| {
            let number = if like.is_some() { at_step } else { at_output };
            FieldWords { number, stem, meaning }
        };
        let mut count = like.unwrap_or(past).len() as u64;
        if like.is_none() {
            file.count(words(4, 4, "pairs", "how many pairs of a sphere and a face there are"), &mut count);
        }
        let which = |is: fn(&PairHistory<f64>) -> bool| {
            (0..).zip(past.iter()).filter(|(_, pair)| is(pair)).map(|(i, _)| i).collect::<Vec<u32>>()
        };
        let [passed, touching, deformed] =
            [which(|p| p.phase == PASSED), which(|p| p.phase == TOUCHING), which(|p| p.greatest != 0.0)];
        let greatest = deformed.iter().map(|i| past[*i as usize].greatest).collect();
        let passed = file.indices(words(5, 28, "passed", "pairs whose sphere went round the edge"), passed);
        let touching = file.indices(words(6, 29, "touching", "pairs that touch"), touching);
        let deformed = file.indices(words(7, 30, "deformed", "pairs that remember a deformation"), deformed);
        let greatest = file.numbers(words(8, 31, "greatest_deformation_m", "of each pair in `deformed`"), greatest);
        let remembering = which(|p| p.phase >= FACE);
        let faces = remembering.iter().map(|i| past[*i as usize].phase - FACE).collect();
        let remembering =
            file.indices(words(38, 40, "in_by_face", "spheres in a solid that came in by a flat face"), remembering);
        let faces = file.numbers(words(39, 41, "face", "number of that face, for each in `in_by_face`"), faces);
        let numbers = passed.iter().chain(&touching).chain(&deformed).chain(&remembering);
        if count > MOST_PAIRS
            || numbers.max().is_some_and(|i| u64::from(*i) >= count)
            || [deformed.len(), remembering.len()] != [greatest.len(), faces.len()]
        {
            return file.refuse("lists of pairs that do not fit each other");
        }
        *past = vec![PairHistory { phase: OPEN, greatest: 0.0 }; count as usize];
        passed.iter().for_each(|i| past[*i as usize].phase = PASSED);
        touching.iter().for_each(|i| past[*i as usize].phase = TOUCHING);
        remembering.iter().zip(faces).for_each(|(i, face)| past[*i as usize].phase = FACE + face);
        deformed.iter().zip(greatest).for_each(|(i, greatest)| past[*i as usize].greatest = greatest);
    }
}
