# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""unseen synth collision: what it writes, and the options that it refuses."""

import json
import unittest

import numpy

from harness import CliTest, contents


class SynthCollision(CliTest):
    def synth(self, *more, out="out"):
        run = self.unseen("synth", "collision", "-o", out, *more)
        self.assertEqual(run.returncode, 0, run.stderr)
        return self.folder / out

    def test_tracks_are_where_the_truth_projects(self):
        out = self.synth("--scene", "mesh", "--video=false", "--seed", "2")
        self.assertEqual(set(contents(out)), {"shot.json", "truth.json", "observations.json", "red.obj", "blue.obj"})
        truth, shot = (json.loads((out / name).read_text()) for name in ("truth.json", "shot.json"))
        self.assertEqual(truth["options"]["scene"], "mesh")
        T = numpy.linalg.inv(numpy.array(truth["T_world_camera"]))
        camera = shot["camera"]
        for seen in json.loads((out / shot["observations"]).read_text()):
            body = "a" if seen["label"] == shot["bodies"][0]["name"] else "b"
            x, y, z = (T @ [*truth["frames"][seen["frame"]][body]["p"], 1])[:3]
            self.assertAlmostEqual(seen["x"], camera["fx"] * x / z + camera["cx"], 6)
            self.assertAlmostEqual(seen["y"], camera["fy"] * y / z + camera["cy"], 6)

    def test_the_same_seed_gives_the_same_video(self):
        size = ("--scene", "ball-floor", "--width", "320", "--height", "180", "--fps", "30")
        one, same = self.synth(*size), self.synth(*size, "--threads", "1", out="same")
        self.assertEqual(set(contents(one)), {"shot.json", "truth.json", "shot.mp4"})
        for name in contents(one):
            self.assertEqual((one / name).read_bytes(), (same / name).read_bytes(), name)

    def test_refuses_what_a_scene_does_not_have(self):
        run = self.unseen("synth", "collision", "-o", "out", "--scene", "ball-floor", "--mass-ratio", "2")
        self.assertEqual(run.returncode, 3)
        self.assertIn("mass_ratio", run.stderr)
        run = self.unseen("synth", "collision", "-o", "out", "--scene", "cars")
        self.assertEqual(run.returncode, 2)
        self.assertIn("boxes", run.stderr)
        self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
