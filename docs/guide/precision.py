"""Measures the table of accuracy.md on precision: what float costs against double as a scene moves
away from the origin.

    python3 precision.py FACET
"""

import json
import os
import subprocess
import sys
import tempfile

DISTANCES = [0, 1, 10, 100, 1e3, 1e4, 1e5, 1e6]
DIRECTION = (1, 0.7, -0.4)

FLOOR = ([(-1, 0, -1), (-1, 0, 1), (1, 0, 1), (1, 0, -1)], [(1, 2, 3, 4)])
LAMP = ([(-0.4, 1.5, -0.4), (0.4, 1.5, -0.4), (0.4, 1.5, 0.4), (-0.4, 1.5, 0.4)], [(1, 2, 3, 4)])
BOX = ([(x, y, z) for x in (-0.4, 0.1) for y in (0, 0.6) for z in (-0.4, 0.2)],
       [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)])
CAMERA = (0.8, 1.1, 2.6)
TARGET = (0, 0.2, 0)

SCENE = """<scene>
<integrator type="path"/>
<sampler type="independent"/>
<camera type="perspective"><integer name="width" value="64"/><integer name="height" value="64"/>
<float name="fov" value="42"/><transform name="toWorld">
<lookat origin="{camera}" target="{target}" up="0 1 0"/></transform></camera>
<mesh type="obj"><string name="filename" value="floor.obj"/><bsdf type="diffuse"/></mesh>
<mesh type="obj"><string name="filename" value="box.obj"/>
<bsdf type="roughconductor"><float name="alpha" value="0.2"/></bsdf></mesh>
<mesh type="obj"><string name="filename" value="lamp.obj"/>
<emitter type="area"><color name="radiance" value="5 5 5"/></emitter></mesh>
</scene>
"""


def moved(point, distance):
    return tuple(p + distance * d for p, d in zip(point, DIRECTION))


def text(point):
    return " ".join(f"{p:.17g}" for p in point)


def write(folder, name, content):
    with open(os.path.join(folder, name), "w", encoding="ascii") as file:
        file.write(content)


def main():
    facet = os.path.abspath(sys.argv[1])
    for distance in DISTANCES:
        with tempfile.TemporaryDirectory() as folder:
            for name, (points, faces) in (("floor", FLOOR), ("lamp", LAMP), ("box", BOX)):
                lines = [f"v {text(moved(p, distance))}" for p in points]
                lines += ["f " + " ".join(map(str, face)) for face in faces]
                write(folder, name + ".obj", "\n".join(lines) + "\n")
            write(folder, "scene.xml", SCENE.format(camera=text(moved(CAMERA, distance)),
                                                    target=text(moved(TARGET, distance))))
            subprocess.run([facet, "tradeoff", "scene.xml", "--budget", "6", "--resolution", "64x64",
                            "--spp", "256", "--json", "report.json", "--quiet"],
                           cwd=folder, check=False, capture_output=True)
            with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
                points = json.load(file)["points"]
        bias = {p["name"]: p["bias"] for p in points}
        print(f"{distance:<10g} {bias['backend reference, precision double']:.2g}")


if __name__ == "__main__":
    main()
