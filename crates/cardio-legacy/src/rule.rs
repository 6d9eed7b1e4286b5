//! The rules a deck can break, and how gravely.

use std::fmt;

/// How strictly a deck is judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Strictness {
    /// Everything doubtful is an error.
    Strict,
    /// What cannot be read with certainty is an error; what is doubtful is a warning.
    #[default]
    Default,
    /// What can be repaired in one obvious way is repaired, with a warning.
    Lenient,
}

/// What a diagnostic means for the deck.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Worth knowing.
    Note,
    /// The deck is used, but somebody should look.
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

/// Gravity of a rule before strictness is applied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Grade {
    /// There is no sure reading: always an error.
    Fatal,
    /// One obvious reading exists: an error, in lenient reading a warning.
    Repairable,
    /// The reading is sure, its intention is not: a warning, in strict reading an error.
    Doubtful,
    /// Always a note.
    Remark,
}

impl Grade {
    /// The severity of a broken rule of this grade.
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

/// A rule of the cards; [`Rule::name`] is the stable name printed with every diagnostic.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Rule {
    // The file and its lines.
    /// No card at all.
    EmptyFile,
    /// A tab, which has no column.
    Tab,
    /// Characters behind column 80.
    LineTooLong,
    /// A control character.
    ControlCharacter,
    /// Bytes that look like UTF-8; they are read as Latin-1, one byte a column.
    LooksLikeUtf8,
    /// Something behind the final card.
    AfterFinalCard,
    // The fields.
    /// Characters that are no number.
    NotANumber,
    /// A number beyond the range of the 360.
    OutOfRange,
    /// Blanks between digits, read as zeros.
    EmbeddedBlanks,
    /// Blanks behind the last digit that became zeros of a number without a point.
    LeftJustified,
    /// An exponent without its letter.
    BareExponent,
    /// A small exponent letter.
    SmallLetter,
    /// A number too near to zero for the 360.
    Underflow,
    /// Blank fields read as zero, counted once a deck.
    BlankIsZero,
    /// Something in columns that the report leaves blank.
    NotBlank,
    /// A number that has to be whole and is not, or counts nothing sensible.
    NotAWholeNumber,
    /// A word other than those the report knows (STAN, NONE, FINI).
    UnknownWord,
    // The order of the cards.
    /// The file ends inside a deck.
    Truncated,
    /// A title card is missing.
    MissingTitle,
    /// A card that starts no series where one must start.
    UnexpectedCard,
    /// The card number of a series' first card is blank, misplaced or wrong.
    CardNumber,
    /// The card number stands where the report's format I8 reads it.
    CardNumberByFormat,
    /// A series has fewer cards than it needs.
    SeriesTooShort,
    /// The number of cards differs from the count on the series' first card.
    CountDiffers,
    /// A series comes twice.
    SeriesTwice,
    /// A series stands elsewhere than in the report's order.
    OutOfOrder,
    /// A series that the deck needs is not there.
    SeriesMissing,
    /// A series that the deck does not need is there.
    SeriesUnused,
    /// A segment, surface or pair number outside its range.
    BadIndex,
    /// The same segment, surface or pair twice.
    IndexTwice,
    /// A segment or surface without its card.
    IndexMissing,
    /// The card 1000 that ends the numbers is missing.
    NoTerminator,
    /// The plot card STAN or NONE is missing.
    NoPlotCard,
    /// The final card FINI is missing.
    NoFinalCard,
    // What the numbers mean.
    /// A number outside what the quantity can be.
    Impossible,
    /// A number that is possible and unlikely.
    Unlikely,
    /// A number that looks as if punched in another unit.
    LooksLikeOtherUnit,
    /// Numbers that contradict one another.
    Inconsistent,
    /// An equality of the compartment's points that does not hold.
    CompartmentEquality,
    /// The path of the vehicle does not cover the run.
    PathTooShort,
    /// A pair of series 14 whose surface a scenario leaves out, so that the pair has no effect.
    PassedPairUnused,
    /// A field that has no effect in this deck.
    Ignored,
}

impl Rule {
    /// The grade of the rule.
    pub fn grade(self) -> Grade {
        match self {
            Self::EmptyFile
            | Self::NotANumber
            | Self::OutOfRange
            | Self::NotAWholeNumber
            | Self::Truncated
            | Self::MissingTitle
            | Self::UnexpectedCard
            | Self::SeriesTooShort
            | Self::SeriesMissing
            | Self::BadIndex
            | Self::IndexTwice
            | Self::IndexMissing
            | Self::Impossible
            | Self::PathTooShort => Grade::Fatal,
            Self::Tab
            | Self::UnknownWord
            | Self::CardNumber
            | Self::CountDiffers
            | Self::SeriesTwice
            | Self::NoTerminator
            | Self::NoPlotCard => Grade::Repairable,
            Self::LineTooLong
            | Self::ControlCharacter
            | Self::LooksLikeUtf8
            | Self::AfterFinalCard
            | Self::EmbeddedBlanks
            | Self::LeftJustified
            | Self::SmallLetter
            | Self::Underflow
            | Self::NotBlank
            | Self::OutOfOrder
            | Self::NoFinalCard
            | Self::Unlikely
            | Self::LooksLikeOtherUnit
            | Self::Inconsistent
            | Self::CompartmentEquality
            | Self::PassedPairUnused => Grade::Doubtful,
            Self::BareExponent | Self::CardNumberByFormat | Self::BlankIsZero | Self::SeriesUnused | Self::Ignored => {
                Grade::Remark
            }
        }
    }

    /// The stable name of the rule.
    pub fn name(self) -> &'static str {
        match self {
            Self::EmptyFile => "empty-file",
            Self::Tab => "tab",
            Self::LineTooLong => "line-too-long",
            Self::ControlCharacter => "control-character",
            Self::LooksLikeUtf8 => "looks-like-utf-8",
            Self::AfterFinalCard => "after-final-card",
            Self::NotANumber => "not-a-number",
            Self::OutOfRange => "out-of-range",
            Self::EmbeddedBlanks => "embedded-blanks",
            Self::LeftJustified => "left-justified",
            Self::BareExponent => "bare-exponent",
            Self::SmallLetter => "small-letter",
            Self::Underflow => "underflow",
            Self::BlankIsZero => "blank-is-zero",
            Self::NotBlank => "not-blank",
            Self::NotAWholeNumber => "not-a-whole-number",
            Self::UnknownWord => "unknown-word",
            Self::Truncated => "truncated",
            Self::MissingTitle => "missing-title",
            Self::UnexpectedCard => "unexpected-card",
            Self::CardNumber => "card-number",
            Self::CardNumberByFormat => "card-number-by-format",
            Self::SeriesTooShort => "series-too-short",
            Self::CountDiffers => "count-differs",
            Self::SeriesTwice => "series-twice",
            Self::OutOfOrder => "out-of-order",
            Self::SeriesMissing => "series-missing",
            Self::SeriesUnused => "series-unused",
            Self::BadIndex => "bad-index",
            Self::IndexTwice => "index-twice",
            Self::IndexMissing => "index-missing",
            Self::NoTerminator => "no-terminator",
            Self::NoPlotCard => "no-plot-card",
            Self::NoFinalCard => "no-final-card",
            Self::Impossible => "impossible",
            Self::Unlikely => "unlikely",
            Self::LooksLikeOtherUnit => "looks-like-other-unit",
            Self::Inconsistent => "inconsistent",
            Self::CompartmentEquality => "compartment-equality",
            Self::PathTooShort => "path-too-short",
            Self::PassedPairUnused => "passed-pair-unused",
            Self::Ignored => "ignored",
        }
    }
}
