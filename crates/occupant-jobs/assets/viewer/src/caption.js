// Words over a picture that is saved: title, clock, how it is shown, where it comes from, and what spoils it.

import { milliseconds } from "./dom.js";
import { CAMERAS } from "./cameras.js";

/** Height of pictures for which the sizes of letters are made, of the words above, and of a line below. */
const HEIGHT = 720;
const HEAD = 62;
const LINE = 17;
/** Share of the height that the words below may take. */
const MOST = 0.24;
/** Letters of labels on the page, and how much larger they are on the picture. */
const LABEL_PX = 11;
const LABEL_SCALE = 1.25;
const FONT = 'system-ui, "Segoe UI", "DejaVu Sans", sans-serif';

/** The words of a stage. The scene stands between those above and those below, which hide nothing of it. */
export class Caption {
  constructor(canvas, stage) {
    this.stage = stage;
    this.context = canvas.getContext("2d");
    this.scale = canvas.height / HEIGHT;
    this.pen = new Pen(this.context, canvas.width / this.scale);
    this.lines = below(this.pen, stage.runs);
    this.top = Math.round(HEAD * this.scale);
    const foot = Math.round((LINE * this.lines.length + 14) * this.scale);
    /** Size of the scene, and of the labels' page. */
    this.scene = [canvas.width, canvas.height - this.top - foot];
    this.room = this.scene.map((side) => side / this.scale / LABEL_SCALE);
  }

  /** Draws the scene at a time, with its words. */
  draw(time, pace) {
    const { context, pen, stage, scale } = this;
    context.fillStyle = pen.colours.ground;
    context.fillRect(0, 0, context.canvas.width, context.canvas.height);
    context.drawImage(stage.canvas, 0, this.top, ...this.scene);
    context.save();
    context.scale(scale, scale);
    head(pen, stage, time, pace);
    foot(pen, this.lines, stage.runs);
    context.restore();
    context.save();
    context.translate(0, this.top);
    context.scale(scale * LABEL_SCALE, scale * LABEL_SCALE);
    labels(pen, stage.labels);
    context.restore();
  }
}

class Pen {
  constructor(context, width) {
    this.context = context;
    this.width = width;
    const style = getComputedStyle(document.documentElement);
    const colour = (name) => style.getPropertyValue(name).trim();
    this.colours = { text: colour("--text"), ground: colour("--ground") };
    this.runs = [0, 1, 2, 3].map((run) => colour(`--run-${run}`));
    context.textBaseline = "alphabetic";
  }

  panel(x, y, width, height) {
    this.context.globalAlpha = 0.78;
    this.context.fillStyle = this.colours.ground;
    this.context.fillRect(x, y, width, height);
    this.context.globalAlpha = 1;
  }

  /** Sets the letters and gives the width of a text. */
  measure(text, size, weight = "normal") {
    this.context.font = `${weight} ${size}px ${FONT}`;
    return this.context.measureText(text).width;
  }

  text(text, x, y) {
    this.context.fillStyle = this.colours.text;
    this.context.fillText(text, x, y);
  }

  /** A text cut to a width. */
  cut(text, room, size, weight) {
    if (this.measure(text, size, weight) <= room) return text;
    let kept = text;
    while (kept && this.measure(`${kept}…`, size, weight) > room) kept = kept.slice(0, -1);
    return `${kept}…`;
  }

  /** Lines no wider than the room. */
  wrapped(text, room, size) {
    const lines = [""];
    for (const word of text.split(/\s+/)) {
      const longer = `${lines[lines.length - 1]} ${word}`.trim();
      if (this.measure(longer, size) <= room || !lines[lines.length - 1])
        lines[lines.length - 1] = longer;
      else lines.push(word);
    }
    return lines;
  }
}

/** What the camera does. */
function cameraWords(eye) {
  const words =
    CAMERAS[eye.preset]?.[1] ??
    `seen from ${eye.preset === "oblique" ? "an angle" : `the ${eye.preset}`}`;
  return eye.isMoved ? `${words}, moved by hand` : words;
}

function head(pen, stage, time, pace) {
  const clock = milliseconds(time);
  const room = pen.width - pen.measure(clock, 28, "bold") - 52;
  const [first] = stage.runs;
  const title = pen.cut(first.title || first.label, room, 20, "bold");
  pen.text(title, 16, 28);
  pen.text(
    pen.cut([cameraWords(stage.eye), pace].filter((part) => part).join(" · "), room, 14),
    16,
    51,
  );
  pen.measure(clock, 28, "bold");
  pen.context.textAlign = "right";
  pen.text(clock, pen.width - 16, 38);
  pen.context.textAlign = "left";
}

/** Where a run comes from: file, its hash, program. */
function origin(run) {
  const known = new Map(run.provenance);
  const hash = known.get("results, SHA-256");
  const status = known.get("status") ?? "";
  const state = status === "completed" ? "" : `, ${status}`;
  return `${run.label}${hash ? ` (SHA-256 ${hash.slice(0, 12)}…)` : ""}, run by ${known.get("program") ?? "–"}${state}`;
}

/** Lines below: the origin of each run, then caveats and notes. */
function below(pen, runs) {
  const several = runs.length > 1;
  const room = pen.width - 32;
  const own = runs.map((run) => pen.cut(several ? `■ ${origin(run)}` : origin(run), room, 13));
  const whose = (run, text) => (several ? `${run.label}: ${text}` : text);
  const said = runs.flatMap((run) => [
    ...run.caveats.map((text) => whose(run, `Caveat: ${text}`)),
    ...run.notes.map((text) => whose(run, text)),
  ]);
  return [...own, ...within(pen, said, room, Math.floor((MOST * HEIGHT) / LINE) - own.length)];
}

function foot(pen, lines, runs) {
  lines.forEach((line, i) => {
    const y = HEIGHT - LINE * (lines.length - i) + 6;
    pen.measure(line, 13);
    pen.text(line, 16, y);
    if (runs.length < 2 || i >= runs.length) return;
    pen.context.fillStyle = pen.runs[i];
    pen.context.fillText("■", 16, y);
  });
}

/** As many texts as fit in some lines, and how many there are besides. */
function within(pen, texts, room, most) {
  const lines = [];
  for (const [i, text] of texts.entries()) {
    const own = pen.wrapped(text, room, 13);
    const isLast = i === texts.length - 1;
    if (lines.length + own.length + (isLast ? 0 : 1) > most)
      return [...lines, `… and ${texts.length - i} more, in the report`];
    lines.push(...own.map((line) => pen.cut(line, room, 13)));
  }
  return lines;
}

function labels(pen, shown) {
  for (const { text, at } of shown.seen()) {
    pen.panel(at[0], at[1], pen.measure(text, LABEL_PX) + 6, LABEL_PX + 5);
    pen.text(text, at[0] + 3, at[1] + LABEL_PX + 1);
  }
}
