// The frame of the page: title, verdicts and caveats, and the places where the rest goes.

import { element } from "./dom.js";
import { buildVerdicts } from "./tables.js";

export function buildPage(root, report) {
  const runs = report.runs;
  const stage = element("div", { class: "stage", id: "stage" });
  const controls = element("div", { class: "controls", role: "group", "aria-label": "Playback" });
  const plots = element("section", { class: "plots", "aria-label": "Time histories" });
  const tables = element("section", { class: "tables", "aria-label": "Results in numbers" });
  const scene = element("section", { class: "scene", "aria-label": "Motion" }, stage, controls);
  const parts = [
    heading(runs),
    ...runs.flatMap((run) => notes(run, runs.length > 1)),
    buildVerdicts(runs),
    ...runs.map((run, number) => caveats(run, number, runs.length > 1)),
    element("main", {}, scene, element("div", { class: "beside" }, plots)),
    tables,
    footer(report),
  ];
  // a run without caveats has no part for them
  root.append(...parts.filter((part) => part !== null));
  return { stage, controls, plots, tables };
}

function footer(report) {
  const licenses = element(
    "pre",
    { tabindex: "0" },
    document.getElementById("licenses").textContent,
  );
  const libraries = element("summary", {}, "Licences of the libraries in this page");
  return element(
    "footer",
    {},
    element("p", {}, `Made by ${report.program}. This file loads nothing from the network.`),
    element("details", {}, libraries, licenses),
  );
}

function heading(runs) {
  const [first, ...others] = runs;
  const title = element("h1", {}, first.title || first.label);
  const own = element("p", {}, others.length ? swatch(0) : null, `${first.label}: ${first.facts}`);
  const against = others.map((run, i) =>
    element("p", {}, swatch(i + 1), `against ${run.label}, ${run.title}: ${run.facts}`),
  );
  return element("header", {}, title, own, ...against);
}

/** A patch of the colour of a run. */
export function swatch(run) {
  return element("span", { class: `swatch run-${run}`, "aria-hidden": "true" });
}

/** The name of a caveat in the page. */
export const caveatName = (run, place) => `caveat-${run + 1}-${place + 1}`;

/** What was seen in a run that spoils figures, numbered as the marks of the figures are. */
export function caveats(run, number, several) {
  if (run.caveats.length === 0) return null;
  const items = run.caveats.map((text, place) =>
    element("li", { id: caveatName(number, place) }, text),
  );
  const whose = several ? ` of ${run.label}` : "";
  const words = `Caveats${whose}: results with ! should not be quoted without them`;
  return element(
    "section",
    { class: "note caveats", role: "note" },
    element("h2", {}, words),
    element("ol", {}, ...items),
  );
}

export function notes(run, several) {
  const said = run.notes.map((note) => (several ? `${run.label}: ${note}` : note));
  return said.map((note) => element("p", { class: "note", role: "note" }, note));
}
