"""Errors of a stream (SPEC 7)."""


class StreamError(Exception):
    """A rule of the format that a stream breaks.

    code is one of kNotFbs, kTruncated, kInvalidStream, kUnsupported and kTooLarge.
    """

    def __init__(self, code, text):
        super().__init__(f"{code}: {text}")
        self.code = code


def truncated(text):
    return StreamError("kTruncated", text)


def invalid(text):
    return StreamError("kInvalidStream", text)


def unsupported(text):
    return StreamError("kUnsupported", text)


def too_large(text):
    return StreamError("kTooLarge", text)
