# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""blender -b --factory-startup --python rendered_scene.py -- SEED OUT: things on a table under area lights, path-traced: color.png, depth.npy (m
along the optical axis), truth.json as `unseen synth cuboids` writes it."""
import json
import math
import pathlib
import random
import sys

import bpy
import mathutils
import numpy as np

WIDTH, HEIGHT, FOCAL = 640, 480, 525.0
SAMPLES, BOUNCES = 16, 3


def place(rng, boxes, size, limit):
    """Where a box of this size lies: on the table, or on another's top; None where it would be inside something."""
    for _ in range(60):
        on = rng.choice(boxes) if boxes and rng.random() < 0.4 else None
        turn = rng.uniform(0, math.pi) if on is None or rng.random() < 0.4 else on["turn"]
        if on is None:
            x, y, bottom = rng.uniform(-limit, limit), rng.uniform(-0.6 * limit, 0.6 * limit), 0.0
        else:
            u, v = (rng.uniform(-0.35, 0.35) * s for s in on["size"][:2])
            c, s = math.cos(on["turn"]), math.sin(on["turn"])
            x, y, bottom = on["x"] + c * u - s * v, on["y"] + s * u + c * v, on["top"]
        box = {"x": x, "y": y, "turn": turn, "size": size, "bottom": bottom, "top": bottom + size[2], "on": on}
        if all(b is on or b["top"] <= bottom or b["bottom"] >= box["top"] or apart(box, b) for b in boxes):
            return box
    return None


def corners(box, grown=0.0):
    c, s = math.cos(box["turn"]), math.sin(box["turn"])
    half = [e / 2 + grown for e in box["size"][:2]]
    return [(box["x"] + c * i * half[0] - s * j * half[1], box["y"] + s * i * half[0] + c * j * half[1]) for i, j in ((1, 1), (-1, 1), (-1, -1), (1, -1))]


def apart(a, b, gap=0.004):
    """True if an axis of either footprint separates them."""
    for turn in (a["turn"], a["turn"] + math.pi / 2, b["turn"], b["turn"] + math.pi / 2):
        n = (math.cos(turn), math.sin(turn))
        p, q = ([x * n[0] + y * n[1] for x, y in corners(box)] for box in (a, b))
        if min(p) > max(q) + gap or min(q) > max(p) + gap:
            return True
    return False


def stands_alone(boxes):
    """Whether each box's centre is over what carries it: nothing here leans."""
    for b in boxes:
        if b["on"]:
            c, s = math.cos(b["on"]["turn"]), math.sin(b["on"]["turn"])
            dx, dy = b["x"] - b["on"]["x"], b["y"] - b["on"]["y"]
            u, v = c * dx + s * dy, -s * dx + c * dy
            if abs(u) > 0.4 * b["on"]["size"][0] or abs(v) > 0.4 * b["on"]["size"][1]:
                return False
    return True


def material(rng, kind):
    m = bpy.data.materials.new(kind)
    m.use_nodes = True
    nodes, links = m.node_tree.nodes, m.node_tree.links
    shader = nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = rng.uniform(0.35, 0.9)
    color = lambda: (rng.uniform(0.05, 0.9), rng.uniform(0.05, 0.9), rng.uniform(0.05, 0.9), 1.0)
    if kind == "plain":
        shader.inputs["Base Color"].default_value = color()
        return m
    texture = nodes.new({"noise": "ShaderNodeTexNoise", "checker": "ShaderNodeTexChecker", "brick": "ShaderNodeTexBrick", "voronoi": "ShaderNodeTexVoronoi"}[kind])
    texture.inputs["Scale"].default_value = rng.uniform(2, 9)
    where = nodes.new("ShaderNodeTexCoord")
    links.new(where.outputs["Generated"], texture.inputs["Vector"])
    if kind in ("checker", "brick"):
        for name in ("Color1", "Color2"):
            texture.inputs[name].default_value = color()
        links.new(texture.outputs["Color"], shader.inputs["Base Color"])
    else:
        ramp = nodes.new("ShaderNodeValToRGB")
        for stop in ramp.color_ramp.elements:
            stop.color = color()
        links.new(texture.outputs["Distance" if kind == "voronoi" else "Fac"], ramp.inputs["Fac"])
        links.new(ramp.outputs["Color"], shader.inputs["Base Color"])
    return m


def cube(rng, center, size, turn):
    bpy.ops.mesh.primitive_cube_add(size=1, location=center, rotation=(0, 0, turn))
    thing = bpy.context.object
    thing.scale = size
    bevel = thing.modifiers.new("edges", "BEVEL")
    bevel.width, bevel.segments = 0.0015, 2
    thing.data.materials.append(material(rng, rng.choice(["plain", "plain", "noise", "checker", "brick", "voronoi"])))


def build(rng):
    boxes, limit = [], rng.uniform(0.15, 0.3)
    for _ in range(rng.randint(2, 8)):
        size = [rng.uniform(0.05, 0.3), rng.uniform(0.04, 0.2), rng.uniform(0.03, 0.25)]
        box = place(rng, boxes, size, limit)
        if box and stands_alone(boxes + [box]):
            boxes.append(box)
    for b in boxes:
        cube(rng, (b["x"], b["y"], (b["bottom"] + b["top"]) / 2), b["size"], b["turn"])
    bpy.ops.mesh.primitive_plane_add(size=3)
    bpy.context.object.data.materials.append(material(rng, rng.choice(["plain", "noise"])))
    if rng.random() < 0.5:  # a wall behind
        bpy.ops.mesh.primitive_plane_add(size=4, location=(0, rng.uniform(0.7, 1.2), 0), rotation=(math.pi / 2, 0, rng.uniform(-0.3, 0.3)))
        bpy.context.object.data.materials.append(material(rng, "plain"))
    for _ in range(rng.randint(1, 3)):
        bpy.ops.object.light_add(type="AREA", location=(rng.uniform(-1.5, 1.5), rng.uniform(-1.8, 0.5), rng.uniform(1.2, 2.5)))
        light = bpy.context.object
        light.data.energy, light.data.size = rng.uniform(15, 60), rng.uniform(0.2, 1.2)
        light.rotation_euler = (-light.location).to_track_quat("-Z", "Y").to_euler()
    return boxes


def look(rng):
    azimuth, pitch, distance = rng.uniform(-0.6, 0.6), math.radians(rng.uniform(20, 50)), rng.uniform(0.7, 1.3)
    target = mathutils.Vector((0, 0, rng.uniform(0.02, 0.12)))
    place = target + distance * mathutils.Vector((math.sin(azimuth) * math.cos(pitch), -math.cos(azimuth) * math.cos(pitch), math.sin(pitch)))
    bpy.ops.object.camera_add(location=place, rotation=(target - place).to_track_quat("-Z", "Y").to_euler())
    camera = bpy.context.object
    camera.data.sensor_width, camera.data.lens = 36.0, 36.0 * FOCAL / WIDTH
    bpy.context.scene.camera = camera
    bpy.context.view_layer.update()
    return camera.matrix_world


def render(out):
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.samples, scene.cycles.max_bounces = "CYCLES", SAMPLES, BOUNCES
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = WIDTH, HEIGHT, 100
    scene.view_layers[0].use_pass_z = True
    scene.world.node_tree.nodes["Background"].inputs[1].default_value = 0.3
    scene.use_nodes = True
    tree = scene.node_tree
    file = tree.nodes.new("CompositorNodeOutputFile")
    file.base_path, file.file_slots[0].path = str(out), "depth"
    file.format.file_format, file.format.color_depth = "OPEN_EXR", "32"
    tree.links.new(tree.nodes["Render Layers"].outputs["Depth"], file.inputs[0])
    scene.render.filepath = str(out / "color.png")
    bpy.ops.render.render(write_still=True)
    file = next(out.glob("depth*.exr"))
    pixels = np.array(bpy.data.images.load(str(file)).pixels[:]).reshape(HEIGHT, WIDTH, 4)
    np.save(out / "depth.npy", pixels[::-1, :, 0])
    file.unlink()


def touching(boxes):
    """Contacts: a box and what it lies on; also what it lies on by chance, at the same height."""
    contacts = []
    for i, b in enumerate(boxes):
        if b["on"] is None:
            contacts.append({"a": 0, "b": i + 1, "kind": "touching"})
        for j, o in enumerate(boxes):
            if o is not b and abs(o["top"] - b["bottom"]) < 1e-9 and not apart(b, o, 0.0):
                contacts.append({"a": min(i, j) + 1, "b": max(i, j) + 1, "kind": "touching"})
    return contacts


def main(seed, out):
    out.mkdir(parents=True, exist_ok=True)
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    rng = random.Random(seed)
    boxes = build(rng)
    camera = look(rng)
    render(out)
    # The camera of the frames looks along +z with y down.
    pose = camera @ mathutils.Matrix.Diagonal((1, -1, -1, 1))
    cuboids = []
    for i, b in enumerate(boxes):
        c, s = math.cos(b["turn"]), math.sin(b["turn"])
        cuboids.append({"id": i + 1, "center": [b["x"], b["y"], (b["bottom"] + b["top"]) / 2], "axes": [[c, s, 0], [-s, c, 0], [0, 0, 1]], "size": b["size"]})
    truth = {"schema": 1, "capability": "synth cuboids", "family": "rendered", "stands": True, "T_world_camera": [list(row) for row in pose],
             "supports": [{"id": 0, "kind": "ground", "normal": [0, 0, 1], "offset": 0}], "cuboids": cuboids, "contacts": touching(boxes)}
    (out / "truth.json").write_text(json.dumps(truth, indent=1))


if __name__ == "__main__":
    arguments = sys.argv[sys.argv.index("--") + 1:]
    main(int(arguments[0]), pathlib.Path(arguments[1]))
