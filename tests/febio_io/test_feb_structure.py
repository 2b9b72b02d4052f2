"""Models that break a rule of the specification are refused, each with where and why."""

import pytest

from febio_io.command import main
from febio_io.errors import FebioFileError, FebioFormatError
from febio_io.feb.structure import read_structure

MODEL = """<?xml version="1.0"?>
<febio_spec version="4.0">
<Module type="fluid-FSI"/>
<Control><time_steps>4</time_steps><step_size>0.1</step_size></Control>
<Material><material id="1" name="M" type="neo-Hookean"><density>1</density><E>1</E><v>0</v></material>
</Material>
<Mesh><Nodes name="all">
<node id="1">0,0,0</node><node id="2">1,0,0</node><node id="3">0,1,0</node><node id="4">0,0,1</node></Nodes>
<Elements type="tet4" name="P"><elem id="1">1,2,3,4</elem></Elements>
<NodeSet name="N">1,2</NodeSet><Surface name="S"><tri3 id="1">1,2,3</tri3></Surface></Mesh>
<MeshDomains><SolidDomain name="P" mat="M"/></MeshDomains>
<Boundary><bc type="zero displacement" node_set="N"><x_dof>1</x_dof></bc></Boundary>
<Loads><surface_load type="fluid normal velocity" surface="S"><velocity lc="1">1</velocity></surface_load>
</Loads>
<LoadData><load_controller id="1" type="loadcurve"><points><pt>0,0</pt><pt>1,1</pt></points>
</load_controller></LoadData>
<Output><plotfile type="febio"><var type="displacement"/></plotfile></Output>
</febio_spec>
"""


@pytest.fixture
def structure(tmp_path):
    def read(text):
        path = tmp_path / "model.feb"
        path.write_text(text)
        return read_structure(path)

    return read


def test_a_model_in_order(structure, tmp_path, capsys):
    found = structure(MODEL)
    assert (found.module, found.n_steps, found.end) == ("fluid-FSI", 4, pytest.approx(0.4))
    assert (found.nodes, found.elements, found.domains) == ({1, 2, 3, 4}, {"P": 1}, {"P": "M"})
    assert main([str(tmp_path / "model.feb")]) == 0
    assert "its structure is in order" in capsys.readouterr().out
    assert main([str(tmp_path / "model.feb"), "--json"]) == 0
    assert '"elements": 1' in capsys.readouterr().out
    assert main([str(tmp_path / "model.feb"), "--export", str(tmp_path / "out")]) == 2


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            'version="4.0"',
            'version="3.0"',
            r"<febio_spec version='3.0'>; allowed: <febio_spec version='4.0'>",
        ),
        ("febio_spec", "spec", r"<spec version='4.0'>; allowed"),
        ('<Module type="fluid-FSI"/>', "", r"<Module> is missing"),
        ('<Module type="fluid-FSI"/>', "<Module/>", r"<Module>: without type; attributes: type"),
        ("<Output>", "<Output><log/>", r"<Output>, <log>: not allowed there; allowed: plotfile, logfile"),
        ("<Output>", "<Extra/><Output>", r"<Extra>: not known; allowed: Module, Control"),
        ("<Output>", '<Module type="solid"/><Output>', r"<Module> stands twice"),
        ("<time_steps>4<", "<time_steps>four<", r"<Control>, <time_steps>: 'four'; allowed: a whole number"),
        ("<step_size>0.1<", "<step_size>x<", r"<Control>, <step_size>: 'x'; allowed: a number"),
        ("neo-Hookean", "rubber", r"<material id='1' name='M'>: type 'rubber'; allowed: neo-Hookean"),
        ("<E>1</E>", "<E>soft</E>", r"<E>: 'soft'; allowed: a number"),
        ("<E>1</E>", "<F>1</F>", r"<F>: not allowed there; allowed: density, E, v"),
        ("0,0,1<", "0,0<", r"<node id='4'>: '0,0'; allowed: three finite numbers"),
        ("0,0,1<", "0,0,nan<", r"three finite numbers"),
        ('node id="4"', 'node id="3"', r"<node id='3'>: 3 stands twice"),
        ('node id="4"', 'node nr="4"', r"attributes nr; allowed: id"),
        ("1,2,3,4<", "1,2,3,5<", r"<Elements name='P'>, <elem id='1'>: node 5, which does not exist"),
        ("1,2,3,4<", "1,2,3<", r"'1,2,3'; allowed: 4 different nodes"),
        ("1,2,3,4<", "1,2,3,3<", r"4 different nodes"),
        ("1,2,3,4<", "1,2,3,-4<", r"allowed: a whole number"),
        ('type="tet4"', 'type="tet"', r"type 'tet'; allowed: hex8, penta6"),
        ("<elem ", '<elem id="1">1,2,3,4</elem><elem ', r"<elem id='1'>: 1 stands twice"),
        ('<NodeSet name="N">1,2<', '<NodeSet name="N">1,9<', r"<NodeSet name='N'>: node 9, which does not"),
        ("tri3", "tri9", r"<Surface name='S'>, <tri9 id='1'>: not allowed there; allowed: tri3, tri6"),
        ('<tri3 id="1">1,2,3<', '<tri3 id="1">1,2<', r"'1,2'; allowed: 3 different nodes"),
        ('mat="M"', 'mat="W"', r"<SolidDomain name='P'>: mat: 'W' does not exist; there are: M"),
        ('<SolidDomain name="P"', '<SolidDomain name="Q"', r"name: 'Q' does not exist; there are: P"),
        ('<SolidDomain name="P" mat="M"/>', "", r"MeshDomains lacks the elements; Elements name: 'P'"),
        ('node_set="N"', 'node_set="O"', r"<bc>: node_set: 'O' does not exist; there are: N"),
        (' node_set="N"', "", r"<bc>: without node_set and surface"),
        ('surface="S"', 'surface="T"', r"surface: 'T' does not exist; there are: S"),
        ('lc="1"', 'lc="2"', r"lc: '2' does not exist; there are: 1"),
        ("<pt>1,1</pt>", "<pt>0,1</pt>", r"finite values at increasing times"),
        ("<pt>1,1</pt>", "<pt>1</pt>", r"points of a time and a value"),
        ('<var type="displacement"/>', '<var type="flow" surface="T"/>', r"<var type='flow'>: surface: 'T'"),
    ],
)
def test_a_broken_rule_is_named(structure, old, new, said):
    assert old in MODEL
    with pytest.raises(FebioFormatError, match=said):
        structure(MODEL.replace(old, new))


@pytest.mark.parametrize("text", ["", "no XML", MODEL[:200], "<febio_spec version='4.0'>"])
def test_what_is_no_xml_is_refused(structure, text):
    with pytest.raises(FebioFileError, match="not a FEBio model"):
        structure(text)


def test_a_bomb_of_entities_is_refused(structure):
    layers = "".join(f'<!ENTITY e{k} "{f"&e{k - 1};" * 10}">' for k in range(1, 12))
    bomb = f'<!DOCTYPE m [<!ENTITY e0 "{"x" * 100}">{layers}]>'
    bomb += '<febio_spec version="4.0"><Module type="&e11;"/></febio_spec>'
    with pytest.raises((FebioFileError, FebioFormatError)):
        structure(bomb)
