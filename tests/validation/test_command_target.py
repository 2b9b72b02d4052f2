"""`python -m validation.compare`: where a result goes, and what it never replaces."""

import json

import pandas as pd
import pytest
from small_case import IMPOSSIBLE, written

from validation.compare import command as compare


class TestTarget:
    def test_a_result_is_replaced_whole(self, tmp_path, quick, made):
        path, result = written(made(), tmp_path), tmp_path / "result"
        for _ in range(2):
            assert compare.main([str(path), "--output", str(result)]) == 0
            (result / "report.pdf").write_text("older")
        assert compare.main([str(path), "--output", str(result)]) == 0
        assert not (result / "report.pdf").exists()
        assert {item.name for item in tmp_path.iterdir()} == {path.name, result.name}

    def test_a_result_with_files_of_others_is_refused(self, tmp_path, capsys, quick, made):
        path, result = written(made(), tmp_path), tmp_path / "result"
        assert compare.main([str(path), "--output", str(result)]) == 0
        (result / "my notes.txt").write_text("precious")
        assert compare.main([str(path), "--output", str(result)]) == 2
        assert "my notes.txt" in capsys.readouterr().err
        assert (result / "my notes.txt").read_text() == "precious"

    def test_an_empty_directory_is_used(self, tmp_path, quick, made):
        (tmp_path / "result").mkdir()
        path = written(made(), tmp_path)
        assert compare.main([str(path), "--output", str(tmp_path / "result")]) == 0
        assert (tmp_path / "result/metrics.csv").is_file()

    def test_a_directory_of_something_else_is_refused(self, tmp_path, capsys, monkeypatch, made):
        monkeypatch.setattr(
            "validation.compare.case.compare_case", lambda *_: pytest.fail("something was computed")
        )
        keep = tmp_path / "result" / "thesis.txt"
        keep.parent.mkdir()
        keep.write_text("precious")
        path = written(made(), tmp_path)
        assert compare.main([str(path), "--output", str(keep.parent)]) == 2
        assert capsys.readouterr().err.endswith("is no result of a comparison; choose another --output\n")
        assert keep.read_text() == "precious"
        assert {item.name for item in tmp_path.iterdir()} == {path.name, "result"}

    @pytest.mark.parametrize("below", [".", "deeper/result"])
    def test_a_file_in_the_way_is_refused(self, tmp_path, capsys, quick, below, made):
        (tmp_path / "result").write_text("precious")
        path = written(made(), tmp_path)
        assert compare.main([str(path), "--output", str(tmp_path / "result" / below)]) == 2
        assert len(capsys.readouterr().err.splitlines()) == 1
        assert (tmp_path / "result").read_text() == "precious"

    def test_the_current_directory_is_used_or_refused(self, tmp_path, capsys, quick, monkeypatch, made):
        path = written(made(), tmp_path)
        (tmp_path / "here").mkdir()
        monkeypatch.chdir(tmp_path / "here")
        assert compare.main([str(path), "--output", "."]) in (0, 2)
        assert {item.name for item in tmp_path.iterdir()} == {path.name, "here"}

    def test_several_cases_go_side_by_side(self, tmp_path, quick, capsys, made):
        first, second = made(), made(IMPOSSIBLE)
        second["name"] = "second"
        paths = [written(first, tmp_path, "a.yaml"), written(second, tmp_path, "b.yaml")]
        assert compare.main([*map(str, paths), "--output", str(tmp_path / "both")]) == 0
        assert {item.name for item in (tmp_path / "both").iterdir()} == {
            "calcification", "second", "side_by_side.csv", "side_by_side.json"
        }  # fmt: skip
        assert len(capsys.readouterr().out.splitlines()) == 3
        table = pd.read_csv(tmp_path / "both/side_by_side.csv")
        lines = json.loads((tmp_path / "both/side_by_side.json").read_text(encoding="utf-8"))
        assert [line["quantity"] for line in lines] == table["quantity"].tolist()
        for name in ("calcification", "second"):
            own = pd.read_csv(tmp_path / "both" / name / "metrics.csv")
            rms = own[(own["quantity"] == "radius") & (own["statistic"] == "rms_error") & own["i"].isna()]
            line = table[(table["quantity"] == "radius") & (table["statistic"] == "rms_error")]
            assert line[f"{name}: error"].tolist() == rms["error"].tolist()[:1]
        assert table["second: status"].dropna().tolist() == ["FAIL"]
        assert table["calcification: status"].dropna().tolist() == []

    def test_cases_of_one_name_are_refused(self, tmp_path, quick, capsys, made):
        path = str(written(made(), tmp_path))
        assert compare.main([path, path, "--output", str(tmp_path / "both")]) == 2
        assert "case names must differ" in capsys.readouterr().err
        assert not (tmp_path / "both").exists()
