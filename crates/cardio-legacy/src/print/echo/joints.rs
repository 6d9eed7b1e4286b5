//! Dampers, stops and springs of the joints.

use occupant_core::body::Joint;
use occupant_core::forces::joint::{Joints, Stop};
use occupant_units::unit::Unit::{NewtonMetrePerRadian, NewtonMetreSecondPerRadian, Radian};

use crate::print::{Case, Pages, Table, Units};

/// Writes the joints.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: Units) {
    let joints = &case.model.setup().joints;
    balls(joints, units).write(pages);
    hinges(joints, units).write(pages);
}

fn balls(joints: &Joints, units: Units) -> Table {
    let (d, k) = (units.of(NewtonMetreSecondPerRadian), units.of(NewtonMetrePerRadian));
    let mut table = Table::new(
        format!("BALL JOINTS ({}, DEG, {}); EPSILON OF BETA {}", d.name(), k.name(), joints.epsilon),
        "NO|<JOINT|DAMPING|TWIST|STOP FROM|TO|DAMPING|SPRING|<REST",
    );
    for (joint, law) in joints.iter() {
        let Some(ball) = law.ball() else {
            continue;
        };
        let rest = ball.spring.map(|s| match s.rest_rad {
            Some(rest) => units.of(Radian).show(rest),
            None => "AS AT THE START".to_owned(),
        });
        let damping = [d.show(ball.damping_n_m_s), d.show(ball.twist_damping_n_m_s)];
        let spring = [k.perhaps(ball.spring.map(|s| s.stiffness_n_m)), rest.unwrap_or_else(|| "-".to_owned())];
        table.row_of(&[&label(joints, joint), &damping, &stop(ball.stop, units), &spring]);
    }
    table
}

fn hinges(joints: &Joints, units: Units) -> Table {
    let d = units.of(NewtonMetreSecondPerRadian);
    let mut table = Table::new(
        format!("HINGES ({}, DEG)", d.name()),
        "NO|<JOINT|DAMPING|LOWER STOP FROM|TO|DAMPING|UPPER STOP FROM|TO|DAMPING",
    );
    for (joint, law) in joints.iter() {
        let Some(hinge) = law.hinge() else {
            continue;
        };
        let [lower, upper] = [hinge.lower_stop, hinge.upper_stop].map(|s| stop(s, units));
        table.row_of(&[&label(joints, joint), &[d.show(hinge.damping_n_m_s)], &lower, &upper]);
    }
    table
}

fn label(joints: &Joints, joint: Joint) -> [String; 2] {
    [joint.number().to_string(), joints.tree()[joint].name.to_owned()]
}

fn stop(stop: Option<Stop>, units: Units) -> [String; 3] {
    [
        units.of(Radian).perhaps(stop.map(|s| s.begin_rad)),
        units.of(Radian).perhaps(stop.map(|s| s.full_rad)),
        units.of(NewtonMetreSecondPerRadian).perhaps(stop.map(|s| s.damping_n_m_s)),
    ]
}
