# SPDX-License-Identifier: MIT
# Films of simulated collisions, from the video to all values with nothing annotated.
import sys

from collision.common import MEASURES, filmed

MOST = {"c_error": 0.08, "m_error": 0.08, "time_frames": 0.5, "rotation_deg": 8}


def films(bench):
    """All kinds of scenes with two seeds, and those of two bodies with a curtain before the impact."""
    cases = []
    for scene in ("boxes", "box-ball", "balls", "offcentre", "mesh", "spin", "planar", "box-floor", "ball-floor"):
        for seed in (41, 42):
            cases.append({"name": f"films-{scene}-{seed}", "synth": {"scene": scene, "seed": seed}, "scene": scene, "curtain": 0})
    for scene in ("boxes", "box-ball", "balls", "offcentre", "mesh", "ball-floor"):
        for seed in (43, 44):
            cases.append({"name": f"films-curtain-{scene}-{seed}", "synth": {"scene": scene, "seed": seed, "curtain": True}, "scene": scene, "curtain": 1})

    def say(rows):
        for curtain in (0, 1):
            some = [row for row in rows if row["curtain"] == curtain]
            good = sum(row["given"] == 1 and all(row.get(name, "") in ("", None) or float(row[name]) < most for name, most in MOST.items()) for row in some)
            held = sum(row.get("c_in") == 1 for row in some)
            print(f"{'with' if curtain else 'without'} a curtain: {good} of {len(some)} within {MOST}; the interval of c holds in {held}", file=sys.stderr)

    return ["case", "scene", "curtain", "seed", *MEASURES], bench.run(filmed, cases), say
