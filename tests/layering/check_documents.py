#!/usr/bin/env python3
"""Documents name files that exist, and code that does: links with their #anchors, pictures, paths, file names, and in
docs/paper.md the names in `code` spans too. Run from anywhere; prints what is wrong, with its line."""

import glob
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCUMENTS = ["README.md", "CONTRIBUTING.md", "bitstream/SPEC.md", "docs/*.md", "docs/pictures/*.svg",
             "samples/README.md", "samples/*/README.md", "tests/*/README.md", "web/README.md", "web/*/README.md",
             "web/samples/*/README.md"]
WITH_SYMBOLS = ["docs/paper.md"]
FOLDERS = "bitstream|cli|common|decoder|docs|encoder|gstreamer|include|library|python|samples|scripts|tests|web"
SUFFIXES = "c|cpp|h|hpp|py|cmake|sh|md|svg"
# Named in documents, but not ours to have.
ELSEWHERE = {"measure.py"}

LINK = re.compile(r"\]\(([^)#]*)#?([^)]*)\)")
PICTURE = re.compile(r'(?:src|srcset)="([^"]+)"')
PATH = re.compile(rf"(?<![\w./-])(?:{FOLDERS})/[\w./*-]*(?:\{{[\w,]+\}})?[\w./*-]*")
FILE = re.compile(rf"(?<![\w./*%-])\w[\w-]*\.(?:{SUFFIXES})\b")
CODE = re.compile(r"`([^`]+)`")
NAME = re.compile(r"[A-Za-z_]\w*")


def repository_files():
    """Paths below ROOT, without what is built or ignored."""
    skip = {".git", "build", "out", "__pycache__"}
    return [path.relative_to(ROOT) for path in ROOT.rglob("*")
            if path.is_file() and not skip & set(path.relative_to(ROOT).parts)]


def braces(path):
    """a/{b,c} as a/b and a/c."""
    before, opening, rest = path.partition("{")
    if not opening:
        return [path]
    inside, _, after = rest.partition("}")
    return [before + word + after for word in inside.split(",")]


def exists(path):
    """A path, a glob pattern, or a source without its suffix."""
    path = path.rstrip(".")
    return any(glob.glob(str(ROOT / (path + suffix))) for suffix in ("", ".h", ".cpp"))


def anchors(document):
    """Of the headings, as GitHub makes them."""
    text = re.sub(r"```.*?```", "", document.read_text(), flags=re.S)
    headings = [LINK.sub("]", heading) for heading in re.findall(r"(?m)^#+ +(.*?) *$", text)]
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def faults(document, file_names, symbols):
    for number, line in enumerate(document.read_text().splitlines(), 1):
        where = f"{document.relative_to(ROOT)}:{number}"
        for target, anchor in LINK.findall(line) + [(picture, "") for picture in PICTURE.findall(line)]:
            linked = document.parent / target if target else document
            if "://" in target:
                continue
            if not linked.exists():
                yield f"{where}: no file {target}"
            elif anchor and anchor not in anchors(linked):
                yield f"{where}: no heading {target}#{anchor}"
        without_links = LINK.sub("]", line)
        for path in PATH.findall(without_links):
            for one in braces(path):
                if not exists(one):
                    yield f"{where}: no file {one}"
        for name in FILE.findall(PATH.sub("", without_links)):
            if name not in file_names:
                yield f"{where}: no file called {name}"
        if symbols:
            for code in CODE.findall(line):
                # Only what looks like a name of ours: no commands, formulas or options.
                if re.fullmatch(r"[A-Za-z_:]\w*(?:::\w+)*(?:\(\))?", code):
                    for name in NAME.findall(code):
                        if name not in symbols:
                            yield f"{where}: nothing is called {name}"


def main():
    files = repository_files()
    file_names = {path.name for path in files} | ELSEWHERE
    symbols = set()
    for path in files:
        if path.suffix in (".c", ".h", ".hpp", ".cpp", ".py") and path.name != pathlib.Path(__file__).name:
            symbols.update(NAME.findall((ROOT / path).read_text()))
    documents = sorted(path for pattern in DOCUMENTS for path in ROOT.glob(pattern))
    assert len(documents) > 8, f"only {len(documents)} documents in {ROOT}"
    found = [fault for document in documents
             for fault in faults(document, file_names,
                                 symbols if str(document.relative_to(ROOT)) in WITH_SYMBOLS else None)]
    print("\n".join(found + [f"{len(documents)} documents, {len(found)} faults"]))
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
