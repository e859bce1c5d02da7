// Chromium without a window, each run with an empty profile and no way out.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const QUIET = [
  "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
];
const SOFTWARE_3D = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const NO_3D = ["--disable-gpu", "--disable-3d-apis"];

/** Opens a report and hands the page to `use`; what went wrong in the page is gathered in `faults`. */
export async function open(file, { webgl = true, ...options }, use) {
  const profile = mkdtempSync(join(tmpdir(), "beamwright-browser-"));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    headless: true,
    args: [...QUIET, ...(webgl ? SOFTWARE_3D : NO_3D)],
    viewport: { width: 1400, height: 950 },
    permissions: ["clipboard-read", "clipboard-write"],
    ...options,
  });
  try {
    const page = context.pages()[0] ?? (await context.newPage());
    const faults = [];
    page.on("console", (m) => ["error", "warning"].includes(m.type()) && faults.push(m.text()));
    page.on("pageerror", (e) => faults.push(`${e}`));
    page.on("dialog", (d) => faults.push(`dialog: ${d.message()}`) && d.dismiss());
    const address = pathToFileURL(resolve(file)).href;
    page.on("request", (r) => r.url().split("#")[0] !== address && faults.push(`request: ${r.url()}`));
    const began = performance.now();
    await page.goto(address);
    if (webgl) await page.waitForSelector("html[data-drawn]");
    return await use(page, faults, performance.now() - began);
  } finally {
    await context.close();
    rmSync(profile, { recursive: true, force: true });
  }
}
