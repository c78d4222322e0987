# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""Files of interactions: the page against result.json, scene.glb through Khronos' validator, motion.bvh through Blender, on made-up results
(tests/interactions/page_sample.h)."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import numpy

from scene import scenes_of

HERE = pathlib.Path(__file__).parent
KINDS = ("one", "three", "nothing")
JOINTS = ("right ankle", "right knee", "right hip", "left hip", "left knee", "left ankle", "pelvis", "thorax",
          "neck", "head", "right wrist", "right elbow", "right shoulder", "left shoulder", "left elbow", "left wrist")


class Interactions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        subprocess.run([os.environ["INTERACTIONS_SAMPLE"], cls.folder], check=True, timeout=60)
        cls.result = {kind: json.loads((cls.folder / kind / "result.json").read_text()) for kind in KINDS}
        cls.scene = {kind: scenes_of(cls.folder / kind / "report.html")[0] for kind in KINDS}

    def test_the_page_shows_everybody_in_every_frame(self):
        for kind in ("one", "three"):
            result, scene = self.result[kind], self.scene[kind]
            people = scene["people"]
            times = scene.array(people["times"])[:, 0]
            joints = scene.array(people["joints"]).reshape(len(result["people"]), len(times), 16, 3)
            self.assertTrue((numpy.diff(times) > 0).all())
            self.assertEqual(people["joint_count"], 16)
            there = 0
            for person, shown in zip(result["people"], joints):
                for frame in person["frames"]:
                    at = numpy.abs(times - frame["frame"] / result["fps"]).argmin()
                    self.assertLess(numpy.abs(shown[at] - frame["joints"]).max(), 1e-5)
                there += len(person["frames"])
            self.assertEqual(numpy.isfinite(joints).all(axis=(2, 3)).sum(), there, "nobody is shown who is not there")
            self.assertEqual(scene.array(people["bones"]).shape, (15, 2))

    def test_an_object_on_the_page_is_all_its_parts(self):
        for kind in ("one", "three"):
            result, scene = self.result[kind], self.scene[kind]
            boxes = scene["objects"]
            of = scene.array(boxes["of"])[:, 0]
            centers, sizes, turns = (scene.array(boxes[name]) for name in ("centers", "sizes", "rotations"))
            self.assertEqual(len(boxes["labels"]), len(result["objects"]))
            for i, item in enumerate(result["objects"]):
                self.assertEqual(boxes["labels"][i], f"{item['category']} {item['confidence']:.2f}")
                mine = numpy.flatnonzero(of == i)
                self.assertEqual(len(mine), len(item["parts"]))
                for part, k in zip(item["parts"], mine):
                    self.assertLess(numpy.abs(centers[k] - part["center"]).max(), 1e-5)
                    self.assertLess(numpy.abs(sizes[k] - part["size"]).max(), 1e-5)
                    w, x, y, z = turns[k]
                    first = [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)]
                    self.assertLess(numpy.abs(first - numpy.array(part["axes"][0])).max(), 1e-5)
            table = next(t for t in scene.header["tables"] if t["title"] == "Objects")
            self.assertEqual([row[0] for row in table["rows"]], [item["category"] for item in result["objects"]])

    def test_windows_speak_for_what_they_prove(self):
        for kind in ("one", "three"):
            result, scene = self.result[kind], self.scene[kind]
            chart, = scene.header["charts"]
            self.assertEqual(len(chart["spans"]), len(result["windows"]))
            self.assertEqual(len(chart["series"]), len(result["people"]))
            for w, span in enumerate(chart["spans"]):
                proves = [i for i, item in enumerate(result["objects"]) if w in item["windows"]]
                self.assertEqual(span.get("elements", {}).get("indices", []), proves)
                self.assertAlmostEqual(span["from"], result["windows"][w]["first"] / result["fps"], places=9)

    def test_detections_lie_on_the_joints_as_the_camera_sees_them(self):
        scene = self.scene["one"]
        camera, seen, people = scene["camera"], scene["detections"], scene["people"]
        T = numpy.linalg.inv(numpy.array(camera["T_world_camera"]).reshape(4, 4))

        def pixels(points):
            p = points @ T[:3, :3].T + T[:3, 3]
            return p[..., :2] / p[..., 2:] * [camera["fx"], camera["fy"]] + [camera["cx"], camera["cy"]]

        shown = {}
        for name, structure in (("seen", seen), ("people", people)):
            times = scene.array(structure["times"])[:, 0]
            joints = scene.array(structure["joints"]).reshape(-1, len(times), 16, 3)[0]
            shown[name] = {round(float(t), 4): pixels(j.astype(float)) for t, j in zip(times, joints)}
        off = numpy.concatenate([numpy.linalg.norm(shown["seen"][t] - shown["people"][t], axis=1) for t in shown["people"] if t in shown["seen"]])
        off = off[numpy.isfinite(off)]
        self.assertGreater(len(off), 1000)
        self.assertLess(numpy.median(off), 10)  # px: the detector's noise

    def test_the_evidence_lies_on_the_floor_it_is_about(self):
        scene = self.scene["one"]
        floor = scene["evidence"]
        self.assertFalse(floor["visible"])
        png = bytes(scene.array(scene[floor["image"]]["data"])[:, 0])
        self.assertEqual(png, (self.folder / "one/evidence.png").read_bytes())
        self.assertEqual(floor["low"], [-4, 0])
        self.assertEqual(floor["high"], [4, 8])

    def test_a_page_of_nothing_has_no_charts_and_no_tables(self):
        header = self.scene["nothing"].header
        self.assertFalse(header.get("charts") or header["tables"])
        self.assertNotIn("time", header)

    @unittest.skipUnless(shutil.which("node") and (HERE / "node_modules/gltf-validator").is_dir(), "gltf-validator is not installed (npm ci in tests/exchange)")
    def test_khronos_finds_nothing_in_the_scenes(self):
        run = subprocess.run(["node", HERE / "validate_gltf.mjs", *(self.folder / kind / "scene.glb" for kind in KINDS)], capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)
        for kind, report in zip(KINDS, json.loads(run.stdout)):
            issues = report["issues"]
            self.assertEqual((issues["numErrors"], issues["numWarnings"]), (0, 0), json.dumps(issues["messages"][:5], indent=1))
            self.assertEqual(report["info"]["animationCount"], kind != "nothing")
            self.assertEqual(report["info"]["drawCallCount"], len(self.result[kind]["objects"]) + 16 * len(self.result[kind]["people"]))

    @unittest.skipUnless(shutil.which("blender"), "blender is not installed (Debian: blender)")
    def test_blender_has_the_joints_of_a_bvh_where_the_result_has_them(self):
        person = self.result["one"]["people"][0]
        frames = person["frames"][::20]
        first = person["frames"][0]["frame"]
        target = self.folder / "blender.json"
        environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
        run = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python", HERE / "blender_bvh.py", "--",
                              target, self.folder / "one/motion.bvh", *(str(f["frame"] - first) for f in frames)],
                             capture_output=True, text=True, timeout=240, env=environment)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        for frame, bones in zip(frames, json.loads(target.read_text())):
            for name, joint in zip(JOINTS, frame["joints"]):
                # The generator's limbs keep their lengths.
                self.assertLess(numpy.abs(numpy.array(bones[name.replace(" ", "_")]) - joint).max(), 0.005, (frame["frame"], name))


if __name__ == "__main__":
    unittest.main()
