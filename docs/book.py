"""Preprocessor of the book (mdBook runs it, see book.toml).

Pages are next to what they describe: in docs/, in crates, with the scenarios. The book gives each page its own path and
changes the links between them. A link to a file that is not a page becomes the file's name, or a link into `repository` if
book.toml names one. A comment `<!-- occupant channels -->` is replaced by the output of that command, if the command is
built (or named in the environment as OCCUPANT); in the repository the comment is invisible.
"""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\[\]]*\])*)\]\(([^()\s]+)\)")
CODE = re.compile(r"^(?:```.*?^```[^\n]*$|~~~.*?^~~~[^\n]*$)|`[^`\n]*`", re.M | re.S)
PRINTED = re.compile(r"^<!-- occupant ([^>]*?) -->$", re.M)


def place(page):
    """Path of a page in the book: its path in the repository without the folders `crates` and `docs`."""
    parts = page.relative_to(ROOT).parts
    return Path(*(part for part in parts if part not in ("crates", "docs")))


def without_code(text):
    """The text with code replaced by blanks, so that positions stay the same."""
    return CODE.sub(lambda code: re.sub(r"[^\n]", " ", code.group()), text)


def with_links(text, change):
    """The text with each link in it changed: `change` takes mark, words and target."""
    kept, end = [], 0
    for link in LINK.finditer(without_code(text)):
        kept += [text[end : link.start()], change(*(text[slice(*link.span(part))] for part in (1, 2, 3)))]
        end = link.end()
    return "".join([*kept, text[end:]])


def turned(mark, text, target, source, pages, repository):
    """A link of a page as it is in the book."""
    file, _, anchor = target.partition("#")
    if not file or re.match(r"[a-z]+:", target):
        return f"{mark}[{text}]({target})"
    found = (source.parent / file).resolve()
    anchor = f"#{anchor}" if anchor else ""
    if found in pages or (mark and found.is_relative_to(DOCS)):
        return f"{mark}[{text}]({os.path.relpath(place(found), place(source).parent)}{anchor})"
    name = found.relative_to(ROOT)
    if repository:
        return f"{mark}[{text}]({repository}/{name}{anchor})"
    return text if str(name) in text or found.name in text else f"{text} (`{name}`)"


def chapters(items):
    """All chapters that have a page, however deep."""
    for item in items:
        chapter = item.get("Chapter") if isinstance(item, dict) else None
        if chapter and chapter["path"]:
            yield chapter
        yield from chapters(chapter["sub_items"] if chapter else [])


def command():
    """The command `occupant`, if there is one."""
    built = Path(os.environ.get("OCCUPANT", ROOT / "target/release/occupant"))
    return built if built.is_file() else None


def printed(match, occupant):
    """The output of a command, as a block."""
    if not occupant:
        return f"`occupant {match[1]}` prints this."
    run = subprocess.run([occupant, *match[1].split()], capture_output=True, text=True, cwd=ROOT, check=True)
    return "```text\n" + run.stdout.rstrip() + "\n```"


def untold(occupant, pages):
    """Commands whose help is on no page."""
    words = subprocess.run([occupant, "--help"], capture_output=True, text=True, check=True).stdout
    commands = re.findall(r"^  ([a-z]+) ", words.partition("Commands:")[2].partition("Options:")[0], re.M)
    told = {match[1] for page in pages for match in PRINTED.finditer(page)}
    return [name for name in commands if name != "help" and f"{name} --help" not in told]


def main():
    if sys.argv[1:2] == ["supports"]:
        sys.exit(0 if sys.argv[2:] == ["html"] else 1)
    context, book = json.load(sys.stdin)
    settings = context["config"].get("preprocessor", {}).get("places", {})
    found = list(chapters(book.get("items") or book.get("sections") or []))
    pages = {(DOCS / chapter["path"]).resolve() for chapter in found}
    occupant = command()
    if occupant and (lacking := untold(occupant, [chapter["content"] for chapter in found])):
        sys.exit(f"docs/reference/commands.md lacks the help of: {', '.join(lacking)}")
    for chapter in found:
        source = (DOCS / chapter["path"]).resolve()
        text = with_links(
            chapter["content"], lambda *link: turned(*link, source, pages, settings.get("repository"))
        )
        chapter["content"] = PRINTED.sub(lambda match: printed(match, occupant), text)
        chapter["path"] = str(place(source))
    json.dump(book, sys.stdout)


if __name__ == "__main__":
    main()
