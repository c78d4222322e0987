# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""The page of a result, and unseen view, which writes it again or two side by side."""

import json
import os
import unittest

import numpy

from harness import CliTest, contents, read_points_ply, room, write_ply
from scene import scenes_of


class View(CliTest):
    def solve(self, points, name="room.ply", out="out", *more):
        write_ply(self.folder / name, points)
        run = self.unseen("planes", name, "-o", out, *more)
        self.assertEqual(run.returncode, 0, run.stderr)
        return self.folder / out

    def test_the_scene_agrees_with_the_files(self):
        out = self.solve(room())
        result = json.loads((out / "result.json").read_text())
        scene, = scenes_of(out / "report.html")
        self.assertEqual(scene.header["scene"], 1)
        self.assertEqual(scene.header["command"], "unseen planes room.ply -o out")
        self.assertEqual(scene.header["summary"], result["summary"])
        self.assertEqual(scene.header["input"], result["input"])
        self.assertNotIn("thinned", scene.header)

        points = read_points_ply(out / "points.ply")
        given = numpy.stack([points[c] for c in "xyz"], 1)
        shown = scene.array(scene["points"]["positions"]) + scene.header["offset"]
        self.assertEqual(len(shown), len(given))
        for a in range(3):  # as multisets along each axis, within half a step
            step = numpy.ptp(given[:, a]) / 65535
            self.assertLess(numpy.abs(numpy.sort(given[:, a]) - numpy.sort(shown[:, a])).max(), 0.51 * step)
        self.assertEqual(sorted(scene.quantity("points", "plane")), sorted(points["plane"]))
        self.assertEqual(sorted(scene.quantity("points", "frame")), sorted(points["frame"]))
        # Each point lies as far from its plane as its residual says.
        normals = numpy.array([p["normal"] for p in result["planes"]])
        offsets = numpy.array([p["offset"] for p in result["planes"]])
        plane = scene.quantity("points", "plane")
        distance = numpy.abs((shown * normals[plane]).sum(1) - offsets[plane])[plane >= 0]
        residual = scene.quantity("points", "residual")[plane >= 0]
        self.assertLess(numpy.abs(distance - residual).max(), 0.51 * result["scale"] / 255 + 1e-4)

    def test_polygons_relations_and_table(self):
        out = self.solve(room())
        result = json.loads((out / "result.json").read_text())
        scene, = scenes_of(out / "report.html")
        planes = scene["planes"]
        vertices = scene.array(planes["vertices"]) + scene.header["offset"]
        rings = scene.array(planes["rings"])
        ends = list(rings[1:, 0]) + [len(vertices)]
        for plane in result["planes"]:
            mine = [vertices[a:b] for (a, owner), b in zip(rings, ends) if owner == plane["id"]]
            self.assertEqual(len(mine), len(plane["polygon"]))
            for ring, polygon in zip(mine, plane["polygon"]):
                self.assertLess(numpy.abs(ring - numpy.array(polygon)).max(), 1e-6)
        # The triangles cover what the polygons do.
        triangles, owner = scene.array(planes["triangles"]), scene.array(planes["triangle_plane"])[:, 0]
        a, b, c = (vertices[triangles[:, k]] for k in range(3))
        areas = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1) / 2
        for plane in result["planes"]:
            self.assertAlmostEqual(areas[owner == plane["id"]].sum(), plane["area"], delta=1e-4 * plane["area"])
        self.assertTrue(numpy.array_equal(scene.array(scene["relations"]["edges"]),
                                          [[r["a"], r["b"]] for r in result["relations"]]))
        self.assertEqual(scene["relations"]["edge_names"], [f"{r['angle_deg']:g}°" for r in result["relations"]])
        for direction, members in enumerate(scene["relations"]["elements"]["of_node"]):
            self.assertEqual(members, [p["id"] for p in result["planes"] if p["direction"] == direction])
        table, = scene.header["tables"]
        self.assertEqual([row[0] for row in table["rows"]], list(range(len(result["planes"]))))
        area = [c["name"] for c in table["columns"]].index("area")
        self.assertEqual([row[area] for row in table["rows"]], [p["area"] for p in result["planes"]])

    def test_before_is_the_free_fit_of_the_points(self):
        # One wall leans by 0.2°, too little to count: after, it is upright; before, it leans.
        points = room(20000)
        wall = numpy.abs(points[:, 0] - 4.0) < 0.02
        points[wall, 0] += numpy.tan(numpy.radians(0.2)) * points[wall, 2]
        out = self.solve(points)
        result = json.loads((out / "result.json").read_text())
        scene, = scenes_of(out / "report.html")
        planes = scene["planes"]
        after, before = scene.array(planes["vertices"]), scene.array(planes["before"])
        leaning, = [p["id"] for p in result["planes"] if abs(p["normal"][0]) > 0.9 and abs(p["offset"]) > 2]
        mine = scene.array(planes["rings"])
        first = mine[mine[:, 1] == leaning][0, 0]
        last = mine[mine[:, 1] == leaning + 1][0, 0] if leaning + 1 < len(result["planes"]) else len(after)
        def lean(v):
            return numpy.degrees(numpy.arctan(numpy.polyfit(v[first:last, 2], v[first:last, 0], 1)[0]))
        self.assertLess(abs(lean(after)), 0.1)  # what the other walls leave of it
        self.assertAlmostEqual(lean(before), 0.2, delta=0.05)

    def test_view_writes_the_same_page_again(self):
        out = self.solve(room(), "room.ply", "out", "--scale", "0.04", "--angles", "60,90")
        page = (out / "report.html").read_bytes()
        (out / "report.html").unlink()
        run = self.unseen("view", "out")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stdout, "page: out/report.html\n")
        again, = scenes_of(out / "report.html")
        self.assertEqual(sorted(again.header["command"].split()), sorted("unseen planes room.ply -o out --scale 0.04 --angles 60,90".split()))
        self.assertEqual(len((out / "report.html").read_bytes()) // 1000, len(page) // 1000)

    def test_two_side_by_side(self):
        self.solve(room(), "room.ply", "coarse", "--scale", "0.2")
        self.solve(room(), "room.ply", "fine", "--scale", "0.05")
        before = contents(self.folder)
        run = self.unseen("view", "coarse", "fine", "-o", "both.html")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual([s.header["facts"][-1]["value"] for s in scenes_of(self.folder / "both.html")], ["0.2 m", "0.05 m"])
        self.assertEqual({**before, "both.html": (self.folder / "both.html").read_bytes()}, contents(self.folder))

    def test_replaces_nothing_but_a_page(self):
        self.solve(room())
        (self.folder / "link.html").symlink_to("out/result.json")
        before = contents(self.folder)
        for page in ("out/result.json", "out/points.ply", "room.ply", "link.html"):
            self.assert_one_line(self.unseen("view", "out", "-o", page), 2, page, ".html")
        self.assertEqual(contents(self.folder), before)
        (self.folder / "old.html").write_text("an older page")
        for page in ("old.html", "new"):
            self.assertEqual(self.unseen("view", "out", "-o", page).returncode, 0)
            self.assertEqual(len(scenes_of(self.folder / page)), 1)

    def test_far_coordinates_keep_their_millimetres(self):
        far = numpy.array([500000.0, 5400000.0, 120.0])
        out = self.solve(room() + far)
        scene, = scenes_of(out / "report.html")
        points = read_points_ply(out / "points.ply")
        shown = scene.array(scene["points"]["positions"]) + scene.header["offset"]
        for a, c in enumerate("xyz"):
            self.assertLess(numpy.abs(numpy.sort(points[c]) - numpy.sort(shown[:, a])).max(), 1e-4)

    def test_hostile_names_stay_text(self):
        name = "<script>alert(1)<|script> & \"quotes\'.ply"
        out = self.solve(room(), name)
        page = (out / "report.html").read_text()
        self.assertNotIn("<script>alert", page)
        self.assertIn("<title>Planes of &lt;script&gt;alert(1)&lt;|script&gt; &amp; &quot;quotes&#39;.ply</title>", page)
        scene, = scenes_of(out / "report.html")
        self.assertEqual(scene.header["title"], "Planes of " + name)

    def test_without_points_and_in_2d(self):
        out = self.solve(room(), "room.ply", "out", "--no-points")
        self.assertEqual(self.unseen("view", "out").returncode, 0)
        scene, = scenes_of(out / "report.html")
        self.assertEqual([s["id"] for s in scene.header["structures"]], ["planes", "relations", "normals"])
        self.assertNotIn("before", scene["planes"])
        self.assertEqual(self.unseen("synth", "planes", "-o", "plan", "--scene", "floorplan", "--points", "5000").returncode, 0)
        self.assertEqual(self.unseen("planes", "plan/cloud.ply", "-o", "lines").returncode, 0)
        scene, = scenes_of(self.folder / "lines/report.html")
        self.assertTrue(scene.header["flat"])
        self.assertEqual(scene["planes"]["kind"], "lines")
        vertices = scene.array(scene["planes"]["vertices"])
        self.assertEqual(len(vertices), 2 * len(scene.header["tables"][0]["rows"]))
        self.assertTrue((vertices[:, 2] == 0).all())

    def test_what_is_no_result(self):
        self.solve(room())
        result = self.folder / "out/result.json"
        self.assert_one_line(self.unseen("view"), 2, "OUT")
        self.assert_one_line(self.unseen("view", "nowhere"), 3, "nowhere", "folder")
        (self.folder / "empty").mkdir()
        self.assert_one_line(self.unseen("view", "out", "empty"), 3, "empty/result.json")
        self.assert_one_line(self.unseen("view", "out", "-o", "/dev/null/page.html"), 3, "/dev/null/page.html")
        text = result.read_text()
        for bad, *words in ((text[: len(text) // 2], "result.json"), (text.replace('"planes",', '"boxes",', 1), "capability", "boxes"),
                            (text.replace('"lambda": 0.5', '"lambda": "x"', 1), "lambda")):
            result.write_text(bad)
            before = contents(self.folder)
            self.assert_one_line(self.unseen("view", "out"), 3, *words)
            self.assertEqual(contents(self.folder), before)

    def test_points_of_another_result(self):
        self.solve(room())
        other = json.loads((self.folder / "out/result.json").read_text())
        self.solve(room(size=(4, 3, 5)), "other.ply", "other")
        (self.folder / "other/points.ply").write_bytes((self.folder / "other/points.ply").read_bytes().replace(b"int plane", b"int place"))
        self.assert_one_line(self.unseen("view", "other"), 3, "points.ply", "plane")

    def test_open_without_a_browser(self):
        self.solve(room())
        run = self.unseen("view", "out", "--open", env={**os.environ, "PATH": "/nonexistent"})
        self.assertEqual(run.returncode, 3)
        self.assertIn("xdg-open", run.stderr)


if __name__ == "__main__":
    unittest.main()
