"""The cache of results: what makes an entry another one, damage, room, two processes, and its use."""

import json
import os
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pytest
import xarray as xr
from kept_entry import entry
from small_case import ROOT, bands, small_case, written
from tube_plot import write_tube
from tubes import Tube

from cases.reading.case_file import load_case_file
from solver.kept import ABANDONED
from validation.compare import command as compare
from validation.errors import ValidationError
from validation.mapping.rays import rays
from validation.reference.alignment import align
from validation.runs import cached as cached_runs
from validation.runs.cache import Cache, open_cache
from validation.runs.cached import reference_key, rom_key
from validation.runs.keys import canonical

GENEROUS = ("radius", "rms_error", "50 %")
SHORT = Tube(sectors=8, rings=2, stacks=6, layers=1)


@pytest.fixture
def store(tmp_path):
    return Cache(tmp_path)


class TestStorage:
    def test_what_was_kept_comes_back(self, store):
        store.put("a", entry())
        found = store.get("a")
        assert found.facts == entry().facts
        xr.testing.assert_identical(found.datasets["fields"], entry().datasets["fields"])
        assert found.datasets["fields"]["single"].dtype == np.float32

    def test_nothing_is_found_under_another_key(self, store):
        store.put("a", entry())
        assert store.get("b") is None

    def test_a_fresh_cache_is_only_written(self, store):
        store.put("a", entry())
        fresh = replace(store, fresh=True)
        assert fresh.get("a") is None
        fresh.put("b", entry())
        assert store.get("b") is not None

    @pytest.mark.parametrize("place", [0, 0.02, 0.3, 0.5, 0.7, 0.95])
    def test_a_changed_byte_is_noticed(self, store, place):
        store.put("a", entry(500))
        path = store.folder / "a.npz"
        content = bytearray(path.read_bytes())
        at = int(place * len(content))
        content[at : at + 64] = bytes(64 * [255])
        path.write_bytes(content)
        with pytest.raises(ValidationError, match=r"a\.npz was damaged"):
            store.get("a")
        assert store.get("a") is None

    @pytest.mark.parametrize("flipped", [0x01, 0x08, 0xFF])
    def test_a_damaged_octet_of_the_files_frame_is_noticed_or_harmless(self, store, flipped):
        store.put("a", entry())
        path = store.folder / "a.npz"
        content = path.read_bytes()
        with ZipFile(path) as stored:
            frame = [*range(192), *range(stored.start_dir, len(content))]
        told = 0
        for at in frame:
            path.write_bytes(content[:at] + bytes([content[at] ^ flipped]) + content[at + 1 :])
            try:
                assert store.get("a").facts == entry().facts
            except ValidationError:
                told += 1
        assert told > len(frame) / 2

    @pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.99])
    def test_a_file_cut_off_is_noticed(self, store, share):
        store.put("a", entry())
        path = store.folder / "a.npz"
        path.write_bytes(path.read_bytes()[: int(share * path.stat().st_size)])
        with pytest.raises(ValidationError, match="was damaged"):
            store.get("a")

    def test_entries_used_longest_ago_make_room(self, store):
        store.put("size", entry())
        size = (store.folder / "size.npz").stat().st_size
        (store.folder / "size.npz").unlink()
        small = replace(store, limit=int(2.5 * size))
        for age, key in ((300, "old"), (200, "used"), (100, "new")):
            small.put(key, entry())
            past = (small.folder / f"{key}.npz").stat().st_mtime - age
            os.utime(small.folder / f"{key}.npz", (past, past))
            if key == "used":
                assert small.get("old") is not None  # which makes it the last one used
        assert small.get("used") is None
        assert small.get("old") is not None

    def test_what_a_dead_process_left_is_removed(self, store):
        (store.folder / ".a.1.1.part").touch()
        (store.folder / ".b.1.1.part").touch()
        past = store.folder.stat().st_mtime - 2 * ABANDONED
        os.utime(store.folder / ".a.1.1.part", (past, past))
        store.put("c", entry())
        assert {path.name for path in store.folder.iterdir()} == {".b.1.1.part", "c.npz"}

    def test_a_folder_that_cannot_be_written_to_is_said(self, tmp_path):
        with pytest.raises(ValidationError, match="cannot be written"):
            Cache(tmp_path / "absent").put("a", entry())

    @pytest.mark.slow
    def test_two_processes_share_a_folder(self, tmp_path):
        code = (
            "import sys; sys.path[:0] = ['tests/validation', '.']\n"
            "from pathlib import Path; from kept_entry import entry\n"
            "from validation.runs.cache import Cache\n"
            f"store = Cache(Path({str(tmp_path)!r}), limit=12000)\n"
            "for n in range(60):\n"
            "    store.put(f'k{n % 7}', entry())\n"
            "    store.get(f'k{(3 * n) % 7}')\n"
        )
        runs = [
            subprocess.Popen([sys.executable, "-c", code], cwd=ROOT, stderr=subprocess.PIPE, text=True)  # noqa: S603
            for _ in range(2)
        ]
        assert [run.communicate(timeout=120)[1] for run in runs] == ["", ""]
        assert all(path.suffix == ".npz" for path in tmp_path.iterdir())

    def test_where_it_lies(self, tmp_path, monkeypatch):
        monkeypatch.setenv("ARTERIAL_ROM_CACHE", str(tmp_path / "own"))
        assert open_cache().folder == tmp_path / "own"
        monkeypatch.setenv("ARTERIAL_ROM_CACHE", "")
        assert open_cache() is None
        monkeypatch.delenv("ARTERIAL_ROM_CACHE")
        monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
        assert open_cache().folder == tmp_path / "arterial-rom-validation" / "results"


@pytest.fixture
def made(tmp_path):
    """A case against a small tube."""
    plot = write_tube(tmp_path / "tube.xplt", SHORT, np.linspace(0.0, 0.79, 5))

    def case(*declared):
        content = bands(small_case("none"), *declared)
        content["reference"] |= {"lumen": ["Blood"], "wall": ["Wall"], "time_offset": "0 s"}
        content["variants"]["none"]["reference"] = {"plot_file": str(plot)}
        return content

    return case


class TestKeys:
    def keys(self, content, folder, times=5):
        case = load_case_file(written(content, folder)).variants["none"]
        instants = align(np.linspace(0.0, 0.79, times), 0.0, case.inlet.period, case.solver.cycles)
        cells = rays(np.array([1e-3]), np.array([0.5]))
        return rom_key(case, instants, cells), reference_key(case, instants, cells)

    @pytest.mark.parametrize(
        ("section", "key", "value", "rom", "reference"),
        [
            ("blood", "viscosity", "0.003 Pa s", True, False),
            ("wall", "youngs_modulus", "0.5 MPa", True, False),
            ("outlet", "offset", "9331 Pa", True, False),
            ("solver", "time_step", "5 ms", True, False),
            ("geometry", "radius", "2.51 mm", True, True),
            ("inlet", "waveform", str(ROOT / "reference_data/waveforms/thesis_inlet.csv"), False, False),
            ("reference", "phi_zero", "-x", False, True),
            ("compare", "times", ["systole"], False, False),
        ],
    )
    def test_what_an_entry_depends_on(self, tmp_path, made, section, key, value, rom, reference):
        before = self.keys(made(), tmp_path)
        changed = made(GENEROUS)
        changed["title"] = "Another title"
        changed[section][key] = value
        after = self.keys(changed, tmp_path)
        assert (before[0] != after[0], before[1] != after[1]) == (rom, reference)

    def test_instants_matter(self, tmp_path, made):
        assert not set(self.keys(made(), tmp_path)) & set(self.keys(made(), tmp_path, times=6))

    def test_contents_of_files_matter(self, tmp_path, made):
        before = self.keys(made(), tmp_path)
        with (tmp_path / "tube.xplt").open("ab") as stream:
            stream.write(b"\0")
        after = self.keys(made(), tmp_path)
        assert before[0] == after[0]
        assert before[1] != after[1]

    def test_code_matters(self, tmp_path, made, monkeypatch):
        before = self.keys(made(), tmp_path)
        monkeypatch.setattr("validation.runs.keys.code_digest", lambda kind: "other code")
        assert not set(before) & set(self.keys(made(), tmp_path))

    def test_floats_count_with_all_their_digits(self):
        assert canonical(0.1) != canonical(np.nextafter(0.1, 1))
        with pytest.raises(TypeError, match="object has no canonical form"):
            canonical({"a": [object()]})


class TestUse:
    @pytest.fixture
    def run(self, tmp_path, monkeypatch, made):
        """Run a case with a cache; give its metrics and provenance."""
        monkeypatch.setenv("ARTERIAL_ROM_CACHE", str(tmp_path / "cache"))
        monkeypatch.setattr("validation.compare.case.write_reports", lambda directory: None)

        def finished(*options, declared=()):
            result = tmp_path / "result"
            shutil.rmtree(result, ignore_errors=True)  # one that need not be computed again
            arguments = [str(written(made(*declared), tmp_path)), "--output", str(result), *options]
            assert compare.main(arguments) == 0
            about = json.loads((result / "provenance.json").read_text(encoding="utf-8"))
            return (result / "metrics.csv").read_text(), about

        return finished

    def used(self, about):
        none = about["variants"]["none"]
        return [each.get("from_cache", False) for each in (none["models"]["rom"], none["reference"])]

    def test_another_band_computes_nothing_anew(self, run, monkeypatch):
        first, about = run()
        assert self.used(about) == [False, False]
        monkeypatch.setattr(cached_runs, "run_reduced_model", lambda *_: pytest.fail("the model ran"))
        monkeypatch.setattr("validation.mapping.state.Mapper.map_state", lambda *_: pytest.fail("mapped"))
        second, again = run(declared=[GENEROUS])
        assert self.used(again) == [True, True]
        assert [line for line in second.splitlines() if not line.endswith("OK")] == first.splitlines()
        one, two = (each["variants"]["none"]["models"]["rom"] for each in (about, again))
        assert one["wall_time_s"] == two["wall_time_s"]

    def test_fresh_computes_everything(self, run):
        first, _ = run()
        second, about = run("--fresh")
        assert self.used(about) == [False, False]
        assert first == second

    def test_a_damaged_entry_is_computed_anew_with_a_remark(self, run, tmp_path, capsys):
        first, _ = run()
        entries = sorted((tmp_path / "cache").glob("*.npz"))
        for path in entries:
            path.write_bytes(path.read_bytes()[:1000])
        second, about = run()
        assert second == first
        assert self.used(about) == [False, False]
        assert sum("was damaged" in note and "computed anew" in note for note in about["notes"]) == len(
            entries
        )
        assert capsys.readouterr().err.count("was damaged") == len(entries)
        assert self.used(run()[1]) == [True, True]

    def test_a_cache_that_cannot_be_written_to_costs_only_time(self, run, monkeypatch, capsys):
        def full(*_arguments):
            raise ValidationError("no space left")

        monkeypatch.setattr(Cache, "put", full)
        _, about = run()
        assert sum("no space left" in note for note in about["notes"]) == 4
        assert Path(about["case"]["path"]).name == "small.yaml"
