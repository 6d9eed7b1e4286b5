//! A drawing in SVG, element by element.
//!
//! Numbers are written with two decimals of a user unit (a pixel at 96 dpi), texts escaped, so that nothing that a user
//! named can break out of its place.

pub use occupant_files::base::escape;
use std::fmt::Write as _;

use super::font::{self, Weight};
use placed_text::trimmed;

/// A drawing under construction; x to the right, y down, user units.
#[derive(Clone, Debug)]
pub struct Svg {
    size: [f64; 2],
    title: String,
    body: String,
    open: usize,
}

/// Anchor of a text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Anchor {
    /// Its start.
    #[default]
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

/// Style of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Text<'a> {
    /// Font size.
    pub size: f64,
    /// Colour.
    pub fill: &'a str,
    /// Anchor.
    pub anchor: Anchor,
    /// Font weight.
    pub weight: Weight,
    /// Rotation about the anchor, degrees clockwise.
    pub turn_deg: f64,
    /// Colour of an outline that keeps it legible over lines.
    pub halo: Option<&'a str>,
}

impl Default for Text<'_> {
    fn default() -> Self {
        Text { size: 12.0, fill: "#222222", anchor: Anchor::Start, weight: Weight::Regular, turn_deg: 0.0, halo: None }
    }
}

impl Svg {
    /// An empty drawing with a title for screen readers.
    pub fn new(width: f64, height: f64, title: &str) -> Self {
        Svg { size: [width, height], title: title.to_owned(), body: String::new(), open: 0 }
    }

    /// Begins a group; `attributes` as in SVG, such as `stroke="#000" fill="none"`.
    pub fn begin(&mut self, attributes: &str) {
        self.line(&format!("<g {attributes}>"));
        self.open += 1;
    }

    /// Begins a group clipped to a rectangle.
    pub fn begin_clip(&mut self, id: &str, x: f64, y: f64, width: f64, height: f64) {
        let (id, area) = (escape(id), rectangle(x, y, width, height));
        self.line(&format!("<clipPath id=\"{id}\"><rect {area}/></clipPath>"));
        self.begin(&format!("clip-path=\"url(#{id})\""));
    }

    /// Ends the last group begun.
    pub fn end(&mut self) {
        self.open = self.open.saturating_sub(1);
        self.line("</g>");
    }

    /// Adds a tooltip to the present group.
    pub fn tip(&mut self, text: &str) {
        self.line(&format!("<title>{}</title>", escape(text)));
    }

    /// A rectangle.
    pub fn rect(&mut self, x: f64, y: f64, width: f64, height: f64, attributes: &str) {
        let area = rectangle(x, y, width, height);
        self.line(&format!("<rect {area} {attributes}/>"));
    }

    /// A line through points.
    pub fn polyline(&mut self, points: &[[f64; 2]], attributes: &str) {
        self.line(&format!("<polyline points=\"{}\" {attributes}/>", list(points)));
    }

    /// Adds a polygon.
    pub fn polygon(&mut self, points: &[[f64; 2]], attributes: &str) {
        self.line(&format!("<polygon points=\"{}\" {attributes}/>", list(points)));
    }

    /// A straight line.
    pub fn segment(&mut self, from: [f64; 2], to: [f64; 2], attributes: &str) {
        let [x1, y1, x2, y2] = [from[0], from[1], to[0], to[1]].map(number);
        self.line(&format!("<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" {attributes}/>"));
    }

    /// Adds a circle.
    pub fn circle(&mut self, centre: [f64; 2], radius: f64, attributes: &str) {
        let [x, y, r] = [centre[0], centre[1], radius].map(number);
        self.line(&format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" {attributes}/>"));
    }

    /// Dots as wide as their line, whose caps must be round: a single element for any number.
    pub fn dots(&mut self, centres: &[[f64; 2]], attributes: &str) {
        let mut data = String::with_capacity(14 * centres.len());
        for [x, y] in centres {
            let _ = write!(data, "M{} {}h.01", number(*x), number(*y));
        }
        self.path(&data, attributes);
    }

    /// A path; `data` as in SVG.
    pub fn path(&mut self, data: &str, attributes: &str) {
        self.line(&format!("<path d=\"{data}\" {attributes}/>"));
    }

    /// A text with its base line at a point.
    pub fn text(&mut self, at: [f64; 2], text: &str, style: &Text<'_>) {
        let [x, y] = at.map(number);
        let mut tag = format!("<text x=\"{x}\" y=\"{y}\"");
        let mut put = |name: &str, value: &str| {
            let _ = write!(tag, " {name}=\"{}\"", escape(value));
        };
        put("font-size", &number(style.size));
        put("fill", style.fill);
        match style.anchor {
            Anchor::Start => {}
            Anchor::Middle => put("text-anchor", "middle"),
            Anchor::End => put("text-anchor", "end"),
        }
        if style.weight == Weight::Bold {
            put("font-weight", "bold");
        }
        if style.turn_deg != 0.0 {
            put("transform", &format!("rotate({} {x} {y})", number(style.turn_deg)));
        }
        if let Some(halo) = style.halo {
            put("stroke", halo);
            put("stroke-width", &number(0.25 * style.size));
            put("stroke-linejoin", "round");
            put("paint-order", "stroke");
        }
        let text = escape(text);
        self.line(&format!("{tag}>{text}</text>"));
    }

    /// The whole file.
    pub fn finish(self) -> String {
        format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{}", self.inline())
    }

    /// The drawing as an element of an HTML page.
    pub fn inline(mut self) -> String {
        while self.open > 0 {
            self.end();
        }
        let [width, height] = self.size.map(number);
        let title = escape(&self.title);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" \
             height=\"{height}\" viewBox=\"0 0 {width} {height}\" font-family=\"{family}\" role=\"img\">\n\
             <title>{title}</title>\n{body}</svg>\n",
            family = font::FAMILY,
            body = self.body
        )
    }

    fn line(&mut self, element: &str) {
        let _ = writeln!(self.body, "{:open$}{element}", "", open = self.open);
    }
}

/// A number in SVG: two decimals, no trailing zeros, 0 for NaN.
pub fn number(value: f64) -> String {
    if !value.is_finite() {
        return "0".to_owned();
    }
    let text = trimmed(value, 2);
    if text == "-0" { "0".to_owned() } else { text }
}

fn list(points: &[[f64; 2]]) -> String {
    let pair = |[x, y]: &[f64; 2]| format!("{},{}", number(*x), number(*y));
    points.iter().map(pair).collect::<Vec<_>>().join(" ")
}

fn rectangle(x: f64, y: f64, width: f64, height: f64) -> String {
    let [x, y, width, height] = [x, y, width, height].map(number);
    format!("x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let cases = [(1.0, "1"), (-0.001, "0"), (2.345, "2.35"), (-10.5, "-10.5"), (100.0, "100")];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
        assert_eq!(number(f64::NAN), "0");
    }

    #[test]
    fn a_text_stays_a_text() {
        let mut svg = Svg::new(10.0, 10.0, "</title><script>");
        svg.begin("fill=\"none\"");
        svg.text([1.0, 2.0], "a<b & \"c\"\u{0}", &Text::default());
        let text = svg.finish();
        assert!(text.contains("a&lt;b &amp; &quot;c&quot;\u{fffd}"));
        assert!(!text.contains("<script>"));
        // groups left open are closed
        assert_eq!(text.matches("</g>").count(), 1);
    }
}
