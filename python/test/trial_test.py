"""Trials and campaigns from Python are those of the program, bit for bit."""
import json
import os
import signal
import threading
import time

import numpy as np
import pytest

import spf
from project import SCENARIOS, program, without_timings

T2 = SCENARIOS / "t2.yaml"


@pytest.fixture(scope="module")
def recorded():
    return spf.Scenario.load(T2).run(3, record=True)


def test_a_trial_of_t2_arrives_and_tells_of_each_robot(recorded):
    assert recorded.outcome == "success" and recorded.succeeded and recorded.failure == ""
    assert recorded.number == 3 and recorded.method == "space_time" and recorded.contact is None
    assert recorded.robots["arrived"].all() and len(recorded.robots) == 5
    assert (recorded.robots["path_length_ratio"] >= 1.0).all()
    assert recorded.to_dict()["robots"][2]["path_length"] == recorded.robots["path_length"][2]


def test_the_recording_holds_the_motion(recorded):
    recording = recorded.recording
    frames = len(recording.time)
    assert recording.pose.shape == (frames, 5, 3) and recording.velocity.shape == (frames, 5, 2)
    assert recording.wheel_speeds.shape == recording.wheel_commands.shape == (frames, 5, 3)
    np.testing.assert_allclose(np.diff(recording.time), 0.1)
    # The path of each robot until it arrived is as long as its record says, to what frames of 0.1 s cut off.
    steps = np.linalg.norm(np.diff(recording.pose[:, :, :2], axis=0), axis=2)
    length = (steps * (recording.time[1:, None] <= recorded.robots["travel_time"] + 0.1)).sum(axis=0)
    np.testing.assert_allclose(length, recorded.robots["path_length"], rtol=0.02, atol=0.1)
    moving = recording.obstacles
    assert moving["position"].shape == (frames, 4, 2) and not moving["person"].any()
    assert sorted(moving["id"]) == list(moving["id"])
    gaps = np.linalg.norm(recording.pose[:, :, None, :2] - moving["position"][:, None], axis=3)
    assert gaps.min() >= recorded.dynamic_distance - 1e-9
    assert {event["robot"] for event in recording.events if event["kind"] == "arrival"} == set(range(5))
    asked = [plan for plan in recording.plans if plan["stop"] is None]
    assert len(asked) == recorded.robots["plans"].sum()
    assert asked[0]["points"].shape[1] == 3 and 0.0 <= asked[0]["risk"] <= 1.0


def test_pictures_of_a_recorded_trial(recorded):
    picture, dark = recorded.picture(5.0), recorded.picture(dark=True, plans=False)
    assert picture.startswith("<svg") and picture.rstrip().endswith("</svg>") and picture != dark
    assert "<html" in recorded.replay()
    with pytest.raises(ValueError, match="record=True"):
        spf.Trial.from_json(recorded.to_json()).picture()


def test_recording_threads_and_json_change_nothing(recorded):
    again = spf.Scenario.load(T2).run(3, jobs=2)
    assert again.recording is None and again.same_result(recorded) and again.digest == recorded.digest
    assert spf.Trial.from_json(again.to_json()).to_json() == again.to_json()
    assert not spf.Scenario.load(T2).run(4).same_result(recorded)


def test_a_run_gives_the_programs_row_bit_for_bit():
    line = program("run", T2, "--trials", 4, "--jobs", 2, "--quiet", "--json", "-")
    results = spf.Campaign.of(spf.Scenario.load(T2), trials=4).run(jobs=2)
    assert len(results) == 4 and results.pairs == []
    assert without_timings(results.to_json_lines()) == without_timings(line)
    assert without_timings(results.rows[0]) == without_timings(line)


def test_a_campaign_gives_the_programs_rows_and_reads_its_trials(tmp_path):
    arguments = {"trials": 2, "methods": ["space_time", "orca"], "noise": ["walk"], "levels": [1],
                 "tracking": ["ideal"]}
    lines = program("experiment", "table2", "--trials", 2, "--method", "space_time,orca", "--noise", "walk", "--level", 1,
                    "--tracking", "ideal", "--quiet", "--json", "-", "--out", tmp_path / "out").splitlines()
    campaign = spf.Campaign.preset("table2", {**arguments, "variants": []})
    results = campaign.run(jobs=2)
    ours = {(row["method"]): without_timings(row) for row in results.rows}
    theirs = {json.loads(line)["method"]: without_timings(line) for line in lines if "method" in json.loads(line)}
    assert ours == theirs and set(ours) == {"space_time", "orca"}
    read = spf.Results.read(tmp_path / "out" / "trials.jsonl")
    assert {trial.digest for trial in read.trials} == {trial.digest for trial in results.trials}
    assert len(spf.Results(results.trials[:2])) == 2
    half = campaign.run(jobs=1, shard=(1, 2))
    assert len(half) == 2 and all(trial.digest in {t.digest for t in results.trials} for trial in half.trials)


def test_progress_is_told_and_may_end_a_run():
    campaign = spf.Campaign.of(spf.Scenario.load(T2, {"trial.tracking": "ideal"}), trials=3)
    told = []
    campaign.run(jobs=1, progress=lambda done, count, trial: told.append((done, count, trial.number)))
    assert [entry[:2] for entry in told] == [(1, 3), (2, 3), (3, 3)]
    assert sorted(entry[2] for entry in told) == [0, 1, 2]

    def fail(done, count, trial):
        told.append(done)
        raise KeyError("enough")

    told.clear()
    with pytest.raises(KeyError, match="enough"):
        campaign.run(jobs=1, progress=fail)
    assert told == [1]


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize("run", [lambda scenario, jobs: scenario.run(0, jobs=jobs),
                                 lambda scenario, jobs: spf.Campaign.of(scenario, trials=10**5).run(jobs=jobs)])
def test_ctrl_c_ends_a_run(run, jobs):
    """Pressed while a method in Python plans, which is a sure moment of the run."""
    class Interrupting:
        asked = 0

        def plan(self, request):
            Interrupting.asked += 1
            if Interrupting.asked == 10:
                os.kill(os.getpid(), signal.SIGINT)

    methods = spf.MethodTable()
    methods.add("interrupting", "stands, and presses Ctrl-C", lambda parameters: Interrupting())
    with pytest.raises(KeyboardInterrupt):
        run(spf.Scenario.load(T2, {"method": "interrupting"}, methods=methods), jobs)


def test_python_goes_on_while_a_trial_runs():
    ticks, running = [], threading.Event()

    def tick():
        while not running.is_set():
            ticks.append(1)
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    before = len(ticks)
    spf.Scenario.load(T2).run(5)
    after = len(ticks)
    running.set()
    thread.join()
    assert after - before > 5


@pytest.mark.parametrize("call, words", [
    (lambda s: s.run(-1), "trial = -1 must be a whole number in [0, 1000000000]"),
    (lambda s: s.run(1.5), "trial = 1.5 must be a whole number"),
    (lambda s: s.run(10**20), "trial = 100000000000000000000 must be"),
    (lambda s: s.run(0, jobs=5000), "jobs = 5000 must be a whole number in [0, 1024]"),
    (lambda s: spf.Campaign.of(s, trials=0), "trials = 0 must be"),
    (lambda s: spf.Campaign.of(s, trials=1).run(shard=(3, 2)), "shard = (3, 2) must be (i, n)"),
    (lambda s: spf.Campaign.preset("table4"), "name = 'table4' must be one of"),
    (lambda s: spf.Campaign.preset("table2", {"trials": 0}), "trials = 0 must"),
    (lambda s: spf.Trial.from_json("{}"), "line:1"),
    (lambda s: spf.Results.read("/nowhere"), "/nowhere: cannot be read"),
])
def test_bad_arguments_are_refused_by_name(call, words):
    with pytest.raises(ValueError) as refused:
        call(spf.Scenario.load(T2))
    assert words in str(refused.value)
