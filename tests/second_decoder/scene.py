"""A scene: what its packets say, and its pictures (SPEC 6, 6.2)."""

from dataclasses import dataclass

import numpy as np

from .atlas import Atlas
from .av1 import Av1Decoder
from .byte_reader import ByteReader
from .blend import REGIONS, BlendDecoder
from .draw import draw, draw_without_geometry, with_full_contrast
from .errors import StreamError, invalid
from .geometry import read_geometry
from .head import HEAD
from .limits import KEPT_PICTURES, MAX_PICTURE_NUMBER, MAX_WAITING_PICTURES
from .mesh import Mesh, Placement
from .motion import MotionDecoder
from .packets import BLEND, GEOMETRY, MOTION, PATTERN, SURROUND, UNIT, WIRE_FRAME
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
    """Takes the packets of a scene after its setup packet.

    passed  pictures that it has before it is joined, and their time
    """

    def __init__(self, setup, passed=(0, 0)):
        self.setup = setup
        self.check = None  # of the first pattern packet
        self.first_shown = 0  # pictures before are passed
        self._begin, self._passed_time = passed
        self.has_losses = self._begin > 0  # an error has told of something that is missing
        self._layout = Layout(setup)
        self._next_frame = HEAD  # of the geometry packets to come
        self._frame = None  # of the geometry
        self._adapted = None  # vertices of the adapted head
        self._surround = Surround.without_packet()
        self._mesh = None
        self._rest = None  # state of the first pattern, which completes the scene
        self._store = {}  # patterns by slot
        self._stored_numbers = {}  # by slot, of the last pattern other than the first
        self._states = [None] * self._begin  # of all pictures, with their durations
        self._missing = set()  # numbers of pictures whose states are interpolated
        self._modes = [(0,) * REGIONS] * self._begin  # of all pictures that have any
        self._released = self._begin
        self._av1 = Av1Decoder()
        self._first_frame = None
        self._patterns = PatternDecoder(setup, self._layout)
        self._motion = None
        self._blend = BlendDecoder(self._begin)
        self._takers = {WIRE_FRAME: self._take_wire_frame, GEOMETRY: self._take_geometry,
                        SURROUND: self._take_surround, PATTERN: self._take_pattern, MOTION: self._take_motion,
                        BLEND: self._take_blend, UNIT: self._take_unit}

    @property
    def is_complete(self):
        """Whether the first pattern has been read."""
        return bool(self._store)

    def take(self, packet):
        """Yields the pictures that a packet releases: planes Y, U, V, and duration in 1/90000 s."""
        if packet.type == PATTERN and not self.is_complete:
            self.check = packet.check
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
        patterns = self._patterns.decode(payload, len(self._states))
        self._skip_unless(patterns, self._patterns.is_broken)
        for coded in patterns:
            if coded.alone and coded.number <= self._stored_numbers.get(coded.slot, 0):
                return
            if not coded.numbers and not self._has_state(coded.number):
                knows = self.has_losses
                self._break_chain(coded)
                if knows:
                    return
                raise invalid("a pattern of a picture that has no state or is not kept")
            self._put(coded)

    def _has_state(self, number):
        """Whether a picture has a state that was sent and is kept."""
        return (max(self._begin, self._released - KEPT_PICTURES) <= number < len(self._states)
                and number not in self._missing)

    def _break_chain(self, coded):
        if not coded.alone:
            self._patterns.break_chain()

    def _put(self, coded):
        """Puts a pattern into the store."""
        if not coded.numbers:
            self._stored_numbers[coded.slot] = coded.number
        try:
            frame = self._full_size(self._decode_frame(coded))
        except StreamError:
            self._break_chain(coded)
            raise
        if coded.numbers:
            self._complete(coded.numbers)
        self._store[coded.slot] = self._build_pattern(coded, frame)

    def _decode_frame(self, coded):
        """The planes of a pattern's frame. One that is alone follows the first frame."""
        if coded.numbers:
            self._first_frame = coded.frame
        if not coded.alone:
            return self._av1.decode(coded.frame)
        av1 = Av1Decoder()
        av1.decode(self._first_frame)
        return av1.decode(coded.frame)

    def _complete(self, rest_numbers):
        """The first pattern is here."""
        self._rest = self._layout.values(rest_numbers)
        self._motion = MotionDecoder(self.setup, self._layout, rest_numbers, self._begin, self._passed_time)
        if self._begin:
            self._patterns.break_chain()  # those before the joining are missing
        if self._adapted is not None:
            self._build_mesh()

    def _build_pattern(self, coded, frame):
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

    def _skip_unless(self, read, needs_missing):
        """A packet that is skipped since it needs a missing one is a loss if none is known."""
        if not read and needs_missing and not self.has_losses:
            raise invalid("a packet is missing")

    def _take_motion(self, payload):
        yield from self._add_motion(payload)

    def _take_unit(self, payload):
        if self.setup.patterns == 1:
            raise invalid("a unit with one slot")
        reader = ByteReader(payload)
        motion = reader.bytes(reader.varint())
        knows = self.has_losses
        group = self._read_motion(motion)
        if not group:
            return
        blend = self._blend.decode_in_unit(payload[reader.position:], group.beginning,
                                           len(self._states) + MAX_WAITING_PICTURES)
        if blend:
            yield from self._add_modes(blend)
        if group.missing and not knows:
            raise invalid("pictures are missing")
        if blend and blend[0] and not knows:
            raise invalid("modes are missing")

    def _add_motion(self, payload):
        knows = self.has_losses
        group = self._read_motion(payload)
        yield from self._release()
        if group and group.missing and not knows:
            raise invalid("pictures are missing")

    def _read_motion(self, payload):
        """Adds the states of a group, which is returned; None if it is skipped."""
        if not self._motion:
            raise invalid("motion before the first pattern")
        begin = len(self._states)
        most = min(MAX_WAITING_PICTURES - (begin - self._released), MAX_PICTURE_NUMBER - begin)
        group = self._motion.decode(payload, most)
        self._skip_unless(group, self._motion.needs_key)
        if not group:
            return None
        self._states += group.pictures
        self._missing.update(range(begin, begin + group.uncertain))
        if self.setup.patterns == 1:
            self._modes += [(0,) * REGIONS] * len(group.pictures)
        return group

    def _take_blend(self, payload):
        if not self._motion or self.setup.patterns == 1:
            raise invalid("a blend packet before the first pattern, or with one slot")
        group = self._blend.decode(payload, len(self._states) + MAX_WAITING_PICTURES)
        self._skip_unless(group, self._blend.needs_key)
        if not group:
            return
        knows = self.has_losses
        yield from self._add_modes(group)
        if group[0] and not knows:
            raise invalid("modes are missing")

    def _add_modes(self, group):
        missing, modes = group
        self._modes += (self._modes[-1:] or [(0,) * REGIONS]) * missing + modes
        yield from self._release()

    def _release(self):
        """Yields the pictures that have a state and modes, and have not been shown."""
        while self._released < min(len(self._states), len(self._modes)):
            values, duration = self._states[self._released]
            if self._released < self.first_shown:
                self._released += 1
                continue
            picture = self._draw(State(values), self._released, self._modes[self._released])
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
