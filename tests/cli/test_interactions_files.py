# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""unseen interactions: the files it writes, that they agree, and what it says to input that it cannot use."""

import json
import unittest

import numpy

from harness import CliTest, glb_json
from scene import scenes_of


class Interactions(CliTest):
    def setUp(self):
        super().setUp()
        run = self.unseen("synth", "interactions", "-o", "room", "--seconds", "12", "--seed", "4", "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)

    def solve(self, *more, out="out"):
        run = self.unseen("interactions", "room/take.json", "-o", out, *more)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        return self.folder / out, run

    def test_the_files_agree(self):
        run = self.unseen("synth", "interactions", "-o", "room", "--seconds", "12", "--seed", "2", "--quiet")  # somebody sits on a couch, whose seat is not its middle
        self.assertEqual(run.returncode, 0, run.stderr)
        out, run = self.solve()
        self.assertEqual({p.name for p in out.iterdir() if not p.name.startswith(".")}, {"result.json", "report.html", "scene.glb", "motion.bvh", "evidence.png"})
        result = json.loads((out / "result.json").read_text())
        person, = result["people"]
        lines = (out / "motion.bvh").read_text().split("\n")
        at = lines.index("MOTION")
        self.assertEqual(lines[at + 1], f"Frames: {person['frames'][-1]['frame'] - person['frames'][0]['frame'] + 1}")
        pelvis = numpy.array(person["frames"][0]["joints"][6])
        numpy.testing.assert_allclose([float(v) for v in lines[at + 3].split()[:3]], 100 * pelvis[[0, 2, 1]] * [1, 1, -1], atol=1e-3)
        names = {node["name"] for node in glb_json(out / "scene.glb")["nodes"]}
        places = []
        for item in result["objects"]:
            self.assertIn(f"{item['category']} {item['id']}", names)
            place = f"{item['center'][0]:.2f}, {item['center'][1]:.2f}"
            self.assertIn(f"{item['category']} at {place} m", run.stdout)
            places.append(place)
        self.assertIn("person 0 left knee", names)
        self.assertTrue((out / "evidence.png").read_bytes().startswith(b"\x89PNG"))
        scene, = scenes_of(out / "report.html")
        self.assertEqual(scene.header["title"], "Interactions of room")
        self.assertEqual(scene.header["command"], "unseen interactions room/take.json -o out")
        self.assertEqual(scene.header["summary"], result["summary"])
        table, = (t for t in scene.header["tables"] if t["title"] == "Objects")
        column = [c["name"] for c in table["columns"]].index("place")
        self.assertEqual([row[column] for row in table["rows"]], places)

    def test_view_writes_the_same_page_again(self):
        out, _ = self.solve("--smoothness=false")
        page = (out / "report.html").read_bytes()
        (out / "report.html").unlink()
        run = self.unseen("view", "out")
        self.assertEqual(run.returncode, 0, run.stderr)
        again, = scenes_of(out / "report.html")
        self.assertEqual(again.header["command"], "unseen interactions room/take.json -o out --smoothness=false")
        (self.folder / "first.html").write_bytes(page)
        first, = scenes_of(self.folder / "first.html")
        self.assertEqual(first.buffer, again.buffer)
        # Without the take the page lacks what the detector saw, and says so.
        (self.folder / "room/take.json").unlink()
        run = self.unseen("view", "out")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("shown without the detections", run.stderr)
        self.assertNotIn("detections", [s["id"] for s in scenes_of(out / "report.html")[0].header["structures"]])

    def test_a_database_of_ones_own(self):
        run = self.unseen("scenelets", "build", "--synth", "3", "--seed", "900", "-o", "own1.bin", "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)
        out, _ = self.solve("--scenelets", "own1.bin", "--no-shipped", "--no-report", out="own")
        self.assertFalse((out / "report.html").exists())
        result = json.loads((out / "result.json").read_text())
        self.assertEqual((result["options"]["scenelets"], result["options"]["shipped"]), ("own1.bin", False))
        both, _ = self.solve("--scenelets", "own1.bin", "--scenelets", "own1.bin", out="both")
        self.assertEqual(json.loads((both / "result.json").read_text())["options"]["scenelets"], "own1.bin;own1.bin")

    def test_refuses_what_it_cannot_use(self):
        (self.folder / "bad.json").write_text("{}")
        for words, code, says in ((["bad.json", "-o", "out"], 3, "joints"), (["none.json", "-o", "out"], 3, "none.json"), (["-o", "out"], 2, "TAKE.json"), (["room/take.json"], 2, "-o OUT"),
                                  (["room/take.json", "-o", "out", "--no-shipped"], 2, "no scenelet"), (["room/take.json", "-o", "out", "--scenelets", "bad.json"], 3, "bad.json"),
                                  (["--video", "room.mp4", "-o", "out"], 2, "--pose-model"), (["--video", "room.mp4", "--pose-model", "none.onnx", "-o", "out"], 3, "none.onnx")):
            run = self.unseen("interactions", *words)
            self.assertEqual(run.returncode, code, words)
            self.assertIn(says, run.stderr)
            self.assertEqual(len(run.stderr.strip().split("\n")), 1, run.stderr)
        self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
