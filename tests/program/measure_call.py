#!/usr/bin/env python3
"""Measures a call over a bad network (samples/call), and prints a table. Needs numpy.

    measure_call.py PICTURES,SOUND PICTURES,SOUND [--seconds N] [--loss PERCENT ...] [--burst MS] [--repair HOW ...]
                    [--latency MS] [--join N] [--options TEXT] [--parts N] [--keep FOLDER] [--prefix COMMAND]

Two ends send these files, Y4M and WAV, to each other: one row for each direction. The network delays each packet by 20 to
70 ms. What is in the first WARM_UP seconds of a call is not counted.

    eye      ms from a picture's time in the source to its showing: median, what 95 of 100 keep to, and longest
    ear      ms from a sound in the source to its sounding, by cross-correlation of parts of a second: median
    freezes  times without a picture for more than 150 ms longer than one lasts, and s in all
    breaks   losses of voice, and s in all, of which the decoder makes something up
    PSNR     dB, luma, mean: of the pictures on the screen at each time against the source so much earlier as `eye` says;
             and of those shown against their own source
    kbit/s   sent, with 28 bytes of IP and UDP for each packet: pictures, voice, repair, RTCP, all; and `rate` is what the
             encoder was told, on average
    trip     ms, longest round trip reported

--join N  instead: N viewers who come one after the other, and how long each waits for a picture and for sound
--options of the call, such as "--capacity 60,40,60 --min-bitrate 2000 --max-bitrate 20000"
--parts   of the call, of equal duration, each with a row of its own
--keep    leaves what was recorded there
--prefix  before each end's command, as `chrt -r 1` on a busy machine
"""
import argparse
import pathlib
import shutil
import statistics
import tempfile
import wave

import numpy

import call
from harness import Y4m

NETWORK = ("--min-delay", 20, "--max-delay", 70)
WARM_UP = 4          # s
RATE = 48000
PART, MOST = 1, 1.6  # s: what is sought in the source, and how late it may be


class Source:
    def __init__(self, pictures, sound):
        self.files = pathlib.Path(pictures).resolve(), pathlib.Path(sound).resolve()
        video = Y4m(self.files[0].read_bytes())
        self.rate, self.width, self.height = video.rate, video.width, video.height
        self.luma = [numpy.frombuffer(picture, numpy.uint8, self.width * self.height) for picture in video.pictures]
        self.size = len(video.pictures[0])
        with wave.open(str(self.files[1])) as file:
            self.samples = numpy.frombuffer(file.readframes(file.getnframes()), numpy.int16).astype(float)


def psnr(one, other):
    error = numpy.mean((one.astype(numpy.int16) - other) ** 2.0)
    return 10 * numpy.log10(255 ** 2 / max(error, 1e-3))


def received_pictures(prefix, source, end, begin):
    """(when, number in the source, luma) of those shown, in order; those of unknown number are left out."""
    shown = numpy.memmap(f"{prefix}.yuv", numpy.uint8, "r").reshape(-1, source.size)
    out = []
    for row, picture in zip(end.pictures, shown):
        number = round((row.recorded - begin) * source.rate)
        if row.recorded > 0 and 0 <= number < len(source.luma):
            out.append((row.at, number, picture[:source.width * source.height]))
    return out


def on_screen(pictures, source, begin, delay, first, last):
    """Mean PSNR at the times of the source's pictures in first..last, and `delay` later."""
    at, values = 0, []
    for number in range(max(0, round((first - delay - begin) * source.rate)), len(source.luma)):
        time = begin + number / source.rate + delay
        if time > last:
            break
        while at + 1 < len(pictures) and pictures[at + 1][0] <= time + 0.5 / source.rate:
            at += 1
        values.append(psnr(pictures[at][2], source.luma[number]))
    return statistics.mean(values)


def ear_delays(prefix, source, end, begin, first, last):
    """Of parts of the sound, ms."""
    samples = numpy.fromfile(f"{prefix}.pcm", numpy.int16).astype(float)
    starts = numpy.cumsum([0] + [row.size // 2 for row in end.voice])
    channels = 2 if end.voice and end.voice[len(end.voice) // 2].size > 2 * RATE // 50 else 1
    length, out, before = PART * RATE, [], -PART
    for row, start in zip(end.voice, starts):
        if row.at < max(first, before + PART) or row.at > last:
            continue
        before = row.at
        part = samples[start:start + length * channels:channels]
        at = round((row.at - begin - MOST) * RATE)
        area = source.samples[max(at, 0):at + length + round(MOST * RATE)]
        if len(part) < length or at < 0 or len(area) <= length or numpy.std(part) < 200:
            continue
        match = numpy.fft.irfft(numpy.fft.rfft(area) * numpy.conj(numpy.fft.rfft(part, len(area))), len(area))
        sums = numpy.cumsum(numpy.concatenate([[0], area ** 2]))
        lags = len(area) - length
        norm = numpy.sqrt((sums[length:length + lags] - sums[:lags]) * numpy.sum(part ** 2)) + 1
        best = int(numpy.argmax(match[:lags] / norm))
        if match[best] / norm[best] > 0.5:
            out.append(1000 * (MOST - best / RATE))
    return out


def freezes(pictures, first, last, rate):
    times = [at for at, *_ in pictures if at >= first] + [last]
    gaps = [b - a for a, b in zip([first] + times, times)]
    long = [gap for gap in gaps if gap > max(3 / rate, 1 / rate + 0.15)]
    return len(long), sum(long)


def measure(folder, name, source, here, there, seconds):
    """A row: what the end `here` saw in these seconds of the source that `there` sent."""
    begin, last = there.sent["picture"], min(here.sent["picture"] + seconds[-1] + 1, here.voice[-1].at)
    first = here.sent["picture"] + seconds[0]
    pictures = received_pictures(folder / name, source, here, begin)
    counted = [picture for picture in pictures if first <= picture[0] < last]
    eye = sorted(1000 * (at - begin - number / source.rate) for at, number, _ in counted)
    ear = ear_delays(folder / name, source, here, there.sent["voice"], first, last)
    if not eye or not ear:
        return "nothing arrives"
    count, frozen = freezes(counted, first, last, source.rate)
    own = statistics.mean(psnr(luma, source.luma[number]) for _, number, luma in counted[::3])
    screen = on_screen(pictures, source, begin, statistics.median(eye) / 1000, first, last)
    seen, sent = ({column: [line[column] for line in end.seconds[seconds[0]:seconds[-1] + 1]] for column in call.COLUMNS}
                  for end in (here, there))
    kbit = {column: statistics.mean(sent[column]) for column in ("faces", "voice", "repair", "rtcp", "all", "rate")}
    return (f"{statistics.median(eye):5.0f} {eye[int(0.95 * len(eye))]:5.0f} {eye[-1]:5.0f} {statistics.median(ear):5.0f}"
            f" {count:4d} {frozen:6.2f} {sum(seen['breaks']):4.0f} {sum(seen['broken']):6.2f} {screen:6.2f} {own:6.2f}"
            f" {kbit['faces']:5.1f} {kbit['voice']:5.1f} {kbit['repair']:5.1f} {kbit['rtcp']:5.1f} {kbit['all']:6.1f}"
            f" {kbit['rate']:5.1f} {max(sent['trip']):5.0f} {sum(seen['asked']):4.0f} {sum(sent['given']):4.0f} {last - first:5.1f}")


def table(arguments, sources, folder):
    print("loss      repair      eye  <95%  most   ear freezes s  breaks s   PSNR    own faces voice repair rtcp   all"
          "  rate  trip asked given s")
    seconds = range(arguments.seconds - 1)
    parts = [seconds[max(WARM_UP, len(seconds) * k // arguments.parts):len(seconds) * (k + 1) // arguments.parts]
             for k in range(arguments.parts)]
    for loss in arguments.loss:
        for burst in sorted({0, arguments.burst if loss else 0}):
            for repair in arguments.repair:
                ends = call.talk(folder, sources[0].files, sources[1].files, "--seconds", arguments.seconds, "--loss",
                                 loss / 100, "--burst", burst, "--repair", repair, "--latency", arguments.latency, *NETWORK,
                                 *arguments.options.split(), prefix=arguments.prefix.split())
                for k, (name, source) in enumerate((("a", sources[1]), ("b", sources[0]))):
                    for part in parts:
                        row = measure(folder, name, source, ends[k], ends[1 - k], part)
                        print(f"{loss:3g} {'burst ' if burst else 'random'} {repair:5} {source.files[0].stem[:4]:4} {row}",
                              flush=True)


def join(arguments, sources, folder):
    port = call.free_ports()
    options = ("--latency", arguments.latency, *NETWORK)
    more = {"prefix": arguments.prefix.split()}
    speaker = call.start(folder, "a", sources[0].files, (port, port + 4), "--seconds", 1000, *options, **more)
    for k in range(arguments.join):
        viewer = call.start(folder, "b", sources[1].files, (port + 4, port), "--seconds", 5 + 0.3 * k, *options, **more)
        end = call.read_end(folder / "b", viewer.communicate()[0].decode())
        begin = end.sent["picture"]
        waits = [f"{rows[0].at - begin:5.2f} s" if rows else "never" for rows in (end.pictures, end.voice)]
        print(f"viewer {k + 1}: picture {waits[0]}, sound {waits[1]}", flush=True)
    speaker.terminate()
    speaker.communicate()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("sources", nargs=2)
    parser.add_argument("--seconds", type=int, default=25)
    parser.add_argument("--loss", type=float, nargs="*", default=[0, 1, 5, 10, 20])
    parser.add_argument("--burst", type=float, default=100)
    parser.add_argument("--repair", nargs="*", default=["none", "rtx", "copy", "both"])
    parser.add_argument("--latency", type=int, default=400)
    parser.add_argument("--join", type=int)
    parser.add_argument("--options", default="")
    parser.add_argument("--parts", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--prefix", default="")
    arguments = parser.parse_args()
    sources = [Source(*pair.split(",")) for pair in arguments.sources]
    with tempfile.TemporaryDirectory() as folder:
        (join if arguments.join else table)(arguments, sources, pathlib.Path(folder))
        if arguments.keep:
            shutil.copytree(folder, arguments.keep, dirs_exist_ok=True)


if __name__ == "__main__":
    main()
