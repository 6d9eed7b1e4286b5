//! What stands beside the road and does not drive.

/// A barrier. Places are X and Y in vehicle-space, m.
#[derive(Clone, Debug, PartialEq)]
pub enum Barrier {
    /// A rigid wall without end: all that lies behind a line.
    Wall(Wall),
    /// A rigid upright cylinder.
    Pole(Pole),
    /// A rigid upright prism.
    Block(Block),
    /// A mass that a force holds back over its way: a cushion, or a sign on a breakaway base.
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

/// A mass on a straight way, held back by a force.
#[derive(Clone, Debug, PartialEq)]
pub struct Slider {
    /// Corners of its convex outline, clockwise from above.
    pub corners_m: Vec<[f64; 2]>,
    /// Mass that a car has to take along, kg.
    pub mass_kg: f64,
    /// Direction of its way, clockwise from X, rad; none: that of the vehicle that hits it.
    pub direction_rad: Option<f64>,
    /// Force over its way: m and N, from 0; straight between.
    pub force_n: Vec<[f64; 2]>,
    /// Share of the energy that comes back.
    pub returned: f64,
    /// What holds behind the end of the force's table.
    pub end: End,
    /// Friction.
    pub friction: f64,
}

/// Behind the end of the way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// It stands: a cushion.
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
