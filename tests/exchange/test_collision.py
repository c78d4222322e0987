# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""Files of collision: result.json against its schema, scene.glb through Khronos' validator and through Blender, on made-up results whose
motion is known in closed form (tests/collision/sample.h)."""

import json
import math
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import jsonschema
import numpy

from scene import scenes_of

HERE = pathlib.Path(__file__).parent
SCHEMAS = pathlib.Path(os.environ["UNSEEN_SOURCE_DIR"]) / "docs/schema"
KINDS = ("two", "bounces")
G = 9.81


def axes(item):
    """An object's rotation and place."""
    m = numpy.array(item["matrix"])
    return m[:3, :3], m[:3, 3]


class Collision(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        subprocess.run([os.environ["COLLISION_SAMPLE"], cls.folder], check=True, timeout=60)

    def test_results_follow_the_schema(self):
        schema = json.loads((SCHEMAS / "collision.schema.json").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        for kind in KINDS:
            jsonschema.Draft202012Validator(schema).validate(json.loads((self.folder / kind / "result.json").read_text()))

    def test_the_schema_of_shots_takes_what_the_design_says_and_no_more(self):
        schema = json.loads((SCHEMAS / "collision-shot.schema.json").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        check = jsonschema.Draft202012Validator(schema)
        shot = {"video": "v.mp4", "fps": 240, "camera": {"hfov_deg": 60, "assumed": True}, "down": [0, 1, 0],
                "bodies": [{"name": "ball", "sphere": 0.05, "mass": 0.1}, {"name": "floor", "fixed": True, "normal": [0, -1, 0]}],
                "orientations": [{"body": "ball", "frame": 3, "q": [1, 0, 0, 0]}]}
        check.validate(shot)
        check.validate({**shot, "camera": {"width": 1280, "height": 720}})
        for change in ({"observations": "obs.json"}, {"vidoe": 1}, {"fps": 0}, {"camera": {"width": 1280}}, {"bodies": shot["bodies"][:1]}, {"camera": {"fx": 900}},
                       {"bodies": [{"name": "ball", "sphere": 400}, shot["bodies"][1]]}):
            self.assertFalse(check.is_valid({**shot, **change}), change)

    def test_the_page_shows_what_the_result_says(self):
        for kind in KINDS:
            result = json.loads((self.folder / kind / "result.json").read_text())
            scene, = scenes_of(self.folder / kind / "report.html")
            bodies = scene["bodies"]
            times = scene.array(bodies["times"])[:, 0]
            paths = scene.array(bodies["positions"]).reshape(len(bodies["shapes"]), len(times), 3)
            self.assertTrue((numpy.diff(times) > 0).all())
            for frame in result["frames"]:
                at = numpy.abs(times - frame["t"]).argmin()
                self.assertLess(numpy.abs(paths[0, at] - frame["a"]["p"]).max(), 1e-6)
            impulses = scene.array(scene["impulses"]["vectors"]).reshape(-1, 3, 3)  # on a, on b, the normal
            self.assertEqual(len(impulses), len(result["impacts"]))
            self.assertLess(numpy.abs(impulses[:, 0] + impulses[:, 1]).max(), 1e-6)
            self.assertLess(numpy.abs(impulses[0, 0] - result["impulse"]).max(), 1e-6)
            flights = scene.quantity("flights", "flight")
            moving = sum("fixed" not in body for body in result["bodies"])
            self.assertEqual(len(set(flights)), moving * (1 + len(result["impacts"])))
            off = scene.quantity("flights", "residual")
            self.assertLess(numpy.abs(off[numpy.isfinite(off)] - 0.25).max(), 1e-6)
            chart, = scene.header["charts"]
            self.assertEqual([mark["x"] for mark in chart["marks"]], [impact["frame"] for impact in result["impacts"]])
            self.assertEqual(sum(series["x"]["count"] for series in chart["series"]), len(result["residuals"]))
            facts = {fact["name"]: fact["value"] for fact in scene.header["facts"]}
            self.assertTrue(facts["restitution"].startswith(f"{result['restitution']['value']:.3f} ± "))

    @unittest.skipUnless(shutil.which("node") and (HERE / "node_modules/gltf-validator").is_dir(), "gltf-validator is not installed (npm ci in tests/exchange)")
    def test_khronos_finds_nothing_in_the_scenes(self):
        run = subprocess.run(["node", HERE / "validate_gltf.mjs", *(self.folder / kind / "scene.glb" for kind in KINDS)], capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)
        for report in json.loads(run.stdout):
            issues = report["issues"]
            self.assertEqual((issues["numErrors"], issues["numWarnings"]), (0, 0), json.dumps(issues["messages"][:5], indent=1))
            self.assertEqual(report["info"]["animationCount"], 1)

    def poses(self, kind, times):
        """What Blender holds at each time, by object."""
        target = self.folder / "blender.json"
        environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
        run = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python", HERE / "blender_motion.py", "--",
                              target, self.folder / kind / "scene.glb", *map(str, times)], capture_output=True, text=True, timeout=240, env=environment)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return json.loads(target.read_text())

    @unittest.skipUnless(shutil.which("blender"), "blender is not installed (Debian: blender)")
    def test_blender_moves_the_bodies_as_they_flew(self):
        hit = 0.255
        times = [10 / 120, 30 / 120, hit, 31 / 120, 55 / 120]
        all_poses = self.poses("two", times)
        self.assertLess(numpy.abs(numpy.array(all_poses[2]["box"]["reach"]) - [0.1, 0.06, 0.04]).max(), 1e-4)
        upright, _ = axes(all_poses[2]["box"])  # Blender turns the axes of meshes; here the body's are the world's
        for t, poses in zip(times, all_poses):
            tau = t - hit
            R, p = axes(poses["box"])
            v = numpy.array([1, 0, 0.3]) if tau <= 0 else numpy.array([-0.5, 0, 0.3])
            self.assertLess(numpy.abs(p - ([-0.1, 3, 0.1] + v * tau - [0, 0, G / 2 * tau**2])).max(), 1e-4, t)
            angle, axis = (5 * tau, 2) if tau <= 0 else (3 * tau, 1)
            cos, sin = math.cos(angle), math.sin(angle)
            turned = numpy.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]]) if axis == 2 else numpy.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])
            self.assertLess(numpy.abs(R @ upright.T - turned).max(), 1e-3, t)

    @unittest.skipUnless(shutil.which("blender"), "blender is not installed (Debian: blender)")
    def test_blender_lets_the_ball_touch_the_floor_and_looks_from_where_it_was_filmed(self):
        second = 0.2 + 2 * 0.8 * 2.8 / G
        for poses in self.poses("bounces", [0.2, second]):
            self.assertLess(abs(axes(poses["ball"])[1][2] + 0.45), 1e-4)
            R, p = axes(poses["camera"])
            self.assertLess(numpy.abs(p).max(), 1e-6)
            self.assertLess(numpy.abs(-R[:, 2] - [0, math.cos(0.1), -math.sin(0.1)]).max(), 1e-5)
            self.assertIn("floor", poses)


if __name__ == "__main__":
    unittest.main()
