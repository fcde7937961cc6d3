"""--points FILE: saved the first time, loaded from then on, refused where it does not fit what else is selected."""

import json
import os
import re
import struct
import unittest

from harness import CommandTest

CORNELL = ["--scene", "cornell", "--detail", "low", "--lights", "500"]


def without_last_point(content):
    """The same file with one pixel more of sky: the layout of lab/renderer/point_file.h."""
    count = struct.unpack_from("<I", content, 20)[0]
    shorter = content[:20] + struct.pack("<I", count - 1) + content[24:-44]
    sealed = 0xCBF29CE484222325
    for byte in shorter:
        sealed = (sealed ^ byte) * 0x100000001B3 % 2**64
    return shorter + struct.pack("<Q", sealed)


class Points(CommandTest):
    def save(self, *extra):
        return self.assert_done("render", *CORNELL, "--size", "63x35", "--points", "a.points", "--view", "tested",
                                "--out", "a.png", "--stats", "a.json", *extra)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def rows(self, name):
        row = json.loads(self.read(name))
        return {key: value for key, value in row.items() if not key.endswith("_ms")}

    def refuse(self, arguments, pattern):
        content = self.read("a.points")
        self.assert_refused(["render", *arguments, "--points", "a.points", "--out", "b.png"], (2,), pattern)
        self.assertEqual(self.read("a.points"), content)

    def test_loaded_points_are_the_saved_ones(self):
        for camera in ("low", "path:0.3"):
            first = self.save("--camera", camera)
            self.assertNotIn("points from", first.stdout)
            content = self.read("a.points")
            second = self.assert_done("render", *CORNELL, "--points", "a.points", "--view", "tested", "--out", "b.png",
                                      "--stats", "b.json")
            self.assertIn(f"camera {camera}, 63x35, points from a.points, ", second.stdout)
            self.assertEqual(self.rows("a.json"), self.rows("b.json"))
            self.assertEqual(self.read("a.png"), self.read("b.png"))
            self.assertEqual(self.read("a.points"), content)
            self.assert_done("render", *CORNELL, "--points", "a.points", "--camera", camera, "--size", "63x35", "--out",
                             "b.png")
            os.remove(self.path("a.points"))

    def test_the_distribution_view_follows_the_saved_camera(self):
        self.save("--camera", "low", "--distribution", "view")
        self.assert_done("render", *CORNELL, "--points", "a.points", "--distribution", "view", "--view", "tested",
                         "--out", "b.png", "--stats", "b.json")
        self.assertEqual(self.rows("a.json"), self.rows("b.json"))

    def test_verify_proves_at_saved_points(self):
        self.save()
        done = self.assert_done("verify", *CORNELL, "--points", "a.points")
        self.assertIn("63x35, points from a.points, ", done.stdout)
        techniques = re.findall(r"(?m)^[a-z0-9_]+", self.assert_done("list", "techniques").stdout)
        self.assertEqual(done.stdout.count("  exact\n"), len(techniques))

    def test_loaded_points_are_not_drawn_again(self):
        def points_of(done):
            return int(re.search(r"(?m)^brute_force +defaults +([\d,]+) ", done.stdout)[1].replace(",", ""))
        one = ["verify", *CORNELL, "--techniques", "brute_force", "--points", "a.points"]
        drawn = points_of(self.assert_done(*one))
        self.write("a.points", without_last_point(self.read("a.points")))
        self.assertEqual(points_of(self.assert_done(*one)), drawn - 1)

    def test_what_does_not_agree_is_refused(self):
        self.save()
        self.refuse(["--scene", "bars"], r'points "a\.points": scene .cornell \(low detail\).: must be .bars.')
        self.refuse([*CORNELL, "--camera", "low"], r"--camera 'low': must be 'front'")
        self.refuse([*CORNELL, "--size", "960x540"], r"--size '960x540': must be 63x35")

    def test_a_damaged_file_is_refused_and_left_alone(self):
        self.save()
        content = self.read("a.points")
        self.write("a.points", content[:-1])
        self.refuse(CORNELL, r'points "a\.points": length: must be \d+ bytes')
        self.write("a.points", content[:-9] + b"x" + content[-8:])
        self.refuse(CORNELL, r'points "a\.points": hash: ')

    def test_a_file_that_cannot_be_made_is_refused(self):
        for path, pattern in (("no/such.points", "no does not exist"), (".", "is a folder")):
            self.assert_refused(["render", *CORNELL, "--points", path, "--out", "a.png"], (2,), pattern)


if __name__ == "__main__":
    unittest.main()
