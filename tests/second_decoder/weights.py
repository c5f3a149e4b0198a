"""Sources of a picture and their weights in the regions and at the points of the mesh (SPEC 11.2 to 11.5)."""

from dataclasses import dataclass

import numpy as np

from .head import HEAD
from .integers import clamp, complete, exp2, log2, quotient
from .raster import signed_areas
from .wire_frame import (BODY, FACE, GROUND, HAIR, INNER_LIPS, LEFT_BROW, LEFT_EYE, MOUTH, OUTER_LIPS, REGION_FEATURES,
                         RIGHT_BROW, RIGHT_EYE)

ONE = 4096  # sum of the weights of all sources at a point of the mesh
REGION_ONE = 256  # and in a region


@dataclass
class RegionRule:
    """How weights depend on the states (tables of SPEC 11.2 and 11.3)."""
    head: int
    body: int
    mouth: int
    brows: int
    eye: int
    time: int
    share: int  # of the weight that depends on the state, 1/64
    count: int  # of patterns that keep a weight


_EYE_RULE = RegionRule(1200, 0, 0, 900, 250, 32, share=64, count=3)
RULES = {MOUTH: RegionRule(600, 0, 250, 0, 0, 8, share=48, count=5),
         RIGHT_EYE: _EYE_RULE,
         LEFT_EYE: _EYE_RULE,
         FACE: RegionRule(280, 0, 1000, 460, 0, 3, share=48, count=4),
         HAIR: RegionRule(230, 0, 0, 0, 0, 128, share=48, count=3),
         BODY: RegionRule(2400, 400, 0, 0, 0, 26, share=48, count=3),
         GROUND: RegionRule(0, 0, 0, 0, 0, 256, share=0, count=2)}
BY_STATE, BY_TIME, HALF_STILL, STILL_BEFORE, STILL_AFTER, FIRST_NEAREST = range(6)


@dataclass
class Source:
    """A pattern as a texture: warped from its seen state, or still."""
    pattern: object
    still: bool
    regions: list  # its weight in each region, 1/256


def _square(x, unit):
    """Square of a difference, 2^-16 of that of the unit."""
    return min(abs(x) * 256 // unit, 2**24) ** 2 if unit else 0


def _control_squares(seen, now, features, unit):
    controls = [c for feature in features for c in HEAD.features[feature].control_range()]
    differences = abs(seen.controls[controls] - now.controls[controls])
    return int((clamp(differences * 256 // unit, 0, 2**24) ** 2).sum()) if unit else 0


def _state_distance(region, seen, now):
    """Squared distance of two states for a region, 2^-16."""
    rule = RULES[region]
    scale = exp2(now.log_scale)
    return (_square(seen.pitch - now.pitch, rule.head) + _square(seen.yaw - now.yaw, rule.head)
            + _square(seen.roll - now.roll, 2 * rule.head)
            + sum(_square(quotient((a - b) * 2**22, scale), rule.body) for a, b in zip(seen.body, now.body))
            + _control_squares(seen, now, (OUTER_LIPS, INNER_LIPS), rule.mouth)
            + _control_squares(seen, now, (RIGHT_BROW, LEFT_BROW), rule.brows)
            + (_control_squares(seen, now, REGION_FEATURES[region], rule.eye) if rule.eye else 0))


class PictureWeights:
    """Weights of the patterns of the store for one picture.

    patterns  those of the store, by slot; each has a state and the number of its picture
    """

    def __init__(self, patterns, now, number):
        self._patterns = patterns
        self._now = now
        self._number = number
        self._find_neighbours()

    def _find_neighbours(self):
        """The patterns before and after the picture in time, and the cross-fade from one to the other in 2^-16."""
        numbers = [pattern.number for pattern in self._patterns]
        earlier = [n for n in numbers if n <= self._number]
        later = [n for n in numbers if n > self._number]
        before = numbers.index(max(earlier)) if earlier else None
        after = numbers.index(min(later)) if later else before
        self._before = after if before is None else before
        self._after = after
        passed = self._number - numbers[self._before]
        self._fade = 0 if self._before == after else passed * 2**16 // (numbers[after] - numbers[self._before])

    def _distances(self, region):
        """Squared distance of each pattern from the picture, 2^-16."""
        numbers = [pattern.number for pattern in self._patterns]
        spacing = max(1, (max(numbers) - min(numbers)) // max(len(numbers) - 1, 1))
        return [_state_distance(region, pattern.state, self._now)
                + (RULES[region].time * _square(pattern.number - self._number, spacing) >> 8)
                for pattern in self._patterns]

    def _by_state(self, rule, distances):
        """Weight of each pattern by its state."""
        logs = [log2(d + 2**16) for d in distances]
        falls = [(e - min(logs)) * 307 >> 8 for e in logs]
        values = [0 if fall > 13 * 2**12 else exp2(13 * 2**12 - fall) >> 13 for fall in falls]
        weights = [v * 2**16 // sum(values) * rule.share // 64 for v in values]
        weights[self._before] += (2**16 - self._fade) * (64 - rule.share) // 64
        weights[self._after] += self._fade * (64 - rule.share) // 64
        if len(weights) > rule.count:
            largest = weights.index(max(weights))
            threshold = sorted(weights, reverse=True)[rule.count]
            weights = [max(w - threshold, 0) for w in weights]
            weights[largest] = max(weights[largest], 1)
        return weights

    def region_weights(self, region, mode):
        """Weight in 1/256 of each source of a region; a source is (place in patterns, is it still)."""
        distances = self._distances(region)
        by_state = self._by_state(RULES[region], distances)
        total = sum(by_state)
        weights = {(k, still): 0 for k in range(len(self._patterns)) for still in (False, True)}
        if mode not in (BY_TIME, STILL_BEFORE, STILL_AFTER):
            for k, weight in enumerate(by_state):
                weights[k, False] += weight
        if mode == BY_TIME:
            weights[self._before, False] += 2**16 - self._fade
            weights[self._after, False] += self._fade
        elif mode == HALF_STILL:
            half = total * self._fade >> 16
            weights[self._before, True] += total - half
            weights[self._after, True] += half
        elif mode == STILL_BEFORE:
            weights[self._before, True] = 1
        elif mode == STILL_AFTER:
            weights[self._after, True] = 1
        elif mode >= FIRST_NEAREST:
            place = min(mode - FIRST_NEAREST, len(distances) - 1)
            nearest_first = sorted(range(len(distances)), key=lambda k: distances[k])
            weights[nearest_first[place], False] += total
        return self._rounded(weights)

    @staticmethod
    def _rounded(weights):
        total = sum(weights.values())
        rounded = {source: (weight * REGION_ONE + total // 2) // total for source, weight in weights.items()}
        largest = max(rounded, key=rounded.get)
        rounded[largest] += REGION_ONE - sum(rounded.values())
        return rounded

    def sources(self, modes):
        """The sources of the picture, in their order; modes are those of the regions."""
        by_region = [self.region_weights(region, mode) for region, mode in enumerate(modes)]
        return [Source(self._patterns[k], still, [weights[k, still] for weights in by_region])
                for k, still in by_region[0] if any(weights[k, still] for weights in by_region)]


def ground_weights(sources):
    """Weight of each source in the ground, 1/256."""
    return np.array([source.regions[GROUND] for source in sources])


def point_weights(mesh, sources, now):
    """Weights of the sources (rows) at the points of the mesh (columns), 1/4096; `now` is the picture's placement."""
    weights = np.array([mesh.shares @ np.array(source.regions) for source in sources])
    head = slice(mesh.grid_points, mesh.grid_points + mesh.frame.vertices)
    weights[:, head] = _visible_weights(weights[:, head], _visibility(mesh, sources, now))
    return weights


def _vertex_areas(mesh, placement):
    """Area of the front sides of the triangles around each vertex, in squares of 1/64 sample, times two."""
    triangles = np.array(mesh.frame.triangles)
    corners = triangles + mesh.grid_points
    areas = np.maximum(signed_areas(placement.x[corners], placement.y[corners]), 0)
    sums = np.zeros(mesh.frame.vertices, np.int64)
    np.add.at(sums, triangles, areas[:, None])
    return sums


def _visibility(mesh, sources, now):
    """How well each source (rows) shows each vertex of the head (columns), 1/256."""
    area = _vertex_areas(mesh, now)
    visibility = np.full((len(sources), mesh.frame.vertices), 256)
    for row, source in zip(visibility, sources):
        if not source.still:
            seen = _vertex_areas(mesh, source.pattern.placement)
            less = 2 * seen < area
            row[less] = 512 * seen[less] // area[less]
    return visibility


def _visible_weights(weights, visibility):
    """Weights at the vertices of the head, after sources that hardly show a vertex have given up theirs."""
    shown = weights * visibility
    total = shown.sum(axis=0)
    changed = complete((shown * ONE + total // 2) // np.maximum(total, 1), ONE)
    return np.where(total > 0, changed, weights)
