//! Two pictures side by side, and pictures of a real test with the words of ours.

use resvg::tiny_skia::{FilterQuality, IntSize, Pixmap, PixmapPaint, Transform};

use super::overlay::{self, Drawn, Words, clock};
use super::{MOST_PIXELS, pixmap};
use crate::film::Frame;

/// Ground of a picture that does not fill its place, and of the line between two pictures.
const GROUND: [u8; 3] = [40, 44, 50];
/// Width of the line between two pictures, pixels.
const LINE: usize = 2;
/// Place of width and height in a PNG file, after its signature and the head of its first chunk.
const SIZE_AT: usize = 16;

/// A picture of a real test at a time of a run.
pub struct Photograph<'a> {
    /// The picture, and its time, s, if it has one; none before the first.
    pub png: Option<(&'a [u8], Option<f64>)>,
    /// What it is of.
    pub title: &'a str,
    /// How it was chosen.
    pub about: &'a str,
    /// The time of the run, s.
    pub time_s: f64,
    /// Where it comes from.
    pub caption: &'a str,
}

/// A photograph as a frame, whole, on a dark ground between its words.
///
/// # Errors
/// Bytes that are no PNG; sides with more than [`MOST_PIXELS`].
pub fn photograph(own: &Photograph<'_>, size: [usize; 2]) -> Result<Frame, String> {
    let told = match own.png {
        None => "no picture yet".to_owned(),
        Some((_, None)) => "one picture".to_owned(),
        Some((_, Some(time_s))) => format!("picture at {}", clock(time_s)),
    };
    let Drawn { svg, free } = overlay::draw(&Words {
        size,
        title: own.title,
        about: own.about,
        time_s: own.time_s,
        speeds: &[told],
        names: &[],
        per_m: None,
        caption: &[(None, own.caption.to_owned())],
    });
    let mut picture = pixmap(size, &vec![GROUND; size[0] * size[1]])?;
    if let Some((bytes, _)) = own.png {
        lay(&decoded(bytes)?, &mut picture, free);
    }
    crate::format::overlay(&svg, &mut picture)?;
    Ok(Frame::Pixels(picture))
}

/// Pixels of a PNG whose sides are not too long: they are looked at before anything is unpacked.
fn decoded(bytes: &[u8]) -> Result<Pixmap, String> {
    let side = |at: usize| bytes.get(at..at + 4).map(|own| u32::from_be_bytes([own[0], own[1], own[2], own[3]]));
    if let (true, Some(width), Some(height)) = (bytes.starts_with(b"\x89PNG"), side(SIZE_AT), side(SIZE_AT + 4))
        && [width, height].iter().any(|side| *side as usize > MOST_PIXELS)
    {
        return Err(format!("it has {width} × {height} pixels; each side can have at most {MOST_PIXELS}"));
    }
    Pixmap::decode_png(bytes).map_err(|error| format!("it cannot be read as PNG: {error}"))
}

/// Puts a picture into the free rows of another, as large as it is whole.
fn lay(picture: &Pixmap, onto: &mut Pixmap, [top, bottom]: [f64; 2]) {
    let room = [onto.width() as f32, ((bottom - top) as f32).max(1.0)];
    let own = [picture.width() as f32, picture.height() as f32];
    let scale = (room[0] / own[0]).min(room[1] / own[1]);
    let [left, down] = [0, 1].map(|i| 0.5 * (room[i] - scale * own[i]));
    let place = Transform::from_row(scale, 0.0, 0.0, scale, left, top as f32 + down);
    let paint = PixmapPaint { quality: FilterQuality::Bilinear, ..PixmapPaint::default() };
    onto.draw_pixmap(0, 0, picture.as_ref(), &paint, place, None);
}

/// Two frames side by side, with a line between them.
///
/// # Errors
/// Frames of different heights; a picture that cannot be made.
pub fn abreast(left: Frame, right: Frame) -> Result<Frame, String> {
    let (left, right) = (left.rendered(1.0)?, right.rendered(1.0)?);
    if left.height() != right.height() {
        return Err(format!("pictures of {} and {} rows cannot be side by side", left.height(), right.height()));
    }
    let size = IntSize::from_wh(left.width() + right.width(), left.height());
    let row = |picture: &Pixmap| 4 * picture.width() as usize;
    let mut bytes = Vec::with_capacity(left.data().len() + right.data().len());
    for (own, other) in left.data().chunks(row(&left)).zip(right.data().chunks(row(&right))) {
        bytes.extend(own);
        let first = bytes.len();
        bytes.extend(other);
        bytes[first..].chunks_mut(4).take(LINE).for_each(|pixel| pixel[..3].copy_from_slice(&GROUND));
    }
    let both = size.and_then(|size| Pixmap::from_vec(bytes, size));
    both.map(Frame::Pixels).ok_or_else(|| "two pictures side by side cannot be made".to_owned())
}
