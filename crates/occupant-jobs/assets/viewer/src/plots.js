// Plots with the time cursor. A click moves the time; a drag zooms, a double click shows all again.

import uPlot from "uplot";
import { locate } from "./data.js";
import { element, figures } from "./dom.js";
import { own } from "./tabs.js";

const HEIGHT = 170;
/** Width of a plot on paper, px. */
const PAPER = 330;
/** Colours of curves, legible on light and dark ground. */
const COLORS = [
  "#3b82c4",
  "#d9730d",
  "#2f9e63",
  "#c4456b",
  "#8b6fc9",
  "#a08a1f",
  "#5c8f97",
  "#8c6d5a",
];
/** A pointer that moves farther than this drags, px. */
const STILL_PX = 4;
/** Values in the legends change no more often than this while playing, ms. */
const LEGEND_MS = 100;

export function buildPlots(root, runs, clock) {
  const charts = runs[0].plots.map((plot) => new Chart(root, plot, runs, clock));
  const width = new ResizeObserver(() => charts.forEach((chart) => chart.fit()));
  width.observe(root);
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const redraw = () => charts.forEach((chart) => chart.chart.redraw());
  dark.addEventListener("change", redraw);
  let said = 0;
  clock.listen(() => {
    const now = performance.now();
    const tell = !clock.playing || now - said > LEGEND_MS;
    if (tell) said = now;
    for (const chart of charts) chart.show(clock.time, tell);
  });
  /** Takes the plots away. */
  const release = () => {
    width.disconnect();
    dark.removeEventListener("change", redraw);
    for (const chart of charts) chart.release();
  };
  /** Draws the plots in the colours and the width of now. */
  release.fit = () => charts.forEach((chart) => chart.repaint());
  return release;
}

/** How the lines of the runs are broken, and the classes of their legends. */
const DASHES = [undefined, [5, 3], [2, 2], [9, 3, 2, 3]];
const LINES = ["line", "line dashed", "line dotted", "line double"];

/** Curves of one plot of all runs: those of the others are dashed. */
function curvesOf(title, runs) {
  const names = [];
  const curves = [];
  runs.forEach((run, number) => {
    const plot = run.plots.find((p) => p.title === title);
    for (const curve of plot ? plot.curves : []) {
      if (!names.includes(curve.name)) names.push(curve.name);
      const color = COLORS[names.indexOf(curve.name) % COLORS.length];
      curves.push({ ...curve, color, run: number, times: run.times });
    }
  });
  return curves;
}

class Chart {
  constructor(root, { title, occupant }, runs, clock) {
    this.curves = curvesOf(title, runs);
    const unit = runs[0].plots.find((p) => p.title === title).unit;
    this.values = this.curves.map(() => element("b", {}));
    const legend = this.curves.map((curve, i) => {
      const line = element("i", { class: LINES[curve.run] });
      line.style.borderColor = curve.color;
      const whose = runs.length > 2 ? runs[curve.run].label : "other";
      const name = curve.run > 0 ? `${curve.name} (${whose})` : curve.name;
      return element("span", { title: curve.meaning }, line, `${name} `, this.values[i]);
    });
    this.place = element("div", { class: "canvas" });
    const head = element("h3", {}, `${title} [${unit}]`);
    const legends = element("div", { class: "legend" }, ...legend);
    this.figure = element(
      "figure",
      { class: "plot", "data-title": title, ...own(occupant) },
      head,
      legends,
      this.place,
    );
    root.append(this.figure);
    this.chart = new uPlot(this.options(), this.data(runs), this.place);
    this.cursor = element("div", { class: "time-cursor" });
    this.chart.over.append(this.cursor);
    this.chart.over.setAttribute("aria-label", `${title} over time; a click moves the time`);
    this.listen(clock);
    this.fit();
    this.seen = true;
    this.observer = new IntersectionObserver(([entry]) => {
      this.seen = entry.isIntersecting;
      this.show(clock.time, true);
    });
    this.observer.observe(this.figure);
  }

  release() {
    this.observer.disconnect();
    this.chart.destroy();
    this.figure.remove();
  }

  /** One table of all times, as the plot library wants it. */
  data(runs) {
    const tables = runs.map((run, number) => {
      const own = this.curves.filter((curve) => curve.run === number);
      const times = Array.from(run.times, (t) => t * 1e3);
      return [times, ...own.map((curve) => Array.from(curve.values))];
    });
    return tables.length === 1 ? tables[0] : uPlot.join(tables);
  }

  options() {
    const style = getComputedStyle(document.documentElement);
    const css = (name) => () => style.getPropertyValue(name).trim();
    const axis = {
      stroke: css("--text"),
      grid: { stroke: css("--grid"), width: 1 },
      ticks: { show: false },
    };
    const font = "11px system-ui, sans-serif";
    return {
      width: 400,
      height: HEIGHT,
      legend: { show: false },
      cursor: { drag: { x: true, y: false }, points: { show: false }, y: false },
      scales: { x: { time: false } },
      axes: [
        { ...axis, font, size: 26, label: "t [ms]", labelSize: 16, labelGap: 0, labelFont: font },
        { ...axis, font, size: 52 },
      ],
      series: [
        {},
        ...this.curves.map((curve) => ({
          label: curve.name,
          stroke: curve.color,
          width: 1.5,
          dash: DASHES[curve.run],
          spanGaps: true,
          points: { show: false },
        })),
      ],
      hooks: {
        setScale: [() => this.time !== undefined && this.putCursor()],
        setSize: [() => this.putCursor()],
      },
    };
  }

  listen(clock) {
    let down = null;
    this.chart.over.addEventListener("pointerdown", (event) => (down = event.clientX));
    this.chart.over.addEventListener("pointerup", (event) => {
      if (down === null || Math.abs(event.clientX - down) > STILL_PX) return;
      const left = event.clientX - this.chart.over.getBoundingClientRect().left;
      clock.pause();
      clock.seek(this.chart.posToVal(left, "x") / 1e3);
    });
  }

  /** On paper as wide as a column, else as its place. */
  repaint() {
    const isPaper = document.documentElement.classList.contains("paper");
    const width = isPaper ? PAPER : this.place.clientWidth;
    if (width > 0) this.chart.setSize({ width, height: HEIGHT });
    this.chart.redraw();
  }

  fit() {
    const width = this.place.clientWidth;
    if (width > 0 && width !== this.chart.width) this.chart.setSize({ width, height: HEIGHT });
  }

  show(time, tell) {
    this.time = time;
    if (!this.seen) return;
    this.putCursor();
    if (!tell) return;
    this.curves.forEach((curve, i) => {
      const { index, fraction } = locate(curve.times, time);
      const here = curve.values[index];
      const next = fraction > 0 ? curve.values[index + 1] : here;
      const value = here + fraction * (next - here);
      // what rounds to nothing is nothing
      this.values[i].textContent = figures(Number(value.toFixed(3)), 3);
    });
  }

  putCursor() {
    if (!this.cursor || !this.chart) return;
    const { min, max } = this.chart.scales.x;
    const now = this.time * 1e3;
    this.cursor.hidden = !(now >= min && now <= max);
    this.cursor.style.transform = `translateX(${this.chart.valToPos(now, "x").toFixed(1)}px)`;
  }
}
