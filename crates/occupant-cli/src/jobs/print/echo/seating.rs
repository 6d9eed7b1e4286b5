//! How the occupant starts: the seating as read and as computed, the coordinates, the belts laid, the pairs passed.

use occupant_core::model::seat::Seated;
use occupant_core::model::seating::{InitialPosture, InitialVelocity, Seating};
use occupant_core::model::settle::Settled;
use occupant_core::motion::report_coordinates::{DOF, ReportCoordinates};

use crate::jobs::print::case::Case;
use crate::jobs::print::end_sheet::pairs;
use crate::jobs::print::page::Pages;
use crate::jobs::print::table::Table;
use crate::jobs::print::unit::{DEGREE, Units};

/// Writes the start.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: &Units) {
    let (setup, start) = (case.model.setup(), case.model.start());
    match &setup.posture {
        InitialPosture::Seated(seating) => read(pages, case, units, seating),
        InitialPosture::Coordinates(_) => {
            pages.say("THE START IS GIVEN BY GENERALIZED COORDINATES; NOBODY WAS SEATED");
        }
        InitialPosture::Continued { .. } => {
            pages.say("THE START CONTINUES AN EARLIER RUN: COORDINATES AND PAIRS WITH NARRY = 0 ARE GIVEN");
        }
    }
    if let Some(seated) = &start.seated {
        computed(pages, units, seated);
    }
    if let Some(settled) = &start.settled {
        came_to_rest(pages, units, settled);
    }
    let recorded = case.file.checkpoints.first().filter(|c| c.index == 0);
    if recorded.is_some_and(|c| c.state.to_numbers() != start.state.to_numbers()) {
        pages.say("*** THE RECORDED START DIFFERS FROM THE ONE COMPUTED HERE: ANOTHER VERSION OF THE PROGRAM ***");
    }
    let laid = setup.belts.iter().zip(&case.model.system().forces.belts);
    for (belt, law) in laid {
        pages.say(&format!(
            "BELT           {}: UNSTRETCHED LENGTH {} {}",
            belt.name,
            units.length.show(law.rest_length),
            units.length.name
        ));
    }
    let q = ReportCoordinates::from_state(&start.state);
    coordinates(pages, units, "GENERALIZED COORDINATES AT THE START", &q);
    let passed = case.passed(&start.history.memory.contacts);
    pairs(pages, case, "PAIRS WITH NARRY(J,K) = 0 AT THE START", &passed);
}

fn read(pages: &mut Pages, case: &Case, units: &Units, seating: &Seating) {
    let l = units.length;
    pages.say(&format!("CUSHION        {}", case.surface(seating.cushion)));
    pages.say(&format!("SEAT BACK      {}", case.surface(seating.back)));
    pages.say(&format!("LATERAL PLACE  {} {}", l.show(seating.lateral_m), l.name));
    let lean = seating.lean_rad.map(|x| DEGREE.show(x));
    pages.say(&format!(
        "LEAN (DEG)     MIDDLE TORSO {}, UPPER TORSO {}, HEAD {}, LOWER TORSO {}, UPPER ARMS {}, ELBOWS {}",
        lean[0],
        lean[1],
        lean[2],
        lean[3],
        DEGREE.show(seating.upper_arms_rad),
        DEGREE.show(seating.elbows_rad)
    ));
    let [x, z] = seating.heels_m.map(|x| l.show(x));
    pages.say(&format!("HEELS          X {x}, Z {z} {}", l.name));
    let velocity = match case.model.setup().velocity {
        InitialVelocity::WithVehicle => "AS IF FIXED TO THE VEHICLE".to_owned(),
        InitialVelocity::VehicleOrigin => "THAT OF THE VEHICLE'S C.G., WITHOUT TURNING".to_owned(),
        InitialVelocity::Given(v) => {
            format!("{} {} ALONG THE VEHICLE'S AXES", units.speed.point(v.into()), units.speed.name)
        }
    };
    pages.say(&format!("VELOCITY       {velocity}"));
}

fn computed(pages: &mut Pages, units: &Units, seated: &Seated) {
    let l = units.length;
    pages.say("");
    pages.say("COMPUTED");
    pages.say(&format!(
        "PELVIS         CENTER AT {} {}, SINKS {} {} INTO THE CUSHION",
        l.point(seated.pelvis_m.into()),
        l.name,
        l.show(seated.sink_m),
        l.name
    ));
    pages.say(&format!("LEFT KNEE      AT {} {}", l.point(seated.knee_m.into()), l.name));
    let [thighs, shanks] = seated.legs_rad.map(|x| DEGREE.show(x));
    pages.say(&format!("LEGS           THIGHS LEAN {thighs}, LOWER LEGS {shanks} DEG"));
}

fn came_to_rest(pages: &mut Pages, units: &Units, settled: &Settled) {
    let (l, f, m) = (units.length, units.force, units.moment);
    pages.say(&format!(
        "SETTLED        MOVED {} {} AND TURNED {} DEG; LEFT OVER {} {} AND {} {} OF A WEIGHT OF {} {}",
        l.show(settled.moved_m.norm()),
        l.name,
        DEGREE.show(settled.turned_rad.norm()),
        f.show(settled.residual_force_n),
        f.name,
        m.show(settled.residual_moment_n_m),
        m.name,
        f.show(settled.weight_n),
        f.name
    ));
}

/// q and their rates, four to a line, with the six decimals of cards.
pub(crate) fn coordinates(pages: &mut Pages, units: &Units, title: &str, at: &ReportCoordinates) {
    let l = units.length;
    let title = format!("{title}: Q(1) TO Q(3) ({}), THE REST (RAD), AND RATES (PER SEC)", l.name);
    let mut table = Table::new(title, &["NO | Q | RATE"; 4].join("|"));
    let rows = DOF.div_ceil(4);
    for row in 0..rows {
        let cell = |i: usize| {
            let scale = if i < 3 { l.size() } else { 1.0 };
            let show = |si: f64| format!("{:.6}", si / scale + 0.0);
            [(i + 1).to_string(), show(at.q[i]), show(at.rates[i])]
        };
        let places = (0..4).map(|k| row + k * rows).filter(|&i| i < DOF);
        table.row(places.flat_map(cell));
    }
    table.write(pages);
}
