// A headless Chromium that must stay silent: no console message of warning or error, no request but the page itself.

import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

const EXECUTABLE = process.env.CHROMIUM ?? "/usr/bin/chromium";
const FLAGS = [
  "--no-sandbox",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--disable-gpu",
  "--enable-unsafe-swiftshader",
];

/** What the software renderer says when a screenshot reads its pixels: not the page's doing. */
const DRIVER = /GL Driver Message \(OpenGL, Performance/;

/**
 * Runs `work(open)`, where `open(file, viewport, scheme)` gives a page with `complaints` and `requests`; a file may be an
 * address. The page of a study draws nothing itself.
 */
export async function withBrowser(work) {
  const profile = mkdtempSync(join(tmpdir(), "occupant-browser-"));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: EXECUTABLE,
    headless: true,
    args: FLAGS,
    viewport: { width: 1280, height: 800 },
  });
  try {
    await work(async (file, viewport = { width: 1280, height: 800 }, scheme = "light") => {
      const page = await context.newPage();
      await page.setViewportSize(viewport);
      await page.emulateMedia({ colorScheme: scheme });
      page.complaints = [];
      page.requests = [];
      page.on("console", (message) => {
        const isBad = ["error", "warning"].includes(message.type());
        if (isBad && !DRIVER.test(message.text())) page.complaints.push(message.text());
      });
      page.on("pageerror", (error) => page.complaints.push(String(error)));
      page.on("request", (request) => page.requests.push(request.url()));
      await page.goto(/^https?:/.test(file) ? file : `file://${file}`);
      const isDrawn = () =>
        document.querySelector(".study") || window.occupantReport?.stage?.frames > 0 || window.occupantPage?.times.first;
      await page.waitForFunction(isDrawn, null, { timeout: 60000 });
      return page;
    });
  } finally {
    await context.close();
    rmSync(profile, { recursive: true, force: true });
  }
}
