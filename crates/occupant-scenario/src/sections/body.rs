//! `[body]`: its keys, converted to a [`Body`].

use indexmap::IndexMap;
use nalgebra::{Point3, UnitQuaternion, Vector2, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::body_joints::own_tree;
use super::builder::Builder;
use super::plates::{
    self, AbdomenChoice, BodyPlateSection, ChestChoice, LinkSection, PelvisChoice, RideSection, SidesChoice,
};
use super::quantity::{NOT_NEGATIVE, POSITIVE, all_si, point, si_or};
use super::{Acceleration, Angle, Force, Inertia, Length, Mass, Ratio};
use occupant_core::body::SphereRow;
use occupant_core::body::people::{Division, Person, REACH, REFERENCE_PERSON, Sex};
use occupant_core::body::tti12::TTI12;
use occupant_core::body::{Body, ContactSphere, Ride, Segment, SegmentProperties, Tree, shape};
use occupant_core::model::setup::STANDARD_GRAVITY_M_S2;
use placed_text::{Problem, with_key};

/// Largest number of spheres; each is tested against all surfaces, and against spheres of other bodies.
const MOST_SPHERES: usize = 500;

/// A preset, changes to it, or a whole body of your own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodySection {
    /// Body to start from; other keys override its values. Without a preset or a person (`sex`, `stature`, `mass`)
    /// everything must be given.
    #[schemars(extend("enum" = [
        "male50", "male50-1970", "female05", "female50", "male95", "child06", "child10",
    ]))]
    pub(crate) preset: Option<String>,
    /// A dummy by name: size, chest, neck and joints; keys given here and under `joints` override them.
    pub(crate) dummy: Option<DummyChoice>,
    /// Sex of an adult defined by sex, stature and mass.
    #[schemars(extend("enum" = ["female", "male"]))]
    pub(crate) sex: Option<String>,
    /// Standing height of that person.
    pub(crate) stature: Option<Length<POSITIVE>>,
    /// Mass of that person.
    pub(crate) mass: Option<Mass<POSITIVE>>,
    /// L_s, distance of a shoulder joint from the midsagittal plane.
    pub(crate) shoulder_half_width: Option<Length<NOT_NEGATIVE>>,
    /// L_H, distance of a hip joint from the midsagittal plane.
    pub(crate) hip_half_width: Option<Length<NOT_NEGATIVE>>,
    /// Height of the neck joint above the line of the shoulders; 0 if absent, as in the 1970 report.
    pub(crate) neck_height: Option<Length<NOT_NEGATIVE>>,
    /// Position of the occipital condyles, [ahead of, above] the joint between neck and head. Upper neck loads are
    /// given there, or at the joint if absent.
    pub(crate) condyles: Option<[Length; 2]>,
    /// Gravity used to convert a `weight` to a mass; standard gravity if absent.
    pub(crate) weighed_at: Option<Acceleration<POSITIVE>>,
    /// Number of segments of a preset or a person: 12, as in the 1970 report; 15, with feet and a neck on two joints;
    /// 17, with hands too; 19, with clavicles that carry the arms. If absent, 19 with `joints.preset` = "person" or
    /// "volunteer" and no other keys in `segments` or `joints`, else 12.
    pub(crate) segment_count: Option<i64>,
    /// The instrumented segments, for a body whose segments have other names.
    pub(crate) landmarks: Option<LandmarksSection>,
    /// Segments by name. The twelve are `middle_torso`, `upper_torso`, `head`, `lower_torso`, `left_upper_arm`,
    /// `left_forearm`, `left_thigh`, `left_lower_leg` and the same on the right. `upper_arms`, `forearms`, `hands`,
    /// `thighs`, `lower_legs`, `feet` stand for both sides.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) segments: IndexMap<String, SegmentSection>,
    /// Joints of your own body by name, or changes to those of a preset. Exactly one segment, the root, has no parent
    /// joint; its upper end is the reference point T1.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) joints: IndexMap<String, BodyJointSection>,
    /// Set of contact spheres, to which `spheres` adds your own; "even" in a car, else "report" if absent. With "report" and "full"
    /// each sphere has its own force: a limb that lies flat on four spheres is four times as stiff, whatever the area.
    pub(crate) sphere_set: Option<SphereSet>,
    /// Greatest distance between neighbouring spheres along a limb, in radii, from 0.4 to 3. If absent, 1.2 with "even" and 1.6 with
    /// "full". Half of it is twice as many spheres.
    pub(crate) sphere_spacing: Option<Ratio<POSITIVE>>,
    /// Compliance of the chest: "person", fitted to hub tests of cadavers and scaled by size; "dummy50", "dummy05f",
    /// those of the Hybrid III dummies; or "rigid". "person" in a car, else "rigid" if absent. A seat back
    /// bears on the spine, where the chest is always rigid.
    pub(crate) chest: Option<ChestChoice>,
    /// "flesh": tissue under a lap belt yields, with estimated values. "flesh" in a car, else "rigid" if absent.
    pub(crate) pelvis: Option<PelvisChoice>,
    /// "person": an abdomen, as a sphere and a plate above the pelvis, which belts, rims and doors can load; fitted to
    /// two values of belt pretensioner tests. "person" in a car, else "rigid", no abdomen, if absent.
    pub(crate) abdomen: Option<AbdomenChoice>,
    /// Ribs, abdomen and pelvis under loads from the side: "person", whose ribs and abdomen yield as from the front; "es2", a side impact
    /// dummy; or "rigid". "rigid" if absent. With them the measures are those of a side impact. They need
    /// `sphere_set` = "even" or "full".
    pub(crate) sides: Option<SidesChoice>,
    /// Deformable parts by name, or changes to those of `chest`: `sternum`, `left_ribs`, `right_ribs`; of `sides`:
    /// `left_side`, `right_side`, `abdomen_side`, `left_pelvis`, `right_pelvis`.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) plates: IndexMap<String, BodyPlateSection>,
    /// Springs and dampers between plates by name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) plate_links: IndexMap<String, LinkSection>,
    /// Contact spheres by name. The 17 of the 1970 report (`head`, `chest`, `pelvis`, `left_shoulder`, …) have a
    /// default centre and need only a radius; `shoulders`, `elbows`, `hands`, `thighs`, `knees`, `shins`, `feet` stand
    /// for both sides.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) spheres: IndexMap<String, SphereSection>,
}

/// A dummy, fitted to the tests named. Its masses, lengths and shape are those of a person of that size.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(crate) enum DummyChoice {
    /// Hybrid III, 50th-percentile male: neck fitted to 49 CFR 572.33 (11 of 12 values within the corridors), chest to
    /// 572.34, hips to 572.35; the back is that of 572.9; knees and limbs were not compared with tests.
    #[serde(rename = "hybrid3_50m-like")]
    HybridIii50M,
    /// Hybrid III, 5th-percentile female: neck fitted to 572.133, chest to 572.134, trunk to 572.135; nothing else was
    /// compared with tests.
    #[serde(rename = "hybrid3_5f-like")]
    HybridIii5F,
    /// Hybrid III, six-year-old child: neck fitted to 572.123, trunk to 572.125; its chest is rigid; nothing else was
    /// compared with tests.
    #[serde(rename = "hybrid3_6c-like")]
    HybridIii6C,
    /// Hybrid II: neck fitted to the pendulum test of 572.7 of 1973; its chest is rigid; nothing else was compared with
    /// tests.
    #[serde(rename = "hybrid2-like")]
    HybridIi,
}

/// A set of contact spheres.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum SphereSet {
    /// The 17 spheres of the 1970 report, with gaps between them.
    Report,
    /// Without gaps: a face, a chin and a neck, sides of chest and pelvis, an abdomen, rows along the limbs, forefeet. Sizes
    /// follow from the radii of the 17, of which thighs and shins become rows.
    Full,
    /// The same spheres as "full", but overlapping ones share their force: it depends on the body's area and not on the
    /// number of spheres.
    Even,
}

/// Segments that carry instruments.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LandmarksSection {
    /// Segment with the head accelerometer; its joint is the upper neck load cell. "head" if absent.
    pub(crate) head: Option<String>,
    /// Segment with the chest accelerometer; "upper_torso" or "chest" if absent.
    pub(crate) chest: Option<String>,
    /// Segment with the pelvis accelerometer, which sits on the cushion; "lower_torso" or "pelvis" if absent.
    pub(crate) pelvis: Option<String>,
}

/// A joint of the body and its position on both segments.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["axis", "axes_on_proximal"], ["axis", "axes_on_distal"]]))]
pub(crate) struct BodyJointSection {
    /// The parent segment, nearer to the root.
    pub(crate) proximal: Option<String>,
    /// The child segment.
    pub(crate) distal: Option<String>,
    /// Joint type: "ball"; "pin", one axis; "universal", about Y, then X of the joint's axes; "fixed". "ball" if
    /// absent.
    #[schemars(extend("enum" = ["ball", "pin", "universal", "fixed"]))]
    pub(crate) kind: Option<String>,
    /// Its position on the proximal segment, from that segment's lower end, in its axes (X forward, Y left, Z up when
    /// standing).
    pub(crate) on_proximal: Option<[Length; 3]>,
    /// Its position on the distal segment, from that segment's lower end, in its axes.
    pub(crate) on_distal: Option<[Length; 3]>,
    /// Axis of a pin, in the axes of both segments at angle 0; Y if absent.
    pub(crate) axis: Option<[Ratio; 3]>,
    /// Yaw, pitch and roll from the joint's axes to those of the proximal segment; none if absent. A pin turns about
    /// the joint's Y axis; bend and twist are measured from its Z axis.
    pub(crate) axes_on_proximal: Option<[Angle; 3]>,
    /// The same for the distal segment.
    pub(crate) axes_on_distal: Option<[Angle; 3]>,
}

/// One segment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["mass", "weight"]]))]
pub(crate) struct SegmentSection {
    /// L, distance between the segment's ends.
    pub(crate) length: Option<Length<POSITIVE>>,
    /// ρ, distance of the centre of gravity from the lower end in standing posture (the distal end of a limb).
    pub(crate) cg_from_lower_end: Option<Length>,
    /// [X, Y] of the centre of gravity, if it is off the line between the ends.
    pub(crate) cg_beside: Option<[Length; 2]>,
    /// Mass. Give this or `weight`.
    pub(crate) mass: Option<Mass<POSITIVE>>,
    /// Weight, as a force; divided by `body.weighed_at` to give the mass.
    pub(crate) weight: Option<Force<POSITIVE>>,
    /// I_x, I_y, I_z about the centre of gravity; X forward, Y left, Z up when standing.
    pub(crate) inertia: Option<[Inertia; 3]>,
    /// Yaw, pitch and roll from the principal axes of `inertia` to the segment's axes, if they differ. Segment axes are
    /// X forward, Y left, Z up: positive yaw is to the left, positive pitch leans the top forward. (In `mount`, loose
    /// bodies and paths, Z is down: positive yaw is to the right, positive pitch leans the top back.)
    pub(crate) principal_axes: Option<[Angle; 3]>,
}

/// A contact sphere.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SphereSection {
    /// Radius.
    pub(crate) radius: Option<Length<POSITIVE>>,
    /// Body part that it belongs to, such as "head". Results combine the forces on all spheres of a part. If absent,
    /// the part in the sphere set, else a part with its own name.
    pub(crate) part: Option<String>,
    /// Factor on its contact forces, for a material that was measured on the whole part; 1 if absent.
    pub(crate) share: Option<Ratio<POSITIVE>>,
    /// Segment that it is fixed to; that of the sphere set if absent.
    pub(crate) segment: Option<String>,
    /// Centre from the segment's lower end, in segment axes (X forward, Y left, Z up when standing).
    pub(crate) centre: Option<[Length; 3]>,
    /// Share of each plate's deflection that the sphere follows, by contact type; none if absent.
    pub(crate) ride: Option<RideSection>,
    /// True removes the sphere.
    pub(crate) remove: Option<bool>,
}

/// Presets of persons, which sex, stature and mass can modify.
const PEOPLE: &str = "one of female05, female50, male50, male95, or sex, stature and mass without a preset";

impl BodySection {
    /// Whether it gives a person's size.
    pub(crate) fn describes_a_person(&self) -> bool {
        self.sex.is_some() || self.stature.is_some() || self.mass.is_some()
    }

    /// Whether it is a dummy, or has the chest or the sides of one.
    pub(crate) fn is_of_dummy(&self) -> bool {
        self.dummy.is_some()
            || matches!(self.chest, Some(ChestChoice::Dummy50 | ChestChoice::Dummy05f))
            || self.sides == Some(SidesChoice::Es2)
    }

    /// The person described, as changes of another.
    pub(crate) fn person(&self, from: Person) -> Person {
        let sex = self.sex.as_deref().map(|sex| if sex == "female" { Sex::Female } else { Sex::Male });
        Person {
            sex: sex.unwrap_or(from.sex),
            stature_m: si_or(&self.stature, from.stature_m),
            mass_kg: si_or(&self.mass, from.mass_kg),
        }
    }
}

/// Checks that a person's size is complete and within the range of the surveys.
fn check_person(b: &mut Builder, preset: Option<&str>, section: &BodySection) {
    if !section.describes_a_person() {
        return;
    }
    let named = preset.and_then(Person::named);
    if let (Some(preset), None) = (preset, named) {
        b.error("body.preset", format!("the preset {preset} has one size"), PEOPLE);
        return;
    }
    if named.is_none() {
        let is_whole = section.sex.is_some() && section.stature.is_some() && section.mass.is_some();
        b.needed("body", "stature", &section.stature);
        b.needed("body", "mass", &section.mass);
        if section.sex.is_none() {
            b.error("body", "`body` has no key `sex`", "sex = \"female\" or \"male\"");
        }
        if !is_whole {
            return;
        }
    }
    let person = section.person(named.unwrap_or(REFERENCE_PERSON));
    let size = format!("a person of {:.3} m and {:.1} kg", person.stature_m, person.mass_kg);
    if !(1.4..=2.05).contains(&person.stature_m) && section.stature.is_some() {
        b.error("body.stature", format!("no adult is {} m tall", person.stature_m), REACH);
    } else if !person.is_within_reach() {
        b.error("body", size, REACH);
    } else if let factor @ (..0.9 | 1.1..) = person.body(Division::default()).1 {
        let found = format!("{size}: segment masses by volume must be scaled by {factor:.2} to reach that mass");
        b.report(Problem::warning(
            "body",
            found,
            "a factor of 0.9 to 1.1: beyond it, a person is unlike those who were measured",
        ));
    }
}

impl BodySection {
    /// The division into segments of a preset or a person.
    pub(crate) fn division(&self) -> Option<Division> {
        self.segment_count.map_or(Some(Division::default()), Division::of)
    }
}

/// The body; `section` is explicit, `preset` is its origin. A partial body (`is_part`) needs no head, chest or pelvis.
/// None if its joints form no tree.
pub(super) fn body(b: &mut Builder, preset: Option<&str>, section: &BodySection, is_part: bool) -> Option<Body> {
    if section.spheres.len() > MOST_SPHERES {
        let found = format!("{} spheres", section.spheres.len());
        b.error("body.spheres", found, format!("at most {MOST_SPHERES}"));
        return None;
    }
    check_person(b, preset, section);
    check_division(b, preset, section);
    let spacing = section.sphere_spacing.as_ref().map(Ratio::si);
    if let Some(spacing) = spacing.filter(|spacing| !(0.4..=3.0).contains(spacing)) {
        b.error("body.sphere_spacing", format!("{spacing}"), "0.4 to 3");
    } else if spacing.is_some() && section.sphere_set.is_none_or(|set| set == SphereSet::Report) {
        let found = "`sphere_spacing` without rows of spheres";
        b.error("body.sphere_spacing", found, "sphere_set = \"even\" or \"full\"");
    }
    let weighed_at_m_s2 = si_or(&section.weighed_at, STANDARD_GRAVITY_M_S2);
    let (tree, places) = if section.joints.is_empty() { (&TTI12, Vec::new()) } else { own_tree(b, section, is_part)? };
    for name in section.segments.keys().filter(|name| tree.segment_named(name).is_none()) {
        let names: Vec<&str> = tree.segment_rows().iter().map(|row| row.name).collect();
        b.unknown(&with_key("body.segments", name), "segment", name, &names);
    }
    let half_width_m = |b: &mut Builder, key: &str, width: &Option<Length<NOT_NEGATIVE>>| {
        if section.joints.is_empty() { b.needed("body", key, width) } else { si_or(width, 0.0) }
    };
    let mut body = Body {
        name: preset.unwrap_or(if section.describes_a_person() { "person" } else { "own" }).to_owned(),
        tree,
        segments: tree.segment_rows().iter().map(|row| segment(b, row.name, weighed_at_m_s2)).collect(),
        places,
        shoulder_half_width_m: half_width_m(b, "shoulder_half_width", &section.shoulder_half_width),
        hip_half_width_m: half_width_m(b, "hip_half_width", &section.hip_half_width),
        neck_height_m: si_or(&section.neck_height, 0.0),
        condyles_m: section.condyles.as_ref().map(all_si).map(|[ahead, above]| Vector3::new(ahead, 0.0, above)),
        spheres: Vec::new(),
        plates: Vec::new(),
        chests: Vec::new(),
        sides: Vec::new(),
    };
    body.plates = plates::plates(b, section, &body);
    body.spheres = spheres(b, section, &body);
    body.chests.extend(plates::chest(b, section, &body));
    let sides = plates::sides(b, section, &mut body);
    body.sides.extend(sides);
    Some(body)
}

fn check_division(b: &mut Builder, preset: Option<&str>, section: &BodySection) {
    let Some(count) = section.segment_count else { return };
    if section.division().is_none() {
        b.error("body.segment_count", format!("{count} segments"), "12, 15, 17 or 19");
    } else if count != 12 && preset.is_none() && !section.describes_a_person() && section.joints.is_empty() {
        let expected = "a preset or a person, or your own `[body.joints]`";
        b.error("body.segment_count", "`segment_count` in a body with its own joints", expected);
    } else if preset == Some("male50-1970") && count != 12 {
        b.error("body.segment_count", format!("male50-1970 in {count} segments"), "12, or preset = \"male50\"");
    }
}

fn segment(b: &mut Builder, name: &str, weighed_at_m_s2: f64) -> SegmentProperties {
    let path = with_key("body.segments", name);
    let Some(section) = b.section::<SegmentSection>(&path) else {
        let found = format!("the body has no segment `{name}`");
        let hint = "body.preset = \"male50\" gives a complete body to change";
        b.report(Problem::error(path, found, "all twelve segments").with_hint(Some(hint)));
        return SegmentProperties::new(f64::NAN, f64::NAN, f64::NAN, Vector3::zeros());
    };
    let mass_kg = match (&section.mass, &section.weight) {
        (None, Some(weight)) => weight.si() / weighed_at_m_s2,
        (mass, _) => b.needed(&path, "mass", mass),
    };
    let inertia_kg_m2 = match &section.inertia {
        Some(inertia) => Vector3::from(all_si(inertia)),
        None => {
            b.error(&path, format!("`{path}` has no key `inertia`"), "inertia = [I_x, I_y, I_z]");
            Vector3::zeros()
        }
    };
    let length_m = b.needed(&path, "length", &section.length);
    let cg_m = b.needed(&path, "cg_from_lower_end", &section.cg_from_lower_end);
    SegmentProperties {
        cg_beside_m: section.cg_beside.as_ref().map_or_else(Vector2::zeros, |beside| all_si(beside).into()),
        principal: turned(&section.principal_axes),
        ..SegmentProperties::new(length_m, mass_kg, cg_m, inertia_kg_m2)
    }
}

/// Yaw, pitch and roll: R_z R_y R_x.
pub(super) fn turned(angles: &Option<[Angle; 3]>) -> UnitQuaternion<f64> {
    let [yaw, pitch, roll] = angles.as_ref().map_or([0.0; 3], all_si);
    UnitQuaternion::from_euler_angles(roll, pitch, yaw)
}

/// The spheres: those of the set in order, then others as written.
fn spheres(b: &mut Builder, body_section: &BodySection, body: &Body) -> Vec<ContactSphere> {
    let sections = &body_section.spheres;
    let kept = |name: &str| {
        let section = sections.get(name)?;
        (section.remove != Some(true)).then_some(section)
    };
    let radius_m = |row: &SphereRow| {
        kept(row.name).map_or(0.0, |s| b.needed(&format!("body.spheres.{}", row.name), "radius", &s.radius))
    };
    let standard = body.tree.spheres();
    let radii_m: Vec<f64> = standard.iter().map(radius_m).collect();
    let mut spheres = Vec::new();
    for sphere in body.standard_spheres(&radii_m) {
        spheres.extend(kept(&sphere.name).map(|section| changed(b, body, sphere, section)));
    }
    let set = body_section.sphere_set.unwrap_or(SphereSet::Report);
    let usual_apart = if set == SphereSet::Even { shape::APART_EVENLY } else { shape::APART };
    if set != SphereSet::Report {
        spheres = shape::full(body, spheres, si_or(&body_section.sphere_spacing, usual_apart));
    }
    let yields_aside =
        set != SphereSet::Report && body_section.sides.is_some_and(|choice| choice != SidesChoice::Rigid);
    let is_later = |name: &str| yields_aside && ["left_abdomen", "right_abdomen"].contains(&name);
    let is_own = |name: &str| standard.iter().all(|row| row.name != name) && !is_later(name);
    for (name, section) in sections.iter().filter(|(name, _)| is_own(name)) {
        let known = spheres.iter().position(|sphere| sphere.name == *name);
        match (known, section.remove) {
            (Some(i), Some(true)) => drop(spheres.remove(i)),
            (Some(i), _) => spheres[i] = changed(b, body, spheres[i].clone(), section),
            (None, Some(true)) => {}
            (None, _) => spheres.extend(own_sphere(b, body, name, section)),
        }
    }
    if yields_aside {
        spheres.extend(sides_of_abdomen(b, body_section, body, &spheres));
    }
    if set == SphereSet::Even {
        shape::share_evenly(&mut spheres);
    }
    spheres
}

/// Spheres at the sides of an abdomen, if there is one, changed or left out as the section says.
fn sides_of_abdomen(
    b: &mut Builder,
    body_section: &BodySection,
    body: &Body,
    spheres: &[ContactSphere],
) -> Vec<ContactSphere> {
    let abdomen = spheres.iter().find(|sphere| sphere.name == "abdomen");
    let side = |sphere: ContactSphere| match body_section.spheres.get(&sphere.name) {
        Some(section) if section.remove == Some(true) => None,
        Some(section) => Some(changed(b, body, sphere, section)),
        None => Some(sphere),
    };
    abdomen.into_iter().flat_map(shape::sides_of_abdomen).filter_map(side).collect()
}

/// A sphere of the set with its own size, position or part.
fn changed(b: &mut Builder, body: &Body, mut sphere: ContactSphere, section: &SphereSection) -> ContactSphere {
    let path = with_key("body.spheres", &sphere.name);
    let segment = carrier(b, body.tree, &path, section);
    if let Some(centre) = &section.centre {
        sphere.centre_from_lower_end_m = point(centre);
        sphere.segment = segment.unwrap_or(sphere.segment);
    } else if segment.is_some_and(|s| s != sphere.segment) {
        b.error(
            &with_key(&path, "segment"),
            format!("sphere `{}` is moved to another segment without a `centre`", sphere.name),
            "centre = [x, y, z] from the lower end of that segment",
        );
    }
    ContactSphere {
        radius_m: si_or(&section.radius, sphere.radius_m),
        part: section.part.clone().unwrap_or(sphere.part),
        share: si_or(&section.share, sphere.share),
        bar_share: si_or(&section.share, sphere.bar_share),
        ride: section.ride.as_ref().map_or(sphere.ride, |ride| plates::ride(b, &path, ride, body)),
        ..sphere
    }
}

/// The segment of a sphere.
fn carrier(b: &mut Builder, tree: &Tree, path: &str, section: &SphereSection) -> Option<Segment> {
    let name = section.segment.as_deref()?;
    let segment = tree.segment_named(name);
    if segment.is_none() {
        let names: Vec<&str> = tree.segment_rows().iter().map(|row| row.name).collect();
        b.unknown(&with_key(path, "segment"), "segment", name, &names);
    }
    segment
}

fn own_sphere(b: &mut Builder, body: &Body, name: &str, section: &SphereSection) -> Option<ContactSphere> {
    let tree = body.tree;
    let path = with_key("body.spheres", name);
    let radius_m = b.needed(&path, "radius", &section.radius);
    let segment = carrier(b, tree, &path, section);
    if section.segment.is_none() {
        let found = format!("sphere `{name}` without a segment");
        let hint = format!("only the 17 standard spheres have a default segment: {}", tree.sphere_names().join(", "));
        b.report(Problem::error(&path, found, "segment = the segment that carries it").with_hint(Some(hint)));
    }
    if section.centre.is_none() {
        let found = format!("sphere `{name}` without a centre");
        b.error(&path, found, "centre = [x, y, z] from the lower end of its segment");
    }
    let centre_m = section.centre.as_ref().map_or_else(Point3::origin, point);
    let sphere = ContactSphere::new(name, segment?, centre_m, radius_m);
    let part = section.part.clone().unwrap_or_else(|| name.to_owned());
    let ride = section.ride.as_ref().map_or_else(Ride::default, |ride| plates::ride(b, &path, ride, body));
    let share = si_or(&section.share, 1.0);
    Some(ContactSphere { part, share, bar_share: share, ride, ..sphere })
}
