"""What every page of the finished site must keep: it asks no network, its links lead somewhere."""

import re
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from pathlib import Path
from urllib.parse import unquote

from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

TAG = re.compile(r"<([a-zA-Z][\w-]*)\b([^<>]*)>")
ATTRIBUTE = re.compile(r"([\w-]+)=(?:\"([^\"]*)\"|'([^']*)')")
SCRIPT = re.compile(r"(<script\b[^>]*>).*?</script>", re.S)
LOADED = {"script": "src", "img": "src", "iframe": "src", "source": "src", "video": "src", "link": "href"}
"""What a page loads by itself, and by which attribute."""
AWAY = re.compile(r"^(https?:)?//")
ADDRESS = re.compile(r"(?:url\(|@import)\s*[\"']?((?:https?:)?//[^\"')\s]+)")


def tags(text: str) -> Iterator[tuple[str, dict[str, str]]]:
    """The elements of a page with their attributes, in order; what stands within scripts is none."""
    for name, inner in TAG.findall(SCRIPT.sub(r"\1", text)):
        yield name.lower(), {key: one or two for key, one, two in ATTRIBUTE.findall(inner)}


@cache
def anchors(page: Path) -> set[str]:
    """What a link can name within a page."""
    text = page.read_text(encoding="utf-8")
    return {given[key] for _, given in tags(text) for key in ("id", "name") if key in given}


def faults(root: Path) -> list[str]:
    """What is wrong with the pages below ``root``, a sentence for each; nothing if all is well."""
    anchors.cache_clear()
    found = sorted(page for page in root.rglob("*.html") if "_static" not in page.parts)
    pages = [fault for page in found for fault in page_faults(page, root)]
    styles = [
        f"{path.name}: asks {found}"
        for path in root.rglob("*.css")
        for found in ADDRESS.findall(path.read_text("utf-8"))
    ]
    return [*pages, *styles]


def page_faults(page: Path, root: Path) -> Iterator[str]:
    """What is wrong with one page."""
    text, name = page.read_text(encoding="utf-8"), page.relative_to(root).as_posix()
    if not re.search(r"<title>[^<]*\w[^<]*</title>", text):
        yield f"{name}: has no title"
    if not re.search(r"<html[^>]* lang=", text):
        yield f"{name}: does not say its language"
    levels = [int(level) for level in re.findall(r"<h([1-6])\b", text)]
    for above, below in pairwise(levels):
        if below > above + 1:
            yield f"{name}: a heading of level {below} stands below one of level {above}"
    for tag, given in tags(text):
        if tag == "img" and not re.search(r"\w{3}", given.get("alt", "")):
            yield f"{name}: the picture {given.get('src', '')[:80]} has no words in its place"
        if tag == "iframe" and not given.get("title"):
            yield f"{name}: the frame {given.get('src')} has no title"
        yield from (f"{name}: {fault}" for fault in link_faults(tag, given, page))


def link_faults(tag: str, given: dict[str, str], page: Path) -> Iterator[str]:
    """What is wrong with the address in one element: that of another computer, or of nothing."""
    loaded = given.get(LOADED.get(tag, ""), "")
    if AWAY.match(loaded) and given.get("rel") != "canonical":
        yield f"loads {loaded}"
    address = loaded or (given.get("href", "") if tag == "a" else "")
    if not address or re.match(r"^(\w+:|//)", address) or given.get("rel") == "canonical":
        return
    path, _, anchor = address.partition("#")
    target = (page.parent / unquote(path.partition("?")[0])).resolve() if path else page
    if not target.is_file():
        yield f"the link {address} leads to no file"
    elif anchor and target.suffix == ".html" and unquote(anchor) not in anchors(target):
        yield f"the link {address} leads to no place in its page"


def check(app: Sphinx, failed: Exception | None) -> None:
    """Stop the build with what is wrong."""
    if failed is None and app.builder.format == "html" and (found := faults(Path(app.outdir))):
        raise ExtensionError("\n".join(["the site is not whole:", *found]))


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("build-finished", check, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
