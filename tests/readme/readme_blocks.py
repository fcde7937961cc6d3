"""Checks that README.md shows the examples' own code: readme_blocks.py README.md SOURCE...

Each SOURCE marks what the README shows with comment lines `// [integration]` and `// [/integration]`. The README must
contain each block word for word; only the indentation that all lines of a block share may differ.
"""

import pathlib
import sys
import textwrap

BEGIN = "// [integration]"
END = "// [/integration]"


def marked_blocks(path):
    """The blocks between the marks of a file, without their common indentation."""
    blocks = []
    lines = None
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        mark = line.strip()
        if mark == BEGIN:
            if lines is not None:
                sys.exit(f"{path}:{number}: {BEGIN} inside a block")
            lines = []
        elif mark == END:
            if lines is None:
                sys.exit(f"{path}:{number}: {END} without {BEGIN}")
            blocks.append(textwrap.dedent("\n".join(lines)).strip("\n"))
            lines = None
        elif lines is not None:
            lines.append(line.rstrip())
    if lines is not None:
        sys.exit(f"{path}: {BEGIN} without {END}")
    return blocks


def fenced_blocks(path):
    """The fenced code blocks of a Markdown file, without their common indentation."""
    blocks = []
    lines = None
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.strip().startswith("```"):
            if lines is not None:
                blocks.append(textwrap.dedent("\n".join(lines)).strip("\n"))
            lines = [] if lines is None else None
        elif lines is not None:
            lines.append(line.rstrip())
    return blocks


def first_difference(wanted, shown):
    """The first line of wanted that the most similar of the shown blocks lacks."""
    nearest = max(shown, key=lambda block: len(set(block.splitlines()) & set(wanted.splitlines())), default="")
    there = set(nearest.splitlines())
    return next((line for line in wanted.splitlines() if line not in there), "its lines are in another order")


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    readme = pathlib.Path(sys.argv[1])
    if not readme.is_file():
        sys.exit(f"{readme} does not exist")
    shown = fenced_blocks(readme)
    failures = []
    for source in map(pathlib.Path, sys.argv[2:]):
        blocks = marked_blocks(source)
        if not blocks or not all(blocks):
            failures.append(f"{source}: no code between {BEGIN} and {END}")
        for block in blocks:
            if not any(block in candidate for candidate in shown):
                failures.append(f"{readme} does not show the code of {source}; first difference: "
                                f"{first_difference(block, shown)}")
    if failures:
        sys.exit("\n".join(failures))
    print(f"{readme} shows the code of {len(sys.argv) - 2} files word for word")


if __name__ == "__main__":
    main()
