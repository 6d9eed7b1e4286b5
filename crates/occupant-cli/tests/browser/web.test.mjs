// The page that simulates, in a real browser: node web.test.mjs OCCUPANT PAGE.html [SCREENSHOTS]
//
// OCCUPANT is the command, whose figures the page must have to the bit.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { gzipSync } from "node:zlib";
import { withBrowser } from "./browser.mjs";
import { LESSONS } from "../../../occupant-web/assets/src/lessons.js";

const [occupant, file, pictures] = process.argv.slice(2).map((path) => resolve(path));
if (!occupant || !file) throw new Error("give OCCUPANT and PAGE.html");
if (pictures) mkdirSync(pictures, { recursive: true });
const work = mkdtempSync(join(tmpdir(), "occupant-web-"));

const MOST_BYTES_GZIPPED = 3e6;
/** From the begin of the script to the first picture of a body, and from a slider to the next one, ms. */
const MOST_MS = { first: 3000, answer: 500 };
const DESKTOP = { width: 1280, height: 800 };
const PHONE = { width: 360, height: 740 };

const tests = { isSmall, isQuick, answersHands, isTheCommand, isTheCommandWithChanges, isTheSweep, savesResults, takesHostileTexts, marksProblems, completes, plotsChannels, opensRecords, compares, teaches, carriesLinks, runsFromServers, isNamed, fits };

const ask = (page, request) => page.evaluate((r) => window.occupantPage.runner.ask(r).then(({ answer }) => answer), request);

const command = (...words) => execFileSync(occupant, words, { cwd: work, encoding: "utf8", maxBuffer: 1 << 28 });

/** The case of a template. */
const template = (page, name, set = []) =>
  page.evaluate(
    ([own, changes]) => {
      const { text } = window.occupantPage.templates.find((one) => one.name === own);
      return { name: `${own}.toml`, text, set: changes, tables: {} };
    },
    [name, set],
  );

/** Waits for the run of what the page shows now. */
async function idle(page) {
  await page.waitForFunction(() => !window.occupantPage.running && !window.occupantPage.wanted, null, { timeout: 60000 });
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))));
}

async function picture(page, name) {
  if (!pictures) return;
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  await page.screenshot({ path: join(pictures, `${name}.png`) });
}

async function isSmall(open) {
  const bytes = readFileSync(file);
  const packed = gzipSync(bytes, { level: 9 }).length;
  console.log(`  ${bytes.length} bytes, ${packed} gzipped`);
  assert.ok(packed < MOST_BYTES_GZIPPED, `${packed} bytes gzipped`);
  return open(file);
}

async function isQuick(open) {
  for (const [name, size] of Object.entries({ desktop: DESKTOP, phone: PHONE })) {
    const page = await open(file, size);
    const { first, run } = await page.evaluate(() => window.occupantPage.times);
    console.log(`  ${name}: a moving body after ${first.toFixed(0)} ms, its run ${run.toFixed(0)} ms`);
    assert.ok(first < MOST_MS.first, `${first} ms`);
    assert.ok(await page.evaluate(() => window.occupantPage.view.clock.playing), "it does not move");
    await page.close();
  }
  return open(file);
}

async function answersHands(open) {
  for (const [name, size] of Object.entries({ desktop: DESKTOP, phone: PHONE })) {
    const page = await open(file, size);
    await idle(page);
    const answers = [];
    for (const value of [54, 60, 45, 52, 48]) {
      await page.evaluate((v) => {
        const slider = document.getElementById("knob-path-delta-v");
        slider.value = v;
        slider.dispatchEvent(new Event("input"));
      }, value);
      await idle(page);
      answers.push(await page.evaluate(() => window.occupantPage.times));
    }
    const middle = (of) => answers.map(of).sort((a, b) => a - b)[2];
    const answer = middle((times) => times.answer);
    console.log(`  ${name}: a slider answered after ${answer.toFixed(0)} ms, its run ${middle((times) => times.run).toFixed(0)} ms`);
    assert.ok(answer < MOST_MS.answer, `${answer} ms`);
    const summary = await page.evaluate(() => window.occupantPage.now.summary.title);
    assert.match(summary, /path.delta_v = 48 km\/h and path.speed = 48 km\/h/);
    await page.close();
  }
  return open(file);
}

/** The summary of a run by the command, and by the page. */
async function both(page, own) {
  writeFileSync(join(work, own.name), own.text);
  const words = own.set.flatMap((change) => ["--set", change]);
  const said = JSON.parse(command("run", own.name, "--no-mcap", "--json", "--quiet", ...words));
  const { summary, unstable_friction } = await ask(page, { do: "run", case: own });
  delete said.summary?.solver.wall_time_s;
  const theirs = Object.fromEntries(Object.keys(summary).map((key) => [key, said[key]]));
  delete theirs.solver.wall_time_s;
  delete summary.solver.wall_time_s;
  return [{ ...summary, unstable_friction }, { ...theirs, unstable_friction: said.unstable_friction }];
}

async function isTheCommand(open) {
  const page = await open(file);
  const names = await page.evaluate(() => window.occupantPage.templates.map((one) => one.name));
  assert.ok(names.length >= 13);
  for (const name of names) {
    const [ours, theirs] = await both(page, await template(page, name));
    assert.ok(ours.measures.length > 0 || name === "pedestrian", name);
    assert.deepStrictEqual(ours, theirs, name);
  }
  console.log(`  ${names.length} templates to the bit`);
  return page;
}

async function isTheCommandWithChanges(open) {
  const page = await open(file);
  const changes = [
    ["path.delta_v=63 km/h", "path.speed=63 km/h", "car.seats.driver.limiter=4.5 kN"],
    ["path.direction=[0.866, 0.5, 0]", 'body.preset="female05"', "car.seats.driver.slack=40 mm"],
    ["car.bags.driver=false", 'car.seats.driver.belt="none"'],
  ];
  for (const set of changes) {
    const [ours, theirs] = await both(page, await template(page, "driver", set));
    assert.deepStrictEqual(ours, theirs, set.join(" "));
  }
  return page;
}

/** The rows of a study are those of the table of `occupant sweep`. */
async function isTheSweep(open) {
  const page = await open(file);
  await idle(page);
  await page.getByRole("tab", { name: "Study" }).click();
  await page.getByLabel("Runs").fill("4");
  await page.getByRole("button", { name: "Run the study" }).click();
  await page.waitForFunction(() => window.occupantPage.study.study?.rows.length === 4 && !window.occupantPage.study.running, null, { timeout: 60000 });
  assert.equal(await page.locator(".scatter circle").count(), 4);
  await picture(page, "study");
  const [text, rows, own] = await page.evaluate(() => {
    const { study } = window.occupantPage;
    return [study.text().text, study.study.rows, window.occupantPage.state.text];
  });
  writeFileSync(join(work, "case.toml"), own);
  writeFileSync(join(work, "study.toml"), text);
  command("sweep", "study.toml", "--output", "study", "--csv", "--quiet");
  const [head, ...lines] = readFileSync(join(work, "study", "results.csv"), "utf8").trim().split("\n");
  const cellsOf = (line) => line.split(/,(?=(?:[^"]*"[^"]*")*[^"]*$)/);
  const names = cellsOf(head).map((name) => name.replace(/^"|"$/g, "").replace(/\s*\[.*$/, ""));
  assert.equal(lines.length, 4);
  let compared = 0;
  lines.forEach((line, i) => {
    const cells = cellsOf(line);
    for (const { name, value } of rows[i].figures) {
      const at = names.indexOf(name);
      if (at < 0 || value === null) continue;
      assert.equal(value, Number(cells[at]), `${name} of run ${i}`);
      compared += 1;
    }
  });
  console.log(`  ${compared} figures of a study to the bit`);
  assert.ok(compared > 100, `${compared} figures compared`);
  return page;
}

async function savesResults(open) {
  const page = await open(file);
  const own = await template(page, "sled");
  const text = await page.evaluate(async (c) => {
    const { bytes } = await window.occupantPage.runner.ask({ do: "save", case: c });
    let binary = "";
    for (const byte of bytes) binary += String.fromCharCode(byte);
    return btoa(binary);
  }, own);
  writeFileSync(join(work, "saved.mcap"), Buffer.from(text, "base64"));
  writeFileSync(join(work, own.name), own.text);
  command("run", own.name, "--output", "own.mcap", "--quiet");
  const [ours, theirs] = ["saved.mcap", "own.mcap"].map((name) => JSON.parse(command("measures", name, "--json")));
  for (const one of [ours, theirs]) for (const key of ["file", "sha256", "results"]) delete one[key];
  assert.deepStrictEqual(JSON.parse(JSON.stringify(ours).replaceAll("saved.mcap", "own.mcap")), theirs);
  return page;
}

const HOSTILE = '<img src=x onerror="window.hacked = 1"></script><script>window.hacked = 1</script>';

async function takesHostileTexts(open) {
  const page = await open(file);
  await idle(page);
  const own = await template(page, "sled");
  const quoted = JSON.stringify(HOSTILE);
  const title = own.text.replace(/^title = .*$/m, `title = ${quoted}`);
  const named = title.replace(/^\[surfaces\.(\w+)\]/m, `[surfaces.${quoted}]`);
  const texts = [title, named, `${title}\n${quoted} = 1\n`, HOSTILE, `title = ${quoted}\n[path]\nkind = "table"\nfile = ${quoted}\n`];
  for (const text of texts) {
    for (const tables of [{}, { [HOSTILE]: `${HOSTILE},t[s]\n${HOSTILE},1\n` }]) {
      await page.evaluate((state) => window.occupantPage.take(state), { name: `${HOSTILE}.toml`, text, set: { [HOSTILE]: HOSTILE }, tables });
      await idle(page);
      await page.evaluate((state) => window.occupantPage.take(state), { name: `${HOSTILE}.toml`, text, set: {}, tables });
      await idle(page);
      await page.evaluate(() => window.occupantPage.keep());
    }
  }
  await page.waitForTimeout(300);
  assert.equal(await page.evaluate(() => window.hacked), undefined);
  assert.equal(await page.locator("img").count(), 0);
  return page;
}

async function marksProblems(open) {
  const page = await open(file);
  await idle(page);
  await page.getByRole("tab", { name: "Text" }).click();
  const area = page.locator("#scenario-text");
  const text = await area.inputValue();
  await area.fill(text.replace('speed = "50 km/h"', 'spead = "50 km/h"'));
  const line = text.split("\n").findIndex((one) => one.startsWith('speed = "50')) + 1;
  await page.waitForFunction(() => document.querySelector(".problems .error"));
  assert.match(await page.locator(".problems .error").first().textContent(), new RegExp(`line ${line}.*spead`));
  assert.equal(await page.locator(".gutter .error").first().textContent(), String(line));
  await picture(page, "problem");
  await page.locator(".problems button").first().click();
  const at = await area.evaluate((node) => node.value.slice(0, node.selectionStart).split("\n").length);
  assert.equal(at, line);
  await area.fill(text);
  await page.waitForFunction(() => !document.querySelector(".problems .error"));
  await idle(page);
  return page;
}

async function completes(open) {
  const page = await open(file);
  await page.getByRole("tab", { name: "Text" }).click();
  const area = page.locator("#scenario-text");
  await page.waitForFunction(() => window.occupantPage.editor.completion.schema);
  await area.press("Control+End");
  await area.pressSequentially("\nbelt = \n");
  await area.press("ArrowUp");
  await area.press("End");
  await area.press("Control+ ");
  const list = page.locator(".completion [role=option]");
  assert.match(await list.allTextContents().then((all) => all.join("|")), /three_point.*lap/);
  await area.press("Escape");
  await area.press("Control+End");
  await area.pressSequentially("head_");
  await area.press("Control+ ");
  assert.match(await list.first().textContent(), /head_gap/);
  await picture(page, "completion");
  await area.press("Enter");
  assert.match(await area.inputValue(), /head_gap = $/);
  return page;
}

async function plotsChannels(open) {
  const page = await open(file);
  await idle(page);
  const field = page.getByLabel("Channels to plot, by name or pattern");
  await field.fill("head.acceleration.*, head.position.x");
  await field.press("Enter");
  await idle(page);
  const titles = await page.locator(".plot h3").allTextContents();
  assert.match(titles[0], /^head\.acceleration\.x and 3 more \[/);
  assert.match(titles[1], /^head\.position\.x \[/);
  await field.fill("hed.position.x");
  await field.press("Enter");
  await idle(page);
  assert.match(await page.locator(".status").first().textContent(), /no channel.*hed\.position\.x/s);
  await field.fill("");
  await field.press("Enter");
  await idle(page);
  assert.equal((await page.locator(".plot h3").allTextContents())[0], titles[2]);
  return page;
}

async function opensRecords(open) {
  const page = await open(file);
  await idle(page);
  const data = resolve(import.meta.dirname, "../data/recorders/magnitudes.csv");
  const bare = join(work, "open.csv");
  writeFileSync(bare, "speed at impact: 60 km/h\nt (ms),delta-v (km/h)\n0,0\n50,15\n100,30\n150,30\n");
  for (const record of [data, bare]) {
    await page.locator("input[type=file]").setInputFiles(record);
    if (record === bare) await page.locator(".running").getByRole("button", { name: "front", exact: true }).click();
    const name = record === bare ? "open.toml" : "magnitudes.toml";
    await page.waitForFunction((expected) => window.occupantPage.state.name === expected, name);
    await idle(page);
    assert.match(await page.locator(".status").first().textContent(), /^Simulated/);
    const says = await page.getByLabel("Notes on the record").locator("li").count();
    assert.ok(says > 0, "no note");
    writeFileSync(join(work, name), await page.evaluate(() => window.occupantPage.state.text));
    for (const [table, text] of await page.evaluate(() => Object.entries(window.occupantPage.state.tables))) writeFileSync(join(work, table), text);
    const theirs = JSON.parse(command("run", name, "--no-mcap", "--json", "--quiet"));
    assert.deepStrictEqual(await page.evaluate(() => window.occupantPage.now.summary.measures), theirs.measures);
  }
  await picture(page, "record");
  return page;
}

async function compares(open) {
  const page = await open(file);
  await idle(page);
  await page.getByRole("button", { name: "Compare with this" }).click();
  await page.getByLabel("driver's air bag", { exact: true }).selectOption("false");
  await idle(page);
  assert.equal(await page.locator(".swatch.run-1").count() > 1, true);
  assert.ok((await page.locator(".legend .dashed").count()) > 5);
  await page.evaluate(() => window.occupantPage.view.clock.seek(0.09));
  await picture(page, "compare");
  return page;
}

/** A figure of a summary by its name. */
function figure(summary, name) {
  const measure = summary.measures.find((one) => one.name === name);
  if (measure) return measure.value;
  return name.split(".").reduce((table, key) => table[key], summary);
}

async function teaches(open) {
  const page = await open(file);
  await idle(page);
  await page.getByRole("tab", { name: "Lessons" }).click();
  for (const { title, runs, claims } of LESSONS) {
    await page.locator(".lesson > summary", { hasText: title }).click();
    await page.locator(".lesson[open]").getByRole("button", { name: runs[1].say, exact: true }).click();
    await page.waitForFunction(() => window.occupantPage.kept !== null);
    await idle(page);
    const [first, second] = await page.evaluate(() => [window.occupantPage.keptSummary, window.occupantPage.now.summary]);
    for (const [name, sign] of Object.entries(claims)) {
      const [before, after] = [figure(first, name), figure(second, name)];
      assert.ok(sign * (after - before) > 0, `${title}: ${name} is ${before}, then ${after}`);
    }
  }
  await picture(page, "lesson");
  return page;
}

async function carriesLinks(open) {
  const page = await open(file);
  await idle(page);
  await page.evaluate(() => window.occupantPage.move("car.seats.driver.limiter", "4 kN", true));
  await idle(page);
  await page.getByRole("button", { name: "Copy link" }).click();
  await page.waitForFunction(() => location.hash.startsWith("#s="));
  const [fragment, title] = await page.evaluate(() => [location.hash, window.occupantPage.now.summary.title]);
  console.log(`  a link of ${fragment.length} characters`);
  const other = await open(file + fragment);
  await idle(other);
  assert.equal(await other.evaluate(() => window.occupantPage.now.summary.title), title);
  await other.close();
  const broken = await open(`${file}#s=${"A".repeat(200)}`);
  assert.deepEqual(broken.complaints, []);
  await broken.close();
  return page;
}

async function runsFromServers(open) {
  const asked = [];
  const server = createServer((request, response) => {
    asked.push(request.url);
    response.setHeader("content-type", "text/html");
    response.end(request.url === "/occupant.html" ? readFileSync(file) : "");
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  const address = `http://127.0.0.1:${server.address().port}/occupant.html`;
  const page = await open(address);
  await idle(page);
  assert.deepEqual(asked.filter((url) => url !== "/favicon.ico"), ["/occupant.html"]);
  await page.close();
  server.close();
  return open(file);
}

/** All that can be worked with has a name for those who do not see it. */
async function isNamed(open) {
  const page = await open(file);
  await idle(page);
  const nameless = await page.evaluate(() => {
    const named = (node) =>
      node.getAttribute("aria-label") || node.labels?.length > 0 || node.textContent.trim() || node.title || node.type === "file";
    return [...document.querySelectorAll("button, input, select, textarea, progress, svg, #page .stage canvas, .u-over")].filter((node) => !named(node)).map((node) => node.outerHTML);
  });
  assert.deepEqual(nameless, []);
  return page;
}

async function fits(open) {
  for (const [name, size] of Object.entries({ desktop: DESKTOP, phone: PHONE })) {
    for (const scheme of ["light", "dark"]) {
      const page = await open(file, size, scheme);
      await idle(page);
      await page.evaluate(() => {
        window.occupantPage.view.clock.pause();
        window.occupantPage.view.clock.seek(0.085);
      });
      await picture(page, `${name}-${scheme}`);
      if (pictures) await page.screenshot({ path: join(pictures, `${name}-${scheme}-whole.png`), fullPage: true });
      for (const tab of ["Sliders", "Text", "Lessons", "Study"]) {
        await page.getByRole("tab", { name: tab }).click();
        const wide = await page.evaluate(() => document.documentElement.scrollWidth);
        assert.ok(wide <= size.width, `${name}, ${tab}: ${wide} px wide`);
        if (name === "phone" && scheme === "light") {
          await page.getByRole("tab", { name: tab }).scrollIntoViewIfNeeded();
          await picture(page, `phone-${tab}`);
        }
      }
      assert.deepEqual(page.complaints, []);
      await page.close();
    }
  }
  return open(file);
}

const chosen = process.env.ONLY ? process.env.ONLY.split(",") : Object.keys(tests);
try {
  await withBrowser(async (open) => {
    for (const name of chosen) {
      console.log(name);
      const page = await tests[name](open);
      assert.deepEqual(page.complaints, [], "the console is not silent");
      assert.deepEqual(page.requests.filter((url) => !/^(file|blob|data):/.test(url)), []);
      await page.close();
    }
  });
} finally {
  rmSync(work, { recursive: true, force: true });
}
