// The page of a report: everything on it is made here from the data that the page carries.

import { readReport } from "./data.js";
import { Clock } from "./clock.js";
import { buildPage } from "./page.js";
import { Stage } from "./stage.js";
import { buildControls } from "./controls.js";
import { buildPlots } from "./plots.js";
import { buildTables } from "./tables.js";
import { listenToKeys } from "./keyboard.js";
import { listenToPrint } from "./print.js";
import { showOccupant } from "./tabs.js";

const report = readReport(document.getElementById("report-data").textContent);
const page = buildPage(document.getElementById("report"), report);
const clock = new Clock(report.runs);

let stage = null;
try {
  stage = new Stage(page.stage, report.runs, clock);
} catch (error) {
  page.stage.classList.add("unavailable");
  page.stage.textContent = `This browser gives no 3-D drawing (WebGL): ${error.message}`;
}
buildControls(page.controls, clock, stage, report.runs);
const plots = buildPlots(page.plots, report.runs, clock);
buildTables(page.tables, report.runs, clock);
showOccupant(report.runs);
listenToPrint(page.strip, clock, stage, plots);
listenToKeys(() => ({ clock, stage }));

// for scripts and tests
window.occupantReport = { clock, stage, runs: report.runs };
