//! Lap belts round the sphere of a pelvis, which cannot slide off it: whether they would have slid off its wings.

use super::caveat::Caveat;
use super::word;
use crate::body::Body;
use crate::forces::chain::Site;
use crate::forces::chain::wing::Slider;
use crate::model::setup::Setup;
use crate::results::sample::Sample;

/// Kinds of belts and straps among all forces on spheres.
const BELTS: [&str; 2] = ["belt", "strap"];

/// Belts round one pelvis.
#[derive(Clone, Debug)]
struct Slide {
    sphere: usize,
    slider: Slider,
    /// Last time of the check, s, and the time at which the belts would have come off.
    seen_s: f64,
    off_s: Option<f64>,
    /// Names of the belts and of their results.
    belts: Vec<[String; 2]>,
}

/// Those of all bodies.
#[derive(Clone, Debug, Default)]
pub(super) struct Slides(Vec<Slide>);

impl Slides {
    pub(super) fn new(setup: &Setup) -> Self {
        let body = &setup.body;
        let is_pelvis = |sphere: usize| {
            let segment = body.spheres.get(sphere).map(|sphere| sphere.segment);
            segment.is_some_and(|segment| body.tree.landmarks_at(segment).pelvis == Some(segment))
        };
        let loops = setup.belts.iter().map(|belt| {
            let figures = format!("belts.{}.*", word(&belt.name));
            (belt.sphere, [belt.name.clone(), figures])
        });
        let chains = setup.chains.iter().flat_map(|chain| {
            let round = chain.nodes.iter().filter_map(|node| match node.site {
                Site::Sphere(sphere) => Some(sphere),
                _ => None,
            });
            round.map(|sphere| (sphere, [chain.belt.clone(), format!("straps.{}_*", word(&chain.belt))]))
        });
        let mut slides = Vec::<Slide>::new();
        for (sphere, names) in loops.chain(chains).filter(|(sphere, _)| is_pelvis(*sphere)) {
            let known = slides.iter_mut().find(|slide| slide.sphere == sphere);
            if let Some(slide) = known {
                slide.belts.push(names);
                continue;
            }
            let (slider, seen_s) = (Slider::default(), setup.time.start_s);
            slides.push(Slide { sphere, slider, seen_s, off_s: None, belts: vec![names] });
        }
        Slides(slides)
    }

    pub(super) fn see(&mut self, sample: &Sample<'_>) {
        for slide in self.0.iter_mut().filter(|slide| slide.off_s.is_none()) {
            let sphere = &sample.model.body().spheres[slide.sphere];
            let force_n = sample.pull_n(slide.sphere, |pull| BELTS.contains(&pull.of));
            let own_n = sample.orientation(sphere.segment).inverse_transform_vector(&force_n);
            let time_s = sample.time_s - slide.seen_s;
            if slide.slider.go([own_n.x, own_n.z], sphere.radius_m, time_s) {
                slide.off_s = Some(sample.time_s);
            }
            slide.seen_s = sample.time_s;
        }
    }

    pub(super) fn caveats(&self, body: &Body) -> Vec<Caveat> {
        let off = self.0.iter().filter_map(|slide| Some((slide, slide.off_s?)));
        off.map(|(slide, time_s)| {
            let belts = slide.belts.iter().map(|[name, _]| name.as_str()).collect::<Vec<_>>().join(" and ");
            let figures = slide.belts.iter().map(|[_, figures]| figures.clone()).collect();
            Caveat::would_submarine(body, slide.sphere, &belts, figures, time_s)
        })
        .collect()
    }
}
