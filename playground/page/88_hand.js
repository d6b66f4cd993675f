// What the hand holds: robots, goals and obstacles that are dragged, walls and people that are drawn, by mouse, touch and keys.

const TOOLS = { move: "Move", wall: "Wall", person: "Person", pillar: "Pillar" };
const PILLAR = 0.5;    // [m] radius
const NEAR = 16;       // [px] a finger's width
let tool = "move";
let hand = null;       // {kind, robot or obstacle, x, y, from} [m]; `from` once a wall or a way has begun
let byKeys = false;    // it is moved by the arrow keys

const rounded = (value) => Math.round(value * 100) / 100;
const place = ({ x, y }) => [rounded(x), rounded(y)];
const distanceTo = (x, y, position) => Math.hypot(toScreenX(x) - position.x, toScreenY(y) - position.y);

function chooseTool(name) {
  tool = name;
  hand = null;
  for (const button of byId("tools").children) button.setAttribute("aria-pressed", String(button.value === name));
  sceneCanvas.style.cursor = name === "move" ? "" : "crosshair";
  repaint();
}

/** What lies under the pointer: a robot, a goal or a moving obstacle. */
function thingAt(position) {
  const robot = robotNear(position.x, position.y);
  if (robot) return { kind: "robot", robot };
  const frame = frameNow();
  const under = (x, y, radius) => distanceTo(x, y, position) < radius * view.scale + NEAR;
  const obstacle = run.obstacles.find((one) => under(sample(one.x, frame), sample(one.y, frame), one.radius));
  if (obstacle) return { kind: "moving", obstacle };
  const goal = run.robots.find((one) => under(goalNow(one).x, goalNow(one).y, 0));
  return goal ? { kind: "goal", robot: goal } : null;
}

grab = (position) => {
  if (run.frames === 0) return null;
  const at = { x: toWorldX(position.x), y: toWorldY(position.y) };
  const held = tool === "move" ? thingAt(position) : { kind: tool, from: at };
  if (!held) return null;
  if (held.robot) chooseRobot(held.robot);
  byKeys = false;
  return {
    move(to) {
      hand = { ...held, x: toWorldX(to.x), y: toWorldY(to.y) };
      repaint();
    },
    drop(to, wasMoved) {
      if (tool === "move" && !wasMoved) return;
      hand = { ...held, x: toWorldX(to.x), y: toWorldY(to.y) };
      if (tool === "wall" && !wasMoved) say("Drag to draw a wall."); else putDown(wasMoved);
      hand = null;
    },
    leave() { hand = null; repaint(); },
  };
};

/** A person whose way was not drawn walks through the middle of what is shown. */
const acrossTheMiddle = ({ x, y }) => {
  const [left, bottom, right, top] = run.bounds;
  const dx = (left + right) / 2 - x, dy = (bottom + top) / 2 - y, length = Math.hypot(dx, dy) || 1;
  return { x: x + (dx / length) * 6, y: y + (dy / length) * 6 };
};

/** Makes the change that what is held stands for. */
function putDown(wayDrawn = true) {
  const { kind, robot, obstacle, from } = hand;
  if (kind === "robot") changeScene({ do: "robot", robot: robot.id, at: place(hand) });
  else if (kind === "goal") changeScene({ do: "goal", robot: robot.id, at: place(hand) });
  else if (kind === "moving") changeScene({ do: "moving", id: obstacle.id, at: place(hand) });
  else if (kind === "wall") changeScene({ do: "wall", from: place(from), to: place(hand) });
  else if (kind === "pillar") changeScene({ do: "pillar", at: place(hand), radius: PILLAR });
  else changeScene({ do: "person", at: place(from), to: place(wayDrawn ? hand : acrossTheMiddle(from)) });
  repaint();
}

// ---- keys: take, move by the arrows, Enter

function takeByKeys(kind) {
  const robot = state.robot, frame = frameNow();
  if (run.frames === 0) return;
  pause();
  byKeys = true;
  let at = { x: view.x, y: view.y };
  if (kind === "robot" || kind === "goal") {
    if (!robot) return;
    at = kind === "goal" ? goalNow(robot) : { x: sample(robot.x, frame), y: sample(robot.y, frame) };
    if (!Number.isFinite(at.x)) at = { x: view.x, y: view.y };
  }
  const obstacle = kind === "moving" ? run.obstacles[(run.obstacles.indexOf(hand?.obstacle) + 1) % run.obstacles.length] : null;
  if (kind === "moving" && !obstacle) return;
  if (obstacle) at = { x: sample(obstacle.x, frame), y: sample(obstacle.y, frame) };
  hand = { kind, robot, obstacle, x: at.x, y: at.y };
  const names = { robot: `Robot ${robot?.id}`, goal: `Goal of robot ${robot?.id}`, moving: `Obstacle ${obstacle?.id}`, wall: "A wall", person: "A person", pillar: "A pillar" };
  say(`${names[kind]}: move with the arrow keys (Shift: farther), Enter puts it down, Escape leaves it.`);
  sceneCanvas.focus({ preventScroll: true });
  repaint();
}

const DIRECTIONS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** Whether the key was for the hand. */
function handTakesKey(event) {
  if (!hand || !byKeys) return false;
  const direction = DIRECTIONS[event.key];
  if (direction) {
    const step = (event.shiftKey ? 50 : 10) / view.scale;
    hand.x += step * direction[0];
    hand.y += step * direction[1];
    announce(`${formatted(hand.x, 1)}, ${formatted(hand.y, 1)} metres`);
  } else if (event.key === "Escape") {
    hand = null;
  } else if (event.key === "Enter") {
    if ((hand.kind === "wall" || hand.kind === "person") && !hand.from) {
      hand.from = { x: hand.x, y: hand.y };
      say("Now to its other end, and Enter.");
    } else {
      putDown();
      hand = null;
      say("Done. Space lets it run.");
    }
  } else {
    return false;
  }
  repaint();
  return true;
}

// ---- picture

function paintHand() {
  if (!hand) return;
  const { kind, x, y, from } = hand;
  const color = hand.robot ? colors[hand.robot.color] : kind === "wall" || kind === "pillar" ? colors.wall : colors.obstacle;
  if (from && kind !== "pillar") strokePath([[from.x, from.y], [x, y]], color, kind === "wall" ? 4 : 2, kind === "wall" ? [] : [6, 5]);
  const radius = { robot: hand.robot?.radius, moving: hand.obstacle?.radius, person: 0.25, pillar: PILLAR }[kind] ?? 0.15;
  const at = kind === "person" && from ? from : { x, y };
  circlePath(at.x, at.y, radius);
  pen.fillStyle = faded(color, 0.45);
  pen.fill();
  pen.strokeStyle = color;
  pen.lineWidth = 2;
  pen.setLineDash([4, 3]);
  pen.stroke();
  pen.setLineDash([]);
  if (kind === "goal") drawGoal({ ...hand.robot, goal: { x, y }, goals: [] }, true);
  drawCross(toScreenX(x), toScreenY(y), 9, colors.text, 1.5);
}
