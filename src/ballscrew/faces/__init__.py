"""Shells that list the questions: command line, web application, notebook, report.

May import everything. Start with ``cli.main`` and ``web.api``.
"""
