"""Which tests look at which module, and how they are run."""

import dataclasses
import json
import os
import re
import resource
import signal
import subprocess
import time

# Suites outside of tests/unit: the name of their tests in CTest begins like this.
GROUPS = {
    "query": (r"query\.[A-Z]", "test_query"),
    "query on the second driver": (r"query\.[a-z]", "test_query"),
    "graph on the second driver": (r"graph\.[a-z]", "test_graph"),
    "gpu on the second driver": (r"gpu\.[a-z]", "test_gpu"),
    "worlds": (r"world\.", "test_worlds"),
    "limits": (r"limits\.", "test_limits"),
    "driver": (r"driver\.", "test_driver"),
    "async compute": (r"async_compute\.", "test_async_compute"),
    "threads": (r"threads$", "test_threads"),
    "reload": (r"reload$", "test_reload"),
    "hash": (r"hash\.", "test_hash"),
    "simulation": (r"simulation\.", "test_simulation"),
    "painter": (r"viewer\.Painter$", "test_painter"),
    "drag": (r"viewer\.Drag$", "test_drag"),
    "viewer": (r"viewer\.Window$", "test_viewer"),
    "cli": (None, "test_program"),
}
# Of each module the groups that use it, in this order, after its own unit tests. By default those of
# the CPU's answers.
ANSWERS = ("query", "worlds", "hash")
DEVICE = ("query", "driver", "query on the second driver")
USED_BY = {
    "geometry": ("query", "worlds", "cli", "hash"),
    "plan": ("query", "driver", "query on the second driver", "hash"),
    "select": ("query", "driver"),
    "decode": DEVICE,
    "results": ("query", "driver", "threads", "hash"),
    "gpu": ("gpu on the second driver", *DEVICE, "async compute"),
    "graph": ("graph on the second driver", *DEVICE, "async compute"),
    "passes": DEVICE,
    "shaders": DEVICE,
    "resident": DEVICE,
    "render": DEVICE,
    "batch": ("query", "driver", "worlds", "limits", "threads"),
    "context": ("worlds", "limits", "query", "driver", "threads"),
    "world": ("worlds", "limits", "threads", "hash", "query"),
    "reload": ("reload", "driver"),
    "io": ("cli",),
    "cli": ("cli",),
    "common": ("cli",),
    "hash": ("hash",),
    "drawing": ("cli",),
    "simulation": ("simulation", "cli"),
    "rendering": ("painter", "cli"),
    "viewer": ("drag", "viewer"),
    "benchmark": ("cli",),
}


@dataclasses.dataclass
class Suite:
    """Some tests of one program, run as one process."""

    name: str
    stage: str
    command: list
    environment: dict
    seconds: float = 0.0  # of its last run that passed


class Suites:
    """All suites of a build."""

    def __init__(self, place):
        self.place = place
        query = [test for test in self.listed() if re.match(GROUPS["query"][0], test["name"])]
        self.first_driver = self.changes_of(query[0])
        self.cache = {}

    def listed(self):
        """The tests as CTest knows them; those whose program is not built have no command."""
        command = ["ctest", "--test-dir", self.place.build, "--show-only=json-v1"]
        said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        return json.loads(said)["tests"]

    @staticmethod
    def changes_of(test):
        """The environment of one test: 'NAME=set:VALUE'."""
        for each in test.get("properties", []):
            if each["name"] == "ENVIRONMENT_MODIFICATION":
                return dict(change.split("=set:", 1) for change in each["value"])
        return {}

    def stages(self, mutant):
        """The names of the groups of suites that use a mutant's module, its own first. Where the
        drivers differ is in what runs at the same time, so the second one is asked for barriers."""
        module = mutant.module
        own = [f"unit {module}"] if (self.place.source / "tests" / "unit" / module).is_dir() else []
        others = USED_BY.get(module, ANSWERS)
        return own + [
            each for each in others if mutant.kind == "barrier" or "second driver" not in each
        ]

    @staticmethod
    def target(stage):
        return f"test_{stage.split()[1]}" if stage.startswith("unit ") else GROUPS[stage][1]

    def of(self, stage):
        """The suites of a group; its program has been built."""
        if stage not in self.cache:
            self.cache[stage] = self.find(stage)
        return self.cache[stage]

    def find(self, stage):
        if stage.startswith("unit ") or stage == "cli":
            folder = self.place.build / "tests" / ("cli" if stage == "cli" else "")
            program = folder / self.target(stage)
            command = [program, "--gtest_list_tests"]
            listed = subprocess.run(command, check=True, capture_output=True, text=True)
            lines = listed.stdout.splitlines()
            names = [line.split(".")[0] for line in lines if re.match(r"\S+\.", line)]
            return [
                Suite(
                    f"{stage}: {name}", stage, [program, f"--gtest_filter={name}.*"], self.first_driver
                )
                for name in names
            ]
        pattern = GROUPS[stage][0]
        return [
            Suite(test["name"], stage, test["command"], self.changes_of(test))
            for test in self.listed()
            if re.match(pattern, test["name"])
        ]


def is_of(noticed_by, stage):
    """Whether it is a suite of the group that noticed something."""
    pattern = GROUPS.get(stage, (None,))[0] or re.escape(f"{stage}: ")
    return re.match(pattern, noticed_by) is not None


def verdict(output, status):
    """What a failed process said: its first failed test, or how it ended."""
    failed = re.search(r"\[  FAILED  \] ([\w/]+\.[\w/]+)", output)
    if failed:
        return failed[1]
    running = re.findall(r"\[ RUN      \] (\S+)", output)
    end = signal.Signals(-status).name if status < 0 else f"exit status {status}"
    return f"{running[-1]} ({end})" if running else end


class Process:
    """A suite that is running. Its limit counts processor time, so that other work on the machine does
    not end it; one that waits for ever is ended after four times as long."""

    def __init__(self, suite, log, limit):
        self.suite, self.limit = suite, 4.0 * limit
        seconds = int(limit) * os.cpu_count()
        self.log = open(log, "w+", errors="replace")
        self.begun = time.monotonic()
        self.process = subprocess.Popen(
            suite.command, stdout=self.log, stderr=subprocess.STDOUT, start_new_session=True,
            env=os.environ | suite.environment | {"GTEST_FAIL_FAST": "1"}, cwd=log.parent,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds)),
        )

    def ended(self):
        """None while it runs; then an empty text, or what it noticed."""
        status = self.process.poll()
        late = time.monotonic() - self.begun > self.limit
        if status is None and not late:
            return None
        seconds = time.monotonic() - self.begun
        self.stop()
        if status is None:
            return f"{self.suite.name}: no end after {seconds:.0f} s"
        self.suite.seconds = seconds if status == 0 else self.suite.seconds
        self.log.seek(0)
        said = verdict(self.log.read(), status) if status else ""
        self.log.close()
        return f"{self.suite.name}: {said}" if said else ""

    def stop(self):
        """Ends it with all it has started."""
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.process.wait()


def run(suites, folder, jobs, limit_of, stopping):
    """Runs suites, `jobs` at a time; returns what the first one that fails has noticed, or an empty
    text if none does before the event `stopping` is set."""
    folder.mkdir(parents=True, exist_ok=True)
    waiting, running = list(suites), {}
    try:
        while (waiting or running) and not stopping.is_set():
            for slot in range(jobs):
                if waiting and slot not in running:
                    suite = waiting.pop(0)
                    running[slot] = Process(suite, folder / f"{slot}.log", limit_of(suite))
            for slot, process in list(running.items()):
                noticed = process.ended()
                if noticed is not None:
                    del running[slot]
                if noticed:
                    return noticed
            time.sleep(0.01)
        return ""
    finally:
        for process in running.values():
            process.stop()
