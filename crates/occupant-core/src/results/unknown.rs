//! A name or an index that a model does not have.

use std::fmt::Display;

use placed_text::nearest;

/// A name or an index that a model does not have, with a likely correction.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no {what} `{asked}`{}", meant(self.nearest.as_deref()))]
#[non_exhaustive]
pub struct Unknown {
    /// Kind of the requested thing: a channel, a sphere.
    pub what: &'static str,
    /// The name or index.
    pub asked: String,
    /// Nearest existing name, if one is near.
    pub nearest: Option<String>,
}

impl Unknown {
    /// `asked` is not among `names`.
    pub fn new<'n>(what: &'static str, asked: impl Display, names: impl Iterator<Item = &'n str>) -> Self {
        let asked = asked.to_string();
        let nearest = nearest(&asked, names).map(str::to_owned);
        Unknown { what, asked, nearest }
    }
}

fn meant(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |name| format!("; did you mean `{name}`?"))
}
