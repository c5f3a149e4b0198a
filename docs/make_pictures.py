#!/usr/bin/env python3
"""Makes the generated parts of docs/: talker.jpg, the pictures of how-it-works.md, head.svg and the list of vertices in
marks.md.

    docs/make_pictures.py [BUILD]       BUILD contains fbs, talker and step_pictures; default build/release

All show the generated talker, tests/talker. Needs ffmpeg with drawtext and the font DejaVu Sans.
"""

import base64
import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

from diagrams import byte_bar, pipeline

DOCS = pathlib.Path(__file__).resolve().parent
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
SIZE, PICTURES, SHOWN = 480, 300, 145
STEPS = {  # panels of step_pictures, with what is written above each
    "adaptation": ["first picture", "68 landmarks found", "generic head, adapted"],
    "contours": ["mouth shut", "open", "eyes shut"],
    "patterns": ["first pattern, as sent", "its head, laid flat", "a later pattern", "its head, laid flat"],
    "decoded": ["source", "mesh, as sent", "decoded", "difference, 4 times"],
}
FEATURES = ["outer lips", "inner lips", "right brow", "left brow", "right upper lid", "left upper lid",
            "right lower lid", "left lower lid", "right pupil", "left pupil"]


def run(*args):
    return subprocess.run(list(map(str, args)), check=True, capture_output=True, text=True).stdout


def strip(panels, target, before=""):
    """Puts (file, text) beside each other, each text above its panel.
    @param before  filters that come first, with a comma at the end"""
    chains = [f"[{i}:v]{before}setsar=1,pad=iw:ih+34:0:34:white,drawtext=fontfile={FONT}:"
              f"text='{text.replace(':', chr(92) + ':')}':fontsize=17:x=8:y=23-max_glyph_a[v{i}]"
              for i, (_, text) in enumerate(panels)]
    graph = ";".join(chains) + ";" + "".join(f"[v{i}]" for i in range(len(panels)))
    inputs = [word for file, _ in panels for word in ("-i", file)]
    run("ffmpeg", "-v", "error", "-y", *inputs, "-filter_complex", f"{graph}hstack={len(panels)},format=yuvj444p",
        "-frames:v", "1", "-q:v", "3", "-bitexact", target)


def talker_pictures(build, target, bar):
    """Source, mesh and decoded picture SHOWN side by side, labelled with the bitrate; and what the stream's bytes are."""
    with tempfile.TemporaryDirectory() as folder:
        at = lambda name: pathlib.Path(folder) / name
        run(f"{build}/talker", at("a.y4m"), "--size", f"{SIZE}x{SIZE}", "--frames", PICTURES)
        run(f"{build}/fbs", "encode", at("a.y4m"), at("a.fbs"), "--overlay", at("b.y4m"), "--quiet")
        run(f"{build}/fbs", "decode", at("a.fbs"), at("c.y4m"), "--quiet")
        seen = json.loads(run(f"{build}/fbs", "inspect", at("a.fbs"), "--json"))
        total = seen["bytes"]["total"] * 8 / seen["seconds"] / 1000
        bits = seen["bytes"]["motion"] * 8 / seen["frames"]
        labels = [f"source, picture {SHOWN} of {PICTURES}", "mesh and snakes",
                  f"decoded: total {total:.1f} kbit/s, {bits:.0f} bits of motion per picture"]
        strip([(at(f"{name}.y4m"), label) for name, label in zip("abc", labels)], target,
              f"select=eq(n\\,{SHOWN}),scale={SIZE}:{SIZE},")
        bar.write_text(byte_bar(seen))


def step_pictures(build, folder):
    """What each step of how-it-works.md makes of a talker."""
    with tempfile.TemporaryDirectory() as panels:
        run(f"{build}/step_pictures", panels)
        for name, texts in STEPS.items():
            strip([(f"{panels}/{name}_{i + 1}.png", text) for i, text in enumerate(texts)], folder / f"{name}.jpg")


def head():
    """Positions in eye distances (x to the picture's right, y down), triangles and vertices of the generic head."""
    gltf = json.loads((DOCS.parent / "common/generic_head.gltf").read_text())
    mesh = gltf["meshes"][0]
    data = base64.b64decode(gltf["buffers"][0]["uri"].split(",")[1])
    count = gltf["accessors"][1]["count"]
    offsets = [view["byteOffset"] for view in gltf["bufferViews"]]
    positions = [(x, -y, -z) for x, y, z in struct.iter_unpack("<3f", data[offsets[0]:offsets[0] + 105 * 12])]
    corners = struct.unpack_from(f"<{count}H", data, offsets[1])
    return positions, list(zip(*[iter(corners)] * 3)), mesh["extras"]["vertices"]


def head_drawing(target):
    """Front view with the vertices' numbers, and side view, as in the paper's Fig. 2."""
    positions, triangles, vertices = head()
    scale, top, middle, side = 620, 1.3, 1.2, 2.8
    front = [((x + middle) * scale, (y + top) * scale) for x, y, z in positions]
    profile = [((side - z) * scale, (y + top) * scale) for x, y, z in positions]
    edges = sorted({tuple(sorted((t[i], t[(i + 1) % 3]))) for t in triangles for i in range(3)})
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {4.4 * scale:.0f} {3.3 * scale:.0f}">',
           '<rect width="100%" height="100%" fill="white"/>']
    for view in (front, profile):
        path = "".join(f"M{view[a][0]:.0f} {view[a][1]:.0f}L{view[b][0]:.0f} {view[b][1]:.0f}" for a, b in edges)
        out.append(f'<path d="{path}" stroke="#8ab" stroke-width="1.5" fill="none"/>')
    out.append('<g font-family="sans-serif" font-size="19" text-anchor="middle">')
    for v, (x, y) in enumerate(front):
        colour = "#a00" if vertices[v]["feature"] >= 0 else "#000"
        out.append(f'<text x="{x:.0f}" y="{y + 5:.0f}" fill="{colour}" stroke="white" stroke-width="4" '
                   f'paint-order="stroke">{v}</text>')
    target.write_text("\n".join(out + ["</g></svg>"]) + "\n")


def vertex_list(target):
    """Replaces the table in marks.md."""
    positions, _, vertices = head()
    rows = ["| vertex | name | iBUG-68 | on the curve of | x | y |", "|---|---|---|---|---|---|"]
    for v, (vertex, p) in enumerate(zip(vertices, positions)):
        landmark = vertex["landmark"] if vertex["landmark"] >= 0 else ""
        feature = FEATURES[vertex["feature"]] if vertex["feature"] >= 0 else ""
        rows.append(f"| {v} | `{vertex['name']}` | {landmark} | {feature} | {p[0]:.3f} | {p[1]:.3f} |")
    text = target.read_text()
    target.write_text(re.sub(r"\| vertex \|.*?\n\n", "\n".join(rows) + "\n\n", text, flags=re.S))


if __name__ == "__main__":
    programs = sys.argv[1] if len(sys.argv) > 1 else DOCS.parent / "build/release"
    head_drawing(DOCS / "head.svg")
    vertex_list(DOCS / "marks.md")
    (DOCS / "pictures/pipeline.svg").write_text(pipeline())
    step_pictures(programs, DOCS / "pictures")
    talker_pictures(programs, DOCS / "talker.jpg", DOCS / "pictures/bytes.svg")
