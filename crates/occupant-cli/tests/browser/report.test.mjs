// The pages of `occupant report` and `occupant study report` in a real browser:
// node report.test.mjs FOLDER [SCREENSHOTS]
//
// The folder has the pages that run.sh makes: report of cart-lap-torso, judged with --verdict, comparison with --against
// cart-unbelted, two of two occupants, thrown of a pedestrian, driven of two cars, study of scenarios/studies/screening-morris.toml, sealed of
// cart-lap-torso with a film.

import assert from "node:assert/strict";
import { mkdirSync, readFileSync, statSync } from "node:fs";
import { join, resolve } from "node:path";
import { withBrowser } from "./browser.mjs";

const [folder, pictures] = process.argv.slice(2).map((path) => resolve(path));
if (!folder) throw new Error("give the folder of the pages");
const [report, judged, comparison, two, thrown, driven, study, sealed] = [
  "report", "judged", "comparison", "two", "thrown", "driven", "study", "sealed",
].map((name) => join(folder, `${name}.html`));
if (pictures) mkdirSync(pictures, { recursive: true });

/** A report of 0.2 s at 1 kHz, the program of the page included. */
const MOST_BYTES = 3e6;

const tests = { opens, plays, scrubs, followsKeys, followsSegments, toggles, zoomsAndOrbits, linksPlots, compares, fitsSmallScreens, isDark, isShort, tellsFirst, judgesOnlyDummies, hasTabs, separatesLabels, drawsThrows, prints, foldsStudies, verifiesItself, hasCameras, stands, choosesCameras, seesOtherCars, films, recordsFilms, saysWhyNoFilm };

const state = (page) =>
  page.evaluate(() => {
    const { clock, stage } = window.occupantReport;
    stage.camera.updateWorldMatrix(true, false);
    const camera = [...stage.camera.matrixWorld.elements.slice(12, 15)];
    return { time: clock.time, playing: clock.playing, frames: stage.frames, camera };
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
      const right = await page.locator(".controls *").evaluateAll((all) => Math.max(...all.map((one) => one.getBoundingClientRect().right)));
      assert.ok(right <= width, `controls of ${file} reach ${right} px`);
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

const CAMERAS = ["vehicle", "ground", "chase", "driver"];

const chooses = async (page, camera) => {
  await page.getByRole("combobox", { name: "Camera" }).selectOption(camera);
  await settled(page);
};

const add = (...all) => [0, 1, 2].map((i) => all.reduce((sum, v) => sum + v[i], 0));
const times = (v, by) => v.map((x) => x * by);
const minus = (a, b) => add(a, times(b, -1));
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (v) => Math.hypot(...v);
const unit = (v) => times(v, 1 / length(v));
const mean = (all) => times(add(...all), 1 / all.length);
const apart = (a, b) => length(minus(a, b));

/** Turns a vector by a quaternion x, y, z, w. */
const turned = ([x, y, z, w], v) => {
  const t = times(cross([x, y, z], v), 2);
  return add(v, times(t, w), cross([x, y, z], t));
};
const placed = (pose, v) => add(turned(pose.slice(3), v), pose.slice(0, 3));

/**
 * The first run at an output: spheres [place, radius] in vehicle axes, head pose, vehicle in vehicle-space, and the camera of the
 * page in vehicle axes.
 */
const moment = async (page, index) => {
  await page.evaluate((i) => window.occupantReport.clock.seek(window.occupantReport.runs[0].times[i]), index);
  await settled(page);
  const found = await page.evaluate((i) => {
    const { stage, runs } = window.occupantReport;
    const [run] = runs;
    const pose = (all, count, item) => [...all.slice((i * count + item) * 7, (i * count + item + 1) * 7)];
    const poses = run.segments.map((_, segment) => pose(run.poses, run.segments.length, segment));
    const carried = (sphere) => {
      const rider = run.ridden.indexOf(sphere);
      const from = (i * run.ridden.length + rider) * 3;
      return rider < 0 ? [0, 0, 0] : [...run.carried.slice(from, from + 3)];
    };
    const camera = stage.camera.clone();
    stage.camera.updateWorldMatrix(true, false);
    const inCar = stage.actors[0].car.matrixWorld.clone().invert().multiply(stage.camera.matrixWorld);
    const e = [...inCar.elements];
    return {
      poses,
      spheres: run.spheres.map(({ name, segment, centre, radius }, s) => ({ name, segment, radius, centre, carried: carried(s) })),
      // exteriors of the own vehicle, and of others
      plates: run.surfaces.filter((surface) => surface.outside).flatMap(({ corners }) => corners.map((at) => ({ at }))),
      lines: run.belts.filter(({ name }) => name.endsWith("outside")).flatMap(({ points, count }) =>
        Array.from({ length: count }, (_, n) => ({ at: [...points.slice(3 * (i * count + n), 3 * (i * count + n + 1))] })),
      ),
      vehicle: pose(run.vehicle, 1, 0),
      heads: run.occupants.map((one) => one.head),
      eye: e.slice(12, 15),
      up: e.slice(4, 7),
      ahead: e.slice(8, 11).map((x) => -x),
      fov: (camera.fov * Math.PI) / 180,
      aspect: camera.aspect,
      isHeadSeen: run.occupants.map((one) => stage.actors[0].figure.meshes[one.head].visible),
    };
  }, index);
  for (const corner of [...found.plates, ...found.lines]) corner.radius = 0;
  for (const sphere of found.spheres) sphere.at = placed(found.poses[sphere.segment], add(sphere.centre, sphere.carried));
  return found;
};

/** Where a place in vehicle axes is in the picture: right and up in halves of it, and how far before the eye. */
const seen = ({ eye, up, ahead, fov, aspect }, at) => {
  const [off, right] = [minus(at, eye), cross(ahead, up)];
  const [deep, slope] = [dot(off, ahead), Math.tan(fov / 2)];
  return { x: dot(off, right) / deep / slope / aspect, y: dot(off, up) / deep / slope, deep };
};
const isSeen = (view, { at }) => {
  const { x, y, deep } = seen(view, at);
  return deep > 0.05 && Math.abs(x) < 1 && Math.abs(y) < 1;
};

const outputs = (page) => page.evaluate(() => window.occupantReport.runs[0].times.length);
/** Outputs that fitted cameras look at. */
const lookedAt = (count) => [...Array(count).keys()].filter((i) => i % Math.ceil(count / 60) === 0);
const close = (found, expected, most, what) => assert.ok(apart(found, expected) < most, `${what}: ${found} instead of ${expected}`);

/** The numbers of `occupant view --3d`, computed from poses by the definitions. Measured differences: up to 4e-9 m. */
async function stands(open) {
  for (const file of [report, two, thrown, driven]) {
    const page = await open(file);
    const count = await outputs(page);
    if (file === driven) {
      const { plates, lines } = await moment(page, 0);
      assert.ok(plates.length > 50 && lines.length > 50, `${plates.length} and ${lines.length} corners of exteriors`);
    }
    const some = [0, 0.3, 0.5, 0.8, 1].map((share) => Math.round(share * (count - 1)));
    for (const camera of CAMERAS) {
      await chooses(page, camera);
      // narrower than 3 to 2: what is beside stays, more is seen above and below
      const { fov, aspect } = await moment(page, 0);
      const height = 2 * Math.atan(Math.tan((camera === "driver" ? 1.25 : 0.56) / 2) * Math.max(1, 1.5 / aspect));
      assert.ok(Math.abs(fov - height) < 1e-9, `${camera}: ${fov} rad`);
    }
    // rides with the car: its place does not change, and the tightest of those near has 76 % of a picture of 3 to 2
    const looked = lookedAt(count);
    const share = (view, sphere) => {
      const right = cross(view.ahead, view.up);
      const [off, slope] = [minus(sphere.at, view.eye), Math.tan(0.28) * dot(minus(sphere.at, view.eye), view.ahead)];
      return Math.max((Math.abs(dot(off, right)) + sphere.radius) / 1.5, Math.abs(dot(off, view.up)) + sphere.radius) / slope;
    };
    for (const camera of ["vehicle", "ground"]) {
      await chooses(page, camera);
      const views = [];
      for (const i of looked) views.push(await moment(page, i));
      const first = views[0].spheres.filter((sphere) => apart(sphere.at, views[0].spheres[0].at) < 1.6);
      const middle = mean(first.map((sphere) => sphere.at));
      const all = (view) =>
        camera === "ground"
          ? [...view.spheres, ...view.plates, ...view.lines]
          : view.spheres.filter((sphere) => apart(sphere.at, middle) < 1.6);
      const shares = views.flatMap((view) => all(view).map((one) => share(view, one)));
      assert.ok(Math.abs(Math.max(...shares) - 0.76) < 1e-6, `${file}, ${camera}: ${Math.max(...shares)}`);
      const way = camera === "vehicle" ? (view, v) => v : (view, v) => turned(view.vehicle.slice(3), v);
      const back = camera === "vehicle" ? [1, 1.05, -0.42] : [0.35, 1, -0.55];
      const stand = camera === "vehicle" ? (view) => view.eye : (view) => placed(view.vehicle, view.eye);
      for (const view of views) {
        close(stand(view), stand(views[0]), 1e-6, `${camera} moves`);
        close(way(view, view.ahead), times(unit(back), -1), 1e-7, `${camera} looks`);
      }
      // the middle of all that is seen is on the axis
      const ends = (i, sign) => {
        const places = views.flatMap((view) => all(view).map(({ at, radius }) => [camera === "vehicle" ? at : placed(view.vehicle, at), radius]));
        return sign * Math.max(...places.map(([place, radius]) => sign * place[i] + radius));
      };
      const target = [0, 1, 2].map((i) => (ends(i, 1) + ends(i, -1)) / 2);
      const off = minus(target, stand(views[0]));
      assert.ok(length(cross(off, unit(back))) < 1e-6, `${file}, ${camera}: ${target} is not in the middle`);
    }
    await chooses(page, "chase");
    for (const i of some) {
      const view = await moment(page, i);
      const near = view.spheres.filter((sphere) => apart(sphere.at, view.spheres[0].at) < 1.6);
      const middle = placed(view.vehicle, mean(near.map((sphere) => sphere.at)));
      const ahead = unit([...turned(view.vehicle.slice(3), [1, 0, 0]).slice(0, 2), 0]);
      // right and up of vehicle-space, whose Z is down
      const right = cross([0, 0, 1], ahead);
      const eye = add(middle, times(ahead, -6), times(right, 2.2), [0, 0, -2]);
      close(placed(view.vehicle, view.eye), eye, 1e-6, "chase stands");
      close(turned(view.vehicle.slice(3), view.ahead), unit(minus(add(middle, times(ahead, 0.5)), eye)), 1e-7, "chase looks");
      assert.ok(Math.abs(turned(view.vehicle.slice(3), cross(view.ahead, view.up))[2]) < 1e-6, "chase is not level");
    }
    await chooses(page, "driver");
    for (const i of some) {
      const view = await moment(page, i);
      const pose = view.poses[view.heads[0]];
      const skull = view.spheres.find((sphere) => sphere.segment === view.heads[0]);
      close(view.eye, placed(pose, add(skull.centre, [0.9 * skull.radius, 0, 0])), 1e-7, "the eye");
      close(view.ahead, turned(pose.slice(3), unit([1, 0, -0.12])), 1e-7, "the eye looks");
      const up = turned(pose.slice(3), [0, 0, 1]);
      assert.ok(dot(view.up, up) > 0.99 && Math.abs(dot(cross(view.ahead, view.up), up)) < 1e-7, `up of the eye ${view.up}`);
      assert.deepEqual(view.isHeadSeen, view.heads.map((_, body) => body > 0));
    }
    await chooses(page, "chase");
    assert.ok((await moment(page, 0)).isHeadSeen.every((is) => is));
    await page.close();
  }
  return open(report);
}

/** Everybody is in the picture of every camera: by projection, and by the pixels that change without them. */
async function hasCameras(open) {
  for (const file of [report, judged, comparison, two, thrown, driven, sealed]) {
    for (const width of [1280, 360]) {
      const page = await open(file, { width, height: 740 });
      const count = await outputs(page);
      for (const camera of CAMERAS) {
        await chooses(page, camera);
        const { spheres } = await moment(page, 0);
        const middle = mean(spheres.filter((sphere) => apart(sphere.at, spheres[0].at) < 1.6).map((sphere) => sphere.at));
        const parts = [];
        for (const share of [0, 0.25, 0.5, 0.75, 1]) {
          const view = await moment(page, Math.round(share * (count - 1)));
          const first = view.spheres.filter((sphere) => apart(sphere.at, view.spheres[0].at) < 1.6);
          // a camera in the car lets go of those who leave it
          const stay = view.spheres.filter((sphere) => apart(sphere.at, middle) < 1.6);
          const own = { vehicle: stay, ground: view.spheres, chase: first, driver: [] }[camera];
          for (const sphere of own) assert.ok(isSeen(view, sphere), `${file}, ${camera}: ${sphere.name} is out of the picture at ${share}`);
          parts.push(view.spheres.filter((sphere) => isSeen(view, sphere)).length);
        }
        // what an eye sees of its own body: nothing of it while it looks ahead
        if (camera === "driver") {
          if (![two, thrown].includes(file)) assert.ok(Math.max(...parts) > 3, `${file}: the occupant sees ${parts} of his spheres`);
          if (file === two) continue;
        }
        const index = Math.round((camera === "driver" ? (file === thrown ? 0.75 : 0.5) : 0.1) * (count - 1));
        await moment(page, index);
        const shot = () => page.locator("#stage").screenshot();
        const before = await shot();
        const isShown = (is) => page.evaluate((is) => {
          window.occupantReport.stage.actors[0].figure.group.visible = is;
          window.occupantReport.stage.draw();
        }, is);
        await isShown(false);
        await settled(page);
        assert.ok(!before.equals(await shot()), `${file}, ${camera}: nothing is seen of the occupant`);
        await isShown(true);
        if (width > 1000) await picture(page, `camera-${camera}-${file.match(/(\w+)\.html/)[1]}`);
      }
      assert.deepEqual(page.complaints, []);
      await page.close();
    }
  }
  return open(report);
}

/** By select and keys; by hand from there on; back; of the chosen occupant. */
async function choosesCameras(open) {
  const page = await open(two);
  const select = page.getByRole("combobox", { name: "Camera" });
  const chosen = () => page.evaluate(() => window.occupantReport.stage.eye.preset);
  const others = [page.getByLabel("follow"), page.getByLabel("at rest")];
  for (const [i, name] of ["oblique", "side", "top", "front", ...CAMERAS].entries()) {
    await page.locator("#stage").click({ position: { x: 3, y: 3 } });
    await page.keyboard.press(String(i + 1));
    assert.deepEqual([await chosen(), await select.inputValue()], [name, name]);
    for (const other of others) assert.equal(await other.isDisabled(), i > 3);
  }
  await select.focus();
  await page.keyboard.press("ArrowUp");
  assert.equal(await chosen(), "chase");
  // the occupant whose tab is open
  const eye = async () => (await moment(page, 40)).eye;
  const headOf = async (body) => (await moment(page, 40)).spheres.find((sphere) => sphere.name === `${body}.head`);
  await chooses(page, "driver");
  for (const name of ["driver", "passenger"]) {
    await page.getByRole("tab", { name }).click();
    const head = await headOf(name);
    assert.ok(Math.abs(apart(await eye(), head.at) - 0.9 * head.radius) < 1e-5, `the eye of the ${name}`);
  }
  await page.getByRole("tab", { name: "driver" }).click();
  // a drag goes on from the camera, which rides on as before
  for (const camera of CAMERAS) {
    await chooses(page, camera);
    const before = await moment(page, 20);
    await page.locator("#stage canvas").scrollIntoViewIfNeeded();
    const box = await page.locator("#stage canvas").boundingBox();
    const at = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(...at);
    await page.mouse.down();
    await page.mouse.move(at[0] + 60, at[1] + 25, { steps: 4 });
    await page.mouse.up();
    await page.mouse.wheel(0, -200);
    await page.waitForTimeout(100);
    const after = await moment(page, 20);
    const angle = Math.acos(dot(before.ahead, after.ahead));
    assert.ok(angle > 0.1 && angle < 1.2, `${camera}: turned by ${angle} rad`);
    // upright as before: no leap
    assert.ok(dot(before.up, after.up) > 0.7, `${camera} toppled`);
    const local = () => page.evaluate(() => window.occupantReport.stage.camera.position.toArray());
    const [one, where] = [await local(), (await moment(page, 20)).eye];
    const later = (await moment(page, 70)).eye;
    assert.deepEqual(await local(), one);
    if (camera === "vehicle") close(later, where, 1e-5, "a camera in the car moved");
    else assert.ok(apart(later, where) > 1e-3, `${camera} does not ride on`);
    await page.getByRole("button", { name: "Reset" }).click();
    const back = await moment(page, 20);
    close(back.eye, before.eye, 1e-5, `${camera} is not back`);
    close(back.ahead, before.ahead, 1e-5, `${camera} does not look back`);
  }
  // views follow as before
  await select.selectOption("oblique");
  await page.getByLabel("follow").selectOption({ label: "nothing" });
  assert.equal(await others[0].isDisabled(), false);
  return page;
}

/** The exterior of another car is an outline. */
async function seesOtherCars(open) {
  const page = await open(driven);
  await chooses(page, "ground");
  const shot = () => page.locator("#stage").screenshot();
  const before = await shot();
  const lines = await page.evaluate(() => {
    const { runs, stage } = window.occupantReport;
    const own = stage.actors[0].belts.ribbons.filter((_, i) => runs[0].belts[i].name === "suv outside");
    own.flatMap((one) => one.meshes).forEach((mesh) => (mesh.visible = false));
    stage.draw();
    return own.length;
  });
  await settled(page);
  assert.ok(lines > 5, `${lines} outlines`);
  assert.ok(!before.equals(await shot()), "the other car is not seen");
  return page;
}

/** The file of a film in a page of its own. */
async function played(page, download, shown) {
  const name = `film-${shown}.${download.suggestedFilename().split(".").pop()}`;
  await download.saveAs(join(folder, name));
  if (pictures) await download.saveAs(join(pictures, name));
  const player = await page.context().newPage();
  const bytes = readFileSync(join(folder, name)).toString("base64");
  const found = await player.evaluate(async (bytes) => {
    const video = document.createElement("video");
    video.muted = true;
    video.src = URL.createObjectURL(await (await fetch(`data:video/mp4;base64,${bytes}`)).blob());
    const heard = (what) => new Promise((done, failed) => {
      video.addEventListener(what, done, { once: true });
      video.addEventListener("error", () => failed(new Error(video.error.message)), { once: true });
    });
    if (video.readyState < 2) await heard("loadeddata");
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [160, 90];
    const context = canvas.getContext("2d", { willReadFrequently: true });
    const frames = [];
    for (const share of [0, 0.5, 0.98]) {
      // the middle of a picture
      video.currentTime = Math.floor(share * video.duration * 25) / 25 + 0.02;
      await heard("seeked");
      context.drawImage(video, 0, 0, 160, 90);
      frames.push([...context.getImageData(0, 0, 160, 90).data]);
    }
    return { seconds: video.duration, size: [video.videoWidth, video.videoHeight], frames };
  }, bytes);
  await player.close();
  return found;
}

const difference = (a, b) => a.reduce((sum, value, i) => sum + Math.abs(value - b[i]), 0) / a.length;

/** Presses a button and waits for its file. */
const file = async (page, button) => {
  const [download] = await Promise.all([page.waitForEvent("download", { timeout: 60000 }), page.getByRole("button", { name: button }).click()]);
  return download;
};

/** Keeps all texts that are written on pictures. */
const overhear = (page) =>
  page.evaluate(() => {
    window.written = [];
    const { fillText } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...rest) {
      window.written.push(text);
      return fillText.call(this, text, ...rest);
    };
  });

/** As many pictures as the run and the speed give, with their words; H.264 and VP9. */
async function films(open) {
  for (const codec of ["avc1", "vp09"]) {
    const page = await open(report, undefined, codec === "avc1" ? "light" : "dark");
    await page.evaluate((codec) => {
      const asked = VideoEncoder.isConfigSupported.bind(VideoEncoder);
      VideoEncoder.isConfigSupported = async (config) => (config.codec.startsWith(codec) ? asked(config) : { supported: false });
    }, codec);
    await chooses(page, "vehicle");
    await page.getByLabel("Speed").selectOption("0.1");
    await seek(page, 0.03);
    await overhear(page);
    const canvas = () => page.evaluate(() => [window.occupantReport.stage.canvas.width, window.occupantReport.stage.canvas.height]);
    const before = await canvas();
    const download = await file(page, "Save film");
    assert.equal(download.suggestedFilename(), "cart-lap-torso-vehicle.mp4");
    assert.match(await page.locator(".film output").textContent(), /^Saved cart-lap-torso-vehicle.mp4, 2.04 s, 0.\d+ MB$/);
    const written = await page.evaluate(() => [...new Set(window.written)]);
    // each 4 ms of the run, at a tenth of real time 25 a second
    const clocks = written.filter((text) => /^\d+\.\d ms$/.test(text));
    assert.deepEqual(clocks, [...Array(51).keys()].map((i) => `${(4 * i).toFixed(1)} ms`));
    const whole = written.join("\n");
    for (const words of [/^Cart, 20 mph, lap and torso belt$/m, /^camera fixed to the vehicle · 10 times slower than real time$/m, /^cart-lap-torso.mcap \(SHA-256 [0-9a-f]{12}…\), run by occupant \d/m, /^Caveat: neck beyond its stop/m]) assert.match(whole, words);
    const film = await played(page, download, codec);
    assert.deepEqual(film.size, [1280, 720]);
    assert.ok(Math.abs(film.seconds - 51 / 25) < 1e-6, `${film.seconds} s`);
    // the film moves, and in its middle is the picture that the page gives of that time
    assert.ok(difference(film.frames[0], film.frames[1]) > 1, "the film stands still");
    await seek(page, 0.1);
    const still = await file(page, "Save picture");
    assert.equal(await page.evaluate(() => document.activeElement.textContent), "Save picture");
    assert.equal(still.suggestedFilename(), "cart-lap-torso-vehicle-100.0-ms.png");
    const stillPath = join(folder, "still.png");
    await still.saveAs(stillPath);
    const pixels = await page.evaluate(async (url) => {
      const image = new Image();
      image.src = url;
      await image.decode();
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [160, 90];
      const context = canvas.getContext("2d");
      context.drawImage(image, 0, 0, 160, 90);
      return { size: [image.naturalWidth, image.naturalHeight], data: [...context.getImageData(0, 0, 160, 90).data] };
    }, `data:image/png;base64,${readFileSync(stillPath).toString("base64")}`);
    assert.deepEqual(pixels.size, [1920, 1080]);
    const [same, other] = [difference(film.frames[1], pixels.data), difference(film.frames[0], pixels.data)];
    console.log(`  ${codec}: differs by ${same.toFixed(2)} from the same picture, by ${other.toFixed(2)} from another`);
    // of 255; measured: 1.30 and 2.95, 1.34 and 2.27; colours of a wrong range: 9.3
    assert.ok(same < 1.8 && same + 0.5 < other, `${same} and ${other}`);
    // the page is as it was
    await seek(page, 0.03);
    await settled(page);
    assert.deepEqual(await canvas(), before);
    assert.equal(await page.locator(".controls [inert]").count(), 0);
    assert.deepEqual(page.complaints, []);
    await page.close();
  }
  const page = await open(comparison, { width: 360, height: 740 });
  await overhear(page);
  // a longer film is stopped
  await page.getByLabel("Speed").selectOption("0.01");
  await seek(page, 0.05);
  await page.getByRole("button", { name: "Save film" }).click();
  await page.waitForFunction(() => /^picture [2-9]/.test(document.querySelector(".film output").textContent));
  await page.keyboard.press("1");
  await picture(page, "filming-360");
  // no picture meanwhile, and nothing else can be changed
  await page.getByRole("button", { name: "Save picture" }).click();
  assert.match(await page.locator(".film output").textContent(), /^picture/);
  assert.equal(await page.locator(".controls > [inert]").count(), 3);
  await page.getByRole("button", { name: "Stop" }).click();
  await page.waitForFunction(() => document.querySelector(".film output").textContent === "Stopped: no file.");
  assert.ok(Math.abs((await state(page)).time - 0.05) < 1e-9);
  const written = await page.evaluate(() => window.written.join("\n"));
  for (const run of ["cart-lap-torso", "cart-unbelted"]) assert.match(written, new RegExp(`^■ ${run}.mcap \\(SHA-256`, "m"));
  await page.getByLabel("Speed").selectOption("1");
  const film = await played(page, await file(page, "Save film"), "two-runs");
  assert.ok(Math.abs(film.seconds - 6 / 25) < 1e-6, `${film.seconds} s`);
  return page;
}

/** Without WebCodecs the recorder of the browser makes the film, of the same length but for its clock. */
async function recordsFilms(open) {
  for (const [type, ending] of [["video/mp4", "mp4"], ["video/webm", "webm"]]) {
    const page = await open(report);
    await page.evaluate((type) => {
      delete window.VideoEncoder;
      const asked = MediaRecorder.isTypeSupported.bind(MediaRecorder);
      MediaRecorder.isTypeSupported = (one) => one.startsWith(type) && asked(one);
    }, type);
    await page.getByLabel("Speed").selectOption("0.1");
    const download = await file(page, "Save film");
    assert.equal(download.suggestedFilename(), `cart-lap-torso-oblique.${ending}`);
    const film = await played(page, download, `recorded-${ending}`);
    console.log(`  ${ending}: ${film.seconds} s`);
    // measured: 2.07 and 2.13 s of 2.04
    assert.ok(film.seconds > 1.9 && film.seconds < 2.6, `${film.seconds} s`);
    assert.deepEqual(film.size, [1280, 720]);
    assert.ok(difference(film.frames[0], film.frames[1]) > 1, "the film stands still");
    assert.deepEqual(page.complaints, []);
    await page.close();
  }
  return open(report);
}

async function saysWhyNoFilm(open) {
  const page = await open(thrown);
  await page.getByLabel("Speed").selectOption("0.002");
  await page.getByRole("button", { name: "Save film" }).click();
  assert.match(await page.locator(".film output").textContent(), /^At 0.002× the film would last 1656 s, and 300 s is the limit/);
  await page.addInitScript(() => {
    delete window.VideoEncoder;
    delete window.MediaRecorder;
  });
  await page.reload();
  await page.waitForFunction(() => window.occupantReport?.stage?.frames > 0);
  assert.ok(await page.getByRole("button", { name: "Save film" }).isDisabled());
  assert.equal(await page.locator(".film output").textContent(), "No film: this browser codes none.");
  // pictures need no coder
  assert.match((await file(page, "Save picture")).suggestedFilename(), /^thrown-oblique-0.0-ms.png$/);
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
