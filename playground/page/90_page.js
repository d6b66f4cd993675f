// Puts the playground together.

/** A word to whoever plays: shown for a while, and read out. */
let saidAt = 0;
function say(text, isProblem = false) {
  const line = byId("said");
  setText(line, text);
  line.classList.toggle("problem", isProblem);
  saidAt = performance.now();
  announce(text);
}

function paintSaid() {
  if (saidAt && performance.now() - saidAt > 8000 && !hand) {
    saidAt = 0;
    setText(byId("said"), "");
  }
}

/** More of the run has come; of a new one the first. */
function runHasGrown(isNew) {
  slider.max = String(Math.max(0, run.frames - 1));
  if (isNew) {
    listRobots();
    state.robot = run.robots[0] ?? null;
    if (view.fitted) fitView();
  }
  if (listedEvents.length !== Math.min(run.events.length, EVENT_LIMIT) || isNew) listEvents();
  byId("loading").hidden = true;
  repaint();
}

function addTools() {
  for (const [name, words] of Object.entries(TOOLS)) {
    const button = make("button", { type: "button", value: name, textContent: words });
    button.addEventListener("click", () => chooseTool(name));
    byId("tools").append(button);
  }
  chooseTool("move");
}

/** Nothing was asked of the engine yet, so that what is moved is where it begins. */
const restartNow = () => { restart(); say("From the beginning."); };
const another = () => { byId("trial").value = String(scene.trial + 1); formChanged("trial"); };

Object.assign(KEYS, {
  m: () => takeByKeys("robot"), g: () => takeByKeys("goal"), o: () => takeByKeys("moving"), k: () => takeByKeys("wall"),
  x: () => takeByKeys("person"), i: () => takeByKeys("pillar"), r: restartNow, e: another,
});
KEY_WORDS.unshift(["m g", "take the chosen robot, its goal"], ["o", "take an obstacle, the next one"], ["k x i", "a wall, a person, a pillar"],
  ["Enter Escape", "put down, leave"], ["r e", "from the beginning, another scene"]);
keyTaker = handTakesKey;

whenAtEnd = () => {};
painters.push(paintControls, paintScene, paintHand, paintTimeline, paintSlider, paintNow, paintDetails, paintCandidates, paintEvents,
  paintWheels, paintMeasured, paintSaid);

/** Once for every picture while it runs. */
function beat() {
  keepAhead();
  if (state.playing || saidAt) repaint();
  requestAnimationFrame(beat);
}

addTools();
fillForm();
fillLayers();
connect();
byId("restart").addEventListener("click", restartNow);
byId("another").addEventListener("click", another);
byId("share").addEventListener("click", shareLink);
window.addEventListener("hashchange", () => {
  if (location.hash === writtenLink) return;
  readLink();
  restart();
});
readColors();
readLink();
showForm();
writeLink();
themeChanged();
startEngine();
play();
requestAnimationFrame(beat);
