"""What the command makes of good input: files, tables, exit codes; and that verify sees a lost light."""

import json
import os
import re
import struct
import unittest

from harness import SMALL, CommandTest

CELLS = ("clustered", "tiled_light_trees", "hybrid_light_trees", "depth_windows", "depth_windows_wave")
DEVICE_BUILT = ("tiled", "culling_2_5d", "clustered_samples", "z_bins", "hybrid_lighting", "octree", "light_linked_list",
                "light_volumes")


def png_size(path):
    with open(path, "rb") as file:
        head = file.read(24)
    assert head[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", head[16:24])


class Render(CommandTest):
    def test_every_view_as_a_picture(self):
        for view in ("shaded", "tested", "affecting", "nodes", "references", "structure"):
            self.assert_done("render", *SMALL, "--view", view, "--out", "a.png")
            width, height = png_size(self.path("a.png"))
            if view == "shaded":
                self.assertEqual((width, height), (64, 36))
            else:
                self.assertGreater(height, 36)
            self.assertEqual(os.listdir(self.folder), ["a.png"])

    def test_every_view_as_plain_numbers(self):
        for view in ("shaded", "tested", "structure"):
            self.assert_done("render", *SMALL, "--view", view, "--out", "a.exr")
            with open(self.path("a.exr"), "rb") as file:
                self.assertEqual(file.read(4), b"\x76\x2f\x31\x01")

    def test_panels_side_by_side(self):
        self.assert_done("render", *SMALL, "--techniques", ",".join(CELLS), "--view", "tested", "--out", "a.png",
                         "--stats", "a.json")
        self.assertGreater(png_size(self.path("a.png"))[0], 3 * 64)
        with open(self.path("a.json")) as file:
            self.assertEqual([row["technique"] for row in json.load(file)], list(CELLS))

    def test_statistics(self):
        self.assert_done("render", *SMALL, "--technique", "clustered", "--set", "tile_size=16", "--out", "a.png",
                         "--stats", "a.json")
        with open(self.path("a.json")) as file:
            row = json.load(file)
        self.assertEqual(row["technique"], "clustered")
        self.assertEqual(row["options"], {"tile_size": "16"})
        self.assertEqual((row["width"], row["height"], row["lights"]), (64, 36, 500))
        self.assertGreater(row["affecting_mean"], 0)
        self.assertGreaterEqual(row["tested_mean"], row["affecting_mean"])
        self.assertGreater(row["structure_bytes"], 0)
        self.assertIsNotNone(row["build_ms"]["median"])
        self.assertGreater(row["wave_cost_64"], 0)
        self.assertGreater(row["wave_cost_32"], 0)

    def test_light_sets_are_the_same_for_every_technique(self):
        self.assert_done("render", *SMALL, "--techniques", "all", "--view", "tested", "--out", "a.png", "--stats",
                         "a.json")
        with open(self.path("a.json")) as file:
            self.assertEqual(len({row["light_set_hash"] for row in json.load(file)}), 1)

    def test_no_light_and_the_smallest_image(self):
        for view in ("shaded", "tested", "structure"):
            self.assert_done("render", *SMALL, "--lights", "0", "--size", "1x1", "--view", view, "--out", "a.png")


class Verify(CommandTest):
    def test_all_techniques_are_exact(self):
        done = self.assert_done("verify", *SMALL, "--techniques", "all", "--stats", "a.json")
        self.assertEqual(done.stderr, "")
        for name in ("brute_force", "exact", *CELLS, *DEVICE_BUILT):
            self.assertRegex(done.stdout, rf"(?m)^{name} .* 0  exact$")
        with open(self.path("a.json")) as file:
            rows = json.load(file)
        self.assertEqual([row["missing_points"] for row in rows], [0] * (2 + len(CELLS) + len(DEVICE_BUILT)))
        cost = {row["technique"]: row["wave_cost_64"] for row in rows}
        self.assertEqual(cost["brute_force"], 500)
        self.assertEqual(min(cost, key=cost.get), "exact")

    def test_options_go_to_the_techniques_that_have_them(self):
        done = self.assert_done("verify", *SMALL, "--set", "tile_size=16", "--set", "leaf_size=2")
        self.assertRegex(done.stdout, r"(?m)^clustered +tile_size=16  ")
        self.assertRegex(done.stdout, r"(?m)^hybrid_light_trees +tile_size=16 leaf_size=2  ")

    def test_lists_at_their_best_are_exact(self):
        for settings in (["cell_test=tight"], ["loop=wave"], ["cell_test=tight", "loop=wave", "tile_size=16", "slice_count=128"]):
            given = [word for setting in settings for word in ("--set", setting)]
            done = self.assert_done("verify", *SMALL, "--techniques", "clustered,depth_windows", *given)
            self.assertRegex(done.stdout, rf"(?m)^clustered +{' '.join(settings)}  .* 0  exact$")

    def test_a_removed_light_is_found_and_named(self):
        for name in ("exact", *CELLS):
            done = self.assert_done("verify", *SMALL, "--remove-one-light", name, code=1)
            self.assertRegex(done.stderr, rf"\Amanylights: {name}: \d+ of 2304 points differ from brute_force; first at "
                             r"pixel \(\d+, \d+\): \d+ of \d+ affecting lights, missing light \d+\n\Z")
            self.assertRegex(done.stdout, rf"(?m)^{name} .*  WRONG$")
            for other in CELLS:
                if other != name:
                    self.assertRegex(done.stdout, rf"(?m)^{other} .*  exact$")

    def test_documented_losses_are_found_and_named(self):
        for coverage in ("centre_ray", "plain"):
            for billboards in ("compute", "raster"):
                done = self.assert_done("verify", *SMALL, "--techniques", "hybrid_lighting", "--set", "tiles=8x4", "--set",
                                        "coverage=" + coverage, "--set", "billboards=" + billboards, code=1)
                self.assertRegex(done.stderr, r"\Amanylights: hybrid_lighting: \d+ of 2304 points differ from brute_force; "
                                 r"first at pixel \(\d+, \d+\): \d+ of \d+ affecting lights, missing lights? \d+.*\n\Z")
                self.assertRegex(done.stdout, r"(?m)^hybrid_lighting .*  WRONG$")

    def test_the_truth_is_brute_force_where_that_is_quick(self):
        done = self.assert_done("verify", *SMALL, "--techniques", "clustered")
        self.assertRegex(done.stdout, r"(?m)^truth: brute_force at all [\d,]+ points$")

    def test_the_grid_says_how_it_was_checked(self):
        done = self.assert_done("verify", *SMALL, "--truth", "grid")
        self.assertEqual(done.stderr, "")
        points = re.search(r"(?m)^truth: grid oracle, itself equal to brute_force at ([\d,]+) of ([\d,]+) points; "
                           r"radiance: exact$", done.stdout)
        self.assertIsNotNone(points, done.stdout)
        self.assertEqual(points[1], points[2])
        for name in ("brute_force", *CELLS):
            self.assertRegex(done.stdout, rf"(?m)^{name} .* 0  exact$")

    def test_the_grid_finds_the_light_sets_of_brute_force(self):
        for truth in ("brute_force", "grid"):
            self.assert_done("verify", *SMALL, "--truth", truth, "--techniques", "clustered", "--stats", truth + ".json")
        rows = []
        for truth in ("brute_force", "grid"):
            with open(self.path(truth + ".json")) as file:
                rows.append(json.load(file))
        self.assertEqual(rows[0]["light_set_hash"], rows[1]["light_set_hash"])
        self.assertEqual([row["missing_points"] for row in rows], [0, 0])

    def test_a_removed_light_is_found_and_named_by_the_grid(self):
        for name in CELLS:
            done = self.assert_done("verify", *SMALL, "--truth", "grid", "--techniques", ",".join(CELLS),
                                    "--remove-one-light", name, code=1)
            self.assertRegex(done.stderr, rf"\Amanylights: {name}: \d+ of 2304 points differ from the grid oracle; first "
                             r"at pixel \(\d+, \d+\): \d+ of \d+ affecting lights, missing light \d+\n\Z")
            self.assertRegex(done.stdout, rf"(?m)^{name} .*  WRONG$")
            self.assertEqual(len(re.findall(r"(?m)  exact$", done.stdout)), len(CELLS) - 1)

    def test_a_wrong_grid_is_a_failed_check(self):
        done = self.assert_done("verify", *SMALL, "--truth", "grid", "--remove-one-light", "grid", code=1)
        self.assertRegex(done.stderr, r"\Amanylights: grid oracle: differs from brute_force at pixel \(\d+, \d+\), first "
                         r"of [\d,]+ points checked\n\Z")
        self.assertEqual(done.stdout, "")

    def test_only_a_light_that_is_there_is_removed_from_the_grid(self):
        remove = ["verify", *SMALL, "--remove-one-light", "grid"]
        self.assert_refused([*remove, "--truth", "brute_force"], (2,), r"'grid': the truth is brute_force$")
        self.assert_refused([*remove, "--truth", "grid", "--lights", "0"], (2,), r"'grid': there is no light to remove$")

    def test_the_grid_leaves_brute_force_out_where_that_takes_long(self):
        done = self.assert_done("verify", *SMALL, "--lights", "65536", "--size", "512x257")
        self.assertRegex(done.stdout, r"(?m)^truth: grid oracle, itself equal to brute_force at 4,096 of [\d,]+ points; "
                         r"radiance: exact$")
        self.assertRegex(done.stdout, r"(?m)^left out: brute_force, which takes more than 8,589,934,592 tests")
        self.assertNotRegex(done.stdout, r"(?m)^brute_force ")
        for name in CELLS:
            self.assertRegex(done.stdout, rf"(?m)^{name} .* 0  exact$")

    def test_a_scene_may_have_a_distribution_of_its_own(self):
        town = ("verify", "--scene", "blocktown", "--detail", "low", "--lights", "50", "--size", "32x18",
                "--techniques", "exact")
        self.assertIn("50 lights (groups, ", self.assert_done(*town).stdout)
        self.assertIn("50 lights (volume, ", self.assert_done(*town, "--distribution", "volume").stdout)

    def test_validation_is_active_and_silent(self):
        done = self.assert_done("verify", *SMALL, "--validation")
        self.assertRegex(done.stdout, r"(?m)^validation: core and synchronization active, 0 messages")


class List(CommandTest):
    def test_lines(self):
        for what, names in {
                "scenes": ("cornell", "bars", "canyon", "citadel", "blocktown"),
                "techniques": ("brute_force", "exact", *CELLS),
                "suites": ("quality", "build"),
        }.items():
            lines = self.assert_done("list", what).stdout.splitlines()
            for name in names:
                self.assertEqual(sum(bool(re.match(rf"{name}  +\S", line)) for line in lines), 1, (what, name))

    def test_devices(self):
        self.assertRegex(self.assert_done("list", "devices").stdout, r"\A *0  \S")


class Help(CommandTest):
    def test_help_is_on_standard_output(self):
        for arguments in (["--help"], ["render", "--help"], ["verify", "--help"], ["bench", "--help"], ["list", "--help"]):
            done = self.assert_done(*arguments)
            self.assertIn("manylights", done.stdout)
            self.assertNotIn("remove-one-light", done.stdout)


if __name__ == "__main__":
    unittest.main()
