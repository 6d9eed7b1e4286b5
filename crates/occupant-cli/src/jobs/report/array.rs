//! Long arrays in the page: base64 of little-endian numbers.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::{Serialize, Serializer};

/// Numbers that travel as base64.
#[derive(Clone, Debug, Default)]
pub(crate) struct Array(Vec<u8>);

impl Array {
    /// Of single precision: 7 figures, enough for the eye.
    pub(crate) fn float32(values: impl IntoIterator<Item = f64>) -> Self {
        let bytes = values.into_iter().flat_map(|v| (v as f32).to_le_bytes());
        Array(bytes.collect())
    }

    /// Of double precision.
    pub(crate) fn float64(values: impl IntoIterator<Item = f64>) -> Self {
        Array(values.into_iter().flat_map(f64::to_le_bytes).collect())
    }

    /// Of small counts; a greater one is the greatest.
    pub(crate) fn uint16(values: impl IntoIterator<Item = usize>) -> Self {
        let short = |v| u16::try_from(v).unwrap_or(u16::MAX).to_le_bytes();
        Array(values.into_iter().flat_map(short).collect())
    }

    /// Of counts; a greater one is the greatest.
    pub(crate) fn uint32(values: impl IntoIterator<Item = usize>) -> Self {
        let long = |v| u32::try_from(v).unwrap_or(u32::MAX).to_le_bytes();
        Array(values.into_iter().flat_map(long).collect())
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
        let text = |a: &Array| serde_json::to_string(a).unwrap();
        assert_eq!(text(&Array::float32([1.0])), "\"AACAPw==\"");
        assert_eq!(text(&Array::float64([1.0])), "\"AAAAAAAA8D8=\"");
        assert_eq!(text(&Array::uint16([1, 70_000])), "\"AQD//w==\"");
        assert_eq!(text(&Array::uint32([258])), "\"AgEAAA==\"");
    }
}
