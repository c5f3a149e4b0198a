"""Geometry packet: the vertices of the adapted head (SPEC 4.2)."""

import numpy as np

from .byte_reader import ByteReader
from .draco import read_points
from .errors import invalid, too_large
from .integers import nearest, quotient
from .limits import MAX_COORDINATE, MAX_GEOMETRY_PAYLOAD

MAX_SCALE = 65536  # 1/4096
MAX_STEP = 4096  # head units
MAX_RESIDUAL = 2**20  # steps
NONE, NEIGHBOURS, MIRROR = range(3)


def read_geometry(payload, frame):
    """Positions x, y, z of the vertices of a wire-frame, head units."""
    if len(payload) > MAX_GEOMETRY_PAYLOAD:
        raise too_large("a geometry packet is too long")
    reader = ByteReader(payload)
    scale = np.array([_varint_up_to(reader, MAX_SCALE) for _ in range(3)])
    step = _varint_up_to(reader, MAX_STEP)
    prediction = reader.u8()
    if prediction > MIRROR:
        raise invalid("an unknown prediction of the geometry")
    residuals = _residuals(frame, read_points(reader.rest(), frame.vertices), prediction)
    if np.any(np.abs(residuals) > MAX_RESIDUAL):
        raise invalid("a residual of the geometry is too large")
    positions = nearest(np.array(frame.positions) * scale, 12) + residuals * step
    if np.any(np.abs(positions) > MAX_COORDINATE):
        raise invalid("a coordinate of the geometry is too large")
    return positions


def _varint_up_to(reader, high):
    value = reader.varint()
    if not 1 <= value <= high:
        raise invalid("a field of the geometry is out of its range")
    return value


def _residuals(frame, points, prediction):
    """Residuals of the vertices, in steps, from the coded points."""
    neighbours = [set() for _ in range(frame.vertices)]
    for triangle in frame.triangles:
        for v in triangle:
            neighbours[v].update(u for u in triangle if u < v)
    residuals = np.array(points)
    for v in range(frame.vertices):
        if prediction == NEIGHBOURS and neighbours[v]:
            residuals[v] += quotient(sum(residuals[u] for u in neighbours[v]), len(neighbours[v]))
        if prediction == MIRROR and frame.mirror[v] < v:
            residuals[v] += residuals[frame.mirror[v]] * (-1, 1, 1)
    return residuals
