from hypothesis import settings

# no deadline: the first example may compile kernels
settings.register_profile("validation", deadline=None, max_examples=50)
settings.load_profile("validation")
