// A film as an MP4 file (ISO/IEC 14496-12): one track of pictures at a constant rate.

/** Ticks of a second, and of a picture. */
const SECOND = 12800;

const bytesOf = (part) =>
  typeof part === "string" ? new TextEncoder().encode(part) : Uint8Array.from(part);
const u16 = (...values) => values.flatMap((value) => [value >> 8, value & 255]);
const u32 = (...values) => values.flatMap((value) => u16(value >>> 16, value & 0xffff));
const zeros = (count) => new Array(count).fill(0);

/** A box: its size, its name of four letters, its parts. */
function box(name, ...parts) {
  const all = parts.map((part) => (part instanceof Uint8Array ? part : bytesOf(part)));
  const size = all.reduce((sum, part) => sum + part.length, 8);
  const made = new Uint8Array(size);
  made.set([...u32(size), ...bytesOf(name)]);
  let at = 8;
  for (const part of all) {
    made.set(part, at);
    at += part.length;
  }
  return made;
}

/** A box with version and flags. */
const full = (name, flags, ...parts) => box(name, u32(flags), ...parts);

const MATRIX = u32(0x10000, 0, 0, 0, 0x10000, 0, 0, 0, 0x40000000);

/**
 * A film, `rate` pictures a second. Samples are what the encoder gave, in its order: bytes, whether a picture stands alone, its
 * place among the pictures shown. `config` is the decoder's, as the encoder told it.
 */
export function mp4(samples, config, [width, height], rate) {
  const head = box("ftyp", "isom", u32(512), "isomiso2mp41");
  const size = movie(samples, config, [width, height], rate, 0).length;
  const moov = movie(samples, config, [width, height], rate, head.length + size + 8);
  const data = samples.reduce((sum, { bytes }) => sum + bytes.length, 8);
  const mdat = new Uint8Array([...u32(data), ...bytesOf("mdat")]);
  return new Blob([head, moov, mdat, ...samples.map(({ bytes }) => bytes)], { type: "video/mp4" });
}

function movie(samples, config, [width, height], rate, offset) {
  const tick = SECOND / rate;
  const duration = samples.length * tick;
  const mvhd = full(
    "mvhd",
    0,
    u32(0, 0, SECOND, duration, 0x10000, 0x1000000, 0, 0),
    MATRIX,
    zeros(24),
    u32(2),
  );
  const tkhd = full(
    "tkhd",
    3,
    u32(0, 0, 1, 0, duration),
    zeros(16),
    MATRIX,
    u32(width * 65536, height * 65536),
  );
  const mdhd = full("mdhd", 0, u32(0, 0, SECOND, duration), u16(0x55c4, 0));
  const hdlr = full("hdlr", 0, zeros(4), "vide", zeros(12), "pictures\0");
  const dinf = box("dinf", full("dref", 0, u32(1), full("url ", 1)));
  const minf = box(
    "minf",
    full("vmhd", 1, zeros(8)),
    dinf,
    table(samples, config, [width, height], tick, offset),
  );
  return box("moov", mvhd, box("trak", tkhd, box("mdia", mdhd, hdlr, minf)));
}

function table(samples, config, [width, height], tick, offset) {
  const count = samples.length;
  const keys = samples.flatMap(({ isKey }, i) => (isKey ? [i + 1] : []));
  const late = samples.map(({ place }, i) => [1, (place - i) * tick]);
  return box(
    "stbl",
    full("stsd", 0, u32(1), entry(config, width, height)),
    full("stts", 0, u32(1, count, tick)),
    // pictures that are decoded in another order than they are shown
    ...(late.some(([, by]) => by !== 0)
      ? [full("ctts", 0x1000000, u32(count, ...late.flat()))]
      : []),
    full("stss", 0, u32(keys.length, ...keys)),
    full("stsc", 0, u32(1, 1, count, 1)),
    full("stsz", 0, u32(0, count, ...samples.map(({ bytes }) => bytes.length))),
    full("stco", 0, u32(1, offset)),
  );
}

/** Numbers of colours (ISO/IEC 23091-2) by the names of WebCodecs. */
const PRIMARIES = { bt709: 1, bt470bg: 5, smpte170m: 6, bt2020: 9, smpte432: 12 };
const TRANSFERS = { bt709: 1, smpte170m: 6, linear: 8, "iec61966-2-1": 13, pq: 16, hlg: 18 };
const MATRICES = { rgb: 0, bt709: 1, bt470bg: 5, smpte170m: 6, "bt2020-ncl": 9 };

/** The sample entry: H.264 with the description of its encoder, or VP9; and the colours. */
function entry({ codec, description, colorSpace }, width, height) {
  const { primaries, transfer, matrix, fullRange } = colorSpace ?? {};
  const colours = [PRIMARIES[primaries] ?? 1, TRANSFERS[transfer] ?? 1, MATRICES[matrix] ?? 1];
  const range = fullRange ? 1 : 0;
  const shape = [...zeros(6), ...u16(1), ...zeros(16), ...u16(width, height)];
  const start = [
    ...shape,
    ...u32(0x480000, 0x480000, 0),
    ...u16(1),
    ...zeros(32),
    ...u16(24, 0xffff),
  ];
  const colr = box("colr", "nclx", u16(...colours), [range << 7]);
  if (codec.startsWith("avc1"))
    return box("avc1", start, box("avcC", new Uint8Array(description)), colr);
  const [, profile, level, depth] = codec.split(".").map(Number);
  const about = [profile, level, (depth << 4) | 2 | range, ...colours];
  return box("vp09", start, full("vpcC", 0x1000000, about, u16(0)), colr);
}
