//! The rules a deck can break, and how gravely.

use std::fmt;

/// Strictness of the check of a deck.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Strictness {
    /// Everything doubtful is an error.
    Strict,
    /// Ambiguous content is an error, doubtful content a warning.
    #[default]
    Default,
    /// Content with one obvious repair is repaired, with a warning.
    Lenient,
}

/// Severity of a diagnostic.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Information.
    Note,
    /// The deck is used, but should be checked.
    Warning,
    /// The deck is not used.
    Error,
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Note => "note",
            Self::Warning => "warning",
            Self::Error => "error",
        })
    }
}

/// Grade of a rule, before strictness is applied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Grade {
    /// Without a certain reading: always an error.
    Fatal,
    /// With one obvious reading: an error, or a warning in lenient mode.
    Repairable,
    /// With a certain reading but doubtful intention: a warning, or an error in strict mode.
    Doubtful,
    /// Always a note.
    Remark,
}

impl Grade {
    /// Severity of a violated rule of this grade.
    pub fn severity(self, strictness: Strictness) -> Severity {
        match (self, strictness) {
            (Self::Fatal, _) => Severity::Error,
            (Self::Repairable, Strictness::Lenient) => Severity::Warning,
            (Self::Repairable, _) => Severity::Error,
            (Self::Doubtful, Strictness::Strict) => Severity::Error,
            (Self::Doubtful, _) => Severity::Warning,
            (Self::Remark, _) => Severity::Note,
        }
    }
}

/// The rules: text, [`Grade`], stable name, expectation and remedy if they are always the same.
macro_rules! rules {
    ($(
        $(#[$meaning:meta])*
        $rule:ident: $grade:ident, $name:literal $(, expects $expected:literal)? $(, remedy $remedy:literal)?;
    )*) => {
        /// A rule of the cards; [`Rule::name`] is the stable name printed with every diagnostic.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Rule {
            $($(#[$meaning])* $rule,)*
        }

        impl Rule {
            /// Grade of the rule.
            pub fn grade(self) -> Grade {
                match self {
                    $(Self::$rule => Grade::$grade,)*
                }
            }

            /// Stable name of the rule.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$rule => $name,)*
                }
            }

            /// Expectation and remedy; none if they depend on the case.
            pub(crate) fn expected_and_remedy(self) -> [Option<&'static str>; 2] {
                let [expected, remedy] = match self {
                    $(Self::$rule => [concat!($($expected)?), concat!($($remedy)?)],)*
                };
                [expected, remedy].map(|text| Some(text).filter(|text| !text.is_empty()))
            }
        }
    };
}

rules! {
    // The file and its lines.
    /// No card.
    EmptyFile: Fatal, "empty-file", expects "two title cards, series 3 to 16 and FINI";
    /// Characters in EBCDIC.
    Ebcdic: Remark, "ebcdic";
    /// Characters in UTF-16.
    Utf16: Remark, "utf-16";
    /// Bytes that are not text of cards.
    NotCards: Fatal, "not-cards", expects "text: Latin-1, UTF-16 or EBCDIC",
        remedy "unpack the file, or export it as text; records must not carry their lengths";
    /// Records of 80 columns without line ends.
    NoLineEnds: Remark, "no-line-ends";
    /// A tab, which has no defined column.
    Tab: Repairable, "tab", expects "blanks only, so that every character has its column",
        remedy "replace tabs by blanks; it was read as if tab stops stood every 8 columns";
    /// Characters beyond column 80.
    LineTooLong: Doubtful, "line-too-long", expects "80 columns",
        remedy "check that no field has slipped to the right, and cut the line";
    /// Characters beyond column 80 in many lines, such as sequence numbers of another machine.
    BeyondTheCard: Remark, "beyond-the-card", expects "80 columns",
        remedy "nothing to do, unless fields have slipped to the right";
    /// A control character.
    ControlCharacter: Doubtful, "control-character";
    /// Bytes that look like UTF-8; they are read as Latin-1, one byte per column.
    LooksLikeUtf8: Doubtful, "looks-like-utf-8", expects "Latin-1, one byte a column",
        remedy "save the deck as Latin-1 (ISO 8859-1) or use plain ASCII";
    /// Text after the final card.
    AfterFinalCard: Doubtful, "after-final-card", expects "FINI behind the last deck, and nothing more",
        remedy "remove an earlier FINI if a deck follows; remove the rest otherwise";
    // The fields.
    /// Characters that are not a number.
    NotANumber: Fatal, "not-a-number";
    /// A number beyond the range of the IBM 360.
    OutOfRange: Fatal, "out-of-range",
        remedy "an exponent must end in the last column of the field, because blanks behind it are zeros";
    /// Blanks between digits, read as zeros.
    EmbeddedBlanks: Doubtful, "embedded-blanks", remedy "close the gap, or punch the zeros";
    /// Blanks after the last digit, read as zeros of a number without a point.
    LeftJustified: Doubtful, "left-justified";
    /// An exponent without its letter.
    BareExponent: Remark, "bare-exponent", remedy "punch the E";
    /// A small exponent letter.
    SmallLetter: Doubtful, "small-letter", remedy "punch E or D";
    /// A number too close to zero for the IBM 360.
    Underflow: Doubtful, "underflow", remedy "punch 0.";
    /// Blank fields read as zero, counted once per deck.
    BlankIsZero: Remark, "blank-is-zero";
    /// Points without a digit, read as zero, counted once per deck.
    LonePoint: Doubtful, "lone-point", expects "a number with a digit, or a blank", remedy "punch 0. where zero is meant";
    /// Characters in columns that the report leaves blank.
    NotBlank: Doubtful, "not-blank", remedy "look whether a number has slipped out of its columns, or remove it";
    /// A number that must be whole and is not, or an implausible count.
    NotAWholeNumber: Fatal, "not-a-whole-number";
    /// A word other than those the report knows (STAN, NONE, FINI).
    UnknownWord: Repairable, "unknown-word", expects "STAN or NONE",
        remedy "punch the word in capitals from column 1; in lenient reading capitals do not matter, anything else is NONE";
    // The order of the cards.
    /// A file that ends within a deck.
    Truncated: Fatal, "truncated", expects "the rest of the deck, a card 1000, a plot card and FINI",
        remedy "look for the missing end of the file";
    /// A title card is missing.
    MissingTitle: Fatal, "missing-title";
    /// A card that begins no series where one must begin.
    UnexpectedCard: Fatal, "unexpected-card";
    /// The card number of a series' first card is blank, misplaced or wrong.
    CardNumber: Repairable, "card-number";
    /// Card number in the columns of the report's format I8.
    CardNumberByFormat: Remark, "card-number-by-format";
    /// A series has fewer cards than it needs.
    SeriesTooShort: Fatal, "series-too-short", remedy "add the missing cards";
    /// The number of cards differs from the count on the series' first card.
    CountDiffers: Repairable, "count-differs", remedy "correct the count, or add or remove cards";
    /// A duplicate series.
    SeriesTwice: Repairable, "series-twice", expects "each series once",
        remedy "remove one of the two; in lenient reading the later one counts, as it did in the program";
    /// A series out of the report's order.
    OutOfOrder: Doubtful, "out-of-order", expects "the series in the order of their numbers",
        remedy "sort the deck; it was read by its card numbers";
    /// A missing series that the deck needs.
    SeriesMissing: Fatal, "series-missing", remedy "add the cards, or punch the card number if they are there";
    /// A series that the deck does not need.
    SeriesUnused: Remark, "series-unused";
    /// A segment, surface or pair number outside its range.
    BadIndex: Fatal, "bad-index";
    /// A duplicate segment, surface or pair.
    IndexTwice: Fatal, "index-twice";
    /// A segment or surface without its card.
    IndexMissing: Fatal, "index-missing", remedy "add the cards, or correct their numbers";
    /// Missing card 1000, which ends the numbers.
    NoTerminator: Repairable, "no-terminator", expects "a card with 1000 in columns 77–80 before this one",
        remedy "add the card";
    /// The plot card STAN or NONE is missing.
    NoPlotCard: Repairable, "no-plot-card", expects "STAN or NONE behind the card 1000",
        remedy "add the card; in lenient reading it is NONE";
    /// The final card FINI is missing.
    NoFinalCard: Doubtful, "no-final-card", expects "FINI in columns 1–4 behind the last deck",
        remedy "add a card FINI; look whether the file is complete";
    // What the numbers mean.
    /// A number outside the possible range of the quantity.
    Impossible: Fatal, "impossible";
    /// A possible but unlikely number.
    Unlikely: Doubtful, "unlikely";
    /// A number that looks like another unit.
    LooksLikeOtherUnit: Doubtful, "looks-like-other-unit";
    /// Numbers that contradict each other.
    Inconsistent: Doubtful, "inconsistent";
    /// A violated equality of the compartment's points.
    CompartmentEquality: Doubtful, "compartment-equality";
    /// A vehicle path that does not cover the run.
    PathTooShort: Fatal, "path-too-short";
    /// A pair of series 14 whose surface the scenario omits, so that it has no effect.
    PassedPairUnused: Doubtful, "passed-pair-unused";
    /// A field without effect in this deck.
    Ignored: Remark, "ignored";
}
