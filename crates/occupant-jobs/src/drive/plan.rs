//! The plan view of a drive: road, barriers, tyre marks, vehicles at chosen times.

use occupant_scenario::Drives;
use occupant_units::trig;
use vehicle_motion::barrier::Barrier;
use vehicle_motion::body::Side;
use vehicle_motion::run::Station;
use vehicle_motion::world::Profile;

use super::Driven;
use occupant_pictures::svg::{Anchor, Svg, Text};

/// Largest size of the plan without text, user units, and largest scale, user units per metre.
const SIZE: [f64; 2] = [1400.0, 700.0];
const LARGEST: f64 = 60.0;
const SIDE: f64 = 24.0;
const HEAD: f64 = 64.0;
const FOOT: f64 = 58.0;
/// Margin around the drawing, and length of a wall shown beyond it, m.
const MARGIN_M: f64 = 3.0;
/// Number of equally spaced times at which vehicles are drawn, besides first contacts and the end.
const TIMES: usize = 8;
/// Distance of the points of a crushed outline, m.
const PART_M: f64 = 0.05;
/// Zones of friction are looked for along so many lines.
const LINES: usize = 1000;
/// Number of fields along a side in which lines of equal height are looked for.
const FIELDS: usize = 60;
/// Possible differences of height between them, m, and least distance of their labels, user units.
const STEPS_M: [f64; 10] = [0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0];
const LABEL: f64 = 60.0;
/// Colours of the vehicles in order, repeated.
const COLOURS: [&str; 5] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8c6d1f"];

/// The part of the ground shown, m, and its scale.
struct Sheet {
    low: [f64; 2],
    high: [f64; 2],
    scale: f64,
}

impl Sheet {
    fn of(drives: &Drives) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for (own, ride) in drives.vehicles.iter().zip(&drives.outcome.rides) {
            for corner in ride.stations().iter().flat_map(|station| outline(own, station)) {
                for i in 0..2 {
                    (low[i], high[i]) = (low[i].min(corner[i]), high[i].max(corner[i]));
                }
            }
        }
        let [low, high] = [low.map(|x| x - MARGIN_M), high.map(|x| x + MARGIN_M)];
        let scale = (SIZE[0] / (high[0] - low[0])).min(SIZE[1] / (high[1] - low[1])).min(LARGEST);
        Sheet { low, high, scale }
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [SIDE + (x - self.low[0]) * self.scale, HEAD + (y - self.low[1]) * self.scale]
    }

    fn all(&self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        points.iter().map(|point| self.at(*point)).collect()
    }

    fn size(&self) -> [f64; 2] {
        [0, 1].map(|i| (self.high[i] - self.low[i]) * self.scale)
    }
}

/// The outline of a vehicle with the residual crush of its sides, as far as it was crushed at a station.
fn crushed(drives: &Drives, number: usize, station: &Station) -> Vec<[f64; 2]> {
    let own = &drives.vehicles[number];
    let most_m = drives.outcome.rides[number].last().crush_m;
    let corners = corners(own);
    let share = if most_m > 0.0 { station.crush_m / most_m } else { 0.0 };
    let profiles = &drives.outcome.damage[number].profiles;
    let edge = |i: usize| {
        let [from, to] = [corners[i], corners[(i + 1) % corners.len()]];
        let parts = (trig::hypot(to[0] - from[0], to[1] - from[1]) / PART_M).ceil().max(1.0) as usize;
        (0..parts).map(move |j| [0, 1].map(|k| from[k] + (to[k] - from[k]) * j as f64 / parts as f64))
    };
    let points = (0..corners.len()).flat_map(edge);
    let pressed = points.map(|point| profiles.iter().fold(point, |at, profile| press(own, profile, share, at)));
    pressed.map(|[x, y]| place(station, x, y)).collect()
}

/// Pushes a point of the outline in to the crush of a side.
fn press(own: &occupant_scenario::DrivenVehicle, profile: &Profile, share: f64, [x, y]: [f64; 2]) -> [f64; 2] {
    let body = &own.car.body;
    let depth_m = |along: f64| {
        let [from, to] = profile.span_m;
        let place = (along - from) / (to - from).max(1e-9) * 5.0;
        let i = (place.floor().clamp(0.0, 4.0)) as usize;
        let between = profile.depths_m[i] + (profile.depths_m[i + 1] - profile.depths_m[i]) * (place - i as f64);
        if (0.0..=5.0).contains(&place) { share * between } else { 0.0 }
    };
    let half_m = 0.5 * body.width_m;
    match profile.side {
        Side::Front => [x.min(body.front_m - depth_m(y)), y],
        Side::Rear => [x.max(body.front_m - body.length_m + depth_m(y)), y],
        Side::Right => [x, y.min(half_m - depth_m(x))],
        Side::Left => [x, y.max(depth_m(x) - half_m)],
    }
}

/// Corners of a vehicle's outline in plan, from its left front corner on.
fn outline(own: &occupant_scenario::DrivenVehicle, station: &Station) -> Vec<[f64; 2]> {
    corners(own).map(|[x, y]| place(station, x, y)).to_vec()
}

/// The same in the vehicle's axes.
fn corners(own: &occupant_scenario::DrivenVehicle) -> [[f64; 2]; 8] {
    let body = &own.car.body;
    let (ahead, behind, half, cut) =
        (body.front_m, body.front_m - body.length_m, 0.5 * body.width_m, body.corner_m.max(0.01));
    [
        [ahead, -half + cut],
        [ahead, half - cut],
        [ahead - cut, half],
        [behind + cut, half],
        [behind, half - cut],
        [behind, -half + cut],
        [behind + cut, -half],
        [ahead - cut, -half],
    ]
}

/// A point of the vehicle in plan view.
fn place(station: &Station, x: f64, y: f64) -> [f64; 2] {
    let at = station.position_m + station.attitude * vehicle_motion::V3::new(x, y, 0.0);
    [at.x, at.y]
}

/// The plan as SVG.
pub fn plan(drives: &Drives, all: &[Driven], title: &str) -> String {
    let sheet = Sheet::of(drives);
    let [width, height] = sheet.size();
    let mut svg = Svg::new(width + 2.0 * SIDE, height + HEAD + FOOT, title);
    svg.rect(0.0, 0.0, width + 2.0 * SIDE, height + HEAD + FOOT, "fill=\"#ffffff\"");
    svg.text([SIDE, 26.0], title, &Text { size: 17.0, ..Text::default() });
    let words =
        "From above: x to the right, y (right of the road) down. Bars at the fronts; outlines with residual crush.";
    svg.text([SIDE, 46.0], words, &Text { size: 12.0, fill: "#555555", ..Text::default() });
    svg.begin_clip("plan", SIDE, HEAD, width, height);
    ground(&mut svg, &sheet, drives);
    marks(&mut svg, &sheet, all);
    for number in 0..drives.barriers.len() {
        barrier(&mut svg, &sheet, drives, number);
    }
    let mut labels = Vec::new();
    for driven in all {
        vehicle(&mut svg, &sheet, drives, driven, &mut labels);
    }
    tell_times(&mut svg, labels);
    svg.end();
    svg.rect(SIDE, HEAD, width, height, "fill=\"none\" stroke=\"#9a9a9a\"");
    foot(&mut svg, &sheet, drives);
    svg.finish()
}

/// Zones of friction and the corners of the cross-section.
fn ground(svg: &mut Svg, sheet: &Sheet, drives: &Drives) {
    let [left, right] = [sheet.low[0], sheet.high[0]];
    let [x, y] = sheet.at(sheet.low);
    let [width, height] = sheet.size();
    svg.rect(x, y, width, height, "fill=\"#f1f1ef\"");
    let ground = &drives.world.ground;
    if let Some(mesh) = ground.as_mesh() {
        for zone in ground.zones() {
            let [mut outline, mut back] = zone.right_m.map(|right_m| ground.line_at_m(right_m));
            back.reverse();
            outline.append(&mut back);
            svg.polygon(&sheet.all(&outline), "fill=\"#e7dfc8\"");
        }
        for edge in mesh.edges_m() {
            svg.polyline(&sheet.all(&edge), "fill=\"none\" stroke=\"#b3ab92\" stroke-dasharray=\"6 4\"");
        }
        if mesh.edges_m().is_empty() {
            contours(svg, sheet, drives);
        }
        return;
    }
    let zone = |right_m: &f64| ground.zone(0.0, *right_m).map(|zone| zone.name.as_str());
    let lines: Vec<f64> = (0..=LINES).map(|i| sheet.low[1] + height / sheet.scale * i as f64 / LINES as f64).collect();
    for strip in lines.chunk_by(|a, b| zone(a) == zone(b)) {
        let Some(name) = zone(&strip[0]) else { continue };
        let [x, y] = sheet.at([left, strip[0]]);
        svg.rect(x, y, width, (strip[strip.len() - 1] - strip[0]) * sheet.scale, "fill=\"#e7dfc8\"");
        svg.text([x + 6.0, y + 14.0], name, &Text { size: 11.0, fill: "#7a6a3a", ..Text::default() });
    }
    for [right_m, up_m] in ground.corners_m().iter().copied() {
        let is_shown = (sheet.low[1]..sheet.high[1]).contains(&right_m);
        if is_shown && ground.corners_m().iter().any(|corner| corner[1] != up_m) {
            svg.segment(
                sheet.at([left, right_m]),
                sheet.at([right, right_m]),
                "stroke=\"#b3ab92\" stroke-dasharray=\"6 4\"",
            );
            let at = sheet.at([right, right_m]);
            let style = Text { size: 11.0, fill: "#7a6a3a", anchor: Anchor::End, ..Text::default() };
            svg.text([at[0] - 6.0, at[1] - 4.0], &format!("{up_m:+.1} m").replace('-', "−"), &style);
        }
    }
}

/// Lines of equal height with their labels, which keep apart.
fn contours(svg: &mut Svg, sheet: &Sheet, drives: &Drives) {
    let at = |i: usize, j: usize| {
        let place = [(0, i), (1, j)]
            .map(|(axis, k)| sheet.low[axis] + (sheet.high[axis] - sheet.low[axis]) * k as f64 / FIELDS as f64);
        (place, drives.world.ground.height_m(place[0], place[1]))
    };
    let fields = || (0..FIELDS).flat_map(|i| (0..FIELDS).map(move |j| (i, j)));
    let halves = |(i, j)| [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]];
    let triangles: Vec<Triangle> = fields().flat_map(halves).collect();
    let heights = triangles.iter().flatten().map(|corner| corner.1);
    let (low_m, high_m) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), h| (a.min(h), b.max(h)));
    let step_m = STEPS_M.into_iter().find(|step| (high_m - low_m) / step <= 8.0);
    let Some(step_m) = step_m.filter(|_| high_m - low_m > 0.02) else { return };
    let mut labels: Vec<[f64; 2]> = Vec::new();
    // between round heights, at which ground is often level
    let levels = ((low_m / step_m - 0.5).ceil() as i64)..=((high_m / step_m - 0.5).floor() as i64);
    for level_m in levels.map(|i| (i as f64 + 0.5) * step_m) {
        let pieces = triangles.iter().filter_map(|triangle| crossed(triangle, level_m));
        let pieces: Vec<_> = pieces.map(|ends| ends.map(|end| sheet.at(end))).collect();
        pieces.iter().for_each(|[from, to]| svg.segment(*from, *to, "stroke=\"#b3ab92\""));
        let is_free = |at: &[f64; 2]| labels.iter().all(|own| trig::hypot(own[0] - at[0], own[1] - at[1]) > LABEL);
        if let Some(at) = pieces.iter().map(|[from, _]| *from).find(is_free) {
            let style = Text { size: 11.0, fill: "#7a6a3a", ..Text::default() };
            svg.text([at[0] + 6.0, at[1] - 4.0], &format!("{level_m:+.2} m").replace('-', "−"), &style);
            labels.push(at);
        }
    }
}

/// Corners of a triangle of the ground: place and height, m.
type Triangle = [([f64; 2], f64); 3];

/// Ends of the line in which a level cuts a triangle; none if it does not.
fn crossed(triangle: &Triangle, level_m: f64) -> Option<[[f64; 2]; 2]> {
    let crossing = |k: usize| {
        let ((a, from_m), (b, to_m)) = (triangle[k], triangle[(k + 1) % 3]);
        let share = (level_m - from_m) / (to_m - from_m);
        ((from_m < level_m) != (to_m < level_m)).then(|| [0, 1].map(|x| a[x] + share * (b[x] - a[x])))
    };
    let mut ends = (0..3).filter_map(crossing);
    Some([ends.next()?, ends.next()?])
}

fn marks(svg: &mut Svg, sheet: &Sheet, all: &[Driven]) {
    let width = (0.16 * sheet.scale).max(1.5);
    let style = format!("fill=\"none\" stroke=\"#444444\" stroke-opacity=\"0.55\" stroke-width=\"{width:.1}\"");
    for mark in all.iter().flat_map(|driven| &driven.marks) {
        svg.polyline(&sheet.all(&mark.points_m), &style);
    }
}

/// A barrier; a rail in its initial and final shape.
fn barrier(svg: &mut Svg, sheet: &Sheet, drives: &Drives, number: usize) {
    let solid = "fill=\"#8d8d8d\" stroke=\"#333333\" stroke-width=\"1.5\"";
    match &drives.world.barriers[number] {
        Barrier::Wall(wall) => {
            let (sine, cosine) = trig::sin_cos(wall.normal_rad);
            let far = 2.0 * (sheet.high[0] - sheet.low[0] + sheet.high[1] - sheet.low[1]);
            let corner = |along: f64, behind: f64| {
                let [x, y] = wall.point_m;
                sheet.at([x - sine * along * far - cosine * behind, y + cosine * along * far - sine * behind])
            };
            svg.polygon(&[corner(-1.0, 0.0), corner(1.0, 0.0), corner(1.0, far), corner(-1.0, far)], solid);
        }
        Barrier::Pole(pole) => {
            let radius = (pole.radius_m * sheet.scale).max(2.0);
            svg.circle(sheet.at(pole.at_m), radius, solid);
        }
        Barrier::Block(block) => svg.polygon(&sheet.all(&block.corners_m), solid),
        Barrier::Slider(slider) => {
            let slid = &drives.outcome.slides[number];
            let (sine, cosine) = trig::sin_cos(slid.direction_rad);
            let moved: Vec<[f64; 2]> =
                slider.corners_m.iter().map(|[x, y]| [x + slid.most_m * cosine, y + slid.most_m * sine]).collect();
            svg.polygon(&sheet.all(&slider.corners_m), "fill=\"#d9c78a\" stroke=\"#333333\"");
            svg.polygon(&sheet.all(&moved), "fill=\"none\" stroke=\"#333333\" stroke-dasharray=\"4 3\"");
        }
        Barrier::Rail(rail) => {
            svg.polyline(&sheet.all(&rail.line_m), "fill=\"none\" stroke=\"#777777\" stroke-dasharray=\"6 4\"");
            if let Some(bent) = drives.outcome.rails.iter().find(|bent| bent.barrier == number) {
                svg.polyline(&sheet.all(&bent.line_m), "fill=\"none\" stroke=\"#333333\" stroke-width=\"3\"");
            }
        }
    }
}

/// Path of a vehicle's centre of gravity, and its outline at several times, later ones darker.
fn vehicle(svg: &mut Svg, sheet: &Sheet, drives: &Drives, driven: &Driven, labels: &mut Vec<([f64; 2], f64)>) {
    let (own, ride) = (&drives.vehicles[driven.number], &drives.outcome.rides[driven.number]);
    let colour = COLOURS[driven.number % COLOURS.len()];
    let stations = ride.stations();
    let way: Vec<[f64; 2]> = stations.iter().map(|station| place(station, 0.0, 0.0)).collect();
    svg.polyline(&sheet.all(&way), &format!("fill=\"none\" stroke=\"{colour}\" stroke-opacity=\"0.6\""));
    let end_s = ride.last().time_s;
    let mut times_s: Vec<f64> = (0..=TIMES).map(|i| end_s * i as f64 / TIMES as f64).collect();
    times_s.extend(driven.collisions.iter().map(|own| own.from_s));
    times_s.sort_by(f64::total_cmp);
    // where it is at rest, or hardly moves on, it is drawn once
    let mut drawn: Option<[f64; 2]> = None;
    for (i, time_s) in times_s.iter().enumerate() {
        let at = stations.partition_point(|station| station.time_s < time_s - 1e-9).min(stations.len() - 1);
        let station = &stations[at];
        let centre = place(station, 0.0, 0.0);
        let is_last = i + 1 == times_s.len();
        let is_hit = driven.collisions.iter().any(|own| own.from_s == *time_s);
        let is_near =
            drawn.is_some_and(|[x, y]| trig::hypot(centre[0] - x, centre[1] - y) < 0.25 * own.car.body.length_m);
        if is_near && !is_last && !is_hit {
            continue;
        }
        drawn = Some(centre);
        let opacity = 0.12 + 0.4 * time_s / end_s;
        let dash = if is_hit { " stroke-width=\"2.5\"" } else { "" };
        let style = format!("fill=\"{colour}\" fill-opacity=\"{opacity:.2}\" stroke=\"{colour}\"{dash}");
        svg.polygon(&sheet.all(&crushed(drives, driven.number, station)), &style);
        // behind what the front loses
        let behind = own.car.body.front_m - drives.outcome.damage[driven.number].residual_m - 0.12;
        let half = 0.38 * own.car.body.width_m;
        let bar = [place(station, behind, -half), place(station, behind, half)];
        svg.polyline(&sheet.all(&bar), &format!("stroke=\"{colour}\" stroke-width=\"3\""));
        labels.push((sheet.at(centre), *time_s));
    }
}

/// Times beside the outlines, the latest first; overlapping ones are left out.
fn tell_times(svg: &mut Svg, mut labels: Vec<([f64; 2], f64)>) {
    labels.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut told: Vec<[f64; 2]> = Vec::new();
    for ([x, y], time_s) in labels {
        let covers = |[left, up]: &[f64; 2]| (x - left).abs() < 42.0 && (y - up).abs() < 14.0;
        if !told.iter().any(covers) {
            let style = Text { size: 11.0, anchor: Anchor::Middle, halo: Some("#ffffff"), ..Text::default() };
            svg.text([x, y + 4.0], &format!("{time_s:.2} s"), &style);
            told.push([x, y]);
        }
    }
}

/// Scale and names.
fn foot(svg: &mut Svg, sheet: &Sheet, drives: &Drives) {
    let y = HEAD + sheet.size()[1] + 26.0;
    let bar_m =
        [0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0].into_iter().find(|m| m * sheet.scale >= 60.0).unwrap_or(200.0);
    let end = SIDE + bar_m * sheet.scale;
    svg.segment([SIDE, y], [end, y], "stroke=\"#222222\" stroke-width=\"2\"");
    svg.text([end + 8.0, y + 4.0], &format!("{bar_m} m"), &Text::default());
    let mut x = end + 80.0;
    for (i, own) in drives.vehicles.iter().enumerate() {
        svg.rect(x, y - 8.0, 16.0, 12.0, &format!("fill=\"{}\" fill-opacity=\"0.5\"", COLOURS[i % COLOURS.len()]));
        svg.text([x + 22.0, y + 3.0], &own.name, &Text::default());
        x += 40.0 + 8.0 * own.name.chars().count() as f64;
    }
    svg.segment([x, y], [x + 24.0, y], "stroke=\"#444444\" stroke-opacity=\"0.55\" stroke-width=\"4\"");
    svg.text([x + 30.0, y + 4.0], "tyre mark", &Text::default());
    svg.text([x + 110.0, y + 4.0], "heavy rim: first touch", &Text::default());
}
