"""The diagrams of how-it-works.md as SVG, for light and dark pages: see make_pictures.py."""

# A picture of a page knows what the reader's system prefers, and not what the page does: so it brings its own ground.
STYLE = """<style>
svg { --ground: #fff; --ink: #1f2328; --soft: #59636e; --box: #f6f8fa;
      --encoder: #0969da; --stream: #bc4c00; --decoder: #1a7f37; --other: #818b98; }
@media (prefers-color-scheme: dark) {
  svg { --ground: #0d1117; --ink: #f0f6fc; --soft: #9198a1; --box: #151b23;
        --encoder: #4493f8; --stream: #f0883e; --decoder: #3fb950; --other: #656c76; }
}
text { font: 15px sans-serif; fill: var(--ink); }
.small { font-size: 13px; fill: var(--soft); }
.ground { fill: var(--ground); }
.box { fill: var(--box); stroke-width: 1.5; }
.encoder { stroke: var(--encoder); } .stream { stroke: var(--stream); }
.decoder { stroke: var(--decoder); } .other { stroke: var(--other); }
.arrow { fill: none; stroke: var(--ink); stroke-width: 1.5; marker-end: url(#tip); }
.loop { stroke: var(--soft); stroke-dasharray: 5 4; }
#tip path { fill: var(--ink); }
</style>
<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="8" markerHeight="8" orient="auto">
<path d="M0 0 8 4 0 8z"/></marker></defs>"""

WIDTH, HEIGHT, STEP, TOP, ROW = 126, 62, 150, 22, 112  # of a box, and from one to the next
# Column, row, kind, what happens and where.
BOXES = {
    "source": (0, 0, "other", ["picture", "cli/video"]),
    "find": (1, 0, "encoder", ["find the face", "encoder/find"]),
    "adapt": (2, 0, "encoder", ["adapt the head", "encoder/find"]),
    "pose": (3, 0, "encoder", ["head pose", "encoder/track"]),
    "snakes": (4, 0, "encoder", ["snakes", "encoder/track"]),
    "fit": (5, 0, "encoder", ["pose and fit", "encoder/fit"]),
    "patterns": (0, 1, "encoder", ["patterns, AV1", "encoder/patterns"]),
    "bits": (1, 1, "stream", ["bits", "bitstream"]),
    "coder": (4, 1, "stream", ["range coder", "bitstream/entropy"]),
    "state": (5, 1, "encoder", ["quantised state", "encoder/plan"]),
    "decoder": (1, 2, "decoder", ["patterns, state", "decoder"]),
    "vertices": (2, 2, "decoder", ["vertices", "decoder/head"]),
    "weights": (3, 2, "decoder", ["weights", "decoder/blend"]),
    "renderer": (4, 2, "decoder", ["renderer", "decoder/draw"]),
    "shown": (5, 2, "other", ["picture", "cli/video"]),
}
ARROWS = ["source find", "find adapt", "adapt pose", "pose snakes", "snakes fit", "fit state", "state coder", "coder bits",
          "source patterns", "patterns bits", "bits decoder", "decoder vertices", "vertices weights",
          "weights renderer", "renderer shown"]


def svg(width, height, inside):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}">\n'
            f'{STYLE}\n<rect class="ground" width="{width}" height="{height}" rx="6"/>\n' + "\n".join(inside) + "\n</svg>\n")


def corner(name):
    return 16 + BOXES[name][0] * STEP, TOP + BOXES[name][1] * ROW


def arrow(begin, end):
    """From edge to edge, along a row or a column."""
    (x, y), (u, v) = corner(begin), corner(end)
    if y == v:
        x, u = (x + WIDTH, u - 2) if x < u else (x, u + WIDTH + 2)
        return f'<path class="arrow" d="M{x} {y + HEIGHT / 2:g}H{u}"/>'
    return f'<path class="arrow" d="M{x + WIDTH / 2:g} {y + HEIGHT}V{v - 2}"/>'


def box(name):
    (x, y), (_, _, kind, lines) = corner(name), BOXES[name]
    middle = x + WIDTH / 2
    return (f'<rect class="box {kind}" x="{x}" y="{y}" width="{WIDTH}" height="{HEIGHT}" rx="5"/>'
            f'<text text-anchor="middle" x="{middle:g}" y="{y + 27}">{lines[0]}</text>'
            f'<text class="small" text-anchor="middle" x="{middle:g}" y="{y + 47}">{lines[1]}</text>')


def pipeline():
    """From picture to picture, with the folder of each step."""
    inside = [arrow(*pair.split()) for pair in ARROWS] + [box(name) for name in BOXES]
    # The encoder has the decoder's patterns.
    (x, y), (u, v) = corner("patterns"), corner("fit")
    turn = v + HEIGHT + 25
    inside += [f'<path class="arrow loop" d="M{x + WIDTH - 20} {y}V{turn}H{u + 24}V{v + HEIGHT + 2}"/>',
               f'<text class="small" text-anchor="middle" x="{(x + u + WIDTH) / 2:g}" y="{turn - 7}">'
               'decoded patterns: what pictures are compared with, as in the decoder</text>']
    return svg(32 + 5 * STEP + WIDTH, TOP + 2 * ROW + HEIGHT + TOP, inside)


def byte_bar(seen):
    """What the bytes of a stream are, from `fbs inspect --json`: a bar, and a line for each part."""
    motion = seen["motion"]
    face = sum(motion[part] for part in ("mouth", "brows", "upper lids", "lower lids", "gaze", "mouth interior"))
    first = seen["patterns"][0]["bytes"]
    parts = [("first pattern", first, "stream", 1), ("the other patterns", seen["bytes"]["patterns"] - first, "stream", 0.55),
             ("shape of the head, layers", seen["bytes"]["geometry"], "decoder", 1),
             ("motion of mouth, brows, eyes", face, "encoder", 1),
             ("motion of head, body, light", motion["pose"] + motion["body"] + motion["ground"] + motion["light"], "encoder", 0.7),
             ("choice of patterns", motion["blend"], "encoder", 0.4)]
    total = seen["bytes"]["total"]
    parts.append(("packets and the rest", total - sum(part[1] for part in parts), "other", 1))
    left, width, x, inside = 16, 848, 16.0, []
    for i, (name, size, colour, strength) in enumerate(parts):
        share = width * size / total
        fill = f'style="fill: var(--{colour})" fill-opacity="{strength}"'
        inside.append(f'<rect {fill} x="{x:.1f}" y="18" width="{max(share - 1.5, 1):.1f}" height="34"/>')
        column, row = i % 2, i // 2
        inside.append(f'<rect {fill} x="{left + column * 430}" y="{70 + row * 25}" width="13" height="13"/>'
                      f'<text x="{left + column * 430 + 22}" y="{82 + row * 25}">{name}: {size} bytes, '
                      f'{100 * size / total:.0f} %</text>')
        x += share
    return svg(880, 76 + 25 * ((len(parts) + 1) // 2), inside)
