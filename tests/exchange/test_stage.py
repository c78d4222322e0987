# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""Files of `unseen stage`, and the add-on of blender/ in headless Blender, on a made-up result (tests/collision/sample.h)."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import jsonschema
import numpy

from scene import scenes_of

HERE = pathlib.Path(__file__).parent
ROOT = pathlib.Path(os.environ["UNSEEN_SOURCE_DIR"])
SHOT = {"observations": "observations.json", "fps": 120, "camera": {"fx": 900, "fy": 900, "cx": 319.5, "cy": 239.5, "width": 640, "height": 480},
        "bodies": [{"name": "box", "box": [0.2, 0.12, 0.08]}, {"name": "ball", "sphere": 0.05}]}
LIST = """
fps = 120
duration = 1.0
[[collision]]
name = "one"
result = "two"
shot = "shot.json"
time = 0.4
[[collision]]
name = "two"
result = "two"
shot = "shot.json"
time = 0.5
translate = [3, 0, 0]
rotate_z_deg = 180
[[collision]]
name = "three"
result = "two"
shot = "shot.json"
time = 0.6
translate = [6, 0, 0]
swap = [{ name = "ball", mesh = "tetrahedron.obj" }]
[[meet]]
bodies = ["one.box", "two.ball"]
time = 0.8
"""
TETRAHEDRON = "v 0 0 0\nv .1 0 0\nv 0 .1 0\nv 0 0 .1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


def matrix(pose):
    w, x, y, z = pose["q"]
    m = numpy.eye(4)
    m[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                 [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                 [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    m[:3, 3] = pose["p"]
    return m


class Staging(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        subprocess.run([os.environ["COLLISION_SAMPLE"], cls.folder], check=True, timeout=60)
        (cls.folder / "shot.json").write_text(json.dumps(SHOT))
        (cls.folder / "observations.json").write_text('[{"frame": 0, "x": 300, "y": 200}]')
        (cls.folder / "tetrahedron.obj").write_text(TETRAHEDRON)
        cls.run_list(LIST, "shot").check_returncode()
        cls.result = json.loads((cls.folder / "shot/result.json").read_text())

    @classmethod
    def run_list(cls, text, out):
        (cls.folder / "list.toml").write_text(text)
        return subprocess.run([os.environ["UNSEEN"], "stage", "list.toml", "-o", out], cwd=cls.folder, capture_output=True, text=True, timeout=120)

    def test_pairs_collide_when_asked_and_two_bodies_again(self):
        wanted = [(0.4, {"one.box", "one.ball"}), (0.5, {"two.box", "two.ball"}), (0.6, {"three.box", "three.ball"}), (0.8, {"one.box", "two.ball"})]
        for time, names in wanted:
            found = [i for i in self.result["impacts"] if set(i["between"]) == names]
            self.assertTrue(found, names)
            self.assertLess(abs(found[0]["time"] - time), 1e-3)
            self.assertLess(abs(found[0]["restitution"] - 0.6), 0.01)

    def test_the_result_follows_the_schema(self):
        schema = json.loads((ROOT / "docs/schema/stage.schema.json").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.Draft202012Validator(schema).validate(self.result)

    def test_usd_has_the_poses_of_the_result(self):
        text = (self.folder / "shot/scene.usda").read_text()
        self.assertIn("timeCodesPerSecond = 120", text)
        for i, block in enumerate(text.split("def Mesh")[1:]):
            samples = re.search(r"translate\.timeSamples = \{(.*)\}", block).group(1)
            found = {float(t): [float(x) for x in p.split(",")] for t, p in re.findall(r"([\d.e-]+): \(([^)]*)\)", samples)}
            self.assertEqual(len(found), len(self.result["frames"]))
            for frame in self.result["frames"]:
                nearest = min(found, key=lambda t: abs(t - 120 * frame["t"]))
                self.assertLess(numpy.abs(numpy.array(found[nearest]) - frame["bodies"][i]["p"]).max(), 1e-9)

    def view(self, *inputs):
        return subprocess.run([os.environ["UNSEEN"], "view", *inputs], cwd=self.folder, capture_output=True, text=True, timeout=120)

    def test_the_page_moves_the_bodies_as_the_result_says(self):
        scene, = scenes_of(self.folder / "shot/report.html")
        self.assertEqual(scene.header["command"], "unseen stage list.toml -o shot")
        self.assertEqual(scene.header["summary"], self.result["summary"])
        bodies = scene["bodies"]
        times, frames = scene.array(bodies["times"])[:, 0], self.result["frames"]
        self.assertLess(numpy.abs(times - [f["t"] for f in frames]).max(), 1e-6)
        shown = scene.array(bodies["positions"]).reshape(len(self.result["bodies"]), len(frames), 3) + scene.header["offset"]
        given = numpy.array([[f["bodies"][i]["p"] for f in frames] for i in range(len(self.result["bodies"]))])
        self.assertLess(numpy.abs(shown - given).max(), 1e-5)
        table, = (t for t in scene.header["tables"] if t["title"] == "Impacts")
        self.assertEqual([row[:3] for row in table["rows"]], [[i["time"], *i["between"]] for i in self.result["impacts"]])

    def test_view_writes_the_same_page_again(self):
        run = self.view("shot", "-o", "again.html")
        self.assertEqual(run.returncode, 0, run.stderr)
        page, = scenes_of(self.folder / "shot/report.html")
        again, = scenes_of(self.folder / "again.html")
        self.assertEqual(page.header["facts"], again.header["facts"])
        self.assertEqual(page.header["tables"], again.header["tables"])
        self.assertEqual(page.header["command"], again.header["command"])
        for name in ("positions", "rotations"):
            self.assertLess(numpy.abs(page.array(page["bodies"][name]) - again.array(again["bodies"][name])).max(), 1e-6)
        mesh, same = (s.array(s["mesh-5"]["vertices"]) for s in (page, again))
        self.assertLess(numpy.abs(mesh - same).max(), 1e-6)

    def test_results_side_by_side_have_a_page_too(self):
        for name in "xy":
            (self.folder / name).mkdir()
            result = json.loads((self.folder / "two/result.json").read_text())
            result["input"]["path"] = "../shot.json"
            (self.folder / name / "result.json").write_text(json.dumps(result))
        subprocess.run([os.environ["UNSEEN"], "stage", "x", "y", "-o", "side"], cwd=self.folder, capture_output=True, check=True, timeout=120)
        self.view("side", "-o", "side.html").check_returncode()
        scene, = scenes_of(self.folder / "side.html")
        self.assertEqual(scene.header["command"], "unseen stage x y/result.json -o side")

    def test_results_in_folders_of_one_name_are_called_by_the_folder_above(self):
        result = json.loads((self.folder / "two/result.json").read_text())
        result["input"]["path"] = str(self.folder / "shot.json")
        for name in ("ducks", "rugby"):
            (self.folder / name / "result").mkdir(parents=True)
            (self.folder / name / "result/result.json").write_text(json.dumps(result))
            (self.folder / "ducks" / f"{name}.json").write_text(json.dumps(result))
        for inputs, names in ((("ducks/result", "rugby/result"), ["ducks", "rugby"]), (("ducks/ducks.json", "ducks/rugby.json"), ["ducks", "rugby"]),
                              (("ducks/result", "ducks/result"), ["ducks", "ducks-2"])):
            subprocess.run([os.environ["UNSEEN"], "stage", *inputs, "-o", "named"], cwd=self.folder, capture_output=True, check=True, timeout=120)
            staged = json.loads((self.folder / "named/result.json").read_text())
            self.assertEqual([p["name"] for p in staged["collisions"]], names)

    def test_results_are_staged_from_any_folder(self):
        made = self.folder / "made"
        (made / "films" / "out").mkdir(parents=True)
        for name in ("shot.json", "observations.json"):
            shutil.copy(self.folder / name, made / "films" / name)
        result = json.loads((self.folder / "two/result.json").read_text())
        result["input"]["path"] = "films/shot.json"  # as unseen was run in "made"
        (made / "films/out/result.json").write_text(json.dumps(result))
        (self.folder / "elsewhere").mkdir()
        run = subprocess.run([os.environ["UNSEEN"], "stage", "../made/films/out", "-o", "staged"], cwd=self.folder / "elsewhere", capture_output=True,
                             text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_view_of_a_bad_shot_gives_one_line(self):
        text = (self.folder / "shot/result.json").read_text()
        (self.folder / "spoilt").mkdir()
        shutil.copy(self.folder / "shot/actor-5.obj", self.folder / "spoilt")
        for change, words in ((("one.box", "uno.box"), "between"), (('"mesh": "actor-5', '"mesh": "actor-9'), "actor-9"), (('"sphere"', '"cone"'), "bodies[1]"),
                              (("9.81", "-9.81"), "gravity")):
            spoilt = text.replace(*change, 1)
            self.assertNotEqual(spoilt, text)
            (self.folder / "spoilt/result.json").write_text(spoilt)
            run = self.view("spoilt")
            self.assertEqual(run.returncode, 3, run.stderr)
            self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
            self.assertIn(words, run.stderr)

    def test_bad_lists_give_one_line(self):
        for change, words in ((("time = 0.4", "tme = 0.4"), "tme"), (("two.ball", "tow.ball"), "tow.ball"), (("time = 0.8", "time = 0.45"), "meet[0]"),
                              (("[[meet]]", "[[meet"), "line"), (('"ball", mesh', '"bal", mesh'), "bal"), (('name = "two"', 'name = "one"'), "of its own")):
            run = self.run_list(LIST.replace(*change, 1), "bad")
            self.assertEqual(run.returncode, 3, run.stderr)
            self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
            self.assertIn(words, run.stderr)

    @unittest.skipUnless(shutil.which("node") and (HERE / "node_modules/gltf-validator").is_dir(), "gltf-validator is not installed (npm ci in tests/exchange)")
    def test_khronos_finds_nothing_in_the_scene(self):
        run = subprocess.run(["node", HERE / "validate_gltf.mjs", self.folder / "shot/scene.glb"], capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)
        issues = json.loads(run.stdout)[0]["issues"]
        self.assertEqual((issues["numErrors"], issues["numWarnings"]), (0, 0), json.dumps(issues["messages"][:5], indent=1))

    def blender(self, result, physics, impact, frames):
        target = self.folder / "blender.json"
        environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
        run = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python", HERE / "blender_stage.py", "--", target,
                              ROOT / "blender", self.folder / result, self.folder / "shot.json", physics, str(impact), *map(str, frames)],
                             capture_output=True, text=True, timeout=240, env=environment)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return json.loads(target.read_text())

    @unittest.skipUnless(shutil.which("blender"), "blender is not installed (Debian: blender)")
    def test_the_add_on_loads_a_collision(self):
        seen = self.blender("two/result.json", "KEYS", 100.6, [80, 100, 120])  # the impact is at frame 30.6 of the clip
        box, ball = seen["bodies"]["box"], seen["bodies"]["ball"]
        self.assertAlmostEqual(ball["mass"] / box["mass"], 1.25, 5)
        self.assertAlmostEqual(ball["restitution"] * box["restitution"], 0.6, 5)
        self.assertTrue(seen["split"])
        self.assertEqual((box["shape"], ball["shape"]), ("BOX", "SPHERE"))
        self.assertLess(numpy.abs(numpy.array(box["size"]) - [0.2, 0.12, 0.08]).max(), 1e-6)
        frames = json.loads((self.folder / "two/result.json").read_text())["frames"]
        for poses, frame in zip(seen["poses"], (10, 30, 50)):
            for name, key in (("box", "a"), ("ball", "b")):
                self.assertLess(numpy.abs(numpy.array(poses[name]) - matrix(frames[frame][key])).max(), 1e-4)
        self.assertLess(numpy.abs(-numpy.array(seen["camera"])[:3, 2] - [0, numpy.cos(0.1), -numpy.sin(0.1)]).max(), 1e-6)

    @unittest.skipUnless(shutil.which("blender"), "blender is not installed (Debian: blender)")
    def test_the_add_on_loads_a_staged_shot(self):
        seen = self.blender("shot", "KEYS", 148, [100, 160, 210])  # t = 0 at frame 100
        self.assertEqual(set(seen["bodies"]), {body["name"] for body in self.result["bodies"]})
        for poses, t in zip(seen["poses"], (0, 60 / 120, 110 / 120)):
            frame = min(self.result["frames"], key=lambda f: abs(f["t"] - t))
            for body, pose in zip(self.result["bodies"], frame["bodies"]):
                self.assertLess(numpy.abs(numpy.array(poses[body["name"]]) - matrix(pose)).max(), 1e-3, body["name"])

    @unittest.skipUnless(shutil.which("blender"), "blender is not installed (Debian: blender)")
    def test_blender_flies_on_from_the_impact(self):
        seen = self.blender("two/result.json", "SIMULATION", 100.6, [1, 120, 130])
        frames = json.loads((self.folder / "two/result.json").read_text())["frames"]
        for poses, frame in zip(seen["poses"][1:], (50, 60)):
            for name, key in (("box", "a"), ("ball", "b")):
                self.assertLess(numpy.abs(numpy.array(poses[name])[:3, 3] - frames[frame][key]["p"]).max(), 0.02, name)


if __name__ == "__main__":
    unittest.main()
