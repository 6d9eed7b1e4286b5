//! Measures of a blow from behind. They are listed where T1 or the head restraint is read.

use super::definition::{Definition, Finding, Lack, at, measure, own, whole};
use super::readings::Readings;
use super::special::Special;
use crate::measure::whiplash::{
    LowerNeckIntercepts, LowerNeckLoads, NkmMode, RestraintContact, greatest_until, lower_neck_load, relative_travel,
};
use crate::measure::{
    Blow, HeadContact, Nic, NkmIntercepts, Quantity, head_restraint_contact, nic, nkm, peak_towards, rebound_speed,
};
use crate::signal::ChannelClass::{Cfc60, Cfc600, Cfc1000};
use occupant_units::unit::Unit::{Metre, MetrePerSecond, MetrePerSecondSquared, Newton, One, Second};

/// Measures of whiplash.
pub(super) const WHIPLASH: &[Definition] = &[
    measure("nic", "NIC, m²/s²", One, Cfc60, |r| Ok(at(r.nic()?.greatest))).brief().limited(Quantity::Nic),
    measure("nic_at_contact", "NIC at head contact, m²/s²", One, Cfc60, Readings::nic_at_contact)
        .weighed(Quantity::Nic),
    measure("nkm", "Nkm", One, Cfc600, Readings::nkm).brief().limited(Quantity::Nkm),
    measure("neck_shear_ahead", "neck shear, head pushed forward", Newton, Cfc1000, |r| {
        r.is_rear()?;
        Ok(at(peak_towards(1.0, &own(&r.neck_n)?[0], r.interval_s)?))
    })
    .limited(Quantity::NeckShearAhead),
    measure("t1_acceleration", "T1 ahead, peak", MetrePerSecondSquared, Cfc60, |r| {
        let t1 = r.special(Special::T1)?;
        let end_s = r.contact()?.map_or(f64::INFINITY, |contact| contact.end_s);
        Ok(at(greatest_until(&t1, r.interval_s, end_s)?))
    })
    .brief()
    .limited(Quantity::T1Acceleration),
    measure("head_contact_time", "head contact with restraint", Second, Cfc600, Readings::contact_time)
        .brief()
        .limited(Quantity::HeadContactTime),
    measure("rebound_speed", "head rebound", MetrePerSecond, Cfc60, |r| {
        let speed = r.special(Special::HeadSpeed)?;
        let from_s = r.contact()?.map_or(0.0, |contact| contact.start_s);
        Ok(at(rebound_speed(&speed, &vec![0.0; speed.len()], r.interval_s, from_s)?))
    })
    .limited(Quantity::ReboundSpeed),
    measure("lower_neck_load", "lower neck load index", One, Cfc1000, Readings::lower_neck),
    measure("pelvis_travel_back", "pelvis travel into the seat", Metre, Cfc60, |r| {
        let place = r.special(Special::PelvisPlace)?;
        Ok(at(relative_travel(&place, &vec![0.0; place.len()], r.interval_s)?.back))
    }),
];

impl Readings {
    /// Whether any whiplash signal is recorded, or a whiplash dummy is requested.
    fn is_rear(&self) -> Result<(), Lack> {
        let reads = [Special::T1, Special::HeadRestraint].iter().any(|which| self.has(*which));
        if reads || self.options.dummy.blow() == Blow::Rear { Ok(()) } else { Err(Lack::Absent) }
    }

    /// The head's contact with its restraint, if recorded and present.
    fn contact(&self) -> Result<Option<HeadContact>, Lack> {
        match self.special(Special::HeadRestraint) {
            Ok(force) => Ok(head_restraint_contact(&force, self.interval_s, &RestraintContact::default())?),
            Err(Lack::Absent) => Ok(None),
            Err(lack) => Err(lack),
        }
    }

    /// NIC of T1 and of the head's forward reading, both CFC 60.
    fn nic(&self) -> Result<Nic, Lack> {
        let t1 = self.special(Special::T1)?;
        let head = own(&self.head_ahead_m_s2)?;
        Ok(nic(&t1, head, self.interval_s, self.contact()?.as_ref())?)
    }

    fn nic_at_contact(&self) -> Result<Finding, Lack> {
        let found = self.nic()?;
        self.special(Special::HeadRestraint)?;
        let value = found.at_contact.ok_or(Lack::NoContact)?;
        Ok(Finding { from_s: self.contact()?.map(|contact| contact.start_s), ..whole(value) })
    }

    fn nkm(&self) -> Result<Finding, Lack> {
        self.is_rear()?;
        let intercepts = NkmIntercepts::of(self.options.dummy).ok_or(Lack::NotOfDummy)?;
        // both of one class: the parts belong to one time
        let found = nkm(own(&self.neck_shear_n)?, &own(&self.neck_n_m)?[1], self.interval_s, &intercepts)?;
        let mode = match found.mode {
            NkmMode::FlexionAnterior => "flexion and anterior shear",
            NkmMode::ExtensionAnterior => "extension and anterior shear",
            NkmMode::FlexionPosterior => "flexion and posterior shear",
            NkmMode::ExtensionPosterior => "extension and posterior shear",
        };
        Ok(Finding { remark: Some(format!("in {mode}")), from_s: Some(found.time_s), ..whole(found.value) })
    }

    fn contact_time(&self) -> Result<Finding, Lack> {
        self.special(Special::HeadRestraint)?;
        let contact = self.contact()?.ok_or(Lack::NoContact)?;
        Ok(Finding {
            from_s: Some(contact.start_s),
            to_s: Some(contact.end_s),
            ..whole(self.start_s + contact.start_s)
        })
    }

    fn lower_neck(&self) -> Result<Finding, Lack> {
        let of = |axis| self.special(Special::LowerNeckForce(axis));
        let about = |axis| self.special(Special::LowerNeckMoment(axis));
        let (fx, fy, fz, mx, my) = (&of(0)?, &of(1)?, &of(2)?, &about(0)?, &about(1)?);
        let loads = LowerNeckLoads { force_n: [fx, fy, fz], moment_nm: [mx, my] };
        Ok(at(lower_neck_load(&loads, self.interval_s, &LowerNeckIntercepts::default())?))
    }
}
