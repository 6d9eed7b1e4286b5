//! The measures as a list: name, value, unit, when.

use crash_measures::unit::Shown;
use crash_measures::unit::Unit::{MetrePerSecond, MetrePerSecondSquared, One, Radian};
use occupant_study::risk::{AXES, Measured};

use super::Report;

/// A unit of the table, and the decimals worth printing in it.
pub(crate) type Unit = (Shown, usize);

pub(crate) fn m_s() -> Unit {
    (MetrePerSecond.shown(), 2)
}

pub(crate) fn km_h() -> Unit {
    (MetrePerSecond.shown_in("km/h"), 1)
}

pub(crate) fn g() -> Unit {
    (MetrePerSecondSquared.shown_in("g"), 2)
}

pub(crate) fn plain() -> Unit {
    (One.shown(), 2)
}

/// Of averages in reports in SI and in those in the US.
fn accelerations() -> [Unit; 2] {
    [g(), (MetrePerSecondSquared.shown(), 1)]
}

/// A measure of the table.
#[derive(Clone, Debug)]
pub(crate) struct Figure {
    /// Name in the table.
    pub(crate) name: String,
    /// Key in JSON, with its SI unit.
    pub(crate) key: String,
    /// Value, SI, with its sign.
    pub(crate) value: f64,
    /// Its units: that of reports in SI, that of reports in the US.
    pub(crate) units: [Unit; 2],
    /// When, s of the record: an instant, or the ends of a window.
    pub(crate) when_s: Vec<f64>,
    /// What else there is to say.
    pub(crate) remark: &'static str,
}

/// What was left out.
#[derive(Clone, Debug)]
pub(crate) struct LeftOut {
    pub(crate) name: String,
    pub(crate) reason: String,
}

/// All measures, and those left out.
pub(crate) struct Figures {
    pub(crate) figures: Vec<Figure>,
    pub(crate) left_out: Vec<LeftOut>,
    start_s: f64,
}

impl Figures {
    /// The measures of a report.
    pub(crate) fn of(report: &Report) -> Self {
        let mut all = Figures { figures: Vec::new(), left_out: Vec::new(), start_s: report.signals.start_s };
        all.flail(report);
        all.head_impact(report);
        all.severity(report);
        all.averages(report);
        all.angles(report);
        all.changes(report);
        all.load_criterion(report);
        all
    }

    fn add(&mut self, name: &str, key: &str, value: f64, units: [Unit; 2], when_s: &[f64]) {
        self.figures.push(Figure {
            name: name.to_owned(),
            key: key.to_owned(),
            value,
            units,
            when_s: when_s.iter().map(|t| self.start_s + t).collect(),
            remark: "",
        });
    }

    fn remark(&mut self, remark: &'static str) {
        if let Some(last) = self.figures.last_mut() {
            last.remark = remark;
        }
    }

    fn leave_out(&mut self, name: &str, reason: impl ToString) {
        self.left_out.push(LeftOut { name: name.to_owned(), reason: reason.to_string() });
    }

    /// The measure, or a line that says why it was left out.
    fn measured<'a, T>(&mut self, name: &str, measure: &'a Measured<T>) -> Option<&'a T> {
        match measure {
            Ok(measure) => Some(measure),
            Err(reason) => {
                self.leave_out(name, reason);
                None
            }
        }
    }

    fn flail(&mut self, report: &Report) {
        let Some(flail) = self.measured("OIV and ORA", &report.risk.flail) else {
            return;
        };
        let when: Vec<f64> = flail.impact_s.into_iter().collect();
        for (name, key, value) in [("OIV x", "oiv_x_m_s", flail.oiv_x_mps), ("OIV y", "oiv_y_m_s", flail.oiv_y_mps)] {
            self.add(name, key, value, [m_s(), (MetrePerSecond.shown_in("ft/s"), 1)], &when);
            if flail.impact_s.is_none() {
                self.remark("no impact: velocity change of the record");
            }
        }
        for (name, key, ridedown) in [("ORA x", "ora_x_m_s2", flail.ora_x), ("ORA y", "ora_y_m_s2", flail.ora_y)] {
            match ridedown {
                Some(w) => self.add(name, key, w.value, accelerations(), &[w.start_s, w.end_s]),
                None => self.leave_out(name, no_ridedown(flail.impact_s)),
            }
        }
    }

    fn head_impact(&mut self, report: &Report) {
        let Some(thiv) = self.measured("THIV and PHD", &report.risk.thiv) else {
            return;
        };
        self.add("THIV", "thiv_m_s", thiv.speed_mps, [km_h(), m_s()], &[thiv.impact_s]);
        match thiv.phd {
            Some(w) => self.add("PHD", "phd_m_s2", w.value, accelerations(), &[w.start_s, w.end_s]),
            None => self.leave_out("PHD", no_ridedown(Some(thiv.impact_s))),
        }
    }

    fn severity(&mut self, report: &Report) {
        for (name, key, measure) in [
            ("ASI (EN 1317-1:1998)", "asi_1998", &report.risk.asi_1998),
            ("ASI (EN 1317-1:2010)", "asi_2010", &report.risk.asi_2010),
        ] {
            if let Some(peak) = self.measured(name, measure) {
                self.add(name, key, peak.value, [plain(); 2], &[peak.time_s]);
            }
        }
    }

    fn averages(&mut self, report: &Report) {
        for (axis, measure) in AXES.iter().zip(&report.risk.max_50ms) {
            let name = format!("max 50 ms average {axis}");
            if let Some(w) = self.measured(&name, measure) {
                let key = format!("max_50ms_{axis}_m_s2");
                self.add(&name, &key, w.value, accelerations(), &[w.start_s, w.end_s]);
            }
        }
    }

    fn angles(&mut self, report: &Report) {
        let angles = &report.risk.angles;
        for (angle, measure) in ["roll", "pitch", "yaw"].into_iter().zip(&angles.largest) {
            let name = format!("max {angle}");
            if let Some(peak) = self.measured(&name, measure) {
                let key = format!("max_{angle}_rad");
                self.add(&name, &key, peak.value, [(Radian.shown_in("deg"), 1); 2], &[peak.time_s]);
                if !angles.of_attitude {
                    self.remark("integral of this rate alone");
                }
            }
        }
    }

    fn changes(&mut self, report: &Report) {
        for (axis, measure) in AXES.iter().zip(&report.risk.velocity_change) {
            let name = format!("velocity change {axis}");
            if let Some(change) = self.measured(&name, measure) {
                let (largest, end_s) = (change.largest, report.signals.end_s() - self.start_s);
                let name = format!("max velocity change {axis}");
                let key = format!("max_velocity_change_{axis}_m_s");
                self.add(&name, &key, largest.value, [m_s(), (MetrePerSecond.shown_in("mph"), 1)], &[largest.time_s]);
                let name = format!("final velocity change {axis}");
                let key = format!("final_velocity_change_{axis}_m_s");
                self.add(&name, &key, change.final_m_s, [m_s(), (MetrePerSecond.shown_in("mph"), 1)], &[end_s]);
            }
        }
    }

    fn load_criterion(&mut self, report: &Report) {
        if let Some(olc) = self.measured("OLC", &report.risk.olc) {
            let when = [olc.free_flight_end_s, olc.end_s];
            self.add("OLC", "olc_m_s2", olc.olc_mps2, accelerations(), &when);
        }
    }
}

fn no_ridedown(impact_s: Option<f64>) -> &'static str {
    match impact_s {
        Some(_) => "the record ends less than 10 ms after the impact of the occupant",
        None => "the occupant never meets the interior within the record",
    }
}
