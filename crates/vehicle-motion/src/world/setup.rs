//! A world ready to run: vehicles, bodies in contact and their memory.

use crate::V3;
use crate::barrier::Barrier;
use crate::crush::law::{Law, Series};
use crate::crush::outline::{Node, Outline, of_body};
use crate::crush::touch::{NO_FACE, Pass, Pose, Shape};
use crate::hull::{Hull, HullMemory, Obstacle};
use crate::integrate::Stack;
use crate::rail::{Beam, BeamMemory};
use crate::slider::Slide;
use crate::state::State;
use crate::vehicle::{Memory, Vehicle};
use crate::world::{Begin, Partner, World, WorldError};

/// Vertical range of barriers, m.
const UPRIGHT_M: [f64; 2] = [-1e3, 1e3];
/// Least breadth of a block that is contacted by the nodes of the car; a narrower one uses its own nodes, m.
const BROAD_M: f64 = 1.5;
/// Node spacing of narrow bodies, m.
const NARROW_M: f64 = 0.02;

/// Two bodies that may touch.
#[derive(Clone, Debug)]
pub(crate) struct Pair {
    pub car: usize,
    pub partner: Partner,
    /// The body of the partner.
    pub body: usize,
    /// Its passes.
    pub passes: core::ops::Range<usize>,
    /// The rail, if it is one, and the start of its state.
    pub rail: Option<usize>,
    /// Whether the contact has forces; impacts by impulse only detect its start.
    pub is_felt: bool,
}

/// A world ready to run.
pub(crate) struct Setup<'a> {
    pub world: &'a World,
    pub vehicles: Vec<Vehicle>,
    pub laws: Vec<Vec<Law>>,
    pub shapes: Vec<Shape>,
    pub passes: Vec<Pass>,
    pub pairs: Vec<Pair>,
    /// For each barrier: its body, position, and slider.
    pub solids: Vec<Solid>,
    pub hulls: Vec<Hull>,
    pub rails: Vec<Rails>,
    /// Lengths of the lists of largest forces.
    lists: Vec<usize>,
}

/// A barrier as a body.
pub(crate) struct Solid {
    pub at_m: V3,
    pub slide: Option<Slide>,
}

/// A rail, and where it stands among the numbers that move besides the vehicles.
pub(crate) struct Rails {
    pub barrier: usize,
    pub beam: Beam,
    pub at: core::ops::Range<usize>,
    /// By car and law of its nodes.
    pub series: Vec<Vec<Series>>,
}

/// State stored between steps.
#[derive(Clone, Debug)]
pub(crate) struct Memories {
    pub vehicles: Vec<Memory>,
    /// By pass and node: the face through which it entered.
    pub faces: Vec<Vec<u8>>,
    /// By list and node: the largest force per width, N/m.
    pub most: Vec<Vec<f64>>,
    /// By barrier: largest way and its direction.
    pub slides: Vec<crate::slider::SlideMemory>,
    /// Rails.
    pub rails: Vec<BeamMemory>,
    /// Hulls on the ground.
    pub hulls: Vec<HullMemory>,
    /// Poses at the last accepted step.
    pub poses: Vec<Pose>,
}

impl<'a> Setup<'a> {
    pub fn new(world: &'a World) -> Result<Self, WorldError> {
        let vehicle = |(car, entry): (usize, &super::Entry)| {
            Vehicle::new(&entry.car, entry.driver.clone()).map_err(|what| WorldError::Car { car, what })
        };
        let vehicles: Vec<Vehicle> = world.cars.iter().enumerate().map(vehicle).collect::<Result<_, _>>()?;
        let (mut shapes, mut laws, mut lists) = (Vec::new(), Vec::new(), Vec::new());
        for vehicle in &vehicles {
            let (outline, nodes, of_faces) = of_body(&vehicle.body, vehicle.chassis.height_m());
            lists.push(nodes.len());
            shapes.push(Shape::new(outline, nodes));
            laws.push(of_faces);
        }
        let mut setup = Setup {
            rails: Vec::new(),
            hulls: Vec::new(),
            world,
            vehicles,
            laws,
            shapes,
            passes: Vec::new(),
            pairs: Vec::new(),
            solids: Vec::new(),
            lists,
        };
        for (number, barrier) in world.barriers.iter().enumerate() {
            setup.add_barrier(number, barrier)?;
        }
        setup.pair_cars();
        let obstacles = setup.obstacles();
        let hull = |v: &Vehicle| Hull::of(&v.body, v.chassis.height_m(), v.chassis.tyre().radius_m, obstacles.clone());
        setup.hulls = setup.vehicles.iter().map(hull).collect();
        Ok(setup)
    }

    /// Barriers that stand.
    fn obstacles(&self) -> Vec<Obstacle> {
        let first = self.vehicles.len();
        let of = |(i, barrier): (usize, &Barrier)| {
            let friction = match barrier {
                Barrier::Wall(own) => own.friction,
                Barrier::Pole(own) => own.friction,
                Barrier::Block(own) => own.friction,
                Barrier::Rail(_) | Barrier::Slider(_) => return None,
            };
            Some(Obstacle { outline: self.shapes[first + i].outline.clone(), at_m: self.solids[i].at_m, friction })
        };
        self.world.barriers.iter().enumerate().filter_map(of).collect()
    }

    fn is_by_impulse(&self, car: usize, partner: Partner) -> bool {
        self.world.impulses.iter().any(|impact| {
            let (first, second) = impact.between;
            (first, second) == (car, partner) || (Partner::Car(first), second) == (partner, Partner::Car(car))
        })
    }

    fn pair_cars(&mut self) {
        for car in 0..self.vehicles.len() {
            for other in car + 1..self.vehicles.len() {
                let from = self.passes.len();
                for (nodes_of, outline_of) in [(car, other), (other, car)] {
                    let series = self.series(nodes_of, Some(outline_of));
                    self.passes.push(Pass {
                        nodes_of,
                        outline_of,
                        memory: nodes_of,
                        weight: 0.5,
                        friction: self.world.friction,
                        series,
                        columns: self.laws[outline_of].len(),
                        rubbing: [0.5; 2],
                        outline_crushes: false,
                    });
                }
                let partner = Partner::Car(other);
                let is_felt = !self.is_by_impulse(car, partner);
                self.pairs.push(Pair {
                    car,
                    partner,
                    body: other,
                    passes: from..self.passes.len(),
                    rail: None,
                    is_felt,
                });
            }
        }
    }

    fn series(&self, first: usize, second: Option<usize>) -> Vec<Series> {
        let of = |law: &Law| match second {
            None => vec![Series::of(law, None)],
            Some(other) => self.laws[other].iter().map(|partner| Series::of(law, Some(partner))).collect(),
        };
        self.laws[first].iter().flat_map(of).collect()
    }

    fn add_barrier(&mut self, number: usize, barrier: &Barrier) -> Result<(), WorldError> {
        let wrong = |what| WorldError::Barrier { barrier: number, what };
        let (corners_m, friction) = match barrier {
            Barrier::Wall(wall) => {
                let (sine, cosine) = libm::sincos(wall.normal_rad);
                let outline = Outline::half_space([0.0; 2], [cosine, sine], UPRIGHT_M);
                let at_m = V3::new(wall.point_m[0], wall.point_m[1], 0.0);
                self.add_solid(number, outline, at_m, wall.friction, true, None);
                return Ok(());
            }
            Barrier::Rail(rail) => return self.add_rail(number, Beam::new(rail).map_err(wrong)?),
            Barrier::Pole(pole) if pole.radius_m.is_nan() || pole.radius_m <= 0.0 => {
                return Err(wrong("a pole needs a radius above 0"));
            }
            Barrier::Pole(pole) => (pole.corners_m(), pole.friction),
            Barrier::Block(block) => (block.corners_m.clone(), block.friction),
            Barrier::Slider(slider) => (slider.corners_m.clone(), slider.friction),
        };
        if !is_convex(&corners_m) {
            return Err(wrong("its corners must go round a convex polygon, clockwise from above"));
        }
        let slide = match barrier {
            Barrier::Slider(slider) => Some(Slide::new(slider).map_err(wrong)?),
            _ => None,
        };
        let n = corners_m.len() as f64;
        let [x, y] = [0, 1].map(|i| corners_m.iter().map(|corner| corner[i]).sum::<f64>() / n);
        let around: Vec<[f64; 2]> = corners_m.iter().map(|corner| [corner[0] - x, corner[1] - y]).collect();
        let outline = Outline::of_corners(&around, UPRIGHT_M);
        let is_broad = outline.breadth_m(&around) >= BROAD_M;
        self.add_solid(number, outline, V3::new(x, y, 0.0), friction, is_broad, slide);
        Ok(())
    }

    fn add_rail(&mut self, number: usize, beam: Beam) -> Result<(), WorldError> {
        let body = self.shapes.len();
        let at = self.rails.last().map_or(2 * self.world.barriers.len(), |rail| rail.at.end);
        let at = at..at + 2 * beam.count;
        let outline = Outline::half_space([0.0; 2], [1.0, 0.0], UPRIGHT_M);
        self.shapes.push(Shape::new(outline, Vec::new()));
        self.solids.push(Solid { at_m: V3::zeros(), slide: None });
        for car in 0..self.vehicles.len() {
            let passes = self.passes.len()..self.passes.len();
            let partner = Partner::Barrier(number);
            let is_felt = !self.is_by_impulse(car, partner);
            self.pairs.push(Pair { car, partner, body, passes, rail: Some(self.rails.len()), is_felt });
        }
        let series = (0..self.vehicles.len()).map(|car| self.series(car, None)).collect();
        self.rails.push(Rails { barrier: number, beam, at, series });
        Ok(())
    }

    fn add_solid(
        &mut self,
        number: usize,
        outline: Outline,
        at_m: V3,
        friction: f64,
        is_broad: bool,
        slide: Option<Slide>,
    ) {
        let body = self.shapes.len();
        let nodes = if is_broad { Vec::new() } else { self.narrow_nodes(&outline, at_m) };
        for car in 0..self.vehicles.len() {
            let from = self.passes.len();
            let of_car = self.series(car, None);
            let pass = Pass {
                nodes_of: car,
                outline_of: body,
                memory: car,
                weight: 1.0,
                friction,
                series: of_car,
                columns: 1,
                rubbing: [1.0, 0.0],
                outline_crushes: false,
            };
            if is_broad {
                self.passes.push(pass);
            } else {
                let columns = pass.series.len();
                let memory = self.lists.len();
                self.lists.push(nodes.len());
                self.passes.push(Pass {
                    nodes_of: body,
                    outline_of: car,
                    memory,
                    columns,
                    rubbing: [0.0, 1.0],
                    outline_crushes: true,
                    ..pass
                });
            }
            let partner = Partner::Barrier(number);
            let is_felt = !self.is_by_impulse(car, partner);
            self.pairs.push(Pair { car, partner, body, passes: from..self.passes.len(), rail: None, is_felt });
        }
        self.shapes.push(Shape::new(outline, nodes));
        self.solids.push(Solid { at_m, slide });
    }

    /// Nodes of a narrow barrier, in the rows of the first car's ends over the ground there.
    fn narrow_nodes(&self, outline: &Outline, at_m: V3) -> Vec<Node> {
        let ground_m = self.world.ground.height_m(at_m.x, at_m.y);
        let rows = self.vehicles.first().map_or(&[][..], |vehicle| &vehicle.body.crush.end_rows);
        rows.iter().flat_map(|row| outline.nodes(NARROW_M, -(ground_m + row.height_m), row.share)).collect()
    }

    /// Where two bodies come nearest: the node of least gap, X and Y, m; none if they pass over each other, or the vehicle
    /// is beyond the ends of a rail.
    pub fn first_touch_m(&self, car: usize, body: usize, stack: &Stack, poses: &[Pose]) -> Option<[f64; 2]> {
        let pair = self.pairs.iter().find(|pair| pair.car == car && pair.body == body)?;
        let (_, place) = match pair.rail {
            Some(number) => {
                let Rails { beam, at, .. } = &self.rails[number];
                beam.nearest(&stack.more[at.clone()], &self.shapes[car], &poses[car])?
            }
            None => {
                let passes = &self.passes[pair.passes.clone()];
                let nearest = passes.iter().filter_map(|pass| pass.nearest(&self.shapes, poses));
                nearest.min_by(|a, b| a.0.total_cmp(&b.0))?
            }
        };
        Some([place.x, place.y])
    }

    /// How far outside of a body's outline in plan a place lies, at least, m; 0 within it.
    pub fn outside_m(&self, body: usize, [x, y]: [f64; 2], stack: &Stack, poses: &[Pose]) -> f64 {
        let (pose, first) = (&poses[body], self.vehicles.len());
        let place_m = V3::new(x, y, pose.at_m.z);
        let rail = self.rails.iter().find(|rail| first + rail.barrier == body);
        match rail {
            Some(Rails { beam, at, .. }) => beam.off_m(&stack.more[at.clone()], [x, y]),
            None => self.shapes[body].outline.gap_m(&(pose.axes.transpose() * (place_m - pose.at_m))).max(0.0),
        }
    }

    /// Deepest crush of a vehicle so far, m.
    pub fn deepest_m(&self, car: usize, memories: &Memories) -> f64 {
        let hit = self.shapes[car].nodes.iter().zip(&memories.most[car]).filter(|(_, most)| **most > 0.0);
        hit.map(|(node, most)| self.laws[car][node.law].crush_m(*most)).fold(0.0, f64::max)
    }

    pub fn memories(&self) -> Memories {
        Memories {
            vehicles: self.vehicles.iter().map(|_| Memory::new()).collect(),
            faces: self.passes.iter().map(|pass| vec![NO_FACE; self.shapes[pass.nodes_of].nodes.len()]).collect(),
            most: self.lists.iter().map(|n| vec![0.0; *n]).collect(),
            slides: self.solids.iter().map(|_| Default::default()).collect(),
            rails: self.rails.iter().map(|rail| rail.beam.memory()).collect(),
            hulls: self.hulls.iter().map(Hull::memory).collect(),
            poses: Vec::new(),
        }
    }

    /// States of the vehicles at the start.
    pub fn begin(&self) -> Vec<State> {
        let state = |(vehicle, entry): (&Vehicle, &super::Entry)| match &entry.begin {
            Begin::At(start) => vehicle.chassis.state_at(start, &self.world.ground),
            Begin::State(state) => *state,
        };
        self.vehicles.iter().zip(&self.world.cars).map(state).collect()
    }
}

fn is_convex(corners_m: &[[f64; 2]]) -> bool {
    let n = corners_m.len();
    let turns = |i: usize| {
        let [a, b, c] = [0, 1, 2].map(|j| corners_m[(i + j) % n]);
        (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
    };
    n >= 3 && (0..n).all(|i| turns(i) > 0.0)
}
