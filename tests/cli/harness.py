# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""What the tests of the command line share. The program is named by the environment variable UNSEEN."""

import json
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest

import numpy

PROGRAM = os.environ["UNSEEN"]
SOURCE = pathlib.Path(os.environ["UNSEEN_SOURCE_DIR"])


def room(count=8000, seed=1, size=(4.0, 3.0, 2.5), noise=0.002):
    """Points (count×3, m) on the floor, the ceiling and the four walls of a box."""
    random = numpy.random.default_rng(seed)
    points = random.uniform(0, 1, (count, 3)) * size
    side = random.integers(0, 6, count)
    axis = side % 3
    points[numpy.arange(count), axis] = (side // 3) * numpy.asarray(size)[axis]
    return points + random.normal(0, noise, (count, 3))


def write_ply(path, points, normals=None):
    columns = points if normals is None else numpy.hstack([points, normals])
    names = ["x", "y", "z", "nx", "ny", "nz"][: columns.shape[1]]
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
    header += "".join(f"property double {name}\n" for name in names) + "end_header\n"
    pathlib.Path(path).write_bytes(header.encode() + numpy.asarray(columns, "<f8").tobytes())


def read_points_ply(path):
    """points.ply as a structured array x, y, z, plane, frame."""
    data = pathlib.Path(path).read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    layout = numpy.dtype([("x", "<f8"), ("y", "<f8"), ("z", "<f8"), ("plane", "<i4"), ("frame", "<i4")])
    return numpy.frombuffer(data[end:], layout)


def glb_json(path):
    data = pathlib.Path(path).read_bytes()
    magic, version, length, chunk = struct.unpack("<4sIII", data[:16])
    assert magic == b"glTF" and version == 2 and length == len(data)
    return json.loads(data[20 : 20 + chunk])


def contents(folder):
    """Name and bytes of every file below a folder, but for the hidden list of what is ours."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*"))
            if p.is_file() and p.name != ".unseen-files"}


class CliTest(unittest.TestCase):
    """Runs the program in a folder of its own."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def unseen(self, *arguments, timeout=300, cwd=None, **more):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd or self.folder, capture_output=True, text=True,
                              timeout=timeout, **more)

    def room_file(self, name="room.ply", **more):
        write_ply(self.folder / name, room(**more))
        return name

    def assert_one_line(self, run, code, *words):
        """The run failed with this code and one line on standard error that holds the words."""
        self.assertEqual(run.returncode, code, run.stderr)
        self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
        self.assertTrue(run.stderr.startswith("unseen: "), run.stderr)
        self.assertEqual(run.stdout, "")
        for word in words:
            self.assertIn(word, run.stderr)
