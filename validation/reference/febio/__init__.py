"""``reference.kind: febio``: plot file, log and data records of a FEBio run."""
