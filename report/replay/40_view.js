// Where the scene's canvas looks: pan and zoom by mouse, touch and keyboard.

const sceneCanvas = document.getElementById("scene");
const view = { x: 0, y: 0, scale: 1, width: 1, height: 1, fitted: true };  // centre [m], [px/m], [px]

const toScreenX = (x) => view.width / 2 + (x - view.x) * view.scale;
const toScreenY = (y) => view.height / 2 - (y - view.y) * view.scale;
const toWorldX = (px) => view.x + (px - view.width / 2) / view.scale;
const toWorldY = (py) => view.y - (py - view.height / 2) / view.scale;

function fitScale() {
  const [left, bottom, right, top] = run.bounds;
  return 0.93 * Math.min(view.width / (right - left), view.height / (top - bottom));
}

function fitView() {
  const [left, bottom, right, top] = run.bounds;
  view.x = (left + right) / 2;
  view.y = (bottom + top) / 2;
  view.scale = fitScale();
  view.fitted = true;
  setFollow(false);
  repaint();
}

/** Zooms about a point of the screen, which stays where it is. */
function zoomAt(px, py, factor) {
  const x = toWorldX(px), y = toWorldY(py);
  const least = 0.4 * fitScale();
  view.scale = Math.min(Math.max(view.scale * factor, least), 200 * least);
  if (!state.follow) {
    view.x = x - (px - view.width / 2) / view.scale;
    view.y = y + (py - view.height / 2) / view.scale;
  }
  view.fitted = false;
  repaint();
}

const zoomBy = (factor) => zoomAt(view.width / 2, view.height / 2, factor);

function panBy(dx, dy) {
  view.x -= dx / view.scale;
  view.y += dy / view.scale;
  view.fitted = false;
  setFollow(false);
  repaint();
}

function setFollow(on) {
  state.follow = on;
  if (on && view.scale < 2 * fitScale()) view.scale = 2 * fitScale();
  if (on) view.fitted = false;
  document.getElementById("follow").setAttribute("aria-pressed", String(on));
  repaint();
}

function robotNear(px, py) {
  let nearest = null, best = Infinity;
  for (const robot of run.robots) {
    const dx = toScreenX(sample(robot.x, frameNow())) - px, dy = toScreenY(sample(robot.y, frameNow())) - py;
    const beyond = Math.hypot(dx, dy) - robot.radius * view.scale;
    if (beyond < 14 && beyond < best) {
      best = beyond;
      nearest = robot;
    }
  }
  return nearest;
}

const pointers = new Map();
let moved = 0;
// A page whose scene can be changed takes over presses: grab(position) returns null or what follows the pointer, with
// move(position), drop(position) and leave().
let grab = () => null;
let grabbed = null;

function letGo() {
  grabbed?.leave();
  grabbed = null;
}

function pointerPosition(event) {
  const box = sceneCanvas.getBoundingClientRect();
  return { x: event.clientX - box.left, y: event.clientY - box.top };
}

function middleAndSpread() {
  const [a, b] = [...pointers.values()];
  return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, spread: Math.max(8, Math.hypot(a.x - b.x, a.y - b.y)) };
}

sceneCanvas.addEventListener("pointerdown", (event) => {
  sceneCanvas.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, pointerPosition(event));
  moved = pointers.size === 1 ? 0 : Infinity;
  letGo();
  if (pointers.size === 1) grabbed = grab(pointerPosition(event));
});

sceneCanvas.addEventListener("pointermove", (event) => {
  if (!pointers.has(event.pointerId)) return;
  const before = pointers.size === 2 ? middleAndSpread() : pointers.get(event.pointerId);
  const position = pointerPosition(event);
  pointers.set(event.pointerId, position);
  if (pointers.size === 2) {
    const after = middleAndSpread();
    zoomAt(after.x, after.y, after.spread / before.spread);
    panBy(after.x - before.x, after.y - before.y);
  } else if (pointers.size === 1) {
    moved += Math.hypot(position.x - before.x, position.y - before.y);
    if (moved <= 4) return;
    if (grabbed) grabbed.move(position); else panBy(position.x - before.x, position.y - before.y);
  }
});

sceneCanvas.addEventListener("pointerup", (event) => {
  const position = pointerPosition(event);
  if (!pointers.delete(event.pointerId)) return;
  if (moved <= 4) chooseRobot(robotNear(position.x, position.y));
  grabbed?.drop(position, moved > 4);
  grabbed = null;
});
sceneCanvas.addEventListener("pointercancel", (event) => {
  pointers.delete(event.pointerId);
  letGo();
});

// The wheel scrolls the page as everywhere, until the scene has been clicked (or with Ctrl).
sceneCanvas.addEventListener("wheel", (event) => {
  if (document.activeElement !== sceneCanvas && !event.ctrlKey && !event.metaKey) return;
  event.preventDefault();
  const position = pointerPosition(event);
  zoomAt(position.x, position.y, Math.exp(-Math.sign(event.deltaY) * Math.min(Math.abs(event.deltaY), 120) * 0.0018));
}, { passive: false });

/** The outline of a robot: of its disc, or through its corners. */
function bodyPath(robot, x, y, heading) {
  if (robot.corners.length === 0) return circlePath(x, y, robot.radius);
  const cosine = Math.cos(heading), sine = Math.sin(heading);
  pen.beginPath();
  for (const corner of robot.corners)
    pen.lineTo(toScreenX(x + cosine * corner.x - sine * corner.y), toScreenY(y + sine * corner.x + cosine * corner.y));
  pen.closePath();
}
