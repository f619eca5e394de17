#!/usr/bin/env python3
"""Links between the pages of a site that lead nowhere: files that are not there, headings that no page has.

usage: check_links.py SITE"""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.names = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.names.update(filter(None, (found.get("id"), found.get("name"))))
        if link := found.get("href") or found.get("src"):
            self.links.append(link)


def main(site):
    site = Path(site).resolve()
    pages = {p.resolve(): Page(p.read_text(encoding="utf-8")) for p in site.rglob("*.html") if "/examples/" not in str(p)}
    lost = 0
    for path, page in sorted(pages.items()):
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or link.startswith("//") or path.name == "404.html":
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not target.exists():
                wrong = "no such file"
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].names:
                wrong = "no such heading"
            else:
                continue
            lost += 1
            print(f"{path.relative_to(site)}: {link}: {wrong}", file=sys.stderr)
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
