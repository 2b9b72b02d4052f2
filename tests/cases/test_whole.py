"""What is written appears whole or not at all."""

import errno

import pytest

from cases.errors import CaseError
from cases.shell.whole import write_text, write_whole, write_whole_folder, writing


def broken_off(path, error):
    with write_whole(path) as partial:
        partial.write_text("half")
        raise error


@pytest.mark.parametrize("error", [ValueError(), OSError(), KeyboardInterrupt(), SystemExit()])
@pytest.mark.parametrize("before", [None, "older"])
def test_a_file_that_breaks_off_leaves_what_was(tmp_path, error, before):
    path = tmp_path / "result.txt"
    if before is not None:
        path.write_text(before)
    with pytest.raises(type(error)):
        broken_off(path, error)
    assert [each.name for each in tmp_path.iterdir()] == ([] if before is None else ["result.txt"])
    assert before is None or path.read_text() == before


def test_a_file_is_not_there_before_it_is_complete(tmp_path):
    path = tmp_path / "result.txt"
    with write_whole(path) as partial:
        partial.write_text("all of it")
        assert partial.parent == tmp_path
        assert not path.exists()
    assert path.read_text() == "all of it"
    assert list(tmp_path.iterdir()) == [path]
    write_text(path, "φ\n")
    assert path.read_bytes() == "φ\n".encode()


def fill(place, error=None):
    with write_whole_folder(place) as partial:
        (partial / "new").touch()
        assert not (place / "new").exists()
        if error is not None:
            raise error


@pytest.mark.parametrize("error", [ValueError(), KeyboardInterrupt()])
def test_a_folder_that_breaks_off_leaves_what_was(tmp_path, error):
    place = tmp_path / "old"
    place.mkdir()
    (place / "older").touch()
    with pytest.raises(type(error)):
        fill(place, error)
    with pytest.raises(type(error)):
        fill(tmp_path / "above" / "none", error)
    assert sorted(tmp_path.rglob("*")) == [place, place / "older"]


def test_a_folder_takes_the_place_of_another_with_all_that_is_in_it(tmp_path):
    place = tmp_path / "old"
    place.mkdir()
    (place / "older").touch()
    fill(place)
    fill(tmp_path / "above" / "none")
    files = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert sorted(files) == [tmp_path / "above/none/new", place / "new"]
    assert len(list(tmp_path.iterdir())) == 2
    assert place.stat().st_mode & 0o777 == 0o755


def test_a_full_disk_is_told_with_the_path(tmp_path):
    with pytest.raises(CaseError) as told, writing(tmp_path, CaseError):
        raise OSError(errno.ENOSPC, "No space left on device")
    assert str(told.value) == f"{tmp_path}: cannot be written: No space left on device"
