"""Ways to spoil a file."""

import random
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


def mutate(data: bytes, dice: random.Random) -> tuple[bytes, str]:
    """Spoil a file in one to three ways.

    Returns:
        What became of it, and the names of the ways.
    """
    spoilt, names = bytearray(data), []
    for _ in range(dice.choice((1, 1, 1, 2, 3))):
        way = dice.choice(MUTATIONS)
        if spoilt:
            way(spoilt, dice)
            names.append(way.__name__)
    return bytes(spoilt), ", ".join(names)
