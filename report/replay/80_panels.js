// Words and numbers beside the scene: the chosen robot, its candidates, events, summary.

const detailCells = new Map();

function showDetail(name, text) {
  if (!detailCells.has(name)) {
    const cell = make("dd");
    document.getElementById("details").append(make("div", {}, make("dt", { textContent: name }), cell));
    detailCells.set(name, cell);
  }
  setText(detailCells.get(name), text);
}

function speedNow(robot) {
  if (run.frames < 2) return NaN;
  const low = Math.min(Math.floor(frameNow()), run.frames - 2);
  return Math.hypot(robot.x[low + 1] - robot.x[low], robot.y[low + 1] - robot.y[low]) / run.interval;
}

function clearanceText(robot, kind, noun) {
  const { distance, index } = robot.clearance[kind];
  const gap = nowIn(distance), which = nowIn(index);
  return `${formatted(gap, 2)} m${Number.isFinite(gap) && which >= 0 ? ` to ${noun}${which}` : ""}`;
}

function paintDetails() {
  const robot = state.robot;
  if (!robot || run.frames === 0) return;
  const frame = frameNow();
  const x = sample(robot.x, frame), y = sample(robot.y, frame);
  const status = run.states[nowIn(robot.state)];
  const line = document.getElementById("state");
  setText(line, status.text);
  line.dataset.kind = status.kind;
  showDetail("Position", `${formatted(x, 2)}, ${formatted(y, 2)} m`);
  showDetail("Heading", `${formatted((sampleAngle(robot.heading, frame) * 180) / Math.PI, 0)}\u00b0`);
  showDetail("Speed", `${formatted(speedNow(robot), 2)} m/s`);
  const goal = goalNow(robot);
  showDetail("To the goal", `${formatted(Math.hypot(goal.x - x, goal.y - y), 2)} m`);
  const error = Math.hypot(sample(robot.estimateX, frame) - x, sample(robot.estimateY, frame) - y);
  showDetail("Estimate off by", `${formatted(100 * error, 1)} cm (\u03c3 ${formatted(100 * sample(robot.sigmaLong, frame), 1)} cm)`);
  showDetail("Gap to moving", clearanceText(robot, "obstacle", "O"));
  showDetail("Gap to robots", clearanceText(robot, "peer", "robot "));
  showDetail("Gap to static", clearanceText(robot, "static", "no. "));
}

let shownPlan;
function paintCandidates() {
  const plan = state.robot && planNewest(state.robot, state.time);
  const note = document.getElementById("plan-note");
  if (plan === shownPlan) return;
  shownPlan = plan;
  const list = document.getElementById("candidates");
  if (!plan) {
    note.textContent = "none yet";
    list.replaceChildren();
    return;
  }
  note.textContent = `at ${formatted(plan.time, 1)} s: ${plan.outcome}, ${formattedDuration(plan.computing)}`;
  list.replaceChildren(...plan.candidates.map((candidate, index) => {
    const key = make("span", { className: "key", textContent: candidateKey(index) });
    const figures = [
      candidate.cost === null ? "" : `cost ${formatted(candidate.cost, 1)}`,
      candidate.risk === null ? "" : `risk ${formatted(candidate.risk, 3)}`,
    ].filter(Boolean).join(", ");
    return make("li", { className: candidate.chosen ? "chosen" : "" }, key,
      make("span", { className: "label", textContent: candidate.label }), make("span", { className: "figures", textContent: figures }));
  }));
}

const EVENT_LIMIT = 500;
let listedEvents = [];  // [event, button]
let currentEvent = null;

function listEvents() {
  const kind = document.getElementById("event-kind").value;
  const own = document.getElementById("event-own").checked;
  const wanted = run.events.filter((event) => (kind === "all" || event.kind === kind) &&
    (!own || event.robot === state.robot?.id));
  listedEvents = wanted.slice(0, EVENT_LIMIT).map((event) => [event, eventButton(event)]);
  const rows = listedEvents.map(([, button]) => make("li", {}, button));
  if (wanted.length === 0) rows.push(make("li", { className: "empty", textContent: "None." }));
  if (wanted.length > EVENT_LIMIT) rows.push(make("li", { className: "empty", textContent: `${wanted.length - EVENT_LIMIT} more: choose one kind or one robot.` }));
  document.getElementById("events").replaceChildren(...rows);
  currentEvent = null;
}

function eventButton(event) {
  const button = make("button", { type: "button" },
    make("time", { textContent: `${formatted(event.time, 1)} s` }),
    make("span", { className: `mark ${event.kind}`, textContent: MARKS[event.kind], ariaHidden: "true" }),
    make("span", { className: "text", textContent: describeEvent(event) }));
  button.addEventListener("click", () => {
    pause();
    chooseRobot(robotWithId(event.robot));
    setTime(event.time);
    announceTime();
  });
  return button;
}

/** Marks the last listed event that has happened, and scrolls the list (never the page) to it. */
function paintCurrentEvent() {
  const index = lastBefore(listedEvents.map(([event]) => event), state.time);
  const button = index < 0 ? null : listedEvents[index][1];
  if (button === currentEvent) return;
  currentEvent?.removeAttribute("aria-current");
  currentEvent = button;
  if (!button) return;
  button.setAttribute("aria-current", "true");
  const list = document.getElementById("events");
  const top = button.offsetTop - list.offsetTop;
  if (top < list.scrollTop || top + button.offsetHeight > list.scrollTop + list.clientHeight) list.scrollTop = top - list.clientHeight / 2;
}

function fillHeader() {
  const outcome = document.getElementById("outcome");
  document.getElementById("title").textContent = run.title;
  outcome.textContent = `${run.success ? "\u2713" : "\u2715"} ${run.outcome}`;
  outcome.classList.add(run.success ? "good" : "bad");
  const facts = [["family", run.family], ["method", run.method], ["noise", `${run.noise}${run.level === null ? "" : ` ${run.level} \u03a3`}`],
    ["tracking", run.tracking], ["trial", String(run.trial)], ["seed", run.seed], ["robots", String(run.robots.length)]];
  document.getElementById("facts").append(...facts.filter(([, value]) => value).map(([name, value]) =>
    make("div", {}, make("dt", { textContent: name }), make("dd", { textContent: value }))));
  document.querySelector("#summary tbody").append(...run.summary.map(([name, value]) =>
    make("tr", {}, make("th", { scope: "row", textContent: name }), make("td", { textContent: value }))));
}

function fillLayers() {
  document.getElementById("layers").append(...LAYERS.map(([name, label, on]) => {
    const box = make("input", { type: "checkbox", checked: on, id: `layer-${name}` });
    box.addEventListener("change", () => {
      layers[name] = box.checked;
      repaint();
    });
    return make("label", { className: "check" }, box, label);
  }));
}
