"""Names sorted without a table of a language: at their base letter, numbers by value."""

import random

from app.core.words import name_order

SORTED = [
    *("Ågren", "Ångström", "Lukas", "Łukasz", "Lutz", "Muller", "Müller", "Muzik", "Nagy"),
    *("Oscar", "Óscar", "Østby", "Ostrowska", "Otto", "student 2", "student 9", "student 10"),
    *("Szűcs", "Żak", "Zorn"),
]
"""As ICU's root collation, which tailors nothing, has them (Qt's collator for English says so)."""


def test_signs_do_not_send_a_name_behind_z_and_ten_comes_after_nine() -> None:
    mixed = random.Random(1).sample(SORTED, len(SORTED))
    assert sorted(mixed, key=name_order) == SORTED
    assert sorted(mixed) != SORTED
