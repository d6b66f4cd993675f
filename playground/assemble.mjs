// node assemble.mjs ENGINE_JS ENGINE_WASM OUTPUT: one page from the engine, the scripts of the replay page that draw, and those of
// the playground.
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const replay = join(here, "../report/replay"), own = join(here, "page");
const [engineScript, engineBytes, output] = process.argv.slice(2);
const text = (path) => readFileSync(path, "utf8");

// The replay page's own run, charts and beginning stay behind.
const LEFT_OUT = ["15_run.js", "60_charts.js", "90_main.js"];
const numbered = (folder) => readdirSync(folder).filter((name) => /^\d.*\.js$/.test(name)).map((name) => [name, join(folder, name)]);
const scripts = [...numbered(replay).filter(([name]) => !LEFT_OUT.includes(name)), ...numbered(own)]
  .sort(([a], [b]) => (a < b ? -1 : 1)).map(([, path]) => text(path)).join("");

const wasmBinary = readFileSync(engineBytes);
const engine = await createRequire(import.meta.url)(engineScript)({ wasmBinary });
const palette = engine.ccall("spf_palette", "string", [], []);

// What both pages have: marked in that of the replay.
const marked = text(join(replay, "replay.html")).matchAll(/<!-- shared: ([a-z]+) -->\n(.*?)\n *<!-- end -->/gs);
const shared = Object.fromEntries([...marked].map(([, name, markup]) => [name.toUpperCase(), markup]));

const parts = {
  ...shared,
  STYLE: palette + text(join(replay, "replay.css")) + text(join(own, "page.css")), BYTES: wasmBinary.toString("base64"),
  ENGINE: text(engineScript), WORKER: text(join(own, "engine_worker.js")), SCRIPT: scripts,
};
for (const name of ["ENGINE", "WORKER", "SCRIPT"]) {
  if (/<\/script|<!--/i.test(parts[name])) throw new Error(`${name} would end its script element`);
}
const page = text(join(own, "page.html")).replace(/@([A-Z]+)@/g, (mark, name) => {
  if (parts[name] === undefined) throw new Error(`page.html: there is no ${mark}`);
  return parts[name];
});
writeFileSync(output, page);
console.log(`${output}: ${(page.length / 1e6).toFixed(2)} MB`);
