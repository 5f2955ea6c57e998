"""Figures of the cross-die study: maps by `tribodraw report`, all that compares runs by gnuplot."""
import shutil
import subprocess

import cross_die_study_data as data

TERMINAL = "set terminal pngcairo size {} fontscale 1.5 linewidth 2\nset output '{}'\nset datafile separator ','\nset grid\n"
# Okabe and Ito: told apart by the colour-blind.
COLOURS = ["#0080c8", "#d55e00", "#009e73", "#cc79a7", "#e69f00"]

# Maps of a run that the documentation shows: run, figure of `tribodraw report`, name there.
MAPS = [("a0.6", "friction_coefficient_die", "friction_0.6"), ("a2.0", "friction_coefficient_die", "friction_2.0"),
        ("a2.0", "lubricant_pressure_die", "lubricant_pressure_2.0"), ("a2.0", "phi_p_die_blank", "phi_p_2.0"),
        ("a0.6", "phi_p_die_blank", "phi_p_0.6"), ("a1.0", "friction_coefficient_die", "friction_1.0"),
        ("a1.0", "major_strain_blank", "major_strain_58mm"), ("a1.0", "minor_strain_blank", "minor_strain_58mm"),
        ("strain40", "major_strain_blank", "major_strain_40mm"), ("strain40", "minor_strain_blank", "minor_strain_40mm"),
        ("half", "friction_coefficient_die", "friction_coefficient_die_35mm"), ("half", "lubricant_pressure_die", "lubricant_pressure_die_35mm"),
        ("a2.0", "thickness", "thickness")]


def gnuplot(script):
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


def force_curve(study, name):
    return f"'{study.folder / name}/history.csv' using 2:($3/1000) skip 1"


def force_chart(study, file, title, curves, extra=""):
    """@p curves: run, colour, dash, key."""
    lines = [f"{force_curve(study, name)} with lines lc rgb '{COLOURS[colour]}' dt {dash} title '{key}'" for name, colour, dash, key in curves]
    gnuplot(TERMINAL.format("1100,800", file) + f"set title '{title}'\nset xlabel 'Punch travel / mm'\nset ylabel 'Punch force / kN'\n"
            f"set key bottom right\n{extra}plot [0:58][0:*] " + ", ".join(lines) + "\n")


def limit_diagram(study, file, title, clouds):
    lines = [f"'{study.folder / name}/elements_final.csv' using (column('minor_strain')):(column('major_strain')) with points pt 7 ps 0.5 "
             f"lc rgb '{COLOURS[colour]}' title '{key}'" for name, colour, key in clouds]
    lines.append(f"'{study.folder / clouds[0][0]}/flc.csv' using 1:2 skip 1 with lines lc rgb 'black' title 'limit (Abspoel-Scholting)'")
    gnuplot(TERMINAL.format("1100,800", file) + f"set title '{title}'\nset xlabel 'Minor logarithmic strain'\nset ylabel 'Major logarithmic strain'\n"
            "set key top right\nplot [-0.75:0.3][0:0.8] " + ", ".join(lines) + "\n")


def relative_to(study, file, title, base, curves, key_place="bottom left"):
    """Force of runs relative to that of @p base over travel."""
    blocks, lines = "", []
    for k, (name, colour, key) in enumerate(curves):
        rows = "\n".join(f"{t},{100 * (force_at(study, name, t) / force_at(study, base, t) - 1)}" for t in range(8, 58))
        blocks += f"$d{k} << EOD\n{rows}\nEOD\n"
        lines.append(f"$d{k} using 1:2 with lines lc rgb '{COLOURS[colour]}' title '{key}'")
    gnuplot(TERMINAL.format("1100,700", file) + blocks + f"set title '{title}'\nset xlabel 'Punch travel / mm'\nset ylabel 'Change of the punch force / %'\n"
            f"set key {key_place}\n" "set object rectangle from 25, graph 0 to 35, graph 1 behind fc rgb '#eeeeee' fs noborder\n"
            "plot [0:58] 0 with lines lc rgb 'black' lw 0.5 notitle, " + ", ".join(lines) + "\n")


def force_at(study, name, travel):
    """Punch force, mean over 2 mm of travel so that single increments do not show [N]."""
    return data.mean(study.history(name), "punch_force_n", travel - 1, min(58, travel + 1))


def band(study, file, names):
    rows = []
    for travel in range(2, 58):
        forces = [1e-3 * force_at(study, name, travel) for name in names]
        rows.append(f"{travel},{min(forces)},{max(forces)},{sum(forces) / len(forces)}")
    gnuplot(TERMINAL.format("1100,800", file) + "$band << EOD\n" + "\n".join(rows) + "\nEOD\n"
            f"set title '{len(names)} generated maps of the same surface, 2.0 g/m^2'\nset xlabel 'Punch travel / mm'\nset ylabel 'Punch force / kN'\n"
            f"set key bottom right\nplot [0:58][0:*] $band using 1:2:3 with filledcurves lc rgb '#9fd0ee' title 'least to greatest', "
            f"$band using 1:4 with lines lc rgb '{COLOURS[0]}' title 'mean', " +
            f"{force_curve(study, 'a0.6')} with lines lc rgb '{COLOURS[1]}' title '0.6 g/m^2, first map'\n")


def map_of_speed_and_viscosity(study, file, viscosities, speeds):
    rows = "\n".join(",".join(f"{1e-3 * data.mean(study.history(f'map{v}_{s}'), 'punch_force_n', 15, 57):.2f}" for s in speeds) for v in viscosities)
    ticks = lambda values: "(" + ", ".join(f"'{v}' {k}" for k, v in enumerate(values)) + ")"
    products = "\n".join(f"{v * s},{1e-3 * data.mean(study.history(f'map{v}_{s}'), 'punch_force_n', 15, 57)},{k}"
                         for v in viscosities for k, s in enumerate(speeds))
    curves = ", ".join(f"$product using ($3=={k} ? $1 : NaN):2 with points pt {5 + k} ps 1.5 lc rgb '{COLOURS[k]}' title '{s} mm/s'" for k, s in enumerate(speeds))
    gnuplot(TERMINAL.format("1500,660", file) + f"$map << EOD\n{rows}\nEOD\n$product << EOD\n{products}\nEOD\nset multiplot layout 1,2\nunset grid\n"
            "set title 'Mean punch force, 15-57 mm / kN'\nset xlabel 'Punch speed / mm/s'\nset ylabel 'Viscosity / mPa s'\n"
            f"set xtics {ticks(speeds)}\nset ytics {ticks(viscosities)}\nset palette defined (0 '#440154', 1 '#21918c', 2 '#fde725')\n"
            "plot [-0.5:3.5][-0.5:3.5] $map matrix with image notitle, $map matrix using 1:2:(sprintf('%.1f', $3)) with labels tc rgb 'white' notitle\n"
            "unset xtics\nunset ytics\nset xtics auto\nset ytics auto\nset grid\nset logscale x\nset format x '10^{%T}'\nset title 'The same over viscosity times speed'\n"
            f"set xlabel 'Viscosity x speed / mPa s mm/s'\nset ylabel 'Mean punch force / kN'\nset key top right\nplot [60:130000] {curves}\nunset multiplot\n")


def draw(program, study, folder, beyond):
    folder.mkdir(parents=True, exist_ok=True)
    names = {"a": "32 mPa s", "v": "90 mPa s"}
    force_chart(study, folder / "punch_force.png", "Cross die, DC04 0.82 mm, holder 100 kN",
                [(letter + amount, k, dash, f"{amount} g/m^2, {names[letter]}") for letter, dash in (("a", 1), ("v", 2)) for k, amount in enumerate(("0.6", "1.0", "2.0"))])
    limit_diagram(study, folder / "fld.png", "32 mPa s, 58 mm", [("a0.6", 1, "0.6 g/m^2"), ("a2.0", 0, "2.0 g/m^2")])
    limit_diagram(study, folder / "fld_lubricants.png", "2.0 g/m^2, 58 mm", [("a2.0", 0, "32 mPa s"), ("v2.0", 3, "90 mPa s")])
    relative_to(study, folder / "amount.png", "Change against 0.6 g/m^2", "a0.6",
                [("a1.0", 1, "1.0 g/m^2, 32 mPa s"), ("v1.0", 3, "1.0 g/m^2, 90 mPa s"), ("step0.6", 4, "0.6 g/m^2 with 5 % shorter increments")])
    if beyond:
        relative_to(study, folder / "squeeze.png", "2.0 g/m^2, against the rule of the paper without squeeze", "paper2.0",
                    [("squeeze2.0", 1, "squeeze term kept"), ("a2.0", 0, "film transport")], "top right")
        relative_to(study, folder / "lay.png", "2.0 g/m^2, against the surface without lay", "a2.0",
                    [("lay_x", 0, "lay along the rolling direction"), ("lay_y", 1, "lay across it"), ("step2.0", 4, "no lay, 5 % shorter increments")])
        band(study, folder / "surface_band.png", ["a2.0", *sorted(f.name for f in study.folder.glob("surface*") if f.is_dir())])
        map_of_speed_and_viscosity(study, folder / "speed_viscosity.png", [10, 32, 90, 270], [10, 30, 90, 270])
    for run in dict.fromkeys(m[0] for m in MAPS):
        if (study.folder / run / "results.csv").exists() and not (study.folder / run / "thickness.png").exists():
            subprocess.run([program, "report", str(study.folder / run)], check=True, capture_output=True)
    for run, figure, name in MAPS:
        source = study.folder / run / f"{figure}.png"
        if source.exists():
            shutil.copy(source, folder / f"{name}.png")
