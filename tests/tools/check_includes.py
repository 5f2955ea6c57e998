#!/usr/bin/env python3
"""Check the borders between modules: who includes whom.

    check_includes.py ROOT

A module includes only itself and modules that stand left of it in ORDER. No public header includes headers of
finite-element or solver libraries, and of the sources only those of modules marked DEALII in their CMakeLists.txt.
Prints every violation; exit code 1 if there is one.
"""
import pathlib
import re
import sys

# Modules of one group do not know each other.
ORDER = [
    ["base"],
    ["surface", "fluid", "material", "tools"],
    ["flattening", "boundary_friction", "shell"],
    ["flow_factors", "contact"],
    ["friction_table"],
    ["lubrication"],
    ["forming"],
    ["output"],
    ["application"],
]
LEVEL = {module: level for level, group in enumerate(ORDER) for module in group}

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
# deal.II and what comes with it: a change there must not recompile, or be known to, the physics.
HEAVY = re.compile(r"^(deal\.II/|Epetra|Tpetra|Amesos|AztecOO|ml_|Teuchos|Kokkos|trilinos/|petsc|p4est)")


def modules_with_finite_elements(root):
    marked = set()
    for module in LEVEL:
        listing = root / "source" / module / "CMakeLists.txt"
        if listing.exists() and re.search(r"tribodraw_module\(\s*" + module + r"\s+DEALII\b", listing.read_text()):
            marked.add(module)
    return marked


def check_file(path, module, is_public_header, with_finite_elements, problems):
    text = path.read_text()
    for match in INCLUDE.finditer(text):
        kind, name = match.groups()
        where = f"{path}:{text.count(chr(10), 0, match.start()) + 1}"
        if name.startswith("tribodraw/"):
            other = name.split("/")[1]
            if other not in LEVEL:
                problems.append(f"{where}: '{name}' is of no known module")
            elif other != module and LEVEL[other] >= LEVEL[module]:
                problems.append(f"{where}: module {module} must not know module {other}")
        elif kind == '"' and (name.startswith("..") or "/" in name):
            problems.append(f"{where}: '{name}' reaches into another folder; use <tribodraw/...>")
        elif HEAVY.match(name):
            if is_public_header:
                problems.append(f"{where}: a header includes '{name}'; include it in the source file")
            elif not with_finite_elements:
                problems.append(f"{where}: module {module} is not marked DEALII and includes '{name}'")


def check(root):
    root = pathlib.Path(root)
    problems = []
    n_files = 0
    marked = modules_with_finite_elements(root)
    for top, is_public_header in ((root / "include" / "tribodraw", True), (root / "source", False)):
        for path in sorted(top.rglob("*")):
            if path.suffix not in (".h", ".cc"):
                continue
            module = path.relative_to(top).parts[0]
            if module not in LEVEL:
                problems.append(f"{path}: '{module}' is not a module; add it to ORDER in {__file__}")
                continue
            n_files += 1
            check_file(path, module, is_public_header, module in marked, problems)
    if n_files == 0:
        problems.append(f"no sources found below {root}")
    return problems


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    problems = check(arguments[0])
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
