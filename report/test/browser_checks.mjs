// Checks of a page in headless Chromium, as its readers open it.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import path from "node:path";

const ARGUMENTS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync"];

export const desktop = { viewport: { width: 1440, height: 900 }, colorScheme: "light" };
export const phone = { viewport: { width: 390, height: 844 }, colorScheme: "light", deviceScaleFactor: 2, hasTouch: true };

/** `modules` is the node_modules folder that has playwright-core. What a page may load is of the `schemes`. */
export async function openBrowser(modules, executablePath, { timeout = 10000, schemes = ["file", "data"] } = {}) {
  const { chromium } = createRequire(path.join(path.resolve(modules), "test.js"))("playwright-core");
  const browser = await chromium.launch({ executablePath, args: ARGUMENTS });
  const failures = [];
  const allowed = new RegExp(`^(${schemes.join("|")}):`);
  return {
    /** Opens the page in a fresh context, runs the check, then demands silence on the console and on the network. */
    async check(name, options, address, body) {
      const context = await browser.newContext(options);
      const page = await context.newPage();
      page.setDefaultTimeout(timeout);
      const complaints = [];
      page.on("console", (message) => ["error", "warning"].includes(message.type()) && complaints.push(`console: ${message.text()}`));
      page.on("pageerror", (error) => complaints.push(`script: ${error.message}`));
      page.on("request", (request) => !allowed.test(request.url()) && complaints.push(`request: ${request.url()}`));
      try {
        await page.goto(address);
        await body(page);
        assert.deepEqual(complaints, []);
        console.log(`ok    ${name}`);
      } catch (error) {
        failures.push(name);
        console.log(`FAIL  ${name}\n${error.stack}\n${complaints.join("\n")}`);
      }
      await context.close();
    },
    /** Says how it went, `others` that failed included, and ends the program with it. */
    async end(others = []) {
      await browser.close();
      failures.push(...others);
      console.log(failures.length === 0 ? "all held" : `failed: ${failures.join("; ")}`);
      process.exit(failures.length === 0 ? 0 : 1);
    },
  };
}
