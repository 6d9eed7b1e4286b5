//! Measures that every body has: head, neck, accelerations, thighs. Each stands once, with what it is called, how it is made
//! and what it is judged by; everything that shows measures takes them from here and from [`super::special`].

use super::definition::{Definition, Finding, Lack, Make, at, level, measure, own, peak, whole};
use super::readings::Readings;
use super::signals::Extreme;
use crate::measure::femur::{DurationLimit, duration_use};
use crate::measure::risk::Severity::{Ais2, Ais3, Ais4};
use crate::measure::risk::{bric_risk, chest_three_ms_risk, femur_risk, hic_risk, neck_axial_risk, nij_risk};
use crate::measure::{
    BricBasis, HicWindow, NeckIntercepts, NeckMode, Peak, Quantity, bric, damage, hic, maximum, nij, peak_towards,
    severity_index,
};
use crate::signal::ChannelClass::{Cfc60, Cfc180, Cfc600, Cfc1000};
use crate::signal::{SignalError, resultant};
use occupant_units::unit::Unit::{MetrePerSecondSquared, Newton, NewtonMetre, One};

/// Measures of the head and of the neck.
pub(super) const HEAD_AND_NECK: &[Definition] = &[
    measure("hic15", "HIC15", One, Cfc1000, |r| r.hic(HicWindow::Ms15))
        .brief()
        .limited(Quantity::Hic15)
        .risks(&[("head AIS2+", Ais2), ("head AIS3+", Ais3), ("head AIS4+", Ais4)], |hic, severity, _| {
            hic_risk(hic, severity)
        }),
    measure("hic36", "HIC36", One, Cfc1000, |r| r.hic(HicWindow::Ms36)).brief().limited(Quantity::Hic36),
    measure("head_peak", "head, peak", MetrePerSecondSquared, Cfc1000, |r| peak(&r.head.peak)).figure("head.peak"),
    measure("head_3ms_contiguous", "head, 3 ms held", MetrePerSecondSquared, Cfc1000, |r| {
        level(&r.head.three_ms_contiguous)
    })
    .figure("head.three_ms_contiguous"),
    measure("head_3ms_cumulative", "head, 3 ms in total", MetrePerSecondSquared, Cfc1000, |r| {
        level(&r.head.three_ms_cumulative)
    })
    .figure("head.three_ms_cumulative")
    .limited(Quantity::HeadThreeMsCumulative),
    measure("gsi", "Gadd severity index", One, Cfc1000, |r| r.severity(&r.head.resultant_m_s2))
        .limited(Quantity::SeverityIndex),
    measure("bric", "BrIC", One, Cfc60, Readings::bric)
        .risks(&[("brain AIS3+", Ais3), ("brain AIS4+", Ais4)], |bric, severity, _| bric_risk(bric, severity)),
    measure("damage", "DAMAGE", One, Cfc60, Readings::damage),
    measure("nij", "Nij", One, Cfc1000, Readings::nij)
        .brief()
        .limited(Quantity::Nij)
        .risks(&[("neck AIS2+", Ais2), ("neck AIS3+", Ais3), ("neck AIS4+", Ais4)], nij_risk),
    measure("neck_tension", "neck tension", Newton, Cfc1000, |r| r.towards(Extreme::Tension, 1.0, &own(&r.neck_n)?[2]))
        .brief()
        .limited(Quantity::NeckTension)
        .risks(&[("neck AIS3+", Ais3)], |force_n, _, dummy| neck_axial_risk(force_n, dummy)),
    measure("neck_compression", "neck compression", Newton, Cfc1000, |r| {
        r.towards(Extreme::Compression, -1.0, &own(&r.neck_n)?[2])
    })
    .brief()
    .limited(Quantity::NeckCompression)
    .risks(&[("neck AIS3+", Ais3)], |force_n, _, dummy| neck_axial_risk(force_n, dummy)),
    measure("neck_shear", "neck shear", Newton, Cfc1000, Readings::neck_shear),
    measure("neck_flexion", "neck flexion moment", NewtonMetre, Cfc600, |r| {
        r.towards(Extreme::Flexion, 1.0, &own(&r.neck_n_m)?[1])
    }),
    measure("neck_extension", "neck extension moment", NewtonMetre, Cfc600, |r| {
        r.towards(Extreme::Extension, -1.0, &own(&r.neck_n_m)?[1])
    }),
];

/// Measures of the chest's acceleration.
pub(super) const CHEST: &[Definition] = &[
    measure("chest_peak", "chest, peak", MetrePerSecondSquared, Cfc180, |r| peak(&r.chest.peak)).figure("chest.peak"),
    measure("chest_3ms_contiguous", "chest, 3 ms held", MetrePerSecondSquared, Cfc180, |r| {
        level(&r.chest.three_ms_contiguous)
    })
    .figure("chest.three_ms_contiguous"),
    measure("chest_3ms_cumulative", "chest, 3 ms in total", MetrePerSecondSquared, Cfc180, |r| {
        level(&r.chest.three_ms_cumulative)
    })
    .figure("chest.three_ms_cumulative")
    .brief()
    .limited(Quantity::ChestThreeMsCumulative)
    .risks(&[("chest AIS3+", Ais3)], |level, _, _| Some(chest_three_ms_risk(level))),
    measure("csi", "chest severity index", One, Cfc180, |r| r.severity(&r.chest.resultant_m_s2))
        .limited(Quantity::SeverityIndex),
];

/// Measures of the pelvis and the femurs.
pub(super) const PELVIS_AND_FEMURS: &[Definition] = &[
    measure("pelvis_peak", "pelvis, peak", MetrePerSecondSquared, Cfc1000, |r| peak(&r.pelvis.peak))
        .figure("pelvis.peak"),
    measure("pelvis_3ms_cumulative", "pelvis, 3 ms in total", MetrePerSecondSquared, Cfc1000, |r| {
        level(&r.pelvis.three_ms_cumulative)
    })
    .figure("pelvis.three_ms_cumulative"),
    femur("right_femur", "right femur compression", |r| r.towards(Extreme::RightFemur, 1.0, own(&r.femur_n[0])?)),
    femur_use("right_femur_duration_use", "right femur over R94 curve", |r| r.femur_use(0)),
    femur("left_femur", "left femur compression", |r| r.towards(Extreme::LeftFemur, 1.0, own(&r.femur_n[1])?)),
    femur_use("left_femur_duration_use", "left femur over R94 curve", |r| r.femur_use(1)),
];

const fn femur(name: &'static str, label: &'static str, of: Make) -> Definition {
    measure(name, label, Newton, Cfc600, of)
        .brief()
        .limited(Quantity::FemurAxial)
        .risks(&[("femur AIS2+", Ais2)], |force_n, _, dummy| femur_risk(force_n, dummy))
}

const fn femur_use(name: &'static str, label: &'static str, of: Make) -> Definition {
    measure(name, label, One, Cfc600, of).limited(Quantity::FemurDurationUse)
}

impl Readings {
    fn hic(&self, window: HicWindow) -> Result<Finding, Lack> {
        let hic = hic(own(&self.head.resultant_m_s2)?, self.interval_s, window)?;
        Ok(Finding { from_s: Some(hic.start_s), to_s: Some(hic.end_s), remark: None, ..whole(hic.value) })
    }

    fn severity(&self, resultant_m_s2: &Result<Vec<f64>, SignalError>) -> Result<Finding, Lack> {
        Ok(whole(severity_index(own(resultant_m_s2)?, self.interval_s)?))
    }

    fn bric(&self) -> Result<Finding, Lack> {
        let [x, y, z] = own(&self.head_rad_s)?;
        let bric = bric(x, y, z, self.interval_s, BricBasis::Average)?;
        let [x, y, z] = bric.peaks_rps.map(|p| p.value);
        let remark = Some(format!("peaks {x:.1}, {y:.1}, {z:.1} rad/s about x, y, z"));
        Ok(Finding { remark, ..whole(bric.value) })
    }

    fn damage(&self) -> Result<Finding, Lack> {
        let [x, y, z] = own(&self.head_rad_s2)?;
        Ok(at(damage(x, y, z, self.interval_s)?))
    }

    fn nij(&self) -> Result<Finding, Lack> {
        let ([_, _, fz], [_, my, _]) = (own(&self.neck_n)?, own(&self.neck_n_m)?);
        let intercepts = NeckIntercepts::of(self.options.dummy).ok_or(Lack::NotOfDummy)?;
        let n = nij(fz, my, self.interval_s, &intercepts)?;
        Ok(Finding { from_s: Some(n.time_s), remark: Some(format!("in {}", mode(n.mode))), ..whole(n.value) })
    }

    /// Largest value of a signal in a direction; 0 if it never has that sign.
    fn towards(&self, which: Extreme, sign: f64, signal: &[f64]) -> Result<Finding, Lack> {
        let sampled = peak_towards(sign, signal, self.interval_s)?;
        let known = self.peak_of(which).map(|peak| Peak { value: peak.value.max(0.0), ..peak });
        Ok(at(known.unwrap_or(sampled)))
    }

    fn neck_shear(&self) -> Result<Finding, Lack> {
        let [x, y, _] = own(&self.neck_n)?;
        let sampled = maximum(&resultant(x, y, &vec![0.0; x.len()])?, self.interval_s)?;
        Ok(at(self.peak_of(Extreme::Shear).unwrap_or(sampled)))
    }

    fn femur_use(&self, side: usize) -> Result<Finding, Lack> {
        let used = duration_use(own(&self.femur_n[side])?, self.interval_s, &DurationLimit::FEMUR_R94_N)?;
        let remark = Some(format!("{:.0} N for {:.1} ms", used.level.max(0.0), used.duration_s * 1e3));
        Ok(Finding { remark, ..whole(used.ratio.max(0.0)) })
    }
}

fn mode(mode: NeckMode) -> &'static str {
    match mode {
        NeckMode::TensionFlexion => "tension and flexion",
        NeckMode::TensionExtension => "tension and extension",
        NeckMode::CompressionFlexion => "compression and flexion",
        NeckMode::CompressionExtension => "compression and extension",
    }
}
