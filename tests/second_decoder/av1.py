"""Decodes the AV1 frames of patterns with libdav1d."""

import ctypes
import ctypes.util

import numpy as np

from .errors import invalid
from .obu import check_frame

_LAYOUT_I420 = 1


class _Settings(ctypes.Structure):
    """Dav1dSettings."""
    _fields_ = [("n_threads", ctypes.c_int), ("max_frame_delay", ctypes.c_int), ("apply_grain", ctypes.c_int),
                ("operating_point", ctypes.c_int), ("all_layers", ctypes.c_int),
                ("frame_size_limit", ctypes.c_uint), ("allocator", ctypes.c_void_p * 3),
                ("logger", ctypes.c_void_p * 2), ("strict_std_compliance", ctypes.c_int),
                ("output_invisible_frames", ctypes.c_int), ("inloop_filters", ctypes.c_int),
                ("reserved", ctypes.c_uint8 * 20)]


class _Data(ctypes.Structure):
    """Dav1dData, with some bytes for later versions."""
    _fields_ = [("data", ctypes.c_void_p), ("sz", ctypes.c_size_t), ("rest", ctypes.c_uint8 * 256)]


class _Picture(ctypes.Structure):
    """Dav1dPicture up to its format, and room for the rest."""
    _fields_ = [("seq_hdr", ctypes.c_void_p), ("frame_hdr", ctypes.c_void_p), ("data", ctypes.c_void_p * 3),
                ("stride", ctypes.c_ssize_t * 2), ("w", ctypes.c_int), ("h", ctypes.c_int),
                ("layout", ctypes.c_int), ("bpc", ctypes.c_int), ("rest", ctypes.c_uint8 * 1024)]


def _load_library():
    library = ctypes.CDLL(ctypes.util.find_library("dav1d") or "libdav1d.so.6")
    library.dav1d_data_create.restype = ctypes.c_void_p
    return library


_DAV1D = _load_library()


class Av1Decoder:
    """Decodes the frames of one scene, in the order of their packets."""

    def __init__(self):
        settings = _Settings()
        _DAV1D.dav1d_default_settings(ctypes.byref(settings))
        settings.n_threads = settings.max_frame_delay = 1
        settings.apply_grain = 0
        settings.logger = (None, None)
        settings.output_invisible_frames = 1
        self._context = ctypes.c_void_p()
        if _DAV1D.dav1d_open(ctypes.byref(self._context), ctypes.byref(settings)) < 0:
            raise RuntimeError("dav1d cannot be opened")
        self._is_first = True

    def __del__(self):
        _DAV1D.dav1d_close(ctypes.byref(self._context))

    def decode(self, frame):
        """The planes Y, U, V of a frame, arrays of bytes."""
        check_frame(frame, self._is_first)
        self._is_first = False
        data = _Data()
        buffer = _DAV1D.dav1d_data_create(ctypes.byref(data), ctypes.c_size_t(len(frame)))
        ctypes.memmove(buffer, frame, len(frame))
        failed = _DAV1D.dav1d_send_data(self._context, ctypes.byref(data)) < 0
        if data.sz:
            _DAV1D.dav1d_data_unref(ctypes.byref(data))
        picture = _Picture()
        if failed or _DAV1D.dav1d_get_picture(self._context, ctypes.byref(picture)) < 0:
            raise invalid("AV1 data is invalid")
        try:
            return _planes(picture)
        finally:
            _DAV1D.dav1d_picture_unref(ctypes.byref(picture))


def _planes(picture):
    if picture.layout != _LAYOUT_I420 or picture.bpc != 8:
        raise invalid("AV1 is not 8-bit 4:2:0")
    return [_plane(picture.data[i], picture.stride[min(i, 1)], *_plane_size(picture, i)) for i in range(3)]


def _plane_size(picture, i):
    return (picture.w, picture.h) if i == 0 else ((picture.w + 1) // 2, (picture.h + 1) // 2)


def _plane(address, stride, width, height):
    """A copy of a plane; stride is the number of bytes from row to row."""
    rows = [ctypes.string_at(address + stride * row, width) for row in range(height)]
    return np.frombuffer(b"".join(rows), np.uint8).reshape(height, width).astype(np.int64)
