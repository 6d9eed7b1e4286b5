//! Implausible signs in the outputs of a run, from which caveats are made.

use super::caveat::{Caveat, Turned};
use super::elements::Elements;
use super::peak::Peak;
use super::slide::Slides;
use super::strokes::Strokes;
use crate::body::Body;
use crate::forces::bag::Bag;
use crate::forces::chain::wing::LEAST_N;
use crate::forces::chain::{Chain, OnShoulder, StrapAction};
use crate::forces::contact::{ContactSystem, Group, PASSED, Plane, Touch};
use crate::forces::joint::{JointLaw, Stop};
use crate::model::Model;
use crate::model::seating::InitialPosture;
use crate::motion::frame::MOST_FRAMES;
use crate::motion::vector::V3;
use crate::results::peaks::Peaks;
use crate::results::sample::{Contact, Sample};
use occupant_units::trig;

/// Overlap below which a sphere has only grazed an edge, and distance of spheres below which a limb has not passed
/// between them, m.
const GRAZE_M: f64 = 0.01;

/// Interval between checks of spheres and limbs, s: a passed surface stays passed for longer, and checks delay runs
/// side by side.
const LOOK_S: f64 = 1.99e-3;

/// Angle beyond the end of a stop that still counts as at the stop, rad: 10°.
const AT_STOP_RAD: f64 = 0.175;
/// Penetration of a solid, as a fraction of its thickness, above which it bottoms out.
const BOTTOM: f64 = 0.8;
/// Largest excess beyond an elastic limit, rad: 30°.
const MOST_EXCESS_RAD: f64 = 0.524;
/// Largest deformation of a seat cushion, m. Other objects deform by at most the diameter of the sphere.
const CUSHION_M: f64 = 0.15;

/// Forward part of the force of webbing on a sphere above which it passes behind the sphere.
const AHEAD: f64 = 0.5;

/// Findings so far. Allocates at the start of a run only.
#[derive(Clone, Debug, Default)]
pub(super) struct Signs {
    /// By joint.
    joints: Vec<Turned>,
    /// By movable joint: its index among all, and its stops (of a hinge, upper and lower).
    stops: Vec<(usize, [Option<Stop>; 2])>,
    /// By joint with elastic limits: its index among all, and the largest excess, rad.
    limits: Vec<(usize, f64)>,
    /// By sphere: overlap without force, penetration, and the surfaces.
    passed: Vec<Sunk>,
    deep: Vec<Sunk>,
    /// By sphere: penetration at which a solid bottoms out, and its thickness, m.
    bottomed: Vec<(Sunk, f64)>,
    /// By sphere: penetration of a bar or rim whose axis its centre crossed.
    through: Vec<Sunk>,
    /// By sphere: penetration beyond the last point of a force function, and that point, m.
    beyond: Vec<(Sunk, f64)>,
    /// By strap: strain beyond the last point of its webbing; by belt over several nodes: payout of its limiter beyond
    /// its curve, m.
    stretched: Vec<Peak>,
    run_out: Vec<Peak>,
    /// By strap: time at which it left the wing of the pelvis where it begins, s, and the side (1: left, 2: right).
    slipped: Vec<Option<(f64, f64)>>,
    /// By belt over several nodes: first time off the shoulder under load, beside the neck, and behind a sphere, s.
    shoulders: Vec<[Option<f64>; 3]>,
    /// By bag and by its spheres: time of firing with the sphere in its way, and time at which the sphere compressed it
    /// to its mount, s.
    bags: Vec<Vec<[Option<f64>; 2]>>,
    /// By bag and by its spheres: first contact of the sphere with a part behind the bag, s, and that part.
    behind: Vec<Vec<Option<(f64, usize)>>>,
    strokes: Strokes,
    slides: Slides,
    /// By segment: distance from its spheres at which it passed through a surface.
    cuts: Vec<Sunk>,
    /// By segment of an arm or a leg: its length, m.
    limbs: Vec<Option<f64>>,
    /// By pair: whether it had passed at the start, and whether the sphere's limb passed through it.
    begun: Vec<[bool; 2]>,
    is_begun: bool,
    /// Time of the last check of spheres and limbs, s.
    seen_s: f64,
    /// Centres of all spheres in the frames of contacts, found when they are needed.
    centres: Vec<Centres>,
    /// Surface on which the body was seated.
    cushion: Option<usize>,
}

#[derive(Clone, Copy, Debug)]
struct Sunk {
    most: Peak,
    surface: usize,
}

impl Sunk {
    const NONE: Sunk = Sunk { most: Peak::NONE, surface: 0 };

    fn see(&mut self, length_m: f64, surface: usize, time_s: f64) {
        if self.most.see(length_m, time_s) {
            self.surface = surface;
        }
    }

    /// The same for the first surface, if it is more than a graze.
    fn see_first(&mut self, length_m: f64, surface: usize, time_s: f64) {
        if self.may_see_first(surface) {
            self.see(length_m, surface, time_s);
        }
    }

    fn may_see_first(&self, surface: usize) -> bool {
        self.most.value < GRAZE_M || surface == self.surface
    }
}

/// Whether a loaded strap pushes a sphere ahead, as seen from its segment.
fn passes_behind(sample: &Sample<'_>, chain: &Chain, strap: &StrapAction<f64>) -> bool {
    let frame = sample.frame(chain.frame);
    strap.on_spheres().any(|(sphere, force_n)| {
        let Some(sphere) = sample.model.body().spheres.get(sphere) else { return false };
        let axes = &sample.evaluation.kinematics.axes[sphere.segment.index()];
        let ahead_n = axes.into_frame(V3::of(&(frame.rotation * force_n))).x;
        ahead_n > LEAST_N && ahead_n > AHEAD * force_n.norm()
    })
}

impl Signs {
    pub(super) fn new(model: &Model) -> Self {
        let body = model.body();
        let turned = Turned { beyond: Peak::NONE, angle_rad: 0.0, stop_rad: 0.0, is_elastic: false };
        let spheres = vec![Sunk::NONE; body.spheres.len()];
        Signs {
            joints: vec![turned; body.tree.joints().len()],
            stops: model
                .system()
                .forces
                .joints
                .joints()
                .map(|of| (of.index(), stops(&model.setup().joints[of])))
                .collect(),
            limits: limits(model),
            passed: spheres.clone(),
            bottomed: spheres.iter().map(|none| (*none, 0.0)).collect(),
            through: spheres.clone(),
            beyond: spheres.iter().map(|none| (*none, 0.0)).collect(),
            stretched: vec![Peak::NONE; model.setup().chains.iter().map(|chain| chain.straps.len()).sum()],
            run_out: vec![Peak::NONE; model.setup().chains.len()],
            slipped: vec![None; model.setup().chains.iter().map(|chain| chain.straps.len()).sum()],
            shoulders: vec![[None; 3]; model.setup().chains.len()],
            bags: model.setup().bags.iter().map(|bag| vec![[None; 2]; bag.spheres.len()]).collect(),
            behind: model.setup().bags.iter().map(|bag| vec![None; bag.spheres.len()]).collect(),
            strokes: Strokes::new(model),
            slides: Slides::new(model.setup()),
            deep: spheres,
            cuts: vec![Sunk::NONE; body.tree.segments().len()],
            limbs: body.tree.segments().map(|own| body.tree.is_limb(own).then(|| body.far_m(own))).collect(),
            begun: vec![[false; 2]; model.system().forces.contacts.pairs.len()],
            is_begun: false,
            seen_s: 0.0,
            centres: Centres::all(model),
            cushion: match &model.setup().posture {
                InitialPosture::Seated(seating) => Some(seating.cushion),
                _ => None,
            },
        }
    }

    pub(super) fn see(&mut self, sample: &Sample<'_>) {
        let (model, time_s) = (sample.model, sample.time_s);
        if sample.step_peaks.are_unknown() {
            self.see_joints(sample);
        }
        let contacts = &model.system().forces.contacts;
        for touch in &sample.actions.contacts {
            self.see_depth(sample, touch);
            if let Some(other) = contacts.other_side(touch) {
                self.see_depth(sample, &other);
            }
            self.see_last_point(sample, touch);
        }
        self.see_chains(sample);
        self.see_bags(sample);
        self.strokes.see(sample);
        self.slides.see(sample);
        if !self.is_begun || time_s - self.seen_s >= LOOK_S {
            for group in &model.system().forces.contacts.groups {
                self.see_group(sample, group);
            }
            (self.is_begun, self.seen_s) = (true, time_s);
        }
    }

    /// Joints of a run whose steps were not recorded.
    fn see_joints(&mut self, sample: &Sample<'_>) {
        let (model, time_s) = (sample.model, sample.time_s);
        for (turned, joint) in self.joints.iter_mut().zip(model.body().tree.joints()) {
            turned.see(&model.setup().joints[joint], sample.joint_angle_rad(joint), time_s);
        }
        for (limited, (_, most_rad)) in sample.actions.limits.iter().zip(&self.limits) {
            self.joints[limited.joint.index()].see_limit(limited.excess, *most_rad, time_s);
        }
    }

    /// The same with the largest values of steps, which elements track.
    pub(super) fn with_steps(&self, elements: &Elements, all: &Peaks, body: &Body) -> Self {
        let (mut signs, peaks) = (self.clone(), &all.elements);
        for (part, own) in body.parts().zip(&all.parts) {
            let sphere = body.spheres.iter().position(|sphere| sphere.part == part).unwrap_or(0);
            signs.through[sphere] = Sunk { most: own.through, surface: own.bar };
        }
        for ((joint, stops), own) in self.stops.iter().zip(elements.of("joint dampers", peaks)) {
            for (stop, beyond) in stops.iter().zip(own) {
                signs.joints[*joint].see_stop(stop.as_ref(), *beyond);
            }
        }
        for ((joint, most_rad), own) in self.limits.iter().zip(elements.of("joints", peaks)) {
            signs.joints[*joint].see_limit(own[0].value, *most_rad, own[0].time_s);
        }
        signs.strokes.see_steps(elements.of("columns", peaks).chain(elements.of("hinges", peaks)));
        signs.strokes.see_plates(elements.of("plates", peaks));
        signs
    }

    /// Checks how deep a sphere is in a surface or a solid.
    fn see_depth(&mut self, sample: &Sample<'_>, touch: &Touch<f64>) {
        let surface = sample.model.system().forces.contacts.surface(touch.pair, touch.part as usize);
        if surface < sample.model.faces().len() {
            self.deep[touch.sphere].see(touch.depth, surface, sample.time_s);
        } else {
            self.see_solid(sample, touch, surface);
        }
    }

    /// Checks a sphere in a solid.
    fn see_solid(&mut self, sample: &Sample<'_>, touch: &Touch<f64>, surface: usize) {
        let contacts = &sample.model.system().forces.contacts;
        let thickness_m = contacts.thickness_m(touch, &sample.history.memory.contacts);
        let radius_m = sample.model.body().spheres[touch.sphere].radius_m;
        let most_m = if thickness_m > radius_m { BOTTOM * thickness_m } else { radius_m + thickness_m };
        let (bottomed, of_m) = &mut self.bottomed[touch.sphere];
        if touch.depth > most_m && bottomed.most.see(touch.depth, sample.time_s) {
            (bottomed.surface, *of_m) = (surface, thickness_m);
        }
    }

    /// Checks a sphere against the last point of its force function.
    fn see_last_point(&mut self, sample: &Sample<'_>, touch: &Touch<f64>) {
        let contacts = &sample.model.system().forces.contacts;
        let last_m = contacts.last_point_m(touch);
        let (beyond, of_m) = &mut self.beyond[touch.sphere];
        if touch.depth > last_m && beyond.most.see(touch.depth - last_m, sample.time_s) {
            (beyond.surface, *of_m) = (contacts.surface(touch.pair, touch.part as usize), last_m);
        }
    }

    /// Checks webbing and limiters against the last points of their curves.
    fn see_chains(&mut self, sample: &Sample<'_>) {
        let chains = &sample.model.setup().chains;
        let ends = chains.iter().flat_map(|chain| chain.straps.iter().map(|_| chain.webbing.end()));
        for ((peak, strap), end) in self.stretched.iter_mut().zip(&sample.actions.chains).zip(ends) {
            peak.see(strap.strain - end, sample.time_s);
        }
        for (slipped, strap) in self.slipped.iter_mut().zip(&sample.actions.chains) {
            if slipped.is_none() && strap.wing > 0.5 && strap.is_off > 0.5 {
                *slipped = Some((sample.time_s, strap.wing));
            }
        }
        self.see_shoulders(sample);
        for ((peak, chain), past) in self.run_out.iter_mut().zip(chains).zip(&sample.history.memory.chains) {
            if let Some(end_m) = chain.device.end_m() {
                peak.see(past.limiter_m() - end_m, sample.time_s);
            }
        }
    }

    /// Checks loaded belts for positions off the shoulder, beside the neck, or behind a sphere.
    fn see_shoulders(&mut self, sample: &Sample<'_>) {
        let (laws, mut first) = (&sample.model.system().forces.chains, 0);
        let belts = laws.iter().zip(&sample.model.setup().chains).zip(&sample.history.memory.chains);
        for (((law, chain), past), [off, neck, behind]) in belts.zip(&mut self.shoulders) {
            let straps = sample.actions.chains.get(first..first + law.strap_count()).unwrap_or_default();
            first += law.strap_count();
            let mark = |seen: &mut Option<f64>| *seen = seen.or(Some(sample.time_s));
            if behind.is_none() && straps.iter().any(|strap| passes_behind(sample, chain, strap)) {
                mark(behind);
            }
            let Some((strap, lies)) = law.on_shoulder(past) else { continue };
            if straps.get(strap).is_some_and(|strap| strap.force >= LEAST_N) && lies != OnShoulder::Bears {
                mark(if lies == OnShoulder::AtNeck { neck } else { off });
            }
        }
    }

    /// Checks for spheres in the way of a bag that fires, and for those that compress one to its mount.
    fn see_bags(&mut self, sample: &Sample<'_>) {
        let is = |flags: f64, i: usize| flags as u32 >> i & 1 == 1;
        let of_bags = sample.model.setup().bags.iter().zip(&sample.actions.bags);
        for ((bag, action), behind) in of_bags.zip(&mut self.behind) {
            for (((sphere, _), push), seen) in bag.spheres.iter().zip(&action.pushes).zip(behind) {
                if seen.is_none() && push.norm_squared() > 0.0 {
                    let touched = sample.contacts().find(|touch| touch.sphere == *sphere && is_behind(push, touch));
                    *seen = touched.map(|touch| (sample.time_s, touch.surface));
                }
            }
        }
        for (spheres, action) in self.bags.iter_mut().zip(&sample.actions.bags) {
            for (i, seen) in spheres.iter_mut().enumerate() {
                for (seen, flags) in seen.iter_mut().zip([action.caught, action.bottoms]) {
                    *seen = seen.or(is(flags, i).then_some(sample.time_s));
                }
            }
        }
    }

    /// Checks a sphere against the faces of a frame.
    fn see_group(&mut self, sample: &Sample<'_>, group: &Group) {
        let contacts = &sample.model.system().forces.contacts;
        let sphere = &sample.model.body().spheres[group.sphere];
        let feels = || sample.actions.contacts.iter().any(|touch| touch.sphere == group.sphere);
        let (segment, pairs) = (sphere.segment.index(), group.pairs.clone());
        let limb = self.limbs[segment].map(|length_m| limb(sample, group.frame, segment, length_m));
        let all = contacts.planes[pairs.clone()].iter().zip(&sample.history.memory.contacts[pairs.clone()]);
        for ((i, begun), (plane, past)) in pairs.clone().zip(&mut self.begun[pairs]).zip(all) {
            let has_passed = past.phase == PASSED;
            if has_passed && !begun[0] {
                if !self.is_begun {
                    begun[0] = true;
                } else if !feels() {
                    let centre = Centres::of(&mut self.centres, sample, group.frame)[group.sphere];
                    let (overlap_m, surface) = overlap(contacts, i, centre, sphere.radius_m);
                    self.passed[group.sphere].see_first(overlap_m, surface, sample.time_s);
                }
            }
            begun[0] &= has_passed;
            let Some(ends) = limb.filter(|_| !begun[1]) else { continue };
            let Some(place) = crossing(plane, sphere.radius_m, ends) else { continue };
            let pair = &contacts.pairs[i];
            for part in pair.parts.iter().filter(|part| pair.is_over(part, place)) {
                if !self.is_begun {
                    begun[1] = true;
                } else if self.cuts[segment].may_see_first(part.surface) {
                    let centres = Centres::of(&mut self.centres, sample, group.frame);
                    let most_m = self.cuts[segment].most.value;
                    let clear_m = clear_m(sample.model.body(), centres, (place, group.sphere), most_m);
                    self.cuts[segment].see_first(clear_m, part.surface, sample.time_s);
                }
            }
        }
    }

    /// Resulting caveats.
    pub(super) fn caveats(&self, body: &Body, surfaces: &[String], chains: &[Chain], bags: &[Bag]) -> Vec<Caveat> {
        let name = |sunk: &Sunk| surfaces[sunk.surface].as_str();
        let joints = body.tree.joints().zip(&self.joints).filter(|(_, turned)| turned.beyond.value > AT_STOP_RAD);
        let joints = joints.map(|(joint, turned)| Caveat::beyond_stop(body, joint, turned));
        let passed = self.passed.iter().enumerate().filter(|(_, sunk)| sunk.most.value > GRAZE_M);
        let passed = worst_of_parts(body, passed).into_iter();
        let passed = passed.map(|(sphere, sunk)| Caveat::passed(body, sphere, name(sunk), sunk.most));
        let most_m = |(sphere, sunk): &(usize, &Sunk)| {
            let diameter_m = 2.0 * body.spheres[*sphere].radius_m;
            if self.cushion == Some(sunk.surface) { diameter_m.min(CUSHION_M) } else { diameter_m }
        };
        let deep = self.deep.iter().enumerate().filter(|one| one.1.most.value > most_m(one));
        let deep = worst_of_parts(body, deep).into_iter();
        let deep = deep.map(|one| Caveat::too_deep(body, one.0, name(one.1), one.1.most, most_m(&one)));
        let cuts = body.tree.segments().zip(&self.cuts).filter(|(_, sunk)| sunk.most.value > GRAZE_M);
        let cuts = cuts.map(|(limb, sunk)| Caveat::cut(body, limb, name(sunk), sunk.most));
        let bottomed = self.bottomed.iter().map(|(sunk, _)| sunk).enumerate().filter(|(_, sunk)| sunk.most.value > 0.0);
        let bottomed = worst_of_parts(body, bottomed).into_iter();
        let bottomed = bottomed.map(|(s, sunk)| Caveat::bottomed(body, s, name(sunk), sunk.most, self.bottomed[s].1));
        let through = self.through.iter().enumerate().filter(|(_, sunk)| sunk.most.value > 0.0);
        let through = worst_of_parts(body, through).into_iter();
        let through = through.map(|(sphere, sunk)| Caveat::through(body, sphere, name(sunk), sunk.most));
        let beyond = self.beyond.iter().map(|(sunk, _)| sunk).enumerate().filter(|(_, sunk)| sunk.most.value > 0.0);
        let beyond = worst_of_parts(body, beyond).into_iter();
        let beyond = beyond.map(|(s, sunk)| Caveat::beyond_curve(body, s, name(sunk), sunk.most, self.beyond[s].1));
        let of_sphere = passed.chain(deep).chain(bottomed).chain(beyond).chain(through).chain(cuts);
        joints
            .chain(of_sphere)
            .chain(self.of_chains(body, chains))
            .chain(self.of_bags(body, surfaces, bags))
            .chain(self.strokes.caveats())
            .chain(self.slides.caveats(body))
            .collect()
    }

    /// Caveats of belts over several nodes.
    fn of_chains<'s>(&'s self, body: &'s Body, chains: &'s [Chain]) -> impl Iterator<Item = Caveat> + use<'s> {
        let belts = chains.iter().flat_map(|chain| chain.straps.iter().map(move |_| chain));
        let slipped = belts.zip(&self.slipped).filter_map(|(chain, seen)| Some((chain, (*seen)?)));
        let slipped: Vec<Caveat> = slipped.filter_map(|(chain, seen)| Caveat::submarined(body, chain, seen)).collect();
        let straps = chains.iter().flat_map(|chain| chain.straps.iter().map(move |strap| (chain, strap)));
        let stretched = straps.zip(&self.stretched).filter(|(_, peak)| peak.value > 0.0);
        let stretched = stretched.map(|((chain, strap), peak)| Caveat::stretched(strap, *peak, chain.webbing.end()));
        let run_out = chains.iter().zip(&self.run_out).filter(|(_, peak)| peak.value > 0.0);
        let run_out =
            run_out.filter_map(|(chain, peak)| Some(Caveat::run_out(&chain.belt, *peak, chain.device.end_m()?)));
        let shoulders = chains.iter().zip(&self.shoulders);
        let shoulders = shoulders.flat_map(move |(chain, [off, neck, behind])| {
            let behind = behind.map(|s| Caveat::behind(body, chain, s));
            [off.map(|s| Caveat::off_shoulder(chain, s)), neck.map(|s| Caveat::at_neck(chain, s)), behind]
        });
        stretched.chain(run_out).chain(slipped).chain(shoulders.flatten())
    }
}

impl Signs {
    /// Caveats of bags.
    fn of_bags(&self, body: &Body, surfaces: &[String], bags: &[Bag]) -> impl Iterator<Item = Caveat> {
        let all = bags.iter().zip(&self.bags).zip(&self.behind).flat_map(|((bag, seen), behind)| {
            seen.iter()
                .zip(behind)
                .zip(&bag.spheres)
                .map(move |((seen, behind), (sphere, _))| (bag, *sphere, seen, behind))
        });
        all.flat_map(move |(bag, sphere, [caught, bottoms], behind)| {
            let new = |sign, time_s| Caveat::of_bag(body, sphere, sign, &bag.name, time_s);
            let touched = |(time_s, what): &(f64, usize)| {
                surfaces.get(*what).map(|what| Caveat::touched_through(body, sphere, &bag.name, what, *time_s))
            };
            let through = behind.as_ref().and_then(touched).or(bottoms.map(|time_s| new("through_bag", time_s)));
            [caught.map(|time_s| new("caught", time_s)), through]
        })
        .flatten()
    }
}

/// Cosine of the largest angle, about 80°, between the forces of a bag and of a part that the sphere touches through
/// the bag. A head that slides over the top of a bag on to the rim behind it has 0.42.
const SAME_WAY: f64 = 0.2;

/// Whether the part that a sphere touches is behind the bag: both forces have the same direction.
fn is_behind(push: &V3<f64>, touch: &Contact) -> bool {
    let normal_n = touch.force_n - touch.friction_n - touch.edge_n;
    let push_n = push.to_vector();
    normal_n.norm() > 0.0 && push_n.dot(&normal_n) > SAME_WAY * push_n.norm() * normal_n.norm()
}

/// Of each part of the body, the sphere with the largest penetration.
fn worst_of_parts<'s>(body: &Body, list: impl Iterator<Item = (usize, &'s Sunk)>) -> Vec<(usize, &'s Sunk)> {
    let mut worst: Vec<(usize, &Sunk)> = Vec::new();
    for one in list {
        match worst.iter_mut().find(|other| body.spheres[other.0].part == body.spheres[one.0].part) {
            Some(known) if known.1.most.value < one.1.most.value => *known = one,
            Some(_) => {}
            None => worst.push(one),
        }
    }
    worst
}

/// By joint with elastic limits: its index among all, and the largest excess, rad.
fn limits(model: &Model) -> Vec<(usize, f64)> {
    let laws = model.system().forces.limits.iter();
    laws.map(|law| (law.joint().index(), MOST_EXCESS_RAD.min(law.last_point_rad()))).collect()
}

impl Turned {
    fn see(&mut self, law: &JointLaw, angle_rad: f64, time_s: f64) {
        for stop in stops(law).iter().flatten() {
            self.see_stop(Some(stop), Peak { value: (angle_rad - stop.full_rad) * sense(stop), time_s });
        }
    }

    /// Checks a joint against the end of a stop.
    fn see_stop(&mut self, stop: Option<&Stop>, beyond: Peak) {
        let Some(stop) = stop.filter(|_| self.beyond.see(beyond.value, beyond.time_s)) else { return };
        let angle_rad = stop.full_rad + sense(stop) * beyond.value;
        (self.angle_rad, self.stop_rad, self.is_elastic) = (angle_rad, stop.full_rad, false);
    }

    /// Checks an angle beyond an elastic limit, of which `most_rad` is the largest possible or the last known.
    fn see_limit(&mut self, excess_rad: f64, most_rad: f64, time_s: f64) {
        if self.beyond.see(excess_rad - (most_rad - AT_STOP_RAD), time_s) {
            (self.angle_rad, self.stop_rad, self.is_elastic) = (excess_rad, most_rad, true);
        }
    }
}

/// Stops of a joint (of a hinge, upper and lower).
fn stops(law: &JointLaw) -> [Option<Stop>; 2] {
    match law {
        JointLaw::Ball(ball) => [ball.stop, None],
        JointLaw::Hinge(hinge) => [hinge.upper_stop, hinge.lower_stop],
    }
}

/// 1 for a stop reached by rising angles, −1 for a lower stop.
fn sense(stop: &Stop) -> f64 {
    (stop.full_rad - stop.begin_rad).signum()
}

/// Both ends of a segment, axes of a frame, m.
fn limb(sample: &Sample<'_>, frame: usize, segment: usize, length_m: f64) -> [V3<f64>; 2] {
    let k = &sample.evaluation.kinematics;
    let far = k.joint[segment] + k.axes[segment].z * length_m;
    [k.joint[segment], far].map(|end| into_frame(sample, frame, end))
}

fn into_frame(sample: &Sample<'_>, frame: usize, point: V3<f64>) -> V3<f64> {
    let carried = |n| sample.evaluation.kinematics.moving(sample.model.system().carriers[n]);
    let frame = frame.checked_sub(MOST_FRAMES).map_or_else(|| sample.frames[frame], carried);
    frame.axes.into_frame(point - frame.origin)
}

/// Centres of all spheres at one instant in the axes of a frame, m.
#[derive(Clone, Debug)]
struct Centres {
    frame: usize,
    time_s: f64,
    centres: Vec<V3<f64>>,
}

impl Centres {
    /// For all frames with faces, of no instant yet.
    fn all(model: &Model) -> Vec<Centres> {
        let mut all = Vec::<Centres>::new();
        for group in &model.system().forces.contacts.groups {
            if all.iter().all(|known| known.frame != group.frame) {
                let centres = vec![V3::zero(); model.body().spheres.len()];
                all.push(Centres { frame: group.frame, time_s: f64::NAN, centres });
            }
        }
        all
    }

    /// Those of a frame in `all`, by sphere.
    fn of<'a>(all: &'a mut [Centres], sample: &Sample<'_>, frame: usize) -> &'a [V3<f64>] {
        let Some(own) = all.iter_mut().find(|own| own.frame == frame) else { return &[] };
        if own.time_s != sample.time_s {
            own.time_s = sample.time_s;
            let (system, k) = (sample.model.system(), &sample.evaluation.kinematics);
            for (sphere, centre) in own.centres.iter_mut().enumerate() {
                *centre = into_frame(sample, frame, system.sphere(k, sphere).1);
            }
        }
        &own.centres
    }
}

/// Overlap of a sphere about `centre` with the nearest part of pair `i`, m, and the part's surface.
fn overlap(contacts: &ContactSystem<f64>, i: usize, centre: V3<f64>, radius_m: f64) -> (f64, usize) {
    let behind_m = contacts.planes[i].depth(centre) - radius_m;
    let pair = &contacts.pairs[i];
    let parts =
        pair.parts.iter().map(|part| (radius_m - trig::hypot(behind_m, pair.beside(part, centre)), part.surface));
    parts.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::NEG_INFINITY, 0))
}

/// Intersection of a line with a plane raised by the radius of a sphere.
fn crossing(plane: &Plane<f64>, radius_m: f64, [from, to]: [V3<f64>; 2]) -> Option<V3<f64>> {
    let [begin, end] = [from, to].map(|point| plane.depth(point) - radius_m);
    (begin * end < 0.0).then(|| from + (to - from) * (begin / (begin - end)))
}

/// Distance of a point from the nearest sphere of the body, m; of any sphere no farther than `most_m`, if there is one,
/// looked for from sphere `first` on.
fn clear_m(body: &Body, centres: &[V3<f64>], (place, first): (V3<f64>, usize), most_m: f64) -> f64 {
    let spheres = || body.spheres.iter().zip(centres);
    let mut clear_m = f64::INFINITY;
    for (sphere, centre) in spheres().skip(first).chain(spheres().take(first)) {
        clear_m = clear_m.min((*centre - place).norm_squared().sqrt() - sphere.radius_m);
        if clear_m <= most_m {
            break;
        }
    }
    clear_m
}
