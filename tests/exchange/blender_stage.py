# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""Runs in Blender: loads the result.json named third after `--` with the add-on in the folder named second, and writes what it made as JSON
into the file named first: rigid bodies, and where they are at the frames that follow the physics and the frame of the impact."""

import json
import pathlib
import sys

import bpy

target, addon, result, shot, physics, impact, *frames = sys.argv[sys.argv.index("--") + 1 :]
sys.path.insert(0, addon)
import unseen_stage  # noqa: E402

bpy.ops.wm.read_factory_settings(use_empty=True)
unseen_stage.register()
scene = bpy.context.scene
scene.unseen.path, scene.unseen.shot, scene.unseen.physics = result, shot, physics
scene.unseen.impact_frame = float(impact) - 40
assert bpy.ops.unseen.load() == {"FINISHED"}
scene.unseen.impact_frame = float(impact)
assert bpy.ops.unseen.align() == {"FINISHED"}
bodies = {item.name: {"mass": item.rigid_body.mass, "restitution": item.rigid_body.restitution, "friction": item.rigid_body.friction,
                      "shape": item.rigid_body.collision_shape, "type": item.rigid_body.type,
                      "size": list(item.dimensions)} for item in scene.objects if item.rigid_body}
poses = []
wanted = set(map(int, frames))
for frame in range(min(wanted), max(wanted) + 1):  # a simulation goes from frame to frame
    scene.frame_set(frame)
    if frame in wanted:
        evaluated = bpy.context.evaluated_depsgraph_get()
        poses.append({name: [list(row) for row in scene.objects[name].evaluated_get(evaluated).matrix_world] for name in bodies})
camera = scene.camera
pathlib.Path(target).write_text(json.dumps({
    "bodies": bodies, "poses": poses, "fps": scene.render.fps / scene.render.fps_base, "split": scene.rigidbody_world.use_split_impulse,
    "camera": [list(row) for row in camera.matrix_world] if camera else None,
    "background": camera.data.background_images[0].clip.name if camera and camera.data.background_images else None}))
