"""A method of your own in Python, as 07_own_method: it follows the guide, and what it returns is checked."""
import sys

import numpy as np
import spf

from picture import Picture


class Cautious:
    def __init__(self, parameters):
        self.acceleration = parameters.robot.max_acceleration

    def plan(self, request):
        here, velocity = request.position, request.velocity
        speed = min(0.5, (self.acceleration * request.cost_to_go(here)) ** 0.5)
        target = speed * request.direction(here)
        plan = spf.Trajectory(request.time)
        for end, least in ((target, 0.05), (target, 0.2), (np.zeros(2), 0.05)):
            duration = max(np.linalg.norm(end - velocity) / self.acceleration, least)
            plan.append(spf.constant_acceleration(here, velocity, end, duration), duration)
            here, velocity = here + 0.5 * duration * (velocity + end), end
        return plan


methods = spf.MethodTable()
methods.add("cautious", "follows the guide slowly", Cautious)
yard = sys.argv[1] if len(sys.argv) > 1 else "examples/own_method/yard.yaml"

picture = Picture((-6, -6), (6, 6))
picture.area([(-1.5, -0.4), (-0.5, -0.4), (-0.5, 1.5), (-1.5, 1.5)], "wall")
for method, colour in (("cautious", "robot"), ("space_time", "quiet")):
    trial = spf.Scenario.load(yard, {"method": method}, methods).run(record=True)
    picture.line(trial.recording.pose[::2, 0, :2], colour)
    print(f"{method}: {trial.outcome} in {trial.robots['travel_time'][0]:.2f} s")
    assert trial.succeeded
picture.line(trial.recording.obstacles["position"][::2, 0], "obstacle")
picture.text((-5.8, 5.5), "cautious blue, space_time grey, what crosses their way orange")
picture.save("15_own_method.svg")
