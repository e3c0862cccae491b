"""Signed distances of points to the colliders of a scene file, by formulas of their own: the judge of contact does not ask the
program that it judges."""
import numpy


def turned(points, collider, axis):
    """Points in the frame in which the collider's axis is y."""
    axis = numpy.array(collider.get("axis", axis), float)
    axis /= numpy.linalg.norm(axis)
    offsets = points - numpy.array(collider.get("origin", [0, 0, 0]), float)
    along = offsets @ axis
    return along, numpy.linalg.norm(offsets - along[:, None] * axis, axis=1)


def plane(points, collider):
    normal = numpy.array(collider["normal"], float)
    return (points - numpy.array(collider["point"], float)) @ (normal / numpy.linalg.norm(normal))


def sphere(points, collider):
    return numpy.linalg.norm(points - numpy.array(collider["origin"], float), axis=1) - collider["radius"]


def capsule(points, collider):
    along, across = turned(points, collider, [0, 1, 0])
    beyond = numpy.maximum(abs(along) - collider["length"] / 2, 0)
    return numpy.hypot(beyond, across) - collider["radius"]


def torus(points, collider):
    along, across = turned(points, collider, [0, 1, 0])
    return numpy.hypot(across - collider["radius"], along) - collider["tube_radius"]


def box(points, collider):
    x, y, z = angle = numpy.radians(collider.get("rotation", [0, 0, 0]))
    size = numpy.linalg.norm(angle)
    cross = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]) / max(size, 1e-30)
    rotation = numpy.eye(3) + numpy.sin(size) * cross + (1 - numpy.cos(size)) * cross @ cross
    rounding = collider.get("rounding", 0.01)
    inner = numpy.array(collider["size"], float) / 2 - rounding
    outside = abs((points - numpy.array(collider["origin"], float)) @ rotation) - inner
    return numpy.linalg.norm(numpy.maximum(outside, 0), axis=1) + numpy.minimum(outside.max(axis=1), 0) - rounding


shapes = {"plane": plane, "sphere": sphere, "capsule": capsule, "torus": torus, "box": box}


def depth(points, colliders, seconds):
    """How deep the deepest of the points is inside a collider [m], 0 when none is. Colliders may turn, as long as they are
    where they began for so many seconds."""
    deepest = 0.0
    for collider in colliders:
        keys = collider.get("motion", {}).get("keys", [])
        later = [key["t"] for key in keys if key["t"] >= seconds]
        keys = [key for key in keys if key["t"] <= min(later, default=seconds)]
        if any("position" in key and key["position"] != collider.get("origin") for key in keys):
            raise ValueError(f"the judge knows no moving colliders: {collider['type']}")
        deepest = max(deepest, -float(shapes[collider["type"]](points, collider).min()))
    return deepest
