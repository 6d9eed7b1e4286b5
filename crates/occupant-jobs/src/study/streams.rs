//! Analysis of a study that is too large for a table of its samples: they go by once, and sums, sketches and groups remain.
//!
//! Moments, regression, Sobol's and Morris's numbers are exact for all samples. Quantiles have the error of a [`Sketch`].
//! Rank correlations and dots of plots are those of a part of the samples, chosen by their numbers.

use occupant_study::analysis::{AnalysisError, EffectSums, Grouping, RegressionSums, SobolPoint, SobolSums};
use occupant_study::sketch::Sketch;
use occupant_study::spread::Spread;
use occupant_study::{Block, Design, Role, Study};

use super::analysis::{Analysis, ByDesign, Fitted, Linear, Reaches, said, too_few};
use super::groups::Groups;
use super::samples::Input;
use super::{Response, Samples};
use crate::quoted::Limits;

/// Largest number of rows of a table of samples; a larger study goes by, and the table has a part of it.
pub const MOST_ROWS: u64 = 20_000;
/// Number of values that a sketch keeps of a response; its quantiles are off by at most 0.3 % of the ranks at ten million.
const KEPT: usize = 4096;
/// The same for each combination of crossed values.
const KEPT_OF_GROUP: usize = 1024;
/// Largest number of combinations of crossed values with a regression.
const MOST_CROSSED: u64 = 2000;

/// A sample that goes by.
#[derive(Clone, Debug)]
pub struct Line {
    /// Its number.
    pub number: u64,
    /// Its role in the design.
    pub role: Role,
    /// Values of the parameters, as of [`Input`].
    pub inputs: Vec<f64>,
    /// Its responses; NaN where it has none.
    pub values: Vec<f64>,
}

/// The samples of a study that stand in its table: all of a small one; of a large one every so many points of the design, one of
/// each stretch at random, so that no pattern of the design is met.
#[derive(Clone, Copy, Debug)]
pub struct Thinning {
    seed: u64,
    /// Samples that belong together.
    unit: u64,
    /// One of so many units is kept.
    every: u64,
}

impl Thinning {
    /// That of a study for a table of at most so many rows.
    pub fn of(study: &Study, rows: u64) -> Self {
        let (samples, unit) = (study.samples(), study.unit());
        let unit = if unit <= rows / 10 { unit } else { 1 };
        let every = if samples <= rows { 1 } else { samples.div_ceil(unit).div_ceil((rows / unit).max(1)) };
        Thinning { seed: study.seed, unit, every }
    }

    /// One of so many samples is kept.
    pub fn every(&self) -> u64 {
        self.every
    }

    /// Whether a sample is kept.
    pub fn keeps(&self, sample: u64) -> bool {
        let unit = sample / self.unit;
        let chosen = occupant_study::of_stretch(self.seed, unit / self.every, self.every);
        self.every == 1 || unit % self.every == chosen
    }
}

/// What is left of the samples of a study.
#[derive(Clone, Debug)]
pub struct Streams {
    /// Number of samples that went by.
    pub samples: u64,
    /// By response.
    pub responses: Vec<Stream>,
    seed: u64,
    unit: u64,
    crossing: u64,
    /// Parameters of the regression.
    numeric: Vec<usize>,
    /// The present samples that belong together.
    together: Vec<Line>,
}

/// What is left of a response.
#[derive(Clone, Debug)]
pub struct Stream {
    /// Its values.
    pub values: Sketch,
    /// Those of the blocks A and B, if the design has blocks.
    pub independent: Option<Sketch>,
    /// Its values by crossed parameters or words.
    pub groups: Groups,
    regression: Result<RegressionSums, String>,
    /// Combinations of crossed values that have the response, as far as seen.
    present: Vec<bool>,
    by_design: Sums,
}

/// Sums specific to a design.
#[derive(Clone, Debug)]
enum Sums {
    Plain,
    Sobol(SobolSums),
    Morris(Vec<EffectSums>),
    OneAtATime(Reaches),
}

impl Streams {
    /// Nothing seen yet; values above limits are counted.
    pub fn new(study: &Study, inputs: &[Input], responses: &[Response], limits: &Limits) -> Self {
        let numeric: Vec<usize> = (0..inputs.len()).filter(|i| inputs[*i].is_number()).collect();
        let crossing = study.crossing();
        let (unit, by) = (if crossing > MOST_CROSSED { 1 } else { study.unit() }, Grouping::Groups(study.seed));
        let k = inputs.len();
        let by_design = || match &study.design {
            Design::Saltelli { second_order, .. } => Sums::Sobol(SobolSums::new(k, *second_order, by)),
            Design::Morris { .. } => Sums::Morris(vec![EffectSums::new(by); k]),
            Design::OneAtATime { .. } => Sums::OneAtATime(Reaches::new(inputs)),
            _ => Sums::Plain,
        };
        let regression = || match Linear::reason_against(study) {
            Some(why) => Err(why.to_owned()),
            None if numeric.is_empty() => Err("no parameter is a varying number".to_owned()),
            None if crossing > MOST_CROSSED => {
                Err(format!("{crossing} combinations of crossed values, more than {MOST_CROSSED}"))
            }
            None => Ok(RegressionSums::new(numeric.len(), study.seed)),
        };
        let has_blocks = matches!(study.design, Design::Saltelli { .. });
        let stream = |response: &Response| {
            let sketch =
                |kept: usize| Sketch::new(kept).counting(limits.of(&response.name).into_iter().map(|limit| limit.most));
            Stream {
                values: sketch(KEPT),
                independent: has_blocks.then(|| sketch(KEPT)),
                groups: Groups::of(inputs, sketch(KEPT_OF_GROUP)),
                regression: regression(),
                present: Vec::new(),
                by_design: by_design(),
            }
        };
        let responses = responses.iter().map(stream).collect();
        Streams { samples: 0, responses, seed: study.seed, unit, crossing, numeric, together: Vec::new() }
    }

    /// Considers the next sample.
    pub fn see(&mut self, line: Line) {
        self.samples += 1;
        let unit = line.number / self.unit;
        if self.together.last().is_some_and(|last| last.number / self.unit != unit) {
            self.close();
        }
        for (stream, value) in self.responses.iter_mut().zip(&line.values) {
            stream.see(&line, *value);
        }
        self.together.push(line);
    }

    /// Ends the samples that belong together.
    pub fn close(&mut self) {
        let lines = std::mem::take(&mut self.together);
        let Some(first) = lines.first() else { return };
        let unit = first.number / self.unit;
        for (i, stream) in self.responses.iter_mut().enumerate() {
            let runs = lines.iter().map(|line| (line.number, line.role, line.values[i]));
            match &mut stream.by_design {
                Sums::Plain | Sums::OneAtATime(_) => {}
                Sums::Sobol(sums) => {
                    point(&runs.collect::<Vec<_>>(), first.inputs.len()).iter().for_each(|point| sums.see(unit, point))
                }
                Sums::Morris(effects) => {
                    steps(&runs.collect::<Vec<_>>(), |parameter, effect| effects[parameter].see(unit, effect));
                }
            }
            let fresh = || RegressionSums::new(self.numeric.len(), self.seed);
            if self.crossing > 1 && lines.len() as u64 == self.crossing {
                let values: Vec<f64> = lines.iter().map(|line| line.values[i]).collect();
                if let Some(mean) = stream.mean_of_point(&values, fresh) {
                    stream.regress(unit, &first.inputs, &self.numeric, mean);
                }
            }
            for line in lines.iter().filter(|line| self.crossing == 1 && is_independent(&line.role)) {
                stream.regress(line.number, &line.inputs, &self.numeric, line.values[i]);
            }
        }
        self.together = lines;
        self.together.clear();
    }

    /// Analyses a response; `samples` are those that were kept.
    pub fn analysis(&self, samples: &Samples, response: usize, study: &Study) -> Analysis {
        let stream = &self.responses[response];
        let by_design = match &stream.by_design {
            Sums::Plain => ByDesign::Plain,
            Sums::Sobol(sums) => ByDesign::Sobol(sums.indices(self.seed).map_err(too_few)),
            Sums::Morris(effects) => {
                let found = effects.iter().map(|effects| effects.effect(self.seed)).collect::<Result<_, _>>();
                ByDesign::Morris(found.map_err(too_few))
            }
            Sums::OneAtATime(reaches) => ByDesign::OneAtATime(reaches.all()),
        };
        let regression = self.regression(stream);
        let linear = Linear::of(samples, &samples.responses[response].values, study, |_, _, _| regression);
        let (spread, constant) = (Spread::of_sketch(&stream.values), !stream.values.varies());
        Analysis::from_parts(response, (spread, constant), linear, by_design, samples.inputs.len())
    }

    fn regression(&self, stream: &Stream) -> Fitted {
        let found = stream.regression.as_ref().map_err(Clone::clone)?.regression(self.seed);
        let found = found.map_err(|e| match e {
            AnalysisError::Constant { parameter: Some(_) } => "no parameter is a varying number".to_owned(),
            e => said(&e),
        });
        found.map(|(which, found)| (which.into_iter().map(|i| self.numeric[i]).collect(), found))
    }
}

impl Stream {
    fn see(&mut self, line: &Line, value: f64) {
        self.values.see(value);
        if let Some(values) = self.independent.as_mut().filter(|_| is_independent(&line.role)) {
            values.see(value);
        }
        self.groups.see(|i| line.inputs[i], value);
        if let Sums::OneAtATime(reaches) = &mut self.by_design {
            reaches.see(&line.role, &line.inputs, value);
        }
    }

    fn regress(&mut self, index: u64, inputs: &[f64], numeric: &[usize], value: f64) {
        if let Ok(sums) = &mut self.regression {
            sums.see(index, numeric.iter().map(|i| inputs[*i]), value);
        }
    }

    /// Mean over the combinations that have the response at all. A combination that is met with it for the first time makes all
    /// points before incomplete.
    fn mean_of_point(&mut self, values: &[f64], fresh: impl FnOnce() -> RegressionSums) -> Option<f64> {
        self.present.resize(values.len(), false);
        let is_new = values.iter().zip(&self.present).any(|(value, known)| value.is_finite() && !known);
        if is_new {
            self.regression = self.regression.as_ref().map(|_| fresh()).map_err(Clone::clone);
            self.present.iter_mut().zip(values).for_each(|(known, value)| *known |= value.is_finite());
        }
        let counted = || values.iter().zip(&self.present).filter(|(_, known)| **known).map(|(value, _)| *value);
        let mean = counted().sum::<f64>() / counted().count() as f64;
        mean.is_finite().then_some(mean)
    }
}

/// Whether the parameters of a row are independent of those of other rows: not of one that mixes Saltelli's blocks A and B.
pub fn is_independent(role: &Role) -> bool {
    !matches!(role, Role::Saltelli { block: Block::Ab { .. } | Block::Ba { .. }, .. })
}

/// A run of a design: its sample, its role, its response.
pub type RunOfDesign = (u64, Role, f64);

/// The rows of a point, if all are there; with those of BA if the design has them.
pub fn point(runs: &[RunOfDesign], parameters: usize) -> Option<SobolPoint> {
    let of = |wanted: Block| {
        let is_it = |role: &Role| matches!(role, Role::Saltelli { block, .. } if *block == wanted);
        runs.iter().find(|(_, role, _)| is_it(role)).map(|run| run.2)
    };
    let has_second = runs.len() > parameters + 2;
    Some(SobolPoint {
        a: of(Block::A)?,
        b: of(Block::B)?,
        ab: (0..parameters).map(|parameter| of(Block::Ab { parameter })).collect::<Option<_>>()?,
        ba: (0..parameters)
            .filter(|_| has_second)
            .map(|parameter| of(Block::Ba { parameter }))
            .collect::<Option<_>>()?,
    })
}

/// Effects of the steps of trajectories whose two runs exist.
pub fn steps(runs: &[RunOfDesign], mut see: impl FnMut(usize, f64)) {
    for pair in runs.windows(2) {
        let [(before, _, from), (after, role, to)] = [pair[0], pair[1]];
        if let Role::Morris { changed: Some((parameter, step)), .. } = role
            && before + 1 == after
        {
            see(parameter, (to - from) / step);
        }
    }
}
