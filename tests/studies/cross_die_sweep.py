#!/usr/bin/env python3
"""Random valid cross-die cases: cross_die_sweep.py PROGRAM FOLDER [--cases 60] [--seed 1]

Element size 8, 4 or 2.5 mm (mostly 8), blank holder force 50 to 200 kN, constant friction 0.05 to 0.20, otherwise
prm/cross_die.prm. Every case must end in one of two ways: 58 mm of punch travel, or a neck, recognised as a result with
exit code 0. Writes FOLDER/sweep.csv; a case that is already there is not run again. Exit code 1 if a case ended otherwise.
"""
import argparse
import csv
import pathlib
import random
import resource
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = ["case", "element_size_mm", "holder_force_kn", "friction", "exit_code", "end", "travel_mm", "neck_x_mm", "neck_y_mm",
           "largest_force_kn", "limit_ratio", "least_thickness_mm", "energy_error", "increments", "iterations", "cut_backs", "cpu_s"]


def cases(number, seed):
    numbers = random.Random(seed)
    for case in range(number):
        size = numbers.choices([8, 4, 2.5], weights=[40, 16, 4])[0]
        yield case, size, round(numbers.uniform(50, 200), 1), round(numbers.uniform(0.05, 0.20), 3)


def run(program, folder, case, size, force, friction):
    output = folder / f"case_{case:02}"
    words = [program, str(SOURCE / "prm" / "cross_die.prm"), "--output", str(output), "--quiet"]
    for entry in ["Coupling/Friction = constant", f"Coupling/Constant friction coefficient = {friction}",
                  f"Blank/Element size = {size} mm", f"Process/Blank holder force = {force} kN",
                  "Output/Travel between fields = 100 mm", "Output/Travel between checkpoints = 0 mm"]:
        words += ["--set", entry]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(words, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    row = dict.fromkeys(COLUMNS, "")
    row.update(case=case, element_size_mm=size, holder_force_kn=force, friction=friction, exit_code=done.returncode,
               cpu_s=f"{after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime:.1f}")
    if not (output / "results.csv").exists():
        row["end"] = done.stderr.strip().splitlines()[-1] if done.stderr.strip() else "nothing written"
        return row
    with open(output / "results.csv") as file:
        figures = {r["quantity"]: float(r["value"]) for r in csv.DictReader(file)}
    log = (output / "log.txt").read_text()
    with open(output / "history.csv") as file:
        row["increments"] = sum(1 for _ in file) - 1
    travel, necked = figures["punch_travel"], figures["necked"] > 0
    row.update(end="neck" if necked else "full travel" if abs(travel - 58) < 1e-9 and done.returncode == 0 else "other",
               travel_mm=f"{travel:.2f}", largest_force_kn=f"{1e-3 * figures['largest_punch_force']:.1f}",
               limit_ratio=f"{figures['largest_major_strain_over_its_forming_limit']:.3f}",
               least_thickness_mm=f"{figures['least_thickness_of_an_element']:.3f}",
               energy_error=f"{figures['energy_error']:.4f}", iterations=int(figures["newton_iterations"]),
               cut_backs=log.count("halved"))
    if necked:
        row.update(neck_x_mm=f"{figures['necked_at_x']:.1f}", neck_y_mm=f"{figures['necked_at_y']:.1f}")
    return row


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program")
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("--cases", type=int, default=60)
    arguments.add_argument("--seed", type=int, default=1)
    given = arguments.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    table = given.folder / "sweep.csv"
    rows = list(csv.DictReader(open(table))) if table.exists() else []
    known = {int(r["case"]) for r in rows}
    for case, size, force, friction in cases(given.cases, given.seed):
        if case in known:
            continue
        rows.append(run(given.program, given.folder, case, size, force, friction))
        with open(table, "w", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS)
            writer.writeheader()
            writer.writerows(rows)
        print({k: v for k, v in rows[-1].items() if v != ""}, flush=True)
    ends = [r["end"] for r in rows]
    wrong = [r["case"] for r in rows if r["end"] not in ("full travel", "neck") or int(r["exit_code"]) != 0]
    print(f"{len(rows)} cases: {ends.count('full travel')} to the full travel, {ends.count('neck')} with a neck, {len(wrong)} others {wrong}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
