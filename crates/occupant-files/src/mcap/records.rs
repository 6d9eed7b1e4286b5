//! The records of an MCAP file, each within its bounds. No length is believed before it was compared with the bytes that
//! are there, so no file makes a reader panic, or take memory out of proportion to its size.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::Read;

use mcap::records::op;

/// Largest unpacked chunk, bytes. Ours have less than one million.
const LARGEST_CHUNK: u64 = 256 << 20;
/// Largest expansion ratio of LZ4.
const LARGEST_RATIO: u64 = 255;

/// A record used by readers of runs.
pub enum Record<'a> {
    /// A channel.
    Channel {
        /// Its number.
        id: u16,
        /// Its topic.
        topic: String,
    },
    /// A message.
    Message {
        /// Number of its channel.
        channel: u16,
        /// Its bytes.
        data: &'a [u8],
    },
    /// A metadata record.
    Metadata {
        /// Its name.
        name: String,
        /// Its entries.
        entries: BTreeMap<String, String>,
    },
    /// An attachment.
    Attachment {
        /// Its name.
        name: String,
        /// Its bytes.
        data: &'a [u8],
    },
    /// Records, unpacked.
    Chunk(Cow<'a, [u8]>),
    /// Any other.
    Other,
}

/// Opcode and position of a record, and the start of the next one.
#[derive(Clone, Copy)]
pub struct Frame<'a> {
    /// Opcode.
    pub opcode: u8,
    body: &'a [u8],
    /// Start of the next record.
    pub next: usize,
}

impl<'a> Frame<'a> {
    /// The record at a position; none if it is incomplete or invalid.
    pub fn at(bytes: &'a [u8], at: usize) -> Option<Self> {
        let mut fields = Fields(bytes.get(at..)?);
        let [opcode] = fields.array()?;
        let length = fields.number()?;
        let body = fields.bytes(length)?;
        (opcode != 0).then_some(Frame { opcode, body, next: bytes.len() - fields.0.len() })
    }

    /// Parses the record; `room` is the number of bytes that compressed chunks may still expand to.
    ///
    /// # Errors
    /// Problems of it.
    pub fn record(self, room: &mut u64) -> Result<Record<'a>, &'static str> {
        let fields = Fields(self.body);
        match self.opcode {
            op::CHANNEL => fields.channel().ok_or("a channel with inconsistent lengths"),
            op::MESSAGE => fields.message().ok_or("a message that is too short"),
            op::METADATA => fields.metadata().ok_or("a metadata record with inconsistent lengths"),
            op::ATTACHMENT => fields.attachment(self.body),
            op::CHUNK => fields.chunk(room),
            _ => Ok(Record::Other),
        }
    }

    /// Checksum of all records before the end of the data; 0 for none.
    pub fn checksum(self) -> u32 {
        Fields(self.body).array().map_or(0, u32::from_le_bytes)
    }
}

/// The index at the end of a file.
#[derive(Default)]
pub struct Index {
    /// Positions where records begin, in order.
    landmarks: Vec<usize>,
    /// Channels: number and topic.
    pub channels: Vec<(u16, String)>,
}

/// Length of the last record and the final magic, bytes.
const FOOTER: usize = 9 + 20 + mcap::MAGIC.len();

impl Index {
    /// The index; empty for a file without its end.
    pub fn of(bytes: &[u8]) -> Self {
        let mut index = Index::default();
        let footer = bytes.len().checked_sub(FOOTER).filter(|_| bytes.ends_with(mcap::MAGIC));
        let footer = footer.and_then(|at| Frame::at(bytes, at)).filter(|frame| frame.opcode == op::FOOTER);
        let start = footer.and_then(|frame| Fields(frame.body).number()).and_then(|at| usize::try_from(at).ok());
        let Some(mut at) = start else { return index };
        // the end of the data stands before
        index.landmarks.extend(at.checked_sub(9 + 4));
        while let Some(frame) = Frame::at(bytes, at) {
            let mut fields = Fields(frame.body);
            let place = match frame.opcode {
                op::CHUNK_INDEX => fields.bytes(16).and_then(|_times| fields.number()),
                op::ATTACHMENT_INDEX | op::METADATA_INDEX => fields.number(),
                _ => None,
            };
            index.landmarks.extend(place.and_then(|at| usize::try_from(at).ok()));
            if let (op::CHANNEL, Ok(Record::Channel { id, topic })) = (frame.opcode, frame.record(&mut 0)) {
                index.channels.push((id, topic));
            }
            at = frame.next;
        }
        index.landmarks.sort_unstable();
        index
    }

    /// The next position after this one where a record begins.
    pub fn after(&self, at: usize) -> Option<usize> {
        self.landmarks.get(self.landmarks.partition_point(|landmark| *landmark <= at)).copied()
    }
}

/// The unread rest of a record.
struct Fields<'a>(&'a [u8]);

impl<'a> Fields<'a> {
    fn bytes(&mut self, length: u64) -> Option<&'a [u8]> {
        self.0.split_off(..usize::try_from(length).ok()?)
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.bytes(N as u64)?.first_chunk().copied()
    }

    fn number(&mut self) -> Option<u64> {
        self.array().map(u64::from_le_bytes)
    }

    /// A block preceded by its length of four bytes.
    fn block(&mut self) -> Option<&'a [u8]> {
        let length = self.array().map(u32::from_le_bytes)?;
        self.bytes(length.into())
    }

    fn text(&mut self) -> Option<String> {
        String::from_utf8(self.block()?.to_vec()).ok()
    }

    fn channel(mut self) -> Option<Record<'a>> {
        let id = self.array().map(u16::from_le_bytes)?;
        let _schema: [u8; 2] = self.array()?;
        Some(Record::Channel { id, topic: self.text()? })
    }

    fn message(mut self) -> Option<Record<'a>> {
        let channel = self.array().map(u16::from_le_bytes)?;
        let _sequence_and_times: [u8; 20] = self.array()?;
        Some(Record::Message { channel, data: self.0 })
    }

    fn metadata(mut self) -> Option<Record<'a>> {
        let name = self.text()?;
        let mut rest = Fields(self.block()?);
        let mut entries = BTreeMap::new();
        while !rest.0.is_empty() {
            entries.insert(rest.text()?, rest.text()?);
        }
        Some(Record::Metadata { name, entries })
    }

    fn attachment(mut self, body: &[u8]) -> Result<Record<'a>, &'static str> {
        let mut lengths = || {
            let _times: [u8; 16] = self.array()?;
            let (name, _media_type) = (self.text()?, self.block()?);
            let length = self.number()?;
            Some((name, self.bytes(length)?, self.array().map(u32::from_le_bytes)?))
        };
        let (name, data, checksum) = lengths().ok_or("an attachment with inconsistent lengths")?;
        if checksum != 0 && body.len().checked_sub(4).map(|end| crc32fast::hash(&body[..end])) != Some(checksum) {
            return Err("an attachment whose checksum does not match");
        }
        Ok(Record::Attachment { name, data })
    }

    fn chunk(mut self, room: &mut u64) -> Result<Record<'a>, &'static str> {
        let mut lengths = || {
            let _times: [u8; 16] = self.array()?;
            let (size, checksum) = (self.number()?, self.array().map(u32::from_le_bytes)?);
            let compression = self.block()?;
            let packed = self.number()?;
            Some((size, checksum, compression, self.bytes(packed)?))
        };
        let (size, checksum, compression, packed) = lengths().ok_or("a chunk with inconsistent lengths")?;
        let content = match compression {
            b"" => Cow::Borrowed(packed),
            b"lz4" => Cow::Owned(unpacked(packed, size, room)?),
            _ => return Err("a chunk with an unsupported compression"),
        };
        if content.len() as u64 != size {
            return Err("a chunk whose size differs from the announced one");
        }
        if checksum != 0 && crc32fast::hash(&content) != checksum {
            return Err("a chunk whose checksum does not match");
        }
        Ok(Record::Chunk(content))
    }
}

fn unpacked(packed: &[u8], size: u64, room: &mut u64) -> Result<Vec<u8>, &'static str> {
    if size > LARGEST_CHUNK {
        return Err("a chunk of more than 256 MiB");
    }
    if size > LARGEST_RATIO.saturating_mul(packed.len() as u64) {
        return Err("a chunk that announces more bytes than it can contain");
    }
    *room = room.checked_sub(size).ok_or("a chunk that unpacks to more bytes than possible")?;
    let mut content = Vec::with_capacity(size as usize);
    let read = unpacking(packed).and_then(|decoder| decoder.take(size + 1).read_to_end(&mut content));
    read.map(|_| content).map_err(|_| "a chunk that cannot be unpacked")
}

#[cfg(not(target_family = "wasm"))]
fn unpacking(packed: &[u8]) -> std::io::Result<impl Read> {
    lz4::Decoder::new(packed)
}

#[cfg(target_family = "wasm")]
fn unpacking(packed: &[u8]) -> std::io::Result<impl Read> {
    Ok(lz4_flex::frame::FrameDecoder::new(packed))
}
