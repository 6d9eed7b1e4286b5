//! Part of a study that one process computes.

use std::fmt;
use std::ops::Range;

/// Part `number` of `count`, from 1; part 1 of 1 is the whole study.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Shard {
    number: u64,
    count: u64,
}

impl Shard {
    /// The whole study.
    pub const WHOLE: Shard = Shard { number: 1, count: 1 };

    /// Parses `3/8`.
    ///
    /// # Errors
    /// Problems of it.
    pub fn parse(text: &str) -> Result<Shard, String> {
        let form = "part/number of parts, such as 3/8";
        let (number, count) =
            text.split_once('/').ok_or_else(|| format!("`{text}` is not a shard; expected {form}"))?;
        let read = |word: &str| {
            let word = word.trim();
            word.parse::<u64>().map_err(|_| format!("`{word}` in `{text}` is not a whole number; expected {form}"))
        };
        Shard::new(read(number)?, read(count)?)
    }

    fn new(number: u64, count: u64) -> Result<Shard, String> {
        match number {
            0 => Err(format!("there is no shard 0/{count}: shards are counted from 1, 1/{count} is the first")),
            _ if number > count => Err(format!("there is no shard {number} of {count}: the last is {count}/{count}")),
            _ => Ok(Shard { number, count }),
        }
    }

    /// The shard given by the environment, and the variable: `OCCUPANT_SHARD`, or else the Slurm job array of the process, or
    /// else the index of the Kubernetes job, one of `OCCUPANT_SHARDS`.
    ///
    /// # Errors
    /// Variables that name no shard.
    pub fn from_environment(get: impl Fn(&str) -> Option<String>) -> Result<Option<(Shard, &'static str)>, String> {
        if let Some(text) = get("OCCUPANT_SHARD") {
            let shard = Shard::parse(&text).map_err(|e| format!("OCCUPANT_SHARD: {e}"))?;
            return Ok(Some((shard, "OCCUPANT_SHARD")));
        }
        let number = |name: &str| {
            let read = |text: String| {
                text.trim().parse::<u64>().map_err(|_| format!("{name}: `{text}` is not a whole number"))
            };
            get(name).map(read).transpose()
        };
        let Some(id) = number("SLURM_ARRAY_TASK_ID")? else {
            let Some(index) = number("JOB_COMPLETION_INDEX")? else { return Ok(None) };
            let count = number("OCCUPANT_SHARDS")?
                .ok_or("JOB_COMPLETION_INDEX is set, but not OCCUPANT_SHARDS; give it the completions of the job")?;
            return Ok(Some((Shard::new(index.saturating_add(1), count)?, "JOB_COMPLETION_INDEX")));
        };
        let count = number("SLURM_ARRAY_TASK_COUNT")?;
        let count = count.ok_or("SLURM_ARRAY_TASK_ID is set, but not SLURM_ARRAY_TASK_COUNT")?;
        let first = number("SLURM_ARRAY_TASK_MIN")?.unwrap_or(0);
        let step = number("SLURM_ARRAY_TASK_STEP")?.unwrap_or(1);
        let place = id.checked_sub(first).filter(|beyond| step > 0 && beyond % step == 0).map(|beyond| beyond / step);
        let place = place.filter(|place| *place < count).ok_or_else(|| {
            format!(
                "task {id} of a Slurm array of {count} tasks from {first} in steps of {step} does not match a part of a study; use an array without gaps"
            )
        })?;
        let shard = Shard::new(place + 1, count)?;
        Ok(Some((shard, "SLURM_ARRAY_TASK_ID")))
    }

    /// Whether it is the whole study.
    pub fn is_whole(self) -> bool {
        self.count == 1
    }

    /// The samples of this part of `samples`: an even, contiguous share.
    pub fn range(self, samples: &Range<u64>) -> Range<u64> {
        let count = samples.end.saturating_sub(samples.start);
        let border = |part: u64| {
            let at = u128::from(count) * u128::from(part) / u128::from(self.count);
            // no greater than `count`
            samples.start + u64::try_from(at).unwrap_or(count)
        };
        border(self.number - 1)..border(self.number)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_cover_every_sample_once() {
        for (samples, count) in [(0, 3), (1, 3), (10, 3), (7, 7), (5, 8), (1_000_000, 48)] {
            let mut next = 7;
            for number in 1..=count {
                let range = Shard { number, count }.range(&(7..7 + samples));
                assert_eq!(range.start, next);
                assert!(range.end - range.start <= samples / count + 1);
                next = range.end;
            }
            assert_eq!(next, 7 + samples);
        }
    }

    #[test]
    fn what_is_no_shard_is_refused_in_words() {
        let refused = |text| Shard::parse(text).unwrap_err();
        assert!(refused("0/8").contains("counted from 1"));
        assert!(refused("9/8").contains("the last is 8/8"));
        assert!(refused("3").contains("such as 3/8"));
        assert!(refused("x/8").contains("not a whole number"));
    }

    fn environment<'a>(pairs: &'a [(&str, &str)]) -> impl Fn(&str) -> Option<String> + 'a {
        move |name| {
            let found = pairs.iter().find(|(key, _)| *key == name);
            found.map(|(_, value)| (*value).to_owned())
        }
    }

    #[test]
    fn slurm_tells_the_shard_and_our_own_variable_goes_before() {
        let slurm = [
            ("SLURM_ARRAY_TASK_ID", "14"),
            ("SLURM_ARRAY_TASK_COUNT", "3"),
            ("SLURM_ARRAY_TASK_MIN", "10"),
            ("SLURM_ARRAY_TASK_STEP", "2"),
        ];
        let third = Shard::parse("3/3").unwrap();
        let found = Shard::from_environment(environment(&slurm));
        assert_eq!(found, Ok(Some((third, "SLURM_ARRAY_TASK_ID"))));
        let mut both = slurm.to_vec();
        both.push(("OCCUPANT_SHARD", "1/2"));
        let half = Shard::parse("1/2").unwrap();
        let found = Shard::from_environment(environment(&both));
        assert_eq!(found, Ok(Some((half, "OCCUPANT_SHARD"))));
        assert_eq!(Shard::from_environment(|_| None), Ok(None));
        for refused in [&slurm[..1], &[slurm[0], slurm[1]], &slurm[..3]] {
            assert!(Shard::from_environment(environment(refused)).is_err(), "{refused:?}");
        }
    }

    #[test]
    fn an_indexed_job_of_kubernetes_counts_from_nought() {
        let job = [("JOB_COMPLETION_INDEX", "7"), ("OCCUPANT_SHARDS", "8")];
        let last = Shard::parse("8/8").unwrap();
        assert_eq!(Shard::from_environment(environment(&job)), Ok(Some((last, "JOB_COMPLETION_INDEX"))));
        assert_eq!(Shard::from_environment(environment(&job[1..])), Ok(None));
        let refused = |pairs: &[(&str, &str)]| Shard::from_environment(environment(pairs)).unwrap_err();
        assert!(refused(&job[..1]).contains("completions of the job"));
        assert!(refused(&[job[0], ("OCCUPANT_SHARDS", "7")]).contains("the last is 7/7"));
    }
}
