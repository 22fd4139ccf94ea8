"""Coordinates for people."""

from app.views.kit.coordinates import lps_words


def test_letters_name_the_side_and_there_is_no_sign():
    assert lps_words((70.94, 109.4, -3.0)) == "L 70.9   P 109.4   I 3.0 mm"
    assert lps_words((-70.94, -109.4, 180.06)) == "R 70.9   A 109.4   S 180.1 mm"
    assert lps_words((0.0, -0.0, -0.01)) == "L 0.0   P 0.0   S 0.0 mm"
