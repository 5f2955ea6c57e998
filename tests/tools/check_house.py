#!/usr/bin/env python3
"""Check the rules of the house that a compiler does not see.

    check_house.py ROOT

- Every source file is listed in the CMakeLists.txt of its module, and the list is sorted: a law that is not
  compiled is silently missing.
- One registered law a file; no file longer than 800 lines.
- Registered laws are not named in forming and application: a new law must not need a change there.
Prints every violation; exit code 1 if there is one.
"""
import pathlib
import re
import sys

MAX_LINES = 800
REGISTER = re.compile(r'^[ \t]*TRIBODRAW_REGISTER(?:_\w+)?\s*\(\s*\w+\s*,\s*\w+\s*,\s*"([^"]+)"', re.MULTILINE)
STRING = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
SOURCE = re.compile(r"(?<![\w/}])\w[\w/]*\.cc\b")
MODULES_WITHOUT_LAWS = ("forming", "application")

# Words that are names of laws and, in the modules above, of something else.
OTHER_MEANING = {
    "constant": "the choice of Coupling/Friction",
}


def check_listing(module, problems):
    listing = module / "CMakeLists.txt"
    if not listing.exists():
        problems.append(f"{module}: no CMakeLists.txt")
        return
    text = re.sub(r"#.*", "", listing.read_text())
    # A name after a variable, `${folder}/x.cc`, is of a generated file.
    listed = SOURCE.findall(text)
    present = {str(p.relative_to(module)) for p in module.rglob("*.cc")}
    present.discard("main.cc")  # the program itself, in the top CMakeLists.txt
    problems += [f"{module / name}: not listed in {listing}" for name in sorted(present - set(listed))]
    problems += [f"{listing}: '{name}' does not exist" for name in listed if not (module / name).exists()]
    call = re.search(r"tribodraw_module\(([^)]*)\)", text)
    in_order = SOURCE.findall(call.group(1)) if call else []
    if in_order != sorted(in_order, key=lambda name: (name.count("/"), name)):  # subfolders last
        problems.append(f"{listing}: the sources are not sorted")


def check_names(root, laws, problems):
    for module in MODULES_WITHOUT_LAWS:
        for top in (root / "source", root / "include" / "tribodraw"):
            for path in sorted((top / module).rglob("*")):
                if path.suffix not in (".h", ".cc"):
                    continue
                text = path.read_text()
                own = set(REGISTER.findall(text))
                for match in STRING.finditer(text):
                    name = match.group(1)
                    if name in laws and name not in own and name not in OTHER_MEANING:
                        line = text.count("\n", 0, match.start()) + 1
                        problems.append(f"{path}:{line}: names the law '{name}' of {laws[name]}")


def check(root):
    root = pathlib.Path(root)
    problems = []
    laws = {}
    modules = sorted(p for p in (root / "source").iterdir() if p.is_dir() and any(p.rglob("*.cc")))
    for module in modules:
        check_listing(module, problems)
        for path in sorted(module.rglob("*.cc")):
            names = REGISTER.findall(path.read_text())
            if len(names) > 1:
                problems.append(f"{path}: registers {len(names)} laws; one a file")
            if module.name not in MODULES_WITHOUT_LAWS:
                laws.update({name: path.name for name in names})
    if not laws:
        problems.append(f"{root}: no registered law found")
    for top in ("include", "source", "tests"):
        for path in sorted((root / top).rglob("*")):
            if path.suffix in (".h", ".cc", ".py") and len(path.read_text().splitlines()) > MAX_LINES:
                problems.append(f"{path}: longer than {MAX_LINES} lines")
    check_names(root, laws, problems)
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
