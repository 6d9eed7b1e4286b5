// Puts the parts into the page: node assemble.mjs PAGE.html OUTPUT.html NAME=FILE...
// Each {{name}} is replaced once; parts are not searched. No part may end its element.

import { readFileSync, writeFileSync } from "node:fs";

const [page, output, ...named] = process.argv.slice(2);
const parts = new Map(
  named.map((pair) => [
    pair.split("=")[0],
    readFileSync(pair.slice(pair.indexOf("=") + 1), "utf8").trimEnd(),
  ]),
);
for (const [name, part] of parts) {
  if (/<\/(script|style)|<!--/i.test(part)) throw new Error(`${name} would end its element`);
}
const whole = readFileSync(page, "utf8").replace(/\{\{(\w+)\}\}/g, (_, name) => parts.get(name));
writeFileSync(output, whole);
