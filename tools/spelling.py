"""Check the spelling of every language's texts by hunspell: `python -m tools.spelling [--list]`.

Debian's packages hunspell, hunspell-de-de, hunspell-de-med and hunspell-fr hold the program and its
dictionaries; a language whose dictionary is absent is skipped, and that is said. Words that are
right although no dictionary has them stand in `tools/spelling/<code>.txt`, one a line. Ends with 1
if a word is in neither. Units, names in braces, markup, code and keys are not looked at.
"""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Final

from app.core.language import PREFIX, folder
from tools.translations import messages

ACCEPTED: Final = Path(__file__).with_name("spelling")
DICTIONARIES: Final = {"de": ("de_DE", "de_med"), "fr": ("fr",)}
"""Code of a language -> its dictionaries; the first has the rules, the others add words."""

_NO_WORDS: Final = re.compile(
    r"\{[^{}]*\}|<[^>]*>|`[^`]*`|&\w+;|%\w|https?://\S+|[\w-]*[._/\\][\w./\\-]*\w"
    r"|(?<!\w)--?\w[\w-]*=?\w*"
)
_WORD: Final = re.compile(r"[^\W\d_]+(?:[-’'][^\W\d_]+)*")


def words_of(text: str) -> Iterator[str]:
    """Yield the words of a translation, as a dictionary has them."""
    while (bare := _NO_WORDS.sub(" ", text)) != text:  # fields within fields
        text = bare
    for match in _WORD.finditer(text.replace("&", "").replace("\N{SOFT HYPHEN}", "")):
        word = match.group().replace("’", "'")
        if len(word) > 2:
            yield word


def unknown(words: Iterable[str], code: str) -> set[str]:
    """Return those of the words that the language's dictionaries have not.

    Raises:
        FileNotFoundError: if hunspell or a dictionary is absent.
    """
    program, names = shutil.which("hunspell"), DICTIONARIES.get(code, (code,))
    listed = "" if program is None else _run([program, "-D"], "").stderr
    absent = [name for name in names if f"/{name}\n" not in listed + "\n"]
    if program is None or absent:
        raise FileNotFoundError(", ".join(absent) if program else "hunspell")
    done = _run([program, "-i", "UTF-8", "-d", ",".join(names), "-l"], "\n".join(words) + "\n")
    return set(done.stdout.split("\n")) - {""}


def _run(command: list[str], text: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command, input=text, capture_output=True, encoding="utf-8", check=True, timeout=300
    )


def accepted(code: str) -> set[str]:
    """Return the words of a language that are right although no dictionary has them."""
    file = ACCEPTED / f"{code}.txt"
    lines = file.read_text(encoding="utf-8").splitlines() if file.is_file() else []
    return {line for line in lines if line and not line.startswith("#")}


def main() -> None:
    """Check the languages."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--list", action="store_true", help="words alone, one a line")
    only_words = parser.parse_args().list
    wrong = 0
    for file in sorted(folder().glob(f"{PREFIX}*.ts")):
        code = file.stem.removeprefix(PREFIX)
        forms = [form for each in messages(file).values() for form in each]
        words = Counter(word for form in forms for word in words_of(form))
        try:
            strange = sorted(unknown(words, code) - accepted(code))
        except FileNotFoundError as error:
            print(f"{code}: skipped, {error} is not installed")
            continue
        wrong += len(strange)
        for word in strange:
            where = next(form for form in forms if word in set(words_of(form)))
            print(word if only_words else f"{code}: {word!r} in {where!r}")
        if not only_words:
            print(f"{code}: {len(words)} words, {len(strange)} in no dictionary")
    raise SystemExit(bool(wrong))


if __name__ == "__main__":
    main()
