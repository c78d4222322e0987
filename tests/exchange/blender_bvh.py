# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""Runs in Blender: imports the BVH file named second after `--`, centimetres with y up, and writes where the heads of its bones are in each of
the frames (from 0) that follow, as JSON into the file named first."""

import builtins
import json
import pathlib
import sys

import bpy

# The BVH importer of Debian's Blender 3.4.1 opens files in mode "rU", which Python 3.11 removed.
plain_open = builtins.open
builtins.open = lambda path, mode="r", *more, **named: plain_open(path, mode.replace("U", ""), *more, **named)

target, path, *frames = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_anim.bvh(filepath=path, axis_forward="-Z", axis_up="Y", global_scale=0.01, frame_start=1, use_fps_scale=False, rotate_mode="NATIVE")
rig = bpy.context.object
report = []
for frame in map(int, frames):
    bpy.context.scene.frame_set(1 + frame)
    report.append({bone.name: list(rig.matrix_world @ bone.head) for bone in rig.pose.bones})
pathlib.Path(target).write_text(json.dumps(report))
