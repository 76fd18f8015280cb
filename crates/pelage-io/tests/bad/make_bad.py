"""Writes the bad USD and NumPy files of this folder. Needs numpy; run here."""

import struct
import zipfile
from pathlib import Path

import numpy as np

HEADER = "#usda 1.0\n"
CURVES = """def BasisCurves "hair" {{
    uniform token type = "cubic"
    uniform token basis = "catmullRom"
    uniform token wrap = "pinned"
    int[] curveVertexCounts = {counts}
    point3f[] points = {points}
    {more}
}}
"""
MESH = """def Mesh "body" {{
    int[] faceVertexCounts = {sizes}
    int[] faceVertexIndices = {indices}
    point3f[] points = {points}
    {more}
}}
"""
LINE = "[(0, 0, 0), (0, 0, 1), (1, 0, 0), (1, 0, 1)]"
QUAD = "[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]"


def curves(counts="[2, 2]", points=LINE, more=""):
    return HEADER + CURVES.format(counts=counts, points=points, more=more)


def mesh(sizes="[4]", indices="[0, 1, 2, 3]", points=QUAD, more=""):
    return HEADER + MESH.format(sizes=sizes, indices=indices, points=points, more=more)


def usda():
    deep = "".join(f'def Xform "x" {{\n' for _ in range(5000)) + "}" * 5000
    nested = "(\n customLayerData = " + "{ dictionary a = " * 5000 + "}" * 5000
    laughs = "".join(
        f'def "l{i}" {{\n'
        + "".join(f'  def "p{k}" (references = </l{i + 1}>) {{}}\n' for k in range(10))
        + "}\n"
        for i in range(8)
    )
    diamonds = "".join(
        f'def "d{i}" (references = [</d{i + 1}>, </e{i + 1}>]) {{}}\n'
        f'def "e{i}" (references = [</d{i + 1}>, </e{i + 1}>]) {{}}\n'
        for i in range(24)
    )
    return {
        "empty": "",
        "header_only_wrong": "#usdz 1.0\n",
        "nothing": HEADER,
        "cut_in_array": curves()[:150],
        "cut_in_string": curves()[:45],
        "binary_rubbish": HEADER + "\x00\x01\x02 \x7f {{{ ]]",
        "not_utf8": (HEADER + 'def "').encode() + b"\xff\xfe\xfa",
        "deep_prims": HEADER + deep,
        "deep_dictionaries": "#usda 1.0\n" + nested,
        "ends_in_dictionary": HEADER + "(\n customLayerData = {\n  string a = \"b\"\n",
        "ends_in_metadata": HEADER + 'def Mesh "body" (\n  references = [ </a>,\n',
        "bracket_of_other_kind": HEADER + 'def Mesh "body" {\n  int[] faceVertexCounts = [4)\n}\n',
        "bracket_closed_twice": HEADER + 'def "body" {\n}\n}\n',
        "comment_not_closed": HEADER + "/* def \"a\" {}\n",
        "path_not_closed": HEADER + 'def "a" (\n  references = </b\n) {}\n',
        # Lists within lists are written as text, which doubles with every level.
        "lists_nest": HEADER + "(\n  a = " + "[" * 60 + '"x"' + "]" * 60 + "\n)\n",
        "prim_of_no_name": HEADER + 'def "" {}\n',
        "prim_is_its_own_child": HEADER + 'def "a" {\n  def "." {}\n}\n',
        "prim_above_itself": HEADER + 'def "a" {\n  def ".." {}\n}\n',
        "variant_closes_its_path": HEADER + 'def "a" {\n  variantSet "v" = {\n    "x}b" {}\n  }\n}\n',
        "point_of_two_numbers": mesh(points="[(0, 0, 0), (1, 0), (1, 1, 0), (0, 1, 0)]"),
        # Going up from a path that ends so never ended.
        "transform_names_no_property": mesh(more='uniform token[] xformOpOrder = ["a/b}"]'),
        "variant_chosen_by_no_name": HEADER
        + 'def "a" (variants = {string v = "x/y}"} variantSets = "v") {\n  variantSet "v" = {}\n}\n',
        "relocates_no_prim": HEADER + "(\n  relocates = { </a/b}>: </c/d}> }\n)\ndef \"a\" {}\n",
        "clips_without_end": HEADER
        + 'def "a" (clips = {dictionary default = {\n  string templateAssetPath = "a.#.usd"\n'
        + "  double templateStartTime = 0\n  double templateEndTime = 1\n"
        + "  double templateStride = 1e-300\n}}) {}\n",
        "inherits_above_itself": HEADER + 'def "a" {\n  def "b" (inherits = <../../a>) {}\n}\n',
        "inherits_no_prim": HEADER + 'def "a" (inherits = </b/../a/.>) {}\n',
        "reference_into_variant": HEADER
        + 'def "a" (variants = {string v = "x"} variantSets = "v") {\n'
        + '  variantSet "v" = { "x" { def "b" (references = </c>) {} } }\n}\n'
        + 'def "c" (references = </a/b>) {}\n',
        "counts_too_many": curves(counts="[2, 200000]"),
        "counts_huge": curves(counts="[2147483647, 2147483647]"),
        "counts_negative": curves(counts="[-2, 2]"),
        "counts_missing": curves().replace("int[] curveVertexCounts", "int[] other"),
        "points_missing": curves().replace("point3f[] points", "point3f[] other"),
        "points_are_strings": curves().replace("point3f[] points = " + LINE, 'string[] points = ["a"]'),
        "points_nan": curves(points="[(0, 0, nan), (0, 0, inf), (1, 0, 0), (1, 0, 1)]"),
        "curve_of_one_point": curves(counts="[1, 3]"),
        "zero_length": curves(points="[(0, 0, 0), (0, 0, 0), (1, 0, 0), (1, 0, 1)]"),
        "widths_too_few": curves(more='float[] widths = [1, 2] (interpolation = "vertex")'),
        "widths_negative": curves(more='float[] widths = [1, -2] (interpolation = "uniform")'),
        "widths_unknown_domain": curves(more='float[] widths = [1] (interpolation = "nonsense")'),
        "widths_of_wrong_type": curves(more="int widths = 3"),
        "ids_twice": curves(more='int64[] primvars:hairId = [4, 4] (interpolation = "uniform")'),
        "indices_out_of_range": curves(
            more="color3f[] primvars:displayColor = [(1, 0, 0)]\nint[] primvars:displayColor:indices = [7]"
        ),
        "extent_wrong": curves(more="float3[] extent = [(5, 5, 5), (6, 6, 6)]"),
        "mesh_index_out_of_range": mesh(indices="[0, 1, 2, 9]"),
        "mesh_index_negative": mesh(indices="[0, 1, 2, -1]"),
        "mesh_sizes_negative": mesh(sizes="[-4]"),
        "mesh_sizes_huge": mesh(sizes="[2147483647]"),
        "mesh_nan": mesh(points="[(nan, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]"),
        "mesh_flat": mesh(points="[(0, 0, 0), (0, 0, 0), (0, 0, 0), (0, 0, 0)]"),
        "mesh_unused": mesh(sizes="[3]", indices="[0, 1, 2]"),
        "mesh_st_count": mesh(
            more='texCoord2f[] primvars:st = [(0, 0)] (interpolation = "faceVarying")'
        ),
        "mesh_xform_type": mesh(
            more='string xformOp:translate = "up"\nuniform token[] xformOpOrder = ["xformOp:translate"]'
        ),
        "mesh_xform_missing": mesh(more='uniform token[] xformOpOrder = ["xformOp:translate"]'),
        "reference_missing": HEADER + 'def "a" (references = @./missing.usda@) {}\n',
        "reference_self": HEADER + 'def "a" (references = @./reference_self.usda@</a>) {}\n',
        "reference_cycle": HEADER + 'def "a" (references = </b>) {}\ndef "b" (references = </a>) {}\n',
        "payload_missing": HEADER + 'def "a" (payload = @./missing.usdc@) {}\n',
        "payload_folder": HEADER + 'def "a" (payload = @../usdc@) {}\n',
        "payload_device": HEADER + 'def "a" (payload = @/dev/zero@) {}\n',
        "payload_broken": HEADER + 'def "a" (payload = @../usdc/truncated.usdc@) {}\n',
        "sublayer_missing": HEADER + "(\n subLayers = [@./missing.usda@]\n)\n",
        "sublayer_self": HEADER + "(\n subLayers = [@./sublayer_self.usda@]\n)\n",
        "inherits_itself": HEADER + 'def "a" (inherits = </a>) { def "b" (inherits = </a>) {} }\n',
        "references_multiply": HEADER + laughs,
        "references_diamonds": HEADER + diamonds,
    }


def write_usda():
    for name, text in usda().items():
        data = text if isinstance(text, bytes) else text.encode()
        Path(f"usda/{name}.usda").write_bytes(data)


def sections(data):
    (toc,) = struct.unpack_from("<Q", data, 16)
    (count,) = struct.unpack_from("<Q", data, toc)
    found = {}
    for i in range(count):
        name, start, size = struct.unpack_from("<16sQQ", data, toc + 8 + 32 * i)
        found[name.rstrip(b"\0").decode()] = start
    return toc, found


def write_usdc():
    data = Path("../reference/curves.usdc").read_bytes()
    toc, starts = sections(data)

    def write(name, data):
        Path(f"usdc/{name}.usdc").write_bytes(data)

    def patched(at, number, size=8):
        return data[:at] + int(number).to_bytes(size, "little") + data[at + size :]

    write("empty", b"")
    write("magic_only", data[:8])
    write("header_only", data[:88])
    write("truncated", data[: len(data) // 2])
    write("cut_at_the_end", data[:-20])
    write("no_toc", patched(16, 0))
    write("toc_outside", patched(16, 1 << 60))
    write("version_of_the_future", patched(8, 0xFF00, 3))
    write("version_of_the_past", patched(8, 0x000100, 3))
    write("sections_many", patched(toc, 1 << 40))
    for name, start in starts.items():
        for number in [1 << 33, (1 << 64) - 1]:
            write(f"{name.lower()}_count_{number}", patched(start, number))
            write(f"{name.lower()}_second_{number}", patched(start + 8, number))
    # Array counts stand before the arrays: make each plausible one huge.
    for at in range(88, min(starts.values()), 24):
        (number,) = struct.unpack_from("<Q", data, at)
        if number in (4, 5, 6, 7, 8, 9, 10, 11, 13):
            write(f"array_at_{at}", patched(at, 1 << 50))


def write_usdz():
    layer = mesh().encode()
    crate = Path("../reference/meshes.usdc").read_bytes()

    def write(name, *entries, compression=zipfile.ZIP_STORED):
        with zipfile.ZipFile(f"usdz/{name}.usdz", "w") as archive:
            for entry, data in entries:
                # Always the same time, for always the same bytes.
                archive.writestr(zipfile.ZipInfo(entry), data, compression)

    def refers(to):
        return (HEADER + f'(\n defaultPrim = "a"\n)\ndef "a" (references = @{to}@) {{}}\n').encode()

    Path("usdz/empty.usdz").write_bytes(b"")
    Path("usdz/no_zip.usdz").write_bytes(layer)
    Path("usdz/no_archive.usdz").write_bytes(b"PK\x03\x04 and then nothing")
    write("no_entries")
    write("no_layer_first", ("body.png", b"not a layer"), ("body.usda", layer))
    write("folder_first", ("parts/", b""), ("parts/body.usda", layer))
    write("compressed", ("body.usdc", crate), compression=zipfile.ZIP_DEFLATED)
    write("bomb", ("body.usda", layer + bytes(80_000_000)), compression=zipfile.ZIP_DEFLATED)
    write("broken_layer", ("body.usdc", crate[: len(crate) // 2]))
    write("layer_of_other_kind", ("body.usdc", layer))
    write("refers_to_no_entry", ("body.usda", refers("./missing.usda")))
    write("refers_to_itself", ("body.usda", refers("./body.usda")))
    write("refers_in_a_circle", ("a.usda", refers("b.usda")), ("b.usda", refers("./a.usda")))
    write("refers_to_its_package", ("body.usda", refers("../refers_to_its_package.usdz")))
    write("package_in_package", ("body.usda", refers("inner.usdz")), ("inner.usdz", layer))
    write("layer_in_inner_package", ("a.usda", refers("inner.usdz[b.usda]")), ("inner.usdz", b""))
    write("good", ("body.usdc", crate))
    good = Path("usdz/good.usdz").read_bytes()
    Path("usdz/good.usdz").unlink()

    def patched(name, at, data):
        Path(f"usdz/{name}.usdz").write_bytes(good[:at] + data + good[at + len(data) :])

    central = good.rindex(b"PK\x01\x02")
    Path("usdz/truncated.usdz").write_bytes(good[: len(good) // 2])
    patched("changed_byte", good.index(b"PXR-USDC") + 2000, b"\xff")
    patched("encrypted", central + 8, b"\x01")
    patched("sizes_huge", central + 20, b"\xfe\xff\xff\xff\xfe\xff\xff\xff")
    patched("header_elsewhere", central + 42, b"\xff\xff\xff\x7f")
    patched("entries_many", good.rindex(b"PK\x05\x06") + 8, b"\xff\xff\xff\xff")


def write_npz():
    def write(name, **arrays):
        np.savez(f"npz/{name}.npz", **arrays)

    points = np.zeros((4, 3), np.float32)
    points[:, 2] = range(4)
    counts = np.array([2, 2], np.uint32)
    Path("npz/empty.npz").write_bytes(b"")
    Path("npz/no_zip.npz").write_bytes(b"PK\x03\x04 and then nothing")
    write("no_arrays")
    write("no_points", counts=counts)
    write("no_counts", points=points)
    write("points_flat", points=points.ravel(), counts=counts)
    write("points_integer", points=points.astype(int), counts=counts)
    write("points_fortran", points=np.asfortranarray(points), counts=counts)
    write("points_objects", points=np.array([None, 1]), counts=counts)
    write("points_text", points=np.array(["a", "b"]), counts=counts)
    write("points_nan", points=points * np.nan, counts=counts)
    write("counts_real", points=points, counts=counts.astype(float))
    write("counts_too_many", points=points, counts=np.array([2, 200]))
    write("counts_negative", points=points, counts=np.array([-2, 4]))
    write("counts_huge", points=points, counts=np.array([2**63 - 1, 2**63 - 1]))
    write("widths_too_few", points=points, counts=counts, widths=np.ones(3, np.float32))
    write("groups_too_large", points=points, counts=counts, group=np.array([1, 2**40]))
    frames = np.stack([points, points])
    write("frames_none", points=frames[:0], counts=counts)
    write("frames_too_few", points=frames, counts=counts, frames=np.array([1.0]))
    write("frames_descend", points=frames, counts=counts, frames=np.array([2.0, 1.0]))
    write("frames_nan", points=frames, counts=counts, frames=np.array([1.0, np.nan]))
    write("frames_text", points=frames, counts=counts, frames=np.array(["a", "b"]))
    write("frames_integer_points", points=frames.astype(int), counts=counts)
    write("normals_of_more_frames", points=frames, counts=counts, normals=np.stack([points] * 3))
    good = Path("npz/points_nan.npz").read_bytes()
    Path("npz/truncated.npz").write_bytes(good[:200])
    for name, shape in [
        ("shape_claims", "(99, 3)"),
        ("shape_huge", "(1 << 9, 3)"),
        ("shape_billions", "(999999999999999999, 3)"),
        ("header_nested", "(" * 40),
    ]:
        header = f"{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}\n"
        start = b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header))
        with zipfile.ZipFile(f"npz/{name}.npz", "w") as archive:
            archive.writestr("points.npy", start + header.encode() + points.tobytes())
            archive.writestr("counts.npy", start + header.encode() + points.tobytes())
    with zipfile.ZipFile("npz/bomb.npz", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("points.npy", bytes(80_000_000))


write_usda()
write_usdc()
write_usdz()
write_npz()
