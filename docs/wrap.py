"""Wraps the prose of Markdown files at 128 characters; code, tables and headings stay, and so does every word.

    python3 docs/wrap.py            all files in which check_links.py finds wide lines
    python3 docs/wrap.py FILE...    these

A paragraph is touched only if one of its lines is too wide.
"""

import re
import sys
from pathlib import Path

from check_links import ROOT, WIDTH, pages, wide

ATOM = re.compile(r"(`[^`]*`|!?\[(?:[^\[\]]|\[[^\]]*\])*\]\([^)]*\))")
ITEM = re.compile(r"\s*(?:[-*+]|\d+\.)\s+")
FILL = WIDTH - 2


def words(text):
    """Words of a text; code and links are one word each."""
    parts = ATOM.split(text)
    joined = "".join(part.replace(" ", "\0") if i % 2 else part for i, part in enumerate(parts))
    return [word.replace("\0", " ") for word in joined.split()]


def filled(text, first, rest):
    """Lines of a paragraph; none begins with what would make a list, a heading or a quote of it."""
    lines, line = [], first
    for i, word in enumerate(words(text)):
        if i and len(line) + 1 + len(word) > FILL and not re.fullmatch(r"[-+*#>|]+|\d+[.)]", word):
            lines.append(line)
            line = rest + word
        else:
            line += word if i == 0 else " " + word
    return [*lines, line]


def wrapped(text):
    """A page with its wide paragraphs wrapped."""
    out, lines, in_code, i = [], text.split("\n"), False, 0

    def stays(line):
        return in_code or not line.strip() or line.lstrip().startswith(("|", "#", ">", "<", "```", "![")) or line[:4] == "    "

    while i < len(lines):
        line = lines[i]
        in_code ^= line.lstrip().startswith("```")
        if stays(line):
            out.append(line)
            i += 1
            continue
        end = i + 1
        while end < len(lines) and not stays(lines[end]) and not ITEM.match(lines[end]):
            end += 1
        paragraph = lines[i:end]
        if max(map(len, paragraph)) > WIDTH:
            item = ITEM.match(line)
            first = (item or re.match(r"\s*", line)).group()
            rest = " " * len(first)
            paragraph = filled(" ".join([line[len(first) :], *paragraph[1:]]), first, rest)
        out += paragraph
        i = end
    return "\n".join(out)


if __name__ == "__main__":
    chosen = [Path(name).resolve() for name in sys.argv[1:]]
    for page in chosen or [page for page in pages(ROOT) if any(wide(page, page.read_text()))]:
        page.write_text(wrapped(page.read_text()))
