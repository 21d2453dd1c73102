"""Measures and draws the first plot of accuracy.md: the error of one sample a pixel of three
estimators of direct light, as the roughness of a plate under a small lamp falls.

    python3 roughness.py FACET > roughness.svg

Writes the figures to standard error. Takes a few minutes.
"""

import json
import math
import os
import subprocess
import sys
import tempfile

ROUGHNESS = [1, 0.5, 0.25, 0.125, 0.0625, 0.03, 0.015, 0.008, 0.004, 0.002, 0.001]
ESTIMATORS = [("direct_ems", "emitter sampling", "#6a3fb5", ""),
              ("direct_mats", "material sampling", "#b4470f", "7 3"),
              ("direct_mis", "both, MIS", "#1c6b3a", "2 3")]
SAMPLES = 256
SEEDS = 4
REFERENCE = 8192

PLATE = "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf 1 2 3 4\n"
LAMP = "v -0.3 0.6 -1.2\nv 0.3 0.6 -1.2\nv 0.3 1.1 -1.2\nv -0.3 1.1 -1.2\nf 1 2 3 4\n"
SCENE = """<scene>
<integrator type="direct_mis"/>
<sampler type="independent"><integer name="sampleCount" value="1"/></sampler>
<camera type="perspective"><integer name="width" value="48"/><integer name="height" value="48"/>
<float name="fov" value="22"/><rfilter type="box"/>
<transform name="toWorld"><lookat origin="0 1 2.2" target="0 -0.15 0.3" up="0 1 0"/></transform>
</camera>
<mesh type="obj"><string name="filename" value="plate.obj"/>
<bsdf type="roughconductor"><float name="alpha" value="{alpha}"/></bsdf></mesh>
<mesh type="obj"><string name="filename" value="lamp.obj"/>
<emitter type="area"><color name="radiance" value="4 4 4"/></emitter></mesh>
</scene>
"""


def run(*words):
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout


def relmse(facet, folder, scene, alpha):
    """Mean over seeds of the estimators' relMSE, trimmed, times samples: that of one sample."""
    reference = os.path.join(folder, "reference.exr")
    run(facet, "render", scene, "--integrator", "direct_mis", "--sampler", "sobol", "--spp",
        str(REFERENCE), "--seed", "1000", "-o", reference, "--quiet")
    result = {}
    for name, *_ in ESTIMATORS:
        total = 0
        for seed in range(SEEDS):
            image = os.path.join(folder, "image.exr")
            run(facet, "render", scene, "--integrator", name, "--spp", str(SAMPLES), "--seed",
                str(seed), "-o", image, "--quiet")
            total += json.loads(run(facet, "compare", image, reference, "--json", "-"))["relmse"]
        result[name] = total / SEEDS * SAMPLES
        print(f"{alpha:<7} {name:<12} {math.sqrt(result[name]):.3g}", file=sys.stderr)
    return result


def draw(table):
    left, right, top, bottom, width, height = 60, 620, 50, 340, 640, 385
    values = [math.sqrt(v) for row in table for v in row.values()]
    low = math.floor(math.log10(min(values)))
    high = math.ceil(math.log10(max(values)))

    def x_of(alpha):
        return right + math.log10(alpha) / 3 * (right - left)

    def y_of(error):
        return bottom - (math.log10(error) - low) / (high - low) * (bottom - top)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
           f'width="{width}" height="{height}">',
           "<style>text { font: 12px sans-serif; fill: #5d5a63; } .name { fill: #1c1b1f; } "
           ".grid { stroke: #d9d5de; }</style>",
           f'<rect width="{width}" height="{height}" fill="#fbfaf8"/>']
    for decade in range(low, high + 1):
        y = y_of(10.0 ** decade)
        out.append(f'<line class="grid" x1="{left}" x2="{right}" y1="{y:.1f}" y2="{y:.1f}"/>'
                   f'<text x="{left - 6}" y="{y + 4:.1f}" text-anchor="end">{10.0 ** decade:g}</text>')
    for alpha in (1, 0.1, 0.01, 0.001):
        out.append(f'<text x="{x_of(alpha):.1f}" y="{bottom + 18}" text-anchor="middle">{alpha}</text>')
    out.append(f'<text x="{(left + right) / 2}" y="{height - 8}" text-anchor="middle">'
               "roughness alpha</text>")
    out.append(f'<text x="{left}" y="18">relative error of one sample a pixel</text>')
    for i, (name, words, color, dash) in enumerate(ESTIMATORS):
        points = " ".join(f"{x_of(a):.1f},{y_of(math.sqrt(row[name])):.1f}"
                          for a, row in zip(ROUGHNESS, table))
        style = f'stroke="{color}" stroke-width="2" stroke-dasharray="{dash}" fill="none"'
        out.append(f'<polyline points="{points}" {style}/>')
        x = left + 150 * i
        out.append(f'<path d="M{x} 34h24" {style}/>'
                   f'<text class="name" x="{x + 30}" y="38">{words}</text>')
    out.append("</svg>")
    print("\n".join(out))


def main():
    facet = os.path.abspath(sys.argv[1])
    table = []
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("plate.obj", PLATE), ("lamp.obj", LAMP)):
            with open(os.path.join(folder, name), "w", encoding="ascii") as file:
                file.write(text)
        scene = os.path.join(folder, "scene.xml")
        for alpha in ROUGHNESS:
            with open(scene, "w", encoding="ascii") as file:
                file.write(SCENE.format(alpha=alpha))
            table.append(relmse(facet, folder, scene, alpha))
    draw(table)


if __name__ == "__main__":
    main()
