"""References of named arrays on a mesh, whatever library reads their files."""
