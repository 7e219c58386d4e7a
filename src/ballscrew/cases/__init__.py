"""Cases that people write: the schema, case files and projects, rows of catalogues, torque cards.

May import ``evidence`` and below, and pydantic. Start with ``case_files.case_file``.
"""
