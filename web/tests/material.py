"""The streams of the tests, made by the program, and what the program itself decodes them to."""
import os
import pathlib
import subprocess
import sys
import wave

ROOT = pathlib.Path(os.environ.get("FBS_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
BUILD = pathlib.Path(os.environ.get("FBS_BUILD", ROOT / "build/release"))
WEB = pathlib.Path(os.environ.get("FBS_WEB", ROOT / "build/web"))
os.environ.setdefault("FBS_BUILD", str(BUILD))
sys.path.insert(0, str(ROOT / "tests/program"))
from speech import RATE, bursts  # noqa: E402  pylint: disable=wrong-import-position

FBS = BUILD / "fbs"
FOLDER = WEB / "material"
SECONDS, PICTURES, WIDTH, HEIGHT = 3, 75, 176, 144
TALK = FOLDER / "talk.fbs"    # scenes of half a second, with Opus
RADIO = FOLDER / "radio.fbs"  # one scene of one pattern, with Codec 2


def run(*command):
    subprocess.run([str(part) for part in command], check=True, timeout=120)


def make():
    """Makes the streams, and three that are not whole."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    if TALK.exists() and TALK.stat().st_mtime > FBS.stat().st_mtime:
        return
    picture, voice, video = (FOLDER / f"source.{suffix}" for suffix in ("y4m", "wav", "mkv"))
    run(BUILD / "talker", picture, "--size", f"{WIDTH}x{HEIGHT}", "--frames", PICTURES, "--fps", PICTURES // SECONDS)
    with wave.open(str(voice), "wb") as out:
        out.setparams((1, 2, RATE, 0, "NONE", ""))
        out.writeframes(bursts(SECONDS, 7).tobytes())
    run("ffmpeg", "-v", "error", "-nostdin", "-y", "-i", picture, "-i", voice, "-c:v", "ffv1", "-c:a", "pcm_s16le", video)
    run(FBS, "encode", video, RADIO, "--quiet", "--effort", 0, "--patterns", 1, "--sound", "codec2")
    run(FBS, "encode", video, TALK, "--quiet", "--effort", 0, "--key-interval", 0.5)
    whole = TALK.read_bytes()
    (FOLDER / "cut.fbs").write_bytes(whole[:len(whole) * 2 // 3])
    (FOLDER / "damaged.fbs").write_bytes(whole[:4000] + bytes(40) + whole[4040:])
    (FOLDER / "page.fbs").write_text("<!doctype html><title>Not found</title>")


def native_pictures(stream):
    """MD5 of the planes of each picture, as the program decodes them."""
    done = subprocess.run([FBS, "decode", stream, "--md5"], check=True, stdout=subprocess.PIPE, text=True, timeout=120)
    return [line.split()[0] for line in done.stdout.splitlines()]


def native_sound(stream):
    """Samples as the program decodes them, and their rate."""
    out = FOLDER / f"{stream.stem}.wav"
    run(FBS, "decode", stream, out)
    with wave.open(str(out), "rb") as sound:
        return sound.readframes(sound.getnframes()), sound.getframerate()
