// The text of the scenario, with line numbers and its problems at their lines.

import { element } from "../../../occupant-jobs/assets/viewer/src/dom.js";
import { Completion } from "./completion.js";

export class Editor {
  /** `changed(text)` is called at every change by hand. */
  constructor(changed) {
    this.text = element("textarea", {
      id: "scenario-text",
      spellcheck: "false",
      autocapitalize: "off",
      autocomplete: "off",
      wrap: "off",
      "aria-label": "Scenario as TOML. Control and space completes a key",
      "aria-describedby": "problems",
    });
    this.gutter = element("pre", { class: "gutter", "aria-hidden": "true" });
    this.problems = element("ul", { class: "problems", id: "problems", "aria-live": "polite" });
    this.completion = new Completion(this.text, () => this.typed());
    const box = element("div", { class: "editor" }, this.gutter, this.text, this.completion.list);
    const hint = element("p", { class: "hint" }, "Ctrl and space completes a key or a value.");
    this.root = element("div", { class: "writing" }, box, hint, this.problems);
    this.changed = changed;
    this.marks = new Map();
    this.text.addEventListener("input", () => this.typed());
    this.text.addEventListener("scroll", () => (this.gutter.scrollTop = this.text.scrollTop));
  }

  typed() {
    this.number();
    this.changed(this.text.value);
  }

  put(text) {
    if (this.text.value === text) return;
    this.text.value = text;
    this.number();
  }

  /** Line numbers, those with a problem marked. */
  number() {
    const count = this.text.value.split("\n").length;
    const lines = [];
    for (let line = 1; line <= count; line++) {
      const mark = this.marks.get(line);
      lines.push(element("span", { class: mark ?? null }, String(line)), "\n");
    }
    this.gutter.replaceChildren(...lines);
    this.gutter.scrollTop = this.text.scrollTop;
  }

  /** Shows problems; those of the text can be clicked. */
  tell(problems, name) {
    this.marks = new Map();
    const items = problems.map((problem) => {
      const isHere = problem.source === name && problem.line !== null;
      const kind = problem.is_error ? "error" : "warning";
      if (isHere && this.marks.get(problem.line) !== "error") this.marks.set(problem.line, kind);
      const where = isHere
        ? this.link(problem)
        : element(
            "b",
            {},
            problem.line ? `${problem.source}, line ${problem.line}` : problem.source,
          );
      const words = [
        problem.found,
        problem.expected && `expected ${problem.expected}`,
        problem.hint,
      ];
      const said = words.filter(Boolean).join("; ");
      return element("li", { class: kind }, element("span", {}, `${kind}: `), where, ` ${said}`);
    });
    this.problems.replaceChildren(...items);
    this.text.setAttribute("aria-invalid", String(problems.some((problem) => problem.is_error)));
    this.number();
  }

  link({ line, column }) {
    const button = element("button", { type: "button", class: "time-link" }, `line ${line}`);
    button.addEventListener("click", () => this.goTo(line, column));
    return button;
  }

  goTo(line, column) {
    const before = this.text.value.split("\n").slice(0, line - 1);
    const at = before.reduce((sum, text) => sum + text.length + 1, 0) + column - 1;
    this.text.focus();
    this.text.setSelectionRange(at, at);
    const height = parseFloat(getComputedStyle(this.text).lineHeight);
    this.text.scrollTop = Math.max(0, (line - 4) * height);
  }
}
