#!/usr/bin/env python3
"""Authors generic_head.gltf: the 105 vertices of the generic head, its triangles, features and skinning weights.

Run by hand; the output is committed. Needs nothing but Python; --preview OUT.png also needs numpy and OpenCV.

    common/author_generic_head.py                        writes common/generic_head.gltf
    common/author_generic_head.py --preview head.png     and draws it: neutral, lids closed, mouth open

The drawing that it starts from, its frame and its unit are in generic_head_drawing.py.
"""

import argparse
import base64
import heapq
import json
import math
import pathlib
import struct

from generic_head_drawing import (CONTROL_MIRROR, FEATURES, FOLLOW, HAIRLINE, LOWER_CONTROLS, LOWER_LIDS, LOWER_LIP,
                                  LOWER_LIP_INSIDE, MIDLINE, SIDE, TRIANGLES, UPPER_CONTROLS, UPPER_LIDS, UPPER_LIP)

UNIT = 4096  # units per eye distance, and the weight of one
SMALLEST_WEIGHT = 16


def to_units(x):
    return math.floor(x * UNIT + 0.5)


class Head:
    """The whole head in integers: both sides, vertices 0..67 in the order of the landmarks."""

    def __init__(self):
        self.build_vertices()
        self.build_triangles()
        self.build_features()
        self.build_skinning()

    def build_vertices(self):
        rows = {}  # name -> (landmark, mirror name, position)
        for name, landmark, y, z in MIDLINE:
            rows[name] = (landmark, name, (0, to_units(y), to_units(z)))
        for name, landmark, x, y, z in SIDE:
            x, y, z = to_units(x), to_units(y), to_units(z)
            right, left = name.format("right"), name.format("left")
            other = None if landmark is None else mirror_landmark(landmark)
            rows[right] = (landmark, left, (-x, y, z))
            rows[left] = (other, right, (x, y, z))
        marked = sorted((row[0], name) for name, row in rows.items() if row[0] is not None)
        assert [landmark for landmark, _ in marked] == list(range(68))
        self.names = [name for _, name in marked] + [name for name, row in rows.items() if row[0] is None]
        self.index = {name: i for i, name in enumerate(self.names)}
        self.mirror = [self.index[rows[name][1]] for name in self.names]
        self.position = [list(rows[name][2]) for name in self.names]
        assert len(self.names) == 105
        self.centre_eyes()

    def centre_eyes(self):
        """Compensates for rounding in one eyelid point, so that the eye centres are exactly one unit apart at y = 0."""
        lid = 47
        for axis, target in ((0, 6 * UNIT // 2), (1, 0)):
            self.position[lid][axis] += target - sum(self.position[v][axis] for v in range(42, 48))
        x, y, z = self.position[lid]
        self.position[self.mirror[lid]] = [-x, y, z]

    def build_triangles(self):
        self.triangles = []
        for line in TRIANGLES.split("\n"):
            if line:
                a, b, c = (self.index[name.format("left")] for name in line.split())
                self.triangles += [(a, b, c), (self.mirror[a], self.mirror[c], self.mirror[b])]
        self.outline = [0] + [self.index[name] for name in HAIRLINE] + list(range(16, 0, -1))

    def build_features(self):
        self.features, self.feature_of, first = [], [-1] * 105, 0
        for f, (name, closed, controls, points) in enumerate(FEATURES):
            points = [(self.index.get(p, p), s12) for p, s12 in points]
            self.features.append((name, closed, first, controls, points))
            for v, _ in points:
                self.feature_of[v] = f
            first += controls
        assert first == 36

    def build_skinning(self):
        """Weights of each vertex as {control: integer}; the right half and the midline, then their mirror image."""
        self.find_neighbours()
        own = {v: row for feature in self.features for v, row in basis_rows(feature).items()}
        self.skinning = [None] * 105
        for v in range(105):
            if self.position[v][0] > 0:
                continue
            row = own.get(v, {})
            wholes = [set(row)] if self.feature_of[v] in (0, 1, 2, 3) else []
            extra = self.follow_inner_lip(v, own) if self.feature_of[v] == 1 else {}
            if extra:
                wholes.append(set(extra))
            if self.names[v].startswith("pupil"):
                extra = self.follow_lids(v, own)
            if v not in own:
                extra = self.follow_features(v, own)
            row = {**row, **extra}
            if self.mirror[v] == v:
                row = {c: (row.get(c, 0) + row.get(CONTROL_MIRROR[c], 0)) / 2 for c in
                       set(row) | {CONTROL_MIRROR[c] for c in row}}
            self.skinning[v] = to_weights(row, wholes)
        for v in range(105):
            if self.skinning[v] is None:
                row = self.skinning[self.mirror[v]]
                self.skinning[v] = dict(sorted((CONTROL_MIRROR[c], w) for c, w in row.items()))

    def find_neighbours(self):
        """Edges used for distances: all but those across the opening of the mouth."""
        upper, lower = {61, 62, 63}, {65, 66, 67}
        self.neighbours = [{} for _ in range(105)]
        for triangle in self.triangles:
            for a, b in zip(triangle, triangle[1:] + triangle[:1]):
                if not ({a, b} & upper and {a, b} & lower):
                    length = math.dist(self.position[a], self.position[b]) / UNIT
                    self.neighbours[a][b] = self.neighbours[b][a] = length

    def distances(self, start):
        """Shortest paths along edges (Dijkstra), in eye distances."""
        done, queue = {}, [(0.0, start)]
        while queue:
            d, v = heapq.heappop(queue)
            if v not in done:
                done[v] = d
                for to, length in self.neighbours[v].items():
                    heapq.heappush(queue, (d + length, to))
        return done

    def mean_row(self, v, sources, own, sigma):
        """The sources' rows, averaged with Gaussian weights of distance."""
        d = self.distances(v)
        g = {f: gauss(d[f], sigma) for f in sources}
        return combine((g[f] / sum(g.values()), own[f]) for f in sources)

    def follow_inner_lip(self, v, own):
        """An inner lip vertex moves as the outer vertices of its own lip near it, so the lip keeps its thickness."""
        if v in (60, 64):
            return own[48 if v == 60 else 54]
        upper = 60 < v < 64
        row = self.mean_row(v, UPPER_LIP if upper else LOWER_LIP, own, 0.12)
        row = {c: w for c, w in row.items() if c not in (LOWER_CONTROLS if upper else UPPER_CONTROLS)}
        return {c: w / sum(row.values()) for c, w in row.items()}

    def follow_lids(self, v, own):
        """The pupil keeps its relative position between the eyelids, so that no triangle of the eye folds as they close."""
        side = self.names[v].rsplit("_", 1)[1]
        height = lambda lid: sum(self.position[u][1] for u in lid[side]) / 2
        up = (self.position[v][1] - height(LOWER_LIDS)) / (height(UPPER_LIDS) - height(LOWER_LIDS))
        return combine([(up / 2, own[u]) for u in UPPER_LIDS[side]] +
                       [((1 - up) / 2, own[u]) for u in LOWER_LIDS[side]])

    def follow_features(self, v, own):
        name = self.names[v].replace("right", "{}").replace("left", "{}")
        rows = []
        for sources, mean_sigma, falloff_sigma, factor in FOLLOW.get(name, []):
            if sources == "upper_lid":
                sources = UPPER_LIDS[self.names[v].rsplit("_", 1)[1]]
            elif sources == "lower_lid":
                sources = LOWER_LIDS[self.names[v].rsplit("_", 1)[1]]
            d = self.distances(v)
            falloff = factor * gauss(min(d[f] for f in sources), falloff_sigma)
            row = self.mean_row(v, sources, own, mean_sigma)
            lips = set(sources) & (set(UPPER_LIP) | set(LOWER_LIP))
            foreign = set()
            if lips and not lips & {49, 50, 51, 52, 53}:
                foreign = UPPER_CONTROLS
            if lips and not lips & set(LOWER_LIP_INSIDE):
                foreign = LOWER_CONTROLS
            whole = sum(row.values())
            row = {c: w for c, w in row.items() if c not in foreign}
            rows.append((falloff * whole / sum(row.values()), row))
        return combine(rows)


def mirror_landmark(i):
    for first, last, turn in ((0, 16, 16), (17, 26, 43), (31, 35, 66), (48, 54, 102), (55, 59, 114),
                              (60, 64, 124), (65, 67, 132)):
        if first <= i <= last:
            return turn - i
    return {36: 45, 37: 44, 38: 43, 39: 42, 40: 47, 41: 46}[i]


def gauss(d, sigma):
    return math.exp(-d * d / (2 * sigma * sigma))


def combine(rows):
    out = {}
    for factor, row in rows:
        for c, w in row.items():
            out[c] = out.get(c, 0.0) + factor * w
    return out


def cubic(t):
    """The cardinal cubic B-spline."""
    t = abs(t)
    return 2 / 3 - t * t + t ** 3 / 2 if t < 1 else (2 - t) ** 3 / 6 if t < 2 else 0.0


def basis_rows(feature):
    """{vertex: {control: weight}} of a feature's vertices under its own controls."""
    _, closed, first, n, points = feature
    rows = {}
    for v, s12 in points:
        s = s12 / 12
        if closed:
            weights = [cubic((s - i + n / 2) % n - n / 2) for i in range(n)]
        elif n == 1:
            weights = [1.0]
        else:
            weights = [math.comb(3, i) * s ** i * (1 - s) ** (3 - i) for i in range(4)]
            weights = weights if n == 4 else weights[1:3]
        rows[v] = {first + i: w for i, w in enumerate(weights) if w > 0}
    return rows


def to_weights(row, wholes):
    """Rounds a row to integers; the controls of each set in `wholes` sum to exactly one."""
    out = {c: to_units(w) for c, w in row.items()}
    out = {c: w for c, w in out.items() if abs(w) >= SMALLEST_WEIGHT}
    for whole in wholes:
        ours = [c for c in sorted(out) if c in whole]
        largest = [c for c in ours if out[c] == max(out[d] for d in ours)]
        rest = UNIT - sum(out[c] for c in ours)
        assert rest % len(largest) == 0 and abs(rest) < 2 * SMALLEST_WEIGHT, (row, out, rest)
        for c in largest:
            out[c] += rest // len(largest)
    return dict(sorted(out.items()))


def to_gltf(head):
    positions = b"".join(struct.pack("<3f", *(c / UNIT for c in p)) for p in head.position)
    indices = b"".join(struct.pack("<3H", *t) for t in head.triangles)
    data = positions + indices
    landmark = lambda v: v if v < 68 else -1
    vertices = [{"name": head.names[v], "mirror": head.mirror[v], "landmark": landmark(v),
                 "feature": head.feature_of[v], "skinning": [[c, w] for c, w in head.skinning[v].items()]}
                for v in range(105)]
    features = [{"name": name, "closed": closed, "first_control": first, "control_count": n,
                 "vertices_s12": [list(p) for p in points]}
                for name, closed, first, n, points in head.features]
    low, high = ([f(p[k] for p in head.position) / UNIT for k in range(3)] for f in (min, max))
    return {
        "asset": {"version": "2.0", "generator": "fbs common/author_generic_head.py"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "generic_head", "mesh": 0}],
        "meshes": [{
            "name": "generic_head",
            "primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 4}],
            "extras": {"units_per_eye_distance": UNIT, "skinning_one": UNIT, "features": features,
                       "outline": head.outline, "vertices": vertices},
        }],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 105, "type": "VEC3", "min": low, "max": high},
            {"bufferView": 1, "componentType": 5123, "count": 3 * len(head.triangles), "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(positions), "target": 34962},
            {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices), "target": 34963},
        ],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," +
                     base64.b64encode(data).decode()}],
    }


def to_json(value, depth=0):
    """JSON with one line per element of the outer levels, for readable diffs."""
    flat = json.dumps(value)
    if len(flat) < 100 or depth > 5 or not isinstance(value, (dict, list)):
        return flat
    pad, end = "\n" + " " * (depth + 1), "\n" + " " * depth
    if isinstance(value, dict):
        return "{" + pad + ("," + pad).join(f"{json.dumps(k)}: {to_json(v, depth + 1)}"
                                            for k, v in value.items()) + end + "}"
    return "[" + pad + ("," + pad).join(to_json(v, depth + 1) for v in value) + end + "]"


def moved(head, offsets):
    """Positions in eye distances after moving controls by {control: (dx, dy)}, y up."""
    out = []
    for p, row in zip(head.position, head.skinning):
        x, y, z = (c / UNIT for c in p)
        for c, w in row.items():
            dx, dy = offsets.get(c, (0, 0))
            x, y = x + dx * w / UNIT, y + dy * w / UNIT
        out.append((x, y, z))
    return out


def closed_lids(head, amount):
    """Offsets of the upper eyelids that bring their vertices this fraction of the distance to the lower ones."""
    offsets = {}
    for first, pairs in ((26, ((37, 41), (38, 40))), (28, ((43, 47), (44, 46)))):
        a, b = (amount * (head.position[low][1] - head.position[up][1]) / UNIT for up, low in pairs)
        offsets[first], offsets[first + 1] = (0, 3 * a - 1.5 * b), (0, 3 * b - 1.5 * a)
    return offsets


def preview(head, path):
    import cv2
    import numpy as np

    def draw(points, yaw, shaded, size=560, scale=150):
        image = np.full((size, 420, 3), 255, np.uint8)
        c, s = math.cos(yaw), math.sin(yaw)
        turned = np.array([(c * x + s * z, y, c * z - s * x) for x, y, z in points]) - (s * 0.6, -0.33, 0)
        flat = np.stack([210 + scale * turned[:, 0], size / 2 - scale * turned[:, 1]], 1)
        light = np.array([0.35, 0.45, 0.82])
        for t in sorted(head.triangles, key=lambda t: sum(turned[v][2] for v in t)):
            normal = np.cross(turned[t[1]] - turned[t[0]], turned[t[2]] - turned[t[0]])
            normal /= np.linalg.norm(normal) + 1e-12
            corners = np.round(flat[list(t)] * 16).astype(np.int32)
            if shaded:
                grey = 60 + 180 * max(0.0, float(normal @ light))
                cv2.fillConvexPoly(image, corners, (grey, grey, grey), cv2.LINE_AA, 4)
            colour = (40, 40, 220) if normal[2] < 0 else (150, 90, 20)
            if not shaded:
                cv2.polylines(image, [corners], True, colour, 1, cv2.LINE_AA, 4)
        return image

    neutral = moved(head, {})
    shut = moved(head, closed_lids(head, 0.95))
    opened = moved(head, {c: (0, -0.4) for c in (6, 7, 8, 9)})
    raised = moved(head, {c: (0, 0.2) for c in range(18, 26)})
    top = [draw(neutral, 0, False), draw(neutral, math.pi / 5, False), draw(neutral, math.pi / 2, False),
           draw(shut, 0, False), draw(opened, 0, False)]
    bottom = [draw(neutral, 0, True), draw(neutral, math.pi / 5, True), draw(neutral, math.pi / 2, True),
              draw(raised, 0, False), draw(opened, math.pi / 5, True)]
    cv2.imwrite(path, np.vstack([np.hstack(top), np.hstack(bottom)]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--output", default=pathlib.Path(__file__).with_name("generic_head.gltf"))
    parser.add_argument("--preview", metavar="PNG", help="draw the head as well")
    args = parser.parse_args()
    head = Head()
    pathlib.Path(args.output).write_text(to_json(to_gltf(head)) + "\n")
    if args.preview:
        preview(head, args.preview)


if __name__ == "__main__":
    main()
