#!/usr/bin/env python3
"""Measures what sound costs and whether it is understood, and prints a table (FBS_BUILD is the folder of sound_tool;
default build/release). Needs numpy, espeak-ng and ffmpeg.

    measure_sound.py [--pictures FOLDER] [--speech FILE...]

Two voices of espeak-ng say some sentences, with pauses between them; or speech is that of FILEs, of any kind that ffmpeg
reads. It is coded and decoded at rates of Opus and in the modes of Codec 2 that the encoder chooses.

    kbit/s   of the frames, pauses included; no headers of packets
    STOI     short-time objective intelligibility against the source (stoi.py): 1 is clean
    delay    ms by which what is decoded comes late, by cross-correlation: of the samples for Opus, of the levels of 15
             bands for Codec 2, which makes its own waveform; the spread is that between parts of 4 s each

--pictures   writes a spectrogram of each there: 0 to 4 kHz from the bottom up, 80 dB from black to white, source first
"""
import argparse
import os
import pathlib
import struct
import subprocess
import zlib

import numpy

import stoi

TOOL = pathlib.Path(os.environ.get("FBS_BUILD", "build/release")) / "sound_tool"
SENTENCES = (
    "The quick brown fox jumps over the lazy dog.",
    "She had your dark suit in greasy wash water all year.",
    "Please call me back at five thirty; I will be home by then.",
    "A voice with the face: how many bits does it really take?",
    "Thirteen ships sailed past the narrow channel before dawn.",
    "Few thieves are never sent to the jug.",
)
VOICES = {"low": ("en-us", 42, 150), "high": ("en-us+f3", 60, 170)}  # voice, pitch, words a minute
PAUSE = 0.4                                                          # seconds
CODINGS = [("opus", rate, ms) for ms in (60, 20) for rate in (6000, 8000, 12000, 16000)] + [
    ("codec2", rate, 0) for rate in (3200, 2400, 1600, 1400, 1200)]
RATES = {"opus": 48000, "codec2": 8000}
MOST_LAG = 60  # ms


def run(command, data=b""):
    done = subprocess.run([str(word) for word in command], input=data, capture_output=True)
    if done.returncode:
        raise SystemExit(f"{command[0]}: {done.stderr.decode().strip()}")
    return done


def resampled(samples, rate_in, rate_out):
    """Mono samples as float64, -1..1."""
    raw = (numpy.clip(samples, -1, 1) * 32767).astype("<i2").tobytes()
    out = run(["ffmpeg", "-v", "error", "-f", "s16le", "-ar", rate_in, "-ac", 1, "-i", "-", "-ar", rate_out, "-f", "s16le", "-"],
              raw).stdout
    return numpy.frombuffer(out, "<i2") / 32768


def read_speech(data):
    """At 48 kHz."""
    out = run(["ffmpeg", "-v", "error", "-i", "-", "-vn", "-ar", 48000, "-ac", 1, "-f", "s16le", "-"], data).stdout
    return numpy.frombuffer(out, "<i2") / 32768


def spoken(voice, pitch, speed):
    pause = numpy.zeros(round(PAUSE * 48000))
    parts = [pause]
    for sentence in SENTENCES:
        wave = run(["espeak-ng", "-v", voice, "-p", pitch, "-s", speed, "--stdout", sentence]).stdout
        parts += [read_speech(wave), pause]
    return numpy.concatenate(parts)


def coded(codec, bitrate, frame_ms, samples):
    """(what is decoded, at the codec's rate; kbit/s)"""
    raw = (numpy.clip(samples, -1, 1) * 32767).astype("<i2").tobytes()
    done = run([TOOL, codec, bitrate, frame_ms or 20], raw)
    _, size, frames, duration, _ = (int(field) for field in done.stderr.split())
    return numpy.frombuffer(done.stdout, "<i2") / 32768, size * 8 / (frames * duration / 48000) / 1000


def spectrum(samples, rate, hop_ms, window_ms, top):
    """Power, bins up to `top` Hz x times: frames of `window_ms` centred on multiples of `hop_ms`."""
    size, hop = round(rate * window_ms / 1000), rate * hop_ms / 1000
    padded = numpy.concatenate([numpy.zeros(size // 2), samples, numpy.zeros(size)])
    window = numpy.hanning(size)
    count = int(len(samples) / hop)
    frames = numpy.array([padded[round(i * hop):round(i * hop) + size] * window for i in range(count)])
    return (numpy.abs(numpy.fft.rfft(frames)) ** 2).T[:int(top * window_ms / 1000)]


def envelopes(samples, rate):
    """Level of 15 bands up to 3 kHz in dB, down to 50 dB below the loudest, each ms, over some periods of the voice."""
    power = spectrum(samples, rate, 1, 40, 3000)
    level = 10 * numpy.log10(power.reshape(15, -1, power.shape[1]).mean(axis=1) + 1e-12)
    return numpy.maximum(level, level.max() - 50)


def envelope_lag(source, decoded):
    """ms by which `decoded` comes late: the peak of the correlation, between whole ms by a parabola."""
    x, y = envelopes(source, 8000), envelopes(decoded, 8000)
    length = min(x.shape[1], y.shape[1]) - 2 * MOST_LAG
    fixed = stoi.normalised(x[:, MOST_LAG:MOST_LAG + length])
    by_lag = [(fixed * stoi.normalised(y[:, MOST_LAG + d:MOST_LAG + d + length])).sum()
              for d in range(-MOST_LAG, MOST_LAG + 1)]
    peak = int(numpy.clip(numpy.argmax(by_lag), 1, len(by_lag) - 2))
    left, here, right = by_lag[peak - 1:peak + 2]
    return peak - MOST_LAG + 0.5 * (left - right) / (left - 2 * here + right)


def waveform_lag(source, decoded):
    """The same of the samples themselves, in steps of a sample at 8 kHz."""
    size = 1 << (len(source) + len(decoded)).bit_length()
    by_lag = numpy.fft.irfft(numpy.conj(numpy.fft.rfft(source, size)) * numpy.fft.rfft(decoded, size), size)
    most = MOST_LAG * 8
    return (int(numpy.argmax(numpy.roll(by_lag, most)[:2 * most + 1])) - most) / 8


def delays(codec, source, decoded):
    """(of the whole, spread between parts of 4 s), of samples at 8 kHz."""
    lag = waveform_lag if codec == "opus" else envelope_lag
    part = 4 * 8000
    parts = [lag(source[i:i + part], decoded[i:i + part]) for i in range(0, len(source) - part, part)]
    return lag(source, decoded), max(parts) - min(parts) if parts else 0.0


def write_png(path, grey):
    """grey: rows x columns of uint8, the top row first."""
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + row.tobytes() for row in grey)
    header = struct.pack(">IIBBBBB", grey.shape[1], grey.shape[0], 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def spectrogram(samples, rate, seconds=4):
    level = 10 * numpy.log10(spectrum(samples[:seconds * rate], rate, 4, 40, 4000) + 1e-9)
    return numpy.clip((level - level.max() + 80) * 255 / 80, 0, 255).astype(numpy.uint8)[::-1]


def measure(name, speech, pictures):
    clean = resampled(speech, 48000, stoi.RATE)
    by_rate = {rate: resampled(speech, 48000, rate) for rate in set(RATES.values())}
    if pictures:
        write_png(pictures / f"{name}_source.png", spectrogram(by_rate[8000], 8000))
    for codec, bitrate, frame_ms in CODINGS:
        rate = RATES[codec]
        decoded, kbps = coded(codec, bitrate, frame_ms, by_rate[rate])
        heard = resampled(decoded, rate, stoi.RATE)
        length = min(len(clean), len(heard))
        narrow = resampled(decoded, rate, 8000)
        delay, spread = delays(codec, by_rate[8000], narrow)
        print(f"{name:<8} {codec:<7} {bitrate / 1000:5.1f} {frame_ms or '':>4}  {kbps:6.2f}  "
              f"{stoi.stoi(clean[:length], heard[:length]):5.3f}  {delay:6.2f}  {spread:6.2f}", flush=True)
        if pictures:
            write_png(pictures / f"{name}_{codec}_{bitrate}_{frame_ms}.png", spectrogram(narrow, 8000))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pictures", type=pathlib.Path)
    parser.add_argument("--speech", type=pathlib.Path, nargs="+", default=[])
    arguments = parser.parse_args()
    if arguments.pictures:
        arguments.pictures.mkdir(parents=True, exist_ok=True)
    print("voice    codec   asked   ms  kbit/s   STOI   delay  spread")
    if arguments.speech:
        for path in arguments.speech:
            measure(path.stem, read_speech(path.read_bytes()), arguments.pictures)
    else:
        for name, voice in VOICES.items():
            measure(name, spoken(*voice), arguments.pictures)


if __name__ == "__main__":
    main()
