//! Positions of the panels on the sheet.

use super::Strip;
use super::projection::View;
use super::window::Window;
use crate::font::{self, Weight};

/// Largest number of times per row.
const COLUMNS: usize = 6;
/// Width of the widest panel of a strip.
pub const PANEL: f64 = 230.0;
/// Width of the widest panel of a film.
pub const FILM_PANEL: f64 = 660.0;
/// Width of the widest panel of a strip with dimensions.
pub const DIMENSIONS_PANEL: f64 = 760.0;
/// Space on the left for the names of the views.
pub const LEFT: f64 = 84.0;
/// Space beside the title and the legend.
pub const MARGIN: f64 = 12.0;
/// Space on top for the title.
const TOP: f64 = 52.0;
/// Space above a block for its times.
pub const TIMES: f64 = 24.0;
/// Between panels.
const GAP: f64 = 8.0;
/// Space below for scales and legend.
const FOOT: f64 = 74.0;
/// Least width, for the legend.
const LEAST_WIDTH: f64 = 760.0;
/// The title.
pub const HEADING: (f64, Weight) = (15.0, Weight::Bold);

/// Layout of a sheet, in user units.
pub struct Layout {
    /// User units per metre.
    pub scale: f64,
    /// The region shown in the panels.
    pub window: Window,
    /// Width of the sheet.
    pub width: f64,
    /// Height of the sheet.
    pub height: f64,
    views: Vec<View>,
    /// Width of a column.
    pub column: f64,
    columns: usize,
    block: f64,
}

impl Layout {
    /// Layout of a sheet with this many moments, its widest panel this wide.
    pub fn of(strip: &Strip<'_>, shown: usize, panel: f64) -> Self {
        let window = Window::of(strip);
        let widths = strip.views.iter().map(|v| window.size_m(*v)[0]);
        let widest = widths.fold(0.0, f64::max);
        let scale = panel / widest.max(1e-3);
        let columns = shown.clamp(1, COLUMNS);
        let blocks = shown.div_ceil(columns).max(1);
        let (views, column) = (strip.views.clone(), widest * scale);
        let title = 2.0 * MARGIN + font::width(&strip.model.setup().title, HEADING.0, HEADING.1);
        let width = (LEFT + columns as f64 * (column + GAP) + GAP).max(LEAST_WIDTH).max(title);
        let mut layout = Layout { scale, window, width, height: 0.0, views, column, columns, block: 0.0 };
        layout.block = TIMES + layout.rows_above(layout.views.len());
        layout.height = TOP + blocks as f64 * layout.block + FOOT;
        layout
    }

    /// Upper left corner, width and height of a moment's panel in a row, centred in its column.
    pub fn panel(&self, moment: usize, row: usize) -> ([f64; 2], [f64; 2]) {
        let size = self.window.size_m(self.views[row]).map(|m| m * self.scale);
        let [x, y] = self.head(moment);
        let aside = 0.5 * (self.column - size[0]);
        ([x + aside, y + TIMES + self.rows_above(row)], size)
    }

    /// Upper left corner of a moment's column.
    pub fn head(&self, moment: usize) -> [f64; 2] {
        let (block, column) = (moment / self.columns, moment % self.columns);
        [LEFT + column as f64 * (self.column + GAP), TOP + block as f64 * self.block]
    }

    /// Whether a moment is the first of its row block.
    pub fn begins_block(&self, moment: usize) -> bool {
        moment.is_multiple_of(self.columns)
    }

    /// Top of the area for scales and legend.
    pub fn foot(&self) -> f64 {
        self.height - FOOT
    }

    fn rows_above(&self, row: usize) -> f64 {
        let heights = self.views[..row].iter().map(|v| self.window.size_m(*v)[1]);
        heights.map(|m| m * self.scale + GAP).sum()
    }
}
