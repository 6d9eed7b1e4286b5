// The frame of the page: title, verdicts and caveats, and the places where the rest goes.

import { element } from "./dom.js";
import { buildVerdicts } from "./tables.js";
import { buildTabs } from "./tabs.js";

export function buildPage(root, report) {
  const runs = report.runs;
  const stage = element("div", { class: "stage", id: "stage" });
  const controls = element("div", { class: "controls", role: "group", "aria-label": "Playback" });
  const plots = element("section", { class: "plots", "aria-label": "Time histories" });
  const tables = element("section", { class: "tables", "aria-label": "Results in numbers" });
  const scene = element("section", { class: "scene", "aria-label": "Motion" }, stage, controls);
  const strip = element("div", { class: "strip" });
  const said = [
    ...runs.flatMap((run) => notes(run, runs.length > 1)),
    ...runs.map((run, number) => caveats(run, number, runs.length > 1)),
  ].filter((part) => part !== null);
  const parts = [
    heading(runs, said.length > 0),
    strip,
    element("main", {}, scene, element("div", { class: "beside" }, plots)),
    ...runs.map((run) => impacts(run, runs.length > 1)),
    buildTabs(runs),
    buildVerdicts(runs),
    said.length > 0 ? element("section", { id: "said", "aria-label": "Notes" }, ...said) : null,
    tables,
    footer(report),
  ];
  // a run without caveats has no part for them
  root.append(...parts.filter((part) => part !== null));
  return { stage, controls, plots, tables, strip };
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

/** Which way the vehicles were struck, as the path tells. */
export function impacts(run, several) {
  if (run.impacts.length === 0) return null;
  const whose = several ? `${run.label}: ` : "";
  return element("p", { class: "impact" }, whose + run.impacts.join("; "));
}

function heading(runs, isSaid) {
  const [first, ...others] = runs;
  const title = element("h1", {}, first.title || first.label);
  const own = element(
    "p",
    { class: "facts" },
    others.length ? swatch(0) : null,
    `${first.label}: ${first.facts}`,
  );
  const against = others.map((run, i) =>
    element(
      "p",
      { class: "facts" },
      swatch(i + 1),
      `against ${run.label}, ${run.title}: ${run.facts}`,
    ),
  );
  const said = element(
    "a",
    { href: "#said" },
    "Read the notes and caveats before you quote a number.",
  );
  return element("header", {}, title, own, ...against, isSaid ? element("p", {}, said) : null);
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
