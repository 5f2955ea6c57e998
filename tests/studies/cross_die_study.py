#!/usr/bin/env python3
"""The paper's cross-die study, with every claim checked as a number: cross_die_study.py PROGRAM FOLDER [--mesh 5]
[--increment 2] [--beyond] [--pictures FOLDER] [--only RUN]

Two lubricants (RP4107S, 32 mPa s, and PLS100T, 90 mPa s) at 0.6, 1.0 and 2.0 g/m2 from prm/cross_die.prm, the same
three amounts with the paper's rule of supply, and runs that differ in numerical settings only (their spread is the
scatter). Prints a table of claims, writes FOLDER/claims.csv and, as in doc/cross_die.md, FOLDER/tables.md; exit code
1 if one fails. --beyond adds what the paper does not have: squeeze term and other decisions of the model, halved
increments, lay of the sheet, surface scatter, a map of speed and viscosity (8 mm elements). --pictures draws figures
there. A run that is there already is not repeated. At 5 mm and 2 mm increments a run takes about 15 CPU s: 4 minutes
for the claims, 8 more with --beyond.
"""
import argparse
import csv
import math
import os
import pathlib
import resource
import subprocess
import sys

import cross_die_study_data as data
import cross_die_study_figures as figures

SOURCE = pathlib.Path(__file__).resolve().parents[2]
AMOUNTS = ["0.6", "1.0", "2.0"]
LUBRICANTS = {"a": "32", "v": "90"}  # RP4107S, PLS100T [mPa s]
WINDOWS = {"0-58 mm": (0, 58), "15-35 mm": (15, 35), "40-57 mm": (40, 57)}
VISCOSITIES, SPEEDS = [10, 32, 90, 270], [10, 30, 90, 270]
SURFACES = [1, 3, 4, 5, 6]
LOOPS, INCREMENTS = ["staggered", "iterated"], [2, 1, 0.5]
DENSITY = 0.896  # g/cm3


def catalogue(given):
    """Settings of each run by name."""
    numerical = {"Blank/Element size": f"{given.mesh:g} mm", "Solver/Largest increment": f"{given.increment:g} mm"}
    runs = {}
    for letter, viscosity in LUBRICANTS.items():
        for amount in AMOUNTS:
            runs[letter + amount] = {**numerical, "Lubricant/Amount": f"{amount} g/m^2", "Lubricant/Viscosity": f"{viscosity} mPa s"}
    for amount in AMOUNTS:
        base = runs["a" + amount]
        runs["paper" + amount] = {**base, "Lubricant/Supply": "paper rule"}
        runs["step" + amount] = {**base, "Solver/Largest increment": f"{0.95 * given.increment:g} mm"}
        runs["first" + amount] = {**base, "Solver/First increment": "0.2 mm"}
    if not given.beyond:
        return runs
    base = runs["a2.0"]
    runs["squeeze2.0"] = {**base, "Lubricant/Supply": "paper rule", "Coupling/Squeeze term": "kept", "Coupling/Film iterations": "20"}
    runs["strain40"] = {**runs["a1.0"], "Process/Punch travel": "40 mm"}
    for kind, stiffness in (("soft", 3650), ("stiff", 14600)):  # half and twice the automatic stiffness of 0.82 mm of steel
        for amount in ("0.6", "2.0"):
            runs[kind + amount] = {**runs["a" + amount], "Solver/Contact stiffness": f"{stiffness} MPa/mm"}
    runs["half"] = {**base, "Process/Punch travel": "35 mm"}
    runs["nominal2.0"] = {**base, "Coupling/Boundary layer pressure": "nominal"}
    runs["follow2.0"] = {**base, "Coupling/Asperities": "follow the table"}
    runs["settled2.0"] = {**base, "Lubricant/Supply": "paper rule", "Coupling/Film iterations": "20"}
    for loop in LOOPS:
        for increment in INCREMENTS:
            runs[f"{loop}{increment}"] = {**base, "Process/Punch travel": "36 mm", "Coupling/Friction loop": loop,
                                          "Solver/Largest increment": f"{increment} mm"}
    lay = "Sheet surface/Generated/Bimodal/Crater correlation length"
    runs["lay_x"] = {**base, lay: "90 um, 22.5 um"}
    runs["lay_y"] = {**base, lay: "22.5 um, 90 um"}
    for seed in SURFACES[1:]:
        runs[f"surface{seed}"] = {**base, "Sheet surface/Generated/Seed": str(seed)}
    for viscosity in VISCOSITIES:
        for speed in SPEEDS:
            runs[f"map{viscosity}_{speed}"] = {**base, "Blank/Element size": "8 mm", "Solver/Largest increment": "2 mm",
                                               "Lubricant/Viscosity": f"{viscosity} mPa s", "Process/Punch speed": f"{speed} mm/s"}
    return runs


def run(program, folder, name, settings):
    if (folder / name / "results.csv").exists():
        return
    words = [program, str(SOURCE / "prm" / "cross_die.prm"), "--output", str(folder / name), "--quiet"]
    fields = "100 mm" if name.startswith("map") else "4 mm"
    for entry, value in {**settings, "Output/Travel between fields": fields, "Output/Travel between checkpoints": "0 mm"}.items():
        words += ["--set", f"{entry} = {value}"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    # Without gnuplot on the path no figures are drawn; `tribodraw report` draws those that are wanted later.
    done = subprocess.run(words, capture_output=True, text=True, env={**os.environ, "PATH": "/nonexistent"})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    print(f"{name}: exit code {done.returncode}, {cpu:.0f} CPU s", flush=True)
    if done.returncode != 0:
        sys.exit(f"{name} failed:\n{done.stderr}")


class Study:
    """All runs that are there, and what is asked of them."""

    def __init__(self, folder):
        self.folder = folder
        self.histories, self.all_steps, self.claims = {}, {}, []

    def history(self, name):
        if name not in self.histories:
            self.histories[name] = data.history(self.folder / name)
        return self.histories[name]

    def steps(self, name):
        if name not in self.all_steps:
            self.all_steps[name] = list(data.steps(self.folder / name))
        return self.all_steps[name]

    def force(self, name, window):
        """Mean punch force [kN]."""
        return 1e-3 * data.mean(self.history(name), "punch_force_n", *WINDOWS[window])

    def scatter(self, window):
        """Largest spread of the mean force among runs that differ in numerical settings only, relative to the mean."""
        spreads = []
        for amount in AMOUNTS:
            forces = [self.force(kind + amount, window) for kind in ("a", "step", "first")]
            spreads.append((max(forces) - min(forces)) / (sum(forces) / len(forces)))
        return max(spreads)

    def margin(self, name):
        """Margin to the forming limit at 58 mm: 1 - largest major strain over its limit."""
        return 1 - data.results(self.folder / name)["largest_major_strain_over_its_forming_limit"]

    def claim(self, text, value, holds):
        self.claims.append((text, value, "note" if holds is None else "pass" if holds else "FAIL"))


def no_pressure_at_least_amount(study):
    for name, oil in (("a0.6", "RP4107S"), ("v0.6", "PLS100T"), ("paper0.6", "RP4107S, paper's rule")):
        largest = max(max(r["max_lubricant_pressure_die_mpa"], r["max_lubricant_pressure_punch_mpa"]) for r in study.history(name))
        study.claim(f"no lubricant pressure at 0.6 g/m2, {oil}", f"largest {largest:g} MPa", largest == 0)


def place_of_the_peak(study):
    """Where the lubricant pressure of the die side is greatest, with the paper's rule and with film transport. The paper's
    contact pressure at the corner of the die rises up to 35 mm; the claim is checked from 24 to 40 mm."""
    rows, parts = [], []
    for name, rule in (("paper2.0", "paper's rule"), ("a2.0", "film transport")):
        drawing = []
        for travel, fields in study.steps(name):
            parts += [(name, f"{travel:.1f}", part, *(f"{x:.3g}" for x in means)) for part, means in means_on_the_radius(fields)]
            touching, pressure = fields.touching(), fields.values["lubricant_pressure_die"]
            if travel < 4 or not touching:
                continue
            tops = {}
            for where in ("anywhere", "radius"):
                nodes = [i for i in touching if where == "anywhere" or fields.zone(i)[0] == where]
                top = max(nodes, key=lambda i: pressure[i])
                tops[where] = (pressure[top], *fields.zone(top))
                rows.append([name, f"{travel:.1f}", where, f"{pressure[top]:.2f}", *fields.zone(top), *(f"{x:.1f}" for x in fields.undeformed[top][:2]),
                             *(f"{x:.1f}" for x in fields.place[top])])
            if 24 <= travel <= 40:
                drawing.append(tops)
        at_fillet = sum(t["radius"][2] == "re-entrant fillet" for t in drawing)
        on_radius = sum(t["anywhere"][1] == "radius" for t in drawing)
        greatest = max((t["radius"] for t in drawing), key=lambda t: t[0])
        study.claim(f"2.0 g/m2, {rule}, 24-40 mm: the peak of the whole die side lies on the die radius", f"{on_radius} of {len(drawing)} steps",
                    on_radius == len(drawing) if name == "paper2.0" else None)
        study.claim(f"2.0 g/m2, {rule}, 24-40 mm: greatest pressure on the die radius at the re-entrant fillet of the die",
                    f"{greatest[0]:.1f} MPa, {greatest[2]}; peak of the radius there in {at_fillet} of {len(drawing)} steps",
                    greatest[2] == "re-entrant fillet")
        last = [r for r in rows if r[0] == name and r[2] == "anywhere" and float(r[1]) > 40]
        study.claim(f"2.0 g/m2, {rule}, beyond 40 mm: place of the peak", "; ".join(sorted({f"{r[4]}, {r[5]}" for r in last})) +
                    f", to {max(float(r[3]) for r in last):.1f} MPa", None)
    with open(study.folder / "peak_pressure.csv", "w", newline="") as stream:
        csv.writer(stream).writerows([("run", "travel_mm", "zone", "pressure_mpa", "height", "part", "x0_mm", "y0_mm", "x_mm", "y_mm", "z_mm"), *rows])
    with open(study.folder / "radius_means.csv", "w", newline="") as stream:
        csv.writer(stream).writerows([("run", "travel_mm", "part", "contact_pressure_mpa", "lubricant_share", "sliding_mm_per_s"), *parts])


def means_on_the_radius(fields):
    """For each part of the die radius: mean contact pressure, share of the load on the lubricant, mean speed of the sheet, over
    its nodes in contact."""
    parts = {}
    for i in fields.touching():
        if fields.zone(i)[0] == "radius":
            parts.setdefault(fields.zone(i)[1], []).append(i)
    for part, nodes in sorted(parts.items()):
        contact = sum(fields.values["contact_pressure_die"][i] for i in nodes)
        lubricant = sum(fields.values["lubricant_pressure_die"][i] for i in nodes)
        speed = sum(math.hypot(*fields.values["velocity"][i]) for i in nodes)
        yield part, (contact / len(nodes), lubricant / contact if contact > 0 else 0., speed / len(nodes))


def forces(study):
    for window in WINDOWS:
        scatter = study.scatter(window)
        f = {name: study.force(name, window) for name in ("a0.6", "a1.0", "a2.0", "v0.6", "v1.0", "v2.0")}
        study.claim(f"scatter of the mean force, {window}", f"{100 * scatter:.2f} %", None)
        study.claim(f"F(0.6), F(1.0), F(2.0), {window}", ", ".join(f"{f['a' + a]:.2f}" for a in AMOUNTS) + " kN", None)
        study.claim(f"F(0.6), F(1.0), F(2.0) with 90 mPa s, {window}", ", ".join(f"{f['v' + a]:.2f}" for a in AMOUNTS) + " kN", None)
        late = window != "15-35 mm"  # before, 1.0 g/m2 is starved everywhere: nothing distinguishes it from 0.6
        fall = {"0.6 > 1.0": 1 - f["a1.0"] / f["a0.6"], "1.0 > 2.0": 1 - f["a2.0"] / f["a1.0"]}
        study.claim(f"F(0.6) > F(1.0) beyond the scatter, {window}", f"{100 * fall['0.6 > 1.0']:.2f} %", fall["0.6 > 1.0"] > scatter if late else None)
        study.claim(f"F(1.0) > F(2.0) beyond the scatter, {window}", f"{100 * fall['1.0 > 2.0']:.2f} %", fall["1.0 > 2.0"] > scatter)
        oil = {a: 1 - f["v" + a] / f["a" + a] for a in AMOUNTS}
        study.claim(f"PLS100T below RP4107S at 2.0 beyond the scatter, {window}", f"{100 * oil['2.0']:.2f} %", oil["2.0"] > scatter)
        study.claim(f"PLS100T below RP4107S at 1.0 beyond the scatter, {window}", f"{100 * oil['1.0']:.2f} %", oil["1.0"] > scatter if late else None)
        study.claim(f"PLS100T equals RP4107S at 0.6 within the scatter, {window}", f"{100 * oil['0.6']:.2f} %", abs(oil["0.6"]) <= scatter)


def flow_factor(study):
    for name, amount in (("a0.6", "0.6"), ("a2.0", "2.0")):
        travel, fields = study.steps(name)[-1]
        phi, touching = fields.values["phi_p_die"], fields.touching()
        means = {}
        for height in ("radius", "flat"):
            nodes = [i for i in touching if fields.zone(i)[0] == height]
            means[height] = sum(phi[i] for i in nodes) / len(nodes)
        study.claim(f"{amount} g/m2: PhiP smaller on the die radius than under the holder, {travel:.0f} mm",
                    f"{means['radius']:.3f} against {means['flat']:.3f}", means["radius"] < means["flat"])


def forming_limit(study):
    margins = {name: study.margin(name) for name in ("a0.6", "a1.0", "a2.0", "v2.0")}
    scatter = max(abs(study.margin(kind + a) - study.margin("a" + a)) for a in AMOUNTS for kind in ("step", "first"))
    study.claim("scatter of the margin to the forming limit", f"{scatter:.4f}", None)
    study.claim("margin to the forming limit larger at 2.0 than at 0.6 g/m2", f"{margins['a2.0']:.3f} against {margins['a0.6']:.3f}",
                margins["a2.0"] > margins["a0.6"] + scatter)
    study.claim("margin at 1.0 g/m2", f"{margins['a1.0']:.3f}", None)
    study.claim("margin at 2.0 g/m2 with PLS100T", f"{margins['v2.0']:.3f}", None)


def regimes_on_the_table(study):
    """Film supplied against the gap of the table, over what the blank reaches: 35 MPa and a strain of 0.65."""
    file = sorted(study.folder.glob("friction_table_*.csv"), key=lambda f: f.stat().st_mtime)[0]
    rows = [{k: float(v) for k, v in row.items()} for row in data.table(file)]
    rows = [r for r in rows if r["p_solid_mpa"] <= 35 and r["eps_p"] <= 0.65]
    low, high = min(r["h_avg_um"] for r in rows), max(r["h_avg_um"] for r in rows)
    film = {a: float(a) / DENSITY for a in AMOUNTS}  # um
    study.claim("table: film of 2.0 g/m2 above every gap", f"{film['2.0']:.3f} against {high:.3f} um", film["2.0"] >= high)
    study.claim("table: film of 0.6 g/m2 below every gap", f"{film['0.6']:.3f} against {low:.3f} um", film["0.6"] < low)
    mixed = [r for r in rows if r["h_avg_um"] <= film["1.0"]]
    study.claim("table: 1.0 g/m2 mixed at high pressure and strain only",
                f"{len(mixed)} of {len(rows)} points, all above {min((r['p_solid_mpa'] for r in mixed), default=0):g} MPa and strain "
                f"{min((r['eps_p'] for r in mixed), default=0):g}", 0 < len(mixed) < 0.2 * len(rows))


def regimes_on_the_blank(study):
    for name, amount, rule in [(kind + a, a, rule) for kind, rule in (("paper", "paper's rule"), ("a", "film transport")) for a in AMOUNTS]:
        # What the tools leave behind piles up on the outermost nodes, which have no pressure: they are counted apart.
        share, at_edge, strain, pressure, first = [], 0, {}, {}, None
        for travel, fields in study.steps(name):
            touching = fields.touching()
            if travel < 4 or not touching:
                continue
            regime = fields.values["lubrication_regime_die"]
            wet = [i for i in touching if regime[i] > 1.5]
            if amount == "0.6":
                at_edge = max(at_edge, sum(fields.on_outer_edge(i) for i in wet))
                wet = [i for i in wet if not fields.on_outer_edge(i)]
            share.append((travel, len(wet) / len(touching)))
            if wet and first is None:
                first = travel
            for kind, nodes in (("wet", wet), ("starved", [i for i in touching if regime[i] < 1.5])):
                strain.setdefault(kind, []).extend(fields.eps_p[i] for i in nodes)
                pressure.setdefault(kind, []).extend(fields.values["contact_pressure_die"][i] for i in nodes)
        text = f"blank, {amount} g/m2, {rule}: "
        least, last = min(s for _, s in share), share[-1][1]
        if amount == "2.0":
            whole = max([t for t, _ in share if all(s == 1 for u, s in share if u <= t)], default=0)
            study.claim(text + "nodes in contact that are mixed or lifted", f"all to {whole:.0f} mm, at least {least:.2f}, {last:.2f} at 58 mm",
                        least == 1 if rule == "paper's rule" else None)
        elif amount == "0.6":
            study.claim(text + "mixed nowhere inside the outer edge", f"largest share {max(s for _, s in share):g}; {at_edge} full nodes without pressure "
                        "on the edge", max(s for _, s in share) == 0)
        elif strain["wet"]:
            average = {k: (sum(pressure[k]) / len(pressure[k]), sum(strain[k]) / len(strain[k])) for k in ("wet", "starved")}
            study.claim(text + "mixed only where pressure and strain are high", f"from {first:.0f} mm, {last:.2f} at 58 mm; mean " + ", ".join(
                f"{average[k][0]:.1f} MPa and strain {average[k][1]:.2f} {k}" for k in average), last < 0.5 and
                average["wet"][0] > average["starved"][0] and average["wet"][1] > average["starved"][1])
        else:
            study.claim(text + "mixed only where pressure and strain are high", "mixed nowhere", False)


def balance(study, names):
    largest = max(max(r["lubricant_volume_error"] for r in study.history(name)) for name in names)
    study.claim("lubricant volume, largest error in any increment of any run", f"{largest:.1e}", largest < 1e-10)


def beyond(study):
    for kind, text in (("soft", "half"), ("stiff", "twice")):
        study.claim(f"fall of the mean force from 0.6 to 2.0 g/m2 with {text} the contact stiffness, " + ", ".join(WINDOWS), ", ".join(
            f"{100 * (1 - study.force(kind + '2.0', w) / study.force(kind + '0.6', w)):.1f}" for w in WINDOWS) + " % (automatic " + ", ".join(
            f"{100 * (1 - study.force('a2.0', w) / study.force('a0.6', w)):.1f}" for w in WINDOWS) + " %)", None)
    for loop in LOOPS:
        study.claim(f"2.0 g/m2, {loop} friction: mean force 15-35 mm with increments of " + ", ".join(f"{i:g}" for i in INCREMENTS) + " mm", ", ".join(
            f"{study.force(f'{loop}{i}', '15-35 mm'):.2f}" for i in INCREMENTS) + " kN", None)
    for name, text in (("a2.0", "film transport"), ("nominal2.0", "nominal pressure in the boundary layer"), ("follow2.0", "asperities follow the table"),
                       ("paper2.0", "paper's rule"), ("settled2.0", "paper's rule, film and flattening iterated"), ("squeeze2.0", "paper's rule with squeeze"), ("lay_x", "lay along the rolling direction"),
                       ("lay_y", "lay across it"), ("soft2.0", "half the contact stiffness"),
                       ("stiff2.0", "twice the contact stiffness"), *((f"surface{s}", f"surface {s}") for s in SURFACES[1:])):
        if (study.folder / name / "results.csv").exists():
            study.claim(f"2.0 g/m2, {text}: mean force " + ", ".join(WINDOWS), ", ".join(f"{study.force(name, w):.2f}" for w in WINDOWS) + " kN; 25-35 mm "
                        f"{1e-3 * data.mean(study.history(name), 'punch_force_n', 25, 35):.2f} kN; draw-in x, y "
                        f"{study.history(name)[-1]['draw_in_x_mm']:.2f}, {study.history(name)[-1]['draw_in_y_mm']:.2f} mm; margin {study.margin(name):.3f}", None)


def write_tables(study, file):
    """The tables of doc/cross_die.md."""
    lines = ["| | mean force 0-58 mm | 15-35 mm | 40-57 mm | friction, die side, 5-25, 25-40, 40-57 mm | greatest lubricant pressure, die side "
             "| starved share of the contact at 58 mm | margin to the forming limit |", "|---" * 8 + "|"]
    for name, text in [(letter + a, f"{a} g/m², {viscosity} mPa s") for a in AMOUNTS for letter, viscosity in LUBRICANTS.items()] + [
            ("paper" + a, f"{a} g/m², 32 mPa s, `Supply = paper rule`") for a in AMOUNTS]:
        rows = study.history(name)
        friction = ", ".join(f"{data.mean(rows, 'mean_mu_die', *window):.3f}" for window in ((5, 25), (25, 40), (40, 57)))
        lines.append(f"| {text} | " + " | ".join(f"{study.force(name, w):.1f} kN" for w in WINDOWS) + f" | {friction} | "
                     f"{max(r['max_lubricant_pressure_die_mpa'] for r in rows):.0f} MPa | {rows[-1]['starved_area_fraction']:.2f} | {study.margin(name):.3f} |")
    lines += ["", "| Claim | Number | |", "|---|---|---|"]
    lines += [f"| {text} | {value} | {'holds' if verdict == 'pass' else '' if verdict == 'note' else verdict} |".replace("g/m2", "g/m²")
              for text, value, verdict in study.claims]
    file.write_text("\n".join(lines) + "\n")


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("program")
    arguments.add_argument("folder", type=pathlib.Path)
    arguments.add_argument("--mesh", type=float, default=5, help="element size [mm]")
    arguments.add_argument("--increment", type=float, default=2, help="largest increment of punch travel [mm]")
    arguments.add_argument("--beyond", action="store_true", help="also the runs beyond the paper")
    arguments.add_argument("--only", action="append", help="do these runs and stop")
    arguments.add_argument("--pictures", type=pathlib.Path, help="draw the figures of the documentation there")
    given = arguments.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    runs = catalogue(given)
    for name in given.only or runs:
        run(given.program, given.folder, name, runs[name])
    if given.only:
        return
    study = Study(given.folder)
    regimes_on_the_table(study)
    regimes_on_the_blank(study)
    no_pressure_at_least_amount(study)
    place_of_the_peak(study)
    forces(study)
    flow_factor(study)
    forming_limit(study)
    balance(study, runs)
    if given.beyond:
        beyond(study)
    width = max(len(text) for text, _, _ in study.claims)
    for text, value, verdict in study.claims:
        print(f"{verdict}  {text:{width}}  {value}")
    with open(given.folder / "claims.csv", "w", newline="") as stream:
        csv.writer(stream).writerows([("claim", "value", "verdict"), *study.claims])
    write_tables(study, given.folder / "tables.md")
    failed = sum(verdict == "FAIL" for _, _, verdict in study.claims)
    print(f"{sum(v == 'pass' for _, _, v in study.claims)} claims hold, {failed} fail")
    if given.pictures:
        figures.draw(given.program, study, given.pictures, given.beyond)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
