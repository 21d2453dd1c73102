"""python3 trade.py REPORT.json OUT.svg: error against seconds, from `facet tradeoff --json`.

One dot a choice, on logarithmic axes; the front, which nothing else beats in both, is a line.
"""
import json
import math
import sys

WIDTH, HEIGHT, LEFT, TOP, RIGHT, BOTTOM = 760, 400, 64, 34, 190, 48


def axis(low, high):
    """Round figures between the two."""
    ticks = []
    for decade in range(math.floor(math.log10(low)) - 1, math.ceil(math.log10(high)) + 1):
        ticks += [m * 10.0**decade for m in (1, 2, 5)]
    return [t for t in ticks if low <= t <= high]


def main():
    report = json.load(open(sys.argv[1]))
    points = [p for p in report["points"] if p["seconds"] > 0 and p["relmse_trimmed"] > 0]
    for p in points:
        p["error"] = 100 * math.sqrt(p["relmse_trimmed"])
    xs, ys = [p["seconds"] for p in points], [p["error"] for p in points]
    x0, x1, y0, y1 = min(xs) / 1.2, max(xs) * 1.2, min(ys) / 1.2, max(ys) * 1.2

    def place(x, y):
        return (LEFT + (WIDTH - LEFT - RIGHT) * math.log(x / x0) / math.log(x1 / x0),
                TOP + (HEIGHT - TOP - BOTTOM) * math.log(y1 / y) / math.log(y1 / y0))

    out = []
    for x in axis(x0, x1):
        px, _ = place(x, y0)
        out.append(f'<line class="g" x1="{px:.1f}" y1="{TOP}" x2="{px:.1f}" y2="{HEIGHT - BOTTOM}"/>'
                   f'<text class="m" x="{px:.1f}" y="{HEIGHT - BOTTOM + 17}">{x:g} s</text>')
    for y in axis(y0, y1):
        _, py = place(x0, y)
        out.append(f'<line class="g" x1="{LEFT}" y1="{py:.1f}" x2="{WIDTH - RIGHT}" y2="{py:.1f}"/>'
                   f'<text class="e" x="{LEFT - 7}" y="{py + 4:.1f}">{y:g} %</text>')
    series = {}
    for p in points:
        series.setdefault(p["name"], []).append(p)
    front = sorted((p for p in points if p["front"]), key=lambda p: p["seconds"])
    line = " ".join("%.1f,%.1f" % place(p["seconds"], p["error"]) for p in front)
    out.append(f'<polyline points="{line}"/>')
    labels = []
    for name, list_ in series.items():
        kind = "best" if name == "best" else "default" if name == "default" else "other"
        last = max(list_, key=lambda p: p["seconds"])
        for p in list_:
            px, py = place(p["seconds"], p["error"])
            out.append(f'<circle class="{kind}" cx="{px:.1f}" cy="{py:.1f}" r="4">'
                       f'<title>{name}, {p["spp"]} samples: {p["error"]:.2g} % in {p["seconds"]:.2g} s'
                       f'</title></circle>')
        labels.append([place(last["seconds"], last["error"])[1], name, kind])
    labels.sort()
    for i, label in enumerate(labels[1:], 1):
        label[0] = max(label[0], labels[i - 1][0] + 15)
    for y, name, kind in labels:
        out.append(f'<text class="{kind}" x="{WIDTH - RIGHT + 12}" y="{y + 4:.1f}">{name}</text>')
    open(sys.argv[2], "w").write(f"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">
<title>Error against seconds</title>
<style>.g{{stroke:#dde3ea}}.m{{text-anchor:middle}}.e{{text-anchor:end}}polyline{{fill:none;stroke:#1a7f4b;stroke-width:1.6}}circle.other{{fill:#8795a6}}circle.default{{fill:#c0392b}}circle.best{{fill:#1a7f4b}}text.default{{fill:#c0392b;font-weight:600}}text.best{{fill:#1a7f4b;font-weight:600}}text.other{{fill:#445}}</style>
<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>
<text x="{LEFT}" y="20">error (root of trimmed relMSE) against seconds of rendering; the line is what nothing beats</text>
{chr(10).join(out)}
</svg>
""")


main()
