// What a run shows: verdicts, scene, plots, tables. Built anew for each run, but the stage, which stays.

import { Clock } from "../../../occupant-jobs/assets/viewer/src/clock.js";
import { buildControls } from "../../../occupant-jobs/assets/viewer/src/controls.js";
import { readReport } from "../../../occupant-jobs/assets/viewer/src/data.js";
import { element } from "../../../occupant-jobs/assets/viewer/src/dom.js";
import { listenToKeys } from "../../../occupant-jobs/assets/viewer/src/keyboard.js";
import { caveats, impacts, notes, swatch } from "../../../occupant-jobs/assets/viewer/src/page.js";
import { buildPlots } from "../../../occupant-jobs/assets/viewer/src/plots.js";
import { Stage } from "../../../occupant-jobs/assets/viewer/src/stage.js";
import { buildTables, buildVerdicts } from "../../../occupant-jobs/assets/viewer/src/tables.js";
import { buildTabs, showOccupant } from "../../../occupant-jobs/assets/viewer/src/tabs.js";

/** A run with its arrays as typed arrays. */
export function readRun(run) {
  return readReport(JSON.stringify({ runs: [run] })).runs[0];
}

export class View {
  /** `plot` hears the names of channels that are to be plotted before the others. */
  constructor(plot) {
    this.heading = element("header", { class: "heading" });
    this.verdicts = element("div", { class: "judged" });
    this.stagePlace = element("div", { class: "stage", tabindex: "0", "aria-label": "Scene" });
    this.controls = element("div", { class: "controls", role: "group", "aria-label": "Playback" });
    this.names = element("datalist", { id: "channels" });
    this.chosen = element("input", {
      type: "search",
      list: "channels",
      spellcheck: "false",
      placeholder: "head.acceleration.*, head.position.x",
      "aria-label": "Channels to plot, by name or pattern",
    });
    this.chosen.addEventListener("change", () => {
      const names = this.chosen.value.split(/[\s,]+/).filter((name) => name);
      plot(names);
    });
    const choice = element("label", { class: "choice" }, "Plot also ", this.chosen, this.names);
    this.plots = element("section", { class: "plots", "aria-label": "Time histories" });
    this.caveats = element("div", { class: "said" });
    this.tables = element("section", { class: "tables", "aria-label": "Results in numbers" });
    const scene = element("section", { class: "scene", "aria-label": "Motion" });
    scene.append(this.stagePlace, this.controls);
    this.root = element(
      "div",
      { class: "view" },
      this.heading,
      element("div", { class: "halves" }, scene, element("div", { class: "beside" }, choice, this.plots)),
      this.verdicts,
      this.caveats,
      this.tables,
    );
    this.stage = null;
    this.clock = null;
    this.removePlots = () => {};
    listenToKeys(() => this, scene);
  }

  /** Offers the names of a run's channels. */
  offer(names) {
    if (this.names.childElementCount === names.length) return;
    this.names.replaceChildren(...names.map((name) => element("option", { value: name })));
  }

  /** Shows runs, the first in front; the time and the camera stay where they are. */
  show(runs) {
    const before = this.clock;
    const clock = new Clock(runs);
    if (before) {
      before.pause();
      clock.repeat = before.repeat;
      if (Math.abs(before.end - clock.end) < 1e-9) clock.speed = before.speed;
    }
    this.clock = clock;
    this.runs = runs;
    this.buildStage(runs, clock);
    this.buildTexts(runs);
    this.controls.replaceChildren();
    buildControls(this.controls, clock, this.stage, runs);
    const scrolled = this.plots.scrollTop;
    this.removePlots();
    this.plots.replaceChildren();
    this.removePlots = buildPlots(this.plots, runs, clock);
    this.plots.scrollTop = scrolled;
    showOccupant(runs);
    if (before) clock.seek(before.time);
    if (before ? before.playing : true) clock.play();
  }

  buildStage(runs, clock) {
    if (this.stage) {
      this.stage.replace(runs, clock);
      return;
    }
    if (this.stagePlace.classList.contains("unavailable")) return;
    try {
      this.stage = new Stage(this.stagePlace, runs, clock);
    } catch (error) {
      this.stagePlace.classList.add("unavailable");
      this.stagePlace.textContent = `This browser gives no 3-D drawing (WebGL): ${error.message}`;
    }
  }

  buildTexts(runs) {
    const several = runs.length > 1;
    const lines = runs.map((run, number) =>
      element("p", {}, several ? swatch(number) : null, several ? `${run.title}: ` : "", run.facts),
    );
    this.heading.classList.toggle("several", several);
    this.heading.replaceChildren(element("h2", {}, runs[0].title || runs[0].label), ...lines);
    const tabs = buildTabs(runs);
    const struck = runs.map((run) => impacts(run, several)).filter((part) => part !== null);
    this.verdicts.replaceChildren(...struck, ...(tabs ? [tabs] : []), buildVerdicts(runs));
    const said = runs.flatMap((run) => notes(run, several));
    const spoils = runs.map((run, number) => caveats(run, number, several));
    this.caveats.replaceChildren(...said, ...spoils.filter((part) => part !== null));
    const open = [...this.tables.querySelectorAll("details")].map((fold) => fold.open);
    this.tables.replaceChildren();
    buildTables(this.tables, runs, this.clock);
    this.tables.querySelectorAll("details").forEach((fold, i) => (fold.open = open[i] ?? fold.open));
  }
}
