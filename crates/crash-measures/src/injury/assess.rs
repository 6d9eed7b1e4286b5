//! From signals to measures.

use super::signals::{Components, Signals};
use super::{Filtering, Measure, Options, Risk};
use crate::measure::femur::{DurationLimit, duration_use};
use crate::measure::risk::{Severity, bric_risk, chest_three_ms_risk, femur_risk, hic_risk, neck_axial_risk, nij_risk};
use crate::measure::{
    BricBasis, HicWindow, NeckIntercepts, NeckMode, Peak, Quantity, ThreeMs, bric, damage, hic, maximum, minimum,
    neck_axial_peaks, nij, severity_index, three_ms_contiguous, three_ms_cumulative,
};
use crate::signal::{ChannelClass, SignalError, filter_cfc, resultant};
use crate::unit::Unit;

/// All measures, in the order of a dummy from head to femur. The list has the same names for every run.
pub fn assess(signals: &Signals, options: &Options) -> Vec<Measure> {
    let mut a = Assessment { signals, options, measures: Vec::with_capacity(24) };
    a.head();
    a.brain();
    a.neck();
    a.chest();
    a.pelvis();
    a.femurs();
    a.measures
}

/// A value and the window where it stands, counted from the first sample.
struct Found {
    value: f64,
    from_s: Option<f64>,
    to_s: Option<f64>,
    remark: Option<String>,
}

impl Found {
    fn at(peak: Peak) -> Self {
        Found { value: peak.value, from_s: Some(peak.time_s), to_s: None, remark: None }
    }

    fn over(level: ThreeMs) -> Self {
        Found { value: level.level_mps2, from_s: Some(level.start_s), to_s: Some(level.end_s), remark: None }
    }
}

/// What a measure is called.
#[derive(Clone, Copy)]
struct Title {
    name: &'static str,
    label: &'static str,
    unit: Unit,
    class: ChannelClass,
}

const fn title(name: &'static str, label: &'static str, unit: Unit, class: ChannelClass) -> Title {
    Title { name, label, unit, class }
}

/// Measures in the making.
struct Assessment<'a> {
    signals: &'a Signals,
    options: &'a Options,
    measures: Vec<Measure>,
}

use ChannelClass::{Cfc60, Cfc180, Cfc600, Cfc1000};
use Unit::{MetrePerSecondSquared as Acceleration, Newton, NewtonMetre, One};

impl Assessment<'_> {
    fn head(&mut self) {
        let (a, dt) = (self.resultant(&self.signals.head_m_s2, Cfc1000), self.signals.interval_s);
        let criterion = |window| {
            a.clone().and_then(|a| {
                let hic = hic(&a, dt, window)?;
                Ok(Found { value: hic.value, from_s: Some(hic.start_s), to_s: Some(hic.end_s), remark: None })
            })
        };
        let m = self.add(title("hic15", "HIC15", One, Cfc1000), criterion(HicWindow::Ms15), Some(Quantity::Hic15));
        m.risks(
            &[("head AIS2+", Severity::Ais2), ("head AIS3+", Severity::Ais3), ("head AIS4+", Severity::Ais4)],
            hic_risk,
        );
        self.add(title("hic36", "HIC36", One, Cfc1000), criterion(HicWindow::Ms36), Some(Quantity::Hic36));
        self.add(
            title("head_peak", "head, peak", Acceleration, Cfc1000),
            of(&a, |a| maximum(a, dt)).map(Found::at),
            None,
        );
        self.add(
            title("head_3ms_contiguous", "head, 3 ms held", Acceleration, Cfc1000),
            of(&a, |a| three_ms_contiguous(a, dt)).map(Found::over),
            None,
        );
        self.add(
            title("head_3ms_cumulative", "head, 3 ms in total", Acceleration, Cfc1000),
            of(&a, |a| three_ms_cumulative(a, dt)).map(Found::over),
            Some(Quantity::HeadThreeMsCumulative),
        );
        self.add(
            title("gsi", "Gadd severity index", One, Cfc1000),
            of(&a, |a| severity_index(a, dt)).map(whole),
            Some(Quantity::SeverityIndex),
        );
    }

    fn brain(&mut self) {
        let dt = self.signals.interval_s;
        let w = self.filtered(&self.signals.head_rad_s, Cfc60);
        let found = w.and_then(|[x, y, z]| bric(&x, &y, &z, dt, BricBasis::Average));
        let found = found.map(|b| Found {
            remark: Some(format!(
                "peaks {:.1}, {:.1}, {:.1} rad/s about x, y, z",
                b.peaks_rps[0].value, b.peaks_rps[1].value, b.peaks_rps[2].value
            )),
            ..whole(b.value)
        });
        let m = self.add(title("bric", "BrIC", One, Cfc60), found, None);
        m.risks(&[("brain AIS3+", Severity::Ais3), ("brain AIS4+", Severity::Ais4)], bric_risk);
        let alpha = self.filtered(&self.signals.head_rad_s2, Cfc60);
        let found = alpha.and_then(|[x, y, z]| damage(&x, &y, &z, dt));
        self.add(title("damage", "DAMAGE", One, Cfc60), found.map(Found::at), None);
    }

    fn neck(&mut self) {
        let dt = self.signals.interval_s;
        let dummy = self.options.dummy;
        let force = self.filtered(&self.signals.neck_n, Cfc1000);
        let moment = self.filtered(&self.signals.neck_n_m, Cfc600);
        let both = force.clone().and_then(|f| Ok((f, moment.clone()?)));
        let found = both.and_then(|([_, _, fz], [_, my, _])| {
            let n = nij(&fz, &my, dt, &NeckIntercepts::of(dummy))?;
            Ok(Found {
                value: n.value,
                from_s: Some(n.time_s),
                to_s: None,
                remark: Some(format!("in {}", mode(n.mode))),
            })
        });
        let m = self.add(title("nij", "Nij", One, Cfc1000), found, Some(Quantity::Nij));
        m.risks(
            &[("neck AIS2+", Severity::Ais2), ("neck AIS3+", Severity::Ais3), ("neck AIS4+", Severity::Ais4)],
            nij_risk,
        );
        let axial = of(&force, |f| neck_axial_peaks(&f[2], dt));
        let tension = axial.clone().map(|(tension, _)| Found::at(not_negative(tension)));
        let compression = axial.map(|(_, compression)| Found::at(not_negative(compression)));
        for (t, found, quantity) in [
            (title("neck_tension", "neck tension", Newton, Cfc1000), tension, Quantity::NeckTension),
            (title("neck_compression", "neck compression", Newton, Cfc1000), compression, Quantity::NeckCompression),
        ] {
            let m = self.add(t, found, Some(quantity));
            m.risks(&[("neck AIS3+", Severity::Ais3)], |force_n, _| neck_axial_risk(force_n, dummy));
        }
        let shear = of(&force, |f| resultant(&f[0], &f[1], &vec![0.0; f[0].len()]));
        self.add(
            title("neck_shear", "neck shear", Newton, Cfc1000),
            of(&shear, |s| maximum(s, dt)).map(Found::at),
            None,
        );
        let flexion = of(&moment, |m| maximum(&m[1], dt)).map(|p| Found::at(not_negative(p)));
        let extension = of(&moment, |m| minimum(&m[1], dt)).map(|p| {
            let value = -p.value;
            Found::at(not_negative(Peak { value, ..p }))
        });
        self.add(title("neck_flexion", "neck flexion moment", NewtonMetre, Cfc600), flexion, None);
        self.add(title("neck_extension", "neck extension moment", NewtonMetre, Cfc600), extension, None);
    }

    fn chest(&mut self) {
        let (a, dt) = (self.resultant(&self.signals.chest_m_s2, Cfc180), self.signals.interval_s);
        self.add(
            title("chest_peak", "chest, peak", Acceleration, Cfc180),
            of(&a, |a| maximum(a, dt)).map(Found::at),
            None,
        );
        self.add(
            title("chest_3ms_contiguous", "chest, 3 ms held", Acceleration, Cfc180),
            of(&a, |a| three_ms_contiguous(a, dt)).map(Found::over),
            None,
        );
        let m = self.add(
            title("chest_3ms_cumulative", "chest, 3 ms in total", Acceleration, Cfc180),
            of(&a, |a| three_ms_cumulative(a, dt)).map(Found::over),
            Some(Quantity::ChestThreeMsCumulative),
        );
        m.risks(&[("chest AIS3+", Severity::Ais3)], |level, _| Some(chest_three_ms_risk(level)));
        self.add(
            title("csi", "chest severity index", One, Cfc180),
            of(&a, |a| severity_index(a, dt)).map(whole),
            Some(Quantity::SeverityIndex),
        );
        self.measures.push(Measure {
            remark: Some("the thorax is rigid: it has no deflection and no viscous criterion".to_owned()),
            ..Measure::without_value(title("chest_deflection", "chest deflection", Unit::Metre, Cfc180), 0)
        });
    }

    fn pelvis(&mut self) {
        let (a, dt) = (self.resultant(&self.signals.pelvis_m_s2, Cfc1000), self.signals.interval_s);
        self.add(
            title("pelvis_peak", "pelvis, peak", Acceleration, Cfc1000),
            of(&a, |a| maximum(a, dt)).map(Found::at),
            None,
        );
        self.add(
            title("pelvis_3ms_cumulative", "pelvis, 3 ms in total", Acceleration, Cfc1000),
            of(&a, |a| three_ms_cumulative(a, dt)).map(Found::over),
            None,
        );
    }

    fn femurs(&mut self) {
        let (dt, dummy) = (self.signals.interval_s, self.options.dummy);
        let names = [
            ("right_femur", "right femur compression", "right_femur_duration_use", "right femur over R94 curve"),
            ("left_femur", "left femur compression", "left_femur_duration_use", "left femur over R94 curve"),
        ];
        for (i, (name, label, use_name, use_label)) in names.into_iter().enumerate() {
            let pressed: Vec<f64> = self.signals.femur_n[i].iter().map(|f| -f).collect();
            let pressed = self.filter(&pressed, Cfc600);
            let peak = of(&pressed, |f| maximum(f, dt)).map(|p| Found::at(not_negative(p)));
            let m = self.add(title(name, label, Newton, Cfc600), peak, Some(Quantity::FemurAxial));
            m.risks(&[("femur AIS2+", Severity::Ais2)], |force_n, _| femur_risk(force_n, dummy));
            let used = of(&pressed, |f| duration_use(f, dt, &DurationLimit::FEMUR_R94_N));
            let used = used.map(|u| Found {
                remark: Some(format!("{:.0} N for {:.1} ms", u.level.max(0.0), u.duration_s * 1e3)),
                ..whole(u.ratio.max(0.0))
            });
            self.add(title(use_name, use_label, One, Cfc600), used, Some(Quantity::FemurDurationUse));
        }
    }

    /// Adds a measure, judged by the limits of `quantity`.
    fn add(&mut self, title: Title, found: Result<Found, SignalError>, quantity: Option<Quantity>) -> &mut Measure {
        let class = match self.options.filtering {
            Filtering::None => 0,
            Filtering::Classes(_) => title.class.hertz() as u32,
        };
        let mut measure = Measure::without_value(title, class);
        let start_s = self.signals.start_s;
        match found {
            Ok(found) => {
                measure.value = Some(found.value);
                measure.from_s = found.from_s.map(|t| start_s + t);
                measure.to_s = found.to_s.map(|t| start_s + t);
                measure.remark = found.remark;
            }
            Err(error) => measure.remark = Some(error.to_string()),
        }
        if let Some(quantity) = quantity {
            measure.judge(quantity, self.options.dummy);
        }
        let at = self.measures.len();
        self.measures.push(measure);
        &mut self.measures[at]
    }

    fn resultant(&self, components: &Components, class: ChannelClass) -> Result<Vec<f64>, SignalError> {
        let [x, y, z] = self.filtered(components, class)?;
        resultant(&x, &y, &z)
    }

    fn filtered(&self, components: &Components, class: ChannelClass) -> Result<Components, SignalError> {
        let [x, y, z] = components;
        Ok([self.filter(x, class)?, self.filter(y, class)?, self.filter(z, class)?])
    }

    fn filter(&self, values: &[f64], class: ChannelClass) -> Result<Vec<f64>, SignalError> {
        match self.options.filtering {
            Filtering::None => Ok(values.to_vec()),
            Filtering::Classes(family) => filter_cfc(values, self.signals.interval_s, class, family),
        }
    }
}

impl Measure {
    fn without_value(title: Title, filter_class: u32) -> Self {
        Measure {
            name: title.name,
            label: title.label,
            unit: title.unit,
            value: None,
            from_s: None,
            to_s: None,
            filter_class,
            remark: None,
            limits: Vec::new(),
            risks: Vec::new(),
        }
    }

    /// Adds the risks that a curve gives for the value.
    fn risks(&mut self, injuries: &[(&'static str, Severity)], curve: impl Fn(f64, Severity) -> Option<f64>) {
        let Some(value) = self.value else {
            return;
        };
        for &(injury, severity) in injuries {
            if let Some(probability) = curve(value, severity) {
                self.risks.push(Risk { injury, probability });
            }
        }
    }
}

/// A measure of the whole record.
fn whole(value: f64) -> Found {
    Found { value, from_s: None, to_s: None, remark: None }
}

fn of<A, B>(signal: &Result<A, SignalError>, measure: impl Fn(&A) -> Result<B, SignalError>) -> Result<B, SignalError> {
    signal.as_ref().map_err(Clone::clone).and_then(measure)
}

/// A peak in the other direction counts as none.
fn not_negative(peak: Peak) -> Peak {
    Peak { value: peak.value.max(0.0), ..peak }
}

fn mode(mode: NeckMode) -> &'static str {
    match mode {
        NeckMode::TensionFlexion => "tension and flexion",
        NeckMode::TensionExtension => "tension and extension",
        NeckMode::CompressionFlexion => "compression and flexion",
        NeckMode::CompressionExtension => "compression and extension",
    }
}
