# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""What the tests of the exchange formats share: results to read back, and the palette."""

import json
import pathlib
import sys
import tempfile

import numpy

from harness import CliTest, room, write_ply

UTM = numpy.array([500000.0, 5400000.0, 300.0])  # m
KINDS = ("room", "utm", "window", "plan")


def skip_module(reason):
    """Ends this test program with the code that CTest shows as skipped."""
    print(f"skipped: {reason}", file=sys.stderr)
    sys.exit(77)


def turned(degrees):
    """Rotation about z."""
    cos, sin = numpy.cos(numpy.radians(degrees)), numpy.sin(numpy.radians(degrees))
    return numpy.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]])


def window():
    """A wall of 4 m × 2.5 m, turned by 30°, with a window of 1.2 m × 1 m, on a floor with a board of 2 m × 1 m that
    stands askew by 20° (points, m)."""
    random = numpy.random.default_rng(5)
    wall = random.uniform((0, -0.002, 0), (4, 0.002, 2.5), (20000, 3))
    in_window = (abs(wall[:, 0] - 2) < 0.6) & (abs(wall[:, 2] - 1.4) < 0.5)
    floor = random.uniform((0, 0, -0.002), (4, 3, 0.002), (20000, 3))
    board = random.uniform((0, -0.002, 0), (2, 0.002, 1), (8000, 3)) @ turned(20).T + (1, 1.5, 0)
    return numpy.vstack([wall[~in_window], floor, board]) @ turned(30).T


def palette(out):
    """sRGB colours, 0…1, of the frames as planes.mtl has them."""
    lines = (out / "planes.mtl").read_text().splitlines()
    return numpy.array([[float(c) for c in line.split()[1:]] for line in lines if line.startswith("Kd ")])


def linear(srgb):
    srgb = numpy.asarray(srgb)
    return numpy.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def outline(plane):
    """Every vertex of a plane of result.json (n×3)."""
    return numpy.array(plane["segment"] if plane.get("segment") else sum(plane["polygon"], []))


class ExchangeTest(CliTest):
    """Results of a room, the same in UTM coordinates, a wall with a window, and a floor plan, made once."""

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        runner = cls()
        runner.folder = pathlib.Path(temporary.name)
        write_ply(runner.folder / "room.ply", room())
        write_ply(runner.folder / "utm.ply", room() + UTM)
        write_ply(runner.folder / "window.ply", window())
        runner.unseen("synth", "planes", "--scene", "floorplan", "--points", 20000, "-o", "synth", "--quiet")
        (runner.folder / "synth/cloud.ply").rename(runner.folder / "plan.ply")
        cls.out = {}
        for kind in KINDS:
            run = runner.unseen("planes", f"{kind}.ply", "-o", kind, "--quiet")
            assert run.returncode == 0, run.stderr
            cls.out[kind] = runner.folder / kind
        cls.result = {kind: json.loads((out / "result.json").read_text()) for kind, out in cls.out.items()}
