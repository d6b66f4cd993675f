"""One call of a planner, as 03_planning_once: the same person, seen by three methods."""
import numpy as np
import spf

from picture import Picture

start, goal = (-3.0, 0.0), (3.0, 0.5)
ground = spf.OccupancyMap((-4, -3), (4, 3))
ground.add_box((-1, -2), (0, 0.4))
person = spf.ObstacleTrack((0.9, 2.6), velocity=(0, -0.6), radius=0.3)

picture = Picture((-4.0, -2.5), (4.0, 3.0))
picture.area([(-1, -2), (0, -2), (0, 0.4), (-1, 0.4)], "wall")
for ahead in range(5):  # where the person will be
    picture.disc(person.position + ahead * person.velocity, 0.3, "obstacle", 0.7 - 0.15 * ahead)
for method, colour in (("space_time", "robot"), ("spf_empc", "limit"), ("orca", "quiet")):
    plan = spf.Planner(method).plan(ground, start, goal, tracks=[person])
    motion = plan.trajectory
    picture.line(motion.position(np.linspace(motion.start_time, motion.end_time, 40)), colour, 3)
    print(f"{method:12} {plan.outcome}: {motion.duration:.2f} s, {motion.length():.2f} m, risk {plan.risk:.3f}")
picture.text((-3.9, 2.75), "space_time blue, spf_empc red, orca grey: what each would do for now")
picture.save("13_planning_once.svg")
