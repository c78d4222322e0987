# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""Runs in Blender: imports the glTF file named second after `--` and writes where its objects are at each of the times (s) that follow, as
JSON into the file named first: the matrix of each, and how far a mesh reaches from its origin."""

import json
import pathlib
import sys

import bpy

def reach(item):
    """Along the world's axes."""
    if item.type != "MESH":
        return None
    corners = [item.matrix_world @ vertex.co - item.matrix_world.translation for vertex in item.data.vertices]
    return [max(abs(c[i]) for c in corners) for i in range(3)]


target, glb, *times = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.fps = 120
# Other shadings fail in Debian's Blender 3.4.1: its glTF importer uses np.bool, which numpy 1.24 removed.
bpy.ops.import_scene.gltf(filepath=glb, import_shading="FLAT")
report = []
for time in map(float, times):
    frame = time * scene.render.fps
    scene.frame_set(int(frame), subframe=frame - int(frame))
    report.append({item.name: {"matrix": [list(row) for row in item.matrix_world], "reach": reach(item)} for item in scene.objects})
pathlib.Path(target).write_text(json.dumps(report))
