// node page_test.mjs NODE_MODULES BROWSER FOLDER: plays with FOLDER/playground.html as a visitor would. Leaves pictures in FOLDER.
// Exit 0 = all held. What depends on how fast the machine is is printed, and not judged.
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";

import { desktop, openBrowser, phone } from "../../report/test/browser_checks.mjs";

const [modules, executablePath, folder] = process.argv.slice(2);
const file = path.resolve(folder, "playground.html");

const { check: checkAt, end } = await openBrowser(modules, executablePath, { timeout: 60000, schemes: ["file", "data", "blob"] });
/** With a scene, once the engine runs. */
function check(name, options, scene, body) {
  const link = scene ? `#scene=${Buffer.from(JSON.stringify(scene)).toString("base64url")}` : "";
  return checkAt(name, options, pathToFileURL(file).href + link, async (page) => {
    await page.waitForFunction(() => document.getElementById("loading").hidden);
    await body(page);
  });
}

const clock = async (page) => parseFloat(await page.textContent("#clock"));
const clockPasses = (page, time) => page.waitForFunction((t) => parseFloat(document.getElementById("clock").textContent) >= t, time);
const pause = (page) => page.click("#play");
/** The scene of the address. */
const sceneOf = async (page) => JSON.parse(Buffer.from((await page.evaluate(() => location.hash)).slice("#scene=".length), "base64url").toString());
/** The two coordinates of a row of the chosen robot's details [m]. */
const position = async (page) => {
  const row = page.locator("#details div", { hasText: /^Position/ }).locator("dd");
  return (await row.textContent()).replace(/\u2212/g, "-").match(/-?[\d.]+/g).map(Number);
};
/** Where a place of a scene of 20 m lies on the screen: it fills 93 % of the canvas's shorter side. */
async function onScreen(page, [x, y]) {
  const box = await page.locator("#scene").boundingBox();
  const scale = (0.93 * Math.min(box.width, box.height)) / 20;
  return { x: box.x + box.width / 2 + x * scale, y: box.y + box.height / 2 - y * scale };
}
const near = (a, b, within) => Math.hypot(a[0] - b[0], a[1] - b[1]) < within;

const quiet = {
  scenario: { family: "explicit", border: { low: [-10, -10], high: [10, 10] }, robots: [{ start: [-6, 0], goal: [6, 0] }],
    moving: [{ position: [0, 6], velocity: [0, 0] }], noise: { level: 0 } },
  trial: 0, changes: [],
};

await check("twelve robots among ten people", desktop, null, async (page) => {
  await clockPasses(page, 3);
  await page.waitForFunction(() => document.getElementById("measured").textContent.includes("pictures"));
  console.log(`      ${await page.textContent("#measured")}`);
  await page.screenshot({ path: path.join(folder, "light.png") });
  const { changes, scenario } = await sceneOf(page);
  assert.deepEqual([scenario.robots, changes[0].people], [12, 10]);
});

await check("a robot is dragged by the mouse, and a goal, and a wall is drawn", desktop, quiet, async (page) => {
  await pause(page);
  await page.click("#restart");
  await page.waitForFunction(() => parseFloat(document.getElementById("clock").textContent) === 0);
  const drag = async (from, to) => {
    const [a, b] = [await onScreen(page, from), await onScreen(page, to)];
    await page.mouse.move(a.x, a.y);
    await page.mouse.down();
    await page.mouse.move((a.x + b.x) / 2, (a.y + b.y) / 2);
    await page.mouse.move(b.x, b.y);
    await page.mouse.up();
  };
  await drag([6, 0], [6, 5]);
  await drag([-6, 0], [-6, -5]);
  await page.click("#tools button[value=wall]");
  await drag([0, -2], [0, 2]);
  const { changes } = await sceneOf(page);
  assert.deepEqual(changes.map((change) => change.do), ["goal", "robot", "wall"]);
  assert.ok(near(changes[0].at, [6, 5], 0.2) && near(changes[1].at, [-6, -5], 0.2), JSON.stringify(changes));
  await page.click("#play");
  await clockPasses(page, 2);
  assert.ok((await position(page))[1] < 0, "it begins where it was put");
});

await check("a robot is dragged by a finger while it runs", phone, quiet, async (page) => {
  await clockPasses(page, 1);
  await pause(page);
  const [from, to] = [await onScreen(page, await position(page)), await onScreen(page, [0, -6])];
  const touch = await page.context().newCDPSession(page);
  const send = (type, at) => touch.send("Input.dispatchTouchEvent", { type, touchPoints: at ? [at] : [] });
  await send("touchStart", from);
  await send("touchMove", { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 });
  await send("touchMove", to);
  await send("touchEnd");
  const time = await clock(page);
  await page.click("#play");
  await clockPasses(page, time + 0.6);
  assert.ok(near(await position(page), [0, -6], 1.5), `it is at ${await position(page)}`);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth), 0);
  await page.screenshot({ path: path.join(folder, "phone.png"), fullPage: true });
});

await check("keys move a goal and throw in a person", { ...desktop, colorScheme: "dark" }, quiet, async (page) => {
  await clockPasses(page, 0.5);
  await page.keyboard.press("g");
  for (let i = 0; i < 4; ++i) await page.keyboard.press("Shift+ArrowDown");
  await page.keyboard.press("Enter");
  await page.keyboard.press("x");
  await page.keyboard.press("Enter");
  for (let i = 0; i < 3; ++i) await page.keyboard.press("Shift+ArrowLeft");
  await page.keyboard.press("Enter");
  const { changes } = await sceneOf(page);
  assert.deepEqual(changes.map((change) => change.do), ["goal", "person"]);
  assert.ok(changes[0].at[1] < -4 && Math.abs(changes[0].at[0] - 6) < 0.01);
  await page.keyboard.press(" ");
  await clockPasses(page, 2);
  assert.match(await page.getAttribute("#scene", "aria-label") + await page.textContent("#said"), /./);
  await page.screenshot({ path: path.join(folder, "dark.png") });
});

await check("what cannot be is said, and is not in the link", desktop, quiet, async (page) => {
  await clockPasses(page, 0.5);
  await page.keyboard.press("g");
  for (let i = 0; i < 9; ++i) await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.getElementById("said").classList.contains("problem"));
  assert.match(await page.textContent("#said"), /border/);
  assert.deepEqual((await sceneOf(page)).changes, []);
});

await check("a link that is none is said, and something runs", desktop, "nonsense", async (page) => {
  assert.match(await page.textContent("#said"), /The link cannot be read/);
  await clockPasses(page, 0.3);
});

const size = statSync(file).size;
await end(size < 3e6 ? [] : [`the page has ${size} bytes`]);
