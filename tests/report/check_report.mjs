// What a person does with a report, done in Chromium.
//
//   node check_report.mjs PICTURES REPORT.html…     HOSTILE.html is known by its name
//
// Screenshots are left in the folder PICTURES.
import assert from "node:assert/strict";
import { basename, join } from "node:path";
import { statSync } from "node:fs";
import { open } from "./browser.mjs";

const [pictures, ...reports] = process.argv.slice(2);

/** Most bytes of a report, and most time until its 3D view is drawn. */
const MOST_BYTES = 5_000_000;
const MOST_MILLISECONDS = 2000;
/** Software 3D on a machine busy with other tests takes a few times as long. */
const BUSY = 4;

let passed = 0;
async function test(name, run) {
  try {
    await run();
  } catch (error) {
    console.error(`not ok: ${name}`);
    throw error;
  }
  passed += 1;
  console.log(`ok: ${name}`);
}

/** How many different colours the 3D view shows. */
const colours = (page) => page.evaluate(() => {
  const canvas = document.querySelector("#view canvas");
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  const context = copy.getContext("2d");
  context.drawImage(canvas, 0, 0);
  const { data } = context.getImageData(0, 0, copy.width, copy.height);
  return new Set(new Uint32Array(data.buffer)).size;
});

/** Waits until the view has been drawn again. */
const drawn = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

/** The view as pixels, to tell whether something changed. */
const seen = async (page) => {
  await drawn(page);
  return page.evaluate(() => document.querySelector("#view canvas").toDataURL());
};

const shot = (page, name) => page.screenshot({ path: join(pictures, `${name}.png`), fullPage: true });
const rows = (page) => page.locator("tr[data-beam]");
const chosen = (page) => page.locator('tr[data-beam][aria-selected="true"]');

async function looks(page, name) {
  await test(`${name}: the canvas is not blank`, async () => assert.ok((await colours(page)) > 50));

  await test(`${name}: a row chooses its beam in the view`, async () => {
    const before = await seen(page);
    await rows(page).first().click();
    assert.equal(await chosen(page).count(), 1);
    assert.match(await page.locator("#label").textContent(), /^B001/);
    assert.notEqual(await seen(page), before);
    await shot(page, `${name}-chosen`);
  });

  await test(`${name}: a click on the middle of a beam chooses its row`, async () => {
    await page.locator("#view").focus();
    await page.keyboard.press("Escape");
    assert.equal(await chosen(page).count(), 0);
    await rows(page).first().click();
    const mark = await chosen(page).locator("td").first().textContent();
    await page.locator("#view").focus();
    await page.keyboard.press("Escape");
    const box = await page.locator("#view").boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    assert.equal(await chosen(page).count(), 1, `nothing chosen where ${mark} is`);
  });

  await test(`${name}: every layer can be switched off and on`, async () => {
    await page.locator('[data-look="fit"]').click();
    for (const layer of ["mesh", "beams", "skeleton", "outlines"]) {
      const before = await seen(page);
      await page.locator(`[data-layer="${layer}"]`).click();
      assert.notEqual(await seen(page), before, layer);
      await page.locator(`[data-layer="${layer}"]`).click();
      assert.equal(await seen(page), before, layer);
    }
  });

  await test(`${name}: colours follow the quantity, and the legend with them`, async () => {
    for (const quantity of ["offset", "area", "deviation", "error"]) {
      await page.locator("#colour").selectOption(quantity);
      assert.ok((await page.locator("#legend div").count()) > 1, quantity);
    }
    await page.locator("#colour").selectOption("profile");
  });

  await test(`${name}: keys turn the view`, async () => {
    const before = await seen(page);
    await page.locator("#view").focus();
    await page.keyboard.press("ArrowLeft");
    assert.notEqual(await seen(page), before);
  });
}

async function table(page, name) {
  await test(`${name}: the search filters the beams`, async () => {
    const all = await rows(page).count();
    await page.locator("#search").fill("b001");
    assert.equal(await page.locator("tr[data-beam]:visible").count(), 1);
    await page.locator("#search").fill("");
    assert.equal(await page.locator("tr[data-beam]:visible").count(), all);
  });

  await test(`${name}: a column sorts as numbers, both ways`, async () => {
    const lengths = () => page.locator("tr[data-beam] td:nth-child(3)").allTextContents();
    await page.locator("#beam-table th").nth(2).click();
    const up = (await lengths()).map(Number);
    assert.deepEqual(up, [...up].sort((a, b) => a - b));
    await page.locator("#beam-table th").nth(2).click();
    assert.deepEqual((await lengths()).map(Number), up.reverse());
  });

  await test(`${name}: the table is copied as TSV`, async () => {
    await page.locator("#copy").click();
    const text = await page.evaluate(() => navigator.clipboard.readText());
    const lines = text.trim().split("\n");
    assert.equal(lines.length, 1 + (await rows(page).count()));
    assert.ok(lines.every((line) => line.split("\t").length === 8));
  });

  await test(`${name}: plots are drawn`, async () => {
    assert.equal(await page.locator(".plots canvas").count(), 3);
  });
}

async function findings(page, name) {
  const places = page.locator("[data-finding]");
  if ((await places.count()) === 0) return;
  await test(`${name}: a finding shows its place`, async () => {
    const before = await seen(page);
    await places.first().click();
    assert.notEqual(await seen(page), before);
  });
}

async function theme(page, name) {
  await test(`${name}: light turns dark`, async () => {
    const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await paper();
    await page.locator("#theme").click();
    assert.notEqual(await paper(), light);
    await page.locator('[data-look="isometric"]').click();
    await drawn(page);
    await shot(page, `${name}-dark`);
  });
}

async function whole(file) {
  const name = basename(file, ".html");
  await test(`${name}: the file is small`, () => assert.ok(statSync(file).size < MOST_BYTES));
  await open(file, {}, async (page, faults, time) => {
    await test(`${name}: it opens fast (${time.toFixed(0)} ms)`, () => assert.ok(time < MOST_MILLISECONDS * (process.env.CI ? BUSY : 1)));
    await shot(page, name);
    await looks(page, name);
    await table(page, name);
    await findings(page, name);
    await theme(page, name);
    await test(`${name}: no error, no warning, no request`, () => assert.deepEqual(faults.filter(own), []));
  });
}

/** Software rendering warns that reading its pixels is slow, which only these tests do. */
const own = (fault) => !/GPU stall due to ReadPixels/.test(fault);

async function hostile(file) {
  await open(file, {}, async (page, faults) => {
    await test("hostile names show as text", async () => {
      assert.equal(await page.locator("img").count(), 0);
      assert.equal(await page.locator("script").count(), 3);
      assert.match(await page.locator("h1").textContent(), /<img src=x onerror=alert\(1\)>/);
    });
    await test("hostile names run nothing", () => assert.deepEqual(faults.filter(own), []));
    await test("the page allows no script but its own", async () => {
      await page.evaluate(() => {
        const script = document.createElement("script");
        script.textContent = "document.title = 'run'";
        document.body.append(script);
      });
      assert.notEqual(await page.title(), "run");
    });
    await shot(page, "hostile");
  });
}

async function narrow(file) {
  const phone = { viewport: { width: 390, height: 800 }, hasTouch: true, colorScheme: "dark" };
  await open(file, phone, async (page, faults) => {
    await test("a narrow page does not scroll sideways", async () => {
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    });
    await test("a narrow page has no fault", () => assert.deepEqual(faults.filter(own), []));
    await shot(page, "narrow-dark");
  });
}

async function withoutWebgl(file) {
  await open(file, { webgl: false }, async (page) => {
    await test("without WebGL the fixed picture is shown", async () => {
      assert.ok(await page.locator("#no-webgl").isVisible());
      assert.ok(await page.locator("#picture svg").isVisible());
      assert.ok((await rows(page).count()) > 0);
    });
    await shot(page, "no-webgl");
  });
}

async function withoutScript(file) {
  await open(file, { webgl: false, javaScriptEnabled: false }, async (page) => {
    await test("without scripts picture and tables can be read", async () => {
      assert.ok(await page.locator("#picture svg").isVisible());
      assert.ok(await page.locator("tr[data-beam]").first().isVisible());
    });
  });
}

for (const file of reports) await (basename(file) === "HOSTILE.html" ? hostile(file) : whole(file));
await narrow(reports[0]);
await withoutWebgl(reports[0]);
await withoutScript(reports[0]);
console.log(`${passed} passed, 0 failed`);
