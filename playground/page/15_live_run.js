// A run that grows: the engine sends what was recorded, in the form of a replay, and it is added at the end. What is older than
// some minutes is dropped, so that the page does not fill the memory.

const MOST_FRAMES = 6000;  // ten minutes
const emptyRun = () => ({
  interval: 0.1, frames: 0, duration: 0, bounds: [-10, -10, 10, 10], boxes: [], discs: [], polygons: [], blocks: [], threshold: 1.2,
  states: [], robots: [], obstacles: [], events: [], dropped: 0,
});
const run = emptyRun();

function clearRun() {
  Object.assign(run, emptyRun());
  cellsOf.clear();
}

const COLUMNS = ["x", "y", "heading", "estimateX", "estimateY", "estimateHeading", "sigmaLong", "sigmaShort", "sigmaAngle", "state", "control"];
const OBSTACLE_COLUMNS = ["x", "y", "vx", "vy", "fieldX", "fieldY", "fieldLong", "fieldShort", "fieldAngle"];
const append = (to, from) => { for (const value of from) to.push(value); };

/** All columns of a robot or an obstacle, those of the wheels and clearances too. */
function columnsOf(thing) {
  if (!thing.wheels) return OBSTACLE_COLUMNS.map((name) => thing[name]);
  const gaps = Object.values(thing.clearance).flatMap(({ distance, index }) => [distance, index]);
  return [...COLUMNS.map((name) => thing[name]), ...thing.wheels, ...gaps];
}

/** The thing with columns that can grow, unknown in the frames before. */
function growing(thing, frames) {
  const blank = () => new Array(frames).fill(NaN);
  for (const name of thing.wheels ? COLUMNS : OBSTACLE_COLUMNS) thing[name] = blank();
  if (!thing.wheels) return thing;
  thing.wheels = thing.wheels.map(blank);
  for (const kind of Object.keys(thing.clearance)) thing.clearance[kind] = { distance: blank(), index: blank() };
  return Object.assign(thing, { tracks: [], plans: [], goals: [], cells: [] });
}

function stateIndex(state) {
  const found = run.states.findIndex((known) => known.text === state.text && known.kind === state.kind);
  return found >= 0 ? found : run.states.push(state) - 1;
}

function appendTracks(robot, tracks) {
  for (const track of tracks) {
    const first = run.frames + track.first;
    const open = robot.tracks.find((known) => known.id === track.id && known.first + known.count === first);
    if (!open) {
      robot.tracks.push({ ...track, first, x: [...track.x], y: [...track.y], sigma: [...track.sigma] });
      continue;
    }
    for (const name of ["x", "y", "sigma"]) append(open[name], track[name]);
    open.count += track.count;
  }
}

const earlier = (item) => ({ ...item, time: item.time - run.dropped });

function appendRobot(part, added) {
  let robot = run.robots[added.position];
  if (!robot) run.robots[added.position] = robot = growing({ ...added }, run.frames);
  const states = Array.from(added.state, (index) => stateIndex(part.states[index]));
  const columns = columnsOf(robot);
  columnsOf({ ...added, state: states }).forEach((column, i) => append(columns[i], column));
  appendTracks(robot, added.tracks);
  for (const plan of added.plans) robot.plans.push({ ...earlier(plan), t: plan.t.map((time) => time - run.dropped) });
  append(robot.goals, added.goals.map(earlier));
  append(robot.cells, added.cells.map(earlier));
}

function appendObstacles(part) {
  for (const added of part.obstacles) {
    let obstacle = run.obstacles.find(({ id }) => id === added.id);
    if (!obstacle) run.obstacles.push(obstacle = growing({ ...added }, run.frames));
    const columns = columnsOf(obstacle);
    columnsOf(added).forEach((column, i) => append(columns[i], column));
  }
}

/** Adds what was recorded since the last part. */
function appendRun(part) {
  Object.assign(run, { bounds: part.bounds, boxes: part.boxes, discs: part.discs, polygons: part.polygons, blocks: part.blocks,
    threshold: part.threshold, interval: part.interval });
  part.robots.forEach((robot) => appendRobot(part, robot));
  appendObstacles(part);
  append(run.events, part.events.map(earlier));
  run.frames += part.frames;
  if (run.frames > MOST_FRAMES) dropOldest(MOST_FRAMES / 2);
  run.duration = Math.max(0, run.frames - 1) * run.interval;
}

/** Forgets the first frames: the run then begins later. */
function dropOldest(frames) {
  const span = frames * run.interval;
  const later = (items) => items.filter((item) => item.time >= span).map((item) => ({ ...item, time: item.time - span }));
  for (const thing of [...run.robots, ...run.obstacles]) columnsOf(thing).forEach((column) => column.splice(0, frames));
  for (const robot of run.robots) {
    const goal = goalNow(robot), followed = robot.plans.slice(lastBefore(robot.plans, span)).filter(({ time }) => time < span);
    const moved = (plan) => ({ ...plan, time: plan.time - span, t: plan.t.map((time) => time - span) });
    robot.plans = [...followed, ...robot.plans.filter(({ time }) => time >= span)].map(moved);
    robot.goals = [{ time: 0, at: goal }, ...later(robot.goals)];
    robot.cells = robot.cells.map((cells) => ({ ...cells, time: Math.max(0, cells.time - span) }));
    robot.tracks = robot.tracks.map((track) => ({ ...track, first: track.first - frames })).filter((track) => track.first >= 0);
  }
  run.events = later(run.events);
  run.frames -= frames;
  run.dropped += span;
  state.time = Math.max(0, state.time - span);
  cellsOf.clear();
}
