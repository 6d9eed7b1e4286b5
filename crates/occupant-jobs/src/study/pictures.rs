//! The pictures of a response over its parameters.

use occupant_study::spread::quantile;

use super::{ByDesign, Finding, Input, Response, plots};
use occupant_pictures::html::Html;

/// Largest number of scatter plots per response.
const SCATTERS: usize = 9;
/// Number of parameters whose pairs are mapped.
const MAPPED: usize = 4;
/// Least number of rows for a map with five colours.
const MAPPED_ROWS: usize = 10;

/// A response over each parameter, and over two at a time.
pub fn pictures(html: &mut Html, of: &Finding<'_>) {
    let Finding { samples, response, analysis, .. } = of;
    let drawn: Vec<&Input> =
        analysis.order.iter().map(|i| &samples.inputs[*i]).filter(|input| input.varies()).collect();
    if drawn.is_empty() {
        return;
    }
    html.text("h3", "Over each parameter");
    if drawn.len() > SCATTERS {
        let words = format!("The {SCATTERS} most important of {}.", drawn.len());
        html.text("p class=\"remark\"", &words);
    }
    if samples.len() > plots::MOST_DOTS || samples.one_in > 1 {
        let every = samples.len().div_ceil(plots::MOST_DOTS).max(1) as u64 * samples.one_in.max(1);
        let words = format!("One in {every} samples is drawn; the numbers use all of them.");
        html.text("p class=\"remark\"", &words);
    }
    html.raw("<div class=\"grid\">\n");
    for input in drawn.iter().take(SCATTERS) {
        let picture = plots::scatter(input, response);
        html.raw(&format!("<figure>{picture}</figure>\n"));
    }
    html.raw("</div>\n");
    // one parameter at a time, no two are ever varied together
    if !matches!(analysis.by_design, ByDesign::OneAtATime(_)) {
        maps(html, &drawn, response);
    }
}

fn maps(html: &mut Html, drawn: &[&Input], response: &Response) {
    let Some(fifths) = fifths(&response.values) else {
        return;
    };
    let few = &drawn[..drawn.len().min(MAPPED)];
    if few.len() < 2 {
        return;
    }
    html.text("h3", "Over two parameters");
    if drawn.len() > MAPPED {
        let words = format!("Pairs of the {MAPPED} most important.");
        html.text("p class=\"remark\"", &words);
    }
    html.raw("<div class=\"grid\">\n");
    for (i, up) in few.iter().enumerate() {
        for across in &few[..i] {
            let picture = plots::map(across, up, response, &fifths);
            html.raw(&format!("<figure>{picture}</figure>\n"));
        }
    }
    html.raw("</div>\n");
}

/// Bounds between the fifths of the values.
fn fifths(values: &[f64]) -> Option<[f64; 4]> {
    let there = values.iter().filter(|x| x.is_finite()).count();
    if there < MAPPED_ROWS {
        return None;
    }
    let bounds: Vec<f64> = [0.2, 0.4, 0.6, 0.8].iter().filter_map(|p| quantile(values, *p)).collect();
    bounds.try_into().ok()
}
