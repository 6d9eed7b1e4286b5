//! The measures as a list: name, value, unit, when.

use crash_measures::measure::{FlailSpace, Peak, Thiv};
use crash_measures::signal::WindowExtreme;
use occupant_study::risk::{AXES, Measured, VehicleRisk, VehicleSignals, VelocityChange};
use occupant_units::unit::Shown;
use occupant_units::unit::Unit::{MetrePerSecond, MetrePerSecondSquared, One, Radian};
use serde::Serialize;

use super::Report;

/// A unit of the table, and the number of printed decimals.
pub type Unit = (Shown, usize);

/// m/s.
pub fn m_s() -> Unit {
    (MetrePerSecond.shown(), 2)
}

/// km/h.
pub fn km_h() -> Unit {
    (MetrePerSecond.shown_in("km/h"), 1)
}

/// ft/s.
pub fn ft_s() -> Unit {
    (MetrePerSecond.shown_in("ft/s"), 1)
}

/// mph.
pub fn mph() -> Unit {
    (MetrePerSecond.shown_in("mph"), 1)
}

/// Degrees.
pub fn deg() -> Unit {
    (Radian.shown_in("deg"), 1)
}

/// Standard gravity.
pub fn g() -> Unit {
    (MetrePerSecondSquared.shown_in("g"), 2)
}

/// A plain number.
pub fn plain() -> Unit {
    (One.shown(), 2)
}

/// Units of average accelerations in SI and US reports.
fn accelerations() -> [Unit; 2] {
    [g(), (MetrePerSecondSquared.shown(), 1)]
}

/// A measure of the table; in JSON its value, time, and remark.
#[derive(Clone, Debug, Serialize)]
pub struct Figure {
    /// Name in the table.
    #[serde(skip)]
    pub name: String,
    /// Key in JSON, with its SI unit.
    #[serde(skip)]
    pub key: String,
    /// Value, SI, with its sign.
    pub value: f64,
    /// Its units in SI and US reports.
    #[serde(skip)]
    pub units: [Unit; 2],
    /// Time, s of the record: an instant, or the ends of a window.
    pub when_s: Vec<f64>,
    /// Remark.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub remark: &'static str,
}

/// A missing measure.
#[derive(Clone, Debug, Serialize)]
pub struct LeftOut {
    /// The measure.
    pub measure: String,
    /// The reason.
    pub reason: String,
}

/// All measures, and the missing ones.
pub struct Figures {
    /// The figures.
    pub figures: Vec<Figure>,
    /// Missing measures.
    pub left_out: Vec<LeftOut>,
    start_s: f64,
}

impl Figures {
    /// The measures of a report.
    pub fn of(report: &Report) -> Self {
        Figures::of_risk(&report.risk, &report.signals)
    }

    /// The measures of a vehicle's motion.
    pub fn of_risk(risk: &VehicleRisk, signals: &VehicleSignals) -> Self {
        let mut all = Figures { figures: Vec::new(), left_out: Vec::new(), start_s: signals.start_s };
        all.flail(&risk.flail);
        all.head_impact(&risk.thiv);
        for (edition, asi) in [("1998", &risk.asi_1998), ("2010", &risk.asi_2010)] {
            let name = format!("ASI (EN 1317-1:{edition})");
            all.peak(&name, &format!("asi_{edition}"), asi, [plain(); 2], "");
        }
        for (axis, average) in AXES.iter().zip(&risk.max_50ms) {
            let name = format!("max 50 ms average {axis}");
            if let Some(average) = all.measured(&name, average) {
                all.window(&name, &format!("max_50ms_{axis}_m_s2"), average);
            }
        }
        let remark = if risk.angles.of_attitude { "" } else { "integral of this rate alone" };
        for (angle, largest) in ["roll", "pitch", "yaw"].into_iter().zip(&risk.angles.largest) {
            let (name, key) = (format!("max {angle}"), format!("max_{angle}_rad"));
            all.peak(&name, &key, largest, [deg(); 2], remark);
        }
        for (axis, change) in AXES.iter().zip(&risk.velocity_change) {
            all.velocity_change(axis, change, signals.end_s());
        }
        if let Some(olc) = all.measured("OLC", &risk.olc) {
            all.add("OLC", "olc_m_s2", olc.olc_mps2, accelerations(), &[olc.free_flight_end_s, olc.end_s]);
        }
        all
    }

    fn add(&mut self, name: &str, key: &str, value: f64, units: [Unit; 2], when_s: &[f64]) -> &mut Figure {
        let (name, key) = (name.to_owned(), key.to_owned());
        let when_s = when_s.iter().map(|t| self.start_s + t).collect();
        self.figures.push(Figure { name, key, value, units, when_s, remark: "" });
        let last = self.figures.len() - 1;
        &mut self.figures[last]
    }

    /// The measure, or a line with the reason why it is missing.
    fn measured<'a, T>(&mut self, name: &str, measure: &'a Result<T, impl ToString>) -> Option<&'a T> {
        let left_out = |reason: &_| LeftOut { measure: name.to_owned(), reason: ToString::to_string(reason) };
        self.left_out.extend(measure.as_ref().err().map(left_out));
        measure.as_ref().ok()
    }

    fn peak(&mut self, name: &str, key: &str, peak: &Measured<Peak>, units: [Unit; 2], remark: &'static str) {
        if let Some(peak) = self.measured(name, peak) {
            self.add(name, key, peak.value, units, &[peak.time_s]).remark = remark;
        }
    }

    /// An average acceleration over a window.
    fn window(&mut self, name: &str, key: &str, average: &WindowExtreme) {
        self.add(name, key, average.value, accelerations(), &[average.start_s, average.end_s]);
    }

    /// An average after the occupant's impact.
    fn ridedown(&mut self, name: &str, key: &str, average: Option<WindowExtreme>, impact_s: Option<f64>) {
        let average = average.ok_or(match impact_s {
            Some(_) => "the record ends less than 10 ms after the occupant impact",
            None => "the occupant does not reach the interior within the record",
        });
        if let Some(average) = self.measured(name, &average) {
            self.window(name, key, average);
        }
    }

    fn flail(&mut self, flail: &Measured<FlailSpace>) {
        let Some(flail) = self.measured("OIV and ORA", flail) else {
            return;
        };
        let units = [m_s(), ft_s()];
        for (name, key, value) in [("OIV x", "oiv_x_m_s", flail.oiv_x_mps), ("OIV y", "oiv_y_m_s", flail.oiv_y_mps)] {
            let oiv = self.add(name, key, value, units, flail.impact_s.as_slice());
            oiv.remark = flail.impact_s.map_or("no impact: velocity change of the record", |_| "");
        }
        self.ridedown("ORA x", "ora_x_m_s2", flail.ora_x, flail.impact_s);
        self.ridedown("ORA y", "ora_y_m_s2", flail.ora_y, flail.impact_s);
    }

    fn head_impact(&mut self, thiv: &Measured<Thiv>) {
        if let Some(thiv) = self.measured("THIV and PHD", thiv) {
            self.add("THIV", "thiv_m_s", thiv.speed_mps, [km_h(), m_s()], &[thiv.impact_s]);
            self.ridedown("PHD", "phd_m_s2", thiv.phd, Some(thiv.impact_s));
        }
    }

    fn velocity_change(&mut self, axis: &str, change: &Measured<VelocityChange>, end_s: f64) {
        let Some(change) = self.measured(&format!("velocity change {axis}"), change) else {
            return;
        };
        let last = Peak { value: change.final_m_s, time_s: end_s - self.start_s };
        for (which, Peak { value, time_s }) in [("max", change.largest), ("final", last)] {
            let name = format!("{which} velocity change {axis}");
            let key = format!("{which}_velocity_change_{axis}_m_s");
            self.add(&name, &key, value, [m_s(), mph()], &[time_s]);
        }
    }
}
