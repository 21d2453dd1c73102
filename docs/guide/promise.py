"""Measures how often `facet render --error E` keeps its promise, and how many samples that takes: the
true errors of renders with many seeds, against a reference.

    python3 promise.py FACET SCENE.xml WIDTHxHEIGHT E SEEDS REFERENCE_SAMPLES [options of facet render]

E is a percentage. A setting would have kept the promise with fewer samples if 95 % of its renders had
an error of at most E with that many. Prints the share of the renders whose error is at most E, the
samples they took, the share with 1/1.3 of their median, and what multiple of the fewest the median is:
the fewest are where the 95 % largest error, which falls with samples as it does between these two
counts, is E. The reference's own error, which its report estimates, is taken off.
"""

import json
import math
import os
import statistics
import subprocess
import sys
import tempfile


def report(*command):
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def largest_of_95_percent(errors):
    return sorted(errors)[math.ceil(0.95 * len(errors)) - 1]


class Measurement:
    """Renders of one scene, and what a reference says of their errors."""

    def __init__(self, folder, facet, scene, size, samples, options):
        self.facet = facet
        self.command = [facet, "render", scene, "--resolution", size, "--quiet", "--json", "-"]
        self.options = options
        self.reference = os.path.join(folder, "reference.exr")
        self.image = os.path.join(folder, "image.exr")
        made = report(*self.command, "--spp", samples, "--sampler", "sobol", "--seed", "98765", "-o",
                      self.reference)
        self.relmse = made["error_estimate"]["relmse"]

    def errors(self, seeds, *goal):
        """True errors, and samples a pixel, of a render with each seed."""
        errors = []
        counts = []
        for seed in range(seeds):
            counts.append(report(*self.command, *goal, "--seed", str(seed), "-o", self.image,
                                 *self.options)["spp"])
            compared = report(self.facet, "compare", self.image, self.reference, "--json", "-")
            errors.append(max(compared["relmse"] - self.relmse, 0) ** 0.5)
        return errors, counts


def main():
    facet, scene, size, wanted, seeds, samples = sys.argv[1:7]
    limit = float(wanted.rstrip("%")) / 100
    with tempfile.TemporaryDirectory() as folder:
        measurement = Measurement(folder, facet, scene, size, samples, sys.argv[7:])
        print(f"reference: error {100 * measurement.relmse ** 0.5:.2g} %", flush=True)
        errors, counts = measurement.errors(int(seeds), "--error", wanted)
        kept = sum(error <= limit for error in errors)
        median = statistics.median(counts)
        print(f"{kept} of {len(errors)} within {wanted}, samples a pixel {min(counts)} to "
              f"{max(counts)}, median {median:g}, largest error {100 * max(errors):.3g} %",
              flush=True)
        fewer = math.ceil(median / 1.3)
        by_fewer, _ = measurement.errors(int(seeds), "--spp", str(fewer))
    print(f"{sum(error <= limit for error in by_fewer)} of {len(errors)} with {fewer} samples")
    order = math.log(statistics.median(by_fewer) / statistics.median(errors)) / math.log(1.3)
    order = min(max(order, 0.5), 1)
    fewest = fewer * (largest_of_95_percent(by_fewer) / limit) ** (1 / order)
    print(f"the median is {median / fewest:.2f} times the fewest")


if __name__ == "__main__":
    main()
