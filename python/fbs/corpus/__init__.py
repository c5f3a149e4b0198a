"""Encodes, measures and compares whole folders of clips as Dask tasks: ``python -m fbs.corpus DIR --out RESULTS``.

The pages of the documentation are in docs/corpus.md.
"""
