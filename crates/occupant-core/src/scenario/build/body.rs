//! `[body]` → [`Body`].

use indexmap::IndexMap;
use nalgebra::{Point3, Vector3};

use super::builder::Builder;
use crate::body::tree::SphereRow;
use crate::body::tti12::TTI12;
use crate::body::{Body, ContactSphere, SegmentProperties, Tree};
use crate::model::setup::STANDARD_GRAVITY_M_S2;
use crate::scenario::model::{BodySection, SegmentSection, Segments, SphereSection};
use crate::scenario::path_text::with_key;

/// The body; `section` is explicit, `preset` is the one it came from.
pub(super) fn body(b: &mut Builder, preset: Option<&str>, section: &BodySection) -> Body {
    let weighed_at_m_s2 = b.optional("body.weighed_at", &section.weighed_at, STANDARD_GRAVITY_M_S2);
    let none = Segments::default();
    let sections = section.segments.as_ref().unwrap_or(&none);
    let tree = &TTI12;
    let segment = |i: usize| {
        let name = tree.segment_rows()[i].name;
        segment(b, name, said_of(sections, name), weighed_at_m_s2)
    };
    let segments = std::array::from_fn(segment);
    let shoulder_half_width_m = b.needed("body", "shoulder_half_width", &section.shoulder_half_width);
    let hip_half_width_m = b.needed("body", "hip_half_width", &section.hip_half_width);
    let mut out = Body {
        name: preset.unwrap_or("own").to_owned(),
        tree,
        segments,
        shoulder_half_width_m,
        hip_half_width_m,
        spheres: Vec::new(),
    };
    out.spheres = spheres(b, &section.spheres, &out);
    out
}

/// What is said of a segment.
fn said_of<'s>(s: &'s Segments, name: &str) -> Option<&'s SegmentSection> {
    match name {
        "middle_torso" => s.middle_torso.as_ref(),
        "upper_torso" => s.upper_torso.as_ref(),
        "head" => s.head.as_ref(),
        "lower_torso" => s.lower_torso.as_ref(),
        "left_upper_arm" => s.left_upper_arm.as_ref(),
        "right_upper_arm" => s.right_upper_arm.as_ref(),
        "left_forearm" => s.left_forearm.as_ref(),
        "right_forearm" => s.right_forearm.as_ref(),
        "left_thigh" => s.left_thigh.as_ref(),
        "right_thigh" => s.right_thigh.as_ref(),
        "left_lower_leg" => s.left_lower_leg.as_ref(),
        "right_lower_leg" => s.right_lower_leg.as_ref(),
        _ => None,
    }
}

fn segment(b: &mut Builder, name: &str, section: Option<&SegmentSection>, weighed_at_m_s2: f64) -> SegmentProperties {
    let path = format!("body.segments.{name}");
    let Some(section) = section else {
        b.error_with_hint(
            &path,
            format!("the body has no segment `{name}`"),
            "all twelve segments",
            "body.preset = \"male50\" gives a whole body to change",
        );
        return SegmentProperties {
            length_m: f64::NAN,
            mass_kg: f64::NAN,
            cg_from_lower_end_m: f64::NAN,
            inertia_kg_m2: Vector3::zeros(),
        };
    };
    let mass_kg = match (&section.mass, &section.weight) {
        (None, Some(weight)) => b.si(&with_key(&path, "weight"), weight) / weighed_at_m_s2,
        (mass, _) => b.needed(&path, "mass", mass),
    };
    let inertia_kg_m2 = match &section.inertia {
        Some(inertia) => Vector3::from(b.triple(&with_key(&path, "inertia"), inertia)),
        None => {
            b.error(&path, format!("`{path}` has no key `inertia`"), "inertia = [I_x, I_y, I_z]");
            Vector3::zeros()
        }
    };
    SegmentProperties {
        length_m: b.needed(&path, "length", &section.length),
        mass_kg,
        cg_from_lower_end_m: b.needed(&path, "cg_from_lower_end", &section.cg_from_lower_end),
        inertia_kg_m2,
    }
}

/// The spheres: the report's in its order, then others as written.
fn spheres(b: &mut Builder, sections: &IndexMap<String, SphereSection>, body: &Body) -> Vec<ContactSphere> {
    let kept = |name: &str| {
        let section = sections.get(name)?;
        (section.remove != Some(true)).then_some(section)
    };
    let standard = body.tree.spheres();
    let radius_m = |row: &SphereRow| {
        kept(row.name).map_or(0.0, |s| b.needed(&format!("body.spheres.{}", row.name), "radius", &s.radius))
    };
    let radii_m: Vec<f64> = standard.iter().map(radius_m).collect();
    let mut spheres = Vec::new();
    for sphere in body.standard_spheres(&radii_m) {
        if let Some(section) = kept(&sphere.name) {
            spheres.push(moved(b, body.tree, sphere, section));
        }
    }
    for (name, section) in sections {
        if standard.iter().all(|row| row.name != name) && section.remove != Some(true) {
            spheres.extend(own_sphere(b, body.tree, name, section));
        }
    }
    spheres
}

/// A standard sphere with a place of its own.
fn moved(b: &mut Builder, tree: &Tree, mut sphere: ContactSphere, section: &SphereSection) -> ContactSphere {
    let path = with_key("body.spheres", &sphere.name);
    let segment = section.segment.as_deref().and_then(|name| tree.segment_named(name));
    if let Some(centre) = &section.centre {
        sphere.centre_from_lower_end_m = b.point(&with_key(&path, "centre"), centre);
        sphere.segment = segment.unwrap_or(sphere.segment);
    } else if segment.is_some_and(|s| s != sphere.segment) {
        b.error(
            &with_key(&path, "segment"),
            format!("`{}` moved to another segment without a place there", sphere.name),
            "centre = [x, y, z] from the lower end of that segment",
        );
    }
    sphere
}

fn own_sphere(b: &mut Builder, tree: &Tree, name: &str, section: &SphereSection) -> Option<ContactSphere> {
    let path = with_key("body.spheres", name);
    let radius_m = b.needed(&path, "radius", &section.radius);
    let segment = section.segment.as_deref().and_then(|name| tree.segment_named(name));
    if segment.is_none() {
        let found = format!("sphere `{name}` without a segment");
        b.error_with_hint(
            &path,
            found,
            "segment = the segment that carries it",
            format!("only the report's 17 spheres know theirs: {}", standard_names(tree).join(", ")),
        );
    }
    let centre = match &section.centre {
        Some(centre) => Some(b.point(&with_key(&path, "centre"), centre)),
        None => {
            let found = format!("sphere `{name}` without a centre");
            b.error(&path, found, "centre = [x, y, z] from the lower end of its segment");
            None
        }
    };
    Some(ContactSphere {
        name: name.to_owned(),
        segment: segment?,
        centre_from_lower_end_m: centre.unwrap_or_else(Point3::origin),
        radius_m,
    })
}

/// Names of the spheres that know their segment.
fn standard_names(tree: &Tree) -> Vec<&'static str> {
    tree.spheres().iter().map(|row| row.name).collect()
}
