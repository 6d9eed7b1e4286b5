//! Reading a result file back as far as a run can resume it: what it says of itself, its documents, its checkpoints.

use std::collections::BTreeMap;

use mcap::read::ChunkFlattener;
use mcap::records::{MessageHeader, Record};
use occupant_core::forces::belt::law::BeltHistory;
use occupant_core::forces::contact::{OPEN, PASSED, PairHistory, TOUCHING};
use occupant_core::forces::{Memory, belt, contact};
use occupant_core::motion::state::State;
use occupant_core::motion::vector::v3;
use occupant_core::results::checkpoint::{Checkpoint, Progress, StepStart};
use occupant_core::results::energy::EnergyStart;
use occupant_core::results::outcome::FirstTouch;
use occupant_core::results::sample::Effort;
use prost::Message as _;

use super::about::{RESULT, RUN};
use super::checkpoint;

/// A file that has more pairs than this is none of ours.
const MOST_PAIRS: u64 = 1 << 20;

/// What a result file holds, or what a run that was cut off has left of it.
#[derive(Clone, Debug, Default)]
pub struct StoredRun {
    /// The entries of the metadata record `occupant.run`.
    pub run: BTreeMap<String, String>,
    /// The entries of `occupant.result`; none if the run was cut off.
    pub result: Option<BTreeMap<String, String>>,
    pub(crate) attachments: BTreeMap<String, Vec<u8>>,
    /// Checkpoints in the file's order.
    pub checkpoints: Vec<Checkpoint>,
}

impl StoredRun {
    /// Reads a file up to its end, or up to where it is cut off. A chunk counts whole or not at all.
    ///
    /// # Errors
    /// A file that is not MCAP, or a checkpoint that cannot be read, in words.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        if !bytes.starts_with(mcap::MAGIC) {
            return Err("it is not an MCAP file".to_owned());
        }
        let mut stored = StoredRun::default();
        let (mut channel, mut in_chunk) = (None, Vec::new());
        let checked = mcap::read::Options::ValidateChunkCrcs.into();
        for record in ChunkFlattener::new_with_options(bytes, checked).map_err(|e| e.to_string())? {
            match record {
                // indices follow a chunk that is whole
                Ok(Record::MessageIndex(_)) => stored.checkpoints.append(&mut in_chunk),
                Ok(record) => stored.take(record, &mut channel, &mut in_chunk)?,
                // a file that was cut off ends with an error
                Err(_) => break,
            }
        }
        Ok(stored)
    }

    /// Takes what counts from a record; `wanted` is the channel of checkpoints, which go to `found`.
    fn take(
        &mut self,
        record: Record<'_>,
        wanted: &mut Option<u16>,
        found: &mut Vec<Checkpoint>,
    ) -> Result<(), String> {
        match record {
            Record::Channel(channel) if channel.topic == checkpoint::TOPIC => {
                *wanted = Some(channel.id);
            }
            Record::Message { header: MessageHeader { channel_id, .. }, data } if *wanted == Some(channel_id) => {
                let message = Message::decode(data.as_ref()).map_err(|e| e.to_string())?;
                found.push(message.checkpoint()?);
            }
            Record::Metadata(metadata) if metadata.name == RUN => self.run = metadata.metadata,
            Record::Metadata(metadata) if metadata.name == RESULT => {
                self.result = Some(metadata.metadata);
            }
            Record::Attachment { header, data, .. } => {
                self.attachments.insert(header.name, data.into_owned());
            }
            _ => {}
        }
        Ok(())
    }
}

/// `occupant.Checkpoint` as `mcap::checkpoint` writes it.
#[derive(Clone, PartialEq, prost::Message)]
struct Message {
    #[prost(double, tag = "1")]
    time_s: f64,
    #[prost(uint64, tag = "2")]
    output: u64,
    #[prost(double, repeated, tag = "3")]
    state: Vec<f64>,
    #[prost(uint64, tag = "4")]
    pairs: u64,
    #[prost(fixed32, repeated, tag = "5")]
    passed: Vec<u32>,
    #[prost(fixed32, repeated, tag = "6")]
    touching: Vec<u32>,
    #[prost(fixed32, repeated, tag = "7")]
    deformed: Vec<u32>,
    #[prost(double, repeated, tag = "8")]
    greatest_deformation_m: Vec<f64>,
    #[prost(double, repeated, tag = "9")]
    belt_normal_vehicle: Vec<f64>,
    #[prost(double, repeated, tag = "10")]
    belt_greatest_elongation_m: Vec<f64>,
    #[prost(fixed32, repeated, tag = "11")]
    first_touch_sphere: Vec<u32>,
    #[prost(fixed32, repeated, tag = "12")]
    first_touch_surface: Vec<u32>,
    #[prost(double, repeated, tag = "13")]
    first_touch_time_s: Vec<f64>,
    #[prost(double, repeated, tag = "14")]
    first_touch_closing_m_s: Vec<f64>,
    #[prost(uint64, tag = "15")]
    steps: u64,
    #[prost(uint64, tag = "16")]
    rejected: u64,
    #[prost(uint64, tag = "17")]
    evaluations: u64,
    #[prost(double, tag = "18")]
    last_step_s: f64,
    #[prost(double, tag = "19")]
    wanted_step_s: f64,
    #[prost(double, tag = "20")]
    start_mechanical_j: f64,
    #[prost(double, tag = "21")]
    start_contacts_j: f64,
    #[prost(double, tag = "22")]
    start_belts_j: f64,
    #[prost(double, tag = "23")]
    greatest_kinetic_j: f64,
    #[prost(double, tag = "24")]
    greatest_imbalance_j: f64,
    #[prost(double, tag = "25")]
    step_error: f64,
    #[prost(double, repeated, tag = "26")]
    step_times_s: Vec<f64>,
    #[prost(double, repeated, tag = "27")]
    step_state: Vec<f64>,
    #[prost(fixed32, repeated, tag = "28")]
    step_passed: Vec<u32>,
    #[prost(fixed32, repeated, tag = "29")]
    step_touching: Vec<u32>,
    #[prost(fixed32, repeated, tag = "30")]
    step_deformed: Vec<u32>,
    #[prost(double, repeated, tag = "31")]
    step_greatest_deformation_m: Vec<f64>,
    #[prost(double, repeated, tag = "32")]
    step_belt_normal_vehicle: Vec<f64>,
    #[prost(double, repeated, tag = "33")]
    step_belt_greatest_elongation_m: Vec<f64>,
}

impl Message {
    fn checkpoint(&self) -> Result<Checkpoint, String> {
        Ok(Checkpoint {
            index: usize::try_from(self.output).map_err(|e| e.to_string())?,
            time_s: self.time_s,
            state: state(&self.state)?,
            memory: Memory {
                contacts: Pairs {
                    number: self.pairs,
                    passed: &self.passed,
                    touching: &self.touching,
                    deformed: &self.deformed,
                    greatest_m: &self.greatest_deformation_m,
                }
                .histories()?,
                belts: belts(&self.belt_normal_vehicle, &self.belt_greatest_elongation_m)?,
                joints: Vec::new(),
            },
            first_touches: self.first_touches()?,
            progress: Progress {
                effort: Effort {
                    steps: self.steps,
                    rejected: self.rejected,
                    evaluations: self.evaluations,
                    step_s: self.last_step_s,
                },
                wanted_s: self.wanted_step_s,
                step_error: self.step_error,
                energy_start: self.energy_start(),
                greatest_kinetic_j: self.greatest_kinetic_j,
                greatest_imbalance_j: self.greatest_imbalance_j,
            },
            under_way: self.step_start()?,
        })
    }

    fn energy_start(&self) -> EnergyStart {
        let mut start = EnergyStart { mechanical_j: self.start_mechanical_j, ..EnergyStart::default() };
        start.stored_j[contact::STORED] = self.start_contacts_j;
        start.stored_j[belt::STORED] = self.start_belts_j;
        start
    }

    /// The start of the step in which the output lies.
    fn step_start(&self) -> Result<Option<StepStart>, String> {
        let [start_s, end_s] = self.step_times_s[..] else {
            same_length("times of a step", &self.step_times_s, &[(); 0])?;
            return Ok(None);
        };
        Ok(Some(StepStart {
            start_s,
            end_s,
            state: state(&self.step_state)?,
            memory: Memory {
                contacts: Pairs {
                    number: self.pairs,
                    passed: &self.step_passed,
                    touching: &self.step_touching,
                    deformed: &self.step_deformed,
                    greatest_m: &self.step_greatest_deformation_m,
                }
                .histories()?,
                belts: belts(&self.step_belt_normal_vehicle, &self.step_belt_greatest_elongation_m)?,
                joints: Vec::new(),
            },
        }))
    }

    fn first_touches(&self) -> Result<Vec<FirstTouch>, String> {
        let spheres = &self.first_touch_sphere;
        same_length("first touches", spheres, &self.first_touch_surface)?;
        same_length("first touches", spheres, &self.first_touch_time_s)?;
        same_length("first touches", spheres, &self.first_touch_closing_m_s)?;
        let touch = |(i, &sphere): (usize, &u32)| FirstTouch {
            sphere: sphere as usize,
            surface: self.first_touch_surface[i] as usize,
            time_s: self.first_touch_time_s[i],
            closing_m_s: self.first_touch_closing_m_s[i],
        };
        Ok(spheres.iter().enumerate().map(touch).collect())
    }
}

/// Pairs of a sphere and a face, by lists of those that are not open and whole.
struct Pairs<'a> {
    number: u64,
    passed: &'a [u32],
    touching: &'a [u32],
    deformed: &'a [u32],
    greatest_m: &'a [f64],
}

impl Pairs<'_> {
    fn histories(&self) -> Result<Vec<PairHistory<f64>>, String> {
        if self.number > MOST_PAIRS {
            return Err(format!("a checkpoint has {} pairs", self.number));
        }
        same_length("deformed pairs", self.deformed, self.greatest_m)?;
        let open = PairHistory { phase: OPEN, greatest: 0.0 };
        let mut pairs = vec![open; self.number as usize];
        let mut change = |pair: u32, to: &dyn Fn(&mut PairHistory<f64>)| {
            let found = pairs.get_mut(pair as usize);
            found.map(to).ok_or_else(|| format!("a checkpoint has no pair {pair}, it has {}", self.number))
        };
        for (list, phase) in [(self.passed, PASSED), (self.touching, TOUCHING)] {
            for &pair in list {
                change(pair, &|p| p.phase = phase)?;
            }
        }
        for (&pair, &greatest) in self.deformed.iter().zip(self.greatest_m) {
            change(pair, &|p| p.greatest = greatest)?;
        }
        Ok(pairs)
    }
}

fn state(numbers: &[f64]) -> Result<State<f64>, String> {
    let found = numbers.len();
    let numbers = numbers.try_into().map_err(|_| format!("a checkpoint's state has {found} numbers, not 75"))?;
    Ok(State::from_numbers(numbers))
}

fn belts(normals: &[f64], greatest_m: &[f64]) -> Result<Vec<BeltHistory<f64>>, String> {
    let (normals, odd) = normals.as_chunks::<3>();
    same_length("belts", normals, greatest_m)?;
    same_length("components of belts' normals", odd, &[(); 0])?;
    let belts = normals.iter().zip(greatest_m);
    Ok(belts.map(|(&[x, y, z], &greatest)| BeltHistory { normal: v3(x, y, z), greatest }).collect())
}

fn same_length<A, B>(what: &str, a: &[A], b: &[B]) -> Result<(), String> {
    match a.len() == b.len() {
        true => Ok(()),
        false => Err(format!("a checkpoint's lists of {what} have {} and {} entries", a.len(), b.len())),
    }
}
