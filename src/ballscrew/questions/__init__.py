"""Questions of users: a folder for each, with its options, its answer and the sheet that is shown of it.

May import ``exports`` and below. Those that the command line registers from a record have it in ``question``; the
commands of the others stand in ``faces/cli``. Start with ``duty``.
"""
