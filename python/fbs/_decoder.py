"""The decoder."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from fbs import _fbs
from fbs._face import FaceState, States, states_of
from fbs._picture import MATRICES, TICKS_PER_SECOND, Format, Picture, PictureInfo, PictureLike, require_writable
from fbs._source import Buffer, ByteSource, Source
from fbs.errors import ArgumentError, DamagedError, Error, NoMemoryError, NotFbsError

if TYPE_CHECKING:
    from types import TracebackType

    from numpy.typing import NDArray

    Floats = NDArray[np.float32]

_OK, _NEED_DATA, _END = 0, 1, 2
_QUALITIES = ("exact", "pattern missing", "interpolated", "held")  # by fbs_quality
_MOST_MISSING = 1024
_LAST_TIME = (1 << 64) - 1


class Scene(NamedTuple):
    """Where decoding can begin: `offset` in bytes, `number` and `time` (s) of its first picture."""

    offset: int
    number: int
    time: float


class Decoder:
    """Decodes a stream, picture by picture.

    A decoder is an iterator over its pictures. Each owns its memory and does not change. Several threads may share
    one: each picture is given to one of them.

    Parameters
    ----------
    source : path, bytes, or binary file, optional
        A path or bytes: the whole stream, in which :meth:`seek` and :attr:`states` work; the path may name a
        Matroska file with a stream. A file, or any object with a method ``read``, is read as pictures are requested.
        Without: the stream comes through :meth:`feed`.
    threads : int, optional
        Threads that draw pictures side by side, up to 64; the pictures are the same. 0: one per core; by default up to
        16 of them.
    max_pixels : int, optional
        Streams with more pixels per picture are refused before allocating memory. 0: the format's limit, 8192 by 8192.
    keep_going : bool
        Continue after damage, and collect it in :attr:`errors`. Otherwise it is raised; requesting the next
        picture then continues.

    Attributes
    ----------
    errors : list of Error
        With `keep_going`: the damage to the stream so far.

    Examples
    --------
    >>> with fbs.Decoder("talk.fbs") as decoder:
    ...     print(decoder.format.width, decoder.format.height, decoder.format.fps)
    ...     brightness = [picture.y.mean() for picture in decoder]
    176 144 30
    >>> len(brightness)
    20

    From a network, as bytes arrive:

    >>> decoder = fbs.Decoder()
    >>> shown = 0
    >>> for piece in (stream[:300], stream[300:]):
    ...     decoder.feed(piece)
    ...     for picture in decoder:
    ...         shown += 1
    >>> decoder.finish()
    >>> shown + len(list(decoder))
    20
    """

    def __init__(
        self,
        source: Source | None = None,
        *,
        threads: int | None = None,
        max_pixels: int = 0,
        keep_going: bool = False,
    ) -> None:
        if threads is None:
            threads = min(16, len(os.sched_getaffinity(0)))
        if not 0 <= threads <= 64:
            raise ArgumentError(f"threads is 0 to 64, not {threads}")
        if max_pixels < 0:
            raise ArgumentError(f"max_pixels is not negative, as {max_pixels} is")
        self.errors: list[Error] = []
        self._lock = threading.RLock()
        self._max_pixels = max_pixels
        self._keep_going = keep_going
        self._decoder = _fbs.Decoder(threads, max_pixels)
        self._source = ByteSource(source)
        self._info: PictureInfo | None = None
        self._format: Format | None = None
        self._waiting: PictureInfo | Error | None = None  # found, and not given out yet
        self._scenes: list[Scene] | None = None
        if self._source.is_whole:
            try:
                self._look_ahead()
            except Error as problem:
                if self._source.name is None:
                    raise
                raise type(problem)(f"{self._source.name}: {problem}", problem.offset) from None

    # ---- opening and closing ----

    def close(self) -> None:
        """Free the decoder's memory. Pictures it returned stay valid."""
        self._decoder.close()

    def __enter__(self) -> Decoder:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    # ---- bytes in ----

    def feed(self, piece: Buffer) -> None:
        """Copy the next bytes of the stream, in pieces of any size.

        For decoders without a source. Iterate over the pictures in between: bytes not yet decoded are kept.
        """
        self._require_fed()
        self._decoder.feed(piece)

    def feed_packet(self, number: int, packet: Buffer) -> None:
        """Copy what one packet of a link brings, in place of :meth:`feed`: a packet of :class:`Encoder`, or several.

        Packets may be missing, come twice or in another order. One that is missing is waited for until one comes
        that is more than eight numbers above it, or until :meth:`skip_missing`, :meth:`packets_lost` or
        :meth:`finish`. If it comes later, pictures that have been returned stay as they were; those behind it are as
        if it had come in order.

        Parameters
        ----------
        number : int
            One more for each packet that is sent, 0 or 1 for the first of the stream. A viewer who joins later
            begins with any number above eight.
        """
        self._require_fed()
        self._decoder.feed_packet(number, packet)

    @property
    def missing(self) -> list[int]:
        """Numbers of the packets that are missing and still of use, to be asked for, the lowest first."""
        return self._decoder.missing(_MOST_MISSING)

    def packets_lost(self, before: int) -> None:
        """Missing packets with numbers below `before` will not come."""
        self._decoder.packets_lost(before)

    def skip_missing(self) -> bool:
        """Go on with the next packet that has come, without the missing ones before it: a picture is due.

        Returns
        -------
        bool
            Whether there is one.
        """
        return self._decoder.skip_missing()

    @property
    def needs_scene(self) -> bool:
        """Whether what follows cannot be decoded until a scene begins: :meth:`Encoder.request_scene` would help."""
        return self._decoder.needs_scene()

    def finish(self) -> None:
        """End the stream."""
        self._decoder.finish()

    def _require_fed(self) -> None:
        if not self._source.is_fed:
            raise ArgumentError("this decoder reads its source by itself")

    def _feed_more(self) -> bool:
        """Feed a piece of the source, or its end. False where there is no source."""
        if self._source.is_fed:
            return False
        piece = self._source.piece()
        if len(piece) > 0:
            self._decoder.feed(piece)
        else:
            self._decoder.finish()
        return True

    # ---- pictures out ----

    def advance(self) -> PictureInfo | None:
        """Advance to the next picture, without drawing it.

        Returns
        -------
        PictureInfo or None
            None at the end, and when more bytes must be fed first.

        Raises
        ------
        DamagedError, TruncatedError, ...
            Reported once, unless `keep_going`: the next call continues after the damage, at the next scene.
        """
        with self._lock:
            waiting, self._waiting = self._waiting, None
            if isinstance(waiting, Error):
                raise waiting
            return self._next_info() if waiting is None else waiting

    def _next_info(self) -> PictureInfo | None:
        while True:
            try:
                status, number, ticks, duration, held, new_scene, quality = self._decoder.next()
            except Error as problem:
                if not self._keep_going or isinstance(problem, (ArgumentError, NoMemoryError, NotFbsError)):
                    raise
                self.errors.append(problem)
                continue
            if status == _OK:
                self._info = PictureInfo(
                    number,
                    ticks / TICKS_PER_SECOND,
                    duration / TICKS_PER_SECOND,
                    held,
                    new_scene,
                    _QUALITIES[quality],
                )
                return self._info
            if status == _END or not self._feed_more():
                return None

    def draw(self, out: PictureLike | None = None) -> Picture:
        """Draw the picture that :meth:`advance` announced last.

        Parameters
        ----------
        out : Picture or three planes, optional
            Target: uint8 arrays of the picture's size, with contiguous rows.

        Returns
        -------
        Picture
            `out`, if given; otherwise a new one.
        """
        picture = self._target(out)
        self._decoder.draw(*picture.planes)
        return picture

    def edited(
        self,
        *,
        pitch: float = 0,
        yaw: float = 0,
        roll: float = 0,
        brows: float = 0,
        mouth: float = 0,
        smile: float = 0,
        lids: float = 0,
    ) -> FaceState | None:
        """The face in the current picture with changes, for :meth:`render`.

        Lips and lids never cross. Changes beyond their limits count as the limits.

        Parameters
        ----------
        pitch, yaw, roll : float
            Degrees to add, up to 12, 18 and 15 either way.
        brows : float
            -1: lowered, 1: raised, as far as looks right.
        mouth : float
            -1: shut, 1: opened wide.
        smile : float
            -1: corners down and in, 1: up and out.
        lids : float
            -1: opened wider, 1: shut.

        Returns
        -------
        FaceState or None
            None if the picture has no face.
        """
        found = self._decoder.edited_state((pitch, yaw, roll, brows, mouth, smile, lids))
        return None if found is None else FaceState(*found)

    def render(self, state: FaceState, out: PictureLike | None = None) -> Picture:
        """Draw the current picture with another state of the face.

        Parameters
        ----------
        state : FaceState
            Rotations within 90 degrees, control points within 2 eye distances.
        out : Picture or three planes, optional
            As for :meth:`draw`.

        Returns
        -------
        Picture
            `out`, if given. With :attr:`state` it is the picture as sent.

        Raises
        ------
        NoFaceError
            The picture has no face.

        Examples
        --------
        >>> decoder = fbs.Decoder("talk.fbs")
        >>> as_sent = next(decoder)
        >>> turned = decoder.render(decoder.edited(yaw=10, mouth=0.5))
        >>> turned.y.shape == as_sent.y.shape, np.array_equal(turned.y, as_sent.y)
        (True, False)
        """
        picture = self._target(out)
        pose = (state.pitch, state.yaw, state.roll, state.x, state.y, state.eye_distance)
        control = np.ascontiguousarray(state.control_points, np.float32)
        if control.shape != (36, 2):
            raise ArgumentError(f"control points are a (36, 2) array, not {control.shape}")
        self._decoder.draw_state(pose, control, *picture.planes)
        return picture

    def __iter__(self) -> Iterator[Picture]:
        return self

    def __next__(self) -> Picture:
        with self._lock:
            if self.advance() is None:
                raise StopIteration
            return self.draw()

    def _target(self, out: PictureLike | None) -> Picture:
        """`out`, or a new picture, with the place of the current one."""
        if self._info is None:
            raise ArgumentError("there is no picture yet")
        format = self.format
        if out is None:
            picture = Picture.empty(format.width, format.height)
        else:
            picture = out if isinstance(out, Picture) else Picture(*out)
            for plane in picture.planes:
                require_writable(plane, 2)
        picture.matrix, picture.full_range = format.matrix, format.full_range
        for name, value in self._info._asdict().items():
            setattr(picture, name, value)
        return picture

    def _look_ahead(self) -> None:
        """Find the first picture, so that anything but a stream is refused at once."""
        try:
            self._waiting = self.advance()
        except Error as problem:
            if self._decoder.format() is None:
                raise
            self._waiting = problem

    # ---- what is known ----

    @property
    def format(self) -> Format:
        """Size, rate and colours of all pictures.

        Raises
        ------
        ArgumentError
            Not known yet: more bytes must be fed.
        """
        if self._format is None:
            found = self._decoder.format()
            if found is None and self._waiting is None and self._info is None:
                self._look_ahead()
                found = self._decoder.format()
            if found is None:
                raise ArgumentError("the format is not known yet")
            width, height, rate_num, rate_den, aspect_num, aspect_den, matrix, full_range = found
            aspect = Fraction(aspect_num, aspect_den) if aspect_num and aspect_den else None
            self._format = Format(
                width, height, Fraction(rate_num, rate_den), aspect, MATRICES[matrix], full_range
            )
        return self._format

    @property
    def info(self) -> PictureInfo | None:
        """The place of the current picture; None before the first."""
        return self._info

    @property
    def state(self) -> FaceState | None:
        """The face in the current picture; None if it has none. Needs no drawing."""
        found = self._decoder.state()
        return None if found is None else FaceState(*found)

    @property
    def landmarks(self) -> Floats | None:
        """(68, 2) float32 array: the 68 points of iBUG in the current picture, pixels; None if it has no face."""
        found = self._decoder.landmarks()
        return None if found is None else found[:, :2]

    @property
    def confidence(self) -> Floats | None:
        """(68,) float32 array: confidence of each landmark, 0 to 1; None if the current picture has no face."""
        found = self._decoder.landmarks()
        return None if found is None else found[:, 2]

    @property
    def blendshapes(self) -> Floats | None:
        """(32,) float32 array: weights of the movements in :data:`fbs.BLENDSHAPES`; None if there is no face."""
        found: Floats | None = self._decoder.blendshapes()
        return found

    @property
    def vertices(self) -> Floats | None:
        """(n, 3) float32 array: the wire-frame in the current picture; None if it has no face.

        x and y are pixels; z is eye distances away from the viewer, from the middle of the head.
        """
        found: Floats | None = self._decoder.vertices()
        return found

    # ---- the whole stream ----

    @property
    def states(self) -> States:
        """The faces of all pictures of the stream, without drawing them. Leaves the current picture as it is.

        Examples
        --------
        >>> states = fbs.Decoder("talk.fbs").states
        >>> states.landmarks.shape, states.pose.shape
        ((20, 68, 2), (20, 3))
        """
        columns: dict[str, Any] = _fbs.read_states(
            self._source.whole("states"), self._max_pixels, self._keep_going
        )
        return states_of(columns, TICKS_PER_SECOND)

    @property
    def scenes(self) -> list[Scene]:
        """Where decoding can begin, in order."""
        if self._scenes is None:
            stream = self._source.whole("scenes")
            found: list[Scene] = []
            ticks = _LAST_TIME
            while (scene := _fbs.find_scene(stream, ticks)) is not None:
                offset, number, ticks = scene
                if found and found[-1].offset == offset:  # the first is given for any time before it, too
                    break
                found.append(Scene(offset, number, ticks / TICKS_PER_SECOND))
                if ticks == 0:
                    break
                ticks -= 1
            self._scenes = found[::-1]
        return self._scenes

    def seek(self, time: float | None = None, *, number: int | None = None) -> None:
        """Make another picture the next one.

        Parameters
        ----------
        time : float
            Seconds: the picture that is shown then.
        number : int
            Instead: the picture of this number, or the next one that is not lost.

        Raises
        ------
        DamagedError, TruncatedError, ...
            Between the beginning of its scene and the picture, unless `keep_going`.

        Examples
        --------
        >>> decoder = fbs.Decoder("talk.fbs")
        >>> decoder.seek(0.5)
        >>> next(decoder).number
        15
        >>> decoder.seek(number=3)
        >>> next(decoder).number
        3
        """
        self._source.whole("seek")
        if (time is None) == (number is None):
            raise ArgumentError("seek to a time or to a number")
        place = time if time is not None else number
        if place is None or not place >= 0:
            raise ArgumentError(f"a place in a stream is not negative, as {place} is")

        def begins_by_then(scene: Scene) -> bool:
            return scene.number <= place if time is None else scene.time <= place

        def is_there(info: PictureInfo) -> bool:
            return info.number >= place if time is None else info.time + info.duration > place

        before = [scene for scene in self.scenes if begins_by_then(scene)] or self.scenes[:1]
        if not before:
            raise DamagedError("there is no scene in the stream")
        with self._lock:
            self._decoder.reset()
            self._waiting = self._info = None
            self._source.go_to(before[-1].offset)
            while (info := self.advance()) is not None:
                if is_there(info):
                    self._waiting = info
                    return
