//! `[materials]`: the keys of a material, converted to a [`Material`].

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::functions::{function, listed, points};
use super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, all_si, si_or};
use super::{Energy, Force, Length, Ratio, Scenario, Speed, Stiffness};
use occupant_core::forces::contact::material::{Breaking, Force as Law, Limit, Material, Memory};
use occupant_core::forces::function::{Beyond, ForceDeflection, Function, Shape, Unloading};
use occupant_core::forces::spring::BilinearSpring;
use placed_text::with_key;

/// A contact material: a bilinear spring with hysteresis, or a force over depth, and friction.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "x-at-most-one" = [["k1", "depth", "polynomial"], ["k1", "library"], ["library", "file"], ["k1", "file"], ["polynomial", "file"], ["polynomial", "shape"], ["polynomial", "returned_each"], ["returned", "returned_each", "unload_slope", "atb"]],
    "x-together" = [["k2", "delta_b"], ["unload_depth", "unload_force"]],
))]
pub(crate) struct MaterialSection {
    /// Name of a material of the library. Other keys override its values.
    #[schemars(extend("enum" = [
        "seat_cushion_s10", "dash_s10", "padding_s10", "hard_s10", "glass_s10", "glass_laminated", "glass_tempered", "body_s10", "stiff_atb", "segment_atb", "column_1969",
        "head_dummy", "head_dummy_1973"
    ]))]
    pub(crate) library: Option<String>,
    /// Name of a surface file, relative to the scenario, as written by `occupant surface`. Other keys override its
    /// values; values not measured must be given here.
    pub(crate) file: Option<String>,
    /// K₁, stiffness up to `delta_b` against one sphere. Three spheres of a part that touch are three times as stiff (a
    /// sphere's `share` scales its force). 0 is a gap before the spring bears.
    pub(crate) k1: Option<Stiffness<NOT_NEGATIVE>>,
    /// Δ_b, deformation at which the stiffness changes. Without it the spring is linear.
    pub(crate) delta_b: Option<Length<NOT_NEGATIVE>>,
    /// K₂, stiffness beyond `delta_b`.
    pub(crate) k2: Option<Stiffness<NOT_NEGATIVE>>,
    /// μ₁, fraction of the energy stored up to `delta_b` that unloading returns.
    pub(crate) mu1: Option<Ratio<FRACTION>>,
    /// μ₂, the same beyond `delta_b`; equal to `mu1` if absent.
    pub(crate) mu2: Option<Ratio<FRACTION>>,
    /// Depths of a force function, from 0.
    pub(crate) depth: Option<Vec<Length<NOT_NEGATIVE>>>,
    /// Force at each.
    pub(crate) force: Option<Vec<Force<NOT_NEGATIVE>>>,
    /// A polynomial instead of points.
    pub(crate) polynomial: Option<PolynomialSection>,
    /// Interpolation of the force between points; "lines" if absent.
    pub(crate) shape: Option<Shape>,
    /// Force or moment beyond the last point; "extends" if absent.
    pub(crate) beyond: Option<Beyond>,
    /// Fraction of the work that unloading returns; 1 if no unloading is given.
    pub(crate) returned: Option<Ratio<FRACTION>>,
    /// The same for each interval.
    pub(crate) returned_each: Option<Vec<Ratio<FRACTION>>>,
    /// Unloading slope instead, no less than the steepest slope of loading; the force may then fall.
    pub(crate) unload_slope: Option<Stiffness<POSITIVE>>,
    /// Depths, from 0, of a lower force curve at which unloading along that slope ends; 0 if absent.
    pub(crate) unload_depth: Option<Vec<Length<NOT_NEGATIVE>>>,
    /// The lower force at each depth.
    pub(crate) unload_force: Option<Vec<Force<NOT_NEGATIVE>>>,
    /// Unloading by the quadratic of the ATB program instead.
    pub(crate) atb: Option<AtbSection>,
    /// Extra force during first loading, which collapses when the depth stops growing.
    pub(crate) spike: Option<SpikeSection>,
    /// Rate factor: factor on the force over deformation speed.
    pub(crate) rate: Option<RateSection>,
    /// A parallel damper.
    pub(crate) viscous: Option<DamperSection>,
    /// Coefficient of friction.
    pub(crate) friction: Option<Ratio<NOT_NEGATIVE>>,
    /// v_s, sliding speed at which friction reaches 71 % of its full value; 5 in/s if absent. Friction grows with slip
    /// and never sticks: on a slope θ a body creeps at v_s tan θ/√(f² − tan² θ). A smaller speed is closer to sticking
    /// but needs proportionally smaller steps; `check` and `run` warn if a fixed step is too long.
    pub(crate) friction_speed: Option<Speed<POSITIVE>>,
    /// Factor on friction over sliding speed.
    pub(crate) friction_over_slip: Option<SlipSection>,
    /// Factor on friction over normal force.
    pub(crate) friction_over_force: Option<LoadSection>,
    /// Whether crush is stored after contact has ended; "reset" if absent.
    pub(crate) memory: Option<Memory>,
    /// A pane: each surface or solid of this material, or each group of solids, breaks as a whole.
    pub(crate) breaks: Option<BreaksSection>,
}

/// When a pane breaks, and what is left of it. One segment of a body breaks it, with all its spheres together; from then on it is
/// broken for all. Depth and crush are those of each sphere, before and after.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["force", "energy"]], "x-together" = [["depth", "left"]]))]
pub(crate) struct BreaksSection {
    /// Normal force under which it breaks.
    pub(crate) force: Option<Force<POSITIVE>>,
    /// Work of pressing it in by which it breaks: the area below force over depth, without `rate` and `viscous`.
    pub(crate) energy: Option<Energy<POSITIVE>>,
    /// Depths, from 0, of the law of what is left; it unloads as the material does. Nothing is left if absent.
    pub(crate) depth: Option<Vec<Length<NOT_NEGATIVE>>>,
    /// Force at each depth.
    pub(crate) left: Option<Vec<Force<NOT_NEGATIVE>>>,
}

/// The quadratic unloading of the ATB program. The returned fraction is limited by the curve; the program reports the
/// actual value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["r", "r_each"], ["g", "g_each"]]))]
pub(crate) struct AtbSection {
    /// R, fraction of the work that unloading returns.
    pub(crate) r: Option<Ratio<FRACTION>>,
    /// G, permanent depth as a fraction of the largest depth; less than 1.
    pub(crate) g: Option<Ratio<FRACTION>>,
    /// Largest depths, increasing, for `r_each` and `g_each`: linear between, constant beyond.
    pub(crate) depth: Option<Vec<Length<NOT_NEGATIVE>>>,
    /// R at each depth.
    pub(crate) r_each: Option<Vec<Ratio<FRACTION>>>,
    /// G at each depth.
    pub(crate) g_each: Option<Vec<Ratio<FRACTION>>>,
}

/// A force F₁s + F₂s² + F₃s³ with s = depth/`depth`, up to `depth`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PolynomialSection {
    /// Largest depth in its range.
    pub(crate) depth: Length<POSITIVE>,
    /// F₁, F₂ and F₃: value of each term at that depth.
    pub(crate) force: [Force; 3],
}

/// A force of the first loading.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpikeSection {
    /// Depths, from 0.
    pub(crate) depth: Vec<Length<NOT_NEGATIVE>>,
    /// Force at each, 0 at the first and the last.
    pub(crate) force: Vec<Force<NOT_NEGATIVE>>,
}

/// A factor over the speed of deformation; constant before the first and after the last.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RateSection {
    /// Speeds, negative where the depth shrinks; one of them is 0.
    pub(crate) speed: Vec<Speed>,
    /// Factor at each speed; must not fall; 1 at speed 0.
    pub(crate) factor: Vec<Ratio<NOT_NEGATIVE>>,
}

/// A damper: `force` at `speed`, proportional to the speed, with full effect from a depth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DamperSection {
    /// Its force at `speed`.
    pub(crate) force: Force<NOT_NEGATIVE>,
    /// A speed of deformation.
    pub(crate) speed: Speed<POSITIVE>,
    /// Depth of full effect; 25 mm if absent.
    pub(crate) depth: Option<Length<POSITIVE>>,
}

/// A factor over the sliding speed; constant before the first and after the last.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SlipSection {
    /// Sliding speeds.
    pub(crate) speed: Vec<Speed<NOT_NEGATIVE>>,
    /// Factor at each.
    pub(crate) factor: Vec<Ratio<NOT_NEGATIVE>>,
}

/// A factor over the normal force; constant before the first and after the last.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LoadSection {
    /// Normal forces.
    pub(crate) force: Vec<Force<NOT_NEGATIVE>>,
    /// Factor at each.
    pub(crate) factor: Vec<Ratio<NOT_NEGATIVE>>,
}

/// Default depth of a damper's full effect, m.
const DAMPED_M: f64 = 0.025;

/// All materials, in the order written.
pub(super) fn materials(b: &mut Builder, scenario: &Scenario) -> Vec<Material> {
    scenario.materials.iter().map(|(name, section)| material(b, name, section)).collect()
}

fn material(b: &mut Builder, name: &str, s: &MaterialSection) -> Material {
    let path = with_key("materials", name);
    if s.k1.is_none() && s.depth.is_none() && s.polynomial.is_none() {
        b.error(&path, format!("`{path}` has none of `k1`, `depth`, `polynomial`, `library`, `file`"), "one of them");
    }
    let friction = b.needed(&path, "friction", &s.friction);
    let plain = match &s.k1 {
        Some(k1) => {
            let keys =
                ["shape", "beyond", "returned", "returned_each", "unload_slope", "atb", "spike", "rate", "viscous"];
            b.refuse_keys(&path, &keys, |key| format!("`{key}` beside `k1`"), "`depth` and `force` instead of `k1`");
            let mu1 = b.needed(&path, "mu1", &s.mu1);
            Material::new(name, spring(k1, &s.k2, &s.delta_b, mu1, &s.mu2), friction)
        }
        None => {
            let keys = ["k2", "delta_b", "mu1", "mu2"];
            b.refuse_keys(&path, &keys, |key| format!("`{key}` without `k1`"), "`returned` beside `depth` and `force`");
            Material::new(name, deflection(b, &path, s), friction)
        }
    };
    let over_slip = s
        .friction_over_slip
        .as_ref()
        .map(|t| points(b, &format!("{path}.friction_over_slip"), ["speed", "factor"], &t.speed, &t.factor));
    let over_force = s
        .friction_over_force
        .as_ref()
        .map(|t| points(b, &format!("{path}.friction_over_force"), ["force", "factor"], &t.force, &t.factor));
    Material {
        friction_factors: [over_slip, over_force].map(Option::unwrap_or_default),
        friction_speed_m_s: si_or(&s.friction_speed, plain.friction_speed_m_s),
        memory: s.memory.unwrap_or(plain.memory),
        breaks: s.breaks.as_ref().map(|breaks| breaking(b, &with_key(&path, "breaks"), breaks, &plain.force)),
        ..plain
    }
}

/// What is left unloads as the `whole` does.
fn breaking(b: &mut Builder, path: &str, s: &BreaksSection, whole: &Law) -> Breaking {
    let force = s.force.as_ref().map(|force| Limit::Force(force.si()));
    let limit = force.unwrap_or_else(|| Limit::Energy(b.needed(path, "energy", &s.energy)));
    let curve = points(b, path, ["depth", "left"], listed(&s.depth), listed(&s.left));
    let left = || match whole {
        Law::Bilinear(spring) => ForceDeflection::lines(curve, spring.returned_1),
        Law::Deflection(whole) => {
            let returned = whole.loading.returned.last().copied().unwrap_or(1.0);
            let unloading = match &whole.unloading {
                Unloading::Slope { n_per_m, .. } => Unloading::Slope { n_per_m: *n_per_m, least: Vec::new() },
                other => other.clone(),
            };
            ForceDeflection { unloading, ..ForceDeflection::lines(curve, returned) }
        }
    };
    Breaking { limit, left: s.left.is_some().then(|| left().into()) }
}

fn deflection(b: &mut Builder, path: &str, s: &MaterialSection) -> ForceDeflection {
    let loading = match &s.polynomial {
        Some(polynomial) => {
            let end = polynomial.depth.si();
            let [c1, c2, c3] = all_si(&polynomial.force);
            let c = [c1 / end, c2 / (end * end), c3 / (end * end * end)];
            let beyond = s.beyond.unwrap_or_default();
            Function { beyond, ..Function::polynomial(c, end, si_or(&s.returned, 1.0)) }
        }
        None => {
            let curve = points(b, path, ["depth", "force"], listed(&s.depth), listed(&s.force));
            let shape = s.shape.unwrap_or_default();
            Function { shape, ..function(curve, &s.beyond, &s.returned, &s.returned_each, 1.0) }
        }
    };
    let least = points(b, path, ["unload_depth", "unload_force"], listed(&s.unload_depth), listed(&s.unload_force));
    if !least.is_empty() && s.unload_slope.is_none() {
        b.error(path, "`unload_force` without `unload_slope`", "unload_slope = a stiffness");
    }
    let spike = s.spike.as_ref().map(|t| points(b, &with_key(path, "spike"), ["depth", "force"], &t.depth, &t.force));
    let rate = s.rate.as_ref().map(|t| points(b, &with_key(path, "rate"), ["speed", "factor"], &t.speed, &t.factor));
    ForceDeflection {
        loading,
        unloading: match (&s.unload_slope, &s.atb) {
            (Some(slope), _) => Unloading::Slope { n_per_m: slope.si(), least },
            (None, Some(atb)) => by_quadratic(b, path, atb),
            (None, None) => Unloading::Stretch,
        },
        spike: spike.unwrap_or_default(),
        rate: rate.unwrap_or_default(),
        viscous: s.viscous.as_ref().map(|t| [t.force.si() / t.speed.si(), si_or(&t.depth, DAMPED_M)]),
    }
}

/// ATB's unloading, with R and G constant or over the largest depth.
fn by_quadratic(b: &mut Builder, path: &str, s: &AtbSection) -> Unloading {
    let path = with_key(path, "atb");
    let mut rows = |one: &Option<Ratio<FRACTION>>, each: &Option<Vec<Ratio<FRACTION>>>, key: &str| match one {
        Some(one) => vec![[0.0, one.si()]],
        None => points(b, &path, ["depth", key], listed(&s.depth), listed(each)),
    };
    Unloading::Quadratic { returned: rows(&s.r, &s.r_each, "r_each"), set: rows(&s.g, &s.g_each, "g_each") }
}

/// A bilinear spring; linear if no break is given.
pub(super) fn spring(
    k1: &Stiffness<NOT_NEGATIVE>,
    k2: &Option<Stiffness<NOT_NEGATIVE>>,
    delta_b: &Option<Length<NOT_NEGATIVE>>,
    returned_1: f64,
    mu2: &Option<Ratio<FRACTION>>,
) -> BilinearSpring {
    let line = BilinearSpring::linear(k1.si(), returned_1);
    BilinearSpring {
        k2_n_per_m: si_or(k2, line.k2_n_per_m),
        break_m: si_or(delta_b, line.break_m),
        returned_2: si_or(mu2, line.returned_2),
        ..line
    }
}
