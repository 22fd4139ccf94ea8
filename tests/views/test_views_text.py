from app.core.disclaimer import DISCLAIMER
from app.views.kit.text import disclaimer


def test_the_disclaimer_of_the_window_is_the_one_of_the_files():
    assert disclaimer() == DISCLAIMER
