"""Measures whether `facet render --time S` ends in time: the seconds of whole processes, start and
writing included.

    python3 punctuality.py FACET SCENE.xml [options of facet render]

Prints, for S from 2 to 60, how many renders were made, the shortest and the longest over S, and how
many took longer than S and 5 %.
"""

import os
import subprocess
import sys
import tempfile
import time

RENDERS = {2: 10, 5: 6, 10: 3, 20: 2, 60: 1}


def main():
    facet, scene, *options = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        image = os.path.join(folder, "image.exr")
        command = [facet, "render", scene, "--quiet", "--spp", "100000000", "-o", image, *options]
        for limit, renders in RENDERS.items():
            taken = []
            for seed in range(renders):
                start = time.monotonic()
                subprocess.run([*command, "--time", str(limit), "--seed", str(seed)], check=True)
                taken.append((time.monotonic() - start) / limit)
            late = sum(share > 1.05 for share in taken)
            print(f"{limit} s: {renders} renders, {min(taken):.3f} to {max(taken):.3f}, {late} late",
                  flush=True)


if __name__ == "__main__":
    main()
