# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""Reads the scenes of a page, written from docs/scene.md alone."""

import base64
import gzip
import json
import pathlib
import re
import struct

import numpy

TYPES = {"u8": "<u1", "u16": "<u2", "u32": "<u4", "i32": "<i4", "f32": "<f4"}


class Scene:
    def __init__(self, text):
        data = gzip.decompress(base64.b64decode(text, validate=True))
        magic, length = struct.unpack("<4sI", data[:8])
        assert magic == b"UNS1"
        self.header = json.loads(data[8 : 8 + length])
        self.buffer = data[(8 + length + 7) // 8 * 8 :]

    def __getitem__(self, structure):
        return next(s for s in self.header["structures"] if s["id"] == structure)

    def array(self, about):
        """The array as count × components, quantised ones as numbers."""
        kind = numpy.dtype(TYPES[about["type"]])
        count, components = about["count"], about.get("components", 1)
        assert about["offset"] % 8 == 0
        size = count * components
        raw = self.buffer[about["offset"] : about["offset"] + size * kind.itemsize]
        if about.get("encoding", "plain") == "delta":
            planes = numpy.frombuffer(raw, "u1").reshape(kind.itemsize, size)
            steps = numpy.ascontiguousarray(planes.T).view(f"<u{kind.itemsize}").reshape(components, count)
            values = numpy.cumsum(steps, axis=1, dtype=steps.dtype).T.copy().view(kind)
        else:
            values = numpy.frombuffer(raw, kind).reshape(count, components)
        if "low" not in about:
            return values
        low, high = numpy.asarray(about["low"]), numpy.asarray(about["high"])
        return low + values / (2 ** (8 * kind.itemsize) - 1) * (high - low)

    def quantity(self, structure, name):
        return self.array(next(q for q in self[structure]["quantities"] if q["id"] == name)["array"])[:, 0]


def scenes_of(page):
    text = pathlib.Path(page).read_text()
    return [Scene(s) for s in re.findall(r'<script type="text/plain" class="unseen-scene">([^<]*)</script>', text)]
