"""The numbers of a state, and how they are coded without a prediction (SPEC 5.1, 5.3, 8.2)."""

from dataclasses import dataclass

import numpy as np

from .errors import invalid
from .head import HEAD
from .integers import clamp, nearest
from .limits import MAX_COEFFICIENT, MAX_CONTROL, MAX_LIGHT, MAX_LOG_SCALE, MAX_ROTATION, MAX_TRANSLATION
from .range_decoder import Wide

NUMBERS = 96


@dataclass
class Part:
    first: int
    count: int
    step: str
    limit: int


# Part 0 is the pose, of three kinds of numbers; they are coded as one part.
_KINDS = (Part(0, 3, "rotation", MAX_ROTATION),
          Part(3, 2, "translation", MAX_TRANSLATION),
          Part(5, 1, "log scale", MAX_LOG_SCALE),
          Part(6, 7, "light", MAX_LIGHT),
          Part(13, 3, "light", MAX_LIGHT),
          Part(16, 4, "translation", MAX_TRANSLATION),
          Part(20, 4, "translation", MAX_TRANSLATION),
          Part(24, 36, "control", MAX_COEFFICIENT),
          Part(60, 16, "control", MAX_COEFFICIENT),
          Part(76, 8, "control", MAX_COEFFICIENT),
          Part(84, 8, "control", MAX_COEFFICIENT),
          Part(92, 4, "control", MAX_COEFFICIENT))
PARTS = [range(0, 6)] + [range(kind.first, kind.first + kind.count) for kind in _KINDS[3:]]
_LOG_SCALE = 5


class Layout:
    """Steps and limits of the numbers of a scene, and which are sent."""

    def __init__(self, setup):
        self.steps = [setup.steps[kind.step] for kind in _KINDS for _ in range(kind.count)]
        self._limits = [kind.limit // setup.steps[kind.step] for kind in _KINDS for _ in range(kind.count)]
        self.sent_parts = [p for p in range(len(PARTS)) if p == 0 or setup.parts >> (p - 1) & 1]

    def check(self, i, number):
        """Raises an error if number i of the state is beyond its limits."""
        low = 0 if i == _LOG_SCALE else -self._limits[i]
        if not low <= number <= self._limits[i]:
            raise invalid("a number of a state is beyond its limit")

    def values(self, numbers):
        return State([number * step for number, step in zip(numbers, self.steps)])


def read_whole_state(decoder, layout):
    """The numbers of a state, coded without reference to another."""
    whole = [Wide() for _ in range(4)]
    numbers = [0] * NUMBERS
    for p in layout.sent_parts:
        for i in PARTS[p]:
            kind = 0 if i < 3 else 1 if i < 5 else 2 if i == _LOG_SCALE else 3
            numbers[i] = decoder.wide(whole[kind])
            layout.check(i, numbers[i])
    return numbers


class State:
    """The values of a state, in the units of SPEC 8.2."""

    def __init__(self, values):
        self.pose = tuple(values[0:6])  # pitch, yaw, roll, tx, ty, log scale
        self.pitch, self.yaw, self.roll, self.tx, self.ty, self.log_scale = self.pose
        self.light = values[6:13]  # offset, gain, slope x, y, quadratic xx, yy, xy
        self.mouth_interior = values[13:16]  # upper, middle, lower
        self.body = values[16:20]  # displacement x, y, scale, rotation
        self.ground = values[20:24]
        self.controls = _control_offsets(values)  # (x, y) of each control point, head units


def _control_offsets(values):
    offsets = []
    for part, expression in zip(PARTS[5:], HEAD.expression):
        assert expression.first_control == len(offsets)
        sums = np.array([values[i] for i in part]) @ np.array(expression.rows)
        offsets += clamp(nearest(sums, 12), -MAX_CONTROL, MAX_CONTROL).reshape(-1, 2).tolist()
    return np.array(offsets)
