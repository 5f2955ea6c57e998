"""Run the commands of the documentation: run_doc_commands.py PROGRAM SOURCE_FOLDER

Of each page the code blocks are taken in their order. A block after a line that ends with `NAME.prm`: (or names the file to be
written) becomes that file; blocks whose lines are commands are run by a shell in a folder of the page, where `./run`,
`build/tribodraw` and `tribodraw` are the program and `prm` are the shipped files. So that this takes seconds, generated maps have 128
pixels a side instead of what the page says, no figures are drawn, and drawings are validated only (they run in other tests).
A command that fails, or a page that should have commands and has none, is an error.
"""
import os
import pathlib
import re
import stat
import subprocess
import sys
import tempfile

COMMAND = re.compile(r"^\s*(\./run|build/tribodraw|tribodraw|cp|for|done|do|grep|mpirun|--set|\|)(\s|$)")
TESTED_ELSEWHERE = re.compile(r"^\s*(cmake|\./test|\./bench|ctest|python3|doc/site)")  # extension, the tests themselves, the site
FILE = re.compile(r"`([\w/]+\.prm)`[^`]*:\s*$")
PAGES_WITH_COMMANDS = {"cross_die.md", *("tutorials/" + name + ".md" for name in (
    "surface", "flow_factors_of_your_surface", "friction_table", "strip_draw", "square_cup", "shell_benchmarks"))}

WRAPPER = """#!/usr/bin/env bash
# the program on smaller maps, drawings only validated
more=()
[[ "$*" = *Generated/Pixels* ]] && smaller=no || smaller=yes
for word in "$@"; do
  case $word in
    *.prm)
      grep -q '^ *set Task *= *forming' "$word" && more+=(--validate)
      for side in Sheet Tool; do
        [[ $smaller = yes ]] && awk -v s="subsection $side surface" '$0 ~ "^" s {{inside = 1}} /^end/ {{inside = 0}} inside && /set Model *= *generated/ {{found = 1}}
          END {{exit !found}}' "$word" && more+=(--set "$side surface/Generated/Pixels = 128")
      done ;;
  esac
done
PATH=/nonexistent exec {program} "$@" "${{more[@]}}"
"""


def blocks(page):
    """(file name or None, text) of the blocks that are files to be written or commands."""
    inside, before, text = False, "", ""
    for line in page.splitlines(keepends=True):
        if not line.startswith("```"):
            if inside:
                text += line
            elif line.strip():
                before = line.strip()
            continue
        inside = not inside
        if inside:
            text = ""
            continue
        lines = [each for each in text.splitlines() if each.strip()]
        name = FILE.search(before)
        if name and any(each.startswith(("set ", "subsection ")) for each in lines):
            yield name.group(1), text
        elif lines and COMMAND.match(lines[0]) and not any(TESTED_ELSEWHERE.match(each) for each in lines):
            yield None, text


def run_page(program, source, page, folder):
    """Problems of one page, and how many commands it has."""
    wrapper = WRAPPER.format(program=program)
    (folder / "build").mkdir()
    (folder / "bin").mkdir()
    for name in "run", "build/tribodraw", "bin/tribodraw":
        (folder / name).write_text(wrapper)
        (folder / name).chmod((folder / name).stat().st_mode | stat.S_IXUSR)
    (folder / "prm").symlink_to(source / "prm")
    count, problems = 0, []
    for name, text in blocks(page.read_text()):
        if name:
            (folder / name).write_text(text)
            continue
        count += 1
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", text], cwd=folder, capture_output=True, text=True,
                              env={**os.environ, "PATH": f"{folder}/bin:{os.environ['PATH']}"}, timeout=600)
        if done.returncode:
            problems.append(f"{page}: exit code {done.returncode} of\n{text}{done.stdout[-1500:]}{done.stderr[-1500:]}")
    return problems, count


def main():
    program, source = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    problems = []
    for page in sorted((source / "doc").rglob("*.md")):
        with tempfile.TemporaryDirectory() as folder:
            found, count = run_page(program, source, page, pathlib.Path(folder))
        problems += found
        name = page.relative_to(source / "doc").as_posix()
        if count:
            print(f"{name}: {count} blocks of commands", flush=True)
        elif name in PAGES_WITH_COMMANDS:
            problems.append(f"{page}: no commands were found")
    print("\n".join(problems) or "All commands of the pages work.")
    sys.exit(bool(problems))


if __name__ == "__main__":
    main()
