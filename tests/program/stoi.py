"""Short-time objective intelligibility of degraded speech: 1 is clean, about 0.9 loses no word, 0.6 loses half of them.

C. Taal, R. Hendriks, R. Heusdens, J. Jensen: An Algorithm for Intelligibility Prediction of Time-Frequency Weighted Noisy
Speech, IEEE Transactions on Audio, Speech, and Language Processing 19 (7), 2011."""
import numpy

RATE = 10000               # Hz, of the samples
FRAME, HOP, FFT = 256, 128, 512
BANDS, LOWEST = 15, 150.0  # third octaves; centre of the lowest, Hz
SEGMENT = 30               # frames: 384 ms
CLIP = 1 + 10 ** (15 / 20)  # lowest signal-to-distortion ratio -15 dB
RANGE = 40                 # dB below the loudest frame: silence
WINDOW = numpy.hanning(FRAME + 2)[1:-1]


def frames_of(samples):
    starts = range(0, len(samples) - FRAME + 1, HOP)
    return numpy.array([samples[i:i + FRAME] for i in starts]) * WINDOW


def overlap_add(frames):
    out = numpy.zeros((len(frames) - 1) * HOP + FRAME)
    for i, frame in enumerate(frames):
        out[i * HOP:i * HOP + FRAME] += frame
    return out


def without_silence(clean, degraded):
    """Both without the frames in which `clean` is silent."""
    x, y = frames_of(clean), frames_of(degraded)
    loudness = 20 * numpy.log10(numpy.linalg.norm(x, axis=1) + 1e-12)
    heard = loudness > loudness.max() - RANGE
    return overlap_add(x[heard]), overlap_add(y[heard])


def third_octaves():
    """Which bins of the spectrum belong to each band: BANDS x (FFT / 2 + 1)."""
    frequencies = numpy.arange(FFT // 2 + 1) * RATE / FFT
    nearest = lambda f: int(numpy.argmin(numpy.abs(frequencies - f)))
    bands = numpy.zeros((BANDS, len(frequencies)))
    for k in range(BANDS):
        bands[k, nearest(LOWEST * 2 ** ((2 * k - 1) / 6)):nearest(LOWEST * 2 ** ((2 * k + 1) / 6))] = 1
    return bands


def band_envelopes(samples):
    """Eq. (1): magnitude by band and frame."""
    power = numpy.abs(numpy.fft.rfft(frames_of(samples), FFT)) ** 2
    return numpy.sqrt(third_octaves() @ power.T)


def normalised(x):
    x = x - x.mean(axis=-1, keepdims=True)
    return x / (numpy.linalg.norm(x, axis=-1, keepdims=True) + 1e-12)


def stoi(clean, degraded):
    """Of samples at RATE, aligned and of equal length, with at least half a second of speech."""
    x, y = (band_envelopes(samples) for samples in without_silence(clean, degraded))
    scores = []
    for end in range(SEGMENT, x.shape[1] + 1):
        xs, ys = x[:, end - SEGMENT:end], y[:, end - SEGMENT:end]
        gain = numpy.linalg.norm(xs, axis=1, keepdims=True) / (numpy.linalg.norm(ys, axis=1, keepdims=True) + 1e-12)
        clipped = numpy.minimum(gain * ys, CLIP * xs)                      # Eq. (3)
        scores.append((normalised(xs) * normalised(clipped)).sum(axis=1))  # Eq. (5)
    return float(numpy.mean(scores))                                       # Eq. (6)
