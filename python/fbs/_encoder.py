"""The encoder."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple, Union

from fbs import _fbs
from fbs._picture import MATRICES, TICKS_PER_SECOND, Format, PictureLike, planes_of
from fbs.errors import ArgumentError

if TYPE_CHECKING:
    from types import TracebackType

    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float32]

Rate = Union[int, float, Fraction]

_SIDES = range(64, 8193)
_TUNES = ("eye", "psnr")
_RESILIENCES = ("none", "packet", "strong")
_MAX_DURATION = 60.0  # s
_MAX_TIME = 2e13  # s
_MAX_TIMEOUT = 1e6  # s


class Packet(bytes):
    """A piece of a stream, which is all its packets in sequence.

    Attributes
    ----------
    key : bool
        Decoding can begin here.
    number : int
        Of the first picture that needs it; in the last packet: number of pictures.
    time : float
        Of that picture, s; in the last packet: the length of the video.
    pushed_time : float or None
        The `time` that picture was pushed with, s.
    """

    key: bool
    number: int
    time: float
    pushed_time: float | None


class Report(NamedTuple):
    """Statistics so far: `pictures` pushed, those `without_face`, `cuts`, and `scenes` begun."""

    pictures: int
    without_face: int
    cuts: int
    scenes: int


class Encoder:
    """Encodes pictures as they come.

    Without `live` the encoder looks ahead: packets come in bursts, up to forty seconds of video later.
    :func:`fbs.encode` writes files, and takes the sound along.

    Parameters
    ----------
    width, height : int
        Pixels, 64 to 8192.
    fps : int, float or Fraction
        Nominal pictures per second. 29.97 and its like are taken as 30000/1001.
    quality : int
        0 (fewest bytes) to 100 (best pictures).
    bitrate : float, optional
        kbit/s in total, which determines quality.
    seconds : float, optional
        Length of the video, if known; for `bitrate`.
    effort : int
        0 to 9. More takes longer and saves bits.
    tune : {"eye", "psnr"}
        What bytes are spent for: mouth and eyes that look right, or the PSNR of the whole frame. No effect with `live`.
    patterns : int
        Pictures of the person in a scene, 1 to 64; 0: chosen by the encoder.
    face : int
        Which face to follow, 0 being the largest.
    allow_no_face : bool
        Also encode a video without any face.
    key_interval : float
        Longest time between scenes, where viewers can join, s. 0: up to 40.
    live : bool
        No look-ahead.
    live_delay : float
        Seconds of pictures that are encoded together. More take fewer bytes.
    live_buffer : float
        With `bitrate`: longest time that data waits to be sent, s.
    resilience : {"none", "packet", "strong"}
        Live, for links that lose packets. packet: motion goes on without them, and patterns wait until they are sent
        again. strong: patterns go on, too.
    join : float
        Live: a viewer who comes in the middle of a scene can join it within so many seconds, at the cost of parts of
        its head all along. 0: only where a scene begins.
    start : float, optional
        With `bitrate`, seconds of it: the first picture is there after so long, coarse if need be, and a finer one
        follows. 0: as fine as the rate as a whole allows. None: 1 live without `join` and strong resilience, with
        which it must be 0, otherwise 0.
    threads : int
        Threads that encode; the stream is the same for any number. 0: as many as there are cores.
    matrix : {"bt601", "bt709", "unspecified"}
        Of YCbCr: for RGB pictures the target of conversion, for planes their own.
    full_range : bool
        Whether black is 0 and white 255.
    pixel_aspect : Fraction, optional
        Width of a pixel over its height; None: unknown.

    Examples
    --------
    >>> encoder = fbs.Encoder(64, 64, fps=25, allow_no_face=True)
    >>> packets = []
    >>> for level in range(5):
    ...     packets += encoder.push(np.full((64, 64, 3), 20 * level, np.uint8))
    >>> packets += encoder.finish()
    >>> len(list(fbs.Decoder(b"".join(packets))))
    5
    """

    def __init__(
        self,
        width: int,
        height: int,
        *,
        fps: Rate = 25,
        quality: int = 50,
        bitrate: float | None = None,
        seconds: float | None = None,
        effort: int = 5,
        tune: str = "eye",
        patterns: int = 0,
        face: int = 0,
        allow_no_face: bool = False,
        key_interval: float = 0,
        live: bool = False,
        live_delay: float = 0.2,
        live_buffer: float = 2,
        resilience: str = "none",
        join: float = 0,
        start: float | None = None,
        threads: int = 0,
        matrix: str = "bt601",
        full_range: bool = False,
        pixel_aspect: Fraction | None = Fraction(1),
    ) -> None:
        rate = rate_of(fps)
        _require("width", width in _SIDES, width, "64 to 8192")
        _require("height", height in _SIDES, height, "64 to 8192")
        _require("quality", 0 <= quality <= 100, quality, "0 to 100")
        _require("bitrate", bitrate is None or bitrate > 0, bitrate, "positive")
        _require("seconds", seconds is None or seconds > 0, seconds, "positive")
        _require("effort", effort in range(10), effort, "0 to 9")
        _require("tune", tune in _TUNES, tune, "one of " + ", ".join(_TUNES))
        _require("resilience", resilience in _RESILIENCES, resilience, "one of " + ", ".join(_RESILIENCES))
        _require("patterns", 0 <= patterns <= 64, patterns, "1 to 64, or 0")
        _require("face", face >= 0, face, "not negative")
        _require("matrix", matrix in MATRICES, matrix, "one of " + ", ".join(MATRICES))
        _require("start", not start or (start > 0 and bitrate is not None), start, "0, or positive with a bitrate")
        times = {"key_interval": key_interval, "live_delay": live_delay, "live_buffer": live_buffer, "join": join}
        for name, value in times.items():
            _require(name, value >= 0, value, "not negative")
        self._format = Format(width, height, rate, pixel_aspect, matrix, full_range)
        self._encoder = _fbs.Encoder(
            {
                "width": width,
                "height": height,
                "rate_num": rate.numerator,
                "rate_den": rate.denominator,
                "aspect_num": 0 if pixel_aspect is None else pixel_aspect.numerator,
                "aspect_den": 1 if pixel_aspect is None else pixel_aspect.denominator,
                "matrix": MATRICES.index(matrix),
                "full_range": int(full_range),
                "quality": quality,
                "bitrate": float(bitrate or 0),
                "seconds": float(seconds or 0),
                "effort": effort,
                "tune": _TUNES.index(tune),
                "patterns": patterns,
                "face": face,
                "allow_no_face": int(allow_no_face),
                "key_interval": float(key_interval),
                "live": int(live),
                "live_delay": float(live_delay),
                "live_buffer": float(live_buffer),
                "resilience": _RESILIENCES.index(resilience),
                "join": float(join),
                "start": -1.0 if start is None else float(start),
                "threads": threads,
            }
        )

    def push(
        self, picture: PictureLike, duration: float | None = None, *, time: float | None = None
    ) -> list[Packet]:
        """Encode the next picture, which is copied.

        Parameters
        ----------
        picture : (h, w, 3) uint8 array, Picture, or three planes
            RGB, or Y, Cb and Cr of 8-bit 4:2:0.
        duration : float, optional
            Seconds, at most 60; until the next picture, or from `fps`, unless given.
        time : float, optional
            At which the picture begins, seconds of any clock, such as ``time.monotonic()``: for cameras. Times rise.
            In the stream the first is 0, and the first picture of a group can be off by as much as the camera is
            irregular.

        Returns
        -------
        list of Packet
            The packets that are ready: often none.

        Raises
        ------
        ArgumentError
            The picture has another size, its time is not later than the last one, or the encoding has ended;
            nothing is taken.
        Error
            Any other error ends the encoding.
        """
        ticks = 0
        if duration is not None:
            _require("duration", 0 < duration <= _MAX_DURATION, duration, "at most 60 s")
            ticks = max(1, round(duration * TICKS_PER_SECOND))
        clock = None
        if time is not None:
            _require("time", abs(time) <= _MAX_TIME, time, "finite, in seconds")
            clock = round(time * TICKS_PER_SECOND)
        self._encoder.push(*planes_of(picture, self._format), ticks, clock)
        return self.pull()

    def finish(self) -> list[Packet]:
        """End the video, and encode the pictures held back.

        Returns
        -------
        list of Packet
            The rest.

        Raises
        ------
        NoFaceError
            No picture showed a face.
        """
        self._encoder.finish()
        return self.pull()

    def pull(self, timeout: float = 0) -> list[Packet]:
        """Packets that have become ready since: with `live` and `threads` a little after a push.

        Parameters
        ----------
        timeout : float
            Seconds to wait for the first of them, if others are encoding.
        """
        _require("timeout", 0 <= timeout <= _MAX_TIMEOUT, timeout, "0 to 1000000 s")
        if timeout > 0:
            self._encoder.wait(round(timeout * 1000))
        packets = []
        while (found := self._encoder.pull()) is not None:
            data, key, number, ticks, clock = found
            packet = Packet(data)
            packet.key, packet.number, packet.time = key, number, ticks / TICKS_PER_SECOND
            packet.pushed_time = None if clock is None else clock / TICKS_PER_SECOND
            packets.append(packet)
        return packets

    def request_scene(self) -> None:
        """Begin a scene with the next picture that can begin one, for instance after a loss. Live only."""
        self._encoder.request_scene()

    def lose_patterns(self) -> None:
        """Tell that a viewer has lost a pattern of the scene for good: later ones need the head alone. Live only."""
        self._encoder.lose_patterns()

    def set_bitrate(self, kbps: float) -> None:
        """Hold what follows to another rate, as the link has it. Live, with a bitrate, only."""
        self._encoder.set_bitrate(kbps)

    @property
    def format(self) -> Format:
        """Size, rate and colours of all pictures."""
        return self._format

    @property
    def report(self) -> Report:
        """Statistics so far."""
        return Report(*self._encoder.report())

    @property
    def landmarks(self) -> Floats | None:
        """(68, 2) float32 array: the points of iBUG in the picture pushed last, pixels; None without a face.

        As tracked, without coding loss.
        """
        found = self._encoder.landmarks()
        return None if found is None else found[:, :2]

    def close(self) -> None:
        """Free the encoder. Packets not yet returned are lost."""
        self._encoder.close()

    def __enter__(self) -> Encoder:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def rate_of(fps: Rate) -> Fraction:
    """Pictures per second as the intended ratio."""
    if not 0 < fps <= 1000:
        raise ArgumentError(f"fps is more than 0 and at most 1000, not {fps}")
    if isinstance(fps, float):
        television = Fraction(round(fps) * 1000, 1001)
        if round(fps) > 0 and not fps.is_integer() and abs(float(television) - fps) < 0.005:
            return television
        return Fraction(fps).limit_denominator(1001)
    return Fraction(fps)


def _require(name: str, holds: bool, value: object, range: str) -> None:
    if not holds:
        raise ArgumentError(f"{name} is {range}, not {value!r}")
