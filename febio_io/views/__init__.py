"""What a plot file is to other libraries and programs: xarray, pyvista, meshio, tables, ParaView."""
