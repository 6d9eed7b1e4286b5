//! Content of a plot, before layout.

/// One plot.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Heading.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Curves in the order of the legend.
    pub curves: Vec<Curve>,
    /// Limits on the vertical axis.
    pub limits: Vec<Limit>,
    /// Text in the middle if there is no curve.
    pub empty: String,
}

/// An axis.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Name of the quantity.
    pub name: String,
    /// Symbol of the unit.
    pub unit: String,
    /// Words at 0, 1, 2, … instead of numbers; empty for an axis of numbers. On the vertical axis they run downward.
    pub words: Vec<String>,
    /// Values that a numeric axis always includes.
    pub includes: Option<[f64; 2]>,
    /// Whether points are given as decimal logarithms.
    pub is_of_powers: bool,
}

impl Axis {
    /// An axis of numbers.
    pub fn of(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Axis { name: name.into(), unit: unit.into(), words: Vec::new(), includes: None, is_of_powers: false }
    }

    /// The range extended by the values always included.
    fn widened(&self, [low, high]: [f64; 2]) -> [f64; 2] {
        self.includes.map_or([low, high], |[from, to]| [low.min(from), high.max(to)])
    }

    /// An axis of words.
    pub fn of_words(name: impl Into<String>, words: Vec<String>) -> Self {
        Axis { words, ..Axis::of(name, "") }
    }
}

/// A curve: points in the units of the axes, a gap where a number is not finite.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Label in the legend.
    pub label: String,
    /// Its style.
    pub style: Style,
    /// Points in their order.
    pub points: Vec<[f64; 2]>,
}

impl Curve {
    /// A curve through points.
    pub fn new(label: impl Into<String>, style: Style, points: Vec<[f64; 2]>) -> Self {
        Curve { label: label.into(), style, points }
    }

    /// The drawable points.
    pub fn drawn(&self) -> impl Iterator<Item = &[f64; 2]> {
        self.points.iter().filter(|point| drawable(point))
    }
}

/// Style of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// CSS colour.
    pub colour: &'static str,
    /// SVG dash pattern; solid if empty.
    pub dash: &'static str,
    /// Width of the line, or of a dot.
    pub width: f64,
    /// Line, dots or area.
    pub mark: Mark,
}

/// Style of the points of a curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mark {
    /// A line through them.
    #[default]
    Line,
    /// Points alone.
    Dots,
    /// A filled area around them.
    Area,
}

/// A level that should not be passed.
#[derive(Clone, Debug)]
pub struct Limit {
    /// Label in the legend.
    pub label: String,
    /// Level in the unit of the vertical axis.
    pub level: f64,
}

/// Colours that most colour-blind people can distinguish (Okabe and Ito, 2008), without their yellow, which is weak on
/// white paper.
const COLOURS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#666666"];
const DASHES: [&str; 4] = ["", "7 3", "2 2.5", "9 3 2 3"];
/// Style of a limit.
pub const LIMIT: Style = Style { colour: "#c00000", dash: "5 3", width: 1.1, mark: Mark::Line };

impl Style {
    /// Number of colours.
    pub const COLOURS: usize = COLOURS.len();
    /// Number of dash patterns, including the solid line.
    pub const DASHES: usize = DASHES.len();
    /// Number of different styles.
    pub const DISTINCT: usize = COLOURS.len() * DASHES.len();

    /// Style of a curve: colours by `colour`, dashes by `dash`; when colours repeat, the dash changes.
    pub fn of(colour: usize, dash: usize) -> Self {
        let dash = dash + colour / COLOURS.len();
        Style { dash: DASHES[dash % DASHES.len()], ..Style::line(COLOURS[colour % COLOURS.len()], 1.5) }
    }

    /// Measured curves: black.
    pub fn measured(dash: usize) -> Self {
        Style { colour: "#000000", dash: DASHES[dash % DASHES.len()], width: 1.2, mark: Mark::Line }
    }

    /// A solid line of this width: a bar, a whisker.
    pub fn line(colour: &'static str, width: f64) -> Self {
        Style { colour, dash: "", width, mark: Mark::Line }
    }

    /// Points of a diameter, in pixels.
    pub fn dots(colour: &'static str, diameter: f64) -> Self {
        Style { mark: Mark::Dots, ..Style::line(colour, diameter) }
    }

    /// An area.
    pub fn area(colour: &'static str) -> Self {
        Style { mark: Mark::Area, ..Style::line(colour, 0.0) }
    }

    /// SVG attributes.
    pub fn attributes(&self) -> String {
        if self.mark == Mark::Area {
            return format!("fill=\"{}\" fill-opacity=\"0.7\" stroke=\"none\"", self.colour);
        }
        let ends = if self.mark == Mark::Dots { " stroke-linecap=\"round\"" } else { "" };
        let dash = match self.dash {
            "" => String::new(),
            dash => format!(" stroke-dasharray=\"{dash}\""),
        };
        format!(
            "fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"{ends}{dash}",
            self.colour, self.width
        )
    }
}

/// Space above a limit, relative to its level.
const LIMIT_ROOM: f64 = 0.02;
/// Largest magnitude that is drawn; larger numbers are left out.
const GREATEST: f64 = 1e300;

/// Whether a point can be drawn.
pub fn drawable(point: &[f64; 2]) -> bool {
    point.iter().all(|value| value.abs() <= GREATEST)
}

impl Figure {
    /// Curves alone, over the axes across and upward.
    pub fn new(title: &str, [x, y]: [Axis; 2], curves: Vec<Curve>) -> Self {
        Figure { title: title.to_owned(), x, y, curves, limits: Vec::new(), empty: "nothing to draw".to_owned() }
    }

    /// The drawable limits.
    pub fn drawn_limits(&self) -> impl Iterator<Item = &Limit> {
        self.limits.iter().filter(|limit| drawable(&[0.0, limit.level]))
    }

    /// Least and largest of X and of Y, limits included; none without a point.
    pub fn extent(&self) -> Option<[[f64; 2]; 2]> {
        let mut extent: Option<[[f64; 2]; 2]> = None;
        for point in self.curves.iter().flat_map(Curve::drawn) {
            let [x, y] = extent.get_or_insert([[point[0]; 2], [point[1]; 2]]);
            *x = [x[0].min(point[0]), x[1].max(point[0])];
            *y = [y[0].min(point[1]), y[1].max(point[1])];
        }
        if let Some([_, y]) = &mut extent {
            for limit in self.drawn_limits() {
                // room on both sides, so that no limit falls together with the frame
                let room = LIMIT_ROOM * limit.level.abs();
                *y = [y[0].min(limit.level - room), y[1].max(limit.level + room)];
            }
        }
        extent.map(|[x, y]| [self.x.widened(x), self.y.widened(y)])
    }
}
