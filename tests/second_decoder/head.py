"""The generic head (SPEC 9.2), read from common/generic_head.gltf."""

import base64
import json
import pathlib
import struct
from dataclasses import dataclass

from .integers import checksum

FILE = pathlib.Path(__file__).parents[2] / "common" / "generic_head.gltf"
CHECKSUM = 0x504F0440DE562CE4
VERTICES = 105

(OUTER_LIPS, INNER_LIPS, RIGHT_BROW, LEFT_BROW, RIGHT_UPPER_LID, LEFT_UPPER_LID, RIGHT_LOWER_LID, LEFT_LOWER_LID,
 RIGHT_PUPIL, LEFT_PUPIL) = range(10)


@dataclass
class Feature:
    closed: bool
    first_control: int
    controls: int
    vertices: list

    def control_range(self):
        return range(self.first_control, self.first_control + self.controls)


@dataclass
class ExpressionPart:
    first_control: int
    controls: int
    rows: list  # one for each coefficient; x and y of each control point in turn, 4096 is a weight of one


@dataclass
class GenericHead:
    positions: list  # x, y, z of each vertex, head units
    triangles: list  # three vertices each
    outline: list
    mirror: list
    landmark: list  # iBUG-68 number of each vertex, or -1
    feature: list  # FeatureId of each vertex, or -1
    skinning: list  # of each vertex: (control point, weight) pairs, 4096 is a weight of one
    features: list
    expression: list

    def integers(self):
        """All values in the order of the checksum."""
        yield VERTICES
        for position, *numbers in zip(self.positions, self.mirror, self.landmark, self.feature):
            yield from position
            yield from numbers
        yield len(self.triangles)
        for triangle in self.triangles:
            yield from triangle
        yield len(self.outline)
        yield from self.outline
        yield len(self.features)
        for feature in self.features:
            yield from (feature.closed, feature.first_control, feature.controls, len(feature.vertices))
            yield from feature.vertices
        for pairs in self.skinning:
            yield len(pairs)
            for pair in pairs:
                yield from pair
        yield len(self.expression)
        for part in self.expression:
            yield from (part.first_control, part.controls)
            for row in part.rows:
                yield from row


def _accessor(gltf, index, code):
    """All numbers of a glTF accessor; `code` is that of struct."""
    accessor = gltf["accessors"][index]
    view = gltf["bufferViews"][accessor["bufferView"]]
    data = base64.b64decode(gltf["buffers"][view["buffer"]]["uri"].partition("base64,")[2])
    count = accessor["count"] * {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
    offset = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return struct.unpack_from(f"<{count}{code}", data, offset)


def load():
    gltf = json.loads(FILE.read_text())
    mesh = gltf["meshes"][0]
    primitive, extras = mesh["primitives"][0], mesh["extras"]
    xyz = [int(4096 * x) for x in _accessor(gltf, primitive["attributes"]["POSITION"], "f")]
    corners = _accessor(gltf, primitive["indices"], "H")
    vertices = extras["vertices"]
    head = GenericHead(
        positions=[(xyz[i], -xyz[i + 1], -xyz[i + 2]) for i in range(0, len(xyz), 3)],
        triangles=[(corners[i], corners[i + 2], corners[i + 1]) for i in range(0, len(corners), 3)],
        outline=extras["outline"],
        mirror=[v["mirror"] for v in vertices],
        landmark=[v["landmark"] for v in vertices],
        feature=[v["feature"] for v in vertices],
        skinning=[v["skinning"] for v in vertices],
        features=[Feature(f["closed"], f["first_control"], f["control_count"], [v for v, _ in f["vertices_s12"]])
                  for f in extras["features"]],
        expression=[ExpressionPart(e["first_control"], e["control_count"], e["rows"]) for e in extras["expression"]])
    assert checksum(head.integers()) == CHECKSUM
    return head


HEAD = load()
