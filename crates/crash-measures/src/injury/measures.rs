//! The list of measures: each once, with what it is called, how it is made and what it is judged by. Everything that shows
//! measures takes them from here.

use super::readings::Readings;
use super::signals::Extreme;
use super::{Filtering, Measure, Risk};
use crate::measure::femur::{DurationLimit, duration_use};
use crate::measure::risk::Severity::{self, Ais2, Ais3, Ais4};
use crate::measure::risk::{bric_risk, chest_three_ms_risk, femur_risk, hic_risk, neck_axial_risk, nij_risk};
use crate::measure::{
    BricBasis, Dummy, HicWindow, NeckIntercepts, NeckMode, Peak, Quantity, ThreeMs, bric, damage, hic, maximum, nij,
    peak_towards, severity_index,
};
use crate::signal::ChannelClass::{self, Cfc60, Cfc180, Cfc600, Cfc1000};
use crate::signal::{SignalError, resultant};
use occupant_units::unit::Unit::{self, Metre, MetrePerSecondSquared, Newton, NewtonMetre, One};

/// All measures, in the order of a dummy from head to femur.
pub(super) const MEASURES: &[Definition] = &[
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
        .risks(&[("neck AIS2+", Ais2), ("neck AIS3+", Ais3), ("neck AIS4+", Ais4)], |nij, severity, _| {
            nij_risk(nij, severity)
        }),
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
    lacking(
        "chest_deflection",
        "chest deflection",
        Metre,
        "the thorax is rigid: it has no deflection and no viscous criterion",
    ),
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

/// A measure: what it is called, how it is made, what it is judged by.
pub(super) struct Definition {
    name: &'static str,
    label: &'static str,
    unit: Unit,
    figure: Option<&'static str>,
    brief: bool,
    made: Made,
    limited: Option<Quantity>,
    risks: &'static [(&'static str, Severity)],
    curve: fn(f64, Severity, Dummy) -> Option<f64>,
}

/// How a measure is made.
#[derive(Clone, Copy)]
enum Made {
    /// Of signals of this filter class.
    Of(ChannelClass, fn(&Readings) -> Result<Finding, SignalError>),
    /// Not at all, for this reason.
    Never(&'static str),
}

/// A value and the window where it stands, counted from the first sample.
struct Finding {
    value: f64,
    from_s: Option<f64>,
    to_s: Option<f64>,
    remark: Option<String>,
}

const fn measure(
    name: &'static str,
    label: &'static str,
    unit: Unit,
    class: ChannelClass,
    of: fn(&Readings) -> Result<Finding, SignalError>,
) -> Definition {
    let figure = Some(name);
    let (made, limited, risks) = (Made::Of(class, of), None, &[]);
    Definition { name, label, unit, figure, brief: false, made, limited, risks, curve: |_, _, _| None }
}

const fn lacking(name: &'static str, label: &'static str, unit: Unit, reason: &'static str) -> Definition {
    let (made, limited, risks) = (Made::Never(reason), None, &[]);
    Definition { name, label, unit, figure: None, brief: false, made, limited, risks, curve: |_, _, _| None }
}

type Make = fn(&Readings) -> Result<Finding, SignalError>;

const fn femur(name: &'static str, label: &'static str, of: Make) -> Definition {
    measure(name, label, Newton, Cfc600, of)
        .brief()
        .limited(Quantity::FemurAxial)
        .risks(&[("femur AIS2+", Ais2)], |force_n, _, dummy| femur_risk(force_n, dummy))
}

const fn femur_use(name: &'static str, label: &'static str, of: Make) -> Definition {
    measure(name, label, One, Cfc600, of).limited(Quantity::FemurDurationUse)
}

impl Definition {
    /// In tables of many runs it bears this name.
    const fn figure(mut self, name: &'static str) -> Self {
        self.figure = Some(name);
        self
    }

    /// It stands in short tables too.
    const fn brief(mut self) -> Self {
        self.brief = true;
        self
    }

    /// It is judged by the limits of a quantity.
    const fn limited(mut self, quantity: Quantity) -> Self {
        self.limited = Some(quantity);
        self
    }

    /// Probabilities of injuries follow from its value.
    const fn risks(
        mut self,
        injuries: &'static [(&'static str, Severity)],
        curve: fn(f64, Severity, Dummy) -> Option<f64>,
    ) -> Self {
        self.risks = injuries;
        self.curve = curve;
        self
    }

    /// The measure of a run.
    pub(super) fn of(&self, readings: &Readings) -> Measure {
        let (filter_class, finding) = match self.made {
            Made::Never(reason) => (0, Err(reason.to_owned())),
            Made::Of(class, of) => {
                let class = if readings.options.filtering == Filtering::None { 0 } else { class.hertz() as u32 };
                (class, of(readings).map_err(|e| why(&e)))
            }
        };
        let time_s = |of: fn(&Finding) -> Option<f64>| Some(readings.start_s + of(finding.as_ref().ok()?)?);
        let mut measure = Measure {
            name: self.name,
            label: self.label,
            figure: self.figure,
            brief: self.brief,
            unit: self.unit,
            value: finding.as_ref().ok().map(|f| f.value),
            from_s: time_s(|f| f.from_s),
            to_s: time_s(|f| f.to_s),
            filter_class,
            limits: Vec::new(),
            risks: Vec::new(),
            remark: finding.map_or_else(Some, |f| f.remark),
        };
        let Some(value) = measure.value else {
            return measure;
        };
        let dummy = readings.options.dummy;
        if let Some(quantity) = self.limited {
            measure.judge(value, quantity, dummy);
        }
        for &(injury, severity) in self.risks {
            let probability = (self.curve)(value, severity, dummy);
            measure.risks.extend(probability.map(|probability| Risk { injury, probability, agrees: true }));
        }
        measure.compare_risks();
        measure
    }
}

/// Of a measure without a part that it could be of.
const NO_PART: &str = "the body has no such part, or a mount moves it as it is told";

impl Measure {
    /// Whether the body has the part that it is of, and moves it by itself.
    pub fn has_part(&self) -> bool {
        self.remark.as_deref() != Some(NO_PART)
    }

    /// Finds risks, of ever worse injuries, that cannot both be: the worse one is the more likely.
    fn compare_risks(&mut self) {
        for worse in 1..self.risks.len() {
            if self.risks[worse].probability > self.risks[worse - 1].probability {
                self.risks[worse - 1..=worse].iter_mut().for_each(|risk| risk.agrees = false);
            }
        }
        let crossed: Vec<&str> = self.risks.iter().filter(|risk| !risk.agrees).map(|risk| risk.injury).collect();
        if !crossed.is_empty() {
            let found = format!("the curves of {} cross: their risks are not to be quoted", crossed.join(", "));
            self.remark = Some(self.remark.take().map_or_else(|| found.clone(), |known| format!("{known}; {found}")));
        }
    }
}

impl Readings {
    fn hic(&self, window: HicWindow) -> Result<Finding, SignalError> {
        let hic = hic(own(&self.head.resultant_m_s2)?, self.interval_s, window)?;
        Ok(Finding { value: hic.value, from_s: Some(hic.start_s), to_s: Some(hic.end_s), remark: None })
    }

    fn severity(&self, resultant_m_s2: &Result<Vec<f64>, SignalError>) -> Result<Finding, SignalError> {
        severity_index(own(resultant_m_s2)?, self.interval_s).map(whole)
    }

    fn bric(&self) -> Result<Finding, SignalError> {
        let [x, y, z] = own(&self.head_rad_s)?;
        let bric = bric(x, y, z, self.interval_s, BricBasis::Average)?;
        let [x, y, z] = bric.peaks_rps.map(|p| p.value);
        let remark = Some(format!("peaks {x:.1}, {y:.1}, {z:.1} rad/s about x, y, z"));
        Ok(Finding { remark, ..whole(bric.value) })
    }

    fn damage(&self) -> Result<Finding, SignalError> {
        let [x, y, z] = own(&self.head_rad_s2)?;
        damage(x, y, z, self.interval_s).map(at)
    }

    fn nij(&self) -> Result<Finding, SignalError> {
        let ([_, _, fz], [_, my, _]) = (own(&self.neck_n)?, own(&self.neck_n_m)?);
        let n = nij(fz, my, self.interval_s, &NeckIntercepts::of(self.options.dummy))?;
        Ok(Finding { value: n.value, from_s: Some(n.time_s), to_s: None, remark: Some(format!("in {}", mode(n.mode))) })
    }

    /// The greatest value of a signal in a sense; 0 if it never has it.
    fn towards(&self, which: Extreme, sign: f64, signal: &[f64]) -> Result<Finding, SignalError> {
        let sampled = peak_towards(sign, signal, self.interval_s)?;
        let known = self.peak_of(which).map(|peak| Peak { value: peak.value.max(0.0), ..peak });
        Ok(at(known.unwrap_or(sampled)))
    }

    fn neck_shear(&self) -> Result<Finding, SignalError> {
        let [x, y, _] = own(&self.neck_n)?;
        let sampled = maximum(&resultant(x, y, &vec![0.0; x.len()])?, self.interval_s)?;
        Ok(at(self.peak_of(Extreme::Shear).unwrap_or(sampled)))
    }

    fn femur_use(&self, side: usize) -> Result<Finding, SignalError> {
        let used = duration_use(own(&self.femur_n[side])?, self.interval_s, &DurationLimit::FEMUR_R94_N)?;
        let remark = Some(format!("{:.0} N for {:.1} ms", used.level.max(0.0), used.duration_s * 1e3));
        Ok(Finding { remark, ..whole(used.ratio.max(0.0)) })
    }
}

/// Why there is no value; the same words for all classes of filters.
fn why(error: &SignalError) -> String {
    match error {
        SignalError::CornerAboveNyquist { nyquist_hz, .. } => {
            let every_ms = (5e8 / nyquist_hz).round() / 1e6;
            format!("outputs every {every_ms} ms are too coarse for the filter: run with output.interval = \"0.1 ms\"")
        }
        // a reading that is none from the first sample on is that of a part which is not there
        SignalError::NotFinite { index: 0, found, .. } if found.is_nan() => NO_PART.to_owned(),
        error => error.to_string(),
    }
}

fn own<T>(signal: &Result<T, SignalError>) -> Result<&T, SignalError> {
    signal.as_ref().map_err(Clone::clone)
}

/// A measure of the whole record.
fn whole(value: f64) -> Finding {
    Finding { value, from_s: None, to_s: None, remark: None }
}

fn at(peak: Peak) -> Finding {
    Finding { from_s: Some(peak.time_s), ..whole(peak.value) }
}

fn peak(of: &Result<Peak, SignalError>) -> Result<Finding, SignalError> {
    of.clone().map(at)
}

fn level(of: &Result<ThreeMs, SignalError>) -> Result<Finding, SignalError> {
    let level = of.clone()?;
    Ok(Finding { from_s: Some(level.start_s), to_s: Some(level.end_s), ..whole(level.level_mps2) })
}

fn mode(mode: NeckMode) -> &'static str {
    match mode {
        NeckMode::TensionFlexion => "tension and flexion",
        NeckMode::TensionExtension => "tension and extension",
        NeckMode::CompressionFlexion => "compression and flexion",
        NeckMode::CompressionExtension => "compression and extension",
    }
}
