"""Measures how often `facet render --error E` keeps its promise: the true errors of renders with
many seeds, against a reference.

    python3 promise.py FACET SCENE.xml WIDTHxHEIGHT E SEEDS REFERENCE_SAMPLES [options of facet render]

E is a percentage. Prints the share of the renders whose error is at most E, the mean square of error
over E (1 would be spending no sample too many, and keeping no promise surely), and the samples taken.
The reference's own error, which its report estimates, is taken off.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile


def report(*command):
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def main():
    facet, scene, size, wanted, seeds, samples = sys.argv[1:7]
    options = sys.argv[7:]
    limit = float(wanted.rstrip("%")) / 100
    with tempfile.TemporaryDirectory() as folder:
        reference = os.path.join(folder, "reference.exr")
        image = os.path.join(folder, "image.exr")
        render = [facet, "render", scene, "--resolution", size, "--quiet", "--json", "-"]
        made = report(*render, "--spp", samples, "--sampler", "sobol", "--seed", "98765", "-o",
                      reference)["error_estimate"]["relmse"]
        print(f"reference: error {100 * made ** 0.5:.2g} %", flush=True)
        errors = []
        counts = []
        for seed in range(int(seeds)):
            counts.append(report(*render, "--error", wanted, "--seed", str(seed), "-o", image,
                                 *options)["spp"])
            compared = report(facet, "compare", image, reference, "--json", "-")
            errors.append(max(compared["relmse"] - made, 0) ** 0.5)
    kept = sum(error <= limit for error in errors)
    square = statistics.mean((error / limit) ** 2 for error in errors)
    print(f"{kept} of {len(errors)} within {wanted}, mean square of error/E {square:.2f}, "
          f"samples a pixel {min(counts)} to {max(counts)}, median {statistics.median(counts):g}, "
          f"largest error {100 * max(errors):.3g} %")


if __name__ == "__main__":
    main()
