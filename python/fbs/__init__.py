"""fbs, a video codec for talking heads."""
