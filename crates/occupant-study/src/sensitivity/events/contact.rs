//! Events of contacts.

use super::{Happening, Notes};
use occupant_core::forces::contact::{PairHistory, TOUCHING, Touch};
use occupant_core::model::Model;
use occupant_core::motion::dual::Dual;
use occupant_core::motion::vector::V3;

/// Look number for a pair never seen.
const NONE_YET: u64 = 1;

/// Contact events of a sphere and a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touching {
    /// Contact begins.
    Begins,
    /// Contact ends: the sphere leaves the plane.
    Ends,
    /// The centre passes beyond the edge: the edge force begins.
    ReachesEdge,
    /// The centre returns from beyond the edge: the edge force ends.
    LeavesEdge,
    /// The sphere has passed around the edge.
    Passes,
    /// The sphere moves onto this surface of the same plane.
    Crosses,
    /// The spring enters its second slope.
    Stiffens,
    /// The spring begins to unload.
    Unloads,
    /// The spring reloads beyond its earlier maximum.
    Reloads,
    /// Sliding reverses.
    SlipsBack,
}

impl Touching {
    /// Description, such as `head begins to touch wheel`.
    pub(super) fn words(self, model: &Model, sphere: usize, surface: usize) -> String {
        let setup = model.setup();
        let sphere = setup.body.spheres.get(sphere).map_or("?", |s| s.name.as_str());
        let surface = setup.surface_name(surface).unwrap_or("?");
        let verb = match self {
            Touching::Begins => "begins to touch",
            Touching::Ends => "leaves",
            Touching::ReachesEdge => "reaches the edge of",
            Touching::LeavesEdge => "comes back from the edge of",
            Touching::Passes => "has gone round the edge of",
            Touching::Crosses => "crosses over to",
            Touching::Stiffens => "reaches the second slope of",
            Touching::Unloads => "begins to unload",
            Touching::Reloads => "loads again",
            Touching::SlipsBack => "reverses its sliding on",
        };
        format!("{sphere} {verb} {surface}")
    }
}

/// A sphere-surface pair at the last look.
#[derive(Clone, Copy, Default)]
struct PairNow {
    /// Number of the look with contact.
    seen: u64,
    sphere: usize,
    surface: usize,
    on_edge: bool,
    stiff: bool,
    unloading: bool,
    slip: Option<V3<f64>>,
    edge_n: f64,
}

/// State of all contacts at the last look.
pub(super) struct Lookout {
    looks: u64,
    pairs: Vec<PairNow>,
    touching: Vec<usize>,
}

impl Lookout {
    pub fn new(model: &Model) -> Self {
        let pairs = model.start().history.memory.contacts.len();
        Lookout { looks: NONE_YET, pairs: vec![PairNow::default(); pairs], touching: Vec::with_capacity(pairs) }
    }

    pub fn look<const N: usize>(
        &mut self,
        model: &Model,
        touches: &[Touch<Dual<N>>],
        past: &[PairHistory<Dual<N>>],
        notes: &mut Notes<N>,
    ) {
        self.looks += 1;
        for touch in touches {
            self.look_at_pair(model, touch, &past[touch.pair], notes);
        }
        self.look_for_ends(past, notes);
    }

    fn look_at_pair<const N: usize>(
        &mut self,
        model: &Model,
        touch: &Touch<Dual<N>>,
        past: &PairHistory<Dual<N>>,
        notes: &mut Notes<N>,
    ) {
        let (setup, contacts) = (model.setup(), &model.system().forces.contacts);
        let part = touch.part.value as usize;
        let surface = contacts.surface(touch.pair, part);
        let sphere = touch.sphere;
        let before = self.pairs[touch.pair];
        let begins = before.seen + 1 != self.looks;
        let slip = V3 { x: touch.slip.x.value, y: touch.slip.y.value, z: touch.slip.z.value };
        let edge_n = length(&touch.edge);
        let depth = touch.depth.value;
        let now = PairNow {
            seen: self.looks,
            sphere,
            surface,
            on_edge: touch.weight.value < 1.0,
            stiff: depth > contacts.knee_m(touch.pair, part),
            unloading: depth < past.greatest.value,
            slip: Some(slip),
            edge_n,
        };
        self.pairs[touch.pair] = now;
        let contact = |what: Touching| Happening::Contact { sphere, surface, what };
        if begins {
            self.touching.push(touch.pair);
            if self.looks > NONE_YET + 1 {
                // the instant of Δ = 0 shifts by −Δ′/Δ̇
                let closing = touch.closing.value;
                let shift = if closing > 0.0 { touch.depth.slopes.map(|s| -s / closing) } else { [f64::NAN; N] };
                notes.note_shifting(contact(Touching::Begins), None, shift);
            }
            return;
        }
        if now.on_edge != before.on_edge {
            let (what, jump_n) =
                if now.on_edge { (Touching::ReachesEdge, edge_n) } else { (Touching::LeavesEdge, before.edge_n) };
            notes.note(contact(what), Some(jump_n));
        }
        if now.surface != before.surface {
            let same = setup.surface_material(before.surface) == setup.surface_material(surface);
            let jump_n = (!same).then_some(touch.normal_force.value);
            notes.note(contact(Touching::Crosses), jump_n);
        }
        if now.stiff && !before.stiff && !now.unloading {
            notes.note(contact(Touching::Stiffens), None);
        }
        if now.unloading != before.unloading {
            let what = if now.unloading { Touching::Unloads } else { Touching::Reloads };
            notes.note(contact(what), None);
        }
        if before.slip.is_some_and(|s| s.dot(slip) < 0.0) && touch.normal_force.value > 0.0 {
            notes.note(contact(Touching::SlipsBack), None);
        }
    }

    fn look_for_ends<const N: usize>(&mut self, past: &[PairHistory<Dual<N>>], notes: &mut Notes<N>) {
        let mut at = 0;
        while at < self.touching.len() {
            let i = self.touching[at];
            let pair = self.pairs[i];
            if pair.seen == self.looks {
                at += 1;
                continue;
            }
            self.touching.swap_remove(at);
            let passed = past[i].phase.value > TOUCHING;
            let (what, jump_n) = if passed { (Touching::Passes, Some(pair.edge_n)) } else { (Touching::Ends, None) };
            let happening = Happening::Contact { sphere: pair.sphere, surface: pair.surface, what };
            notes.note(happening, jump_n);
        }
    }
}

fn length<const N: usize>(v: &V3<Dual<N>>) -> f64 {
    (v.x.value * v.x.value + v.y.value * v.y.value + v.z.value * v.z.value).sqrt()
}
