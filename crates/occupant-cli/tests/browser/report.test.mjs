// The pages of `occupant report` and `occupant study report` in a real browser:
// node report.test.mjs FOLDER [SCREENSHOTS]
//
// The folder has the pages that run.sh makes: report of cart-lap-torso, judged with --verdict, comparison with --against
// cart-unbelted, two of two occupants, thrown of a pedestrian, study of scenarios/studies/screening-morris.toml, sealed of
// cart-lap-torso with a film.

import assert from "node:assert/strict";
import { mkdirSync, readFileSync, statSync } from "node:fs";
import { join, resolve } from "node:path";
import { withBrowser } from "./browser.mjs";

const [folder, pictures] = process.argv.slice(2).map((path) => resolve(path));
if (!folder) throw new Error("give the folder of the pages");
const [report, judged, comparison, two, thrown, study, sealed] = [
  "report", "judged", "comparison", "two", "thrown", "study", "sealed",
].map((name) => join(folder, `${name}.html`));
if (pictures) mkdirSync(pictures, { recursive: true });

/** A report of 0.2 s at 1 kHz, the program of the page included. */
const MOST_BYTES = 3e6;

const tests = { opens, plays, scrubs, followsKeys, followsSegments, toggles, zoomsAndOrbits, linksPlots, compares, fitsSmallScreens, isDark, isShort, tellsFirst, judgesOnlyDummies, hasTabs, separatesLabels, drawsThrows, prints, foldsStudies, verifiesItself };

const state = (page) =>
  page.evaluate(() => {
    const { clock, stage } = window.occupantReport;
    return { time: clock.time, playing: clock.playing, frames: stage.frames, camera: stage.camera.position.toArray() };
  });

/** Waits until what was changed has been drawn. */
const settled = (page) =>
  page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

async function picture(page, name) {
  await settled(page);
  if (pictures) await page.screenshot({ path: join(pictures, `${name}.png`) });
}

const seek = (page, time) => page.evaluate((t) => window.occupantReport.clock.seek(t), time);

/** Colours of the stage: how many different ones there are tells whether anything is drawn. */
async function colors(page) {
  const bytes = await page.locator("#stage canvas").screenshot();
  return new Set(bytes.toString("latin1").match(/[^]{3}/g)).size;
}

async function opens(open) {
  assert.ok(statSync(report).size < MOST_BYTES, `${statSync(report).size} bytes`);
  const page = await open(report);
  assert.match(await page.title(), /lap and torso belt/);
  assert.ok((await page.locator(".plot").count()) >= 8);
  assert.ok((await page.locator(".tables tbody tr").count()) > 30);
  assert.ok((await colors(page)) > 500, "the stage is empty");
  await picture(page, "open");
  if (pictures) await page.screenshot({ path: join(pictures, "whole.png"), fullPage: true });
  return page;
}

async function plays(open) {
  const page = await open(report);
  await page.getByLabel("Speed").selectOption("0.01");
  const before = await state(page);
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await page.waitForTimeout(3000);
  const after = await state(page);
  assert.ok(after.playing && after.time > before.time);
  const rate = (after.frames - before.frames) / 3;
  console.log(`  ${rate.toFixed(1)} frames/s in software rendering`);
  assert.ok(rate > 5, `${rate} frames/s`);
  await page.getByRole("button", { name: "Pause" }).click();
  const paused = await state(page);
  await page.waitForTimeout(300);
  assert.equal((await state(page)).time, paused.time);
  return page;
}

async function scrubs(open) {
  const page = await open(report);
  const scrub = page.getByRole("slider", { name: "Time" });
  await scrub.fill("100");
  assert.ok(Math.abs((await state(page)).time - 0.1) < 1e-9);
  assert.match(await page.locator(".time").textContent(), /100\.0 ms/);
  await picture(page, "scrubbed-100ms");
  return page;
}

async function followsKeys(open) {
  const page = await open(report);
  const press = async (key) => {
    await page.keyboard.press(key);
    return (await state(page)).time;
  };
  assert.ok(Math.abs((await press("ArrowRight")) - 0.001) < 1e-9);
  assert.ok(Math.abs((await press("Shift+ArrowRight")) - 0.011) < 1e-9);
  assert.ok(Math.abs((await press("ArrowLeft")) - 0.01) < 1e-9);
  assert.ok(Math.abs((await press("End")) - 0.2) < 1e-9);
  assert.equal(await press("Home"), 0);
  await press(" ");
  assert.ok((await state(page)).playing);
  await press(" ");
  assert.ok(!(await state(page)).playing);
  return page;
}

async function followsSegments(open) {
  const page = await open(report);
  await page.getByLabel("follow").selectOption({ label: "the head" });
  await seek(page, 0);
  const before = await state(page);
  await seek(page, 0.12);
  const after = await state(page);
  const moved = Math.hypot(...after.camera.map((c, i) => c - before.camera[i]));
  assert.ok(moved > 0.05, `the camera moved by ${moved} m`);
  await picture(page, "follow-head");
  return page;
}

async function toggles(open) {
  const page = await open(report);
  await seek(page, 0.08);
  for (const name of ["surfaces", "belts", "arrows", "trails", "labels", "spheres"]) {
    const shot = () => page.locator("#stage").screenshot();
    const before = await shot();
    await page.locator(`#show-${name}`).click();
    await picture(page, `toggle-${name}`);
    assert.ok(!before.equals(await shot()), `${name} changes nothing`);
    await page.locator(`#show-${name}`).click();
    await settled(page);
  }
  return page;
}

async function zoomsAndOrbits(open) {
  const page = await open(report);
  for (const [i, view] of ["oblique", "side", "top", "front"].entries()) {
    await page.keyboard.press(String(i + 1));
    await seek(page, 0.09);
    await picture(page, `view-${view}`);
  }
  await page.locator("#stage canvas").scrollIntoViewIfNeeded();
  const box = await page.locator("#stage canvas").boundingBox();
  const middle = [box.x + box.width / 2, box.y + box.height / 2];
  const before = await state(page);
  await page.mouse.move(...middle);
  await page.mouse.down();
  await page.mouse.move(middle[0] + 90, middle[1] + 30, { steps: 5 });
  await page.mouse.up();
  const orbited = await state(page);
  assert.notDeepEqual(orbited.camera, before.camera);
  await page.mouse.wheel(0, -400);
  await page.waitForTimeout(200);
  assert.notDeepEqual((await state(page)).camera, orbited.camera);
  await page.getByLabel("at rest").selectOption("ground");
  await seek(page, 0.05);
  await picture(page, "ground-at-rest");
  return page;
}

async function linksPlots(open) {
  const page = await open(report);
  const plot = page.locator(".plot .u-over").first();
  await plot.scrollIntoViewIfNeeded();
  const box = await plot.boundingBox();
  await page.mouse.click(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
  assert.ok(Math.abs((await state(page)).time - 0.1) < 0.005, `${(await state(page)).time}`);
  const cursor = await page.locator(".time-cursor").first().boundingBox();
  assert.ok(Math.abs(cursor.x - (box.x + 0.5 * box.width)) < 3);
  const peak = page.locator(".time-link").first();
  const text = await peak.textContent();
  await peak.click();
  assert.equal(await page.locator(".time").textContent(), text);
  return page;
}

async function compares(open) {
  const page = await open(comparison);
  await seek(page, 0.1);
  await picture(page, "compare-ghost");
  await page.locator("#other").selectOption("beside");
  await picture(page, "compare-beside");
  assert.ok((await page.locator(".legend .dashed").count()) > 5);
  assert.equal(await page.locator(".swatch.run-1").count() > 1, true);
  if (pictures) await page.screenshot({ path: join(pictures, "compare-whole.png"), fullPage: true });
  return page;
}

async function fitsSmallScreens(open) {
  for (const file of [two, thrown]) {
    for (const [width, most] of [[360, 4000], [768, 11000]]) {
      const page = await open(file, { width, height: 740 });
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(wide <= width, `${file} is ${wide} px wide`);
      // before: 19 802 px of two occupants; measured: 2900
      assert.ok((await height(page)) <= most, `${file} at ${width} px is ${await height(page)} px high`);
      const stage = await page.locator("#stage").boundingBox();
      // the scene is on the first screen
      assert.ok(stage.y < 250 && stage.y + stage.height < 740, `${stage.y} px`);
      await page.close();
    }
  }
  const page = await open(report, { width: 380, height: 700 });
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 380, `the page is ${wide} px wide`);
  await picture(page, "small");
  if (pictures) await page.screenshot({ path: join(pictures, "small-whole.png"), fullPage: true });
  return page;
}

async function isDark(open) {
  const page = await open(report, undefined, "dark");
  await seek(page, 0.08);
  await picture(page, "dark");
  return page;
}

const height = (page) => page.evaluate(() => document.documentElement.scrollHeight);

/** Pages grew to 7000 px of a run and 17 000 of a study. */
async function isShort(open) {
  for (const [file, width, most] of [[report, 1280, 3200], [report, 800, 5500], [study, 1280, 1500], [study, 800, 1800]]) {
    const page = await open(file, { width, height: 900 });
    const found = await height(page);
    assert.ok(found <= most, `${file} at ${width} px is ${found} px high`);
    await page.close();
  }
  return open(report);
}

/** A person's body gets no verdict, unless one asks for it. */
async function judgesOnlyDummies(open) {
  const page = await open(report);
  assert.equal(await page.locator(".card.failed, .card.passed, .verdict.failed, .verdict.passed").count(), 0);
  assert.match(await page.locator(".card", { hasText: "Nij" }).first().textContent(), /limit of a dummy 1.000 \(Hybrid III 50M\), FMVSS 208/);
  assert.match(await page.locator(".tables").textContent(), /700.0 of a dummy/);
  assert.ok(!/failed|passed|EXCEEDED/.test(await page.locator(".verdicts, .tables table").first().textContent()));
  assert.match(await page.locator(".impact").textContent(), /^Frontal impact: delta-v of the vehicle .*struck 0°/);
  return page;
}

async function hasTabs(open) {
  const page = await open(two);
  const [driver, passenger] = [page.getByRole("tab", { name: "driver" }), page.getByRole("tab", { name: "passenger" })];
  const seen = async () => {
    const names = await page.locator("[data-occupant]:visible").evaluateAll((all) => all.map((one) => one.dataset.occupant));
    return [...new Set(names)];
  };
  assert.deepEqual(await seen(), ["driver"]);
  assert.equal(await driver.getAttribute("aria-selected"), "true");
  const panels = (await driver.getAttribute("aria-controls")).split(" ");
  assert.equal(panels.length, 2);
  for (const id of panels) assert.equal(await page.locator(`#${id}`).getAttribute("role"), "tabpanel");
  const before = (await state(page)).time;
  await driver.focus();
  await page.keyboard.press("ArrowRight");
  assert.deepEqual(await seen(), ["passenger"]);
  assert.ok(await passenger.evaluate((tab) => tab === document.activeElement && tab.tabIndex === 0));
  assert.equal((await state(page)).time, before, "the arrow moved the time");
  // plots that come to be seen are as wide as their place
  const [canvas, place] = [page.locator(".plot:visible .uplot").first(), page.locator(".plot:visible .canvas").first()];
  await settled(page);
  assert.ok(Math.abs((await canvas.boundingBox()).width - (await place.boundingBox()).width) < 2);
  for (const [key, expected] of [["ArrowRight", "driver"], ["ArrowLeft", "passenger"], ["Home", "driver"], ["End", "passenger"]]) {
    await page.keyboard.press(key);
    assert.deepEqual(await seen(), [expected], key);
  }
  // the rows of the one are not those of the other, and do not repeat the name
  const names = await page.locator("#measures-passenger th[scope=row]").allTextContents();
  assert.ok(names.includes("HIC15") && names.every((name) => !name.startsWith("driver.")));
  await driver.click();
  assert.deepEqual(await seen(), ["driver"]);
  assert.match(await page.locator(".impact").textContent(), /^Side impact from the left: delta-v/);
  // no rule of a frontal test judges a side impact
  assert.ok(!/FMVSS 208|UN R94|UN R137/.test(await page.locator(".verdicts, .tables .groups").allTextContents().then((t) => t.join())));
  await picture(page, "tabs");
  return page;
}

async function separatesLabels(open) {
  const page = await open(two, { width: 360, height: 740 });
  await page.locator("#show-labels").click();
  await seek(page, 0.07);
  await settled(page);
  const boxes = await page.locator(".label:visible").evaluateAll((all) =>
    all.map((one) => [one.textContent, one.getBoundingClientRect()]).map(([text, { left, right, top, bottom }]) => ({ text, left, right, top, bottom })),
  );
  assert.ok(boxes.length > 3, `${boxes.length} labels`);
  for (const [i, a] of boxes.entries()) {
    for (const b of boxes.slice(i + 1)) {
      const [x, y] = [Math.min(a.right, b.right) - Math.max(a.left, b.left), Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top)];
      assert.ok(x < 1 || y < 1, `${a.text} covers ${b.text}`);
    }
  }
  await picture(page, "labels");
  return page;
}

/** The plan is to scale, and Searle's bounds stand beside the throw. */
async function drawsThrows(open) {
  const page = await open(thrown);
  const row = (name) => page.locator(".tables tr", { has: page.getByRole("rowheader", { name, exact: true }) }).locator("td").first();
  const number = async (name) => Number((await row(name).textContent()).match(/[\d.]+/)[0]);
  const [slow, fast] = [await number("Searle, least speed"), await number("Searle, greatest speed")];
  assert.ok(slow > 3 && slow < fast, `${slow} to ${fast}`);
  const drawn = await page.locator(".plan").evaluate((svg) => {
    const places = [...svg.querySelectorAll(".place")].map((one) => [one.cx.baseVal.value, one.cy.baseVal.value]);
    const [left, right] = svg.querySelector(".ruler").getAttribute("d").match(/M(\d+).*H([\d.]+)/).slice(1).map(Number);
    return { first: places[0], last: places.at(-1), ruler: right - left, texts: [...svg.querySelectorAll("text")].map((one) => one.textContent) };
  });
  const metres = Number(drawn.texts.at(-1).match(/^[\d.]+/)[0]);
  const gone = (Math.hypot(drawn.last[0] - drawn.first[0], drawn.last[1] - drawn.first[1]) * metres) / drawn.ruler;
  const distance = (await number("throw distance")) / ((await row("throw distance").textContent()).includes("mm") ? 1e3 : 1);
  // measured: 0.03 %
  assert.ok(Math.abs(gone / distance - 1) < 0.01, `${gone} m in plan, ${distance} m in the table`);
  const fold = page.locator("details", { has: page.getByRole("heading", { name: "Contacts with the ground" }) });
  await fold.locator("summary").click();
  const rows = await fold.locator("tbody tr").allTextContents();
  assert.ok(rows.length > 5 && rows.length <= 60 && rows.some((text) => /ms.*head.*ground.*m.*m\/s/.test(text)), rows.join("\n"));
  await picture(page, "plan");
  return page;
}

/** On paper: all tabs, pictures of the motion, light colours, no empty page. */
async function prints(open) {
  const page = await open(two, undefined, "dark");
  const bytes = (await page.pdf({ preferCSSPageSize: true, printBackground: true })).toString("latin1");
  const sheets = bytes.match(/\/Type \/Page\b/g).length;
  console.log(`  ${sheets} pages`);
  // measured: 14
  assert.ok(sheets >= 6 && sheets <= 22, `${sheets} pages`);
  assert.match(bytes, /\/Type \/Catalog/);
  // afterwards the page is as it was
  assert.equal(await page.locator(".strip canvas").count(), 0);
  assert.ok(!(await page.evaluate(() => document.documentElement.classList.contains("paper"))));
  await page.emulateMedia({ media: "print", colorScheme: "dark" });
  await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
  const found = await page.evaluate(() => {
    const hues = [...document.querySelectorAll(".strip canvas")].map((one) => {
      const { data } = one.getContext("2d").getImageData(0, 0, one.width, one.height);
      return new Set(new Uint32Array(data.buffer)).size;
    });
    const style = (name) => getComputedStyle(document.querySelector(name));
    return { hues, ground: style("body").backgroundColor, cut: [style(".plot"), style("tr"), style(".card")].map((one) => one.breakInside), closed: document.querySelectorAll("#report .group:not([open])").length, heading: style("h3").breakAfter };
  });
  assert.ok(found.hues.length === 6 && found.hues.every((count) => count > 100), `${found.hues}`);
  assert.deepEqual([found.ground, found.closed, found.heading], ["rgb(255, 255, 255)", 0, "avoid"]);
  assert.deepEqual(found.cut, ["avoid", "avoid", "avoid"]);
  for (const name of ["driver", "passenger"]) assert.ok(await page.locator(`#measures-${name}`).isVisible(), name);
  assert.ok(!(await page.locator(".occupants").isVisible()) && !(await page.locator("#stage").isVisible()));
  await picture(page, "print");
  await page.evaluate(() => window.dispatchEvent(new Event("afterprint")));
  await page.emulateMedia({ media: "screen" });
  return page;
}

async function tellsFirst(open) {
  const page = await open(judged);
  const place = async (what) => (await page.locator(what).first().boundingBox()).y;
  const places = [await place("h1"), await place("#stage"), await place(".verdicts"), await place(".caveats")];
  assert.deepEqual(places, [...places].sort((a, b) => a - b));
  assert.match(await page.locator(".card.failed").first().textContent(), /Nij.*failed, ≤ 1/);
  // a mark leads to its caveat
  const mark = page.locator(".card .mark").first();
  const caveat = page.locator(await mark.getAttribute("href"));
  assert.match(await caveat.textContent(), /neck/);
  // no column without a value, no empty half of the page
  for (const table of await page.locator(".tables table").all()) {
    const empty = await table.evaluate((node) => {
      const rows = [...node.tBodies[0].rows].filter((row) => row.cells.length > 1);
      return [...Array(rows[0].cells.length).keys()].filter((i) => rows.every((row) => !row.cells[i].textContent));
    });
    assert.deepEqual(empty, []);
  }
  const [scene, plots] = [await page.locator(".scene").boundingBox(), await page.locator(".plots").boundingBox()];
  assert.ok(Math.abs(scene.height - plots.height) < 2, `${scene.height} and ${plots.height} px`);
  assert.ok(!/Steps rejected/.test(await page.locator(".tables").textContent()));
  return page;
}

async function foldsStudies(open) {
  const page = await open(study);
  const section = page.locator("section#r0");
  assert.ok(!(await section.isVisible()));
  // several tables of the page lead to a response
  await page.locator("a[href='#r0']").first().click();
  assert.ok(await section.isVisible(), "the link does not unfold its section");
  await picture(page, "study");
  return page;
}

async function verifiesItself(open) {
  const page = await open(sealed);
  const bytes = readFileSync(sealed);
  const answer = async (buffer) => {
    await page.locator("#seal-answer").evaluate((node) => (node.textContent = ""));
    await page.locator("#seal-file").setInputFiles({ name: "case.html", mimeType: "text/html", buffer });
    await page.waitForFunction(() => document.getElementById("seal-answer").textContent);
    return page.locator("#seal-answer").textContent();
  };
  assert.match(await answer(bytes), /^Every byte is as sealed\.\nSHA-256 of the file: [0-9a-f]{64}$/);
  for (const at of [0, bytes.length >> 1, bytes.length - 200, bytes.length - 1]) {
    const altered = Buffer.from(bytes);
    altered[at] ^= 1;
    assert.match(await answer(altered), /^ALTERED: /, `byte ${at}`);
  }
  assert.match(await answer(Buffer.from("nothing of the sort")), /^ALTERED/);
  // what was added is shown, and the page is no wider than a phone
  assert.ok(await page.locator("img[alt='an added picture']").evaluate((image) => image.naturalWidth > 100));
  await page.setViewportSize({ width: 360, height: 740 });
  await settled(page);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 360, `${wide} px`);
  if (pictures) await page.locator("#sealed").screenshot({ path: join(pictures, "sealed-360.png") });
  await page.setViewportSize({ width: 1280, height: 800 });
  if (pictures) await page.locator("#sealed").screenshot({ path: join(pictures, "sealed.png") });
  return page;
}

await withBrowser(async (open) => {
  for (const [name, test] of Object.entries(tests)) {
    console.log(name);
    const page = await test(open);
    assert.deepEqual(page.complaints, [], "the console is not silent");
    assert.deepEqual(page.requests.filter((url) => !/^(file|blob|data):/.test(url)), []);
    await page.close();
  }
});
