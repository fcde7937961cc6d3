"""Runs a program that draws a PNG, and looks at the picture: picture_check.py PROGRAM OUT.png

Where the Vulkan validation layer is installed, it watches, and has to stay silent.

Exit status 0: the picture is neither black nor uniform. 77: the machine has no usable Vulkan device (the program's exit
status 3), so nothing was tested. 1: everything else.
"""

import os
import struct
import subprocess
import sys
import zlib

SKIPPED = 77
NO_DEVICE = 3
VALIDATION = "VK_LAYER_KHRONOS_validation"


def png_chunks(data):
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        sys.exit("not a PNG")
    position = 8
    while position < len(data):
        length, kind = struct.unpack_from(">I4s", data, position)
        yield kind, data[position + 8:position + 8 + length]
        position += 12 + length


def unfilter(kind, line, above, step):
    """Undoes a PNG row filter (PNG specification, section 9) in place."""
    if kind == 1:  # sub
        for i in range(step, len(line)):
            line[i] = (line[i] + line[i - step]) & 0xFF
    elif kind == 2:  # up
        line[:] = bytes((value + up) & 0xFF for value, up in zip(line, above))
    elif kind == 3:  # average
        for i in range(len(line)):
            left = line[i - step] if i >= step else 0
            line[i] = (line[i] + (left + above[i]) // 2) & 0xFF
    elif kind == 4:  # Paeth
        left = corner = bytes(step)
        for i in range(0, len(line), step):
            for k in range(step):
                a, b, c = left[k], above[i + k], corner[k]
                to_a, to_b, to_c = abs(b - c), abs(a - c), abs(a + b - 2 * c)
                nearest = a if to_a <= to_b and to_a <= to_c else b if to_b <= to_c else c
                line[i + k] = (line[i + k] + nearest) & 0xFF
            left, corner = line[i:i + step], above[i:i + step]
    elif kind != 0:
        sys.exit(f"unknown row filter {kind}")


def read_rgba(path):
    """Width, height and rows of an 8-bit RGBA PNG."""
    with open(path, "rb") as file:
        chunks = list(png_chunks(file.read()))
    width, height, depth, color, _, _, interlace = struct.unpack(">IIBBBBB", chunks[0][1])
    if (depth, color, interlace) != (8, 6, 0):
        sys.exit(f"{path}: not an 8-bit RGBA image")
    data = zlib.decompress(b"".join(body for kind, body in chunks if kind == b"IDAT"))
    above = bytearray(4 * width)
    rows = []
    for y in range(height):
        start = y * (4 * width + 1)
        line = bytearray(data[start + 1:start + 1 + 4 * width])
        unfilter(data[start], line, above, 4)
        rows.append(line)
        above = line
    return width, height, rows


def faults(width, height, rows):
    """What is wrong with the picture, from coarse statistics that any sensible picture of this scene passes."""
    pixels = [tuple(row[4 * x:4 * x + 4]) for row in rows[::2] for x in range(0, width, 2)]
    brightness = [(r + g + b) / 3 for r, g, b, _ in pixels]
    mean = sum(brightness) / len(brightness)
    deviation = (sum((value - mean) ** 2 for value in brightness) / len(brightness)) ** 0.5
    colorful = sum(max(p[:3]) - min(p[:3]) > 40 for p in pixels) / len(pixels)
    lower = sum(brightness[len(brightness) // 2:]) / (len(brightness) // 2)
    print(f"{width}x{height}, mean {mean:.1f}, deviation {deviation:.1f}, lower half {lower:.1f}, "
          f"colourful pixels {100 * colorful:.0f}%, colours {len(set(pixels))}")
    if mean < 10: yield "the picture is black"
    if mean > 200: yield "the picture is washed out"
    if deviation < 10: yield "the picture is uniform"
    if lower < 20: yield "the ground is not lit"
    if colorful < 0.2: yield "the lights have no colour"
    if len(set(pixels)) < 1000: yield "the picture has hardly any colours"
    if any(p[3] != 255 for p in pixels): yield "some pixels are not opaque"


def run_watched(command):
    """Runs a program with the validation layer. The loader's own messages tell whether it is there."""
    environment = dict(os.environ, VK_INSTANCE_LAYERS=VALIDATION, VK_LOADER_DEBUG="layer")
    result = subprocess.run(command, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    lines = result.stdout.splitlines()
    active = any("Insert instance layer" in line and VALIDATION in line for line in lines)
    print("validation layer:", "active" if active else "not installed")
    said = [line for line in lines if line.strip() and "LAYER:" not in line]
    print("\n".join(said))
    if any("VUID-" in line or "Validation" in line or "SYNC-HAZARD" in line for line in said):
        sys.exit("the validation layer complains")
    return result


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, out = sys.argv[1:]
    if os.path.exists(out):
        os.remove(out)
    result = run_watched([program, out])
    if result.returncode == NO_DEVICE:
        sys.exit(SKIPPED)
    if result.returncode != 0:
        sys.exit(f"{program} ended with status {result.returncode}")
    found = list(faults(*read_rgba(out)))
    if found:
        sys.exit(f"{out}: " + "; ".join(found))


if __name__ == "__main__":
    main()
