//! Vessels whose walls are at rest.

use super::*;

/// T = (m₀c_vT₀ + m c_pT_in)/((m₀ + m)c_v).
#[test]
fn a_vessel_that_is_filled_has_the_temperature_and_pressure_of_the_closed_form() {
    let rows = vec![[0.0, 0.0, 700.0], [0.01, 4.0, 700.0], [0.03, 0.0, 700.0]]; // 60 g
    let mut bag = closed();
    bag.inflators[0] = Inflator { gas: IDEAL, due_s: 0.0, rows, tank: None };
    let mut rig = Rig::filled(&bag, 101_325.0, 300.0, 0.06);
    rig.run(0.031, 1e-4);
    let (temperature, pressure) = (rig.actions[0].temperature, rig.absolute());
    assert!((temperature - 618.0585).abs() < 5e-5, "{temperature}");
    assert!((pressure - 392_189.0).abs() < 5e-2, "{pressure}");
    assert!(rig.actions[0].residual < 1e-12, "{:e}", rig.actions[0].residual);
}

/// p = p₀(1 + ½(γ − 1)t/τ)^(−2γ/(γ − 1)) as long as the flow is choked, T = T₀(…)^−2.
#[test]
fn a_vessel_that_empties_through_a_hole_follows_the_closed_form_while_the_flow_is_choked() {
    let area_m2 = 2.0 * std::f64::consts::PI * 0.02_f64.powi(2);
    let vent = Vent { area_m2, discharge: 0.6, opens_at_pa: 0.0, due_s: 0.0 };
    let bag = Bag { vents: vec![vent], ..closed() };
    let mut rig = Rig::filled(&bag, 250_000.0, 600.0, 0.06);
    let tau: f64 = 0.137_699_476;
    for (ms, pressure) in [(1.0, 247_472.936), (2.0, 244_975.023), (3.0, 242_505.883), (26.0, 192_864.177)] {
        let end = 1e-3 * ms;
        rig.run(end, 1e-5);
        let closed = 250_000.0 * (1.0 + 0.2 * end / tau).powi(-7);
        assert!((closed / pressure - 1.0).abs() < 1e-6, "{closed}");
        assert!((rig.absolute() / closed - 1.0).abs() < 3e-10, "{ms} ms: {} {closed}", rig.absolute());
        let temperature = 600.0 * (1.0 + 0.2 * end / tau).powi(-2);
        assert!((rig.actions[0].temperature / temperature - 1.0).abs() < 1e-9);
    }
    // on to the pressure outside, never below
    rig.run(1.0, 1e-4);
    assert!((0.0..1.0).contains(&rig.actions[0].pressure), "{}", rig.actions[0].pressure);
    assert!(rig.actions[0].residual < 1e-9, "{:e}", rig.actions[0].residual);
}

#[test]
fn the_flow_through_a_hole_chokes_where_it_should() {
    let mixture =
        gas::Mixture::new(3.5 * 296.8 * 600.0, 101_325.0, 10.0, [(gas::GasLaw::new(&IDEAL), 1.0)].into_iter());
    let over_root = |pressure: f64| mixture.outflow(pressure, 101_325.0) * (296.8_f64 * 600.0).sqrt() / pressure;
    let critical = 101_325.0 / 0.528_281_788;
    assert!((over_root(2.0 * critical) - 0.684_731_456).abs() < 1e-9);
    assert!((over_root(1.01 * critical) - over_root(1.5 * critical)).abs() < 1e-15);
    let (pi, gamma): (f64, f64) = (0.8, 1.4);
    let subsonic = (2.0 * gamma / (gamma - 1.0) * (pi.powf(2.0 / gamma) - pi.powf((gamma + 1.0) / gamma))).sqrt();
    let off = over_root(101_325.0 / pi) - subsonic;
    assert!(off.abs() < 3e-14, "{off:e}");
}

/// A vent opens at its pressure and stays open; heat flows out until the gas has the temperature of the ambient air.
#[test]
fn a_vent_that_has_opened_stays_open() {
    let vent = Vent { area_m2: 1e-3, discharge: 0.7, opens_at_pa: 20_000.0, due_s: NEVER };
    let bag = Bag { vents: vec![vent], ..closed() };
    let mut shut = Rig::filled(&bag, 121_000.0, 300.0, 0.06);
    shut.run(0.01, 1e-4);
    assert!((shut.absolute() / 121_000.0 - 1.0).abs() < 1e-12);
    let mut open = Rig::filled(&bag, 121_400.0, 300.0, 0.06);
    open.run(1.0, 1e-4);
    assert!(open.actions[0].pressure < 1.0, "{}", open.actions[0].pressure);
}

#[test]
fn heat_is_lost_until_the_gas_is_as_cold_as_the_air() {
    let bag = Bag { heat_w_m2_k: 2000.0, ..closed() };
    let mut rig = Rig::filled(&bag, 250_000.0, 600.0, 0.06);
    rig.run(0.3, 1e-4);
    assert!((rig.actions[0].temperature - 300.0).abs() < 0.1, "{}", rig.actions[0].temperature);
    assert!(rig.actions[0].residual < 1e-10);
}

/// Cold gas flows into a bag that does not fill: U of its content is constant, and nothing jumps at p_a.
#[test]
fn a_bag_that_is_slack_has_the_pressure_outside_until_it_is_full() {
    let rows = vec![[0.0, 1.0, 300.0], [0.2, 1.0, 300.0]];
    let mut bag = Bag { fires_s: 0.0, deploy_s: 0.001, ..closed() };
    bag.inflators[0] = Inflator { gas: IDEAL, due_s: 0.0, rows, tank: None };
    let mut rig = Rig::new(&[bag]);
    rig.run(0.05, 1e-4);
    let slack = rig.actions[0];
    let folded = 0.02 * 0.06;
    assert!(
        (slack.pressure, slack.temperature) == (0.0, slack.temperature) && (slack.temperature - 300.0).abs() < 1e-9
    );
    assert!((slack.volume - folded - 0.05 * 296.8 * 300.0 / 101_325.0).abs() < 1e-12, "{}", slack.volume);
    rig.run(0.1, 1e-4);
    // full after 66 ms: more gas than fits is compressed and hotter
    let taut = rig.actions[0];
    assert!(taut.pressure > 1000.0 && taut.temperature > 300.0 && (taut.volume - 0.06).abs() < 1e-12);
    // measured: 3e-7, by the step in which it becomes taut
    assert!(taut.residual < 1e-6, "its walls stand still but for one step: {:e}", taut.residual);
}

/// An unfolding bag that gets no gas stays slack, and air alone keeps its temperature.
#[test]
fn a_bag_without_gas_unfolds_and_stays_slack() {
    let bag = Bag { fires_s: 0.0, deploy_s: 0.02, ..closed() };
    let mut rig = Rig::new(&[bag]);
    rig.run(0.03, 1e-4);
    let action = rig.actions[0];
    assert!(action.pressure < 1e-9 && (action.temperature - 300.0).abs() < 1e-9, "{action:?}");
    assert!((action.volume - 0.0012).abs() < 1e-15);
}

/// Gases keep their specific heats: air heated by hot carbon dioxide in a closed tank, by the sum of their energies.
#[test]
fn a_mixture_has_the_energy_of_its_parts() {
    let gases = ["nitrogen", "carbon_dioxide", "water", "helium"].map(|name| Gas::named(name).unwrap());
    let masses = [0.02, 0.03, 0.01, 0.004];
    let (temperature, law) = (731.0, gases.each_ref().map(gas::GasLaw::new));
    let energy: f64 =
        law.iter().zip(masses).map(|(gas, m)| m * (gas.enthalpy(temperature) - gas.r * temperature)).sum();
    let mixture = |free: f64| gas::Mixture::new(energy + 1e5 * free, 1e5, free, law.into_iter().zip(masses));
    let taut = mixture(0.06);
    assert!((taut.temperature / temperature - 1.0).abs() < 1e-14 && (taut.energy / energy - 1.0).abs() < 1e-14);
    let r: f64 = law.iter().zip(masses).map(|(gas, m)| m * gas.r).sum();
    assert!((taut.gauge + 1e5 - r * temperature / 0.06).abs() < 1e-8);
    // in as much room as it takes at the pressure outside it is just slack, at the same temperature
    let slack = mixture(r * temperature / 1e5 * (1.0 + 1e-12));
    assert!(slack.gauge == 0.0 && (slack.temperature / temperature - 1.0).abs() < 1e-12);
}
