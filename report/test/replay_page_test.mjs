// node replay_page_test.mjs NODE_MODULES BROWSER FOLDER: opens FOLDER/sample.html (spf_sample_replay) as a reader would.
// Leaves pictures in FOLDER. Exit 0 = all held.
import assert from "node:assert/strict";
import path from "node:path";
import { pathToFileURL } from "node:url";

import { desktop, openBrowser, phone } from "./browser_checks.mjs";

const [modules, executablePath, folder] = process.argv.slice(2);
const address = pathToFileURL(path.resolve(folder, "sample.html")).href;

const { check: checkAt, end } = await openBrowser(modules, executablePath);
const check = (name, options, suffix, body) => checkAt(name, options, address + suffix, body);

const clock = async (page) => parseFloat((await page.textContent("#clock")).replace("\u2212", "-"));
const clockIs = (page, seconds) => page.waitForFunction((s) => Math.abs(parseFloat(document.getElementById("clock").textContent) - s) < 0.051, seconds);
/** Fingerprint of a canvas. */
const picture = (page, id) => page.evaluate((name) => document.getElementById(name).toDataURL(), id);
/** How many pixels of the canvas are not transparent. */
const inked = (page, id) => page.evaluate((name) => {
  const canvas = document.getElementById(name);
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let i = 3; i < data.length; i += 4) if (data[i] > 0) ++count;
  return count;
}, id);
const sideways = (page) => page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
/** Two animation frames later everything asked for is painted. */
const painted = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

await check("shows the run's words as words", desktop, "", async (page) => {
  assert.equal(await page.title(), 'Sample <run> & "replay"');
  assert.equal(await page.textContent("#title"), 'Sample <run> & "replay"');
  assert.match(await page.textContent("#events"), /<\/script><script>document\.title='broken'<\/script>/);
  assert.match(await page.textContent("#outcome"), /collision/);
  assert.equal(await page.locator("#summary tr").count(), 6);
  for (const id of ["scene", "timeline"]) {
    await painted(page);
    assert.ok(await inked(page, id) > 500, `${id} is empty`);
  }
});

await check("charts stand in their boxes and look like their legend", desktop, "", async (page) => {
  await painted(page);
  for (const [name, series] of [["wheels", 3], ["clearance", 3], ["computing", 2]]) {
    const looks = await page.evaluate((id) => {
      const box = document.getElementById(`chart-${id}`).getBoundingClientRect();
      const paths = [...document.querySelectorAll(`#chart-${id} path`)];
      const inside = (at) => at.width > 50 && at.left >= box.left && at.right <= box.right && at.top >= box.top && at.bottom <= box.bottom;
      return { inside: paths.every((path) => inside(path.getBoundingClientRect())), lines: paths.map((path) => getComputedStyle(path).stroke),
        legend: [...document.querySelectorAll(`#legend-${id} i`)].map((mark) => getComputedStyle(mark).borderTopColor),
        values: [...document.querySelectorAll(`#legend-${id} b`)].map((value) => value.textContent) };
    }, name);
    assert.ok(looks.inside, `${name} sticks out`);
    assert.equal(looks.lines.length, series);
    assert.deepEqual(looks.lines, looks.legend);
    for (const value of looks.values) assert.match(value, /^\u2212?[0-9.]+ (m\/s|m|\u00b5s|ms)/);
  }
});

await check("the cursor stands where a chart is pressed and follows the drag", desktop, "", async (page) => {
  await page.locator("#chart-clearance").scrollIntoViewIfNeeded();
  const area = await page.locator("#chart-clearance .area").boundingBox();
  const cursorAt = async (x) => {
    await painted(page);
    for (const name of ["wheels", "clearance", "computing"]) {
      const all = await page.locator(`#chart-${name} .area`).boundingBox();
      const cursor = await page.locator(`#chart-${name} .cursor`).boundingBox();
      assert.ok(Math.abs((cursor.x + cursor.width / 2 - all.x) / all.width - (x - area.x) / area.width) < 0.01, name);
    }
  };
  await page.mouse.move(area.x + area.width / 4, area.y + 40);
  await page.mouse.down();
  await clockIs(page, 6);
  await cursorAt(area.x + area.width / 4);
  await page.mouse.move(area.x + area.width / 2, area.y + 90, { steps: 3 });
  await clockIs(page, 12);
  await page.mouse.up();
  await cursorAt(area.x + area.width / 2);
});

await check("plays with the space key and stops", desktop, "", async (page) => {
  const before = await picture(page, "scene");
  assert.equal(await clock(page), 0);
  await page.keyboard.press("Space");
  await page.waitForFunction(() => parseFloat(document.getElementById("clock").textContent) >= 0.5);
  assert.equal(await page.getAttribute("#play", "aria-label"), "Pause");
  await page.keyboard.press("Space");
  await page.waitForFunction(() => document.getElementById("play").getAttribute("aria-label") === "Play");
  await painted(page);
  const stopped = await clock(page);
  await page.waitForTimeout(250);
  assert.equal(await clock(page), stopped);
  assert.notEqual(await picture(page, "scene"), before);
});

await check("the play button does not react twice to space", desktop, "", async (page) => {
  await page.focus("#play");
  await page.keyboard.press("Space");
  await page.waitForFunction(() => parseFloat(document.getElementById("clock").textContent) >= 0.2);
  assert.equal(await page.getAttribute("#play", "aria-label"), "Pause");
});

await check("speed changes by key and by list, and the end stops", desktop, "#t=20", async (page) => {
  for (let i = 0; i < 6; ++i) await page.keyboard.press("]");
  await page.waitForFunction(() => document.getElementById("speed").value === "16");
  await page.keyboard.press("[");
  await page.waitForFunction(() => document.getElementById("speed").value === "8");
  await page.selectOption("#speed", "16");
  await page.click("#play");
  await clockIs(page, 24);
  await page.waitForFunction(() => document.getElementById("play").getAttribute("aria-label") === "Play");
});

await check("scrubs by keyboard", desktop, "", async (page) => {
  await page.keyboard.press("ArrowRight");
  await clockIs(page, 0.1);
  await page.keyboard.press("Shift+ArrowRight");
  await clockIs(page, 1.1);
  await page.keyboard.press("ArrowLeft");
  await clockIs(page, 1.0);
  await page.keyboard.press("End");
  await clockIs(page, 24);
  await page.keyboard.press("Home");
  await clockIs(page, 0);
  await page.focus("#slider");
  await page.keyboard.press("ArrowRight");
  await clockIs(page, 0.1);
  await page.waitForFunction(() => document.getElementById("slider").getAttribute("aria-valuetext") === "0.1 seconds");
});

await check("choosing a robot shows its candidates and its reason", desktop, "#t=8.5", async (page) => {
  await page.selectOption("#robot", "2");
  await page.waitForFunction(() => document.getElementById("state").textContent.startsWith("braking: obstacle 0"));
  assert.equal(await page.locator("#candidates li").count(), 2);
  assert.equal(await page.locator("#candidates li.chosen").count(), 1);
  assert.match(await page.textContent("#candidates"), /left of obstacle 0.*right of obstacle 0/s);
  await painted(page);
  const withCandidates = await picture(page, "scene");
  await page.uncheck("#layer-candidates");
  await painted(page);
  assert.notEqual(await picture(page, "scene"), withCandidates);
  const wheels = await page.innerHTML("#chart-wheels");
  assert.match(wheels, /of robot 2/);
  await page.focus("#scene");
  await page.keyboard.press("3");
  await page.waitForFunction(() => document.getElementById("robot").value === "3");
  await painted(page);
  assert.match(await page.innerHTML("#chart-wheels"), /of robot 3/);
  assert.notEqual(await page.innerHTML("#chart-wheels"), wheels.replace("of robot 2", "of robot 3"));
});

await check("a click on a robot chooses it, a drag moves the scene", desktop, "?robot=3", async (page) => {
  await page.click("#follow");  // puts robot 3 into the middle ...
  await painted(page);
  await page.click("#follow");  // ... where it stays
  await page.keyboard.press("n");
  await page.waitForFunction(() => document.getElementById("robot").value === "1");
  const box = await page.locator("#scene").boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await page.waitForFunction(() => document.getElementById("robot").value === "3");
  const before = await picture(page, "scene");
  await page.mouse.move(box.x + 200, box.y + 200);
  await page.mouse.down();
  await page.mouse.move(box.x + 260, box.y + 230, { steps: 4 });
  await page.mouse.up();
  await painted(page);
  assert.notEqual(await picture(page, "scene"), before);
  assert.equal(await page.inputValue("#robot"), "3");
});

await check("the address jumps", desktop, "?t=12.5&robot=3", async (page) => {
  await clockIs(page, 12.5);
  assert.equal(await page.inputValue("#robot"), "3");
  await page.evaluate(() => { location.hash = "#t=3&robot=2"; });
  await clockIs(page, 3);
  assert.equal(await page.inputValue("#robot"), "2");
  await page.evaluate(() => { location.hash = "#t=nonsense&robot=99"; });
  await clockIs(page, 0);
  assert.equal(await page.inputValue("#robot"), "2");
});

await check("events and charts jump on a click", desktop, "", async (page) => {
  await page.selectOption("#event-kind", "contact");
  assert.equal(await page.locator("#events button").count(), 1);
  const time = parseFloat(await page.textContent("#events time"));
  assert.ok(time > 1);
  await page.click("#events button");
  await clockIs(page, time);
  assert.match(await page.textContent("#now"), /contact with obstacle 0/);
  await page.selectOption("#event-kind", "arrival");
  const all = await page.locator("#events button").count();
  await page.check("#event-own");
  assert.ok(await page.locator("#events button").count() < all);
  const chart = await page.locator("#chart-wheels").boundingBox();
  await page.click("#chart-wheels", { position: { x: chart.width - 11, y: 60 } });
  await page.waitForFunction(() => parseFloat(document.getElementById("clock").textContent) > 23.5);
});

await check("follows the system's colours and the button overrides them", { ...desktop, colorScheme: "dark" }, "#t=8.5", async (page) => {
  const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const dark = await background();
  await painted(page);
  await page.screenshot({ path: path.join(folder, "dark.png"), fullPage: true });
  const scene = await picture(page, "scene");
  const line = () => page.evaluate(() => getComputedStyle(document.querySelector("#chart-wheels path")).stroke);
  const darkLine = await line();
  await page.click("#theme");
  await painted(page);
  assert.notEqual(await background(), dark);
  assert.notEqual(await line(), darkLine);
  assert.notEqual(await picture(page, "scene"), scene);
  await page.screenshot({ path: path.join(folder, "light.png"), fullPage: true });
});

for (const width of [320, 390, 768, 1024]) {
  await check(`nothing sticks out at ${width} px`, { ...phone, viewport: { width, height: 800 } }, "#t=8.5", async (page) => {
    await painted(page);
    assert.equal(await sideways(page), 0);
    await page.screenshot({ path: path.join(folder, `width-${width}.png`), fullPage: true });
  });
}

await check("redraws at once when the window changes size", desktop, "#t=8.5", async (page) => {
  await page.setViewportSize({ width: 800, height: 700 });
  await painted(page);
  for (const id of ["scene", "timeline"]) {
    assert.ok(await inked(page, id) > 500, `${id} is empty`);
    const sizes = await page.evaluate((name) => [document.getElementById(name).width, document.getElementById(name).clientWidth], id);
    assert.ok(Math.abs(sizes[0] - sizes[1]) <= 1, `${id} is ${sizes}`);
  }
});

await check("every control has a name and can be reached by Tab", desktop, "", async (page) => {
  const nameless = await page.evaluate(() => [...document.querySelectorAll("button, select, input, canvas:not([aria-hidden]), svg")].filter((element) =>
    !(element.getAttribute("aria-label") || element.textContent.trim() || element.labels?.[0]?.textContent.trim())).map((element) => element.id));
  assert.deepEqual(nameless, []);
  const reached = new Set();
  for (let i = 0; i < 60; ++i) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement.id));
  }
  for (const id of ["scene", "play", "speed", "slider", "robot", "event-kind", "theme", "layer-fields"]) assert.ok(reached.has(id), `Tab misses ${id}`);
});

await check("help opens by key, closes by Escape and holds the keys back", desktop, "", async (page) => {
  await page.keyboard.press("?");
  await page.waitForSelector("#help[open]");
  await page.keyboard.press("ArrowRight");
  await painted(page);
  assert.equal(await clock(page), 0);
  await page.keyboard.press("Escape");
  await page.waitForSelector("#help[open]", { state: "detached" });
});

await end();
