//! A run as bytes: to be saved and resumed, in another process or on another machine.

use std::sync::Arc;

use super::driving::Held;
use super::{Course, Run, RunError};
use crate::forces::stored::Archive;
use crate::model::Model;
use crate::quantity::{FieldWords, Value};
use crate::results::checkpoint::Checkpoint;
use crate::vehicle::live::LiveFrames;

/// First bytes of the format.
const MARK: &[u8; 16] = b"occupant run 1\r\n";

impl Run<'_> {
    /// The whole run as bytes, including the motion of a live vehicle: [`Run::load`] continues from it, to the bit.
    ///
    /// # Errors
    /// As of [`Run::look`].
    pub fn save(&mut self) -> Result<Vec<u8>, RunError> {
        let mut checkpoint = self.checkpoint()?;
        let mut file = Writer(MARK.to_vec());
        file.0.extend(self.model.names_hash().to_le_bytes());
        checkpoint.keep(&mut file);
        let course = &mut self.course;
        let energies: Vec<f64> = course
            .energy_starts
            .iter()
            .flat_map(|start| start.stored_j.into_iter().chain([start.mechanical_j]))
            .collect();
        let frames = course.cursor.live.as_ref().map_or_else(Vec::new, |frames| frames.numbers());
        for list in [energies, course.breaks_s.clone(), frames, vec![f64::from(u8::from(self.is_recorded))]] {
            (&mut file as &mut dyn Archive).numbers(EXTRA, list);
        }
        Ok(file.0)
    }
}

impl Run<'static> {
    /// [`Run::load`] of a model that the run shares.
    ///
    /// # Errors
    /// As of [`Run::load`].
    pub fn load_shared(model: Arc<Model>, bytes: &[u8]) -> Result<Self, RunError> {
        let Run { course, is_recorded, .. } = Run::load(&model, bytes)?;
        Ok(Run { course, is_recorded, model: Held::Shared(model) })
    }
}

impl<'m> Run<'m> {
    /// The run of `model` that [`Run::save`] put away.
    ///
    /// # Errors
    /// Bytes that are no saved run of this model, or of another version of the program.
    pub fn load(model: &'m Model, bytes: &[u8]) -> Result<Self, RunError> {
        let wrong = |found: &str| RunError::input(found, "what `Run::save` gave for this model, in this version");
        let rest = bytes.strip_prefix(MARK).ok_or_else(|| wrong("bytes that are no saved run"))?;
        let (hash, rest) = rest.split_at_checked(8).ok_or_else(|| wrong("a saved run that breaks off"))?;
        if hash != model.names_hash().to_le_bytes() {
            return Err(wrong("a run of another model"));
        }
        let mut file = Reader { rest, is_sound: true };
        let checkpoint = Checkpoint::stored(&mut file);
        let mut lists = [const { Vec::new() }; 4];
        for list in &mut lists {
            *list = (&mut file as &mut dyn Archive).numbers(EXTRA, Vec::new());
        }
        if !file.is_sound || !file.rest.is_empty() {
            return Err(wrong("a saved run that is cut off or too long"));
        }
        let [energies, breaks_s, frames, is_recorded] = lists;
        let mut course = Course::from_checkpoint(model, &checkpoint, false)?;
        take_energies(&mut course, &energies);
        if !breaks_s.is_sorted() {
            return Err(wrong("times that do not rise"));
        }
        course.breaks_s = breaks_s;
        course.cursor.live = match &frames[..] {
            [] => None,
            numbers => Some(Box::new(LiveFrames::from_numbers(numbers).ok_or_else(|| wrong("other frames"))?)),
        };
        Ok(Run { model: Held::Lent(model), course, is_recorded: is_recorded.first().is_some_and(|x| *x == 1.0) })
    }
}

/// Reference energies of balances, of which a checkpoint contains those of the first body only.
fn take_energies(course: &mut Course, numbers: &[f64]) {
    for (start, own) in course.energy_starts.iter_mut().zip(numbers.chunks_exact(crate::forces::STORES + 1)) {
        start.stored_j.copy_from_slice(&own[..crate::forces::STORES]);
        start.mechanical_j = own[crate::forces::STORES];
    }
}

/// Lists in addition to the checkpoint.
const EXTRA: FieldWords = FieldWords { number: u32::MAX, stem: "", meaning: "" };

/// Writes values one after another: field number, kind, length, numbers.
struct Writer(Vec<u8>);

/// Reads these values.
struct Reader<'a> {
    rest: &'a [u8],
    is_sound: bool,
}

impl Archive for Writer {
    fn exchange(&mut self, words: FieldWords, value: &mut Value) {
        let (kind, numbers): (u8, Vec<u64>) = match value {
            Value::Number(x) => (0, vec![x.to_bits()]),
            Value::Count(n) => (1, vec![*n]),
            Value::Numbers(list) => (2, list.iter().map(|x| x.to_bits()).collect()),
            Value::Indices(list) => (3, list.iter().map(|n| u64::from(*n)).collect()),
            Value::Singles(list) => (4, list.iter().map(|x| u64::from(x.to_bits())).collect()),
            // no checkpoint has others
            _ => (5, Vec::new()),
        };
        self.0.extend(words.number.to_le_bytes());
        self.0.push(kind);
        self.0.extend((numbers.len() as u64).to_le_bytes());
        self.0.extend(numbers.iter().flat_map(|n| n.to_le_bytes()));
    }
}

impl<'a> Reader<'a> {
    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(count)?;
        self.rest = rest;
        Some(taken)
    }

    fn number<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }

    fn value(&mut self, words: FieldWords) -> Option<Value> {
        let is_it = u32::from_le_bytes(self.number()?) == words.number;
        let [kind] = self.number()?;
        let count = usize::try_from(u64::from_le_bytes(self.number()?)).ok()?;
        let numbers = self.take(count.checked_mul(8)?)?.as_chunks().0.iter().map(|n| u64::from_le_bytes(*n));
        let numbers: Vec<u64> = numbers.collect();
        let first = numbers.first().copied();
        let value = match kind {
            0 => Value::Number(f64::from_bits(first?)),
            1 => Value::Count(first?),
            2 => Value::Numbers(numbers.into_iter().map(f64::from_bits).collect()),
            3 => Value::Indices(numbers.into_iter().map(|n| n as u32).collect()),
            4 => Value::Singles(numbers.into_iter().map(|n| f32::from_bits(n as u32)).collect()),
            _ => return None,
        };
        is_it.then_some(value)
    }
}

impl Archive for Reader<'_> {
    fn exchange(&mut self, words: FieldWords, value: &mut Value) {
        match self.value(words).filter(|_| self.is_sound) {
            Some(found) if std::mem::discriminant(&found) == std::mem::discriminant(value) => *value = found,
            _ => self.is_sound = false,
        }
    }

    fn refuse(&mut self, _why: &str) {
        self.is_sound = false;
    }
}
