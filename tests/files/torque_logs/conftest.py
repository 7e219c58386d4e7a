"""Logs for tests of reading."""

import pytest

from ballscrew.files.torque_logs import reading


@pytest.fixture
def read(tmp_path):
    """Read a text as a file."""

    def read(text, name="log.csv", columns=None, **options):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return reading.read(path, columns, **options)

    return read
