"""`bench`: files, the schema of rows, runs that are stopped and resumed, and that a wrong light set yields no figure."""

import csv
import json
import os
import re
import signal
import subprocess
import time
import unittest

from harness import PROGRAM, CommandTest

VIEW = ["--detail", "low", "--size", "64x36"]
SMALL_BENCH = ["bench", "quality", "--scenes", "bars", *VIEW, "--out", "out"]
TINY = [*SMALL_BENCH, "--quick", "--views", "path", "--lights", "300,600"]
LONGER = [*SMALL_BENCH, "--views", "path", "--lights", "300"]  # to be interrupted
USUAL = ["exact", "clustered", "tiled_light_trees", "hybrid_light_trees", "depth_windows", "depth_windows_wave"]
BUILT_ON_DEVICE = ["tiled", "culling_2_5d", "clustered_samples", "z_bins", "octree", "hybrid_lighting",
                   "light_linked_list", "light_volumes"]  # so there are no stages on the CPU
TIMES = ("build_ms", "cold_build_ms", "stages_ms", "shade_ms", "shade_over_exact")


def without_times(row):
    return {key: value for key, value in row.items() if key not in TIMES}


class BenchTest(CommandTest):
    def rows(self):
        with open(self.path("out/quality.json")) as file:
            return json.load(file)["rows"]

    def counted(self):
        return [without_times(row) for row in self.rows()]


class Bench(BenchTest):
    def test_files_hold_a_row_per_case_and_technique(self):
        done = self.assert_done(*TINY)
        self.assertEqual(done.stderr, "")
        rows = self.rows()
        self.assertEqual(len(rows), 2 * 2 * len(USUAL))
        self.assertEqual([row["technique"] for row in rows[:len(USUAL)]], USUAL)
        for row in rows:
            self.assertEqual(row["missing_points"], 0)
            self.assertGreaterEqual(row["tested_mean"], row["affecting_mean"])
            self.assertGreaterEqual(row["wave_tested_64"], row["wave_affecting_64"])
        with open(self.path("out/quality.csv"), newline="") as file:
            table = list(csv.DictReader(file))
        self.assertEqual([line["technique"] for line in table], [row["technique"] for row in rows])
        self.assertEqual([float(line["tested_mean"]) for line in table], [row["tested_mean"] for row in rows])
        with open(self.path("out/quality.md")) as file:
            self.assertEqual(file.read(), done.stdout)

    def test_every_technique_has_the_light_sets_of_exact(self):
        self.assert_done(*SMALL_BENCH, "--quick", "--views", "path", "--lights", "300", "--techniques", "all")
        hashes = {}
        for row in self.rows():
            hashes.setdefault((row["lights"], row["camera"]), set()).add(row["light_set_hash"])
        self.assertEqual({len(found) for found in hashes.values()}, {1})

    def test_times_are_taken_where_they_are_asked_for(self):
        self.assert_done(*SMALL_BENCH, "--quick", "--views", "cameras", "--lights", "300", "--repeat", "2", "--techniques",
                         ",".join(USUAL + BUILT_ON_DEVICE))
        for row in self.rows():
            self.assertEqual(row["shade_ms"]["repeats"], 2)
            self.assertEqual(row["shade_over_exact"]["repeats"], 2)
            if row["technique"] == "exact":
                self.assertEqual(row["shade_over_exact"], {"min": 1, "median": 1, "max": 1, "repeats": 2})
                self.assertIsNone(row["build_ms"]["median"])
            else:
                self.assertEqual(row["build_ms"]["repeats"], 2 * 3)
                self.assertEqual(row["cold_build_ms"]["repeats"], 2)
                on_device = row["technique"] in BUILT_ON_DEVICE
                self.assertEqual(list(row["stages_ms"]), [] if on_device else ["plan", "write"])
                for stage in row["stages_ms"].values():
                    self.assertEqual(stage["repeats"], 2 * 3)

    def test_two_runs_count_the_same(self):
        self.assert_done(*TINY)
        first = self.counted()
        self.assert_done(*TINY)
        self.assertEqual(self.counted(), first)

    def test_a_technique_with_a_planted_error_has_no_figure(self):
        done = self.assert_done(*TINY, "--remove-one-light", "clustered", code=1)
        self.assertRegex(done.stderr, r"\A(manylights: bars volume \d+, frame \d+: clustered: \d+ of \d+ points [^\n]+\n)+\Z")
        self.assertIn("WRONG", done.stdout)
        for row in self.rows():
            if row["technique"] != "clustered":
                self.assertIsNotNone(row["tested_mean"])
                continue
            self.assertGreater(row["missing_points"], 0)
            for key in ("tested_mean", "wave_cost_64", "references", "structure_bytes", "light_set_hash"):
                self.assertIsNone(row[key], key)

    def test_a_truth_that_is_not_brute_forces_has_no_figure_at_all(self):
        done = self.assert_done(*SMALL_BENCH, "--views", "cameras", "--lights", "300", "--remove-one-light", "grid", code=1)
        self.assertRegex(done.stderr, r"(?m)^manylights: bars volume 300, camera 0: clustered: the grid oracle differs from "
                         r"brute force at pixel \(\d+, \d+\)$")
        for row in self.rows():
            self.assertEqual((row["tested_mean"], row["missing_points"], row["shade_ms"]["median"]), (None, None, None))

    def test_rows_are_those_of_render(self):
        self.assert_done(*TINY)
        for lights, camera in (("300", "path:0"), ("600", "path:0.5")):
            self.assert_done("render", "--scene", "bars", *VIEW, "--lights", lights, "--camera", camera, "--technique", "clustered",
                             "--set", "tile_size=48", "--set", "slice_count=16", "--out", "a.png", "--stats", "a.json")
            with open(self.path("a.json")) as file:
                row = {**without_times(json.load(file)), "missing_points": 0}
            self.assertIn(row, self.counted())

    def test_lists_with_other_options_have_lines_of_their_own(self):
        self.assert_done(*SMALL_BENCH, "--views", "cameras", "--lights", "8192", "--techniques", "exact,clustered", "--repeat", "1")
        rows = self.rows()
        self.assertEqual(len(rows), 4 * 4)
        self.assertEqual([row["options"].get("tile_size") for row in rows[:4]], [None, "48", "32", "16"])
        self.assertEqual({row["missing_points"] for row in rows}, {0})
        tested = [row["tested_mean"] for row in rows[:4]]
        self.assertEqual(tested, sorted(tested[:1]) + sorted(tested[1:], reverse=True))
        with open(self.path("out/quality.md")) as file:
            text = file.read()
        for label in ("exact", "clustered 48x16", "clustered 32x64 tight wave", "clustered 16x128 tight wave"):
            self.assertEqual(len(re.findall(rf"(?m)^\| {label} +\|", text)), 2, label)
        before = self.rows()
        self.assert_done(*SMALL_BENCH, "--views", "cameras", "--lights", "8192", "--techniques", "exact,clustered", "--repeat", "1",
                         "--resume")
        self.assertEqual(self.rows(), before)

    def test_a_scene_that_is_not_there_is_skipped_with_the_reason(self):
        done = self.assert_done("bench", "quality", "--scenes", "sponza", "--scene-folder", "nowhere", "--out", "out")
        self.assertRegex(done.stderr, r"\Amanylights: sponza: skipped, for nowhere/sponza/sponza.glb is not there\n\Z")
        self.assertEqual(self.rows(), [])


class BenchBuild(CommandTest):
    RUN = ["bench", "build", "--scenes", "bars", *VIEW, "--lights", "0,900", "--repeat", "2", "--out", "out"]
    ONE_THREAD = ["paper hybrid 48", "hybrid 48", "trees 48", "lists 48", "windows 48", "windows 32", "windows chosen", "floor"]

    def rows(self):
        with open(self.path("out/build.json")) as file:
            return json.load(file)["rows"]

    def test_a_row_per_builder_with_ratios_of_rounds(self):
        done = self.assert_done(*self.RUN, "--device", "no such card")  # it needs none
        rows = self.rows()
        for lights in (0, 900):
            names = [row["builder"] for row in rows if row["lights"] == lights and row["threads"] == 1]
            self.assertEqual(names, self.ONE_THREAD)
        for row in rows:
            self.assertEqual(row["build_ms"]["repeats"], 2)
            self.assertEqual(row["cold_build_ms"]["repeats"], 2)
            self.assertEqual(row["one_thread_over_this"]["repeats"], 2 if row["threads"] == 2 else 0)
            self.assertEqual(row["references"] > 0, row["lights"] > 0, row["builder"])
            if row["builder"] == "paper hybrid 48":
                self.assertEqual(row["paper_over_this"], {"min": 1, "median": 1, "max": 1, "repeats": 2})
        with open(self.path("out/build.md")) as file:
            self.assertEqual(file.read(), done.stdout)

    def test_a_second_thread_builds_the_same(self):
        self.assert_done(*self.RUN)
        keys = ("builder", "tile_px", "visible_lights", "references", "structure_bytes")
        built = {tuple(row[key] for key in keys) for row in self.rows() if row["lights"] == 900}
        self.assertEqual(len(built), len(self.ONE_THREAD))

    def test_what_is_complete_is_not_timed_again(self):
        self.assert_done(*self.RUN)
        before = self.rows()
        self.assert_done(*self.RUN, "--resume")
        self.assertEqual(self.rows(), before)


class BenchRefusals(BenchTest):
    def test_bad_options_are_refused_before_anything_is_made(self):
        for arguments, pattern in (
            (["nothing", "--out", "out"], r"suite 'nothing': must be one of quality, build"),
            (["build", "--out", "out", "--techniques", "exact"], r"--techniques 'exact': the suite build has none"),
            (["build", "--out", "out", "--views", "path"], r"--views 'path': the suite build has none"),
            (["build", "--out", "out", "--scenes", "moon"], r"--scenes 'moon': must be one of canyon, "),
            (["quality"], r"--out is required"),
            (["--out", "out"], r"suite is required"),
            (["quality", "--out", "/proc/none"], r"--out '/proc/none': is no folder and cannot be made one"),
            (["quality", "--out", "out", "--scenes", "moon"], r"--scenes 'moon': must be one of canyon, "),
            (["quality", "--out", "out", "--views", "side"], r"--views 'side': must be one of cameras, path"),
            (["quality", "--out", "out", "--lights", "1,-1"], r"--lights '-1': must be a whole number from 0"),
            (["quality", "--out", "out", "--repeat", "0"], r"--repeat '0': must be a whole number from 1 to 1000"),
            (["quality", "--out", "out", "--size", "0x9"], r"--size '0x9': must be WIDTHxHEIGHT"),
            (["quality", "--out", "out", "--techniques", "magic"], r"--techniques 'magic': unknown technique"),
            (["quality", "--out", "out", "--detail", "some"], r"--detail 'some': must be one of low, full"),
        ):
            self.assert_refused(["bench", *arguments], {2}, pattern)

    def test_without_a_device_nothing_is_written(self):
        self.assert_refused([*SMALL_BENCH, "--device", "no such card"], {3}, "no such card")


class Resume(BenchTest):
    def journal(self):
        with open(self.path("out/quality.journal"), "rb") as file:
            return file.read()

    def run_and_kill(self, lines):
        """Starts a run and kills it hard once its journal has this many lines."""
        process = subprocess.Popen([PROGRAM, *LONGER], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end = time.monotonic() + 200
        while time.monotonic() < end and process.poll() is None:
            if os.path.exists(self.path("out/quality.journal")) and self.journal().count(b"\n") >= lines:
                break
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.assertFalse(os.path.exists(self.path("out/quality.json")), "killed too late")

    def test_a_killed_run_goes_on_and_gives_the_same_rows(self):
        self.run_and_kill(5)
        done_before = self.journal()
        self.assert_done(*LONGER, "--resume")
        self.assertTrue(self.journal().startswith(done_before[:done_before.rfind(b"\n") + 1]), "measured again")
        resumed = self.counted()
        self.assert_done(*LONGER)
        self.assertEqual(self.counted(), resumed)

    def test_what_is_complete_is_not_measured_again(self):
        self.assert_done(*TINY)
        before, rows = self.journal(), self.rows()
        self.assert_done(*TINY, "--resume")
        self.assertEqual((self.journal(), self.rows()), (before, rows))

    def test_a_damaged_journal_is_refused(self):
        os.mkdir(self.path("out"))
        self.write("out/quality.journal", b"{}\n")
        self.assert_refused([*TINY, "--resume"], {2}, r"--resume 'out/quality.journal': suite is null, must be")


if __name__ == "__main__":
    unittest.main()
