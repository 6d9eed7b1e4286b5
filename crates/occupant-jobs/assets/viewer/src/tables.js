// The run in numbers: measures against limits, contacts, energy, provenance, scenario.

import { element, figures, milliseconds } from "./dom.js";
import { buildPlan, groundRows } from "./ground.js";
import { caveatName, swatch } from "./page.js";
import { occupantsOf, panel } from "./tabs.js";

export function buildTables(root, runs, clock) {
  const names = occupantsOf(runs);
  const shown = names.length > 1 ? names : [];
  const panels = shown.map((name) => panel(name, "measures", measures(runs, clock, name)));
  root.append(...panels, measures(runs, clock, null), ground(runs, clock), provenance(runs));
  for (const run of runs) root.append(scenario(run, runs.length > 1));
}

/** Whether a row is of the occupant, or with none named of all; of a single one all are. */
const isOf = (m, name, runs) => occupantsOf(runs).length < 2 || (m.occupant ?? null) === name;

/** The name of a row in the table of its occupant. */
const shortName = (m) =>
  m.occupant && m.name.startsWith(`${m.occupant}.`) ? m.name.slice(m.occupant.length + 1) : m.name;

/** Every measure that has a limit; the same limit of several rules once. A panel for each of several occupants. */
export function buildVerdicts(runs) {
  const names = occupantsOf(runs);
  if (names.length < 2) return tiles(runs, null);
  return element(
    "div",
    { class: "judged" },
    ...names.map((name) => panel(name, "verdicts", tiles(runs, name))),
  );
}

function tiles(runs, name) {
  const judged = runs[0].measures.filter((m) => m.limit !== null && isOf(m, name, runs));
  const cards = [];
  for (const m of judged) {
    const known = cards.find((card) => card.name === m.name && card.limit === m.limit);
    if (known) known.rules.push(m.rule);
    else cards.push({ ...m, rules: [m.rule] });
  }
  const isJudged = judged.some((m) => m.verdict !== null);
  const label = isJudged ? "Verdicts" : "Measures beside limits of dummies";
  const words = "Limits made for dummies: for a person's body they are yardsticks, no verdicts.";
  const yardsticks =
    cards.length > 0 && !isJudged ? element("p", { class: "yardsticks" }, words) : null;
  return element(
    "section",
    { class: "verdicts", "aria-label": label },
    yardsticks,
    ...cards.map(verdict),
  );

  function verdict(card) {
    const own = runs.map((run, number) => {
      const m = run.measures.find((other) => isSame(other, card));
      if (!m) return null;
      const value = [`${figures(m.value)} ${m.unit}`, ...marks(m, number)];
      const sign = runs.length > 1 ? swatch(number) : null;
      return element("b", { class: `verdict ${m.verdict ?? ""}` }, sign, ...value);
    });
    const rules = card.rules.join(", ");
    const limit = card.verdict
      ? `${card.verdict}, ≤ ${figures(card.limit)} of ${rules}`
      : `limit of a dummy ${figures(card.limit)} (${card.dummy}), ${rules}`;
    return element(
      "div",
      { class: `card ${card.verdict ?? "open"}` },
      element("span", {}, shortName(card)),
      ...own,
      element("small", {}, limit),
    );
  }
}

/** Marks of a figure, one for each caveat on it, which lead there. */
function marks(m, run) {
  return m.caveats.map((place) =>
    element(
      "a",
      { class: "mark", href: `#${caveatName(run, place)}`, title: `caveat ${place + 1}` },
      ` !${place + 1}`,
    ),
  );
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
  if (time === null || time === undefined) return element("td", {});
  const button = element("button", { type: "button", class: "time-link" }, milliseconds(time));
  button.addEventListener("click", () => {
    clock.pause();
    clock.seek(time);
  });
  return element("td", { class: "number" }, button);
}

/** A table of each group, as many beside each other as there is room for. */
function measures(runs, clock, occupant) {
  const keys = [];
  for (const m of runs.flatMap((run) => run.measures).filter((m) => isOf(m, occupant, runs))) {
    if (!keys.some((key) => isSame(key, m))) keys.push(m);
  }
  const names = [...new Set(keys.map((key) => key.group))];
  const groups = names.map((name) => group(name, keys, runs, clock));
  const columns = runs.length > 1 ? "groups wide" : "groups";
  const all = element("div", { class: columns }, ...groups, ...contacts(runs, clock, occupant));
  const several = occupantsOf(runs).length > 1;
  const title = occupant
    ? `All measures of ${occupant.replaceAll("_", " ")}`
    : several
      ? "Common to all"
      : "All measures";
  return section(title, all);
}

/** Whether two rows tell of one measure against one rule. */
function isSame(a, b) {
  return a.group === b.group && a.name === b.name && a.rule === b.rule;
}

/** The measures of a group, under the columns that are not empty. */
function group(name, keys, runs, clock) {
  const own = keys.filter((key) => key.group === name);
  const rows = own.map((key) => runs.map((run) => run.measures.find((m) => isSame(key, m))));
  const columns = COLUMNS.filter(
    ({ field }) => !field || rows.flat().some((m) => m && m[field] !== null),
  );
  const head = ["Measure"];
  for (const number of runs.keys()) {
    const names = columns.map((column) => column.head);
    if (runs.length > 1) names[0] = [swatch(number), names[0]];
    head.push(...names);
  }
  const isRuled = own.some((key) => key.rule !== null);
  if (isRuled) head.push("rule");
  const body = own.flatMap((key, i) => {
    const cells = rows[i].flatMap((m, run) =>
      columns.map((column) => (m ? column.cell(m, run, clock) : element("td", {}, "–"))),
    );
    const rule = isRuled ? element("td", {}, key.rule ?? "") : null;
    const row = element("tr", {}, element("th", { scope: "row" }, shortName(key)), ...cells, rule);
    if (!key.remark) return [row];
    row.classList.add("remarked");
    const remark = element("td", { class: "remark", colspan: head.length }, key.remark);
    return [row, element("tr", {}, remark)];
  });
  return folding(name, table(head, body));
}

/** Folded on a phone, where all groups below each other are many screens. */
const isWide = () => window.matchMedia("(min-width: 700px)").matches;

function folding(title, ...children) {
  const heading = element("summary", {}, element("h3", {}, ...[title].flat()));
  return element("details", { class: "group", open: isWide() }, heading, ...children);
}

/** Columns of a run's measures; one without a value of its field in any row is left out. */
const COLUMNS = [
  { head: "value", cell: (m, run) => valueCell(m, run) },
  { head: "at", field: "time_s", cell: (m, run, clock) => timeCell(m.time_s, clock) },
  {
    head: "limit",
    field: "limit",
    cell: (m) => element("td", { class: "number" }, m.limit === null ? "" : limitText(m)),
  },
  {
    head: "verdict",
    field: "verdict",
    cell: (m) => element("td", { class: `verdict ${m.verdict ?? ""}` }, m.verdict ?? ""),
  },
];

/** A limit; one without a verdict is of a dummy. */
const limitText = (m) => (m.verdict ? `≤ ${figures(m.limit)}` : `${figures(m.limit)} of a dummy`);

function valueCell(m, run) {
  // what rounds to nothing is nothing, but where a small part of something counts
  const exact = m.unit === "" || m.unit === "%";
  const value = m.value === null || exact ? m.value : Number(m.value.toFixed(3));
  const text = value === null ? "–" : `${figures(value)} ${m.unit}`;
  return element("td", { class: "number" }, text, ...marks(m, run));
}

/** A longer list of contacts with the ground is folded. */
const MOST_ROWS = 20;

/** The ground in plan and all contacts with it, of runs with either. */
function ground(runs, clock) {
  const parts = runs.flatMap((run, number) => {
    const plan = buildPlan(run);
    const rows = groundRows(run, clock, timeCell);
    if (!plan && rows.length === 0) return [];
    const whose = runs.length > 1 ? [swatch(number), run.label] : ["Contacts with the ground"];
    const more = run.ground.more > 0 ? element("p", {}, `and ${run.ground.more} more`) : null;
    const head = ["Time", "Segment", "Ground", "Place X, Y", "Speed"];
    const list = rows.length > 0 ? table(head, rows) : null;
    const fold = folding(whose, list, more);
    if (rows.length > MOST_ROWS) fold.open = false;
    return [plan ? element("figure", { class: "planned" }, plan) : null, fold];
  });
  return parts.length > 0 ? section("On the ground", ...parts) : "";
}

function contacts(runs, clock, occupant) {
  const names = occupantsOf(runs);
  const ownerOf = (c) => names.find((name) => c.part.startsWith(`${name}.`)) ?? null;
  if (names.length > 1 && occupant === null) return [];
  return runs.map((run, number) => {
    const own = run.first_contacts.filter((c) => names.length < 2 || ownerOf(c) === occupant);
    const rows = own.map((c) =>
      element(
        "tr",
        {},
        timeCell(c.time_s, clock),
        element("td", {}, c.sphere),
        element("td", {}, c.surface),
        element(
          "td",
          { class: "number" },
          c.at_start
            ? "at the start"
            : `${figures(c.closing_m_s / run.speed_unit[0], 3)} ${run.speed_unit[1]}`,
        ),
      ),
    );
    const whose =
      runs.length > 1 ? [swatch(number), `First contacts of ${run.label}`] : ["First contacts"];
    const none = element("p", {}, "Nothing touched anything.");
    const list =
      rows.length > 0 ? table(["Time", "Sphere", "Surface", "Closing speed"], rows) : none;
    return folding(whose, list);
  });
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
  return folded("Where it comes from", "origin", table(head, rows));
}

function scenario(run, several) {
  const title = several ? `Scenario of ${run.label}` : "Scenario";
  const text = element("pre", { tabindex: "0" }, run.scenario);
  return folded(title, "scenario", text);
}

function folded(title, name, ...children) {
  return element("details", { class: name }, element("summary", {}, title), ...children);
}
