#!/usr/bin/env python3
"""Kill runs and resume them: kill_test.py PROGRAM FOLDER [--kills 100] [--flips 100] [--tasks NAME ...]

Every task in small is run to its end twice, with the same bytes. Then runs are interrupted, and gone on with by --resume, until
--kills of each task have been ended by SIGKILL: half of them at a random time, half of them at a random place in the writing of a file (in the middle
of its content, before and after it gets its name); one interruption in six is a full disk instead (exit code 2, the file named).
After one to four interruptions in a row a run is resumed to its end, and all its CSV, VTU, PVD and JSON files have to be the
bytes of the uninterrupted run, with no other file left over. At the end a random byte of the newest checkpoint is flipped --flips
times: it has to be noticed, the one before it has to be used, and the end has to be the same bytes.

With --tmpfs (root only) full disks are also real: a small file system of 200 kB to 2 MB.
Exit code 0: all that held; a line a task says how often.
"""
import argparse
import filecmp
import math
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
SMALL_MAPS = {"Sheet surface/Generated/Pixels": "96", "Tool surface/Generated/Pixels": "96"}
TABLE = {**SMALL_MAPS, "Friction table/Pressures": "1, 5, 20 MPa", "Friction table/Strains": "0, 0.2", "Friction table/Cut heights": "5",
         "Friction table/Interpolation error": "1"}
DRAW = {"Blank/Element size": "13 mm", "Process/Punch travel": "4 mm", "Solver/First increment": "0.5 mm",
        "Solver/Largest increment": "0.5 mm", "Output/Travel between checkpoints": "0.5 mm", "Output/Travel between fields": "1 mm"}
TASKS = {  # name: (file, settings)
    "surface": ("surface", {"Sheet surface/Generated/Pixels": "256"}),
    "flow factors": ("flow_factors_gaussian", {"Sheet surface/Generated/Pixels": "128"}),
    "friction table": ("friction_table", TABLE),
    "strip draw": ("strip_draw", {**TABLE, "Friction table/Pressures": "1, 5, 20, 100 MPa", "Friction table/Strains": "0, 0.2, 0.5", "Strip draw/Sweep/Coefficient table": "false"}),
    "film": ("pocket_bearing", {}),
    "sheet": ("shell_hinged_roof", {"Sheet test/Shell/Surface/U elements": "12", "Sheet test/Shell/Surface/V elements": "12"}),
    "drawing": ("cross_die", {**DRAW, "Coupling/Friction": "constant", "Coupling/Constant friction coefficient": "0.1",
                              "Process/Unloading": "tools removed"}),
    "lubricated drawing": ("cross_die", {**DRAW, **SMALL_MAPS, "Friction table/Cut heights": "5"}),
}
WITH_CHECKPOINTS = {"drawing", "lubricated drawing"}
NOT_RESULTS = {"timing.csv"}
KINDS = {".csv", ".vtu", ".pvd", ".json", ".gsf", ".prm"}


class Failure(Exception):
    pass


class Case:
    """One task in small: commands, the uninterrupted run, comparisons with it."""

    def __init__(self, program, name, folder, library):
        self.program, self.name, self.library = program, name, library
        self.file, self.settings = TASKS[name]
        self.folder = folder / name.replace(" ", "_")
        self.whole = self.folder / "whole"
        counter = self.folder / "events"
        self.duration = math.inf  # the shorter of two: other work on the machine must not put most kills behind the end
        for root in (self.whole, self.folder / "again"):
            start = time.monotonic()
            self.check(self.run(root, environment=self.preload("count", 0, counter) if library else None), 0)
            self.duration = min(self.duration, time.monotonic() - start)
        self.n_events = int(counter.read_text()) if library else 0
        self.compare(root, "second run")

    def preload(self, how, at, counter=""):
        return {"LD_PRELOAD": str(self.library), "INTERRUPT_HOW": how, "INTERRUPT_AT": str(at), "INTERRUPT_COUNT": str(counter)}

    def command(self, root, resume):
        words = [self.program, SOURCE / "prm" / (self.file + ".prm"), "--output", root / "run"]
        for entry, value in self.settings.items():
            words += ["--set", f"{entry} = {value}"]
        return [str(w) for w in words] + (["--resume"] if resume else [])

    def run(self, root, resume=False, environment=None, seconds=None):
        """Run it, without drawing figures (they are found in PATH); kill it after so many seconds."""
        root.mkdir(parents=True, exist_ok=True)
        with open(root / "terminal.txt", "w+") as terminal:
            process = subprocess.Popen(self.command(root, resume), stdout=terminal, stderr=subprocess.STDOUT,
                                       env={**os.environ, "PATH": "/nonexistent", **(environment or {})})
            try:
                process.wait(timeout=seconds)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        return process.returncode, (root / "terminal.txt").read_text()

    def check(self, outcome, code):
        if outcome[0] != code:
            raise Failure(f"{self.name}: exit code {outcome[0]} instead of {code}\n{outcome[1][-3000:]}")

    def results(self, root):
        return sorted(str(f.relative_to(root)) for f in root.rglob("*") if f.suffix in KINDS and f.name not in NOT_RESULTS)

    def compare(self, root, what):
        left = [str(f) for f in root.rglob("*.partial")]
        if left:
            raise Failure(f"{self.name}, {what}: half written files are left: {left}")
        if self.results(root) != self.results(self.whole):
            raise Failure(f"{self.name}, {what}: other files: {set(self.results(root)) ^ set(self.results(self.whole))}")
        for file in self.results(root):
            if not filecmp.cmp(root / file, self.whole / file, shallow=False):
                raise Failure(f"{self.name}, {what}: {file} has other bytes; see {root}")


def interrupt(case, root, resume, chance, tally):
    """One interruption of one of the three kinds."""
    kind = chance.choice(["time", "writing", "time", "writing", "time", "full"]) if case.library else "time"
    if kind == "time":
        code, text = case.run(root, resume, seconds=chance.uniform(0, 1.05 * case.duration))
    else:
        code, text = case.run(root, resume, case.preload("kill" if kind == "writing" else "full", chance.randint(1, case.n_events)))
    if code == -9:
        tally["kills"] += 1
        tally["kills in writing"] += kind == "writing"
    elif code == 2 and kind == "full" and "No space left on device" in text:
        tally["full disks"] += 1
    elif code == 0:
        tally["ended before"] += 1  # a resumed run has less to do
    else:
        case.check((code, text), 0)


def kill_and_resume(case, kills, chance, tally):
    while tally["kills"] < kills:
        root = case.folder / "cut"
        shutil.rmtree(root, ignore_errors=True)
        for k in range(chance.randint(1, 4)):
            interrupt(case, root, k > 0, chance, tally)
        case.check(case.run(root, resume=True), 0)
        case.compare(root, "resumed")
        tally["resumed to the end"] += 1


def flip_bytes(case, flips, chance, tally):
    """Take one interrupted run with two checkpoints and damage the newer one in many ways."""
    start = case.folder / "interrupted"
    shutil.rmtree(start, ignore_errors=True)
    n = case.n_events
    while True:  # the latest interruption that leaves both checkpoints
        n -= 3
        case.run(start, environment=case.preload("kill", n))
        files = sorted((start / "run").glob("checkpoint_*.bin"), key=lambda f: f.stat().st_mtime_ns)
        if len(files) == 2:
            break
    newest = files[1].name
    for _ in range(flips):
        root = case.folder / "flipped"
        shutil.rmtree(root, ignore_errors=True)
        shutil.copytree(start, root)
        content = bytearray((root / "run" / newest).read_bytes())
        content[chance.randrange(len(content))] ^= chance.randint(1, 255)
        (root / "run" / newest).write_bytes(content)
        outcome = case.run(root, resume=True)
        case.check(outcome, 0)
        if newest not in outcome[1] or files[0].name + " at" not in outcome[1]:
            raise Failure(f"{case.name}: a flipped byte was not noticed\n{outcome[1]}")
        case.compare(root, "flipped byte")
        tally["flipped bytes"] += 1


def real_full_disk(case, chance, tally):
    root = case.folder / "small_disk"
    root.mkdir(parents=True, exist_ok=True)
    for size in [chance.randint(200, 2000) for _ in range(5)]:
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k", "tmpfs", root], check=True)
        try:
            code, text = case.run(root)
            if code not in (0, 2) or (code == 2 and "No space left on device" not in text):
                case.check((code, text), 2)
            subprocess.run(["mount", "-o", "remount,size=200m", root], check=True)
            case.check(case.run(root, resume=True), 0)
            case.compare(root, "real full disk")
            tally["real full disks"] += code == 2
        finally:
            subprocess.run(["umount", root], check=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program", type=pathlib.Path)
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("--kills", type=int, default=100)
    arguments.add_argument("--flips", type=int, default=100)
    arguments.add_argument("--tasks", nargs="+", choices=TASKS, default=list(TASKS))
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--library", type=pathlib.Path, help="built from interrupt_writes.c; built here if absent")
    arguments.add_argument("--tmpfs", action="store_true")
    given = arguments.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="kills-", dir=given.folder)).resolve()
    library = given.library
    if library is None:
        library = folder / "interrupt_writes.so"
        subprocess.run(["cc", "-O1", "-shared", "-fPIC", "-o", library, SOURCE / "tests/studies/interrupt_writes.c", "-ldl"], check=True)
    try:
        for name in given.tasks:
            chance = random.Random(f"{given.seed} {name}")
            tally = dict.fromkeys(["kills", "kills in writing", "full disks", "ended before", "resumed to the end", "flipped bytes",
                                   "real full disks"], 0)
            case = Case(given.program.resolve(), name, folder, library.resolve())
            kill_and_resume(case, given.kills, chance, tally)
            if name in WITH_CHECKPOINTS:
                flip_bytes(case, given.flips, chance, tally)
            if given.tmpfs:
                real_full_disk(case, chance, tally)
            print(f"{name} ({case.duration:.1f} s, {case.n_events} moments of writing): "
                  + ", ".join(f"{count} {what}" for what, count in tally.items() if count) + "; all the same bytes", flush=True)
    except Failure as failure:
        sys.exit(str(failure))
    shutil.rmtree(folder)


if __name__ == "__main__":
    main()
