# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""scene.glb through Khronos' validator, from npm (`npm ci` in this folder, which scripts/test does)."""

import json
import pathlib
import shutil
import subprocess
import unittest

import numpy

import frames
from harness import glb_json
from results import KINDS, ExchangeTest, skip_module

HERE = pathlib.Path(__file__).parent
if shutil.which("node") is None:
    skip_module("node is not installed (Debian: nodejs)")
if not (HERE / "node_modules/gltf-validator").is_dir():
    skip_module("gltf-validator is not installed (npm ci in tests/exchange)")


class Gltf(ExchangeTest):
    def reports(self, paths):
        """The validator's reports on files in which it finds neither errors nor warnings."""
        run = subprocess.run(["node", HERE / "validate_gltf.mjs", *map(str, paths)], capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)
        reports = json.loads(run.stdout)
        self.assertEqual(len(reports), len(paths))
        for report in reports:
            issues = report["issues"]
            told = json.dumps(issues["messages"][:5], indent=1)
            self.assertEqual((issues["numErrors"], issues["numWarnings"]), (0, 0), told)
        return reports

    def test_planes(self):
        for kind, report in zip(KINDS, self.reports([self.out[kind] / "scene.glb" for kind in KINDS])):
            self.assertEqual(report["info"]["drawCallCount"], len(self.result[kind]["planes"]) + 1)

    def test_cuboids(self):
        frames.write_frame(self.folder)
        run = self.unseen("cuboids", "frame.json", "-o", "out", "--quiet")
        self.assertEqual(run.returncode, 0, run.stderr)
        report, = self.reports([self.folder / "out/scene.glb"])
        result = json.loads((self.folder / "out/result.json").read_text())
        self.assertGreaterEqual(report["info"]["drawCallCount"], len(result["cuboids"]) + len(result["supports"]) + 1)
        # Seen and hidden parts fill each box: together they reach from end to end of it.
        glb = glb_json(self.folder / "out/scene.glb")
        for box in result["cuboids"]:
            parts = [n for n in glb["nodes"] if n["name"].split(" (")[0].split(",")[0] == f"box {box['id']}"]
            accessors = [glb["accessors"][glb["meshes"][n["mesh"]]["primitives"][0]["attributes"]["POSITION"]] for n in parts]
            reach = numpy.abs(numpy.array(box["axes"]).T) @ numpy.array(box["size"]) / 2
            self.assertTrue(numpy.allclose(numpy.min([a["min"] for a in accessors], 0), box["center"] - reach, atol=1e-5))
            self.assertTrue(numpy.allclose(numpy.max([a["max"] for a in accessors], 0), box["center"] + reach, atol=1e-5))
        kinds = {m["name"]: m.get("alphaMode", "OPAQUE") for m in glb["materials"]}
        for name, kind in kinds.items():
            if name.startswith("box"):
                self.assertEqual(kind, "BLEND" if name.endswith("hidden") else "OPAQUE", name)


if __name__ == "__main__":
    unittest.main()
