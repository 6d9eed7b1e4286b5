//! A number in SI units as a person would have written it at a place of a scenario.

use super::document::Value;
use super::draft::Draft;
use super::place::Wanted;
use super::quantity::split_number;
use super::unit_expression;

impl Draft {
    /// A number in SI units as it would be written at a place, as TOML: with so many significant digits, in the unit that
    /// the number there has, else in that of the scenario's bare numbers. None where no number can stand.
    pub fn written(&self, path: &str, si: f64, digits: usize) -> Option<String> {
        let place = self.places(path).ok()?.into_iter().next()?;
        let kind = match place.wanted {
            Wanted::Quantity(kind) => kind,
            Wanted::Number => return Some(rounded(si, digits)),
            Wanted::Names(_) | Wanted::Text | Wanted::Truth => return None,
        };
        if let Some(Value::String(text)) = &place.value {
            let (_, start) = split_number(text)?;
            let unit = text[start..].trim_end();
            let scale = unit_expression::parse(unit, 0).ok()?;
            return Some(format!("\"{} {unit}\"", rounded(si / scale.factor, digits)));
        }
        let bare = kind.bare_unit(self.units());
        let factor = match bare {
            "" => 1.0,
            unit => unit_expression::parse(unit, 0).ok()?.factor,
        };
        Some(rounded(si / factor, digits))
    }

    /// The unit in which people read a number at a place, and how many SI units it is: that of the number that stands
    /// there, else that of the scenario's bare numbers. None where no quantity can stand.
    pub fn unit_at(&self, path: &str) -> Option<(String, f64)> {
        let place = self.places(path).ok()?.into_iter().next()?;
        let Wanted::Quantity(kind) = place.wanted else {
            return None;
        };
        let unit = match &place.value {
            Some(Value::String(text)) => {
                let (_, start) = split_number(text)?;
                text[start..].trim_end().to_owned()
            }
            _ => kind.bare_unit(self.units()).to_owned(),
        };
        if unit.is_empty() {
            return Some((unit, 1.0));
        }
        let factor = unit_expression::parse(&unit, 0).ok()?.factor;
        Some((unit, factor))
    }
}

/// The shortest text of a number rounded to so many significant digits.
fn rounded(value: f64, digits: usize) -> String {
    let short = format!("{value:.*e}", digits.max(1) - 1);
    short.parse::<f64>().unwrap_or(value).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Format;

    #[test]
    fn numbers_keep_the_unit_that_stands_there() {
        let text = r#"
            title = "a"
            units = "in-lbf-s"
            [joints.neck]
            damping = "20 in lbf s/rad"
            [materials]
            seat = { k1 = 48, mu1 = 0.5 }
            [path]
            kind = "pulse"
            speed = "20 mph"
        "#;
        let draft = Draft::read(text, Format::Toml, "a.toml").unwrap();
        let si = |path: &str| draft.places(path).unwrap()[0].si.unwrap();
        for (path, wanted) in [
            ("joints.neck.damping", "\"24.6914 in lbf s/rad\""),
            ("materials.seat.k1", "59.2593"),
            ("materials.seat.mu1", "0.617284"),
            ("path.speed", "\"24.6914 mph\""),
        ] {
            let found = draft.written(path, si(path) * 1.234_567_9, 6);
            assert_eq!(found.as_deref(), Some(wanted));
        }
        assert_eq!(draft.written("title", 1.0, 6), None);
    }
}
