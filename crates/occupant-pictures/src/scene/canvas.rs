//! A depth buffer of our own: triangles by their nearest sample, four samples a pixel, in bands of rows that threads share.
//!
//! An offscreen context of a graphics library would need a driver that servers and continuous integration lack; a general
//! rasteriser would bring more code than these lines. Each pixel depends on the scene alone, so the bits do not depend on
//! the number of threads.

use rayon::prelude::*;

use super::lens::{Frustum, V3};

/// Rows of a band.
const ROWS: usize = 16;
/// Places of the samples in a pixel: a turned square, so that near-level and near-upright edges get four shades.
const SAMPLES: [[f32; 2]; 4] = [[-0.125, -0.375], [0.375, -0.125], [0.125, 0.375], [-0.375, 0.125]];
/// Sample without a triangle.
const NOTHING: u32 = u32::MAX;

/// Largest number of ghosts, and how much of what is behind them they cover.
pub(super) const MOST_GHOSTS: usize = 3;
const OPACITY: f32 = 0.5;
/// How much nearer to the eye a ghost must be to be seen, m: bodies in the same place would be speckled.
const BEFORE_M: f32 = 3e-3;

/// A colour, linear, 0 to 1.
pub(super) type Colour = [f32; 3];

/// A corner: relative to the scene's origin, with its normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Corner {
    pub(super) place: V3,
    pub(super) normal: V3,
}

/// Triangles of one thing.
#[derive(Clone, Debug, Default)]
pub(super) struct Piece {
    pub(super) corners: Vec<Corner>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) paint: Paint,
    /// How much nearer to the eye it counts, m: what lies on a skin stays above it.
    pub(super) before_m: f32,
}

/// How a thing is painted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Paint {
    /// Of one colour, lit.
    Matt(Colour),
    /// Ground with a grid of metres.
    Grid(Colour),
    /// Nothing seen.
    #[default]
    None,
}

/// What is blended over the picture, farthest first.
#[derive(Clone, Debug)]
pub(super) enum Veil {
    /// A flat polygon.
    Sheet { corners: Vec<V3>, colour: Colour, opacity: f32 },
    /// A line of this many pixels.
    Line { ends: [V3; 2], colour: Colour, opacity: f32, pixels: f32 },
}

/// A point of a surface that is painted.
pub(super) struct Spot {
    pub(super) place: V3,
    pub(super) normal: V3,
    pub(super) paint: Paint,
    /// Direction from the eye, one unit forward, and the same one pixel to the right and down.
    pub(super) rays: [V3; 3],
}

/// What gives a point its colour, and the sky behind everything.
pub(super) trait Light: Sync {
    fn colour(&self, spot: &Spot) -> Colour;
    fn sky(&self, ray: &V3) -> Colour;
}

/// A triangle on the picture: pixels and 1/distance of its corners, and their normals divided by the distance.
struct Flat {
    at: [[f32; 2]; 3],
    inverse: [f32; 3],
    normals: [V3; 3],
    piece: u32,
}

/// A veil on the picture.
struct FlatVeil {
    far: f32,
    rows: [f32; 2],
    look: Look,
    colour: Colour,
    opacity: f32,
}

enum Look {
    Triangles(Vec<Flat>),
    Line([[f32; 2]; 2], [f32; 2], f32),
}

/// Things laid on the picture: their triangles, and which of them each band of rows has.
struct Laid<'p> {
    pieces: &'p [Piece],
    flat: Vec<Flat>,
    bins: Vec<Vec<u32>>,
}

impl<'p> Laid<'p> {
    fn of(lens: &Frustum, pieces: &'p [Piece]) -> Self {
        let parts: Vec<Vec<Flat>> =
            pieces.par_iter().enumerate().map(|(i, piece)| flattened(lens, piece, i as u32)).collect();
        let flat: Vec<Flat> = parts.into_iter().flatten().collect();
        let bands = lens.size[1].div_ceil(ROWS);
        let mut bins: Vec<Vec<u32>> = vec![Vec::new(); bands];
        for (i, triangle) in flat.iter().enumerate() {
            let [low, high] = span(triangle.at.map(|p| p[1]));
            let last = (high.max(0.0) as usize / ROWS).min(bands.saturating_sub(1));
            for bin in bins.iter_mut().take(last + 1).skip(low.max(0.0) as usize / ROWS) {
                bin.push(i as u32);
            }
        }
        Laid { pieces, flat, bins }
    }

    /// The samples of a band of so many rows.
    fn band(&self, width: usize, band: usize, rows: usize) -> Band {
        let mut own = Band::new(width, band * ROWS, rows);
        self.bins[band].iter().for_each(|i| own.cover(&self.flat[*i as usize], *i));
        own
    }
}

/// The picture, row by row, red, green, blue, 0 to 255: pieces, over them translucent ghosts, of each what is nearest, and
/// veils before and behind both.
pub(super) fn paint(
    lens: &Frustum,
    pieces: &[Piece],
    ghosts: &[Vec<Piece>],
    veils: &[Veil],
    light: &dyn Light,
) -> Vec<[u8; 3]> {
    let [width, height] = lens.size;
    let laid_pieces = Laid::of(lens, pieces);
    let ghosts: Vec<Laid<'_>> = ghosts.iter().take(MOST_GHOSTS).map(|own| Laid::of(lens, own)).collect();
    let mut over: Vec<FlatVeil> = veils.iter().filter_map(|veil| laid(lens, veil)).collect();
    over.sort_by(|a, b| b.far.total_cmp(&a.far));
    let mut pixels = vec![[0; 3]; width * height];
    pixels.par_chunks_mut(width * ROWS).enumerate().for_each(|(band, rows)| {
        let count = rows.len() / width;
        let mut own = laid_pieces.band(width, band, count);
        let mut colours = own.resolve(lens, &laid_pieces, light);
        if ghosts.iter().any(|ghost| !ghost.bins[band].is_empty()) {
            let bands: Vec<Band> = ghosts.iter().map(|ghost| ghost.band(width, band, count)).collect();
            let nearest = own.nearest(&bands);
            over.iter().for_each(|veil| own.blend(&mut colours, veil, Some(&nearest)));
            own.haunt(&mut colours, lens, &ghosts, &bands, light);
            own.near = nearest;
        }
        over.iter().for_each(|veil| own.blend(&mut colours, veil, None));
        for (pixel, colour) in rows.iter_mut().zip(&colours) {
            *pixel = colour.map(|c| (c.clamp(0.0, 1.0).sqrt() * 255.0 + 0.5) as u8);
        }
    });
    pixels
}

/// Samples of some rows.
struct Band {
    width: usize,
    top: usize,
    rows: usize,
    /// 1/distance of the nearest triangle, and which it is.
    near: Vec<[f32; 4]>,
    what: Vec<[u32; 4]>,
}

impl Band {
    fn new(width: usize, top: usize, rows: usize) -> Self {
        let count = width * rows;
        Band { width, top, rows, near: vec![[0.0; 4]; count], what: vec![[NOTHING; 4]; count] }
    }

    /// Calls `hit` with each pixel that a triangle covers and 1/distance at its samples, 0 where it does not cover them.
    #[inline(always)]
    fn each(&self, flat: &Flat, mut hit: impl FnMut(usize, [f32; 4])) {
        let Some(plane) = Plane::of(flat) else { return };
        let [left, right] = span(flat.at.map(|p| p[0]));
        let [low, high] = span(flat.at.map(|p| p[1]));
        let columns = left.max(0.0) as usize..((right.max(0.0) as usize) + 1).min(self.width);
        let first = (low.max(0.0) as usize).max(self.top);
        let last = ((high.max(0.0) as usize) + 1).min(self.top + self.rows);
        for y in first..last {
            let row = (y - self.top) * self.width;
            for x in columns.clone() {
                let centre = [x as f32 + 0.5, y as f32 + 0.5];
                let at = plane.shares(centre);
                // wholly outside of one side
                if (0..3).any(|i| at[i] < -plane.reach[i]) {
                    continue;
                }
                let samples = SAMPLES.map(|offset| {
                    let own = plane.moved(at, offset);
                    let within = own[0] >= 0.0 && own[1] >= 0.0 && own[2] >= 0.0;
                    if within { plane.inverse(flat, own) } else { 0.0 }
                });
                hit(row + x, samples);
            }
        }
    }

    fn cover(&mut self, flat: &Flat, id: u32) {
        let (mut near, mut what) = (std::mem::take(&mut self.near), std::mem::take(&mut self.what));
        self.each(flat, |pixel, samples| {
            for (sample, inverse) in samples.into_iter().enumerate() {
                if inverse > near[pixel][sample] {
                    near[pixel][sample] = inverse;
                    what[pixel][sample] = id;
                }
            }
        });
        (self.near, self.what) = (near, what);
    }

    /// Colour of each pixel: once where all samples show one thing, else sample by sample.
    fn resolve(&self, lens: &Frustum, laid: &Laid<'_>, light: &dyn Light) -> Vec<Colour> {
        (0..self.what.len()).map(|pixel| self.shade(pixel, [true; 4], lens, laid, light)).collect()
    }

    /// Mean colour of some samples of a pixel.
    fn shade(&self, pixel: usize, seen: [bool; 4], lens: &Frustum, laid: &Laid<'_>, light: &dyn Light) -> Colour {
        let of = |id: u32, x: f32, y: f32| match laid.flat.get(id as usize) {
            Some(triangle) => light.colour(&spot(lens, laid.pieces, triangle, [x, y])),
            None => light.sky(&lens.ray(x, y)),
        };
        let piece = |id: u32| laid.flat.get(id as usize).map_or(NOTHING, |triangle| triangle.piece);
        let (x, y) = ((pixel % self.width) as f32 + 0.5, (self.top + pixel / self.width) as f32 + 0.5);
        let what = &self.what[pixel];
        let first = piece(what[0]);
        if seen == [true; 4] && what.iter().all(|id| piece(*id) == first) {
            return of(what[0], x, y);
        }
        let share = 1.0 / seen.iter().filter(|own| **own).count().max(1) as f32;
        let mut sum = [0.0; 3];
        for ((id, [right, down]), _) in what.iter().zip(SAMPLES).zip(seen).filter(|(_, seen)| *seen) {
            let own = of(*id, x + right, y + down);
            (0..3).for_each(|c| sum[c] += share * own[c]);
        }
        sum
    }

    /// 1/distance of what is nearest among this band and others.
    fn nearest(&self, others: &[Band]) -> Vec<[f32; 4]> {
        let mut near = self.near.clone();
        for (all, own) in others.iter().flat_map(|other| other.near.iter().enumerate()) {
            (0..4).for_each(|sample| near[all][sample] = near[all][sample].max(own[sample]));
        }
        near
    }

    /// Blends ghosts over what is behind them, the farthest first.
    fn haunt(&self, colours: &mut [Colour], lens: &Frustum, ghosts: &[Laid<'_>], bands: &[Band], light: &dyn Light) {
        for (pixel, colour) in colours.iter_mut().enumerate() {
            let mut order: [(f32, usize); MOST_GHOSTS] = std::array::from_fn(|ghost| {
                let near = bands.get(ghost).map_or([0.0; 4], |band| band.near[pixel]);
                (near.into_iter().fold(0.0, f32::max), ghost)
            });
            order.sort_by(|a, b| a.0.total_cmp(&b.0));
            for (_, ghost) in order.into_iter().filter(|(near, _)| *near > 0.0) {
                let seen = [0, 1, 2, 3].map(|s| {
                    let near = self.near[pixel][s];
                    bands[ghost].near[pixel][s] > near + BEFORE_M * near * near
                });
                let share = OPACITY * 0.25 * seen.iter().filter(|own| **own).count() as f32;
                if share > 0.0 {
                    let own = bands[ghost].shade(pixel, seen, lens, &ghosts[ghost], light);
                    (0..3).for_each(|c| colour[c] += share * (own[c] - colour[c]));
                }
            }
        }
    }

    /// Blends a veil over the samples that it is before; with `upto`, of those alone that it is not before there.
    fn blend(&self, colours: &mut [Colour], veil: &FlatVeil, upto: Option<&Vec<[f32; 4]>>) {
        let (top, bottom) = (self.top as f32, (self.top + self.rows) as f32);
        if veil.rows[1] < top || veil.rows[0] > bottom {
            return;
        }
        let free = |pixel: usize, own: [f32; 4]| {
            let is_free =
                |s: &usize| own[*s] > self.near[pixel][*s] && upto.is_none_or(|upto| own[*s] <= upto[pixel][*s]);
            (0..4).filter(is_free).count()
        };
        let mut mix = |pixel: usize, share: f32| {
            let colour = &mut colours[pixel];
            (0..3).for_each(|c| colour[c] += share * veil.opacity * (veil.colour[c] - colour[c]));
        };
        match &veil.look {
            Look::Triangles(all) => {
                for flat in all {
                    self.each(flat, |pixel, samples| {
                        let free = free(pixel, samples);
                        if free > 0 {
                            mix(pixel, 0.25 * free as f32);
                        }
                    });
                }
            }
            Look::Line(ends, inverse, pixels) => self.stroke(*ends, *inverse, *pixels, free, mix),
        }
    }

    fn stroke(
        &self,
        [a, b]: [[f32; 2]; 2],
        inverse: [f32; 2],
        pixels: f32,
        free: impl Fn(usize, [f32; 4]) -> usize,
        mut mix: impl FnMut(usize, f32),
    ) {
        let half = 0.5 * pixels.max(1.0);
        let faint = pixels.min(1.0);
        let along = [b[0] - a[0], b[1] - a[1]];
        let square = along[0] * along[0] + along[1] * along[1];
        let low = (a[1].min(b[1]) - half - 1.0).max(self.top as f32) as usize;
        let high = ((a[1].max(b[1]) + half + 1.0).max(0.0) as usize + 1).min(self.top + self.rows);
        for y in low..high {
            // the part of the line near this row
            let row = y as f32 + 0.5;
            let reach = half + 1.5;
            let part = |edge: f32| if along[1].abs() > 1e-3 { (edge - a[1]) / along[1] } else { edge - row };
            let [from, to] = if along[1].abs() > 1e-3 {
                let [p, q] = [part(row - reach), part(row + reach)];
                [p.min(q).clamp(0.0, 1.0), p.max(q).clamp(0.0, 1.0)]
            } else {
                [0.0, 1.0]
            };
            let [p, q] = [a[0] + from * along[0], a[0] + to * along[0]];
            let left = (p.min(q) - half - 1.0).max(0.0) as usize;
            let right = ((p.max(q) + half + 1.0).max(0.0) as usize + 1).min(self.width);
            for x in left..right {
                let from = [x as f32 + 0.5 - a[0], row - a[1]];
                let share = ((from[0] * along[0] + from[1] * along[1]) / square.max(1e-12)).clamp(0.0, 1.0);
                let off = [from[0] - share * along[0], from[1] - share * along[1]];
                let distance = (off[0] * off[0] + off[1] * off[1]).sqrt();
                let covered = (half + 0.5 - distance).clamp(0.0, 1.0) * faint;
                if covered > 0.0 {
                    let pixel = (y - self.top) * self.width + x;
                    let own = (inverse[0] + share * (inverse[1] - inverse[0])) * 1.002;
                    mix(pixel, covered * 0.25 * free(pixel, [own; 4]) as f32);
                }
            }
        }
    }
}

/// Edge functions of a triangle, 1 at the corner opposite to each side.
struct Plane {
    from: [[f32; 2]; 3],
    slope: [[f32; 2]; 3],
    /// Largest change between a pixel's middle and its samples.
    reach: [f32; 3],
}

impl Plane {
    fn of(flat: &Flat) -> Option<Self> {
        let [a, b, c] = flat.at;
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area.is_nan() || area.abs() <= 1e-12 {
            return None;
        }
        let from = [b, c, a];
        let to = [c, a, b];
        let slope = [0, 1, 2].map(|i| [-(to[i][1] - from[i][1]) / area, (to[i][0] - from[i][0]) / area]);
        let reach = slope.map(|[x, y]| 0.375 * (x.abs() + y.abs()));
        Some(Plane { from, slope, reach })
    }

    /// Shares of the three corners at a place.
    #[inline(always)]
    fn shares(&self, at: [f32; 2]) -> [f32; 3] {
        let one = |i: usize| self.moved_one(i, [at[0] - self.from[i][0], at[1] - self.from[i][1]]);
        [one(0), one(1), one(2)]
    }

    #[inline(always)]
    fn moved_one(&self, i: usize, by: [f32; 2]) -> f32 {
        self.slope[i][0] * by[0] + self.slope[i][1] * by[1]
    }

    #[inline(always)]
    fn moved(&self, at: [f32; 3], by: [f32; 2]) -> [f32; 3] {
        [at[0] + self.moved_one(0, by), at[1] + self.moved_one(1, by), at[2] + self.moved_one(2, by)]
    }

    #[inline(always)]
    fn inverse(&self, flat: &Flat, shares: [f32; 3]) -> f32 {
        shares[0] * flat.inverse[0] + shares[1] * flat.inverse[1] + shares[2] * flat.inverse[2]
    }
}

/// The point of a triangle on a pixel.
fn spot(lens: &Frustum, pieces: &[Piece], flat: &Flat, [x, y]: [f32; 2]) -> Spot {
    let rays = [lens.ray(x, y), lens.ray(x + 1.0, y), lens.ray(x, y + 1.0)];
    let shares = Plane::of(flat).map_or([1.0, 0.0, 0.0], |plane| plane.shares([x, y]));
    let inverse: f32 = (0..3).map(|i| shares[i] * flat.inverse[i]).sum();
    let normal = flat.normals[0] * shares[0] + flat.normals[1] * shares[1] + flat.normals[2] * shares[2];
    let piece = &pieces[flat.piece as usize];
    let away = 1.0 / inverse.max(1e-9) + piece.before_m;
    Spot {
        place: lens.eye + rays[0] * away,
        normal: normal.try_normalize(1e-12).unwrap_or_else(V3::z),
        paint: piece.paint,
        rays,
    }
}

fn span(of: [f32; 3]) -> [f32; 2] {
    [of[0].min(of[1]).min(of[2]), of[0].max(of[1]).max(of[2])]
}

/// The triangles of a piece on the picture, cut at its edges.
fn flattened(lens: &Frustum, piece: &Piece, id: u32) -> Vec<Flat> {
    let seen: Vec<Corner> =
        piece.corners.iter().map(|c| Corner { place: lens.seen(&c.place), normal: c.normal }).collect();
    let planes = lens.planes();
    let mut all = Vec::with_capacity(piece.triangles.len());
    for triangle in &piece.triangles {
        let Some(corners) = corners_of(&seen, triangle) else { continue };
        fan(lens, &planes, corners, id, piece.before_m, &mut all);
    }
    all
}

fn corners_of(seen: &[Corner], triangle: &[u32; 3]) -> Option<[Corner; 3]> {
    let at = |i: u32| seen.get(i as usize).copied().filter(|c| c.place.sum().is_finite());
    Some([at(triangle[0])?, at(triangle[1])?, at(triangle[2])?])
}

/// Cuts a triangle at the planes and lays what is left on the picture.
fn fan(lens: &Frustum, planes: &[(V3, f32); 5], corners: [Corner; 3], piece: u32, before_m: f32, all: &mut Vec<Flat>) {
    let beyond = |(normal, from): &(V3, f32), c: &Corner| normal.dot(&c.place) - from;
    let flat = |c: [Corner; 3]| {
        let inverse = c.map(|c| 1.0 / (c.place.z - before_m).max(0.5 * super::lens::NEAR_M));
        let normals = [0, 1, 2].map(|i| c[i].normal * inverse[i]);
        Flat { at: c.map(|c| lens.pixel(&c.place)), inverse, normals, piece }
    };
    if planes.iter().all(|plane| corners.iter().all(|c| beyond(plane, c) >= 0.0)) {
        return all.push(flat(corners));
    }
    let mut polygon = corners.to_vec();
    for plane in planes {
        polygon = cut(&polygon, |c| beyond(plane, c));
    }
    for i in 2..polygon.len() {
        all.push(flat([polygon[0], polygon[i - 1], polygon[i]]));
    }
}

/// The part of a convex polygon where `inside` is not negative.
fn cut(polygon: &[Corner], inside: impl Fn(&Corner) -> f32) -> Vec<Corner> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, to) in polygon.iter().enumerate() {
        let from = &polygon[(i + polygon.len() - 1) % polygon.len()];
        let (before, after) = (inside(from), inside(to));
        if before * after < 0.0 {
            let share = before / (before - after);
            let between = |a: &V3, b: &V3| a + (b - a) * share;
            let (place, normal) = (between(&from.place, &to.place), between(&from.normal, &to.normal));
            kept.push(Corner { place, normal });
        }
        if after >= 0.0 {
            kept.push(*to);
        }
    }
    kept
}

/// A veil on the picture; none if nothing of it is before the lens.
fn laid(lens: &Frustum, veil: &Veil) -> Option<FlatVeil> {
    let planes = lens.planes();
    let cut_all = |corners: &[V3]| {
        let seen = corners.iter().map(|c| Corner { place: lens.seen(c), normal: V3::zeros() }).collect::<Vec<_>>();
        let sound = seen.iter().all(|c| c.place.sum().is_finite());
        let inside = |plane: &(V3, f32), c: &Corner| plane.0.dot(&c.place) - plane.1;
        if sound { planes.iter().fold(seen, |left, plane| cut(&left, |c| inside(plane, c))) } else { Vec::new() }
    };
    let far = |corners: &[Corner]| corners.iter().map(|c| c.place.z).sum::<f32>() / corners.len() as f32;
    let rows = |at: &mut dyn Iterator<Item = f32>| at.fold([f32::MAX, f32::MIN], |[l, h], y| [l.min(y), h.max(y)]);
    match veil {
        Veil::Sheet { corners, colour, opacity } => {
            let left = cut_all(corners);
            let flat = |c: [Corner; 3]| Flat {
                at: c.map(|c| lens.pixel(&c.place)),
                inverse: c.map(|c| 1.0 / c.place.z),
                normals: [V3::zeros(); 3],
                piece: NOTHING,
            };
            let all: Vec<Flat> = (2..left.len()).map(|i| flat([left[0], left[i - 1], left[i]])).collect();
            let rows = rows(&mut all.iter().flat_map(|f| f.at).map(|p| p[1]));
            let look = Look::Triangles(all);
            (left.len() > 2).then(|| FlatVeil { far: far(&left), rows, look, colour: *colour, opacity: *opacity })
        }
        Veil::Line { ends, colour, opacity, pixels } => {
            // a line is a triangle without width; cutting keeps its two ends
            let left = cut_all(&[ends[0], ends[1]]);
            let (first, last) = (left.first()?, left.iter().find(|c| c.place != left[0].place)?);
            let at = [first, last].map(|c| lens.pixel(&c.place));
            let inverse = [first, last].map(|c| 1.0 / c.place.z);
            let [low, high] = rows(&mut at.iter().map(|p| p[1]));
            let look = Look::Line(at, inverse, *pixels);
            let rows = [low - pixels - 1.0, high + pixels + 1.0];
            Some(FlatVeil { far: far(&left) - 1e-3, rows, look, colour: *colour, opacity: *opacity })
        }
    }
}
