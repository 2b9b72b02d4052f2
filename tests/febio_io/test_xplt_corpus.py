"""Plot files of FEBio's own test problems, where they are at hand."""

import numpy as np
import pytest

from febio_io.xplt import open_plot

# Name: states, element types in the order of the domains.
CORPUS = {
    "bs01": (29, ["hex8"]),
    "bt03": (6, ["line3"]),
    "co44": (51, ["hex8", "hex8"]),
    "co61": (11, ["quad4", "hex8"]),
    "di05": (21, ["tet4", "tet4", "line2"]),
    "fl07": (2, ["hex8"]),
    "ma32": (101, ["hex8"]),
    "ma61": (27, ["hex8"]),
    "oi09": (72, ["hex8", "quad4"]),
    "pl07": (9, ["hex20"]),
    "rj08": (11, ["hex8", "hex8", "hex8"]),
}


@pytest.fixture(scope="session")
def corpus(shared_data):
    folder = shared_data / "xplt_corpus"
    if not folder.is_dir():
        pytest.skip("the corpus of plot files is not beside the repository")
    return folder


def test_every_file_is_expected(corpus):
    assert {path.stem for path in corpus.glob("*.xplt")} == set(CORPUS)


@pytest.mark.parametrize("name", CORPUS)
def test_every_file_is_read_whole(corpus, name):
    n_states, element_types = CORPUS[name]
    with open_plot(corpus / f"{name}.xplt") as plot:
        assert plot.n_states == n_states
        assert plot.warnings == ()
        assert [domain.element_type.name for domain in plot.mesh.domains] == element_types
        blocks = 0
        for state in range(n_states):
            assert plot.active_elements(state).shape == (plot.mesh.n_elements,)
            for item in plot.objects(state):
                assert set(item.values) == {variable.name for variable in item.model_object.variables}
                blocks += len(item.values)
            for variable in plot.variables:
                for region in plot.regions(variable, state):
                    values = plot.field(variable, state, region)
                    assert np.isfinite(values).all()
                    blocks += 1
        assert blocks >= n_states


def test_rigid_bodies_are_where_their_domains_are(corpus):
    with open_plot(corpus / "rj08.xplt") as plot:
        assert [(item.kind, item.name) for item in plot.mesh.objects] == [
            ("point", "Ground"),
            ("point", "Slider"),
            ("point", "RigidPrismaticJoint01"),
            ("line", "RigidSpring01"),
        ]
        slider = plot.objects(-1)[1]
        np.testing.assert_allclose(slider.position, slider.values["Position"])
        (domain,) = (domain for domain in plot.mesh.domains if domain.part_name == "Slider")
        corners = (plot.mesh.coordinates + plot.field("displacement", -1))[domain.nodes]
        np.testing.assert_allclose(corners.mean(axis=0), slider.position, atol=1e-6)


def test_rigid_bodies_without_states_of_their_own(corpus):
    with open_plot(corpus / "di05.xplt") as plot:
        assert len(plot.mesh.objects) == 2
