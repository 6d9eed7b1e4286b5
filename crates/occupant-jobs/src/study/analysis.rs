//! Analysis of one response from a table of samples.

use occupant_study::analysis::{
    AnalysisError, Effect, EffectSums, Grouping, RankCorrelation, Regression, RegressionSums, SobolIndices, SobolSums,
    rank_correlation, regression,
};
use occupant_study::spread::Spread;
use occupant_study::{Design, Role, Study};

use super::samples::varies;
use super::streams::{RunOfDesign, is_independent, point, steps};
use super::{Input, Samples};

/// Limit on rows × (k + 1)² of a regression on k parameters with a thousand resamples of rows; beyond it, groups of rows are
/// resampled.
const REGRESSION_WORK: usize = 1_000_000;
/// Number of rows up to which rows are resampled, however many parameters there are.
const REGRESSION_ROWS: usize = 200;

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
    pub regression: Fitted,
}

/// The parameters of a regression with its result, or the reason why there is none.
pub type Fitted = Result<(Vec<usize>, Regression), String>;

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
    /// Number of levels with a value.
    pub levels: usize,
    /// Number of levels without a value.
    pub missing: usize,
    /// Least and greatest response of its levels.
    range: [f64; 2],
    /// Parameter value and response at its least and its greatest value.
    ends: Option<[(f64, f64); 2]>,
    /// Whether the parameter's values are ordered; words are not.
    ordered: bool,
}

impl Reach {
    fn new(input: &Input) -> Self {
        let range = [f64::INFINITY, f64::NEG_INFINITY];
        Reach { nominal: f64::NAN, levels: 0, missing: 0, range, ends: None, ordered: input.is_number() }
    }

    fn see(&mut self, at: f64, value: f64) {
        if !value.is_finite() {
            self.missing += 1;
            return;
        }
        self.levels += 1;
        self.range = [self.range[0].min(value), self.range[1].max(value)];
        let [least, greatest] = self.ends.unwrap_or([(at, value); 2]);
        let first = if at < least.0 { (at, value) } else { least };
        // of equal ones the last
        let last = if at >= greatest.0 { (at, value) } else { greatest };
        self.ends = Some([first, last]);
    }

    /// Least and largest response, including that of the base.
    pub fn range(&self) -> [f64; 2] {
        [self.range[0].min(self.nominal), self.range[1].max(self.nominal)]
    }

    /// Responses at the least and the largest value of the parameter, if its values are ordered.
    pub fn ends(&self) -> Option<[f64; 2]> {
        self.ends.filter(|_| self.ordered).map(|ends| ends.map(|end| end.1))
    }
}

/// The reaches of all parameters, run by run.
#[derive(Clone, Debug)]
pub struct Reaches {
    nominal: f64,
    all: Vec<Reach>,
}

impl Reaches {
    /// No run yet.
    pub fn new(inputs: &[Input]) -> Self {
        Reaches { nominal: f64::NAN, all: inputs.iter().map(Reach::new).collect() }
    }

    /// Considers a run.
    pub fn see(&mut self, role: &Role, inputs: &[f64], value: f64) {
        match role {
            Role::Nominal => self.nominal = value,
            Role::Varied { parameter } => self.all[*parameter].see(inputs[*parameter], value),
            _ => {}
        }
    }

    /// The reaches.
    ///
    /// # Errors
    /// The base run has no value.
    pub fn all(&self) -> Result<Vec<Reach>, String> {
        let nominal = self.nominal;
        let of_base = |reach: &Reach| Reach { nominal, ..reach.clone() };
        let found = nominal.is_finite().then(|| self.all.iter().map(of_base).collect());
        found.ok_or_else(|| "the base run has no such result".to_owned())
    }
}

impl Analysis {
    /// Analyses response number `response` of a table of samples of a study.
    pub fn of(samples: &Samples, response: usize, study: &Study) -> Analysis {
        let values = &samples.responses[response].values;
        let seed = study.seed;
        let by_design = match &study.design {
            Design::Saltelli { second_order, .. } => ByDesign::Sobol(sobol(samples, values, seed, *second_order)),
            Design::Morris { .. } => ByDesign::Morris(morris(samples, values, seed)),
            Design::OneAtATime { .. } => ByDesign::OneAtATime(reaches(samples, values)),
            _ => ByDesign::Plain,
        };
        let linear = Linear::of(samples, values, study, |inputs, rows, values| fit(inputs, rows, values, seed));
        let spread = (Spread::of(values), !varies(values));
        Analysis::from_parts(response, spread, linear, by_design, samples.inputs.len())
    }

    /// From its parts: the spread and whether it is constant, and those of so many parameters.
    pub fn from_parts(
        response: usize,
        (spread, constant): (Option<Spread>, bool),
        linear: Linear,
        by_design: ByDesign,
        parameters: usize,
    ) -> Analysis {
        let order = order(parameters, &by_design, &linear);
        Analysis { response, spread, constant, linear, by_design, order }
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
    /// Reason why a study has neither rank correlations nor a regression.
    pub fn reason_against(study: &Study) -> Option<&'static str> {
        match &study.design {
            Design::Morris { .. } => Some(
                "the runs of Morris trajectories depend on one another, so rank correlation and regression would not be valid",
            ),
            Design::OneAtATime { .. } => {
                Some("a one-at-a-time design shows no interactions: only the tornado is available")
            }
            _ => None,
        }
    }

    /// Rank correlations of a table of samples, and the regression that `fit` makes of inputs, rows and values.
    pub fn of(
        samples: &Samples,
        values: &[f64],
        study: &Study,
        fit: impl FnOnce(&[Input], &[usize], &[f64]) -> Fitted,
    ) -> Linear {
        if let Some(why) = Linear::reason_against(study).map(str::to_owned) {
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
        Linear { without: None, ranks: inputs.iter().map(rank).collect(), regression: fit(inputs, &rows, values) }
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
fn fit(inputs: &[Input], rows: &[usize], values: &[f64], seed: u64) -> Fitted {
    let among = |i: &usize| inputs[*i].is_number() && inputs[*i].varies();
    let which: Vec<usize> = (0..inputs.len()).filter(among).collect();
    if which.is_empty() {
        return Err("no parameter is a varying number".to_owned());
    }
    if rows.len() > (REGRESSION_WORK / (which.len() + 1).pow(2)).max(REGRESSION_ROWS) {
        let mut sums = RegressionSums::new(which.len(), seed);
        rows.iter().for_each(|row| sums.see(*row as u64, which.iter().map(|i| inputs[*i].values[*row]), values[*row]));
        let found = sums.regression(seed);
        let named = |at: Vec<usize>| at.into_iter().map(|at| which[at]).collect();
        return found.map(|(at, found)| (named(at), found)).map_err(|e| said(&e));
    }
    let taken = |column: &[f64]| -> Vec<f64> { rows.iter().map(|r| column[*r]).collect() };
    let columns: Vec<Vec<f64>> = which.iter().map(|i| taken(&inputs[*i].values)).collect();
    let found = regression(&columns, &taken(values), seed);
    found.map(|found| (which, found)).map_err(|e| said(&e))
}

/// Rows with independent parameters: for Saltelli's blocks those of A and B.
pub fn independent(samples: &Samples) -> Vec<usize> {
    (0..samples.len()).filter(|row| is_independent(&samples.roles[*row])).collect()
}

/// The runs of a table in order.
fn runs(samples: &Samples, values: &[f64]) -> Vec<RunOfDesign> {
    let all = samples.numbers.iter().zip(&samples.roles).zip(values);
    all.map(|((number, role), value)| (*number, *role, *value)).collect()
}

/// Points whose runs all exist; NaN for a run without the figure.
fn sobol(samples: &Samples, values: &[f64], seed: u64, second_order: bool) -> Result<SobolIndices, String> {
    let parameters = samples.inputs.len();
    let mut sums = SobolSums::new(parameters, second_order, Grouping::Rows);
    let point_of = |run: &RunOfDesign| if let Role::Saltelli { point, .. } = run.1 { Some(point) } else { None };
    for runs in runs(samples, values).chunk_by(|one, next| point_of(one) == point_of(next)) {
        point(runs, parameters).iter().for_each(|point| sums.see(0, point));
    }
    sums.indices(seed).map_err(too_few)
}

/// Effects of all steps whose two runs exist.
fn morris(samples: &Samples, values: &[f64], seed: u64) -> Result<Vec<Effect>, String> {
    let mut effects = vec![EffectSums::new(Grouping::Rows); samples.inputs.len()];
    steps(&runs(samples, values), |parameter, effect| effects[parameter].see(0, effect));
    effects.iter().map(|effects| effects.effect(seed)).collect::<Result<_, _>>().map_err(too_few)
}

fn reaches(samples: &Samples, values: &[f64]) -> Result<Vec<Reach>, String> {
    let mut reaches = Reaches::new(&samples.inputs);
    for (row, value) in values.iter().enumerate() {
        let inputs: Vec<f64> = samples.inputs.iter().map(|input| input.values[row]).collect();
        reaches.see(&samples.roles[row], &inputs, *value);
    }
    reaches.all()
}

/// The reason in the words of a design.
pub fn too_few(error: AnalysisError) -> String {
    match error {
        AnalysisError::TooFew { found, needed } if needed < 5 => {
            format!("a parameter with {found} effects; at least {needed} are needed")
        }
        AnalysisError::TooFew { found, needed } => {
            format!("{found} complete points; at least {needed} are needed")
        }
        e => said(&e),
    }
}

/// The reason in the words of a study.
pub fn said(error: &AnalysisError) -> String {
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
