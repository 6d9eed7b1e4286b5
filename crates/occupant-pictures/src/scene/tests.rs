//! Proofs of the renderer: closed forms, order of depth, the same bits for any number of threads, hostile cameras.

use std::f64::consts::PI;

use nalgebra::{Point3, Rotation3, Vector3};
use occupant_core::body::Body;
use occupant_core::body::tti12::TTI12;
use occupant_core::forces::contact::surface::Frame as Axes;
use occupant_core::forces::joint::Joints;
use occupant_core::model::{Model, seating::InitialPosture, setup::SetupBuilder};
use occupant_core::motion::report_coordinates::{DOF, ReportCoordinates};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_core::vehicle::{FrameMotion, VehiclePath};
use resvg::tiny_skia::{Color, Pixmap};

use super::canvas::{Colour, Corner, Light, Paint, Piece, Spot, Veil, paint};
use super::lens::{Lens, V3};
use super::stage::in_space;
use super::{Camera, MOST_GHOSTS, Photograph, Scene, Shown, abreast, photograph};
use crate::body::{Lump, Snapshot};
use crate::film::Frame;
use crate::mesh::{FINE, hull};

/// Each thing in its own colour, on black.
struct Plain;

impl Light for Plain {
    fn colour(&self, spot: &Spot) -> Colour {
        match spot.paint {
            Paint::Matt(colour) | Paint::Grid(colour) => colour,
            Paint::None => [0.0; 3],
        }
    }

    fn sky(&self, _: &V3) -> Colour {
        [0.0; 3]
    }
}

const RED: Colour = [1.0, 0.0, 0.0];
const BLUE: Colour = [0.0, 0.0, 1.0];

fn ahead(height_rad: f64) -> Lens {
    Lens { eye_m: Point3::origin(), target_m: Point3::new(1.0, 0.0, 0.0), up: Vector3::z(), height_rad }
}

fn sphere(centre_m: Vector3<f64>, radius_m: f64, colour: Colour) -> Piece {
    let ball = Lump { centre_m, half_m: Vector3::repeat(radius_m) };
    let mesh = hull(&[ball, ball], FINE);
    let corner =
        |(place, normal): (&[f32; 3], &[f32; 3])| Corner { place: V3::from(*place), normal: V3::from(*normal) };
    let corners = mesh.corners.iter().zip(&mesh.normals).map(corner).collect();
    Piece { corners, triangles: mesh.triangles, paint: Paint::Matt(colour), before_m: 0.0 }
}

fn picture(lens: &Lens, size: [usize; 2], pieces: &[Piece], veils: &[Veil]) -> Vec<[u8; 3]> {
    haunted(lens, size, pieces, &[], veils)
}

fn haunted(lens: &Lens, size: [usize; 2], pieces: &[Piece], ghosts: &[Vec<Piece>], veils: &[Veil]) -> Vec<[u8; 3]> {
    paint(&lens.before(&Vector3::zeros(), size), pieces, ghosts, veils, &Plain)
}

/// A point at the distance d, a to the left and h above, is at w/2 − f a/d, H/2 − f h/d, with f = H/2 / tan(angle/2).
#[test]
fn a_point_is_projected_by_the_closed_form() {
    let frustum = ahead(1.0).before(&Vector3::zeros(), [400, 200]);
    let focal = 100.0 / 0.5f64.tan();
    for [d, a, h] in [[2.0, 0.5, 0.3], [10.0, -4.0, 1.0], [0.3, 0.02, -0.05]] {
        let [x, y] = frustum.pixel(&frustum.seen(&V3::new(d as f32, a as f32, h as f32)));
        assert!((f64::from(x) - (200.0 - focal * a / d)).abs() < 1e-3, "{x}");
        assert!((f64::from(y) - (100.0 - focal * h / d)).abs() < 1e-3, "{y}");
        // and back
        let back = frustum.eye + frustum.ray(x, y) * d as f32;
        assert!((back - V3::new(d as f32, a as f32, h as f32)).norm() < 1e-5);
    }
}

/// A sphere of radius r at the distance d before the eye covers a circle of the radius f r/√(d² − r²). Measured: 0.3 %
/// less, as its facets lie inside it.
#[test]
fn the_silhouette_of_a_sphere_has_its_area() {
    let (radius, away) = (0.5, 3.0);
    let shown = picture(&ahead(0.6), [300, 300], &[sphere(Vector3::new(away, 0.0, 0.0), radius, RED)], &[]);
    let share: f64 = shown.iter().map(|p| (f64::from(p[0]) / 255.0).powi(2)).sum();
    let focal = 150.0 / 0.3f64.tan();
    let exact = PI * (focal * radius / (away * away - radius * radius).sqrt()).powi(2);
    assert!((share / exact - 1.0).abs() < 0.01, "{share} of {exact}");
}

#[test]
fn the_nearer_of_two_spheres_hides_the_other_in_any_order() {
    let near = sphere(Vector3::new(2.0, 0.1, 0.0), 0.3, RED);
    let far = sphere(Vector3::new(4.0, -0.2, 0.0), 0.6, BLUE);
    let one = picture(&ahead(0.7), [120, 90], &[near.clone(), far.clone()], &[]);
    let other = picture(&ahead(0.7), [120, 90], &[far, near], &[]);
    assert_eq!(one, other);
    assert_eq!(one[45 * 120 + 57], [255, 0, 0]);
    assert!(one.contains(&[0, 0, 255]));
}

/// Half of blue over red is half of each, in squares; behind red it is nothing.
#[test]
fn a_veil_is_blended_before_a_thing_and_hidden_behind_it() {
    let red = sphere(Vector3::new(3.0, 0.0, 0.0), 1.0, RED);
    let sheet = |x: f32| {
        let corners = [[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]].map(|[y, z]| V3::new(x, y, z)).to_vec();
        Veil::Sheet { corners, colour: BLUE, opacity: 0.5 }
    };
    let middle = |veil: Veil| picture(&ahead(0.7), [40, 40], std::slice::from_ref(&red), &[veil])[20 * 40 + 20];
    assert_eq!(middle(sheet(6.0)), [255, 0, 0]);
    let [r, g, b] = middle(sheet(1.0));
    assert!(g == 0 && r.abs_diff(180) < 9 && b.abs_diff(180) < 9, "{r} {b}");
}

/// Of a ghost the nearest surface alone is blended, half of it, in squares: over sky, over what is behind it, not through
/// what is before it. Of two ghosts the farther one is blended first, in any order. Veils behind a ghost are blended before
/// it. A ghost in the place of a thing is not seen.
#[test]
fn a_ghost_is_blended_once_by_its_depth() {
    const GREEN: Colour = [0.0, 1.0, 0.0];
    let ball = |x: f64, colour| sphere(Vector3::new(x, 0.0, 0.0), 0.5, colour);
    let middle = |pieces: &[Piece], ghosts: &[Vec<Piece>], veils: &[Veil]| {
        haunted(&ahead(0.7), [40, 40], pieces, ghosts, veils)[20 * 40 + 20]
    };
    let close = |found: [u8; 3], shares: [f64; 3]| {
        let apart = found.iter().zip(shares).map(|(own, share)| (f64::from(*own) - 255.0 * share.sqrt()).abs());
        assert!(apart.fold(0.0, f64::max) <= 1.0, "{found:?}, {shares:?}");
    };
    close(middle(&[], &[vec![ball(3.0, BLUE)]], &[]), [0.0, 0.0, 0.5]);
    // its far side, and what it is made of twice, add nothing
    close(middle(&[], &[vec![ball(3.0, BLUE), ball(3.1, BLUE), ball(3.0, BLUE)]], &[]), [0.0, 0.0, 0.5]);
    close(middle(&[ball(6.0, RED)], &[vec![ball(3.0, BLUE)]], &[]), [0.5, 0.0, 0.5]);
    close(middle(&[ball(3.0, RED)], &[vec![ball(6.0, BLUE)]], &[]), [1.0, 0.0, 0.0]);
    close(middle(&[ball(3.0, RED)], &[vec![ball(3.0, BLUE)]], &[]), [1.0, 0.0, 0.0]);
    close(middle(&[ball(3.0, RED)], &[vec![ball(2.998, BLUE)]], &[]), [1.0, 0.0, 0.0]);
    for ghosts in [[ball(3.0, BLUE), ball(6.0, GREEN)], [ball(6.0, GREEN), ball(3.0, BLUE)]] {
        close(middle(&[ball(9.0, RED)], &ghosts.map(|own| vec![own]), &[]), [0.25, 0.25, 0.5]);
    }
    let sheet = |x: f32| {
        let corners = [[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]].map(|[y, z]| V3::new(x, y, z)).to_vec();
        Veil::Sheet { corners, colour: GREEN, opacity: 0.5 }
    };
    close(middle(&[ball(9.0, RED)], &[vec![ball(3.0, BLUE)]], &[sheet(6.0)]), [0.25, 0.25, 0.5]);
    close(middle(&[ball(9.0, RED)], &[vec![ball(3.0, BLUE)]], &[sheet(1.0)]), [0.25, 0.5, 0.25]);
}

#[test]
fn the_bits_do_not_depend_on_the_number_of_threads() {
    let pieces: Vec<Piece> =
        (0..9).map(|i| sphere(Vector3::new(3.0, 0.3 * f64::from(i) - 1.2, 0.1 * f64::from(i)), 0.3, RED)).collect();
    let line =
        Veil::Line { ends: [V3::new(2.0, -1.0, 0.2), V3::new(4.0, 1.0, 0.1)], colour: BLUE, opacity: 0.7, pixels: 2.5 };
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let ghosts = [vec![sphere(Vector3::new(2.5, 0.3, 0.1), 0.4, BLUE)], pieces[2..5].to_vec()];
        pool.install(|| haunted(&ahead(0.8), [160, 100], &pieces, &ghosts, std::slice::from_ref(&line)))
    };
    let one = with(1);
    assert!(one.contains(&[255, 0, 0]));
    assert!((2..6).all(|threads| with(threads) == one));
}

/// What lies behind the eye, through it, or nowhere, and lenses that look nowhere, give a picture all the same.
#[test]
fn hostile_lenses_and_places_give_a_picture() {
    let nan = Point3::new(f64::NAN, 0.0, 0.0);
    let at = |eye_m, target_m, height_rad| Lens { eye_m, target_m, up: Vector3::z(), height_rad };
    let origin = Point3::origin();
    let hostile = [
        at(origin, origin, 0.7),
        at(nan, origin, 0.7),
        at(origin, nan, 0.7),
        at(origin, Point3::new(1.0, 0.0, 0.0), 0.0),
        at(origin, Point3::new(1.0, 0.0, 0.0), f64::INFINITY),
        at(Point3::new(1e300, 0.0, 0.0), Point3::new(-1e300, 0.0, 0.0), 0.7),
    ];
    let mut things = vec![sphere(Vector3::zeros(), 1.0, RED), sphere(Vector3::new(-5.0, 0.0, 0.0), 1.0, RED)];
    things.push(sphere(Vector3::repeat(f64::NAN), 1.0, RED));
    things.push(Piece { triangles: vec![[0, 1, 99]], ..things[0].clone() });
    let far = V3::new(1e30, -1e30, 1.0);
    let veils = [
        Veil::Line { ends: [V3::zeros(), V3::zeros()], colour: RED, opacity: 1.0, pixels: 2.0 },
        Veil::Line { ends: [far, -far], colour: RED, opacity: 1.0, pixels: 2.0 },
        Veil::Sheet { corners: vec![V3::repeat(f32::NAN); 4], colour: RED, opacity: 1.0 },
        Veil::Sheet { corners: Vec::new(), colour: RED, opacity: 1.0 },
    ];
    assert!(hostile[..5].iter().all(|lens| !lens.looks()));
    for lens in &hostile {
        assert_eq!(picture(lens, [33, 17], &things, &veils).len(), 33 * 17);
    }
    // straight up and straight down
    for z in [1.0, -1.0] {
        let shown = picture(
            &at(origin, Point3::new(0.0, 0.0, z), 0.7),
            [20, 20],
            &[sphere(Vector3::z() * (3.0 * z), 1.0, RED)],
            &[],
        );
        assert_eq!(shown[10 * 20 + 10], [255, 0, 0]);
    }
}

/// A body dropped onto nothing, without a vehicle.
fn fall(end_s: f64) -> (Model, Vec<Snapshot>) {
    let case = SetupBuilder::new("Fall", Body::male50(), Joints::male50());
    let standing = InitialPosture::Coordinates(Box::new(ReportCoordinates { q: [0.0; DOF], rates: [0.0; DOF] }));
    let model = Model::new(case.build(VehiclePath::parked(), standing, end_s)).unwrap();
    let mut moments = Vec::new();
    simulate(&model, &mut Watch(|sample: &Sample<'_>| moments.push(Snapshot::of(sample)))).unwrap();
    (model, moments)
}

fn shown<'a>(model: &'a Model, moments: &'a [Snapshot]) -> Shown<'a> {
    Shown { model, moments, clock_s: &[], caption: vec!["run".to_owned()] }
}

/// Every camera sees it.
#[test]
fn every_camera_sees_a_body_without_a_car() {
    let (model, moments) = fall(0.01);
    assert_eq!(model.body().tree.segments().len(), TTI12.segments().len());
    let run = shown(&model, &moments);
    for camera in [Camera::Ground, Camera::Vehicle, Camera::Chase, Camera::Driver] {
        let fitted = camera.fitted(&[&run], 1.78).unwrap();
        let scene = Scene::new(&run, &[], fitted, [96, 54], "").unwrap();
        let pixmap = scene.frame(0).unwrap().rendered(1.0).unwrap();
        // trousers and shirt are blue, ground and sky grey
        let blue = pixmap.pixels().iter().filter(|p| i32::from(p.blue()) > i32::from(p.red()) + 35).count();
        assert!(camera == Camera::Driver || blue > 20, "{camera:?}: {blue}");
        assert!(scene.frame(moments.len()).is_err());
    }
    let empty = shown(&model, &[]);
    let ground = Camera::Ground.fitted(&[&empty], 1.78).unwrap();
    assert!(Scene::new(&empty, &[], ground, [96, 54], "").unwrap().frame(0).is_err());
    assert!(Scene::new(&run, &[], ground, [0, 54], "").is_err());
    assert!(Scene::new(&run, &vec![run.clone(); MOST_GHOSTS + 1], ground, [96, 54], "").is_err());
}

/// A run as its own ghost is not seen, by any camera; one that is lower is. One that has ended says so.
#[test]
fn a_ghost_stands_where_it_is_and_says_when_it_has_ended() {
    let (model, moments) = fall(0.4);
    let run = shown(&model, &moments);
    let last = moments.len() - 1;
    let bare = |scene: &Scene<'_>, at: usize| {
        let lens = scene.camera.lens(&model, &moments[at]);
        let origin = Vector3::zeros();
        scene.bare(at, &lens, &lens.before(&origin, [192, 108]), &origin)
    };
    // stays where it was when it began to fall
    let stays = vec![moments[0].clone(); moments.len()];
    let ghost = shown(&model, &stays);
    for camera in [Camera::Ground, Camera::Vehicle, Camera::Chase] {
        let fitted = camera.fitted(&[&run], 1.78).unwrap();
        let scene = |ghosts: &[Shown<'_>]| bare(&Scene::new(&run, ghosts, fitted, [192, 108], "").unwrap(), last);
        let alone = scene(&[]);
        assert_eq!(alone, scene(&[run.clone(), run.clone()]), "{camera:?}");
        let pink = |all: &[[u8; 3]]| all.iter().filter(|[r, g, b]| *r > g.saturating_add(15) && b > g).count();
        assert_eq!(pink(&alone), 0, "{camera:?}");
        let seen = pink(&scene(std::slice::from_ref(&ghost)));
        assert!(seen > 100, "{camera:?}: {seen}");
    }
    let fitted = Camera::Ground.fitted(&[&run], 1.78).unwrap();
    let scene = Scene::new(&run, &[ghost], fitted, [192, 108], "").unwrap();
    let said = |at: usize| scene.captions(at).into_iter().map(|(_, line)| line).collect::<Vec<_>>();
    assert_eq!(said(0), ["run", "run"]);
    assert_eq!(said(last), ["run", "run, ended at 0 ms and stays as it was then"]);
}

/// Carried to where another vehicle is, nothing moves in the vehicle's axes, not even what stands in space.
#[test]
fn a_carried_moment_is_the_same_in_its_vehicle() {
    let (_, moments) = fall(0.01);
    let turn = Rotation3::from_euler_angles(0.3, -0.2, 2.0).into_inner();
    let vehicle = FrameMotion { origin_m: Vector3::new(5.0, -3.0, 1.0), rotation: turn, ..moments[0].vehicle };
    let (own, carried) = (&moments[1], moments[1].carried_by(&vehicle));
    let still = [Point3::new(1.0, 2.0, 3.0)];
    let [before, after] = [own, &carried].map(|moment| moment.placed_m(Axes::Space, &still)[0]);
    assert!((before - after).norm() < 1e-12, "{before} {after}");
    assert_eq!(own.spheres_m, carried.spheres_m);
    let head = own.spheres_m[0];
    assert_eq!(in_space(&carried, &head), vehicle.point_to_space(head.coords).into());
    // and back
    let back = carried.carried_by(&own.vehicle);
    assert!((back.placed_m(Axes::Space, &still)[0] - before).norm() < 1e-12);
}

/// A white picture twice as wide as high on a square: half of the free rows are dark.
#[test]
fn a_photograph_is_whole_on_a_dark_ground() {
    let mut white = Pixmap::new(80, 40).unwrap();
    white.fill(Color::WHITE);
    let png = white.encode_png().unwrap();
    let of = |png: Option<(&[u8], Option<f64>)>, size| {
        let own = Photograph { png, title: "", about: "", time_s: 0.04, caption: "" };
        photograph(&own, size).and_then(|frame| frame.rendered(1.0))
    };
    let count = |picture: &Pixmap| picture.pixels().iter().filter(|pixel| pixel.red() == 255).count();
    let square = of(Some((&png, Some(0.03))), [720, 720]).unwrap();
    // measured: 259200 less what the words have
    assert_eq!(count(&square), 720 * 360);
    assert_eq!(count(&of(None, [720, 720]).unwrap()), 0);
    let huge = {
        let mut png = png.clone();
        png[16..20].copy_from_slice(&60_000u32.to_be_bytes());
        png
    };
    assert!(of(Some((&huge, None)), [64, 64]).unwrap_err().contains("60000 × 40 pixels"));
    for wrong in [&png[..30], &png[..png.len() / 2], b"", b"GIF89a"] {
        assert!(of(Some((wrong, None)), [64, 64]).unwrap_err().contains("cannot be read as PNG"));
    }
    let frame = |size| of(None, size).map(Frame::Pixels).unwrap();
    let both = abreast(frame([30, 20]), frame([31, 20])).unwrap().rendered(1.0).unwrap();
    assert_eq!([both.width(), both.height()], [61, 20]);
    assert!(abreast(frame([30, 20]), frame([30, 21])).is_err());
}
