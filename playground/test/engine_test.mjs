// node engine_test.mjs ENGINE_JS ENGINE_WASM SPF_PROGRAM FOLDER: the engine under node, beside the native program. Exit 0 = all held.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const [script, bytes, program, folder] = process.argv.slice(2);
const engine = await createRequire(import.meta.url)(path.resolve(script))({ wasmBinary: readFileSync(bytes) });
const ask = (name, ...values) => JSON.parse(engine.ccall(name, "string", values.map((value) => typeof value), values));
const begin = (scene) => ask("spf_begin", JSON.stringify(scene));
const change = (one) => ask("spf_change", JSON.stringify(one));

function toTheEnd(scenario, step) {
  let answer = begin({ scenario });
  for (let time = step; !answer.outcome && time < 200; time += step) answer = ask("spf_advance", time);
  return answer;
}

/** What the native program says of the first trial of the same file. */
function native(scenario, name) {
  const out = path.join(folder, name);
  rmSync(out, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  writeFileSync(`${out}.yaml`, JSON.stringify(scenario));  // JSON is YAML
  execFileSync(program, ["run", `${out}.yaml`, "--out", out, "--quiet"], { stdio: "ignore" });
  const log = readdirSync(out, { recursive: true }).find((file) => file.endsWith("trials.jsonl"));
  return JSON.parse(readFileSync(path.join(out, log), "utf8").trim().split("\n").pop());
}

const checks = {
  "a trial is the same in steps of any length"() {
    const scenario = { family: "t2" };
    const whole = toTheEnd(scenario, 100), steps = toTheEnd(scenario, 0.05);
    assert.equal(whole.digest, steps.digest);
    assert.equal(whole.ended, steps.ended);
  },
  // The arithmetic is the same, the C library's sine and its like are others (docs/playground.md), and what a trial makes of a
  // last place grows: so no digest, but the outcome, and the time as nearly as a trial with other small errors would have it.
  "a trial ends as that of the native program"() {
    for (const scenario of [{ family: "t2" }, { family: "p8" }]) {
      const here = toTheEnd(scenario, 100), there = native(scenario, "native");
      assert.equal(here.outcome, there.outcome);
      assert.ok(Math.abs(here.ended / there.sim_time - 1) < 0.05, `${here.ended} s here, ${there.sim_time} s there`);
    }
  },
  "what is told moves and what is drawn stands"() {
    begin({ scenario: { family: "t2" }, changes: [{ do: "crowd", people: 3 }] });
    const told = ask("spf_advance", 1).run;
    const people = told.obstacles.length;
    assert.deepEqual(change({ do: "wall", from: [-2, 9], to: [2, 9] }), {});
    assert.deepEqual(change({ do: "person", at: [-10, 10], to: [-6, 10] }), {});
    assert.deepEqual(change({ do: "robot", robot: 0, at: [9, -9] }), {});
    assert.deepEqual(change({ do: "risk", seconds: 5 }), {});
    const { run } = ask("spf_advance", 2);
    assert.equal(run.obstacles.length, people + 1);
    assert.equal(run.map.boxes.length, told.map.boxes.length + 1);
    assert.ok(Math.abs(run.robots[0].x[0] - 9000) < 1000 && Math.abs(run.robots[0].y[0] + 9000) < 1000);
  },
  "no plan and no goal is lost between two frames"() {
    begin({ scenario: { family: "t2" } });
    ask("spf_advance", 0.42);
    change({ do: "goal", robot: 0, at: [9, -9] });
    const parts = [0.44, 0.46, 0.48, 0.52].map((time) => ask("spf_advance", time).run).filter(Boolean);
    assert.deepEqual(parts.flatMap((run) => run.robots[0].goals ?? []).map((goal) => goal.at), [[9000, -9000]]);
  },
  "what cannot be is refused, and the scene goes on"() {
    begin({ scenario: { family: "t2" } });
    assert.match(change({ do: "goal", robot: 99, at: [0, 0] }).error, /robot = 99, of which there are/);
    assert.match(change({ do: "goal", robot: 0, at: [0, 1e9] }).error, /at = .* must be \[x, y\] in \[-1000, 1000\] m/);
    assert.match(change({ do: "pillar", at: [0, 0], radius: -1 }).error, /radius = -1/);
    assert.match(change({ do: "fly" }).error, /do = "fly" must be one of goal, robot/);
    assert.match(change({ do: "goal", robot: 0, at: [100, 100] }).error, /border/);
    assert.match(begin({ scenario: { family: "t2", robot: 3 } }).error, /robot/);
    assert.match(begin({ scenario: { family: "nothing" } }).error, /family/);
    assert.match(ask("spf_begin", "{").error, /scene/);
    assert.equal(ask("spf_advance", 1).error, undefined);
  },
};

let failed = 0;
for (const [name, body] of Object.entries(checks)) {
  try {
    body();
    console.log(`ok    ${name}`);
  } catch (error) {
    ++failed;
    console.log(`FAIL  ${name}\n${error.stack}`);
  }
}
process.exit(failed ? 1 : 0);
