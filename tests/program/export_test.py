"""Models and tables of a stream's head."""
import csv
import io
import json
import math
import os
import shutil
import struct
import subprocess
import unittest

from harness import GREY_FIRST, MATERIAL, TALK_FBS, TALK_ONE_FBS, TWO_SCENES_FBS, ProgramTest, flat_y4m

FLOAT, USHORT, UBYTE = 5126, 5123, 5121
SIZES = {FLOAT: 4, USHORT: 2, UBYTE: 1}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
PICTURES, RATE = 120, 30
FIXED = ["frame", "rx_deg", "ry_deg", "rz_deg", "tx_px", "ty_px", "scale"] + [
    axis + str(k) for k in range(68) for axis in "xy"] + ["timestamp", "confidence", "success", "gaze_x_deg", "gaze_y_deg"]


class Glb:
    """A binary glTF file: its JSON, and what accessors hold."""

    def __init__(self, data):
        magic, version, length = struct.unpack_from("<4sII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data))
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON"
        self.json = json.loads(data[20:20 + size])
        binary, kind = struct.unpack_from("<I4s", data, 20 + size)
        assert kind == b"BIN\0" and 28 + size + binary == len(data)
        self.binary = data[28 + size:]

    def bytes_of(self, view):
        v = self.json["bufferViews"][view]
        begin = v.get("byteOffset", 0)
        assert begin % 4 == 0 and begin + v["byteLength"] <= self.json["buffers"][0]["byteLength"] <= len(self.binary)
        return self.binary[begin:begin + v["byteLength"]]

    def numbers(self, view, offset, component, count):
        data = self.bytes_of(view)
        assert offset + count * SIZES[component] <= len(data), "an accessor beyond its view"
        return list(struct.unpack_from(f"<{count}{ {FLOAT: 'f', USHORT: 'H', UBYTE: 'B'}[component]}", data, offset))

    def values(self, index):
        """Rows of an accessor, sparse ones too; bounds are checked on the way."""
        a = self.json["accessors"][index]
        width, count = WIDTHS[a["type"]], a["count"]
        flat = [0] * (width * count)
        if "bufferView" in a:
            flat = self.numbers(a["bufferView"], a.get("byteOffset", 0), a["componentType"], width * count)
        if "sparse" in a:
            s = a["sparse"]
            places = self.numbers(s["indices"]["bufferView"], s["indices"].get("byteOffset", 0),
                                  s["indices"]["componentType"], s["count"])
            assert places == sorted(set(places)) and places[-1] < count
            moved = self.numbers(s["values"]["bufferView"], s["values"].get("byteOffset", 0), FLOAT, width * s["count"])
            for i, place in enumerate(places):
                flat[place * width:(place + 1) * width] = moved[i * width:(i + 1) * width]
        rows = [tuple(flat[i * width:(i + 1) * width]) for i in range(count)]
        if "min" in a:
            assert [min(c) for c in zip(*rows)] == a["min"] and [max(c) for c in zip(*rows)] == a["max"], "bounds"
        return rows

    def node(self, name):
        return next(n for n in self.json["nodes"] if n.get("name") == name)

    def channels(self, name):
        """Times and values of the channels of a node by path."""
        animation, out = self.json["animations"][0], {}
        for c in animation["channels"]:
            if self.json["nodes"][c["target"]["node"]].get("name") != name:
                continue
            sampler = animation["samplers"][c["sampler"]]
            out[c["target"]["path"]] = ([t for t, in self.values(sampler["input"])], self.values(sampler["output"]))
        return out


def rows_of(text):
    return list(csv.DictReader(io.StringIO(text)))


def at_time(times, values, width, time):
    """Values of linear keyframes at a time."""
    after = next((i for i, t in enumerate(times) if t >= time), len(times) - 1)
    before = max(after - 1, 0)
    f = 0 if times[after] == times[before] else (time - times[before]) / (times[after] - times[before])
    return [values[before * width + k] * (1 - f) + values[after * width + k] * f for k in range(width)]


class Model(ProgramTest):
    def export(self, stream=TALK_FBS, *options, name="head.glb"):
        self.succeed("export", stream, name, *options)
        return Glb((self.folder / name).read_bytes())

    def test_every_accessor_holds_what_it_says(self):
        glb = self.export()
        for i in range(len(glb.json["accessors"])):
            glb.values(i)

    def test_texture_is_a_png(self):
        glb = self.export()
        image = glb.json["images"][0]
        self.assertEqual(image["mimeType"], "image/png")
        data = glb.bytes_of(image["bufferView"])
        self.assertTrue(data.startswith(b"\x89PNG\r\n\x1a\n"))
        width, height = struct.unpack_from(">II", data, 16)
        self.assertTrue(30 < width < 176 and 30 < height < 144, (width, height))

    def test_animation_lasts_as_long_as_the_stream(self):
        for path, (times, _) in self.export().channels("head_0").items():
            self.assertEqual(times[0], 0, path)
            self.assertAlmostEqual(times[-1], PICTURES / RATE, places=5, msg=path)
            self.assertEqual(times, sorted(set(times)), path)

    def test_weights_are_those_of_all_targets(self):
        glb = self.export()
        mesh = glb.json["meshes"][0]
        names = mesh["extras"]["targetNames"]
        self.assertIn("jawOpen", names)
        self.assertEqual(len(mesh["weights"]), len(names))
        for primitive in mesh["primitives"]:
            self.assertEqual(len(primitive["targets"]), len(names))
        times, weights = glb.channels("head_0")["weights"]
        self.assertEqual(len(weights), len(times) * len(names))

    def test_model_moves_as_the_table_says(self):
        """Landmarks of the model, through its node and its targets, lie where the table has them."""
        glb = self.export(TALK_ONE_FBS)
        table = rows_of(self.succeed("export", TALK_ONE_FBS, "-").decode())
        primitive = glb.json["meshes"][0]["primitives"][0]
        rest = glb.values(primitive["attributes"]["POSITION"])
        targets = [glb.values(t["POSITION"]) for t in primitive["targets"]]
        track = {path: (times, [x for row in values for x in row]) for path, (times, values) in glb.channels("head_0").items()}
        landmarks = range(68)  # the first vertices of the mesh
        for frame in (0, 25, 61, 97, 119):
            time = frame / RATE
            moved = {path: at_time(times, values, {"rotation": 4, "weights": len(targets)}.get(path, 3), time)
                     for path, (times, values) in track.items()}
            for k in landmarks:
                p = list(rest[k])
                for target, weight in zip(targets, moved["weights"]):
                    p = [a + weight * d for a, d in zip(p, target[k])]
                x, y, _ = self.rotated(moved["rotation"], p)
                x, y = (x * moved["scale"][0] + moved["translation"][0], -(y * moved["scale"][1] + moved["translation"][1]))
                self.assertAlmostEqual(x, float(table[frame][f"x{k}"]), delta=0.1, msg=f"picture {frame}, landmark {k}")
                self.assertAlmostEqual(y, float(table[frame][f"y{k}"]), delta=0.1, msg=f"picture {frame}, landmark {k}")

    @staticmethod
    def rotated(q, p):
        length = math.sqrt(sum(c * c for c in q))
        x, y, z, w = (c / length for c in q)
        t = [2 * (y * p[2] - z * p[1]), 2 * (z * p[0] - x * p[2]), 2 * (x * p[1] - y * p[0])]
        return [p[0] + w * t[0] + y * t[2] - z * t[1], p[1] + w * t[1] + z * t[0] - x * t[2],
                p[2] + w * t[2] + x * t[1] - y * t[0]]

    def test_keyframes_are_thinned(self):
        for path, (times, _) in self.export(TALK_ONE_FBS).channels("head_0").items():
            self.assertLess(len(times), PICTURES, path)

    def test_head_is_hidden_while_there_is_none(self):
        glb = self.export(TWO_SCENES_FBS)
        times, scales = glb.channels("head_0_shown")["scale"]
        self.assertEqual(scales[0], (0, 0, 0))
        self.assertEqual(scales[1], (1, 1, 1))
        self.assertAlmostEqual(times[1], GREY_FIRST / RATE, delta=1.01 / RATE)

    def test_hidden_head_is_told(self):
        done = self.fbs("export", TWO_SCENES_FBS, "head.glb")
        self.assertEqual(done.returncode, 0)
        self.assertIn(b"head.glb: ", done.stderr)
        self.assertEqual(self.fbs("export", TALK_FBS, "head.glb").stderr, b"")

    def test_text_is_self_contained(self):
        self.succeed("export", TALK_FBS, "head.gltf")
        model = json.loads((self.folder / "head.gltf").read_text())
        self.assertTrue(model["buffers"][0]["uri"].startswith("data:application/octet-stream;base64,"))
        self.assertEqual(list(self.files()), ["head.gltf"])

    def test_draco(self):
        glb = self.export(TALK_FBS, "--draco")
        self.assertEqual(glb.json["extensionsRequired"], ["KHR_draco_mesh_compression"])
        extension = glb.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]
        self.assertTrue(glb.bytes_of(extension["bufferView"]).startswith(b"DRACO"))

    def test_same_bytes_again(self):
        first = self.export() and (self.folder / "head.glb").read_bytes()
        self.export()
        self.assertEqual((self.folder / "head.glb").read_bytes(), first)

    def test_from_a_pipe(self):
        self.succeed("export", "-", "head.glb", stdin=TALK_FBS.read_bytes())
        self.assertTrue((self.folder / "head.glb").is_file())

    def test_stream_without_a_face(self):
        self.write("grey.y4m", flat_y4m(128, 96, 5))
        self.succeed("encode", "grey.y4m", "grey.fbs", "--allow-no-face", "--quiet")
        for name in ("head.glb", "head.gltf", "head_%05d.obj"):
            self.fail_cleanly("export", "grey.fbs", name, says=["grey.fbs", "no face"])
        rows = rows_of(self.succeed("export", "grey.fbs", "-").decode())
        self.assertEqual([r["x30"] for r in rows], ["nan"] * 5)
        self.assertEqual([r["success"] for r in rows], ["0"] * 5)

    def test_options_that_do_not_apply(self):
        self.fail_cleanly("export", TALK_FBS, "out.csv", "--draco", says=["--draco", ".glb"])
        self.fail_cleanly("export", TALK_FBS, "head_%05d.obj", "--draco", says=["--draco"])
        self.fail_cleanly("export", TALK_FBS, "head.glb", "--format", "json", says=["--format json", ".json"])
        self.fail_cleanly("export", TALK_FBS, "out.csv", "--format", "json", says=["--format json"])
        self.fail_cleanly("export", TALK_FBS, "out.csv", "--format", "glb", says=["--format glb"])
        self.fail_cleanly("export", TALK_FBS, "-", "--format", "xml", says=["--format"])
        self.fail_cleanly("export", TALK_FBS, "head.obj", says=["head.obj", "%05d"])


class Validator(ProgramTest):
    """GLTF_VALIDATOR: folder of the node module gltf-validator (npm install gltf-validator)."""

    SCRIPT = """const v = require(process.argv[1]), fs = require('fs');
v.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2]))).then(r => console.log(JSON.stringify(r.issues)))"""

    def setUp(self):
        super().setUp()
        self.module = os.environ.get("GLTF_VALIDATOR")
        if not self.module or not shutil.which("node"):
            self.skipTest("no GLTF_VALIDATOR, or no node")

    def test_finds_no_fault(self):
        for stream, name, *options in ((TALK_FBS, "head.glb"), (TALK_FBS, "head.gltf"), (TALK_FBS, "draco.glb", "--draco"),
                                       (TWO_SCENES_FBS, "two.glb")):
            with self.subTest(name):
                self.succeed("export", stream, name, *options)
                done = subprocess.run(["node", "-e", self.SCRIPT, os.path.abspath(self.module), name], cwd=self.folder,
                                      capture_output=True, check=True)
                issues = json.loads(done.stdout)
                self.assertEqual((issues["numErrors"], issues["numWarnings"]), (0, 0), issues["messages"])


class Obj(ProgramTest):
    def test_is_a_file_for_each_picture_and_one_material(self):
        (self.folder / "mesh").mkdir()
        self.succeed("export", TALK_FBS, "mesh/head_%05d.obj")
        names = set(self.files())
        self.assertEqual(names, {f"mesh/head_{i:05d}.obj" for i in range(1, PICTURES + 1)} | {"mesh/head.mtl", "mesh/head.png"})
        text = (self.folder / "mesh/head_00040.obj").read_text()
        self.assertIn("mtllib head.mtl\n", text)
        self.assertIn("map_Kd head.png\n", (self.folder / "mesh/head.mtl").read_text())
        self.assertEqual(text.count("\nv "), 105)
        corners = [int(c.split("/")[0]) for line in text.splitlines() if line.startswith("f ") for c in line.split()[1:]]
        self.assertEqual(sorted(set(corners)), list(range(1, 106)))

    def test_has_no_vertices_without_a_head(self):
        self.succeed("export", TWO_SCENES_FBS, "head_%03d.obj")
        self.assertNotIn("\nv ", (self.folder / "head_001.obj").read_text())
        self.assertIn("\nv ", (self.folder / "head_020.obj").read_text())

    def test_full_disk_leaves_nothing(self):
        self.fail_cleanly("export", TALK_FBS, "head_%05d.obj", says=["head_00001.obj"], largest_file=2_000)


class Table(ProgramTest):
    def test_columns(self):
        text = self.succeed("export", TALK_FBS, "-").decode()
        head = text.splitlines()[0].split(",")
        self.assertEqual(head[:len(FIXED)], FIXED)
        self.assertIn("jawOpen", head[len(FIXED):])
        rows = rows_of(text)
        self.assertEqual([int(r["frame"]) for r in rows], list(range(PICTURES)))
        for i, r in enumerate(rows):
            self.assertAlmostEqual(float(r["timestamp"]), i / RATE, places=5)
            self.assertTrue(all(math.isfinite(float(v)) for v in r.values()), r)

    def test_json_has_the_numbers_of_csv(self):
        self.succeed("export", TALK_FBS, "out.csv")
        self.succeed("export", TALK_FBS, "out.json")
        rows = rows_of((self.folder / "out.csv").read_text())
        read = json.loads((self.folder / "out.json").read_text())
        self.assertEqual((read["width"], read["height"]), (176, 144))
        self.assertEqual(len(read["frames"]), len(rows))
        for row, frame in zip(rows, read["frames"]):
            face = frame["face"]
            names = {"frame": frame["frame"], "timestamp": frame["timestamp"], "confidence": frame["confidence"],
                     "success": int(frame["success"]), **face["pose"], **face["gaze"], **face["blendshapes"]}
            for k, (x, y) in enumerate(face["landmarks"]):
                names[f"x{k}"], names[f"y{k}"] = x, y
            self.assertEqual(names, {name: float(value) for name, value in row.items()})

    def test_standard_output_has_the_same(self):
        self.succeed("export", TALK_FBS, "out.csv")
        self.succeed("export", TALK_FBS, "out.json")
        self.assertEqual(self.succeed("export", TALK_FBS, "-"), (self.folder / "out.csv").read_bytes())
        self.assertEqual(self.succeed("export", TALK_FBS, "-", "--format", "json"), (self.folder / "out.json").read_bytes())
        for model in ("glb", "gltf"):
            self.succeed("export", TALK_FBS, "out." + model, "--draco")
            self.assertEqual(self.succeed("export", TALK_FBS, "-", "--format", model, "--draco"),
                             (self.folder / f"out.{model}").read_bytes())

    def test_jaw_opens_with_the_lips(self):
        rows = rows_of(self.succeed("export", TALK_FBS, "-").decode())
        gaps = [(float(r["y66"]) - float(r["y62"])) / float(r["scale"]) for r in rows]
        jaws = [float(r["jawOpen"]) for r in rows]
        self.assertGreater(correlation(gaps, jaws), 0.95)


def correlation(a, b):
    mean_a, mean_b = sum(a) / len(a), sum(b) / len(b)
    covariance = sum((x - mean_a) * (y - mean_b) for x, y in zip(a, b))
    return covariance / math.sqrt(sum((x - mean_a) ** 2 for x in a) * sum((y - mean_b) ** 2 for y in b))


if __name__ == "__main__":
    unittest.main()
