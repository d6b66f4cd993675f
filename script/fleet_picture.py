#!/usr/bin/env python3
"""fleet_picture.py [FILE.svg]: the moving picture of README, docs/fleet.svg, of a real run. It needs the Python package
(PYTHONPATH=build/release/python after a build with -D SPF_BUILD_PYTHON=ON). One animated SVG, without a script, in the
reader's light or dark theme."""
import sys
from pathlib import Path

import numpy as np
import spf

ANGLE = np.linspace(0, 2 * np.pi, 12, endpoint=False) + 0.13
RING = np.column_stack([7.2 * np.cos(ANGLE), 4.2 * np.sin(ANGLE)])
SCENE = {
    "family": "explicit",
    "border": {"low": [-8.5, -5.2], "high": [8.5, 5.2]},
    "robots": [{"start": start, "goal": -start} for start in RING],
    "boxes": [{"low": [-3.6, 0.8], "high": [-2.4, 1.8]}, {"low": [2.4, -1.8], "high": [3.6, -0.8]}],
    "discs": [{"center": [-2.6, -2.2], "radius": 0.6}, {"center": [2.6, 2.2], "radius": 0.6}],
    "people": [{"waypoints": waypoints, "speed": speed} for waypoints, speed in (
        ([[-7, -4.5], [-4, 0], [5, 1]], 1.0), ([[0, 4.6], [0, -4.6]], 0.8), ([[7.5, -3], [-7.5, -0.5]], 1.1),
        ([[-7.5, 3.2], [0, 3.4], [7.5, 3.2]], 0.9))],
}
SCALE = 42  # px a metre
STEP = 3    # frames of 0.1 s between key frames
STYLE = """
 .ground{fill:#fff;stroke:#76818d}.wall{fill:#6b7683;fill-opacity:.45}.person{fill:#b84700}.field{fill:#b84700;fill-opacity:.13}
 .goal{fill:none;stroke:#76818d;stroke-dasharray:3 3}.trail{fill:none;stroke-width:1.2;stroke-opacity:.35}
 .number{fill:#fff;font:bold 12px sans-serif;text-anchor:middle}
 .c0{fill:#0067a8;stroke:#0067a8}.c1{fill:#8a5d00;stroke:#8a5d00}.c2{fill:#a02c78;stroke:#a02c78}.c3{fill:#00735a;stroke:#00735a}
 .trail{fill:none}
 @media (prefers-color-scheme:dark){.ground{fill:#171d24}.wall{fill:#8793a0}.person{fill:#ff9a5c}.field{fill:#ff9a5c}
 .number{fill:#0b1117}.c0{fill:#5cb3f0;stroke:#5cb3f0}.c1{fill:#e3b341;stroke:#e3b341}.c2{fill:#ec92c6;stroke:#ec92c6}
 .c3{fill:#45c9a0;stroke:#45c9a0}.trail{fill:none}}
"""


def pixels(points):
    """Of positions [m], y down."""
    return np.round((np.asarray(points) * [1, -1] + [8.5, 5.2]) * SCALE, 1)


def number(value):
    return f"{value:.1f}".removesuffix(".0")


def moving(points, duration, rotate=None):
    """An element's animation along positions, over and over with two seconds' rest at the end."""
    steps = [f"{number(x)} {number(y)}" for x, y in pixels(points)]
    move = f'<animateTransform attributeName="transform" type="translate" dur="{duration:.1f}s" repeatCount="indefinite" values="'
    text = move + ";".join(steps + [steps[-1]] * (20 // STEP)) + '"/>'
    if rotate is not None:
        turns = [number(angle) for angle in rotate]
        text += (f'<animateTransform attributeName="transform" type="rotate" additive="sum" dur="{duration:.1f}s" '
                 f'repeatCount="indefinite" values="{";".join(turns + [turns[-1]] * (20 // STEP))}"/>')
    return text


def still_transform(point):
    x, y = pixels(point)
    return f'transform="translate({number(x)} {number(y)})"'


def draw_ground():
    for box in SCENE["boxes"]:
        x, y = pixels([box["low"][0], box["high"][1]])
        width, height = (np.subtract(box["high"], box["low"]) * SCALE)
        yield f'<rect class="wall" x="{number(x)}" y="{number(y)}" width="{number(width)}" height="{number(height)}"/>'
    for disc in SCENE["discs"]:
        x, y = pixels(disc["center"])
        yield f'<circle class="wall" cx="{number(x)}" cy="{number(y)}" r="{number(disc["radius"] * SCALE)}"/>'
    for goal in -RING:
        x, y = pixels(goal)
        yield f'<circle class="goal" cx="{number(x)}" cy="{number(y)}" r="8"/>'


def draw_robots(pose, duration):
    for robot in range(pose.shape[1]):
        path = "L".join(f"{number(x)} {number(y)}" for x, y in pixels(pose[::2, robot, :2]))
        yield f'<path class="trail c{robot % 4}" d="M{path}"/>'
    for robot in range(pose.shape[1]):
        yield (f'<g {still_transform(pose[0, robot, :2])}>{moving(pose[:, robot, :2], duration)}'
               f'<circle class="c{robot % 4}" r="{0.3 * SCALE:.1f}"/><text class="number" y="4">{robot}</text></g>')


def draw_people(obstacles, duration):
    """Each with the ellipse where its safety probability field counts as dangerous."""
    for person in range(len(obstacles["id"])):
        position, velocity = obstacles["position"][::STEP, person], obstacles["velocity"][::STEP, person]
        radius = obstacles["radius"][person]
        fields = [spf.ProbabilityField(p, v, radius) for p, v in zip(position, velocity)]
        contours = [field.ellipse(field.threshold) for field in fields]
        long_axis, short_axis = np.median([contour["half_axes"] for contour in contours], axis=0) * SCALE
        turn = np.degrees(-np.unwrap([contour["heading"] for contour in contours], period=np.pi))
        center = np.array([contour["center"] for contour in contours])
        yield (f'<g {still_transform(center[0])}>{moving(center, duration, turn)}<ellipse class="field" rx="{number(long_axis)}" '
               f'ry="{number(short_axis)}"/></g><g {still_transform(position[0])}>{moving(position, duration)}'
               f'<circle class="person" r="{number(radius * SCALE)}"/></g>')


def main():
    file = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent / "docs" / "fleet.svg")
    trial = spf.Scenario.from_dict(SCENE).run(record=True)
    if not trial.succeeded:
        sys.exit(f"fleet_picture.py: the run ended with {trial.outcome}")
    pose = trial.recording.pose[::STEP]
    duration = (len(pose) + 20 // STEP) * STEP / 10
    parts = [*draw_ground(), *draw_people(trial.recording.obstacles, duration), *draw_robots(pose, duration)]
    title = "Twelve robots change places among four people who walk"
    file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {17 * SCALE} {10.4 * SCALE:.0f}" role="img"><title>{title}'
                    f'</title><style>{STYLE}</style><rect class="ground" width="100%" height="100%"/>\n' + "\n".join(parts)
                    + "\n</svg>\n", encoding="utf-8")
    times = trial.robots["travel_time"]
    print(f"{file}: {file.stat().st_size / 1000:.0f} kB, {trial.outcome} in {times.max():.1f} s")


if __name__ == "__main__":
    main()
