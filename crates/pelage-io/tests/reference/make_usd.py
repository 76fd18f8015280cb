"""Writes the USD files of this folder and what OpenUSD itself reads from them.

Needs `pip install usd-core`. Run in this folder.
"""

import json
import shutil
import tempfile
from pathlib import Path

from pxr import Gf, Sdf, Usd, UsdGeom, UsdUtils, Vt

TIMES = [None, 0.0, 2.5, 10.0, 99.0]


def cube(stage, path, **kind):
    mesh = UsdGeom.Mesh.Define(stage, path)
    points = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    mesh.CreatePointsAttr(points)
    mesh.CreateFaceVertexCountsAttr([4, 4, 4, 3, 3])
    faces = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 2, 7, 6]
    mesh.CreateFaceVertexIndicesAttr(faces)
    return mesh


def st(mesh, name, interpolation, count, indices=None):
    primvars = UsdGeom.PrimvarsAPI(mesh)
    primvar = primvars.CreatePrimvar(name, Sdf.ValueTypeNames.TexCoord2fArray, interpolation)
    primvar.Set([(i / 16, 1 - i / 32) for i in range(count)])
    if indices:
        primvar.SetIndices(Vt.IntArray(indices))


def meshes(name):
    stage = Usd.Stage.CreateNew(name)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    world = UsdGeom.Xform.Define(stage, "/World")
    world.AddTranslateOp().Set((1, 2, 3))
    world.AddRotateXYZOp().Set((10, 20, 30))
    world.AddScaleOp().Set((2, 1, 0.5))

    body = cube(stage, "/World/body")
    st(body, "st", "faceVarying", 5, [i % 5 for i in range(18)])
    normals = [(0, 0, 1) if i % 2 else (1, 0, 0) for i in range(18)]
    body.CreateNormalsAttr(normals)
    body.SetNormalsInterpolation("faceVarying")
    still = body.GetPointsAttr().Get()
    body.GetPointsAttr().Set([p * 2 for p in still], 0)
    body.GetPointsAttr().Set([p * 4 for p in still], 10)

    left = cube(stage, "/World/left")
    left.CreateOrientationAttr("leftHanded")
    left.CreateHoleIndicesAttr([1])
    st(left, "st", "vertex", 8)
    left.AddRotateZYXOp().Set((5, 6, 7))
    left.AddOrientOp().Set(Gf.Quatf(0.5, 0.5, -0.5, 0.5))

    mirror = cube(stage, "/World/mirror")
    mirror.AddTranslateOp(opSuffix="pivot").Set((0.5, 0.25, 0))
    mirror.AddScaleOp().Set((-1, 1, 1))
    mirror.AddRotateYOp().Set(33)
    mirror.AddTranslateOp(opSuffix="pivot", isInverseOp=True)

    free = cube(stage, "/World/free")
    free.SetResetXformStack(True)
    matrix = Gf.Matrix4d().SetRotate(Gf.Rotation((1, 2, 3), 40))
    matrix.SetTranslateOnly((7, 8, 9))
    free.AddTransformOp().Set(matrix)

    moving = cube(stage, "/World/moving")
    move = moving.AddTranslateOp()
    move.Set((0, 0, 0), 0)
    move.Set((10, 0, 0), 10)

    proxy = cube(stage, "/World/proxy")
    proxy.CreatePurposeAttr("proxy")
    UsdGeom.Mesh(stage.OverridePrim("/World/over"))
    stage.CreateClassPrim("/Class")
    cube(stage, "/Class/abstract")
    asset = stage.DefinePrim("/World/copy", "Xform")
    asset.GetReferences().AddInternalReference("/Class")
    UsdGeom.Xform(asset).AddTranslateOp().Set((0, 0, 50))
    stage.Save()
    return stage


def read_mesh(prim, time):
    time = Usd.TimeCode.Default() if time is None else Usd.TimeCode(time)
    mesh = UsdGeom.Mesh(prim)
    points = mesh.GetPointsAttr().Get(time)
    world = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(time)
    if time == Usd.TimeCode.Default() and prim.GetName() == "moving":
        # Pelage takes the first sample where there is no default.
        world = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(0)
    points = [[float(x) for x in world.Transform(Gf.Vec3d(p))] for p in points]
    flip = (mesh.GetOrientationAttr().Get() == "leftHanded") != (world.GetDeterminant() < 0)
    holes = mesh.GetHoleIndicesAttr().Get() or []
    sizes, corners, uvs = [], [], []
    primvar = UsdGeom.PrimvarsAPI(prim).GetPrimvar("st")
    values = primvar.ComputeFlattened() if primvar else None
    start = 0
    indices = mesh.GetFaceVertexIndicesAttr().Get()
    for face, size in enumerate(mesh.GetFaceVertexCountsAttr().Get()):
        order = list(range(start, start + size))
        start += size
        if face in holes:
            continue
        if flip:
            order = order[:1] + order[:0:-1]
        sizes.append(size)
        corners += [indices[c] for c in order]
        if values:
            varying = primvar.GetInterpolation() == "faceVarying"
            uvs += [list(values[c if varying else indices[c]]) for c in order]
    return {"points": points, "sizes": sizes, "corners": corners, "uvs": uvs}


CURVES = [
    ("linear", "nonperiodic", [2, 5]),
    ("linear", "periodic", [3, 5]),
    ("linear", "pinned", [2, 4]),
    ("bezier", "nonperiodic", [4, 7]),
    ("bezier", "periodic", [3, 6]),
    ("bspline", "nonperiodic", [4, 6]),
    ("bspline", "periodic", [4, 6]),
    ("bspline", "pinned", [3, 5]),
    ("catmullRom", "nonperiodic", [4, 9]),
    ("catmullRom", "periodic", [4, 6]),
    ("catmullRom", "pinned", [2, 6]),
]


def varying_size(curves):
    # ComputeVaryingDataSize counts pinned cubics as if they were periodic ones
    # that lack their ends; the schema and the renderers take one value a vertex.
    if curves.GetWrapAttr().Get() == "pinned":
        return sum(curves.GetCurveVertexCountsAttr().Get())
    return curves.ComputeVaryingDataSize(Usd.TimeCode.Default())


def curves(name):
    stage = Usd.Stage.CreateNew(name)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    top = UsdGeom.Xform.Define(stage, "/Hair")
    top.AddTranslateOp().Set((0, 100, 0))
    top.AddScaleOp().Set((2, 2, 2))
    for i, (basis, wrap, counts) in enumerate(CURVES):
        prim = UsdGeom.BasisCurves.Define(stage, f"/Hair/{basis}_{wrap}")
        prim.CreateTypeAttr("linear" if basis == "linear" else "cubic")
        if basis not in ("linear", "bezier"):
            prim.CreateBasisAttr(basis)
        prim.CreateWrapAttr(wrap)
        prim.CreateCurveVertexCountsAttr(counts)
        points = [(k * 0.5, (k * k) % 7, i) for k in range(sum(counts))]
        prim.CreatePointsAttr(points)
        prim.GetPointsAttr().Set(points, 1)
        prim.GetPointsAttr().Set([(x + 1, y, z) for x, y, z in points], 2)
        domain = ["constant", "uniform", "varying", "vertex"][i % 4]
        size = varying_size(prim)
        size = {"constant": 1, "uniform": 2, "varying": size, "vertex": sum(counts)}[domain]
        prim.CreateWidthsAttr([1 + k / 8 for k in range(size)])
        prim.SetWidthsInterpolation(domain)
        primvars = UsdGeom.PrimvarsAPI(prim)
        types = Sdf.ValueTypeNames
        primvars.CreatePrimvar("st", types.TexCoord2fArray, "uniform").Set([(0.25, 0.5), (1, 0)])
        primvars.CreatePrimvar("hairId", types.Int64Array, "uniform").Set([5_000_000_000, 7])
        primvars.CreatePrimvar("strandId", types.IntArray, "uniform").Set([0, 1])
        primvars.CreatePrimvar("group", types.IntArray, "uniform").Set([3, 4])
        rest = primvars.CreatePrimvar("restRoot", types.Point3fArray, "uniform")
        rest.Set([(1, 2, 3), (4, 5, 6)])
        prim.CreateDisplayColorPrimvar("constant").Set([(0.5, 0.25, 0.125)])
        prim.CreateDisplayOpacityPrimvar("uniform").Set([0.5, 1.0])
        mystery = primvars.CreatePrimvar("mystery", types.HalfArray, "uniform")
        mystery.Set([1.0, 2.0])
        extent = UsdGeom.PointBased.ComputeExtent(prim.GetPointsAttr().Get())
        prim.CreateExtentAttr([extent[0] - Gf.Vec3f(2), extent[1] + Gf.Vec3f(2)])
    stage.Save()
    return stage


def read_curves(prim, time):
    time = Usd.TimeCode.Default() if time is None else Usd.TimeCode(time)
    curves = UsdGeom.BasisCurves(prim)
    world = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(time)
    points = [list(map(float, world.Transform(Gf.Vec3d(p)))) for p in curves.GetPointsAttr().Get(time)]
    return {
        "counts": list(curves.GetCurveVertexCountsAttr().Get()),
        "points": points,
        "varying": varying_size(curves),
        "widths": list(curves.GetWidthsAttr().Get()),
        "domain": curves.GetWidthsInterpolation(),
    }


def packed(name):
    """A constant array, which packs 2,000 to 1: no reason to distrust a file."""
    stage = Usd.Stage.CreateNew(name)
    prim = UsdGeom.BasisCurves.Define(stage, "/hair")
    prim.CreateTypeAttr("linear")
    prim.CreateCurveVertexCountsAttr([2])
    prim.CreatePointsAttr([(0, 0, 0), (0, 0, 1)])
    ones = UsdGeom.PrimvarsAPI(prim).CreatePrimvar("ones", Sdf.ValueTypeNames.IntArray)
    ones.Set([1] * 100_000)
    stage.Save()


def packages():
    """A package of one layer, and one whose root layer refers to another."""
    UsdUtils.CreateNewUsdzPackage(Sdf.AssetPath("meshes.usdc"), "meshes.usdz")
    with tempfile.TemporaryDirectory() as folder:
        parts = Path(folder, "parts")
        parts.mkdir()
        shutil.copy("curves.usdc", parts)
        scene = str(Path(folder, "scene.usda"))
        stage = Usd.Stage.CreateNew(scene)
        UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
        UsdGeom.SetStageMetersPerUnit(stage, 0.01)
        hair = stage.DefinePrim("/Hair")
        hair.GetReferences().AddReference("./parts/curves.usdc", "/Hair")
        stage.Save()
        UsdUtils.CreateNewUsdzPackage(Sdf.AssetPath(scene), "curves.usdz")


def main():
    packed("packed.usdc")
    expected = {"meshes": {}, "curves": {}}
    stage = meshes("meshes.usda")
    stage.Export("meshes.usdc", addSourceFileComment=False)
    for time in TIMES:
        expected["meshes"][str(time)] = {
            str(prim.GetPath()): read_mesh(prim, time)
            for prim in stage.Traverse()
            if prim.IsA(UsdGeom.Mesh) and prim.GetName() != "proxy"
        }
    stage = curves("curves.usda")
    stage.Export("curves.usdc", addSourceFileComment=False)
    for time in [None, 1.5]:
        expected["curves"][str(time)] = {
            str(prim.GetPath()): read_curves(prim, time)
            for prim in stage.Traverse()
            if prim.IsA(UsdGeom.BasisCurves)
        }
    packages()
    with open("usd_expected.json", "w") as file:
        json.dump(expected, file, separators=(",", ":"))


main()
