# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""Runs in Blender: imports the BVH file named second after `--`, centimetres with y up, and writes where the heads of its bones are in each of
the frames (from 0) that follow, as JSON into the file named first."""

import json
import pathlib
import sys

import bpy

target, path, *frames = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_anim.bvh(filepath=path, axis_forward="-Z", axis_up="Y", global_scale=0.01, frame_start=0, use_fps_scale=False, rotate_mode="NATIVE")
rig = bpy.context.object
report = []
for frame in map(int, frames):
    bpy.context.scene.frame_set(frame)
    report.append({bone.name: list(rig.matrix_world @ bone.head) for bone in rig.pose.bones})
pathlib.Path(target).write_text(json.dumps(report))
