//! Corners of surfaces → points of series 8: which corner is which point.

use std::collections::BTreeMap;

use super::Back;

/// Fields of series 8 that a polygon determines, for each assignment of its corners to the layout's.
pub(super) struct Polygon {
    pub name: String,
    pub readings: Vec<Vec<(String, String)>>,
}

/// Assignment of corners to points, which is determined only where surfaces meet: searched such that all surfaces agree
/// with one another and with the points that the notes keep of omitted surfaces.
pub(super) fn place_points(back: &mut Back<'_>, mut polygons: Vec<Polygon>) {
    polygons.retain(|p| !p.readings.is_empty());
    let mut search = Search::from_known(kept_places(back));
    let mut found = search.from(&polygons, 0);
    if !found {
        // Somebody may have changed the surfaces and not the notes.
        search = Search::from_known(BTreeMap::new());
        found = search.from(&polygons, 0);
    }
    if found {
        for (name, digits) in search.known {
            back.deck.set(&name, &digits);
        }
    } else {
        let name = polygons.get(search.deepest).map_or("", |p| p.name.as_str());
        back.misfit(format!(
            "surfaces.{name} does not meet the surfaces before it at the points that they share on cards"
        ));
    }
}

/// Fields of series 8 that the notes keep.
fn kept_places(back: &Back<'_>) -> BTreeMap<String, String> {
    let is_place = |name: &str| name.starts_with("XV(") || name.starts_with("ZV(") || name == "VCW" || name == "VRW";
    back.kept.iter().filter(|(name, _)| is_place(name)).map(|(name, digits)| (name.clone(), digits.clone())).collect()
}

/// Largest number of search steps: sufficient for any compartment whose surfaces meet.
const SEARCH_BUDGET: usize = 20_000;

struct Search {
    known: BTreeMap<String, String>,
    deepest: usize,
    budget: usize,
}

impl Search {
    fn from_known(known: BTreeMap<String, String>) -> Self {
        Self { known, deepest: 0, budget: SEARCH_BUDGET }
    }

    /// Searches for assignments of the polygons from `at` on that agree with the known fields.
    fn from(&mut self, polygons: &[Polygon], at: usize) -> bool {
        self.deepest = self.deepest.max(at);
        let Some(polygon) = polygons.get(at) else { return true };
        for reading in &polygon.readings {
            if self.budget == 0 {
                return false;
            }
            self.budget -= 1;
            let Some(added) = self.add(reading) else { continue };
            if self.from(polygons, at + 1) {
                return true;
            }
            added.iter().for_each(|name| drop(self.known.remove(name)));
        }
        false
    }

    /// Adds an assignment; `None`, and no change, if it contradicts the known fields.
    fn add(&mut self, reading: &[(String, String)]) -> Option<Vec<String>> {
        let mut added = Vec::new();
        for (name, digits) in reading {
            match self.known.get(name) {
                Some(known) if is_same_number(known, digits) => {}
                Some(_) => {
                    added.iter().for_each(|name| drop(self.known.remove(name)));
                    return None;
                }
                None => {
                    self.known.insert(name.clone(), digits.clone());
                    added.push(name.clone());
                }
            }
        }
        Some(added)
    }
}

fn is_same_number(one: &str, two: &str) -> bool {
    one == two || matches!((one.parse::<f64>(), two.parse::<f64>()), (Ok(a), Ok(b)) if a == b)
}
