// The frame of the page on elements that keep their texts: what nobody sees in a browser that a machine lacks.
// node --test page.test.mjs

import assert from "node:assert/strict";
import { test } from "node:test";

/** An element that turns what is no element into a text, as a browser does. */
class Node {
  constructor(name) {
    this.name = name;
    this.children = [];
  }
  setAttribute() {}
  append(...children) {
    this.children.push(...children.map((child) => (child instanceof Node ? child : String(child))));
  }
  texts() {
    return this.children.flatMap((child) => (child instanceof Node ? child.texts() : [child]));
  }
}
globalThis.document = {
  createElement: (name) => new Node(name),
  getElementById: () => ({ textContent: "licences" }),
};

const { buildPage } = await import("../../../occupant-jobs/assets/viewer/src/page.js");

const run = (label, caveats) => ({
  label,
  title: `Title of ${label}`,
  facts: "facts",
  notes: [],
  caveats,
  measures: [],
  impacts: [],
  occupants: [],
});

test("a run without caveats leaves no word behind", () => {
  for (const runs of [[run("a", [])], [run("a", []), run("b", ["bent"]), run("c", [])]]) {
    const root = new Node("div");
    buildPage(root, { program: "occupant", runs });
    assert.ok(!root.texts().includes("null"), root.texts().join("|"));
    assert.equal(root.texts().filter((text) => text.includes("Caveats")).length, runs.length > 1 ? 1 : 0);
    for (const { label } of runs.slice(1)) assert.ok(root.texts().some((text) => text.includes(`against ${label}`)));
  }
});
