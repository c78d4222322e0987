# SPDX-License-Identifier: MIT
# Friction at the contact: with it in the model, without it (Fig. 5.10), and what a point mass makes of the frictionless one.
import json

import numpy as np

from collision.common import MEASURES, files, floats, number, reconstruct, scores, simulated
from collision.synthetic import say

GRAVITY = np.array([0, 0, -9.81])
ROLLS = 2 / 7    # of the slip that friction takes from a solid ball until it rolls
FPS = 120
CAMERA = {"fx": 1000, "fy": 1000, "cx": 639.5, "cy": 359.5, "width": 1280, "height": 720}


def frictionless(c, mu, slope, rolls):
    """What c reads when J is taken for the normal's direction: a body that meets with speed 1 along the normal and `slope` across, and whose
    friction ends at a share `rolls` of the slip. A point mass has 1: 0.6 at mu = 0.3 and 45° reads (c - mu + mu² (1 + c)) / (1 + mu) = 0.34."""
    J, before = np.array([1 + c, -min(mu * (1 + c), rolls * slope)]), np.array([-1.0, slope])
    return float(-((before + J) @ J) / (before @ J))


def slope_of(truth):
    """Speed across over speed along the normal, of the centres at the first impact."""
    impact = truth["impacts"][0]
    normal = np.array(impact["normal"])
    frame = max((f for f in truth["frames"] if f["t"] < impact["time"]), key=lambda f: f["t"])
    v = np.array(frame["a"]["v"])
    v = v - frame["b"]["v"] if "b" in frame else v + (impact["time"] - frame["t"]) * GRAVITY
    along = v @ normal
    return float(np.linalg.norm(v - along * normal) / -along)


def point_shot(folder, mu, c):
    """A point mass that slides on a floor at 45°, 2 m before a level camera."""
    v, at = 2.8, np.array([-0.1, 2.0, -0.5])
    before = v * np.array([1.0, 0, -1.0])
    after = before + v * (1 + c) * np.array([-mu, 0, 1])
    seen = []
    for frame in range(-30, 61):
        t = frame / FPS + 0.003
        x, y, z = at + (before if t < 0 else after) * t + 0.5 * GRAVITY * t**2
        u, w = CAMERA["cx"] + CAMERA["fx"] * x / y, CAMERA["cy"] - CAMERA["fy"] * z / y
        if z >= at[2] - 1e-9 and 0 <= u < 1280 and 0 <= w < 720:
            seen.append({"frame": frame + 30, "x": u, "y": w, "radius": CAMERA["fx"] * 0.03 / y, "label": "point"})
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "observations.json").write_text(json.dumps(seen))
    (folder / "shot.json").write_text(json.dumps({"observations": "observations.json", "fps": FPS, "camera": CAMERA, "down": [0, 1, 0],
                                                  "bodies": [{"name": "point", "size": 0.06}, {"name": "floor", "fixed": True, "normal": [0, -1, 0]}]}))


def case(bench, scene, mu, c, seed, model):
    name = f"friction-{scene}-{mu}-{c}-{'with' if model else 'without'}"
    if scene == "point":
        shot = bench.work / name / "shot"
        point_shot(shot, mu, c)
        code, seconds, result = reconstruct(shot, shot.parent / "out", {"friction": model})
        row = {"case": name, "seed": seed, **scores(code, seconds, result, c, None)}
        closed = frictionless(c, mu, 1.0, 1.0)
    else:
        spin = {} if scene == "boxes" else {"spin": 0}  # balls slip as their centres do
        synth = {"scene": scene, "fps": 60 if scene == "boxes" else FPS, "friction": mu, "restitution": c, "seed": seed} | spin
        row = simulated(bench, name, synth, {"friction": model})
        _, truth, result = files(bench, name)
        closed = None if scene == "boxes" else frictionless(c, mu, slope_of(truth), ROLLS)
    found = result["impacts"][0]["friction"] if result and result["impacts"] else None
    return row | {"scene": scene, "model": "with" if model else "without", "mu": mu, "mu_found": number(found), "closed_form": number(closed),
                  "bias": f"{float(row['c']) - c:.4f}" if row.get("c") else ""}


def say_all(rows):
    for scene in dict.fromkeys(row["scene"] for row in rows):
        for model in ("with", "without"):
            these = [row for row in rows if row["scene"] == scene and row["model"] == model]
            bias = floats(these, "bias")
            text = f"  {scene}, {model} friction: {len(these)} runs, {len(bias)} values"
            if len(bias):
                text += f"; bias of c {bias.mean():+.4f} (mean), {np.median(bias):+.4f} (median), {np.abs(bias).max():.4f} (most)"
            closed = [abs(float(row["c"]) - float(row["closed_form"])) for row in these if row.get("c") and row["closed_form"]]
            if model == "without" and closed:
                text += f"; from the closed form {np.median(closed):.4f} (median), {max(closed):.4f} (most)"
            say(text)


def friction(bench):
    """Fig. 5.10: friction 0 to 0.5 and restitution 0.2 to 0.8."""
    grids = {"point": ((0, 0.1, 0.3, 0.5), (0.4, 0.6, 0.8)), "balls": ((0, 0.1, 0.3, 0.5), (0.2, 0.4, 0.6, 0.8)),
             "ball-floor": ((0, 0.1, 0.3, 0.5), (0.6, 0.8)), "boxes": ((0, 0.25, 0.5), (0.2, 0.5, 0.8))}
    cases = [{"scene": scene, "mu": mu, "c": c, "seed": 10 * i + k + 1, "model": model}
             for scene, (mus, cs) in grids.items() for i, mu in enumerate(mus) for k, c in enumerate(cs) for model in (True, False)]
    return ["case", "scene", "model", "mu", "mu_found", "closed_form", "bias", "seed", *MEASURES], bench.run(case, cases), say_all
