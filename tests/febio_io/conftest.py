from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="session")
def reference_folder():
    return ROOT / "reference_data" / "febio"


@pytest.fixture(scope="session")
def shared_data():
    folder = ROOT.parent / "shared" / "data"
    if not folder.is_dir():
        pytest.skip("the folder of shared data is not beside the repository")
    return folder


@pytest.fixture
def write(tmp_path):
    """Write bytes into a file and give its path."""

    def to_file(content, name="case.xplt"):
        path = tmp_path / name
        path.write_bytes(content)
        return path

    return to_file
