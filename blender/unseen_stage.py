# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""Blender add-on: loads result.json of `unseen collision` or `unseen stage` with its bodies, their motion and physics."""

import json
import math
import pathlib

import bmesh
import bpy
import numpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, PointerProperty, StringProperty
from mathutils import Matrix, Vector

bl_info = {
    "name": "unseen: staged collisions",
    "author": "the unseen authors",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "3D view > sidebar > unseen",
    "description": "Loads reconstructed and staged collisions as keyframes and rigid bodies",
    "category": "Animation",
}

HANDOVER = 2  # frames after the last impact at which Blender's simulation takes over
IMPACT = "unseen_impact_frame"  # custom property of a collection: the scene's frame of its first impact


class LoadError(Exception):
    """What a user can mend."""


def read_json(path):
    try:
        return json.loads(pathlib.Path(path).read_text())
    except (OSError, ValueError) as error:
        raise LoadError(f"{path}: {error}") from error


# --- shapes


def read_obj(path):
    vertices, faces = [], []
    for line in pathlib.Path(path).read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) for word in words[1:]]
            faces.append([c - 1 if c > 0 else len(vertices) + c for c in corners])
    return vertices, faces


def read_off(path):
    words = [word for line in pathlib.Path(path).read_text().splitlines() for word in line.split("#")[0].split()]
    count, at = int(words[1]), 4 + 3 * int(words[1])
    vertices = numpy.array(words[4:at], float).reshape(count, 3).tolist()
    faces = []
    for _ in range(int(words[2])):
        size = int(words[at])
        faces.append([int(word) for word in words[at + 1 : at + 1 + size]])
        at += 1 + size
    return vertices, faces


def read_with_blender(path, operator):
    """Through one of Blender's own importers, none of which turns the axes."""
    operator(filepath=str(path))
    item = bpy.context.object
    vertices = [list(v.co) for v in item.data.vertices]
    faces = [list(p.vertices) for p in item.data.polygons]
    mesh = item.data
    bpy.data.objects.remove(item)
    bpy.data.meshes.remove(mesh)
    return vertices, faces


def read_mesh(path):
    path = pathlib.Path(path)
    if not path.is_file():
        raise LoadError(f"{path}: no such mesh")
    ending = path.suffix.lower()
    if ending == ".obj":
        return read_obj(path)
    if ending == ".off":
        return read_off(path)
    if ending == ".stl":
        return read_with_blender(path, bpy.ops.import_mesh.stl)
    if ending == ".ply":
        return read_with_blender(path, bpy.ops.import_mesh.ply)
    raise LoadError(f"{path}: an OBJ, OFF, STL or PLY file was expected")


def about_center_of_mass(vertices, faces):
    """The vertices of a closed mesh from its centre of mass (tetrahedra from one point to each triangle)."""
    v = numpy.array(vertices, float)
    origin = v.mean(0)
    triangles = numpy.array([(f[0], f[i], f[i + 1]) for f in faces for i in range(1, len(f) - 1)])
    a, b, c = (v[triangles[:, i]] - origin for i in range(3))
    volumes = numpy.einsum("ij,ij->i", a, numpy.cross(b, c))
    return (v - origin - (volumes[:, None] * (a + b + c)).sum(0) / (4 * volumes.sum())).tolist()


def make_mesh(body, folder, centered):
    """A mesh whose origin is the body's centre of mass, and the shape that rigid bodies have."""
    mesh = bpy.data.meshes.new(body["name"])
    if "mesh" in body:
        vertices, faces = read_mesh(folder / body["mesh"])
        mesh.from_pydata(vertices if centered else about_center_of_mass(vertices, faces), [], faces)
        mesh.update()
        return mesh, "CONVEX_HULL"
    shape = bmesh.new()
    if "box" in body:
        bmesh.ops.create_cube(shape, size=1.0, matrix=Matrix.Diagonal((*body["box"], 1.0)))
    else:
        radius = body["sphere"] if "sphere" in body else body["size"] / 2
        bmesh.ops.create_uvsphere(shape, u_segments=48, v_segments=24, radius=radius)
    shape.to_mesh(mesh)
    shape.free()
    return mesh, "BOX" if "box" in body else "SPHERE"


# --- results


def shot_of(result, folder, named):
    path = pathlib.Path(named) if named else pathlib.Path(result["input"]["path"])
    for candidate in (path, folder / path, folder / path.name, folder.parent / path.name):
        if candidate.is_file():
            return read_json(candidate), candidate.parent
    raise LoadError(f"{path}: the shot that the result was made from was not found; name it beside the result")


def of_collision(result, folder, named_shot):
    """What a result of `unseen collision` says, in the form of one of `unseen stage`."""
    if not result["impacts"]:
        raise LoadError("the result has no collision")
    shot, shot_folder = shot_of(result, folder, named_shot)
    shapes = {body["name"]: body for body in shot["bodies"]}
    first = result["impacts"][0]
    ratio = (result["mass_ratio"] or {"value": 1.0})["value"]
    keys = [key for key, body in zip("ab", result["bodies"]) if not body.get("fixed")]
    bodies = []
    for key, body in zip("ab", result["bodies"]):
        if key in keys:
            bodies.append({**shapes[body["name"]], "mass": ratio if key == "b" else 1.0,
                           "restitution": math.sqrt(first["restitution"]["value"]), "friction": math.sqrt(first["friction"] or 0.0)})
    frames = [{"t": frame["t"], "bodies": [frame.get(key) for key in keys]} for frame in result["frames"]]
    walls = []
    if result["fixed"]:
        normal = numpy.array(first["normal"])
        walls.append({"name": result["fixed"], "normal": first["normal"], "offset": float(normal @ first["contact_point"]),
                      "restitution": math.sqrt(first["restitution"]["value"]), "friction": math.sqrt(first["friction"] or 0.0)})
    return {"fps": result["fps"], "gravity": shot.get("gravity", 9.81), "bodies": bodies, "walls": walls, "frames": frames,
            "impacts": result["impacts"], "folder": shot_folder, "centered": False, "camera": result["camera"],
            "T_world_camera": result["T_world_camera"], "clip": shot_folder / shot["video"] if "video" in shot else None}


def of_stage(result, folder):
    return {**result, "folder": folder, "centered": True, "camera": None, "clip": None}


def read_motion(path, named_shot=""):
    path = pathlib.Path(path)
    if path.is_dir():
        path = path / "result.json"
    result = read_json(path)
    kind = result.get("capability")
    if kind == "collision":
        return of_collision(result, path.parent, named_shot)
    if kind == "stage":
        return of_stage(result, path.parent)
    raise LoadError(f"{path}: a result of unseen collision or unseen stage was expected")


# --- scene


def ensure_world(scene, motion):
    """Rigid bodies as the estimates mean them: split impulses, for else Bullet adds to the restitution."""
    if scene.rigidbody_world is None:
        bpy.ops.rigidbody.world_add()
    world = scene.rigidbody_world
    if world.collection is None:
        world.collection = bpy.data.collections.new("RigidBodyWorld")
    world.use_split_impulse = True
    world.substeps_per_frame = max(world.substeps_per_frame, math.ceil(960 / motion["fps"]))
    world.solver_iterations = max(world.solver_iterations, 50)
    scene.gravity = (0, 0, -motion["gravity"])
    return world


def make_rigid(scene, item, shape, kind, mass, body):
    scene.rigidbody_world.collection.objects.link(item)
    rigid = item.rigid_body
    rigid.type = kind
    rigid.collision_shape = shape
    rigid.mass = mass
    rigid.restitution = body.get("restitution", 1.0)  # Bullet multiplies the restitutions of two
    rigid.friction = body.get("friction", 0.0)
    rigid.linear_damping = rigid.angular_damping = 0.0
    rigid.use_margin = True
    rigid.collision_margin = 0.0
    return rigid


def add_keys(item, keys):
    """Linear keys (frame, p, q); quaternions keep their sign."""
    action = bpy.data.actions.new(item.name)
    item.animation_data_create().action = action
    rotations = numpy.array([q for _, _, q in keys])
    for i in range(1, len(rotations)):
        if rotations[i] @ rotations[i - 1] < 0:
            rotations[i] *= -1
    values = numpy.hstack([[p for _, p, _ in keys], rotations])
    frames = [frame for frame, _, _ in keys]
    for column in range(7):
        path, index = ("location", column) if column < 3 else ("rotation_quaternion", column - 3)
        curve = action.fcurves.new(path, index=index)
        curve.keyframe_points.add(len(keys))
        curve.keyframe_points.foreach_set("co", numpy.column_stack([frames, values[:, column]]).ravel())
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
        curve.update()


def hand_over(item, impact_frame):
    """Keys until shortly after the impact, from there on the simulation. Not before: Bullet takes contacts ahead of time when bodies come
    within a step of each other, which can rob them of all their bounce, and Blender has no setting against it."""
    rigid = item.rigid_body
    last = math.ceil(impact_frame) + HANDOVER
    for value, frame in ((True, last), (False, last + 1)):
        rigid.kinematic = value
        rigid.keyframe_insert("kinematic", frame=frame)


def add_wall(scene, collection, wall):
    mesh = bpy.data.meshes.new(wall["name"])
    mesh.from_pydata([(-5, -5, 0), (5, -5, 0), (5, 5, 0), (-5, 5, 0)], [], [(0, 1, 2, 3)])
    item = bpy.data.objects.new(wall["name"], mesh)
    collection.objects.link(item)
    item.rotation_mode = "QUATERNION"
    item.rotation_quaternion = Vector((0, 0, 1)).rotation_difference(Vector(wall["normal"]))
    item.location = wall["offset"] * Vector(wall["normal"])
    make_rigid(scene, item, "MESH", "PASSIVE", 1.0, wall)


def add_camera(scene, collection, motion, start_frame):
    """The camera of the shot, with the clip behind what it sees."""
    c = motion["camera"]
    data = bpy.data.cameras.new("camera")
    item = bpy.data.objects.new("camera", data)
    collection.objects.link(item)
    item.matrix_world = Matrix(motion["T_world_camera"]) @ Matrix.Diagonal((1, -1, -1, 1))  # Blender's look along −z with y up
    width, height = c["width"], c["height"]
    data.sensor_fit = "HORIZONTAL"
    data.lens = c["fx"] * data.sensor_width / width
    data.shift_x = -(c["cx"] - (width - 1) / 2) / width
    data.shift_y = (c["cy"] - (height - 1) / 2) / width
    scene.camera = item
    scene.render.resolution_x, scene.render.resolution_y = width, height
    if motion["clip"] is None or not motion["clip"].is_file():
        return
    clip = bpy.data.movieclips.load(str(motion["clip"]))
    clip.frame_start = round(start_frame)
    data.show_background_images = True
    background = data.background_images.new()
    background.source = "MOVIE_CLIP"
    background.clip = clip
    background.alpha = 1.0


def load(context, path, shot="", impact_frame=100.0, physics="KEYS", clip=True):
    """Makes a collection of what the result holds; its first impact happens at `impact_frame` of the scene."""
    motion = read_motion(path, shot)
    if not motion["impacts"]:
        raise LoadError("the result has no collision")
    scene = context.scene
    fps = motion["fps"]
    scene.render.fps = max(1, round(fps))
    scene.render.fps_base = scene.render.fps / fps
    start = impact_frame - motion["impacts"][0]["time"] * fps  # where t = 0 lies
    collection = bpy.data.collections.new(pathlib.Path(path).parent.name or "collision")
    scene.collection.children.link(collection)
    collection[IMPACT] = impact_frame
    ensure_world(scene, motion)
    for i, body in enumerate(motion["bodies"]):
        keys = [(start + frame["t"] * fps, frame["bodies"][i]["p"], frame["bodies"][i]["q"]) for frame in motion["frames"] if frame["bodies"][i]]
        mesh, shape = make_mesh(body, motion["folder"], motion["centered"])
        item = bpy.data.objects.new(body["name"], mesh)
        item.rotation_mode = "QUATERNION"
        collection.objects.link(item)
        rigid = make_rigid(scene, item, shape, "ACTIVE", body["mass"], body)
        rigid.kinematic = True
        if not keys:
            continue
        add_keys(item, keys)
        if physics == "SIMULATION":
            own = [impact["time"] for impact in motion["impacts"] if body["name"] in impact["between"]]
            hand_over(item, start + max(own, default=motion["impacts"][0]["time"]) * fps)
    for wall in motion["walls"]:
        add_wall(scene, collection, wall)
    if clip and motion["camera"] and motion["camera"]["width"]:
        add_camera(scene, collection, motion, start)
    last = start + motion["frames"][-1]["t"] * fps
    scene.frame_end = max(scene.frame_end, math.ceil(last))
    scene.rigidbody_world.point_cache.frame_end = scene.frame_end
    return collection


def shift(collection, frames):
    """Moves all that happens in a collection in time."""
    for item in collection.all_objects:
        if item.animation_data is None or item.animation_data.action is None:
            continue
        for curve in item.animation_data.action.fcurves:
            for point in curve.keyframe_points:
                point.co.x += frames
                point.handle_left.x += frames
                point.handle_right.x += frames
            curve.update()
    collection[IMPACT] += frames


# --- user interface


class UnseenSettings(bpy.types.PropertyGroup):
    path: StringProperty(name="Result", subtype="FILE_PATH", description="result.json of unseen collision or unseen stage")
    shot: StringProperty(name="Shot", subtype="FILE_PATH", description="The SHOT.json of a collision, if it was moved")
    impact_frame: FloatProperty(name="Impact at frame", default=100.0, description="When the first impact happens")
    physics: EnumProperty(name="After the impact", default="KEYS",
                          items=[("KEYS", "Reconstruction", "Keyframes throughout"),
                                 ("SIMULATION", "Simulation", "Blender's rigid bodies take over shortly after the last impact")])
    clip: BoolProperty(name="Clip behind the camera", default=True)


class UNSEEN_OT_load(bpy.types.Operator):
    """Load a reconstructed or staged collision"""

    bl_idname = "unseen.load"
    bl_label = "Load"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        settings = context.scene.unseen
        try:
            load(context, bpy.path.abspath(settings.path), bpy.path.abspath(settings.shot) if settings.shot else "", settings.impact_frame,
                 settings.physics, settings.clip)
        except LoadError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class UNSEEN_OT_align(bpy.types.Operator):
    """Shift every loaded collision so that its first impact happens at the frame given"""

    bl_idname = "unseen.align"
    bl_label = "Align impacts"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        for collection in bpy.data.collections:
            if IMPACT in collection:
                shift(collection, context.scene.unseen.impact_frame - collection[IMPACT])
        return {"FINISHED"}


class UNSEEN_PT_panel(bpy.types.Panel):
    bl_label = "Collisions"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "unseen"

    def draw(self, context):
        settings = context.scene.unseen
        for name in ("path", "shot", "impact_frame", "physics", "clip"):
            self.layout.prop(settings, name)
        self.layout.operator(UNSEEN_OT_load.bl_idname)
        self.layout.operator(UNSEEN_OT_align.bl_idname)


CLASSES = (UnseenSettings, UNSEEN_OT_load, UNSEEN_OT_align, UNSEEN_PT_panel)


def register():
    for item in CLASSES:
        bpy.utils.register_class(item)
    bpy.types.Scene.unseen = PointerProperty(type=UnseenSettings)


def unregister():
    del bpy.types.Scene.unseen
    for item in reversed(CLASSES):
        bpy.utils.unregister_class(item)


if __name__ == "__main__":
    register()
