//! The recorder that writes a run as an MCAP file.

use std::borrow::Cow;
use std::io::{Seek, Write};
use std::num::NonZeroU32;

use mcap::{Attachment, McapResult, WriteOptions, Writer};
use occupant_core::model::Model;
use occupant_core::results::catalogue::Message;
use occupant_core::results::outcome::Outcome;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;

use super::about::{About, Document};
use super::channel::{Channel, Schemas};
use super::clock::{nanoseconds, stride};
use super::foxglove::{FRAME_TRANSFORMS, LOG, Level, SCENE_UPDATE};
use super::log::Names;
use super::press::Press;
use super::transforms::FrameNames;
use super::wire::Wire;
use super::{COMPRESSION, about, checkpoint, layout, log, messages, scene, topics, transforms};

/// Settings of the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct McapOptions {
    /// Largest rate of transforms and scenes, 1/s; result messages are written at every output.
    pub frames_per_s: NonZeroU32,
    /// Outputs per chunk; a killed run leaves all complete chunks.
    pub outputs_per_chunk: NonZeroU32,
    /// Length of force arrows, m/N.
    pub force_scale_m_per_n: f64,
}

impl Default for McapOptions {
    /// 500 frames a second, 50 outputs a chunk, 0.1 m for 1 kN.
    fn default() -> Self {
        McapOptions {
            frames_per_s: NonZeroU32::new(500).unwrap_or(NonZeroU32::MIN),
            outputs_per_chunk: NonZeroU32::new(50).unwrap_or(NonZeroU32::MIN),
            force_scale_m_per_n: 1e-4,
        }
    }
}

/// Writes every result of a run to `W`. The same scenario gives the same bytes.
///
/// The file is complete when the run has ended and says how in its last metadata record. Dropped before, it is a readable
/// file without that record. Chunks are compressed and written on a thread of their own during the run.
pub struct McapRecorder<W: Write + Seek + Send + 'static> {
    press: Press<W>,
    about: About,
    tables: Vec<Document>,
    options: McapOptions,
    tracks: Option<Tracks>,
    outputs: u64,
}

/// Channels of a run in progress.
struct Tracks {
    start_s: f64,
    /// Outputs per frame of the scene.
    stride: usize,
    frames: FrameNames,
    names: Names,
    messages: Vec<(Message, Channel)>,
    transforms: Channel,
    lines: Channel,
    forces: Channel,
    log: Channel,
}

impl<W: Write + Seek + Send + 'static> McapRecorder<W> {
    /// Begins a file in `target`, which should be buffered.
    ///
    /// # Errors
    /// An error of `target`.
    pub fn new(target: W, about: About, options: McapOptions) -> McapResult<Self> {
        let writer = WriteOptions::new()
            .profile("")
            .library(about.program.clone())
            .compression(COMPRESSION)
            // a chunk goes to the file whole or not at all
            .disable_seeking(true)
            .create(target)?;
        Ok(McapRecorder { press: Press::new(writer), about, tables: Vec::new(), options, tracks: None, outputs: 0 })
    }

    /// Attaches a table referred to by the scenario.
    pub fn with_table(mut self, table: Document) -> Self {
        self.tables.push(table);
        self
    }

    /// The target after the run's end. Before that, the file stays incomplete.
    ///
    /// # Errors
    /// None is left.
    pub fn into_inner(self) -> McapResult<W> {
        self.press.into_inner()
    }

    fn write_documents(&mut self, model: &Model, messages: &[Message]) -> Result<(), RecorderError> {
        let writer = self.press.home()?;
        writer.write_metadata(&about::run(&self.about, &self.tables, model))?;
        let layout = Document {
            name: layout::NAME.to_owned(),
            media_type: "application/json".to_owned(),
            content: serde_json::to_vec_pretty(&layout::layout(messages))?,
        };
        let scenario = [&self.about.scenario].into_iter().chain(&self.tables);
        for document in scenario.chain(&self.about.resolved).chain([&layout]) {
            writer.attach(&Attachment {
                log_time: 0,
                create_time: 0,
                name: document.name.clone(),
                media_type: document.media_type.clone(),
                data: Cow::Borrowed(&document.content),
            })?;
        }
        Ok(())
    }

    /// Writes the constant scenes, on their own topics.
    fn write_still_scenes(&mut self, model: &Model, schemas: &Schemas, frames: &FrameNames) -> McapResult<()> {
        type Draw<'a> = &'a dyn Fn(&mut Wire);
        let body = model.body();
        let scenes: [(&str, Draw<'_>); 4] = [
            (topics::COMPARTMENT_SCENE, &|w| scene::compartment::write(w, model)),
            (topics::BODY_SCENE, &|w| scene::body::write(w, body, frames)),
            (topics::SPHERES_SCENE, &|w| scene::body::write_spheres(w, body, frames)),
            (topics::LABELS_SCENE, &|w| scene::labels::write(w, model)),
        ];
        for (topic, draw) in scenes {
            let mut channel = schemas.add_foxglove(self.press.home()?, topic, SCENE_UPDATE)?;
            self.press.put(&mut channel, 0, draw);
        }
        Ok(())
    }
}

impl Tracks {
    fn new(
        writer: &mut Writer<impl Write + Seek>,
        schemas: &Schemas,
        model: &Model,
        messages: Vec<Message>,
        options: &McapOptions,
    ) -> McapResult<Self> {
        let mut with_channels = Vec::with_capacity(messages.len());
        for message in messages {
            let channel = schemas.add(writer, &message)?;
            with_channels.push((message, channel));
        }
        let mut add = |topic, name| schemas.add_foxglove(writer, topic, name);
        let time = &model.setup().time;
        Ok(Tracks {
            start_s: time.start_s,
            stride: stride(time.output_s, options.frames_per_s.get()),
            frames: FrameNames::new(model.body()),
            names: Names::of(model),
            messages: with_channels,
            transforms: add(topics::TRANSFORMS, FRAME_TRANSFORMS)?,
            lines: add(topics::LINES_SCENE, SCENE_UPDATE)?,
            forces: add(topics::FORCES_SCENE, SCENE_UPDATE)?,
            log: add(topics::LOG, LOG)?,
        })
    }

    fn write_messages(&mut self, press: &mut Press<impl Write + Seek + Send + 'static>, sample: &Sample<'_>) {
        let ns = nanoseconds(sample.time_s, self.start_s);
        for (message, channel) in &mut self.messages {
            press.put(channel, ns, |wire| {
                for field in &message.fields {
                    if let Some(source) = &field.source {
                        wire.value(field.number, &source.value(sample));
                    }
                }
                if message.topic == checkpoint::TOPIC {
                    checkpoint::write(wire, sample);
                }
            });
        }
    }

    fn write_frame(
        &mut self,
        press: &mut Press<impl Write + Seek + Send + 'static>,
        sample: &Sample<'_>,
        m_per_n: f64,
    ) {
        let ns = nanoseconds(sample.time_s, self.start_s);
        press.put(&mut self.transforms, ns, |wire| transforms::write(wire, ns, sample, &self.frames));
        press.put(&mut self.lines, ns, |wire| scene::lines::write(wire, ns, sample));
        press.put(&mut self.forces, ns, |wire| scene::forces::write(wire, ns, sample, m_per_n));
    }

    fn write_log(
        &mut self,
        press: &mut Press<impl Write + Seek + Send + 'static>,
        time_s: f64,
        (level, words): (Level, &str),
    ) {
        let ns = nanoseconds(time_s, self.start_s);
        press.put(&mut self.log, ns, |wire| log::write(wire, ns, level, words));
    }
}

impl<W: Write + Seek + Send + 'static> Recorder for McapRecorder<W> {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        if self.tracks.is_some() {
            return Err("a second run into the same file; expected one recorder per run".into());
        }
        let messages = messages(model);
        self.write_documents(model, &messages)?;
        let schemas = Schemas::default();
        let writer = self.press.home()?;
        let mut tracks = Tracks::new(writer, &schemas, model, messages, &self.options)?;
        self.write_still_scenes(model, &schemas, &tracks.frames)?;
        for problem in model.warnings().iter() {
            tracks.write_log(&mut self.press, tracks.start_s, (Level::Warning, &problem.to_string()));
        }
        self.press.home()?;
        self.tracks = Some(tracks);
        Ok(())
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        let press = &mut self.press;
        let tracks = self.tracks.as_mut().ok_or("an output before the run began")?;
        tracks.write_messages(press, sample);
        let (first, last) = (self.outputs == 0, sample.is_last());
        if first || last || sample.index.is_multiple_of(tracks.stride) {
            tracks.write_frame(press, sample, self.options.force_scale_m_per_n);
        }
        self.outputs += 1;
        if self.outputs.is_multiple_of(self.options.outputs_per_chunk.get().into()) {
            press.end_chunk()?;
        }
        Ok(Flow::Continue)
    }

    fn end(&mut self, outcome: &Outcome) -> Result<(), RecorderError> {
        let press = &mut self.press;
        let tracks = self.tracks.as_mut().ok_or("an end before the run began")?;
        for touch in &outcome.first_touches {
            let words = tracks.names.first_touch(touch);
            tracks.write_log(press, touch.time_s, (Level::Info, &words));
        }
        let (level, words) = log::end(outcome);
        tracks.write_log(press, outcome.time_s, (level, &words));
        let writer = press.home()?;
        writer.write_metadata(&about::result(outcome, self.outputs))?;
        writer.finish()?;
        Ok(())
    }
}
