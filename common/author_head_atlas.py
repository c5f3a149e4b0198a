#!/usr/bin/env python3
"""Authors the atlas of the head: where each vertex of generic_head.gltf lies when the head is laid out flat, so that no
triangle hides another and all of them have room, also those that are closed or seen from the side in most pictures.

Run by hand after a change of the head; the output is committed. --preview OUT.png needs numpy and OpenCV.

    common/author_head_atlas.py                       writes generic_head_atlas.cpp beside it
    common/author_head_atlas.py --preview atlas.png   draws it instead
"""

import argparse
import json
import math
import pathlib
import struct
import base64

UNIT = 4096  # units per eye distance
RING = 0.22  # eye distances from the outline to the ring
SIDE = 0.45  # what depth adds to the distance from the middle: sides are laid out flat
SIDE_FROM = 1.0  # depth, toward the viewer, behind which they are sides
LIPS = 0.26  # how far the lower lip and all below are moved down, so that the mouth is open
LIPS_AT = 1.12  # applies below this
LIDS = 0.08  # how far all above the eyes is moved up, so that they are wide open
LIDS_AT = -0.03  # applies above this
LOWER_LIDS = 0.05  # how far all below the eyes is moved down
LOWER_LIDS_AT = 0.0355  # applies below this


def read_head(path):
    gltf = json.loads(path.read_text())
    data = base64.b64decode(gltf["buffers"][0]["uri"].split(",")[1])

    def accessor(k, code, size):
        a = gltf["accessors"][k]
        view = gltf["bufferViews"][a["bufferView"]]
        first = view.get("byteOffset", 0) + a.get("byteOffset", 0)
        return struct.unpack_from("<%d%s" % (a["count"] * size, code), data, first)

    primitive = gltf["meshes"][0]["primitives"][0]
    flat = accessor(primitive["attributes"]["POSITION"], "f", 3)
    positions = [(flat[i], -flat[i + 1], flat[i + 2]) for i in range(0, len(flat), 3)]  # y down
    codes = {5123: "H", 5125: "I"}
    indices = accessor(primitive["indices"], codes[gltf["accessors"][primitive["indices"]]["componentType"]], 1)
    triangles = [(indices[i], indices[i + 2], indices[i + 1]) for i in range(0, len(indices), 3)]  # clockwise
    return positions, triangles, gltf["meshes"][0]["extras"]["outline"]


def laid_out(position):
    x, y, z = position
    u = x + math.copysign(SIDE * max(0.0, SIDE_FROM - z), x) if x else 0.0
    v = y + (LIPS if y > LIPS_AT else 0.0) - (LIDS if y < LIDS_AT else 0.0) + (LOWER_LIDS if y > LOWER_LIDS_AT else 0.0)
    return u, v


def ring_of(points, outline):
    """One point for each of the outline, outwards."""
    out = []
    for k in range(len(outline)):
        (ax, ay), (bx, by), (cx, cy) = (points[outline[(k + d) % len(outline)]] for d in (-1, 0, 1))
        nx, ny = cy - ay, ax - cx  # clockwise in the picture: outside is to the left of the path
        length = math.hypot(nx, ny)
        out.append((bx + RING * nx / length, by + RING * ny / length))
    return out


TABLE = """// The atlas of the generic head, by author_head_atlas.py: not to be edited.
#include "common/generic_head.h"

namespace fbs {

const std::array<glm::ivec2, kVertexCount + kRingCount> kHeadAtlas = {{
%s}};

}  // namespace fbs
"""


def write(path, table):
    lines = ""
    line = "   "
    for x, y in table:
        item = " {%d, %d}," % (x, y)
        if len(line) + len(item) > 110:
            lines += line + "\n"
            line = "   "
        line += item
    path.write_text(TABLE % (lines + line + "\n"))


def fnv1a(values):
    h = 0xCBF29CE484222325
    for value in values:
        for byte in struct.pack("<i", value):
            h = (h ^ byte) * 0x100000001B3 % 2**64
    return h


def area(points, triangle):
    (ax, ay), (bx, by), (cx, cy) = (points[v] for v in triangle)
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--preview")
    here = pathlib.Path(__file__).resolve().parent
    arguments = parser.parse_args()
    positions, triangles, outline = read_head(here / "generic_head.gltf")
    points = [laid_out(p) for p in positions]
    points += ring_of(points, outline)
    n, first = len(outline), len(positions)
    triangles += [t for i in range(n) for t in ((outline[i], first + i, first + (i + 1) % n),
                                                (outline[i], first + (i + 1) % n, outline[(i + 1) % n]))]
    margin = RING / 2 + 0.03  # the skirt, and a sample or two
    left, top = (min(p[k] for p in points) - margin for k in (0, 1))
    table = [(round((x - left) * UNIT), round((y - top) * UNIT)) for x, y in points]
    size = [max(p[k] for p in table) + round(margin * UNIT) for k in (0, 1)]
    assert all(area(table, t) > 0.004 * UNIT**2 for t in triangles)
    print("size", size, "checksum %016X" % fnv1a(n for p in table for n in p))
    if arguments.preview:
        preview(arguments.preview, table, triangles, size)
    else:
        write(here / "generic_head_atlas.cpp", table)


def preview(path, table, triangles, size):
    import cv2
    import numpy as np
    scale = 200 / UNIT
    image = np.full((int(size[1] * scale), int(size[0] * scale), 3), 255, np.uint8)
    for t in triangles:
        cv2.polylines(image, [np.array([[int(table[v][0] * scale), int(table[v][1] * scale)] for v in t])], True, 0)
    cv2.imwrite(path, image)


if __name__ == "__main__":
    main()
