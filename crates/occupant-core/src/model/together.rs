//! Several bodies in one run: each starts as it would alone, then all are one model whose kernel goes from tree to
//! tree.

use crate::body::{Body, called};
use crate::forces::belt::Belt;
use crate::forces::chain::{Chain, Node, Site as NodeSite};
use crate::forces::contact::self_contact::SelfContact;
use crate::forces::contact::surface::Frame;
use crate::forces::joint::Joints;
use crate::model::Model;
use crate::model::seating::InitialPosture;
use crate::model::setup::{Member, OtherFrame, Setup};
use placed_text::{Problem, Problems};

/// Prefix of the paths of problems of a member.
const OWN: [&str; 9] =
    ["body", "joints", "posture", "seat", "mount", "velocity", "belts", "self_contact", "initial_state"];

/// A frame relative to a body's home: home and vehicle are exchanged.
fn seen_from(home: Frame, frame: Frame) -> Frame {
    match frame {
        Frame::Vehicle => home,
        frame if frame == home => Frame::Vehicle,
        frame => frame,
    }
}

impl Setup {
    /// The same for one body whose home replaces the vehicle; surfaces of other bodies touch nothing there.
    #[must_use]
    pub fn at_home(mut self, home: Frame) -> Setup {
        let seen = |frame: Frame| if frame.segment().is_some() { Frame::Space } else { seen_from(home, frame) };
        let hide = |frame: Frame, spheres: &mut Option<Vec<usize>>| {
            if frame.segment().is_some() {
                *spheres = Some(Vec::new());
            }
        };
        for surface in &mut self.surfaces {
            hide(surface.frame, &mut surface.spheres);
            surface.frame = seen(surface.frame);
        }
        for solid in &mut self.solids {
            hide(solid.frame, &mut solid.spheres);
            solid.frame = seen(solid.frame);
        }
        if let Frame::Other(i) = home
            && let Some(frame) = self.frames.get_mut(i)
        {
            // bags are the first vehicle's
            self.bags.clear();
            std::mem::swap(&mut self.path, &mut frame.path);
            for OtherFrame { parent, .. } in &mut self.frames {
                *parent = parent.map(|(frame, origin_m)| (seen(frame), origin_m));
            }
        }
        self
    }

    /// Adds `members` to this setup. The setup's own body, joints, belts and posture are ignored.
    #[must_use]
    pub fn together(self, members: Vec<Member>, pairs: &[[(usize, usize); 2]], skins: &[usize]) -> Setup {
        let mut all = Setup { body: bodies(&members), members, posture: InitialPosture::Together, ..self };
        all.joints = Joints::together(all.body.tree, all.members.iter().map(|member| &member.alone.joints));
        let Setup { members, surfaces, solids, belts, chains, bags, bands, behind, output, .. } = &mut all;
        let (mut segment, mut sphere, mut plate) = (0, 0, 0);
        let mut own = SelfContact { skins: Vec::new(), pairs: Vec::new() };
        let mut firsts = Vec::new();
        for surface in surfaces.iter_mut() {
            surface.spheres = Some(Vec::new());
        }
        for solid in solids.iter_mut() {
            solid.spheres = Some(Vec::new());
        }
        bags.iter_mut().for_each(|bag| bag.spheres.clear());
        let skins = skins.iter().chain(std::iter::repeat(&0));
        for (Member { name, home, meets, alone }, skin) in members.iter().zip(skins) {
            let count = alone.body.spheres.len();
            let met = |spheres: &Option<Vec<usize>>| -> Vec<usize> {
                let all: Vec<usize> = spheres.clone().unwrap_or_else(|| (0..count).collect());
                all.into_iter().map(|i| sphere + i).collect()
            };
            let lists = surfaces.iter_mut().map(|surface| &mut surface.spheres);
            for (all, own) in lists.chain(solids.iter_mut().map(|solid| &mut solid.spheres)).zip(meets) {
                all.get_or_insert_default().extend(met(own));
            }
            belts.extend(alone.belts.iter().map(|belt| Belt {
                name: called(name, &belt.name),
                sphere: sphere + belt.sphere,
                frame: *home,
                ..belt.clone()
            }));
            chains.extend(alone.chains.iter().map(|chain| Chain {
                belt: called(name, &chain.belt),
                straps: chain.straps.iter().map(|strap| called(name, strap)).collect(),
                frame: *home,
                nodes: chain.nodes.iter().map(|node| moved(node, segment, sphere, plate)).collect(),
                ..chain.clone()
            }));
            bands.extend(alone.bands.iter().map(|band| band.of_member(called(name, &band.name), plate)));
            behind.extend(alone.behind.iter().copied());
            plate += alone.body.plates.len();
            for (all, own) in bags.iter_mut().zip(&alone.bags) {
                all.spheres.extend(own.spheres.iter().map(|(i, reach)| (sphere + i, *reach)));
            }
            let skins = alone.self_contact.as_ref().map_or_else(|| vec![*skin; count], |own| own.skins.clone());
            let touching = alone.self_contact.iter().flat_map(|own| &own.pairs);
            own.pairs.extend(touching.map(|pair| pair.map(|i| sphere + i)));
            own.skins.extend(skins);
            output.markers.extend(alone.output.markers.iter().map(|marker| marker.of_member(name, segment)));
            firsts.push(sphere);
            (segment, sphere) = (segment + alone.body.segments.len(), sphere + count);
        }
        // a member that does not exist has no sphere: `Model::new` refuses it
        let among_all = |(member, i): (usize, usize)| firsts.get(member).map_or(usize::MAX, |first| first + i);
        own.pairs.extend(pairs.iter().map(|pair| pair.map(among_all)));
        behind.sort_unstable();
        behind.dedup();
        own.pairs.sort_unstable();
        all.self_contact = (!own.pairs.is_empty()).then_some(own);
        all
    }
}

fn bodies(members: &[Member]) -> Body {
    let all: Vec<(&str, &Body)> = members.iter().map(|member| (member.name.as_str(), &member.alone.body)).collect();
    Body::together(&all)
}

/// Node of a belt with indices among the segments and spheres of all bodies.
fn moved(node: &Node, segment: usize, sphere: usize, first: usize) -> Node {
    let site = match &node.site {
        site @ NodeSite::Vehicle(..) => site.clone(),
        NodeSite::Segment(n, point, away) => NodeSite::Segment(segment + n, *point, *away),
        NodeSite::Track(n, track) => NodeSite::Track(segment + n, track.of_member(segment, first)),
        NodeSite::Sphere(i) => NodeSite::Sphere(sphere + i),
    };
    let ride = node.ride.iter().map(|(plate, share)| (first + plate, *share)).collect();
    Node { site, ride, ..node.clone() }
}

/// The members as models of their own; none with a single body.
pub(super) fn alone(setup: &Setup, problems: &mut Problems) -> Option<Vec<Model>> {
    let mut models = Vec::new();
    for member in &setup.members {
        let model = match Model::new(member.alone.clone()) {
            Ok(model) => {
                absorb(member, model.warnings(), problems);
                Some(model)
            }
            Err(found) => {
                absorb(member, &found, problems);
                None
            }
        };
        models.extend(model);
    }
    (models.len() == setup.members.len()).then_some(models)
}

/// Adds the problems of a member; those of common parts once.
fn absorb(member: &Member, found: &Problems, problems: &mut Problems) {
    for problem in found.iter() {
        let first = problem.path.split(['.', '[']).next().unwrap_or_default();
        let is_own = OWN.contains(&first) && !member.name.is_empty();
        // a loose body has no keys but its own
        let own = if member.is_loose() { problem.path.rsplit('.').next() } else { None };
        let own = own.unwrap_or(&problem.path);
        let path = if is_own { format!("{}.{own}", member.path()) } else { problem.path.clone() };
        let problem = Problem { path, ..problem.clone() };
        if problems.iter().all(|known| *known != problem) {
            problems.push(problem);
        }
    }
}
