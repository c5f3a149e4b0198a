#!/usr/bin/env python3
"""Writes a wire-frame with four triangles for each one of the generic head: an example of a head of your own, which
`fbs retarget --wire-frame` puts in the place of the generic one. What the file must say: docs/wire-frames.md.

    samples/finer_head.py fine.gltf
    fbs retarget --motion anna.fbs --face anna.fbs --wire-frame fine.gltf fine.fbs

Vertices are added in the middle of the edges, and round the head between them (Phong tessellation: Boubekeur & Alexa,
2008). Needs nothing but Python.
"""

import base64
import json
import pathlib
import re
import struct
import sys

COMMON = pathlib.Path(__file__).resolve().parent.parent / "common"
CORNERS = (60, 64)  # landmarks: right and left corner between the lips
ROUNDNESS = 0.75  # 0: edges stay straight


class Head:
    """Positions in eye distances (y up), triangles counter-clockwise, and what extras says of them."""

    def __init__(self):
        gltf = json.loads((COMMON / "generic_head.gltf").read_text())
        data = base64.b64decode(gltf["buffers"][0]["uri"].split(",")[1])
        count, corners = (gltf["accessors"][k]["count"] for k in (0, 1))
        start = gltf["bufferViews"][1]["byteOffset"]
        self.positions = list(struct.iter_unpack("<3f", data[:12 * count]))
        self.triangles = list(struct.iter_unpack("<3H", data[start:start + 2 * corners]))
        extras = gltf["meshes"][0]["extras"]
        self.outline = extras["outline"]
        self.landmarks = [vertex["landmark"] for vertex in extras["vertices"]]
        self.skinning = [dict(vertex["skinning"]) for vertex in extras["vertices"]]
        self.features = {f["name"]: (f["closed"], [v for v, _ in f["vertices_s12"]]) for f in extras["features"]}
        table = re.findall(r"\{(\d+), (\d+)\}", (COMMON / "generic_head_atlas.cpp").read_text())
        self.atlas = [(int(x), int(y)) for x, y in table[:count]]
        self.ring = [(int(x), int(y)) for x, y in table[count:]]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def normals(head):
    """Of each vertex: the mean of its triangles' by area."""
    sums = [[0.0] * 3 for _ in head.positions]
    for a, b, c in head.triangles:
        p, q = (minus(head.positions[v], head.positions[a]) for v in (b, c))
        across = (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])
        for v in (a, b, c):
            sums[v] = [s + x for s, x in zip(sums[v], across)]
    return [[x / max(dot(n, n) ** 0.5, 1e-9) for x in n] for n in sums]


def middle(a, b):
    return tuple((x + y) / 2 for x, y in zip(a, b))


def whole_middle(a, b):
    return tuple((x + y) // 2 for x, y in zip(a, b))


class Finer:
    """The head, and a vertex in the middle of each edge."""

    def __init__(self, head):
        self.head, self.normals, self.middles = head, normals(head), {}
        self.inner_lips = head.features["mouth_inner"][1]
        # What lies on a contour stays on the straight line between its ends, where the contour was.
        self.straight = {frozenset(edge) for edge in zip(head.outline, head.outline[1:] + head.outline[:1])}
        for closed, vertices in head.features.values():
            self.straight |= {frozenset(edge) for edge in zip(vertices, vertices[1:] + vertices[:1])}
        self.straight |= {frozenset((a, b)) for a in self.inner_lips for b in self.inner_lips}

    def middle_of(self, a, b):
        """Index of the vertex in the middle of an edge, which is added when it is asked for first."""
        if frozenset((a, b)) in self.middles:
            return self.middles[frozenset((a, b))]
        head = self.head
        place = middle(head.positions[a], head.positions[b])
        if frozenset((a, b)) not in self.straight:
            on_planes = [[x - dot(minus(place, head.positions[v]), self.normals[v]) * n
                          for x, n in zip(place, self.normals[v])] for v in (a, b)]
            place = tuple((1 - ROUNDNESS) * x + ROUNDNESS * y for x, y in zip(place, middle(*on_planes)))
        head.positions.append(place)
        head.landmarks.append(-1)
        weights = {c: (head.skinning[a].get(c, 0) + head.skinning[b].get(c, 0)) // 2
                   for c in head.skinning[a].keys() | head.skinning[b].keys()}
        head.skinning.append({c: weight for c, weight in sorted(weights.items()) if weight != 0})
        head.atlas.append(whole_middle(head.atlas[a], head.atlas[b]))
        self.middles[frozenset((a, b))] = len(head.positions) - 1
        return len(head.positions) - 1

    def with_middles(self, line, closed):
        out = []
        for a, b in zip(line, line[1:] + line[:1]):
            out += [a, self.middle_of(a, b)]
        return out if closed else out[:-1]

    def split_triangles(self):
        out = []
        for a, b, c in self.head.triangles:
            if not all(v in self.inner_lips for v in (a, b, c)):
                ab, bc, ca = self.middle_of(a, b), self.middle_of(b, c), self.middle_of(c, a)
                out += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        return out

    def mouth(self, lips):
        """Triangles between the lips. Their corners must all be on the lips, so they cannot be split."""
        other = lips.index(CORNERS[1])
        upper, lower = lips[:other + 1], [lips[0]] + lips[:other - 1:-1]
        out = []
        for i in range(len(upper) - 1):
            out += [(upper[i], lower[i + 1], upper[i + 1])] if i + 2 < len(upper) else []
            out += [(upper[i], lower[i], lower[i + 1])] if i > 0 else []
        return out

    def make(self):
        head = self.head
        triangles = self.split_triangles()
        head.outline = self.with_middles(head.outline, True)
        head.features = {name: (closed, self.with_middles(vertices, closed))
                         for name, (closed, vertices) in head.features.items()}
        head.triangles = triangles + self.mouth(head.features["mouth_inner"][1])
        around = zip(head.ring, head.ring[1:] + head.ring[:1])
        head.ring = [place for a, b in around for place in (a, whole_middle(a, b))]


def write(head, path):
    positions = b"".join(struct.pack("<3f", *p) for p in head.positions)
    corners = b"".join(struct.pack("<3H", *t) for t in head.triangles)
    bounds = [[limit(p[axis] for p in head.positions) for axis in range(3)] for limit in (min, max)]
    bounds = [[struct.unpack("<f", struct.pack("<f", x))[0] for x in bound] for bound in bounds]
    extras = {
        "vertices": [{"landmark": landmark, "skinning": list(map(list, weights.items()))}
                     for landmark, weights in zip(head.landmarks, head.skinning)],
        "features": [{"name": name, "vertices": vertices} for name, (_, vertices) in head.features.items()],
        "outline": head.outline,
        "atlas": head.atlas + head.ring,
    }
    uri = "data:application/octet-stream;base64," + base64.b64encode(positions + corners).decode()
    gltf = {
        "asset": {"version": "2.0", "generator": "fbs samples/finer_head.py"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "finer_head", "mesh": 0}],
        "meshes": [{"name": "finer_head", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 4}],
                    "extras": extras}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(head.positions), "type": "VEC3",
                       "min": bounds[0], "max": bounds[1]},
                      {"bufferView": 1, "componentType": 5123, "count": 3 * len(head.triangles), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(positions), "target": 34962},
                        {"buffer": 0, "byteOffset": len(positions), "byteLength": len(corners), "target": 34963}],
        "buffers": [{"byteLength": len(positions + corners), "uri": uri}],
    }
    pathlib.Path(path).write_text(json.dumps(gltf) + "\n")


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    head = Head()
    Finer(head).make()
    write(head, sys.argv[1])
    print(f"{sys.argv[1]}: {len(head.positions)} vertices, {len(head.triangles)} triangles")


if __name__ == "__main__":
    main()
