#!/usr/bin/env python3
"""Authors the expression basis of generic_head.gltf: the directions in which control points move together.

Run by hand after author_generic_head.py; commit the output. Needs numpy.

    common/author_expression_basis.py            writes extras.expression of common/generic_head.gltf

Input is common/expression_statistics.json: for each part of the face, over talking faces, the covariance of its
control points and their effect on the picture (the mean Gauss-Newton Hessian of squared luma differences). It was
measured on the fits of ten clips with equal weights. A third of the mean effect is added to all directions, since viewers
notice shapes beyond squared differences. Lower eyelids are not tracked yet and use the statistics of the upper ones. The
basis is the Karhunen-Loeve transform in the metric of that effect: coefficients are uncorrelated, the first vary most,
and a step of any of them changes the picture by the same amount. Statistics are symmetrised between a face and its
mirror image. The basis is complete: unusual expressions cost more bits, but all can be coded.
"""

import argparse
import json
import pathlib

import numpy as np

ONE = 4096  # a weight of one

# name, first control point, number of control points
PARTS = [("mouth", 0, 18), ("brows", 18, 8), ("upper_lids", 26, 4), ("lower_lids", 30, 4), ("gaze", 34, 2)]


def symmetric(lower, n):
    matrix = np.zeros((n, n))
    matrix[np.tril_indices(n)] = lower
    return matrix + np.tril(matrix, -1).T


def mirror(vertices, first, count):
    """The control point offsets (x0, y0, x1, y1 ...) of the mirrored face."""
    skinning = np.zeros((len(vertices), count))
    for v, vertex in enumerate(vertices):
        for control, weight in vertex["skinning"]:
            if first <= control < first + count:
                skinning[v, control - first] = weight
    swap = np.linalg.pinv(skinning) @ skinning[[v["mirror"] for v in vertices]]
    out = np.zeros((2 * count, 2 * count))
    out[0::2, 0::2], out[1::2, 1::2] = -swap, swap
    return out


def basis(covariance, effect, flip):
    covariance = (covariance + flip @ covariance @ flip.T) / 2
    effect = (effect + flip.T @ effect @ flip) / 2
    root = np.linalg.cholesky(effect)
    variance, modes = np.linalg.eigh(root.T @ covariance @ root)
    modes = np.linalg.solve(root.T, modes[:, np.argsort(-variance)])
    modes /= np.exp(np.mean(np.log(np.linalg.norm(modes, axis=0))))
    # Choose the sign that makes the largest number positive.
    largest = modes[np.argmax(np.abs(modes), axis=0), np.arange(modes.shape[1])]
    return np.round(ONE * modes * np.sign(largest)).astype(int).T


def main():
    here = pathlib.Path(__file__).parent
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--statistics", default=here / "expression_statistics.json")
    parser.add_argument("--head", default=here / "generic_head.gltf")
    args = parser.parse_args()
    statistics = json.loads(pathlib.Path(args.statistics).read_text())
    head = json.loads(pathlib.Path(args.head).read_text())
    extras = head["meshes"][0]["extras"]
    extras["expression"] = []
    for name, first, count in PARTS:
        n = 2 * count
        rows = basis(symmetric(statistics[name]["covariance"], n), symmetric(statistics[name]["effect"], n),
                     mirror(extras["vertices"], first, count))
        assert np.abs(rows).max() < 8 * ONE
        extras["expression"].append({"name": name, "first_control": first, "control_count": count,
                                     "rows": rows.tolist()})
    from author_generic_head import to_json
    pathlib.Path(args.head).write_text(to_json(head) + "\n")


if __name__ == "__main__":
    main()
