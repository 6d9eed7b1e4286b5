//! Cameras by name, and those of a user.

use nalgebra::{Point3, Vector3};
use occupant_core::model::Model;

use super::Shown;
use super::lens::Lens;
use super::stage::{frame_pose, in_space};
use crate::body::{Snapshot, sphere_centre_m};

/// Angle of the picture's height: of all cameras, and of an occupant's eye, rad.
const HEIGHT_RAD: f64 = 0.56;
const EYE_RAD: f64 = 1.25;
/// Share of the picture that what must be seen may take.
const WITHIN: f64 = 0.76;
/// Distance from the place of the first moment beyond which a camera in the car lets people go, m.
const LET_GO_M: f64 = 1.6;
/// Chase: behind, beside and above, m.
const CHASE_M: [f64; 3] = [6.0, 2.2, 2.0];
/// Most moments looked at for a camera that must see all.
const MOMENTS: usize = 60;

/// Where a picture is taken from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Camera {
    /// Fixed in space, far enough to see the whole path.
    Ground,
    /// Rides with the vehicle, from its front right.
    #[default]
    Vehicle,
    /// Behind and above the first occupant, level.
    Chase,
    /// The eye of the first occupant, looking forward.
    Driver,
    /// A place and a target of the user.
    Own(Lens, Carrier),
}

/// The axes of a user's camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carrier {
    /// Vehicle: X forward, Y right, Z down.
    Vehicle,
    /// Space: X forward, Y left, Z up.
    Space,
}

/// A camera fitted to the runs that it looks at.
#[derive(Clone, Copy, Debug)]
pub struct Fitted {
    pub(super) camera: Camera,
    /// Of cameras that stand in vehicle or space axes.
    fixed: Lens,
}

impl Camera {
    /// Name for the caption.
    pub const fn name(&self) -> &'static str {
        match self {
            Camera::Ground => "camera fixed to the ground",
            Camera::Vehicle => "camera fixed to the vehicle",
            Camera::Chase => "camera behind the occupant",
            Camera::Driver => "seen by the occupant",
            Camera::Own(..) => "camera from a file",
        }
    }

    /// Whether it rides with the vehicle: other runs are then compared in axes of their own vehicles.
    pub const fn rides(&self) -> bool {
        matches!(self, Camera::Vehicle | Camera::Driver | Camera::Own(_, Carrier::Vehicle))
    }

    /// The camera for pictures so many times as wide as high that show all of some runs.
    ///
    /// # Errors
    /// A user's camera that looks nowhere.
    pub fn fitted(self, runs: &[&Shown<'_>], aspect: f64) -> Result<Fitted, String> {
        let fixed = match self {
            Camera::Own(lens, _) if lens.looks() => lens,
            Camera::Own(..) => {
                let expected = "eye and target must be finite and apart, and the field of view 1 to 170 degrees";
                return Err(format!("the camera looks nowhere: {expected}"));
            }
            Camera::Ground => ground(runs, aspect),
            _ => riding(runs, aspect),
        };
        Ok(Fitted { camera: self, fixed })
    }
}

/// Segment of the first head.
fn head(model: &Model) -> Option<usize> {
    let tree = &model.body().tree;
    tree.segments().find(|s| tree.landmarks_at(*s).head == Some(*s)).map(|segment| segment.index())
}

impl Fitted {
    /// The segment that is not drawn: the head of whose eye is looked through.
    pub(super) fn hidden(&self, model: &Model) -> Option<usize> {
        if self.camera == Camera::Driver { head(model) } else { None }
    }

    /// The lens at a moment, space axes.
    pub(super) fn lens(&self, model: &Model, moment: &Snapshot) -> Lens {
        let carried = |lens: &Lens| Lens {
            eye_m: in_space(moment, &lens.eye_m),
            target_m: in_space(moment, &lens.target_m),
            up: moment.vehicle.vector_to_space(lens.up),
            ..*lens
        };
        match self.camera {
            Camera::Ground | Camera::Own(_, Carrier::Space) => self.fixed,
            Camera::Vehicle | Camera::Own(_, Carrier::Vehicle) => carried(&self.fixed),
            Camera::Chase => chase(moment),
            Camera::Driver => eye(model, moment).unwrap_or_else(|| carried(&self.fixed)),
        }
    }
}

fn eye(model: &Model, moment: &Snapshot) -> Option<Lens> {
    let (body, head) = (model.body(), head(model)?);
    let pose = frame_pose(moment) * moment.poses[head];
    let skull = body.spheres.iter().find(|sphere| sphere.segment.index() == head);
    let middle = skull.map_or_else(Vector3::zeros, |sphere| sphere_centre_m(body, sphere));
    let reach = skull.map_or(0.09, |sphere| 0.9 * sphere.radius_m);
    let eye_m = pose * Point3::from(middle + Vector3::x() * reach);
    // a little downward, as drivers look at the road
    let target_m = eye_m + pose * Vector3::new(1.0, 0.0, -0.12);
    Some(Lens { eye_m, target_m, up: pose * Vector3::z(), height_rad: EYE_RAD })
}

/// Level, behind the first occupant in the direction in which the vehicle points.
fn chase(moment: &Snapshot) -> Lens {
    let target_m = in_space(moment, &first_middle(moment));
    let ahead = heading(moment);
    let right = ahead.cross(&Vector3::z());
    let [behind, beside, above] = CHASE_M;
    let eye_m = target_m - ahead * behind + right * beside + Vector3::z() * above;
    Lens { eye_m, target_m: target_m + ahead * 0.5, up: Vector3::z(), height_rad: HEIGHT_RAD }
}

/// The vehicle's direction on the ground.
fn heading(moment: &Snapshot) -> Vector3<f64> {
    let ahead = moment.vehicle.vector_to_space(Vector3::x());
    Vector3::new(ahead.x, ahead.y, 0.0).try_normalize(0.2).unwrap_or_else(Vector3::x)
}

/// Middle of the spheres, or of the segments, vehicle axes.
pub(super) fn middle(moment: &Snapshot) -> Point3<f64> {
    let of_poses = || moment.poses.iter().map(|pose| Point3::from(pose.translation.vector)).collect::<Vec<_>>();
    let points = if moment.spheres_m.is_empty() { of_poses() } else { moment.spheres_m.clone() };
    let sum: Vector3<f64> = points.iter().map(|p| p.coords).sum();
    Point3::from(sum / points.len().max(1) as f64)
}

/// Spheres of the bodies, with their radii, vehicle axes.
fn spheres<'m>(model: &'m Model, moment: &'m Snapshot) -> impl Iterator<Item = (Point3<f64>, f64)> + 'm {
    model.body().spheres.iter().zip(&moment.spheres_m).map(|(sphere, at)| (*at, sphere.radius_m))
}

fn riding(runs: &[&Shown<'_>], aspect: f64) -> Lens {
    let first_of = |run: &Shown<'_>| run.moments.first().map_or_else(Point3::origin, first_middle);
    let near = runs.iter().flat_map(|run| {
        let first = first_of(run);
        let all = some(run.moments).flat_map(|moment| spheres(run.model, moment));
        all.filter(move |(at, _)| (at - first).norm() < LET_GO_M)
    });
    let middle = runs.first().map_or_else(Point3::origin, |run| first_of(run));
    fit(&near.collect::<Vec<_>>(), middle, Vector3::new(1.0, 1.05, -0.42), -Vector3::z(), aspect)
}

/// Moments that a camera is fitted to.
fn some(moments: &[Snapshot]) -> impl Iterator<Item = &Snapshot> {
    moments.iter().step_by(moments.len().div_ceil(MOMENTS).max(1))
}

/// Of the first body alone: a second vehicle's people are far away.
fn first_middle(moment: &Snapshot) -> Point3<f64> {
    let first = moment.spheres_m.first().copied().unwrap_or_else(|| middle(moment));
    let near: Vec<_> = moment.spheres_m.iter().filter(|at| (*at - first).norm() < LET_GO_M).collect();
    let sum: Vector3<f64> = near.iter().map(|p| p.coords).sum();
    if near.is_empty() { first } else { Point3::from(sum / near.len() as f64) }
}

fn ground(runs: &[&Shown<'_>], aspect: f64) -> Lens {
    let mut points = Vec::new();
    for (model, moment) in runs.iter().flat_map(|run| some(run.moments).map(|moment| (run.model, moment))) {
        points.extend(spheres(model, moment).map(|(at, radius_m)| (in_space(moment, &at), radius_m)));
        for own in model.setup().scenery.iter().filter(|own| own.name.ends_with("outside")) {
            let corners = own.polygons_m.iter().flat_map(|polygon| moment.placed_m(own.frame, polygon));
            points.extend(corners.map(|p| (in_space(moment, &p), 0.0)));
        }
    }
    let first = runs.first().and_then(|run| run.moments.first());
    let ahead = first.map_or_else(Vector3::x, heading);
    let right = ahead.cross(&Vector3::z());
    let middle = first.map_or_else(Point3::origin, |moment| in_space(moment, &middle(moment)));
    fit(&points, middle, right * 1.0 + ahead * 0.35 + Vector3::z() * 0.55, Vector3::z(), aspect)
}

/// A lens in a direction from the middle of points, as near as all of them are in the picture's middle.
fn fit(
    points: &[(Point3<f64>, f64)],
    otherwise: Point3<f64>,
    from: Vector3<f64>,
    up: Vector3<f64>,
    aspect: f64,
) -> Lens {
    let sound: Vec<_> = points.iter().filter(|(at, _)| at.coords.sum().is_finite()).collect();
    let least = |i: usize| sound.iter().map(|(at, r)| at[i] - r).fold(f64::INFINITY, f64::min);
    let most = |i: usize| sound.iter().map(|(at, r)| at[i] + r).fold(f64::NEG_INFINITY, f64::max);
    let middle = |i: usize| 0.5 * (least(i) + most(i));
    let target_m = if sound.is_empty() { otherwise } else { Point3::new(middle(0), middle(1), middle(2)) };
    let back = from.normalize();
    let right = up.cross(&back).normalize();
    let above = back.cross(&right);
    let slope = occupant_units::trig::sin_cos(0.5 * HEIGHT_RAD);
    let slope = WITHIN * slope.0 / slope.1;
    let far = |(at, radius_m): &&(Point3<f64>, f64)| {
        let off = at - target_m;
        // half as wide again as high is enough
        let aside = ((right.dot(&off).abs() + radius_m) / aspect.min(1.5)).max(above.dot(&off).abs() + radius_m);
        aside / slope + back.dot(&off)
    };
    let away = sound.iter().map(far).fold(1.2, f64::max);
    Lens { eye_m: target_m + back * away, target_m, up, height_rad: HEIGHT_RAD }
}
