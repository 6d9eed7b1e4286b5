//! Round ticks for a range.

use occupant_units::trig;
use placed_text::trimmed;

/// Range of an axis, its ticks, and their format.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    /// Least and largest value shown.
    pub range: [f64; 2],
    /// Ticks, increasing.
    pub ticks: Vec<f64>,
    /// Power of ten moved from the ticks to the axis label.
    pub exponent: i32,
    decimals: usize,
    /// Words at the ticks 0, 1, 2, … instead of numbers.
    words: Vec<String>,
    /// Whether ticks are decimal logarithms of their labels.
    is_of_powers: bool,
}

impl Scale {
    /// A scale with about `count` ticks that covers a range and ends on ticks.
    ///
    /// A range without extent (a constant) is widened around its value; zero is included if it is near.
    pub fn new([low, high]: [f64; 2], count: usize) -> Self {
        let [low, high] = opened(low, high);
        let step = round_step((high - low) / count.max(1) as f64);
        // multiples of the step, counted, so that ticks carry no sums of rounding errors
        let first = (low / step + 1e-9).floor();
        let last = (high / step - 1e-9).ceil().max(first + 1.0);
        Self::counted(first, last, step)
    }

    /// A horizontal scale: the range unchanged, ticks inside it.
    pub fn inside([low, high]: [f64; 2], count: usize) -> Self {
        let size = low.abs().max(high.abs());
        let [low, high] = if high - low > SMALLEST.max(1e-12 * size) { [low, high] } else { opened(low, high) };
        let step = round_step((high - low) / count.max(1) as f64);
        let first = (low / step - 1e-6).ceil();
        let last = (high / step + 1e-6).floor();
        Scale { range: [low, high], ..Self::counted(first, last, step) }
    }

    /// A scale of words at 0, 1, 2, …; `downward` puts the first at its end.
    pub fn of_words(words: Vec<String>, downward: bool) -> Self {
        let ticks: Vec<f64> = (0..words.len()).map(|i| i as f64).collect();
        let beyond = words.len().max(1) as f64 - 0.5;
        Scale {
            range: if downward { [beyond, -0.5] } else { [-0.5, beyond] },
            ticks,
            exponent: 0,
            decimals: 0,
            words,
            is_of_powers: false,
        }
    }

    /// A logarithmic scale: ticks at powers of ten; if these are fewer than three, at 2 and 5 times these, at all multiples, or at
    /// round steps.
    pub fn of_powers([low, high]: [f64; 2]) -> Self {
        let [low, high] = if high - low > 1e-9 { [low, high] } else { [low - 0.1, high + 0.1] };
        let within = |times: &[f64]| -> Vec<f64> {
            let decades = (low.floor() as i32..=high.ceil() as i32).take(100);
            let all = decades.flat_map(|decade| times.iter().map(move |times| f64::from(decade) + trig::log10(*times)));
            all.filter(|tick| (low - 1e-9..=high + 1e-9).contains(tick)).collect()
        };
        let multiples: [&[f64]; 3] = [&[1.0], &[1.0, 2.0, 5.0], &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]];
        let finer = &multiples[usize::from(high - low <= 2.0)..];
        let steps = || {
            let linear = Scale::inside([low, high].map(|end| trig::pow(10.0, end)), 4).ticks;
            linear.into_iter().filter(|tick| *tick > 0.0).map(trig::log10).collect()
        };
        let ticks = finer.iter().map(|times| within(times)).find(|ticks| ticks.len() >= 3).unwrap_or_else(steps);
        Scale { range: [low, high], ticks, exponent: 0, decimals: 0, words: Vec::new(), is_of_powers: true }
    }

    /// Whether its ticks have words.
    pub fn has_words(&self) -> bool {
        !self.words.is_empty()
    }

    /// Ticks at the multiples of a step from the first to the last.
    fn counted(first: f64, last: f64, step: f64) -> Self {
        let count = (last - first + 1.0).max(0.0) as usize;
        let ticks: Vec<f64> = (0..count).map(|i| (first + i as f64) * step).collect();
        let greatest = ticks.iter().fold(0.0_f64, |m, t| m.max(t.abs()));
        let exponent = match greatest {
            g if g >= 1e5 || (g < 1e-2 && g > 0.0) => 3 * (trig::log10(g) / 3.0).floor() as i32,
            _ => 0,
        };
        let digits = (trig::log10(step) - f64::from(exponent) + 1e-9).floor();
        Scale {
            range: [ticks.first().copied().unwrap_or(0.0), ticks.last().copied().unwrap_or(1.0)],
            decimals: (-digits).clamp(0.0, 12.0) as usize,
            ticks,
            exponent,
            words: Vec::new(),
            is_of_powers: false,
        }
    }

    /// Label of a tick: a number without its power of ten, or a word.
    pub fn figures(&self, tick: f64) -> String {
        if self.has_words() {
            // ticks of words are 0, 1, 2, …
            return self.words.get(tick as usize).cloned().unwrap_or_default();
        }
        if self.is_of_powers {
            let value = trig::pow(10_f64, tick);
            return if (1e-3..1e5).contains(&value) { trimmed(value, 4) } else { format!("{value:.0e}") };
        }
        // in two factors: the power alone may be beyond what a double holds
        let half = self.exponent / 2;
        let value = tick * trig::powi(10.0, -half) * trig::powi(10.0, half - self.exponent);
        let text = format!("{value:.*}", self.decimals);
        let is_zero = text.bytes().all(|b| matches!(b, b'-' | b'0' | b'.'));
        // a true minus sign is as wide as a plus
        text.replace('-', if is_zero { "" } else { "−" })
    }

    /// Position of a value, 0 at the start of the range and 1 at its end.
    pub fn place(&self, value: f64) -> f64 {
        let [low, high] = self.range;
        // halves, so that no difference overflows
        (0.5 * value - 0.5 * low) / (0.5 * high - 0.5 * low)
    }
}

/// Smallest size that counts as different from zero.
const SMALLEST: f64 = 1e-290;

/// A range with nonzero extent, including zero if it is near.
fn opened(low: f64, high: f64) -> [f64; 2] {
    let size = low.abs().max(high.abs());
    // steps between smaller values would not be doubles
    if size < SMALLEST {
        return [-1.0, 1.0];
    }
    // what differs by rounding alone is a constant
    if high - low <= 1e-9 * size {
        return [low - 0.1 * size, high + 0.1 * size];
    }
    let span = high - low;
    match () {
        () if low > 0.0 && low <= span => [0.0, high],
        () if high < 0.0 && -high <= span => [low, 0.0],
        () => [low, high],
    }
}

/// The least of 1, 2, 5 times a power of ten that is at least `step`.
fn round_step(step: f64) -> f64 {
    let power = trig::powi(10.0, trig::log10(step).floor() as i32);
    let times = step / power;
    let round = [1.0, 2.0, 5.0, 10.0].into_iter().find(|r| times <= r + 1e-9);
    round.unwrap_or(10.0) * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_cover_the_range() {
        let scale = Scale::new([-3.2, 41.7], 5);
        assert_eq!(scale.ticks, [-10.0, 0.0, 10.0, 20.0, 30.0, 40.0, 50.0]);
        assert_eq!(scale.figures(-10.0), "−10");
        let scale = Scale::new([0.0, 0.37], 5);
        assert_eq!(scale.figures(scale.ticks[1]), "0.1");
        assert_eq!((scale.place(0.0), scale.place(0.4)), (0.0, 1.0));
    }

    #[test]
    fn a_constant_gets_room_and_rounding_is_no_variation() {
        for value in [9.81, -5.0, 1e-7, 3e12] {
            let scale = Scale::new([value, value * (1.0 + 1e-12)], 5);
            let [low, high] = scale.range;
            assert!(low < value && value < high && high - low > 0.1 * value.abs());
        }
        assert_eq!(Scale::new([0.0, 0.0], 4).range, [-1.0, 1.0]);
    }

    #[test]
    fn words_stand_at_their_numbers() {
        let words = vec!["a".to_owned(), "b".to_owned()];
        let down = Scale::of_words(words.clone(), true);
        assert_eq!((down.place(0.0), down.place(1.0)), (0.75, 0.25));
        let across = Scale::of_words(words, false);
        assert_eq!((across.place(0.0), across.place(1.0)), (0.25, 0.75));
        assert_eq!(across.figures(across.ticks[1]), "b");
    }

    #[test]
    fn powers_of_ten_move_into_the_label() {
        let scale = Scale::new([0.0, 2.4e6], 5);
        assert_eq!((scale.exponent, scale.figures(1e6).as_str()), (6, "1.0"));
        let scale = Scale::new([0.0, 3e-5], 3);
        assert_eq!((scale.exponent, scale.figures(1e-5).as_str()), (-6, "10"));
        assert_eq!(Scale::new([0.0, 9000.0], 5).exponent, 0);
    }

    #[test]
    fn powers_have_round_ticks() {
        let scale = Scale::of_powers([10_f64.log10(), 400_f64.log10()]);
        let figures: Vec<String> = scale.ticks.iter().map(|tick| scale.figures(*tick)).collect();
        assert_eq!(figures, ["10", "20", "50", "100", "200"]);
        let told = |from: f64, to: f64| {
            let scale = Scale::of_powers([from.log10(), to.log10()]);
            scale.ticks.iter().map(|tick| scale.figures(*tick)).collect::<Vec<_>>()
        };
        assert_eq!(told(2.0, 5.0), ["2", "3", "4", "5"]);
        assert_eq!(told(2.1, 2.9), ["2.2", "2.4", "2.6", "2.8"]);
        assert_eq!(told(30.0, 31.0), ["30", "30.5", "31"]);
        assert_eq!(told(0.6, 250.0), ["1", "10", "100"]);
        let wide = Scale::of_powers([-3.0, 3.0]);
        assert_eq!(wide.figures(wide.ticks[0]), "0.001");
        assert_eq!((wide.ticks.len(), wide.place(0.0)), (7, 0.5));
    }

    #[test]
    fn any_range_gives_a_few_finite_increasing_ticks() {
        let sizes = [5e-324, 1e-300, 1e-12, 1.0, 17.3, 1e9, 1e300];
        for low in sizes.iter().flat_map(|s| [-s, 0.0, *s]) {
            for high in sizes.iter().flat_map(|s| [-s, 0.0, *s]).filter(|h| *h >= low) {
                for scale in [Scale::new([low, high], 5), Scale::inside([low, high], 6)] {
                    assert!((1..=14).contains(&scale.ticks.len()), "{low} {high}: {scale:?}");
                    assert!(scale.ticks.windows(2).all(|w| w[0] < w[1]), "{low} {high}");
                    // what is left of a tick by rounding may lie beyond the axis, by no width of a line
                    let (from, to) = (scale.place(low), scale.place(high));
                    assert!(from > -1e-8 && to < 1.0 + 1e-8, "{low} {high}: {scale:?}");
                    assert!(scale.ticks.iter().all(|t| scale.figures(*t).len() < 20), "{scale:?}");
                }
            }
        }
    }
}
