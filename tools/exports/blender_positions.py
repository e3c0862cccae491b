"""Run by Blender (tools/exports/check.py): imports an OBJ, lets a PC2 point cache move it, and writes the positions of its
vertices at some frames as JSON: [[[x, y, z] ...] a frame].

blender --background --factory-startup --python blender_positions.py -- rest.obj cache.pc2 frames out.json
"""
import json, sys

import bpy

rest, cache, frames, out = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.object.select_all(action="SELECT")
bpy.ops.object.delete()
bpy.ops.wm.obj_import(filepath=rest)  # y up in the file, z up in Blender: the object is turned, its mesh is not
mesh = bpy.context.selected_objects[0]
modifier = mesh.modifiers.new("cache", "MESH_CACHE")
modifier.cache_format = "PC2"
modifier.filepath = cache

positions = []
for frame in map(int, frames.split(",")):
    bpy.context.scene.frame_set(frame)
    moved = mesh.evaluated_get(bpy.context.evaluated_depsgraph_get())
    # From Blender's world, where z is up, back to ours.
    world = [moved.matrix_world @ vertex.co for vertex in moved.data.vertices]
    positions.append([[p.x, p.z, -p.y] for p in world])
uvs = len(mesh.data.uv_layers[0].data) if mesh.data.uv_layers else 0
with open(out, "w") as file:
    json.dump({"version": bpy.app.version_string, "frames": positions, "faces": len(mesh.data.polygons), "uvs": uvs}, file)
