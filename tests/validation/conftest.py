import os

from hypothesis import settings

os.environ["ARTERIAL_ROM_CACHE"] = ""  # tests that replace parts of the code must not find results of others

# no deadline: the first example may compile kernels
settings.register_profile("validation", deadline=None, max_examples=50)
settings.load_profile("validation")
