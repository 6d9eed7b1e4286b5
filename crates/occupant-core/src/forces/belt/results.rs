//! Results of a belt (report, "Output", item 7).

use occupant_units::unit::Unit::{self, Joule, Metre, Newton, Radian};

use super::course::course_m;
use super::law::{BeltAction, BeltHistory, BeltLaw};
use super::{Belt, Belts};
use crate::forces::element::Element;
use crate::forces::shown::{Line, Named, OneOf, Pull, Reported, Shown, Tracked, Tracker};
use crate::forces::sphere::Use;
use crate::forces::stored::Archive;
use crate::forces::table::{Cell, Column, Table};
use crate::motion::scalar::Scalar;
use crate::motion::vector::v3;
use crate::quantity::{Axes, FieldWords, Quantity};

type Of = Quantity<OneOf<Belts>>;

impl Reported for Belts {
    const MESSAGE: &'static str = "BeltState";

    const QUANTITIES: &'static [Of] = &[
        Of::number(Newton, |b| b.loop_force).channel("force", "loop force of the {}").field(
            2,
            "loop_force",
            "force in the webbing (item 7)",
        ),
        Of::number(Metre, |b| b.elongation).channel("elongation", "elongation of the {}").field(
            5,
            "elongation",
            "length less the unstretched length; negative in slack",
        ),
        Of::vector(Newton, Axes::Vehicle, |b| b.force.to_vector())
            .channel("body_force", "force on the body of the {}")
            .field(3, "restraining_force", "force on the sphere, at its centre (item 7)")
            .resultant(4, "restraining_force", "its magnitude"),
        Of::number(Metre, |b| b.length).field(6, "length", "length round the body"),
        Of::number(Radian, |b| b.wrap).field(
            7,
            "wrap",
            "angle over which the belt lies on the sphere; 0 or less: off the body",
        ),
        Of::number(Joule, |b| b.stored).field(8, "stored", "recoverable energy"),
    ];

    const PEAKS: &'static [Tracked] = &[
        Tracked {
            column: Column::number("loop_force_n", "loop force, N", 0).measure("peak", Newton),
            time: Some(Column::time("time_s").measure("peak_time", Unit::Second)),
            at_least_zero: true,
        },
        Tracked {
            column: Column { scale: 1e3, ..Column::number("elongation_m", "stretch, mm", 1) }.measure("stretch", Metre),
            time: None,
            at_least_zero: false,
        },
        Tracked {
            column: Column::number("body_force_n", "force on body, N", 0).measure("body_peak", Newton),
            time: None,
            at_least_zero: true,
        },
    ];

    #[inline(always)]
    fn track<S: Scalar>(b: &BeltAction<S>, tracker: &mut impl Tracker<S>) {
        tracker.numbers(&[b.loop_force, b.elongation, b.force.norm_squared().sqrt()]);
    }

    fn keep(past: &mut Vec<BeltHistory<f64>>, like: Option<&[BeltHistory<f64>]>, file: &mut dyn Archive) {
        let [normal, greatest] = if like.is_some() { [32, 33] } else { [9, 10] };
        let meaning = "x, y, z of the normal of each belt's plane";
        let normal = FieldWords { number: normal, stem: "belt_normal_vehicle", meaning };
        let normals = past.iter().flat_map(|belt| [belt.normal.x, belt.normal.y, belt.normal.z]).collect();
        let normals = file.numbers(normal, normals);
        let greatest = FieldWords { number: greatest, stem: "belt_greatest_elongation_m", meaning: "of each belt" };
        let greatest = file.numbers(greatest, past.iter().map(|belt| belt.greatest).collect());
        if normals.len() != 3 * greatest.len() {
            return file.refuse("lists of belts that do not fit each other");
        }
        let belts = normals.as_chunks().0.iter().zip(greatest);
        *past = belts.map(|(&[x, y, z], greatest)| BeltHistory { normal: v3(x, y, z), greatest }).collect();
    }

    fn named<'a>(data: Self::Data<'a>) -> Vec<Named<'a>> {
        data.iter().map(|belt| Named { name: &belt.name, sphere: Some(belt.sphere) }).collect()
    }

    fn start_table(shown: &Shown<'_, Self>) -> Option<Table> {
        let columns = [
            Column::text("sphere", "round"),
            Column::number("length_m", "length, m", 4),
            Column::number("rest_length_m", "unstretched, m", 4),
            Column::number("wrap_deg", "wrap, °", 1),
            Column::number("loop_force_n", "loop force, N", 1),
        ];
        let row = |((belt, law), action): ((&Belt, &BeltLaw<f64>), &BeltAction<f64>)| {
            let sphere = Cell::Text(shown.body.spheres[belt.sphere].name.clone());
            let numbers = [action.length, law.rest_length, action.wrap.to_degrees(), action.loop_force];
            let numbers = numbers.map(|number| Cell::Number(Some(number)));
            (belt.name.clone(), [sphere].into_iter().chain(numbers).collect())
        };
        Some(Table::new(Self::NAMES[0], &columns, shown.data.iter().zip(shown.law).zip(shown.actions).map(row)))
    }

    fn lines(shown: &Shown<'_, Self>) -> Vec<Line> {
        let line = |(belt, action): (&Belt, &BeltAction<f64>)| {
            let radius_m = shown.body.spheres[belt.sphere].radius_m;
            let points_m = course_m(belt, radius_m, (shown.centre_m)(belt.sphere, Use::Belt), action);
            Line { name: belt.name.clone(), points_m, force_n: action.loop_force }
        };
        shown.data.iter().zip(shown.actions).map(line).collect()
    }

    fn pulls(shown: &Shown<'_, Self>, show: &mut dyn FnMut(&Pull<'_>)) {
        let [of, _] = Self::NAMES;
        for (belt, action) in shown.data.iter().zip(shown.actions) {
            let (name, sphere) = (&belt.name, belt.sphere);
            let point_m = (shown.centre_m)(sphere, Use::Belt);
            show(&Pull { of, name, sphere, point_m, force_n: action.force.to_vector() });
        }
    }

    /// The force jumps only where a loaded belt slips off the body.
    fn event<S: Scalar>(before: &BeltAction<S>, now: &BeltAction<S>) -> Option<(&'static str, Option<S>)> {
        let is_positive = |x: S| S::any(x.gt(S::zero()));
        match (is_positive(before.loop_force), is_positive(now.loop_force)) {
            (false, true) => Some(("tightens", None)),
            (true, false) if is_positive(now.wrap) => Some(("goes slack", None)),
            (true, false) => Some(("slips off the body", Some(before.loop_force))),
            _ => None,
        }
    }
}
