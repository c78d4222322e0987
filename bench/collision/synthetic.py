# SPDX-License-Identifier: MIT
# Experiments on simulated tracks: exact, noise, orientations, gap, spin, coverage, ablation.
import sys

import numpy as np

from collision.common import MEASURES, files, simulated, summary
from collision.motion import after_impact

THESIS = {"scene": "boxes", "fps": 60, "frames": 90, "restitution": 0.49, "mass_ratio": 1.33}  # Sec. 5.4.1
LITTLE = {"centroid_noise": 0.01, "orientation_noise": 2}


def say(text):
    print(text, file=sys.stderr)


def by(rows, column, what):
    """One line a value of a column, and one for all."""
    for value in dict.fromkeys(row[column] for row in rows):
        say("  " + summary([row for row in rows if row[column] == value], f"{what} {value}"))
    if rows:
        say(summary(rows, "all"))


def exact(bench):
    """Tracks without noise."""
    scenes = ["boxes", "balls", "offcentre", "box-ball", "mesh", "spin", "planar", "box-floor", "boxes", "ball-floor"]
    cases = [{"name": f"exact-{scene}-{10 * turn + i}", "synth": {"scene": scene, "fps": 60, "seed": 10 * turn + i}, "scene": scene}
             for turn in (0, 1) for i, scene in enumerate(scenes, 1)]
    return ["case", "scene", "seed", *MEASURES], bench.run(simulated, cases), lambda rows: by(rows, "scene", "scene")


def off_by(percent, draw):
    """Sightings with uniform noise of up to so much of the larger body's mean size in the picture."""
    random = np.random.default_rng([round(10 * percent), draw])

    def disturb(sightings):
        sizes = {label: np.mean([2 * s["radius"] for s in sightings if s["label"] == label]) for label in {s["label"] for s in sightings}}
        most = percent / 100 * max(sizes.values())
        return [s | {axis: s[axis] + random.uniform(-most, most) for axis in "xy"} for s in sightings]

    return disturb


def noise(bench):
    """Fig. 5.8a: one scene, 63 runs with centroids off by up to a share of the larger body's size: 21 margins, three draws of each."""
    cases = []
    for percent in np.linspace(0, 30, 21):
        for draw in range(1, 4):
            cases.append({"name": f"noise-{percent:g}-{draw}", "synth": {**THESIS, "seed": 1}, "disturb": off_by(percent, draw),
                          "percent": f"{percent:g}", "draw": draw})
    return ["case", "percent", "draw", "seed", *MEASURES], bench.run(simulated, cases), lambda rows: by(rows, "seed", "scene")


def noise_scenes(bench):
    """The same over nine scenes at seven levels, each scene with the same noise at all of them."""
    cases = []
    for level in (0, 5, 10, 15, 20, 25, 30):
        for seed in range(1, 10):
            cases.append({"name": f"noise-scenes-{level}-{seed}", "synth": {**THESIS, "centroid_noise": level / 100, "seed": seed}, "percent": level})
    return ["case", "percent", "seed", *MEASURES], bench.run(simulated, cases), lambda rows: by(rows, "percent", "noise (%)")


def bad_ones(rows):
    """What the program says of values that are off by more than 0.1."""
    bad = [row for row in rows if row.get("c_error", "") != "" and float(row["c_error"]) > 0.1]
    ambiguous = sum(row["ambiguous"] > 0 for row in bad)
    honest = sum(row["c_in"] == 1 or row["ambiguous_holds"] == 1 for row in bad)
    return f"off by more than 0.1: {len(bad)}; of these {ambiguous} are called ambiguous, {honest} have the truth in the interval or among the others"


def orientations(bench):
    """Fig. 5.8b: given orientations turned by up to 40°, two standard deviations."""
    cases = []
    for level in (0, 5, 10, 15, 20, 25, 30, 40):
        for seed in range(1, 5):
            synth = {**THESIS, "orientation_noise": level / 2, "seed": seed}
            cases.append({"name": f"orientations-{level}-{seed}", "synth": synth, "degrees": level})

    def say_all(rows):
        by(rows, "degrees", "noise (deg)")
        say(bad_ones(rows))

    return ["case", "degrees", "seed", *MEASURES], bench.run(simulated, cases), say_all


def gap(bench):
    """Fig. 5.11: nothing is seen around the impact; four orientations of a body in 90 frames. Half of the runs have some noise."""
    cases = []
    for frames in (2, 4, 6, 8, 10):
        for seed in range(1, 7):
            synth = {**THESIS, "gap": frames, "seed": seed} | (LITTLE if seed % 2 else {})
            cases.append({"name": f"gap-{frames}-{seed}", "synth": synth, "gap": frames, "noisy": seed % 2})

    def say_all(rows):
        by(rows, "noisy", "noise")
        by(rows, "gap", "gap")

    return ["case", "gap", "noisy", "seed", *MEASURES], bench.run(simulated, cases), say_all


def spin_case(bench, name, synth, **columns):
    row = simulated(bench, name, synth, **columns)
    fastest, turned = after_impact(*files(bench, name)[1:])
    right = {} if turned is None else {"turned_deg": f"{turned:.1f}", "right_turns": int(turned < 30)}
    return row | {"spin_after": f"{fastest:.1f}"} | right


def spin(bench):
    """Spin after the impact of 8 to 30 rad/s: is the number of turns right?"""
    cases = []
    for seed in range(1, 9):
        for scene, speed in (("offcentre", None), ("spin", 12), ("spin", 20)):
            synth = {"scene": scene, "fps": 60, "seed": seed, **LITTLE} | ({"spin": speed} if speed else {})
            cases.append({"name": f"spin-{scene}-{speed or 'drawn'}-{seed}", "synth": synth, "scene": scene})

    def say_all(rows):
        by(rows, "scene", "scene")
        fast = [row for row in rows if 8 <= float(row["spin_after"]) <= 30]
        say(f"right number of turns: {sum(row.get('right_turns') == 1 for row in fast)} of {len(fast)} runs with 8 to 30 rad/s after the impact")

    return ["case", "scene", "seed", "spin_after", "turned_deg", "right_turns", *MEASURES], bench.run(spin_case, cases), say_all


def sizes_off_by(share, alike, seed):
    """Radii with uniform noise of up to so much of themselves, and those of a body off alike, with a standard deviation of `alike`."""
    random = np.random.default_rng([round(1e4 * share), seed])

    def disturb(sightings):
        scale = {label: np.exp(random.normal(0, alike)) if alike else 1 for label in sorted({s["label"] for s in sightings})}
        return [s | {"radius": s["radius"] * scale[s["label"]] * (1 + random.uniform(-share, share))} if "radius" in s else s for s in sightings]

    return disturb


def coverage(bench, sizes_alike=0):
    """Do the 95 % intervals hold the truth? Radii are as noisy as centres."""
    random = np.random.default_rng(1)
    kinds = ["balls"] * 10 + ["planar"] * 3 + ["ball-floor"] * 2 + ["boxes"] * 3 + ["offcentre", "box-ball"]
    cases = []
    for i in range(200):
        scene = kinds[i % len(kinds)]
        level = {"centroid_noise": round(random.uniform(0.005, 0.06), 4), "orientation_noise": round(random.uniform(1, 6), 2)}
        cases.append({"name": f"coverage{'-sizes' if sizes_alike else ''}-{scene}-{i + 1}", "synth": {"scene": scene, "fps": 120, "seed": i + 1, **level},
                      "disturb": sizes_off_by(level["centroid_noise"], sizes_alike, i + 1), "scene": scene, **level})
    fields = ["case", "scene", "centroid_noise", "orientation_noise", "seed", *MEASURES]
    return fields, bench.run(simulated, cases), lambda rows: by(rows, "scene", "scene")


def coverage_sizes(bench):
    """The same where the sizes of a body are all wrong alike by 4 %, as the solver takes those of spheres to be."""
    return coverage(bench, 0.04)


def ablation(bench):
    """Fig. 5.9: soft physics with terms left out, and the exact form."""
    left_out = ["momentum", "impulse", "energy", "restitution", "gravity", "size", "orientation", "momentum,impulse",
                "momentum,impulse,energy,restitution"]
    kinds = [("exact", {"physics": "exact"}), ("soft", {"physics": "soft"})]
    kinds += [("without " + terms, {"physics": "soft", "without": terms}) for terms in left_out]
    cases = []
    for percent, degrees in ((0, 0), (5, 5)):
        synth = {**THESIS, "gap": 10, "centroid_noise": percent / 100, "orientation_noise": degrees}
        for kind, solve in kinds:
            for seed in (1, 2, 3):
                name = f"ablation-{percent}-{kind}-{seed}".replace(" ", "-").replace(",", "-")
                cases.append({"name": name, "synth": {**synth, "seed": seed}, "solve": solve, "percent": percent, "terms": kind})

    def say_all(rows):
        for percent in (0, 5):
            by([row for row in rows if row["percent"] == percent], "terms", f"{percent} % and {percent}°,")

    return ["case", "percent", "terms", "seed", *MEASURES], bench.run(simulated, cases), say_all
