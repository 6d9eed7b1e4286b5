// Pictures and films of the stage as files, drawn in the page and sent nowhere.
//
// A film is drawn picture by picture, 25 a second at the chosen speed, however long each takes, and coded by WebCodecs:
// the number of pictures and their times depend on the run and the speed alone. Where a browser has no WebCodecs, its
// MediaRecorder gets the same pictures, 1/25 s apart as well as its clock allows.

import { Caption } from "./caption.js";
import { element } from "./dom.js";
import { mp4 } from "./mp4.js";

const RATE = 25;
/** Pixels of films and of single pictures. */
const FILM = [1280, 720];
const PICTURE = [1920, 1080];
/** Longest film, s. */
const MOST_S = 300;
const BITS_S = 6e6;
/** Pictures from one that stands alone to the next. */
const KEYS = 50;
/** Pictures that may wait for the encoder. */
const QUEUE = 4;

/** Players know the first best; some browsers lack its encoder. */
const CODECS = ["avc1.4d001f", "avc1.42001f", "vp09.00.31.08"];
const RECORDED = [
  "video/mp4;codecs=avc1.42001f",
  "video/mp4",
  "video/webm;codecs=vp9",
  "video/webm",
];

const recordedType = () => RECORDED.find((type) => window.MediaRecorder?.isTypeSupported(type));

/** Times of the pictures of a film, the begin and the end among them. */
function filmTimes({ start, end, speed }) {
  const step = speed / RATE;
  const count = Math.ceil((end - start) / step - 1e-6) + 1;
  return Array.from({ length: count }, (_, i) => Math.min(start + i * step, end));
}

/** Why there can be no film; nothing if there can. */
export function noFilm() {
  return window.VideoEncoder || recordedType() ? null : "No film: this browser codes none.";
}

/** A place to draw pictures for files. */
class Sheet {
  constructor(stage, clock, size) {
    Object.assign(this, { stage, clock });
    this.canvas = element("canvas", { width: size[0], height: size[1] });
  }

  /** Draws the clock's time, with its words. */
  draw(pace) {
    const { stage } = this;
    if (stage.renderer.getContext().isContextLost())
      throw new Error("the browser took the 3-D drawing away; load the page again");
    stage.render();
    stage.labels.place();
    this.caption.draw(this.clock.time, pace);
  }

  begin() {
    this.before = this.clock.time;
    this.clock.pause();
    this.caption = new Caption(this.canvas, this.stage);
    this.stage.labels.size = this.caption.room;
    this.stage.save(this.caption.scene);
  }

  end() {
    this.stage.labels.size = null;
    this.stage.restore();
    if (this.stage.clock === this.clock) this.clock.seek(this.before);
  }
}

/** The picture of now as PNG. */
export async function picture(stage, clock) {
  const sheet = new Sheet(stage, clock, PICTURE);
  sheet.begin();
  try {
    sheet.draw("");
    const blob = await new Promise((done) => sheet.canvas.toBlob(done, "image/png"));
    if (!blob) throw new Error("the browser makes no picture of this size");
    return { blob, name: `${nameOf(stage, `-${(clock.time * 1e3).toFixed(1)}-ms`)}.png` };
  } finally {
    sheet.end();
  }
}

/** The film from begin to end; `told(done, count)` hears of progress and ends the film where it is false. */
export async function film(stage, clock, told) {
  const { speed } = clock;
  const times = filmTimes(clock);
  const pace =
    speed === 1 ? "real time" : `${Number((1 / speed).toPrecision(4))} times slower than real time`;
  const sheet = new Sheet(stage, clock, FILM);
  const named = nameOf(stage, "");
  const coder = window.VideoEncoder ? await Coder.of(sheet.canvas) : null;
  const maker = coder ?? new Recording(sheet.canvas);
  sheet.begin();
  try {
    for (const [i, time] of times.entries()) {
      clock.pause();
      clock.seek(time);
      sheet.draw(pace);
      await maker.add(i);
      const goes = told(i + 1, times.length) && stage.clock === clock;
      if (!goes) return null;
    }
    const blob = await maker.end(times.length);
    const ending = blob.type.startsWith("video/mp4") ? "mp4" : "webm";
    return { blob, name: `${named}.${ending}`, seconds: coder && times.length / RATE };
  } finally {
    maker.close();
    sheet.end();
  }
}

/** Why a film would be too long; nothing if it is not. */
export function tooLong(clock) {
  const seconds = Math.round((clock.end - clock.start) / clock.speed);
  if (seconds <= MOST_S) return null;
  return `At ${clock.speed}× the film would last ${seconds} s, and ${MOST_S} s is the limit: choose a higher speed.`;
}

function nameOf(stage, moment) {
  const label = stage.runs[0].label.replace(/\.\w+$/, "").replace(/[\\/:*?"<>|]+/g, "_");
  return `${label}-${stage.eye.preset}${moment}`;
}

/** Lets the page live. Timers of pages that nobody sees are slow. */
const breath = () =>
  new Promise((done) => {
    if (!document.hidden) setTimeout(done);
    else {
      const { port1, port2 } = new MessageChannel();
      port1.onmessage = done;
      port2.postMessage(null);
    }
  });
const wait = (ms) => new Promise((done) => setTimeout(done, ms));

/** WebCodecs. */
class Coder {
  /** One for the pictures of a canvas; none if the browser has no encoder that an MP4 file can hold. */
  static async of(canvas) {
    const { width, height } = canvas;
    for (const codec of CODECS) {
      const own = codec.startsWith("avc1") ? { avc: { format: "avc" } } : {};
      const config = { codec, width, height, bitrate: BITS_S, framerate: RATE, ...own };
      const answer = await VideoEncoder.isConfigSupported(config).catch(() => null);
      if (answer?.supported) return new Coder(canvas, config);
    }
    return null;
  }

  constructor(canvas, config) {
    this.canvas = canvas;
    this.samples = [];
    this.error = null;
    this.encoder = new VideoEncoder({
      output: (chunk, about) => this.put(chunk, about),
      error: (error) => (this.error = error),
    });
    this.encoder.configure(config);
    this.config = { codec: config.codec };
  }

  put(chunk, about) {
    if (about?.decoderConfig) this.config = { ...this.config, ...about.decoderConfig };
    const bytes = new Uint8Array(chunk.byteLength);
    chunk.copyTo(bytes);
    const place = Math.round((chunk.timestamp * RATE) / 1e6);
    this.samples.push({ bytes, isKey: chunk.type === "key", place });
  }

  async add(i) {
    const frame = new VideoFrame(this.canvas, {
      timestamp: (i * 1e6) / RATE,
      duration: 1e6 / RATE,
    });
    this.encoder.encode(frame, { keyFrame: i % KEYS === 0 });
    frame.close();
    do await breath();
    while (!this.error && this.encoder.encodeQueueSize > QUEUE);
    if (this.error) throw this.error;
  }

  async end(count) {
    await this.encoder.flush();
    if (this.samples.length !== count)
      throw new Error(`the browser coded ${this.samples.length} of ${count} pictures`);
    return mp4(this.samples, this.config, FILM, RATE);
  }

  close() {
    if (this.encoder.state !== "closed") this.encoder.close();
  }
}

/** MediaRecorder: its clock runs only while a picture is shown. */
class Recording {
  constructor(canvas) {
    const type = recordedType();
    if (!type || !canvas.captureStream) throw new Error("this browser codes no films");
    this.stream = canvas.captureStream(0);
    [this.track] = this.stream.getVideoTracks();
    this.recorder = new MediaRecorder(this.stream, { mimeType: type, videoBitsPerSecond: BITS_S });
    this.parts = [];
    this.recorder.addEventListener("dataavailable", ({ data }) => this.parts.push(data));
    this.ended = new Promise((done) => this.recorder.addEventListener("stop", done));
    this.recorder.start();
    this.recorder.pause();
    this.shown = 0;
  }

  async add(i) {
    const from = performance.now();
    this.recorder.resume();
    this.track.requestFrame();
    await wait(((i + 1) * 1e3) / RATE - this.shown);
    this.recorder.pause();
    this.shown += performance.now() - from;
  }

  async end() {
    // the last picture's length
    this.recorder.resume();
    this.track.requestFrame();
    this.recorder.stop();
    await this.ended;
    return new Blob(this.parts, { type: this.recorder.mimeType });
  }

  close() {
    if (this.recorder.state !== "inactive") this.recorder.stop();
    this.track.stop();
  }
}
