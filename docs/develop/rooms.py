"""python3 rooms.py: draws rooms.svg from what the rooms' CMakeLists.txt say that they use."""
import pathlib
import re

here = pathlib.Path(__file__).resolve().parent
host = here.parent.parent / "host"

# From the top; whatever a room uses must stand below it.
ROWS = [
    ["cli"],
    ["report"],
    ["bench", "extremes", "nori", "tradeoff"],
    ["parity", "door"],
    ["render", "reference"],
    ["gpu", "accel", "scene"],
    ["parts", "convergence", "compare"],
    ["image", "statistics"],
    ["core"],
]
WIDTH, HEIGHT, STEP, BOX = 760, 46, 74, 112


def uses():
    """{room: rooms that it uses}"""
    found = {}
    for file in host.glob("*/CMakeLists.txt"):
        text = file.read_text()
        match = re.search(r"facet_room\((\w+).*?USES ([\w\s]+?)(?:\n\s*[A-Z_]+ |\))", text, re.S)
        if match:
            found[match[1]] = [r for r in match[2].split() if (host / r).is_dir()]
    rooms = {r for row in ROWS for r in row}
    found["cli"] = sorted(rooms - {"cli"})
    found.setdefault("core", [])
    assert set(found) == rooms, (set(found) ^ rooms)
    return found


def reached(graph, room):
    below = set()
    for other in graph[room]:
        below |= {other} | reached(graph, other)
    return below


def main():
    graph = uses()
    places = {}
    for j, row in enumerate(ROWS):
        for i, room in enumerate(row):
            places[room] = (WIDTH * (i + 1) / (len(row) + 1), 20 + j * STEP)
    lines, boxes = [], []
    for room, others in graph.items():
        for other in others:
            assert places[other][1] > places[room][1], f"{room} uses {other}"
            # An arrow that others imply would say nothing.
            if any(other in reached(graph, third) for third in others):
                continue
            (x1, y1), (x2, y2) = places[room], places[other]
            lines.append(f'<line x1="{x1:.0f}" y1="{y1 + HEIGHT}" x2="{x2:.0f}" y2="{y2 - 2}"/>')
    for room, (x, y) in places.items():
        boxes.append(f'<rect x="{x - BOX / 2:.0f}" y="{y}" width="{BOX}" height="{HEIGHT}" rx="6"/>'
                     f'<text x="{x:.0f}" y="{y + 28}">{room}</text>')
    height = 20 + len(ROWS) * STEP
    (here / "rooms.svg").write_text(f"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" font-family="sans-serif" font-size="15">
<title>The rooms of facet; an arrow points to what a room uses</title>
<style>line{{stroke:#8795a6;stroke-width:1.3;marker-end:url(#a)}}rect{{fill:#e9f0f8;stroke:#5b6b7f}}text{{text-anchor:middle;fill:#123}}</style>
<defs><marker id="a" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto"><path d="M0 0 8 4 0 8z" fill="#8795a6"/></marker></defs>
<rect width="{WIDTH}" height="{height}" style="fill:#fff;stroke:none"/>
{chr(10).join(sorted(lines))}
{chr(10).join(boxes)}
</svg>
""")


main()
