//! Readings of a dummy's instruments at an evaluation: at every accepted step, in lanes and alone.

use crate::body::tree::{BodyRow, JointRow};
use crate::body::{Body, Limb, Segment};
use crate::forces::sphere::{Riding, Use};
use crate::kernel::carried::Carried;
use crate::kernel::{Scratch, System};
use crate::motion::frame::Frames;
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::{Layout, MOST_SLIDES};
use crate::motion::scalar::Scalar;
use crate::motion::vector::{V3, v3};
use nalgebra::Vector3;

/// Count of numbers in a reading.
pub(crate) const READINGS: usize = TIBIAE + TIBIA_SIGNALS;
/// Index of the neck's force in a reading, followed by its moment.
pub(crate) const NECK: usize = 15;
/// Index of the femurs, right and left.
pub(crate) const FEMURS: usize = 21;
/// Index of the head's position.
pub(crate) const PLACE: usize = 23;
/// Index of the chest deflections: of the sternum, then of the points of [`POINTS`].
pub(crate) const CHEST: usize = 26;
/// Index of the values for rear impact: acceleration of T1 forward, speed forward of the head and position forward of
/// the pelvis, in axes of the body's home frame.
pub(crate) const REAR: usize = CHEST + CHEST_POINTS;
/// Index of the values for side impact: deflection of the ribs of the side that is pressed in more, m; force of the
/// abdomen from the side, N; reading of an accelerometer at T12; force of the side of the pelvis that is loaded more, N, and
/// the pubic symphysis' share of it.
pub(crate) const SIDE: usize = REAR + 3;
/// Count of those values.
pub(crate) const SIDE_SIGNALS: usize = 7;
/// Index of the loads of the lower legs: moments about X and Y and force along Z at the upper and the lower site of the right leg,
/// then of the left one.
pub(crate) const TIBIAE: usize = SIDE + SIDE_SIGNALS;
/// Count of those loads.
pub(crate) const TIBIA_SIGNALS: usize = 4 * TIBIA_LOADS;
/// Count of those at a site.
const TIBIA_LOADS: usize = 3;
/// Distance of a site from the joint next to it, as a share of the way from knee to ankle: our choice, because load cells of
/// dummies have places of their own.
const TIBIA_SHARE: f64 = 0.25;
/// Number of chest points.
pub(crate) const CHEST_POINTS: usize = 1 + POINTS.len();
/// Points of a chest besides the sternum, by their names in bodies.
const POINTS: [&str; 4] = ["upper_left", "upper_right", "lower_left", "lower_right"];

/// What the instruments of one body read at one instant, SI. In SAE J211 axes of the segments: what accelerometers of head,
/// chest and pelvis read, angular velocity and acceleration of the head, force and moment of the neck on the head at the
/// condyles; tension of the right and the left femur; then the centre of the head's sphere in axes of the body's home, and the
/// deflections of a chest, m; then the values for rear and side impact; then the loads of the lower legs. NaN for what a body
/// lacks.
pub(crate) type Reading<S> = [S; READINGS];

/// Instruments of a body.
#[derive(Clone, Debug)]
pub(crate) struct Instruments<S> {
    /// Segments with the accelerometers of head, chest and pelvis.
    accelerometers: [Option<usize>; 3],
    neck: Option<Neck<S>>,
    /// Segment above the chest, towards the head, whose joint is T1, if any.
    above_t1: Option<usize>,
    /// Whether the values for rear impact are read.
    is_rear: bool,
    /// Right and left leg.
    legs: [Option<Leg>; 2],
    /// Sphere of the head.
    head: Option<usize>,
    /// Home frame of the body.
    home: usize,
    /// How the points of its chest move with plates.
    chest: [Option<Riding<S>>; CHEST_POINTS],
    sides: Option<SideSites<S>>,
}

/// Instruments of a trunk whose sides yield.
#[derive(Clone, Copy, Debug)]
struct SideSites<S> {
    /// Plates of the ribs, left and right.
    ribs: [usize; 2],
    /// Plate of the abdomen, if there is one.
    abdomen: Option<usize>,
    /// Plates of the pelvis, left and right, if it yields, and the share of the pubic symphysis, 0 in a person.
    pelvis: Option<[usize; 2]>,
    pubic_share: S,
    /// Segment of the chest, and the place of T12 on it: its lower end, from its joint.
    chest: usize,
    t12: V3<S>,
}

#[derive(Clone, Debug)]
struct Neck<S> {
    from: Beyond,
    /// Segment in whose axes the load is given.
    head: usize,
    condyles: V3<S>,
}

#[derive(Clone, Debug, PartialEq)]
struct Leg {
    thigh: usize,
    /// Index among the knees of all bodies.
    knee: usize,
    shanks: Vec<Beyond>,
    tibia: Option<Tibia>,
}

/// A lower leg with a foot of its own.
#[derive(Clone, Debug, PartialEq)]
struct Tibia {
    shank: usize,
    knee: Beyond,
    ankle: Beyond,
}

/// A joint and all that is distal to it.
#[derive(Clone, Debug, PartialEq)]
struct Beyond {
    segment: usize,
    /// The segment and all distal to it.
    subtree: Vec<usize>,
    /// Whether the distal segment of the joint carries the proximal one.
    is_reversed: bool,
}

impl Instruments<f64> {
    /// Fits `system`, of these bodies, with their instruments: `sites` gives by body its home frame and the position of
    /// its condyles, `is_rear` whether values for rear impact are read.
    pub(crate) fn fit(system: &mut System<f64>, body: &Body, sites: &[(usize, Option<Vector3<f64>>)], is_rear: bool) {
        let (rows, layout) = (body.tree.bodies(), &system.skeleton.layout);
        let all = rows.iter().enumerate().zip(sites);
        let fitted =
            all.map(|((of, row), site)| Instruments { is_rear, ..Instruments::of(body, layout, of, row, *site) });
        system.instruments = fitted.collect();
        let legs = system.instruments.iter().flat_map(|own| own.legs.iter().flatten());
        for Leg { thigh, knee, .. } in legs {
            let half_m = 0.5 * body.segment(body.tree.segment(*thigh)).length_m;
            for (site, sphere) in system.spheres.iter_mut().zip(&body.spheres) {
                if site.segment == *thigh && sphere.centre_from_lower_end_m.z < half_m {
                    site.knee = Some(*knee);
                }
            }
        }
    }

    fn of(
        body: &Body,
        layout: &Layout,
        of: usize,
        row: &BodyRow,
        (home, condyles_m): (usize, Option<Vector3<f64>>),
    ) -> Self {
        let (tree, marks) = (body.tree, &row.landmarks);
        let beyond = |row: &JointRow| {
            let segment = row.carrying()[1].index();
            Beyond { segment, subtree: layout.subtree(segment).collect(), is_reversed: row.is_reversed() }
        };
        let neck = marks.neck.map(|joint| Neck {
            from: beyond(&tree[joint]),
            head: tree[joint].distal.index(),
            condyles: condyles_m.map_or(V3::zero(), |place| V3::of(&place)),
        });
        let all = marks.instruments().map(|segment| segment.map(Segment::index));
        let carried = |n: &usize| layout.parent(*n);
        let above_t1 = std::iter::successors(all[0], carried).find(|n| all[1].is_some() && layout.parent(*n) == all[1]);
        let joints = || tree.joints().map(|joint| &tree[joint]);
        let between = |proximal, distal| joints().find(|row| row.proximal == proximal && row.distal == distal);
        let leg = |(side, limb): (usize, Option<Limb>)| {
            let Limb { upper: thigh, lower, end } = limb?;
            let knees = joints().filter(|row| row.proximal == thigh);
            let ends = between(thigh, lower).zip(end.and_then(|foot| between(lower, foot)));
            let tibia =
                ends.map(|(knee, ankle)| Tibia { shank: lower.index(), knee: beyond(knee), ankle: beyond(ankle) });
            Some(Leg { thigh: thigh.index(), knee: 2 * of + side, shanks: knees.map(beyond).collect(), tibia })
        };
        let chest = body.chests.iter().find(|chest| chest.of == row.name);
        let shares = |point: &str| Some(&chest?.points.iter().find(|(name, _)| name == point)?.1);
        let breastbone = chest.map(|chest| Riding::new(&vec![(chest.breastbone, 1.0)]));
        let points = POINTS.map(|point| shares(point).map(Riding::new));
        let head = if row.name.is_empty() { "head".to_owned() } else { format!("{}.head", row.name) };
        let [right, left] = [(0, marks.legs.right), (1, marks.legs.left)].map(leg);
        let sides = body.sides.iter().find(|sides| sides.of == row.name).zip(marks.instruments()[1]);
        Instruments {
            accelerometers: all,
            neck,
            above_t1,
            is_rear: false,
            legs: [right, left],
            head: body.sphere(&head),
            home,
            chest: std::array::from_fn(|i| if i == 0 { breastbone } else { points[i - 1] }),
            sides: sides.map(|(own, chest)| SideSites {
                ribs: own.ribs,
                abdomen: own.abdomen,
                pelvis: own.pelvis,
                pubic_share: own.pubic_share.unwrap_or(0.0),
                chest: chest.index(),
                t12: -V3::of(&body.joint_m(chest)),
            }),
        }
    }
}

impl<S: Copy> Instruments<S> {
    /// Whether another is at the same places.
    pub(crate) fn is_like<A: Copy>(&self, other: &Instruments<A>) -> bool {
        let neck = self.neck.as_ref().map(|neck| (&neck.from, neck.head));
        self.accelerometers == other.accelerometers
            && neck == other.neck.as_ref().map(|neck| (&neck.from, neck.head))
            && (&self.legs, self.head, self.home, self.above_t1, self.is_rear)
                == (&other.legs, other.head, other.home, other.above_t1, other.is_rear)
            && self.sides.map(|own| own.places()) == other.sides.map(|own| own.places())
            && self.chest.iter().zip(&other.chest).all(|pair| match pair {
                (Some(a), Some(b)) => a.is_like(b),
                (a, b) => a.is_none() && b.is_none(),
            })
    }

    /// f applied to every number and the one in the same place of `other`, which [is like](Instruments::is_like) it.
    pub(crate) fn zip<A: Copy, T>(&self, other: &Instruments<A>, f: &impl Fn(S, A) -> T) -> Instruments<T> {
        let neck = |(a, b): (&Neck<S>, &Neck<A>)| Neck {
            from: a.from.clone(),
            head: a.head,
            condyles: a.condyles.zip(&b.condyles, f),
        };
        Instruments {
            accelerometers: self.accelerometers,
            neck: self.neck.as_ref().zip(other.neck.as_ref()).map(neck),
            above_t1: self.above_t1,
            is_rear: self.is_rear,
            legs: self.legs.clone(),
            head: self.head,
            home: self.home,
            chest: std::array::from_fn(|i| self.chest[i].zip(other.chest[i]).map(|(a, b)| a.zip(&b, f))),
            sides: self.sides.zip(other.sides).map(|(a, b)| {
                let SideSites { ribs, abdomen, pelvis, pubic_share, chest, t12 } = a;
                let (pubic_share, t12) = (f(pubic_share, b.pubic_share), t12.zip(&b.t12, f));
                SideSites { ribs, abdomen, pelvis, pubic_share, chest, t12 }
            }),
        }
    }
}

impl<S: Copy> SideSites<S> {
    /// Its plates and its segment.
    fn places(&self) -> ([usize; 2], Option<usize>, Option<[usize; 2]>, usize) {
        (self.ribs, self.abdomen, self.pelvis, self.chest)
    }
}

impl Beyond {
    /// Force and moment of the proximal segment on the distal one, space axes.
    #[inline(always)]
    fn load<S: Scalar>(&self, from: &Carried<'_, S>) -> (V3<S>, V3<S>) {
        let load = from.at(self.segment, self.subtree.iter().copied());
        if self.is_reversed { (-load.force, -load.moment) } else { (load.force, load.moment) }
    }
}

impl<S: Scalar> Instruments<S> {
    /// Centre of the head's sphere in axes of the body's home frame.
    #[inline(always)]
    pub(crate) fn head_in(&self, system: &System<S>, k: &Kinematics<S>, frames: &Frames<S>) -> Option<V3<S>> {
        let (_, centre, _) = system.spheres[self.head?].place(k, Use::Contact);
        let home = &frames[self.home];
        Some(home.axes.into_frame(centre - home.origin))
    }

    #[inline(always)]
    fn read(&self, system: &System<S>, from: &Carried<'_, S>, frames: &Frames<S>) -> Reading<S> {
        let k = from.k;
        let mut reading = [S::of(f64::NAN); READINGS];
        for (i, segment) in self.accelerometers.iter().enumerate() {
            if let Some(n) = segment {
                put(&mut reading, 3 * i, told(k, *n, from.specific_force(*n)));
            }
        }
        if let [Some(n), ..] = self.accelerometers {
            put(&mut reading, 9, told(k, n, k.omega[n]));
            put(&mut reading, 12, told(k, n, from.accelerations.alpha[n]));
        }
        if let Some(Neck { from: joint, head, condyles }) = &self.neck {
            let (force, moment) = joint.load(from);
            put(&mut reading, NECK, told(k, *head, force));
            put(&mut reading, NECK + 3, told(k, *head, moment - k.axes[*head].out(*condyles).cross(force)));
        }
        if let Some(place) = self.head_in(system, k, frames) {
            put(&mut reading, PLACE, place);
        }
        for (i, point) in self.chest.iter().enumerate() {
            let Some(point) = point else { continue };
            let sum = point.plates().fold(S::zero(), |sum, (plate, share)| sum + share * k.slides[plate].way);
            reading[CHEST + i] = sum;
        }
        if self.is_rear {
            self.read_rear(system, from, frames, &mut reading);
        }
        if let Some(sides) = &self.sides {
            sides.read(system, from, &mut reading);
        }
        for (i, leg) in self.legs.iter().enumerate() {
            let Some(Leg { thigh, knee, shanks, tibia }) = leg else { continue };
            let mut along = from.knees[*knee];
            for shank in shanks {
                along -= shank.load(from).0;
            }
            // Z of a thigh points from the knee to the hip: a force at the knee against it pulls
            reading[FEMURS + i] = -along.dot(k.axes[*thigh].z);
            if let Some(tibia) = tibia {
                let loads = tibia.loads(from);
                for (site, [force, moment]) in loads.iter().enumerate() {
                    let at = TIBIAE + TIBIA_LOADS * (2 * i + site);
                    [reading[at], reading[at + 1], reading[at + 2]] = [moment.x, moment.y, force.z];
                }
            }
        }
        reading
    }
}

impl Tibia {
    /// Force and moment at the upper and the lower site: what the leg below it exerts on the leg above it, in SAE J211 axes of
    /// the shank.
    #[inline(always)]
    fn loads<S: Scalar>(&self, from: &Carried<'_, S>) -> [[V3<S>; 2]; 2] {
        let k = from.k;
        let [knee, ankle] = [k.joint[self.knee.segment], k.joint[self.ankle.segment]];
        let down = (ankle - knee) * S::of(TIBIA_SHARE);
        [self.site(from, (&self.knee, knee, down), 1.0), self.site(from, (&self.ankle, ankle, -down), -1.0)]
    }

    /// The same at the site at the end of `way` from a joint at `end`.
    #[inline(always)]
    fn site<S: Scalar>(
        &self,
        from: &Carried<'_, S>,
        (joint, end, way): (&Beyond, V3<S>, V3<S>),
        sign: f64,
    ) -> [V3<S>; 2] {
        let (k, skeleton) = (from.k, from.skeleton);
        let (force, moment) = joint.load(from);
        // the piece of the shank between joint and site, with its share of a mass spread evenly along it
        let middle = way * S::of(0.5);
        let up = v3(S::zero(), S::zero(), skeleton.gravity);
        let felt = from.accelerations.at(k, self.shank, end + middle - k.joint[self.shank]) + up;
        let own = felt * (skeleton.links[self.shank].mass * S::of(sign * TIBIA_SHARE));
        let turning = way.cross(force) - moment - middle.cross(own);
        [told(k, self.shank, own - force), told(k, self.shank, turning)]
    }
}

impl Instruments<f64> {
    /// Force and moment at the upper and the lower site of the right (0) or left (1) leg; none without a foot of its own.
    pub(crate) fn tibia(&self, leg: usize, from: &Carried<'_, f64>) -> Option<[[V3<f64>; 2]; 2]> {
        Some(self.legs[leg].as_ref()?.tibia.as_ref()?.loads(from))
    }
}

impl<S: Scalar> Instruments<S> {
    /// Values for rear impact.
    #[inline(always)]
    fn read_rear(&self, system: &System<S>, from: &Carried<'_, S>, frames: &Frames<S>, reading: &mut Reading<S>) {
        let (k, home, skeleton) = (from.k, &frames[self.home], &system.skeleton);
        let [head, chest, pelvis] = self.accelerometers;
        if let (Some(chest), Some(above)) = (chest, self.above_t1) {
            let gravity = v3(S::zero(), S::zero(), skeleton.gravity);
            let felt = from.accelerations.at(k, chest, k.joint[above] - k.joint[chest]) + gravity;
            reading[REAR] = felt.dot(k.axes[chest].x);
        }
        if let Some(head) = head {
            let place = k.cg(skeleton, head);
            reading[REAR + 1] = (k.cg_velocity(skeleton, head) - home.velocity_at(place)).dot(home.axes.x);
        }
        if let Some(pelvis) = pelvis {
            reading[REAR + 2] = (k.cg(skeleton, pelvis) - home.origin).dot(home.axes.x);
        }
    }
}

impl<S: Scalar> SideSites<S> {
    /// Values for side impact.
    #[inline(always)]
    fn read(&self, system: &System<S>, from: &Carried<'_, S>, reading: &mut Reading<S>) {
        let k = from.k;
        let [left, right] = self.ribs;
        reading[SIDE] = k.slides[left % MOST_SLIDES].way.max(k.slides[right % MOST_SLIDES].way);
        if let Some(plate) = self.abdomen {
            reading[SIDE + 1] = from.resist[plate % MOST_SLIDES].abs();
        }
        let gravity = v3(S::zero(), S::zero(), system.skeleton.gravity);
        let felt = from.accelerations.at(k, self.chest, k.axes[self.chest].out(self.t12)) + gravity;
        put(reading, SIDE + 2, told(k, self.chest, felt));
        if let Some(pelvis) = self.pelvis {
            let [left, right] = pelvis;
            reading[SIDE + 5] = from.resist[left % MOST_SLIDES].abs().max(from.resist[right % MOST_SLIDES].abs());
            reading[SIDE + 6] = self.pubic_share * reading[SIDE + 5];
        }
    }
}

/// Writes a vector into a reading.
#[inline(always)]
fn put<S: Scalar>(reading: &mut Reading<S>, at: usize, v: V3<S>) {
    [reading[at], reading[at + 1], reading[at + 2]] = [v.x, v.y, v.z];
}

/// From space axes to SAE J211 axes of a segment (Y right, Z down), whose own axes are left and up.
#[inline(always)]
fn told<S: Scalar>(k: &Kinematics<S>, n: usize, v: V3<S>) -> V3<S> {
    let v = k.axes[n].into_frame(v);
    v3(v.x, -v.y, -v.z)
}

impl<S: Scalar> System<S> {
    /// Shows the readings of every body at the latest evaluation, in `frames`.
    #[inline(always)]
    pub(crate) fn read(&self, scratch: &Scratch<S>, frames: &Frames<S>, show: &mut impl FnMut(usize, &Reading<S>)) {
        self.read_from(&Carried::of(&self.skeleton, scratch), frames, show);
    }

    #[inline(always)]
    pub(crate) fn read_from(
        &self,
        from: &Carried<'_, S>,
        frames: &Frames<S>,
        show: &mut impl FnMut(usize, &Reading<S>),
    ) {
        for (of, instruments) in self.instruments.iter().enumerate() {
            show(of, &instruments.read(self, from, frames));
        }
    }
}
