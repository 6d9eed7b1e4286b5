// The pages of `occupant report` and `occupant study report` in a real browser:
// node report.test.mjs REPORT.html COMPARISON.html STUDY.html [SCREENSHOTS]
//
// REPORT.html is a report of scenarios/cart-lap-torso.toml, COMPARISON.html one with --against cart-unbelted, STUDY.html one of
// scenarios/studies/screening-morris.toml.

import assert from "node:assert/strict";
import { mkdirSync, statSync } from "node:fs";
import { join, resolve } from "node:path";
import { withBrowser } from "./browser.mjs";

const [report, comparison, study, pictures] = process.argv.slice(2).map((path) => resolve(path));
if (!report || !comparison || !study) throw new Error("give REPORT.html, COMPARISON.html and STUDY.html");
if (pictures) mkdirSync(pictures, { recursive: true });

/** A report of 0.2 s at 1 kHz, the program of the page included. */
const MOST_BYTES = 3e6;

const tests = { opens, plays, scrubs, followsKeys, followsSegments, toggles, zoomsAndOrbits, linksPlots, compares, fitsSmallScreens, isDark, isShort, tellsFirst, foldsStudies };

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

async function tellsFirst(open) {
  const page = await open(report);
  const place = async (what) => (await page.locator(what).first().boundingBox()).y;
  const places = [await place("h1"), await place(".verdicts"), await place(".caveats"), await place("#stage")];
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

await withBrowser(async (open) => {
  for (const [name, test] of Object.entries(tests)) {
    console.log(name);
    const page = await test(open);
    assert.deepEqual(page.complaints, [], "the console is not silent");
    assert.deepEqual(page.requests.filter((url) => !/^(file|blob|data):/.test(url)), []);
    await page.close();
  }
});
