//! The plot card, STAN or NONE (series 16).

use crate::card::Card;
use crate::card_number::looks_like_first_card;
use crate::deck::Plot;
use crate::diagnostic::Finding;
use crate::field_reader::read_fields;
use crate::layout::{CardId, series};
use crate::reader::{Reader, starts_with_fini};
use crate::rule::Rule;
use crate::series_reader::WORD;

const PLOT_SERIES: u8 = 16;

impl Reader<'_> {
    /// The plot card; `None` if the deck ends without one and is not to be used.
    pub(crate) fn read_plot(&mut self) -> Option<Plot> {
        let id = CardId { series: PLOT_SERIES, letter: None, number: None };
        let card = self.card();
        let third_follows = self.cards.get(self.at + 2).and_then(looks_like_first_card).is_some_and(|s| s.number == 3);
        let word = card.map(|c| c.text_of(WORD).to_ascii_uppercase());
        let plot = match word.as_deref() {
            Some("STAN") => Plot::Standard,
            Some("NONE") => Plot::None,
            _ if card.is_none_or(starts_with_fini) || third_follows => {
                self.report_no_plot_card(card, id);
                return Some(Plot::None);
            }
            _ => Plot::None,
        };
        let card = card?;
        self.at += 1;
        if card.text_of(WORD) != word.unwrap_or_default() || !matches!(card.field(WORD), b"STAN" | b"NONE") {
            self.sink.report(
                Finding::new(Rule::UnknownWord, format!("`{}` is no plot option", card.text_of(WORD)))
                    .on(card)
                    .in_card(id)
                    .at(WORD)
                    .expected("STAN or NONE")
                    .remedy("punch the word in capitals from column 1; in lenient reading capitals do not matter, anything else is NONE"),
            );
        }
        self.check_rest_of_word_card(card, id);
        Some(plot)
    }

    fn report_no_plot_card(&mut self, card: Option<&Card>, id: CardId) {
        let mut finding = Finding::new(Rule::NoPlotCard, "the plot card (series 16) is missing")
            .in_card(id)
            .expected("STAN or NONE behind the card 1000")
            .remedy("add the card; in lenient reading it is NONE");
        if let Some(card) = card.or(self.cards.last()) {
            finding = finding.on(card);
        }
        self.sink.report(finding);
    }

    pub(crate) fn check_rest_of_word_card(&mut self, card: &Card, id: CardId) {
        if let Some(layout) = series(PLOT_SERIES).and_then(|s| s.cards.first()) {
            read_fields(card, layout, id, self.sink);
        }
    }
}
