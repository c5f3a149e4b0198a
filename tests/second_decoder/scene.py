"""A scene: what its packets say, and its pictures (SPEC 6)."""

from dataclasses import dataclass

import numpy as np

from .atlas import Atlas
from .av1 import Av1Decoder
from .blend import REGIONS, BlendDecoder
from .draw import draw, draw_without_geometry, with_full_contrast
from .errors import invalid, too_large
from .geometry import read_geometry
from .head import HEAD
from .limits import KEPT_PICTURES, MAX_PICTURE_NUMBER, MAX_WAITING_PICTURES
from .mesh import Mesh, Placement
from .motion import MotionDecoder
from .packets import BLEND, GEOMETRY, MOTION, PATTERN, SURROUND, WIRE_FRAME
from .pattern import PatternDecoder
from .raster import planes
from .samples import enlarge
from .state import Layout, State
from .surround import Surround, read_surround
from .weights import PictureWeights
from .wire_frame_packet import read_wire_frame


@dataclass
class Pattern:
    number: int  # of its picture
    state: State  # in which it is seen
    planes: list  # Y, U, V
    placement: Placement = None  # of the mesh in its state; None in a scene without geometry
    atlas: list = None  # planes Y, U, V of what it shows of the head, if the scene has a face


class Scene:
    """Takes the packets of a scene after its setup packet."""

    def __init__(self, setup):
        self.setup = setup
        self._layout = Layout(setup)
        self._next_frame = HEAD  # of the geometry packets to come
        self._frame = None  # of the geometry
        self._adapted = None  # vertices of the adapted head
        self._surround = Surround.without_packet()
        self._mesh = None
        self._rest = None  # state of the first pattern, which completes the scene
        self._store = {}  # patterns by slot
        self._states = []  # of all pictures, with their durations
        self._released = 0
        self._av1 = Av1Decoder()
        self._patterns = PatternDecoder(setup, self._layout)
        self._motion = None
        self._blend = BlendDecoder()
        self._takers = {WIRE_FRAME: self._take_wire_frame, GEOMETRY: self._take_geometry,
                        SURROUND: self._take_surround, PATTERN: self._take_pattern, MOTION: self._take_motion,
                        BLEND: self._take_blend}

    def take(self, packet):
        """Yields the pictures that a packet releases: planes Y, U, V, and duration in 1/90000 s."""
        taker = self._takers.get(packet.type)
        yield from (taker(packet.payload) if taker else None) or ()

    def _take_wire_frame(self, payload):
        self._next_frame = read_wire_frame(payload)

    def _take_geometry(self, payload):
        adapted = read_geometry(payload, self._next_frame)
        if self._rest is None:
            self._frame, self._adapted = self._next_frame, adapted

    def _take_surround(self, payload):
        self._surround = read_surround(payload)
        if self._mesh:
            self._build_mesh()

    def _build_mesh(self):
        self._mesh = Mesh(self.setup, self._surround, self._frame, self._adapted, self._rest)
        self._mesh.atlas = Atlas(self._frame, self._mesh.rest_scale)
        for pattern in self._store.values():
            self._place(pattern)

    def _place(self, pattern):
        """Finds where the mesh is in a pattern, and what it shows of the head."""
        mesh = self._mesh
        seen = pattern.placement = mesh.place(pattern.state)
        if not mesh.is_plane:
            head = slice(mesh.grid_points, None)
            pattern.atlas = mesh.atlas.of_pattern(pattern.planes, seen.x[head], seen.y[head], seen.offset[head],
                                                  seen.gain[head])

    def _take_pattern(self, payload):
        numbers = {slot: pattern.number for slot, pattern in self._store.items()}
        for coded in self._patterns.decode(payload, numbers, len(self._states)):
            if coded.numbers:
                self._complete(coded.numbers)
            self._check_order(coded)
            self._store[coded.slot] = self._decode_pattern(coded)

    def _complete(self, rest_numbers):
        """The first pattern is here."""
        self._rest = self._layout.values(rest_numbers)
        self._motion = MotionDecoder(self.setup, self._layout, rest_numbers)
        if self._adapted is not None:
            self._build_mesh()

    def _check_order(self, coded):
        if coded.slot > len(self._store):
            raise invalid("a pattern for a slot after an empty one")
        if coded.number < self._released - KEPT_PICTURES:
            raise invalid("a pattern of a picture that is not kept")

    def _decode_pattern(self, coded):
        frame = self._full_size(self._av1.decode(coded.frame))
        state = self._rest if coded.numbers else State(self._states[coded.number][0])
        if not self._mesh:
            return Pattern(coded.number, state, frame)
        if self.setup.contrast or self.setup.chroma_contrast:
            frame = with_full_contrast(self.setup, self._mesh, self._mesh.place(state), frame)
        pattern = Pattern(coded.number, state, frame)
        self._place(pattern)
        return pattern

    def _full_size(self, frame):
        """The planes of a frame, enlarged if it is reduced."""
        width, height = self.setup.width, self.setup.height
        shape = frame[0].shape
        if shape == (height, width):
            return frame
        if shape != ((height + 1) // 2, (width + 1) // 2):
            raise invalid("a pattern of a wrong size")
        return [enlarge(plane, form.width, form.height) for plane, form in zip(frame, planes(width, height))]

    def _take_motion(self, payload):
        if not self._motion:
            raise invalid("motion before the first pattern")
        self._states += self._motion.decode(payload)
        if len(self._states) > MAX_PICTURE_NUMBER:
            raise too_large("too many pictures in a scene")
        if self.setup.patterns == 1:
            return self._release([(0,) * REGIONS] * (len(self._states) - self._released))
        if len(self._states) - self._released > MAX_WAITING_PICTURES:
            raise too_large("too many pictures wait")

    def _take_blend(self, payload):
        if not self._motion or self.setup.patterns == 1:
            raise invalid("a blend packet before the first pattern, or with one slot")
        modes = self._blend.decode(payload)
        if len(modes) > len(self._states) - self._released:
            raise invalid("a blend packet is ahead of the motion")
        return self._release(modes)

    def _release(self, modes_of_pictures):
        for modes in modes_of_pictures:
            values, duration = self._states[self._released]
            picture = self._draw(State(values), self._released, modes)
            self._released += 1
            yield picture, duration

    def _draw(self, state, number, modes):
        store = [self._store[slot] for slot in sorted(self._store)]
        sources = PictureWeights(store, state, number).sources(modes)
        if self._mesh:
            picture = draw(self.setup, self._mesh, sources, state)
        else:
            picture = draw_without_geometry(self.setup, sources)
        return [plane.astype(np.uint8) for plane in picture]
