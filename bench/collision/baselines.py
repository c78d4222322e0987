# SPDX-License-Identifier: MIT
# What needs no physics: poses between keyframes (Fig. 5.15). And a spinning ball beside the same ball without spin (Fig. 5.13).
import numpy as np

from collision.common import MEASURES, files, floats, number, read, simulated
from collision.motion import half_turns, matrix, poses, slerp, turned
from collision.synthetic import say

AROUND = 0.06  # s on each side of the impact that is compared


def between(keys, frame):
    """Linear in place, slerp in orientation; held before the first keyframe and after the last."""
    at = sorted(keys)
    if frame <= at[0] or frame >= at[-1]:
        return keys[at[0] if frame <= at[0] else at[-1]]
    right = int(np.searchsorted(at, frame, side="right"))
    low, high = at[right - 1], at[right]
    share = (frame - low) / (high - low)
    (p, q), (r, s) = keys[low], keys[high]
    return (1 - share) * p + share * r, slerp(q, s, share)


def gap_between(shapes, states):
    """How far two bodies are apart, m (negative: how deep in each other), by the best separating direction of faces, edges and centres."""
    (a, p, q), (b, r, s) = ((shape, *state) for shape, state in zip(shapes, states))
    A, B = matrix(q), matrix(s)
    away = r - p
    directions = [away]
    if "box" in a and "box" in b:
        directions = [*A.T, *B.T, *(np.cross(i, j) for i in A.T for j in B.T)]
    reach = lambda body, R, d: 0.5 * np.abs(R.T @ d) @ body["box"] if "box" in body else body["sphere"]  # noqa: E731
    units = [d / np.linalg.norm(d) for d in directions if np.linalg.norm(d) > 1e-9]
    return max(abs(away @ d) - reach(a, A, d) - reach(b, B, d) for d in units)


def quarters(frames, impact):
    """Frames at a quarter and at three quarters of what was seen on each side of the impact, where the tracks have orientations."""
    sides = [[f for f in frames if f < impact], [f for f in frames if f > impact]]
    return {side[int(share * len(side))] for side in sides for share in (0.25, 0.75)}


def keyframes(shot, seen, truth, name, body):
    """The true poses where orientations were given: the keyframes of someone who makes no error."""
    true = poses(truth, name)
    given = {round(o["t"] * shot["fps"]) for o in shot.get("orientations", []) if o["body"] == body["name"]}
    return {f: true[f] for f in given or quarters(seen, truth["impacts"][0]["frame"]) if f in true}


def compare(bench, name, synth, **columns):
    row = simulated(bench, name, synth, **columns)
    shot, truth, result = files(bench, name)
    file = read(shot / "shot.json")
    impact, shapes = truth["impacts"][0]["frame"], truth["bodies"]
    seen = sorted({o["frame"] for o in read(shot / "observations.json")})
    true = [poses(truth, body) for body in "ab"]
    keys = [keyframes(file, seen, truth, body, shape) for body, shape in zip("ab", shapes)]
    near = [f for f in true[0] if f in true[1] and abs(f - impact) <= AROUND * truth["fps"]]
    ways = {"keyframes": [{f: between(k, f) for f in near} for k in keys]}
    if result:
        ways["ours"] = [poses(result, body) for body in "ab"]
    for way, paths in ways.items():
        use = [f for f in near if f in paths[0] and f in paths[1]]
        if not use:
            continue
        off = [np.linalg.norm(paths[i][f][0] - true[i][f][0]) for i in (0, 1) for f in use]
        boxes = [i for i in (0, 1) if "box" in shapes[i]]
        angles = [np.degrees(turned(true[i][f][1], paths[i][f][1], half_turns(shapes[i]))) for i in boxes for f in use]
        row |= {f"{way}_off_m": number(float(max(off))), f"{way}_turned_deg": number(float(max(angles))) if angles else "",
                f"{way}_apart_m": number(float(min(gap_between(shapes, [paths[i][f] for i in (0, 1)]) for f in use)))}
    row["true_apart_m"] = number(float(min(gap_between(shapes, [true[i][f] for i in (0, 1)]) for f in near)))
    return row


def keyframe(bench):
    """Fig. 5.15: two boxes, two balls; the two orientations of each flight are the keyframes. Nothing is seen for 10 frames around the impact."""
    cases = []
    for scene in ("boxes", "offcentre", "balls"):
        for seed in range(1, 5):
            synth = {"scene": scene, "fps": 120, "gap": 10, "centroid_noise": 0.01, "orientation_noise": 2, "seed": seed}
            cases.append({"name": f"keyframe-{scene}-{seed}", "synth": synth, "scene": scene})
    columns = [f"{way}_{what}" for way in ("keyframes", "ours") for what in ("off_m", "turned_deg", "apart_m")]

    def say_all(rows):
        for way in ("keyframes", "ours"):
            off, turn, apart = (floats(rows, f"{way}_{what}") for what in ("off_m", "turned_deg", "apart_m"))
            if len(off):
                say(f"  {way}: within {1000 * AROUND:.0f} ms of the impact off by up to {100 * np.median(off):.1f} cm (median)"
                    + (f" and {np.median(turn):.1f}°" if len(turn) else "") + f"; the bodies come within {100 * np.median(apart):.1f} cm")

    return ["case", "scene", "seed", *columns, "true_apart_m", *MEASURES], bench.run(compare, cases), say_all


def spinning(bench):
    """Fig. 5.13: a ball that spins has the restitution of the same ball without spin, also where friction makes the spin tell."""
    cases = []
    for scene, seeds in (("ball-floor", (1, 2, 3, 4)), ("balls", (1, 2, 3, 4))):
        for seed in seeds:
            for spin in (0, 30):
                synth = {"scene": scene, "fps": 120, "friction": 0.2, "restitution": 0.7, "spin": spin, "centroid_noise": 0.01, "seed": seed}
                cases.append({"name": f"spinning-{scene}-{spin}-{seed}", "synth": synth, "scene": scene, "spin": spin})

    def say_all(rows):
        values = {}
        for row in rows:
            if row.get("c"):
                values.setdefault((row["scene"], row["seed"]), {})[row["spin"]] = float(row["c"])
        apart = [abs(pair[0] - pair[30]) for pair in values.values() if len(pair) == 2]
        if apart:
            say(f"  c with and without spin: {np.median(apart):.4f} apart (median), {max(apart):.4f} (most), {len(apart)} pairs")
        else:
            say("  no pair has both values")

    return ["case", "scene", "spin", "seed", *MEASURES], bench.run(simulated, cases), say_all
