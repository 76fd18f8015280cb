"""Writes the NumPy archives of this folder. Needs numpy; run in this folder."""

import numpy as np

counts = np.array([2, 3, 4], np.uint32)
points = np.arange(27, dtype=np.float32).reshape(9, 3)
curve = np.arange(3)
arrays = {
    "points": points,
    "counts": counts,
    "widths": np.linspace(0.1, 0.2, 9, dtype=np.float32),
    "colors": points / 27,
    "opacities": np.ones(9, np.float32),
    "normals": np.tile(np.float32([0, 0, 1]), (9, 1)),
    "hair_id": (curve + 5_000_000_000).astype(np.uint64),
    "strand_id": curve.astype(np.uint32),
    "root_uv": np.float32([[0, 0], [0.5, 0.25], [1, 1]]),
    "strand_uv": np.zeros((3, 2), np.float32),
    "group": curve.astype(np.uint32),
    "triangle": curve.astype(np.uint32) + 10,
    "barycentric": np.tile(np.float32([0.5, 0.25, 0.25]), (3, 1)),
    "root_rest": np.float32([[1, 2, 3], [4, 5, 6], [7, 8, 9]]),
}
np.savez("hair.npz", **arrays)
wide = {
    name: array.astype(np.float64 if array.dtype.kind == "f" else np.int64)
    for name, array in arrays.items()
}
np.savez_compressed("hair_wide.npz", mystery=np.array(["a", "b"]), **wide)
