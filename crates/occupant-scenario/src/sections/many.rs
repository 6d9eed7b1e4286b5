//! `[occupants]` and `[loose]`: several bodies, and how each becomes a scenario of its own in one world.

use indexmap::IndexMap;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::belts::BeltSection;
use super::body::BodySection;
use super::builder::{Builder, index_of};
use super::drive::Drives;
use super::frames::{Meets, VEHICLE};
use super::joints::JointsSection;
use super::markers::MarkerSection;
use super::mount::MountSection;
use super::muscles::MusclesSection;
use super::path::pose;
use super::posture::PostureSection;
use super::quantity::{POSITIVE, all_si, point};
use super::retractors::RetractorSection;
use super::self_contact::SelfContactSection;
use super::setup::setup;
use super::solids::SolidSection;
use super::stance::StanceSection;
use super::{Angle, AngularVelocity, Inertia, Length, Mass, Scenario, Speed};
use occupant_core::body::{Body, ContactSphere};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::forces::joint::Joints;
use occupant_core::model::seating::{InitialPosture, InitialVelocity, Mounting, Placing};
use occupant_core::model::setup::{LOOSE, Member, Setup};
use placed_text::{Diagnostics, Document, Node, Problem, with_key};

/// One of several occupants.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["posture", "stance", "mount"]]))]
pub(crate) struct OccupantSection {
    /// Name of the vehicle that it starts in, and whose axes its geometry uses: "vehicle" or one of `vehicles`. If
    /// absent, it is on the ground.
    pub(crate) vehicle: Option<String>,
    /// Its body.
    pub(crate) body: BodySection,
    /// Its joints.
    pub(crate) joints: JointsSection,
    /// Its seated posture.
    pub(crate) posture: Option<PostureSection>,
    /// Its standing posture.
    pub(crate) stance: Option<StanceSection>,
    /// A mount that holds one of its segments.
    pub(crate) mount: Option<MountSection>,
    /// Its muscles.
    pub(crate) muscles: Option<MusclesSection>,
    /// Markers by name: points of segments whose motion is recorded.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) markers: IndexMap<String, MarkerSection>,
    /// Belts by name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) belts: IndexMap<String, BeltSection>,
    /// Retractors by name; each serves one belt.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) retractors: IndexMap<String, RetractorSection>,
    /// Contact between parts of its body.
    pub(crate) self_contact: Option<SelfContactSection>,
}

/// A loose rigid body: an impactor, cargo, a child seat. Its geometry is given from its origin in its own axes, X
/// forward, Y left, Z up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LooseSection {
    /// Mass.
    pub(crate) mass: Mass<POSITIVE>,
    /// I_x, I_y, I_z about the centre of gravity.
    pub(crate) inertia: [Inertia; 3],
    /// Centre of gravity, at or above the origin; [0, 0, 0] if absent.
    pub(crate) cg: Option<[Length; 3]>,
    /// Name of the vehicle that it starts with, and whose axes `at` uses. If absent, none: `at` is in vehicle-space.
    pub(crate) vehicle: Option<String>,
    /// Position of its origin.
    pub(crate) at: [Length; 3],
    /// Roll, positive with the right side down; 0 if absent.
    pub(crate) roll: Option<Angle>,
    /// Pitch, positive with the top leant back; 0 if absent.
    pub(crate) pitch: Option<Angle>,
    /// Yaw, positive to the right; 0 if absent.
    pub(crate) yaw: Option<Angle>,
    /// Velocity relative to its vehicle, in the axes of `at`; [0, 0, 0] if absent.
    pub(crate) velocity: Option<[Speed; 3]>,
    /// Angular velocity relative to its vehicle, in the same axes; [0, 0, 0] if absent.
    pub(crate) spin: Option<[AngularVelocity; 3]>,
    /// Its spheres by name, which touch surfaces, solids and the spheres of others. Surfaces and solids with `frame` =
    /// its name are also part of it, and others touch those.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) spheres: IndexMap<String, LooseSphereSection>,
    /// Name of the material of its spheres; `contact.skin` if absent.
    pub(crate) skin: Option<String>,
}

/// A sphere of a loose body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LooseSphereSection {
    /// Centre, from the origin.
    pub(crate) centre: [Length; 3],
    /// Radius.
    pub(crate) radius: Length<POSITIVE>,
}

/// Keys of an occupant, which are top-level keys of a scenario with one occupant.
const OWN: [&str; 10] =
    ["body", "joints", "posture", "stance", "mount", "muscles", "markers", "belts", "retractors", "self_contact"];

/// The tree of a scenario with a single one of its occupants.
pub(crate) fn alone(root: &Node, occupant: &str) -> Option<Node> {
    let own = root.get("occupants")?.get(occupant)?.clone();
    let mut root = root.clone();
    let table = root.as_table_mut()?;
    table.shift_remove("occupants");
    for key in OWN {
        table.shift_remove(key);
        if let Some(entry) = own.as_table()?.get(key) {
            table.insert(key.to_owned(), entry.clone());
        }
    }
    Some(root)
}

/// Builds the plain data of several bodies in one world.
pub(crate) fn together(
    written: &Scenario,
    explicit: &Scenario,
    document: &Document,
    drives: Option<&Drives>,
) -> Result<(Setup, Diagnostics), Diagnostics> {
    let (mut problems, mut members, mut worlds) = (Diagnostics::new(), Vec::new(), Vec::new());
    if explicit.body.is_some() {
        let (world, found) = setup(written, explicit, document, drives)?;
        problems.extend(found);
        members.push((String::new(), Frame::Vehicle, world.clone()));
        worlds.push(world);
    }
    for (name, section) in &explicit.occupants {
        let root = alone(&document.root, name).unwrap_or_else(|| document.root.clone());
        let own = Document { root, ..document.clone() };
        let sections: Scenario = own.sections("scenario")?;
        let mut says = written.clone();
        says.body = written.occupants.get(name).map(|own| own.body.clone());
        says.joints = written.occupants.get(name).map(|own| own.joints.clone());
        let b = &mut Builder { document, problems: Diagnostics::new(), drives };
        let home = home_of(b, explicit, &format!("occupants.{name}"), section.vehicle.as_deref());
        if section.vehicle.is_none() && section.posture.is_some() {
            let problem = "a seated occupant without a vehicle";
            b.error(&format!("occupants.{name}"), problem, "vehicle = \"vehicle\", or the name of another");
        }
        problems.extend(std::mem::take(&mut b.problems));
        match setup(&says, &sections, &own, drives) {
            Ok((world, found)) => {
                problems.extend(found);
                members.push((name.clone(), home, world.clone()));
                worlds.push(world);
            }
            Err(found) => problems.extend(found),
        }
    }
    let Some(world) = worlds.into_iter().next().filter(|_| !problems.has_errors()) else { return Err(problems) };
    let b = &mut Builder { document, problems, drives };
    for (name, section) in &explicit.loose {
        let home = home_of(b, explicit, &format!("loose.{name}"), section.vehicle.as_deref());
        members.push((name.clone(), home, loose(b, name, section, &world)));
    }
    let setup = joined(b, explicit, world, members);
    let problems = std::mem::take(&mut b.problems);
    if problems.has_errors() { Err(problems) } else { Ok((setup, problems)) }
}

fn home_of(b: &mut Builder, s: &Scenario, path: &str, vehicle: Option<&str>) -> Frame {
    s.home(vehicle).unwrap_or_else(|| {
        let mut names = vec![VEHICLE];
        names.extend(s.vehicles.keys().map(String::as_str));
        b.unknown(&with_key(path, "vehicle"), "vehicle", vehicle.unwrap_or_default(), &names);
        Frame::Vehicle
    })
}

/// A loose body alone in its surroundings.
fn loose(b: &mut Builder, name: &str, section: &LooseSection, world: &Setup) -> Setup {
    let cg = section.cg.as_ref().map_or_else(Vector3::zeros, |cg| Vector3::from(all_si(cg)));
    if cg.z < 0.0 {
        b.error(&format!("loose.{name}.cg"), "a centre of gravity below the origin", "an origin at it or below it");
    }
    let mut body = Body::rigid(LOOSE, section.mass.si(), all_si(&section.inertia), cg);
    let segment = body.tree.segment(0);
    for (name, sphere) in &section.spheres {
        body.spheres.push(ContactSphere::new(name, segment, point(&sphere.centre), sphere.radius.si()));
    }
    let reach = |sphere: &ContactSphere| sphere.centre_from_lower_end_m.coords.norm();
    let longest_m = body.spheres.iter().map(reach).fold(cg.norm(), f64::max);
    body.segments[0].length_m = (2.0 * longest_m).max(0.1);
    let place_m = Vector3::from(all_si(&section.at));
    let attitude = pose(&None, [&section.roll, &section.pitch, &section.yaw]).attitude;
    let at = Mounting { frame: Frame::Vehicle, point_m: Vector3::zeros(), place_m, attitude, angles_rad: Vec::new() };
    let spin_rad_s = section.spin.as_ref().map_or_else(Vector3::zeros, |spin| Vector3::from(all_si(spin)));
    let given = section.velocity.as_ref().map(|v| InitialVelocity::Given(Vector3::from(all_si(v))));
    let mut setup = Setup {
        joints: Joints::free(body.tree),
        body,
        self_contact: None,
        belts: Vec::new(),
        chains: Vec::new(),
        bands: Vec::new(),
        posture: InitialPosture::Placed(Box::new(Placing { at, stands: false, spin_rad_s })),
        velocity: given.unwrap_or_default(),
        output: Default::default(),
        ..world.clone()
    };
    // who may touch a surface is said of the parts of an occupant
    let lists = setup.surfaces.iter_mut().map(|own| &mut own.spheres);
    for list in lists.chain(setup.solids.iter_mut().map(|own| &mut own.spheres)).flatten() {
        list.clear();
    }
    setup.bags.iter_mut().for_each(|bag| bag.spheres.clear());
    setup
}

/// All members with their common surroundings.
fn joined(b: &mut Builder, s: &Scenario, mut world: Setup, members: Vec<(String, Frame, Setup)>) -> Setup {
    let counts: Vec<usize> = members.iter().map(|(_, _, setup)| setup.body.segments.len()).collect();
    let first_loose = members.len() - s.loose.len();
    // loose bodies have been known by their places so far
    let settled = |frame: Frame| match frame {
        Frame::Segment(i) => Frame::Segment(counts[..first_loose + i].iter().sum()),
        frame => frame,
    };
    world.surfaces.iter_mut().for_each(|surface| surface.frame = settled(surface.frame));
    world.solids.iter_mut().for_each(|solid| solid.frame = settled(solid.frame));
    warn_of_unmet(b, s, &world, &members);
    let names: Vec<&str> = s.occupants.keys().map(String::as_str).collect();
    for (bag, section) in &s.bags {
        if let Some(name) = section.occupant.as_deref().filter(|name| !names.contains(name)) {
            b.unknown(&(with_key("bags", bag) + ".occupant"), "occupant", name, &names);
        }
    }
    let meets = s.surfaces.values().map(|own| own.meets.unwrap_or(Meets::Own));
    let meets = meets.chain(s.ground.iter().map(|_| Meets::All));
    let meets: Vec<Meets> = meets.chain(s.solids.values().map(SolidSection::meets)).collect();
    let own = |(name, home, mut setup): (String, Frame, Setup)| {
        let frames = world.surfaces.iter().map(|own| own.frame).chain(world.solids.iter().map(|own| own.frame));
        let lists = setup.surfaces.iter_mut().map(|own| &mut own.spheres);
        let lists = lists.chain(setup.solids.iter_mut().map(|own| &mut own.spheres));
        for ((spheres, frame), meets) in lists.zip(frames).zip(&meets) {
            if !s.is_met(*meets, frame, home) {
                *spheres = Some(Vec::new());
            }
        }
        for (bag, section) in setup.bags.iter_mut().zip(s.bags.values()) {
            if section.occupant.as_ref().is_some_and(|of| *of != name) {
                bag.spheres.clear();
            }
        }
        for (own, all) in setup.surfaces.iter_mut().zip(&world.surfaces) {
            own.frame = all.frame;
        }
        for (own, all) in setup.solids.iter_mut().zip(&world.solids) {
            own.frame = all.frame;
        }
        let lists = setup.surfaces.iter().map(|own| &own.spheres).chain(setup.solids.iter().map(|own| &own.spheres));
        Member { name, home, meets: lists.cloned().collect(), alone: setup.at_home(home) }
    };
    let members: Vec<Member> = members.into_iter().map(own).collect();
    let (pairs, skins) = pairs(b, s, &members);
    world.belts.clear();
    world.chains.clear();
    world.bands.clear();
    world.output.markers.clear();
    world.together(members, &pairs, &skins)
}

/// Reports bodies that pass through surfaces of another vehicle whose `meets` is not given.
fn warn_of_unmet(b: &mut Builder, s: &Scenario, world: &Setup, members: &[(String, Frame, Setup)]) {
    let surfaces = s.surfaces.iter().zip(&world.surfaces).filter(|((_, own), _)| own.meets.is_none());
    let surfaces: Vec<_> = surfaces.map(|((name, _), surface)| (name, surface.frame)).collect();
    for (name, home, _) in members.iter().filter(|(.., setup)| !setup.body.spheres.is_empty()) {
        let unmet = surfaces.iter().filter(|(_, frame)| !s.is_met(Meets::Own, *frame, *home));
        let unmet: Vec<&str> = unmet.map(|(name, _)| name.as_str()).collect();
        let Some((first, others)) = unmet.split_first() else { continue };
        let more = if others.is_empty() { String::new() } else { format!(" and {} more", others.len()) };
        let name = if name.is_empty() { "the occupant" } else { name };
        let found = format!(
            "{name} passes through {first}{more}: by default, only those who start in its vehicle touch a surface"
        );
        let expected = "meets = \"all\" if others can come in front of it, else \"own\"";
        let problem = Problem::warning(with_key("surfaces", first), found, expected);
        b.report(problem.with_hint(Some("a solid can be touched by all, from all sides")));
    }
}

/// Spheres of different bodies that can touch, by member and index, and the default skins of members.
fn pairs(b: &mut Builder, s: &Scenario, members: &[Member]) -> (Vec<[(usize, usize); 2]>, Vec<usize>) {
    let contact = s.contact.as_ref();
    let material = |name: &str| index_of(name, s.materials.keys().map(String::as_str));
    let common = contact.and_then(|contact| contact.skin.as_deref());
    let skin = |member: &Member| {
        let own = s.loose.get(&member.name).and_then(|own| own.skin.as_deref());
        own.or(common).map(material)
    };
    let skins: Vec<Option<usize>> = members.iter().map(skin).collect();
    let title = |member: &Member| if member.name.is_empty() { "occupant".to_owned() } else { member.name.clone() };
    let titles: Vec<String> = members.iter().map(title).collect();
    let mut list = Vec::new();
    let said = contact.and_then(|contact| contact.bodies.as_ref());
    for (i, names) in said.into_iter().flatten().enumerate() {
        let known: Vec<&str> = titles.iter().map(String::as_str).collect();
        for (j, name) in names.iter().enumerate().filter(|(_, name)| !titles.contains(name)) {
            b.unknown(&format!("contact.bodies[{i}][{j}]"), "body", name, &known);
        }
    }
    for (i, one) in members.iter().enumerate() {
        for (j, other) in members.iter().enumerate().skip(i + 1) {
            let is_said = |names: &[String; 2]| names.contains(&titles[i]) && names.contains(&titles[j]);
            if said.is_some_and(|said| !said.iter().any(is_said)) {
                continue;
            }
            let has_skin = |k: usize, member: &Member| skins[k].is_some() || member.alone.self_contact.is_some();
            let lacks = [(i, one), (j, other)].into_iter().find(|(k, member)| !has_skin(*k, member));
            let touching = !one.alone.body.spheres.is_empty() && !other.alone.body.spheres.is_empty();
            match lacks.filter(|_| touching) {
                Some((k, _)) => {
                    let found = format!("contact between bodies needs a skin material, and `{}` has none", titles[k]);
                    let expected = "contact.skin = the name of a material, a `self_contact.skin`, or contact.bodies = [] for no contact";
                    b.error("contact", found, expected);
                    return (Vec::new(), vec![0; members.len()]);
                }
                None => {
                    let all = (0..one.alone.body.spheres.len())
                        .flat_map(|a| (0..other.alone.body.spheres.len()).map(move |c| (a, c)));
                    list.extend(all.map(|(a, c)| [(i, a), (j, c)]));
                }
            }
        }
    }
    (list, skins.into_iter().map(|skin| skin.unwrap_or(0)).collect())
}
