"""Running a locally installed FEBio: ``python -m febio_io.run MODEL.feb``."""
