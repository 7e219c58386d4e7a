"""Tables of screws that people own: their columns, their rows, the kinds of nuts by name"""
