// What is pressed: playback, theme, keys.

const byId = (id) => document.getElementById(id);
const robotSelect = byId("robot"), speedSelect = byId("speed"), playButton = byId("play");

function paintControls() {
  const label = state.playing ? "Pause" : "Play";
  if (playButton.getAttribute("aria-label") !== label) {
    playButton.setAttribute("aria-label", label);
    playButton.firstElementChild.className = `icon icon-${label.toLowerCase()}`;
  }
  const clock = byId("clock");
  const text = formatted(state.time, 1);
  if (clock.firstChild?.data !== text) clock.replaceChildren(text, make("small", { textContent: ` / ${formatted(run.duration, 1)} s` }));
  if (speedSelect.value !== String(state.speed)) speedSelect.value = String(state.speed);
  const chosen = state.robot ? String(state.robot.id) : "";
  if (robotSelect.value !== chosen) robotSelect.value = chosen;
  if (!state.playing) sceneCanvas.setAttribute("aria-label", sceneWords());
}

function sceneWords() {
  const robot = state.robot;
  const status = robot && run.frames > 0 ? ` Robot ${robot.id}: ${run.states[nowIn(robot.state)].text}.` : "";
  return `Scene with ${run.robots.length} robots and ${run.obstacles.length} moving obstacles at ${formatted(state.time, 1)} seconds.${status}`;
}

// Theme: the reader's system decides until the button is pressed.
const isDark = () => (document.documentElement.dataset.theme ?? (prefersDark.matches ? "dark" : "light")) === "dark";

function themeChanged() {
  readColors();
  byId("theme").textContent = isDark() ? "Light" : "Dark";
  byId("theme").setAttribute("aria-label", isDark() ? "Use light colours" : "Use dark colours");
  repaint();
}

function toggleTheme() {
  document.documentElement.dataset.theme = isDark() ? "light" : "dark";
  themeChanged();
}

// Keys.
let typedDigits = "", typedAt = 0;
function typeDigit(digit) {
  const now = performance.now();
  typedDigits = now - typedAt < 900 ? typedDigits + digit : digit;
  typedAt = now;
  chooseRobot(robotWithId(Number(typedDigits)) ?? robotWithId(Number(digit)));
}

const PAN = 60;  // [px]
const KEYS = {  // a page may add its own
  " ": togglePlay,
  ArrowLeft: (event) => stepFrames(event.shiftKey ? -Math.round(1 / run.interval) : -1),
  ArrowRight: (event) => stepFrames(event.shiftKey ? Math.round(1 / run.interval) : 1),
  PageUp: () => stepFrames(-Math.round(5 / run.interval)),
  PageDown: () => stepFrames(Math.round(5 / run.interval)),
  Home: () => { pause(); setTime(0); },
  End: () => { pause(); setTime(run.duration); },
  "[": () => changeSpeed(-1), "]": () => changeSpeed(1),
  ",": () => jumpToEvent(-1), ".": () => jumpToEvent(1),
  n: () => chooseNeighbour(1), p: () => chooseNeighbour(-1),
  "+": () => zoomBy(1.25), "=": () => zoomBy(1.25), "-": () => zoomBy(0.8), f: fitView,
  a: () => panBy(PAN, 0), d: () => panBy(-PAN, 0), w: () => panBy(0, PAN), s: () => panBy(0, -PAN),
  c: () => setFollow(!state.follow), t: toggleTheme, "?": () => byId("help").showModal(),
};
const KEY_WORDS = [
  ["Space", "play, pause"], ["\u2190 \u2192", "one frame (with Shift: one second)"], ["Page \u2191 \u2193", "five seconds"],
  ["Home End", "start, end"], ["[ ]", "slower, faster"], [", .", "last, next event"], ["0\u20139", "choose a robot by its number"],
  ["n p", "next, previous robot"], ["+ \u2212 f", "zoom in, out, show everything"], ["w a s d", "move the scene"],
  ["c", "follow the robot"], ["t", "light, dark"], ["?", "this list"],
];

/** Whether the focused control needs this key for itself. */
function isTaken(event) {
  const element = event.target;
  if (document.querySelector("dialog[open]") || event.ctrlKey || event.metaKey || event.altKey) return true;
  if (element instanceof HTMLSelectElement || ["number", "text"].includes(element.type)) return true;
  if (element.type === "range" && element !== slider) return true;
  const presses = element instanceof HTMLButtonElement || element.type === "checkbox" || element instanceof HTMLAnchorElement;
  if (presses) return event.key === " " || event.key === "Enter";
  const scrolls = element.closest?.(".events");
  return Boolean(scrolls) && ["PageUp", "PageDown", "Home", "End"].includes(event.key);
}

let keyTaker = () => false;  // a page may take keys before all others
document.addEventListener("keydown", (event) => {
  if (isTaken(event)) return;
  if (keyTaker(event)) {
    event.preventDefault();
    return;
  }
  if (/^[0-9]$/.test(event.key)) {
    typeDigit(event.key);
    return;
  }
  const action = KEYS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (!action) return;
  event.preventDefault();
  action(event);
});

function listRobots() {
  robotSelect.replaceChildren(...run.robots.map((robot) => make("option", { value: String(robot.id), textContent: `robot ${robot.id}` })));
}

function connect() {
  const click = (id, action) => byId(id).addEventListener("click", action);
  click("play", togglePlay);
  click("back", () => stepFrames(-1));
  click("forward", () => stepFrames(1));
  click("zoom-in", () => zoomBy(1.25));
  click("zoom-out", () => zoomBy(0.8));
  click("fit", fitView);
  click("follow", () => setFollow(!state.follow));
  click("theme", toggleTheme);
  click("help-open", () => byId("help").showModal());
  speedSelect.append(...SPEEDS.map((speed) => make("option", { value: String(speed), textContent: `${speed}\u00d7` })));
  speedSelect.setAttribute("aria-label", "Speed");
  speedSelect.addEventListener("change", () => setSpeed(Number(speedSelect.value)));
  listRobots();
  robotSelect.addEventListener("change", () => chooseRobot(robotWithId(Number(robotSelect.value))));
  byId("event-kind").addEventListener("change", () => { listEvents(); repaint(); });
  byId("event-own").addEventListener("change", () => { listEvents(); repaint(); });
  byId("keys").append(...KEY_WORDS.flatMap(([keys, words]) =>
    [make("dt", {}, ...keys.split(" ").flatMap((key, i) => [i ? " " : "", make("kbd", { textContent: key })])), make("dd", { textContent: words })]));
  prefersDark.addEventListener("change", themeChanged);
  // A canvas that changes size is cleared: draw in the same turn, before the browser shows it empty.
  const observer = new ResizeObserver(paintAll);
  document.querySelectorAll("canvas").forEach((canvas) => observer.observe(canvas));
}

function paintAll() {
  for (const paint of painters) paint();
}

let listedFor = null;
function paintEvents() {
  if (byId("event-own").checked && listedFor !== state.robot) listEvents();
  listedFor = state.robot;
  paintCurrentEvent();
}
