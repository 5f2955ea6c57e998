#!/usr/bin/env python3
"""Every task on 1, 2 and 4 ranks: numbers of all CSV files agree to 1e-10 of the largest in their column; and a checkpoint written
on 2 ranks is gone on with on 1 and on 4."""
import argparse
import csv
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "studies"))
import coarse
import kill_test

TOLERANCE = 1e-10
# Counts of a solver may differ by one; errors and residuals are round-off themselves; what the clock says.
NOT_RESULTS = ("iterations", "_error", "residual", "imbalance", "relative_error")
# A strain is a difference of positions (200 mm) over an element (13 mm): round-off of 2^-53 is this much.
STRAIN_ROUND_OFF = 1e-14
STRAINS = ("strain", "thinning", "flc_margin")  # the last is a strain over one of some tenths
CASES = {
    "flow factors": kill_test.TASKS["flow factors"],
    "friction table": kill_test.TASKS["friction table"],
    "strip draw": kill_test.TASKS["strip draw"],
    "film": ("slider_bearing", {}),
    "film with cavities": ("pocket_bearing", {"Gap/Elements along": "100"}),
    "elastic shell": ("shell_open_cylinder", {"Sheet test/Shell/Solver/Residual tolerance": "1e-12"}),
    "elastic step of a drawing": ("cross_die", {**kill_test.TASKS["drawing"][1], "Process/Punch travel": "0.1 mm", "Process/Unloading": "no",
                                               "Solver/First increment": "0.05 mm", "Solver/Largest increment": "0.05 mm",
                                               "Solver/Residual tolerance": "1e-11", "Solver/Displacement tolerance": "1e-9 mm"}),
}

arguments = argparse.ArgumentParser()
for name in ("program", "mpiexec", "source"):
    arguments.add_argument("--" + name, required=True)
arguments.add_argument("--cases", nargs="+", default=list(CASES) + ["checkpoint"])
given = arguments.parse_args()
# Ranks share cores here: one that waits should yield.
ENVIRONMENT = {**os.environ, "OMPI_MCA_mpi_yield_when_idle": "1", "DEAL_II_NUM_THREADS": "1"}
problems = []


def run(ranks, words):
    launch = [given.mpiexec, "--allow-run-as-root", "--oversubscribe", "-x", "PATH=/nonexistent", "-n", str(ranks)]  # no figures
    done = subprocess.run(launch + [str(w) for w in words], capture_output=True, text=True, env=ENVIRONMENT)
    if done.returncode:
        sys.exit(f"{ranks} ranks: exit code {done.returncode}\n{done.stdout}\n{done.stderr}")


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def difference(one, other, what):
    """The largest difference of two folders in parts of the largest number of its column; words must be the same."""
    worst = 0
    for file in sorted(one.glob("*.csv")):
        if file.name == "timing.csv":
            continue
        with open(file) as a, open(other / file.name) as b:
            a, b = list(csv.reader(a)), list(csv.reader(b))
        if len(a) != len(b):
            problems.append(f"{what}, {file.name}: {len(a)} and {len(b)} rows")
            continue
        by_quantity = a[0][:1] == ["quantity"]
        for c, column in enumerate(a[0]):
            scale = max([abs(number(r[c])) for r in a[1:] if number(r[c]) is not None and number(r[c]) == number(r[c])] or [0])
            for ra, rb in zip(a[1:], b[1:]):
                name = ra[0] if by_quantity else column
                x, y = number(ra[c]), number(rb[c])
                if any(word in name for word in NOT_RESULTS) or (x is not None and y is not None and x != x and y != y):
                    continue
                if x is None or y is None:
                    if ra[c] != rb[c]:
                        problems.append(f"{what}, {file.name}, {name}: {ra[c]!r} and {rb[c]!r}")
                    continue
                if by_quantity:
                    scale = max(abs(x), 1e-12)
                if any(word in name for word in STRAINS) and abs(x - y) < STRAIN_ROUND_OFF:
                    continue
                error = abs(x - y) / scale if scale > 0 else abs(y)
                if not error <= worst:
                    worst = error
                    where = f"{file.name}, {name}: {x!r} and {y!r}"
    return worst, where if worst > 0 else "all the same"


with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    for name in given.cases:
        if name == "checkpoint":
            continue
        file, settings = CASES[name]
        outputs = {}
        for ranks in (1, 2, 4):
            outputs[ranks] = folder / name.replace(" ", "_") / str(ranks) / "run"
            words = [given.program, pathlib.Path(given.source) / "prm" / (file + ".prm"), "--quiet", "--output", outputs[ranks]]
            for entry, value in settings.items():
                words += ["--set", f"{entry} = {value}"]
            run(ranks, words)
        for ranks in (2, 4):
            worst, where = difference(outputs[1], outputs[ranks], f"{name} on {ranks} ranks")
            print(f"{name} on {ranks} ranks: {worst:.1e} ({where})", flush=True)
            if not worst <= TOLERANCE:
                problems.append(f"{name} on {ranks} ranks: {where}")
    if "checkpoint" in given.cases:
        changes = {"Coupling/Friction": "constant", "Output/Travel between checkpoints": "1 mm"}
        whole = folder / "whole"
        run(1, coarse.command(given.program, given.source, str(whole), changes.items()))
        for ranks in (1, 4):
            cut = folder / f"cut_{ranks}"
            run(2, coarse.command(given.program, given.source, str(cut), {**changes, "Process/Punch travel": "2 mm"}.items()))
            run(ranks, coarse.command(given.program, given.source, str(cut), changes.items()) + ["--resume"])
            header, expected = coarse.rows(whole / "history.csv")
            _, found = coarse.rows(cut / "history.csv")
            column = header.index("punch_force_n")
            worst = max(abs(a[column] - b[column]) / abs(expected[-1][column]) for a, b in zip(expected, found))
            print(f"checkpoint of 2 ranks, resumed on {ranks}: punch force within {worst:.1e}, {len(found)} of {len(expected)} rows")
            if len(found) != len(expected) or not worst < 1e-6:  # Newton's tolerance is 1e-9 of the contact forces
                problems.append(f"checkpoint of 2 ranks, resumed on {ranks}")

print("\n".join(problems))
sys.exit(1 if problems else 0)
