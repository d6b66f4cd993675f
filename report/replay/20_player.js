// What is shown now, and who is told when it changes.

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8, 16];

const state = { time: 0, playing: false, speed: 1, robot: null, follow: false };
const painters = [];  // called once per animation frame after a change
let paintPending = false;

/** Asks for one repaint in the next animation frame, however often it is called. */
function repaint() {
  if (paintPending) return;
  paintPending = true;
  requestAnimationFrame(() => {
    paintPending = false;
    for (const paint of painters) paint();
  });
}

/** Frame number, fractional, of the present time. */
const goalNow = (robot) => robot.goals.reduce((goal, next) => (next.time <= state.time + 1e-6 ? next.at : goal), robot.goal);
const frameNow = () => (run.frames < 2 ? 0 : state.time / run.interval);

function setTime(time) {
  state.time = Math.min(Math.max(Number.isFinite(time) ? time : 0, 0), run.duration);
  repaint();
}

/** Goes to a whole frame, so that repeated steps do not drift. */
function stepFrames(count) {
  pause();
  const frame = count < 0 ? Math.ceil(frameNow() - 1e-6) : Math.floor(frameNow() + 1e-6);
  setTime((frame + count) * run.interval);
}

let whenAtEnd = pause;  // a run that still grows goes on
let lastTick = null;
function tick(now) {
  if (!state.playing) return;
  if (lastTick !== null) setTime(state.time + Math.min((now - lastTick) / 1000, 0.25) * state.speed);
  lastTick = now;
  if (state.time >= run.duration) whenAtEnd();
  if (state.playing) requestAnimationFrame(tick);
}

function play() {
  if (state.playing || (run.duration <= 0 && whenAtEnd === pause)) return;
  if (state.time >= run.duration && whenAtEnd === pause) state.time = 0;
  state.playing = true;
  lastTick = null;
  requestAnimationFrame(tick);
  repaint();
}

function pause() {
  if (!state.playing) return;
  state.playing = false;
  repaint();
}

const togglePlay = () => (state.playing ? pause() : play());

function setSpeed(speed) {
  state.speed = SPEEDS.includes(speed) ? speed : 1;
  repaint();
}

function changeSpeed(steps) {
  const index = SPEEDS.indexOf(state.speed) + steps;
  setSpeed(SPEEDS[Math.min(Math.max(index, 0), SPEEDS.length - 1)]);
}

function chooseRobot(robot) {
  if (!robot || state.robot === robot) return;
  state.robot = robot;
  announce(`Robot ${robot.id} chosen`);
  repaint();
}

function chooseNeighbour(steps) {
  if (run.robots.length === 0) return;
  const index = run.robots.indexOf(state.robot) + steps;
  chooseRobot(run.robots[(index + run.robots.length) % run.robots.length]);
}

const robotWithId = (id) => run.robots.find((robot) => robot.id === id);

/** Said by screen readers. */
function announce(text) {
  document.getElementById("announce").textContent = text;
}
