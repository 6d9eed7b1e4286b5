//! Cases, their texts, errors by kind.

use occupant::prelude::*;

const DRIVER: &str = include_str!("../examples/driver.toml");

fn seated() -> Result<Case, Error> {
    let mut case = Case::new("seat", Occupant::male50());
    let foam = case.material(Material::new("foam", BilinearSpring::linear(2e4, 0.4), 0.6));
    let inside = [0.1, 0.0, -0.3];
    let cushion = case.surface("cushion", foam, Outline::strip([[-0.2, 0.1], [0.3, 0.05]], 0.0, 0.3, 0.3), inside);
    let back = case.surface("back", foam, Outline::strip([[-0.2, 0.1], [-0.4, -0.6]], 0.0, 0.3, 0.3), inside);
    case.surface("floor", foam, Outline::strip([[-0.2, 0.4], [0.9, 0.4]], 0.0, 0.7, 0.7), inside);
    let pelvis = case.sphere("pelvis")?;
    case.belt("lap", pelvis, [[-0.15, -0.25, 0.2], [-0.15, 0.25, 0.2]], BilinearSpring::linear(8e4, 1.0));
    case.seat(Seat::new(cushion, back, [0.7, 0.35]).angle("upper_torso", 0.3));
    case.pulse(15.0, PulseShape::HalfSine { strength: Strength::DeltaV(15.0), duration_s: 0.08 })?;
    let head = case.segment("head")?;
    case.marker("forehead", head, [0.09, 0.0, 0.1]);
    case.ends_at(0.1);
    Ok(case)
}

#[test]
fn a_case_in_code_runs() -> Result<(), Error> {
    let results = seated()?.model()?.simulate()?;
    assert!(results.figure("belts.lap.peak")? > 1000.0);
    assert!(results.measure(PelvisPeak)? > 50.0 && results.measure(EnergyError)? < 1e-4);
    assert!(results.channel("marker.forehead.position.x")?.iter().all(|x| x.is_finite()));
    Ok(())
}

#[test]
fn errors_have_kinds_and_words() {
    let kind = |error: Option<Error>| error.map(|error| (error.kind(), !error.to_string().is_empty()));
    let case = || Case::from_toml(DRIVER).unwrap();
    assert_eq!(kind(Case::from_toml("").err()), Some((ErrorKind::Text, true)));
    let wrong = Case::from_toml("title = 3").unwrap_err();
    assert!(wrong.diagnostics().is_some() && wrong.problems().is_none());
    assert_eq!(kind(case().sphere("hed").err()), Some((ErrorKind::Name, true)));
    assert_eq!(kind(case().segment("hed").err()), Some((ErrorKind::Name, true)));
    assert_eq!(kind(case().surface_named("flor").err()), Some((ErrorKind::Name, true)));
    assert_eq!(kind(Occupant::person(Sex::Male, f64::NAN, 0.0).err()), Some((ErrorKind::Input, true)));
    let shape = PulseShape::HalfSine { strength: Strength::DeltaV(f64::NAN), duration_s: 0.08 };
    assert_eq!(kind(case().pulse(10.0, shape).err()), Some((ErrorKind::Input, true)));
    let mut broken = case();
    broken.ends_at(f64::NAN);
    let refused = broken.model().unwrap_err();
    assert!(refused.kind() == ErrorKind::Case && refused.problems().is_some());
    let mut wild = case();
    wild.integrator(Integrator::Rk4 { step_s: 0.05 });
    wild.outputs_every(0.05);
    assert_eq!(kind(wild.model().unwrap().simulate().err()), Some((ErrorKind::Integration, true)));
    let model = case().model().unwrap();
    let mut run = Run::new(&model);
    assert_eq!(kind(run.advance_to(f64::NAN).err().map(Error::from)), Some((ErrorKind::Input, true)));
    assert_eq!(kind(Log::of(&model, &["nothing"]).err()), Some((ErrorKind::Name, true)));
    assert_eq!(kind(Log::new(&model).end(Run::new(&model)).err()), Some((ErrorKind::Recording, true)));
    // as `main` shows it
    assert_eq!(format!("{refused:?}"), refused.to_string());
}

#[test]
fn texts_are_changed_and_written() -> Result<(), Error> {
    let mut text = Scenario::from_toml(DRIVER)?;
    text.set("path.speed", "25 mph")?;
    assert_eq!(text.get("path.speed")?, "25 mph");
    assert_eq!(text.get("paht.speed").unwrap_err().kind(), ErrorKind::Text);
    assert!(text.get("joints.*.damping").is_err() && text.set("paht.speed", "1").is_err());
    let case = Case::from_scenario(&text)?;
    let again = Case::from_toml(&case.to_toml()?)?;
    assert_eq!(again.setup(), case.setup());
    let mut changed = again.clone();
    changed.ends_at(0.1);
    assert_eq!(changed.to_toml().unwrap_err().kind(), ErrorKind::Text);
    Ok(())
}

/// What looks ahead along a path is refused where the path is told on the way.
#[test]
fn triggers_that_look_ahead_are_refused() -> Result<(), Error> {
    let mut text = Scenario::from_toml(DRIVER)?;
    Case::from_scenario(&text)?.live(VehicleState::default())?;
    text.set("triggers.crash", r#"{ kind = "vehicle_acceleration", threshold = "3 g" }"#)?;
    let mut case = Case::from_scenario(&text)?;
    let refused = case.live(VehicleState::default()).unwrap_err();
    assert!(refused.kind() == ErrorKind::Case && refused.to_string().contains("triggers.crash"), "{refused}");
    case.model()?;
    // in whatever way the path is exchanged under them
    case.path(VehiclePath::parked());
    assert_eq!(case.model().unwrap_err().kind(), ErrorKind::Case);
    let mut case = Case::from_scenario(&text)?;
    case.setup_mut().path = VehiclePath::live(VehicleState::default());
    assert_eq!(case.model().unwrap_err().kind(), ErrorKind::Case);
    Ok(())
}

#[cfg(feature = "serde")]
#[test]
fn texts_go_through_serde() {
    let text = Scenario::from_toml(DRIVER).unwrap();
    let json = serde_json::to_string(&text).unwrap();
    let again: Scenario = serde_json::from_str(&json).unwrap();
    assert_eq!(again.to_toml().unwrap(), text.to_toml().unwrap());
}
