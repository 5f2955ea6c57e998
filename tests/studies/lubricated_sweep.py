#!/usr/bin/env python3
"""Random valid lubricated cross-die cases: lubricated_sweep.py PROGRAM FOLDER [--cases 200] [--seed 1] [--jobs 1] [--only N]

Amount 0.3 to 3.5 g/m2, viscosity 10 to 300 mPa s, punch speed 10 to 200 mm/s, blank holder force 50 to 200 kN, thickness
0.6 to 1.1 mm, one of eight surfaces, one of both rules of supply (four of five: film transport), otherwise
prm/cross_die.prm with 8 mm elements and increments of 2 mm. Every case must reach 58 mm of punch travel or end with a
neck, recognised as a result with exit code 0, and the lubricant must be conserved to 1e-10 of its volume in every
increment (film transport). Writes FOLDER/sweep.csv; a case that is already there is not run again. The folder of a case
that ended otherwise is kept for its diagnosis. Exit code 1 if more than 1 % of the cases failed or a balance did.
About 10 CPU s a case and one friction table (10 CPU s) a surface.
"""
import argparse
import concurrent.futures
import csv
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
DRAWN = ["amount_g_m2", "viscosity_mpas", "speed_mm_s", "holder_force_kn", "thickness_mm", "surface_seed", "supply"]
COLUMNS = ["case", *DRAWN, "exit_code", "end", "travel_mm", "largest_force_kn", "mean_friction_die", "largest_lubricant_pressure_mpa",
           "starved_at_end", "volume_error", "limit_ratio", "energy_error", "increments", "iterations", "halved", "cpu_s"]
LARGEST_VOLUME_ERROR = 1e-10
LARGEST_SHARE_OF_FAILURES = 0.01


def log_uniform(numbers, low, high):
    return low * (high / low) ** numbers.random()


def cases(number, seed):
    numbers = random.Random(seed)
    for case in range(number):
        yield {"case": case,
               "amount_g_m2": round(numbers.uniform(0.3, 3.5), 2),
               "viscosity_mpas": round(log_uniform(numbers, 10, 300), 1),
               "speed_mm_s": round(log_uniform(numbers, 10, 200), 1),
               "holder_force_kn": round(numbers.uniform(50, 200), 1),
               "thickness_mm": round(numbers.uniform(0.6, 1.1), 3),
               "surface_seed": numbers.randint(1, 8),
               "supply": numbers.choices(["film transport", "paper rule"], weights=[4, 1])[0]}


def command(program, output, drawn):
    words = [program, str(SOURCE / "prm" / "cross_die.prm"), "--output", str(output), "--quiet"]
    for entry in [f"Lubricant/Amount = {drawn['amount_g_m2']} g/m^2", f"Lubricant/Viscosity = {drawn['viscosity_mpas']} mPa s",
                  f"Process/Punch speed = {drawn['speed_mm_s']} mm/s", f"Process/Blank holder force = {drawn['holder_force_kn']} kN",
                  f"Blank/Thickness = {drawn['thickness_mm']} mm", f"Forming limit/Abspoel-Scholting/Thickness = {drawn['thickness_mm']} mm",
                  f"Sheet surface/Generated/Seed = {drawn['surface_seed']}", f"Lubricant/Supply = {drawn['supply']}",
                  "Blank/Element size = 8 mm", "Solver/Largest increment = 2 mm",
                  "Output/Travel between fields = 100 mm", "Output/Travel between checkpoints = 0 mm"]:
        words += ["--set", entry]
    return words


def run(program, folder, drawn):
    output = folder / f"case_{drawn['case']:03}"
    # Without gnuplot on the path no figures are drawn; they would take longer than the drawing.
    with tempfile.TemporaryFile("w+") as errors:
        child = subprocess.Popen(command(program, output, drawn), stdout=subprocess.DEVNULL, stderr=errors,
                                 env={**os.environ, "PATH": "/nonexistent"})
        _, status, usage = os.wait4(child.pid, 0)  # the time of this case alone, whatever runs beside it
        child.returncode = os.waitstatus_to_exitcode(status)
        errors.seek(0)
        complaint = errors.read().strip()
    row = dict.fromkeys(COLUMNS, "")
    row.update(drawn, exit_code=child.returncode, cpu_s=f"{usage.ru_utime + usage.ru_stime:.1f}")
    if not (output / "results.csv").exists():
        row["end"] = complaint.splitlines()[-1] if complaint else "nothing written"
        return row
    with open(output / "results.csv") as file:
        figures = {r["quantity"]: float(r["value"]) for r in csv.DictReader(file)}
    with open(output / "history.csv") as file:
        history = [{k: float(v) for k, v in r.items()} for r in csv.DictReader(file)]
    travel, necked = figures["punch_travel"], figures["necked"] > 0
    row.update(end="neck" if necked else "full travel" if abs(travel - 58) < 1e-9 and child.returncode == 0 else "other",
               travel_mm=f"{travel:.2f}", largest_force_kn=f"{1e-3 * figures['largest_punch_force']:.1f}",
               mean_friction_die=f"{sum(r['mean_mu_die'] for r in history) / len(history):.4f}",
               largest_lubricant_pressure_mpa=f"{max(r['max_lubricant_pressure_die_mpa'] for r in history):.2f}",
               starved_at_end=f"{history[-1]['starved_area_fraction']:.3f}",
               volume_error=f"{max(r['lubricant_volume_error'] for r in history):.1e}",
               limit_ratio=f"{figures['largest_major_strain_over_its_forming_limit']:.3f}", energy_error=f"{figures['energy_error']:.4f}",
               increments=len(history), iterations=int(figures["newton_iterations"]),
               halved=(output / "log.txt").read_text().count("halved"))
    if good(row):
        shutil.rmtree(output)
    return row


def good(row):
    return row["end"] in ("full travel", "neck") and int(row["exit_code"]) == 0


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program")
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("--cases", type=int, default=200)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--jobs", type=int, default=1, help="cases side by side")
    arguments.add_argument("--only", type=int, action="append", help="print the command of this case and run it, with all output")
    given = arguments.parse_args()
    if given.only:
        for drawn in cases(given.cases, given.seed):
            if drawn["case"] in given.only:
                words = command(given.program, given.folder / f"case_{drawn['case']:03}", drawn)
                print(" ".join(f"'{w}'" if " " in w else w for w in words), flush=True)
                subprocess.run(words, check=False)
        return
    given.folder.mkdir(parents=True, exist_ok=True)
    table = given.folder / "sweep.csv"
    rows = list(csv.DictReader(open(table))) if table.exists() else []
    known = {int(r["case"]) for r in rows}
    missing = [drawn for drawn in cases(given.cases, given.seed) if drawn["case"] not in known]
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        running = [pool.submit(run, given.program, given.folder, drawn) for drawn in missing]
        for done in concurrent.futures.as_completed(running):
            print({k: v for k, v in done.result().items() if v != ""}, flush=True)
            rows.append(done.result())
            rows.sort(key=lambda row: int(row["case"]))
            with open(table, "w", newline="") as file:
                writer = csv.DictWriter(file, COLUMNS)
                writer.writeheader()
                writer.writerows(rows)
    report(rows)


def report(rows):
    ends = [r["end"] for r in rows]
    wrong = [r for r in rows if not good(r)]
    errors = [float(r["volume_error"]) for r in rows if r["volume_error"] != ""]
    lost = [r["case"] for r in rows if r["volume_error"] != "" and float(r["volume_error"]) > LARGEST_VOLUME_ERROR]
    print(f"{len(rows)} cases: {ends.count('full travel')} to the full travel, {ends.count('neck')} with a neck, {len(wrong)} others")
    for row in wrong:
        print(f"  case {row['case']}: exit code {row['exit_code']}, {row['end']}, travel {row['travel_mm']} mm")
    print(f"greatest error of the lubricant volume {max(errors, default=0.):.1e} of the total (limit {LARGEST_VOLUME_ERROR:.0e}), above it: {lost}")
    sys.exit(1 if lost or len(wrong) > LARGEST_SHARE_OF_FAILURES * len(rows) else 0)


if __name__ == "__main__":
    main()
