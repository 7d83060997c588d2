"""Follows every link of a built book: the file is there, and the place in it, too. Usage: check_book.py FOLDER"""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """Targets and places of one page."""

    def __init__(self, text):
        super().__init__()
        self.targets, self.places = [], {""}
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value is not None:
                self.targets.append(value)
            if name in ("id", "name"):
                self.places.add(value)


def main(folder):
    root = Path(folder).resolve()
    pages = {path: Page(path.read_text(encoding="utf-8")) for path in sorted(root.rglob("*.html"))}
    faults, followed = [], 0
    for path, page in pages.items():
        # All pages in one, whose links keep the folders they had; and the page for what is not found, which is shown anywhere.
        if path.name in ("print.html", "404.html"):
            continue
        for target in page.targets:
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                continue
            followed += 1
            to = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if to.is_dir():
                to = to / "index.html"
            if not to.is_relative_to(root) or not to.is_file():
                faults.append(f"{path.relative_to(root)}: {target} leads nowhere")
            elif to in pages and unquote(parts.fragment) not in pages[to].places:
                faults.append(f"{path.relative_to(root)}: {target}: no such place")
    for fault in faults:
        print(fault)
    print(f"{len(pages)} pages, {followed} links, {len(faults)} of them wrong")
    return 1 if faults or followed < 100 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
