// Sliders and choices for the values that the simulator says can be moved. Each makes a change as `--set` does.

import { element } from "../../../occupant-jobs/assets/viewer/src/dom.js";

/** The number of a change such as "56 km/h". */
const numberOf = (text) => (text === undefined ? null : Number.parseFloat(text));

export class Knobs {
  /** `changed(path, value, isOver)`: a value as text, or null for that of the text; isOver when the hand has let go. */
  constructor(changed) {
    this.changed = changed;
    this.root = element("div", { class: "knobs" });
    this.shape = "";
  }

  /** Shows what can be moved; `set` are the changes that are made. */
  show(knobs, set) {
    const shape = JSON.stringify(
      knobs.map((knob) => [knob.path, knob.kind, knob.names, knob.label]),
    );
    if (shape !== this.shape) this.build(knobs);
    this.shape = shape;
    for (const knob of knobs) this.put(knob, set);
  }

  build(knobs) {
    const groups = new Map();
    this.rows = new Map();
    for (const knob of knobs) {
      if (!groups.has(knob.group)) {
        const box = element("fieldset", {}, element("legend", {}, knob.group));
        groups.set(knob.group, box);
      }
      const row = this.row(knob);
      this.rows.set(knob.path, row);
      groups.get(knob.group).append(row.root);
    }
    const none = element("p", {}, "Nothing here can be moved: see the problems of the text.");
    this.root.replaceChildren(...(groups.size > 0 ? groups.values() : [none]));
  }

  row(knob) {
    const id = `knob-${knob.path.replace(/[^a-z0-9]+/gi, "-")}`;
    const label = element("label", { for: id, title: knob.path }, knob.label);
    const back = element(
      "button",
      {
        type: "button",
        class: "back",
        "aria-label": `${knob.label}: back to the text`,
        hidden: true,
      },
      "↺",
    );
    back.addEventListener("click", () => this.changed(knob.path, null, true));
    const make = { number, direction, choice, truth }[knob.kind];
    const input = make(knob, id, (value, isOver) => this.changed(knob.path, value, isOver));
    const root = element(
      "div",
      { class: `knob ${knob.kind === "direction" ? "number" : knob.kind}` },
      label,
      ...input.parts,
      back,
    );
    return { root, back, put: input.put };
  }

  put(knob, set) {
    const row = this.rows.get(knob.path);
    const own = set.get(knob.path);
    row.back.hidden = own === undefined;
    row.root.classList.toggle("moved", own !== undefined);
    row.put(knob, own);
  }
}

/** A slider with its number, in which one can write too. */
function number(knob, id, changed) {
  const { from, to, step, unit } = knob;
  const slider = element("input", { type: "range", id, min: from, max: to, step });
  const field = element("input", {
    type: "number",
    step: "any",
    "aria-label": `${knob.label}, ${unit || "factor"}`,
  });
  const said = (value) => (unit ? `${value} ${unit}` : String(value));
  slider.addEventListener("input", () => {
    field.value = slider.value;
    slider.setAttribute("aria-valuetext", said(slider.value));
    changed(said(slider.value), false);
  });
  slider.addEventListener("change", () => changed(said(slider.value), true));
  field.addEventListener("change", () => {
    if (field.value !== "" && Number.isFinite(Number(field.value)))
      changed(said(field.value), true);
  });
  const put = (now, own) => {
    const value = own === undefined ? now.now : numberOf(own);
    if (document.activeElement !== slider) slider.value = value ?? (from + to) / 2;
    if (document.activeElement !== field)
      field.value = value === null ? "" : Number(value.toPrecision(5));
    field.placeholder = "usual";
    slider.classList.toggle("usual", value === null);
    slider.setAttribute("aria-valuetext", value === null ? "as is usual" : said(field.value));
  };
  return { parts: [slider, field, element("span", { class: "unit" }, unit)], put };
}

/** An angle in degrees, set as a vector. */
function direction(knob, id, changed) {
  const vector = (text) => {
    const angle = (Number.parseFloat(text) * Math.PI) / 180;
    const [x, y] = [Math.cos(angle), Math.sin(angle)].map((part) => Number(part.toFixed(4)));
    return `[${x}, ${y}, 0]`;
  };
  const own = { ...knob, from: -180, to: 180, step: 5, unit: "deg" };
  const made = number(own, id, (text, isOver) => changed(vector(text), isOver));
  const put = (now, set) => {
    const [x, y] = (set ?? "").replace(/[[\]]/g, "").split(",").map(Number);
    const angle = set === undefined ? now.now : (Math.atan2(y, x) * 180) / Math.PI;
    made.put({ ...now, now: Number(angle.toFixed(2)) }, undefined);
  };
  return { parts: made.parts, put };
}

function choice(knob, id, changed) {
  const select = element("select", { id });
  select.append(element("option", { value: "" }, "as is usual"));
  for (const name of knob.names)
    select.append(element("option", { value: name }, name.replace(/_/g, " ")));
  select.addEventListener("change", () =>
    changed(select.value === "" ? null : `"${select.value}"`, true),
  );
  const put = (now, own) => {
    select.value = own === undefined ? (now.now ?? "") : own.replace(/"/g, "");
    select.firstChild.hidden = now.now !== null;
  };
  return { parts: [select], put };
}

function truth(knob, id, changed) {
  const select = element("select", { id });
  for (const [value, word] of [
    ["", "as is usual"],
    ["true", "yes"],
    ["false", "no"],
  ]) {
    select.append(element("option", { value }, word));
  }
  select.addEventListener("change", () => changed(select.value === "" ? null : select.value, true));
  const put = (now, own) => {
    select.value = own ?? (now.now === null ? "" : String(now.now));
    select.firstChild.hidden = now.now !== null;
  };
  return { parts: [select], put };
}
