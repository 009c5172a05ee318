#!/usr/bin/env python3
"""What Doxygen does not do for the target documentation.

    pages.py filter HTML FILE    prints a source as Doxygen reads it, and copies the files that it links to below HTML
    pages.py help HTML           adds the help pages of the plugin, and fails if a link of any page leads nowhere
"""

import pathlib
import re
import shutil
import sys
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
HELP = ROOT / "ParaViewPlugin" / "Documentation"
METHOD = ROOT / "Filters" / "Core"  # its pages have formulas


def link_for_doxygen(html, page, label, target):
    """Doxygen knows pages. Pictures stand beside the help pages; other files are copied."""
    place, _, anchor = target.partition("#")
    path = (page.parent / place).resolve()
    if re.match(r"https?:|@", target) or path.suffix == ".md" and place:
        return f"[{label}]({place})"
    if path.parent == HELP:
        return f"[{label}](help/{path.name})"
    if not place or path.is_dir():
        return label
    copy = pathlib.Path("sources") / path.relative_to(ROOT)
    (html / copy).parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(path, html / copy)
    return f"[{label}]({copy.as_posix()})"


def without_autolinks(line):
    """#F is a number of faces, not a link. A line that begins with # is a heading, or for the preprocessor."""
    return line if line.lstrip().startswith("#") else re.sub(r"#(?=\w)", r"\\#", line)


def filtered(html, page):
    text = page.read_text()
    if page.suffix == ".md" and METHOD in page.parents:
        text = re.sub(r"```math\n(.*?)```", r"\\f[\n\1\\f]", text, flags=re.DOTALL)
        text = re.sub(r"\$", r"\\f$", text)
    if page.suffix == ".md":
        text = re.sub(r"\[([^]]*)\]\(([^)\s]+)\)", lambda match: link_for_doxygen(html, page, *match.groups()), text)
    return "\n".join(map(without_autolinks, text.split("\n")))


def add_help(html):
    """Help pages link to each other, and to pages of the method, by the names that they have in ParaView."""
    folder = html / "help"
    folder.mkdir(exist_ok=True)
    for path in HELP.iterdir():
        is_of_filter = path.suffix == ".html" and path.stem not in ("DirectionalFields", "SeveralRanks")
        shutil.copyfile(path, folder / (f"filters.{path.name}" if is_of_filter else path.name))
    for path in METHOD.glob("*/*.md"):
        shutil.copyfile(path, folder / path.name)


def dead_links(html):
    for page in sorted(html.rglob("*.html")):
        for target in re.findall(r'(?:href|src)="([^"#]+)', page.read_text(errors="replace")):
            if not re.match(r"\w+:", target) and not (page.parent / urllib.parse.unquote(target)).exists():
                yield f"{page.relative_to(html)} links to {target}, which does not exist"


def main():
    command, html = sys.argv[1], pathlib.Path(sys.argv[2])
    if command == "filter":
        sys.stdout.write(filtered(html, pathlib.Path(sys.argv[3]).resolve()))
        return 0
    add_help(html)
    found = list(dead_links(html))
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
