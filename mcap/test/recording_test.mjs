// node recording_test.mjs FOUND: does a recording of scene.yaml, as read_recording.mjs found it, hold what happened?
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";

const found = JSON.parse(await readFile(process.argv[2], "utf8"));
const channel = (topic) => found.channels[topic] ?? assert.fail(`no ${topic} among ${Object.keys(found.channels)}`);
const near = (value, expected, tolerance) =>
  assert.ok(Math.abs(value - expected) <= tolerance, `${value} is not within ${tolerance} of ${expected}`);

assert.equal(found.profile, "ros2");
assert.ok(found.chunkCount >= 1);
assert.equal(found.messageStartTime, 0);
const seconds = found.messageEndTime / 1e9;
assert.ok(seconds > 4.0 && seconds < 30.0, `${seconds} s`);

const starts = [[-2, 0], [0, -2]];
const goals = [[2, 0], [0, 2]];
for (const robot of [0, 1]) {
  const poses = channel(`/robot${robot}/pose`);
  assert.equal(poses.schema, "geometry_msgs/msg/PoseStamped");
  assert.equal(poses.first.header.frame_id, "map");
  for (const [pose, [x, y]] of [[poses.first, starts[robot]], [poses.last, goals[robot]]]) {
    near(pose.pose.position.x, x, 0.1);
    near(pose.pose.position.y, y, 0.1);
  }
  near(poses.count, 10 * seconds, 2); // 10 Hz
  const goal = channel(`/robot${robot}/goal_pose`).first.pose.position;
  assert.deepEqual([goal.x, goal.y], goals[robot]);

  const scans = channel(`/robot${robot}/scan`);
  assert.equal(scans.schema, "sensor_msgs/msg/LaserScan");
  assert.equal(scans.first.header.frame_id, `robot${robot}/base_link`);
  // The border is 2 m away from where the first robot starts, straight behind it.
  if (robot === 0) near(Math.min(...scans.first.ranges), 2.0, 0.1);

  const grid = channel(`/robot${robot}/grid`);
  assert.equal(grid.last.data.length, grid.last.info.width * grid.last.info.height);
  assert.ok(grid.last.data.includes(100) && grid.last.data.includes(0));
  assert.ok(channel(`/robot${robot}/path`).last.poses.length >= 1);
  assert.ok(channel(`/robot${robot}/markers`).last.markers.some((marker) => marker.ns === "plan"));
  assert.ok(channel(`/robot${robot}/plan`).first.time >= 0);
  assert.ok(channel(`/robot${robot}/control`).count > 10 * seconds);
}
assert.equal(channel("/tf").last.transforms[1].child_frame_id, "robot1/base_link");
const kinds = channel("/simulator/markers").last.markers.map((marker) => marker.ns);
for (const kind of ["robot", "disc", "box", "border"]) assert.ok(kinds.includes(kind), kind);
assert.ok(channel("/diagnostics").last.status.some((status) => status.name === "robot0: planner"));
assert.equal(channel("/events").count, 2);
assert.equal(channel("/events").last.kind, "arrival");
