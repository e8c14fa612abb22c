#!/usr/bin/env python3
"""Puts mistakes into the code, one at a time, and tells which tests notice them.

    mutation.py list [PATTERN...]        lists the mutants, of all or of those whose name has a match
    mutation.py check                    fails if one of them no longer applies to the sources
    mutation.py run [--again | --new] [PATTERN...]
                                         builds each mutant, runs the suites that use its module
                                         until one fails, and writes the table of all results;
                                         the test that noticed a mutant last time goes first

The mutants are in the folder `mutants`, a file per module (mutants.py has the format). They are
built in build/mutants, from copies of the sources, as many mutants at a time as there are
processors. Results are kept beside the table, in docs/measurements/mutants.json: a run that was
interrupted goes on where it was, unless the code has changed since; where only tests have changed,
those that were noticed are left out. --again leaves out none; --new all that were run with some
older code. Fails if a mutant is noticed by no suite, and is not marked as equivalent, or cannot be
built.
"""

import concurrent.futures
import dataclasses
import itertools
import json
import os
import pathlib
import queue
import re
import sys
import threading
import time

sys.dont_write_bytecode = True
import mutants  # noqa: E402
import suites  # noqa: E402
import workplace  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = ROOT / "docs" / "measurements" / "mutants.md"
RESULTS = TABLE.with_suffix(".json")
BUILD_LIMIT = 3600.0  # seconds for what one mutant needs compiled and linked
SOUND_LIMIT = 1200.0  # seconds for a suite without a mistake
SURVIVED, BAD = "", "not built"


HEAD = """# Mutants

What `tools/mutation/mutation.py run` wrote ([how to read and use it](../../CONTRIBUTING.md#mutants)). A
mutant is a mistake put into one file, chosen from the code before a look at the tests. *Noticed by*: the
first suite that failed, and its first failed test; the suites of the mutant's own module come first.
*Seconds* include compilation and linking, beside other mutants.

{run} of {listed} mutants were run{older}, which takes {minutes:.0f} minutes with {workers} at a time;
{equivalent} of them change no answer. Of the other {counted}, {noticed} were noticed ({share:.1f} %).

| mutant | kind | noticed by | seconds |
|---|---|---|---|
"""


@dataclasses.dataclass
class Result:
    """What became of a mutant, at a state of the code and of the tests."""

    change: str
    code: str
    tests: str
    noticed_by: str
    seconds: float


class Store:
    """Results, which are part of the repository, and the times of the suites on this machine."""

    def __init__(self, times):
        self.times = times
        self.lock = threading.Lock()
        self.sound_lock = threading.Lock()
        results = json.loads(RESULTS.read_text()) if RESULTS.is_file() else {}
        self.results = {name: Result(**each) for name, each in results.items()}
        # By group of suites: the state of code and tests at which they pass, and their times.
        self.sound = json.loads(times.read_text()) if times.is_file() else {}

    def add(self, name, result):
        with self.lock:
            self.results[name] = result
            every = {each: dataclasses.asdict(self.results[each]) for each in sorted(self.results)}
            write_json(RESULTS, every)

    def add_sound(self, stage, known):
        self.sound[stage] = known
        write_json(self.times, self.sound)


def write_json(path, content):
    part = path.with_suffix(".part")
    part.write_text(json.dumps(content, indent=1) + "\n")
    part.replace(path)


class Worker:
    """Builds and tests one mutant at a time, in a place of its own."""

    def __init__(self, number, jobs, files, store, stopping):
        self.place = workplace.Workplace(ROOT, number)
        self.jobs = jobs
        self.files = files  # of all mutants, by name
        self.store = store
        self.stopping = stopping
        self.code, self.tests = self.place.refresh()
        self.place.configure()
        self.suites = suites.Suites(self.place)
        self.sound = {}  # by group of suites: the seconds of each

    def require_sound(self, stage):
        """Builds a group of suites without a mistake, and runs it once for each state of the code
        and the tests: a suite that fails by itself notices nothing."""
        if stage in self.sound:
            return
        if said := self.place.make([self.suites.target(stage)], os.cpu_count(), None):
            sys.exit(f"{stage} cannot be built:\n{said[-2000:]}")
        with self.store.sound_lock:
            known = self.store.sound.get(stage, {})
            if known.get("state") != [self.code, self.tests]:
                print(f"{stage}: without a mistake ...", flush=True)
                every = self.suites.of(stage)
                # On all processors: most workers wait for this.
                if failed := self.run_suites(every, lambda _: SOUND_LIMIT, os.cpu_count()):
                    sys.exit(f"{stage} fails without a mistake: {failed}")
                seconds = {each.name: each.seconds for each in every}
                known = {"state": [self.code, self.tests], "seconds": seconds}
                self.store.add_sound(stage, known)
        self.sound[stage] = known["seconds"]

    def run_suites(self, every, limit_of, jobs):
        return suites.run(every, self.place.folder / "logs", jobs, limit_of, self.stopping)

    def limit_of(self, suite):
        return 20.0 + 5.0 * self.seconds_of(suite)

    def seconds_of(self, suite):
        """How long a suite takes without a mistake."""
        return self.sound[suite.stage][suite.name]

    def in_order(self, every, mutant):
        """Suites by their time for each mutant that they can be expected to notice: those that
        noticed others of the module, and of the file above all, will notice more of them."""
        with self.store.lock:
            noticed = [(name, each.noticed_by) for name, each in self.store.results.items()]
        near = [
            (notice, 4.0 if self.files.get(name) == mutant.file else 1.0)
            for name, notice in noticed
            if name.startswith(f"{mutant.module}/")
        ]

        def cost(suite):
            hits = sum(weight for notice, weight in near if notice.startswith(f"{suite.name}: "))
            return self.seconds_of(suite) / (0.2 + hits)

        return sorted(every, key=cost)

    def notice(self, mutant, stage, former=""):
        """The test of a group that fails with the mistake that is in place; SURVIVED if there is
        none, BAD if it is no program. `former`: looks only at the suite that noticed it before."""
        if said := self.place.make([self.suites.target(stage)], self.jobs, BUILD_LIMIT):
            if not self.stopping.is_set():
                print(said[-2000:], flush=True)
            return BAD
        every = self.suites.of(stage)
        if former:
            every = [each for each in every if former.startswith(f"{each.name}: ")]
        return self.run_suites(self.in_order(every, mutant), self.limit_of, self.jobs)

    def run(self, mutant):
        known = self.store.results.get(mutant.full_name)
        former = known.noticed_by if known else ""
        looks = [(stage, "") for stage in self.suites.stages(mutant)]
        looks = [(stage, former) for stage, _ in looks if suites.is_of(former, stage)] + looks
        noticed, seconds = SURVIVED, 0.0
        while looks and noticed == SURVIVED:
            self.require_sound(looks[0][0])
            start = time.monotonic()
            with self.place.mistake(mutant):
                while looks and looks[0][0] in self.sound and noticed == SURVIVED:
                    noticed = self.notice(mutant, *looks.pop(0))
            seconds += time.monotonic() - start
        if not self.stopping.is_set():
            result = Result(mutant.digest, self.code, self.tests, noticed, round(seconds, 1))
            self.store.add(mutant.full_name, result)
        return noticed, seconds

    def is_done(self, mutant, any_code=False):
        """Whether its result holds: tests that have changed can only notice more."""
        result = self.store.results.get(mutant.full_name)
        return (
            result
            and result.change == mutant.digest
            and (any_code or result.code == self.code)
            and (result.tests == self.tests or result.noticed_by not in (SURVIVED, BAD))
        )

    def run_all(self, files, tell):
        """Runs the mutants of one file after the other, until no file is left."""
        while not self.stopping.is_set():
            try:
                group = files.get_nowait()
            except queue.Empty:
                return
            for mutant in group:
                noticed, seconds = self.run(mutant)
                if self.stopping.is_set():
                    return
                tell(mutant, noticed, seconds)


def word_for(mutant, noticed):
    if noticed == SURVIVED:
        return "equivalent" if mutant.equivalent else "SURVIVED"
    return f"NOT EQUIVALENT: {noticed}" if mutant.equivalent else noticed


def is_fault(mutant, noticed):
    return noticed == BAD or (noticed == SURVIVED) != bool(mutant.equivalent)


def chosen(patterns, every):
    if not patterns:
        return every
    return [each for each in every if any(re.search(p, each.full_name) for p in patterns)]


def make_workers(count, files):
    """As many as are useful, which divide the processors among themselves."""
    folder = workplace.folder_of(ROOT)
    folder.mkdir(parents=True, exist_ok=True)
    store, stopping = Store(folder / "times.json"), threading.Event()
    count = max(1, min(count, os.cpu_count()))
    jobs = os.cpu_count() // count
    return [Worker(number, jobs, files, store, stopping) for number in range(count)]


def run(patterns, flags):
    every = mutants.read_all()
    wanted = sorted(chosen(patterns, every), key=lambda each: (each.module, each.file))
    # Those of one file one after the other: it is compiled once for each, and once more at the end.
    groups = [list(group) for _, group in itertools.groupby(wanted, lambda each: each.file)]
    workers = make_workers(len(groups), {each.full_name: each.file for each in every})
    store, any_code = workers[0].store, "--new" in flags
    done, faults = 0, 0

    def tell(mutant, noticed, seconds):
        nonlocal done, faults
        with store.lock:
            done += 1
            faults += is_fault(mutant, noticed)
            said = f"{mutant.full_name}: {word_for(mutant, noticed)} ({seconds:.0f} s)"
            print(f"{done}/{len(wanted)} {said}", flush=True)

    files = queue.SimpleQueue()
    for group in sorted(groups, key=len, reverse=True):
        left = [each for each in group if "--again" in flags or not workers[0].is_done(each, any_code)]
        for mutant in group:
            if mutant not in left:
                tell(mutant, store.results[mutant.full_name].noticed_by, 0.0)
        if left:
            files.put(left)
    with concurrent.futures.ThreadPoolExecutor(len(workers)) as pool:
        try:
            ends = [pool.submit(each.run_all, files, tell) for each in workers]
            for end in concurrent.futures.as_completed(ends):
                end.result()
        finally:
            workers[0].stopping.set()
    TABLE.write_text(table(every, workers[0]))
    return 1 if faults else 0


def table(every, worker):
    """The latest result of each mutant, as a page of the documents."""
    rows, seconds, noticed, equivalent, older = [], 0.0, 0, 0, 0
    for mutant in every:
        result = worker.store.results.get(mutant.full_name)
        if not result or result.change != mutant.digest:
            continue
        seconds += result.seconds
        equivalent += bool(mutant.equivalent)
        noticed += not mutant.equivalent and result.noticed_by not in (SURVIVED, BAD)
        older += not worker.is_done(mutant)
        word = word_for(mutant, result.noticed_by).replace("|", "\\|")
        rows.append(f"| {mutant.full_name} | {mutant.kind} | {word} | {result.seconds:.0f} |")
    counted = len(rows) - equivalent
    head = HEAD.format(
        listed=len(every), run=len(rows), noticed=noticed, equivalent=equivalent, counted=counted,
        share=100.0 * noticed / max(1, counted), workers=os.cpu_count(),
        minutes=seconds / 60.0 / os.cpu_count(),
        older=f" ({older} of them with older code)" if older else "",
    )
    return head + "\n".join(rows) + "\n"


def list_mutants(patterns):
    for mutant in chosen(patterns, mutants.read_all()):
        equivalent = f" [equivalent: {mutant.equivalent}]" if mutant.equivalent else ""
        print(f"{mutant.full_name} ({mutant.kind}, {mutant.file}): {mutant.why}{equivalent}")
    return 0


def check():
    every = mutants.read_all()
    faults = mutants.faults(every, ROOT)
    print("\n".join(faults) or f"{len(every)} mutants apply")
    return 1 if faults else 0


def main():
    command, *rest = sys.argv[1:] or [""]
    flags = [word for word in rest if word.startswith("-")]
    patterns = [word for word in rest if word not in flags]
    if len(flags) > 1 or not set(flags) <= {"--again", "--new"}:
        command = ""
    try:
        if command == "list" and not flags:
            return list_mutants(patterns)
        if command == "check" and not rest:
            return check()
        if command == "run":
            return run(patterns, flags)
    except ValueError as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("interrupted; the next run goes on from here", file=sys.stderr)
        return 130
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
