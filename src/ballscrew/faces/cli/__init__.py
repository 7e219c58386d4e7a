"""The command line."""

#: The exit code of a program that Ctrl-C ends.
INTERRUPTED = 130
