#!/usr/bin/env python3
"""Writes the 68 landmarks of each picture of a video, found by MediaPipe, as `fbs encode --landmarks` reads them.

    mediapipe_landmarks.py VIDEO OUT.csv

Needs the Python packages mediapipe (tried with 0.10.14, which brings its models along) and opencv-python.
"""
import csv
import sys

import cv2
import mediapipe

# The vertex of MediaPipe's face mesh that lies nearest to each iBUG-68 landmark.
JAW = (127, 234, 93, 132, 58, 136, 150, 176, 152, 400, 379, 365, 288, 361, 323, 454, 356)
BROWS = (70, 63, 105, 66, 107, 336, 296, 334, 293, 300)
NOSE = (168, 197, 5, 4, 75, 97, 2, 326, 305)
EYES = (33, 160, 158, 133, 153, 144, 362, 385, 387, 263, 373, 380)
LIPS = (61, 39, 37, 0, 267, 269, 291, 405, 314, 17, 84, 181, 78, 82, 13, 312, 308, 317, 14, 87)
VERTICES = (*JAW, *BROWS, *NOSE, *EYES, *LIPS)


def main(video, table):
    capture = cv2.VideoCapture(video)
    if not capture.isOpened():
        sys.exit(f"cannot read {video}")
    with mediapipe.solutions.face_mesh.FaceMesh(refine_landmarks=True) as mesh, open(table, "w", newline="") as out:
        rows = csv.writer(out)
        rows.writerow(["frame"] + [axis + str(k) for k in range(68) for axis in "xy"])
        frame = 0
        while True:
            there, picture = capture.read()
            if not there:
                break
            height, width = picture.shape[:2]
            faces = mesh.process(cv2.cvtColor(picture, cv2.COLOR_BGR2RGB)).multi_face_landmarks
            points = [faces[0].landmark[v] for v in VERTICES] if faces else []
            rows.writerow([frame] + ([f"{value:.2f}" for p in points for value in (p.x * width, p.y * height)]
                                     or ["nan"] * 136))
            frame += 1


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
