// The engine's thread, and the clock that both keep: it computes a little ahead of what is shown.

const LEAD = 0.15;  // [s] of real time that the engine is ahead
const engine = { worker: null, number: 0, asked: 0, begun: false, outcome: null, digest: "", computing: 0, told: null };

function startEngine() {
  const text = (id) => byId(id).textContent;
  const script = new Blob([text("engine-script"), text("worker-script")], { type: "text/javascript" });
  engine.worker = new Worker(URL.createObjectURL(script));
  engine.worker.onmessage = ({ data }) => hear(data);
  engine.worker.onerror = (event) => say(`The engine stopped: ${event.message}`, true);
  const bytes = Uint8Array.from(atob(text("engine-bytes")), (character) => character.charCodeAt(0));
  engine.worker.postMessage({ wasm: bytes });
}

function hear(answer) {
  if (answer.ready) return beginScene();
  if (answer.number !== engine.number) return undefined;  // of a scene before
  engine.computing += answer.computed;
  if (answer.error) return refused(answer);
  if (answer.changed) return undefined;
  if (answer.begun) clearForScene();
  Object.assign(engine, { outcome: answer.outcome, digest: answer.digest, ended: answer.ended });
  if (answer.run) {
    appendRun(decodeRun(answer.run));
    runHasGrown(answer.begun);
  }
  return undefined;
}

/** What the engine does not do, it says why: a change is taken back, and with a scene that cannot run the last one stays. */
function refused({ error, changed }) {
  say(error, true);
  if (changed) takeBack(changed); else engine.begun = run.frames > 0;
}

/** Begins the scene of the form, with the changes made so far. */
function beginScene() {
  ++engine.number;
  engine.worker.postMessage({ begin: scene, number: engine.number });
}

function clearForScene() {
  clearRun();
  Object.assign(engine, { asked: 0, begun: true });
  Object.assign(state, { time: 0, robot: null });
  measured.reset();
}

/** Asks for as much as is shown soon. */
function keepAhead() {
  if (!state.playing || !engine.begun) return;
  const wanted = state.time + run.dropped + run.interval + LEAD * Math.max(1, state.speed);
  if (wanted < engine.asked + 0.02) return;
  engine.asked = wanted;
  engine.worker.postMessage({ until: wanted });
}

/** Pictures a second, and how much of its time the engine computes, over the last second. */
const measured = {
  times: [], since: 0, shown: "",
  reset() { Object.assign(this, { times: [], since: performance.now(), from: state.time + run.dropped }); engine.computing = 0; },
  picture() {
    if (!state.playing) return this.reset();
    const now = performance.now();
    this.times.push(now);
    if (now - this.since < 1000) return undefined;
    const seconds = (now - this.since) / 1000;
    const ratio = (state.time + run.dropped - this.from) / seconds;
    engine.told = { pictures: this.times.length / seconds, ratio, share: engine.computing / 1000 / seconds };
    this.shown = `${formatted(engine.told.pictures, 0)} pictures a second, ${formatted(ratio, 2)}\u00d7 real time, engine busy ${formatted(100 * engine.told.share, 0)} %`;
    return this.reset();
  },
};

function paintMeasured() {
  measured.picture();
  const ended = engine.outcome ? `trial: ${engine.outcome} at ${formatted(engine.ended, 1)} s` : "";
  setText(byId("measured"), [measured.shown, ended].filter(Boolean).join("; "));
}
