"""python3 trade.py REPORT.json OUT.svg CHOICE...: error against seconds, from `facet tradeoff --json`.

A line a choice, through its numbers of samples, on logarithmic axes.
"""
import json
import math
import sys

WIDTH, HEIGHT, LEFT, TOP, RIGHT, BOTTOM = 760, 380, 64, 34, 190, 48
COLORS = ["#c0392b", "#1a7f4b", "#2b5fb0", "#8e5ab5", "#b8801b", "#4a5563"]


def axis(low, high):
    """Round figures between the two."""
    ticks = []
    for decade in range(math.floor(math.log10(low)) - 1, math.ceil(math.log10(high)) + 1):
        ticks += [m * 10.0**decade for m in (1, 2, 5)]
    return [t for t in ticks if low <= t <= high]


def main():
    report = json.load(open(sys.argv[1]))
    names = sys.argv[3:]
    for name in names:
        if not any(p["name"] == name for p in report["points"]):
            sys.exit(f"{sys.argv[1]} has no choice {name}")
    points = [p for p in report["points"] if p["name"] in names and p["relmse_trimmed"] > 0]
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
    ends = []
    for name in names:
        list_ = sorted(series[name], key=lambda p: p["seconds"])
        color = COLORS[len(ends) % len(COLORS)]
        places = [place(p["seconds"], p["error"]) for p in list_]
        out.append(f'<polyline stroke="{color}" points="{" ".join("%.1f,%.1f" % q for q in places)}"/>')
        for p, (px, py) in zip(list_, places):
            out.append(f'<circle fill="{color}" cx="{px:.1f}" cy="{py:.1f}" r="4"><title>{name}, '
                       f'{p["spp"]} samples: {p["error"]:.2g} % in {p["seconds"]:.2g} s</title></circle>')
        ends.append([places[-1][1], places[-1], name, color])
    ends.sort()
    for i, end in enumerate(ends[1:], 1):
        end[0] = max(end[0], ends[i - 1][0] + 17)
    for y, (px, py), name, color in ends:
        out.append(f'<path stroke="{color}" d="M{px + 6:.1f} {py:.1f} L{WIDTH - RIGHT + 8} {y:.1f}"/>'
                   f'<text fill="{color}" x="{WIDTH - RIGHT + 12}" y="{y + 4:.1f}">{name}</text>')
    open(sys.argv[2], "w").write(f"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">
<title>Error against seconds</title>
<style>.g{{stroke:#dde3ea}}.m{{text-anchor:middle}}.e{{text-anchor:end}}polyline,path{{fill:none;stroke-width:1.6}}path{{stroke-width:.7}}</style>
<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>
<text x="{LEFT}" y="20">error (root of trimmed relMSE) against seconds of rendering, two cores</text>
{chr(10).join(out)}
</svg>
""")


main()
