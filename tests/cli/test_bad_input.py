# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""Input that cannot be used: exit code 3, one line, nothing written, and an earlier result stays."""

import json
import subprocess
import unittest
import zlib

import numpy

from harness import PROGRAM, CliTest, contents, room, write_ply

HEADER = "ply\nformat {}\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nend_header\n"


def png():
    """A grey 8×8 image."""
    def chunk(kind, data):
        body = kind + data
        return len(data).to_bytes(4, "big") + body + zlib.crc32(body).to_bytes(4, "big")

    rows = b"".join(b"\0" + bytes(range(0, 240, 30)) for _ in range(8))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", bytes([0, 0, 0, 8, 0, 0, 0, 8, 8, 0, 0, 0, 0]))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class BadInput(CliTest):
    def setUp(self):
        super().setUp()
        (self.folder / "out").mkdir()
        (self.folder / "out/result.json").write_text("an earlier result")

    def assert_refused(self, name, *words, arguments=(), code=3):
        before = contents(self.folder)
        run = self.unseen("planes", name, "-o", "out", *arguments, timeout=60)
        self.assert_one_line(run, code, *words)
        self.assertEqual(contents(self.folder), before)

    def write(self, name, data):
        (self.folder / name).write_bytes(data if isinstance(data, bytes) else data.encode())
        return name

    def test_a_video_in_the_place_of_a_shot(self):
        (self.folder / "clip.mp4").write_bytes(b"\0\0\0\x20ftypisom" + bytes(range(256)))
        for command in ("collision", "cuboids", "interactions"):
            self.assert_one_line(self.unseen(command, "clip.mp4", "-o", "out"), 3, "clip.mp4")
        self.assertIn("no text", self.unseen("collision", "clip.mp4", "-o", "out").stderr)

    def test_two_scales(self):
        self.assert_one_line(self.unseen("planes", self.room_file(), "--scale", "0.1", "--relative-scale", "0.01", "-o", "out"), 3, "relative_scale", "one of the two")

    def test_no_such_file(self):
        self.assert_refused("none.ply", "none.ply")

    def test_empty_file(self):
        self.assert_refused(self.write("empty.ply", b""), "empty.ply")
        self.assert_refused(self.write("empty.xyz", b""), "empty.xyz")

    def test_header_only(self):
        self.assert_refused(self.write("header.ply", HEADER.format("ascii 1.0", 0)), "header.ply")
        self.assert_refused(self.write("half.ply", "ply\nformat ascii 1.0\nelement vert"), "half.ply")

    def test_truncated(self):
        write_ply(self.folder / "whole.ply", room())
        whole = (self.folder / "whole.ply").read_bytes()
        self.assert_refused(self.write("cut.ply", whole[: len(whole) // 2]), "cut.ply")
        self.assert_refused(self.write("cut_text.ply", HEADER.format("ascii 1.0", 3) + "0 0 0\n1 0"), "cut_text.ply")

    def test_counts_of_a_billion(self):
        for kind in ("ascii 1.0", "binary_little_endian 1.0", "binary_big_endian 1.0"):
            for count in (10**9, 2**63, 10**30):
                self.assert_refused(self.write("vast.ply", HEADER.format(kind, count) + "0 0 0\n"), "vast.ply")
        self.assert_refused(self.write("vast.pcd", "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
                                       "WIDTH 1000000000\nHEIGHT 1\nPOINTS 1000000000\nDATA binary\nabcd"),
                            "vast.pcd")

    def test_nothing_finite(self):
        write_ply(self.folder / "nan.ply", numpy.full((100, 3), numpy.nan))
        self.assert_refused("nan.ply", "nan.ply")
        write_ply(self.folder / "inf.ply", numpy.full((100, 3), numpy.inf))
        self.assert_refused("inf.ply", "inf.ply")

    def test_too_little_to_span_anything(self):
        write_ply(self.folder / "one.ply", numpy.zeros((1, 3)))
        self.assert_refused("one.ply", "one.ply")
        write_ply(self.folder / "same.ply", numpy.full((500, 3), 1.5))
        self.assert_refused("same.ply", "same.ply")
        along = numpy.linspace(0, 1, 500)[:, None]
        write_ply(self.folder / "line.ply", along * [[1.0, 2.0, 3.0]])
        self.assert_refused("line.ply", "line.ply")

    def test_picture_renamed(self):
        self.assert_refused(self.write("picture.ply", png()), "picture.ply")

    def test_random_bytes(self):
        data = numpy.random.default_rng(5).integers(0, 256, 4096, dtype=numpy.uint8).tobytes()
        for name in ("noise.ply", "noise.pcd", "noise.las", "noise.png", "noise.obj", "noise.xyz"):
            self.assert_refused(self.write(name, data), name)

    def test_folder_with_nothing_usable(self):
        (self.folder / "tiles").mkdir()
        self.assert_refused("tiles", "tiles")
        self.write("tiles/a.ply", b"")
        self.write("tiles/b.txt", "no points here\n")
        self.assert_refused("tiles", "tiles")

    def test_scale_larger_than_the_scene(self):
        self.room_file()
        self.assert_refused("room.ply", "scale", arguments=("--scale", "1000"))

    def test_unwritable_output(self):
        self.room_file()
        before = contents(self.folder)
        self.write("file", "not a folder")
        for out in ("file", "file/below", "/proc/unseen-out", "/dev/null/out"):
            with self.subTest(out=out):
                self.assert_one_line(self.unseen("planes", "room.ply", "-o", out), 3, out)
        (self.folder / "file").unlink()
        self.assertEqual(contents(self.folder), before)

    def test_standard_output_without_room(self):
        self.room_file()
        with open("/dev/full", "w") as full:
            for arguments in (["planes", "room.ply", "-o", "new", "--json"], ["--help"], ["planes", "--help"], ["--version"]):
                run = subprocess.run([PROGRAM, *arguments], cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
                self.assertEqual(run.returncode, 3, arguments)
                self.assertIn("standard output", run.stderr)

    def test_result_of_another_kind(self):
        self.write("truth.json", "[" * 100000)
        self.assert_one_line(self.unseen("evaluate", "planes", "out", "--truth", "truth.json"), 3, "result.json")


class ImperfectInput(CliTest):
    def summary(self, name, *more):
        run = self.unseen("planes", name, "-o", "out", *more)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads((self.folder / "out/result.json").read_text()), run

    def test_some_points_not_finite(self):
        points = room()
        points[::100] = numpy.nan
        points[1::100, 2] = numpy.inf
        write_ply(self.folder / "holes.ply", points)
        result, _ = self.summary("holes.ply")
        self.assertEqual(len(result["planes"]), 6)
        self.assertEqual(result["summary"]["counts"]["points"], 8000)
        self.assertEqual(result["summary"]["counts"]["finite"], 8000 - 160)

    def test_zero_normals(self):
        write_ply(self.folder / "zero.ply", room(), numpy.zeros((8000, 3)))
        result, _ = self.summary("zero.ply")
        self.assertEqual(len(result["planes"]), 6)
        self.assertTrue(any("normal" in warning for warning in result["summary"]["warnings"]))

    def test_folder_with_some_usable_tiles(self):
        tiles = self.folder / "tiles"
        tiles.mkdir()
        points = room()
        write_ply(tiles / "a.ply", points[:4000])
        write_ply(tiles / "d.ply", points[4000:])
        (tiles / "b.ply").write_bytes(b"")
        (tiles / "c.ply").write_bytes(png())
        result, run = self.summary("tiles")
        self.assertEqual(len(result["planes"]), 6)
        for bad in ("b.ply", "c.ply"):
            self.assertEqual(sum(bad in warning for warning in result["summary"]["warnings"]), 1)
            self.assertEqual(sum(bad in line for line in run.stderr.splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
