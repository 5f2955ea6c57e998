#!/usr/bin/env python3
"""Convergence and sensitivity of the square cup: square_cup_study.py PROGRAM FOLDER [--only NAME ...] [--finest]

Runs prm/square_cup.prm as it is, without its fine zones (the reference), and that with one change at a time: element size,
increments, contact (stiffness, thickness, elastic slip), thickness points, friction, yield locus and its reference direction. Writes FOLDER/study.csv and FOLDER/study.md with
punch force, draw-in, work and friction work; a case that is already there is not run again. About 30 CPU s a case;
`--finest` adds elements of half the size, about 4 minutes. Exit code 1 if a case does not reach 40 mm, or if halving the elements or the
increments moves the largest punch force by more than 3 % or 2 %.
"""
import argparse
import csv
import pathlib
import resource
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
STIFFNESS = 7550  # MPa/mm: what the automatic one starts with here, E / (1 - nu) / 2000 over 2.5 % of the thickness
MISES = ["Sheet material/Yield locus = von Mises"]
HILL = "Sheet material/Hill 1948/"
HOLDER = "Tools/Blank holder/"
AVERAGE = [HILL + "R0 = 1.77", HILL + "R45 = 1.77", HILL + "R90 = 1.77"]
# Stresses at 0, 45, 90 degrees and equibiaxial over that at 0 degrees, and the equibiaxial strain ratio: those of a DC04
# (prm/cross_die.prm); the R-values are the benchmark's.
YLD = "Sheet material/Yld2000-2d/"
YLD2000 = ["Sheet material/Yield locus = Yld2000-2d", YLD + "Exponent = 6", YLD + "Coefficients = fitted",
           YLD + "Yield stresses = 1, 1.031, 0.9885, 1.132", YLD + "R values = 1.79, 1.51, 2.27, 0.8988"]

UNIFORM = ["Blank/Fine zones = 0 mm", "Blank/Fine zone sizes = 0 mm"]

REFERENCE = "reference: elements of 2.0833 mm"
AS_SHIPPED = "square_cup.prm: 1.04 mm at the middle of the sides"
CASES = {
    AS_SHIPPED: [],
    REFERENCE: [],
    "elements of 3.125 mm": ["Blank/Element size = 3.125 mm"],
    "elements of 1.5 mm": ["Blank/Element size = 1.5 mm"],
    "increments of 0.5 mm": ["Solver/Largest increment = 0.5 mm"],
    "contact stiffness / 3": [f"Solver/Contact stiffness = {STIFFNESS / 3:.0f} MPa/mm"],
    "contact stiffness x 3": [f"Solver/Contact stiffness = {STIFFNESS * 3:.0f} MPa/mm"],
    "contact with the initial thickness": ["Solver/Contact thickness = initial"],
    "elastic slip of 0.003 mm": ["Solver/Elastic slip = 0.003 mm"],
    "blank holder flat up to 39.1 mm": [HOLDER + "Model = square die"] + [HOLDER + "Square die/" + entry for entry in (
        "Width in x = 74 mm", "Width in y = 74 mm", "Corner radius = 12 mm", "Clearance = 0 mm", "Edge radius = 2.1 mm")],
    "9 thickness points": ["Blank/Thickness points = 9"],
    "friction 0.16": ["Coupling/Constant friction coefficient = 0.16"],
    "R0 and R90 exchanged": [HILL + "R0 = 2.27", HILL + "R90 = 1.79"],
    "R = 1.77 in all directions": AVERAGE,
    "von Mises": MISES,
    "von Mises, initial thickness": MISES + ["Solver/Contact thickness = initial"],
    "Yld2000-2d, stresses of DC04": YLD2000,
}
FINEST = "elements of 1.0417 mm"

COLUMNS = ["case", "force_15_kn", "force_30_kn", "force_40_kn", "largest_force_kn", "draw_in_x_15_mm", "draw_in_y_15_mm",
           "draw_in_diagonal_15_mm", "draw_in_x_40_mm", "draw_in_y_40_mm", "draw_in_diagonal_40_mm", "work_j", "friction_work_j",
           "penetration_mm", "energy_error", "increments", "iterations", "cpu_s"]


def at(rows, column, travel):
    """Linear in punch travel."""
    for a, b in zip(rows, rows[1:]):
        low, high = float(a["punch_travel_mm"]), float(b["punch_travel_mm"])
        if low <= travel <= high and high > low:
            weight = (travel - low) / (high - low)
            return (1 - weight) * float(a[column]) + weight * float(b[column])
    return float("nan")


def read(file):
    with open(file) as stream:
        return list(csv.DictReader(stream))


def run(program, folder, name, settings):
    output = folder / "".join(c if c.isalnum() else "_" for c in name)
    words = [program, str(SOURCE / "prm" / "square_cup.prm"), "--output", str(output), "--quiet"]
    for entry in (UNIFORM if name != AS_SHIPPED else []) + settings + ["Output/Travel between fields = 100 mm", "Output/Travel between checkpoints = 0 mm"]:
        words += ["--set", entry]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(words, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        print(done.stderr, file=sys.stderr)
        return None
    return figures(name, output, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def figures(name, output, cpu):
    history, energy = read(output / "history.csv"), read(output / "energy.csv")
    row = {"case": name, "work_j": f"{float(energy[-1]['external_work_j']):.0f}",
           "friction_work_j": f"{float(energy[-1]['friction_work_j']):.0f}",
           "penetration_mm": f"{max(float(r['max_penetration_mm']) for r in energy):.3f}",
           "energy_error": f"{float(energy[-1]['energy_error']):.4f}",
           "largest_force_kn": f"{1e-3 * max(float(r['punch_force_n']) for r in history):.2f}",
           "increments": len(history), "iterations": sum(int(r["newton_iterations"]) for r in history),
           "cpu_s": f"{cpu:.0f}"}
    for travel in (15, 30, 40):
        row[f"force_{travel}_kn"] = f"{1e-3 * at(history, 'punch_force_n', travel - 1e-9):.2f}"
    for travel in (15, 40):
        for which in ("x", "y", "diagonal"):
            row[f"draw_in_{which}_{travel}_mm"] = f"{at(history, f'draw_in_{which}_mm', travel - 1e-9):.2f}"
    return row


def write(folder, rows):
    with open(folder / "study.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    lines = ["| run | force at 15 / 30 / 40 mm, largest [kN] | draw-in x, y, diagonal at 15 mm | at 40 mm [mm] | work, friction work [J] | penetration [mm] |",
             "|---|---|---|---|---|---|"]
    for r in rows:
        draw = [", ".join(r[f"draw_in_{which}_{travel}_mm"] for which in ("x", "y", "diagonal")) for travel in (15, 40)]
        lines.append(f"| {r['case']} | {r['force_15_kn']} / {r['force_30_kn']} / {r['force_40_kn']}, {r['largest_force_kn']} "
                     f"| {draw[0]} | {draw[1]} | {r['work_j']}, {r['friction_work_j']} | {r['penetration_mm']} |")
    (folder / "study.md").write_text("\n".join(lines) + "\n")


def change(rows, name):
    force = {r["case"]: float(r["largest_force_kn"]) for r in rows}
    return abs(force[name] / force[REFERENCE] - 1) if name in force and REFERENCE in force else None


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program")
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("--only", nargs="*", metavar="NAME", help="cases whose name contains one of these words")
    arguments.add_argument("--finest", action="store_true")
    given = arguments.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    cases = dict(CASES)
    if given.finest:
        cases[FINEST] = ["Blank/Element size = 1.0416667 mm"]
    chosen = {name: settings for name, settings in cases.items() if not given.only or any(word in name for word in given.only)}
    if not chosen:
        arguments.error(f"no case has {given.only} in its name; cases: {'; '.join(cases)}")
    table = given.folder / "study.csv"
    rows = read(table) if table.exists() else []
    known, failed = {r["case"] for r in rows}, []
    for name, settings in chosen.items():
        if name in known:
            continue
        row = run(given.program, given.folder, name, settings)
        if row is None:
            failed.append(name)
            continue
        rows.append(row)
        rows.sort(key=lambda r: list(CASES).index(r["case"]) if r["case"] in CASES else len(CASES))
        write(given.folder, rows)
        print(row, flush=True)
    print((given.folder / "study.md").read_text())
    for name, allowed in ((FINEST, 0.03), ("increments of 0.5 mm", 0.02)):
        moved = change(rows, name)
        if moved is not None:
            print(f"{name}: largest punch force moves by {100 * moved:.2f} % (allowed {100 * allowed:.0f} %)")
            if moved > allowed:
                failed.append(name)
    if failed:
        print("failed:", ", ".join(failed))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
