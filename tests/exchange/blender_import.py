# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""Runs in Blender: imports scene.glb, planes.obj and planes.ply of each result folder named after `--` and writes what
Blender holds then as JSON into the file named first."""

import json
import pathlib
import sys

import bpy


def base_color(material):
    """Linear; None for a material without light (that of the points)."""
    node = material.node_tree.nodes.get("Principled BSDF")
    return node and list(node.inputs["Base Color"].default_value)[:3]


def facts_of(item):
    """One object in world coordinates."""
    facts = {"name": item.name, "type": item.type, "parent": item.parent and item.parent.name}
    if "offset" in item:
        facts["offset"] = list(item["offset"])
    if item.type != "MESH":
        return facts
    mesh = item.data
    corners = [item.matrix_world @ vertex.co for vertex in mesh.vertices]
    facts["low"] = [min(c[i] for c in corners) for i in range(3)]
    facts["high"] = [max(c[i] for c in corners) for i in range(3)]
    facts["vertices"], facts["edges"], facts["faces"] = len(corners), len(mesh.edges), len(mesh.polygons)
    facts["normals"] = [list(item.matrix_world.to_3x3() @ face.normal) for face in mesh.polygons]
    facts["area"] = sum(face.area for face in mesh.polygons)
    facts["materials"] = [[m.name, base_color(m)] for m in mesh.materials if m]
    facts["colors"] = sorted({tuple(c.color[:3]) for layer in mesh.color_attributes for c in layer.data})  # linear
    return facts


def imported(importer, path, **options):
    """What an importer makes of a file in an empty scene."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    done = importer(filepath=str(path), **options)
    bpy.context.view_layer.update()
    return {"done": done == {"FINISHED"}, "objects": [facts_of(item) for item in bpy.context.scene.objects]}


target, *folders = sys.argv[sys.argv.index("--") + 1 :]
report = {}
for folder in map(pathlib.Path, folders):
    report[folder.name] = {
        # Other shadings fail in Debian's Blender 3.4.1: its glTF importer uses np.bool, which numpy 1.24 removed.
        "glb": imported(bpy.ops.import_scene.gltf, folder / "scene.glb", import_shading="FLAT"),
        "obj": imported(bpy.ops.wm.obj_import, folder / "planes.obj", forward_axis="Y", up_axis="Z"),
        "ply": imported(bpy.ops.import_mesh.ply, folder / "planes.ply"),
    }
pathlib.Path(target).write_text(json.dumps(report))
