"""Backups in a folder: what is alike lies there once, and what is damaged is named.

Pieces are looked at with `hashlib`, and an encrypted one is decrypted by OpenSSL's primitives put
together here as the module's first lines describe them, and by nothing of the program.
"""

import hashlib
import hmac
import json
import os
import shutil
from pathlib import Path

import pytest
from cryptography.hazmat.primitives.ciphers import Cipher
from cryptography.hazmat.primitives.ciphers.algorithms import AES256
from cryptography.hazmat.primitives.ciphers.modes import GCM
from school_stations import SchoolStation, headed, pool

from app.commands import build
from app.core.files import watched
from app.session.archive import backup, backup_into, check_backup
from app.session.backup_file import ArchiveError
from app.session.backup_folder import backups_of, is_encrypted
from app.session.errors import SessionError
from app.session.restoring import restore_backup
from app.session.station import new_recovery_key


@pytest.fixture
def station(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> SchoolStation:
    station = headed(tmp_path / "head", monkeypatch)
    for key in sorted(pool()[1]):
        station.record(key)
    return station


def pieces(out: Path) -> list[Path]:
    return sorted(path for path in (out / "objects").rglob("*") if path.is_file())


def emptied(station: SchoolStation) -> set[str]:
    """Take all records away; return their names."""
    names = {path.name for path in station.folder.glob("*.mcap")}
    for path in list(station.folder.iterdir()):
        path.unlink() if path.is_file() else shutil.rmtree(path)
    return names


@pytest.mark.long("journey")
def test_what_was_there_at_the_last_backup_is_not_written_again(
    station: SchoolStation, tmp_path: Path
) -> None:
    out = tmp_path / "backups"
    first = backup_into(out, station.folder)
    assert (first.records, first.new > 0) == (3, True)
    for path in pieces(out):
        assert path.name == hashlib.sha256(path.read_bytes()).hexdigest()
    before = {path: path.stat().st_mtime_ns for path in pieces(out)}
    station.record(sorted(pool()[1])[0])
    second = backup_into(out, station.folder)
    assert second.records == 4
    assert all(path.stat().st_mtime_ns == then for path, then in before.items())
    new = [path for path in pieces(out) if path not in before]
    assert second.new == sum(path.stat().st_size for path in new)
    assert backups_of(out) == [first.path, second.path]
    assert (check_backup(out).files, check_backup(first.path).files) == (4, 3)
    assert check_backup(out).wrong == ()


@pytest.mark.parametrize("passphrase", ["", "correct horse battery"])
def test_what_was_lost_comes_back_from_a_folder_as_from_a_file(
    station: SchoolStation, tmp_path: Path, passphrase: str
) -> None:
    backup_into(tmp_path / "backups", station.folder, passphrase=passphrase)
    backup(tmp_path / "all.acusbackup", station.folder)
    before = {path.name: path.read_bytes() for path in station.folder.glob("*.mcap")}
    for source, secret in ((tmp_path / "backups", passphrase), (tmp_path / "all.acusbackup", "")):
        names = emptied(station)
        done = restore_backup(source, station.folder, passphrase=secret)
        assert done.records == len(names) == 3
        assert {path.name: path.read_bytes() for path in station.folder.glob("*.mcap")} == before


def test_an_encrypted_backup_shows_nothing_and_opens_as_it_is_described(
    station: SchoolStation, tmp_path: Path
) -> None:
    out = tmp_path / "backups"
    done = backup_into(out, station.folder, passphrase="correct horse")
    record = sorted(station.folder.glob("*.mcap"))[0].read_bytes()
    everything = b"".join(path.read_bytes() for path in [done.path, *pieces(out)])
    assert b"Ada" not in everything
    assert record[:64] not in everything
    said = json.loads(done.path.read_text())
    salt, nonce, sealed = (bytes.fromhex(said["key"][name]) for name in ("salt", "nonce", "sealed"))
    key = hashlib.scrypt(b"correct horse", salt=salt, n=1 << 15, r=8, p=1, maxmem=1 << 26, dklen=32)
    secret = opened(key, nonce + sealed, b"acus backups")
    body = json.loads(opened(of(secret, "list"), bytes.fromhex(said["body"]), b"acus-backup-list"))
    name = next(name for name in body["files"] if name.endswith(".mcap"))
    (piece,) = body["pieces"][name]
    digest = hashlib.sha256((station.folder / Path(name).name).read_bytes()).digest()
    assert piece == hmac.digest(of(secret, "name"), digest, "sha256").hex()
    data = (out / "objects" / piece[:2] / piece).read_bytes()
    assert hashlib.sha256(opened(of(secret, "piece"), data, piece.encode())).digest() == digest


def opened(key: bytes, data: bytes, name: bytes) -> bytes:
    cipher = Cipher(AES256(key), GCM(data[:12], data[-16:])).decryptor()
    cipher.authenticate_additional_data(name)
    return cipher.update(data[12:-16]) + cipher.finalize()


def of(secret: bytes, purpose: str) -> bytes:
    """HKDF of RFC 5869 with SHA-256, without salt, one block."""
    first = hmac.digest(bytes(32), secret, "sha256")
    return hmac.digest(first, f"acus backups: {purpose}".encode() + b"\x01", "sha256")


@pytest.mark.parametrize("passphrase", ["", "correct horse"])
@pytest.mark.parametrize("harm", ["cut", "flipped", "missing", "swapped"])
def test_a_piece_that_is_harmed_is_named_and_nothing_is_restored(
    station: SchoolStation, tmp_path: Path, passphrase: str, harm: str
) -> None:
    out = tmp_path / "backups"
    backup_into(out, station.folder, passphrase=passphrase)
    large, other = sorted(pieces(out), key=lambda path: -path.stat().st_size)[:2]
    data = bytearray(large.read_bytes())
    if harm == "cut":
        large.write_bytes(data[:-1])
    elif harm == "flipped":
        data[len(data) // 2] ^= 1
        large.write_bytes(data)
    elif harm == "missing":
        large.unlink()
    else:
        large.write_bytes(other.read_bytes())
    done = check_backup(out, passphrase=passphrase)
    assert len(done.wrong) == 1
    assert f"objects/{large.parent.name}/{large.name}" in done.wrong[0]
    emptied(station)
    with pytest.raises(ArchiveError, match="is damaged") as refused:
        restore_backup(out, station.folder, passphrase=passphrase)
    assert "\n" not in str(refused.value)
    assert list(station.folder.glob("*.mcap")) == []


@pytest.mark.long("journey")
@pytest.mark.parametrize("passphrase", ["", "correct horse"])
def test_a_list_that_is_cut_or_of_which_a_byte_is_flipped_is_refused_in_one_line(
    station: SchoolStation, tmp_path: Path, passphrase: str
) -> None:
    path = backup_into(tmp_path / "backups", station.folder, passphrase=passphrase).path
    whole = path.read_bytes()
    places = [len(whole) * k // 40 for k in range(40)]
    for harmed in [whole[:n] for n in places] + [flipped(whole, n) for n in places]:
        path.write_bytes(harmed)
        with pytest.raises(ArchiveError) as refused:
            check_backup(path, passphrase=passphrase)
        assert "\n" not in str(refused.value)


def flipped(data: bytes, place: int) -> bytes:
    return data[:place] + bytes([data[place] ^ 1]) + data[place + 1 :]


def test_another_passphrase_or_none_or_one_too_many_is_one_line(
    station: SchoolStation, tmp_path: Path
) -> None:
    locked, plain = tmp_path / "locked", tmp_path / "plain"
    backup_into(locked, station.folder, passphrase="correct horse")
    backup_into(plain, station.folder)
    with pytest.raises(ArchiveError, match="that is not its passphrase"):
        check_backup(locked, passphrase="wrong horse")
    with pytest.raises(ArchiveError, match="is encrypted: give its passphrase"):
        restore_backup(locked, station.folder)
    with pytest.raises(ArchiveError, match="that is not its passphrase"):
        backup_into(locked, station.folder, passphrase="wrong horse")
    with pytest.raises(ArchiveError, match="are encrypted: give their passphrase"):
        backup_into(locked, station.folder)
    with pytest.raises(ArchiveError, match="are not encrypted: choose another folder"):
        backup_into(plain, station.folder, passphrase="correct horse")
    with pytest.raises(ArchiveError, match="holds no backup"):
        check_backup(station.folder)
    assert len(backups_of(locked)) == len(backups_of(plain)) == 1


@pytest.mark.long("journey")
def test_a_damaged_list_and_a_backup_in_one_file_end_no_later_backups(
    station: SchoolStation, tmp_path: Path
) -> None:
    out = tmp_path / "backups"
    whole = backup_into(out, station.folder, passphrase="correct horse").path
    (out / "z.acusbackup").write_bytes(whole.read_bytes()[:1000])
    backup(out / "acus-2099-01-01.acusbackup", station.folder)
    assert is_encrypted(out)
    added = backup_into(out, station.folder, passphrase="correct horse")
    assert added.new == 0
    (out / "z.acusbackup").unlink()
    assert backups_of(out) == [whole, added.path]  # the file is none of them
    assert check_backup(out, passphrase="correct horse").wrong == ()
    kept = added.path.read_bytes()
    added.path.write_bytes(kept[:1000])
    with pytest.raises(ArchiveError, match=f"damaged: .*; the backup before it is {whole}$"):
        check_backup(out, passphrase="correct horse")
    assert check_backup(whole, passphrase="correct horse").wrong == ()
    added.path.write_bytes(kept)
    whole.write_bytes(whole.read_bytes()[:1000])
    added.path.write_bytes(added.path.read_bytes()[:1000])
    with pytest.raises(ArchiveError, match="is no backup of Acus, or damaged"):
        backup_into(out, station.folder)


@pytest.mark.parametrize("number", [0, 1, 4, 9])
def test_a_backup_that_is_ended_in_between_leaves_the_one_before_and_the_next_goes_on(
    station: SchoolStation, tmp_path: Path, number: int
) -> None:
    class KilledError(Exception):
        pass

    left = [number]

    def kill(deed: str, path: Path) -> None:
        if "backups" in path.parts and deed == "write":
            left[0] -= 1
            if left[0] < 0:
                raise KilledError

    out = tmp_path / "backups"
    with pytest.raises(KilledError), watched(kill):
        backup_into(out, station.folder)
    assert backups_of(out) == []
    backup_into(out, station.folder)
    assert check_backup(out).wrong == ()


def test_cts_go_in_where_they_are_asked_for_and_come_back(
    station: SchoolStation, tmp_path: Path
) -> None:
    data = Path(os.environ["ACUS_DATA"])
    scan = tmp_path / "scan"
    (scan / "a").mkdir(parents=True)
    (scan / "a" / "1.2.3").write_bytes(b"first")
    (scan / "2").write_bytes(b"second")
    (data / "exercises").mkdir(exist_ok=True)
    (data / "exercises" / "own.yaml").write_text(f"ct: {{folder: '{scan}', digest: {'a' * 64}}}\n")
    without = backup_into(tmp_path / "backups", station.folder)
    assert any("the CT" in line and "own" in line for line in without.left_out)
    done = backup_into(tmp_path / "backups", station.folder, with_cts=True)
    assert not any("the CT" in line for line in done.left_out)
    (folder,) = restore_backup(done.path, station.folder).cts
    assert sorted(path.read_bytes() for path in Path(folder).iterdir()) == [b"first", b"second"]


@pytest.mark.long("journey")
def test_the_commands_back_up_check_and_restore(
    station: SchoolStation,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    out, records = str(tmp_path / "backups"), ["--folder", str(station.folder)]
    monkeypatch.setenv("ACUS_BACKUP_PASSPHRASE", "correct horse")
    assert run("store", "backup", "--into", out, "--encrypt", *records) == 0
    assert "3 records written" in capsys.readouterr().out
    assert run("store", "check", out) == 0
    emptied(station)
    assert run("store", "restore", out, *records) == 0
    assert "3 records restored" in capsys.readouterr().out
    monkeypatch.setenv("ACUS_BACKUP_PASSPHRASE", new_recovery_key())
    with pytest.raises(ArchiveError, match="that is not its passphrase"):
        run("store", "check", out)
    with pytest.raises(SessionError, match="--into FOLDER"):
        run("store", "backup", "--out", out, "--encrypt", *records)


def run(*args: str) -> int:
    try:
        build()(args=list(args), prog_name="acus", standalone_mode=False)
    except SystemExit as end:
        return int(end.code or 0)
    return 0
