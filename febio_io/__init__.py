"""FEBio's files: readers for plot files, logs and data records, and models of arteries.

    from febio_io.xplt import open_plot
    from febio_io.text.log import read_log
    from febio_io.text.data_records import read_data_record

    with open_plot("case.xplt") as plot:
        velocity = plot.field("nodal fluid velocity", state=-1)  # (n_nodes, 3)
        pressure = plot.field("fluid pressure", -1, "Lumen")  # (n_elements,)
        history = plot.series("displacement")  # (n_states, n_nodes, 3)
        dataset = plot.to_xarray(variables=["displacement"])
        grid = plot.to_pyvista(-1, deformed=True)

``pyvista.read("case.xplt")`` works without an import, by an entry point, where this package is installed
beside pyvista 0.49 or later. ``meshio.read("case.xplt")`` works after ``import
febio_io.views.meshio_format``, as meshio knows no entry points; meshio itself is an optional requirement:
``pip install arterial-rom-validation[meshio]``.

``python -m febio_io FILE`` tells what a file holds, and writes results in other formats; ``python -m
febio_io.feb CASE.yaml`` writes FEBio's model of a case, and ``python -m febio_io.run MODEL.feb`` runs it.
"""
