"""Two machines of a network, for tests: two network namespaces, joined by a cable (veth) that can be pulled."""
import contextlib
import os
import re
import signal
import subprocess
import tempfile
import time
from pathlib import Path

ADDRESS = {"a": "10.83.0.1", "b": "10.83.0.2"}


class Unavailable(Exception):
    """The kernel or the rights do not allow network namespaces."""


def ip(*arguments):
    subprocess.run(["ip", *arguments], check=True, capture_output=True, text=True)


class Machine:
    """A network namespace with one end of the cable. The environment of what it runs is this one with `variables`, by their names:
    None takes one away."""

    def __init__(self, letter, folder):
        self.name = f"spf{os.getpid()}{letter}"
        self.address = ADDRESS[letter]
        self.folder = folder / letter
        self.folder.mkdir()
        self.variables = {}
        self.started = []
        ip("netns", "add", self.name)

    def run(self, *command):
        ip("netns", "exec", self.name, *command)

    def connect(self, interface):
        self.interface = interface
        ip("link", "set", interface, "netns", self.name)
        self.run("ip", "address", "add", f"{self.address}/24", "dev", interface)
        self.run("ip", "link", "set", interface, "up")
        self.run("ip", "link", "set", "lo", "up")

    def pull(self):
        self.run("ip", "link", "set", self.interface, "down")

    def plug(self):
        self.run("ip", "link", "set", self.interface, "up")

    def start(self, name, *command):
        environment = {key: value for key, value in {**os.environ, **self.variables}.items() if value is not None}
        with open(self.folder / f"{name}.log", "w", encoding="utf-8") as log:
            process = subprocess.Popen(["ip", "netns", "exec", self.name, *command], env=environment, stdout=log,
                                       stderr=subprocess.STDOUT, start_new_session=True)
        self.started.append(process)
        return process

    def log(self, name):
        return (self.folder / f"{name}.log").read_text(encoding="utf-8", errors="replace")

    def processes(self):
        found = subprocess.run(["ip", "netns", "pids", self.name], capture_output=True, text=True, check=False)
        return [int(word) for word in found.stdout.split()]

    def end(self, seconds):
        """Asks what it started to end; what has not within that time."""
        for process in reversed(self.started):
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
        deadline = time.monotonic() + seconds
        for process in self.started:
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(max(0.0, deadline - time.monotonic()))
        return [process for process in self.started if process.poll() is None]

    def remove(self):
        self.end(20.0)
        for process in self.processes():
            os.kill(process, signal.SIGKILL)
        for process in self.started:
            process.wait()
        subprocess.run(["ip", "netns", "delete", self.name], check=False, capture_output=True)


@contextlib.contextmanager
def two_machines(folder):
    """Both, connected; their logs are in `folder`."""
    machines = []
    try:
        try:
            for letter in "ab":
                machines.append(Machine(letter, folder))
            ends = [f"spf{os.getpid() % 100000}{machine.name[-1]}0" for machine in machines]
            ip("link", "add", ends[0], "type", "veth", "peer", "name", ends[1])
            for machine, end in zip(machines, ends):
                machine.connect(end)
        except (OSError, subprocess.CalledProcessError) as error:
            raise Unavailable(getattr(error, "stderr", "") or str(error)) from error
        yield machines
    finally:
        for machine in reversed(machines):
            machine.remove()


def longest_gap(log, robot):
    """Between two commands that reached a base, as the simulator tells at its end [s]."""
    return float(re.search(rf"robot{robot}: \d+ commands, \d+ late, longest gap ([\d.]+) s", log).group(1))


def test_on_two_machines(drive):
    """A test's exit status: `drive(first, second, folder)` tells what is wrong, in a list. 77 (skipped) without namespaces."""
    with tempfile.TemporaryDirectory(prefix="spf-two-machines-") as name:
        try:
            with two_machines(Path(name)) as machines:
                problems = drive(*machines, Path(name))
            if problems:  # what the simulator and the robots said last
                for log in sorted(Path(name).glob("*/*.log")):
                    print(f"-- {log.name}:", *log.read_text(encoding="utf-8", errors="replace").splitlines()[-15:], sep="\n")
        except Unavailable as error:
            print(f"skipped: no network namespaces here ({error})")
            return 77
    print("\n".join(problems) if problems else "both machines' robots arrived")
    return 1 if problems else 0
