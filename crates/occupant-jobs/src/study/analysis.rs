//! Analysis of one response from a table of samples.

use occupant_study::analysis::{
    AnalysisError, Effect, RankCorrelation, Regression, SobolIndices, rank_correlation, regression, screening,
    sobol_indices,
};
use occupant_study::spread::Spread;
use occupant_study::{Block, Design, Role, Study};

use super::samples::varies;
use super::{Input, Samples};

/// Limit on rows × (k + 1)² of a regression on k parameters with a thousand resamples; beyond it, rows are subsampled
/// evenly.
const REGRESSION_WORK: usize = 1_000_000;
/// Largest number of rows of a regression.
const REGRESSION_ROWS: usize = 20_000;

/// Analysis of one response in a table of samples.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// Index of the response.
    pub response: usize,
    /// Spread of its values; none if no sample has one.
    pub spread: Option<Spread>,
    /// Whether it is constant, so that no parameter matters.
    pub constant: bool,
    /// Rank correlation and regression.
    pub linear: Linear,
    /// Analysis specific to the design.
    pub by_design: ByDesign,
    /// Parameters, the most important first.
    pub order: Vec<usize>,
}

/// Rank correlation and regression.
#[derive(Clone, Debug)]
pub struct Linear {
    /// Reason why there is none.
    pub without: Option<String>,
    /// By parameter: its rank correlation, or the reason why it has none.
    pub ranks: Vec<Result<RankCorrelation, String>>,
    /// The parameters of the regression with its result, or the reason why there is none.
    pub regression: Result<(Vec<usize>, Regression), String>,
}

/// Analysis specific to a design.
#[derive(Clone, Debug)]
pub enum ByDesign {
    /// None.
    Plain,
    /// Sobol's indices, or the reason why there are none.
    Sobol(Result<SobolIndices, String>),
    /// Morris's effects by parameter, or the reason why there are none.
    Morris(Result<Vec<Effect>, String>),
    /// Reach of each parameter alone, or the reason why it is unknown.
    OneAtATime(Result<Vec<Reach>, String>),
}

/// Range of a response when one parameter alone is changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Reach {
    /// Response of the base scenario.
    pub nominal: f64,
    /// Parameter values and responses, in the order of the design, where they exist.
    pub levels: Vec<(f64, f64)>,
    /// Number of levels without a value.
    pub missing: usize,
    /// Whether the parameter's values are ordered; words are not.
    ordered: bool,
}

impl Reach {
    /// Least and largest response, including that of the base.
    pub fn range(&self) -> [f64; 2] {
        let all = || self.levels.iter().map(|l| l.1).chain([self.nominal]);
        [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// Responses at the least and the largest value of the parameter, if its values are ordered.
    pub fn ends(&self) -> Option<[f64; 2]> {
        if !self.ordered {
            return None;
        }
        let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.0.total_cmp(&b.0);
        let least = self.levels.iter().min_by(by_value)?;
        let greatest = self.levels.iter().max_by(by_value)?;
        Some([least.1, greatest.1])
    }
}

impl Analysis {
    /// Analyses response number `response` of a table of samples of a study.
    pub fn of(samples: &Samples, response: usize, study: &Study) -> Analysis {
        let values = &samples.responses[response].values;
        let seed = study.seed;
        let by_design = match &study.design {
            Design::Saltelli { .. } => ByDesign::Sobol(sobol(samples, values, seed)),
            Design::Morris { .. } => ByDesign::Morris(morris(samples, values, seed)),
            Design::OneAtATime { .. } => ByDesign::OneAtATime(reaches(samples, values)),
            _ => ByDesign::Plain,
        };
        let linear = Linear::of(samples, values, study);
        Analysis {
            response,
            spread: Spread::of(values),
            constant: !varies(values),
            order: order(samples.inputs.len(), &by_design, &linear),
            linear,
            by_design,
        }
    }
}

/// Parameters by importance, as far as known.
fn order(parameters: usize, by_design: &ByDesign, linear: &Linear) -> Vec<usize> {
    let weight = |i: usize| -> f64 {
        match by_design {
            ByDesign::Sobol(Ok(found)) => found.total.get(i).map(|e| e.value),
            ByDesign::Morris(Ok(found)) => found.get(i).map(|e| e.mean_magnitude.value),
            ByDesign::OneAtATime(Ok(found)) => found.get(i).map(|r| {
                let [low, high] = r.range();
                high - low
            }),
            _ => {
                let found = linear.ranks.get(i).and_then(|r| r.as_ref().ok());
                found.map(|r| r.rho.value.abs())
            }
        }
        .filter(|x| x.is_finite())
        .unwrap_or(-1.0)
    };
    let mut order: Vec<usize> = (0..parameters).collect();
    order.sort_by(|a, b| weight(*b).total_cmp(&weight(*a)));
    order
}

impl Linear {
    fn of(samples: &Samples, values: &[f64], study: &Study) -> Linear {
        let without = match &study.design {
            Design::Morris { .. } => {
                "the runs of Morris trajectories depend on one another, so rank correlation and regression would not be valid"
            }
            Design::OneAtATime { .. } => "a one-at-a-time design shows no interactions: only the tornado is available",
            _ => "",
        };
        if !without.is_empty() {
            let why = without.to_owned();
            return Linear { without: Some(why.clone()), ranks: Vec::new(), regression: Err(why) };
        }
        let means = (study.crossing() > 1).then(|| means_of_points(samples, values, study.crossing()));
        let (inputs, values, rows) = match &means {
            Some((inputs, values)) => (inputs, values.as_slice(), (0..values.len()).collect()),
            None => (&samples.inputs, values, independent(samples)),
        };
        let taken = |column: &[f64]| -> Vec<f64> { rows.iter().map(|r| column[*r]).collect() };
        let y = taken(values);
        let rank = |input: &Input| match input {
            input if input.crossed => Err("crossed with every sample".to_owned()),
            input if input.is_number() => rank_correlation(&taken(&input.values), &y).map_err(|e| said(&e)),
            _ => Err("words have no order".to_owned()),
        };
        Linear {
            without: None,
            ranks: inputs.iter().map(rank).collect(),
            regression: fit(inputs, &rows, values, study.seed),
        }
    }
}

/// One row per point of a design with crossed parameters: the point's inputs, and the mean response over all
/// combinations of crossed values that have the response at all: a woman has no Nkm. Rows of one point are not
/// independent, but these means are. Incomplete points are omitted.
fn means_of_points(samples: &Samples, values: &[f64], crossing: u64) -> (Vec<Input>, Vec<f64>) {
    let rows: Vec<usize> = (0..samples.len()).collect();
    let combination = |row: usize| (samples.numbers[row] % crossing) as usize;
    let mut has_response = vec![false; crossing as usize];
    for row in rows.iter().filter(|row| values[**row].is_finite()) {
        has_response[combination(*row)] = true;
    }
    let responses = has_response.iter().filter(|has| **has).count() as f64;
    let points = rows.chunk_by(|a, b| samples.numbers[*a] / crossing == samples.numbers[*b] / crossing);
    let whole: Vec<&[usize]> = points.filter(|rows| rows.len() as u64 == crossing).collect();
    let mean = |rows: &&[usize]| {
        let counted = rows.iter().filter(|row| has_response[combination(**row)]);
        counted.map(|row| values[*row]).sum::<f64>() / responses
    };
    let of_points =
        |input: &Input| Input { values: whole.iter().map(|rows| input.values[rows[0]]).collect(), ..input.clone() };
    (samples.inputs.iter().map(of_points).collect(), whole.iter().map(mean).collect())
}

/// Regression on all numeric parameters that vary.
fn fit(inputs: &[Input], rows: &[usize], values: &[f64], seed: u64) -> Result<(Vec<usize>, Regression), String> {
    let among = |i: &usize| inputs[*i].is_number() && inputs[*i].varies();
    let which: Vec<usize> = (0..inputs.len()).filter(among).collect();
    if which.is_empty() {
        return Err("no parameter is a varying number".to_owned());
    }
    let most = (REGRESSION_WORK / (which.len() + 1).pow(2)).clamp(200, REGRESSION_ROWS);
    let every = rows.len().div_ceil(most).max(1);
    let taken = |column: &[f64]| -> Vec<f64> {
        let rows = rows.iter().step_by(every);
        rows.map(|r| column[*r]).collect()
    };
    let columns: Vec<Vec<f64>> = which.iter().map(|i| taken(&inputs[*i].values)).collect();
    let found = regression(&columns, &taken(values), seed);
    found.map(|found| (which, found)).map_err(|e| said(&e))
}

/// Rows with independent parameters: for Saltelli's blocks those of A and B.
pub fn independent(samples: &Samples) -> Vec<usize> {
    let is_mixed =
        |row: &usize| matches!(samples.roles[*row], Role::Saltelli { block: Block::Ab { .. } | Block::Ba { .. }, .. });
    (0..samples.len()).filter(|row| !is_mixed(row)).collect()
}

/// Points whose runs all exist; NaN for a run without the figure.
fn sobol(samples: &Samples, values: &[f64], seed: u64) -> Result<SobolIndices, String> {
    let (mut a, mut b, mut ab) = (Vec::new(), Vec::new(), vec![Vec::new(); samples.inputs.len()]);
    let runs = samples.roles.iter().zip(values).filter_map(|(role, value)| match role {
        Role::Saltelli { point, block } => Some((point, block, *value)),
        _ => None,
    });
    for runs in runs.collect::<Vec<_>>().chunk_by(|one, next| one.0 == next.0) {
        let of = |wanted: Block| runs.iter().find(|(_, block, _)| **block == wanted).map(|run| run.2);
        let between: Option<Vec<f64>> = (0..ab.len()).map(|parameter| of(Block::Ab { parameter })).collect();
        if let (Some(first), Some(between), Some(last)) = (of(Block::A), between, of(Block::B)) {
            a.push(first);
            b.push(last);
            ab.iter_mut().zip(between).for_each(|(column, value)| column.push(value));
        }
    }
    sobol_indices(&a, &b, &ab, seed).map_err(|e| match e {
        AnalysisError::TooFew { found, needed } => {
            format!("{found} complete points; at least {needed} are needed")
        }
        e => said(&e),
    })
}

/// Effects of all steps whose two runs exist.
fn morris(samples: &Samples, values: &[f64], seed: u64) -> Result<Vec<Effect>, String> {
    let mut effects: Vec<Vec<f64>> = vec![Vec::new(); samples.inputs.len()];
    for (row, role) in samples.roles.iter().enumerate() {
        let Role::Morris { changed: Some((parameter, step)), .. } = role else {
            continue;
        };
        let before = samples.numbers[row].checked_sub(1);
        let before = before.and_then(|number| samples.row_of(number));
        let Some(before) = before else {
            continue;
        };
        effects[*parameter].push((values[row] - values[before]) / step);
    }
    screening(&effects, seed).map_err(|e| match e {
        AnalysisError::TooFew { found, needed } => {
            format!("a parameter with {found} effects; at least {needed} are needed")
        }
        e => said(&e),
    })
}

fn reaches(samples: &Samples, values: &[f64]) -> Result<Vec<Reach>, String> {
    let base = samples.roles.iter().position(|r| *r == Role::Nominal);
    let nominal = base.map(|row| values[row]).filter(|x| x.is_finite());
    let nominal = nominal.ok_or("the base run has no such result")?;
    let none = |input: &Input| Reach { nominal, levels: Vec::new(), missing: 0, ordered: input.is_number() };
    let mut reaches: Vec<Reach> = samples.inputs.iter().map(none).collect();
    for (row, role) in samples.roles.iter().enumerate() {
        let Role::Varied { parameter } = role else {
            continue;
        };
        let reach = &mut reaches[*parameter];
        if values[row].is_finite() {
            reach.levels.push((samples.inputs[*parameter].values[row], values[row]))
        } else {
            reach.missing += 1
        }
    }
    Ok(reaches)
}

fn said(error: &AnalysisError) -> String {
    match error {
        AnalysisError::Constant { parameter: Some(_) } => "a parameter is the same in all rows".to_owned(),
        AnalysisError::Constant { parameter: None } => "the result is the same in all rows".to_owned(),
        e => e.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three points times two sexes: a response of men alone, one of both, and one that a run of a man lacks.
    #[test]
    fn means_of_points_leave_out_combinations_without_the_response() {
        let input = Input { values: vec![1.0, 1.0, 2.0, 2.0, 3.0, 3.0], ..Input::default() };
        let samples = Samples { numbers: (0..6).collect(), inputs: vec![input], ..Samples::default() };
        let of = |values: [f64; 6]| means_of_points(&samples, &values, 2);
        let none = f64::NAN;
        let (inputs, men) = of([10.0, none, 20.0, none, 30.0, none]);
        assert_eq!((&inputs[0].values[..], &men[..]), (&[1.0, 2.0, 3.0][..], &[10.0, 20.0, 30.0][..]));
        assert_eq!(of([10.0, 20.0, 20.0, 40.0, 30.0, 60.0]).1, [15.0, 30.0, 45.0]);
        let lacking = of([10.0, 20.0, none, 40.0, 30.0, 60.0]).1;
        assert!(lacking[0] == 15.0 && lacking[1].is_nan() && lacking[2] == 45.0);
        assert!(of([none; 6]).1.iter().all(|mean| mean.is_nan()));
    }
}
