"""Run by Blender (tools/exports/check.py): imports files and writes what meshes are in each, as JSON: {file: [{"name", "faces",
"uvs", "positions"} ...]}, with y up again, in the order of their names. A format that this Blender cannot import is left out.

blender --background --factory-startup --python blender_meshes.py -- out.json file ...
"""
import json, sys

import bpy, numpy

numpy.bool = bool  # the glTF importer of Blender 3.4 still uses the name, which newer NumPys lack

out, *files = sys.argv[sys.argv.index("--") + 1:]
importers = {"obj": ["wm.obj_import"], "ply": ["wm.ply_import", "import_mesh.ply"], "usda": ["wm.usd_import"],
             "usdc": ["wm.usd_import"], "glb": ["import_scene.gltf"]}


def importer(extension):
    for name in importers[extension]:
        group, function = name.split(".")
        operator = getattr(getattr(bpy.ops, group), function)
        try:
            operator.get_rna_type()
            return operator
        except KeyError:
            pass
    return None


# PLY says nothing of axes: Blender's importer leaves them as they are.
def told(mesh, turned):
    positions = [mesh.matrix_world @ vertex.co for vertex in mesh.data.vertices]
    return {"name": mesh.name, "faces": len(mesh.data.polygons), "uvs": len(mesh.data.uv_layers),
            "positions": [[p.x, p.z, -p.y] if turned else [p.x, p.y, p.z] for p in positions]}


result = {}
for file in files:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    extension = file.rsplit(".", 1)[1]
    operator = importer(extension)
    if operator is None:
        print("this Blender cannot import ." + extension)
        continue
    operator(filepath=file)
    meshes = sorted((each for each in bpy.data.objects if each.type == "MESH"), key=lambda each: each.name)
    result[extension] = {"meshes": [told(each, extension != "ply") for each in meshes],
                         "cameras": sum(each.type == "CAMERA" for each in bpy.data.objects)}
with open(out, "w") as file:
    json.dump({"version": bpy.app.version_string, "files": result}, file)
