# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""planes.csv read back by Python's csv, its sizes measured anew from the polygons of result.json."""

import csv
import unittest

import numpy

from results import ExchangeTest

HEADER_3D = ["id", "tag", "frame", "direction", "normal_x", "normal_y", "normal_z", "offset_m", "area_m2",
             "perimeter_m", "width_m", "height_m", "holes", "hole_area_m2", "points", "rms_m"]
HEADER_2D = ["id", "tag", "frame", "direction", "normal_x", "normal_y", "offset_m", "length_m", "start_x_m",
             "start_y_m", "end_x_m", "end_y_m", "points", "rms_m"]


def flat(ring, normal):
    """A ring in two coordinates of its plane (n×2)."""
    _, _, axes = numpy.linalg.svd(numpy.asarray(normal)[None])
    return (numpy.asarray(ring) - ring[0]) @ axes[1:].T


def ring_area(points):
    x, y = points.T
    return abs(x @ numpy.roll(y, -1) - y @ numpy.roll(x, -1)) / 2


def ring_length(points):
    return numpy.linalg.norm(points - numpy.roll(points, -1, 0), axis=1).sum()


def least_rectangle(points, step=1e-4):
    """Sides of the smallest of the bounding rectangles at all angles, `step` rad apart."""
    angles = numpy.arange(0, numpy.pi / 2, step)
    along = points @ numpy.array([numpy.cos(angles), numpy.sin(angles)])
    across = points @ numpy.array([-numpy.sin(angles), numpy.cos(angles)])
    sides = numpy.stack([numpy.ptp(along, axis=0), numpy.ptp(across, axis=0)])
    return sorted(sides[:, sides.prod(0).argmin()])


class Table(ExchangeTest):
    def rows(self, kind):
        with open(self.out[kind] / "planes.csv", newline="", encoding="utf-8") as file:
            return list(csv.reader(file, strict=True))

    def dicts(self, kind):
        header, *rows = self.rows(kind)
        return [dict(zip(header, row, strict=True)) for row in rows]

    def test_lines_end_as_in_rfc_4180(self):
        for out in self.out.values():
            data = (out / "planes.csv").read_bytes()
            self.assertTrue(data.endswith(b"\r\n"))
            self.assertEqual(data.count(b"\n"), data.count(b"\r\n"))

    def test_header_names_the_units(self):
        self.assertEqual(self.rows("room")[0], HEADER_3D)
        self.assertEqual(self.rows("plan")[0], HEADER_2D)

    def test_a_row_a_plane_with_the_same_bits_as_the_result(self):
        for kind, result in self.result.items():
            rows = self.dicts(kind)
            self.assertEqual(len(rows), len(result["planes"]))
            for row, plane in zip(rows, result["planes"]):
                for name in ("id", "frame", "direction", "points"):
                    self.assertEqual(int(row[name]), plane[name])
                self.assertEqual(row["tag"], plane["tag"] or "")
                self.assertEqual([float(row[f"normal_{c}"]) for c in "xyz" if f"normal_{c}" in row],
                                 plane["normal"][: result["dimensions"]])
                self.assertEqual((float(row["offset_m"]), float(row["rms_m"])), (plane["offset"], plane["rms"]))
                self.assertEqual(float(row["length_m" if kind == "plan" else "area_m2"]), plane["area"])

    def test_ends_of_lines(self):
        for row, plane in zip(self.dicts("plan"), self.result["plan"]["planes"]):
            ends = [[float(row[f"{end}_{c}_m"]) for c in "xy"] for end in ("start", "end")]
            self.assertEqual(ends, [p[:2] for p in plane["segment"]])

    def test_areas_and_lengths_of_outlines_and_holes(self):
        for kind in ("room", "utm", "window"):
            for row, plane in zip(self.dicts(kind), self.result[kind]["planes"]):
                outline, *holes = [flat(ring, plane["normal"]) for ring in plane["polygon"]]
                self.assertEqual(int(row["holes"]), len(holes))
                hole_area = sum(map(ring_area, holes))
                self.assertAlmostEqual(float(row["hole_area_m2"]), hole_area, 7)
                self.assertAlmostEqual(float(row["area_m2"]), ring_area(outline) - hole_area, 7)
                self.assertAlmostEqual(float(row["perimeter_m"]), ring_length(outline), 7)

    def test_no_rectangle_is_smaller(self):
        for kind in ("room", "utm", "window"):
            for row, plane in zip(self.dicts(kind), self.result[kind]["planes"]):
                if plane["tag"] in ("wall", "vertical"):
                    continue
                height, width = least_rectangle(flat(plane["polygon"][0], plane["normal"]))
                self.assertLessEqual(float(row["height_m"]), float(row["width_m"]))
                area = float(row["width_m"]) * float(row["height_m"])
                self.assertLessEqual(area, width * height * (1 + 1e-9))
                self.assertGreater(area, width * height * (1 - 1e-3))

    def test_walls_are_measured_upright(self):
        for kind in ("room", "utm", "window"):
            walls = [(row, plane) for row, plane in zip(self.dicts(kind), self.result[kind]["planes"])
                     if plane["tag"] == "wall"]
            self.assertTrue(walls)
            for row, plane in walls:
                ring = numpy.array(plane["polygon"][0])
                along = numpy.cross([0, 0, 1], plane["normal"])
                self.assertAlmostEqual(float(row["height_m"]), numpy.ptp(ring[:, 2]), 4)
                self.assertAlmostEqual(float(row["width_m"]), numpy.ptp(ring @ along / numpy.linalg.norm(along)), 6)

    def test_a_window_has_its_size(self):
        wall, = [row for row in self.dicts("window") if row["tag"] == "wall"]
        self.assertEqual(wall["holes"], "1")
        self.assertAlmostEqual(float(wall["hole_area_m2"]), 1.2, delta=0.25)
        self.assertAlmostEqual(float(wall["width_m"]), 4.0, delta=0.1)
        self.assertAlmostEqual(float(wall["height_m"]), 2.5, delta=0.1)
        self.assertAlmostEqual(float(wall["area_m2"]), 8.8, delta=0.4)


if __name__ == "__main__":
    unittest.main()
