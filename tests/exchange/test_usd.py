# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""scene.usda through a strict reader, compared with result.json and planes.ply. Where Pixar's library is installed
(`pxr`; Debian has no package of it), it opens the files, too."""

import importlib.util
import unittest

import numpy

import usd_reader
from results import KINDS, ExchangeTest, linear, outline, palette


def triangles_of_ply(out):
    """Triangles of planes.ply by plane, as the positions of their corners (n×3×3)."""
    lines = (out / "planes.ply").read_text().split("end_header\n")
    count = int(lines[0].split("element vertex ")[1].split()[0])
    rows = lines[1].splitlines()
    vertices = numpy.array([row.split()[:3] for row in rows[:count]], float)
    triangles = {}
    for row in rows[count:]:
        numbers = list(map(int, row.split()))
        triangles.setdefault(numbers[4], []).append(vertices[numbers[1:4]])
    return {plane: numpy.array(corners) for plane, corners in triangles.items()}


class Usd(ExchangeTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.stages = {kind: usd_reader.read(out / "scene.usda") for kind, out in cls.out.items()}

    def planes(self, kind):
        """Frame, prim and id of each plane."""
        for frame_name, frame in self.stages[kind][1].children["planes"].children.items():
            for name, prim in frame.children.items():
                yield int(frame_name.removeprefix("frame_")), prim, int(name.removeprefix("plane_"))

    def offset(self, kind):
        return numpy.array(self.stages[kind][1].attributes["xformOp:translate"].value)

    def test_is_in_metres_with_z_up(self):
        for metadata, root in self.stages.values():
            self.assertEqual((metadata["metersPerUnit"], metadata["upAxis"]), (1, "Z"))
            self.assertEqual(metadata["defaultPrim"], root.name)
            self.assertEqual(root.name, "unseen")
            self.assertEqual(root.attributes["xformOpOrder"].value, ["xformOp:translate"])

    def test_every_plane_stands_in_its_frame_with_its_colour_and_tag(self):
        for kind, result in self.result.items():
            colors = linear(palette(self.out[kind]))
            found = list(self.planes(kind))
            self.assertEqual(sorted(plane for _, _, plane in found), [p["id"] for p in result["planes"]])
            for frame, prim, plane in found:
                self.assertEqual(frame, result["planes"][plane]["frame"])
                self.assertEqual(prim.type, "BasisCurves" if kind == "plan" else "Mesh")
                color = prim.attributes["primvars:displayColor"]
                self.assertEqual(color.interpolation, "constant")
                self.assertLess(numpy.abs(color.value - colors[frame]).max(), 1e-4)  # planes.mtl has 4 digits
                tag = prim.attributes.get("userProperties:tag")
                self.assertEqual(tag and tag.value, result["planes"][plane]["tag"])

    def test_positions_are_those_of_the_result(self):
        self.assertFalse(self.offset("room").any())
        self.assertTrue(self.offset("utm").all())
        for kind, result in self.result.items():
            for _, prim, plane in self.planes(kind):
                world = numpy.array(prim.attributes["points"].value) + self.offset(kind)
                self.assertLess(numpy.abs(world - outline(result["planes"][plane])).max(), 1e-5)

    def test_triangles_are_those_of_planes_ply(self):
        for kind in ("room", "utm", "window"):
            truth = triangles_of_ply(self.out[kind])
            for _, prim, plane in self.planes(kind):
                self.assertEqual(set(prim.attributes["faceVertexCounts"].value), {3})
                indices = numpy.array(prim.attributes["faceVertexIndices"].value).reshape(-1, 3)
                self.assertEqual(len(indices), len(prim.attributes["faceVertexCounts"].value))
                corners = numpy.array(prim.attributes["points"].value)[indices] + self.offset(kind)
                self.assertLess(numpy.abs(corners - truth[plane]).max(), 1e-5)
                self.assertTrue(prim.attributes["doubleSided"].value)
                self.assertEqual(prim.attributes["subdivisionScheme"].value, "none")

    def test_lines_are_linear_curves(self):
        for _, prim, _ in self.planes("plan"):
            self.assertEqual(prim.attributes["type"].value, "linear")
            self.assertEqual(prim.attributes["curveVertexCounts"].value, [2])
            width, = prim.attributes["widths"].value
            self.assertAlmostEqual(width / self.result["plan"]["scale"], 1, 6)

    def test_extents_hold_what_they_bound(self):
        for kind in KINDS:
            for prim in [prim for _, prim, _ in self.planes(kind)] + [self.stages[kind][1].children["points"]]:
                low, high = numpy.array(prim.attributes["extent"].value)
                points = numpy.array(prim.attributes["points"].value)
                half = prim.attributes["widths"].value[0] / 2 if "widths" in prim.attributes else 0
                self.assertLess(numpy.abs(points.min(0) - half - low).max(), 1e-5)
                self.assertLess(numpy.abs(points.max(0) + half - high).max(), 1e-5)

    def test_points_have_a_colour_each(self):
        for kind, (_, root) in self.stages.items():
            attributes = root.children["points"].attributes
            count = len(attributes["points"].value)
            self.assertTrue(0 < count <= 50000)
            indices = attributes["primvars:displayColor:indices"].value
            self.assertEqual(len(indices), count)
            self.assertTrue(0 <= min(indices) and max(indices) < len(attributes["primvars:displayColor"].value))
            self.assertEqual(attributes["primvars:displayColor"].interpolation, "vertex")
            self.assertEqual(len(attributes["widths"].value), 1)
            self.assertTrue(0 < attributes["widths"].value[0] <= self.result[kind]["scale"] * (1 + 1e-6))

    @unittest.skipUnless(importlib.util.find_spec("pxr"), "Pixar's USD library (pxr) is not installed")
    def test_pixars_library_opens_it(self):
        from pxr import Usd as pixar, UsdGeom
        for kind, out in self.out.items():
            stage = pixar.Stage.Open(str(out / "scene.usda"))
            self.assertEqual((UsdGeom.GetStageUpAxis(stage), UsdGeom.GetStageMetersPerUnit(stage)), ("Z", 1))
            shapes = [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Gprim)]
            self.assertEqual(len(shapes), len(self.result[kind]["planes"]) + 1)


if __name__ == "__main__":
    unittest.main()
