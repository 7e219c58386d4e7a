"""Independent solutions that tests compare the package with."""
