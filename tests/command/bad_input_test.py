"""Every kind of bad input: one line that names what and why, exit code 2 or 3, nothing half-written."""

import os
import unittest

import gltf_files
from harness import SMALL, CommandTest


class Usage(CommandTest):
    def refuse(self, extra, pattern, codes=(2,)):
        self.assert_refused(["render", "--out", "a.png", "--stats", "a.json", *extra], codes, pattern)

    def test_no_subcommand(self):
        self.assert_refused([], (2,), r"usage: .*manylights --help")

    def test_unknown_subcommand_and_option(self):
        self.assert_refused(["paint"], (2,), r"usage: .*--help")
        self.refuse(["--colour", "red"], r"usage: .*--colour.*manylights render --help")

    def test_missing_out(self):
        self.assert_refused(["render"], (2,), r"--out is required")

    def test_sizes(self):
        for size in ("0x0", "0x36", "64x0", "64", "-64x36", "8193x36", "64x36x2", "99999999999x1"):
            self.refuse(["--size", size], rf"--size '{size}': must be WIDTHxHEIGHT, each from 1 to 8192")

    def test_light_counts(self):
        for count in ("-1", "16777217", "many", "1.5", "1e3"):
            self.refuse(["--lights", count], rf"--lights '{count}': must be a whole number from 0 to 16777216")

    def test_light_kinds(self):
        self.refuse(["--kinds", "point,spot"], r"--kinds 'point,spot': .*this version shades point lights")

    def test_names(self):
        self.refuse(["--technique", "magic"], r"--technique 'magic': unknown technique; there are .*hybrid_light_trees")
        self.refuse(["--view", "depth"], r"--view 'depth': must be one of .*structure")
        self.refuse(["--detail", "high"], r"--detail 'high': must be one of low, full")

    def test_technique_options(self):
        self.refuse(["--set", "tile_sise=48"], r"tile_sise.*unknown option.*tile_size")
        self.refuse(["--set", "tile_size"], r"--set 'tile_size': must be KEY=VALUE")
        self.refuse(["--technique", "tiled_light_trees", "--set", "loop=wave"], r"loop=wave.*unknown option.*tile_size")


class Values(CommandTest):
    def refuse(self, extra, pattern, codes=(2,), **environment):
        self.assert_refused(["render", *SMALL, "--out", "a.png", "--stats", "a.json", *extra], codes, pattern,
                            **environment)

    def test_tile_size_zero_or_absurd(self):
        for value in ("0", "-1", "1000000", "48.5", ""):
            self.refuse(["--set", f"tile_size={value}"], rf"tile_size={value}: must be a whole number from \d+ to \d+")

    def test_cells_and_loop_of_lists(self):
        for value in ("tightly", "Box", ""):
            self.refuse(["--technique", "clustered", "--set", f"cell_test={value}"], rf"cell_test={value}: must be one of box, tight")
            self.refuse(["--technique", "clustered", "--set", f"loop={value}"], rf"loop={value}: must be one of lane, wave")
        for setting in ("cell_test=tight", "loop=wave"):
            self.refuse(["--technique", "clustered", "--set", "producer=library", "--set", setting],
                        rf"clustered: option {setting} needs producer=paper")

    def test_camera(self):
        self.refuse(["--camera", "nowhere"], r"camera.*nowhere")
        for position in ("path:1", "path:-0.5", "path:nan", "path:", "path:0.5x"):
            self.refuse(["--camera", position], r"path.*\[0, 1\)")

    def test_distribution_and_radius(self):
        self.refuse(["--distribution", "everywhere"], r"distribution.*everywhere.*volume")
        for radius in ("5:1", "nan:1", "-1:1", "1:inf", "big", "1", "1:2:3"):
            self.refuse(["--radius", radius], r"radius.*MIN:MAX")

    def test_output_folder_does_not_exist(self):
        self.refuse(["--out", "none/a.png"], r"none/a\.png")
        self.refuse(["--stats", "none/a.json"], r"none/a\.json.*does not exist")

    def test_output_cannot_be_written(self):
        self.refuse(["--out", "/proc/a.png"], r"/proc/a\.png")
        self.refuse(["--stats", "/proc/a.json"], r"/proc/a\.json")
        os.mkdir(self.path("folder.png"))
        self.refuse(["--out", "folder.png"], r"folder\.png")

    def test_output_extension(self):
        for name in ("a.jpg", "a", ".png.gz"):
            self.refuse(["--out", name], r"\.png.*\.exr")

    def test_structure_of_a_technique_without_cells(self):
        self.refuse(["--technique", "brute_force", "--view", "structure"], r"brute_force has no cells")


class Scenes(CommandTest):
    def refuse(self, scene, pattern):
        self.assert_refused(["render", "--scene", scene, "--size", "64x36", "--lights", "10", "--out", "a.png"], (2,),
                            pattern)

    def test_unknown_scene(self):
        self.refuse("nowhere", r"nowhere.*canyon")

    def test_missing_file(self):
        self.refuse("missing.glb", r"missing\.glb")

    def test_folder_instead_of_a_file(self):
        os.mkdir(self.path("folder.glb"))
        self.refuse("folder.glb", r"folder\.glb")

    def test_empty_file(self):
        self.write("empty.glb", b"")
        self.refuse("empty.glb", r"empty\.glb")
        self.write("empty.gltf", b"")
        self.refuse("empty.gltf", r"empty\.gltf")

    def test_truncated_file(self):
        whole = gltf_files.binary(gltf_files.triangle())
        for length in (3, 11, 19, 60, len(whole) - 5):
            self.write("cut.glb", whole[:length])
            self.refuse("cut.glb", r"cut\.glb")
        self.write("cut.gltf", gltf_files.triangle()[:100])
        self.refuse("cut.gltf", r"cut\.gltf")

    def test_other_kind_of_file(self):
        self.write("picture.glb", b"\x89PNG\r\n\x1a\n" + bytes(100))
        self.refuse("picture.glb", r"picture\.glb")
        self.write("text.gltf", b"a scene, truly\n")
        self.refuse("text.gltf", r"text\.gltf")

    def test_vertex_index_out_of_range(self):
        self.write("index.gltf", gltf_files.triangle_with_indices(0, 1, 3))
        self.refuse("index.gltf", r"index\.gltf")

    def test_references_out_of_range(self):
        for name, change in {
                "node": {"scenes": [{"nodes": [7]}]},
                "mesh": {"nodes": [{"mesh": 7}]},
                "accessor": {"meshes": [{"primitives": [{"attributes": {"POSITION": 7}, "indices": 1}]}]},
                "material": {"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 7}]}]},
                "view": {"bufferViews": [{"buffer": 7, "byteLength": 36}, {"buffer": 0, "byteLength": 6}]},
                "length": {"bufferViews": [{"buffer": 0, "byteLength": 36000}, {"buffer": 0, "byteLength": 6}]},
        }.items():
            with self.subTest(name):
                self.write("range.gltf", gltf_files.triangle(**change))
                self.refuse("range.gltf", r"range\.gltf")

    def test_no_geometry(self):
        self.write("bare.gltf", gltf_files.triangle(nodes=[{}]))
        self.refuse("bare.gltf", r"bare\.gltf.*(triangle|geometry)")

    def test_degenerate_camera(self):
        camera = {"type": "perspective", "perspective": {"yfov": 0.0, "znear": 0.1}}
        self.write("camera.gltf", gltf_files.triangle(cameras=[camera], scenes=[{"nodes": [0, 1]}],
                                                      nodes=[{"mesh": 0}, {"camera": 0}]))
        self.refuse("camera.gltf", r"camera\.gltf.*camera")

    def test_degenerate_node_matrix(self):
        camera = {"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.1}}
        self.write("flat.gltf", gltf_files.triangle(cameras=[camera], scenes=[{"nodes": [0, 1]}],
                                                    nodes=[{"mesh": 0}, {"camera": 0, "scale": [0, 0, 0]}]))
        self.refuse("flat.gltf", r"flat\.gltf.*camera")

    def test_scene_without_lights_of_its_own(self):
        self.write("dark.gltf", gltf_files.triangle())
        self.assert_refused(["render", "--scene", "dark.gltf", "--distribution", "file", "--size", "64x36", "--out",
                             "a.png"], (2,), r"distribution.*file")


class Devices(CommandTest):
    def refuse(self, extra, pattern, codes, **environment):
        self.assert_refused(["render", *SMALL, "--out", "a.png", *extra], codes, pattern, **environment)

    def test_unknown_device(self):
        self.refuse(["--device", "abacus"], r"abacus", (3,))
        self.refuse(["--device", "999"], r"999", (3,))

    def test_no_device(self):
        self.refuse([], r"no .*device", (3,), VK_LOADER_DRIVERS_DISABLE="*")
        self.assert_refused(["list", "devices"], (3,), r"no .*device", VK_LOADER_DRIVERS_DISABLE="*")

    def test_more_than_the_device_holds(self):
        self.refuse(["--size", "8192x8192"], r"(8192|MiB|GiB|bytes)", (2, 3))


if __name__ == "__main__":
    unittest.main()
