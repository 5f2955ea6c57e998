"""A friction table written by the program obeys the published schema, and damaged ones do not.

check_schema.py PROGRAM SOURCE_FOLDER

The validator below knows the words of JSON Schema that doc/friction_table.schema.json uses, and no others."""
import copy
import json
import pathlib
import subprocess
import sys
import tempfile

KNOWN = {"$schema", "title", "description", "type", "required", "properties", "const", "enum", "items", "prefixItems",
         "minItems", "maxItems"}
TYPES = {"object": dict, "array": list, "string": str, "number": (int, float)}


def problems(value, schema, place="table"):
    unknown = set(schema) - KNOWN
    assert not unknown, f"the schema uses {unknown}, which this validator does not know"
    if "const" in schema and value != schema["const"]:
        return [f"{place}: {value!r} instead of {schema['const']!r}"]
    if "enum" in schema and value not in schema["enum"]:
        return [f"{place}: {value!r} not in {schema['enum']}"]
    if "type" in schema and (not isinstance(value, TYPES[schema["type"]]) or isinstance(value, bool)):
        return [f"{place}: not of type {schema['type']}"]
    found = []
    if isinstance(value, dict):
        found += [f"{place}: lacks {key}" for key in schema.get("required", []) if key not in value]
        for key, sub in schema.get("properties", {}).items():
            if key in value:
                found += problems(value[key], sub, f"{place}/{key}")
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            found.append(f"{place}: {len(value)} items")
        for i, (item, sub) in enumerate(zip(value, schema.get("prefixItems", []))):
            found += problems(item, sub, f"{place}/{i}")
        if "items" in schema:
            for i, item in enumerate(value):
                found += problems(item, schema["items"], f"{place}/{i}")
    return found


def main():
    program, source = sys.argv[1], pathlib.Path(sys.argv[2])
    schema = json.loads((source / "doc/friction_table.schema.json").read_text())
    with tempfile.TemporaryDirectory() as folder:
        command = [program, str(source / "prm/friction_table.prm"), "--output", folder + "/out", "--quiet"]
        for surface in ("Sheet", "Tool"):
            command += ["--set", f"{surface} surface/Generated/Pixels = 128"]
        subprocess.run(command, check=True, timeout=300)
        table = json.loads(pathlib.Path(folder, "out/friction_table.json").read_text())
    assert problems(table, schema) == [], problems(table, schema)[:5]
    # What the schema cannot say: the number of values follows from the axes.
    for name, content in table["tables"].items():
        n = 1
        for axis in content["axes"]:
            n *= len(axis["points"])
        assert len(content["values"]) == n, name
    for path, value in [(("format",), "x"), (("version",), 2), (("sq", "unit"), "um"), (("state_curves", "h_avg"), None),
                        (("tables", "shear_strength", "axes", 0, "name"), "time"), (("tables", "shear_strength", "values"), []),
                        (("tables", "cut_height_normal", "axes"), table["tables"]["shear_strength"]["axes"])]:
        damaged = copy.deepcopy(table)
        place = damaged
        for key in path[:-1]:
            place = place[key]
        if value is None:
            del place[path[-1]]
        else:
            place[path[-1]] = value
        assert problems(damaged, schema), f"damage at {path} is not seen"


if __name__ == "__main__":
    main()
