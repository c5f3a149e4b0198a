#!/usr/bin/env python3
"""Makes the media of the demo: make_media.py FOLDER.

A generated talker with a synthetic voice, as fbs at three rates and as AV1 as near to each as it comes, with the model of
the head and media.json, which says how many bytes each has. Needs build/release/{fbs,talker} (or those of FBS_BUILD),
espeak-ng, and ffmpeg with SVT-AV1. Takes some minutes."""
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("FBS_BUILD", ROOT / "build/release"))
SECONDS = 12
RATES = (3, 5, 10)       # kbit/s of fbs, picture and voice
OPUS = 6                 # kbit/s of the voice beside AV1: the least that Opus has
TEXT = ("This person was drawn by a computer, and so was the voice. A few pictures of the face are sent, "
        "and between them only how head and face move. You can turn the head while it speaks.")


def run(*command):
    subprocess.run([str(part) for part in command], check=True)


def ffmpeg(*arguments):
    run("ffmpeg", "-v", "error", "-nostdin", "-y", *arguments)


def source(folder):
    """The talker with its voice."""
    picture, voice, out = folder / "talker.y4m", folder / "voice.wav", folder / "talker.mkv"
    run(BUILD / "talker", picture, "--size", "352x288", "--fps", "25", "--frames", SECONDS * 25, "--motion", "talk", "--seed", 3)
    run("espeak-ng", "-v", "en", "-s", 160, "-w", voice, TEXT)
    ffmpeg("-i", picture, "-i", voice, "-t", SECONDS, "-c:v", "ffv1", "-c:a", "pcm_s16le", out)
    picture.unlink()
    voice.unlink()
    return out


def av1(video, rate, out):
    """AV1 with an average of `rate` kbit/s for picture and voice, or the least that it reaches: smaller or slower if need be.
    Returns its size and its pictures a second."""
    part, best, chosen = out.with_suffix(".part.webm"), None, None
    for size, fps in (("352x288", 25), ("176x144", 25), ("176x144", 12.5)):
        for crf in (63, 58, 53, 48):
            ffmpeg("-i", video, "-vf", f"fps={fps},scale={size}:flags=area", "-pix_fmt", "yuv420p", "-c:v", "libsvtav1",
                   "-preset", "4", "-crf", crf, "-g", "300", "-c:a", "libopus", "-b:a", f"{OPUS}k", "-ac", "1",
                   "-application", "voip", part)
            miss = abs(part.stat().st_size * 8 / 1000 / SECONDS - rate)
            if best is not None and miss >= best:
                break
            best, chosen = miss, (size, fps)
            part.replace(out)
    part.unlink(missing_ok=True)
    return chosen


def main():
    os.environ.setdefault("SVT_LOG", "1")  # errors only
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__.splitlines()[0])
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    video = source(folder)
    media = []
    for rate in RATES:
        stream, peer = folder / f"talker_{rate}.fbs", folder / f"talker_{rate}.webm"
        run(BUILD / "fbs", "encode", video, stream, "--bitrate", rate, "--quiet")
        size, fps = av1(video, rate, peer)
        media.append({"rate": rate, "fbs": stream.name, "fbs_bytes": stream.stat().st_size, "av1": peer.name,
                      "av1_bytes": peer.stat().st_size, "av1_size": size, "av1_fps": fps})
    run(BUILD / "fbs", "export", folder / f"talker_{RATES[-1]}.fbs", folder / "head.glb")
    video.unlink()
    (folder / "media.json").write_text(json.dumps({"seconds": SECONDS, "media": media}, indent=1) + "\n")


if __name__ == "__main__":
    main()
