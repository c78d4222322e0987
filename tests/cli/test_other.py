# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""unseen convert, synth planes and evaluate planes."""

import json
import os
import unittest

import numpy

from harness import CliTest, contents, room, write_ply

BOX = """v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 0 2.5\nv 4 0 2.5\nv 4 3 2.5\nv 0 3 2.5
f 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"""


class Convert(CliTest):
    def test_there_and_back_keeps_every_bit(self):
        self.room_file()
        for ending in ("csv", "ply"):
            self.assertTrue(numpy.array_equal(self.there_and_back(ending), room()), ending)

    def test_pcd_is_in_single_precision_as_its_programs_take_it(self):
        self.room_file()
        self.assertLess(numpy.abs(self.there_and_back("pcd") - room()).max(), 1e-6)
        self.assertIn(b"SIZE 4 4 4\nTYPE F F F\n", (self.folder / "copy.pcd").read_bytes())

    def there_and_back(self, ending):
        self.assertEqual(self.unseen("convert", "room.ply", f"copy.{ending}").returncode, 0)
        run = self.unseen("convert", f"copy.{ending}", f"back_{ending}.ply")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn(f"back_{ending}.ply", run.stdout)
        data = (self.folder / f"back_{ending}.ply").read_bytes()
        body = data[data.index(b"end_header\n") + len(b"end_header\n") :]
        return numpy.frombuffer(body, "<f8").reshape(-1, 3)

    def test_unknown_ending_and_bad_input(self):
        self.room_file()
        before = contents(self.folder)
        self.assert_one_line(self.unseen("convert", "room.ply", "room.xlsx"), 3, "room.xlsx")
        self.assert_one_line(self.unseen("convert", "none.ply", "room.pcd"), 3, "none.ply")
        self.assert_one_line(self.unseen("convert", "room.ply", "/dev/null/room.pcd"), 3, "/dev/null/room.pcd")
        self.assertEqual(contents(self.folder), before)

    def test_reads_nothing_that_it_replaces(self):
        self.room_file()
        (self.folder / "link.ply").symlink_to("room.ply")
        (self.folder / "tiles").mkdir()
        (self.folder / "tiles/a.xyz").write_text("1 2 3\n4 5 6\n")
        before = contents(self.folder)
        self.assert_one_line(self.unseen("convert", "room.ply", "room.ply"), 2, "room.ply", "the same file as IN")
        os.link(self.folder / "room.ply", self.folder / "twin.ply")
        self.assert_one_line(self.unseen("convert", "twin.ply", "room.ply"), 2, "room.ply", "the same file as IN")
        os.remove(self.folder / "twin.ply")
        self.assert_one_line(self.unseen("convert", "link.ply", "room.ply"), 2, "room.ply", "the same file as IN")
        self.assert_one_line(self.unseen("convert", "tiles", "tiles/a.xyz"), 2, "tiles/a.xyz", "lies in the folder IN")
        self.assert_one_line(self.unseen("convert", "tiles", "tiles/all.xyz"), 2, "tiles/all.xyz", "lies in the folder IN")
        self.assertEqual(contents(self.folder), before)

    def test_no_points_are_no_cloud(self):
        (self.folder / "none.ptx").write_text("1\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n0 0 0 0.5\n")
        self.assert_one_line(self.unseen("convert", "none.ptx", "none.ply"), 3, "none.ptx", "no points")
        self.assertFalse((self.folder / "none.ply").exists())


class Evaluate(CliTest):
    def setUp(self):
        super().setUp()
        self.room_file()
        run = self.unseen("planes", "room.ply", "-o", "out")
        self.assertEqual(run.returncode, 0, run.stderr)
        (self.folder / "box.obj").write_text(BOX)

    def evaluation(self, truth, *more):
        run = self.unseen("evaluate", "planes", "out", "--truth", truth, *more)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads((self.folder / "out/evaluation.json").read_text()), run

    def test_against_the_mesh(self):
        before = contents(self.folder / "out")
        score, run = self.evaluation("box.obj")
        self.assertEqual(score["truth"]["kind"], "mesh")
        self.assertEqual(score["angles"]["points"], 8000)
        self.assertLess(score["angles"]["as_assigned"]["angles"]["median_deg"], 0.1)
        self.assertGreater(score["angles"]["nearest"]["recall"], 0.99)
        self.assertEqual(score["relations"]["planes"], 6)
        self.assertLess(score["relations"]["largest_error_deg"], 0.01)
        self.assertIn("recall", run.stdout)
        self.assertEqual(len({len(line) for line in run.stdout.splitlines() if "angle error" in line}), 1)
        after = contents(self.folder / "out")
        after.pop("evaluation.json")
        self.assertEqual(after, before)

    def test_against_itself(self):
        score, _ = self.evaluation("out")
        self.assertEqual(score["truth"]["kind"], "result")
        self.assertEqual(score["angles"]["as_assigned"]["angles"]["mean_deg"], 0)
        self.assertEqual(score["angles"]["as_assigned"]["recall"], 1)

    def test_against_labels(self):
        points = room()
        walls = numpy.stack([points[:, 0], points[:, 1], points[:, 2], 4 - points[:, 0], 3 - points[:, 1],
                             2.5 - points[:, 2]], 1)
        labels = numpy.abs(walls).argmin(1)
        rows = [f"{x!r},{y!r},{z!r},{label}" for (x, y, z), label in zip(points.tolist(), labels)]
        (self.folder / "truth.csv").write_text("x,y,z,label\n" + "\n".join(rows) + "\n")
        score, run = self.evaluation("truth.csv")
        self.assertEqual(score["truth"]["kind"], "labels")
        self.assertEqual((score["segments"]["labels"], score["segments"]["correct"]), (6, 6))
        self.assertEqual(score["segments"]["f1"], 1)
        self.assertIn("F1", run.stdout)

    def test_next_result_takes_the_score_of_the_last_away(self):
        self.evaluation("box.obj")
        self.evaluation("box.obj")
        (self.folder / "out/notes.txt").write_text("mine")
        self.assertEqual(self.unseen("planes", "room.ply", "-o", "out").returncode, 0)
        self.assertFalse((self.folder / "out/evaluation.json").exists())
        self.assertEqual((self.folder / "out/notes.txt").read_text(), "mine")

    def test_json_is_the_file(self):
        score, run = self.evaluation("box.obj", "--json", "--pairs", "1000", "--scale", "0.03")
        self.assertEqual(json.loads(run.stdout), score)
        self.assertEqual(score["scale"], 0.03)
        self.assertEqual(score["angles"]["as_assigned"]["angles"]["pairs"], 1000)

    def test_what_cannot_be_compared(self):
        self.assert_one_line(self.unseen("evaluate", "planes", "none", "--truth", "box.obj"), 3, "none")
        self.assert_one_line(self.unseen("evaluate", "planes", "out", "--truth", "none.obj"), 3, "none.obj")
        self.assert_one_line(self.unseen("evaluate", "planes", "out", "--truth", "room.ply"), 3, "room.ply", "label")
        write_ply(self.folder / "few.ply", room()[:7000])
        self.assertEqual(self.unseen("planes", "few.ply", "-o", "few").returncode, 0)
        self.assert_one_line(self.unseen("evaluate", "planes", "out", "--truth", "few"), 3, "few", "8000")
        self.assertFalse((self.folder / "out/evaluation.json").exists())

    def test_broken_result(self):
        path = self.folder / "out/result.json"
        text = path.read_text()
        path.write_text(text[: len(text) // 2])
        self.assert_one_line(self.unseen("evaluate", "planes", "out", "--truth", "box.obj"), 3, "result.json")
        path.write_text("[" * 1000000)
        self.assert_one_line(self.unseen("evaluate", "planes", "out", "--truth", "box.obj"), 3, "result.json")


class Synth(CliTest):
    def test_scene_with_truth(self):
        run = self.unseen("synth", "planes", "-o", "scene", "--points", "20000", "--seed", "3")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(set(contents(self.folder / "scene")), {"cloud.ply", "truth.obj", "truth.json"})
        truth = json.loads((self.folder / "scene/truth.json").read_text())
        self.assertEqual(truth["points"], 20000)
        self.assertEqual(truth["options"]["seed"], 3)
        for plane in truth["planes"]:
            axes = numpy.array(truth["frames"][plane["frame"]]["axes"])
            self.assertAlmostEqual(numpy.abs(axes @ plane["normal"]).max(), 1, 9)
        self.assertIn("planes", run.stdout)

    def test_is_found_again(self):
        self.unseen("synth", "planes", "-o", "scene", "--points", "60000")
        run = self.unseen("planes", "scene/cloud.ply", "-o", "out", "--scale", "0.05")
        self.assertEqual(run.returncode, 0, run.stderr)
        for truth in ("scene/truth.obj", "scene/cloud.ply"):
            run = self.unseen("evaluate", "planes", "out", "--truth", truth)
            self.assertEqual(run.returncode, 0, run.stderr)
        score = json.loads((self.folder / "out/evaluation.json").read_text())
        self.assertEqual(score["truth"]["kind"], "labels")
        self.assertGreater(score["segments"]["correct"], 0)

    def test_same_seed_same_bytes(self):
        for name, seed, threads in (("a", 5, 1), ("b", 5, 2), ("c", 6, 2)):
            self.unseen("synth", "planes", "-o", name, "--points", "5000", "--seed", seed, "--threads", threads)
        a, b, c = (contents(self.folder / name) for name in "abc")
        self.assertEqual(a, b)
        self.assertNotEqual(a["cloud.ply"], c["cloud.ply"])

    def test_bad_options(self):
        for flag, value in (("--scene", "castle"), ("--points", "-5"), ("--noise", "nan")):
            self.assert_one_line(self.unseen("synth", "planes", "-o", "scene", flag, value), 2, flag[2:], value)
        self.assert_one_line(self.unseen("synth", "planes", "-o", "/dev/null/scene", "--points", "5000"), 3, "/dev/null")
        self.assertEqual(contents(self.folder), {})


if __name__ == "__main__":
    unittest.main()
