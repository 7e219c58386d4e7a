"""The files of an export, their range and their worst error."""
