"""Memory stays where it is, however many pictures are decoded. --pictures 10000 takes longer and is more certain."""

import gc
import os
import tracemalloc

import pytest
from conftest import PICTURES, VECTORS

import fbs

SLACK = 3 << 20  # bytes: of the allocator's own. A picture has 38 kB
PYTHON_SLACK = 100_000


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def grows(body, rounds):
    """By how many bytes the process and Python's own objects grow from the first tenth of the rounds to the last."""
    for _ in range(max(1, rounds // 10)):
        body()
    gc.collect()
    tracemalloc.start()
    before = resident(), tracemalloc.get_traced_memory()[0]
    for _ in range(rounds):
        body()
    gc.collect()
    after = resident(), tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    return after[0] - before[0], after[1] - before[1]


def check(body, rounds):
    process, python = grows(body, rounds)
    print(f"{rounds} rounds: the process grew by {process} bytes, Python's objects by {python}")
    assert process < SLACK and python < PYTHON_SLACK


def test_of_a_decoder_that_goes_on_for_ever(stream, request):
    decoder = fbs.Decoder(stream)

    def once_through():
        decoder.seek(0)
        for picture in decoder:
            picture.rgb()
            assert decoder.state is not None and decoder.landmarks is not None

    check(once_through, request.config.getoption("pictures") // PICTURES)


def test_of_decoders_states_and_errors(stream, request):
    damaged = (VECTORS / "flipped_bits.fbs").read_bytes()

    def once():
        assert len(fbs.Decoder(stream).states) == PICTURES
        for wrong in (damaged, b"no stream"):
            with pytest.raises(fbs.Error):
                list(fbs.Decoder(wrong))

    check(once, request.config.getoption("pictures") // PICTURES)


def test_of_encoders(stream, request):
    picture = next(fbs.Decoder(stream))

    def once():
        encoder = fbs.Encoder(176, 144, patterns=1)
        encoder.push(picture)
        encoder.finish()

    check(once, request.config.getoption("pictures") // 40)
