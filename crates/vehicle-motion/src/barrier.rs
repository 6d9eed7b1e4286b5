//! Barriers and other obstacles beside the road.

/// A barrier. Positions are X and Y in vehicle-space, m.
#[derive(Clone, Debug, PartialEq)]
pub enum Barrier {
    /// A rigid infinite wall: the half space behind a line.
    Wall(Wall),
    /// A rigid upright cylinder.
    Pole(Pole),
    /// A rigid upright prism.
    Block(Block),
    /// A rail on posts.
    Rail(Rail),
    /// A mass on a straight path, held back by a force: a crash cushion, or a sign on a breakaway base.
    Slider(Slider),
}

/// A rigid wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// A point of its face.
    pub point_m: [f64; 2],
    /// Direction of its outward normal, clockwise from X, rad.
    pub normal_rad: f64,
    /// Friction: 0.55 for a car's end, 0.2 along smooth concrete.
    pub friction: f64,
}

/// A rigid pole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pole {
    /// Its axis.
    pub at_m: [f64; 2],
    /// Radius, m.
    pub radius_m: f64,
    /// Friction.
    pub friction: f64,
}

/// A rigid block.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Corners of a convex polygon, clockwise from above.
    pub corners_m: Vec<[f64; 2]>,
    /// Friction.
    pub friction: f64,
}

/// A mass on a straight path, held back by a force.
#[derive(Clone, Debug, PartialEq)]
pub struct Slider {
    /// Corners of its convex outline, clockwise from above.
    pub corners_m: Vec<[f64; 2]>,
    /// Mass accelerated by the car, kg.
    pub mass_kg: f64,
    /// Direction of its path, clockwise from X, rad; none: that of the vehicle that hits it.
    pub direction_rad: Option<f64>,
    /// Force over travel: m and N, from 0; linear between points.
    pub force_n: Vec<[f64; 2]>,
    /// Share of the energy returned.
    pub returned: f64,
    /// Behaviour beyond the end of the force's table.
    pub end: End,
    /// Friction.
    pub friction: f64,
}

/// A rail on posts, in plan. Its ends are pinned.
#[derive(Clone, Debug, PartialEq)]
pub struct Rail {
    /// From and to.
    pub line_m: [[f64; 2]; 2],
    /// Whether the traffic is on its left, seen from its start.
    pub traffic_on_left: bool,
    /// Height at which its force acts, m.
    pub height_m: f64,
    /// Its lower and upper edge, m.
    pub band_m: [f64; 2],
    /// Distance of the posts, m.
    pub spacing_m: f64,
    /// Mass along it, kg/m.
    pub kg_per_m: f64,
    /// Mass that moves with each post, kg.
    pub post_kg: f64,
    /// Stiffness of its section in tension, EA, N.
    pub stretch_n: f64,
    /// Tension at which it yields, N.
    pub yield_n: f64,
    /// Stiffness of its section in bending, EI, N·m².
    pub bend_n_m2: f64,
    /// Moment at which it yields, N·m.
    pub yield_n_m: f64,
    /// Stiffness of each anchor, N/m.
    pub anchor_n_per_m: f64,
    /// Stiffness of a post, N/m.
    pub post_n_per_m: f64,
    /// Force at which a post yields, N.
    pub post_n: f64,
    /// Deflection at which a post releases the rail, m.
    pub release_m: f64,
    /// Friction along it.
    pub friction: f64,
}

impl Rail {
    /// A W-beam on steel posts every 1.905 m. Section values are those of the profile; the posts' force, the release
    /// and the anchors are guesses, tuned to one remembered deflection.
    pub fn w_beam(line_m: [[f64; 2]; 2]) -> Self {
        Rail {
            line_m,
            traffic_on_left: true,
            height_m: 0.55,
            band_m: [0.4, 0.71],
            spacing_m: 1.905,
            kg_per_m: 10.4,
            post_kg: 12.0,
            stretch_n: 257e6,
            yield_n: 440e3,
            bend_n_m2: 191e3,
            yield_n_m: 10e3,
            anchor_n_per_m: 2e6,
            post_n_per_m: 1.5e6,
            post_n: 40e3,
            release_m: 0.5,
            friction: 0.3,
        }
    }
}

/// End of a slider's path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// It stops: a cushion.
    Rigid,
    /// It is free: a breakaway base.
    Released,
}

impl Pole {
    /// Corners of its outline, a polygon of the same area, clockwise from above.
    pub fn corners_m(&self) -> Vec<[f64; 2]> {
        let n = 48;
        let corner = |i: i32| {
            let (sine, cosine) = libm::sincos(core::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(n));
            // the same area as the circle
            let radius_m = self.radius_m / libm::cos(core::f64::consts::PI / f64::from(n)).sqrt();
            [self.at_m[0] + radius_m * cosine, self.at_m[1] + radius_m * sine]
        };
        (0..n).map(corner).collect()
    }
}
