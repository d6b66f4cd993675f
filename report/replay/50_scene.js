// The scene, drawn from back to front.

const LAYERS = [
  ["trails", "Trails", true], ["plans", "Plans", true], ["candidates", "Candidates", true], ["sensing", "Sensing range", true],
  ["perceived", "Perceived", true], ["fields", "Fields", true], ["estimate", "Estimate", true],
];
const layers = Object.fromEntries(LAYERS.map(([name, , on]) => [name, on]));
const cellsOf = new Map();  // robot -> PerceivedCells
const TRAIL_TIME = 8;       // [s] of the others; the chosen robot shows its whole path
const CANDIDATE_DASHES = [[7, 4], [2, 4], [10, 3, 2, 3], [4, 2], [12, 5], [1, 3], [8, 2, 1, 2, 1, 2], [5, 7]];

let pen = null;  // 2d context of the scene

function strokePath(points, style, width, dash = []) {
  if (points.length < 2) return;
  pen.beginPath();
  points.forEach(([x, y], i) => (i === 0 ? pen.moveTo(toScreenX(x), toScreenY(y)) : pen.lineTo(toScreenX(x), toScreenY(y))));
  pen.strokeStyle = style;
  pen.lineWidth = width;
  pen.setLineDash(dash);
  pen.stroke();
  pen.setLineDash([]);
}

function circlePath(x, y, radius) {
  pen.beginPath();
  pen.arc(toScreenX(x), toScreenY(y), Math.max(0, radius * view.scale), 0, 2 * Math.PI);
}

function drawGrid() {
  const step = Math.max(tickStep(view.width / view.scale, view.width / 70), 0.01);
  const decimals = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));
  pen.strokeStyle = colors.grid;
  pen.lineWidth = 1;
  pen.beginPath();
  const columns = [], rows = [];
  for (let i = Math.ceil(toWorldX(0) / step); i * step < toWorldX(view.width); ++i) columns.push(i * step);
  for (let i = Math.ceil(toWorldY(view.height) / step); i * step < toWorldY(0); ++i) rows.push(i * step);
  for (const x of columns) {
    pen.moveTo(Math.round(toScreenX(x)) + 0.5, 0);
    pen.lineTo(Math.round(toScreenX(x)) + 0.5, view.height);
  }
  for (const y of rows) {
    pen.moveTo(0, Math.round(toScreenY(y)) + 0.5);
    pen.lineTo(view.width, Math.round(toScreenY(y)) + 0.5);
  }
  pen.stroke();
  return { columns, rows, decimals };
}

/** Numbers along the left and lower edge, over everything else. */
function drawScales({ columns, rows, decimals }) {
  pen.font = `11px ${FONT}`;
  pen.fillStyle = colors.muted;
  pen.textBaseline = "bottom";
  pen.textAlign = "center";
  for (const x of columns) {
    if (toScreenX(x) > 44 && toScreenX(x) < view.width - 40) haloText(formatted(x, decimals), toScreenX(x), view.height - 4, colors.muted);
  }
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  for (const y of rows) {
    if (toScreenY(y) > 12 && toScreenY(y) < view.height - 24) haloText(formatted(y, decimals), 5, toScreenY(y), colors.muted);
  }
  pen.textBaseline = "bottom";
  pen.textAlign = "right";
  haloText("x, y [m]", view.width - 6, view.height - 4, colors.muted);
}

function haloText(text, x, y, color) {
  pen.lineJoin = "round";
  pen.lineWidth = 3;
  pen.strokeStyle = faded(colors.panel, 0.85);
  pen.strokeText(text, x, y);
  pen.fillStyle = color;
  pen.fillText(text, x, y);
}

function cornersPath(corners) {
  pen.moveTo(toScreenX(corners[0]), toScreenY(corners[1]));
  for (let i = 2; i < corners.length; i += 2) pen.lineTo(toScreenX(corners[i]), toScreenY(corners[i + 1]));
  pen.closePath();
}

function drawMap() {
  const [left, bottom, right, top] = run.bounds;
  pen.lineWidth = 1.5;
  pen.strokeStyle = colors.control;
  pen.strokeRect(toScreenX(left), toScreenY(top), (right - left) * view.scale, (top - bottom) * view.scale);
  pen.fillStyle = faded(colors.wall, 0.22);
  pen.strokeStyle = colors.wall;
  pen.lineWidth = 1.25;
  for (const [x0, y0, x1, y1] of run.boxes) {
    pen.beginPath();
    pen.rect(toScreenX(x0), toScreenY(y1), (x1 - x0) * view.scale, (y1 - y0) * view.scale);
    pen.fill();
    pen.stroke();
  }
  for (const [x, y, radius] of run.discs) {
    circlePath(x, y, radius);
    pen.fill();
    pen.stroke();
  }
  for (const corners of run.polygons) {
    pen.beginPath();
    cornersPath(corners);
    pen.fill();
    pen.stroke();
  }
  pen.fillStyle = faded(colors.wall, 0.6);
  pen.beginPath();
  for (const corners of run.blocks) cornersPath(corners);
  pen.fill();
}

function drawPerceived(robot, frame) {
  if (!cellsOf.has(robot)) cellsOf.set(robot, new PerceivedCells(robot));
  const size = robot.cellSize * view.scale;
  pen.fillStyle = faded(colors.perceived, 0.85);
  for (const [column, row] of cellsOf.get(robot).at(state.time)) {
    const x = toScreenX(robot.cellOrigin.x + column * robot.cellSize);
    const y = toScreenY(robot.cellOrigin.y + (row + 1) * robot.cellSize);
    pen.fillRect(x + 0.06 * size, y + 0.06 * size, Math.max(1, 0.88 * size), Math.max(1, 0.88 * size));
  }
  const nearest = Math.round(frame);
  for (const track of robot.tracks) {
    const k = nearest - track.first;
    if (k < 0 || k >= track.count) continue;
    const x = track.x[k], y = track.y[k];
    circlePath(x, y, 2 * track.sigma[k]);
    pen.strokeStyle = colors.accent;
    pen.lineWidth = 1.25;
    pen.setLineDash([2, 3]);
    pen.stroke();
    pen.setLineDash([]);
    drawCross(toScreenX(x), toScreenY(y), 4, colors.accent, 1.5);
  }
}

function drawCross(px, py, size, color, width) {
  pen.beginPath();
  pen.moveTo(px - size, py);
  pen.lineTo(px + size, py);
  pen.moveTo(px, py - size);
  pen.lineTo(px, py + size);
  pen.strokeStyle = color;
  pen.lineWidth = width;
  pen.stroke();
}

/** The Gaussian exp(-m^2 / 2) up to m = 3, and its outline at the threshold. */
function drawField(obstacle, frame) {
  const long = sample(obstacle.fieldLong, frame), short = sample(obstacle.fieldShort, frame);
  if (!(long > 0) || !(short > 0)) return;
  const deviation = run.threshold > 0 ? 3 / run.threshold : 2.5;
  pen.save();
  pen.translate(toScreenX(sample(obstacle.fieldX, frame)), toScreenY(sample(obstacle.fieldY, frame)));
  pen.rotate(-sampleAngle(obstacle.fieldAngle, frame, Math.PI));
  pen.scale(long * view.scale, short * view.scale);
  const gradient = pen.createRadialGradient(0, 0, 0, 0, 0, deviation);
  for (let m = 0; m <= 3; m += 0.5) gradient.addColorStop(m / 3, faded(colors.obstacle, m === 3 ? 0 : 0.42 * Math.exp(-0.5 * m * m)));
  pen.fillStyle = gradient;
  pen.beginPath();
  pen.arc(0, 0, deviation, 0, 2 * Math.PI);
  pen.fill();
  pen.beginPath();
  pen.arc(0, 0, 1, 0, 2 * Math.PI);
  pen.restore();
  pen.strokeStyle = colors.obstacle;
  pen.lineWidth = 1.25;
  pen.setLineDash([5, 4]);
  pen.stroke();
  pen.setLineDash([]);
}

function drawArrow(x, y, dx, dy, color) {
  const x0 = toScreenX(x), y0 = toScreenY(y), x1 = toScreenX(x + dx), y1 = toScreenY(y + dy);
  const length = Math.hypot(x1 - x0, y1 - y0);
  if (length < 6) return;
  const ux = (x1 - x0) / length, uy = (y1 - y0) / length;
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(x1, y1);
  pen.moveTo(x1 - 7 * ux + 4 * uy, y1 - 7 * uy - 4 * ux);
  pen.lineTo(x1, y1);
  pen.lineTo(x1 - 7 * ux - 4 * uy, y1 - 7 * uy + 4 * ux);
  pen.strokeStyle = color;
  pen.lineWidth = 2;
  pen.stroke();
}

function drawObstacle(obstacle, frame) {
  const x = sample(obstacle.x, frame), y = sample(obstacle.y, frame);
  circlePath(x, y, obstacle.radius);
  pen.fillStyle = faded(colors.obstacle, 0.35);
  pen.fill();
  pen.strokeStyle = colors.obstacle;
  pen.lineWidth = 2;
  pen.stroke();
  drawArrow(x, y, sample(obstacle.vx, frame), sample(obstacle.vy, frame), colors.obstacle);
  pen.font = `600 12px ${FONT}`;
  pen.textAlign = "center";
  pen.textBaseline = "bottom";
  haloText(`O${obstacle.id}`, toScreenX(x), toScreenY(y) - obstacle.radius * view.scale - 3, colors.obstacle);
}

function drawTrail(robot, frame, chosen) {
  const last = Math.floor(frame);
  const first = chosen ? 0 : Math.max(0, last - Math.round(TRAIL_TIME / run.interval));
  const points = [];
  for (let k = first; k <= last; ++k) points.push([robot.x[k], robot.y[k]]);
  points.push([sample(robot.x, frame), sample(robot.y, frame)]);
  strokePath(points, faded(colors[robot.color], chosen ? 0.7 : 0.4), chosen ? 2 : 1.5);
}

function drawPlan(robot, frame, chosen) {
  const plan = planFollowed(robot, state.time);
  if (!plan) return;
  const points = [[sample(robot.x, frame), sample(robot.y, frame)]];
  for (let i = 0; i < plan.t.length; ++i) {
    if (plan.t[i] > state.time) points.push([plan.x[i], plan.y[i]]);
  }
  strokePath(points, faded(colors[robot.color], chosen ? 1 : 0.75), chosen ? 3 : 2, chosen ? [] : [1.5, 4]);
}

function drawCandidates(robot) {
  const plan = planNewest(robot, state.time);
  if (!plan) return;
  plan.candidates.forEach((candidate, index) => {
    const points = Array.from(candidate.x, (x, i) => [x, candidate.y[i]]);
    if (points.length < 2) return;
    if (!candidate.chosen) strokePath(points, colors[robot.color], 1.75, CANDIDATE_DASHES[index % CANDIDATE_DASHES.length]);
    const [x, y] = middle(points);
    pen.font = `700 12px ${FONT}`;
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    haloText(candidateKey(index), toScreenX(x) + 9, toScreenY(y) - 9, colors[robot.color]);
  });
}

/** The point half way along a line, where candidates differ most. */
function middle(points) {
  const lengths = points.slice(1).map(([x, y], i) => Math.hypot(x - points[i][0], y - points[i][1]));
  let left = lengths.reduce((a, b) => a + b, 0) / 2;
  for (let i = 0; i < lengths.length; ++i) {
    if (left <= lengths[i] && lengths[i] > 0) {
      const share = left / lengths[i];
      return [points[i][0] + share * (points[i + 1][0] - points[i][0]), points[i][1] + share * (points[i + 1][1] - points[i][1])];
    }
    left -= lengths[i];
  }
  return points[points.length - 1];
}

const candidateKey = (index) => String.fromCharCode(65 + (index % 26));

function drawGoal(robot, chosen) {
  const goal = goalNow(robot);
  const px = toScreenX(goal.x), py = toScreenY(goal.y);
  const size = Math.max(4, 0.45 * robot.radius * view.scale);
  pen.beginPath();
  pen.moveTo(px, py - size);
  pen.lineTo(px + size, py);
  pen.lineTo(px, py + size);
  pen.lineTo(px - size, py);
  pen.closePath();
  pen.strokeStyle = colors[robot.color];
  pen.lineWidth = chosen ? 2.5 : 1.5;
  pen.stroke();
}

function drawRobot(robot, frame, chosen) {
  const x = sample(robot.x, frame), y = sample(robot.y, frame), heading = sampleAngle(robot.heading, frame);
  const px = toScreenX(x), py = toScreenY(y), radius = robot.radius * view.scale;
  const color = colors[robot.color];
  bodyPath(robot, x, y, heading);
  pen.fillStyle = color;
  pen.fill();
  pen.strokeStyle = colors.panel;
  pen.lineWidth = 1;
  pen.stroke();
  pen.beginPath();  // heading: a nose on the rim
  pen.moveTo(px + 0.98 * radius * Math.cos(heading), py - 0.98 * radius * Math.sin(heading));
  pen.lineTo(px + 1.5 * radius * Math.cos(heading), py - 1.5 * radius * Math.sin(heading));
  pen.strokeStyle = color;
  pen.lineWidth = Math.max(2, 0.18 * radius);
  pen.stroke();
  if (chosen) {
    pen.beginPath();
    pen.arc(px, py, Math.max(radius, 3) + 4, 0, 2 * Math.PI);
    pen.strokeStyle = colors.accent;
    pen.lineWidth = 2.5;
    pen.stroke();
  }
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  if (chosen && layers.estimate) {  // the estimate lies over the disc
    pen.font = `700 13px ${FONT}`;
    haloText(String(robot.id), px, py - Math.max(radius, 3) - 13, color);
  } else if (radius >= 7) {
    pen.font = `600 ${Math.min(Math.max(0.95 * radius, 9), 16)}px ${FONT}`;
    pen.fillStyle = colors["on-accent"];
    pen.fillText(String(robot.id), px, py + 0.5);
  } else if (chosen || run.robots.length <= 60) {
    pen.font = `600 11px ${FONT}`;
    haloText(String(robot.id), px, py - radius - 8, color);
  }
}

function drawSensing(robot, frame) {
  if (!(robot.range > 0)) return;
  circlePath(sample(robot.x, frame), sample(robot.y, frame), robot.range);
  pen.fillStyle = faded(colors.accent, 0.05);
  pen.fill();
  pen.strokeStyle = faded(colors.accent, 0.7);
  pen.lineWidth = 1.25;
  pen.setLineDash([6, 5]);
  pen.stroke();
  pen.setLineDash([]);
}

/** Cross at the estimated position, ellipse of two standard deviations. */
function drawEstimate(robot, frame) {
  const x = sample(robot.estimateX, frame), y = sample(robot.estimateY, frame);
  if (!Number.isFinite(x + y)) return;
  const long = 2 * sample(robot.sigmaLong, frame), short = 2 * sample(robot.sigmaShort, frame);
  pen.beginPath();
  if (long > 0) pen.ellipse(toScreenX(x), toScreenY(y), long * view.scale, short * view.scale, -sampleAngle(robot.sigmaAngle, frame, Math.PI), 0, 2 * Math.PI);
  pen.strokeStyle = faded(colors.panel, 0.8);
  pen.lineWidth = 3;
  pen.stroke();
  pen.strokeStyle = colors.text;
  pen.lineWidth = 1.5;
  pen.stroke();
  drawCross(toScreenX(x), toScreenY(y), 5, faded(colors.panel, 0.8), 3.5);
  drawCross(toScreenX(x), toScreenY(y), 4, colors.text, 1.5);
}

function drawContacts() {
  for (const event of run.events) {
    if (event.kind !== "contact" || event.time > state.time + 1e-9 || !event.at) continue;
    const px = toScreenX(event.at.x), py = toScreenY(event.at.y);
    pen.beginPath();
    pen.arc(px, py, 13, 0, 2 * Math.PI);
    pen.moveTo(px - 7, py - 7);
    pen.lineTo(px + 7, py + 7);
    pen.moveTo(px + 7, py - 7);
    pen.lineTo(px - 7, py + 7);
    pen.strokeStyle = colors.panel;
    pen.lineWidth = 6;
    pen.stroke();
    pen.strokeStyle = colors.bad;
    pen.lineWidth = 3;
    pen.stroke();
  }
}

function paintScene() {
  const { context, width, height } = fitCanvas(sceneCanvas);
  pen = context;
  const resized = width !== view.width || height !== view.height;
  view.width = width;
  view.height = height;
  if (resized && view.fitted) view.scale = fitScale();
  const frame = frameNow(), chosen = state.robot;
  if (state.follow && chosen && run.frames > 0) {
    view.x = sample(chosen.x, frame);
    view.y = sample(chosen.y, frame);
  }
  pen.clearRect(0, 0, width, height);
  const scales = drawGrid();
  drawMap();
  if (run.frames > 0) paintMovingThings(frame, chosen);
  drawContacts();
  drawScales(scales);
}

function paintMovingThings(frame, chosen) {
  const others = run.robots.filter((robot) => robot !== chosen);
  if (layers.sensing && chosen) drawSensing(chosen, frame);
  if (layers.fields) run.obstacles.forEach((obstacle) => drawField(obstacle, frame));
  if (layers.perceived && chosen) drawPerceived(chosen, frame);
  run.robots.forEach((robot) => drawGoal(robot, robot === chosen));
  if (layers.trails) run.robots.forEach((robot) => drawTrail(robot, frame, robot === chosen));
  if (layers.plans) others.forEach((robot) => drawPlan(robot, frame, false));
  if (layers.candidates && chosen) drawCandidates(chosen);
  if (layers.plans && chosen) drawPlan(chosen, frame, true);
  run.obstacles.forEach((obstacle) => drawObstacle(obstacle, frame));
  others.forEach((robot) => drawRobot(robot, frame, false));
  if (chosen) drawRobot(chosen, frame, true);
  if (layers.estimate && chosen) drawEstimate(chosen, frame);
}
