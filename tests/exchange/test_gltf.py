# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""scene.glb through Khronos' validator, from npm (`npm ci` in this folder, which scripts/test does)."""

import json
import pathlib
import shutil
import subprocess
import unittest

from results import KINDS, ExchangeTest, skip_module

HERE = pathlib.Path(__file__).parent
if shutil.which("node") is None:
    skip_module("node is not installed (Debian: nodejs)")
if not (HERE / "node_modules/gltf-validator").is_dir():
    skip_module("gltf-validator is not installed (npm ci in tests/exchange)")


class Gltf(ExchangeTest):
    def test_validator_finds_neither_errors_nor_warnings(self):
        paths = [str(self.out[kind] / "scene.glb") for kind in KINDS]
        run = subprocess.run(["node", HERE / "validate_gltf.mjs", *paths], capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)
        reports = json.loads(run.stdout)
        self.assertEqual(len(reports), len(KINDS))
        for kind, report in zip(KINDS, reports):
            issues = report["issues"]
            told = json.dumps(issues["messages"][:5], indent=1)
            self.assertEqual((issues["numErrors"], issues["numWarnings"]), (0, 0), told)
            self.assertEqual(report["info"]["drawCallCount"], len(self.result[kind]["planes"]) + 1)


if __name__ == "__main__":
    unittest.main()
