"""Whatever a file holds, loading it gives a case or a message."""

import io
from copy import deepcopy

import pytest
from case_folder import BASE
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from ruamel.yaml import YAML

from cases.errors import CaseFileError
from cases.reading.case_file import load_case_file

DATA = YAML(typ="safe").load(BASE)
shared_folder = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)


def places(value, path=()):
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, below in items:
        yield (*path, key)
        yield from places(below, (*path, key))


odd_scalars = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5) | st.just("1 mm")
odd_values = st.recursive(
    odd_scalars,
    lambda below: (
        st.lists(below, max_size=3)
        | st.dictionaries(
            st.sampled_from(["x", "phi", "pattern", "kind", "i", "law", "layers", "fourier", "scheme"]), below
        )
    ),
    max_leaves=4,
)


def loads_or_explains(folder, content):
    file = folder.path / "x.yaml"
    file.write_bytes(content)
    try:
        load_case_file(file)
    except CaseFileError as error:
        message = str(error)
    else:
        return
    assert all(line.startswith(str(file)) for line in message.split("\n"))


@shared_folder
@given(place=st.sampled_from(list(places(DATA))), value=odd_values)
def test_a_value_of_any_kind_anywhere(folder, place, value):
    data = deepcopy(DATA)
    section = data
    for key in place[:-1]:
        section = section[key]
    section[place[-1]] = value
    stream = io.BytesIO()
    YAML(typ="safe", pure=True).dump(data, stream)
    loads_or_explains(folder, stream.getvalue())


@shared_folder
@given(start=st.integers(0, len(BASE)), stop=st.integers(0, len(BASE)), noise=st.binary(max_size=4))
def test_a_file_cut_or_garbled_anywhere(folder, start, stop, noise):
    content = BASE.encode()
    loads_or_explains(folder, content[:start] + noise + content[stop:])


@pytest.mark.parametrize(
    "content", [b"", b"\x00", b"%YAML 9.0\n---\na: 1", b"a: 2001-02-30", b"a: !!int x", b"!!int 3"]
)
def test_odd_files(folder, content):
    loads_or_explains(folder, content)
