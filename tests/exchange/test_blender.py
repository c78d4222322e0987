# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""scene.glb, planes.obj and planes.ply opened in Blender: objects, names, colours, sizes, which way is up."""

import json
import os
import pathlib
import shutil
import subprocess
import unittest

import numpy

from results import KINDS, ExchangeTest, linear, outline, palette, skip_module

HERE = pathlib.Path(__file__).parent
if shutil.which("blender") is None:
    skip_module("blender is not installed (Debian: blender)")
NEAR = ("room", "window", "plan")  # Blender keeps float32, which holds UTM coordinates to half a metre only


class Blender(ExchangeTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        target = cls.out["room"].parent / "blender.json"
        environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
        run = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                              HERE / "blender_import.py", "--", target, *cls.out.values()],
                             capture_output=True, text=True, timeout=240, env=environment)
        assert run.returncode == 0, run.stdout + run.stderr
        cls.seen = json.loads(target.read_text())

    def planes(self, kind, file, name_of):
        """Each plane of result.json with the object that has its name."""
        objects = {item["name"]: item for item in self.seen[kind][file]["objects"]}
        return [(plane, objects[name_of(plane)]) for plane in self.result[kind]["planes"]]

    def glb_planes(self, kind):
        return self.planes(kind, "glb", lambda p: f"plane {p['id']}" + (f" ({p['tag']})" if p["tag"] else ""))

    def obj_planes(self, kind):
        return self.planes(kind, "obj", lambda p: f"plane_{p['id']}" + (f"_{p['tag']}" if p["tag"] else ""))

    def assert_box(self, item, points, tolerance=1e-4):
        self.assertLess(numpy.abs(points.min(0) - item["low"]).max(), tolerance, item["name"])
        self.assertLess(numpy.abs(points.max(0) - item["high"]).max(), tolerance, item["name"])

    def test_all_files_are_imported(self):
        for kind in KINDS:
            planes = len(self.result[kind]["planes"])
            for file, objects in (("glb", 1 + planes + 1), ("obj", planes), ("ply", 1)):
                self.assertTrue(self.seen[kind][file]["done"])
                self.assertEqual(len(self.seen[kind][file]["objects"]), objects, (kind, file))

    def test_glb_has_the_names_below_one_root(self):
        for kind in KINDS:
            root, = [item for item in self.seen[kind]["glb"]["objects"] if item["parent"] is None]
            self.assertEqual((root["name"], root["type"]), ("unseen", "EMPTY"))
            self.assertTrue(all(item["parent"] == "unseen" for _, item in self.glb_planes(kind)))

    def test_sizes_and_places_are_those_of_the_result_with_z_up(self):
        for kind in KINDS:
            root = next(item for item in self.seen[kind]["glb"]["objects"] if item["name"] == "unseen")
            for plane, item in self.glb_planes(kind):
                self.assert_box(item, outline(plane) - root["offset"])
        for kind in NEAR:
            for plane, item in self.obj_planes(kind):
                self.assert_box(item, outline(plane))
            item, = self.seen[kind]["ply"]["objects"]
            self.assert_box(item, numpy.vstack([outline(plane) for plane in self.result[kind]["planes"]]))

    def test_faces_look_along_the_normal_and_cover_the_area(self):
        for kind in ("room", "window"):
            for pairs in (self.glb_planes(kind), self.obj_planes(kind)):
                for plane, item in pairs:
                    self.assertGreater((numpy.array(item["normals"]) @ plane["normal"]).min(), 0.99)
                    self.assertLess(abs(item["area"] - plane["area"]), 1e-4 * plane["area"])

    def test_glb_has_the_palette_in_linear_colours(self):
        for kind in KINDS:
            colors = linear(palette(self.out[kind]))
            for plane, item in self.glb_planes(kind):
                (name, color), = item["materials"]
                self.assertEqual(name, f"frame {plane['frame']}")
                self.assertLess(numpy.abs(color - colors[plane["frame"]]).max(), 1e-4)

    def test_obj_has_the_colours_of_its_materials(self):
        for kind in KINDS:
            colors = palette(self.out[kind])  # Blender takes Kd as it stands
            for plane, item in self.obj_planes(kind):
                (name, color), = item["materials"]
                self.assertEqual(name, f"frame_{plane['frame']}")
                self.assertLess(numpy.abs(color - colors[plane["frame"]]).max(), 1e-4)

    def test_ply_has_the_colours_of_the_frames(self):
        self.assertGreater(len(palette(self.out["window"])), 1)
        for kind in ("room", "utm", "window"):
            item, = self.seen[kind]["ply"]["objects"]
            frames = {plane["frame"] for plane in self.result[kind]["planes"]}
            expected = sorted(map(tuple, linear(palette(self.out[kind])[sorted(frames)])))
            self.assertEqual(len(item["colors"]), len(expected))
            self.assertLess(numpy.abs(numpy.array(item["colors"]) - expected).max(), 1e-3)

    def test_drawings_are_edges(self):
        for _, item in self.glb_planes("plan") + self.obj_planes("plan"):
            self.assertEqual((item["vertices"], item["edges"], item["faces"]), (2, 1, 0))
        item, = self.seen["plan"]["ply"]["objects"]
        self.assertEqual((item["edges"], item["faces"]), (len(self.result["plan"]["planes"]), 0))


if __name__ == "__main__":
    unittest.main()
