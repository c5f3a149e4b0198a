"""What fbs.track() returns."""

import sys

import numpy as np
import pytest

import fbs


def test_with_pandas_it_is_a_data_frame(stream):
    pandas = pytest.importorskip("pandas")
    table = fbs.track(stream)
    assert isinstance(table, pandas.DataFrame)
    assert table.success.dtype == np.int64 and table.rx_deg.dtype == np.float64


def test_without_pandas_it_is_the_same_columns(stream, monkeypatch):
    before = fbs.track(stream)
    monkeypatch.setitem(sys.modules, "pandas", None)
    table = fbs.track(stream)
    assert type(table) is dict and list(table) == list(before)
    for name, column in table.items():
        np.testing.assert_array_equal(column, before[name])


def test_a_stream_has_what_its_states_have(stream):
    table, states = fbs.track(stream), fbs.Decoder(stream).states
    np.testing.assert_allclose(table["timestamp"], states.time, atol=1e-3)
    np.testing.assert_allclose(table["rx_deg"], states.pitch, atol=1e-2)
    np.testing.assert_allclose(table["ry_deg"], states.yaw, atol=1e-2)
    np.testing.assert_allclose(table["rz_deg"], states.roll, atol=1e-2)
    np.testing.assert_allclose(table["x30"], states.landmarks[:, 30, 0], atol=1e-2)
    for k, name in enumerate(fbs.BLENDSHAPES):
        np.testing.assert_allclose(table[name], states.blendshapes[:, k], atol=1e-3)
    np.testing.assert_allclose(table["scale"], states.eye_distance, atol=1e-2)


def test_settings_of_tracking_are_not_for_streams(stream):
    with pytest.raises(fbs.ArgumentError, match="for videos"):
        fbs.track(stream, frames=3)


def test_a_video_is_tracked(video, stream):
    told = []
    table = fbs.track(video, frames=8, on_progress=lambda *n: told.append(n))
    assert list(table) == list(fbs.track(stream)) and len(table["frame"]) == 8
    assert np.all(table["success"] == 1) and np.all(table["confidence"] > 0.5)
    assert told[-1][0] == 8
