//! Peak values of a run with their times, at its accepted steps: they include what happens between outputs and do not
//! depend on the output interval.

use crate::results::summary::Peak;

/// Number of peaks of the instruments of one body.
pub(crate) const FELT: usize = 16;
/// Index of the excursions among them: forward, rearward, right, left, down, up.
pub(crate) const EXCURSIONS: usize = 10;

/// Largest values at the accepted steps of a run so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Peaks {
    /// Tracked values of the kinds of force elements, in the order of kinds, elements and peaks.
    pub(crate) elements: Vec<Peak>,
    /// By body: resultants of the accelerometers of head, chest and pelvis, m/s²; tension, compression, shear of the
    /// neck, N, its flexion and extension, N·m; compression of the right and the left femur, N; excursions of the head,
    /// m.
    pub(crate) felt: Vec<[Peak; FELT]>,
    /// By part of the body.
    pub(crate) parts: Vec<PartPeak>,
}

/// Largest values of the contacts of one part of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PartPeak {
    /// Magnitude of the sum of the forces, N.
    pub force: Peak,
    /// Surface of the largest normal force at that time.
    pub surface: usize,
    /// Δ, m.
    pub penetration: Peak,
    /// Largest Δ over the thickness of a solid.
    pub used: f64,
    /// Δ in a bar or a rim whose axis was crossed by a sphere's centre, m, and its index.
    pub through: Peak,
    pub bar: usize,
}

impl PartPeak {
    const NONE: PartPeak =
        PartPeak { force: Peak::NONE, surface: 0, penetration: Peak::NONE, used: 0.0, through: Peak::NONE, bar: 0 };

    /// Records a sphere's centre that crosses the axis of a bar.
    pub(crate) fn go_through(&mut self, depth_m: f64, bar: usize, time_s: f64) {
        if self.through.see(depth_m, time_s) {
            self.bar = bar;
        }
    }
}

impl Peaks {
    /// Empty peaks for these numbers of values, bodies and parts.
    pub(crate) fn none(elements: usize, bodies: usize, parts: usize) -> Self {
        Peaks {
            elements: vec![Peak::NONE; elements],
            felt: vec![[Peak::NONE; FELT]; bodies],
            parts: vec![PartPeak::NONE; parts],
        }
    }

    /// Whether steps were not recorded, as in files before 0.2.
    pub(crate) fn are_unknown(&self) -> bool {
        self.felt.is_empty()
    }

    /// Clears everything without allocation.
    pub(crate) fn clear(&mut self) {
        self.elements.fill(Peak::NONE);
        self.felt.fill([Peak::NONE; FELT]);
        self.parts.fill(PartPeak::NONE);
    }

    /// Copies `other`, of the same run, without allocation if the space suffices.
    pub(crate) fn take_over(&mut self, other: &Peaks) {
        self.elements.clone_from(&other.elements);
        self.felt.clone_from(&other.felt);
        self.parts.clone_from(&other.parts);
    }

    /// Adds the peaks of `later`, recorded after these.
    pub(crate) fn merge(&mut self, later: &Peaks) {
        let felt = self.felt.iter_mut().flatten().zip(later.felt.iter().flatten());
        for (peak, other) in self.elements.iter_mut().zip(&later.elements).chain(felt) {
            peak.see(other.value, other.time_s);
        }
        for (part, other) in self.parts.iter_mut().zip(&later.parts) {
            if part.force.see(other.force.value, other.force.time_s) {
                part.surface = other.surface;
            }
            part.penetration.see(other.penetration.value, other.penetration.time_s);
            part.used = part.used.max(other.used);
            part.go_through(other.through.value, other.bar, other.through.time_s);
        }
    }

    /// All as plain numbers: values and times.
    pub(crate) fn numbers(&self) -> Vec<f64> {
        let peaks = self.elements.iter().chain(self.felt.iter().flatten());
        let parts = self.parts.iter().flat_map(|part| {
            let PartPeak { force, surface, penetration, used, through, bar } = *part;
            let places = [surface, bar].map(|place| place as f64);
            let peaks = [force, penetration, through].map(|peak| [peak.value, peak.time_s]);
            peaks.into_iter().flatten().chain(places).chain([used])
        });
        peaks.flat_map(|peak| [peak.value, peak.time_s]).chain(parts).collect()
    }

    /// Sets them from plain numbers; false if they are of another run.
    pub(crate) fn read(&mut self, numbers: &[f64]) -> bool {
        let (peaks, parts) = (2 * (self.elements.len() + FELT * self.felt.len()), 9 * self.parts.len());
        if numbers.len() != peaks + parts {
            return false;
        }
        let (pairs, _) = numbers[..peaks].as_chunks();
        let all = self.elements.iter_mut().chain(self.felt.iter_mut().flatten());
        all.zip(pairs).for_each(|(peak, &[value, time_s])| *peak = Peak { value, time_s });
        let (rows, _) = numbers[peaks..].as_chunks();
        for (part, &[force, force_s, depth, depth_s, through, through_s, surface, bar, used]) in
            self.parts.iter_mut().zip(rows)
        {
            let peak = |value, time_s| Peak { value, time_s };
            let (force, penetration, through) = (peak(force, force_s), peak(depth, depth_s), peak(through, through_s));
            *part = PartPeak { force, surface: surface as usize, penetration, used, through, bar: bar as usize };
        }
        true
    }
}
