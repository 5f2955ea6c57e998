#!/usr/bin/env python3
"""Check the relative links and images of the Markdown files: file and heading must exist.

    check_links.py ROOT

Looks at the files of ROOT itself and of ROOT/doc. Prints every dead link; exit code 1 if there is one.
"""
import pathlib
import re
import sys

LINK = re.compile(r"!?\[[^\]]*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
IMAGE_TAG = re.compile(r"<(?:img|source)\b[^>]*\bsrc(?:set)?=\"([^\"]+)\"")
ELSEWHERE = re.compile(r"^[a-z][a-z0-9+.-]*:", re.IGNORECASE)


def without_code(text):
    text = re.sub(r"^(```|~~~).*?^\1[^\n]*$", "", text, flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"`[^`\n]*`", "", text)


def anchors(text):
    """Names that GitHub gives to the headings."""
    found = {}
    names = set()
    for heading in re.findall(r"^#{1,6}[ \t]+(.*?)[ \t]*#*$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), re.M):
        name = re.sub(r"[^\w\- ]", "", heading.replace("`", "").lower()).replace(" ", "-")
        count = found.get(name, 0)
        found[name] = count + 1
        names.add(name if count == 0 else f"{name}-{count}")
    return names | set(re.findall(r"<a (?:name|id)=\"([^\"]+)\"", text))


def check(root):
    root = pathlib.Path(root).resolve()
    problems = []
    for path in sorted(root.glob("*.md")) + sorted((root / "doc").rglob("*.md")):
        text = path.read_text(encoding="utf-8")
        body = without_code(text)
        for target in LINK.findall(body) + IMAGE_TAG.findall(body):
            if ELSEWHERE.match(target) or target.startswith("//"):
                continue
            where = f"{path.relative_to(root)}: '{target}'"
            name, _, anchor = target.partition("#")
            other = (path.parent / name).resolve() if name else path
            if not other.is_relative_to(root) or not other.exists():
                problems.append(f"{where}: there is no such file")
            elif anchor and other.suffix == ".md" and anchor not in anchors(other.read_text(encoding="utf-8")):
                problems.append(f"{where}: there is no such heading")
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
