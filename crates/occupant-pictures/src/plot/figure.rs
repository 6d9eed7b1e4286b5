//! Content of a plot, before layout.

/// One plot.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Heading.
    pub title: String,
    /// Across.
    pub x: Axis,
    /// Upward.
    pub y: Axis,
    /// Curves in the order of the legend.
    pub curves: Vec<Curve>,
    /// Limits on Y.
    pub limits: Vec<Limit>,
    /// What stands in the middle if there is no curve.
    pub empty: String,
}

/// An axis.
#[derive(Clone, Debug)]
pub struct Axis {
    /// What it shows.
    pub name: String,
    /// Symbol of the unit.
    pub unit: String,
    /// Words that stand at 0, 1, 2, …, instead of figures; empty for an axis of numbers. Upward they go down the page.
    pub words: Vec<String>,
    /// Least and largest value that an axis of numbers shows whatever the curves need.
    pub includes: Option<[f64; 2]>,
    /// Whether points stand at the decimal logarithms of their values.
    pub is_of_powers: bool,
}

impl Axis {
    /// An axis of numbers.
    pub fn of(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Axis { name: name.into(), unit: unit.into(), words: Vec::new(), includes: None, is_of_powers: false }
    }

    /// A range that covers `range` and what is to be shown at any rate.
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
    /// For the legend.
    pub label: String,
    /// How it is drawn.
    pub style: Style,
    /// Points in their order.
    pub points: Vec<[f64; 2]>,
}

impl Curve {
    /// A curve through points.
    pub fn new(label: impl Into<String>, style: Style, points: Vec<[f64; 2]>) -> Self {
        Curve { label: label.into(), style, points }
    }

    /// The points that can be drawn.
    pub fn drawn(&self) -> impl Iterator<Item = &[f64; 2]> {
        self.points.iter().filter(|point| drawable(point))
    }
}

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// As in CSS.
    pub colour: &'static str,
    /// SVG dash pattern; solid if empty.
    pub dash: &'static str,
    /// Width of the line, or of a dot.
    pub width: f64,
    /// Line, dots or area.
    pub mark: Mark,
}

/// What stands at the points of a curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mark {
    /// A line through them.
    #[default]
    Line,
    /// Points alone.
    Dots,
    /// They go round an area.
    Area,
}

/// A level that should not be passed.
#[derive(Clone, Debug)]
pub struct Limit {
    /// For the legend.
    pub label: String,
    /// Level in the unit of Y.
    pub level: f64,
}

/// Colours that most colour-blind people tell apart (Okabe and Ito, 2008), their yellow left out for white paper.
const COLOURS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#666666"];
const DASHES: [&str; 4] = ["", "7 3", "2 2.5", "9 3 2 3"];
/// Of a limit.
pub const LIMIT: Style = Style { colour: "#c00000", dash: "5 3", width: 1.1, mark: Mark::Line };

impl Style {
    /// How many colours there are.
    pub const COLOURS: usize = COLOURS.len();
    /// Dash patterns, the solid line counted.
    pub const DASHES: usize = DASHES.len();
    /// Styles that differ.
    pub const DISTINCT: usize = COLOURS.len() * DASHES.len();

    /// The style of a curve: colours by `colour`, dashes by `dash`; colours that come round again bring the next dash.
    pub fn of(colour: usize, dash: usize) -> Self {
        let dash = dash + colour / COLOURS.len();
        Style { dash: DASHES[dash % DASHES.len()], ..Style::line(COLOURS[colour % COLOURS.len()], 1.5) }
    }

    /// Measured curves: black.
    pub fn measured(dash: usize) -> Self {
        Style { colour: "#000000", dash: DASHES[dash % DASHES.len()], width: 1.2, mark: Mark::Line }
    }

    /// A solid line of any width: a bar, a whisker.
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

    /// As attributes of SVG.
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

/// Room beyond a limit, over its level.
const LIMIT_ROOM: f64 = 0.02;
/// Largest magnitude that is drawn; greater numbers count as none.
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

    /// The limits that can be drawn.
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
