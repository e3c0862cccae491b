"""Run by Blender (tools/pairs): draws cloth of an OBJ file with Cycles on the processor, under the lights of clothsim's studio.

blender --background --factory-startup --python blender_picture.py -- order.json

The order (tools/pairs makes it) has camera, light, cloth and solids as clothsim knows them: metres, y up, colours in sRGB. The
picture is mapped to the screen by the curve of shaders/render/tone.glsl, so that the light is compared and not the film.
"""
import json, math, pathlib, sys

import bpy, numpy
from mathutils import Vector

root = pathlib.Path(__file__).resolve().parent.parent.parent
order = json.loads(pathlib.Path(sys.argv[sys.argv.index("--") + 1]).read_text())

# As makeLook() has them (src/render/look.cpp): linear light, and colours in sRGB.
KEY, FILL, SKY = (1.22, 1.15, 1.04), (0.16, 0.20, 0.28), (0.34, 0.38, 0.44)
SOLID, FLOOR, BACKDROP_TOP, BACKDROP_BOTTOM = (0.80, 0.82, 0.84), (0.70, 0.73, 0.76), (0.32, 0.38, 0.45), (0.62, 0.67, 0.72)
GLOW = (0.16, 0.17, 0.18)
PRINT_SEEN_FROM_BEHIND = 0.45  # shaders/render/dye.glsl
KNEE = 0.65  # shaders/render/tone.glsl
FLOOR_RADIUS, POOL_SHARPNESS = 6.0, 14.0


def linear(srgb):
    srgb = numpy.asarray(srgb, float)
    return numpy.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def encoded(light):
    light = numpy.clip(light, 0, None)
    above = numpy.maximum(light - KNEE, 0)
    light = numpy.minimum(light, KNEE) + above / (1 + above / (1 - KNEE))
    return numpy.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


def turned(v):  # Blender's z is up
    return Vector((v[0], -v[2], v[1]))


def pixels_of(file):
    """Rows from the top, values as the file has them, 0 to 1."""
    image = bpy.data.images.load(str(file))
    image.colorspace_settings.name = "Non-Color"
    return numpy.array(image.pixels[:]).reshape(image.size[1], image.size[0], 4)[::-1]


def image_of(name, rows, data=True):
    image = bpy.data.images.new(name, rows.shape[1], rows.shape[0], float_buffer=True, is_data=data)
    full = numpy.ones(rows.shape[:2] + (4,), numpy.float32)
    full[..., :3] = rows[::-1, :, :3]
    image.pixels.foreach_set(full.ravel())
    return image


def rgba(color):
    return (*[float(each) for each in color], 1.0)


class Nodes:
    """A material's nodes, made and linked in one call each."""

    def __init__(self, tree):
        self.tree = tree
        tree.nodes.clear()

    def add(self, kind, inputs=(), **settings):
        node = self.tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        for key, value in dict(inputs).items():
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, node.inputs[key])
            else:
                node.inputs[key].default_value = value
        return node


def material(name):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    return made, Nodes(made.node_tree)


def add_light(direction, color, angle):
    data = bpy.data.lights.new("sun", "SUN")
    strength = max(color)
    data.color, data.energy, data.angle = [each / strength for each in color], math.pi * strength, angle
    sun = bpy.data.objects.new("sun", data)
    sun.rotation_mode = "QUATERNION"
    sun.rotation_quaternion = turned(direction).to_track_quat("Z", "Y")
    bpy.context.collection.objects.link(sun)


def add_lights():
    add_light(order["light"], KEY, math.radians(9))
    front = Vector((order["camera"][0] - order["target"][0], 0, order["camera"][2] - order["target"][2])).normalized()
    right = Vector((front.z, 0, -front.x))
    add_light(0.9 * right + Vector((0, 0.25, 0)) + 0.35 * front, FILL, math.radians(170))
    # The sky, brighter or darker so that a level surface gets SKY of it, as in clothsim; Blender's pictures of skies turn the
    # other way.
    rows = linear(pixels_of(root / "assets/textures/sky.png")[..., :3])
    height, width = rows.shape[:2]
    polar = math.pi * (numpy.arange(height) + 0.5) / height
    weight = numpy.clip(numpy.cos(polar), 0, None) * numpy.sin(polar) * 2 * math.pi ** 2 / (width * height) / math.pi
    rows *= numpy.array(SKY) / (rows * weight[:, None, None]).sum((0, 1))
    angle = -((numpy.arange(width) + 0.5) / width - 0.5)
    rows = rows[:, numpy.floor(((0.25 + angle + 0.5) % 1.0) * width).astype(int)]
    world = bpy.data.worlds.new("sky")
    bpy.context.scene.world = world
    world.use_nodes = True
    nodes = Nodes(world.node_tree)
    picture = nodes.add("ShaderNodeTexEnvironment", image=image_of("sky", rows))
    background = nodes.add("ShaderNodeBackground", {"Color": picture.outputs["Color"]})
    nodes.add("ShaderNodeOutputWorld", {"Surface": background.outputs[0]})


def weave_pictures(cloth, reverse):
    """Colour and normal of the weave, from the picture that clothsim has (tools/make_textures). The weft floats on the reverse as
    the warp does on the face."""
    stored = pixels_of(root / f"assets/textures/weave_{cloth['weave']}.png")
    if reverse:
        stored = stored.transpose(1, 0, 2)[..., [1, 0, 2, 3]]
    warp = numpy.clip(stored[..., 3] / numpy.maximum(stored[..., 2], 0.01), 0, 1)[..., None]
    front, back = linear(cloth["color"]), linear(cloth["back_color"])
    if reverse:
        front, back = back, front
    color = (back + (front - back) * warp if cloth["weave"] == "denim" else numpy.ones_like(warp) * front) * stored[..., 2:3]
    slope = (stored[..., :2] * 2 - 256 / 255) * 1.5
    normal = numpy.concatenate([slope * (-1, 1), numpy.ones_like(warp)], 2)  # v goes up there, and down in clothsim
    normal /= numpy.linalg.norm(normal, axis=2, keepdims=True)
    return image_of("color", color), image_of("normal", normal * 0.5 + 0.5)


# OBJ files count v from the lower edge of pictures; clothsim, in repeats, from the upper one.
def scaled_place(nodes, uv, x, y):
    return nodes.add("ShaderNodeMapping", {"Vector": uv, "Scale": (x, y, 1), "Location": (0, -y, 0)}).outputs[0]


def cloth_color(nodes, cloth, uv, weave, reverse):
    own = nodes.add("ShaderNodeRGB").outputs[0]
    own.default_value = rgba(linear(cloth["back_color" if reverse else "color"]))
    if "print" in cloth:
        longer = max(cloth["size"])
        place = scaled_place(nodes, uv, *[cloth["print_repeat"] * each / longer for each in cloth["size"]])
        picture = bpy.data.images.load(str(root / f"assets/textures/{cloth['print']}.png"))
        print_color = nodes.add("ShaderNodeTexImage", {"Vector": place}, image=picture).outputs[0]
        seen = PRINT_SEEN_FROM_BEHIND if reverse else 1.0
        return nodes.add("ShaderNodeMixRGB", {"Fac": seen, "Color1": own, "Color2": print_color}).outputs[0]
    if cloth["weave"] == "denim":
        return weave
    return own


def cloth_material(cloth, reverse):
    if reverse:
        cloth = {**cloth, **cloth.get("reverse", {})}
    made, nodes = material("reverse" if reverse else "face")
    uv = nodes.add("ShaderNodeUVMap").outputs[0]
    place = scaled_place(nodes, uv, *[size / (threads * cloth["spacing"])
                                      for size, threads in zip(cloth["size"], cloth["threads"])])
    color, normal = [nodes.add("ShaderNodeTexImage", {"Vector": place}, image=each).outputs[0]
                     for each in weave_pictures(cloth, reverse)]
    base = cloth_color(nodes, cloth, uv, color, reverse)
    bent = nodes.add("ShaderNodeNormalMap", {"Color": normal, "Strength": cloth["relief"]}).outputs[0]
    tangent = nodes.add("ShaderNodeTangent", direction_type="UV_MAP").outputs[0]
    surface = nodes.add("ShaderNodeBsdfPrincipled", {
        "Base Color": base, "Normal": bent, "Tangent": tangent, "Roughness": cloth["roughness"],
        "Specular": cloth["specular"], "Anisotropic": cloth["anisotropic"], "Sheen": cloth["sheen"], "Sheen Tint": 0.5,
        "Metallic": cloth["metallic"]}).outputs[0]
    through = nodes.add("ShaderNodeBsdfTranslucent", {"Color": base}).outputs[0]
    mixed = nodes.add("ShaderNodeMixShader", {0: cloth["transmitted"], 1: surface, 2: through}).outputs[0]
    nodes.add("ShaderNodeOutputMaterial", {"Surface": mixed})
    return made


def floor_material():
    made, nodes = material("floor")
    place = nodes.add("ShaderNodeTexCoord").outputs["Object"]
    distance = nodes.add("ShaderNodeVectorMath", {0: place}, operation="LENGTH").outputs["Value"]
    squared = nodes.add("ShaderNodeMath", {0: distance, 1: 2.0}, operation="POWER").outputs[0]
    part = nodes.add("ShaderNodeMath", {0: squared, 1: 1 / FLOOR_RADIUS ** 2}, operation="MULTIPLY").outputs[0]
    fade = nodes.add("ShaderNodeMath", {0: 1.0, 1: part}, operation="SUBTRACT", use_clamp=True).outputs[0]
    opacity = nodes.add("ShaderNodeMath", {0: fade, 1: 2.0}, operation="POWER").outputs[0]
    far = nodes.add("ShaderNodeMath", {0: part, 1: POOL_SHARPNESS, 2: 1.0}, operation="MULTIPLY_ADD").outputs[0]
    near = nodes.add("ShaderNodeMath", {0: 0.75, 1: far}, operation="DIVIDE").outputs[0]
    pool = nodes.add("ShaderNodeMath", {0: near, 1: 0.25}, operation="ADD").outputs[0]
    color = nodes.add("ShaderNodeMixRGB", {"Fac": pool, "Color1": (0, 0, 0, 1), "Color2": rgba(linear(FLOOR))}).outputs[0]
    matte = nodes.add("ShaderNodeBsdfDiffuse", {"Color": color}).outputs[0]
    clear = nodes.add("ShaderNodeBsdfTransparent").outputs[0]
    mixed = nodes.add("ShaderNodeMixShader", {0: opacity, 1: clear, 2: matte}).outputs[0]
    nodes.add("ShaderNodeOutputMaterial", {"Surface": mixed})
    return made


def import_obj(file):
    before = set(bpy.data.objects)
    bpy.ops.wm.obj_import(filepath=str(file))
    return [each for each in bpy.data.objects if each not in before and each.type == "MESH"]


def add_cloth(cloth):
    sides = [cloth_material(cloth, reverse) for reverse in (False, True)]
    for piece in import_obj(cloth["file"]):
        piece.data.materials.clear()
        for side in sides:
            piece.data.materials.append(side)
        bpy.context.view_layer.objects.active = piece
        if cloth["is_grid"]:
            bpy.ops.object.mode_set(mode="EDIT")
            bpy.ops.mesh.select_all(action="SELECT")
            bpy.ops.mesh.tris_convert_to_quads(face_threshold=math.pi, shape_threshold=math.pi)
            bpy.ops.object.mode_set(mode="OBJECT")
        smooth = piece.modifiers.new("smooth", "SUBSURF")
        smooth.levels = smooth.render_levels = cloth["levels"]
        thick = piece.modifiers.new("thick", "SOLIDIFY")
        thick.thickness, thick.offset, thick.material_offset = cloth["thickness"], 0, 1  # the other side is the reverse
        for polygon in piece.data.polygons:
            polygon.use_smooth = True


def add_solids():
    made, nodes = material("solid")
    surface = nodes.add("ShaderNodeBsdfPrincipled", {"Base Color": rgba(linear(SOLID)), "Roughness": 0.5}).outputs[0]
    nodes.add("ShaderNodeOutputMaterial", {"Surface": surface})
    for solid in order["solids"]:
        if "file" in solid:
            piece, = import_obj(root / solid["file"])
            piece.location = turned(solid["origin"])
        else:
            bpy.ops.mesh.primitive_uv_sphere_add(segments=96, ring_count=64, radius=solid["radius"], location=turned(solid["origin"]))
            piece = bpy.context.object
        for polygon in piece.data.polygons:
            polygon.use_smooth = True
        piece.data.materials.clear()
        piece.data.materials.append(made)
    bpy.ops.mesh.primitive_circle_add(vertices=64, radius=FLOOR_RADIUS, fill_type="NGON", location=(0, 0, order["floor"]))
    bpy.context.object.data.materials.append(floor_material())


def add_camera():
    data = bpy.data.cameras.new("camera")
    data.sensor_fit, data.angle, data.clip_start = "VERTICAL", math.radians(order["fov"]), 0.01
    camera = bpy.data.objects.new("camera", data)
    camera.location = turned(order["camera"])
    camera.rotation_mode = "QUATERNION"
    camera.rotation_quaternion = (camera.location - turned(order["target"])).to_track_quat("Z", "Y")
    bpy.context.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def draw(file):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = "CPU", order["samples"], False
    scene.render.threads_mode, scene.render.threads = "FIXED", 2
    scene.render.film_transparent = True
    scene.render.resolution_x, scene.render.resolution_y = order["size"]
    scene.view_settings.view_transform = "Standard"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.filepath = file + ".exr"
    bpy.ops.render.render(write_still=True)


def over_backdrop(light):
    """The backdrop of shaders/render/background.glsl behind what was drawn."""
    height, width = light.shape[:2]
    y = ((numpy.arange(height) + 0.5) / height)[::-1, None]
    x = ((numpy.arange(width) + 0.5) / width - 0.5)[None, :] * width / height
    glow = numpy.exp(-3 * (x ** 2 + (y - 0.55) ** 2))[..., None]
    part = (y * y * (3 - 2 * y))[..., None]
    behind = linear(BACKDROP_BOTTOM) * (1 - part) + linear(BACKDROP_TOP) * part + glow * numpy.array(GLOW)
    return light[..., :3] + (1 - light[..., 3:]) * behind


def write(file):
    light = pixels_of(file + ".exr")
    screen = encoded(over_backdrop(light))
    image = bpy.data.images.new("screen", light.shape[1], light.shape[0])
    full = numpy.ones(light.shape, numpy.float32)
    full[..., :3] = numpy.clip(screen, 0, 1)[::-1]
    image.pixels.foreach_set(full.ravel())
    image.filepath_raw, image.file_format = file, "PNG"
    image.save()


bpy.ops.wm.read_factory_settings(use_empty=True)
add_lights()
add_cloth(order["cloth"])
add_solids()
add_camera()
draw(order["out"])
write(order["out"])
