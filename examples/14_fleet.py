"""A fleet in the simulator, as 05_fleet: a scenario as a dict with numpy arrays, and its recording as arrays."""
from math import cos, pi, sin

import numpy as np
import spf

from picture import Picture

angles = [2 * pi * robot / 8 for robot in range(8)]
start = 4 * np.array([[cos(angle), sin(angle)] for angle in angles])
scenario = spf.Scenario.from_dict({
    "family": "explicit",
    "border": {"low": [-5.5, -5.5], "high": [5.5, 5.5]},
    "robots": [{"start": a, "goal": -a} for a in start],
    "people": [{"waypoints": [[-5, 2], [5, -2]], "speed": 0.8}],
})
trial = scenario.run(record=True)
pose = trial.recording.pose  # (frames, robots, 3)
gap = np.linalg.norm(pose[:, :, None, :2] - pose[:, None, :, :2], axis=-1) + 1e9 * np.eye(len(start))
print(f"{trial.outcome}: {len(pose)} frames, robots never nearer than {gap.min() - 0.6:.2f} m to each other")
print("travel times [s]:", np.round(trial.robots["travel_time"], 2))

picture = Picture((-5.5, -5.5), (5.5, 5.5))
for robot in range(len(start)):
    picture.line(pose[::2, robot, :2], "robot", 1.5)
    picture.disc(pose[-1, robot, :2], 0.3, "robot")
person = trial.recording.obstacles["position"]
picture.line(person[::2, 0], "obstacle")
picture.disc(person[-1, 0], 0.25, "obstacle")
picture.save("14_fleet.svg")
assert trial.succeeded
