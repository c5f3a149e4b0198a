"""The generic head (SPEC 9.2, 10.12), read from common/generic_head.gltf and common/generic_head_atlas.cpp."""

import base64
import json
import pathlib
import re
import struct
from dataclasses import dataclass

from .integers import checksum
from .wire_frame import LANDMARKS, Feature, WireFrame

FOLDER = pathlib.Path(__file__).parents[2] / "common"
CHECKSUM = 0x504F0440DE562CE4
ATLAS_CHECKSUM = 0x7EF7D415AFF39EB7


@dataclass
class ExpressionPart:
    first_control: int
    controls: int
    rows: list  # one for each coefficient; x and y of each control point in turn, 4096 is a weight of one


@dataclass
class GenericHead(WireFrame):
    landmark: list  # iBUG-68 number of each vertex, or -1
    feature: list  # FeatureId of each vertex, or -1
    expression: list

    def integers(self):
        """All values in the order of the checksum."""
        yield self.vertices
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


def _atlas():
    text = (FOLDER / "generic_head_atlas.cpp").read_text()
    table = [(int(u), int(v)) for u, v in re.findall(r"\{(\d+), (\d+)\}", text)]
    assert checksum(n for pair in table for n in pair) == ATLAS_CHECKSUM
    return table


def load():
    gltf = json.loads((FOLDER / "generic_head.gltf").read_text())
    mesh = gltf["meshes"][0]
    primitive, extras = mesh["primitives"][0], mesh["extras"]
    xyz = [int(4096 * x) for x in _accessor(gltf, primitive["attributes"]["POSITION"], "f")]
    corners = _accessor(gltf, primitive["indices"], "H")
    vertices = extras["vertices"]
    landmark = [v["landmark"] for v in vertices]
    head = GenericHead(
        positions=[(xyz[i], -xyz[i + 1], -xyz[i + 2]) for i in range(0, len(xyz), 3)],
        triangles=[(corners[i], corners[i + 2], corners[i + 1]) for i in range(0, len(corners), 3)],
        outline=extras["outline"],
        mirror=[v["mirror"] for v in vertices],
        landmark=landmark,
        landmark_vertices=[landmark.index(k) for k in range(LANDMARKS)],
        feature=[v["feature"] for v in vertices],
        skinning=[v["skinning"] for v in vertices],
        features=[Feature(f["closed"], f["first_control"], f["control_count"], [v for v, _ in f["vertices_s12"]])
                  for f in extras["features"]],
        atlas=_atlas(),
        expression=[ExpressionPart(e["first_control"], e["control_count"], e["rows"]) for e in extras["expression"]])
    assert checksum(head.integers()) == CHECKSUM
    assert len(head.atlas) == head.vertices + head.ring
    return head


HEAD = load()
