"""A symbol of a worksheet under another name: ``python -m mechsheet.run.rename WORKSHEET OLD NEW``."""

import sys
from pathlib import Path

from mechsheet.run.arguments import UsageError, usage
from mechsheet.run.ending import say, watch
from mechsheet.workbook.save import save
from mechsheet.worksheet.cells import load
from mechsheet.worksheet.renaming import renamed
from mechsheet.worksheet.scene import texts_beside


def main() -> None:
    worksheet, *names = sys.argv[1:]
    watch(worksheet)
    if len(names) != 2:
        raise UsageError("rename takes a worksheet, a symbol and its new name, such as hitch F_gc F_c")
    path, (old, new) = Path(worksheet), names
    load(path)  # tells what cannot be read
    with usage():
        made = renamed(path, old, new, texts_beside(path))
    before = {file: file.read_bytes() for file in made}
    try:
        for file, text in made.items():
            save(text.encode(), file)
    except BaseException:  # all of them or none, after Ctrl-C too
        for file, held in before.items():
            if file.read_bytes() != held:
                save(held, file)
        raise
    say(*(f"written {file}" for file in made))


if __name__ == "__main__":
    main()
