# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""drawing.dxf read back by ezdxf, drawing.svg by an XML parser; only drawings have them."""

import importlib.util
import re
import unittest
import xml.etree.ElementTree as xml

import numpy

from harness import room, write_ply
from results import ExchangeTest, palette, skip_module

if importlib.util.find_spec("ezdxf") is None:
    skip_module("ezdxf is not installed (Debian: python3-ezdxf)")
import ezdxf

SVG = "{http://www.w3.org/2000/svg}"


class Drawing(ExchangeTest):
    def segments(self):
        return {p["id"]: numpy.array(p["segment"]) for p in self.result["plan"]["planes"]}

    def test_dxf_has_a_line_a_segment_to_the_bit(self):
        document = ezdxf.readfile(self.out["plan"] / "drawing.dxf")
        self.assertEqual(document.dxfversion, "AC1009")
        self.assertFalse(document.audit().has_errors)
        lines = list(document.modelspace())
        planes = self.result["plan"]["planes"]
        self.assertEqual([line.dxftype() for line in lines], ["LINE"] * len(planes))
        for line, plane in zip(lines, planes):
            self.assertEqual([list(line.dxf.start), list(line.dxf.end)], plane["segment"])
            self.assertEqual(line.dxf.layer, f"FRAME_{plane['frame']}")
        corners = numpy.concatenate(list(self.segments().values()))
        self.assertEqual(list(document.header["$EXTMIN"]), list(corners.min(0)))
        self.assertEqual(list(document.header["$EXTMAX"]), list(corners.max(0)))

    def test_dxf_layers_have_the_frames_colours_as_near_as_the_index_allows(self):
        document = ezdxf.readfile(self.out["plan"] / "drawing.dxf")
        for frame, color in enumerate(palette(self.out["plan"])):
            index = document.layers.get(f"FRAME_{frame}").dxf.color
            difference = numpy.abs(numpy.array(ezdxf.colors.aci2rgb(index)) - 255 * color)
            self.assertLess(difference.max(), 60)

    def test_dxf_is_pairs_of_code_and_value(self):
        text = (self.out["plan"] / "drawing.dxf").read_text("ascii")
        self.assertTrue(text.endswith("  0\nEOF\n"))
        lines = text.splitlines()
        for code, value in zip(lines[::2], lines[1::2], strict=True):
            self.assertRegex(code, r"^ *\d+$")
            if 10 <= int(code) < 60:  # real numbers
                self.assertRegex(value, r"^-?\d+\.\d+(e[+-]\d+)?$")

    def test_svg_is_in_metres_and_true_to_size(self):
        root = xml.parse(self.out["plan"] / "drawing.svg").getroot()
        left, top, width, height = map(float, root.get("viewBox").split())
        self.assertAlmostEqual(float(root.get("width").removesuffix("mm")), 1e3 * width, 1)
        self.assertAlmostEqual(float(root.get("height").removesuffix("mm")), 1e3 * height, 1)
        self.check_svg(root, self.segments(), (left, top, width, height))

    def check_svg(self, root, segments, box):
        formula = re.fullmatch(r".*world x = x \+ (\S+), world y = (\S+) - y", root.find(SVG + "desc").text)
        x0, y0 = map(float, formula.groups())
        seen = set()
        for group in root.findall(SVG + "g"):
            frame = int(group.get("id").removeprefix("frame_"))
            self.assertEqual(group.get("stroke"), self.hex(frame))
            for path in group:
                plane = int(path.get("id").removeprefix("plane_"))
                self.assertEqual(self.result["plan"]["planes"][plane]["frame"], frame)
                numbers = re.fullmatch(r"M(\S+) (\S+)L(\S+) (\S+)", path.get("d")).groups()
                ends = numpy.array(numbers, float).reshape(2, 2)
                self.assertTrue((ends >= box[:2]).all() and (ends <= numpy.add(box[:2], box[2:])).all())
                world = numpy.stack([x0 + ends[:, 0], y0 - ends[:, 1]], 1)
                self.assertLess(numpy.abs(world - segments[plane][:, :2]).max(), 1e-6)
                seen.add(plane)
        self.assertEqual(seen, set(segments))

    def hex(self, frame):
        return "#" + "".join(f"{round(255 * c):02x}" for c in palette(self.out["plan"])[frame])

    def test_a_3d_result_leaves_no_drawing_behind(self):
        for name in ("drawing.dxf", "drawing.svg"):
            self.assertFalse((self.out["room"] / name).exists())
        points = numpy.zeros((1000, 3))
        points[:, 0] = numpy.linspace(0, 4, 1000)
        points[500:, :2] = points[500:, 1::-1]
        write_ply(self.folder / "plan.ply", points)
        write_ply(self.folder / "room.ply", room())
        self.assertEqual(self.unseen("planes", "plan.ply", "-o", "out", "--scale", 0.05).returncode, 0)
        self.assertTrue((self.folder / "out/drawing.dxf").exists())
        self.assertEqual(self.unseen("planes", "room.ply", "-o", "out").returncode, 0)
        self.assertEqual(list((self.folder / "out").glob("drawing.*")), [])


if __name__ == "__main__":
    unittest.main()
