"""Questions of users: a folder for each, with its computation, document, text, picture and tables.

May import ``exports`` and below; files named ``figure`` alone import matplotlib. Start with ``duty``.
"""
