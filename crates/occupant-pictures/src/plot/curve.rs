//! From points to lines of a drawing.

use super::figure::drawable;

/// Polylines without gaps, in drawing units; an isolated point is a line of one.
///
/// `to_page` converts a point. Curves with many more points than `columns` keep the first, least, largest and last in
/// each column: they look the same.
pub fn strokes(points: &[[f64; 2]], columns: usize, to_page: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<Vec<[f64; 2]>> {
    let parts = points.split(|point| !drawable(point)).filter(|part| !part.is_empty());
    let strokes = parts.map(|part| part.iter().map(|point| to_page(*point)).collect::<Vec<_>>());
    let dense = points.len() > 8 * columns;
    strokes.map(|stroke| if dense { thinned(&stroke, columns) } else { stroke }).collect()
}

/// First, least, largest and last of each half unit of width; a line that turns back is unchanged.
fn thinned(stroke: &[[f64; 2]], columns: usize) -> Vec<[f64; 2]> {
    let (Some(first), Some(last)) = (stroke.first(), stroke.last()) else {
        return Vec::new();
    };
    let forward = stroke.windows(2).all(|w| w[0][0] <= w[1][0]);
    let width = last[0] - first[0];
    if !forward || width <= 0.0 {
        return stroke.to_vec();
    }
    let column = |p: &[f64; 2]| ((p[0] - first[0]) / width * columns as f64) as usize;
    let mut kept = Vec::new();
    for group in stroke.chunk_by(|a, b| column(a) == column(b)) {
        let by_height = |a: &&[f64; 2], b: &&[f64; 2]| a[1].total_cmp(&b[1]);
        let ends = [group.first(), group.last()];
        let peaks = [group.iter().min_by(by_height), group.iter().max_by(by_height)];
        let mut group: Vec<[f64; 2]> = ends.into_iter().chain(peaks).flatten().copied().collect();
        group.sort_by(|a, b| a[0].total_cmp(&b[0]));
        group.dedup();
        kept.extend(group);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAN: f64 = f64::NAN;

    #[test]
    fn gaps_part_strokes_and_lone_points_stay() {
        let points = [[0.0, 1.0], [1.0, 2.0], [2.0, NAN], [3.0, 5.0], [4.0, NAN], [5.0, f64::INFINITY]];
        let found = strokes(&points, 100, |p| p);
        assert_eq!(found, [vec![[0.0, 1.0], [1.0, 2.0]], vec![[3.0, 5.0]]]);
        assert!(strokes(&[], 100, |p| p).is_empty());
    }

    #[test]
    fn thinning_keeps_peaks_and_ends() {
        let mut points: Vec<[f64; 2]> = (0..100_000).map(|i| [f64::from(i), 0.0]).collect();
        points[54_321][1] = 7.0;
        points[54_322][1] = -3.0;
        let found = &strokes(&points, 500, |p| p)[0];
        assert!(found.len() < 2100, "{}", found.len());
        assert!(found.contains(&[54_321.0, 7.0]) && found.contains(&[54_322.0, -3.0]));
        assert_eq!((found[0], found[found.len() - 1]), (points[0], points[99_999]));
    }
}
