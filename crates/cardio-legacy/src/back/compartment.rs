//! Materials and surfaces → series 8 and 9.

use nalgebra::{Point3, Vector3};
use occupant_core::forces::contact::material::{DEFAULT_FRICTION_SPEED_M_S, Material, Memory};
use occupant_core::forces::contact::surface::{Frame, Outline, Surface};
use occupant_units::trig;

use super::digits::factor;
use super::points::{Polygon, place_points};
use super::{Back, unit_of};
use crate::compartment::{CompartmentLayout, Corner};

/// Tolerance of positions, in parts of 1 m plus the value, for rounding of the wheel's position.
const SAME_PLACE: f64 = 1e-9;

pub(super) fn read(back: &mut Back<'_>, layout: &CompartmentLayout) {
    let numbers: Vec<Option<u32>> = back.setup.surfaces.iter().map(|s| layout.number_of(&s.name)).collect();
    let mut polygons = Vec::new();
    for (surface, number) in back.setup.surfaces.iter().zip(numbers) {
        match number {
            Some(number) => {
                read_surface(back, layout, surface, number);
                polygons.extend(polygon(back, layout, surface, number));
            }
            None => back.misfit(format!("surfaces.{}: it is none of the 25 surfaces of the cards", surface.name)),
        }
    }
    for solid in &back.setup.solids {
        back.misfit(format!("solids.{}: cards have only plane surfaces", solid.name));
    }
    place_points(back, polygons);
    for surface in back.setup.surfaces.iter().filter(|surface| surface.name == layout.wheel.name) {
        check_wheel(back, layout, surface);
    }
    let there = |name: &str| back.setup.surfaces.iter().any(|s| s.name == name);
    let kept = |number: u32| back.kept.contains_key(&format!("STIF1({number})"));
    let missing = (1..=25).filter(|n| !kept(*n)).filter_map(|n| layout.name_of(n)).filter(|name| !there(name));
    let missing: Vec<&str> = missing.collect();
    if !missing.is_empty() {
        back.misfit(format!("surfaces {} are missing: cards need all 25 surfaces", missing.join(", ")));
    }
}

fn read_surface(back: &mut Back<'_>, layout: &CompartmentLayout, surface: &Surface, number: u32) {
    let name = &surface.name;
    back.misfit_if(
        surface.frame != Frame::Vehicle,
        format!("surfaces.{name}.frame: the cards' surfaces belong to the vehicle"),
    );
    back.misfit_if(
        surface.spheres.is_some(),
        format!("surfaces.{name}.spheres: on cards all spheres touch all surfaces"),
    );
    if let Some(material) = back.setup.materials.get(surface.material) {
        read_material(back, material, number);
    }
    match (&surface.outline, number == layout.wheel.number) {
        (Outline::Disc { centre_m, radius_m, .. }, true) => {
            back.set_all([("DSW", 2.0 * radius_m), ("SWP", -centre_m.y)]);
        }
        (Outline::Polygon(_), false) => {}
        _ => back.misfit(format!("surfaces.{name}: cards have a disc for the wheel and polygons for the others")),
    }
}

fn read_material(back: &mut Back<'_>, material: &Material, number: u32) {
    let Some(spring) = material.force.bilinear() else {
        back.misfit(format!("materials.{}: on cards a material is two straight lines, `k1` and `k2`", material.name));
        return;
    };
    back.misfit_if(
        material.memory != Memory::Reset,
        format!("materials.{}.memory = \"retain\": cards forget", material.name),
    );
    let usual = material.friction_speed_m_s == DEFAULT_FRICTION_SPEED_M_S;
    back.misfit_if(!usual, format!("materials.{}.friction_speed: cards cannot choose it", material.name));
    let has_factors = material.friction_factors.iter().any(|rows| !rows.is_empty());
    back.misfit_if(has_factors, format!("materials.{}: friction on cards is one number", material.name));
    let slopes = [("STIF1", spring.k1_n_per_m), ("STIF2", spring.k2_n_per_m), ("DELB", spring.break_m)];
    let losses = [("AMU1", spring.returned_1), ("AMU2", spring.returned_2), ("COFR", material.friction)];
    back.set_numbered(number, slopes);
    back.set_numbered(number, losses);
}

fn polygon(back: &mut Back<'_>, layout: &CompartmentLayout, surface: &Surface, number: u32) -> Option<Polygon> {
    let Outline::Polygon(corners) = &surface.outline else { return None };
    let (name, wanted) = (&surface.name, layout.corners_of(number));
    if wanted.len() != corners.len() {
        back.misfit(format!("surfaces.{name} has {} corners; on cards it has {}", corners.len(), wanted.len()));
        return None;
    }
    let count = corners.len();
    let orders = (0..count).flat_map(|start| [false, true].map(|turned| order(count, start, turned)));
    let on_their_sides =
        orders.filter(|order| order.iter().zip(wanted).all(|(at, corner)| on_its_side(corner, &corners[*at])));
    // each coordinate once, whatever the order of the corners
    let mut inches = |(name, si): (&str, f64)| back.fitting(name, unit_of("VCW"), si);
    let place = |at: &Point3<f64>| [("XV", at.x), ("ZV", at.z), ("VCW and VRW", at.y.abs())].map(&mut inches);
    let places: Vec<[String; 3]> = corners.iter().map(place).collect();
    let reading =
        |order: Vec<usize>| order.iter().zip(wanted).flat_map(|(at, corner)| fields_at(corner, &places[*at])).collect();
    let readings: Vec<_> = on_their_sides.map(reading).collect();
    if readings.is_empty() {
        back.misfit(format!(
            "surfaces.{name}: its corners do not lie left and right as those of the cards' surface {number}"
        ));
    }
    Some(Polygon { name: name.clone(), readings })
}

fn order(count: usize, start: usize, turned: bool) -> Vec<usize> {
    (0..count).map(|i| if turned { (start + count - i) % count } else { (start + i) % count }).collect()
}

fn on_its_side(corner: &Corner, place: &Point3<f64>) -> bool {
    corner.wall.is_left == (place.y < 0.0)
}

/// Position of a corner as fields of series 8.
fn fields_at(corner: &Corner, [x, z, width]: &[String; 3]) -> [(String, String); 3] {
    [
        (format!("XV({})", corner.x_of), x.clone()),
        (format!("ZV({})", corner.z_of), z.clone()),
        (corner.wall.half_width.to_owned(), width.clone()),
    ]
}

/// Cards have no field for the wheel's position; a position other than that of a conversion is lost.
fn check_wheel(back: &mut Back<'_>, layout: &CompartmentLayout, surface: &Surface) {
    let Outline::Disc { centre_m, axis, .. } = &surface.outline else { return };
    let wheel = &layout.wheel;
    let inch = factor(unit_of("VCW"));
    let known = |name: &str| back.digits(&format!("{name}({})", wheel.point)).and_then(|d| d.parse::<f64>().ok());
    let [x, z] = ["XV", "ZV"].map(|name| known(name).unwrap_or(f64::NAN) * inch);
    let (sin, cos) = trig::sin_cos(wheel.tilt_deg.to_radians());
    let tilted = (axis / axis.norm() - Vector3::new(-cos, 0.0, -sin)).norm() > SAME_PLACE;
    let differ = |one: f64, two: f64| (one - two).abs() > SAME_PLACE * (1.0 + one.abs());
    let moved = differ(x - wheel.behind_in * inch, centre_m.x) || differ(z + wheel.below_in * inch, centre_m.z);
    back.misfit_if(
        moved || tilted,
        format!(
            "surfaces.{}: no card places the wheel; a deck has it {}, tilted {} degrees",
            wheel.name,
            wheel.words(),
            wheel.tilt_deg
        ),
    );
}
