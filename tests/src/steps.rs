//! The classical method by itself, for integrations that prove the model: it shares no code with it.

/// A state a step of length `h` (s) behind `y` at `t` (s), with the rate of change that `rate` gives at a time.
pub fn step<const N: usize>(t: f64, h: f64, y: [f64; N], rate: &impl Fn(f64, [f64; N]) -> [f64; N]) -> [f64; N] {
    let ahead = |h: f64, rate: [f64; N]| std::array::from_fn(|i| y[i] + h * rate[i]);
    let one = rate(t, y);
    let two = rate(t + 0.5 * h, ahead(0.5 * h, one));
    let three = rate(t + 0.5 * h, ahead(0.5 * h, two));
    let four = rate(t + h, ahead(h, three));
    std::array::from_fn(|i| y[i] + h * (one[i] + 2.0 * (two[i] + three[i]) + four[i]) / 6.0)
}

/// The length of the step from `y` at `t`, at most `h`, at whose end `beyond` turns positive, if it does within it.
pub fn until<const N: usize>(
    t: f64,
    h: f64,
    y: [f64; N],
    rate: &impl Fn(f64, [f64; N]) -> [f64; N],
    beyond: impl Fn(f64, [f64; N]) -> f64,
) -> Option<f64> {
    let is_beyond = |part: f64| beyond(t + part, step(t, part, y, rate)) > 0.0;
    if !is_beyond(h) {
        return None;
    }
    let (mut low, mut high) = (0.0, h);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if is_beyond(middle) { high = middle } else { low = middle }
    }
    Some(high)
}
