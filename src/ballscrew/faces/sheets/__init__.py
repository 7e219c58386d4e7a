"""Renderers of sheets (:mod:`ballscrew.basis.sheet`): the terminal, pictures, files, and blocks of a report."""
