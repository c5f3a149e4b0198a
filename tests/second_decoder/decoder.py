"""From the bytes of a stream to its pictures; errors, position, loss, returning (SPEC 6.1, 6.2, 6.6, 7)."""

from .byte_reader import ByteReader
from .errors import StreamError, invalid, too_large, truncated, unsupported
from .head_parts import HeadParts
from .integers import clamp
from .limits import KEPT_SCENES, MAX_DURATION, MAX_HELD_PICTURES, MAX_STREAM_PICTURES
from .packets import END, HEAD_PART, RETURN, SCENE_PACKETS, SETUP, Damage, packets
from .scene import Scene
from .setup import KEEP_AND_PRESENT, KEEP_NONE, read_return, read_setup


class Decoder:
    """Decodes one stream. After pictures() has ended, `errors` has what was wrong, in order."""

    def __init__(self):
        self.errors = []
        self._scene = None
        self._aside = []  # scenes to which the stream may return, the last one last
        self._earlier_losses = False  # in a scene before, since the last that kept none
        self._size = None  # width and height of all scenes
        self._is_lost = False  # everything up to the next setup packet or return packet
        self._position = None  # pictures that have been shown, those before the place of joining included
        self._time = 0  # sum of their durations, 1/90000 s
        self._guesses = False  # durations of lost pictures, since the last position
        self._last = None  # the last picture shown
        self._held = 0  # times that it has been shown in the place of others
        self._head_parts = HeadParts()
        self._passed = 0, 0  # pictures of the scene before it was joined, and their time
        self._held_duration = 0  # nominal duration in its scene, or while there is none in the last scene

    @property
    def setup(self):
        """That of the scene which is being decoded."""
        return self._scene.setup

    def pictures(self, data):
        """Yields each picture: planes Y, U, V, and duration in 1/90000 s."""
        source = packets(data)
        for packet in source:
            try:
                if isinstance(packet, Damage):
                    raise packet.error
                if packet.type == HEAD_PART and not packet.in_parts:
                    self._take_part(packet.payload, source)
                yield from self._take(packet)
            except StreamError as error:
                self.errors.append(error)
                if packet.type not in (END, HEAD_PART):
                    self._lose(packet.type)
        if not self._scene and not self.errors:
            self.errors.append(truncated("the stream ends before its first scene"))

    def _lose(self, kind):
        """Notes a loss; without its first pattern, or the packet that begins it, nothing of a scene is of use."""
        self._guesses = True
        if kind in (SETUP, RETURN):
            self._scene = None
        if self._scene:
            self._scene.has_losses = True
        self._is_lost |= not self._scene or not self._scene.is_complete

    def _has_losses(self):
        """Whether an error has told of a loss in the scene."""
        return self._is_lost or bool(self._scene) and self._scene.has_losses

    def _present(self):
        """The scene, if its first pattern has been read and it is not lost."""
        return self._scene if self._scene and self._scene.is_complete and not self._is_lost else None

    def _set_aside(self):
        if self._present():
            self._aside = [*self._aside, self._scene][-KEPT_SCENES:]

    def _take(self, packet):
        if packet.type == SETUP:
            yield from self._take_setup(packet.payload, self._passed if packet.in_parts else (0, 0))
        elif packet.type == RETURN:
            yield from self._take_return(packet.payload)
        elif packet.type == END:
            yield from self._take_end(packet.payload)
        elif packet.type in SCENE_PACKETS and not self._is_lost:
            if not self._scene:
                raise invalid("a packet before the first setup packet")
            for picture, duration in self._scene.take(packet):
                self._show(picture, duration)
                self._held = 0
                self._held_duration = self._scene.setup.nominal_duration()
                yield picture, duration

    def _take_part(self, payload, source):
        """A part of a head. If that is whole, its packets are the next."""
        present = self._present()
        head = self._head_parts.take(payload, present.check & 0xFFFF if present else None)
        if head:
            packets_of_head, self._passed = head
            source.send(packets_of_head)

    def _show(self, picture, duration):
        self._last = picture
        self._position += 1
        self._time += duration

    def _take_setup(self, payload, passed):
        kept, self._aside = self._aside, []
        setup = read_setup(payload)
        knows = not self._scene or self._has_losses()
        self._earlier_losses = setup.keeps != KEEP_NONE and (self._earlier_losses or knows)
        if setup.keeps != KEEP_NONE:
            self._aside = kept
        if setup.keeps == KEEP_AND_PRESENT:
            self._set_aside()
        size = setup.width, setup.height
        if self._size and size != self._size:
            raise unsupported("another picture size in a later scene")
        position, time = setup.pictures_before + passed[0], setup.time_before + passed[1]
        if self._position is None:
            self._position, self._time = position, time
        yield from self._fill_up_to(position, time)
        if self._last is None:
            self._held_duration = setup.nominal_duration()
        self._size = size
        self._is_lost = False
        self._scene = Scene(setup, passed)

    def _take_return(self, payload):
        check, (position, time), passed, aside = read_return(payload)
        present = self._present()
        scene = next((s for s in [present, *reversed(self._aside)] if s and s.check == check), None)
        knows = self._earlier_losses or self._has_losses()
        if scene is not present:
            self._aside = [s for s in self._aside if s is not scene]
            if aside:
                self._set_aside()
        if not scene:
            self._scene, self._is_lost = None, True
            if not knows:
                raise invalid("there is no such scene to return to")
            return
        yield from self._fill_up_to(position, time)
        if scene is not present:
            self._earlier_losses = knows
            scene.has_losses |= knows
        scene.first_shown = max(scene.first_shown, passed)
        self._scene, self._is_lost = scene, False

    def _take_end(self, payload):
        pictures = ByteReader(payload).varint()
        if pictures > MAX_STREAM_PICTURES:
            raise too_large("too many pictures in a stream")
        if self._position is not None:
            missing = pictures - self._position
            yield from self._fill_up_to(pictures, self._time + missing * self._held_duration)

    def _fill_up_to(self, position, time):
        """Holds the last picture in the place of missing ones before a position."""
        missing = position - self._position
        left = time - self._time
        fits = missing <= left <= missing * MAX_DURATION
        if missing < 0 or not (fits or self._guesses):
            raise invalid("a position contradicts the pictures that were shown")
        self._guesses = False
        too_many = self._last is not None and self._held + missing > MAX_HELD_PICTURES
        if too_many:
            self.errors.append(too_large("too many pictures are missing to be held"))
        elif missing and not self._has_losses():
            self.errors.append(invalid("pictures are missing"))
        if too_many or not fits or self._last is None:
            self._position, self._time = position, time
            return
        for r in range(missing, 0, -1):
            duration = clamp(self._held_duration, max(1, time - self._time - (r - 1) * MAX_DURATION),
                             time - self._time - (r - 1))
            self._held += 1
            self._show(self._last, duration)
            yield self._last, duration
