"""The talker with a voice of which no two places sound alike."""
import array
import random
import shutil
import subprocess
import wave

from harness import FBS, TALK_Y4M, ffmpeg

RATE = 48000
STEP = 48  # samples of a millisecond


def bursts(seconds, seed):
    """Tones of random pitch, length and loudness, with pauses: no two places are alike."""
    chance, samples = random.Random(seed), array.array("h")
    while len(samples) < seconds * RATE:
        period, loud = chance.randrange(40, 160), chance.randrange(3000, 12000)
        for k in range(chance.randrange(30, 140) * STEP):
            samples.append(loud if k % period < period // 2 else -loud)
        samples.extend([0] * (chance.randrange(10, 60) * STEP))
    return samples[:int(seconds * RATE)]


def make_speech(stream, seconds, folder, seed=7):
    """Encodes it, unless that has been done with this fbs.
    @param seconds  of sound; the pictures last four"""
    if stream.exists() and stream.stat().st_mtime > FBS.stat().st_mtime:
        return
    with wave.open(str(folder / "speech.wav"), "wb") as out:
        out.setparams((1, 2, RATE, 0, "NONE", ""))
        out.writeframes(bursts(seconds, seed).tobytes())
    ffmpeg("-i", TALK_Y4M, "-i", folder / "speech.wav", "-c:v", "libx264", "-crf", "10", "-c:a", "pcm_s16le",
           folder / "speech.mkv")
    subprocess.run([FBS, "encode", folder / "speech.mkv", folder / "speech.fbs", "--quiet", "--patterns", "1",
                    "--sound-bitrate", "32"], check=True)
    shutil.move(folder / "speech.fbs", stream)
