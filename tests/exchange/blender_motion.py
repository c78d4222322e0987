# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""Runs in Blender: imports the glTF file named second after `--` and writes where its objects are at each of the times (s) that follow,
and the camera, as JSON into the file named first."""

import json
import pathlib
import sys

import bpy

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
    report.append({item.name: [list(row) for row in item.matrix_world] for item in scene.objects})
pathlib.Path(target).write_text(json.dumps(report))
