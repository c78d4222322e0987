# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""unseen interactions, evaluate and view: from a take to furniture and motion, and what a bad take says."""

import copy
import json
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import jsonschema
import numpy

from harness import PROGRAM, SOURCE, CliTest, contents
from scene import scenes_of

FILES = {"result.json", "report.html", "scene.glb", "motion.bvh", "evidence.png"}
BODY_25 = {0: 11, 1: 10, 2: 9, 3: 12, 4: 13, 5: 14, 10: 4, 11: 3, 12: 2, 13: 5, 14: 6, 15: 7}  # joints that OpenPose sees itself


def keypoints(folder, frame):
    """The only person of a frame as 25 rows of x, y, confidence."""
    text = json.loads((folder / f"joints/{frame:06}_keypoints.json").read_text())
    return numpy.reshape(text["people"][0]["pose_keypoints_2d"], (25, 3))


class Interactions(CliTest):
    @classmethod
    def setUpClass(cls):
        """A generated take in which somebody sits down, and its result."""
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.made = pathlib.Path(temporary.name)
        for arguments in (("synth", "interactions", "-o", "take", "--seed", "5", "--seconds", "12"), ("interactions", "take/take.json", "-o", "out")):
            subprocess.run([PROGRAM, *arguments], cwd=cls.made, check=True, capture_output=True, timeout=120)
        cls.result = json.loads((cls.made / "out/result.json").read_text())
        cls.take = json.loads((cls.made / "take/take.json").read_text())

    def setUp(self):
        super().setUp()
        for name in ("take", "out"):
            shutil.copytree(self.made / name, self.folder / name)

    def assert_refused(self, take, *words):
        """The take (a text, or fields that change) ends with code 3 and one line, and an earlier result stays."""
        text = take if isinstance(take, str) else json.dumps({k: v for k, v in {**copy.deepcopy(self.take), **take}.items() if v is not None})
        (self.folder / "take/bad.json").write_text(text)
        before = contents(self.folder)
        self.assert_one_line(self.unseen("interactions", "take/bad.json", "-o", "out", timeout=60), 3, *words)
        self.assertEqual(contents(self.folder), before)

    def test_the_result_follows_the_schema(self):
        self.assertEqual(set(contents(self.made / "out")), FILES)
        schema = json.loads((SOURCE / "docs/schema/interactions.schema.json").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.Draft202012Validator(schema).validate(self.result)
        transform = numpy.array(self.result["T_world_camera"])
        numpy.testing.assert_allclose(transform[:3, :3] @ transform[:3, :3].T, numpy.eye(3), atol=1e-9)
        numpy.testing.assert_allclose(transform[:3, 3], [0, 0, self.result["ground"]["camera_height"]])
        windows = self.result["windows"]
        for item in self.result["objects"]:
            self.assertTrue(all(w < len(windows) for w in item["windows"]))
        for person in self.result["people"]:
            self.assertEqual(len(person["likelihood"]), len(person["frames"]))
            mine = [w for w in windows if w["person"] == person["id"]]
            for frame in person["frames"]:
                inside = any(w["first"] <= frame["frame"] <= w["last"] for w in mine)
                self.assertTrue(inside or frame["source"] == "pose")
            self.assertTrue(all(a["last"] < b["first"] for a, b in zip(mine, mine[1:])), "windows do not overlap")

    def test_every_frame_has_a_pose_that_projects_to_its_joints(self):
        frames = self.result["people"][0]["frames"]
        self.assertEqual([f["frame"] for f in frames], list(range(120)))
        camera, to_camera = self.result["camera"], numpy.linalg.inv(self.result["T_world_camera"])
        off = []
        for frame in frames:
            seen = keypoints(self.made / "take", frame["frame"])
            points = numpy.array(frame["joints"]) @ to_camera[:3, :3].T + to_camera[:3, 3]
            x, y = (camera[f] * points[:, i] / points[:, 2] + camera[c] for i, (f, c) in enumerate((("fx", "cx"), ("fy", "cy"))))
            off += [numpy.hypot(x[ours] - seen[its, 0], y[ours] - seen[its, 1]) for ours, its in BODY_25.items() if seen[its, 2] > 0.7]
        self.assertGreater(len(off), 500)
        self.assertLess(numpy.median(off), 20)

    def test_what_was_found_is_measured_and_shown(self):
        run = self.unseen("evaluate", "interactions", "out", "--truth", "take")
        self.assertEqual(run.returncode, 0, run.stderr)
        score = json.loads((self.folder / "out/evaluation.json").read_text())
        self.assertEqual((score["found"], score["interacted"]), (1, 1))
        self.assertLess(score["distance"]["mean"], 0.8)
        self.assertLess(score["poses"]["all"]["local"], 0.12)
        page = (self.folder / "out/report.html").read_bytes()
        (self.folder / "out/report.html").unlink()
        self.assertEqual(self.unseen("view", "out").returncode, 0)
        self.assertGreater(len((self.folder / "out/report.html").read_bytes()), len(page) // 2)

    def test_any_number_of_threads_gives_the_same_files(self):
        run = self.unseen("interactions", "take/take.json", "-o", "one", "--threads", "1", "--no-report", "--json")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(json.loads(run.stdout)["status"], "solved")
        one, many = contents(self.folder / "one"), contents(self.folder / "out")
        self.assertEqual(set(one), FILES - {"report.html"})
        mine = json.loads(one.pop("result.json"))
        mine["summary"]["seconds"] = self.result["summary"]["seconds"]
        self.assertEqual(mine, self.result)
        for name in one:
            self.assertEqual(one[name], many[name], name)

    def test_nobody_touches_anything_is_no_solution(self):
        self.assertEqual(self.unseen("synth", "interactions", "-o", "still", "--still", "--seconds", "8", "--seed", "3").returncode, 0)
        run = self.unseen("interactions", "still/take.json", "-o", "nothing")
        self.assertEqual(run.returncode, 4, run.stderr)
        self.assertIn("no object found", run.stdout)
        result = json.loads((self.folder / "nothing/result.json").read_text())
        self.assertEqual((result["summary"]["status"], result["objects"]), ("infeasible", []))
        self.assertEqual(len(result["people"][0]["frames"]), 80)

    def test_takes_of_one_room_make_one_scene(self):
        up = self.result["T_world_camera"][2][:3]  # the world's z in the camera's coordinates
        known = {**self.take, "up": up, "camera_height": self.result["ground"]["camera_height"]}
        del known["lifted"]
        for name, first in (("early", 0), ("late", 60)):
            (self.folder / "take" / name).mkdir()
            for path in sorted((self.folder / "take/joints").iterdir())[first : first + 60]:
                shutil.copy(path, self.folder / "take" / name)
            (self.folder / f"take/{name}.json").write_text(json.dumps({**known, "joints": name}))
        run = self.unseen("interactions", "take/early.json", "take/late.json", "-o", "both")
        self.assertEqual(run.returncode, 0, run.stderr)
        result = json.loads((self.folder / "both/result.json").read_text())
        self.assertEqual(result["ground"]["source"], "given")
        numpy.testing.assert_allclose(result["T_world_camera"], self.result["T_world_camera"], atol=1e-4)
        self.assertEqual([len(p["frames"]) for p in result["people"]], [60, 60])
        self.assertEqual([o["superclass"] for o in result["objects"]], ["sit"])
        self.assertTrue((self.folder / "both/motion-1.bvh").exists())
        first, = scenes_of(self.folder / "both/report.html")
        self.assertEqual(self.unseen("view", "both").returncode, 0)
        again, = scenes_of(self.folder / "both/report.html")
        self.assertEqual(again.header["command"], "unseen interactions take/early.json take/late.json -o both")
        self.assertEqual(again.header["title"], "Interactions of early.json, late.json")
        self.assertEqual(first.buffer, again.buffer)
        other = {**self.take, "camera": {**self.take["camera"], "fx": 900}}
        (self.folder / "take/other.json").write_text(json.dumps(other))
        self.assert_one_line(self.unseen("interactions", "take/early.json", "take/other.json", "-o", "out"), 3, "take/other.json", "camera", "early")

    def test_intrinsics_may_be_unknown(self):
        (self.folder / "take/mine.json").write_text(json.dumps({"joints": "joints", "format": "openpose", "fps": 10}))
        run = self.unseen("interactions", "take/mine.json", "-o", "mine", "--no-report")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("1920 x 1080 is assumed", run.stderr)
        result = json.loads((self.folder / "mine/result.json").read_text())
        self.assertAlmostEqual(result["camera"]["fx"], 960 / numpy.tan(numpy.radians(30)), places=6)
        self.assertEqual([o["superclass"] for o in result["objects"]], ["sit"])

    def test_bad_takes_say_which_field(self):
        for change, words in (({"format": None}, ("format", "this field")),
                              ({"format": "json"}, ("format", '"json"', "openpose, coco, mediapipe or i3db")),
                              ({"joints": "nowhere"}, ("joints", "nowhere")),
                              ({"fps": 0}, ("fps", "found 0")),
                              ({"people": 0}, ("people", "[1, 16]")),
                              ({"peoples": 2}, ("peoples", "unknown field")),
                              ({"camera": {"fx": 1000}}, ("camera", "fy is missing")),
                              ({"camera": {"hfov_deg": 300}}, ("camera.hfov_deg", "300")),
                              ({"up": [0, 0, 0]}, ("up", "direction")),
                              ({"camera_height": -1}, ("camera_height", "-1")),
                              ({"labels": [{"frame": 0, "person": 0, "pixel": [1, 2]}]}, ("labels[0]", "nobody")),
                              ({"masks": [{"category": "chair", "image": "none.png"}]}, ("masks[0].image", "none.png"))):
            with self.subTest(change=change):
                self.assert_refused(change, "bad.json", *words)
        self.assert_refused("{", "bad.json")
        self.assert_refused("[" * 100000, "bad.json")
        (self.folder / "take/joints/000007_keypoints.json").write_text(json.dumps({"people": [{"pose_keypoints_2d": [1, 2, 3]}]}))
        self.assert_refused({}, "000007_keypoints.json", "people[0].pose_keypoints_2d", "75")

    def test_bad_databases(self):
        (self.folder / "text.bin").write_text("no scenelets")
        shipped = (SOURCE / "data/scenelets.bin").read_bytes()
        (self.folder / "cut.bin").write_bytes(shipped[: len(shipped) // 2])
        before = contents(self.folder)
        for name, word in (("none.bin", "No such file"), ("text.bin", "another kind of file"), ("cut.bin", "checksum")):
            self.assert_one_line(self.unseen("interactions", "take/take.json", "-o", "out", "--scenelets", name), 3, name, word)
        self.assertEqual(contents(self.folder), before)

    def test_bad_calls(self):
        for arguments, word in (((), "TAKE"), (("take/take.json",), "-o"), (("take/take.json", "-o", "x", "--no-shipped"), "--scenelets"),
                                (("take/take.json", "-o", "x", "--seed", "-1"), "seed"),
                                (("take/take.json", "-o", "x", "--occlusion=perhaps"), "occlusion")):
            self.assert_one_line(self.unseen("interactions", *arguments), 2, word)
        self.assertFalse((self.folder / "x").exists())

    def test_a_dumped_configuration_is_read_again(self):
        first = self.unseen("interactions", "--dump-config", "--occlusion=false", "--scenelets", "a.bin", "--scenelets", "b.bin", "--no-shipped")
        self.assertEqual(first.returncode, 0, first.stderr)
        for line in ("[interactions]", "occlusion = false", 'scenelets = "a.bin;b.bin"', "shipped = false", "evidence = true"):
            self.assertIn(line, first.stdout.splitlines())
        (self.folder / "my.toml").write_text(first.stdout + "\n[scenelets]\nreach = 2\n")
        again = self.unseen("interactions", "--config", "my.toml", "--dump-config")
        self.assertEqual((again.returncode, again.stdout), (0, first.stdout), again.stderr)


if __name__ == "__main__":
    unittest.main()
