# SPDX-License-Identifier: MIT
# Poses of results and truths in the camera's coordinates, and how far they are from each other.
import numpy as np


def product(p, q):
    """Of quaternions [w,x,y,z]."""
    a, b, c, d = p
    e, f, g, h = q
    return np.array([a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e])


def inverse(q):
    return np.array(q) * [1, -1, -1, -1]


def angle(p, q):
    """Between two rotations, rad."""
    return 2 * np.arccos(min(1.0, abs(float(np.dot(p, q)))))


def matrix(q):
    return np.array([product(product(q, [0, *axis]), inverse(q))[1:] for axis in np.eye(3)]).T


def quaternion(r):
    """Of a rotation matrix; from its largest component."""
    t = np.array([r.trace(), *r.diagonal()])
    i = int(np.argmax(t))
    if i == 0:
        q = np.array([1 + t[0], r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    else:
        j, k = i % 3 + 1, (i + 1) % 3 + 1
        q = np.zeros(4)
        q[0], q[i] = r[k - 1, j - 1] - r[j - 1, k - 1], 1 + 2 * r[i - 1, i - 1] - t[0]
        q[j], q[k] = r[j - 1, i - 1] + r[i - 1, j - 1], r[k - 1, i - 1] + r[i - 1, k - 1]
    return q / np.linalg.norm(q)


def slerp(p, q, share):
    if np.dot(p, q) < 0:
        q = -q
    half = np.arccos(min(1.0, float(np.dot(p, q))))
    if half < 1e-9:
        return p
    return (np.sin((1 - share) * half) * p + np.sin(share * half) * q) / np.sin(half)


def poses(file, body):
    """{frame: (p, q)} of body "a" or "b" in the camera's coordinates."""
    T = np.array(file["T_world_camera"])
    turn = quaternion(T[:3, :3].T)
    seen = {}
    for frame in file["frames"]:
        if body in frame:
            p = T[:3, :3].T @ (np.array(frame[body]["p"]) - T[:3, 3])
            seen[frame["frame"]] = (p, product(turn, frame[body]["q"]))
    return seen


def half_turns(shape):
    """Rotations that map a box of three different edges to itself; one for other bodies."""
    return list(np.eye(4)) if "box" in shape else [np.array([1.0, 0, 0, 0])]


def turned(p, q, symmetries):
    """Smallest angle between two rotations of a body, rad."""
    return min(angle(p, product(q, s)) for s in symmetries)


def after_impact(truth, result):
    """Fastest true spin of the two after the impact, rad/s, and the larger RMS of their rotations after it (deg; none without a result)."""
    spins, errors = [], []
    for name, body in zip("ab", truth["bodies"]):
        if body.get("fixed") or "sphere" in body:
            continue
        true = {f: pose for f, pose in poses(truth, name).items() if f > truth["impacts"][0]["frame"]}
        steps = [angle(true[f][1], true[f + 1][1]) for f in true if f + 1 in true]
        spins.append(np.mean(steps) * truth["fps"])
        if result:
            found = poses(result, name)
            off = [turned(true[f][1], found[f][1], half_turns(body)) for f in true if f in found]
            errors.append(np.degrees(np.sqrt(np.mean(np.square(off)))) if off else 180.0)
    return max(spins), max(errors) if errors else None
