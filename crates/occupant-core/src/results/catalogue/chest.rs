//! Deformable chests: deflections, their share of the depth, the viscous response.

use occupant_units::unit::Unit;

use super::{Catalogue, Source};
use crate::body::{Chest, Shares, called};
use crate::quantity::{Axes, Value};
use crate::results::channel::{Channel, Component};
use crate::results::sample::Sample;

/// s and ṡ summed over plates with their shares.
fn moved(sample: &Sample<'_>, shares: &Shares) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for (plate, share) in shares {
        let own = sample.actions.plates.get(*plate).map_or([f64::NAN; 2], |own| [own.deflection, own.speed]);
        sum = [sum[0] + share * own[0], sum[1] + share * own[1]];
    }
    sum
}

impl Catalogue {
    /// Channels of a chest.
    pub(super) fn chest(&mut self, chest: &Chest) {
        let breastbone = vec![(chest.breastbone, 1.0)];
        let (depth_m, scale) = (chest.depth_m, chest.viscous_scale);
        self.of_chest(chest, "deflection", Unit::Metre, "deflection of the sternum", &breastbone, |[s, _]| s);
        let share = "deflection of the sternum as a share of the chest's depth";
        self.of_chest(chest, "compression", Unit::One, share, &breastbone, move |[s, _]| s / depth_m);
        let viscous = "scale factor times speed times share of depth of the sternum's deflection, unfiltered";
        self.of_chest(chest, "viscous", Unit::MetrePerSecond, viscous, &breastbone, move |[s, speed]| {
            scale * speed * s / depth_m
        });
        for (point, shares) in &chest.points {
            let meaning = format!("deflection of the {} ribs", point.replace('_', " "));
            self.of_chest(chest, &format!("{point}.deflection"), Unit::Metre, &meaning, shares, |[s, _]| s);
        }
    }

    fn of_chest(
        &mut self,
        chest: &Chest,
        name: &str,
        unit: Unit,
        meaning: &str,
        shares: &Shares,
        value: impl Fn([f64; 2]) -> f64 + Send + Sync + 'static,
    ) {
        let shares = shares.clone();
        self.channels.push(Channel {
            name: format!("{}.{name}", called(&chest.of, "chest")),
            unit,
            axes: Axes::None,
            meaning: format!("{meaning}, inward positive"),
            source: Source::new(move |sample| Value::Number(value(moved(sample, &shares)))),
            component: Component::X,
            of: self.of,
        });
    }
}
