# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""unseen planes on input that is in order: what it prints and writes."""

import json
import unittest

import jsonschema
import numpy

from harness import SOURCE, CliTest, contents, glb_json, read_points_ply, room, write_ply


class Planes(CliTest):
    def test_writes_all_files_and_they_agree(self):
        run = self.unseen("planes", self.room_file(), "-o", "out")
        self.assertEqual(run.returncode, 0, run.stderr)
        out = self.folder / "out"
        self.assertEqual(set(contents(out)), {"result.json", "points.ply", "planes.ply", "planes.obj", "planes.mtl",
                                              "planes.csv", "scene.glb", "scene.usda", "report.html"})
        self.assertEqual([p.name for p in self.folder.iterdir() if p.name not in ("out", "room.ply")], [])

        result = json.loads((out / "result.json").read_text())
        schema = json.loads((SOURCE / "docs/schema/planes.result.schema.json").read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        jsonschema.Draft202012Validator(schema).validate(result)
        self.assertEqual(result["summary"]["status"], "solved")
        self.assertEqual(result["summary"]["counts"]["points"], 8000)
        self.assertEqual(len(result["planes"]), 6)
        self.assertEqual(len(result["frames"]), 1)

        points = read_points_ply(out / "points.ply")
        self.assertTrue(numpy.array_equal(numpy.stack([points[c] for c in "xyz"], 1), room()))
        for plane in result["planes"]:
            self.assertEqual(int((points["plane"] == plane["id"]).sum()), plane["points"])
            self.assertTrue((points["frame"][points["plane"] == plane["id"]] == plane["frame"]).all())
        self.assertTrue((points["frame"][points["plane"] < 0] == -1).all())
        self.assertEqual(int((points["plane"] >= 0).sum()), result["summary"]["counts"]["assigned"])

        names = [node["name"] for node in glb_json(out / "scene.glb")["nodes"]]
        self.assertEqual(len(names), 1 + 6 + 1)

    def test_prints_a_few_friendly_lines(self):
        run = self.unseen("planes", self.room_file(), "-o", "out")
        lines = run.stdout.splitlines()
        self.assertTrue(3 <= len(lines) <= 6, run.stdout)
        self.assertIn("8000 points", run.stdout)
        self.assertIn("6 planes", run.stdout)
        self.assertIn("estimated", run.stdout)
        self.assertIn("out/report.html", run.stdout)
        given = self.unseen("planes", "room.ply", "-o", "out", "--scale", "0.05")
        self.assertNotIn("estimated", given.stdout)
        self.assertIn("0.05 m", given.stdout)

    def test_json_equals_the_summary(self):
        run = self.unseen("planes", self.room_file(), "-o", "out", "--json")
        self.assertEqual(json.loads(run.stdout), json.loads((self.folder / "out/result.json").read_text())["summary"])

    def test_quiet_prints_nothing(self):
        run = self.unseen("planes", self.room_file(), "-o", "out", "--quiet")
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))

    def test_what_is_not_wanted_is_not_written(self):
        run = self.unseen("planes", self.room_file(), "-o", "out", "--no-points", "--no-report")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(set(contents(self.folder / "out")),
                         {"result.json", "planes.ply", "planes.obj", "planes.mtl", "planes.csv", "scene.glb",
                          "scene.usda"})

    def test_second_run_replaces_the_first(self):
        self.room_file()
        self.unseen("planes", "room.ply", "-o", "out")
        first = contents(self.folder / "out")
        self.assertEqual(self.unseen("planes", "room.ply", "-o", "out", "--scale", "0.08").returncode, 0)
        second = contents(self.folder / "out")
        self.assertEqual(set(first), set(second))
        self.assertNotEqual(first["result.json"], second["result.json"])

    def test_a_result_beside_its_tiles_is_no_tile(self):
        tiles = self.folder / "tiles"
        tiles.mkdir()
        self.room_file("tiles/a.ply")
        runs = [self.unseen("planes", "tiles", "-o", "tiles") for _ in range(2)]
        self.assertEqual(runs[1].returncode, 0, runs[1].stderr)
        self.assertEqual(runs[0].stdout, runs[1].stdout)
        self.assertNotIn("points.ply", runs[0].stderr)
        self.assertIn("points.ply: from the result of an earlier run", runs[1].stderr)
        self.assertEqual(self.unseen("view", "tiles", "-o", "page.html").returncode, 0)

    def test_same_bytes_at_any_thread_count(self):
        self.room_file()
        results = []
        for threads in (1, 2, 4):
            self.unseen("planes", "room.ply", "-o", f"out{threads}", "--threads", threads)
            files = contents(self.folder / f"out{threads}")
            result = json.loads(files.pop("result.json"))
            result["summary"].pop("seconds")
            files.pop("report.html")
            results.append((result, files))
        self.assertEqual(results[0], results[1])
        self.assertEqual(results[0], results[2])

    def test_utm_coordinates_lose_nothing(self):
        offset = numpy.array([500000.0, 5400000.0, 300.0])
        write_ply(self.folder / "utm.ply", room() + offset)
        self.assertEqual(self.unseen("planes", "utm.ply", "-o", "out").returncode, 0)
        points = read_points_ply(self.folder / "out/points.ply")
        self.assertTrue(numpy.array_equal(numpy.stack([points[c] for c in "xyz"], 1), room() + offset))
        root = glb_json(self.folder / "out/scene.glb")["nodes"][0]
        self.assertLess(numpy.abs(numpy.array(root["extras"]["offset"]) - offset).max(), 5)

    def test_drawing(self):
        random = numpy.random.default_rng(2)
        points = numpy.zeros((2000, 3))
        along = random.uniform(0, 4, 2000)
        points[:1000, 0], points[1000:, 1] = along[:1000], along[1000:]
        points[:, :2] += random.normal(0, 0.002, (2000, 2))
        write_ply(self.folder / "plan.ply", points)
        run = self.unseen("planes", "plan.ply", "-o", "out", "--scale", "0.05")
        self.assertEqual(run.returncode, 0, run.stderr)
        result = json.loads((self.folder / "out/result.json").read_text())
        schema = json.loads((SOURCE / "docs/schema/planes.result.schema.json").read_text())
        jsonschema.Draft202012Validator(schema).validate(result)
        self.assertEqual(result["dimensions"], 2)
        self.assertEqual(len(result["planes"]), 2)
        self.assertTrue(all(len(plane["segment"]) == 2 for plane in result["planes"]))
        self.assertLess({"drawing.dxf", "drawing.svg"}, set(contents(self.folder / "out")))

    def test_infeasible_is_written_and_says_so(self):
        write_ply(self.folder / "dust.ply", numpy.random.default_rng(3).uniform(0, 1, (60, 3)))
        run = self.unseen("planes", "dust.ply", "-o", "out", "--scale", "0.0001")
        self.assertEqual(run.returncode, 4, run.stderr)
        result = json.loads((self.folder / "out/result.json").read_text())
        self.assertEqual(result["summary"]["status"], "infeasible")
        self.assertEqual(result["planes"], [])
        self.assertEqual(set(contents(self.folder / "out")), {"result.json", "report.html"})


if __name__ == "__main__":
    unittest.main()
