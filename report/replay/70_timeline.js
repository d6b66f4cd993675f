// Above the slider: the chosen robot's states as a band, and what happened as marks of different shape.

const timelineCanvas = document.getElementById("timeline");
const slider = document.getElementById("slider");
const EDGE = 8;  // [px] half the slider's thumb, so that both scales agree
const STATE_COLORS = { moving: "accent", braking: "caution", waiting: "caution", arrived: "good", trouble: "bad" };
const MARKS = { contact: "\u2715", stop: "\u25a0", arrival: "\u25b2", note: "\u2022" };

/** Unbroken runs of one state: [first frame, frame after the last, state]. */
function stateRuns(robot) {
  const runs = [];
  for (let k = 0; k < run.frames; ++k) {
    const last = runs[runs.length - 1];
    if (last && last[2] === robot.state[k]) last[1] = k + 1; else runs.push([k, k + 1, robot.state[k]]);
  }
  return runs;
}

function paintStateBand(context, x) {
  for (const [first, end, index] of stateRuns(state.robot)) {
    const { kind } = run.states[index];
    const left = x(first * run.interval), width = Math.max(1.5, x(end * run.interval) - left);
    const color = colors[STATE_COLORS[kind] || "control"];
    context.fillStyle = kind === "moving" ? faded(color, 0.28) : color;
    context.fillRect(left, 33, width, kind === "waiting" ? 5 : 9);
    if (kind === "waiting") context.fillRect(left, 40, width, 2);
  }
}

function paintMark(context, event, px) {
  const own = !state.robot || event.robot === state.robot.id;
  const color = { contact: colors.bad, stop: colors.caution, arrival: colors.good }[event.kind] || colors.muted;
  context.globalAlpha = own || event.kind === "contact" ? 1 : 0.45;
  context.strokeStyle = context.fillStyle = color;
  context.beginPath();
  if (event.kind === "contact") {
    context.lineWidth = 2.5;
    for (const side of [-5, 5]) {
      context.moveTo(px - side, 3);
      context.lineTo(px + side, 13);
    }
    context.stroke();
  } else if (event.kind === "arrival") {
    context.moveTo(px, 15);
    context.lineTo(px + 5, 24);
    context.lineTo(px - 5, 24);
    context.fill();
  } else if (event.kind === "stop") {
    context.fillRect(px - 3.5, 16, 7, 8);
  } else {
    context.fillRect(px - 0.5, 27, 1, 4);
  }
  context.globalAlpha = 1;
}

function paintTimeline() {
  const { context, width, height } = fitCanvas(timelineCanvas);
  const x = (time) => EDGE + (run.duration > 0 ? time / run.duration : 0) * (width - 2 * EDGE);
  context.clearRect(0, 0, width, height);
  context.fillStyle = colors.raised;
  context.fillRect(EDGE, 33, width - 2 * EDGE, 9);
  if (state.robot) paintStateBand(context, x);
  for (const event of run.events) paintMark(context, event, x(event.time));
  const now = Math.round(x(state.time)) + 0.5;
  context.strokeStyle = colors.text;
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(now, 0);
  context.lineTo(now, height);
  context.stroke();
}

function paintSlider() {
  const frame = Math.round(frameNow());
  if (Number(slider.value) !== frame) slider.value = String(frame);
  slider.style.setProperty("--done", `${run.duration > 0 ? (100 * state.time) / run.duration : 0}%`);
  if (!state.playing) slider.setAttribute("aria-valuetext", `${formatted(state.time, 1)} seconds`);
}

function describeEvent(event) {
  const who = event.robot >= 0 ? `robot ${event.robot}` : "";
  const whom = event.other ? `with ${event.other}` : "";
  const words = { contact: `contact ${whom}`, stop: "stop", arrival: "arrived", note: "" }[event.kind];
  return [[who, words].filter(Boolean).join(" ").trim(), event.text].filter(Boolean).join(": ");
}

/** One line under the slider: what happened last, for a while; then what comes next. */
function paintNow() {
  const line = document.getElementById("now");
  const next = run.events.find((event) => event.time > state.time + 1e-9);
  let text = next ? `next: ${formatted(next.time, 1)} s  ${describeEvent(next)}` : "";
  const last = lastBefore(run.events, state.time);
  if (last >= 0 && run.events[last].time > state.time - 3)
    text = `${formatted(run.events[last].time, 1)} s  ${describeEvent(run.events[last])}`;
  setText(line, text);
}

/** The next or last event. */
function jumpToEvent(direction) {
  const times = run.events.map((event) => event.time);
  const found = direction > 0 ? times.find((time) => time > state.time + 1e-3) : times.filter((time) => time < state.time - 1e-3).pop();
  if (found === undefined) return;
  pause();
  setTime(found);
  announceTime();
}

function announceTime() {
  const index = lastBefore(run.events, state.time);
  const event = index >= 0 && run.events[index].time > state.time - 0.05 ? run.events[index] : null;
  announce(`${formatted(state.time, 1)} seconds${event ? ", " + describeEvent(event) : ""}`);
}

slider.max = String(Math.max(0, run.frames - 1));
slider.addEventListener("input", () => {
  pause();
  setTime(Number(slider.value) * run.interval);
});
scrubOn(timelineCanvas, () => {
  const { left, width } = timelineCanvas.getBoundingClientRect();
  return { left: left + EDGE, width: width - 2 * EDGE };
});
