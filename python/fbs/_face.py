"""A stream's data of the face."""

from __future__ import annotations

import operator
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class FaceState:
    """Pose and expression of the face in one picture.

    ``dataclasses.replace(state, yaw=state.yaw + 10)`` makes another, which :meth:`fbs.Decoder.render` draws;
    :meth:`fbs.Decoder.edited` makes one by movements of the face.

    Attributes
    ----------
    pitch, yaw, roll : float
        Degrees. Positive: the face looks down, to the picture's left, its top leans to the picture's right.
    x, y : float
        Middle of the head at the height of the eyes, pixels from the top left corner of the picture.
    eye_distance : float
        With the face seen from the front, pixels.
    control_points : (36, 2) float32 array
        Displacement of each control point from the expressionless face, x and y along the head's own axes, in eye
        distances. Outer mouth 0..9, inner mouth 10..17, right brow 18..21, left brow 22..25, upper lids 26..29, lower
        lids 30..33, pupils 34 and 35; "right" and "left" are the person's own.
    """

    pitch: float
    yaw: float
    roll: float
    x: float
    y: float
    eye_distance: float
    control_points: Floats = field(repr=False)


@dataclass(frozen=True, eq=False)
class States:
    """The faces of all n pictures of a stream, one row a picture.

    Where a picture has no face, numbers are NaN.

    Attributes
    ----------
    number : (n,) int64 array
        Number of each picture, from 0; missing numbers were lost.
    time, duration : (n,) float64 arrays
        Seconds.
    has_face, held, new_scene : (n,) bool arrays
        Whether there is a face; whether the picture was lost, and the previous one is shown; whether decoding can
        begin here.
    pose : (n, 3) float32 array
        Pitch, yaw and roll as in :class:`FaceState`, degrees.
    position : (n, 2) float32 array
        Middle of the head, pixels.
    eye_distance : (n,) float32 array
        Pixels.
    control_points : (n, 36, 2) float32 array
        As in :class:`FaceState`, eye distances.
    landmarks : (n, 68, 2) float32 array
        The 68 points of iBUG (300-W), x and y, pixels. The centre of the first pixel is 0.5, 0.5.
    confidence : (n, 68) float32 array
        Confidence of each landmark, 0 to 1: how much of the face around it faces the viewer.
    blendshapes : (n, 32) float32 array
        Weights of movements, named by :data:`fbs.BLENDSHAPES` as in ARKit; 0 is the face of the scene's first picture.
    """

    number: NDArray[np.int64]
    time: NDArray[np.float64]
    duration: NDArray[np.float64]
    has_face: NDArray[np.bool_]
    held: NDArray[np.bool_]
    new_scene: NDArray[np.bool_]
    pose: Floats
    position: Floats
    eye_distance: Floats
    control_points: Floats
    landmarks: Floats
    confidence: Floats
    blendshapes: Floats

    @property
    def pitch(self) -> Floats:
        """(n,) float32 array, degrees; positive: the face looks down."""
        return self.pose[:, 0]

    @property
    def yaw(self) -> Floats:
        """(n,) float32 array, degrees; positive: the face looks to the picture's left."""
        return self.pose[:, 1]

    @property
    def roll(self) -> Floats:
        """(n,) float32 array, degrees; positive: the top of the head leans to the picture's right."""
        return self.pose[:, 2]

    def __len__(self) -> int:
        return len(self.number)

    def __getitem__(self, index: int) -> FaceState | None:
        """The state of the picture in row `index`; None where it has no face."""
        index = operator.index(index)
        if not self.has_face[index]:
            return None
        pitch, yaw, roll = map(float, self.pose[index])
        x, y = map(float, self.position[index])
        return FaceState(pitch, yaw, roll, x, y, float(self.eye_distance[index]), self.control_points[index])

    def __iter__(self) -> Iterator[FaceState | None]:
        return (self[index] for index in range(len(self)))

    def __repr__(self) -> str:
        return f"<fbs.States of {len(self)} pictures, {int(self.has_face.sum())} with a face>"


def states_of(columns: dict[str, NDArray[Any]], ticks_per_second: int) -> States:
    """Name the columns of the extension."""
    pose, landmarks = columns["pose"], columns["landmarks"]
    return States(
        number=columns["number"].astype(np.int64),
        time=columns["time"] / ticks_per_second,
        duration=columns["duration"] / ticks_per_second,
        has_face=columns["has_face"].astype(bool),
        held=columns["held"].astype(bool),
        new_scene=columns["new_scene"].astype(bool),
        pose=pose[:, :3],
        position=pose[:, 3:5],
        eye_distance=pose[:, 5],
        control_points=columns["control"],
        landmarks=landmarks[:, :, :2],
        confidence=landmarks[:, :, 2],
        blendshapes=columns["blendshapes"],
    )
