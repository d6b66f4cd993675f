// node report_page_test.mjs NODE_MODULES BROWSER FOLDER: opens FOLDER/report.html as a reader would. Leaves pictures in
// FOLDER. Exit 0 = all held.
import assert from "node:assert/strict";
import path from "node:path";
import { pathToFileURL } from "node:url";

import { desktop, openBrowser } from "../../report/test/browser_checks.mjs";

const [modules, executablePath, folder] = process.argv.slice(2);
const address = pathToFileURL(path.resolve(folder, "report.html")).href;

const { check: checkAt, end } = await openBrowser(modules, executablePath);
const check = (name, options, body) => checkAt(name, options, address, body);

const background = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor);

await check("the paper's figures stand beside ours", desktop, async (page) => {
  const row = page.locator("#table2-tables table").first().locator("tbody tr", { hasText: "0.25 Sigma" }).filter({ hasText: "spf_empc" });
  assert.match(await row.textContent(), /paper 72/);
  assert.match(await row.textContent(), /paper 27\.17 \| 25\.14 \| 2\.42/);
});

await check("charts are drawn inside their boxes", desktop, async (page) => {
  assert.ok(await page.locator(".charts svg").count() >= 6);
  const outside = await page.evaluate(() => [...document.querySelectorAll(".charts svg")].flatMap((svg) => {
    const box = svg.getBoundingClientRect();
    return [...svg.querySelectorAll("circle, rect, line, path, polygon")].filter((mark) => {
      const at = mark.getBoundingClientRect();
      return at.left < box.left - 1 || at.right > box.right + 1 || at.top < box.top - 1 || at.bottom > box.bottom + 1;
    }).map((mark) => mark.outerHTML);
  }));
  assert.deepEqual(outside, []);
  const nan = await page.evaluate(() => [...document.querySelectorAll("svg *")].filter((mark) => /nan|inf/i.test([...mark.attributes].map((a) => a.value).join(" "))).length);
  assert.equal(nan, 0);
  await page.screenshot({ path: path.join(folder, "desktop.png"), fullPage: true });
});

await check("failures open by keyboard and tell cause and command", desktop, async (page) => {
  const details = page.locator("#table2-failures details").first();
  await details.locator("summary").focus();
  await page.keyboard.press("Enter");
  assert.equal(await details.evaluate((element) => element.open), true);
  const text = await details.locator("tbody tr").first().textContent();
  assert.match(text, /robot \d+ .*touched|not arrived/);
  assert.match(text, /last plan/);
  assert.match(text, /spf run table2\/cells\/.*\.yaml --first 100\d\d/);
});

await check("a linked replay opens", desktop, async (page) => {
  const link = page.locator("#table2-failures a").first();
  await page.goto(new URL(await link.getAttribute("href"), address).href);
  assert.match(await page.textContent("#outcome"), /collision|overtime/);
});

await check("stills are shown", desktop, async (page) => {
  assert.equal(await page.locator("#scenes-pictures .frames svg").count(), 5);
});

await check("paired comparisons open", desktop, async (page) => {
  await page.locator("#table2-paired summary").first().click();
  assert.ok(await page.locator("#table2-paired details[open] tbody tr").count() >= 6);
});

await check("the theme follows the system and the button", { ...desktop, colorScheme: "dark" }, async (page) => {
  const dark = await background(page);
  await page.focus("#theme");
  await page.keyboard.press("Enter");
  assert.match(await page.textContent("#theme"), /light/);
  assert.notEqual(await background(page), dark);
  await page.keyboard.press("Enter");
  assert.equal(await background(page), dark);
});

for (const width of [320, 390, 768, 1024]) {
  await check(`nothing sticks out at ${width} px, opened`, { viewport: { width, height: 800 }, colorScheme: "dark" }, async (page) => {
    await page.evaluate(() => document.querySelectorAll("details").forEach((details) => { details.open = true; }));
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth), 0);
    await page.screenshot({ path: path.join(folder, `width-${width}.png`) });
  });
}

await check("every heading, link and table can be reached and has a name", desktop, async (page) => {
  const broken = await page.evaluate(() => [...document.querySelectorAll("nav a")].filter((link) => !document.querySelector(link.getAttribute("href"))).map((link) => link.href));
  assert.deepEqual(broken, []);
  const ids = await page.evaluate(() => [...document.querySelectorAll("[id]")].map((element) => element.id));
  assert.equal(new Set(ids).size, ids.length);
  assert.equal(await page.locator(".scroll:not([tabindex])").count(), 0);
});

await end();
