# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""unseen collision, evaluate and view: from a shot to a value, and what a bad shot says."""

import json
import unittest

from harness import CliTest, contents
from scene import scenes_of


class Collision(CliTest):
    def bounce(self, *more):
        run = self.unseen("synth", "collision", "-o", "shot", "--scene", "ball-floor", "--video=false", "--seed", "3", *more)
        self.assertEqual(run.returncode, 0, run.stderr)
        return "shot/shot.json"

    def test_a_bouncing_ball_gives_its_restitution(self):
        shot = self.bounce()
        run = self.unseen("collision", shot, "-o", "out")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(set(contents(self.folder / "out")), {"result.json", "report.html", "scene.glb"})
        truth = json.loads((self.folder / "shot/truth.json").read_text())
        result = json.loads((self.folder / "out/result.json").read_text())
        self.assertAlmostEqual(result["restitution"]["value"], truth["restitution"]["value"], delta=0.02)
        run = self.unseen("evaluate", "collision", "out", "--truth", "shot/truth.json")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue((self.folder / "out/evaluation.json").exists())
        self.assertEqual(self.unseen("view", "out").returncode, 0)

    def test_a_flight_without_a_collision_is_no_solution(self):
        shot = self.bounce()
        data = json.loads((self.folder / shot).read_text())
        truth = json.loads((self.folder / "shot/truth.json").read_text())
        data["frames"] = [0, int(truth["impacts"][0]["frame"]) - 2]
        (self.folder / "shot/short.json").write_text(json.dumps(data))
        run = self.unseen("collision", "shot/short.json", "-o", "out")
        self.assertEqual(run.returncode, 4, run.stderr)
        self.assertIn("no collision", run.stderr + run.stdout)
        self.assertEqual(json.loads((self.folder / "out/result.json").read_text())["impacts"], [])
        page, = scenes_of(self.folder / "out/report.html")
        self.assertEqual(page.header["verdict"], "no collision was found")
        self.assertNotIn("Bodies at the impact", [table["title"] for table in page.header["tables"]])

    def test_what_the_model_does_not_explain_is_shown_as_no_impact(self):
        run = self.unseen("synth", "collision", "-o", "shot", "--scene", "flight", "--video=false", "--seed", "7")
        self.assertEqual(run.returncode, 0, run.stderr)
        run = self.unseen("collision", "shot/shot.json", "-o", "out")
        self.assertEqual(run.returncode, 4, run.stderr)
        self.assertFalse(json.loads((self.folder / "out/result.json").read_text())["fits"])
        self.assertIn("does not explain the impact", run.stdout)
        self.assertNotIn("kinetic energy", run.stdout)
        page, = scenes_of(self.folder / "out/report.html")
        self.assertEqual(page.header["verdict"], "no value of the restitution can be relied on")
        self.assertNotIn("impulses", [s["id"] for s in page.header["structures"]])
        titles = [table["title"] for table in page.header["tables"]]
        self.assertNotIn("Impacts", titles)
        self.assertNotIn("Bodies at the impact", titles)
        self.assertNotIn("kinetic energy kept", [fact["name"] for fact in page.header["facts"]])

    def test_what_is_no_video_is_bad_input(self):
        (self.folder / "junk.mp4").write_text("junk")
        bodies = [{"name": "ball", "sphere": 0.1}, {"name": "floor", "fixed": True}]
        (self.folder / "junk.json").write_text(json.dumps({"video": "junk.mp4", "bodies": bodies}))
        run = self.unseen("collision", "junk.json", "-o", "out")
        self.assertEqual(run.returncode, 3)
        self.assertEqual(len(run.stderr.strip().splitlines()), 1)
        self.assertIn("junk.mp4", run.stderr)
        self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
