"""Pictures and states of the decoder."""

import dataclasses
import gc
import hashlib
import io
import re
import sys
import threading

import numpy as np
import pytest
from conftest import PICTURES, SOURCE, VECTORS

import fbs
from fbs import _program

TABLE = [line.split() for line in (VECTORS / "vectors.txt").read_text().splitlines() if line[0] != "#"]
CLASSES = {
    "kNotFbs": fbs.NotFbsError,
    "kTruncated": fbs.TruncatedError,
    "kInvalidStream": fbs.DamagedError,
    "kUnsupported": fbs.UnsupportedError,
    "kTooLarge": fbs.TooLargeError,
}


def digest(pictures):
    md5 = hashlib.md5()
    count = 0
    for picture in pictures:
        md5.update(picture.tobytes())
        count += 1
    return count, md5.hexdigest()


@pytest.mark.parametrize("name, error, pictures, md5", TABLE, ids=[row[0] for row in TABLE])
def test_vectors_have_the_pictures_and_the_errors_of_their_table(name, error, pictures, md5):
    if error == "kNotFbs":
        with pytest.raises(fbs.NotFbsError):
            fbs.Decoder(VECTORS / name, keep_going=True)
        return
    with fbs.Decoder(VECTORS / name, keep_going=True) as decoder:
        assert digest(decoder) == (int(pictures), md5)
        assert [type(found) for found in decoder.errors[:1]] == [CLASSES[e] for e in [error] if e != "-"]


def test_pictures_are_those_of_the_program(stream):
    printed = _program.run(["decode", stream, "--md5"]).splitlines()
    ours = [f"{hashlib.md5(picture.tobytes()).hexdigest()} {picture.number}" for picture in fbs.Decoder(stream)]
    assert [re.sub(r"\s+", " ", line.strip()) for line in printed] == ours


def test_pictures_of_a_person_are_those_of_the_program(tmp_path):
    clip = SOURCE.parent / "shared/clips/akiyo_cif.mkv"
    if not clip.exists():
        pytest.skip(f"no {clip}")
    path = fbs.encode(clip, tmp_path / "clip.fbs", effort=0, options=["--frames", "40"])
    printed = [line.split()[0] for line in _program.run(["decode", path, "--md5"]).splitlines()]
    assert printed == [hashlib.md5(picture.tobytes()).hexdigest() for picture in fbs.Decoder(path)]
    assert np.ptp(fbs.Decoder(path).states.landmarks, axis=(0, 1)).min() > 50


def test_damage_is_raised_once_and_decoding_goes_on():
    decoder = fbs.Decoder(VECTORS / "lost_scene.fbs")
    before = 0
    with pytest.raises(fbs.DamagedError) as raised:
        for _ in decoder:
            before += 1
    assert raised.value.offset > 0
    assert before > 0 and before + len(list(decoder)) == 26


def test_what_is_no_stream_is_refused_at_once(tmp_path, video):
    with pytest.raises(fbs.FileError, match=r"cannot read .*none\.fbs: No such file"):
        fbs.Decoder(tmp_path / "none.fbs")
    with pytest.raises(fbs.NotFbsError, match=r"talk\.y4m: not an fbs stream"):
        fbs.Decoder(video)
    with pytest.raises(fbs.Error):
        fbs.Decoder(b"")
    with pytest.raises(fbs.ArgumentError, match="a path, bytes, or a binary file, not int"):
        fbs.Decoder(3)
    with pytest.raises(fbs.TooLargeError):
        fbs.Decoder(VECTORS / "talk.fbs", max_pixels=1000)


@pytest.mark.parametrize("size", [1, 1000])
def test_bytes_in_pieces_give_the_same_pictures(stream, size):
    data = stream.read_bytes()
    decoder = fbs.Decoder()
    pictures = []
    with pytest.raises(fbs.ArgumentError, match="not known yet"):
        decoder.format
    for at in range(0, len(data), size):
        decoder.feed(data[at : at + size])
        pictures += decoder
    decoder.finish()
    pictures += decoder
    assert digest(pictures) == digest(fbs.Decoder(stream))
    with pytest.raises(fbs.ArgumentError, match="of a path or of bytes"):
        decoder.seek(0)


def test_files_are_read_as_pictures_are_asked_for(stream):
    class Slow(io.RawIOBase):
        """Gives 100 bytes at a time, as a pipe may."""

        asked = 0

        def read(self, size=-1):
            self.asked += 1
            return file.read(100)

    with open(stream, "rb") as file:
        source = Slow()
        decoder = fbs.Decoder(source)
        assert source.asked == 0
        assert decoder.format.width == 176
        assert digest(decoder) == digest(fbs.Decoder(stream))


def test_a_matroska_file_may_have_the_stream(stream, tmp_path, video):
    _program.run(["remux", stream, tmp_path / "talk.mkv"])
    assert digest(fbs.Decoder(tmp_path / "talk.mkv")) == digest(fbs.Decoder(stream))
    _program.run(["decode", stream, tmp_path / "other.mkv"])
    with pytest.raises(fbs.Error, match=r"other\.mkv"):
        fbs.Decoder(tmp_path / "other.mkv")


def test_pictures_own_their_memory(stream):
    decoder = fbs.Decoder(stream)
    first = next(decoder)
    before = first.tobytes()
    planes = first.planes
    list(decoder)
    decoder.close()
    del decoder, first
    gc.collect()
    assert b"".join(plane.tobytes() for plane in planes) == before
    assert planes[0].base is planes[1].base and not planes[0].flags.owndata  # one allocation, three views


def test_drawing_into_arrays_of_ones_own(stream):
    decoder = fbs.Decoder(stream)
    expected = next(decoder)
    wide = np.zeros((144, 200), np.uint8)  # rows that are longer than the picture's
    upside_down = np.zeros((72, 88), np.uint8)[::-1]
    drawn = decoder.draw(out=(wide[:, 4:180], upside_down, np.zeros((72, 88), np.uint8)))
    assert drawn.y.base is wide
    assert drawn.tobytes() == expected.tobytes()
    assert not wide[:, :4].any() and not wide[:, 180:].any()
    again = fbs.Picture.empty(176, 144)
    assert decoder.draw(out=again) is again and again.tobytes() == expected.tobytes()
    for wrong in (fbs.Picture.empty(176, 146), (wide[:, ::2], upside_down, upside_down)):
        with pytest.raises(fbs.ArgumentError):
            decoder.draw(out=wrong)
    read_only = np.zeros((144, 176), np.uint8)
    read_only.flags.writeable = False
    with pytest.raises(fbs.ArgumentError, match="read-only"):
        decoder.draw(out=(read_only, upside_down, upside_down))


def packets_of(stream):
    """Its packets, with their checks (SPEC 3.1)."""
    at, packets = 4, []
    while at < len(stream):
        begin, length, shift, at = at, 0, 0, at + 1
        while True:
            length |= (stream[at] & 127) << shift
            shift, at = shift + 7, at + 1
            if stream[at - 1] < 128:
                break
        at += length + (2 if length < 256 else 3)
        packets.append(stream[begin:at])
    return packets


def test_packets_of_a_link_may_be_missing_or_late():
    stream = (VECTORS / "live.fbs").read_bytes()
    whole = [picture.tobytes() for picture in fbs.Decoder(stream)]
    packets = packets_of(stream)
    lost = next(k for k, packet in enumerate(packets) if packet[0] == 11) + 1  # a unit

    def decoder_behind_the_loss():
        decoder = fbs.Decoder()
        for k, packet in enumerate(packets[: lost + 2]):
            if k != lost:
                decoder.feed_packet(k, packet)
        return decoder

    decoder = decoder_behind_the_loss()
    assert {picture.quality for picture in decoder} == {"exact"}  # it is waited for
    assert decoder.missing == [lost]
    assert decoder.skip_missing()
    assert {picture.quality for picture in decoder} > {"exact"}
    assert not decoder.skip_missing()
    assert not decoder.needs_scene
    decoder.packets_lost(lost + 1)
    assert decoder.missing == []

    decoder = decoder_behind_the_loss()
    decoder.feed_packet(lost, packets[lost])
    for k in range(lost + 2, len(packets)):
        decoder.feed_packet(k, packets[k])
    decoder.finish()
    assert [picture.tobytes() for picture in decoder] == whole
    with pytest.raises(fbs.ArgumentError):
        fbs.Decoder(stream).feed_packet(0, b"")

    decoder = fbs.Decoder()
    for k in range(2, 9):  # the head of the scene is lost
        decoder.feed_packet(k, packets[k])
    assert list(decoder) == [] and not decoder.needs_scene
    assert decoder.skip_missing()
    assert list(decoder) == [] and decoder.needs_scene
    with pytest.raises(fbs.ArgumentError):
        decoder.feed(stream)


@pytest.mark.parametrize("name", ["talk.fbs", "joined.fbs", "late.fbs", "durations.fbs", "two_heads.fbs", "lost_scene.fbs"])
def test_seeking_finds_every_picture(name):
    decoder = fbs.Decoder(VECTORS / name, keep_going=True)
    pictures = [(p.number, p.time, p.duration, p.tobytes()) for p in decoder if not p.held]
    for number, time, duration, data in reversed(pictures):
        decoder.seek(number=number)
        found = next(decoder)
        assert (found.number, found.tobytes()) == (number, data)
        decoder.seek(time + duration / 2)
        assert decoder.info.number == next(decoder).number == number
    decoder.seek(1e6)
    assert list(decoder) == []
    for wrong in ({"time": -1}, {"number": -1}, {"time": 1, "number": 1}, {}, {"time": float("nan")}):
        with pytest.raises(fbs.ArgumentError):
            decoder.seek(**wrong)


def test_seeking_reads_no_scene_before_the_one_it_needs():
    data = bytearray((VECTORS / "two_heads.fbs").read_bytes())
    first, second = fbs.Decoder(data).scenes
    data[first.offset + 1000] ^= 255
    decoder = fbs.Decoder(data)
    decoder.seek(number=second.number)
    assert next(decoder).number == second.number
    with pytest.raises(fbs.DamagedError):
        decoder.seek(number=first.number)


def test_scenes_are_where_decoding_can_begin():
    data = (VECTORS / "two_heads.fbs").read_bytes()
    decoder = fbs.Decoder(data)
    begins = [picture.number for picture in decoder if picture.new_scene]
    assert [scene.number for scene in decoder.scenes] == begins == [0, 6]
    last = fbs.Decoder()
    last.feed(data[:4] + data[decoder.scenes[-1].offset :])
    assert next(last).new_scene


def test_states_are_those_of_each_picture(stream):
    decoder = fbs.Decoder(stream)
    states = decoder.states
    assert len(states) == PICTURES and states.has_face.all()
    assert states.landmarks.shape == (PICTURES, 68, 2) and states.control_points.shape == (PICTURES, 36, 2)
    for row in range(PICTURES):
        info = decoder.advance()
        assert (info.number, info.time) == (states.number[row], states.time[row])
        one, many = decoder.state, states[row]
        np.testing.assert_array_equal(one.control_points, many.control_points)
        np.testing.assert_array_equal(
            dataclasses.astuple(one)[:6], dataclasses.astuple(many)[:6]
        )
        np.testing.assert_array_equal(decoder.landmarks, states.landmarks[row])
        np.testing.assert_array_equal(decoder.confidence, states.confidence[row])
        np.testing.assert_array_equal(decoder.blendshapes, states.blendshapes[row])
        assert decoder.vertices.shape == (105, 3)
    assert np.ptp(states.yaw) > 1 and np.all(states.confidence <= 1)
    assert np.all(np.abs(states.position - [88, 64]) < 30)


def test_pictures_without_a_face_have_no_state():
    decoder = fbs.Decoder(VECTORS / "nobody.fbs")
    next(decoder)
    assert decoder.state is decoder.landmarks is decoder.confidence is decoder.vertices is decoder.blendshapes is None
    assert decoder.edited(yaw=1) is None
    with pytest.raises(fbs.NoFaceError):
        decoder.render(fbs.FaceState(0, 0, 0, 80, 60, 20, np.zeros((36, 2))))
    states = decoder.states
    assert not states.has_face.any() and np.isnan(states.landmarks).all() and list(states) == [None] * 4


def test_the_state_that_was_sent_draws_the_picture_that_was_sent(stream):
    decoder = fbs.Decoder(stream)
    for row, picture in enumerate(decoder):
        assert decoder.render(decoder.state).tobytes() == picture.tobytes()
        assert decoder.render(decoder.states[row]).tobytes() == picture.tobytes()
        assert decoder.draw().tobytes() == picture.tobytes()


def test_an_edited_state_turns_the_head(stream):
    decoder = fbs.Decoder(stream)
    as_sent = next(decoder)
    edited = decoder.edited(yaw=10, mouth=1)
    assert edited.yaw == pytest.approx(decoder.state.yaw + 10, abs=0.1)
    out = fbs.Picture.empty(176, 144)
    assert decoder.render(edited, out=out) is out and out.number == as_sent.number
    change = np.abs(out.y.astype(int) - as_sent.y)
    assert change[40:110, 60:120].mean() > 5 > change[:20, :20].mean()
    by_hand = decoder.render(dataclasses.replace(decoder.state, yaw=decoder.state.yaw + 10))
    assert by_hand.tobytes() != as_sent.tobytes()
    for wrong in ({"yaw": 91}, {"pitch": float("nan")}, {"control_points": np.zeros((36, 3))}, {"eye_distance": 0}):
        with pytest.raises(fbs.ArgumentError):
            decoder.render(dataclasses.replace(edited, **wrong))
    with pytest.raises(fbs.ArgumentError):
        decoder.edited(yaw=float("nan"))


def test_states_of_a_damaged_stream():
    with pytest.raises(fbs.DamagedError):
        fbs.Decoder(VECTORS / "lost_scene.fbs").states
    states = fbs.Decoder(VECTORS / "lost_scene.fbs", keep_going=True).states
    assert len(states) == 26 and states.held.any()


def test_calls_that_make_no_sense():
    decoder = fbs.Decoder()
    with pytest.raises(fbs.ArgumentError, match="no picture yet"):
        decoder.draw()
    decoder.close()
    decoder.close()
    with pytest.raises(fbs.ArgumentError, match="closed"):
        decoder.feed(b"")
    with pytest.raises(fbs.ArgumentError, match="by itself"):
        fbs.Decoder(VECTORS / "talk.fbs").feed(b"")
    for threads in (-1, 65):
        with pytest.raises(fbs.ArgumentError, match="threads"):
            fbs.Decoder(threads=threads)


@pytest.fixture
def hasty_threads():
    """Threads change places wherever they can."""
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(interval)


def test_threads_share_one_decoder_and_several_run_side_by_side(stream, hasty_threads):
    expected = digest(fbs.Decoder(stream))
    for _ in range(10):
        shared, drawn, digests = fbs.Decoder(stream), [], []
        targets = [lambda: drawn.extend(shared)] * 3 + [lambda: digests.append(digest(fbs.Decoder(stream, threads=2)))]
        threads = [threading.Thread(target=target) for target in targets]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert digest(sorted(drawn, key=lambda picture: picture.number)) == expected and digests == [expected]
