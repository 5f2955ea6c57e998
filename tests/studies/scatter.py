#!/usr/bin/env python3
"""Numerical scatter of the drawing: scatter.py PROGRAM FOLDER [--size MM] [--ranks MPIEXEC]

The square cup of prm/square_cup.prm to 40 mm, with solver settings varied that must not matter: first increment, largest
increment, tolerance; with --ranks also two ranks. Prints, for the punch force over the whole stroke, the largest and the mean
square difference from the first run, by the peak, and draw-in at the end. Writes FOLDER/<case>/history.csv; a case that is
already there is not run again.
"""
import argparse
import csv
import pathlib
import subprocess

SOURCE = pathlib.Path(__file__).resolve().parents[2]
CASES = {"as shipped": [],
         "first increment 0.03 mm": ["Solver/First increment = 0.03 mm"],
         "largest increment 0.95 mm": ["Solver/Largest increment = 0.95 mm"],
         "residual tolerance 1e-5": ["Solver/Residual tolerance = 1e-5"]}


def history(program, folder, name, settings, size, launcher=()):
    output = folder / name.replace(" ", "_")
    if not (output / "results.csv").exists():
        words = [*launcher, program, str(SOURCE / "prm" / "square_cup.prm"), "--output", str(output), "--quiet"]
        for entry in [f"Blank/Element size = {size} mm", "Output/Travel between fields = 100 mm",
                      "Output/Travel between checkpoints = 0 mm", *settings]:
            words += ["--set", entry]
        subprocess.run(words, check=True)
    with open(output / "history.csv") as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def force_at(rows, travel):
    for a, b in zip(rows, rows[1:]):
        if a["punch_travel_mm"] <= travel <= b["punch_travel_mm"] and b["punch_travel_mm"] > a["punch_travel_mm"]:
            share = (travel - a["punch_travel_mm"]) / (b["punch_travel_mm"] - a["punch_travel_mm"])
            return a["punch_force_n"] + share * (b["punch_force_n"] - a["punch_force_n"])
    return rows[-1]["punch_force_n"]


arguments = argparse.ArgumentParser()
arguments.add_argument("program")
arguments.add_argument("folder", type=pathlib.Path)
arguments.add_argument("--size", type=float, default=3.75)
arguments.add_argument("--ranks", metavar="MPIEXEC")
given = arguments.parse_args()
given.folder.mkdir(parents=True, exist_ok=True)

runs = {name: history(given.program, given.folder, name, settings, given.size) for name, settings in CASES.items()}
if given.ranks:
    launcher = [given.ranks, "--allow-run-as-root", "--oversubscribe", "-n", "2"]
    runs["two ranks"] = history(given.program, given.folder, "two ranks", [], given.size, launcher)
first = next(iter(runs.values()))
peak = max(row["punch_force_n"] for row in first)
travels = [0.5 * i for i in range(2, 81)]
worst = 0.
for name, rows in runs.items():
    # Between two increments the force is taken as a straight line in either run.
    differences = [(force_at(rows, t) - force_at(first, t)) / peak for t in travels]
    largest = max(map(abs, differences))
    worst = max(worst, largest)
    end = rows[-1]
    mean = (sum(d * d for d in differences) / len(differences)) ** 0.5
    print(f"{name}: {len(rows)} rows, at most {100 * largest:.2f} % of the peak ({100 * mean:.2f} % in the mean square), "
          f"{end['punch_force_n'] * 1e-3:.2f} kN, draw-in {end['draw_in_x_mm']:.3f} {end['draw_in_y_mm']:.3f} {end['draw_in_diagonal_mm']:.3f} mm")
print(f"scatter at most {100 * worst:.2f} % of the peak force of {peak * 1e-3:.2f} kN")
