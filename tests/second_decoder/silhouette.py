"""The picture along silhouettes of the head, softened (SPEC 10.13)."""

import numpy as np

from .integers import clamp, quotient
from .raster import signed_areas

HIDDEN = 768  # of an edge, head units: farther behind what is drawn
FAR_BEHIND = 384  # of what is behind an edge, head units


def silhouettes(corners, x, y, warped):
    """Pairs of vertices, lower number first, that a drawn triangle shares with one that is not drawn.

    warped  weight of the warped sources at each vertex
    """
    drawn = signed_areas(x[corners], y[corners]) > 0
    pairs = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
    is_drawn = np.tile(drawn, 3)
    of_drawn, of_others = ({tuple(pair) for pair in pairs[which].tolist()} for which in (is_drawn, ~is_drawn))
    return sorted(pair for pair in of_drawn & of_others if warped[list(pair)].any())


def soften(samples, plane, depth, edges, now, width):
    """Softens the samples of a plane in place.

    depth  of each sample
    edges  silhouettes()
    now    placement of the mesh
    width  of the face, 1/64 luma sample
    """
    one = 1 << plane.bits
    radius = int(clamp(width >> 5, one, 8 * one))
    marked = np.zeros(samples.shape, bool)
    for first, second in edges:
        _mark(marked, plane, depth, [tuple(int(at[v]) for at in (now.x, now.y, now.z)) for v in (first, second)], radius)
    for _ in range((radius + one // 2) >> plane.bits):
        around = np.pad(samples, 1, mode="edge").astype(np.int64)
        across = around[:, :-2] + 2 * around[:, 1:-1] + around[:, 2:]
        soft = (across[:-2] + 2 * across[1:-1] + across[2:] + 8) >> 4
        samples[marked] = soft[marked]


def _mark(marked, plane, depth, ends, radius):
    (x0, y0, z0), (x1, y1, z1) = ends
    left, right = plane.samples_between(min(x0, x1) - radius, max(x0, x1) + radius, plane.width)
    top, bottom = plane.samples_between(min(y0, y1) - radius, max(y0, y1) + radius, plane.height)
    if left >= right or top >= bottom:
        return
    rows, columns = np.mgrid[top:bottom, left:right]
    x, y = plane.centres(columns), plane.centres(rows)
    dx, dy = x1 - x0, y1 - y0
    square = dx * dx + dy * dy
    t = clamp(quotient(((x - x0) * dx + (y - y0) * dy) << 12, square), 0, 1 << 12) if square else np.zeros_like(x)
    ex, ey, ez = (start + (step * t >> 12) for start, step in ((x0, dx), (y0, dy), (z0, z1 - z0)))
    near = (x - ex) ** 2 + (y - ey) ** 2 <= radius * radius
    seen = depth[rows, columns] >= ez - HIDDEN
    far_behind = np.zeros_like(near)
    for j in (-1, 0, 1):
        for i in (-1, 0, 1):
            row, column = (ey >> plane.bits) + j, (ex >> plane.bits) + i
            inside = (row >= 0) & (row < plane.height) & (column >= 0) & (column < plane.width)
            behind = depth[clamp(row, 0, plane.height - 1), clamp(column, 0, plane.width - 1)]
            far_behind |= inside & (behind > ez + FAR_BEHIND)
    marked[top:bottom, left:right] |= near & seen & far_behind
