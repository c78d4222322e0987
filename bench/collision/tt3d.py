# SPDX-License-Identifier: MIT
# Table-tennis balls that bounce once, from a single calibrated view: 2D tracks of TT3D against its 3D data.
import json
import sys

import numpy as np

from collision.common import MEASURES, floats, reconstruct, scores, summary

RADIUS = 0.02    # m
MASS = 0.0027    # kg
WINDOW = 0.16    # s on each side of the bounce that the 3D data's restitution is taken from
GRAVITY = 9.81
FPS = 25
LEAST_AFTER = 4  # sightings after the bounce
VIEWS = ("side", "oblique", "back")


def table(path):
    return np.genfromtxt(path, delimiter=",", names=True)


def points(rows):
    return np.c_[rows["X"], rows["Y"], rows["Z"]]


def camera_of(path):
    """Intrinsics, and X_camera = R X_table + t."""
    values = {}
    for line in path.read_text().splitlines():
        key, _, text = line.partition(":")
        if text:
            values[key.strip()] = json.loads(text)
    turn = np.array(values["rvec"])
    size = np.linalg.norm(turn)
    x, y, z = turn / size
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    R = np.eye(3) + np.sin(size) * cross + (1 - np.cos(size)) * cross @ cross
    camera = {"fx": values["f"], "fy": values["f"], "cx": values["w"] / 2, "cy": values["h"] / 2, "width": values["w"], "height": values["h"]}
    return camera, R, np.array(values["tvec"])


def bounce(time, height, bent):
    """Time and restitution of the lowest point's bounce: parabolas before and after it. `bent`: with a free curvature, which takes in drag and
    lift near the bounce; else with gravity's."""
    lowest = time[np.argmin(height)]
    near = lambda side: (side > 1e-3) & (side < WINDOW)  # noqa: E731
    fits = []
    for sign in (-1, 1):
        use = near(sign * (time - lowest))
        t, z = time[use] - lowest, height[use]
        fits.append(np.polyfit(t, z, 2) if bent else np.r_[-GRAVITY / 2, np.polyfit(t, z + GRAVITY / 2 * t**2, 1)])
    roots = np.roots(np.trim_zeros(fits[1] - fits[0], "f"))
    at = min(roots[np.isreal(roots)].real, key=abs, default=0.0)
    down, up = (np.polyval(np.polyder(fit), at) for fit in fits)
    return lowest + at, -up / down


def write_shot(folder, data, view, track):
    """SHOT.json and its sightings: camera, down and the table are known, the ball's size in the picture is not."""
    camera, R, t = camera_of(data / f"{view}.yaml")
    up = R[:, 2]
    folder.mkdir(parents=True, exist_ok=True)
    seen = [{"frame": round(row["Timestamp"] * FPS), "x": row["u"], "y": row["v"], "label": "ball"} for row in track]
    (folder / "observations.json").write_text(json.dumps(seen))
    (folder / "shot.json").write_text(json.dumps({
        "observations": "observations.json", "fps": FPS, "camera": camera, "down": list(-up), "floor": {"normal": list(up), "offset": float(up @ t)},
        "bodies": [{"name": "ball", "sphere": RADIUS, "mass": MASS}, {"name": "table", "fixed": True, "normal": list(up)}]}))
    return points(track) @ R.T + t


def distance(result, true):
    """RMS between the centres and the true ones in the camera's coordinates, m, over the frames that the result has."""
    T = np.array(result["T_world_camera"])
    off = [T[:3, :3].T @ (np.array(f["a"]["p"]) - T[:3, 3]) - true[f["frame"]] for f in result["frames"] if "a" in f and f["frame"] in true]
    return np.sqrt(np.mean(np.sum(np.square(off), 1))) if off else None


def case(bench, view, noisy, drag, number):
    data = bench.data / "collision/tt3d"
    truth = table(data / f"3D_gt/{number}.csv")
    time = truth["Timestamp"] - truth["Timestamp"][0]
    at, c_true = bounce(time, truth["Z"], True)
    _, c_plain = bounce(time, truth["Z"], False)
    track = table(data / (view if noisy else f"{view}_no_noise") / f"{number}.csv")
    after = int((track["Timestamp"] > at).sum())
    name = f"tt3d-{view}-{'noisy' if noisy else 'exact'}-{drag}-{number}"
    true = write_shot(bench.work / name / "shot", data, view, track)
    code, seconds, result = reconstruct(bench.work / name / "shot", bench.work / name / "out", {"drag": drag})
    row = {"case": name, "view": view, "noisy": int(noisy), "drag": drag, "track": number, "before": len(track) - after, "after": after,
           "c_no_drag": f"{c_plain:.4f}", **scores(code, seconds, result, c_true, None)}
    if result:
        rms = distance(result, dict(enumerate(true)))
        row["rms_m"] = "" if rms is None else f"{rms:.4f}"
        if result["impacts"]:
            row["time_frames"] = f"{abs(result['impacts'][0]['time'] - at) * FPS:.3f}"
    return row


def usable(data):
    """Numbers of the tracks with enough sightings after the bounce."""
    for path in sorted((data / "3D_gt").glob("*.csv")):
        truth, track = table(path), table(data / "side_no_noise" / path.name)
        at, _ = bounce(truth["Timestamp"] - truth["Timestamp"][0], truth["Z"], True)
        if (track["Timestamp"] > at).sum() >= LEAST_AFTER:
            yield path.stem


def say_all(rows):
    kind = lambda row: f"{row['view']}, {'noisy' if row['noisy'] else 'exact'}, drag {row['drag']}"  # noqa: E731
    for one in dict.fromkeys(map(kind, rows)):
        these = [row for row in rows if kind(row) == one]
        rms = floats(these, "rms_m")
        text = f"; 3D RMS {100 * np.median(rms):.1f} cm (median)" if len(rms) else ""
        print("  " + summary(these, one) + text, file=sys.stderr)


def tt3d(bench):
    """With c_true from the 3D data, drag and lift taken in; c_no_drag is what parabolas under gravity alone make of the same data. A light
    ball at 5 to 10 m/s: without drag in the model c comes out too low."""
    data = bench.data / "collision/tt3d"
    fields = ["case", "view", "noisy", "drag", "track", "before", "after", "c_no_drag", "rms_m", *MEASURES]
    if not data.is_dir():
        print(f"tt3d: skipped, there is no {data}", file=sys.stderr)
        return fields, [], say_all
    numbers = list(usable(data))
    kinds = [(True, "on"), (False, "on"), (True, "off")]
    cases = [{"view": view, "noisy": noisy, "drag": drag, "number": number} for noisy, drag in kinds for view in VIEWS for number in numbers]
    return fields, bench.run(case, cases), say_all
