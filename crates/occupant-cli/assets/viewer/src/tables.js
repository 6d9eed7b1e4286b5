// The run in numbers: measures against limits, contacts, energy, provenance, scenario.

import { element, figures, milliseconds } from "./dom.js";
import { swatch } from "./page.js";

export function buildTables(root, runs, clock) {
  root.append(measures(runs, clock), contacts(runs, clock), provenance(runs));
  for (const run of runs) root.append(scenario(run, runs.length > 1));
}

function section(title, ...children) {
  return element("section", {}, element("h2", {}, title), ...children);
}

/** A table that may be wider than the screen. */
function table(head, rows) {
  const top = element(
    "tr",
    {},
    ...head.map((cell) => element("th", { scope: "col" }, ...[cell].flat())),
  );
  const scroll = { class: "scroll", tabindex: "0" };
  return element(
    "div",
    scroll,
    element("table", {}, element("thead", {}, top), element("tbody", {}, ...rows)),
  );
}

/** A time that can be clicked to go there. */
function timeCell(time, clock) {
  if (time === null || time === undefined) return element("td", {}, "–");
  const button = element("button", { type: "button", class: "time-link" }, milliseconds(time));
  button.addEventListener("click", () => {
    clock.pause();
    clock.seek(time);
  });
  return element("td", { class: "number" }, button);
}

function measures(runs, clock) {
  const keys = [];
  for (const m of runs.flatMap((run) => run.measures)) {
    if (!keys.some((key) => isSame(key, m))) keys.push(m);
  }
  const head = ["Measure"];
  for (const number of runs.keys()) {
    head.push(runs.length > 1 ? [swatch(number), "value"] : "Value", "at", "limit", "verdict");
  }
  head.push("rule");
  const rows = [];
  for (const [i, key] of keys.entries()) {
    if (i === 0 || key.group !== keys[i - 1].group) rows.push(groupRow(key.group, head.length));
    rows.push(measureRow(key, runs, clock));
  }
  return section("Measures", table(head, rows));
}

/** Whether two rows tell of one measure against one rule. */
function isSame(a, b) {
  return a.group === b.group && a.name === b.name && a.rule === b.rule;
}

function groupRow(group, columns) {
  const head = element("th", { colspan: columns, scope: "rowgroup" }, group);
  return element("tr", { class: "group" }, head);
}

function measureRow(key, runs, clock) {
  const remark = key.remark ? element("p", { class: "remark" }, key.remark) : null;
  const name = element("th", { scope: "row" }, key.name, remark);
  const cells = runs.flatMap((run) =>
    measureCells(
      run.measures.find((m) => isSame(key, m)),
      clock,
    ),
  );
  return element("tr", {}, name, ...cells, element("td", {}, key.rule ?? ""));
}

function measureCells(m, clock) {
  if (!m) return ["–", "–", "–", "–"].map((text) => element("td", {}, text));
  const mark = m.is_marked ? " !" : "";
  const value = m.value === null ? "–" : `${figures(m.value)} ${m.unit}${mark}`;
  const limit = m.limit === null ? "–" : `≤ ${figures(m.limit)} ${m.unit}`;
  const verdict = m.verdict ?? "–";
  return [
    element("td", { class: "number" }, value),
    timeCell(m.time_s, clock),
    element("td", { class: "number" }, limit),
    element("td", { class: `verdict ${verdict}` }, verdict),
  ];
}

function contacts(runs, clock) {
  const lists = runs.map((run, number) => {
    const rows = run.first_contacts.map((c) =>
      element(
        "tr",
        {},
        timeCell(c.time_s, clock),
        element("td", {}, c.sphere),
        element("td", {}, c.surface),
        element(
          "td",
          { class: "number" },
          c.at_start ? "at the start" : `${figures(c.closing_m_s, 3)} m/s`,
        ),
      ),
    );
    const parts = [];
    if (runs.length > 1) parts.push(element("h3", {}, swatch(number), run.label));
    const none = element("p", {}, "Nothing touched anything.");
    parts.push(
      rows.length > 0 ? table(["Time", "Sphere", "Surface", "Closing speed"], rows) : none,
    );
    return element("div", {}, ...parts);
  });
  return section("First contacts", element("div", { class: "columns" }, ...lists));
}

function provenance(runs) {
  const keys = [...new Set(runs.flatMap((run) => run.provenance.map(([key]) => key)))];
  const value = (run, key) => run.provenance.find(([k]) => k === key)?.[1] ?? "–";
  const rows = keys.map((key) =>
    element(
      "tr",
      {},
      element("th", { scope: "row" }, key),
      ...runs.map((run) => element("td", { class: "wrap" }, value(run, key))),
    ),
  );
  const head = [
    "",
    ...runs.map((run, number) => (runs.length > 1 ? [swatch(number), run.label] : run.label)),
  ];
  return section("Where it comes from", table(head, rows));
}

function scenario(run, several) {
  const title = several ? `Scenario of ${run.label}` : "Scenario";
  const text = element("pre", { tabindex: "0" }, run.scenario);
  return element("details", { class: "scenario" }, element("summary", {}, title), text);
}
