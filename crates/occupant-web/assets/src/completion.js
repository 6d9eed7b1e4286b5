// Keys and values that the schema allows where the caret is.

import { element } from "../../../occupant-jobs/assets/viewer/src/dom.js";

const MOST = 40;

export class Completion {
  constructor(text, typed) {
    this.text = text;
    this.typed = typed;
    this.schema = null;
    this.offers = [];
    this.at = 0;
    this.list = element("ul", {
      class: "completion",
      role: "listbox",
      id: "completion",
      hidden: true,
    });
    text.setAttribute("aria-controls", "completion");
    text.addEventListener("keydown", (event) => this.pressed(event));
    text.addEventListener("blur", () => setTimeout(() => this.hide(), 150));
    text.addEventListener("input", () => !this.list.hidden && this.offer());
  }

  pressed(event) {
    if (event.key === " " && event.ctrlKey) {
      event.preventDefault();
      this.offer();
      return;
    }
    if (this.list.hidden) return;
    const acts = {
      ArrowDown: () => this.move(1),
      ArrowUp: () => this.move(-1),
      Enter: () => this.insert(this.offers[this.at]),
      Tab: () => this.insert(this.offers[this.at]),
      Escape: () => this.hide(),
    };
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  hide() {
    this.list.hidden = true;
    this.text.removeAttribute("aria-activedescendant");
  }

  offer() {
    if (!this.schema) return;
    const found = offers(this.schema, this.text.value, this.text.selectionStart);
    this.word = found.word;
    this.offers = found.offers.slice(0, MOST);
    if (this.offers.length === 0) {
      this.hide();
      return;
    }
    this.list.replaceChildren(...this.offers.map((offer, i) => this.item(offer, i)));
    const line = this.text.value.slice(0, this.text.selectionStart).split("\n").length;
    const height = parseFloat(getComputedStyle(this.text).lineHeight);
    const top = line * height - this.text.scrollTop + 8;
    this.list.style.top = `${Math.max(0, Math.min(top, this.text.clientHeight - 40))}px`;
    this.list.hidden = false;
    this.at = 0;
    this.move(0);
  }

  item(offer, i) {
    const item = element(
      "li",
      { role: "option", id: `offer-${i}` },
      element("b", {}, offer.name),
      element("span", {}, ` ${offer.meaning}`),
    );
    item.addEventListener("mousedown", (event) => {
      event.preventDefault();
      this.insert(offer);
    });
    return item;
  }

  move(by) {
    this.at = (this.at + by + this.offers.length) % this.offers.length;
    [...this.list.children].forEach((item, i) =>
      item.setAttribute("aria-selected", String(i === this.at)),
    );
    this.list.children[this.at].scrollIntoView({ block: "nearest" });
    this.text.setAttribute("aria-activedescendant", `offer-${this.at}`);
  }

  insert(offer) {
    const end = this.text.selectionStart;
    const start = end - this.word.length;
    this.text.setRangeText(offer.text, start, end, "end");
    this.hide();
    this.text.focus();
    this.typed();
  }
}

/** What may stand at a place of a text: `{word, offers: [{name, meaning, text}]}`. */
export function offers(schema, text, caret) {
  const before = text.slice(0, caret);
  const line = before.slice(before.lastIndexOf("\n") + 1);
  const header = /^\s*\[+([^\]]*)$/.exec(line);
  if (header) return ofHeader(schema, header[1]);
  const section = [...before.matchAll(/^\s*\[+([^\]\n]+)\]+/gm)].pop();
  const steps = section ? pathOf(section[1]) : [];
  const value = /^\s*([\w.-]+)\s*=\s*("?)([\w.-]*)$/.exec(line);
  if (value) return ofValue(schema, [...steps, ...pathOf(value[1])], value[2], value[3]);
  const key = /^\s*([\w.-]*)$/.exec(line);
  if (!key) return { word: "", offers: [] };
  const parts = key[1].split(".");
  const word = parts.pop();
  const written = writtenKeys(text, section ? section.index : 0, Boolean(section));
  return { word, offers: keysAt(schema, [...steps, ...parts], word, (name) => !written.has(name)) };
}

const pathOf = (text) => text.split(".").map((part) => part.trim().replace(/^["']|["']$/g, ""));

/** Keys that the section of a text has. */
function writtenKeys(text, start, isSection) {
  const body = text.slice(start).replace(isSection ? /^\s*\[.*\n?/ : /^/, "");
  const own = body.split(/^\s*\[/m)[0];
  return new Set([...own.matchAll(/^\s*([\w-]+)\s*=/gm)].map((match) => match[1]));
}

function ofHeader(schema, written) {
  const parts = written.split(".");
  const word = parts.pop();
  const tables = keysAt(schema, parts, word, () => true).filter((offer) => offer.isTable);
  return { word, offers: tables.map((offer) => ({ ...offer, text: offer.name })) };
}

function ofValue(schema, steps, quote, word) {
  const names = nodesAt(schema, steps).flatMap((node) => valuesOf(schema, node));
  const own = [...new Map(names.map((offer) => [offer.name, offer])).values()];
  const offers = own
    .filter((offer) => offer.name.startsWith(word))
    .map((offer) => ({ ...offer, text: offer.isText && !quote ? `"${offer.name}"` : offer.name }));
  return { word, offers };
}

function valuesOf(schema, node) {
  return forms(schema, node).flatMap((form) => {
    const meaning = form.description ?? "";
    const named = (value) => ({ name: String(value), meaning, isText: typeof value === "string" });
    if (form.const !== undefined) return [named(form.const)];
    if (form.enum) return form.enum.map(named);
    if ([form.type].flat().includes("boolean")) return [named(true), named(false)];
    return [];
  });
}

function keysAt(schema, steps, word, isFree) {
  const found = new Map();
  for (const node of nodesAt(schema, steps)) {
    for (const form of forms(schema, node)) {
      for (const [name, below] of Object.entries(form.properties ?? {})) {
        if (!name.startsWith(word) || !isFree(name) || found.has(name)) continue;
        const isTable = forms(schema, below).some((f) => f.properties || f.additionalProperties);
        const meaning = (below.description ?? "").replace(/\s+/g, " ");
        found.set(name, { name, meaning, isTable, text: `${name} = ` });
      }
    }
  }
  return [...found.values()];
}

/** The schemas of what stands at a path. */
function nodesAt(schema, steps) {
  let nodes = [schema];
  for (const step of steps.filter((s) => s !== "")) {
    nodes = nodes.flatMap((node) =>
      forms(schema, node).flatMap((form) => {
        if (form.properties?.[step]) return [form.properties[step]];
        if (typeof form.additionalProperties === "object") return [form.additionalProperties];
        return form.items
          ? forms(schema, form.items).flatMap((f) => f.properties?.[step] ?? [])
          : [];
      }),
    );
  }
  return nodes;
}

/** A schema and all that it may stand for. */
function forms(schema, node, depth = 0) {
  if (!node || depth > 6) return [];
  const more = [...(node.oneOf ?? []), ...(node.anyOf ?? []), ...(node.allOf ?? [])];
  if (node.$ref) more.push(schema.$defs?.[node.$ref.replace("#/$defs/", "")]);
  return [node, ...more.flatMap((below) => forms(schema, below, depth + 1))];
}
