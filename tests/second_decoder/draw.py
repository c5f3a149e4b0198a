"""Draws pictures of a scene from the patterns of its store (SPEC 10, 11.6, 11.7)."""

import numpy as np

from .atlas import atlas_weights
from .integers import clamp
from .mouth import Opening, amount
from .nodes import Nodes, rounded_weights
from .patches import blended, displacements, warped
from .raster import FARTHEST, NO_TRIANGLE, Fragments, Plane, Triangles, planes
from .samples import Blend, blur, cell_shares, light, restore_contrast, sample_texture
from .silhouette import silhouettes, soften
from .weights import ground_weights, point_weights


def draw_without_geometry(setup, sources):
    """The picture, planes Y, U, V, of a scene without geometry."""
    nodes = np.ones((setup.height // 8 + 2, setup.width // 8 + 2), np.int64)
    weights = [weight * nodes for weight in ground_weights(sources)]
    return [blended(plane, [source.pattern.planes[k] for source in sources], weights)
            for k, plane in enumerate(planes(setup.width, setup.height))]


def draw(setup, mesh, sources, state):
    """The picture of a state, planes Y, U, V."""
    scene = _PictureDrawing(setup, mesh, sources, state)
    picture = scene.surround()
    if not mesh.is_plane:
        scene.draw_head(picture)
    return picture


class _PictureDrawing:
    """One picture: the surround, then the head."""

    def __init__(self, setup, mesh, sources, state):
        self._setup = setup
        self._mesh = mesh
        self._sources = sources
        self._state = state
        self._now = mesh.place(state)
        self._weights = point_weights(mesh, sources, self._now)
        self._planes = planes(setup.width, setup.height)

    def surround(self):
        """Planes Y, U, V of the picture without the head."""
        now = self._now
        nodes = Nodes(self._setup.width, self._setup.height, self._mesh.surround_triangles(), now.x, now.y)
        fields = []
        for source in self._sources:
            seen = source.pattern.placement
            fields.append(None if source.still else
                          displacements(nodes, (seen.x, seen.y), (now.x, now.y), self._setup.width, self._setup.height))
        ground = ground_weights(self._sources)[:, None, None]
        weights = np.array([nodes.at(weight) for weight in self._weights])
        weights = np.where(nodes.is_covered, rounded_weights(weights, 16), ground)
        return [blended(plane, [warped(source.pattern.planes[k], plane, field)
                                for source, field in zip(self._sources, fields)], weights)
                for k, plane in enumerate(self._planes)]

    def draw_head(self, picture):
        """Draws the head over the picture."""
        corners = self._mesh.head_triangles
        triangles = Triangles(self._now.x[corners], self._now.y[corners])
        head = slice(self._mesh.grid_points, None)
        shows = (self._weights[:, head] != 0).any(axis=1)
        warped_ones = [k for k, source in enumerate(self._sources) if shows[k] and not source.still]
        texture = None
        if warped_ones:
            texture = self._mesh.atlas.blend([self._sources[k].pattern.atlas for k in warped_ones],
                                             atlas_weights(self._mesh.frame, self._weights[warped_ones, head]))
        vertices = self._now.x[head][:self._mesh.frame.vertices]
        weights = [self._weights[warped_ones].sum(axis=0)]
        edges = silhouettes(corners, self._now.x, self._now.y, weights[0])
        weights += [weight for weight, source in zip(self._weights, self._sources) if source.still]
        for k, plane in enumerate(self._planes):
            shown = np.full((plane.height, plane.width), NO_TRIANGLE)
            depth = np.full(shown.shape, FARTHEST)
            triangles.draw_with_depth(shown, depth, plane, self._now.z[corners])
            fragments = Fragments(triangles, shown, plane)
            stills = [source.pattern.planes[k] for source in self._sources if source.still]
            samples = [self._from_atlas(texture[k], k, fragments) if texture else None]
            samples += [self._from_still(plane_of_still, fragments) for plane_of_still in stills]
            picture[k][fragments.rows, fragments.columns] = self._blend(fragments, samples, weights)
            soften(picture[k], plane, depth, edges, self._now, int(vertices.max() - vertices.min()))
        self._mix_mouth(picture)

    def _mix_mouth(self, picture):
        head = slice(self._mesh.grid_points, None)
        opening = Opening(self._mesh.frame, self._now.x[head], self._now.y[head])
        most = amount(self._sources, self._now)
        if most == 0 or not opening.is_drawn:
            return
        for k, plane in enumerate(self._planes):
            colours = self._setup.upper_lip[k], self._setup.lower_lip[k]
            offsets = self._state.mouth_interior if k == 0 else (0, 0, 0)
            picture[k][:] = opening.mix(picture[k], plane, colours, offsets, most)

    def _blend(self, fragments, samples, weights):
        corners = self._mesh.head_triangles
        used = np.array([(weight[corners] != 0).any(axis=1) for weight in weights])  # by triangles
        last = len(weights) - 1 - used[::-1].argmax(axis=0)
        blend = Blend(len(fragments.triangle))
        for k, (sample, weight) in enumerate(zip(samples, weights)):
            at = np.flatnonzero(used[k, fragments.triangle])
            if len(at):
                blend.add(at, sample[at], fragments.quantities(weight[corners])[at], last[fragments.triangle[at]] == k)
        return blend.result()

    def _from_still(self, texture, fragments):
        corners = self._mesh.head_triangles
        return sample_texture(texture, fragments.texture_positions(self._now.x[corners]),
                              fragments.texture_positions(self._now.y[corners]))

    def _from_atlas(self, texture, plane, fragments):
        """Samples of plane 0, 1 or 2 from the blended atlas, with light."""
        atlas, corners = self._mesh.atlas, self._mesh.head_triangles - self._mesh.grid_points
        samples = sample_texture(texture, fragments.texture_positions(atlas.x[corners]),
                                 fragments.texture_positions(atlas.y[corners]))
        if plane == 0:
            offset, gain = (at[self._mesh.head_triangles] for at in (self._now.offset, self._now.gain))
            samples = light(samples, fragments.quantities(offset), fragments.quantities(gain))
        return samples


def face_cells(setup, mesh, seen):
    """Share of the face in cells of a pattern, 1/255; `seen` is the pattern's placement (SPEC 11.7)."""
    vertices = slice(mesh.grid_points, mesh.grid_points + mesh.frame.vertices)
    corners = mesh.head_triangles[(mesh.head_triangles < vertices.stop).all(axis=1)]
    triangles = Triangles(seen.x[corners] >> 2, seen.y[corners] >> 2)
    plane = Plane((setup.width + 3) // 4, (setup.height + 3) // 4, 6)
    shown = np.full((plane.height, plane.width), NO_TRIANGLE)
    triangles.draw(shown, plane)
    cells = np.where(shown == NO_TRIANGLE, 0, 255)
    radius = int(clamp((seen.x[vertices].max() - seen.x[vertices].min()) >> 12, 1, 64))
    for _ in range(3):
        cells = blur(blur(cells, radius, 1), radius, 0)
    return cells


def with_full_contrast(setup, mesh, seen, coded):
    """The planes of a pattern as they were before the encoder lessened their contrast."""
    shares = cell_shares(face_cells(setup, mesh, seen), coded[0].shape)
    outside, chroma = 256 - setup.contrast, 256 + 2 * setup.chroma_contrast
    luma = outside + ((256 - outside) * shares + 127) // 255
    return [restore_contrast(plane, contrast) for plane, contrast in zip(coded, (luma, chroma, chroma))]
