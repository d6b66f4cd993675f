// The engine on a thread of its own, so that a long plan never holds up the picture. Messages in: {wasm}, {begin: scene, number},
// {until: time}, {change}. Out: what the engine answers, with the number of the scene, and how long it computed.

let engine = null;
let number = 0;
let target = 0, now = 0;
let running = false;

function ask(name, ...values) {
  const started = performance.now();
  const answer = JSON.parse(engine.ccall(name, "string", values.map((value) => typeof value), values));
  return { ...answer, computed: performance.now() - started, number };
}

const SLICE = 0.05;  // [s] simulated, after which messages are looked at
const next = new MessageChannel();
next.port1.onmessage = () => {
  if (now >= target - 1e-9) {
    running = false;
    return;
  }
  const answer = ask("spf_advance", Math.min(now + SLICE, target));
  if (answer.error) target = now; else now = answer.time;
  postMessage(answer);
  next.port2.postMessage(0);
};

function goOn() {
  if (running) return;
  running = true;
  next.port2.postMessage(0);
}

onmessage = async ({ data }) => {
  if (data.wasm) {
    engine = await makeEngine({ wasmBinary: data.wasm });
    postMessage({ ready: true });
  } else if (data.begin) {
    const answer = ask("spf_begin", JSON.stringify(data.begin));
    if (!answer.error) {
      number = data.number;
      target = now = answer.time;
    }
    postMessage({ ...answer, number: data.number, begun: !answer.error });
  } else if (data.change) {
    postMessage({ ...ask("spf_change", JSON.stringify(data.change)), changed: data.change });
  } else if (data.until > target) {
    target = data.until;
    goOn();
  }
};
