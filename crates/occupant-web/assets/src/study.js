// A small study: some sliders varied together, one figure of each run against each of them.

import { element, figures } from "../../../occupant-jobs/assets/viewer/src/dom.js";
import { Engine, Refused } from "./engine.js";

/** Figures that one is likely to look for, the first that is there is shown first. */
const LIKELY = ["hic15", "chest.three_ms_cumulative", "chest_deflection", "head_excursion.forward"];
const WIDTH = 340;
const HEIGHT = 240;
const EDGE = { left: 52, right: 10, top: 8, bottom: 36 };

export class StudyTab {
  /** `page` gives the case, the simulator and a place for words. */
  constructor(page) {
    this.page = page;
    this.choices = element("div", { class: "varied" });
    this.count = element("input", {
      type: "number",
      min: 4,
      max: 500,
      value: 24,
      id: "study-runs",
    });
    this.beginButton = element("button", { type: "button" }, "Run the study");
    this.beginButton.addEventListener("click", () => this.toggle());
    this.bar = element("progress", { max: 1, value: 0, hidden: true, "aria-label": "Study" });
    this.figure = element("select", { id: "study-figure" });
    this.figure.addEventListener("change", () => this.draw());
    this.figureLabel = element("label", { hidden: true }, "Figure ", this.figure);
    this.plots = element("div", { class: "scatters" });
    this.words = element("p", { class: "status", role: "status" });
    this.csv = element("button", { type: "button", hidden: true }, "Save as CSV");
    this.csv.addEventListener("click", () => this.save());
    this.root = element(
      "div",
      { class: "study-tab" },
      element(
        "p",
        {},
        "Choose values to vary together, evenly spread between two bounds (a Latin hypercube).",
      ),
      this.choices,
      element(
        "p",
        { class: "row" },
        element("label", { for: "study-runs" }, "Runs"),
        this.count,
        this.beginButton,
      ),
      this.bar,
      this.words,
      this.figureLabel,
      this.plots,
      this.csv,
    );
    this.rows = new Map();
  }

  /** The values that can be varied. */
  show(knobs) {
    const numbers = knobs.filter((knob) => knob.kind === "number");
    const shape = JSON.stringify(numbers.map((knob) => knob.path));
    if (shape === this.shape) return;
    this.shape = shape;
    this.rows = new Map(numbers.map((knob) => [knob.path, row(knob)]));
    this.choices.replaceChildren(...[...this.rows.values()].map(({ root }) => root));
    const first = this.rows.get("path.delta_v") ?? this.rows.values().next().value;
    if (first) first.box.checked = true;
  }

  /** The study as TOML. */
  text() {
    const varied = [...this.rows].filter(([, { box }]) => box.checked);
    const parameters = varied.map(([path, { knob, from, to }]) => {
      const isSpeed = this.page.isStop && ["path.speed", "path.delta_v"].includes(path);
      const paths = JSON.stringify(isSpeed ? ["path.speed", "path.delta_v"] : [path]);
      const value = (field) =>
        knob.unit ? JSON.stringify(`${Number(field.value)} ${knob.unit}`) : Number(field.value);
      return `[[parameters]]\nname = ${JSON.stringify(knob.label)}\npaths = ${paths}\nrange = { from = ${value(from)}, to = ${value(to)} }\n`;
    });
    const head = `title = "Study in a page"\nbase = "case.toml"\nseed = 1\n\n[design]\nkind = "latin_hypercube"\nsamples = ${Math.round(Number(this.count.value))}\n`;
    return { varied: varied.map(([, { knob }]) => knob), text: [head, ...parameters].join("\n") };
  }

  async toggle() {
    if (this.running) {
      this.running = false;
      return;
    }
    const { varied, text } = this.text();
    if (varied.length === 0) {
      this.words.textContent = "Choose at least one value to vary.";
      return;
    }
    this.running = true;
    this.beginButton.textContent = "Stop";
    this.bar.hidden = false;
    try {
      await this.runAll(varied, text);
    } catch (error) {
      const first = error instanceof Refused && error.problems.find((problem) => problem.is_error);
      this.words.textContent = first ? `${first.found}; expected ${first.expected}` : error.message;
    }
    this.running = false;
    this.bar.hidden = true;
    this.beginButton.textContent = "Run the study";
  }

  async runAll(varied, text) {
    const base = this.page.case();
    const { answer } = await this.page.checker.ask({ do: "study", case: base, study: text });
    this.study = { varied, parameters: answer.parameters, rows: [] };
    const engines = this.engines();
    let next = 0;
    const take = async (engine) => {
      while (this.running && next < answer.samples.length) {
        const number = next++;
        await this.runOne(engine, number, base, answer.samples[number]);
        const done = this.study.rows.length;
        this.bar.value = done / answer.samples.length;
        this.words.textContent = `${done} of ${answer.samples.length} runs`;
      }
    };
    await Promise.all(engines.map(take));
    engines.slice(1).forEach((engine) => engine.end());
    this.study.rows.sort((a, b) => a.number - b.number);
    const failed = this.study.rows.filter((row) => row.failed).length;
    const done = this.study.rows.length - failed;
    this.words.textContent = `${done} runs${failed > 0 ? `, ${failed} failed` : ""}.`;
    this.csv.hidden = false;
  }

  /** Workers for a study: one core is left for the page. */
  engines() {
    const most = Math.max(1, Math.min(8, (navigator.hardwareConcurrency ?? 2) - 1));
    const more = Array.from({ length: most - 1 }, () => new Engine(this.page.module));
    return [this.page.checker, ...more];
  }

  async runOne(engine, number, base, sample) {
    const request = { do: "measure", case: { ...base, set: [...base.set, ...sample.set] } };
    const row = { number, values: sample.values, figures: [] };
    try {
      row.figures = (await engine.ask(request)).answer.figures;
    } catch (error) {
      row.failed = error.message;
    }
    this.study.rows.push(row);
    if (row.failed) return;
    if (this.study.rows.filter((one) => !one.failed).length === 1) this.offer(row.figures);
    this.draw();
  }

  offer(all) {
    const names = all.filter(
      (figure) => figure.value !== null && !/^(solver|run)\./.test(figure.name),
    );
    const before = this.figure.value;
    this.figure.replaceChildren(
      ...names.map(({ name, unit }) =>
        element("option", { value: name }, unit === "1" ? name : `${name}, ${unit}`),
      ),
    );
    const likely = [before, ...LIKELY].find((name) => names.some((figure) => figure.name === name));
    if (likely) this.figure.value = likely;
    this.figureLabel.hidden = false;
  }

  draw() {
    const { varied, parameters, rows } = this.study;
    const points = rows.flatMap(({ values, figures: own }) => {
      const figure = own.find(({ name }) => name === this.figure.value);
      return figure && figure.value !== null
        ? [{ values, y: figure.value, isSpoilt: figure.is_spoilt }]
        : [];
    });
    const label = this.figure.selectedOptions[0]?.textContent ?? "";
    const plots = parameters.map((parameter, i) => {
      const knob = varied[i];
      const per = perOf(knob, parameter.unit);
      const own = points.map(({ values, y, isSpoilt }) => ({ x: values[i] / per, y, isSpoilt }));
      return scatter(own, `${knob.label}${knob.unit ? `, ${knob.unit}` : ""}`, label);
    });
    const spoilt = points.some((point) => point.isSpoilt);
    const note = spoilt
      ? element("p", { class: "hint" }, "Hollow points: a caveat applies, not to be quoted.")
      : null;
    this.plots.replaceChildren(...plots, ...(note ? [note] : []));
  }

  save() {
    const { parameters, rows } = this.study;
    const names = rows.find((row) => row.figures.length > 0)?.figures ?? [];
    const head = [
      ...parameters.map(({ name, unit }) => `${name} [${unit || 1}]`),
      ...names.map(({ name, unit }) => `${name} [${unit}]`),
    ];
    const quoted = (text) => `"${text.replace(/"/g, '""')}"`;
    const lines = rows.map(({ values, figures: own }) =>
      [...values, ...names.map((_, i) => own[i]?.value ?? "")].join(","),
    );
    this.page.saveFile("study.csv", [head.map(quoted).join(","), ...lines].join("\n") + "\n");
  }
}

/** SI value of a knob's unit. */
function perOf(knob, si) {
  const sizes = {
    "km/h": 1 / 3.6,
    ms: 1e-3,
    cm: 1e-2,
    mm: 1e-3,
    kN: 1e3,
    kg: 1,
    deg: Math.PI / 180,
  };
  return si === "" ? 1 : (sizes[knob.unit] ?? 1);
}

function row(knob) {
  const id = `vary-${knob.path.replace(/[^a-z0-9]+/gi, "-")}`;
  const box = element("input", { type: "checkbox", id });
  const now = knob.now ?? (knob.from + knob.to) / 2;
  const rounded = (value) => Number((Math.round(value / knob.step) * knob.step).toPrecision(6));
  const field = (value, word) =>
    element("input", {
      type: "number",
      step: "any",
      value,
      "aria-label": `${knob.label}, ${word}, ${knob.unit}`,
    });
  const from = field(rounded(Math.max(knob.from, now - 0.2 * (knob.to - knob.from))), "from");
  const to = field(rounded(Math.min(knob.to, now + 0.2 * (knob.to - knob.from))), "to");
  const root = element(
    "div",
    { class: "vary" },
    box,
    element("label", { for: id }, knob.label),
    from,
    "–",
    to,
    element("span", { class: "unit" }, knob.unit),
  );
  return { root, knob, box, from, to };
}

/** A scatter plot as SVG, with its numbers in words for those who do not see it. */
function scatter(points, xLabel, yLabel) {
  const svg = (name, attributes, ...children) => {
    const node = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    node.append(...children);
    return node;
  };
  const [xs, ys] = ["x", "y"].map((axis) => scale(points.map((point) => point[axis])));
  const x = (value) =>
    EDGE.left + ((value - xs.from) / (xs.to - xs.from)) * (WIDTH - EDGE.left - EDGE.right);
  const y = (value) =>
    HEIGHT -
    EDGE.bottom -
    ((value - ys.from) / (ys.to - ys.from)) * (HEIGHT - EDGE.top - EDGE.bottom);
  const words =
    points.length > 0
      ? `${points.length} runs; ${yLabel} from ${figures(Math.min(...points.map((p) => p.y)))} to ${figures(Math.max(...points.map((p) => p.y)))}`
      : "no runs";
  const root = svg("svg", {
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
    role: "img",
    class: "scatter",
    "aria-label": `${yLabel} against ${xLabel}: ${words}`,
  });
  for (const tick of ys.ticks) {
    root.append(
      svg("line", {
        x1: EDGE.left,
        x2: WIDTH - EDGE.right,
        y1: y(tick),
        y2: y(tick),
        class: "grid",
      }),
    );
    root.append(
      svg("text", { x: EDGE.left - 5, y: y(tick) + 4, "text-anchor": "end" }, figures(tick, 3)),
    );
  }
  for (const tick of xs.ticks) {
    root.append(
      svg("line", {
        x1: x(tick),
        x2: x(tick),
        y1: EDGE.top,
        y2: HEIGHT - EDGE.bottom,
        class: "grid",
      }),
    );
    root.append(
      svg(
        "text",
        { x: x(tick), y: HEIGHT - EDGE.bottom + 14, "text-anchor": "middle" },
        figures(tick, 3),
      ),
    );
  }
  for (const point of points) {
    root.append(
      svg("circle", {
        cx: x(point.x),
        cy: y(point.y),
        r: 3.5,
        class: point.isSpoilt ? "spoilt" : "good",
      }),
    );
  }
  root.append(
    svg("text", { x: (WIDTH + EDGE.left) / 2, y: HEIGHT - 4, "text-anchor": "middle" }, xLabel),
  );
  return element("figure", { class: "scatter-box" }, element("figcaption", {}, yLabel), root);
}

/** Bounds of an axis, and about five round ticks. */
function scale(values) {
  let [low, high] = values.length > 0 ? [Math.min(...values), Math.max(...values)] : [0, 1];
  if (!(high > low))
    [low, high] = [low - 0.5 * (Math.abs(low) || 1), high + 0.5 * (Math.abs(high) || 1)];
  const rough = (high - low) / 4;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough);
  const [from, to] = [Math.floor(low / step) * step, Math.ceil(high / step) * step];
  const ticks = Array.from(
    { length: Math.round((to - from) / step) + 1 },
    (_, i) => from + i * step,
  );
  return { from, to, ticks };
}
