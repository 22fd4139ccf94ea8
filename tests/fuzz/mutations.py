"""Ways to spoil a file."""

import random
import re
from collections.abc import Callable

HOSTILE_LENGTHS = (0, 1, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFE, 0xFFFFFFFF)
HOSTILE_TEXTS = (b"nan", b"inf", b"-", b"1e999", b"\\\\\\\\", b"99999999999999", b"\0\0\0\0")
HOSTILE_SHORTS = (0, 1, 2, 7, 12, 33, 0x7FFF, 0xFFFF)
FORMAT_TAGS = (0x0002, 0x0008, 0x0010, 0x0011, 0x0100, 0x0101, 0x0102, 0x0103)


def flip_bits(data: bytearray, dice: random.Random) -> None:
    for _ in range(dice.choice((1, 1, 2, 8, 64))):
        data[dice.randrange(len(data))] ^= 1 << dice.randrange(8)


def flip_bits_of_the_header(data: bytearray, dice: random.Random) -> None:
    for _ in range(dice.choice((1, 2, 8))):
        data[dice.randrange(min(len(data), 1400))] ^= 1 << dice.randrange(8)


def truncate(data: bytearray, dice: random.Random) -> None:
    del data[dice.randrange(len(data)) :]


def cut_out(data: bytearray, dice: random.Random) -> None:
    start = dice.randrange(len(data))
    del data[start : start + dice.choice((1, 2, 8, 100, 1000))]


def repeat(data: bytearray, dice: random.Random) -> None:
    start = dice.randrange(len(data))
    part = data[start : start + dice.choice((8, 100, 1000))]
    data[start:start] = part * dice.choice((1, 2, 50))


def noise(data: bytearray, dice: random.Random) -> None:
    start = dice.randrange(len(data))
    count = min(dice.choice((1, 4, 16, 256)), len(data) - start)
    data[start : start + count] = dice.randbytes(count)


def hostile_length(data: bytearray, dice: random.Random) -> None:
    width = dice.choice((2, 4))
    start = dice.randrange(132, max(133, min(len(data) - width, 3000)))
    value = dice.choice(HOSTILE_LENGTHS) & ((1 << 8 * width) - 1)
    data[start : start + width] = value.to_bytes(width, dice.choice(("little", "big")))


def hostile_text(data: bytearray, dice: random.Random) -> None:
    spots = [at for at in range(132, min(len(data), 1400)) if 48 <= data[at] <= 57]
    if spots:
        text = dice.choice(HOSTILE_TEXTS)
        start = dice.choice(spots)
        data[start : start + len(text)] = text


def hostile_format(data: bytearray, dice: random.Random) -> None:
    element = dice.choice(FORMAT_TAGS)
    tag = b"\x28\x00" + element.to_bytes(2, "little")
    start = data.find(tag, 132)
    if start >= 0:
        at = start + 8
        data[at : at + 2] = dice.choice(HOSTILE_SHORTS).to_bytes(2, "little")


def deep_sequence(data: bytearray, dice: random.Random) -> None:
    """Nest sequences of undefined length before the pixels, closed or not."""
    depth = dice.choice((3, 50, 400, 3000))
    start = data.find(b"\x28\x00\x02\x00", 132)
    head = b"\x20\x00\x90\x91SQ\0\0\xff\xff\xff\xff" + b"\xfe\xff\x00\xe0\xff\xff\xff\xff"
    tail = b"\xfe\xff\x0d\xe0\0\0\0\0" + b"\xfe\xff\xdd\xe0\0\0\0\0"
    at = start if start > 0 else len(data)
    data[at:at] = head * depth + tail * (depth if dice.random() < 0.5 else 0)


MUTATIONS: tuple[Callable[[bytearray, random.Random], None], ...] = (
    flip_bits,
    flip_bits_of_the_header,
    truncate,
    cut_out,
    repeat,
    noise,
    hostile_length,
    hostile_text,
    hostile_format,
    deep_sequence,
)


# --- files of lines of text

NUMBERS = (
    b"nan", b".nan", b"inf", b"-.inf", b"-1", b"0", b"1e308", b"-1e-320", b"1e999", b"0x7fffffff",
    b"99999999999999999999", b"9" * 5000, b"1:1:1.5", b"1_0", b"2026-99-99", b"[]", b"true",
)  # fmt: skip
WORDS = (
    b"null", b"[]", b"{}", b'""', b"*a", b"&a a", b"!!python/object:os.system x", b"!!binary x",
    b"!!int x", b"<<", b"../../etc/passwd", b"\xf0\x9f\x92\xa9", b"A" * 5000, b"yes", b"\0",
    b"<!DOCTYPE a [<!ENTITY b 'c'>]>", b"&b;", b"%YAML 9.9",
)  # fmt: skip
OPENING = (b"[", b"{", b"{a: ", b"- ", b"<a>", b"((")


def hostile_number(data: bytearray, dice: random.Random) -> None:
    found = [match.span() for match in re.finditer(rb"-?\d+(\.\d*)?([eE][-+]?\d+)?", bytes(data))]
    if found:
        start, end = dice.choice(found)
        data[start:end] = dice.choice(NUMBERS)


def hostile_word(data: bytearray, dice: random.Random) -> None:
    found = [match.span() for match in re.finditer(rb"[A-Za-z_]+", bytes(data))]
    if found:
        start, end = dice.choice(found)
        data[start:end] = dice.choice(WORDS)


def shuffled_lines(data: bytearray, dice: random.Random) -> None:
    lines = bytes(data).split(b"\n")
    for _ in range(dice.choice((1, 1, 3))):
        a, b = dice.randrange(len(lines)), dice.randrange(len(lines))
        way = dice.randrange(3)
        if way == 0:
            lines[a], lines[b] = lines[b], lines[a]
        elif way == 1:
            lines.insert(a, lines[b])
        elif len(lines) > 1:
            del lines[a]
    data[:] = b"\n".join(lines)


def deep_text(data: bytearray, dice: random.Random) -> None:
    start = dice.randrange(len(data))
    data[start:start] = dice.choice(OPENING) * dice.choice((3, 50, 1000, 20000))


def many_aliases(data: bytearray, dice: random.Random) -> None:
    """Ten lines of YAML that stand for 10^10 values, under the name of a field that is there."""
    names = re.findall(rb"(?m)^([A-Za-z_]+):", bytes(data)) or [b"z"]
    lines = [b"a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    for k in range(1, dice.choice((4, 10))):
        lines.append(b"a%d: &a%d [%s]" % (k, k, b", ".join([b"*a%d" % (k - 1)] * 10)))
    lines.append(dice.choice(names) + b": *a%d" % (len(lines) - 1))
    data.extend(b"\n" + b"\n".join(lines) + b"\n")


TEXT_MUTATIONS: tuple[Callable[[bytearray, random.Random], None], ...] = (
    flip_bits,
    truncate,
    cut_out,
    repeat,
    noise,
    hostile_number,
    hostile_number,
    hostile_word,
    shuffled_lines,
    deep_text,
    many_aliases,
)


def mutate(data: bytes, dice: random.Random, text: bool = False) -> tuple[bytes, str]:
    """Spoil a file in one to three ways; one of lines of text in those that suit it.

    Returns:
        What became of it, and the names of the ways.
    """
    spoilt, names = bytearray(data), []
    for _ in range(dice.choice((1, 1, 1, 2, 3))):
        way = dice.choice(TEXT_MUTATIONS if text else MUTATIONS)
        if spoilt:
            way(spoilt, dice)
            names.append(way.__name__)
    return bytes(spoilt), ", ".join(names)
