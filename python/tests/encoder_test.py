"""Pictures to packets, and to files."""

import threading
import time
from fractions import Fraction

import numpy as np
import pytest
from conftest import PICTURES

import fbs


@pytest.fixture(scope="module")
def pictures(talker):
    """Of the source: planes, as Y4M has them."""
    data = (talker / "talk.y4m").read_bytes().partition(b"\n")[2]
    size = 176 * 144 * 3 // 2
    frames = np.frombuffer(data, np.uint8).reshape(PICTURES, len(b"FRAME\n") + size)[:, 6:]
    y, u, v = np.split(frames, [176 * 144, 176 * 144 * 5 // 4], axis=1)
    return list(zip(y.reshape(-1, 144, 176), u.reshape(-1, 72, 88), v.reshape(-1, 72, 88)))


def encoded(pictures, encoder):
    packets = [packet for picture in pictures for packet in encoder.push(picture)]
    return packets + encoder.finish()


def test_the_stream_is_that_of_the_program(pictures, stream):
    """Read-only planes, and none that owns its memory."""
    packets = encoded(pictures, fbs.Encoder(176, 144, fps=30))
    ours, theirs = list(fbs.Decoder(b"".join(packets))), list(fbs.Decoder(stream))
    assert [picture.tobytes() for picture in ours] == [picture.tobytes() for picture in theirs]
    assert packets[0].key and (packets[0].number, packets[0].time) == (0, 0)
    assert not packets[-1].key and packets[-1].number == PICTURES
    assert packets[-1].time == pytest.approx(PICTURES / 30, abs=1e-4)


def test_planes_of_any_layout_give_the_same_stream(pictures):
    def turned(plane):
        return np.ascontiguousarray(plane[::-1])[::-1]  # rows lie upwards

    def spread(plane):
        wide = np.zeros((plane.shape[0], 2 * plane.shape[1]), np.uint8)
        wide[:, ::2] = plane
        return wide[:, ::2]

    kinds = [
        pictures[:3],
        [[turned(plane) for plane in picture] for picture in pictures[:3]],
        [fbs.Picture(*map(spread, picture)) for picture in pictures[:3]],
    ]
    streams = [b"".join(encoded(kind, fbs.Encoder(176, 144, patterns=1))) for kind in kinds]
    assert streams[1] == streams[0] and streams[2] == streams[0]


def test_rgb_and_an_array_of_all(pictures, tmp_path):
    rgb = np.stack([fbs.Picture(*picture, matrix="bt601").rgb() for picture in pictures[:6]])
    told = []
    path = fbs.encode(rgb, tmp_path / "a.fbs", fps=10, patterns=1, on_progress=lambda *n: told.append(n))
    decoder = fbs.Decoder(path)
    assert (decoder.format.fps, decoder.format.matrix) == (10, "bt601")
    assert told == [(n, 6) for n in range(1, 7)]
    again = np.stack([picture.rgb() for picture in decoder])
    assert np.mean((again[0].astype(int) - rgb[0]) ** 2) < 100


def test_durations_are_kept(pictures):
    encoder = fbs.Encoder(176, 144, patterns=1)
    packets = []
    for picture, duration in zip(pictures, (0.1, 2, 0.04)):
        packets += encoder.push(picture, duration)
    states = fbs.Decoder(b"".join(packets + encoder.finish())).states
    np.testing.assert_allclose(states.duration[:2], [0.1, 2], atol=1e-4)
    np.testing.assert_allclose(states.time, [0, 0.1, 2.1], atol=1e-4)


def test_a_cameras_times_come_back(pictures):
    times = [1e6 + t for t in np.cumsum([0] + [0.12, 0.14, 0.05, 0.9, 0.03, 0.12, 0.1] + [0.13] * (len(pictures) - 8))]
    encoder = fbs.Encoder(176, 144, fps=30, live=True, threads=2)
    packets = []
    for picture, time in zip(pictures, times):
        packets += encoder.push(picture, time=time) + encoder.pull(timeout=60)
    packets += encoder.finish()
    assert packets[-1].pushed_time is None
    for packet in packets[:-1]:
        assert packet.pushed_time == pytest.approx(times[packet.number], abs=1e-4)
    shown = fbs.Decoder(b"".join(packets)).states.time
    firsts = {packet.number for packet in packets}  # a group begins when the encoder expects it to
    others = [n for n in range(len(pictures)) if n not in firsts]
    assert len(others) > len(pictures) / 3
    np.testing.assert_allclose(shown[others], [times[n] - times[0] for n in others], atol=3e-5)
    with pytest.raises(fbs.ArgumentError, match="later"):
        again = fbs.Encoder(176, 144, allow_no_face=True)
        again.push(pictures[0], time=5)
        again.push(pictures[1], time=5)


def test_live_gives_packets_at_once_and_scenes_on_request(pictures):
    with fbs.Encoder(176, 144, fps=30, live=True, threads=1) as encoder:
        first = encoder.push(pictures[0])
        assert first and first[0].key
        assert len(list(fbs.Decoder(b"".join(first)))) <= 1
        packets = first + [packet for picture in pictures[1:8] for packet in encoder.push(picture)]
        encoder.request_scene()
        packets += [packet for picture in pictures[8:] for packet in encoder.push(picture)] + encoder.finish()
        assert sum(packet.key for packet in packets) == 2
        assert encoder.report == (PICTURES, 0, 0, 2) or encoder.report.pictures == PICTURES
    with pytest.raises(fbs.ArgumentError, match="live encoding only"):
        fbs.Encoder(176, 144).request_scene()


def test_a_live_bitrate_may_change(pictures):
    def sizes(then):
        with fbs.Encoder(176, 144, fps=10, live=True, threads=1, bitrate=8) as encoder:
            packets = [packet for picture in pictures[:8] for packet in encoder.push(picture)]
            encoder.set_bitrate(then)
            more = [packet for picture in pictures[8:] for packet in encoder.push(picture)] + encoder.finish()
            return sum(map(len, packets)), sum(map(len, more))

    (before, low), (same, high) = sizes(1), sizes(60)
    assert before == same
    assert low < 0.7 * high
    for wrong in ({"live": True}, {"bitrate": 8}):
        with pytest.raises(fbs.ArgumentError, match="live encoding with a bitrate only"):
            fbs.Encoder(176, 144, **wrong).set_bitrate(5)
    encoder = fbs.Encoder(176, 144, live=True, bitrate=8)
    encoder.push(pictures[0])
    for kbps in (0, -1, float("nan")):
        with pytest.raises(fbs.ArgumentError):
            encoder.set_bitrate(kbps)
    encoder.push(pictures[1])  # goes on as before
    assert encoder.finish()


def test_lost_patterns_are_for_live_encoding():
    fbs.Encoder(64, 64, allow_no_face=True, live=True, resilience="packet").lose_patterns()
    with pytest.raises(fbs.ArgumentError, match="live encoding only"):
        fbs.Encoder(64, 64).lose_patterns()


def test_landmarks_are_there_as_they_are_tracked(pictures):
    encoder = fbs.Encoder(176, 144, fps=30)
    encoder.push(pictures[0])
    assert encoder.landmarks.shape == (68, 2)
    assert np.all((encoder.landmarks > 20) & (encoder.landmarks < 150))
    assert encoder.report.pictures == 1 and encoder.report.without_face == 0


@pytest.mark.parametrize(
    "settings, says",
    [
        ({"width": 63}, "width is 64 to 8192, not 63"),
        ({"quality": 101}, "quality is 0 to 100"),
        ({"effort": 10}, "effort"),
        ({"tune": "ssim"}, "tune"),
        ({"patterns": 65}, "patterns"),
        ({"bitrate": -1}, "bitrate"),
        ({"matrix": "bt2020"}, "matrix"),
        ({"fps": 0}, "fps"),
        ({"fps": float("nan")}, "fps"),
        ({"live_delay": -1}, "live_delay"),
        ({"start": 1}, "start"),
        ({"bitrate": 5, "start": -1}, "start"),
    ],
)
def test_settings_out_of_range_are_named(settings, says):
    with pytest.raises(fbs.ArgumentError, match=says):
        fbs.Encoder(**{"width": 176, "height": 144, **settings})


def test_rates_of_television_are_ratios():
    rates = {29.97: Fraction(30000, 1001), 23.976: Fraction(24000, 1001), 59.94: Fraction(60000, 1001), 12.5: Fraction(25, 2)}
    for fps, meant in rates.items():
        assert fbs.Encoder(64, 64, fps=fps).format.fps == meant


def test_wrong_pictures_are_refused_and_the_rest_goes_on(pictures):
    encoder = fbs.Encoder(176, 144, patterns=1)
    wrong = [
        np.zeros((144, 174, 3), np.uint8),
        np.zeros((144, 176, 3)),
        np.zeros((144, 176), np.uint8),
        pictures[0][:2],
        (pictures[0][0], pictures[0][1], pictures[0][1][:, :87]),
        fbs.Picture(*pictures[0], matrix="bt709"),
        fbs.Picture(*pictures[0], full_range=True),
    ]
    for picture in wrong:
        with pytest.raises(fbs.ArgumentError):
            encoder.push(picture)
    with pytest.raises(fbs.ArgumentError, match="at most 60 s"):
        encoder.push(pictures[0], duration=61)
    assert len(list(fbs.Decoder(b"".join(encoded(pictures[:3], encoder))))) == 3
    with pytest.raises(fbs.ArgumentError, match="has ended"):
        encoder.push(pictures[0])


def test_pictures_without_a_face(tmp_path):
    grey = np.full((4, 64, 64, 3), 90, np.uint8)
    with pytest.raises(fbs.NoFaceError, match="no face"):
        fbs.encode(grey, tmp_path / "grey.fbs")
    assert list(tmp_path.iterdir()) == []
    assert len(fbs.decode(fbs.encode(grey, tmp_path / "grey.fbs", allow_no_face=True))) == 4


def test_what_ends_early_leaves_no_file(tmp_path, pictures):
    def interrupted():
        yield from pictures[:2]
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fbs.encode(interrupted(), tmp_path / "a.fbs")
    with pytest.raises(fbs.ArgumentError, match="there is no picture"):
        fbs.encode([], tmp_path / "a.fbs")
    with pytest.raises(fbs.FileError, match="cannot write"):
        fbs.encode(pictures, tmp_path / "none" / "a.fbs")
    for settings in ({"quality": 50, "bitrate": 5}, {"options": ["--overlay", "a.mp4"]}):
        with pytest.raises(fbs.ArgumentError):
            fbs.encode(pictures, tmp_path / "a.fbs", **settings)
    assert list(tmp_path.iterdir()) == []


def test_other_threads_run_while_an_encoder_works(pictures):
    """The interpreter's lock is free: this thread counts while another waits in finish()."""
    encoder = fbs.Encoder(176, 144, fps=30)
    for picture in pictures:
        encoder.push(picture)
    stamps = [time.perf_counter()]
    worker = threading.Thread(target=encoder.finish)
    worker.start()
    while worker.is_alive():
        time.sleep(0.001)
        stamps.append(time.perf_counter())
    longest, took = max(np.diff(stamps)), stamps[-1] - stamps[0]
    assert longest < took / 2, (longest, took)
