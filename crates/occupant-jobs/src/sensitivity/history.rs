//! Time histories of derivatives as tables: the channel, then its derivative by each parameter.

use occupant_core::model::Model;

use super::analysis::{Analysis, Asked};
use super::units::{ascii, per};
use crate::base::program;
use crate::files::history::{Column, Histories, UnitChoice, shown};
use occupant_files::export::{About, ColumnAbout};

/// Channels and their derivatives over the outputs.
pub fn histories(asked: &Asked<'_>, analysis: &Analysis) -> Histories {
    let mut columns = Vec::new();
    for (c, channel) in asked.request.channels.iter().enumerate() {
        let mut column = |values: Vec<f64>| {
            columns.push(Column { channel: channel.clone(), class: None, values });
        };
        column(analysis.values.channels[c].clone());
        for derivatives in &analysis.derivatives {
            column(derivatives.channels[c].iter().map(|s| s.value).collect());
        }
    }
    let outputs = &analysis.trajectory.checkpoints;
    Histories { time_s: outputs.iter().map(|o| o.time_s).collect(), columns, notes: Vec::new() }
}

/// Description of the columns; `source` is the scenario's name and SHA-256.
pub fn about(model: &Model, asked: &Asked<'_>, analysis: &Analysis, [source, sha256]: [&str; 2]) -> About {
    let mut columns = vec![ColumnAbout::time()];
    for channel in &asked.request.channels {
        let unit = shown(channel.unit, UnitChoice::Si).ascii();
        let column = |name: String, unit: String, meaning: String| {
            let (frame, filter) = (channel.axes.name(), "none".to_owned());
            ColumnAbout { name, unit, frame, filter, meaning }
        };
        columns.push(column(channel.name.clone(), unit.clone(), channel.meaning.clone()));
        columns.extend(asked.parameters.iter().map(|parameter| {
            let name = format!("d({})/d({})", channel.name, parameter.name);
            let meaning = format!("derivative of {} by {}", channel.name, parameter.name);
            column(name, ascii(&per(&unit, &parameter.unit)), meaning)
        }));
    }
    let events = analysis.trajectory.events.len();
    let mut notes: Vec<String> = analysis.built.iter().flat_map(|b| b.notes.clone()).collect();
    notes.push(format!("derivatives at fixed times, in SI units; {events} times at which they are not smooth"));
    About {
        program: program(),
        title: model.setup().title.clone(),
        source: source.to_owned(),
        source_sha256: sha256.to_owned(),
        complete: true,
        units: UnitChoice::Si.name(),
        filter: "none".to_owned(),
        filter_coefficients: None,
        notes,
        columns,
        figures: Vec::new(),
    }
}
