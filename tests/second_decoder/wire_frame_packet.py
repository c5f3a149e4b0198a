"""Wire-frame packet: a mesh in the place of the generic head (SPEC 4.8)."""

from .errors import invalid, too_large
from .head import HEAD
from .limits import (MAX_ATLAS_COORDINATE, MAX_COORDINATE, MAX_FEATURE_VERTICES, MAX_OUTLINE, MAX_SKINNING_SUM,
                     MAX_WIRE_FRAME_PAYLOAD, MAX_WIRE_FRAME_TRIANGLES, MAX_WIRE_FRAME_VERTICES,
                     MIN_WIRE_FRAME_VERTICES)
from .range_decoder import Exponential, RangeDecoder, Wide
from .wire_frame import (CONTROLS, FEATURES, INNER_LIPS, LANDMARKS, LEFT_MOUTH_CORNER, LEFT_PUPIL, RIGHT_MOUTH_CORNER,
                         RIGHT_PUPIL, Feature, WireFrame)


def read_wire_frame(payload):
    if len(payload) > MAX_WIRE_FRAME_PAYLOAD:
        raise too_large("a wire-frame packet is too long")
    frame = _Reader(payload).frame()
    _check(frame)
    return frame


class _Reader:
    """The elements of the payload, and their contexts."""

    def __init__(self, payload):
        self._decoder = RangeDecoder(payload)
        self._vertices = 0
        self._size = Exponential()
        self._control = Exponential()
        self._index = Wide()
        self._weight = Wide()
        self._position = [Wide() for _ in range(3)]
        self._corner = [Wide() for _ in range(3)]
        self._atlas = [Wide() for _ in range(2)]

    def frame(self):
        self._vertices = self._read_size(MIN_WIRE_FRAME_VERTICES, MAX_WIRE_FRAME_VERTICES)
        positions = self._points(self._position, self._vertices, -MAX_COORDINATE, MAX_COORDINATE)
        landmark_vertices = self._read_vertices(LANDMARKS)
        features = [self._read_vertices(self._read_size(1, MAX_FEATURE_VERTICES)) for _ in range(FEATURES)]
        triangles = self._triangles(self._read_size(1, MAX_WIRE_FRAME_TRIANGLES))
        outline = self._read_vertices(self._read_size(3, MAX_OUTLINE))
        skinning = [self._pairs(self._read_size(0, CONTROLS)) for _ in range(self._vertices)]
        atlas = self._points(self._atlas, self._vertices + len(outline), 0, MAX_ATLAS_COORDINATE)
        self._decoder.finish()
        return WireFrame(
            positions=positions, triangles=triangles, outline=outline, mirror=list(range(self._vertices)),
            landmark_vertices=landmark_vertices, skinning=skinning, atlas=atlas,
            features=[Feature(generic.closed, generic.first_control, generic.controls, vertices)
                      for generic, vertices in zip(HEAD.features, features)])

    def _read_size(self, low, high):
        size = low + self._decoder.exponential(self._size)
        if size > high:
            raise invalid("a table of a wire-frame is too long")
        return size

    def _number(self, contexts, before, low, high):
        number = before + self._decoder.wide(contexts)
        if not low <= number <= high:
            raise invalid("a number of a wire-frame is out of its range")
        return number

    def _vertex(self, contexts, before):
        return self._number(contexts, before, 0, self._vertices - 1)

    def _read_vertices(self, count):
        vertices = []
        for _ in range(count):
            vertices.append(self._vertex(self._index, vertices[-1] if vertices else 0))
        return vertices

    def _points(self, contexts, count, low, high):
        points = []
        before = (0,) * len(contexts)
        for _ in range(count):
            before = tuple(self._number(c, b, low, high) for c, b in zip(contexts, before))
            points.append(before)
        return points

    def _triangles(self, count):
        triangles = []
        for _ in range(count):
            last = triangles[-1][0] if triangles else 0
            triangle = []
            for contexts in self._corner:
                last = self._vertex(contexts, last)
                triangle.append(last)
            triangles.append(triangle)
        return triangles

    def _pairs(self, count):
        pairs = []
        control = -1
        for _ in range(count):
            control += 1 + self._decoder.exponential(self._control)
            if control >= CONTROLS:
                raise invalid("a control point that there is not")
            pairs.append((control, self._number(self._weight, 0, -MAX_SKINNING_SUM, MAX_SKINNING_SUM)))
        return pairs


def _check(frame):
    """The rules for whole tables."""
    def are_different(vertices):
        return len(set(vertices)) == len(vertices)

    lips = frame.features[INNER_LIPS].vertices
    corners = [frame.landmark_vertices[k] for k in (RIGHT_MOUTH_CORNER, LEFT_MOUTH_CORNER)]
    rules = (
        are_different(frame.landmark_vertices),
        all(are_different(triangle) for triangle in frame.triangles),
        are_different(frame.outline),
        are_different([v for feature in frame.features for v in feature.vertices]),
        all(len(frame.features[pupil].vertices) == 1 for pupil in (RIGHT_PUPIL, LEFT_PUPIL)),
        lips[0] == corners[0] and corners[1] in lips,
        all(weight != 0 for pairs in frame.skinning for _, weight in pairs),
        all(sum(abs(weight) for _, weight in pairs) <= MAX_SKINNING_SUM for pairs in frame.skinning))
    if not all(rules):
        raise invalid("a wire-frame breaks a rule")
