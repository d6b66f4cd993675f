// The run, decoded: metres, seconds, radians. The file's units are those of report/replay_json.hpp.

/** Undoes IntegerColumn: differences to numbers; null is not known; zeros at the end were left out. */
function decodeColumn(differences, length, step) {
  const values = new Float64Array(length);
  let running = 0;
  for (let i = 0; i < length; ++i) {
    const difference = i < differences.length ? differences[i] : 0;
    if (difference === null) {
      values[i] = NaN;
    } else {
      running += difference;
      values[i] = running * step;
    }
  }
  return values;
}

const LENGTH = 1e-3, SIGMA = 1e-4, ANGLE = 1e-3, TIME = 1e-3, COMPUTING = 1e-7;
const known = (value, step) => (value === null ? NaN : value * step);
const decodePoint = (pair) => ({ x: known(pair[0], LENGTH), y: known(pair[1], LENGTH) });

function decodeCandidate([label, chosen, cost, risk, n, x, y], texts) {
  return { label: texts[label], chosen: chosen === 1, cost, risk, x: decodeColumn(x, n, LENGTH), y: decodeColumn(y, n, LENGTH) };
}

function decodePlan([time, outcome, computing, evaluations, n, t, x, y, candidates], texts) {
  return {
    time: known(time, TIME), outcome: texts[outcome], computing: known(computing, COMPUTING), evaluations,
    t: decodeColumn(t, n, TIME), x: decodeColumn(x, n, LENGTH), y: decodeColumn(y, n, LENGTH),
    candidates: candidates.map((candidate) => decodeCandidate(candidate, texts)),
  };
}

function decodeCells(raw) {
  return { x: decodeColumn(raw.x, raw.n, 1), y: decodeColumn(raw.y, raw.n, 1) };
}

function decodeClearance(raw, frames) {
  return { distance: decodeColumn(raw.distance, frames, LENGTH), index: decodeColumn(raw.index, frames, 1) };
}

function decodeRobot(raw, position, frames, texts) {
  const lengths = (name) => decodeColumn(raw[name], frames, LENGTH);
  const angles = (name) => decodeColumn(raw[name], frames, ANGLE);
  return {
    id: raw.id, position, color: `robot-${position % 5}`, radius: known(raw.radius, LENGTH), goal: decodePoint(raw.goal),
    corners: (raw.corners ?? []).map(decodePoint),
    goals: (raw.goals ?? []).map((goal) => ({ time: known(goal.time, TIME), at: decodePoint(goal.at) })),
    wheelLimit: known(raw.wheel_limit, LENGTH), range: known(raw.range, LENGTH),
    x: lengths("x"), y: lengths("y"), heading: angles("heading"),
    estimateX: lengths("estimate_x"), estimateY: lengths("estimate_y"), estimateHeading: angles("estimate_heading"),
    sigmaLong: decodeColumn(raw.sigma_long, frames, SIGMA), sigmaShort: decodeColumn(raw.sigma_short, frames, SIGMA),
    sigmaAngle: angles("sigma_angle"), state: decodeColumn(raw.state, frames, 1),
    wheels: raw.wheels.map((wheel) => decodeColumn(wheel, frames, LENGTH)),
    clearance: {
      obstacle: decodeClearance(raw.clearance.obstacle, frames),
      peer: decodeClearance(raw.clearance.peer, frames),
      static: decodeClearance(raw.clearance.static, frames),
    },
    control: decodeColumn(raw.control, frames, COMPUTING),
    tracks: raw.tracks.map((track) => ({
      id: track.id, first: track.first, count: track.n,
      x: decodeColumn(track.x, track.n, LENGTH), y: decodeColumn(track.y, track.n, LENGTH),
      sigma: decodeColumn(track.sigma, track.n, LENGTH),
    })),
    plans: raw.plans.map((plan) => decodePlan(plan, texts)),
    cellSize: known(raw.cell_size, SIGMA), cellOrigin: decodePoint(raw.cell_origin),
    cells: raw.cells.map((update) => ({
      time: known(update.time, TIME), added: decodeCells(update.added), removed: decodeCells(update.removed),
    })),
  };
}

function decodeObstacle(raw, frames) {
  const lengths = (name) => decodeColumn(raw[name], frames, LENGTH);
  return {
    id: raw.id, radius: known(raw.radius, LENGTH), x: lengths("x"), y: lengths("y"), vx: lengths("vx"), vy: lengths("vy"),
    fieldX: lengths("field_x"), fieldY: lengths("field_y"), fieldLong: lengths("field_long"), fieldShort: lengths("field_short"),
    fieldAngle: decodeColumn(raw.field_angle, frames, ANGLE),
  };
}

function decodeRun(raw) {
  const metres = (list) => list.map((value) => known(value, LENGTH));
  const frames = raw.frames;
  return {
    ...raw,
    interval: raw.frame_interval, frames, duration: Math.max(0, frames - 1) * raw.frame_interval,
    bounds: metres(raw.map.bounds), boxes: raw.map.boxes.map(metres), discs: raw.map.discs.map(metres),
    polygons: raw.map.polygons.map(metres), blocks: raw.map.blocks.map(metres),
    threshold: raw.field_threshold,
    robots: raw.robots.map((robot, position) => decodeRobot(robot, position, frames, raw.texts)),
    obstacles: raw.obstacles.map((obstacle) => decodeObstacle(obstacle, frames)),
    events: raw.events.map((event) => ({
      time: known(event.time, TIME), robot: event.robot, kind: event.kind,
      text: raw.texts[event.text], other: raw.texts[event.other], at: event.at === null ? null : decodePoint(event.at),
    })),
  };
}

/** Value between two frames; `frame` may be fractional. */
function sample(values, frame) {
  const low = Math.min(Math.floor(frame), values.length - 1);
  const high = Math.min(low + 1, values.length - 1);
  return low === high ? values[low] : values[low] + (frame - low) * (values[high] - values[low]);
}

/** The same for angles, the shorter way round; `turn` is the angle's period. */
function sampleAngle(values, frame, turn = 2 * Math.PI) {
  const low = Math.min(Math.floor(frame), values.length - 1);
  const high = Math.min(low + 1, values.length - 1);
  const difference = values[high] - values[low];
  return values[low] + (frame - low) * (difference - turn * Math.round(difference / turn));
}

/** Index of the last item whose time is not after `time`, or -1. */
function lastBefore(items, time) {
  let low = 0, high = items.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (items[middle].time <= time + 1e-9) low = middle + 1; else high = middle;
  }
  return low - 1;
}

/** The plan that the robot follows at `time`: the newest one that holds a trajectory. */
function planFollowed(robot, time) {
  for (let i = lastBefore(robot.plans, time); i >= 0; --i) {
    if (robot.plans[i].x.length > 0) return robot.plans[i];
  }
  return null;
}

function planNewest(robot, time) {
  const index = lastBefore(robot.plans, time);
  return index < 0 ? null : robot.plans[index];
}

/** Cells that a robot knows to be occupied; walks forward with time and starts again when time goes back. */
class PerceivedCells {
  constructor(robot) {
    this.robot = robot;
    this.reset();
  }
  reset() {
    this.done = 0;
    this.time = -Infinity;
    this.occupied = new Map();
  }
  at(time) {
    if (time < this.time) this.reset();
    this.time = time;
    const updates = this.robot.cells;
    for (; this.done < updates.length && updates[this.done].time <= time + 1e-9; ++this.done) {
      const { added, removed } = updates[this.done];
      for (let i = 0; i < added.x.length; ++i) this.occupied.set(`${added.x[i]},${added.y[i]}`, [added.x[i], added.y[i]]);
      for (let i = 0; i < removed.x.length; ++i) this.occupied.delete(`${removed.x[i]},${removed.y[i]}`);
    }
    return this.occupied.values();
  }
}
