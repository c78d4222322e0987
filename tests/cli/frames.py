# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""RGB-D frames of boxes on a table, ray-cast by hand, and the PNG files they are kept in."""

import json
import zlib

import numpy

WIDTH, HEIGHT, FOCAL = 320, 240, 260.0
# Centre (on the table: z = half the height), yaw (rad) and size, m; table at z = 0, the camera 0.8 m above it.
BOXES = [((0.0, 1.1, 0.1), 0.3, (0.3, 0.2, 0.2)), ((0.0, 1.1, 0.27), 0.5, (0.2, 0.16, 0.14)),
         ((0.35, 1.3, 0.15), 0.0, (0.16, 0.2, 0.3))]
COLORS = [(170, 180, 160), (200, 60, 50), (60, 90, 190), (220, 180, 60)]


def png(image):
    """uint16 grey, uint8 grey or uint8 colour as a PNG."""
    def chunk(kind, data):
        body = kind + data
        return len(data).to_bytes(4, "big") + body + zlib.crc32(body).to_bytes(4, "big")

    height, width = image.shape[:2]
    bits, kind = 8 * image.dtype.itemsize, 2 if image.ndim == 3 else 0
    rows = image.astype(image.dtype.newbyteorder(">")).reshape(height, -1)
    data = b"".join(b"\0" + row.tobytes() for row in rows)
    header = width.to_bytes(4, "big") + height.to_bytes(4, "big") + bytes([bits, kind, 0, 0, 0])
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b"")


def tiff(image):
    """uint16 grey as a TIFF of one strip."""
    height, width = image.shape
    data = image.astype("<u2").tobytes()
    fields = [(256, width), (257, height), (258, 16), (259, 1), (262, 1), (273, 8 + 2 + 12 * 9 + 4), (277, 1), (278, height), (279, len(data))]
    entries = b"".join(tag.to_bytes(2, "little") + b"\4\0\1\0\0\0" + value.to_bytes(4, "little") for tag, value in fields)
    return b"II*\0\x08\0\0\0" + len(fields).to_bytes(2, "little") + entries + bytes(4) + data


def render(boxes=BOXES, pitch=0.55, height=0.8, noise=0.0005, seed=3):
    """Depth (m), object of each pixel (0 = table, −1 = nothing) and the up direction in the camera's coordinates."""
    cos, sin = numpy.cos(pitch), numpy.sin(pitch)
    turn = numpy.array([[1, 0, 0], [0, -sin, cos], [0, -cos, -sin]])  # camera to world
    v, u = numpy.mgrid[0:HEIGHT, 0:WIDTH]
    rays = numpy.stack([(u - (WIDTH - 1) / 2) / FOCAL, (v - (HEIGHT - 1) / 2) / FOCAL, numpy.ones(u.shape)], -1) @ turn.T
    origin = numpy.array([0, 0, height])
    with numpy.errstate(divide="ignore", invalid="ignore"):
        depth = numpy.where(rays[..., 2] < 0, -height / rays[..., 2], numpy.inf)
        owner = numpy.where(depth < 2.5, 0, -1)
        depth[owner < 0] = numpy.inf
        for i, (center, yaw, size) in enumerate(boxes):
            axes = numpy.array([[numpy.cos(yaw), numpy.sin(yaw), 0], [-numpy.sin(yaw), numpy.cos(yaw), 0], [0, 0, 1]])
            start, way = axes @ (origin - center), rays @ axes.T
            a, b = (-numpy.array(size) / 2 - start) / way, (numpy.array(size) / 2 - start) / way
            near, far = numpy.minimum(a, b).max(-1), numpy.maximum(a, b).min(-1)
            hit = (near < far) & (near > 0) & (near < depth)
            depth[hit], owner[hit] = near[hit], i + 1
    depth = depth + numpy.random.default_rng(seed).normal(0, noise, depth.shape)
    return depth, owner, turn.T @ [0, 0, 1]


def write_frame(folder, name="frame.json", **fields):
    """depth.png, color.png and a frame file; None takes a field away. Gives the frame file's name."""
    folder.mkdir(parents=True, exist_ok=True)
    depth, owner, _ = render()
    stored = numpy.where(numpy.isfinite(depth), numpy.rint(depth * 1000), 0).astype(numpy.uint16)
    (folder / "depth.png").write_bytes(png(stored))
    (folder / "color.png").write_bytes(png(numpy.array(COLORS + [(30, 30, 30)], numpy.uint8)[owner]))
    frame = {"depth": "depth.png", "depth_scale": 1000, "color": "color.png",
             "camera": {"fx": FOCAL, "fy": FOCAL, "cx": (WIDTH - 1) / 2, "cy": (HEIGHT - 1) / 2}}
    frame.update(fields)
    (folder / name).write_text(json.dumps({key: value for key, value in frame.items() if value is not None}))
    return name
