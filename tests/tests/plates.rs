//! Plates of the trunk: a hub on point masses, books, rigid limits, side by side.

use occupant_core::model::Model;
use occupant_core::results::channel::{Channel, Series, channels};
use occupant_core::results::outcome::Status;
use occupant_core::run::simulate::simulate;
use occupant_tests::measure::{assert_below, assert_within};
use occupant_tests::room::{ends_alike_side_by_side, setup};

/// A spine of 38 kg that is free, its breastbone, and a hub that comes head on: three point masses.
const HUB: &str = r#"
title = "a hub on a breastbone"
gravity = 0
time = { end = "60 ms" }
output = { interval = "0.02 ms" }
path = { kind = "fixed" }
contact = { bodies = [] }
mount = { segment = "trunk", frame = "space", point = [0, 0, 0.2], place = [0, 0, 0], let_go = [0, 0, 0] }

[body]
segments.trunk = { length = 0.4, cg_from_lower_end = 0.2, mass = 38.1, inertia = [2, 2, 2] }
segments.cap = { length = 0.1, cg_from_lower_end = 0.05, mass = 0.1, inertia = [0.001, 0.001, 0.001] }
joints.top = { proximal = "trunk", distal = "cap", kind = "fixed", on_proximal = [0, 0, 0.15], on_distal = [0, 0, 0] }
spheres.front = { segment = "trunk", centre = [0, 0, 0.2], radius = 0.1, ride = { contact = { sternum = 1 } } }

[body.plates.sternum]
segment = "trunk"
at = [0.1, 0, 0.2]
inward = [-1, 0, 0]
mass = 0.2
depth = "0.24 m"
spring = { depth = [0, "22 mm", "100 mm"], force = [0, "220 N", "4.12 kN"], returned = 0.3 }
damper = { linear = "40 N s/m", quadratic = "116 N s^2/m^2", outward = "650 N s/m" }

[joints.top]

[materials.skin]
k1 = "480 kN/m"
mu1 = 0.7
friction = 0

[loose.hub]
mass = 23.4
inertia = [0.1, 0.1, 0.1]
at = [0.1, 0, 0]
velocity = [-6.7, 0, 0]

[surfaces.face]
frame = "hub"
meets = "all"
material = "skin"
points = [[0, -0.5, -0.5], [0, 0.5, -0.5], [0, 0.5, 0.5], [0, -0.5, 0.5]]
inside = [-1, 0, 0]
"#;

/// Values of the channels of these names; the run must end well.
fn traced(text: &str, set: &[&str], names: &[&str]) -> Vec<Vec<f64>> {
    let model = Model::new(setup(text, set)).unwrap_or_else(|problems| panic!("{problems}"));
    let known = channels(&model);
    let wanted = |name: &&str| {
        let found = known.iter().find(|c: &&Channel| c.name == **name).cloned();
        found.unwrap_or_else(|| panic!("no {name} among {:?}", known.iter().map(|c| &c.name).collect::<Vec<_>>()))
    };
    let mut series = Series::new(names.iter().map(wanted).collect());
    let outcome = simulate(&model, &mut series).unwrap();
    assert_eq!(outcome.status, Status::Completed);
    series.values
}

fn greatest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

const HUB_CHANNELS: [&str; 5] = [
    "sphere.front.force.x",
    "sphere.front.penetration",
    "plate.sternum.deflection",
    "plate.sternum.speed",
    "energy.balance",
];

/// Peak force, outer depth, deflection, and the greatest speed of deflection.
fn hub(set: &[&str]) -> [f64; 4] {
    let values = traced(HUB, set, &HUB_CHANNELS);
    let outer: Vec<f64> = values[1].iter().zip(&values[2]).map(|(skin, deflection)| skin + deflection).collect();
    // Measured: 1e-9 of what the hub brings.
    assert_below("balance, J", greatest(&values[4]), 1e-3);
    [greatest(&values[0]), greatest(&outer), greatest(&values[2]), greatest(&values[3])]
}

/// Golden numbers of an independent program of point masses.
#[test]
fn a_hub_on_point_masses_goes_as_golden_numbers_say() {
    for (set, golden) in [
        (&["loose.hub.velocity=[-4.3, 0, 0]"][..], [2320.2, 69.02, 64.20]),
        (&[], [4148.3, 92.21, 84.76]),
        (&["loose.hub.velocity=[-7.15, 0, 0]", "loose.hub.mass=22.7"], [4589.7, 95.16, f64::NAN]),
        (&["loose.hub.velocity=[-9.5, 0, 0]"], [7273.8, 116.07, f64::NAN]),
    ] {
        let [force, outer, deflection, _] = hub(set);
        for (name, found, expected) in [
            ("force, N", force, golden[0]),
            ("outer, mm", 1e3 * outer, golden[1]),
            ("inner, mm", 1e3 * deflection, golden[2]),
        ] {
            if expected.is_finite() {
                assert_below(name, found / expected - 1.0, 1e-4);
            }
        }
    }
    assert_within("greatest speed, m/s", hub(&[])[3], [5.63, 5.65]);
}
