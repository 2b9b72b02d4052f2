from pathlib import Path

import pytest
from case_folder import CaseFolder


@pytest.fixture
def folder(tmp_path: Path) -> CaseFolder:
    return CaseFolder(tmp_path)


@pytest.fixture
def ready_file() -> Path:
    return Path(__file__).parents[2] / "cases/calcification.yaml"
