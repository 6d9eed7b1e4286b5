//! All candidates of a search in the order of the search, as a table: history.parquet and history.csv.

use std::path::PathBuf;

use super::progress::words_of;
use super::{Objective, Record};
use crate::base::{Existing, Failure};
use crate::files::study_folder::{Column, Folder, Manifest, Role, Row, Status, StudyTable};
use occupant_files::table::{Cell, Form};
use occupant_study::search::Stage;

/// Writes both tables; their names.
///
/// # Errors
/// An error of the operating system.
pub fn write<O: Objective>(folder: &Folder, objective: &O, records: &[Record]) -> Result<Vec<PathBuf>, Failure> {
    let files = [("history.parquet", Form::Parquet), ("history.csv", Form::Csv)];
    let files = files.map(|(name, form)| (folder.path.join(name), form));
    let mut table = StudyTable::create(files, Existing::Replace, &manifest(objective))?;
    rows(objective, records).iter().try_for_each(|row| table.row(row))?;
    table.publish()
}

fn manifest<O: Objective>(objective: &O) -> Manifest {
    let column = |name: String, unit: &str, role| Column { name, unit: unit.to_owned(), role };
    let one_if_empty = |unit: &'static str| if unit.is_empty() { "1" } else { unit };
    let mut manifest = objective.manifest().clone();
    manifest.columns = vec![
        column("stage".to_owned(), "", Role::InputText),
        column("descent".to_owned(), "1", Role::Input),
        column("generation".to_owned(), "1", Role::Input),
    ];
    let parameters = objective.parameters().iter();
    manifest.columns.extend(parameters.map(|p| column(format!("input.{}", p.name), one_if_empty(p.unit), Role::Input)));
    for name in ["score", "best"] {
        manifest.columns.push(column(name.to_owned(), "1", Role::Figure));
    }
    manifest.columns.extend(objective.columns());
    manifest
}

fn rows<O: Objective>(objective: &O, records: &[Record]) -> Vec<Row> {
    let mut best = f64::INFINITY;
    let row = |(index, record): (usize, &Record)| {
        let (stage, _) = words_of(record.stage);
        let counted = match record.stage {
            Some(Stage::Descent { number, generation }) => [number, generation].map(|n| n as f64),
            Some(Stage::Model { region, round }) => [region, round].map(|n| n as f64),
            _ => [f64::NAN; 2],
        };
        let number = |x: f64| if x.is_nan() { Cell::Absent } else { Cell::Number(x) };
        let mut cells = vec![Cell::Text(stage.into())];
        cells.extend(counted.map(number));
        match &record.at {
            Some(at) => cells.extend(objective.values(at).into_iter().map(Cell::Number)),
            None => cells.extend(vec![Cell::Absent; objective.bounds().len()]),
        }
        best = if record.at.is_some() { record.score.min(best) } else { best };
        cells.extend([record.score, best].map(Cell::finite));
        cells.extend(objective.row(&record.parts).into_iter().map(number));
        Row {
            index: index as u64,
            status: match record.reason {
                None => Status::Completed,
                Some(_) => Status::Failed,
            },
            reason: record.reason.clone().unwrap_or_default(),
            caveats: record.caveats.clone(),
            cells,
            wall_time_s: record.wall_time_s,
            kernel: record.kernel.clone(),
        }
    };
    records.iter().enumerate().map(row).collect()
}
