"""Writes the bad files of Super-Helices: JSON and NumPy. Needs numpy; run here."""

import copy
import json
from pathlib import Path

import numpy as np

GOOD = {
    "format": "super-helices",
    "version": 1,
    "up_axis": "Y",
    "meters_per_unit": 0.01,
    "strands": {
        "elements": [2, 0],
        "vertices": [8, 2],
        "root": [[0, 0, 0], [1, 0, 0]],
        "tangent": [[0, 1, 0], [1, 0, 0]],
        "normal": [[1, 0, 0], [0, 1, 0]],
        "error": [0.01, 0],
    },
    "elements": {
        "length": [1, 2],
        "twist": [0.5, 0],
        "curvature_1": [0, 1],
        "curvature_2": [-1, 0],
    },
}


def changed(**changes):
    """GOOD with values by path, parts set apart by __; None takes one away."""
    data = copy.deepcopy(GOOD)
    for path, value in changes.items():
        *folders, name = path.split("__")
        at = data
        for folder in folders:
            at = at[folder]
        if value is None:
            del at[name]
        else:
            at[name] = value
    return json.dumps(data)


BAD = {
    "empty": "",
    "no_object": "[1, 2]",
    "no_format": changed(format=None),
    "other_format": changed(format="guides"),
    "other_version": changed(version=2),
    "cut_short": changed()[:200],
    "unknown_key": changed(strands__color=[1, 2]),
    "missing_array": changed(elements__twist=None),
    "text_for_number": changed(elements__twist=["a", "b"]),
    "null_for_number": changed().replace("0.5", "null"),
    "infinite": changed().replace("0.5", "1e99"),
    "too_few_elements": changed(elements__length=[1]),
    "too_many_elements": changed(strands__elements=[2, 1]),
    "elements_wrap": changed(strands__elements=[4294967295, 3]),
    "negative_count": changed(strands__elements=[-2, 4]),
    "too_few_roots": changed(strands__root=[[0, 0, 0]]),
    "flat_root": changed(strands__root=[0, 0, 0]),
    "long_tangent": changed(strands__tangent=[[0, 2, 0], [1, 0, 0]]),
    "zero_tangent": changed(strands__tangent=[[0, 0, 0], [1, 0, 0]]),
    "normal_along_tangent": changed(strands__normal=[[0, 1, 0], [0, 1, 0]]),
    "negative_length": changed(elements__length=[-1, 2]),
    "too_far": changed(elements__length=[3e38, 3e38], elements__twist=[0, 0], elements__curvature_1=[0, 0], elements__curvature_2=[0, 0]),
    "turns_without_end": changed(elements__twist=[1e30, 0]),
    "negative_error": changed(strands__error=[-1, 0]),
    "vertices_billions": changed(strands__vertices=[4000000000, 2]),
    "zero_unit": changed(meters_per_unit=0),
    "other_axis": changed(up_axis="X"),
    "deep": "[" * 100000,
}

ODD = {
    "plain": changed(),
    "no_space": changed(up_axis=None, meters_per_unit=None),
    "no_strands": changed(
        strands={k: [] for k in GOOD["strands"]}, elements={k: [] for k in GOOD["elements"]}
    ),
    "only_points": changed(
        strands__elements=[0, 0], elements={k: [] for k in GOOD["elements"]}
    ),
}


def arrays(**changes):
    found = {
        "version": np.array([1], "<u4"),
        "elements": np.array([2, 0], "<u4"),
        "vertices": np.array([8, 2], "<u4"),
        "root": np.array(GOOD["strands"]["root"], "<f4"),
        "tangent": np.array(GOOD["strands"]["tangent"], "<f4"),
        "normal": np.array(GOOD["strands"]["normal"], "<f4"),
        "error": np.array([0.01, 0], "<f4"),
        "length": np.array([1, 2], "<f4"),
        "twist": np.array([0.5, 0], "<f4"),
        "curvature_1": np.array([0, 1], "<f4"),
        "curvature_2": np.array([-1, 0], "<f4"),
    } | changes
    return {name: array for name, array in found.items() if array is not None}


BAD_ARRAYS = {
    "other_version": arrays(version=np.array([2], "<u4")),
    "missing_array": arrays(twist=None),
    "flat_root": arrays(root=np.zeros(6, "<f4")),
    "negative_count": arrays(vertices=np.array([-8, 2], "<i4")),
    "too_few_elements": arrays(length=np.array([1], "<f4")),
    "nan": arrays(twist=np.array([np.nan, 0], "<f4")),
    "vertices_billions": arrays(vertices=np.array([4000000000, 2], "<u4")),
}

folder = Path("super_helices")
for name, text in BAD.items():
    (folder / f"{name}.json").write_text(text)
for name, text in ODD.items():
    (folder / "tolerated" / f"{name}.json").write_text(text)
for name, found in BAD_ARRAYS.items():
    np.savez(folder / f"{name}.npz", **found)
np.savez(folder / "tolerated" / "plain.npz", **arrays())
seeds = Path("../../../../fuzz/seeds/super_helices")
seeds.mkdir(parents=True, exist_ok=True)
(seeds / "plain.json").write_text(changed())
