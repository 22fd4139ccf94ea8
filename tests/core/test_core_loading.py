import sys
import threading

import pytest

from app.core.loading import ONE_AT_A_TIME, is_loaded, load_modules, turn
from app.core.progress import Cancelled, Progress


@pytest.fixture
def package(tmp_path, monkeypatch):
    """A package whose parts import each other's neighbours."""
    folder = tmp_path / "acus_test_package"
    folder.mkdir()
    (folder / "__init__.py").write_text("import time; time.sleep(0.02)\nfrom . import first\n")
    (folder / "first.py").write_text("import time; time.sleep(0.02)\n")
    (folder / "second.py").write_text("from . import first\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    yield "acus_test_package"
    for name in [name for name in sys.modules if name.startswith("acus_test_package")]:
        del sys.modules[name]


def test_modules_are_loaded_in_the_order_given(package):
    load_modules([f"{package}.first", f"{package}.second"], Progress())
    assert {f"{package}.first", f"{package}.second"} <= set(sys.modules)


def test_a_module_that_is_missing_is_named():
    with pytest.raises(ImportError, match="acus_no_such_module"):
        load_modules(["acus_no_such_module"], Progress())


def test_loading_stops_when_it_is_cancelled(package):
    progress = Progress()
    progress.cancel()
    with pytest.raises(Cancelled):
        load_modules([package], progress)
    assert package not in sys.modules


def test_threads_that_load_parts_of_one_package_do_not_lock_each_other_out(package):
    failures = []

    def load(name):
        try:
            load_modules([name], Progress())
        except BaseException as error:
            failures.append(error)

    names = [package, f"{package}.first", f"{package}.second"] * 3
    threads = [threading.Thread(target=load, args=(name,)) for name in names]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(10.0)
    assert not failures
    assert not any(thread.is_alive() for thread in threads)


def test_who_waits_for_another_to_load_is_told_so_and_then_has_the_turn():
    held, free, told = threading.Event(), threading.Event(), []

    def hold():
        with ONE_AT_A_TIME:
            held.set()
            free.wait(10.0)

    def listen(_, text):
        told.append(text)
        if text:
            free.set()

    thread = threading.Thread(target=hold)
    thread.start()
    assert held.wait(10.0)
    with turn(Progress(listen)):
        assert free.is_set()
    thread.join(10.0)
    assert "first start" in told[-1]
    assert ONE_AT_A_TIME.acquire(blocking=False)
    ONE_AT_A_TIME.release()


def test_who_waits_for_another_to_load_may_give_up():
    held, free, progress = threading.Event(), threading.Event(), Progress()

    def hold():
        with ONE_AT_A_TIME:
            held.set()
            free.wait(10.0)

    thread = threading.Thread(target=hold)
    thread.start()
    assert held.wait(10.0)
    threading.Timer(0.15, progress.cancel).start()
    with pytest.raises(Cancelled), turn(progress):
        pytest.fail("it was not its turn")
    free.set()
    thread.join(10.0)


def test_who_wants_a_module_that_is_there_waits_for_nobody_and_one_that_is_begun_is_not_there(
    package, monkeypatch
):
    load_modules([f"{package}.first"], Progress())
    held, done, went = threading.Event(), threading.Event(), threading.Event()

    def hold():
        with ONE_AT_A_TIME:
            held.set()
            done.wait(30.0)

    def want():
        with turn(Progress(), package, f"{package}.first"):
            went.set()

    holder, asker = threading.Thread(target=hold), threading.Thread(target=want)
    holder.start()
    assert held.wait(10.0)
    asker.start()
    try:
        assert went.wait(5.0)
        assert not is_loaded(f"{package}.second")
        monkeypatch.setattr(sys.modules[package].__spec__, "_initializing", True, raising=False)
        assert not is_loaded(package)
    finally:
        done.set()
        holder.join(10.0)
        asker.join(10.0)
