"""Questions of users: a folder for each, with its options, its answer and the sheet that is shown of it.

May import ``exports`` and below. The folder itself has the options, and the record of those that the command line
registers from one; the commands of the others stand in ``faces/cli``. Start with ``duty``.
"""
