#!/usr/bin/env python3
"""mdBook preprocessor: a link of the book leads where it leads in the repository.

A page of docs/project includes a document that lies elsewhere, and its links are told from there. What is a page of the
book is linked as that page, what lies below docs as it lies, anything else at the repository. A link to nothing ends the build.
"""

import json
import os
import re
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent
ROOT = DOCS.parent
INCLUDE = re.compile(r"\{\{#include (\S+)\}\}\s*")
LINK = re.compile(r"\]\((?!https?:|#)([^)#\s]+)(#[^)\s]*)?\)")


def chapters(items):
    for item in items:
        chapter = item.get("Chapter") if isinstance(item, dict) else None
        if chapter:
            yield chapter
            yield from chapters(chapter["sub_items"])


def source(page):
    """The document that a page shows."""
    own = DOCS / page
    included = INCLUDE.fullmatch(own.read_text())
    return (own.parent / included[1]).resolve() if included else own


def main():
    if sys.argv[1:2] == ["supports"]:
        return
    context, book = json.load(sys.stdin)
    written = [chapter for chapter in chapters(book["items"]) if chapter["path"]]
    sources = {chapter["path"]: source(chapter["path"]) for chapter in written}
    pages = {document: page for page, document in sources.items()}
    repository = context["config"]["output"]["html"]["git-repository-url"]

    for chapter in written:
        page, document = chapter["path"], sources[chapter["path"]]

        def lead(link):
            there, fragment = (document.parent / link[1]).resolve(), link[2] or ""
            if not there.exists():
                sys.exit(f"{document.relative_to(ROOT)}: {link[1]} is not there")
            if there in pages:
                target = os.path.relpath(pages[there], os.path.dirname(page))
            elif there.is_relative_to(DOCS):
                target = os.path.relpath(there, DOCS / os.path.dirname(page))
            else:
                target = f"{repository}/blob/main/{there.relative_to(ROOT)}"
            return f"]({target}{fragment})"

        chapter["content"] = LINK.sub(lead, chapter["content"])
    json.dump(book, sys.stdout)


main()
