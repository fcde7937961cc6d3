"""Small glTF files, right and wrong ones."""

import base64
import json
import struct


def triangle(**changes):
    """A .gltf of one triangle; changes replace top-level entries."""
    positions = struct.pack("<9f", -1, -1, -3, 1, -1, -3, 0, 1, -3)
    indices = struct.pack("<3H", 0, 1, 2)
    data = base64.b64encode(positions + indices).decode()
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, -3], "max": [1, 1, -3]},
            {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(positions)},
            {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices)},
        ],
        "buffers": [{"byteLength": len(positions) + len(indices), "uri": "data:application/octet-stream;base64," + data}],
    }
    document.update(changes)
    return json.dumps(document).encode()


def triangle_with_indices(*indices):
    """As triangle, with other vertex indices."""
    document = json.loads(triangle())
    data = base64.b64decode(document["buffers"][0]["uri"].split(",")[1])[:36] + struct.pack("<3H", *indices)
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps(document).encode()


def binary(document):
    """A .glb that holds this JSON text."""
    text = document + b" " * (-len(document) % 4)
    chunk = struct.pack("<I4s", len(text), b"JSON") + text
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunk)) + chunk
