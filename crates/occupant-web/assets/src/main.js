// The page: a case as text and as sliders on one side, what its run shows on the other.

import { element } from "../../../occupant-jobs/assets/viewer/src/dom.js";
import { Editor } from "./editor.js";
import { Engine, GivenUp, Refused, unpack } from "./engine.js";
import { fromFragment, toFragment } from "./link.js";
import { Knobs } from "./knobs.js";
import { LESSONS } from "./lessons.js";
import { StudyTab } from "./study.js";
import { View, readRun } from "./view.js";

/** A run that takes longer than this is given up for the next one, ms. */
const PATIENCE_MS = 1500;
/** After the last letter the text waits so long before it is checked and run, ms. */
const PAUSE_MS = 350;

class Page {
  constructor(root) {
    /** The case: text, changes, tables. */
    this.state = { name: "driver.toml", text: "", set: new Map(), tables: {} };
    this.kept = null;
    this.now = null;
    this.times = { begin: performance.now() };
    this.knobs = new Knobs((path, value, isOver) => this.move(path, value, isOver));
    this.editor = new Editor((text) => this.write(text));
    /** Channels to plot before the others. */
    this.plotted = [];
    this.view = new View((names) => {
      this.plotted = names;
      this.ask();
    });
    this.study = new StudyTab(this);
    this.build(root);
  }

  build(root) {
    this.template = element("select", { id: "template", "aria-label": "Template" });
    this.template.addEventListener("change", () => this.choose(this.template.value));
    this.status = element("p", { class: "status", role: "status" });
    this.bar = element("progress", { max: 1, value: 0, "aria-label": "Run", hidden: true });
    this.stopButton = button("Stop", () => this.stop());
    this.stopButton.hidden = true;
    this.keepButton = button("Compare with this", () => this.keep());
    this.file = element("input", {
      type: "file",
      multiple: true,
      hidden: true,
      accept: ".toml,.json,.csv,.txt,.tsv,.xlsx,.mcap",
    });
    this.file.addEventListener("change", () => this.open([...this.file.files]));
    const bar = element(
      "div",
      { class: "bar" },
      element("h1", {}, "Occupant"),
      element("label", { for: "template" }, "Template"),
      this.template,
      button(
        "Open…",
        () => this.file.click(),
        "A scenario (.toml, .json) with the tables that it names (.csv), a recorder's report (.csv, .txt, .xlsx), or results (.mcap)",
      ),
      button("Save scenario", () => this.saveText()),
      button(
        "Save results",
        () => this.saveResults(),
        "The run as MCAP, for viewers and for `occupant report`",
      ),
      button("Copy link", () => this.copyLink(), "A link to this page that carries the scenario"),
      this.keepButton,
      this.file,
    );
    this.changes = element("p", { class: "changes" });
    const tabs = new Tabs([
      ["Sliders", element("div", {}, this.changes, this.knobs.root)],
      ["Text", this.editor.root],
      ["Lessons", this.lessons()],
      ["Study", this.study.root],
    ]);
    this.tabs = tabs;
    this.notes = element("ul", { class: "record", "aria-label": "Notes on the record" });
    const running = [this.status, this.bar, this.stopButton];
    const run = element("div", { class: "running" }, ...running, this.notes);
    const hand = element("section", { class: "hand", "aria-label": "Scenario" }, run, tabs.root);
    root.append(bar, element("main", { class: "sides" }, hand, this.view.root), footer());
    root.addEventListener("dragover", (event) => event.preventDefault());
    root.addEventListener("drop", (event) => {
      event.preventDefault();
      this.open([...event.dataTransfer.files]);
    });
  }

  async begin(module) {
    this.say("Unpacking the simulator …");
    const compiled = await unpack(module);
    this.module = compiled;
    this.runner = new Engine(compiled);
    this.checker = new Engine(compiled);
    const linked = await fromFragment(location.hash);
    const { answer } = await this.checker.ask({ do: "about" });
    this.program = answer.program;
    this.templates = answer.templates;
    for (const { name, meaning } of answer.templates) {
      this.template.append(element("option", { value: name }, meaning));
    }
    this.template.append(element("option", { value: "", hidden: true }, "a text of your own"));
    if (linked) this.take(linked);
    else this.choose(answer.templates[0].name);
    const schema = await this.checker.ask({ do: "schema" });
    this.editor.completion.schema = schema.answer;
    window.addEventListener("hashchange", async () => {
      const state = await fromFragment(location.hash);
      if (state) this.take(state);
    });
  }

  /** Begins with a template. */
  choose(name) {
    const { text } = this.templates.find((template) => template.name === name);
    this.template.value = name;
    this.take({ name: `${name}.toml`, text, set: {}, tables: {} });
  }

  /** Takes a case as it was saved. */
  take({ name, text, set, tables }) {
    this.notes.replaceChildren();
    this.state = { name, text, set: new Map(Object.entries(set)), tables: { ...tables } };
    const known = this.templates.find((template) => `${template.name}.toml` === name);
    this.template.value = known && known.text === text ? known.name : "";
    this.editor.put(text);
    this.changed();
  }

  /** A slider or choice was moved. */
  move(path, value, isOver) {
    const set = this.state.set;
    if (value === null) set.delete(path);
    else set.set(path, value);
    // a car that comes to rest changes its speed by all of it
    const twin = { "path.delta_v": "path.speed", "path.speed": "path.delta_v" }[path];
    if (twin && this.isStop) {
      if (value === null) set.delete(twin);
      else set.set(twin, value);
    }
    this.times.moved = performance.now();
    this.tellChanges();
    this.ask();
    if (isOver) this.check();
  }

  write(text) {
    this.state.text = text;
    this.template.value = "";
    clearTimeout(this.pause);
    this.pause = setTimeout(() => this.changed(), PAUSE_MS);
  }

  /** The case as the simulator wants it. */
  case() {
    const { name, text, set, tables } = this.state;
    return { name, text, set: [...set].map(([path, value]) => `${path}=${value}`), tables };
  }

  changed() {
    this.tellChanges();
    this.check();
    this.ask();
  }

  tellChanges() {
    const set = [...this.state.set];
    const words = set.map(([path, value]) => `--set ${path}='${value}'`).join(" ");
    const own = element("code", {}, words);
    const write = button("Write into the text", () => this.writeChanges());
    const back = button("Undo all", () => {
      this.state.set.clear();
      this.changed();
    });
    this.changes.replaceChildren(
      ...(set.length > 0 ? ["Changed: ", own, " ", write, " ", back] : []),
    );
  }

  /** Writes the changes into the text, where they stay. */
  async writeChanges() {
    try {
      const { answer } = await this.checker.ask({ do: "write", case: this.case() });
      const { name, tables } = this.state;
      this.take({ name, text: answer.text, set: {}, tables });
      this.say("The changes stand in the text now.");
    } catch (error) {
      if (!(error instanceof GivenUp)) this.say(error.message, true);
    }
  }

  async check() {
    const asked = (this.checking = (this.checking ?? 0) + 1);
    const state = this.state;
    try {
      const { answer } = await this.checker.ask({ do: "check", case: this.case() });
      if (asked !== this.checking || state !== this.state) return;
      this.editor.tell(answer.problems, state.name);
      if (answer.knobs.length === 0 && answer.problems.some((problem) => problem.is_error)) return;
      this.put(answer.knobs);
    } catch (error) {
      if (!(error instanceof GivenUp)) this.say(error.message, true);
    }
  }

  put(knobs) {
    const now = (path) => knobs.find((knob) => knob.path === path)?.now;
    const [speed, change] = [now("path.speed"), now("path.delta_v")];
    this.isStop = speed !== undefined && change !== undefined && Math.abs(speed - change) < 1e-9;
    this.knobs.show(knobs, this.state.set);
    this.study.show(knobs);
  }

  /** Asks for a run of the case as it is now; a run under way is waited for, unless it is a long one. */
  ask() {
    this.wanted = true;
    if (!this.running) this.run();
    else if (performance.now() - this.began > PATIENCE_MS) this.runner.stop();
  }

  async run() {
    this.running = true;
    while (this.wanted) {
      this.wanted = false;
      this.began = performance.now();
      await this.runOnce();
    }
    this.running = false;
    this.bar.hidden = true;
    this.stopButton.hidden = true;
  }

  async runOnce() {
    const moved = this.times.moved;
    const request = { do: "run", case: this.case(), channels: this.plotted };
    this.say("Running …");
    const slow = setTimeout(() => {
      this.bar.hidden = false;
      this.stopButton.hidden = false;
    }, 400);
    try {
      const { answer, ms } = await this.runner.ask(request, (share) => (this.bar.value = share));
      this.now = { run: readRun(answer.run), summary: answer.summary, warnings: answer.warnings };
      this.view.offer(answer.channels);
      this.show();
      const s = this.now.summary;
      this.say(
        `Simulated ${((s.reached_s - s.start_s) * 1e3).toFixed(0)} ms in ${(ms / 1e3).toFixed(2)} s.`,
      );
      this.timed(moved, ms);
    } catch (error) {
      if (error instanceof GivenUp) {
        if (!this.wanted) this.say("Stopped.");
      } else if (error instanceof Refused) {
        if (error.problems.length > 0) this.editor.tell(error.problems, this.state.name);
        const first = error.problems.find((problem) => problem.is_error);
        this.say(first ? `Not run: ${first.found}` : error.message, true);
      } else {
        this.say(`The simulator broke off: ${error.message}`, true);
      }
    }
    clearTimeout(slow);
    this.bar.value = 0;
  }

  /** Times for tests: of the run alone, and until it was drawn. */
  timed(moved, ms) {
    requestAnimationFrame(() =>
      requestAnimationFrame(() => {
        const now = performance.now();
        this.times.first ??= now - this.times.begin;
        this.times.run = ms;
        if (moved) this.times.answer = now - moved;
        this.times.count = (this.times.count ?? 0) + 1;
      }),
    );
  }

  show() {
    const runs = this.kept ? [this.now.run, this.kept] : [this.now.run];
    this.view.show(runs);
  }

  stop() {
    this.wanted = false;
    this.runner.stop();
  }

  /** Keeps this run to compare the next ones with, or forgets the kept one. */
  keep() {
    this.compareWith(this.kept ? null : this.now && { ...this.now.run, label: "kept run" });
    if (this.now) this.show();
  }

  compareWith(run) {
    this.kept = run;
    this.keepButton.textContent = this.kept ? "Stop comparing" : "Compare with this";
    this.keepButton.setAttribute("aria-pressed", String(Boolean(this.kept)));
  }

  lessons() {
    const lesson = ({ title, question, runs, look, answer }) => {
      const steps = runs.map(({ say }, i) => {
        const begin = button(say, () => this.teach(runs, i));
        return element("li", {}, begin, i > 0 ? ` beside “${runs[0].say}”` : "");
      });
      return element(
        "details",
        { class: "lesson", name: "lesson" },
        element("summary", {}, title),
        element("p", {}, question),
        element("ol", {}, ...steps),
        element("p", {}, look),
        element("details", {}, element("summary", {}, "What happens"), element("p", {}, answer)),
      );
    };
    return element("div", { class: "lessons" }, ...LESSONS.map(lesson));
  }

  /** The case of a lesson, beside its first one. */
  async teach(runs, chosen) {
    const of = ({ template, set }) => {
      const { name, text } = this.templates.find((one) => one.name === template);
      return { name: `${name}.toml`, text, set, tables: {} };
    };
    const asked = (this.taught = (this.taught ?? 0) + 1);
    this.compareWith(null);
    if (chosen > 0) {
      this.say("Running the first case …");
      const { set, ...first } = of(runs[0]);
      const changes = Object.entries(set).map(([path, value]) => `${path}=${value}`);
      const { answer } = await this.checker.ask({ do: "run", case: { ...first, set: changes } });
      if (asked !== this.taught) return;
      this.compareWith({ ...readRun(answer.run), label: runs[0].say });
      this.keptSummary = answer.summary;
    }
    this.take(of(runs[chosen]));
  }

  async open(files) {
    this.file.value = "";
    const results = files.find((file) => /\.mcap$/i.test(file.name));
    if (results) {
      await this.openResults(results);
      return;
    }
    const texts = await Promise.all(files.map(async (file) => [file.name, await file.text()]));
    const isScenario = ([name]) => /\.(toml|json)$/i.test(name);
    const scenario = texts.find(isScenario);
    const tables = Object.fromEntries(texts.filter((file) => !isScenario(file)));
    if (scenario) this.take({ name: scenario[0], text: scenario[1], set: {}, tables });
    else if (files.length === 1 && !this.state.text.includes(files[0].name)) {
      await this.openRecord(files[0]);
    } else {
      Object.assign(this.state.tables, tables);
      this.changed();
    }
  }

  /** Makes a case of a recorder's table or report; asks for the side that was struck where it is open. */
  async openRecord(file, struck = []) {
    try {
      const bytes = new Uint8Array(await file.arrayBuffer());
      const request = { do: "import", name: file.name, struck };
      const { answer } = await this.checker.ask(request, () => {}, bytes);
      this.take({ ...answer.case, set: {} });
      this.notes.replaceChildren(...answer.notes.map((note) => element("li", {}, note)));
    } catch (error) {
      if (error instanceof GivenUp) return;
      this.say(error.message, true);
      if (!error.message.includes("--struck")) return;
      const sides = ["front", "rear", "left", "right"];
      const choice = sides.map((side) => button(side, () => this.openRecord(file, [side])));
      this.status.append(" Struck at the: ", ...choice);
    }
  }

  /** Takes the case of a result file, whose run is computed once more. */
  async openResults(file) {
    try {
      const bytes = new Uint8Array(await file.arrayBuffer());
      const { answer } = await this.checker.ask({ do: "open", name: file.name }, () => {}, bytes);
      const set = answer.case.set.map((change) => [
        change.slice(0, change.indexOf("=")),
        change.slice(change.indexOf("=") + 1),
      ]);
      this.opened = answer.summary;
      this.take({ ...answer.case, set: Object.fromEntries(set) });
    } catch (error) {
      if (!(error instanceof GivenUp)) this.say(error.message, true);
    }
  }

  async saveText() {
    if (this.state.set.size > 0) await this.writeChanges();
    const { name, text, set } = this.state;
    const head = [...set]
      .map(([path, value]) => `# changed in the page: --set ${path}='${value}'\n`)
      .join("");
    save(name, new Blob([head + text], { type: "application/toml" }));
  }

  saveFile(name, text) {
    save(name, new Blob([text]));
  }

  async saveResults() {
    try {
      const { bytes } = await this.checker.ask({ do: "save", case: this.case() });
      save(this.state.name.replace(/\.\w+$/, "") + ".mcap", new Blob([bytes]));
    } catch (error) {
      if (!(error instanceof GivenUp)) this.say(error.message, true);
    }
  }

  async copyLink() {
    const { name, text, set, tables } = this.state;
    const fragment = await toFragment({ name, text, set: Object.fromEntries(set), tables });
    history.replaceState(null, "", fragment);
    try {
      await navigator.clipboard.writeText(location.href);
      this.say("The link is in the clipboard and in the address line.");
    } catch {
      this.say("The link is in the address line.");
    }
  }

  say(words, isWrong = false) {
    this.status.textContent = words;
    this.status.classList.toggle("wrong", isWrong);
  }
}

/** Parts of which one is seen. */
class Tabs {
  constructor(parts) {
    const list = element("div", {
      class: "tabs",
      role: "tablist",
      "aria-label": "Ways to change the scenario",
    });
    this.tabs = parts.map(([name, content], i) => {
      const tab = element(
        "button",
        { type: "button", role: "tab", id: `tab-${i}`, "aria-controls": `part-${i}` },
        name,
      );
      const part = element(
        "div",
        { role: "tabpanel", id: `part-${i}`, "aria-labelledby": `tab-${i}` },
        content,
      );
      tab.addEventListener("click", () => this.choose(i));
      tab.addEventListener("keydown", (event) => {
        const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
        if (!by) return;
        this.choose((i + by + parts.length) % parts.length);
        this.tabs[(i + by + parts.length) % parts.length].tab.focus();
      });
      list.append(tab);
      return { tab, part };
    });
    this.root = element("div", {}, list, ...this.tabs.map(({ part }) => part));
    this.choose(0);
  }

  choose(chosen) {
    this.tabs.forEach(({ tab, part }, i) => {
      tab.setAttribute("aria-selected", String(i === chosen));
      tab.tabIndex = i === chosen ? 0 : -1;
      part.hidden = i !== chosen;
    });
  }
}

function button(word, act, title = null) {
  const made = element("button", { type: "button", title }, word);
  made.addEventListener("click", act);
  return made;
}

function save(name, blob) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function footer() {
  const text = document.getElementById("licenses").textContent;
  return element(
    "footer",
    {},
    element(
      "p",
      {},
      "Everything is computed in this page; nothing is sent anywhere. Results are those of the command occupant, to the bit. No result here is a judgement about a real car or person.",
    ),
    element(
      "details",
      {},
      element("summary", {}, "Licences of the libraries in this page"),
      element("pre", { tabindex: "0" }, text),
    ),
  );
}

const page = new Page(document.getElementById("page"));
// for scripts and tests
window.occupantPage = page;
page
  .begin(document.getElementById("module").textContent)
  .catch((error) => page.say(`The simulator does not start: ${error.message}`, true));
