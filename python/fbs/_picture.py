"""Pictures in numpy's arrays."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple, Union

import numpy as np

from fbs import _fbs
from fbs.errors import ArgumentError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Plane = NDArray[np.uint8]

MATRICES = ("unspecified", "bt601", "bt709")
"""At the numbers of fbs_matrix."""

TICKS_PER_SECOND = 90000


@dataclass(frozen=True)
class Format:
    """Properties shared by all pictures of a stream.

    Attributes
    ----------
    width, height : int
        Pixels.
    fps : Fraction
        Nominal pictures per second; each picture has its own duration.
    pixel_aspect : Fraction or None
        Width of a pixel over its height; None when unknown.
    matrix : {"unspecified", "bt601", "bt709"}
        Of YCbCr. "unspecified" counts as BT.601.
    full_range : bool
        False: black is 16 and white 235. True: 0 and 255.
    """

    width: int
    height: int
    fps: Fraction
    pixel_aspect: Fraction | None
    matrix: str
    full_range: bool


class PictureInfo(NamedTuple):
    """A picture's place in its stream: `number` from 0, `time` and `duration` in seconds.

    `held`: the picture was lost, and the one before is shown in its place. `new_scene`: decoding can begin here.
    `quality`: what it has suffered from losses, "exact", "pattern missing", "interpolated" (its motion is) or "held".
    """

    number: int
    time: float
    duration: float
    held: bool
    new_scene: bool
    quality: str


class Picture:
    """A picture: 8-bit 4:2:0, planes Y, Cb and Cr.

    Parameters
    ----------
    y : (h, w) uint8 array
    u, v : ((h + 1) // 2, (w + 1) // 2) uint8 arrays
        Each sample is at the centre of the four pixels it belongs to. The planes are kept, not copied.
    matrix : {"unspecified", "bt601", "bt709"}
    full_range : bool
        As in :class:`Format`; for conversion to RGB.

    Attributes
    ----------
    number : int
        Place in the stream, from 0.
    time : float
        Since the beginning of the stream, s.
    duration : float
        s; 0 for pictures that are not from a stream.
    held : bool
        This picture was lost; the previous one is shown in its place.
    new_scene : bool
        The first picture of a scene where decoding can begin.
    quality : {"exact", "pattern missing", "interpolated", "held"}
        What it has suffered from losses.

    Examples
    --------
    >>> grey = np.full((144, 176, 3), 128, np.uint8)
    >>> picture = fbs.Picture.from_rgb(grey)
    >>> picture.y.shape, picture.u.shape
    ((144, 176), (72, 88))
    >>> np.array_equal(picture.rgb(), grey)
    True
    """

    __slots__ = ("duration", "full_range", "held", "matrix", "new_scene", "number", "quality", "time", "u", "v", "y")

    def __init__(
        self, y: Plane, u: Plane, v: Plane, *, matrix: str = "unspecified", full_range: bool = False
    ) -> None:
        if matrix not in MATRICES:
            raise ArgumentError(f"matrix is one of {', '.join(MATRICES)}, not {matrix!r}")
        for plane in (y, u, v):
            if not isinstance(plane, np.ndarray) or plane.dtype != np.uint8 or plane.ndim != 2:
                raise ArgumentError(f"a plane is a 2-D array of uint8, not {_described(plane)}")
        self.y = y
        self.u = u
        self.v = v
        self.matrix = matrix
        self.full_range = full_range
        self.number = 0
        self.time = 0.0
        self.duration = 0.0
        self.held = False
        self.new_scene = False
        self.quality = "exact"

    @classmethod
    def empty(cls, width: int, height: int, *, matrix: str = "unspecified", full_range: bool = False) -> Picture:
        """Make a picture to draw into, with undefined content."""
        luma, half = width * height, ((height + 1) // 2, (width + 1) // 2)
        chroma = half[0] * half[1]
        samples: Plane = np.empty(luma + 2 * chroma, np.uint8)
        return cls(
            samples[:luma].reshape(height, width),
            samples[luma : luma + chroma].reshape(half),
            samples[luma + chroma :].reshape(half),
            matrix=matrix,
            full_range=full_range,
        )

    @classmethod
    def from_rgb(cls, rgb: Plane, *, matrix: str = "bt601", full_range: bool = False) -> Picture:
        """Convert from RGB.

        Parameters
        ----------
        rgb : (h, w, 3) uint8 array
        matrix, full_range
            Of the result.
        """
        rgb = np.asarray(rgb)
        if rgb.dtype != np.uint8 or rgb.ndim != 3 or rgb.shape[2] != 3:
            raise ArgumentError(f"an RGB picture is an (h, w, 3) array of uint8, not {_described(rgb)}")
        if rgb.strides[1:] != (3, 1):
            rgb = np.ascontiguousarray(rgb)
        picture = cls.empty(rgb.shape[1], rgb.shape[0], matrix=matrix, full_range=full_range)
        _fbs.planes_from_rgb(rgb, *picture.planes, MATRICES.index(matrix), full_range)
        return picture

    @property
    def planes(self) -> tuple[Plane, Plane, Plane]:
        """The arrays `y`, `u` and `v`."""
        return self.y, self.u, self.v

    @property
    def width(self) -> int:
        """Pixels."""
        return int(self.y.shape[1])

    @property
    def height(self) -> int:
        """Pixels."""
        return int(self.y.shape[0])

    def rgb(self, out: Plane | None = None) -> Plane:
        """Convert to RGB, by the picture's matrix and range.

        Parameters
        ----------
        out : (h, w, 3) uint8 array, optional
            Target.

        Returns
        -------
        (h, w, 3) uint8 array
            `out`, if given.
        """
        if out is None:
            out = np.empty((self.height, self.width, 3), np.uint8)
        require_writable(out, 3)
        _fbs.rgb_from_planes(*_rows_contiguous(self), out, MATRICES.index(self.matrix), self.full_range)
        return out

    def tobytes(self) -> bytes:
        """All samples of Y, then U, then V, as in Y4M and in the digest of ``fbs decode --md5``."""
        return b"".join(plane.tobytes() for plane in self.planes)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        """RGB, so that ``np.asarray`` and ``plt.imshow`` accept a picture."""
        if copy is False:
            raise ValueError("a picture becomes RGB by a copy")
        rgb = self.rgb()
        return rgb if dtype is None else rgb.astype(dtype)

    def _repr_png_(self) -> bytes:
        """What a notebook shows."""
        rows = np.empty((self.height, 1 + 3 * self.width), np.uint8)
        rows[:, 0] = 0  # no filter
        rows[:, 1:] = self.rgb().reshape(self.height, -1)

        def chunk(kind: bytes, data: bytes) -> bytes:
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

        header = struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0)  # 8 bits, RGB
        data = zlib.compress(rows.tobytes(), 1)
        return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")

    def __repr__(self) -> str:
        return f"<fbs.Picture {self.width}x{self.height}, number {self.number}, {self.time:.3f} s>"


PictureLike = Union[Picture, "Plane", Sequence["Plane"]]
"""A Picture, an (h, w, 3) array, or three planes."""


def planes_of(picture: PictureLike, format: Format) -> tuple[Plane, Plane, Plane]:
    """Planes Y, U and V of any input of an encoder, with contiguous rows; copied only if necessary."""
    if isinstance(picture, np.ndarray) and picture.ndim == 3:
        picture = Picture.from_rgb(picture, matrix=format.matrix, full_range=format.full_range)
    elif not isinstance(picture, Picture):
        planes = [np.asarray(plane) for plane in picture]
        if len(planes) != 3:
            raise ArgumentError("a picture is an (h, w, 3) array of uint8, a Picture, or three planes of uint8")
        picture = Picture(*planes, matrix=format.matrix, full_range=format.full_range)
    if (picture.width, picture.height) != (format.width, format.height):
        raise ArgumentError(
            f"the picture is {picture.width}x{picture.height}, the stream {format.width}x{format.height}"
        )
    if _meaning(picture) != _meaning(format):
        raise ArgumentError(f"the picture has {_named(picture)}, the stream {_named(format)}")
    return _rows_contiguous(picture)


def _meaning(colours: Picture | Format) -> tuple[bool, bool]:
    """What the samples mean: BT.709 or not, full range or not."""
    return colours.matrix == "bt709", colours.full_range


def _named(colours: Picture | Format) -> str:
    return f"matrix {colours.matrix} and {'full' if colours.full_range else 'limited'} range"


def _rows_contiguous(picture: Picture) -> tuple[Plane, Plane, Plane]:
    y, u, v = (p if p.ndim == 2 and p.strides[1] == 1 else np.ascontiguousarray(p) for p in picture.planes)
    return y, u, v


def require_writable(array: Plane, dimensions: int) -> None:
    """ArgumentError, unless this is an array that a picture can be written into."""
    if not isinstance(array, np.ndarray) or array.dtype != np.uint8 or array.ndim != dimensions:
        raise ArgumentError(f"what is written into is a {dimensions}-D array of uint8, not {_described(array)}")
    if not array.flags.writeable:
        raise ArgumentError("what is written into is read-only")


def _described(thing: object) -> str:
    return f"{thing.shape} of {thing.dtype}" if isinstance(thing, np.ndarray) else type(thing).__name__
