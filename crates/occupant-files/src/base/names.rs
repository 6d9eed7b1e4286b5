//! The names that files and messages carry: of this program, and of files without their folders. Texts as XML has them.

use std::path::{Component, Path};

/// Name and version of this program.
pub fn program() -> String {
    format!("occupant {}", env!("CARGO_PKG_VERSION"))
}

/// The name of a file without its folder.
pub fn file_name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

/// A word for a shell: quoted if it contains characters that a shell would interpret.
pub fn quoted(word: impl std::fmt::Display) -> String {
    let word = word.to_string();
    let is_plain = |c: char| c.is_alphanumeric() || "_./-+=:@%,".contains(c);
    // a word that begins with a dash would be an option
    if !word.is_empty() && word.chars().all(is_plain) && !word.starts_with('-') {
        return word;
    }
    let dashed = if word.starts_with('-') { "./" } else { "" };
    format!("'{dashed}{}'", word.replace('\'', r"'\''"))
}

/// File extension in lower case, without its dot; empty if there is none.
pub fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
}

/// The entry of a table for a file's extension; none for another one.
pub fn by_ending<T: Copy>(path: &Path, kinds: &[(&str, T)]) -> Option<T> {
    let ending = ending(path);
    kinds.iter().find(|(known, _)| *known == ending).map(|(_, kind)| *kind)
}

/// Whether a file name has the extension of a page.
pub fn is_page(path: &Path) -> bool {
    matches!(ending(path).as_str(), "html" | "htm")
}

/// A valid file name made from a name.
pub fn file_stem(name: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() || "-_ .".contains(c) { c } else { '_' };
    name.chars().map(plain).collect()
}

/// Whether a path read from a file stays inside a folder.
pub fn stays_within(name: &str) -> bool {
    !name.is_empty() && Path::new(name).components().all(|part| matches!(part, Component::Normal(_)))
}

/// Text for XML: marks escaped, control characters (which XML forbids) replaced.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\n' | '\t' | '\r' => out.push(' '),
            '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            c if c.is_control() => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shell_takes_a_quoted_name_as_one_word() {
        for plain in ["case.toml", "out/über.mcap", "a-b_c+1.csv"] {
            assert_eq!(quoted(plain), plain);
        }
        assert_eq!(quoted("my case.toml"), "'my case.toml'");
        assert_eq!(quoted("$(rm x);.toml"), "'$(rm x);.toml'");
        assert_eq!(quoted("it's.toml"), r"'it'\''s.toml'");
        assert_eq!((quoted(""), quoted("-f")), ("''".to_owned(), "'./-f'".to_owned()));
    }
}
