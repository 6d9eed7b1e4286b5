//! Films: the frames of a drawing that moves, as an animated GIF, or as MP4 by the encoder of the machine.

use std::borrow::Cow;
use std::collections::HashMap;
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;

use color_quant::NeuQuant;
use rayon::prelude::*;
use resvg::tiny_skia::{Pixmap, PremultipliedColorU8};

use super::format::render;
use occupant_files::base::by_ending;

/// Frames per second; those of a GIF last whole hundredths.
pub const FRAMES_A_SECOND: u16 = 25;
/// Pixels per drawing unit.
const PIXELS: f64 = 1.25;
/// Frames rendered before they are encoded.
const AT_ONCE: usize = 32;
/// Colour quantisation, from best (1) to fastest (30): drawings have few colours.
const COLOUR_SPEED: i32 = 10;
/// The encoder of MP4.
const ENCODER: &str = "ffmpeg";

/// Kinds of films.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Film {
    /// A moving GIF.
    Gif,
    /// H.264 in MP4, by an external encoder.
    Mp4,
}

/// A frame.
pub enum Frame {
    /// As SVG.
    Drawing(String),
    /// As pixels.
    Pixels(Pixmap),
}

/// Makes frame n.
pub type Draw<'a> = &'a (dyn Fn(usize) -> Result<Frame, String> + Sync);

impl Frame {
    /// Its bytes as PNG; a drawing has `pixels` pixels per user unit.
    ///
    /// # Errors
    /// A drawing that cannot be rendered.
    pub fn png(self, pixels: f64) -> Result<Vec<u8>, String> {
        let pixmap = self.rendered(pixels)?;
        pixmap.encode_png().map_err(|e| format!("the picture cannot be written as PNG: {e}"))
    }

    pub(crate) fn rendered(self, pixels: f64) -> Result<Pixmap, String> {
        match self {
            Frame::Drawing(svg) => render(&svg, pixels),
            Frame::Pixels(pixmap) => Ok(pixmap),
        }
    }
}

impl Film {
    /// The kind for the file's extension; none for another.
    pub fn of(path: &Path) -> Option<Self> {
        by_ending(path, &[("gif", Film::Gif), ("mp4", Film::Mp4)])
    }

    /// Bytes of a film with this many frames.
    ///
    /// # Errors
    /// A frame that cannot be rendered; an encoder that is not there or fails.
    pub fn encode(self, count: usize, draw: Draw<'_>) -> Result<Vec<u8>, String> {
        match self {
            Film::Gif => gif(count, draw),
            Film::Mp4 => mp4(count, draw),
        }
    }
}

/// Passes the frames on in order, each converted by `make`.
fn each<F: Send>(
    count: usize,
    draw: Draw<'_>,
    make: impl Fn(Pixmap) -> F + Sync,
    mut take: impl FnMut(F) -> Result<(), String>,
) -> Result<(), String> {
    for first in (0..count).step_by(AT_ONCE) {
        let some = first..count.min(first + AT_ONCE);
        let frames: Result<Vec<F>, String> =
            some.into_par_iter().map(|frame| draw(frame)?.rendered(PIXELS).map(&make)).collect();
        frames?.into_iter().try_for_each(&mut take)?;
    }
    Ok(())
}

fn gif(count: usize, draw: Draw<'_>) -> Result<Vec<u8>, String> {
    let failed = |error: gif::EncodingError| format!("the film cannot be written as GIF: {error}");
    let some = [0, count / 2, count.saturating_sub(1)].map(|frame| draw(frame)?.rendered(PIXELS));
    let [first, middle, last] = some;
    let some = [first?, middle?, last?];
    // of sheets that are at most a few thousand pixels wide and high
    let side = |pixels: u32| u16::try_from(pixels).unwrap_or(u16::MAX);
    let [width, height] = [some[0].width(), some[0].height()].map(side);
    let colours = Colours::of(&some);
    let mut encoder = gif::Encoder::new(Vec::new(), width, height, &colours.palette).map_err(failed)?;
    encoder.set_repeat(gif::Repeat::Infinite).map_err(failed)?;
    let mut shown: Vec<u8> = Vec::new();
    each(
        count,
        draw,
        |pixels| colours.indices(&pixels),
        |frame| {
            let changes = changes(&shown, &frame, usize::from(width));
            shown = frame;
            encoder.write_frame(&changes).map_err(failed)
        },
    )?;
    encoder.into_inner().map_err(|error| format!("the film cannot be written as GIF: {error}"))
}

/// Palette index of an unchanged pixel.
const UNCHANGED: u8 = 255;

/// The colours of a film.
struct Colours {
    nearest: NeuQuant,
    palette: Vec<u8>,
}

impl Colours {
    /// Palette of some of its frames.
    fn of(frames: &[Pixmap]) -> Self {
        let pixels: Vec<u8> = frames.iter().flat_map(Pixmap::data).copied().collect();
        let nearest = NeuQuant::new(COLOUR_SPEED, usize::from(UNCHANGED), &pixels);
        let mut palette = nearest.color_map_rgb();
        palette.extend([0; 3]);
        Colours { nearest, palette }
    }

    /// Palette index of each pixel.
    fn indices(&self, pixels: &Pixmap) -> Vec<u8> {
        let mut known = HashMap::new();
        let index = |pixel: &PremultipliedColorU8| {
            let colour = [pixel.red(), pixel.green(), pixel.blue(), pixel.alpha()];
            *known.entry(colour).or_insert_with(|| self.nearest.index_of(&colour) as u8)
        };
        pixels.pixels().iter().map(index).collect()
    }
}

/// Bounding rectangle of the changes from the shown frame.
fn changes(shown: &[u8], frame: &[u8], width: usize) -> gif::Frame<'static> {
    let differs = |at: &usize| shown.get(*at) != Some(&frame[*at]);
    let places = || (0..frame.len()).filter(differs);
    let (top, bottom) = (places().next().unwrap_or(0) / width, places().next_back().unwrap_or(0) / width);
    let left = places().map(|at| at % width).min().unwrap_or(0);
    let right = places().map(|at| at % width).max().unwrap_or(0);
    let pixel = |at: usize| if differs(&at) { frame[at] } else { UNCHANGED };
    let buffer = (top..=bottom).flat_map(|y| (left..=right).map(move |x| y * width + x)).map(pixel).collect();
    gif::Frame {
        delay: 100 / FRAMES_A_SECOND,
        // of a picture whose sides fit
        left: left as u16,
        top: top as u16,
        width: (right + 1 - left) as u16,
        height: (bottom + 1 - top) as u16,
        transparent: Some(UNCHANGED),
        dispose: gif::DisposalMethod::Keep,
        buffer: Cow::Owned(buffer),
        ..gif::Frame::default()
    }
}

fn mp4(count: usize, draw: Draw<'_>) -> Result<Vec<u8>, String> {
    let mut encoder: Option<Encoder> = None;
    each(
        count,
        draw,
        |pixels| pixels,
        |frame| {
            let encoder = match &mut encoder {
                Some(encoder) => encoder,
                None => encoder.insert(Encoder::start([frame.width(), frame.height()])?),
            };
            // one that has ended says why at its end
            let _ = encoder.child.stdin.as_mut().map(|stdin| stdin.write_all(frame.data()));
            Ok(())
        },
    )?;
    encoder.ok_or_else(|| "the film has no frames".to_owned())?.finish()
}

/// The running encoder: pixels in, film out.
struct Encoder {
    child: Child,
    film: thread::JoinHandle<std::io::Result<Vec<u8>>>,
    trouble: thread::JoinHandle<std::io::Result<Vec<u8>>>,
}

impl Encoder {
    fn start([width, height]: [u32; 2]) -> Result<Self, String> {
        let size = format!("{width}x{height}");
        let rate = FRAMES_A_SECOND.to_string();
        // in pieces, as a pipe cannot be gone back in; of even sides, as players want them
        let words = ["-v", "error", "-f", "rawvideo", "-pix_fmt", "rgba", "-s", &size, "-r", &rate, "-i", "-", "-vf"];
        let out = ["pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-movflags", "frag_keyframe+empty_moov"];
        let mut command = Command::new(ENCODER);
        command.args(words).args(out).args(["-f", "mp4", "-"]);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let missing = |error| format!("an MP4 film needs {ENCODER}, which cannot be started here: {error}");
        let mut child = command.spawn().map_err(missing)?;
        let (stdout, stderr) = (child.stdout.take(), child.stderr.take());
        Ok(Encoder { child, film: thread::spawn(|| all_of(stdout)), trouble: thread::spawn(|| all_of(stderr)) })
    }

    fn finish(mut self) -> Result<Vec<u8>, String> {
        drop(self.child.stdin.take());
        let failed = |what: String| format!("{ENCODER} could not make the film: {what}");
        let status = self.child.wait().map_err(|error| failed(error.to_string()))?;
        let read = |thread: thread::JoinHandle<std::io::Result<Vec<u8>>>| match thread.join() {
            Ok(bytes) => bytes.map_err(|error| failed(error.to_string())),
            Err(_) => Err(failed("its output was lost".to_owned())),
        };
        let (film, trouble) = (read(self.film)?, read(self.trouble)?);
        let said = String::from_utf8_lossy(&trouble);
        if status.success() { Ok(film) } else { Err(failed(format!("{status}, {}", said.trim().escape_debug()))) }
    }
}

fn all_of(pipe: Option<impl Read>) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    pipe.map_or(Ok(0), |mut pipe| pipe.read_to_end(&mut bytes))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bar that grows, read back by a decoder.
    #[test]
    fn frames_of_a_gif_come_in_their_order() {
        let bar = |n: usize| {
            Ok(Frame::Drawing(format!(
                r#"<svg xmlns="http://www.w3.org/2000/svg" width="80" height="10"><rect width="{}" height="10"/></svg>"#,
                n as f64 / PIXELS
            )))
        };
        let bytes = Film::Gif.encode(40, &bar).unwrap();
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut film = options.read_info(&bytes[..]).unwrap();
        let (mut widths, mut row) = (Vec::new(), [false; 100]);
        while let Some(frame) = film.read_next_frame().unwrap() {
            assert_eq!(frame.delay, 4);
            for (pixel, dark) in
                frame.buffer.chunks(4).zip(&mut row[usize::from(frame.left)..]).take(frame.width.into())
            {
                if pixel[3] > 0 {
                    *dark = pixel[0] < 128;
                }
            }
            widths.push(row.iter().filter(|dark| **dark).count());
        }
        assert_eq!((film.width(), film.height()), (100, 13));
        assert_eq!(widths, (0..40).collect::<Vec<_>>());
    }
}
