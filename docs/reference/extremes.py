"""Writes the page of the extremes from what `facet extremes --json` found, on some drivers.

    facet extremes --json a.json
    python3 extremes.py a.json [b.json ...] > extremes.md

Rows of a later file replace those of an earlier one of the same device and driver.
"""

import json
import sys

INTRODUCTION = """# Numbers at the edge

Each row says what is measured, over which inputs, and the largest deviation found with the input
that made it. A row *holds* where that stays within its limit. `facet extremes` measures this table
on any device (`--quick`: a sample of it), `tests/extremes` hold it in every run of the tests, and
`docs/reference/extremes.py` wrote this page from its JSON.

The **premise** is what images that are the same in every bit rest on: every operation rounded by
itself, as IEEE 754 says, denormal numbers kept, in the order in which it is written. Of one
operand all 2³² words are tried; of two or three a billion, half of which are of any kind and size,
the others near powers of two, denormal, infinite, NaN, 0, the largest, or such that sums cancel
(`shaders/shared/extreme_inputs.h`). **Elementary functions** are compared with double, and the
worst input with 160 bits; an *ulp* is the distance of neighbouring floats at the true value.
**BSDFs** are compared with their definitions in 160 bits (`host/extremes/bsdf_models.cpp`), which
take the directions as they are, rounded to float. Three things are no error of a function, and its
row says where they are taken off: where Beckmann's exponent exceeds ten, an error grows with it;
beside the critical angle reflectance has an infinite slope, and two ulp of the cosine change it by
any factor; a sample's direction is rounded before its density is asked again, and a lobe may be
narrower than that. What is seen of a value below 1e-30 counts as nothing. Microfacets' reflectance
after Schlick, (1 - c)^5 beside c = 1, changes with them likewise. **Rays and triangles** meet in
soups of any shape and size, and are compared with double; no ray may leak out of a closed mesh.
**Surfaces**, **lights**, **images** and **scenes** are renders whose result is known: a convex
body under an even sky loses no ray, a floor under a square lamp has its form factor, a scene times
a power of two gives the same bits. **Parity** renders the scenes of all these rows by kernels and
reference.
"""


def number(value):
    if value is None:
        return "not finite"
    return f"{value:.4g}" if value else "0"


def count(value):
    for size, name in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if value >= size:
            return f"{value / size:.3g} {name}"
    return str(value)


def verdict(row):
    if row["holds"]:
        return "holds"
    return "argued" if row["argued"] else "**fails**"


def escaped(text):
    return text.replace("|", "\\|")


def read_tables(names):
    """The tables of the files, one a device and driver."""
    tables = {}
    for name in names:
        table = json.load(open(name))
        known = tables.setdefault((table["device"], table["driver"], table["quick"]), table)
        if known is table:
            continue
        rows = {(row["group"], row["name"]): row for row in known["rows"] + table["rows"]}
        known["rows"] = list(rows.values())
    return list(tables.values())


def main():
    tables = read_tables(sys.argv[1:])
    print(INTRODUCTION)
    for table in tables:
        inputs = "a sample of the inputs" if table["quick"] else "all inputs"
        print(f"- facet {table['version']}, {table['device']}, {table['driver']}: {inputs}, {len(table['rows'])} rows")
    groups = list(dict.fromkeys(row["group"] for table in tables for row in table["rows"]))
    for group in groups:
        print(f"\n## {group[0].upper() + group[1:]}\n")
        several = len(tables) > 1
        print("| row | inputs | " + ("driver | " if several else "") +
              "how many | worst | limit | unit | | worst input |")
        print("|---|---|" + ("---|" if several else "") + "---|---|---|---|---|---|")
        names = list(dict.fromkeys(row["name"] for table in tables for row in table["rows"]
                                   if row["group"] == group))
        for name in names:
            first = True
            for table in tables:
                for row in table["rows"]:
                    if row["name"] != name:
                        continue
                    driver = f"{table['driver'].split('(')[0].strip()} | " if several else ""
                    print(f"| {escaped(name) if first else ''} | {escaped(row['range']) if first else ''} | "
                          f"{driver}{count(row['inputs'])} | {number(row['worst'])} | "
                          f"{number(row['limit'])} | {row['unit']} | {verdict(row)} | {escaped(row['at'])} |")
                    first = False
    notes = {row["argued"] for table in tables for row in table["rows"] if row["argued"]}
    for note in sorted(notes):
        print(f"\n{note}")


if __name__ == "__main__":
    main()
