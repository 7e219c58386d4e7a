"""Renderers of sheets (:mod:`ballscrew.basis.output.sheet`): the terminal, pictures, files, and blocks of a report."""
