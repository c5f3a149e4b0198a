"""What `cmake --install` writes: others build with it, it shows nothing of our inside, and the program runs from there."""
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile

from harness import BUILD, MAX_SECONDS, SOURCE, TALK_FBS, TALK_Y4M, ProgramTest, read_y4m

CMAKE, CC, CXX = (os.environ.get(name, default) for name, default in (("FBS_CMAKE", "cmake"), ("CC", "cc"), ("CXX", "c++")))
SAMPLES = SOURCE / "samples"
VECTORS = SOURCE / "tests/vectors"
HEADERS = ["fbs.h", "encoder.h", "packet.h", "sound.h", "fbs.hpp", "encoder.hpp"]
STATUSES = {"-": "no error", "kNotFbs": "not an fbs stream", "kTruncated": "the stream is cut off",
            "kInvalidStream": "damaged stream", "kUnsupported": "not supported by this version",
            "kTooLarge": "too large"}
PICTURES = 30  # of the talker, that are encoded again

# A project that uses what is installed; KIND is "" or "_static".
PROJECT = """
cmake_minimum_required(VERSION 3.25)
project(user LANGUAGES C CXX)
find_package(fbs 0.2 REQUIRED COMPONENTS encoder sound)
foreach(sample feed_in_pieces print_landmarks)
  add_executable(${sample} %(samples)s/${sample}.c)
  target_link_libraries(${sample} PRIVATE fbs::fbs%(kind)s)
endforeach()
add_executable(encode_frames %(samples)s/encode_frames.c)
target_link_libraries(encode_frames PRIVATE fbs::encoder%(kind)s)
add_executable(round_trip round_trip.cpp)
target_compile_features(round_trip PRIVATE cxx_std_17)
target_compile_options(round_trip PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Werror)
target_link_libraries(round_trip PRIVATE fbs::encoder%(kind)s)
add_executable(listen listen.c)
target_link_libraries(listen PRIVATE fbs::sound)
"""

LISTEN = """
#include <fbs/sound.h>
int main(void) {
  fbs_sound* sound = 0;
  fbs_sound_info info;
  if (fbs_sound_open(&sound) != FBS_OK) return 1;
  if (fbs_sound_get_info(sound, &info) != FBS_OK || info.sample_rate != 0) return 2;
  fbs_sound_close(&sound);
  return sound == 0 ? 0 : 3;
}
"""

# A project that has fbs as a folder.
PARENT = """
cmake_minimum_required(VERSION 3.25)
project(parent LANGUAGES C CXX)
add_subdirectory(%(source)s fbs)
add_executable(user user.c)
target_link_libraries(user PRIVATE fbs::fbs)
add_executable(static_user user.c)
target_link_libraries(static_user PRIVATE fbs::fbs_static)
"""

# The headers for C++: errors, moves, and a grey video without a face.
ROUND_TRIP = """
#include <fbs/encoder.hpp>
#include <vector>
int main() {
  auto settings = fbs::Encoder::default_settings();
  try {
    fbs::Encoder refused(settings);
    return 1;
  } catch (const fbs::Error& error) {
    if (error.status() != FBS_ERROR_ARGUMENT) return 2;
  }
  settings.format.width = settings.format.height = 64;
  settings.allow_no_face = 1;
  fbs::Encoder encoder(settings);
  const std::vector<std::uint8_t> grey(64 * 64, 90);
  const fbs_const_picture picture = {64, 64, {grey.data(), grey.data(), grey.data()}, {64, 32, 32}};
  for (int n = 0; n < 5; ++n) encoder.push(picture);
  if (encoder.landmarks()) return 3;
  encoder.finish();
  fbs::Decoder first, decoder = std::move(first);
  if (decoder.format()) return 4;
  while (auto packet = encoder.pull()) decoder.feed(packet->data, packet->size);
  decoder.finish();
  int pictures = 0;
  for (fbs_picture_info info; decoder.next(&info) == FBS_OK; ++pictures)
    if (decoder.picture().width != 64 || decoder.state() || decoder.landmarks() || decoder.vertices()) return 5;
  try {
    decoder.feed(grey.data(), 1);
    return 6;
  } catch (const fbs::Error&) {
  }
  return pictures == 5 && encoder.report().pictures == 5 ? 0 : 7;
}
"""


def run(*command, **keywords):
    """Runs a command, which must succeed; returns what it prints."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=MAX_SECONDS, **keywords)
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout


class Install(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls._tree = tempfile.TemporaryDirectory(prefix="fbs-install-")
        cls.addClassCleanup(cls._tree.cleanup)
        cls.prefix = pathlib.Path(cls._tree.name) / "usr"
        run(CMAKE, "--install", BUILD, "--prefix", cls.prefix)
        libraries = list(cls.prefix.glob("lib*/**/libfbs.so"))
        assert len(libraries) == 1, libraries
        cls.lib = libraries[0].parent

    def environment(self, lib):
        return {**os.environ, "PKG_CONFIG_PATH": str(lib / "pkgconfig"), "LD_LIBRARY_PATH": str(lib)}

    def check_decoding(self, program, lib, vectors, pieces):
        """Decodes vectors in pieces of this many bytes, and compares with vectors.txt."""
        checked = 0
        for line in (VECTORS / "vectors.txt").read_text().splitlines():
            name, error, pictures, md5 = line.split() if line[0] != "#" else ("#", "", "", "")
            if name == "#" or not (vectors is None or name in vectors):
                continue
            for piece in pieces:
                printed = run(program, VECTORS / name, piece, self.folder / "out.yuv", env=self.environment(lib))
                found = hashlib.md5((self.folder / "out.yuv").read_bytes()).hexdigest()
                self.assertEqual((found, printed.split()[0]), (md5, pictures), f"{name} in pieces of {piece}")
                self.assertTrue(printed.endswith(f"the first: {STATUSES[error]}\n"), f"{name}: {printed}")
            checked += 1
        self.assertGreater(checked, 0)

    def check_encoding(self, programs, lib):
        """Encodes pictures of the talker, and decodes them."""
        source = read_y4m(TALK_Y4M)
        raw = b"".join(source.pictures[:PICTURES])
        done = subprocess.run([programs / "encode_frames", "176", "144", "25", self.folder / "out.fbs"], input=raw,
                              capture_output=True, timeout=MAX_SECONDS, env=self.environment(lib))
        self.assertEqual(done.returncode, 0, done.stderr)
        printed = run(programs / "feed_in_pieces", self.folder / "out.fbs", 100, env=self.environment(lib))
        self.assertTrue(printed.startswith(f"{PICTURES} pictures, 0 of them held"), printed)
        return (self.folder / "out.fbs").read_bytes()

    def compile_with_pkg_config(self, lib, package, samples, *static):
        flags = run("pkg-config", "--cflags", "--libs", *static, package, env=self.environment(lib)).split()
        for sample in samples:
            run(CC, "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", SAMPLES / f"{sample}.c", "-o",
                self.folder / sample, *flags)

    def only_static(self):
        """The installed tree without shared libraries, so that linkers take the others."""
        lib = self.folder / "static" / self.lib.relative_to(self.prefix)
        shutil.copytree(self.prefix / "include", self.folder / "static/include")
        shutil.copytree(self.lib, lib, ignore=lambda _, names: [name for name in names if ".so" in name])
        return lib

    def test_pkg_config_and_a_compiler_are_enough(self):
        self.compile_with_pkg_config(self.lib, "fbs", ["feed_in_pieces", "print_landmarks"])
        self.check_decoding(self.folder / "feed_in_pieces", self.lib, None, [1, 7, 4096])
        self.compile_with_pkg_config(self.lib, "fbs-encoder", ["encode_frames", "lossy_call"])
        self.check_encoding(self.folder, self.lib)

    def test_pkg_config_names_all_that_static_libraries_need(self):
        lib = self.only_static()
        self.compile_with_pkg_config(lib, "fbs", ["feed_in_pieces"], "--static")
        self.assertNotIn("libfbs", run("readelf", "-d", self.folder / "feed_in_pieces"))
        self.check_decoding(self.folder / "feed_in_pieces", lib, ["talk.fbs", "truncated.fbs"], [1, 7, 4096])
        self.compile_with_pkg_config(lib, "fbs-encoder", ["encode_frames"], "--static")
        self.check_encoding(self.folder, lib)

    def test_go_calls_what_is_installed(self):
        if not shutil.which("go"):
            self.skipTest("no go")
        raw = b"".join(read_y4m(TALK_Y4M).pictures[:PICTURES])
        flags = run("pkg-config", "--cflags", "--libs", "fbs-encoder", env=self.environment(self.lib)).split()
        run(CXX, "-std=c++17", SAMPLES / "round_trip.cpp", "-o", self.folder / "round_trip", *flags)
        printed = []
        for command in ([self.folder / "round_trip"], ["go", "run", SAMPLES / "round_trip.go"]):
            done = subprocess.run([*command, "176", "144", "25"], input=raw, capture_output=True, timeout=MAX_SECONDS,
                                  env=self.environment(self.lib))
            self.assertEqual(done.returncode, 0, done.stderr)
            printed.append(done.stdout)
        self.assertEqual(len(printed[0]), len(raw))
        self.assertEqual(*printed)

    def test_find_package(self):
        streams = []
        for kind in ("", "_static"):
            project = self.folder / f"project{kind}"
            project.mkdir()
            (project / "CMakeLists.txt").write_text(PROJECT % {"samples": SAMPLES, "kind": kind})
            (project / "round_trip.cpp").write_text(ROUND_TRIP)
            (project / "listen.c").write_text(LISTEN)
            run(CMAKE, "-S", project, "-B", project / "build", "-DCMAKE_BUILD_TYPE=Release",
                f"-DCMAKE_PREFIX_PATH={self.prefix}")
            run(CMAKE, "--build", project / "build")
            self.check_decoding(project / "build/feed_in_pieces", self.lib, ["talk.fbs", "odd.fbs"], [1, 7, 4096])
            run(project / "build/print_landmarks", TALK_FBS)
            run(project / "build/round_trip")
            run(project / "build/listen")
            streams.append(self.check_encoding(project / "build", self.lib))
            needed = run("readelf", "-d", project / "build/feed_in_pieces")
            self.assertEqual("libfbs.so" in needed, kind == "")
        self.assertEqual(*streams)

    def test_a_folder_of_another_project(self):
        """Nothing of how we build ourselves is asked of those who link us, and the encoder is not built."""
        (self.folder / "CMakeLists.txt").write_text(PARENT % {"source": SOURCE})
        (self.folder / "user.c").write_text("#include <fbs/fbs.h>\nint main(void) { return !fbs_version_number(); }\n")
        run(CMAKE, "-S", self.folder, "-B", self.folder / "build", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON")
        commands = {entry["file"]: entry["command"]
                    for entry in json.loads((self.folder / "build/compile_commands.json").read_text())}
        ours = [command for file, command in commands.items() if not file.endswith("user.c")]
        self.assertGreater(len(ours), 20)
        self.assertFalse([command for command in ours if "-Werror" in command or "/encoder/" in command])
        theirs = commands[str(self.folder / "user.c")]
        included = re.findall(r"-(?:I|isystem) ?(\S+)", theirs)
        self.assertEqual([pathlib.Path(path).resolve() for path in included], [SOURCE.resolve() / "include"])
        self.assertNotIn(" -W", theirs)

    def test_gstreamer_finds_the_plugin(self):
        plugins = list(self.prefix.glob("lib*/**/gstreamer-1.0/libgstfbs.so"))
        if not plugins or not shutil.which("gst-inspect-1.0"):
            self.skipTest("the plugin for GStreamer was not built, or no gst-inspect-1.0")
        environment = {**os.environ, "GST_PLUGIN_PATH": str(plugins[0].parent), "GST_REGISTRY": str(self.folder / "registry")}
        for element in ("fbsenc", "fbsdec"):
            self.assertIn(str(plugins[0]), run("gst-inspect-1.0", element, env=environment))
        self.assertNotIn(str(BUILD), run("readelf", "-d", plugins[0]))

    def test_headers_stand_alone(self):
        include = self.prefix / "include"
        self.assertEqual(sorted(path.name for path in (include / "fbs").iterdir()), sorted(HEADERS))
        warnings = ["-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror", "-fsyntax-only", "-I", include]
        for header in HEADERS:
            if header.endswith(".h"):
                run(CC, "-std=c99", *warnings, "-x", "c", include / "fbs" / header)
            run(CXX, "-std=c++17", *warnings, "-x", "c++", include / "fbs" / header)

    def test_libraries_show_nothing_but_the_interface(self):
        version = re.findall(r"#define FBS_VERSION_M\w+ (\d+)", (SOURCE / "include/fbs/fbs.h").read_text())
        for name, foreign in (("fbs", r"opencv|aom|OpenImageIO|libav"), ("fbs_encoder", r"OpenImageIO|libav|highgui")):
            library = self.lib / f"lib{name}.so"
            symbols = [line.split()[-1] for line in run("nm", "-D", "--defined-only", library).splitlines()]
            self.assertTrue(symbols)
            self.assertEqual([symbol for symbol in symbols if not symbol.startswith("fbs_")], [])
            declared = {symbol for header in HEADERS[:3] for symbol in
                        re.findall(r"^FBS_API .*?\b(fbs_\w+)\(", (self.prefix / "include/fbs" / header).read_text(), re.M)}
            self.assertLessEqual(set(symbols), declared)
            self.assertGreater(len(symbols), 7)
            dynamic = run("readelf", "-d", library)
            self.assertIn(f"[lib{name}.so.{version[0]}.{version[1]}]", dynamic)
            self.assertFalse(re.findall(rf"NEEDED.*(?:{foreign})", dynamic))
            self.assertNotRegex(dynamic, "RPATH|RUNPATH")

    def test_the_program_finds_its_modules(self):
        fbs = self.prefix / "bin/fbs"
        run(fbs, "encode", TALK_Y4M, self.folder / "out.fbs", "--frames", "10", "--quiet")
        run(fbs, "decode", self.folder / "out.fbs", self.folder / "out.mp4", "--quiet")
        self.assertGreater((self.folder / "out.mp4").stat().st_size, 1000)
