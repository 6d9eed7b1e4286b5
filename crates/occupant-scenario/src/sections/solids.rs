//! `[solids]`: the keys of each kind of solid, converted to [`Solid`]s.

use nalgebra::{Point3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::{Builder, index_of};
use super::frames::Meets;
use super::path::pose;
use super::quantity::{NOT_NEGATIVE, POSITIVE, all_si, point, si_or};
use super::surfaces::{FacingChoice, SurfaceSection, report_undecided, surface};
use super::{Angle, Length, Ratio, Scenario};
use occupant_core::body::Body;
use occupant_core::forces::contact::flat_face::FlatFace;
use occupant_core::forces::contact::solid::{Shape, Solid};
use occupant_core::forces::contact::surface::{Frame, wheel_axis};
use placed_text::{Problems, with_key};

/// The sections of all kinds, each with the keys that every solid has.
macro_rules! kinds {
    ($($(#[$about:meta])* $Kind:ident($Section:ident $(, $rule:literal = $keys:tt)*) { $($(#[$doc:meta])* $key:ident: $Type:ty,)* })*) => {
        /// A solid: a body with thickness that spheres can touch.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(tag = "kind", rename_all = "snake_case")]
        pub(crate) enum SolidSection {
            $($(#[$about])* $Kind(Box<$Section>),)*
        }

        $(
            $(#[$about])*
            #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
            #[serde(deny_unknown_fields)]
            #[schemars(extend($($rule = $keys),*))]
            pub(crate) struct $Section {
                /// Name of its material in `materials`.
                pub(crate) material: String,
                /// Frame that it is fixed to; "vehicle" if absent.
                pub(crate) frame: Option<String>,
                /// With several bodies, which ones can touch it, as for a surface; "all" if absent.
                pub(crate) meets: Option<Meets>,
                /// Name of a group. Solids of a group act as one body without seams; they share frame and material.
                pub(crate) group: Option<String>,
                /// Names of the body parts or spheres that can touch it; all if absent.
                pub(crate) spheres: Option<Vec<String>>,
                /// True: it supports the spine, as a seat back does; see surfaces.
                pub(crate) behind: Option<bool>,
                $($(#[$doc])* pub(crate) $key: $Type,)*
            }
        )*

        impl SolidSection {
            /// The outline of a prism seen from the side.
            pub(crate) fn profile(&self) -> Option<&[[Length; 2]]> {
                if let SolidSection::Prism(prism) = self { prism.profile.as_deref() } else { None }
            }

            /// Whether it supports the spine.
            pub(super) fn behind(&self) -> Option<bool> {
                match self {
                    $(SolidSection::$Kind(s) => s.behind,)*
                }
            }

            /// Bodies that can touch it: all by default, because a solid resists from all sides.
            pub(super) fn meets(&self) -> Meets {
                let said = match self {
                    $(SolidSection::$Kind(s) => s.meets,)*
                };
                said.unwrap_or(Meets::All)
            }

            /// Its frame by name.
            pub(super) fn frame(&self) -> Option<&str> {
                self.common().frame
            }

            fn common(&self) -> Common<'_> {
                match self {
                    $(SolidSection::$Kind(s) => Common {
                        material: &s.material,
                        frame: s.frame.as_deref(),
                        group: &s.group,
                        spheres: &s.spheres,
                    },)*
                }
            }
        }
    };
}

/// Keys of every solid.
struct Common<'a> {
    material: &'a str,
    frame: Option<&'a str>,
    group: &'a Option<String>,
    spheres: &'a Option<Vec<String>>,
}

kinds! {
    /// A prism: a convex polygon, extended to both sides.
    Prism(PrismSection, "x-exactly-one" = [["points", "profile"]]) {
        /// Corners [x, y, z] of a convex plane polygon, in any order.
        points: Option<Vec<[Length; 3]>>,
        /// The same, seen from the side, as [x, z].
        profile: Option<Vec<[Length; 2]>>,
        /// Lateral position of the profile; 0 if absent.
        y: Option<Length>,
        /// Extent to each side of the polygon.
        half_width: Length<POSITIVE>,
        /// Radius of its edges and corners; 0 if absent.
        rounding: Option<Length<NOT_NEGATIVE>>,
    }
    /// A box. Angles are yaw, then pitch, then roll.
    Box(BoxSection) {
        /// Its centre.
        centre: [Length; 3],
        /// Its lengths along x, y and z, before rotation.
        lengths: [Length<POSITIVE>; 3],
        /// Roll; 0 if absent.
        roll: Option<Angle>,
        /// Pitch; 0 if absent.
        pitch: Option<Angle>,
        /// Yaw; 0 if absent.
        yaw: Option<Angle>,
        /// Radius of its edges and corners; 0 if absent.
        rounding: Option<Length<NOT_NEGATIVE>>,
    }
    /// A plate: a surface with `points`, or `edge` and `half_width`, and a thickness behind its open side.
    Plate(PlateSection, "x-exactly-one" = [["points", "edge"]], "x-together" = [["edge", "half_width"]]) {
        /// Corners [x, y, z] in order round the front, a convex plane polygon.
        points: Option<Vec<[Length; 3]>>,
        /// Two points [x, z] of a rectangular front seen from the side.
        edge: Option<[[Length; 2]; 2]>,
        /// Half the rectangle's width.
        half_width: Option<Length<POSITIVE>>,
        /// Lateral position of the rectangle's centre; 0 if absent.
        y: Option<Length>,
        /// Thickness behind the front.
        thickness: Length<POSITIVE>,
        /// Radius of its edges and corners; 0 if absent.
        rounding: Option<Length<NOT_NEGATIVE>>,
        /// A point on the open side, in the solid's frame; the scenario's `inside` if absent.
        inside: Option<[Length; 3]>,
        /// "order": the order of the corners gives the open side, instead of a point.
        facing: Option<FacingChoice>,
    }
    /// A round plate, such as the hub of a steering wheel.
    Disc(DiscSolidSection, "x-exactly-one" = [["tilt", "axis"]]) {
        /// Its centre.
        centre: [Length; 3],
        /// Angle of its plane from the vertical, upper edge forward, as for a steering wheel.
        tilt: Option<Angle>,
        /// Direction of its axis; any length.
        axis: Option<[Ratio; 3]>,
        /// Radius.
        radius: Length<POSITIVE>,
        /// Length along the axis.
        thickness: Length<POSITIVE>,
        /// Radius of its edges; 0 if absent.
        rounding: Option<Length<NOT_NEGATIVE>>,
    }
    /// A round bar with round ends: a steering column, a pillar, a grab rail.
    Capsule(CapsuleSection) {
        /// Ends of its axis.
        ends: [[Length; 3]; 2],
        /// Radius.
        radius: Length<POSITIVE>,
    }
    /// The rim of a steering wheel. A sphere can pass through it: add a hub.
    Rim(RimSection, "x-exactly-one" = [["tilt", "axis"]]) {
        /// Its centre.
        centre: [Length; 3],
        /// Angle of its plane from the vertical, upper edge forward.
        tilt: Option<Angle>,
        /// Direction of its axis; any length.
        axis: Option<[Ratio; 3]>,
        /// Radius of the ring, to the middle of the tube.
        radius: Length<POSITIVE>,
        /// Radius of the tube.
        tube_radius: Length<POSITIVE>,
    }
    /// Everything behind a plane: the ground, a wall.
    HalfSpace(HalfSpaceSection) {
        /// A point on the plane.
        point: [Length; 3],
        /// Its normal, out of the solid; any length.
        normal: [Ratio; 3],
    }
}

/// All solids, in the order written.
pub(super) fn solids(b: &mut Builder, scenario: &Scenario, body: &Body) -> Vec<Solid> {
    let mut undecided = Vec::new();
    let mut solids = Vec::with_capacity(scenario.solids.len());
    for (name, section) in &scenario.solids {
        let common = section.common();
        let frame = b.frame(scenario, &format!("{}.frame", with_key("solids", name)), common.frame);
        let shape = match section {
            SolidSection::Plate(s) => plate(b, scenario, body, (name, s), &mut undecided),
            _ => shape(section, frame),
        };
        let Some(shape) = shape else { continue };
        let spheres = format!("{}.spheres", with_key("solids", name));
        solids.push(Solid {
            name: name.to_owned(),
            frame,
            shape,
            material: index_of(common.material, scenario.materials.keys().map(String::as_str)),
            group: common.group.clone(),
            spheres: common.spheres.as_ref().map(|names| b.spheres(&spheres, names, body)),
        });
    }
    report_undecided(b, &undecided);
    solids
}

/// The shape of all but a plate.
fn shape(section: &SolidSection, frame: Frame) -> Option<Shape> {
    let axis = |tilt: &Option<Angle>, axis: &Option<[Ratio; 3]>| match (tilt, axis) {
        (Some(tilt), _) => wheel_axis(frame, tilt.si()),
        (None, axis) => axis.as_ref().map_or(Vector3::zeros(), |axis| Vector3::from(all_si(axis))),
    };
    Some(match section {
        SolidSection::Prism(s) => {
            let y = si_or(&s.y, 0.0);
            let beside = s.profile.iter().flatten().map(|p| Point3::new(p[0].si(), y, p[1].si()));
            let corners_m = s.points.iter().flatten().map(point).chain(beside).collect();
            Shape::Prism { corners_m, half_width_m: s.half_width.si(), rounding_m: si_or(&s.rounding, 0.0) }
        }
        SolidSection::Box(s) => {
            let pose = pose(&Some(s.centre.clone()), [&s.roll, &s.pitch, &s.yaw]);
            let (centre_m, axes) = (Point3::from(pose.position_m), pose.attitude.matrix());
            Shape::block(centre_m, Vector3::from(all_si(&s.lengths)), &axes, si_or(&s.rounding, 0.0))
        }
        SolidSection::Plate(_) => return None,
        SolidSection::Disc(s) => Shape::Disc {
            centre_m: point(&s.centre),
            axis: axis(&s.tilt, &s.axis),
            radius_m: s.radius.si(),
            thickness_m: s.thickness.si(),
            rounding_m: si_or(&s.rounding, 0.0),
        },
        SolidSection::Capsule(s) => Shape::Capsule { ends_m: s.ends.each_ref().map(point), radius_m: s.radius.si() },
        SolidSection::Rim(s) => Shape::Rim {
            centre_m: point(&s.centre),
            axis: axis(&s.tilt, &s.axis),
            ring_radius_m: s.radius.si(),
            tube_radius_m: s.tube_radius.si(),
        },
        SolidSection::HalfSpace(s) => {
            Shape::HalfSpace { point_m: point(&s.point), normal: Vector3::from(all_si(&s.normal)) }
        }
    })
}

fn plate(
    b: &mut Builder,
    scenario: &Scenario,
    body: &Body,
    (name, s): (&str, &PlateSection),
    undecided: &mut Vec<String>,
) -> Option<Shape> {
    let path = with_key("solids", name);
    let front = surface(b, scenario, body, (&path, name, &front(s)), undecided);
    let mut problems = Problems::new();
    let front = FlatFace::new(&front, &path, &mut problems);
    problems.iter().for_each(|problem| b.report(problem.clone()));
    Shape::plate(&front?, s.thickness.si(), si_or(&s.rounding, 0.0))
}

/// The front of a plate as a surface.
fn front(s: &PlateSection) -> SurfaceSection {
    SurfaceSection {
        material: s.material.clone(),
        frame: s.frame.clone(),
        meets: None,
        points: s.points.clone(),
        edge: s.edge.clone(),
        half_width: s.half_width.clone(),
        end_half_width: None,
        y: s.y.clone(),
        disc: None,
        plane: None,
        inside: s.inside.clone(),
        facing: s.facing,
        spheres: None,
        behind: None,
    }
}
