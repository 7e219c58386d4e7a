"""Files that people bring: spreadsheets and CSV, headings, numbers, logs as rows.

May import ``basis``. Start with ``tables.headings`` and ``torque_logs.reading``.
"""
