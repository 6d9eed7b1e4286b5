"""Dead links and anchors in all Markdown of the repository, pages of docs/ that the book leaves out, and wide lines.

    python3 docs/check_links.py

Links are checked as they stand in the repository. The book turns them (book.py), so that both hold.
"""

import re
import sys
from pathlib import Path

from book import DOCS, LINK, ROOT, without_code

SKIPPED = {"target", "node_modules", ".git", ".venv"}
WIDTH = 130
# written by the program itself; tables and code may be wider anywhere
WRITTEN = {"keys-scenario.md", "keys-study.md", "cards.md", "LICENSES.md"}


def pages(folder):
    """All Markdown below a folder."""
    for path in sorted(folder.iterdir()):
        if path.is_dir() and path.name not in SKIPPED and not path.is_symlink():
            yield from pages(path)
        elif path.suffix == ".md":
            yield path


def anchors(text):
    """Anchors that the headings of a page give, as the web and the book make them."""
    found = {}
    names = set(re.findall(r'<a (?:id|name)="([^"]+)"', text))
    for heading in re.findall(r"^#+ +(.*?) *#*$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
        name = re.sub(r"[^\w\- ]", "", plain).strip().replace(" ", "-")
        found[name] = found.get(name, -1) + 1
        names.add(f"{name}-{found[name]}" if found[name] else name)
    return names


def dead(page, texts):
    """Links of a page that lead nowhere, each with its line."""
    text = without_code(texts[page])
    for link in LINK.finditer(text):
        file, _, anchor = link[3].partition("#")
        if re.match(r"[a-z]+:", link[3]):
            continue
        target = (page.parent / file).resolve() if file else page
        line = text.count("\n", 0, link.start()) + 1
        if not target.exists():
            yield f"{page.relative_to(ROOT)}:{line}: {link[3]}: no such file"
        elif anchor and target in texts and anchor not in anchors(texts[target]):
            yield f"{page.relative_to(ROOT)}:{line}: {link[3]}: no such heading"


def wide(page, text):
    """Lines of prose wider than code is."""
    if page.name in WRITTEN:
        return
    for number, line in enumerate(without_code(text).splitlines(), 1):
        full = text.splitlines()[number - 1]
        if len(full) > WIDTH and line.strip() and not full.lstrip().startswith(("|", "[", "<!--", "![")):
            yield f"{page.relative_to(ROOT)}:{number}: {len(full)} characters, at most {WIDTH}: python3 docs/wrap.py"


def faults():
    """All that is wrong."""
    texts = {path: path.read_text() for path in pages(ROOT)}
    for page, text in texts.items():
        yield from dead(page, texts)
        yield from wide(page, text)
    summary = DOCS / "SUMMARY.md"
    chapters = [(DOCS / link[3]).resolve() for link in LINK.finditer(texts[summary])]
    for page in sorted({page for page in chapters if chapters.count(page) > 1}):
        yield f"docs/SUMMARY.md: {page.relative_to(ROOT)} stands twice"
    for page in texts:
        if page.is_relative_to(DOCS) and page != summary and page not in chapters:
            yield f"docs/SUMMARY.md: {page.relative_to(ROOT)} is not in the book"


if __name__ == "__main__":
    found = list(faults())
    print("\n".join(found), file=sys.stderr, end="\n" if found else "")
    sys.exit(bool(found))
