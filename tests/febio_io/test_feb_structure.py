"""What is wrong with a model for sure is told, each with where and why; what is not known is not judged."""

import re

import pytest

from febio_io.command import main
from febio_io.errors import FebioFileError
from febio_io.feb.structure import read_structure

UNCHECKED = ["parameters of <Control>", "variables of <Output>"]
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
        ('version="4.0"', 'version="5.0"', r"<febio_spec version='5.0'>; FEBio 4 reads versions 1.2, 2.0"),
        ('<Module type="fluid-FSI"/>', "", r"<Module> is missing"),
        ('<Module type="fluid-FSI"/>', "<Module/>", r"<Module>: without type"),
        ("<Output>", '<Module type="solid"/><Output>', r"<Module> stands twice"),
        ("<time_steps>4<", "<time_steps>four<", r"<Control>, <time_steps>: 'four'; allowed: a whole number"),
        ("<time_steps>4<", "<time_steps>4.5<", r"<time_steps>: '4.5'; allowed: a whole number"),
        ("<step_size>0.1<", "<step_size>x<", r"<Control>, <step_size>: 'x'; allowed: a number"),
        (
            "<Control><time_steps>4</time_steps><step_size>0.1</step_size></Control>",
            "",
            r"<Control> is missing, with its <time_steps>; so is a <Step>",
        ),
        ("0,0,1<", "0,0<", r"<node id='4'>: '0,0'; allowed: three finite numbers"),
        ("0,0,1<", "0,0,nan<", r"three finite numbers"),
        ('node id="4"', 'node id="3"', r"<node id='3'>: 3 stands twice"),
        ('node id="4"', 'node nr="4"', r"<node id=None>: without id"),
        ("1,2,3,4<", "1,2,3,5<", r"<Elements name='P'>, <elem id='1'>: node 5, which does not exist"),
        ("1,2,3,4<", "1,2,3<", r"'1,2,3'; allowed: 4 different nodes"),
        ("1,2,3,4<", "1,2,3,3<", r"4 different nodes"),
        ("1,2,3,4<", "1,2,3,-4<", r"node -4, which does not exist"),
        ("1,2,3,4<", "1,2,3,x<", r"allowed: whole numbers"),
        ("<elem ", '<elem id="1">1,2,3,4</elem><elem ', r"<elem id='1'>: 1 stands twice"),
        ('<NodeSet name="N">1,2<', '<NodeSet name="N">1,9<', r"<NodeSet name='N'>: node 9, which does not"),
        ('<NodeSet name="N">', '<NodeSet name="N">1</NodeSet><NodeSet name="N">', r"'N' stands twice"),
        ('<tri3 id="1">1,2,3<', '<tri3 id="1">1,2<', r"'1,2'; allowed: 3 different nodes"),
        ('<tri3 id="1">1,2,3<', '<tri3 id="1">1,2,7<', r"<tri3 id='1'>: node 7, which does not exist"),
        ('mat="M"', 'mat="W"', r"<SolidDomain name='P'>: mat: 'W' does not exist; there are: M"),
        ('<SolidDomain name="P"', '<SolidDomain name="Q"', r"name: 'Q' does not exist; there are: P"),
        ('<SolidDomain name="P" mat="M"/>', "", r"MeshDomains lacks the elements; Elements name: 'P'"),
        ('node_set="N"', 'node_set="O"', r"<bc>: node_set: 'O' does not exist; there are: N"),
        ('node_set="N"', 'node_set="@surface:T"', r"<bc>: node_set: '@surface:T' does not exist"),
        (' node_set="N"', "", r"<bc>: without node_set and surface"),
        ('surface="S"', 'surface="T"', r"surface: 'T' does not exist; there are: S"),
        (' surface="S"', "", r"<surface_load>: without surface"),
        ('lc="1"', 'lc="2"', r"lc: '2' does not exist; there are: 1"),
        ("<pt>1,1</pt>", "<pt>1</pt>", r"points of a time and a value"),
        ("<pt>1,1</pt>", "<pt>1,nan</pt>", r"points of a time and a value"),
        ('<var type="displacement"/>', '<var type="flow" surface="T"/>', r"<var type='flow'>: surface: 'T'"),
        ("<x_dof>1</x_dof>", '<x_dof type="map">grown</x_dof>', r"map: 'grown' does not exist"),
        (
            "</Mesh>",
            '<SurfacePair name="C"><primary>S</primary><secondary>T</secondary></SurfacePair></Mesh>',
            r"<SurfacePair>, <secondary>: 'T' does not exist; there are: S",
        ),
        (
            "<Output>",
            '<Contact><contact type="sliding-elastic" surface_pair="C"/></Contact><Output>',
            r"<contact>: surface_pair: 'C' does not exist",
        ),
    ],
)
def test_what_is_wrong_for_sure_is_named(structure, tmp_path, capsys, old, new, said):
    assert old in MODEL
    found = structure(MODEL.replace(old, new))
    assert [problem for problem in found.problems if re.search(said, problem)]
    assert main([str(tmp_path / "model.feb")]) == 2
    assert re.search(said, capsys.readouterr().err)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("<Output>", "<Output><log/>", "<Output>, <log>, unknown to FEBio 4.11"),
        ("<Output>", "<Extra/><Output>", "<Extra>, unknown to FEBio 4.11"),
        ("neo-Hookean", "rubber", "<material type='rubber'>"),
        ("<E>1</E>", "<E>soft</E>", "<material id='1' name='M'>, <E>: the expression 'soft'"),
        ("<E>1</E>", "<F>1</F>", "<material id='1' name='M'>, <F> of 'neo-Hookean', unknown to FEBio 4.11"),
        ("zero displacement", "warped", "<bc type='warped'>"),
        ("tri3", "tri9", "<Surface>, <tri9>, unknown to FEBio 4.11"),
        ('type="tet4"', 'type="tet"', "elements of type 'tet', unknown to FEBio 4.11"),
        ("</Mesh>", "<Sphere/></Mesh>", "<Mesh>, <Sphere>, unknown to FEBio 4.11"),
        ("<Output>", '<Include>more.feb</Include><Output surface="T">', "<Include> of another file"),
        ('version="4.0"', 'version="1.2"', "what version 1.2 allows"),
    ],
)
def test_what_is_not_known_is_not_checked(structure, tmp_path, capsys, old, new, said):
    assert old in MODEL
    found = structure(MODEL.replace(old, new))
    assert found.problems == []
    assert [what for what in found.unchecked if what.startswith(said)]
    assert main([str(tmp_path / "model.feb")]) == 0
    assert said in capsys.readouterr().out


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('<Module type="fluid-FSI"/>', '<Module type="fluid-FSI"><units>mm-N-s</units></Module>'),
        ("<step_size>", '<time_stepper type="default"><dtmax lc="1">1</dtmax></time_stepper><step_size>'),
        ('node_set="N"', 'node_set="@surface:S"'),
        ('node_set="N"', 'node_set="@elem_set:P"'),
        ('node_set="N"', 'node_set="all"'),
        ("1,2,3,4</elem>", "1,2,3,4</elem><elem id='2'> 1, 3, 2,4 </elem>"),
        ('type="tet4"', 'type="TET4G4"'),
        (
            "<Output>",
            (
                '<Step><step id="1"><Control><time_steps>2</time_steps><step_size>1</step_size></Control>'
                '<Loads><surface_load type="pressure" surface="S"/></Loads></step></Step><Output>'
            ),
        ),
        (
            "<Output>",
            (
                '<Rigid><rigid_bc type="rigid_fixed"><rb>M</rb></rigid_bc></Rigid>'
                '<Constraints><constraint type="volume" surface="S"/></Constraints><Output>'
            ),
        ),
        ("<pt>1,1</pt>", "<pt>1,1</pt><pt>0.5,2</pt>"),  # FEBio sorts them
        ("<E>1</E>", '<E type="math">1+X</E>'),
        ("<?xml version", "<?xml version"),
    ],
)
def test_what_febio_accepts_is_accepted(structure, old, new):
    assert old in MODEL
    assert structure(MODEL.replace(old, new)).problems == []


OLD = """<?xml version="1.0" encoding="ISO-8859-1"?>
<febio_spec version="2.5"><Module type="solid"/><Control><time_steps>10</time_steps>
<step_size>0.1</step_size></Control>
<Material><material id="1" name="M" type="neo-Hookean"><E>1</E></material></Material>
<Geometry><Nodes name="all"><node id="1">0,0,0</node><node id="2">1,0,0</node><node id="3">0,1,0</node>
<node id="4">0,0,1</node></Nodes><Elements type="tet4" mat="1" name="P"><elem id="1">1,2,3,4</elem></Elements>
<NodeSet name="N"><node id="1"/><node id="2"/></NodeSet></Geometry>
<Boundary><fix bc="x,y,z" node_set="N"/></Boundary>
<LoadData><loadcurve id="1" type="linear"><point>0,0</point></loadcurve></LoadData></febio_spec>
"""


def test_a_model_of_febio_2(structure, tmp_path, capsys):
    found = structure(OLD)
    assert (found.problems, found.domains, found.n_steps) == ([], {"P": "1"}, 10)
    assert main([str(tmp_path / "model.feb")]) == 0
    assert "FEBio model 2.5, solid" in capsys.readouterr().out
    assert "node 9" in structure(OLD.replace('<node id="2"/>', '<node id="9"/>')).problems[0]
    assert "node_set: 'O'" in structure(OLD.replace('node_set="N"', 'node_set="O"')).problems[0]
    assert "mat: '2'" in structure(OLD.replace('mat="1"', 'mat="2"')).problems[0]


def test_many_problems_are_counted(structure, tmp_path, capsys):
    rows = "".join(f'<elem id="{number}">1,2,3,9</elem>' for number in range(2, 500))
    found = structure(MODEL.replace("<elem ", rows + "<elem "))
    assert (found.n_problems, len(found.problems)) == (498, 100)
    assert main([str(tmp_path / "model.feb")]) == 2
    assert "and 488 more problems" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("<febio_optimize version='2.0'/>", "an optimization of FEBio"),
        ("<?xml version='1.0'?><svg/>", "its first tag is <svg>"),
        ("<spec version='4.0'/>", "its first tag is <spec>"),
    ],
)
def test_what_is_no_model(structure, text, what):
    with pytest.raises(FebioFileError, match=what):
        structure(text)


def test_the_models_of_this_package_hold_nothing_that_is_unknown(shared_data):
    for name in ("febio/local.feb", "febio/tiny_raw.feb", "febio_reversal/reversal.feb"):
        found = read_structure(shared_data / name)
        assert (found.problems, list(found.unchecked)) == ([], UNCHECKED)


@pytest.mark.parametrize(
    "name", ["ok", "no_fluid_type", "dtmax_lc", "units", "dilatation", "at_surface", "mooney"]
)
def test_small_models_that_febio_accepts(shared_data, capsys, name):
    assert main([str(shared_data / "inputs_that_fail" / f"feb_{name}.feb")]) == 0
    assert ("<material type='Mooney-Rivlin'>" in capsys.readouterr().out) == (name == "mooney")


@pytest.mark.parametrize("text", ["", "no XML", MODEL[:200], "<febio_spec version='4.0'>"])
def test_what_is_no_xml_is_refused(structure, text):
    with pytest.raises(FebioFileError, match="not a FEBio model"):
        structure(text)


def test_a_bomb_of_entities_is_refused(structure):
    layers = "".join(f'<!ENTITY e{k} "{f"&e{k - 1};" * 10}">' for k in range(1, 12))
    bomb = f'<!DOCTYPE m [<!ENTITY e0 "{"x" * 100}">{layers}]>'
    bomb += '<febio_spec version="4.0"><Module type="&e11;"/></febio_spec>'
    with pytest.raises(FebioFileError):
        structure(bomb)
