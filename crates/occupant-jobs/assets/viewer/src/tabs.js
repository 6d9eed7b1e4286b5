// A tab for each of several occupants. What has a name in `data-occupant` is seen while its tab is chosen, and in print.

import { element } from "./dom.js";

/** Names of the occupants of runs; none for single ones. */
export const occupantsOf = (runs) => [
  ...new Set(runs.flatMap((run) => run.occupants.map((one) => one.name)).filter((name) => name)),
];

/** Attributes of what is of one occupant. */
export const own = (name) => (name ? { "data-occupant": name } : {});

/** The occupant seen last: another run of the page that simulates shows the same one. */
let chosen = null;

const listeners = [];

/** Calls `listener` at every choice with the name of the occupant that is seen. */
export const listenToTabs = (listener) => listeners.push(listener);

/** The row of tabs; none for a single occupant. */
export function buildTabs(runs) {
  const names = occupantsOf(runs);
  if (names.length < 2) return null;
  const tabs = names.map((name) =>
    element(
      "button",
      { type: "button", role: "tab", id: tabId(name), "data-name": name },
      name.replaceAll("_", " "),
    ),
  );
  const row = element("div", { class: "occupants", role: "tablist", "aria-label": "Occupants" });
  row.append(...tabs);
  row.addEventListener("click", ({ target }) => {
    if (target.dataset.name) showOccupant(runs, target.dataset.name);
  });
  row.addEventListener("keydown", (event) => {
    const count = names.length;
    const steps = { ArrowRight: 1, ArrowLeft: -1, Home: -count, End: count };
    if (!(event.key in steps)) return;
    event.preventDefault();
    // the arrows of the page step through time
    event.stopPropagation();
    const at = names.indexOf(chosen) + steps[event.key];
    const next = Math.abs(steps[event.key]) === 1 ? (at + count) % count : at < 0 ? 0 : count - 1;
    showOccupant(runs, names[next]);
    tabs[next].focus();
  });
  return row;
}

/** Shows what is of an occupant, of the one seen last if none is named. */
export function showOccupant(runs, name) {
  const names = occupantsOf(runs);
  chosen = names.includes(name) ? name : names.includes(chosen) ? chosen : names[0];
  listeners.forEach((listener) => listener(chosen ?? ""));
  for (const part of document.querySelectorAll("[data-occupant]"))
    part.hidden = part.dataset.occupant !== chosen;
  for (const tab of document.querySelectorAll(".occupants [role=tab]")) {
    const isChosen = tab.dataset.name === chosen;
    tab.setAttribute("aria-selected", String(isChosen));
    tab.tabIndex = isChosen ? 0 : -1;
  }
  for (const tab of document.querySelectorAll(".occupants [role=tab]")) {
    const panels = document.querySelectorAll(
      `[role=tabpanel][data-occupant="${CSS.escape(tab.dataset.name)}"]`,
    );
    tab.setAttribute("aria-controls", [...panels].map((panel) => panel.id).join(" "));
  }
}

const tabId = (name) => `tab-${name}`;

/** A panel of an occupant, with a heading for print. */
export function panel(name, kind, ...children) {
  if (!name) return element("div", {}, ...children);
  const attributes = {
    ...own(name),
    id: `${kind}-${name}`,
    role: "tabpanel",
    "aria-labelledby": tabId(name),
  };
  const heading = element("h2", { class: "of-print" }, name.replaceAll("_", " "));
  return element("div", attributes, heading, ...children);
}
