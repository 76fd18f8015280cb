#!/usr/bin/env python3
"""Makes the small files that readers are tried with.

`bad/FORMAT/` holds files that must be refused, `bad/FORMAT/tolerated/` odd ones
that must be read, and `fuzz/seeds/FORMAT/` sound ones to start mutating from.
Needs nothing but Python's own library; run it from anywhere and commit the result.
"""

import base64
import json
import struct
import zlib
from pathlib import Path

HERE = Path(__file__).parent
BAD = HERE / "bad"
SEEDS = HERE.parents[2] / "fuzz" / "seeds"
HUGE = 0xFFFFFFFF


def put(folder, name, data):
    if isinstance(data, str):
        data = data.encode()
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(data)


def bad(path, data):
    put((BAD / path).parent, Path(path).name, data)


def seed(path, data):
    put((SEEDS / path).parent, Path(path).name, data)


# OBJ ---------------------------------------------------------------------------

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
FULL_OBJ = (
    SQUARE
    + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
    + "o square\nf 1/1/1 2/2/1 3/3/1 4/4/1\nf -4//1 -3//1 -2//1\n"
)
LINES = SQUARE + "o hair\nl 1 2 3\nl 1 4\n"


def obj():
    refused = {
        "empty": "",
        "no_face": SQUARE,
        "two_corners": SQUARE + "f 1 2\n",
        "index_zero": SQUARE + "f 0 1 2\n",
        "index_beyond_the_end": SQUARE + "f 1 2 5\n",
        "negative_before_the_start": SQUARE + "f -1 -2 -5\n",
        "most_negative": SQUARE + "f 1 2 -9223372036854775808\n",
        "index_of_64_bits": SQUARE + "f 1 2 18446744073709551617\n",
        "uv_beyond_the_end": SQUARE + "vt 0 0\nf 1/1 2/1 3/2\n",
        "normal_zero": SQUARE + "vn 0 0 1\nf 1//0 2//0 3//0\n",
        "four_indices": SQUARE + "f 1/1/1/1 2 3\n",
        "no_vertex_index": SQUARE + "vt 0 0\nf /1 /1 /1\n",
        "nan": SQUARE + "v nan 0 0\nf 1 2 3\n",
        "infinite": SQUARE + "v 0 1e39 0\nf 1 2 3\n",
        "word_for_a_number": SQUARE + "v one 0 0\nf 1 2 3\n",
        "cut_short": FULL_OBJ[:-8],
        "cut_in_a_vertex": "v 0 0",
        "binary": bytes(range(256)) * 4,
        "endless_continuation": "f 1 \\\n" * 50,
        "only_lines": LINES,
        "nul_bytes": b"v 0 0\0 0\nf 1 1 1\n",
    }
    for name, data in refused.items():
        bad(f"obj/{name}.obj", data)
    tolerated = {
        "unknown_statements": SQUARE + "curv 0 1\nfoo\nusemtl \xff\nf 1 2 3\n",
        "mac_and_dos_ends": SQUARE.replace("\n", "\r\n") + "f 1 2 3",
        "some_uvs": FULL_OBJ,
        "same_corner_twice": SQUARE + "f 1 1 1\n",
        "vertices_last": "f 1 2 3\n" + SQUARE,
    }
    for name, data in tolerated.items():
        bad(f"obj/tolerated/{name}.obj", data)
    for name, data in {
        "empty": "",
        "only_faces": FULL_OBJ,
        "one_vertex": SQUARE + "l 1\n",
        "no_such_vertex": SQUARE + "l 1 9\n",
    }.items():
        bad(f"obj_curves/{name}.obj", data)
    bad("obj_curves/tolerated/zero_length.obj", SQUARE + "l 1 1\n")
    seed("obj/full.obj", FULL_OBJ)
    seed("obj/lines.obj", LINES)


# PLY ---------------------------------------------------------------------------

PLY_HEADER = """ply
format {encoding} 1.0
comment made by hand
element vertex {vertices}
property float x
property float y
property double z
property float nx
property float ny
property float nz
property float s
property float t
element face {faces}
property list uchar int vertex_indices
end_header
"""


def ply_ascii(vertices=4, faces=1):
    body = "".join(f"{x} {y} 0 0 0 1 {x} {y}\n" for x, y in [(0, 0), (1, 0), (1, 1), (0, 1)])
    return PLY_HEADER.format(encoding="ascii", vertices=vertices, faces=faces) + body + "4 0 1 2 3\n"


def ply_binary(order, vertices=4, faces=1, face=None):
    name = {"<": "binary_little_endian", ">": "binary_big_endian"}[order]
    data = PLY_HEADER.format(encoding=name, vertices=vertices, faces=faces).encode()
    for x, y in [(0, 0), (1, 0), (1, 1), (0, 1)]:
        data += struct.pack(order + "ffdfffff", x, y, 0, 0, 0, 1, x, y)
    return data + (face or struct.pack(order + "B4i", 4, 0, 1, 2, 3))


def ply():
    text = ply_ascii()
    refused = {
        "empty": "",
        "only_the_first_word": "ply\n",
        "no_end_header": text.split("end_header")[0],
        "no_body": text.split("end_header")[0] + "end_header\n",
        "unknown_format": text.replace("ascii", "utf16"),
        "unknown_type": text.replace("property double", "property quad"),
        "huge_vertex_count": ply_ascii(vertices=2**64 - 1),
        "count_beyond_64_bits": ply_ascii(vertices=2**65),
        "negative_count": ply_ascii(vertices=-1),
        "more_faces_than_there_are": ply_ascii(faces=2),
        "element_without_properties": "ply\nformat binary_little_endian 1.0\n"
        "element nothing 18446744073709551615\nend_header\n",
        "index_beyond_the_end": text.replace("4 0 1 2 3", "4 0 1 2 4"),
        "negative_index": text.replace("4 0 1 2 3", "4 0 1 2 -1"),
        "two_corners": text.replace("4 0 1 2 3", "2 0 1"),
        "negative_list": text.replace("4 0 1 2 3", "-4 0 1 2 3"),
        "huge_list": text.replace("4 0 1 2 3", "4000000000 0 1 2 3"),
        "nan": text.replace("1 1 0 0", "1 nan 0 0"),
        "words": text.replace("1 1 0 0", "one one 0 0"),
        "no_faces": ply_ascii(faces=0),
        "no_z": text.replace("property double z\n", ""),
        "indices_no_list": text.replace("list uchar int", "int"),
        "little_cut_short": ply_binary("<")[:-1],
        "big_cut_in_vertices": ply_binary(">")[:-60],
        "little_huge_count": ply_binary("<", vertices=2**40),
        "little_huge_list": ply_binary("<", face=b"\xff\0\0"),
        "little_index": ply_binary("<", face=struct.pack("<B4I", 4, 0, 1, 2, HUGE)),
        "binary_garbage": bytes(range(256)),
    }
    for name, data in refused.items():
        bad(f"ply/{name}.ply", data)
    bad("ply/tolerated/bytes_behind.ply", ply_binary("<") + b"more")
    bad("ply/tolerated/numbers_without_zeros.ply", text.replace("1 1 0 0", "1. 1 .0 0"))
    seed("ply/text.ply", text)
    seed("ply/little.ply", ply_binary("<"))
    seed("ply/big.ply", ply_binary(">"))


# glTF --------------------------------------------------------------------------

GLTF_DATA = struct.pack(
    "<9f9f6f3H", *[0, 0, 0, 1, 0, 0, 0, 1, 0], *[0, 0, 1] * 3, *[0, 0, 1, 0, 0, 1], 0, 1, 2
)


def gltf_root(uri=True):
    buffer = {"byteLength": len(GLTF_DATA)}
    if uri:
        text = base64.b64encode(GLTF_DATA).decode()
        buffer["uri"] = "data:application/octet-stream;base64," + text
    accessor = {"bufferView": 0, "componentType": 5126, "count": 3}
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "rotation": [0, 0, 0.6, 0.8]}],
        "meshes": [
            {
                "primitives": [
                    {"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3}
                ]
            }
        ],
        "accessors": [
            dict(accessor, type="VEC3"),
            dict(accessor, type="VEC3", byteOffset=36),
            dict(accessor, type="VEC2", byteOffset=72),
            {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 96},
            {"buffer": 0, "byteOffset": 96, "byteLength": 6},
        ],
        "buffers": [buffer],
    }


def glb(root, data, length=None):
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, length or 12 + len(chunks)) + chunks


def gltf():
    def changed(name, change):
        root = gltf_root()
        change(root)
        bad(f"gltf/{name}.gltf", json.dumps(root))

    def primitive(root):
        return root["meshes"][0]["primitives"][0]

    def many_nodes(root):
        root["scenes"][0]["nodes"] = list(range(2000))
        root["nodes"] = [{"mesh": 0}] * 2000
        root["meshes"][0]["primitives"] *= 60

    changed("cyclic_nodes", lambda r: r.update(nodes=[{"children": [1]}, {"children": [0]}]))
    changed("node_is_its_own_child", lambda r: r.update(nodes=[{"children": [0]}]))
    changed("missing_node", lambda r: r["scenes"][0].update(nodes=[4]))
    changed("missing_scene", lambda r: r.update(scene=4))
    changed("missing_mesh", lambda r: r["nodes"][0].update(mesh=4))
    changed("missing_accessor", lambda r: primitive(r)["attributes"].update(POSITION=4000))
    changed("missing_view", lambda r: r["accessors"][0].update(bufferView=9))
    changed("missing_buffer", lambda r: r["bufferViews"][0].update(buffer=9))
    changed("missing_file", lambda r: r["buffers"][0].update(uri="nowhere.bin"))
    changed("elsewhere", lambda r: r["buffers"][0].update(uri="https://example.com/a.bin"))
    changed("no_base64", lambda r: r["buffers"][0].update(uri="data:;base64,???"))
    changed("short_buffer", lambda r: r["buffers"][0].update(uri="data:;base64,AAAA"))
    changed("huge_count", lambda r: r["accessors"][0].update(count=2**62))
    changed("huge_offset", lambda r: r["accessors"][0].update(byteOffset=2**63))
    changed("huge_view", lambda r: r["bufferViews"][0].update(byteLength=2**63, byteOffset=2**63))
    changed("small_stride", lambda r: r["bufferViews"][0].update(byteStride=1))
    changed("huge_stride", lambda r: r["bufferViews"][0].update(byteStride=2**63))
    changed("index_beyond_the_end", lambda r: r["accessors"][0].update(count=2))
    changed("float_indices", lambda r: primitive(r).update(indices=2))
    changed("wrong_type", lambda r: r["accessors"][0].update(type="MAT4"))
    changed("unknown_component", lambda r: r["accessors"][0].update(componentType=5130))
    changed("unknown_mode", lambda r: primitive(r).update(mode=9))
    changed("no_position", lambda r: primitive(r)["attributes"].pop("POSITION"))
    changed("only_points", lambda r: primitive(r).update(mode=0))
    changed("unread_extension", lambda r: r.update(extensionsRequired=["KHR_draco_mesh_compression"]))
    changed("mesh_repeated_too_often", many_nodes)
    changed("no_meshes", lambda r: (r.pop("meshes"), r.update(nodes=[{}])))
    bad("gltf/empty.gltf", "")
    bad("gltf/no_object.gltf", "[]")
    bad("gltf/deep.gltf", "[" * 5000)
    bad("gltf/cut_short.gltf", json.dumps(gltf_root())[:300])
    whole = glb(gltf_root(uri=False), GLTF_DATA)
    bad("gltf/cut_short.glb", whole[:-40])
    bad("gltf/header_only.glb", whole[:12])
    bad("gltf/tiny_length.glb", glb(gltf_root(uri=False), GLTF_DATA, length=3))
    bad("gltf/huge_length.glb", glb(gltf_root(uri=False), GLTF_DATA, length=HUGE))
    bad("gltf/huge_chunk.glb", whole[:12] + struct.pack("<I", HUGE) + whole[16:])
    odd = gltf_root()
    odd["nodes"][0]["rotation"] = [0, 0, 0, 0]
    bad("gltf/tolerated/zero_rotation.gltf", json.dumps(odd))
    seed("gltf/text.gltf", json.dumps(gltf_root()))
    seed("gltf/binary.glb", whole)


# Images ------------------------------------------------------------------------


def png(width=2, height=2, depth=8, rows=None, color=0):
    def chunk(kind, data):
        check = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)

    row = b"\0" + b"\x40" * (width * depth // 8) if rows is None else b""
    head = struct.pack(">IIBBBBB", width, height, depth, color, 0, 0, 0)
    texels = zlib.compress(row * height if rows is None else rows)
    return (
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", texels) + chunk(b"IEND", b"")
    )


def tiff(width=2, height=1, texels=struct.pack("<2f", 0.5, 2.0), bits=32, kind=3):
    tags = [
        (256, 4, width),
        (257, 4, height),
        (258, 3, bits),
        (259, 3, 1),
        (262, 3, 1),
        (273, 4, 8),
        (277, 3, 1),
        (278, 4, height),
        (279, 4, len(texels)),
        (339, 3, kind),
    ]
    data = struct.pack("<2sHI", b"II", 42, 8 + len(texels)) + texels
    data += struct.pack("<H", len(tags))
    for tag, field, value in tags:
        data += struct.pack("<HHII", tag, field, 1, value)
    return data + struct.pack("<I", 0)


def exr(width=2, height=2, value=0.5, channels=("Y",), window=None, sampling=1, display=None):
    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data

    box = window or (0, 0, width - 1, height - 1)
    list_ = b"".join(
        c.encode() + b"\0" + struct.pack("<iBxxxii", 2, 0, sampling, sampling) for c in channels
    )
    head = struct.pack("<II", 20000630, 2)
    head += attribute(b"channels", b"chlist", list_ + b"\0")
    head += attribute(b"compression", b"compression", b"\0")
    head += attribute(b"dataWindow", b"box2i", struct.pack("<4i", *box))
    head += attribute(b"displayWindow", b"box2i", struct.pack("<4i", *(display or box)))
    head += attribute(b"lineOrder", b"lineOrder", b"\0")
    head += attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
    head += attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0))
    head += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1))
    head += b"\0"
    line = struct.pack(f"<{width * len(channels)}f", *[value] * (width * len(channels)))
    chunks = [struct.pack("<ii", box[1] + y, len(line)) + line for y in range(height)]
    at = len(head) + 8 * height
    offsets = [at + y * len(chunks[0]) for y in range(height)]
    return head + struct.pack(f"<{height}Q", *offsets) + b"".join(chunks)


HDR = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + bytes([128, 64, 32, 129] * 2)

# 8 × 8 grey texels, baseline.
JPEG = base64.b64decode(
    "/9j/4AAQSkZJRgABAgAAAQABAAD/wAALCAAIAAgBAREA/9sAQwAQCwwODAoQDg0OEhEQExgoGhgWFhgxIyUdKDoz"
    "PTw5Mzg3QEhcTkBEV0U3OFBtUVdfYmdoZz5NcXlwZHhcZWdj/8QAHwAAAQUBAQEBAQEAAAAAAAAAAAECAwQFBgcI"
    "CQoL/8QAtRAAAgEDAwIEAwUFBAQAAAF9AQIDAAQRBRIhMUEGE1FhByJxFDKBkaEII0KxwRVS0fAkM2JyggkKFhcY"
    "GRolJicoKSo0NTY3ODk6Q0RFRkdISUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKTlJWWl5iZmqKj"
    "pKWmp6ipqrKztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uHi4+Tl5ufo6erx8vP09fb3+Pn6/9oACAEBAAA/AMWv"
    "/9k="
)


def image():
    refused = {
        "empty.png": b"",
        "text.png": "this is no image\n",
        "signature_only.png": b"\x89PNG\r\n\x1a\n",
        "cut_short.png": png()[:45],
        "claims_too_much.png": png(width=1 << 20, height=1 << 20, rows=b"\0" * 9),
        "claims_more_than_it_holds.png": png(width=8192, height=8192, rows=b"\0" * 9),
        "no_width.png": png(width=0),
        "too_few_rows.png": png(rows=b"\0\1\1"),
        "cut_short.jpg": JPEG[: len(JPEG) // 3],
        "signature_only.jpg": JPEG[:4],
        "signature_only.hdr": b"#?RADIANCE\n",
        "cut_short.hdr": HDR[:-3],
        "huge.hdr": HDR.replace(b"-Y 1 +X 2", b"-Y 999999999 +X 999999999"),
        "signature_only.tif": b"II*\0",
        "directory_beyond_the_end.tif": struct.pack("<2sHI", b"II", 42, HUGE),
        "directory_in_itself.tif": struct.pack("<2sHIHI", b"II", 42, 8, HUGE & 0xFFFF, 8),
        "cut_short.tif": tiff()[:-60],
        "huge.tif": tiff(width=HUGE, height=HUGE),
        "nan.tif": tiff(texels=struct.pack("<2f", 1, float("nan"))),
        "texels_missing.tif": tiff(height=9),
        "signature_only.exr": struct.pack("<I", 20000630),
        "cut_in_header.exr": exr()[:100],
        "cut_in_texels.exr": exr()[:-5],
        "nan.exr": exr(value=float("nan")),
        "infinite.exr": exr(value=float("inf")),
        "no_known_channels.exr": exr(channels=("albedo", "depth")),
        "subsampled.exr": exr(sampling=2),
        "huge.exr": exr(window=(-(2**31), -(2**31), 2**31 - 1, 2**31 - 1)),
        "large.exr": exr(window=(0, 0, 8000, 8000)),
        "huge_display.exr": exr(display=(-(2**31), 0, 2**31 - 1, 8000)),
        "backward_window.exr": exr(window=(5, 5, 0, 0)),
    }
    for name, data in refused.items():
        bad(f"image/{name}", data)
    bad("image/tolerated/wrong_name.jpg", png())
    bad("image/tolerated/cropped.exr", exr(display=(-1, -1, 3, 3)))
    bad("image/tolerated/lone_channel.exr", exr(channels=("density",)))
    bad("image/tolerated/grey_floats.tif", tiff())
    seed("image/grey.png", png())
    seed("image/deep.png", png(depth=16))
    seed("image/grey.jpg", JPEG)
    seed("image/floats.tif", tiff())
    seed("image/bytes.tif", tiff(texels=b"\1\2", bits=8, kind=1))
    seed("image/small.hdr", HDR)
    seed("image/grey.exr", exr())
    seed("image/rgba.exr", exr(channels=("A", "B", "G", "R")))


# .hair -------------------------------------------------------------------------


def hair_file(hairs=2, points=5, arrays=31, segments=(1, 2), default=2, magic=b"HAIR"):
    head = magic + struct.pack("<4I5f", hairs, points, arrays, default, 0.1, 0.0, 1, 1, 1)
    data = head.ljust(128, b"\0")
    if arrays & 1:
        data += struct.pack(f"<{len(segments)}H", *segments)
    data += struct.pack("<15f", *range(15)) if arrays & 2 else b""
    data += struct.pack("<5f", *[0.1] * 5) if arrays & 4 else b""
    data += struct.pack("<5f", *[0.5] * 5) if arrays & 8 else b""
    data += struct.pack("<15f", *[0.5] * 15) if arrays & 16 else b""
    return data


def hair():
    whole = hair_file()
    refused = {
        "empty": b"",
        "magic_only": b"HAIR",
        "wrong_magic": hair_file(magic=b"FUZZ"),
        "header_only": whole[:128],
        "header_cut_short": whole[:100],
        "cut_short": whole[:-1],
        "no_points": hair_file(arrays=1),
        "huge_counts": hair_file(hairs=HUGE, points=HUGE),
        "huge_points": hair_file(points=HUGE),
        "huge_hairs": hair_file(hairs=HUGE),
        "sum_too_small": hair_file(segments=(1, 1)),
        "sum_too_large": hair_file(segments=(65535, 65535)),
        "default_segments_overflow": hair_file(hairs=HUGE, arrays=2, default=HUGE),
        "default_segments_disagree": hair_file(arrays=2, default=7),
    }
    for name, data in refused.items():
        bad(f"hair/{name}.hair", data)
    bad("hair/tolerated/bytes_behind.hair", whole + b"more")
    bad("hair/tolerated/no_strand.hair", hair_file(hairs=0, points=0, segments=()))
    nan = bytearray(whole)
    nan[132:136] = struct.pack("<f", float("nan"))
    bad("hair/tolerated/nan.hair", bytes(nan))
    seed("hair/all.hair", whole)
    seed("hair/points.hair", hair_file(hairs=1, points=5, arrays=2, default=4))


for make in (obj, ply, gltf, image, hair):
    make()
