"""The program as a user meets it: command_line.py PROGRAM SOURCE_FOLDER MPIEXEC"""
import csv
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.dom.minidom

PROGRAM = SOURCE = MPIEXEC = None
# Sizes that make a run take a second; the physics is tested in the modules.
SMALL = ["--set", "Sheet surface/Generated/Pixels = 64", "--set", "Sheet surface/Generated/Pixel size = 6 um"]


class InFolder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="tribodraw-command-line-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_program(self, *arguments, code=0, launcher=(), environment=None):
        result = subprocess.run([*launcher, PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                                timeout=300, env={**os.environ, **(environment or {})})
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result

    def prm(self, name):
        return SOURCE / "prm" / (name + ".prm")

    def rows(self, path):
        with open(self.folder / path, newline="") as file:
            return list(csv.DictReader(file))


class Options(InFolder):
    def test_help_names_all_options_verbs_and_exit_codes(self):
        text = self.run_program("--help").stdout
        for word in ["--output", "--set", "--resume", "--validate", "--quiet", "--help", "--version", "init", "explain", "list",
                     "parameters", "export", "--format", "report", "compare MEASURED DIR", "--columns", "doctor", "output/NAME"]:
            self.assertIn(word, text)

    def test_version(self):
        text = self.run_program("--version").stdout
        for name in ["tribodraw", "deal.II", "Trilinos", "MUMPS", "Eigen", "MPI"]:
            self.assertRegex(text, rf"(?m)^{name} \D*\d+\.\d+")

    def test_wrong_command_lines(self):
        cases = {("--outptu", "x", "a.prm"): "Did you mean '--output'?", ("--validat", "a.prm"): "Did you mean '--validate'?",
                 (): "No parameter file", ("lst",): "Did you mean 'list'?", ("a.prm", "b.prm"): "a.prm",
                 ("a.prm",): "a.prm", ("--output",): "needs a value", ("--quiet=yes", "a.prm"): "takes no value",
                 ("explain",): "tribodraw explain", ("list", "--resume"): "no effect", ("init", "surfce"): "Did you mean 'surface'?",
                 ("explain", "Task/Nothing"): "Task/Nothing", ("report", "nowhere"): "nowhere",
                 ("export", "nowhere.json", "--format", "csv"): "nowhere.json", ("export", "nowhere.json"): "--format",
                 ("export", "x.json", "--format", "abacus"): "Did you mean 'abaqus'?",
                 ("list", "--format", "csv"): "no effect", ("a.prm", "--strain", "1"): "no effect"}
        for arguments, expected in cases.items():
            with self.subTest(arguments):
                result = self.run_program(*arguments, code=2)
                self.assertIn(expected, result.stderr)
                self.assertEqual(len(result.stderr.strip().splitlines()), 1, "one message, once")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_wrong_settings(self):
        for setting, expected in {"Gap/Sides": "Gap/Sides", "Gap/Sids = no flow": "Did you mean 'Sides'?",
                                  "Process/Sheet speed = 60": "Process/Sheet speed"}.items():
            with self.subTest(setting):
                self.assertIn(expected, self.run_program(self.prm("slider_bearing"), "--set", setting, code=2).stderr)

    def test_every_shipped_file_is_valid_and_says_what_it_is(self):
        for file in sorted((SOURCE / "prm").glob("*.prm")):
            with self.subTest(file.name):
                self.assertIn("is valid", self.run_program(file, "--validate").stdout)
                head = file.read_text().split("\nset ")[0]
                for words in ["Source of the values:", "Expected run time:", "Expected key result:"]:
                    self.assertIn(words, head)
                self.assertNotIn("@", head)
        self.assertEqual(list(self.folder.iterdir()), [], "--validate writes nothing")


class Verbs(InFolder):
    def test_init_writes_each_shipped_file_once(self):
        for file in sorted((SOURCE / "prm").glob("*.prm")):
            with self.subTest(file.name):
                self.run_program("init", file.stem)
                written = self.folder / file.name
                self.assertEqual(written.read_bytes(), file.read_bytes())
                written.write_text("mine")
                self.assertIn("not overwritten", self.run_program("init", file.stem, code=2).stderr)
                self.assertEqual(written.read_text(), "mine")

    def test_list_gives_each_model_a_sentence(self):
        text = self.run_program("list").stdout
        for kind in ["task", "surface source", "asperity model", "flow factor model", "hardening law", "yield locus"]:
            self.assertRegex(text, rf"(?m)^{kind}$")
        for line in text.splitlines():
            if line.startswith("  "):
                self.assertRegex(line, r"^  [^:]+: .{10,}")

    def test_parameters_are_complete(self):
        text = self.run_program("parameters").stdout
        for task in ["surface", "flow factors", "friction table", "film", "forming"]:
            self.assertIn(f"## Task `{task}`", text)
        rows = [line for line in text.splitlines() if line.startswith("| ") and not line.startswith("| Entry")]
        self.assertGreater(len(rows), 50)
        for row in rows:
            cells = [c.strip() for c in row.replace("\\|", "/").strip("|").split("|")]
            self.assertEqual(len(cells), 5, row)
            self.assertTrue(all(cells), "a cell is empty: " + row)

    def test_explain(self):
        text = self.run_program("explain", "Sheet surface/Generated/Sq").stdout
        for word in ["um", "Root mean square", "surface", "required"]:
            self.assertIn(word, text)
        self.assertIn("Lubricant/Viscosity", self.run_program("explain", "Lubricant").stdout)
        self.assertIn("Did you mean 'Sheet surface/Generated/Sq'?", self.run_program("explain", "Sheet surface/Generated/Sqq", code=2).stderr)

    def test_doctor(self):
        text = self.run_program("doctor").stdout
        for line in text.splitlines():
            self.assertRegex(line, r"^(ok  |warn)  \S")
        for topic in ["MPI", "BLAS", "gnuplot", "cores", "memory", "current folder"]:
            self.assertIn(topic, text)

    def test_without_gnuplot_a_run_succeeds_with_one_warning(self):
        result = self.run_program(self.prm("surface"), *SMALL, environment={"PATH": "/nonexistent"})
        self.assertEqual((result.stdout + result.stderr).count("gnuplot was not found"), 1)
        self.assertTrue((self.folder / "output/surface/report.html").exists())


class Runs(InFolder):
    def run_twice(self, name, *arguments):
        """Run a file into two folders and check what every task leaves, and that both have the same bytes."""
        for folder in "first", "second":
            self.run_program(self.prm(name), "--quiet", "--output", folder, *arguments)
        files = {f.name for f in (self.folder / "first").iterdir()}
        self.assertEqual(files, {f.name for f in (self.folder / "second").iterdir()})
        self.assertLessEqual({"effective.prm", "run_info.txt", "timing.csv", "log.txt", "report.html"}, files)
        for file in files - {"timing.csv", "log.txt", "report.html"}:
            self.assertEqual((self.folder / "first" / file).read_bytes(), (self.folder / "second" / file).read_bytes(), file)
        for file in files:
            if pathlib.Path(file).suffix in {".svg", ".html", ".vtu", ".pvd"}:
                xml.dom.minidom.parse(str(self.folder / "first" / file))
        return files

    def header(self, file):
        return (self.folder / "first" / file).read_text().splitlines()[0]

    def test_film(self):
        files = self.run_twice("slider_bearing")
        self.assertLessEqual({"results.csv", "solution.pvd", "solution-00000.vtu", "lubricant_pressure.svg"}, files)
        self.assertEqual(self.header("results.csv"), "quantity,value,unit")
        # Rayleigh's bearing, film 4 to 2 um over 10 mm, 60 mm/s, 32 mPa s: load per width
        # 6 eta U L^2 / (h1 - h0)^2 (ln(h1/h0) - 2 (h1 - h0)/(h1 + h0)) = 7.626 N/mm, closed form; mesh error below 0.1 %.
        load = {r["quantity"]: float(r["value"]) for r in self.rows("first/results.csv")}["load_per_width"]
        self.assertAlmostEqual(load / 7.62635, 1, delta=1e-3)

    def test_effective_parameters_give_the_same_results(self):
        self.run_program(self.prm("slider_bearing"), "--quiet", "--output", "first")
        shutil.copy(self.folder / "first/effective.prm", self.folder / "again.prm")
        self.run_program("again.prm", "--quiet", "--output", "second")
        for file in "results.csv", "effective.prm", "solution-00000.vtu":
            self.assertEqual((self.folder / "first" / file).read_bytes(), (self.folder / "second" / file).read_bytes())

    def test_surface(self):
        files = self.run_twice("surface", *SMALL)
        self.assertLessEqual({"surface.csv", "surface_map.svg", "height_distribution.svg", "abbott_curve.svg"}, files)
        self.assertEqual(self.header("surface.csv"), "parameter,value,unit")
        values = {r["parameter"]: float(r["value"]) for r in self.rows("first/surface.csv")}
        self.assertAlmostEqual(values["Sq"], 1.6, places=10)  # the map is scaled to exactly this

    def test_flow_factors(self):
        files = self.run_twice("flow_factors_gaussian", *SMALL, "--set", "Flow factors/Separations = 4, 1.5")
        self.assertLessEqual({"phi_p.svg", "phi_s.svg"}, files)
        self.assertTrue(self.header("flow_factors.csv").startswith(
            "cut_height_um,h_avg_um,h_avg_over_sq,contact_fraction,phi_p_xx,phi_p_xy,phi_p_yx,phi_p_yy,"
            "phi_s_xx,phi_s_xy,phi_s_yx,phi_s_yy"))
        self.assertEqual([round(float(r["h_avg_over_sq"]), 9) for r in self.rows("first/flow_factors.csv")], [4, 1.5])

    def test_compare(self):
        self.run_program(self.prm("flow_factors_gaussian"), *SMALL, "--set", "Flow factors/Separations = 4, 3, 2", "--quiet", "--output", "first")
        rows = [(float(r["h_avg_over_sq"]), float(r["phi_p_xx"])) for r in self.rows("first/flow_factors.csv")]
        measured = self.folder / "measured.csv"
        measured.write_text("h_avg_over_sq,phi_p_xx\n" + "".join(f"{h},{phi + 0.25}\n" for h, phi in rows))
        text = self.run_program("compare", measured, "first").stdout
        self.assertIn("phi_p_xx over h_avg_over_sq, 2 to 4, 3 measured points", text)
        self.assertIn("mean -0.25", text)  # computed minus measured
        self.assertTrue((self.folder / "first/compare_phi_p_xx.svg").exists())
        self.assertIn('id="compare_phi_p_xx"', (self.folder / "first/report.html").read_text())
        self.assertEqual(float(self.rows("first/compare.csv")[0]["points"]), 3)
        for arguments, expected in {("compare", measured): "tribodraw compare MEASURED DIR", ("compare", measured, "nowhere"): "nowhere",
                                    ("compare", "none.csv", "first"): "none.csv",
                                    ("compare", measured, "first", "--columns", "a"): "--columns"}.items():
            with self.subTest(arguments):
                self.assertIn(expected, self.run_program(*arguments, code=2).stderr)

    def test_friction_table(self):
        tool = [s.replace("Sheet", "Tool") for s in SMALL]
        files = self.run_twice("friction_table", *SMALL, *tool, "--set", "Friction table/Pressures = 1, 10 MPa",
                               "--set", "Friction table/Strains = 0, 0.2", "--set", "Friction table/Cut heights = 4",
                               "--set", "Friction table/Interpolation error = 1")
        self.assertLessEqual({"friction_table.json", "table_contact_fraction.svg", "table_friction_coefficient.svg"}, files)
        self.assertEqual(self.header("friction_table.csv"),
                         "p_solid_mpa,eps_p,cut_height_um,contact_fraction,h_avg_um,tau_solid_mpa,mu_boundary,"
                         "phi_p_xx,phi_p_yy,phi_s_xx,phi_s_yy")
        self.assertEqual(len(self.rows("first/friction_table.csv")), 4)

    def test_scatter_strip_draw_and_export(self):
        tool = [s.replace("Sheet", "Tool") for s in SMALL]
        quick = ["--set", "Friction table/Cut heights = 4", "--set", "Friction table/Interpolation error = 0.2"]
        self.run_program(self.prm("friction_table"), "--quiet", "--output", "table", *SMALL, *tool, *quick,
                         "--set", "Scatter/Seeds = 2, 3")
        self.assertEqual(list(self.rows("table/scatter.csv")[0])[:6],
                         ["p_solid_mpa", "eps_p", "contact_fraction_mean", "contact_fraction_sd", "contact_fraction_min",
                          "contact_fraction_max"])
        self.assertLessEqual({"scatter_contact_fraction.svg", "scatter_friction_coefficient.svg"},
                             {f.name for f in (self.folder / "table").iterdir()})
        self.assertGreater(max(float(r["contact_fraction_sd"]) for r in self.rows("table/scatter.csv")), 0)
        given = self.folder / "table"
        band = ", ".join(str(given / f"friction_table_map_{i}.json") for i in (1, 2, 3))
        sweeps = ["--set", f"Friction table/File = {given / 'friction_table.json'}", "--set", f"Friction table/Band files = {band}",
                  "--set", "Strip draw/Sweep/Pressures = 2, 4, 8 MPa", "--set", "Strip draw/Sweep/Speeds = 3, 10, 100, 1000 mm/s"]
        files = self.run_twice("strip_draw", *sweeps)
        self.assertLessEqual({"results.csv", "strip_profile.csv", "sweep_speed.csv", "sweep_amount.csv", "sweep_speed.svg",
                              "strip_pressure.svg", "friction_coefficient.json", "friction_coefficient.csv"}, files)
        for row in self.rows("first/sweep_amount.csv"):
            self.assertLessEqual(float(row["mu_lowest"]), float(row["mu"]))
            self.assertLess(float(row["flow_error"]), 1e-12)
        amounts = [float(r["mu"]) for r in self.rows("first/sweep_amount.csv")]
        self.assertLess(amounts[-1], 0.8 * amounts[0])  # more lubricant, less friction
        self.assertEqual(len(self.rows("first/friction_coefficient.csv")), 3 * 4 * 5)
        # Ranks share the points and come to the same bytes.
        self.run_program(self.prm("strip_draw"), "--quiet", "--output", "ranks", *sweeps, launcher=[MPIEXEC, "--allow-run-as-root",
                                  "--oversubscribe", "-np", "2"])
        for file in "sweep_speed.csv", "friction_coefficient.csv":
            self.assertEqual((self.folder / "ranks" / file).read_bytes(), (self.folder / "first" / file).read_bytes())
        # Export, beside the table and to a named file; a fit that is not good enough leaves nothing.
        coefficients = str(self.folder / "first/friction_coefficient.json")
        for name, file in {"abaqus": "_abaqus.inp", "ls-dyna": "_ls-dyna.k", "csv": "_export.csv", "json": "_export.json"}.items():
            self.run_program("export", coefficients, "--format", name)
            self.assertGreater((self.folder / f"first/friction_coefficient{file}").stat().st_size, 100)
        self.run_program("export", coefficients, "--format", "openradioss", "--strain", "0.05", "--max-error", "0.5", "--to", "x.rad")
        self.assertIn("/FRICTION/1", (self.folder / "x.rad").read_text())
        result = self.run_program("export", coefficients, "--format", "openradioss", "--max-error", "1e-9", "--to", "y.rad", code=2)
        self.assertIn("--max-error", result.stderr)
        self.assertFalse((self.folder / "y.rad").exists())
        self.run_program("export", coefficients, "--format", "csv", "--to", coefficients, code=2)
        self.run_program("export", str(self.folder / "first/results.csv"), "--format", "csv", code=2)
        # A tool that asks for more pressure than the table holds.
        result = self.run_program(self.prm("strip_draw"), "--output", "third", *sweeps, "--set", "Strip draw/Pressure = 400 MPa", code=2)
        self.assertIn("Friction table/Pressures", result.stderr)

    def test_not_converged_is_exit_code_3_with_a_report(self):
        # At this viscosity the pressure would reach some 150 MPa without Barus' law, which then multiplies it by 10^4.
        barus = "Lubricant/Barus/Pressure coefficient"
        result = self.run_program(self.prm("slider_bearing"), "--output", "first", "--set", "Lubricant/Viscosity law = Barus",
                                  "--set", f"{barus} = 60 1/GPa", "--set", "Lubricant/Viscosity = 4000 mPa s", code=3)
        self.assertIn("did not settle", result.stderr)
        self.assertNotIn("report it", result.stderr)
        self.assertLessEqual({"report.html", "timing.csv", "log.txt"}, {f.name for f in (self.folder / "first").iterdir()})

    def test_report_is_drawn_again(self):
        self.run_program(self.prm("slider_bearing"), "--quiet", "--output", "first")
        report = (self.folder / "first/report.html").read_bytes()
        for file in "report.html", "lubricant_pressure.svg", "lubricant_pressure.png":
            (self.folder / "first" / file).unlink()
        self.run_program("report", "first")
        self.assertEqual((self.folder / "first/report.html").read_bytes(), report)

    def test_default_output_folder_and_quiet(self):
        result = self.run_program(self.prm("slider_bearing"), "--quiet")
        self.assertTrue((self.folder / "output/slider_bearing/results.csv").exists())
        lines = (result.stdout + result.stderr).splitlines()
        self.assertTrue(all(line.startswith("Warning: ") for line in lines), lines)


class Parallel(InFolder):
    def launcher(self):
        return [MPIEXEC, "--allow-run-as-root", "--oversubscribe", "-np", "2"]

    def test_two_ranks_give_the_results_of_one(self):
        self.run_program(self.prm("slider_bearing"), "--output", "one")
        self.run_program(self.prm("slider_bearing"), "--output", "two", launcher=self.launcher())
        for a, b in zip(self.rows("one/results.csv"), self.rows("two/results.csv")):
            self.assertEqual(a["quantity"], b["quantity"])
            self.assertAlmostEqual(float(a["value"]), float(b["value"]), delta=1e-10 * max(1., abs(float(a["value"]))))

    def test_wrong_input_is_reported_once(self):
        result = self.run_program(self.prm("slider_bearing"), "--set", "Gap/Sids = x", code=2, launcher=self.launcher())
        self.assertEqual((result.stdout + result.stderr).count("Gap/Sids"), 1)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_rank_that_fails_alone_ends_the_run(self):
        # By a shell and not by "mpiexec ... : ...", which crashes in Open MPI 5.0.7.
        rank_one_fails = '[ "${OMPI_COMM_WORLD_RANK:-$PMI_RANK}" = 1 ] && set -- "$@" --set "Gap/Sids = x"; exec "$@"'
        result = subprocess.run([*self.launcher(), "sh", "-c", rank_one_fails, "sh", PROGRAM, str(self.prm("slider_bearing"))],
                                cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        self.assertIn("rank 1: ", result.stderr)
        self.assertIn("Gap/Sids", result.stderr)

    def test_a_folder_that_cannot_be_made_ends_all_ranks(self):
        (self.folder / "file").write_text("")
        result = self.run_program(self.prm("slider_bearing"), "--output", "file/x", code=2, launcher=self.launcher())
        self.assertEqual(result.stderr.count("tribodraw: "), 1, result.stderr)


if __name__ == "__main__":
    PROGRAM, SOURCE, MPIEXEC = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
