"""Draws pictures of a scene from the patterns of its store (SPEC 10, 11.6, 11.7)."""

import numpy as np

from .head import HEAD, VERTICES
from .integers import clamp
from .mesh import MOUTH_INTERIOR
from .raster import NO_TRIANGLE, Fragments, Triangles, planes
from .samples import (MAX_AMOUNT, WEIGHT_ONE, Blend, blend_planes, light, mouth_interior, restore_contrast,
                      sample_texture)
from .weights import ground_weights, point_weights

_RAMP = {60: 128, 61: 0, 62: 0, 63: 0, 64: 128, 65: 256, 66: 256, 67: 256}  # of the mouth colours, by landmark
_HEAD_RAMP = np.array([_RAMP.get(landmark, 0) for landmark in HEAD.landmark] + [0] * len(HEAD.outline))


def draw_without_geometry(sources):
    """The picture, planes Y, U, V, of a scene without geometry."""
    weights = ground_weights(sources)
    return [blend_planes([source.pattern.planes[i] for source in sources], weights) for i in range(3)]


def draw(setup, mesh, sources, state):
    """The picture of a state, planes Y, U, V."""
    picture = draw_without_geometry(sources)
    scene = _PictureDrawing(setup, mesh, sources, state)
    formats = planes(setup.width, setup.height)
    luma = scene.fragments(formats[0])
    chroma = scene.fragments(formats[1])
    for i, fragments in enumerate((luma, chroma, chroma)):
        picture[i][fragments.rows, fragments.columns] = scene.samples(i, fragments)
    return picture


class _PictureDrawing:
    """The triangles of one picture: cells of the surround, then the head."""

    def __init__(self, setup, mesh, sources, state):
        self._setup = setup
        self._sources = sources
        self._state = state
        self._now = mesh.place(state)
        self._weights = point_weights(mesh, sources, self._now)
        cells = self._drawn_cells(mesh)
        surround = np.stack([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]], axis=1).reshape(-1, 3)
        self._corners = np.concatenate([surround, mesh.head_triangles])
        self._first_of_head = len(surround)
        self._triangles = Triangles(self._now.x[self._corners], self._now.y[self._corners])
        self._is_mouth = np.concatenate([np.zeros(len(surround), bool), MOUTH_INTERIOR])
        self._ramp = np.concatenate([np.zeros(mesh.grid_points, np.int64), _HEAD_RAMP])[self._corners]
        self._used = (self._weights[:, self._corners] != 0).any(axis=2)  # sources by triangles
        self._last_source = len(sources) - 1 - self._used[::-1].argmax(axis=0)

    def _drawn_cells(self, mesh):
        """The cells that change what the blended patterns show (SPEC 10.3)."""
        grid = slice(0, mesh.grid_points)
        like_ground = (self._weights[:, grid] == ground_weights(self._sources)[:, None]).all(axis=0)
        for source, weights in zip(self._sources, self._weights):
            if not source.still:
                seen = source.pattern.placement
                same = (self._now.x[grid] == seen.x[grid]) & (self._now.y[grid] == seen.y[grid])
                like_ground &= same | (weights[grid] == 0)
        return mesh.cells[~like_ground[mesh.cells].all(axis=1)]

    def fragments(self, plane):
        """The samples that surround and head cover in a plane."""
        shown = np.full((plane.height, plane.width), NO_TRIANGLE)
        head = self._first_of_head
        Triangles(self._triangles.x[:head], self._triangles.y[:head]).draw(shown, plane)
        self._triangles.draw_with_depth(shown, plane, self._now.z[self._corners], head)
        return Fragments(self._triangles, shown, plane)

    def samples(self, plane, fragments):
        """The samples of plane 0, 1 or 2 at the fragments."""
        blend = Blend(len(fragments.triangle))
        for k, source in enumerate(self._sources):
            at = np.flatnonzero(self._used[k, fragments.triangle])
            samples = self._sample(plane, fragments, source)[at]
            weight = fragments.quantities(self._weights[k][self._corners])[at]
            blend.add(at, samples, weight, self._last_source[fragments.triangle[at]] == k)
        return blend.result()

    def _sample(self, plane, fragments, source):
        """The samples of one source."""
        texture = source.pattern.planes[plane]
        seen = source.pattern.placement
        x, y = (self._now.x, self._now.y) if source.still else (seen.texture_x, seen.texture_y)
        samples = sample_texture(texture, fragments.texture_positions(x[self._corners]),
                                 fragments.texture_positions(y[self._corners]))
        if source.still:
            return samples
        if plane == 0:
            offset, gain = ((now - then)[self._corners] for now, then in
                            ((self._now.offset, seen.offset), (self._now.gain, seen.gain)))
            samples = light(samples, fragments.quantities(offset), fragments.quantities(gain))
        amount = clamp(self._now.gap - seen.gap, 0, MAX_AMOUNT)
        colours = self._setup.upper_lip[plane], self._setup.lower_lip[plane]
        offsets = self._state.mouth_interior if plane == 0 else (0, 0, 0)
        mixed = mouth_interior(samples, fragments.quantities(self._ramp), amount, colours, offsets)
        return np.where(self._is_mouth[fragments.triangle], mixed, samples)


def face_shares(mesh, seen, plane):
    """Share of the face in the samples of a pattern, 1/255; `seen` is the pattern's placement (SPEC 11.7)."""
    corners = mesh.head_triangles
    triangles = Triangles(seen.x[corners], seen.y[corners])
    shown = np.full((plane.height, plane.width), NO_TRIANGLE)
    triangles.draw(shown, plane)
    fragments = Fragments(triangles, shown, plane)
    weight = np.where(corners < mesh.grid_points + VERTICES, WEIGHT_ONE, 0)
    blend = Blend(len(fragments.triangle))
    blend.add(np.arange(len(fragments.triangle)), 255, fragments.quantities(weight), is_last=False)
    shares = np.zeros(shown.shape, np.int64)
    shares[fragments.rows, fragments.columns] = blend.result()
    return shares


def with_full_contrast(setup, mesh, seen, coded):
    """The planes of a pattern as they were before the encoder lessened their contrast."""
    luma, chroma, _ = planes(setup.width, setup.height)
    outside, chroma_inside = 256 - setup.contrast, 256 + 2 * setup.chroma_contrast
    face, chroma_face = face_shares(mesh, seen, luma), face_shares(mesh, seen, chroma)
    return [restore_contrast(coded[0], face, outside, 256)] + [
        restore_contrast(plane, chroma_face, outside, chroma_inside) for plane in coded[1:]]
