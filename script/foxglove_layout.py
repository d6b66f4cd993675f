#!/usr/bin/env python3
"""foxglove_layout.py [--robots N] : a layout for Foxglove that shows a recording of a fleet (docs/recordings.md), as JSON.

mcap/foxglove_layout.json is what it prints for twelve robots.
"""
import argparse
import json
import sys

CAMERA = {"distance": 30, "perspective": False, "phi": 0, "target": [0, 0, 0], "targetOffset": [0, 0, 0],
          "targetOrientation": [0, 0, 0, 1], "thetaOffset": 0, "fovy": 45, "near": 0.5, "far": 5000}


def scene(robots):
    topics = {"/map": {"visible": True}, "/simulator/markers": {"visible": True}}
    for robot in range(robots):
        topics[f"/robot{robot}/path"] = {"visible": True, "type": "line", "lineWidth": 0.05}
        topics[f"/robot{robot}/scan"] = {"visible": True, "colorMode": "flat", "flatColor": "#d03030", "pointSize": 2}
        topics[f"/robot{robot}/markers"] = {"visible": robot == 0}
        topics[f"/robot{robot}/grid"] = {"visible": False}
    return {"cameraState": CAMERA, "followMode": "follow-none", "followTf": "map", "scene": {}, "transforms": {}, "topics": topics,
            "layers": {}}


def plot(paths, title):
    return {"title": title, "paths": [{"value": path, "enabled": True, "timestampMethod": "receiveTime"} for path in paths],
            "showLegend": True, "isSynced": True, "xAxisVal": "timestamp", "showXAxisLabels": True, "showYAxisLabels": True}


def layout(robots):
    panels = {
        "3D!fleet": scene(robots),
        "Plot!plans": plot([f"/robot{robot}/plan.plan_ms" for robot in range(robots)], "planning call [ms]"),
        "Plot!risk": plot([f"/robot{robot}/plan.risk" for robot in range(robots)], "risk of the plan [1]"),
        "RawMessages!events": {"topicPath": "/events"},
        "DiagnosticSummary!health": {"minLevel": 0, "pinnedIds": [], "hardwareIdFilter": "", "topicToRender": "/diagnostics",
                                     "sortByLevel": True},
    }
    right = {"first": {"first": "Plot!plans", "second": "Plot!risk", "direction": "column"},
             "second": {"first": "RawMessages!events", "second": "DiagnosticSummary!health", "direction": "column"},
             "direction": "column"}
    return {"configById": panels, "globalVariables": {}, "userNodes": {}, "playbackConfig": {"speed": 1},
            "layout": {"first": "3D!fleet", "second": right, "direction": "row", "splitPercentage": 65}}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--robots", type=int, default=12)
    json.dump(layout(parser.parse_args().robots), sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
