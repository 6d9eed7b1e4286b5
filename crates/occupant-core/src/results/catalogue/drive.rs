//! Vehicles of `drive`: steering, crush, wheels.

use occupant_units::unit::Unit::{Metre, MetrePerSecond, Newton, NewtonMetre, One, Radian, RadianPerSecond};

use crate::model::setup::DRIVE_NUMBERS;
use crate::quantity::{Owner, Quantity};
use crate::results::sample::Sample;

/// A driven vehicle at one output.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfDrive;

impl Owner for OfDrive {
    type At<'a> = [f64; DRIVE_NUMBERS];
}

/// Values of a vehicle (index) at the time of an output, by linear interpolation between its stations.
pub(super) fn at(s: &Sample<'_>, vehicle: usize) -> [f64; DRIVE_NUMBERS] {
    let log = &s.model.setup().logs[vehicle];
    let last = log.times_s.len() - 1;
    let next = log.times_s.partition_point(|time_s| *time_s <= s.time_s).clamp(1.min(last), last);
    let before = next.saturating_sub(1);
    let [from, to] = [&log.rows[before], &log.rows[next]];
    let span_s = log.times_s[next] - log.times_s[before];
    let share = if span_s > 0.0 { ((s.time_s - log.times_s[before]) / span_s).clamp(0.0, 1.0) } else { 0.0 };
    core::array::from_fn(|i| from[i] + share * (to[i] - from[i]))
}

fn number<const I: usize>(row: &[f64; DRIVE_NUMBERS]) -> f64 {
    row[I]
}

type Of = Quantity<OfDrive>;

#[rustfmt::skip]
pub(super) const QUANTITIES: [Of; DRIVE_NUMBERS] = [
    Of::number(MetrePerSecond, number::<0>).channel("speed", "speed of the {}").field(2, "speed", "speed"),
    Of::number(Radian, number::<1>).channel("slip_angle", "direction of travel of the {} to the right of its heading").field(3, "slip_angle", "direction of travel to the right of its heading"),
    Of::number(Radian, number::<2>).channel("steer", "mean angle of the front wheels of the {}, to the right positive").field(4, "steer", "mean angle of the front wheels, to the right positive"),
    Of::number(Metre, number::<3>).channel("crush", "deepest crush of the {} so far").field(5, "crush", "deepest crush so far"),
    Of::number(Newton, number::<4>).channel("struck", "force of other vehicles and barriers on the {}").field(6, "struck", "force of other vehicles and barriers"),
    Of::number(Newton, number::<5>).channel("hull", "force of the ground on hull and rims of the {}").field(7, "hull", "force of the ground on hull and rims"),
    Of::number(Newton, number::<6>).channel("wheel.left_front.load", "normal force of the ground on the left front wheel of the {}").field(8, "left_front_load", "normal force of the ground on the left front wheel"),
    Of::number(Metre, number::<7>).channel("wheel.left_front.travel", "jounce of the left front wheel of the {} from its rest position, up positive").field(9, "left_front_travel", "jounce of the left front wheel from its rest position, up positive"),
    Of::number(RadianPerSecond, number::<8>).channel("wheel.left_front.spin", "spin of the left front wheel of the {}, rolling forward positive").field(10, "left_front_spin", "spin of the left front wheel, rolling forward positive"),
    Of::number(NewtonMetre, number::<9>).channel("wheel.left_front.brake", "brake torque of the left front wheel of the {} that could act").field(11, "left_front_brake", "brake torque of the left front wheel that could act"),
    Of::number(MetrePerSecond, number::<10>).channel("wheel.left_front.slide_x", "sliding of the left front wheel of the {} on the ground, ahead").field(12, "left_front_slide_ahead", "sliding of the left front wheel on the ground, ahead"),
    Of::number(MetrePerSecond, number::<11>).channel("wheel.left_front.slide_y", "sliding of the left front wheel of the {} on the ground, to the right").field(13, "left_front_slide_right", "sliding of the left front wheel on the ground, to the right"),
    Of::number(Newton, number::<12>).channel("wheel.left_front.force_x", "force of the ground on the left front wheel of the {} along it").field(14, "left_front_force_ahead", "force of the ground on the left front wheel along it"),
    Of::number(Newton, number::<13>).channel("wheel.left_front.force_y", "force of the ground on the left front wheel of the {} across it, to the right").field(15, "left_front_force_right", "force of the ground on the left front wheel across it, to the right"),
    Of::number(One, number::<14>).channel("wheel.left_front.saturation", "share of its friction that the left front wheel of the {} uses; 1 slides").field(16, "left_front_saturation", "share of its friction that the left front wheel uses; 1 slides"),
    Of::number(Newton, number::<15>).channel("wheel.right_front.load", "normal force of the ground on the right front wheel of the {}").field(17, "right_front_load", "normal force of the ground on the right front wheel"),
    Of::number(Metre, number::<16>).channel("wheel.right_front.travel", "jounce of the right front wheel of the {} from its rest position, up positive").field(18, "right_front_travel", "jounce of the right front wheel from its rest position, up positive"),
    Of::number(RadianPerSecond, number::<17>).channel("wheel.right_front.spin", "spin of the right front wheel of the {}, rolling forward positive").field(19, "right_front_spin", "spin of the right front wheel, rolling forward positive"),
    Of::number(NewtonMetre, number::<18>).channel("wheel.right_front.brake", "brake torque of the right front wheel of the {} that could act").field(20, "right_front_brake", "brake torque of the right front wheel that could act"),
    Of::number(MetrePerSecond, number::<19>).channel("wheel.right_front.slide_x", "sliding of the right front wheel of the {} on the ground, ahead").field(21, "right_front_slide_ahead", "sliding of the right front wheel on the ground, ahead"),
    Of::number(MetrePerSecond, number::<20>).channel("wheel.right_front.slide_y", "sliding of the right front wheel of the {} on the ground, to the right").field(22, "right_front_slide_right", "sliding of the right front wheel on the ground, to the right"),
    Of::number(Newton, number::<21>).channel("wheel.right_front.force_x", "force of the ground on the right front wheel of the {} along it").field(23, "right_front_force_ahead", "force of the ground on the right front wheel along it"),
    Of::number(Newton, number::<22>).channel("wheel.right_front.force_y", "force of the ground on the right front wheel of the {} across it, to the right").field(24, "right_front_force_right", "force of the ground on the right front wheel across it, to the right"),
    Of::number(One, number::<23>).channel("wheel.right_front.saturation", "share of its friction that the right front wheel of the {} uses; 1 slides").field(25, "right_front_saturation", "share of its friction that the right front wheel uses; 1 slides"),
    Of::number(Newton, number::<24>).channel("wheel.left_rear.load", "normal force of the ground on the left rear wheel of the {}").field(26, "left_rear_load", "normal force of the ground on the left rear wheel"),
    Of::number(Metre, number::<25>).channel("wheel.left_rear.travel", "jounce of the left rear wheel of the {} from its rest position, up positive").field(27, "left_rear_travel", "jounce of the left rear wheel from its rest position, up positive"),
    Of::number(RadianPerSecond, number::<26>).channel("wheel.left_rear.spin", "spin of the left rear wheel of the {}, rolling forward positive").field(28, "left_rear_spin", "spin of the left rear wheel, rolling forward positive"),
    Of::number(NewtonMetre, number::<27>).channel("wheel.left_rear.brake", "brake torque of the left rear wheel of the {} that could act").field(29, "left_rear_brake", "brake torque of the left rear wheel that could act"),
    Of::number(MetrePerSecond, number::<28>).channel("wheel.left_rear.slide_x", "sliding of the left rear wheel of the {} on the ground, ahead").field(30, "left_rear_slide_ahead", "sliding of the left rear wheel on the ground, ahead"),
    Of::number(MetrePerSecond, number::<29>).channel("wheel.left_rear.slide_y", "sliding of the left rear wheel of the {} on the ground, to the right").field(31, "left_rear_slide_right", "sliding of the left rear wheel on the ground, to the right"),
    Of::number(Newton, number::<30>).channel("wheel.left_rear.force_x", "force of the ground on the left rear wheel of the {} along it").field(32, "left_rear_force_ahead", "force of the ground on the left rear wheel along it"),
    Of::number(Newton, number::<31>).channel("wheel.left_rear.force_y", "force of the ground on the left rear wheel of the {} across it, to the right").field(33, "left_rear_force_right", "force of the ground on the left rear wheel across it, to the right"),
    Of::number(One, number::<32>).channel("wheel.left_rear.saturation", "share of its friction that the left rear wheel of the {} uses; 1 slides").field(34, "left_rear_saturation", "share of its friction that the left rear wheel uses; 1 slides"),
    Of::number(Newton, number::<33>).channel("wheel.right_rear.load", "normal force of the ground on the right rear wheel of the {}").field(35, "right_rear_load", "normal force of the ground on the right rear wheel"),
    Of::number(Metre, number::<34>).channel("wheel.right_rear.travel", "jounce of the right rear wheel of the {} from its rest position, up positive").field(36, "right_rear_travel", "jounce of the right rear wheel from its rest position, up positive"),
    Of::number(RadianPerSecond, number::<35>).channel("wheel.right_rear.spin", "spin of the right rear wheel of the {}, rolling forward positive").field(37, "right_rear_spin", "spin of the right rear wheel, rolling forward positive"),
    Of::number(NewtonMetre, number::<36>).channel("wheel.right_rear.brake", "brake torque of the right rear wheel of the {} that could act").field(38, "right_rear_brake", "brake torque of the right rear wheel that could act"),
    Of::number(MetrePerSecond, number::<37>).channel("wheel.right_rear.slide_x", "sliding of the right rear wheel of the {} on the ground, ahead").field(39, "right_rear_slide_ahead", "sliding of the right rear wheel on the ground, ahead"),
    Of::number(MetrePerSecond, number::<38>).channel("wheel.right_rear.slide_y", "sliding of the right rear wheel of the {} on the ground, to the right").field(40, "right_rear_slide_right", "sliding of the right rear wheel on the ground, to the right"),
    Of::number(Newton, number::<39>).channel("wheel.right_rear.force_x", "force of the ground on the right rear wheel of the {} along it").field(41, "right_rear_force_ahead", "force of the ground on the right rear wheel along it"),
    Of::number(Newton, number::<40>).channel("wheel.right_rear.force_y", "force of the ground on the right rear wheel of the {} across it, to the right").field(42, "right_rear_force_right", "force of the ground on the right rear wheel across it, to the right"),
    Of::number(One, number::<41>).channel("wheel.right_rear.saturation", "share of its friction that the right rear wheel of the {} uses; 1 slides").field(43, "right_rear_saturation", "share of its friction that the right rear wheel uses; 1 slides"),
];
