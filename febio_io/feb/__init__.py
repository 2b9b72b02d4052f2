"""FEBio's models (.feb): a calcified artery as a fluid-FSI model, written from plain numbers.

    from febio_io.feb.model import ArteryModel
    from febio_io.feb.writer import write_model

``python -m febio_io.feb CASE.yaml --output MODEL.feb`` writes the model of a case file.
"""
