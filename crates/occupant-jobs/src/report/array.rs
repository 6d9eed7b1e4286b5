//! Long arrays in the page: base64 of little-endian numbers.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::{Serialize, Serializer};

/// Numbers of one type, encoded as base64.
#[derive(Debug, Default)]
pub struct Array(Vec<u8>);

impl Array {
    /// Adds single-precision numbers: 7 digits, enough for display.
    pub fn float32(&mut self, values: impl IntoIterator<Item = f64>) {
        self.0.extend(values.into_iter().flat_map(|v| (v as f32).to_le_bytes()));
    }

    /// Adds numbers of double precision.
    pub fn float64(&mut self, values: &[f64]) {
        self.0.extend(values.iter().flat_map(|v| v.to_le_bytes()));
    }

    /// Adds a small count, clamped to the largest.
    pub fn uint16(&mut self, value: usize) {
        self.0.extend(u16::try_from(value).unwrap_or(u16::MAX).to_le_bytes());
    }

    /// Adds a count, clamped to the largest.
    pub fn uint32(&mut self, value: usize) {
        self.0.extend(u32::try_from(value).unwrap_or(u32::MAX).to_le_bytes());
    }
}

impl Serialize for Array {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&STANDARD.encode(&self.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_little_endian() {
        let text = |add: &dyn Fn(&mut Array)| {
            let mut array = Array::default();
            add(&mut array);
            serde_json::to_string(&array).unwrap()
        };
        assert_eq!(text(&|a| a.float32([1.0])), "\"AACAPw==\"");
        assert_eq!(text(&|a| a.float64(&[1.0])), "\"AAAAAAAA8D8=\"");
        assert_eq!(text(&|a| [1, 70_000].into_iter().for_each(|count| a.uint16(count))), "\"AQD//w==\"");
        assert_eq!(text(&|a| a.uint32(258)), "\"AgEAAA==\"");
    }
}
