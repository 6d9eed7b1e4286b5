//! One panel: the body in the compartment at one moment from one side.
//!
//! Painted from the back to the front: surfaces behind the body, the body's parts by depth, then what must never be
//! hidden: bags and lines of force elements, surfaces before the body (as dashed outlines), contacts.

use nalgebra::Point3;
use occupant_units::trig;

use super::Strip;
use super::hull::outline;
use super::projection::View;
use crate::body::{Part, Snapshot, Tone};
use crate::svg::{Svg, number};

/// Normal component towards the viewer below which a surface is drawn as a line.
const EDGE_ON: f64 = 0.02;
/// Colours of the drawing.
pub const SURFACE: &str = "#5b6770";
/// A line under tension.
pub const TAUT: &str = "#c2410c";
/// A slack line.
pub const SLACK: &str = "#8a8a8a";
/// Sections of bags.
pub const BAG: &str = "#7c6f9c";
/// Contact points and forces.
pub const CONTACT: &str = "#be123c";
/// Length of an arrow's head relative to its width.
const SLENDER: f64 = 2.2;

/// Data of a panel besides its moment.
pub struct Pen<'a> {
    /// Its strip.
    pub strip: &'a Strip<'a>,
    /// The parts of the body.
    pub parts: &'a [Part],
    /// User units per metre.
    pub scale: f64,
    /// User units per newton; none without contacts.
    pub per_n: Option<f64>,
}

/// Converts picture coordinates to the sheet's.
#[derive(Clone, Copy)]
struct Place {
    view: View,
    scale: f64,
    /// Sheet position of the picture's origin.
    origin: [f64; 2],
}

impl Place {
    fn flat(&self, p: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| self.origin[i] + self.scale * p[i])
    }

    fn of(&self, p: &Point3<f64>) -> [f64; 2] {
        self.flat(self.view.place(p))
    }

    fn all(&self, points: &[Point3<f64>]) -> Vec<[f64; 2]> {
        points.iter().map(|p| self.of(p)).collect()
    }
}

/// Draws a panel; `corner` is the sheet position of the picture point `corner_m`.
pub fn draw(svg: &mut Svg, pen: &Pen<'_>, moment: &Snapshot, view: View, corner: [f64; 2], corner_m: [f64; 2]) {
    let place = Place { view, scale: pen.scale, origin: [0, 1].map(|i| corner[i] - pen.scale * corner_m[i]) };
    let (before, behind) = surfaces(pen, moment, view);
    for corners in moment.relief_m(pen.strip.model) {
        let look = format!("fill=\"{SURFACE}\" fill-opacity=\"0.04\" stroke=\"{SURFACE}\" stroke-width=\"0.2\"");
        svg.polygon(&place.all(&corners), &look);
    }
    for corners in &behind {
        draw_surface(svg, &place, corners, false);
    }
    draw_body(svg, &place, pen, moment);
    draw_spheres(svg, &place, pen, moment);
    draw_sections(svg, &place, moment);
    draw_lines(svg, &place, moment);
    for corners in &before {
        draw_surface(svg, &place, corners, true);
    }
    draw_contacts(svg, &place, pen, moment);
}

/// A surface, or a face of a solid.
type Polygon = Vec<Point3<f64>>;

/// Surfaces in front of the pelvis (or of the first segment, without one), and the others.
fn surfaces(pen: &Pen<'_>, moment: &Snapshot, view: View) -> (Vec<Polygon>, Vec<Polygon>) {
    let at = pen.strip.model.body().tree.landmarks().pelvis.map_or(0, |pelvis| pelvis.index());
    let pelvis = moment.poses[at].translation.vector;
    let own = view.depth(&pelvis.into());
    moment.polygons_m(pen.strip.model).into_iter().partition(|corners| {
        let sum: f64 = corners.iter().map(|c| view.depth(c)).sum();
        sum / corners.len() as f64 > own
    })
}

fn draw_surface(svg: &mut Svg, place: &Place, corners: &[Point3<f64>], before: bool) {
    let points = place.all(corners);
    let (a, b) = (corners[1] - corners[0], corners[2] - corners[0]);
    let normal = a.cross(&b);
    let towards = place.view.turn(normal).z / normal.norm().max(1e-12);
    if towards.abs() < EDGE_ON {
        let (from, to) = farthest(&points);
        let line = format!("stroke=\"{SURFACE}\" stroke-width=\"1.6\" stroke-linecap=\"round\"");
        return svg.segment(from, to, &line);
    }
    let look = if before {
        format!("fill=\"none\" stroke=\"{SURFACE}\" stroke-width=\"0.6\" stroke-dasharray=\"3 2\"")
    } else {
        format!("fill=\"{SURFACE}\" fill-opacity=\"0.08\" stroke=\"{SURFACE}\" stroke-width=\"0.7\"")
    };
    svg.polygon(&points, &look);
}

/// The two points farthest apart.
fn farthest(points: &[[f64; 2]]) -> ([f64; 2], [f64; 2]) {
    let mut found = ([0.0; 2], [0.0; 2]);
    let mut most = -1.0;
    for (i, a) in points.iter().enumerate() {
        for b in &points[i + 1..] {
            let distance = trig::hypot(a[0] - b[0], a[1] - b[1]);
            if distance > most {
                (most, found) = (distance, (*a, *b));
            }
        }
    }
    found
}

fn draw_body(svg: &mut Svg, place: &Place, pen: &Pen<'_>, moment: &Snapshot) {
    let depth = |part: &Part| {
        let pose = &moment.poses[part.segment.index()];
        let ends = part.ends.map(|e| place.view.depth(&(pose * Point3::from(e.centre_m))));
        0.5 * (ends[0] + ends[1])
    };
    let mut order: Vec<(f64, &Part)> = pen.parts.iter().map(|p| (depth(p), p)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    svg.begin("stroke=\"#2b2f36\" stroke-width=\"0.7\" stroke-linejoin=\"round\"");
    for (_, part) in order {
        let pose = &moment.poses[part.segment.index()];
        let points: Vec<_> = { outline(part, pose, place.view).into_iter() }.map(|p| place.flat(p)).collect();
        svg.polygon(&points, &format!("fill=\"{}\"", fill(part.tone)));
    }
    svg.end();
}

const fn fill(tone: Tone) -> &'static str {
    match tone {
        Tone::Skin => "#e9c4a6",
        Tone::Shirt => "#8fb0cf",
        Tone::Trousers => "#a9afb9",
    }
}

fn draw_spheres(svg: &mut Svg, place: &Place, pen: &Pen<'_>, moment: &Snapshot) {
    svg.begin("fill=\"none\" stroke=\"#2b2f36\" stroke-opacity=\"0.45\" stroke-width=\"0.5\"");
    for (sphere, centre) in pen.strip.model.body().spheres.iter().zip(&moment.spheres_m) {
        svg.circle(place.of(centre), place.scale * sphere.radius_m, "");
    }
    svg.end();
}

/// Draws sections of bags, transparent so that the body stays visible.
fn draw_sections(svg: &mut Svg, place: &Place, moment: &Snapshot) {
    let look = format!("fill=\"{BAG}\" fill-opacity=\"0.12\" stroke=\"{BAG}\" stroke-width=\"0.7\"");
    for section in &moment.sections {
        svg.polygon(&place.all(&section.corners_m), &look);
    }
}

fn draw_lines(svg: &mut Svg, place: &Place, moment: &Snapshot) {
    for line in &moment.lines {
        let points = place.all(&line.points_m);
        let color = if line.force_n > 0.0 { TAUT } else { SLACK };
        let style = format!(
            "fill=\"none\" stroke=\"{color}\" stroke-width=\"1.8\" stroke-opacity=\"0.9\" stroke-linejoin=\"round\""
        );
        svg.polyline(&points, &style);
        for end in [points.first(), points.last()].into_iter().flatten() {
            svg.circle(*end, 2.2, &format!("fill=\"{color}\""));
        }
    }
}

fn draw_contacts(svg: &mut Svg, place: &Place, pen: &Pen<'_>, moment: &Snapshot) {
    for contact in &moment.contacts {
        let from = place.of(&contact.point_m);
        svg.circle(from, 1.7, &format!("fill=\"{CONTACT}\""));
        if let Some(per_n) = pen.per_n {
            let along = place.view.turn(contact.force_n) * per_n;
            arrow(svg, from, [from[0] + along.x, from[1] + along.y], CONTACT);
        }
    }
}

/// An arrow; left out if shorter than its head.
pub fn arrow(svg: &mut Svg, from: [f64; 2], to: [f64; 2], color: &str) {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = trig::hypot(along[0], along[1]);
    let head = 6.0_f64.min(0.5 * length);
    if length < 3.0 {
        return;
    }
    let unit = along.map(|c| c / length);
    let base = [0, 1].map(|i| to[i] - head * unit[i]);
    svg.segment(from, base, &format!("stroke=\"{color}\" stroke-width=\"1.3\""));
    let half = head / SLENDER;
    let corner = |side: f64| [base[0] - side * half * unit[1], base[1] + side * half * unit[0]];
    let [a, b] = [corner(1.0), corner(-1.0)];
    let [x, y, ax, ay, bx, by] = [to[0], to[1], a[0], a[1], b[0], b[1]].map(number);
    svg.path(&format!("M{x} {y}L{ax} {ay}L{bx} {by}Z"), &format!("fill=\"{color}\""));
}
