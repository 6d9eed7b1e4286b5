//! Initial state of the occupant: the seating as read and as computed, the coordinates, the elements, the passed pairs.

use occupant_core::model::seat::Seated;
use occupant_core::model::seating::{InitialPosture, InitialVelocity, Seating};
use occupant_core::model::settle::Settled;
use occupant_core::motion::report_coordinates::{DOF, ReportCoordinates};
use occupant_units::unit::Unit::{Metre, MetrePerSecond, Newton, NewtonMetre, One, Radian};

use crate::print::end_sheet::pairs;
use crate::print::unit::degree;
use crate::print::{Case, ELEMENTS, Pages, Table, Units};

/// Writes the start.
pub(crate) fn write(pages: &mut Pages, case: &Case, units: Units) {
    let (setup, start) = (case.model.setup(), case.model.start());
    match &setup.posture {
        InitialPosture::Seated(seating) => read(pages, case, units, seating),
        InitialPosture::Mounted(_) => pages.say("THE FIRST SEGMENT IS HELD BY A MOUNT; NOBODY WAS SEATED"),
        InitialPosture::Placed(_) => pages.say("THE BODY WAS PUT WHERE IT BEGINS; NOBODY WAS SEATED"),
        InitialPosture::Together => pages.say("SEVERAL BODIES, EACH AS THE SCENARIO SAYS"),
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
    if recorded.is_some_and(|c| c.state != start.state.numbers()) {
        pages.say("*** THE RECORDED START DIFFERS FROM THE ONE COMPUTED HERE: ANOTHER VERSION OF THE PROGRAM ***");
    }
    ELEMENTS.iter().for_each(|element| (element.start)(pages, case, units));
    let q = match &setup.posture {
        InitialPosture::Seated(_) | InitialPosture::Mounted(_) | InitialPosture::Placed(_) => {
            ReportCoordinates::from_state(&start.state)
        }
        // as read: the angles of a state are normalised
        InitialPosture::Coordinates(q) | InitialPosture::Continued { coordinates: q, .. } => Some(**q),
        InitialPosture::Together => None,
    };
    if let Some(q) = q.as_ref().filter(|_| case.is_of_report()) {
        coordinates(pages, units, "GENERALIZED COORDINATES AT THE START", q);
    }
    let passed = case.passed(&start.history.memory.contacts);
    pairs(pages, case, "PAIRS WITH NARRY(J,K) = 0 AT THE START", &passed);
}

fn read(pages: &mut Pages, case: &Case, units: Units, seating: &Seating) {
    let (l, angle) = (units.of(Metre), units.of(Radian));
    pages.fact("CUSHION", case.surface(seating.cushion));
    pages.fact("SEAT BACK", case.surface(seating.back));
    pages.fact("LATERAL PLACE", l.say(seating.lateral_m));
    let shown = |(name, rad): &(String, f64)| format!("{} {}", name.replace('_', " ").to_uppercase(), angle.show(*rad));
    pages.fact("LEAN (DEG)", seating.angles_rad.iter().map(shown).collect::<Vec<_>>().join(", "));
    let [x, z] = seating.heels_m;
    pages.fact("HEELS", format!("X {}, Z {}", l.show(x), l.say(z)));
    let v = units.of(MetrePerSecond);
    let velocity = match case.model.setup().velocity {
        InitialVelocity::WithVehicle => "AS IF FIXED TO THE VEHICLE".to_owned(),
        InitialVelocity::VehicleOrigin => "THAT OF THE VEHICLE'S C.G., WITHOUT TURNING".to_owned(),
        InitialVelocity::Given(along) => format!("{} {} ALONG THE VEHICLE'S AXES", v.point(along), v.name()),
    };
    pages.fact("VELOCITY", velocity);
}

fn computed(pages: &mut Pages, units: Units, seated: &Seated) {
    let l = units.of(Metre);
    pages.say("");
    pages.say("COMPUTED");
    let (pelvis, sink) = (l.point(seated.pelvis_m), l.say(seated.sink_m));
    pages.fact("PELVIS", format!("CENTER AT {pelvis} {}, SINKS {sink} INTO THE CUSHION", l.name()));
    pages.fact("LEFT KNEE", format!("AT {} {}", l.point(seated.knee_m), l.name()));
    let [thighs, shanks] = seated.legs_rad.map(|x| degree().show(x));
    pages.fact("LEGS", format!("THIGHS LEAN {thighs}, LOWER LEGS {shanks} DEG"));
}

fn came_to_rest(pages: &mut Pages, units: Units, settled: &Settled) {
    let (moved, turned) = (units.of(Metre).say(settled.moved_m), degree().say(settled.turned_rad));
    let [force, weight] = [settled.residual_force_n, settled.weight_n].map(|x| units.of(Newton).say(x));
    let moment = units.of(NewtonMetre).say(settled.residual_moment_n_m);
    let left = format!("LEFT OVER {force} AND {moment} OF A WEIGHT OF {weight}");
    pages.fact("SETTLED", format!("MOVED {moved} AND TURNED {turned}; {left}"));
}

/// q and its rates, four per line, with the six decimals of cards, or with all digits if they were read.
pub(crate) fn coordinates(pages: &mut Pages, units: Units, title: &str, at: &ReportCoordinates) {
    let title = units.heading(&format!("{title}: Q(1) TO Q(3) ({{}}), THE REST (RAD), AND RATES (PER SEC)"), &[Metre]);
    let mut table = Table::new(title, "NO|Q|RATE|NO|Q|RATE|NO|Q|RATE|NO|Q|RATE");
    let rows = DOF.div_ceil(4);
    for row in 0..rows {
        let cell = |i: usize| {
            let unit = units.of(if i < 3 { Metre } else { One });
            let show = |si: f64| unit.in_full(si, format!("{:.6}", si / unit.size() + 0.0));
            [(i + 1).to_string(), show(at.q[i]), show(at.rates[i])]
        };
        let places = (0..4).map(|k| row + k * rows).filter(|&i| i < DOF);
        table.row(places.flat_map(cell));
    }
    table.write(pages);
}
