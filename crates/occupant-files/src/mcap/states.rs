//! A result file with the states of a run alone. Every command reads it as the whole file, and computes the rest again; viewers of
//! MCAP find no scene in it.

use std::borrow::Cow;
use std::io::Cursor;

use mcap::records::Metadata;
use mcap::{Attachment, McapResult, WriteOptions};

use super::about::{RESULT, RUN};
use super::channel::Schemas;
use super::checkpoint::{checkpoint, encoded};
use super::clock::nanoseconds;
use super::stored::StoredRun;

/// The file: metadata, documents and checkpoints of a run, in chunks that are not compressed.
///
/// # Errors
/// None for a run that was read.
pub fn states(run: &StoredRun) -> McapResult<Vec<u8>> {
    let program = run.run.get("program").cloned().unwrap_or_default();
    let options = WriteOptions::new().profile("").library(program).compression(None).disable_seeking(true);
    let mut writer = options.create(Cursor::new(Vec::new()))?;
    let metadata = |name: &str, entries| Metadata { name: name.to_owned(), metadata: entries };
    writer.write_metadata(&metadata(RUN, run.run.clone()))?;
    for (name, bytes) in &run.attachments {
        writer.attach(&Attachment {
            log_time: 0,
            create_time: 0,
            name: name.clone(),
            media_type: "application/octet-stream".to_owned(),
            data: Cow::Borrowed(bytes),
        })?;
    }
    let mut channel = Schemas::default().add(&mut writer, &checkpoint())?;
    // times count from the start of the run, which a resumed file does not hold
    let start_s = run.run.get("start_s").and_then(|start| start.parse().ok()).unwrap_or(0.0);
    for output in &run.checkpoints {
        writer.write_to_known_channel(&channel.next(nanoseconds(output.time_s, start_s)), &encoded(output))?;
    }
    if let Some(result) = &run.result {
        writer.write_metadata(&metadata(RESULT, result.clone()))?;
    }
    writer.finish()?;
    Ok(writer.into_inner().into_inner())
}
