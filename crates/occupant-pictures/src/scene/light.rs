//! Light: a high lamp with soft shadows, the sky, and a grid on the ground.

use super::canvas::{Colour, Light, Paint, Piece, Spot};
use super::lens::V3;

/// Side of the map of shadows, texels.
const MAP: usize = 1024;
/// How far a shadow's edge is blurred, texels each way.
const BLUR: isize = 2;
/// How far a thing must be before another to shade it, m.
const BIAS_M: f32 = 0.012;
/// Distance at which the ground is half as clear as near the eye, m at least, and relative to that of what is looked at.
const HAZE_M: f32 = 70.0;
const HAZE: f32 = 3.0;
/// Width of the lines of the grid, m, and their spacings.
const GRID: [(f32, f32); 2] = [(0.018, 1.0), (0.05, 10.0)];
const ZENITH: Colour = [0.62, 0.72, 0.84];
const HORIZON: Colour = [0.86, 0.89, 0.92];
const LINE: Colour = [0.36, 0.38, 0.40];

/// The lamp, the shadows it throws, and where the grid's zero is.
pub(super) struct Lamp {
    /// Towards the lamp, of length 1.
    pub(super) towards: V3,
    pub(super) eye: V3,
    /// Distance of what is looked at, m.
    pub(super) away_m: f32,
    /// Place of the origin within the grid, m.
    pub(super) grid: [f32; 2],
    /// Shadows of what is solid, and of what is seen through.
    pub(super) shadows: [(Shadows, f32); 2],
}

/// Depths of the nearest things as the lamp sees them.
pub(super) struct Shadows {
    axes: [V3; 3],
    centre: V3,
    texels_m: f32,
    depth: Vec<f32>,
}

/// Squares a display's colour: its square root is taken for the picture.
pub(super) fn linear([r, g, b]: Colour) -> Colour {
    [r * r, g * g, b * b]
}

impl Shadows {
    /// Shadows of triangles within a ball.
    pub(super) fn of<'p>(towards: &V3, centre: V3, radius_m: f32, pieces: impl Iterator<Item = &'p Piece>) -> Self {
        let side = towards.cross(&V3::x()).try_normalize(1e-6).unwrap_or_else(V3::y);
        let axes = [side, side.cross(towards), *towards];
        let texels_m = 0.5 * MAP as f32 / radius_m.max(0.1);
        let mut map = Shadows { axes, centre, texels_m, depth: vec![f32::MIN; MAP * MAP] };
        for piece in pieces {
            let seen: Vec<V3> = piece.corners.iter().map(|c| map.seen(&c.place)).collect();
            for [a, b, c] in &piece.triangles {
                map.cover([seen[*a as usize], seen[*b as usize], seen[*c as usize]]);
            }
        }
        map
    }

    /// Place on the map, texels, and height towards the lamp, m.
    fn seen(&self, place: &V3) -> V3 {
        let from = place - self.centre;
        let half = 0.5 * MAP as f32;
        let [x, y] = [0, 1].map(|i| half + self.axes[i].dot(&from) * self.texels_m);
        V3::new(x, y, self.axes[2].dot(&from))
    }

    fn cover(&mut self, [a, b, c]: [V3; 3]) {
        let area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if area.is_nan() || area.abs() <= 1e-9 {
            return;
        }
        let range = |of: [f32; 3]| {
            let low = of[0].min(of[1]).min(of[2]).max(0.0) as usize;
            low..((of[0].max(of[1]).max(of[2]).max(0.0) as usize) + 1).min(MAP)
        };
        for y in range([a.y, b.y, c.y]) {
            for x in range([a.x, b.x, c.x]) {
                let (px, py) = (x as f32 + 0.5, y as f32 + 0.5);
                let edge = |p: V3, q: V3| ((q.x - p.x) * (py - p.y) - (q.y - p.y) * (px - p.x)) / area;
                let (u, v, w) = (edge(b, c), edge(c, a), edge(a, b));
                if u >= 0.0 && v >= 0.0 && w >= 0.0 {
                    let own = &mut self.depth[y * MAP + x];
                    *own = own.max(u * a.z + v * b.z + w * c.z);
                }
            }
        }
    }

    /// Share of the lamp that a place sees.
    fn lit(&self, place: &V3) -> f32 {
        let at = self.seen(place);
        let edge = BLUR as f32 + 1.0;
        let within = |x: f32| x > edge && x < MAP as f32 - edge - 1.0;
        if !within(at.x) || !within(at.y) {
            return 1.0;
        }
        let (fx, fy) = (at.x - 0.5, at.y - 0.5);
        let (x, y) = (fx as isize, fy as isize);
        let (u, v) = (fx - x as f32, fy - y as f32);
        let mut free = 0.0;
        for j in -BLUR..=BLUR + 1 {
            // the outer rows count by the place between the texels
            let row = if j == -BLUR {
                1.0 - v
            } else if j == BLUR + 1 {
                v
            } else {
                1.0
            };
            for i in -BLUR..=BLUR + 1 {
                let column = if i == -BLUR {
                    1.0 - u
                } else if i == BLUR + 1 {
                    u
                } else {
                    1.0
                };
                let depth = self.depth[(y + j) as usize * MAP + (x + i) as usize];
                free += if depth > at.z + BIAS_M { 0.0 } else { row * column };
            }
        }
        let side = 2.0 * BLUR as f32 + 1.0;
        free / (side * side)
    }
}

impl Light for Lamp {
    fn colour(&self, spot: &Spot) -> Colour {
        match spot.paint {
            Paint::Matt(colour) => self.matt(spot, colour),
            Paint::Grid(colour) => self.ground(spot, colour),
            Paint::None => [0.0; 3],
        }
    }

    fn sky(&self, ray: &V3) -> Colour {
        let rise = (ray.z / ray.norm()).clamp(0.0, 0.6) / 0.6;
        let (low, high) = (linear(HORIZON), linear(ZENITH));
        [0, 1, 2].map(|c| low[c] + rise * (high[c] - low[c]))
    }
}

impl Lamp {
    fn free(&self, place: &V3) -> f32 {
        self.shadows.iter().map(|(map, strength)| 1.0 - strength * (1.0 - map.lit(place))).product()
    }

    fn matt(&self, spot: &Spot, colour: Colour) -> Colour {
        let view = (self.eye - spot.place).try_normalize(1e-9).unwrap_or_else(V3::z);
        // both sides of a sheet are seen
        let normal = if spot.normal.dot(&view) < 0.0 && spot.normal.dot(&spot.rays[0]) > 0.0 {
            -spot.normal
        } else {
            spot.normal
        };
        let facing = normal.dot(&self.towards).max(0.0);
        let free = if facing > 0.0 { self.free(&(spot.place + normal * 0.008)) } else { 0.0 };
        let sky = 0.5 + 0.5 * normal.z;
        let head = normal.dot(&view).max(0.0);
        // what turns away from the eye is darker: the rounding of a limb is read from it
        let light = 0.10 + 0.20 * sky + 0.22 * head * head + 0.66 * facing * free;
        let half = (view + self.towards).try_normalize(1e-9).unwrap_or_else(V3::z);
        let mut shine = normal.dot(&half).max(0.0);
        (0..5).for_each(|_| shine *= shine);
        [0, 1, 2].map(|c| colour[c] * light + 0.05 * shine * free)
    }

    fn ground(&self, spot: &Spot, colour: Colour) -> Colour {
        let normal = if spot.normal.z < 0.0 { -spot.normal } else { spot.normal };
        let onto = |ray: &V3| {
            let slope = normal.dot(ray);
            let share = normal.dot(&(spot.place - self.eye)) / if slope.abs() > 1e-6 { slope } else { 1e-6 };
            self.eye + ray * share
        };
        let (right, down) = (onto(&spot.rays[1]) - spot.place, onto(&spot.rays[2]) - spot.place);
        let mut share = 0.0;
        for (width, spacing) in GRID {
            for axis in 0..2 {
                let blur = (right[axis].abs() + down[axis].abs()).clamp(1e-5, 1e3);
                let at = (spot.place[axis] + self.grid[axis]) / spacing;
                share = f32::max(share, covered(at, width / spacing, blur / spacing));
            }
        }
        let away = (spot.place - self.eye).norm();
        let clear = 1.0 / (1.0 + square(away / HAZE_M.max(HAZE * self.away_m)));
        let light =
            (0.42 + 0.58 * normal.dot(&self.towards).max(0.0) * self.free(&(spot.place + normal * 0.01))).min(1.0);
        let (line, far) = (linear(LINE), linear(HORIZON));
        let painted = |c: usize| (colour[c] + 0.7 * share * (line[c] - colour[c])) * light;
        [0, 1, 2].map(|c| far[c] + clear * (painted(c) - far[c]))
    }
}

const fn square(x: f32) -> f32 {
    x * x
}

/// Share of a pixel of width `blur` around `at` that lines of `width` at whole numbers cover.
fn covered(at: f32, width: f32, blur: f32) -> f32 {
    let blur = blur.max(1e-4);
    // integral of the lines from 0
    let upto = |x: f32| x.floor() * width + (x - x.floor()).min(width);
    let from = at + 0.5 * width - 0.5 * blur;
    ((upto(from + blur) - upto(from)) / blur).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_covers_its_share_of_a_pixel_however_wide() {
        assert!((covered(3.0, 0.02, 0.001) - 1.0).abs() < 1e-3);
        assert_eq!(covered(3.5, 0.02, 0.001), 0.0);
        assert!((covered(3.0, 0.02, 0.04) - 0.5).abs() < 1e-3);
        // many lines in one pixel are their mean
        assert!((covered(7.3, 0.02, 50.0) - 0.02).abs() < 1e-3);
    }
}
